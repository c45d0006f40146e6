#include <gmock/gmock.h>

#include <algorithm>

#include "devices/camming4/camming4.hpp"
#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// EANPOS: what differs from EPICPOS (spec 7, D17).
class Eanpos : public PositionerTest {
 protected:
  Eanpos() : PositionerTest(eanpos::make_eanpos) {}
  double peak_acceleration(const char* name) {
    order(name);
    double peak = 0;
    double last = 0;
    do {
      tick();
      peak = std::max(peak, std::abs(speed() - last) * 1000 / period);
      last = speed();
    } while (get("st_still") == 0);
    return peak;
  }
};

TEST_F(Eanpos, RampsAreLinear) {
  start();
  write("setpos", 4000);
  command("START");
  for (int i = 2; i <= 50; ++i) {
    tick();
    EXPECT_NEAR(speed(), 100 * i, 1);
  }
  EXPECT_EQ(get("st_still"), 0);
}

TEST_F(Eanpos, BothRampsTakeTheSameTimeAndOneTwiceTheAcceleration) {
  covers({"ramptype"});
  start();
  write("setpos", 1000);
  EXPECT_EQ(duration("START"), 150);
  write("setpos", 2000);
  EXPECT_NEAR(peak_acceleration("START"), 5000 / 0.1, 500);
  write("ramptype", 1);
  write("setpos", 1000);
  EXPECT_EQ(duration("START"), 150);
  write("setpos", 0);
  EXPECT_NEAR(peak_acceleration("START"), 2 * 5000 / 0.1, 500);
}

TEST_F(Eanpos, AShortMoveIsATriangle) {
  write("setpos", 125);
  start();
  order("START");
  double peak = 0;
  long periods = 0;
  do {
    tick();
    ++periods;
    peak = std::max(peak, speed());
  } while (get("st_still") == 0);
  // vp = sqrt(D a) = 2500 Um/s with a = 50000; twice 0.05 s
  EXPECT_NEAR(peak, 2500, 1);
  EXPECT_EQ(periods, 50);
}

TEST_F(Eanpos, StopDeceleratesAtOnce) {
  for (const int ramptype : {0, 1}) {
    device->power_up();
    write("ramptype", ramptype);
    start();
    command("MANFW");
    ticks(24);
    EXPECT_NEAR(speed(), 2500, 1);
    EXPECT_EQ(duration("STOP"), 25);
  }
}

TEST_F(Eanpos, ChangesActInsideALinearRamp) {
  set({{"rampmode", 1}, {"tacc", 100}, {"tdec", 100}});
  start();
  write("setpos", 10000);
  command("START");
  ticks(24);
  write("tacc", 50);  // twice as steep, at once (002 1.3.3)
  const double before = speed();
  ticks(10);
  EXPECT_NEAR(speed() - before, 2000, 5);
  write("setvel", 4000);
  ticks(20);
  EXPECT_NEAR(speed(), 4000, 1);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 10000, 1);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

// The simulated master (000 1.5): the counter is on slot 1 and only the device moves it. cntratio 100000: 1
// Um = 1 pulse = 4 bits, so with unitvel 1 speeds are in Hz.
class EanposSimulated : public PositionerTest {
 protected:
  EanposSimulated() : PositionerTest(eanpos::make_eanpos, "1.CNT01") {
    blocked = true;
    set({{"cntratio", 100000}, {"setvel", 1000}, {"maxvel", 100000}});
    command("INIT");
  }
};

TEST_F(EanposSimulated, CountsFourBitsAHertz) {
  command("MANFW");
  ticks(20);
  for (const int hertz : {1000, 333, 77777, 1}) {
    write("setvel", hertz);
    ticks(600);  // through the ramp
    const std::int64_t before = count();
    ticks(500);  // 1 s
    EXPECT_NEAR(static_cast<double>(count() - before), 4.0 * hertz, 1) << hertz;
  }
  command("STOP");
  EXPECT_TRUE(wait("st_still", 1));
  const std::int64_t stopped = count();
  ticks(100);
  EXPECT_EQ(count(), stopped);
}

TEST_F(EanposSimulated, KeepsThePartOfABit) {
  // 1 Hz is 0.008 bits a sample: nothing but the kept part moves the counter.
  set({{"setvel", 1}, {"taccdec", 0}});
  command("MANFW");
  ticks(500 * 100 - 1);  // 100 s
  EXPECT_EQ(count(), 400);
}

TEST_F(EanposSimulated, ReadsItsOwnCounter) {
  command("MANFW");
  ticks(1000);
  EXPECT_NEAR(get("posit"), static_cast<double>(count()) / 4, 3);
  EXPECT_EQ(get("st_loopon"), 0);
  command("STOP");
  EXPECT_TRUE(wait("st_still", 1));
  tick();
  EXPECT_EQ(get("posit"), count() / 4);
  command("CNTREV");
  write("posit", 0);
  const std::int64_t before = count();
  command("MANFW");
  ticks(100);
  command("STOP");
  ASSERT_TRUE(wait("st_still", 1));
  tick();
  EXPECT_EQ(get("posit"), (before - count()) / 4);
}

TEST_F(EanposSimulated, PlacesItself) {
  for (const int quota : {2500, -777, 0}) {
    ASSERT_TRUE(place(quota));
    EXPECT_EQ(get("posit"), quota);
    EXPECT_EQ(count(), 4 * quota);
    EXPECT_EQ(get("st_toll"), 1);
  }
}

