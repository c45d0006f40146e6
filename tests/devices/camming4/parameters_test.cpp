#include <gmock/gmock.h>

#include <algorithm>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

/// What each parameter does to the running device, by closed forms. Without gains and with the slave blocked
/// the following error is the theoretical way.
class Camming4Parameters : public Camming4Test {
 protected:
  /// Theoretical way of `count` periods [bits].
  int way(int count) {
    const int before = get("follerr");
    ticks(count);
    return get("follerr") - before;
  }
};

TEST_F(Camming4Parameters, SpeedsAreInWholeUnitsPerMinuteOrSecond) {
  without_gains();
  does("setvel=60 maxvel=6000 tacc=0 maxpos=999999");
  int per_second = 60;
  for (const int decpt : {0, 1, 2, 3}) {
    for (const int unitvel : {1, 0}) {
      does("power");
      set({{"decpt", decpt}, {"unitvel", unitvel}});
      does("INIT LOOPON MANFW +5");
      // 60 whole units of 10^decpt Um a second, or a minute, for 2 s.
      EXPECT_NEAR(way(1000), 2 * (unitvel == 1 ? per_second : per_second / 60), 1);
      shows("vconst");
    }
    per_second *= 10;
  }
  covers({"decpt", "unitvel", "setvel"});
}

TEST_F(Camming4Parameters, RampsTakeTheirShareOfTaccAndTdec) {
  does("tacc=50 tdec=20 setvel=10000");  // a fifth of maxvel: 0.1 s and 0.04 s
  does("INIT LOOPON setpos=50000 START");
  int accelerating = 1;
  for (; get("st_acc") == 1; ++accelerating) tick();
  EXPECT_NEAR(accelerating, 50, 1);
  shows("vconst");
  after("until:dec", "!vconst");
  EXPECT_NEAR(time_to_still(), 20, 1);
  shows("!dec");
  covers({"tacc", "tdec", "st_acc"});
}

TEST_F(Camming4Parameters, ANewTdecActsOnTheRunningPlacement) {
  does("setvel=10000 tdec=100 INIT LOOPON setpos=20000 START +150 tdec=10 until:dec");
  EXPECT_NEAR(time_to_still(), 10, 1);  // 0.02 s
  after("+200", "posit=20000~1");
  covers({"tdec"});
}

TEST_F(Camming4Parameters, ANewTargetBeyondALimitIsTheLimit) {
  after("maxpos=4000 INIT LOOPON setpos=3000 START +60 setpos=9000 until:still +200", "posit=4000~1");
  covers({"maxpos"});
}

TEST_F(Camming4Parameters, LinearRampTimesActInsideTheRamp) {
  without_gains();
  does("feedfw=1000 setvel=40000 tacc=100 INIT LOOPON MANFW +99");
  const int half_way = get("ffwdreg");  // 0.2 s of 50000 Um/s2
  EXPECT_NEAR(half_way, 0.2 * 32767, 70);
  does("tacc=25 +50");  // four times as steep
  EXPECT_NEAR(get("ffwdreg") - half_way, 0.1 * 4 * 32767, 300);
  covers({"tacc", "ffwdreg"});
}

TEST_F(Camming4Parameters, EpicycloidalRampsPeakAtTwiceTheGradient) {
  const auto steepest = [&](int type) {
    does("power");
    write("ramptype", type);
    does("INIT LOOPON posit=0 setpos=50000 START");
    int most = 0;
    for (int last = 0; get("st_acc") == 1; tick()) {
      most = std::max(most, get("ffwdreg") - last);
      last = get("ffwdreg");
    }
    return most;
  };
  EXPECT_NEAR(steepest(0), 65.5, 1);  // 50000 Um/s2: 100 of 50000 Um/s a period
  EXPECT_NEAR(steepest(1), 131, 2);
  covers({"ramptype"});
}

TEST_F(Camming4Parameters, AShortMovementKeepsItsTimesOrItsGradients) {
  does("ramptype=1 INIT LOOPON");
  // 100 Um at 5000 Um/s with ramps of 0.1 s: kept, they take 0.2 s; with their gradient the peak is
  // sqrt(100*50000) and the ramps take 44.7 ms each.
  does("setpos=100 START");
  EXPECT_NEAR(time_to_still(), 99, 1);
  does("rtype=1 setpos=0 START");
  EXPECT_NEAR(time_to_still(), 44, 1);
  covers({"rtype"});
}

TEST_F(Camming4Parameters, AStopEndsTheEpicycloidalRampOrBreaksIt) {
  does("ramptype=1 INIT LOOPON");
  const auto peak_after_stop = [&] {
    does("MANFW +25");  // half of the ramp to 5000 Um/s
    does("STOP");
    int most = 0;
    for (; get("st_still") == 0; tick()) most = std::max(most, get("ffwdreg"));
    return most;
  };
  EXPECT_EQ(peak_after_stop(), 3277);
  does("stopt=1");
  EXPECT_NEAR(peak_after_stop(), 3277 / 2, 150);
  covers({"stopt", "STOP accepted"});
}

TEST_F(Camming4Parameters, FeedForwardIsItsShareOfTheSpeed) {
  after("feedfw=500 INIT LOOPON MANFW +60", "ffwdreg=1638");
  covers({"feedfw"});
}

