#include <cmath>

#include "devices/oopos2/laws.hpp"
#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

// The slow range by the speed (001 1.4.5; spec 9.4).
TEST(Oopos2Laws, SlowRangeIsProportional) {
  const Slowdown law{1, 800, 50, 1000};
  for (const int vel : {0, 1, 62, 63, 64, 500, 999, 1000, 1001, 5000}) {
    const double exact = std::min(800.0, 800.0 * vel / 1000);
    EXPECT_EQ(slow_range(law, vel), std::max(50, static_cast<int>(exact))) << vel;
  }
}

TEST(Oopos2Laws, SlowRangeBySquare) {
  const Slowdown law{2, 9999, 0, 999999};
  for (const int vel : {0, 1, 100, 9999, 100000, 500000, 999998, 999999, 2000000}) {
    const double share = std::min(1.0, vel / 999999.0);
    EXPECT_EQ(slow_range(law, vel), std::floor(9999 * share * share)) << vel;
  }
  EXPECT_EQ(slow_range({2, 800, 0, 1000}, 500), 200);
}

TEST(Oopos2Laws, TheSmallestSlowRangeIsStronger) {
  EXPECT_EQ(slow_range({1, 8, 80, 1000}, 1000), 80);  // as the manual's program sets them
  EXPECT_EQ(slow_range({1, 300, 0, 0}, 0), 300);      // without a maxvel
}

class Oopos2Slowdown : public Oopos2Test {
 protected:
  Oopos2Slowdown() { does("setpos=5000 maxvel=4000 maxslow=1000 minslow=30 toldly=5 INIT"); }
  /// Way before the quota at which the axis goes slow.
  int slows_at() {
    does("START");
    while (!output(5)) tick();
    return 5000 - get("posit");
  }
};

TEST_F(Oopos2Slowdown, SpeedIsMeasuredOver240Milliseconds) {
  covers({"frq", "decpt", "unitvel"});
  after("MANFFW +22", "vel=0");  // the first window began after INIT
  after("+1", "vel=1917");       // 23 samples of 24
  does("+24");
  EXPECT_EQ(get("frq"), 20 * 100 / 4);
  shows("vel=2000");
  after("decpt=1 +24", "vel=200");
  after("unitvel=0 +24", "vel=12000");
  after("MANFBW +60", "vel=12000");  // a magnitude
}

TEST_F(Oopos2Slowdown, Fixed) {
  EXPECT_EQ(slows_at(), 200);
  shows("exeslow=0");
}

TEST_F(Oopos2Slowdown, Proportional) {
  covers({"slowtype", "slowtype 1", "maxvel", "maxslow"});
  does("slowtype=1");
  EXPECT_EQ(slows_at(), 500);  // half of maxvel
  shows("exeslow=500");
  after("+60", "vel=400 exeslow=500");     // held
  after("until:still +60", "exeslow=30");  // minslow at rest
}

TEST_F(Oopos2Slowdown, BySquare) {
  covers({"slowtype 2", "minslow"});
  does("slowtype=2");
  EXPECT_EQ(slows_at(), 240);  // a quarter, 250, by steps of 20
  shows("exeslow=250");
}

TEST_F(Oopos2Slowdown, BySquareIsNeverBelowMinslow) {
  does("slowtype=2 minslow=400");
  EXPECT_EQ(slows_at(), 400);
}

TEST_F(Oopos2Slowdown, FollowsTheSpeedUntilItIsEntered) {
  after("slowtype=1 START +60", "exeslow=500");
  fast = 40;
  after("+48", "exeslow=1000");
}

}  // namespace
}  // namespace drycut::devices::oopos2
