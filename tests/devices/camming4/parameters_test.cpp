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
  void without_gains() {
    set({{"pgain", 0}, {"feedfw", 0}});
    slave_blocked = true;
  }
  /// Theoretical way of `count` periods [bits].
  int way(int count) {
    const int before = get("follerr");
    ticks(count);
    return get("follerr") - before;
  }
  /// Periods until the axis stands.
  int time_to_still() {
    const long before = samples;
    EXPECT_TRUE(wait("st_still", 1));
    return static_cast<int>(samples - before);
  }
};

TEST_F(Camming4Parameters, SpeedsAreInWholeUnitsPerMinuteOrSecond) {
  without_gains();
  set({{"setvel", 60}, {"maxvel", 6000}, {"tacc", 0}, {"maxpos", 999999}});
  int per_second = 60;
  for (const int decpt : {0, 1, 2, 3}) {
    for (const int unitvel : {1, 0}) {
      device.power_up();
      set({{"decpt", decpt}, {"unitvel", unitvel}});
      start();
      command("MANFW");
      ticks(5);
      // 60 whole units of 10^decpt Um a second, or a minute, for 2 s.
      EXPECT_NEAR(way(1000), 2 * (unitvel == 1 ? per_second : per_second / 60), 1);
      EXPECT_EQ(get("st_vconst"), 1);
    }
    per_second *= 10;
  }
  covers({"decpt", "unitvel", "st_vconst", "setvel"});
}

TEST_F(Camming4Parameters, RampsTakeTheirShareOfTaccAndTdec) {
  set({{"tacc", 50}, {"tdec", 20}, {"setvel", 10000}});  // a fifth of maxvel: 0.1 s and 0.04 s
  start();
  write("setpos", 50000);
  command("START");
  int accelerating = 1;
  for (; get("st_acc") == 1; ++accelerating) tick();
  EXPECT_NEAR(accelerating, 50, 1);
  EXPECT_EQ(get("st_vconst"), 1);
  ASSERT_TRUE(wait("st_dec", 1));
  EXPECT_EQ(get("st_vconst"), 0);
  EXPECT_NEAR(time_to_still(), 20, 1);
  EXPECT_EQ(get("st_dec"), 0);
  covers({"tacc", "tdec", "st_acc", "st_dec"});
}

TEST_F(Camming4Parameters, ANewTdecActsOnTheRunningPlacement) {
  set({{"setvel", 10000}, {"tdec", 100}});
  start();
  write("setpos", 20000);
  command("START");
  ticks(150);
  write("tdec", 10);
  ASSERT_TRUE(wait("st_dec", 1));
  EXPECT_NEAR(time_to_still(), 10, 1);  // 0.02 s
  ticks(200);
  EXPECT_NEAR(get("posit"), 20000, 1);
  covers({"tdec"});
}

TEST_F(Camming4Parameters, ANewTargetBeyondALimitIsTheLimit) {
  write("maxpos", 4000);
  start();
  write("setpos", 3000);
  command("START");
  ticks(60);
  write("setpos", 9000);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_NEAR(get("posit"), 4000, 1);
  covers({"maxpos"});
}

TEST_F(Camming4Parameters, LinearRampTimesActInsideTheRamp) {
  without_gains();
  write("feedfw", 1000);
  set({{"setvel", 40000}, {"tacc", 100}});
  start();
  command("MANFW");
  ticks(99);
  const int half_way = get("ffwdreg");  // 0.2 s of 50000 Um/s2
  EXPECT_NEAR(half_way, 0.2 * 32767, 70);
  write("tacc", 25);
  ticks(50);  // four times as steep
  EXPECT_NEAR(get("ffwdreg") - half_way, 0.1 * 4 * 32767, 300);
  covers({"tacc", "ffwdreg"});
}