TEST_F(EanposSimulated, RunsWithoutEndOrDrift) {
  write("setvel", 100000);
  command("MANFW");
  ticks(1000);
  for (int i = 0; i < 100; ++i) {
    const std::int64_t before = count();
    for (int n = 0; n < 5000; ++n) {  // 10 s
      tick();
      if (get("posit") >= 500000) write("posit", 0);
    }
    ASSERT_EQ(count() - before, 4000000);
    ASSERT_EQ(get("st_still"), 0);
  }
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(EanposSimulated, EmergencyStopsIt) {
  command("MANFW");
  ticks(100);
  command("EMRG");
  const std::int64_t stopped = count();
  ticks(10);
  EXPECT_EQ(count(), stopped);
}

TEST_F(EanposSimulated, PowerLossClearsTheCounterAndKeepsThePosition) {
  command("MANFW");
  ticks(500);
  command("STOP");
  wait("st_still", 1);
  tick();
  const int posit = get("posit");
  ASSERT_GT(posit, 500);
  device->power_up();
  EXPECT_EQ(count(), 0);
  command("INIT");
  tick();
  EXPECT_EQ(get("posit"), posit);
}

TEST_F(EanposSimulated, EpicposIsAnotherDeviceOfMovement) {
  Cards other;
  const Address counter = *parse_address("1.CNT02");
  const auto epicpos = make_epicpos({{2, {}}, {0, counter}, {0, {}}, {0, {}}, {0, {}}}, other);
  const auto write_to = [&](const char* name, int value) {
    epicpos->write(*find_symbol(epicpos->type(), name), value);
  };
  for (const auto& [name, value] : {std::pair{"cntratio", 100000},
                                    {"maxvel", 1000},
                                    {"setvel", 1000},
                                    {"unitvel", 1},
                                    {"maxpos", 999999}})
    write_to(name, value);
  for (const char* name : {"INIT", "MANFW"}) {
    epicpos->command(*find_command(epicpos->type(), name));
    epicpos->sample();
  }
  for (int i = 1; i < 500; ++i) epicpos->sample();
  EXPECT_EQ(other.counters.at(counter).count, 4000);
}

TEST_F(EanposSimulated, TwoOnOneCounterAreReported) {
  const auto second = eanpos::make_eanpos({{2, {}}, {0, address}, {0, {}}, {0, {}}, {0, {}}}, cards);
  second->write(*find_symbol(second->type(), "cntratio"), 100000);
  second->command(*find_command(second->type(), "INIT"));
  second->sample();
  const auto said = second->take_diagnostics();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].subject + ": " + said[0].text, "ICont: another device moves the same simulated counter");
}

// CAMMING4 takes it as either master, and exchanges them in a cam without a jump (000 1.5; D18).
TEST_F(EanposSimulated, IsAMasterOfCamming4) {
  Resources record(12);
  record[0].number = period;
  record[1].address = parse_address("2.CNT01");
  record[2].address = parse_address("2.CNT02");
  record[3].address = address;
  const auto cam = camming4::make_camming4(record, cards);
  const auto set_cam = [&](const char* name, int value) {
    cam->write(*find_symbol(cam->type(), name), value);
  };
  const auto cam_value = [&](const char* name) { return cam->read(*find_symbol(cam->type(), name)); };
  for (const auto& [name, value] : {std::pair{"measure", 1},
                                    {"pulse", 4},
                                    {"measurem", 1},
                                    {"pulsem", 4},
                                    {"maxvel", 100000},
                                    {"unitvel", 1},
                                    {"feedfw", 1000},
                                    {"mtype", 1},
                                    {"codeG1", 132},
                                    {"codeQm1", 1000},
                                    {"codeQs1", 500},
                                    {"codeG2", 133},
                                    {"codeQm2", 900000},
                                    {"codeQs2", 900000}})
    set_cam(name, value);
  const auto give_cam = [&](const char* name) { cam->command(*find_command(cam->type(), name)); };
  give_cam("INIT");
  give_cam("LOOPON");
  cam->sample();
  give_cam("STARTCAM");
  cam->sample();
  ASSERT_EQ(cam_value("st_camex"), 1);
  command("MANFW");
  for (int i = 0; i < 1000; ++i) {
    tick();
    cam->sample();
    ASSERT_EQ(cam_value("encoderm"), count());
  }
  EXPECT_EQ(cam_value("rowex"), 2);
  EXPECT_EQ(cam_value("ffwdreg"), 328);  // 1000 Um/s of 100000: the slave runs with the master
  const int before = cam_value("positm");
  cards.counters.at(*parse_address("2.CNT02")).count = 123456;
  set_cam("mtype", 0);
  cam->sample();
  EXPECT_NEAR(cam_value("positm"), before, 2);
  cards.counters.at(*parse_address("2.CNT02")).count += 40;
  tick();
  cam->sample();
  EXPECT_NEAR(cam_value("positm"), before + 10, 2);
}

// Its count at an edge of an interrupt line is the one of its last sample.
TEST_F(EanposSimulated, IsCapturedByInterrupts) {
  Resources record(12);
  record[0].number = period;
  record[2].address = address;
  record[9].number = 5;
  const auto cam = camming4::make_camming4(record, cards);
  const auto set_cam = [&](const char* name, int value) {
    cam->write(*find_symbol(cam->type(), name), value);
  };
  for (const auto& [name, value] : {std::pair{"measurem", 1}, {"pulsem", 4}, {"funInt", 4}})
    set_cam(name, value);
  cam->command(0);
  cam->sample();
  set_cam("intcapt", 2);
  cam->sample();
  cam->command(*find_command(cam->type(), "INTENBL"));
  command("MANFW");
  for (int i = 0; i < 300; ++i) {
    tick();
    cam->sample();
  }
  ASSERT_GT(count(), 1000);
  cam->interrupt(5, true);
  const std::int64_t at_edge = count();
  tick();
  cam->sample();
  EXPECT_EQ(cam->read(*find_symbol(cam->type(), "delta2")), at_edge);
}

}  // namespace
}  // namespace drycut::devices::epicpos
