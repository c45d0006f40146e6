// What each word and flag of the parameter block does (003 5), beyond the order of events.
#include <cmath>
#include <numeric>
#include <random>

#include "tests/devices/lx3vp/bench.hpp"
#include "tests/devices/lx3vp/covers.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Lx3vpBlock, TheLimitHoldsPulsesBackAndLosesNone) {
  CamBench bench;
  bench.set_wide(word::max_frequency, 25'000);  // 2.5 a tick
  bench.start(1);
  bench.move(1000);
  EXPECT_TRUE(bench.flag(status::delayed));
  EXPECT_THAT(bench.notes(), ElementsAre(HasSubstr("the frequency limit of D2006 holds back pulses of Y0")));
  std::vector<int> given;
  for (int i = 0; i < 8; ++i) {
    const auto before = bench.output();
    bench.tick();
    given.push_back(bench.output() - before);
  }
  EXPECT_THAT(given, testing::Each(testing::AnyOf(2, 3)));
  EXPECT_EQ(std::accumulate(given.begin(), given.end(), 0), 20);
  EXPECT_EQ(bench.tick(500), 1000);
  EXPECT_THAT(bench.notes(), IsEmpty()) << "told once a start";
  covers({"word 6", "word 1 bit 2"});
}

TEST(Lx3vpBlock, ASteadyTrainAtTheLimitIsNotHeldBack) {
  for (const int frequency : {1, 3000, 10'000, 33'333, 199'999, 200'000}) {
    CamBench bench;
    bench.set_wide(word::max_frequency, frequency);
    bench.table({{0, 0}, {1'000'000, 1'000'000}});
    bench.start(1);
    std::int64_t due = 0;
    std::int64_t counts = 0;
    for (int i = 1; i <= 20'000; ++i) {
      due += frequency;
      const std::int64_t now = due / ticks_per_second;
      bench.move(static_cast<std::int32_t>(now - counts));
      counts = now;
    }
    EXPECT_EQ(bench.output(), counts) << frequency;
    EXPECT_FALSE(bench.flag(status::delayed)) << frequency;
  }
}

TEST(Lx3vpBlock, LimitsOutOfRangeAreTheLargest) {
  for (const int limit : {-1, 200'001, 2'000'000'000}) {
    CamBench bench;
    bench.set_wide(word::max_frequency, limit);
    bench.start(1);
    EXPECT_EQ(bench.move(1000), 20) << limit;
  }
  CamBench frozen;
  frozen.set_wide(word::max_frequency, 0);
  frozen.start(1);
  frozen.move(10);
  EXPECT_EQ(frozen.tick(1000), 0);
  EXPECT_TRUE(frozen.flag(status::delayed));
}

