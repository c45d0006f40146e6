#include <gmock/gmock.h>

#include <algorithm>

#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

/// Runs of a day: exact to the count. Not in the coverage run, which would take them twice.
class Camming4LongRun : public Camming4Test {
 protected:
  static constexpr int period_ms = 10;
  Camming4LongRun() : Camming4Test("2.CNT01", "2.CNT02", period_ms) {}

  /// `count` samples of `bits` of the master each; the slave stands or follows by itself.
  void run(std::int64_t count, std::int64_t bits) {
    for (std::int64_t i = 0; i < count; ++i) {
      master().count += bits;
      does("sample");
    }
  }
};

// 000 1.2.14: out and back again with 8 sectors, then the counts' update and the jump to the first.
TEST_F(Camming4LongRun, TheWireGuideIsExactAfterADay) {
  // 3/7 and 5/11 Um a bit: neither a boundary nor a lap is a whole number of counts.
  does("measurem=3 pulsem=7 measure=5 pulse=11 pgain=0 feedfw=0 maxfollerr=2147483647 syncrange=999999");
  rows({{131, 100, 30},
        {133, 500, 300},
        {135, 100, 30},
        {133, 50, 0},
        {131, 100, -30},
        {133, 500, -300},
        {135, 100, -30},
        {133, 50, 0},
        {139, 1500, 0},
        {137, 1}});
  does("blocked=1 INIT LOOPON STARTCAM");
  // 1500 Um of master are 3500 bits: 125 samples of 28 bits a lap.
  constexpr std::int64_t samples_a_day = 86'400'000 / period_ms;
  static_assert(samples_a_day % 125 == 0);
  run(samples_a_day - 125 / 5, 28);
  shows("camex");
  EXPECT_EQ(get("positm"), 1500 - 300);
  // 300 Um before the end: 150 Um of row 6 and rows 7, 8 are to come: at 0.6, 90 + 30 Um.
  shows("rowex=6");
  EXPECT_EQ(get("follerr"), (90 + 30) * 11 / 5);
  run(125 / 5, 28);
  shows("rowex=1 positm=0 encoderm=0 posit=0 follerr=0 !error !warning silent");
}

// The slave advances each lap, the counts are set back: posit and positm stay, the axis does not drift.
TEST_F(Camming4LongRun, TenMillionCountsEndOnTheExactCount) {
  does(
      "measurem=934 pulsem=4099 measure=777 pulse=8191 pgain=0 feedfw=0 maxfollerr=2147483647 "
      "syncrange=999999");
  rows({{133, 123, 41}, {134, 77, 101}, {153, 3, 2, 61, 17}, {133, 90, -35}, {138}});
  does("blocked=1 INIT LOOPON STARTCAM");
  // A lap is 351 Um: 934 laps are 351*4099 bits. 107 Um and 17 bits of the slave a lap.
  constexpr std::int64_t counts = 351 * 4099;
  std::int64_t done = 0;
  for (int round = 1; round <= 7; ++round) {
    while (done < round * counts) {
      const std::int64_t step = std::min<std::int64_t>(97, round * counts - done);
      done += step;
      run(1, step);
    }
    shows("rowex=1 positm=0 encoderm=0");
    // Theoretical: (107*8191 + 17*777)/777 bits a lap; the axis stands, so it is all following error.
    const std::int64_t grains = (107LL * 8191 + 17 * 777) * 934 * round;
    EXPECT_EQ(get("follerr"), (grains + 777 / 2) / 777) << round;
    // posit is taken back by the space of each lap although the axis stands.
    EXPECT_EQ(get("posit"), -grains / 8191) << round;
  }
  EXPECT_GT(done, 10'000'000);
  shows("!error");
}

}  // namespace
}  // namespace drycut::devices::camming4