TEST_F(Camming4Parameters, EpicycloidalRampsPeakAtTwiceTheGradient) {
  const auto steepest = [&](int type) {
    device.power_up();
    write("ramptype", type);
    start();
    write("posit", 0);
    write("setpos", 50000);
    command("START");
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
  write("ramptype", 1);
  start();
  // 100 Um at 5000 Um/s with ramps of 0.1 s: kept, they take 0.2 s; with their gradient the peak is
  // sqrt(100*50000) and the ramps take 44.7 ms each.
  write("setpos", 100);
  command("START");
  EXPECT_NEAR(time_to_still(), 99, 1);
  set({{"rtype", 1}, {"setpos", 0}});
  command("START");
  EXPECT_NEAR(time_to_still(), 44, 1);
  covers({"rtype"});
}

TEST_F(Camming4Parameters, AStopEndsTheEpicycloidalRampOrBreaksIt) {
  write("ramptype", 1);
  start();
  const auto peak_after_stop = [&] {
    command("MANFW");
    ticks(25);  // half of the ramp to 5000 Um/s
    command("STOP");
    int most = 0;
    for (; get("st_still") == 0; tick()) most = std::max(most, get("ffwdreg"));
    return most;
  };
  EXPECT_EQ(peak_after_stop(), 3277);
  write("stopt", 1);
  EXPECT_NEAR(peak_after_stop(), 3277 / 2, 150);
  covers({"stopt", "STOP accepted"});
}

TEST_F(Camming4Parameters, FeedForwardIsItsShareOfTheSpeed) {
  write("feedfw", 500);
  start();
  command("MANFW");
  ticks(60);
  EXPECT_EQ(get("ffwdreg"), 1638);
  covers({"feedfw", "ffwdreg", "MANFW accepted"});
}

TEST_F(Camming4Parameters, IntegralAndDerivativeActByTheirTimes) {
  set({{"pgain", 0}, {"feedfw", 0}, {"integt", 20}});
  start();
  slave_blocked = true;
  slave().count -= 10;  // a tenth of the unit error; 2 ms of 20 ms
  for (int i = 1; i <= 20; ++i) {
    sample();
    EXPECT_NEAR(get("intreg"), i * 327.67, 1) << i;
    EXPECT_EQ(get("derreg"), 0);
    EXPECT_EQ(word(), get("intreg"));
  }
  set({{"integt", 0}, {"derivt", 4}});
  slave().count -= 5;
  sample();
  EXPECT_EQ(get("intreg"), 0);
  EXPECT_EQ(get("derreg"), 3277);  // two periods of 5 bits
  EXPECT_EQ(word(), 3277);
  sample();
  EXPECT_EQ(get("derreg"), 0);
  covers({"integt", "derivt", "intreg", "derreg"});
}

TEST_F(Camming4Parameters, FrequencyWindowsAreThoseOfTheirTimeBase) {
  constexpr int windows[] = {240, 480, 24, 120};
  for (int base = 0; base < 4; ++base) {
    device.power_up();
    const int other = 3 - base;
    set({{"tbf", base}, {"tbfm", other}});
    slave_blocked = true;
    command("INIT");
    long slave_seen = 0;
    long master_seen = 0;
    const long begin = samples - 1;
    for (int i = 0; i < 260; ++i) {
      slave().count += 4;
      tick(8);
      if (slave_seen == 0 && get("frq") != 0) slave_seen = samples - begin;
      if (master_seen == 0 && get("frqm") != 0) master_seen = samples - begin;
    }
    EXPECT_EQ(slave_seen * period, windows[base] + period);
    EXPECT_EQ(master_seen * period, windows[other] + period);
    EXPECT_EQ(get("frq"), 500);
    EXPECT_EQ(get("vel"), 2000);
    EXPECT_EQ(get("frqm"), 1000);
  }
  covers({"tbf", "tbfm", "frq", "frqm", "vel"});
}

TEST_F(Camming4Parameters, TheMastersFrequencyMayBeWritten) {
  write("tbfm", 2);  // 24 ms
  start();
  write("frqm", 77);
  tick();
  EXPECT_EQ(get("frqm"), 77);
  ticks(24, 8);
  EXPECT_EQ(get("frqm"), 1000);
}

TEST_F(Camming4Parameters, CountsAndPositionsAreWrittenInTheirUnits) {
  set({{"measure", 3600}, {"pulse", 4096}, {"measurem", 10}, {"pulsem", 40}});
  command("INIT");
  set({{"posit", 1800}, {"positm", -7}});
  sample();
  EXPECT_EQ(get("encoder"), 2048);
  EXPECT_EQ(get("encoderm"), -28);
  set({{"encoder", -4096}, {"encoderm", 100}});
  sample();
  EXPECT_EQ(get("posit"), -3600);
  EXPECT_EQ(get("positm"), 25);
  master().count += 3;
  sample();
  EXPECT_EQ(get("positm"), 25);  // 103 bits: 25.75
  master().count += 1;
  sample();
  EXPECT_EQ(get("positm"), 26);
  covers({"measure", "pulse", "measurem", "pulsem", "posit", "positm", "encoder", "encoderm"});
}

TEST_F(Camming4Parameters, WritingAPositionDropsTheRemainderAndDelCntmKeepsIt) {
  set({{"measurem", 1}, {"pulsem", 10}, {"delta2", 5}});
  command("INIT");
  tick(28);
  command("DELCNTM");
  EXPECT_EQ(get("positm"), 7);  // 7.8
  tick(2);
  EXPECT_EQ(get("positm"), 8);
  tick(9);
  write("positm", 8);
  tick();
  tick(9);
  EXPECT_EQ(get("positm"), 8);  // 8.9
  tick(1);
  EXPECT_EQ(get("positm"), 9);
  covers({"DELCNTM accepted", "delta2"});
}

TEST_F(Camming4Parameters, APositionOfTheMasterDoesNotTouchTheSlavesPlacement) {
  start();
  write("setpos", 1000);
  command("START");
  ASSERT_TRUE(wait("st_dec", 1));
  write("positm", 5);
  tick();
  EXPECT_EQ(get("positm"), 5);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_EQ(get("st_toll"), 1);
  covers({"st_toll"});
}

TEST_F(Camming4Parameters, ToleranceBoundsAreInclusive) {
  write("toll", 5);
  start();
  slave_blocked = true;
  write("setpos", 0);
  command("START");
  ticks(3);
  for (const int posit : {-6, -5, 5, 6}) {
    slave().count = posit;
    sample();
    EXPECT_EQ(get("st_toll"), std::abs(posit) <= 5 ? 1 : 0) << posit;
    EXPECT_EQ(get("st_tpos"), std::abs(posit) <= 5 ? 1 : 0) << posit;
  }
  covers({"toll", "st_toll", "st_tpos", "START accepted"});
}

TEST_F(Camming4Parameters, MaxfollerrIsTheLargestErrorThatIsNotReported) {
  write("maxfollerr", 40);
  start();
  slave_blocked = true;
  slave().count = -40;
  sample();
  EXPECT_EQ(get("follerr"), 40);
  EXPECT_EQ(get("st_foller"), 0);
  slave().count = -41;
  sample();
  EXPECT_EQ(get("follerr"), 41);
  EXPECT_EQ(get("st_foller"), 1);
  EXPECT_EQ(get("st_emrg"), 0);  // nothing stops by itself
  EXPECT_NE(word(), 0);
  slave().count = 0;
  ticks(249);
  EXPECT_EQ(get("st_foller"), 1);
  tick();
  EXPECT_EQ(get("st_foller"), 0);
  covers({"maxfollerr", "follerr", "st_foller"});
}

TEST_F(Camming4Parameters, GainsScaleWithMaxvelAndThePeriod) {
  set({{"maxvel", 25000}, {"pgain", 500}});
  start();
  slave_blocked = true;
  slave().count = -10;  // 50 bits are the way at maxvel in a period
  sample();
  EXPECT_EQ(get("propreg"), 3277);
  covers({"maxvel", "pgain", "propreg"});
}

TEST_F(Camming4Parameters, InRetentiveMemoryTheCountIsKeptToTheBit) {
  set({{"measure", 1}, {"pulse", 10}, {"measurem", 1}, {"pulsem", 10}});
  command("INIT");
  slave().count = 23;
  tick(47);
  Cards other_cards;
  Camming4 other({{2, {}},
                  {0, slave_address},
                  {0, master_address},
                  {0, {}},
                  {0, {}},
                  {0, {}},
                  {0, {}},
                  {0, {}},
                  {0, {}},
                  {0, {}},
                  {0, {}},
                  {0, {}}},
                 other_cards);
  const auto symbol = [&](const char* name) { return *find_symbol(other.type(), name); };
  for (const std::string& name : symbol_names(device.type()))
    other.restore(*find_symbol(other.type(), name), get(name));
  other.command(0);
  other.sample();
  EXPECT_EQ(other.read(symbol("posit")), 2);
  EXPECT_EQ(other.read(symbol("encoder")), 23);
  EXPECT_EQ(other.read(symbol("positm")), 4);
  EXPECT_EQ(other.read(symbol("encoderm")), 47);
  other_cards.counters.at(slave_address).count += 7;
  other_cards.counters.at(master_address).count += 3;
  other.sample();
  EXPECT_EQ(other.read(symbol("posit")), 3);
  EXPECT_EQ(other.read(symbol("positm")), 5);
}

TEST_F(Camming4Parameters, ANewResolutionBeforeInitKeepsThePosition) {
  command("INIT");
  slave().count = 1234;
  sample();
  device.power_up();
  set({{"measure", 10}, {"pulse", 4}});
  command("INIT");
  EXPECT_EQ(get("posit"), 1234);
  EXPECT_EQ(get("encoder"), 494);  // 1234 * 4 / 10
}

}  // namespace
}  // namespace drycut::devices::camming4
