#include <gmock/gmock.h>

#include <algorithm>

#include "devices/camming4/camming4.hpp"
#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

// EANPOS: what differs from EPICPOS (spec 7, D17).
class Eanpos : public PositionerTest {
 protected:
  Eanpos() : PositionerTest(eanpos::make_eanpos) {}
  double peak_acceleration(const char* name) {
    order(name);
    double peak = 0;
    double last = 0;
    do {
      does("+1");
      peak = std::max(peak, std::abs(speed() - last) * 1000 / period);
      last = speed();
    } while (get("st_still") == 0);
    return peak;
  }
};

TEST_F(Eanpos, RampsAreLinear) {
  does("INIT LOOPON setpos=4000 START");
  for (int i = 2; i <= 50; ++i) {
    does("+1");
    EXPECT_NEAR(speed(), 100 * i, 1);
  }
  shows("!still");
}

TEST_F(Eanpos, BothRampsTakeTheSameTimeAndOneTwiceTheAcceleration) {
  covers({"ramptype"});
  does("INIT LOOPON setpos=1000");
  EXPECT_EQ(duration("START"), 150);
  does("setpos=2000");
  EXPECT_NEAR(peak_acceleration("START"), 5000 / 0.1, 500);
  does("ramptype=1 setpos=1000");
  EXPECT_EQ(duration("START"), 150);
  does("setpos=0");
  EXPECT_NEAR(peak_acceleration("START"), 2 * 5000 / 0.1, 500);
}

TEST_F(Eanpos, AShortMoveIsATriangle) {
  does("setpos=125 INIT LOOPON START!");
  double peak = 0;
  long periods = 0;
  do {
    does("+1");
    ++periods;
    peak = std::max(peak, speed());
  } while (get("st_still") == 0);
  // vp = sqrt(D a) = 2500 Um/s with a = 50000; twice 0.05 s
  EXPECT_NEAR(peak, 2500, 1);
  EXPECT_EQ(periods, 50);
}

TEST_F(Eanpos, StopDeceleratesAtOnce) {
  for (const int ramptype : {0, 1}) {
    does("power");
    write("ramptype", ramptype);
    after("INIT LOOPON MANFW +24", "speed=2500~1");
    EXPECT_EQ(duration("STOP"), 25);
  }
}

TEST_F(Eanpos, ChangesActInsideALinearRamp) {
  // Twice as steep, at once (002 1.3.3).
  does("rampmode=1 tacc=100 tdec=100 INIT LOOPON setpos=10000 START +24 tacc=50");
  const double before = speed();
  does("+10");
  EXPECT_NEAR(speed() - before, 2000, 5);
  after("setvel=4000 +20", "speed=4000~1");
  after("until:still +300", "posit=10000~1 silent");
}

// The simulated master (000 1.5): the counter is on slot 1 and only the device moves it. cntratio 100000: 1
// Um = 1 pulse = 4 bits, so with unitvel 1 speeds are in Hz.
class EanposSimulated : public PositionerTest {
 protected:
  EanposSimulated() : PositionerTest(eanpos::make_eanpos, "1.CNT01") {
    does("blocked=1 cntratio=100000 setvel=1000 maxvel=100000 INIT");
  }
};

TEST_F(EanposSimulated, CountsFourBitsAHertz) {
  does("MANFW +20");
  for (const int hertz : {1000, 333, 77777, 1}) {
    write("setvel", hertz);
    does("+600");  // through the ramp
    const std::int64_t before = count();
    does("+500");  // 1 s
    EXPECT_NEAR(static_cast<double>(count() - before), 4.0 * hertz, 1) << hertz;
  }
  does("STOP until:still");
  const std::int64_t stopped = count();
  does("+100");
  EXPECT_EQ(count(), stopped);
}

TEST_F(EanposSimulated, KeepsThePartOfABit) {
  // 1 Hz is 0.008 bits a sample: nothing but the kept part moves the counter.
  does("setvel=1 taccdec=0 MANFW");
  ticks(500 * 100 - 1);  // 100 s
  shows("count=400");
}

TEST_F(EanposSimulated, ReadsItsOwnCounter) {
  does("MANFW +1000");
  EXPECT_NEAR(get("posit"), static_cast<double>(count()) / 4, 3);
  shows("!loopon");
  does("STOP until:still +1");
  EXPECT_EQ(get("posit"), count() / 4);
  does("CNTREV posit=0");
  const std::int64_t before = count();
  does("MANFW +100 STOP until:still +1");
  EXPECT_EQ(get("posit"), (before - count()) / 4);
}

