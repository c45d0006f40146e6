// The pulse outputs: DPLSV, DDRVI, DDRVA, the flags of the outputs, and the high-speed counters.
#include <cmath>

#include "devices/lx3vp/high_speed_counters.hpp"
#include "tests/devices/lx3vp/bench.hpp"
#include "tests/devices/lx3vp/covers.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

constexpr std::array<int, 4> positions{8140, 8142, 8150, 8152};
constexpr std::array<int, 4> stops{8145, 8146, 8152, 8153};
constexpr std::array<int, 4> busy{8147, 8148, 8149, 8150};

using Order = PulseOrder::Kind;

void plsv(CamBench& bench, std::int32_t frequency, int output, bool powered = true, int step = 1) {
  bench.unit.pulses(step, {Order::speed, output, 10 + output, frequency}, powered, bench.registers);
}

class Lx3vpPulses : public testing::Test {
 protected:
  void SetUp() override {
    bench.registers.set_i32(8146, 100'000);
    bench.registers.d[8148] = 100;
  }
  void plsv(std::int32_t frequency, bool powered = true, int step = 1) {
    lx3vp::plsv(bench, frequency, 0, powered, step);
  }
  void drive(bool absolute, std::int32_t pulses, std::int32_t frequency, bool powered = true) {
    bench.unit.pulses(2, {absolute ? Order::position : Order::distance, 0, 10, frequency, pulses}, powered,
                      bench.registers);
  }
  void plsy(std::int32_t frequency, std::int32_t pulses, bool powered = true) {
    bench.unit.pulses(3, {Order::train, 0, PulseOrder::no_direction, frequency, pulses}, powered,
                      bench.registers);
  }
  // Executes the instruction every millisecond until M8029; the milliseconds that took.
  int drive_to_end(bool absolute, std::int32_t pulses, std::int32_t frequency) {
    int ms = 0;
    drive(absolute, pulses, frequency);
    for (; !bench.registers.m[8029] && ms < 60'000; ++ms) {
      bench.tick(10);
      drive(absolute, pulses, frequency);
    }
    return ms;
  }
  CamBench bench;
};

TEST_F(Lx3vpPulses, DplsvGivesItsFrequencyExactly) {
  for (const int frequency : {1, 777, 12'345, 200'000}) {
    CamBench fresh;
    lx3vp::plsv(fresh, frequency, 0);
    fresh.tick();  // the direction first
    EXPECT_EQ(fresh.tick(100'000), 10 * frequency);
    EXPECT_TRUE(fresh.level(10));
  }
}

TEST_F(Lx3vpPulses, DplsvFollowsItsRegisterAndTurnsRound) {
  plsv(10'000);
  EXPECT_EQ(bench.tick(101), 100);
  plsv(-20'000);
  bench.tick();
  EXPECT_FALSE(bench.level(10));
  EXPECT_EQ(bench.output(), 100) << "the direction first";
  EXPECT_EQ(bench.tick(100), -100);
  EXPECT_EQ(bench.unit.pulses(0), 300);
  plsv(0);
  EXPECT_EQ(bench.tick(50), -100);
  plsv(10'000'000);
  EXPECT_EQ(bench.tick(101), 1900) << "200 kHz at most";
  plsv(0, false);
  EXPECT_EQ(bench.tick(50), 1900);
}

TEST_F(Lx3vpPulses, EveryOutputHasItsFlags) {
  for (int output = 0; output < 4; ++output) {
    const auto i = static_cast<std::size_t>(output);
    CamBench fresh;
    lx3vp::plsv(fresh, 50'000, output);
    fresh.tick(11);
    for (std::size_t other = 0; other < 4; ++other) {
      EXPECT_EQ(fresh.registers.m[static_cast<std::size_t>(busy[other])], other == i);
      EXPECT_EQ(fresh.registers.i32(positions[other]), other == i ? 50 : 0);
    }
    fresh.registers.m[static_cast<std::size_t>(stops[i])] = true;
    fresh.tick(10);
    EXPECT_EQ(fresh.registers.i32(positions[i]), 50);
    fresh.registers.m[static_cast<std::size_t>(stops[i])] = false;
    fresh.tick(10);
    EXPECT_EQ(fresh.registers.i32(positions[i]), 100);
    lx3vp::plsv(fresh, 50'000, output, false);
    fresh.tick();
    EXPECT_FALSE(fresh.registers.m[static_cast<std::size_t>(busy[i])]);
  }
  covers({"M8145", "M8146", "M8152", "M8153", "M8147", "M8148", "M8149", "M8150"});
}

TEST_F(Lx3vpPulses, TheStopFlagStopsACamUntilItIsStartedAgain) {
  for (std::size_t i = 0; i < 4; ++i) {
    CamBench fresh;
    fresh.operands.output = static_cast<int>(i);
    fresh.start(1);
    fresh.move(10);
    EXPECT_TRUE(fresh.registers.m[static_cast<std::size_t>(busy[i])]);
    fresh.registers.m[static_cast<std::size_t>(stops[i])] = true;
    fresh.move(10);
    EXPECT_EQ(fresh.registers.i32(positions[i]), 10);
    EXPECT_FALSE(fresh.flag(status::cyclic));
    EXPECT_FALSE(fresh.registers.m[static_cast<std::size_t>(busy[i])]);
    fresh.registers.m[static_cast<std::size_t>(stops[i])] = false;
    for (int k = 0; k < 10; ++k) fresh.move(10);
    EXPECT_EQ(fresh.registers.i32(positions[i]), 10);
    fresh.restart(1);
    fresh.move(10);
    EXPECT_EQ(fresh.registers.i32(positions[i]), 20);
  }
}

TEST_F(Lx3vpPulses, AnOutputHasOneInstructionAtATime) {
  plsv(10'000);
  plsv(50'000, true, 5);
  plsv(50'000, true, 5);
  EXPECT_THAT(bench.notes(),
              ElementsAre("Y0 is in use by another instruction; this instruction gives no pulses"));
  EXPECT_EQ(bench.tick(11), 10);
  plsv(10'000, false);
  plsv(50'000, true, 5);
  EXPECT_EQ(bench.tick(2), 20);
  // A cam that starts meanwhile has no output.
  bench.start(1);
  EXPECT_THAT(bench.notes(), ElementsAre("6781: another instruction gives pulses on Y0"));
  plsv(50'000, false, 5);
  bench.restart(1);
  plsv(50'000, true, 5);
  EXPECT_THAT(bench.notes(), ElementsAre("Y0 is in use by a cam; this instruction gives no pulses"));
}

TEST_F(Lx3vpPulses, DdrviMovesByItsPulsesOnARamp) {
  const int ms = drive_to_end(false, 20'000, 50'000);
  EXPECT_EQ(bench.output(), 20'000);
  // 100 ms from 0 to the top speed of 100 kHz, so 50 ms to 50 kHz: 1250 pulses each ramp, the rest at 50 kHz;
  // the least speed, sqrt(slope / 2), shortens it a little.
  const double expected = 50 + (20'000 - 2 * 1250) / 50.0 + 50;
  EXPECT_NEAR(ms, expected, 3);
  EXPECT_FALSE(bench.registers.m[8147]);
  EXPECT_EQ(bench.tick(1000), 20'000);
  drive(false, 20'000, 50'000, false);
  EXPECT_FALSE(bench.registers.m[8029]);
  EXPECT_GT(drive_to_end(false, -500, 50'000), 0);
  EXPECT_EQ(bench.output(), 19'500);
  EXPECT_FALSE(bench.level(10));
  covers({"M8029"});
}

TEST_F(Lx3vpPulses, DdrvaMovesToAPosition) {
  bench.registers.set_i32(8140, 300);
  drive_to_end(true, 100, 10'000);
  EXPECT_EQ(bench.output(), 100);
  EXPECT_EQ(bench.unit.pulses(0), 200);
}

TEST_F(Lx3vpPulses, TheRampIsThatOfTheSpecialRegisters) {
  const auto time = [&](std::int32_t top, int ramp_ms, int bias) {
    CamBench fresh;
    std::swap(fresh, bench);
    bench.registers.set_i32(8146, top);
    bench.registers.d[8148] = static_cast<std::uint16_t>(ramp_ms);
    bench.registers.d[8145] = static_cast<std::uint16_t>(bias);
    const int ms = drive_to_end(false, 30'000, 200'000);
    EXPECT_EQ(bench.output(), 30'000);
    return ms;
  };
  // Top speed V after T: V T for both ramps together, the rest at V.
  EXPECT_NEAR(time(50'000, 200, 0), 200 + 200 + (30'000 - 10'000) / 50.0, 4);
  EXPECT_NEAR(time(100'000, 200, 0), 200 + 200 + (30'000 - 20'000) / 100.0, 4);
  EXPECT_NEAR(time(50'000, 400, 0), 400 + 400 + (30'000 - 20'000) / 50.0, 6);
  // From bias 5 kHz to 50 kHz the mean is 27.5 kHz.
  EXPECT_NEAR(time(50'000, 200, 5'000), 200 + 200 + (30'000 - 11'000) / 50.0, 4);
  covers({"D8145", "D8146", "D8148"});
}

TEST_F(Lx3vpPulses, AStoppedDriveIsGivenUp) {
  drive(false, 10'000, 10'000);
  bench.tick(1000);
  const auto given = bench.output();
  EXPECT_GT(given, 0);
  bench.registers.m[8145] = true;
  bench.tick(1000);
  bench.registers.m[8145] = false;
  drive(false, 10'000, 10'000);
  EXPECT_EQ(bench.tick(1000), given);
  EXPECT_FALSE(bench.registers.m[8029]);
  drive(false, 10'000, 10'000, false);
  drive(false, 100, 10'000);
  EXPECT_EQ(bench.tick(1000), given + 100);
}

TEST(Lx3vpCounters, OneWayCountersCountEveryPulseAsTheirRelaySays) {
  Registers registers;
  HighSpeedCounters unit;
  unit.count(235, 400, registers);
  EXPECT_EQ(registers.c[235].value, 0) << "not enabled";
  unit.enable(235, 150, true);
  unit.count(235, 800, registers);
  EXPECT_EQ(registers.c[235].value, 100);
  unit.count(235, 400, registers);  // the encoder runs back: a pulse is a pulse
  EXPECT_EQ(registers.c[235].value, 200);
  EXPECT_TRUE(registers.c[235].contact);
  registers.m[8235] = true;
  unit.count(235, 800, registers);
  EXPECT_EQ(registers.c[235].value, 100);
  EXPECT_FALSE(registers.c[235].contact);
  EXPECT_EQ(unit.pulses()[235], 100);
  covers({"M8235"});
}

TEST(Lx3vpCounters, TwoWayCountersFollowTheEncoder) {
  Registers registers;
  HighSpeedCounters unit;
  unit.enable(251, 50, true);
  unit.count(251, 203, registers);
  EXPECT_EQ(registers.c[251].value, 50);
  EXPECT_TRUE(registers.c[251].contact);
  unit.count(251, 199, registers);
  EXPECT_EQ(registers.c[251].value, 49);
  EXPECT_FALSE(registers.c[251].contact);
  unit.count(251, -1, registers);
  EXPECT_EQ(registers.c[251].value, -1) << "a pulse lies between -4 and 0 as between 0 and 4";
  unit.enable(246, 0, true);
  unit.count(246, -40, registers);
  EXPECT_TRUE(registers.m[8246]);
  unit.count(246, 40, registers);
  EXPECT_FALSE(registers.m[8246]);
  EXPECT_EQ(registers.c[246].value, 10);
  covers({"M8246"});
}

TEST(Lx3vpCounters, AnEncoderThatReturnsHasCountedNothing) {
  Registers registers;
  HighSpeedCounters unit;
  unit.enable(251, 0, true);
  std::int64_t edges = 0;
  for (int i = 0; i < 10'000; ++i) {
    edges += i % 7 - 3;
    unit.count(251, edges, registers);
  }
  unit.count(251, 0, registers);
  EXPECT_EQ(registers.c[251].value, 0);
  EXPECT_EQ(unit.pulses()[251], 0);
}

TEST(Lx3vpCounters, TheRegisterMayBeWrittenAndIsARing) {
  Registers registers;
  HighSpeedCounters unit;
  unit.enable(251, 0, true);
  registers.c[251].value = std::numeric_limits<std::int32_t>::max();
  unit.count(251, 8, registers);
  EXPECT_EQ(registers.c[251].value, std::numeric_limits<std::int32_t>::min() + 1);
  EXPECT_EQ(unit.pulses()[251], 2);
}

// PLSY and ZRN.

TEST_F(Lx3vpPulses, PlsyGivesItsPulsesWithoutARamp) {
  plsy(10'000, 500);
  EXPECT_EQ(bench.tick(100), 100);
  EXPECT_TRUE(bench.registers.m[8147]);
  plsy(20'000, 7);  // the frequency at once, the number with the next power
  EXPECT_EQ(bench.tick(100), 300);
  EXPECT_FALSE(bench.registers.m[8029]);
  bench.tick(1000);
  plsy(20'000, 7);
  EXPECT_EQ(bench.output(), 500);
  EXPECT_TRUE(bench.registers.m[8029]);
  EXPECT_FALSE(bench.registers.m[8147]);
  plsy(20'000, 7);
  EXPECT_EQ(bench.tick(100), 500) << "once a rising edge";
  plsy(20'000, 7, false);
  EXPECT_FALSE(bench.registers.m[8029]);
  plsy(20'000, 7);
  EXPECT_EQ(bench.tick(100), 507);
  EXPECT_THAT(bench.unit.held(), Not(Contains(10))) << "the direction is the program's";
}

TEST_F(Lx3vpPulses, PlsyWithoutNumberGoesOnUntilItLosesPower) {
  plsy(200'000, 0);
  EXPECT_EQ(bench.tick(10'000), 200'000);
  plsy(200'000, 0, false);
  EXPECT_EQ(bench.tick(10), 200'000);
  plsy(200'000, 0);
  bench.registers.m[8145] = true;
  bench.tick(10);
  bench.registers.m[8145] = false;
  EXPECT_EQ(bench.tick(10), 200'000) << "M8145 ends it until the next rising edge";
}

TEST_F(Lx3vpPulses, ZrnSeeksTheEndOfTheDog) {
  const auto zrn = [&](bool powered = true) {
    const PulseOrder order{Order::zero, 0, PulseOrder::no_direction, 20'000, 0, 1'000, {'X', 5}};
    bench.unit.pulses(4, order, powered, bench.registers);
  };
  bench.registers.set_i32(8140, 12'345);
  zrn();
  bench.tick(2'000);  // 100 ms of ramp at most
  const auto at_speed = bench.output();
  EXPECT_EQ(bench.tick(100), at_speed - 200) << "backwards at 20 kHz";
  bench.inputs[5] = true;
  bench.tick(2'000);
  const auto at_creep = bench.output();
  EXPECT_EQ(bench.tick(1'000), at_creep - 100) << "at 1 kHz";
  bench.inputs[5] = false;
  EXPECT_EQ(bench.tick(), 0) << "the position is 0 where the dog ends";
  const auto given = bench.unit.pulses(0);
  bench.tick(100);
  zrn();
  EXPECT_EQ(bench.unit.pulses(0), given);
  EXPECT_TRUE(bench.registers.m[8029]);
  // A start on the dog creeps from the beginning.
  zrn(false);
  bench.inputs[5] = true;
  zrn();
  EXPECT_EQ(bench.tick(1'000), -100);
}

TEST_F(Lx3vpPulses, AnOutputIsOneInstructionsAtATime) {
  plsv(1'000);
  plsy(1'000, 5);
  EXPECT_THAT(bench.notes(),
              ElementsAre("Y0 is in use by another instruction; this instruction gives no pulses"));
}

}  // namespace
}  // namespace drycut::devices::lx3vp