TEST(Lx3vpBlock, TheWindowIsOnFromLowToHighInclusive) {
  CamBench bench;
  bench.table({{0, 0}, {200'000, 200}});
  bench.set(word::sync_output, 7);
  bench.set_wide(word::sync_low, 70'000);  // needs both words
  bench.set_wide(word::sync_high, 140'000);
  bench.set(word::live, live::sync_output);
  bench.start(1);
  const auto at = [&](std::int32_t position) {
    bench.move(position - bench.get_wide(word::master_position));
    return bench.level(7) && bench.registers.y[7] && bench.flag(status::in_window);
  };
  EXPECT_FALSE(at(69'999));
  EXPECT_TRUE(at(70'000));
  EXPECT_TRUE(at(100'000));
  EXPECT_TRUE(at(140'000));
  EXPECT_FALSE(at(140'001));
  EXPECT_FALSE(bench.level(7));
  EXPECT_FALSE(bench.flag(status::in_window));
  EXPECT_TRUE(at(270'000)) << "in every cycle";
  covers({"word 9", "word 11", "word 8", "word 4 bit 0", "word 1 bit 10"});
}

TEST(Lx3vpBlock, TheWindowEndsWithTheCam) {
  CamBench bench;
  bench.set(word::sync_output, 9);  // Y11
  bench.set_wide(word::sync_high, 1000);
  bench.set(word::live, live::sync_output);
  bench.outputs[9] = true;
  bench.enable();
  bench.tick();
  EXPECT_TRUE(bench.level(9)) << "not the cam's before it runs";
  bench.set(word::start, 1);
  bench.tick(3);
  EXPECT_TRUE(bench.level(9));
  EXPECT_THAT(bench.unit.held(), Contains(9));
  bench.set(word::live, 0);  // may be changed while it runs
  bench.tick();
  EXPECT_FALSE(bench.level(9));
  EXPECT_THAT(bench.unit.held(), Not(Contains(9)));
  bench.set(word::live, live::sync_output);
  bench.set(word::sync_output, 10);
  bench.tick();
  EXPECT_FALSE(bench.level(9));
  EXPECT_TRUE(bench.level(10));
  bench.set(word::start, 0);
  bench.tick();
  EXPECT_FALSE(bench.level(10));
  EXPECT_FALSE(bench.flag(status::in_window));
}

TEST(Lx3vpBlock, TheZoomsAreRatios) {
  CamBench bench;
  bench.table({{0, 0}, {3000, 1000}});
  bench.zoom({3, 7}, {2, 5});
  bench.set(word::function, function::master_zoom | function::slave_zoom);
  bench.start(1);
  EXPECT_EQ(bench.travel(7000), 400);  // 3000 table units
  EXPECT_EQ(bench.travel(700), 440);   // 300 more
  EXPECT_THAT(bench.wide_words(
                  {word::master_position, word::master_counts, word::slave_position, word::slave_pulses}),
              ElementsAre(300, 7700, 100, 40));
  // Each has a bit of its own.
  CamBench master;
  master.set(word::master_numerator, 2);
  master.set(word::slave_numerator, 3);
  master.set(word::function, function::master_zoom);
  master.start(1);
  EXPECT_EQ(master.travel(100), 200);
  CamBench slave;
  slave.set(word::master_numerator, 2);
  slave.set(word::slave_numerator, 3);
  slave.set(word::function, function::slave_zoom);
  slave.start(1);
  EXPECT_EQ(slave.travel(100), 300);
  CamBench none;
  none.set(word::master_numerator, 2);
  none.set(word::slave_numerator, 3);
  none.start(1);
  EXPECT_EQ(none.travel(100), 100);
  covers({"word 23", "word 24", "word 29", "word 30", "word 3 bit 2", "word 3 bit 3"});
}

TEST(Lx3vpBlock, TheTimeAxisCountsTicks) {
  for (const int unit : {1, 10}) {
    CamBench bench;
    bench.operands.master = {MasterSource::Kind::time, unit};
    bench.start(1);
    EXPECT_TRUE(bench.flag(status::time_axis));
    bench.tick(500 * unit);
    EXPECT_EQ(bench.get_wide(word::master_position), 500) << unit;
    EXPECT_EQ(bench.output(), 500) << unit;
    EXPECT_EQ(bench.tick(unit - 1), 500) << unit;
  }
  CamBench other(1);
  EXPECT_FALSE(other.flag(status::time_axis));
  covers({"word 1 bit 11"});
}

TEST(Lx3vpBlock, AHighSpeedCounterIsItsTerminalsPulses) {
  CamBench bench;
  bench.operands.master = {MasterSource::Kind::counter, 251};
  bench.high_speed[251] = 5'000'000'000;
  bench.start(1);
  bench.high_speed[251] += 15;
  bench.registers.c[251].value = 700;  // writing the register moves nothing
  EXPECT_EQ(bench.tick(), 15);
}

TEST(Lx3vpBlock, AnOrdinaryCounterIsItsRegister) {
  CamBench bench;
  bench.operands.master = {MasterSource::Kind::counter, 200};
  bench.start(1);
  bench.registers.c[200].value = 12;
  bench.high_speed[200] = 700;
  EXPECT_EQ(bench.tick(), 12);
}

TEST(Lx3vpBlock, ARegisterMasterPassesTheEndOf32Bit) {
  CamBench bench;
  bench.registers.set_i32(CamBench::master_register, std::numeric_limits<std::int32_t>::max() - 3);
  bench.start(1);
  bench.move(10);
  EXPECT_EQ(bench.registers.i32(CamBench::master_register), std::numeric_limits<std::int32_t>::min() + 6);
  EXPECT_EQ(bench.output(), 10);
}

// 10^8 pulses through zooms with coprime ratios, as a saw gives them in a shift: exact at the end.
TEST(Lx3vpBlock, AHundredMillionPulsesEndExactly) {
  CamBench bench;
  bench.table({{0, 0}, {4999, 5003}, {10'007, 10'009}});
  bench.zoom({65521, 65519}, {32749, 32771});
  bench.set(word::function, function::master_zoom | function::slave_zoom);
  bench.start(1);
  // 19 counts a tick, whole cycles of the master's zoom and the table at the end.
  std::int64_t counts = 0;
  constexpr std::int64_t total = 100'000'000;
  while (counts < total) {
    const auto step = static_cast<std::int32_t>(std::min<std::int64_t>(19, total - counts));
    bench.move(step);
    counts += step;
  }
  bench.tick(2);
  const RowLaw law({{0, 0}, {4999, 5003}, {10'007, 10'009}}, {65521, 65519}, {32749, 32771});
  // total x 65521/65519 table units are this many cycles and a rest; a cycle is 10009 x 32749/32771 pulses.
  const Wide units = Wide{total} * 65521;
  const Wide cycle = Wide{10'007} * 65519;
  const auto cycles = static_cast<std::int64_t>(units / cycle);
  const long double rest = static_cast<long double>(units % cycle) / 65519;
  const long double in_cycle = rest < 4999 ? rest * 5003 / 4999 : 5003 + (rest - 4999) * 5006 / 5008;
  const long double exact = (static_cast<long double>(cycles) * 10'009 + in_cycle) * 32749 / 32771;
  EXPECT_EQ(bench.output(), std::llround(exact));
  EXPECT_EQ(bench.output(), law.pulses(law.place(total)));
  EXPECT_EQ(bench.unit.pulses(0), bench.output()) << "each pulse one forwards";
  EXPECT_GT(bench.output(), 99'900'000);
}

// A reversing master, stops at any moment, deficits: in the end the slave is where the law puts it.
TEST(Lx3vpBlock, AfterAnyRunThePositionIsTheLawOfTheTravel) {
  std::mt19937 random(3);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int round = 0; round < 300; ++round) {
    CamBench bench;
    std::vector<std::pair<std::int32_t, std::int32_t>> rows;
    std::vector<RowLaw::Row> law_rows;
    std::int32_t master = draw(0, 50);
    for (int count = draw(2, 8); count > 0; --count) {
      rows.emplace_back(master, draw(-200, 200));
      law_rows.push_back({rows.back().first, rows.back().second});
      master += draw(1, 400);
    }
    bench.table(rows);
    const Zoom in{static_cast<std::uint16_t>(draw(1, 9)), static_cast<std::uint16_t>(draw(1, 9))};
    const Zoom out{static_cast<std::uint16_t>(draw(1, 9)), static_cast<std::uint16_t>(draw(1, 9))};
    bench.zoom(in, out);
    bench.set_wide(word::max_frequency, draw(20'000, 200'000));
    bench.set(word::function,
              function::master_zoom | function::slave_zoom | (round % 2 == 0 ? function::resume : 0U));
    bench.start(1);
    std::int64_t travel = 0;
    for (int i = draw(1, 400); i > 0; --i) {
      const int counts = draw(-40, 60);
      bench.move(counts);
      travel += counts;
      if (round % 2 == 0 && draw(0, 20) == 0) {  // stop, and go on from there
        bench.restart(1);
      }
    }
    for (std::int32_t before = bench.output() + 1; before != bench.output();) {  // until nothing is owed
      before = bench.output();
      bench.tick(500);
    }
    const RowLaw law(law_rows, in, out);
    EXPECT_EQ(bench.output(), law.pulses(law.place(travel))) << "round " << round;
    EXPECT_EQ(bench.get_wide(word::master_counts), travel);
  }
}

TEST(Lx3vpBlock, TheDirectionChangesATickBeforeThePulses) {
  CamBench bench;
  bench.table({{0, 0}, {100, 100}, {200, 0}});
  bench.start(1);
  EXPECT_TRUE(bench.level(CamBench::direction)) << "forwards from the start on";
  bench.travel(100);
  const auto given = bench.unit.pulses(0);
  bench.move(10);
  EXPECT_FALSE(bench.level(CamBench::direction));
  EXPECT_EQ(bench.unit.pulses(0), given);
  bench.tick();
  EXPECT_EQ(bench.unit.pulses(0), given + 10);
  EXPECT_EQ(bench.output(), 90);
}

TEST(Lx3vpBlock, FourCamsRunAtOnce) {
  CamBench bench;
  constexpr std::array<int, 4> blocks{1000, 2000, 3000, 4000};
  CamPort port = bench.port();
  for (int i = 0; i < 4; ++i) {
    const int at = blocks[static_cast<std::size_t>(i)];
    bench.initialise(at);
    bench.table({{0, 0}, {1000, 100 * (i + 1)}}, at);
    bench.set(word::start, 1, at);
    DecamOperands operands = bench.operands;
    operands.block = at;
    operands.output = i;
    operands.direction = 4 + i;
    bench.unit.decam(10 + i, operands, true, port);
  }
  bench.tick(3);
  for (int i = 0; i < 100; ++i) bench.move(37);
  bench.tick(200);
  EXPECT_EQ(bench.registers.i32(8140), 370);
  EXPECT_EQ(bench.registers.i32(8142), 740);
  EXPECT_EQ(bench.registers.i32(8150), 1110);
  EXPECT_EQ(bench.registers.i32(8152), 1480);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(bench.level(4 + i));
  covers({"D8140", "D8142", "D8150", "D8152"});
}

TEST(Lx3vpBlock, ThePositionRegistersCountBothWaysAndMayBeWritten) {
  CamBench bench(1);
  bench.travel(300);
  EXPECT_EQ(bench.registers.d[8140], 300);
  bench.registers.set_i32(8140, 0);
  EXPECT_EQ(bench.travel(-301), -301);
  EXPECT_EQ(bench.unit.pulses(0), 601) << "the train counts every pulse";
}

}  // namespace
}  // namespace drycut::devices::lx3vp