TEST_F(EanposSimulated, PlacesItself) {
  for (const int quota : {2500, -777, 0}) {
    ASSERT_TRUE(place(quota));
    EXPECT_EQ(get("posit"), quota);
    EXPECT_EQ(count(), 4 * quota);
    shows("toll");
  }
}

TEST_F(EanposSimulated, RunsWithoutEndOrDrift) {
  does("setvel=100000 MANFW +1000");
  for (int i = 0; i < 100; ++i) {
    const std::int64_t before = count();
    for (int n = 0; n < 5000; ++n) {  // 10 s
      does("+1");
      if (get("posit") >= 500000) write("posit", 0);
    }
    ASSERT_EQ(count() - before, 4000000);
    shows("!still");
  }
  shows("silent");
}

TEST_F(EanposSimulated, EmergencyStopsIt) {
  does("MANFW +100 EMRG");
  const std::int64_t stopped = count();
  does("+10");
  EXPECT_EQ(count(), stopped);
}

TEST_F(EanposSimulated, PowerLossClearsTheCounterAndKeepsThePosition) {
  does("MANFW +500 STOP until:still +1");
  const int posit = get("posit");
  ASSERT_GT(posit, 500);
  after("power", "count=0");
  does("INIT +1");
  EXPECT_EQ(get("posit"), posit);
}

TEST_F(EanposSimulated, EpicposIsAnotherDeviceOfMovement) {
  Cards other;
  const auto epicpos = make_epicpos(terminals_of("2 1.CNT02 X X X"), other);
  drive(*epicpos, "cntratio=100000 maxvel=1000 setvel=1000 unitvel=1 maxpos=999999 INIT MANFW");
  for (int i = 1; i < 500; ++i) epicpos->sample();
  EXPECT_EQ(other.counters.begin()->second.count, 4000);
}

TEST_F(EanposSimulated, TwoOnOneCounterAreReported) {
  const auto second = eanpos::make_eanpos(terminals_of("2 1.CNT01 X X X"), cards);
  drive(*second, "cntratio=100000 INIT");
  EXPECT_THAT(said_by(*second),
              testing::ElementsAre("ICont: another device moves the same simulated counter"));
}

// CAMMING4 takes it as either master, and exchanges them in a cam without a jump (000 1.5; D18).
TEST_F(EanposSimulated, IsAMasterOfCamming4) {
  const auto cam = camming4::make_camming4(terminals_of("2 2.CNT01 2.CNT02 1.CNT01 X X X X X X X X"), cards);
  drive(*cam,
        "measure=1 pulse=4 measurem=1 pulsem=4 maxvel=100000 unitvel=1 feedfw=1000 mtype=1 "
        "codeG1=132 codeQm1=1000 codeQs1=500 codeG2=133 codeQm2=900000 codeQs2=900000 INIT! LOOPON STARTCAM");
  ASSERT_EQ(value_of(*cam, "st_camex"), 1);
  does("MANFW");
  for (int i = 0; i < 1000; ++i) {
    tick();
    cam->sample();
    ASSERT_EQ(value_of(*cam, "encoderm"), count());
  }
  EXPECT_EQ(value_of(*cam, "rowex"), 2);
  EXPECT_EQ(value_of(*cam, "ffwdreg"), 328);  // 1000 Um/s of 100000: the slave runs with the master
  const int before = value_of(*cam, "positm");
  std::int64_t& wired = cards.counters.at(*parse_address("2.CNT02")).count;
  wired = 123456;
  drive(*cam, "mtype=0 sample");
  EXPECT_NEAR(value_of(*cam, "positm"), before, 2);
  wired += 40;
  tick();
  cam->sample();
  EXPECT_NEAR(value_of(*cam, "positm"), before + 10, 2);
}

// Its count at an edge of an interrupt line is the one of its last sample.
TEST_F(EanposSimulated, IsCapturedByInterrupts) {
  const auto cam = camming4::make_camming4(terminals_of("2 X 1.CNT01 X X X X X X 5 X X"), cards);
  drive(*cam, "measurem=1 pulsem=4 funInt=4 INIT intcapt=2 sample INTENBL!");
  does("MANFW");
  for (int i = 0; i < 300; ++i) {
    tick();
    cam->sample();
  }
  shows("count>1000");
  cam->interrupt(5, true);
  const std::int64_t at_edge = count();
  tick();
  cam->sample();
  EXPECT_EQ(value_of(*cam, "delta2"), at_edge);
}

}  // namespace
}  // namespace drycut::devices::epicpos