TEST_F(Camming4Parameters, IntegralAndDerivativeActByTheirTimes) {
  // A tenth of the unit error; 2 ms of 20 ms.
  does("pgain=0 feedfw=0 integt=20 INIT LOOPON blocked=1 count+=-10");
  for (int i = 1; i <= 20; ++i) {
    does("sample");
    EXPECT_NEAR(get("intreg"), i * 327.67, 1) << i;
    shows("derreg=0");
    EXPECT_EQ(word(), get("intreg"));
  }
  after("integt=0 derivt=4 count+=-5 sample", "intreg=0 derreg=3277");  // two periods of 5 bits
  shows("DAC=3277");
  after("sample", "derreg=0");
  covers({"integt", "derivt"});
}

TEST_F(Camming4Parameters, FrequencyWindowsAreThoseOfTheirTimeBase) {
  constexpr int windows[] = {240, 480, 24, 120};
  for (int base = 0; base < 4; ++base) {
    does("power");
    const int other = 3 - base;
    set({{"tbf", base}, {"tbfm", other}});
    does("blocked=1 INIT");
    long slave_seen = 0;
    long master_seen = 0;
    const long begin = samples - 1;
    for (int i = 0; i < 260; ++i) {
      does("count+=-4 +1*8");
      if (slave_seen == 0 && get("frq") != 0) slave_seen = samples - begin;
      if (master_seen == 0 && get("frqm") != 0) master_seen = samples - begin;
    }
    EXPECT_EQ(slave_seen * period, windows[base] + period);
    EXPECT_EQ(master_seen * period, windows[other] + period);
    shows("frq=500 vel=2000 frqm=1000");
  }
  covers({"tbf", "tbfm"});
}

TEST_F(Camming4Parameters, TheMastersFrequencyMayBeWritten) {
  does("tbfm=2");  // 24 ms
  after("INIT LOOPON frqm=77 +1", "frqm=77");
  after("+24*8", "frqm=1000");
}

TEST_F(Camming4Parameters, CountsAndPositionsAreWrittenInTheirUnits) {
  after("measure=3600 pulse=4096 measurem=10 pulsem=40 INIT posit=1800 positm=-7 sample",
        "encoder=2048 encoderm=-28");
  after("encoder=-4096 encoderm=100 sample", "posit=-3600 positm=25");
  after("master+=3 sample", "positm=25");  // 103 bits: 25.75
  after("master+=1 sample", "positm=26");
  covers({"measure", "pulse", "measurem", "pulsem"});
}

TEST_F(Camming4Parameters, WritingAPositionDropsTheRemainderAndDelCntmKeepsIt) {
  after("measurem=1 pulsem=10 delta2=5 INIT +1*28 DELCNTM", "positm=7");  // 7.8
  after("+1*2", "positm=8");
  after("+1*9 positm=8 +1 +1*9", "positm=8");  // 8.9
  after("+1*1", "positm=9");
  covers({"delta2"});
}

TEST_F(Camming4Parameters, APositionOfTheMasterDoesNotTouchTheSlavesPlacement) {
  after("INIT LOOPON setpos=1000 START until:dec positm=5 +1", "positm=5");
  after("until:still +200", "toll");
}

TEST_F(Camming4Parameters, ToleranceBoundsAreInclusive) {
  does("toll=5 INIT LOOPON blocked=1 setpos=0 START +3");
  for (const int posit : {-6, -5, 5, 6}) {
    count() = posit;
    does("sample");
    EXPECT_EQ(get("st_toll"), std::abs(posit) <= 5 ? 1 : 0) << posit;
    EXPECT_EQ(get("st_tpos"), std::abs(posit) <= 5 ? 1 : 0) << posit;
  }
  covers({"toll", "st_toll", "st_tpos", "START accepted"});
}

TEST_F(Camming4Parameters, MaxfollerrIsTheLargestErrorThatIsNotReported) {
  after("maxfollerr=40 INIT LOOPON blocked=1 count=-40 sample", "follerr=40 !foller");
  after("count=-41 sample", "follerr=41 foller !emrg");  // nothing stops by itself
  shows("DAC!=0");
  after("count=0 +249", "foller");
  after("+1", "!foller");
  covers({"maxfollerr"});
}

TEST_F(Camming4Parameters, GainsScaleWithMaxvelAndThePeriod) {
  does(
      "maxvel=25000 pgain=500 INIT LOOPON blocked=1 count=-10");  // 50 bits are the way at maxvel in a period
  after("sample", "propreg=3277");
  covers({"maxvel", "pgain"});
}

TEST_F(Camming4Parameters, InRetentiveMemoryTheCountIsKeptToTheBit) {
  does("measure=1 pulse=10 measurem=1 pulsem=10 INIT count=23 +1*47");
  Cards other_cards;
  Camming4 other(terminals_of("2 2.CNT01 2.CNT02 X X X X X X X X X"), other_cards);
  const auto symbol = [&](const char* name) { return *find_symbol(other.type(), name); };
  for (const std::string& name : symbol_names(device->type()))
    other.restore(*find_symbol(other.type(), name), get(name));
  other.command(0);
  other.sample();
  EXPECT_EQ(other.read(symbol("posit")), 2);
  EXPECT_EQ(other.read(symbol("encoder")), 23);
  EXPECT_EQ(other.read(symbol("positm")), 4);
  EXPECT_EQ(other.read(symbol("encoderm")), 47);
  other_cards.counters.at(address).count += 7;
  other_cards.counters.at(master_address).count += 3;
  other.sample();
  EXPECT_EQ(other.read(symbol("posit")), 3);
  EXPECT_EQ(other.read(symbol("positm")), 5);
}

TEST_F(Camming4Parameters, ANewResolutionBeforeInitKeepsThePosition) {
  after("INIT count=1234 sample power measure=10 pulse=4 INIT", "posit=1234 encoder=494");  // 1234 * 4 / 10
}

}  // namespace
}  // namespace drycut::devices::camming4
