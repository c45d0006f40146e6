#include <gtest/gtest.h>

#include <cmath>

#include "tests/devices/camming4/cam_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

// 000 1: the introduction's table.
CamBench introduction(const CamSettings& settings = {}) {
  return started({{132, 100, 50}, {133, 200, 200}, {134, 160, 120}, {133, 150, 150}, {135, 90, 45}, end_row},
                 settings);
}

TEST(CamEngine, IntroductionRuns700OfTheMasterAnd565OfTheSlave) {
  for (const std::int64_t stride : {1, 7, 13}) {
    CamBench bench = introduction();
    bench.run(699, stride);
    EXPECT_TRUE(bench.cam.running());
    EXPECT_TRUE(bench.to(700).ended);
    EXPECT_EQ(bench.cam.step().slave_bits, 565);
    EXPECT_EQ(bench.cam.step().slave_fraction, 0);
    EXPECT_TRUE(bench.errors.empty());
    EXPECT_TRUE(bench.warnings.empty());
  }
}

TEST(CamEngine, IntroductionFollowsTheMasterExactlyWhereTheManualSaysSo) {
  CamBench bench = introduction({.master = {1, 4}, .slave = {1, 4}, .decpt = 0});
  const struct {
    double master, slave, ratio;
  } points[] = {
      {50, 12.5, 0.5},      {100, 50, 1},  {200, 150, 1}, {300, 250, 1}, {340, 250 + 40 * 0.875, 0.75},
      {380, 250 + 60, 0.5}, {460, 370, 1}, {500, 410, 1}, {610, 520, 1}, {655, 520 + 45 * 0.75, 0.5}};
  for (const auto& point : points) {
    EXPECT_NEAR(bench.slave_at(static_cast<std::int64_t>(point.master * 4)), point.slave, tolerance)
        << point.master;
    EXPECT_NEAR(bench.cam.step().ratio, point.ratio, tolerance) << point.master;
  }
}

TEST(CamEngine, PositionDoesNotDependOnTheSampling) {
  CamBench fine = introduction({.master = {7, 30}, .slave = {11, 13}, .decpt = 0});
  CamBench coarse = introduction({.master = {7, 30}, .slave = {11, 13}, .decpt = 0});
  for (std::int64_t count = 0; count < 3000; count += 150) {
    fine.run(count);
    coarse.to(count);
    EXPECT_NEAR(fine.slave_um(), coarse.slave_um(), tolerance);
  }
}

TEST(CamEngine, OvershootGoesIntoTheNextSector) {
  CamBench bench = started({{154, 100, 50}, {154, 100, 200}, end_row});
  bench.to(95);
  EXPECT_EQ(bench.to(110).row, 2);
  EXPECT_NEAR(bench.slave_um(), 50 + 10 * 2, tolerance);
}

TEST(CamEngine, OriginMayBeALatchedCountInThePast) {
  CamBench bench({{154, 1000, 500}, end_row});
  bench.master = 1234;
  bench.cam.start({.master_count = 1200, .slave_bits = 40, .slave_fraction = 0.25});
  EXPECT_EQ(bench.to(1240).slave_bits, 60);
  EXPECT_NEAR(bench.cam.step().slave_fraction, 0.25, tolerance);
}

TEST(CamEngine, BoundariesAreNotRoundedToCounts) {
  // A sector of 10 Um is 233.33.. counts: the third ends exactly on a count.
  CamBench bench = started({{154, 10, 10}, {137, 1}}, {.master = {3, 70}, .slave = {1, 1}, .decpt = 0});
  bench.run(70 * 999, 100);
  bench.run(70 * 1000);
  EXPECT_EQ(bench.cam.master_origin(), (Point{70000, 0, 0}));
  EXPECT_EQ(bench.slave, 3000);
}

TEST(CamEngine, TenMillionCountsThroughALoopWithAwkwardRatiosEndOnTheExactCount) {
  // A loop is 123 + 77 + 61 Um of master, 41 + 101 - 35 Um and 17 bits of slave.
  const CamSettings settings{.master = {934, 4099}, .slave = {777, 8191}, .decpt = 0};
  CamBench bench =
      started({{133, 123, 41}, {134, 77, 101}, {153, 3, 2, 61, 17}, {133, 90, -35}, {138}}, settings);
  constexpr std::int64_t loop_um = 123 + 77 + 61 + 90;
  constexpr std::int64_t slave_grains = (41 + 101 - 35) * 8191 + 17 * 777;
  // After 934 loops the master stands on a whole count.
  constexpr std::int64_t counts = loop_um * 4099;
  for (int round = 1; round <= 7; ++round) {
    bench.run(round * counts, 97);
    EXPECT_EQ(bench.cam.master_origin(), (Point{round * counts, 0, 0}));
    const std::int64_t slave = slave_grains * 934 * round;
    EXPECT_EQ(bench.cam.slave_origin(), (Point{slave / 777, slave % 777, 0}));
    EXPECT_EQ(bench.master_grains, 0);
    EXPECT_EQ(bench.cam.step().slave_bits, slave / 777);
  }
  EXPECT_GT(bench.master, 10'000'000);
  EXPECT_TRUE(bench.errors.empty());
}

TEST(CamEngine, AMillionLoopsDoNotDrift) {
  const CamSettings settings{.master = {999, 1000}, .slave = {998, 3001}, .decpt = 0};
  CamBench bench = started({{154, 7, 5}, {154, 5, 3}, {138}}, settings);
  constexpr std::int64_t loops = 999'000;
  for (std::int64_t m = 0; m < loops * 12 * 1000 / 999; m += 3) bench.to(m);
  bench.to(loops * 12 * 1000 / 999);
  EXPECT_EQ(bench.cam.master_origin(), (Point{loops * 12 * 1000 / 999, 0, 0}));
  EXPECT_EQ(bench.cam.slave_origin(), (Point{loops * 8 * 3001 / 998, loops * 8 * 3001 % 998, 0}));
  EXPECT_EQ(bench.master_grains, 0);
}

TEST(CamEngine, ArcsInALoopDriftByLessThanAThousandthOfACount) {
  CamBench bench = started({{171, 100, 100, 0, 100}, {171, 100, -100, 0, 100}, {138}},
                           {.master = {1, 1}, .slave = {1, 1}, .decpt = 0});
  const double half_circle = 100 * std::acos(-1.0);
  for (int loop = 1; loop <= 10000; ++loop)
    for (int part = 1; part <= 8; ++part)
      bench.to(static_cast<std::int64_t>(std::llround((loop - 1 + part / 8.0) * half_circle)) + 1);
  const Point& origin = bench.cam.master_origin();
  EXPECT_NEAR(static_cast<double>(origin.bits) + origin.fraction, 10000 * half_circle, 1e-3);
  EXPECT_LE(std::abs(bench.positm()), 2);
  EXPECT_EQ(bench.cam.slave_origin(), (Point{0, 0, 0}));
}

TEST(CamEngine, NextRowIsTakenAsItWasWhenTheRunningRowBegan) {
  CamBench bench = started({{154, 100, 100}, {154, 100, 100}, {137, 1}});
  bench.run(50);
  bench.cam.write(2, Column::codeQs, 200);
  EXPECT_NEAR(bench.slave_at(150), 150, tolerance);              // this time the old one
  EXPECT_NEAR(bench.slave_at(350), 200 + 100 + 100, tolerance);  // next time the new one
}

TEST(CamEngine, ComingBackTheRowAheadIsStillAsItWas) {
  CamBench bench = started({{154, 100, 100}, {154, 100, 100}, {137, 1}});
  bench.run(120);
  EXPECT_EQ(bench.run(80).row, 1);
  bench.cam.write(2, Column::codeQs, 300);
  EXPECT_NEAR(bench.slave_at(150), 150, tolerance);
  EXPECT_NEAR(bench.slave_at(350), 200 + 100 + 150, tolerance);
}

TEST(CamEngine, ALoopAfterAStartSyncTakesOffWhatRanSinceTheQuota) {
  CamBench bench = started({{160, 50}, {154, 100, 60}, {138}});
  bench.run(100);
  bench.cam.write(1, Column::codeG, 130);  // else the loop would meet it again: error 7
  bench.run(160);
  EXPECT_EQ(bench.positm(), 160 - 100);
  EXPECT_EQ(bench.posit(), 6);
  EXPECT_TRUE(bench.errors.empty());
}

TEST(CamEngine, RowAfterTheNextIsTakenAsItStands) {
  CamBench bench = started({{154, 100, 100}, {154, 100, 100}, {154, 100, 100}, end_row});
  bench.run(50);
  bench.cam.write(3, Column::codeQs, 200);
  EXPECT_NEAR(bench.slave_at(250), 300, tolerance);
}

TEST(CamEngine, OnlyTheRunningRowRefusesWrites) {
  CamBench bench({{154, 100, 100}, {154, 100, 100}, end_row});
  EXPECT_FALSE(bench.cam.refuses(1, Column::codeQm));
  bench.start();
  bench.to(10);
  EXPECT_TRUE(bench.cam.refuses(1, Column::codeQs));
  EXPECT_TRUE(bench.cam.refuses(1, Column::codeM));
  EXPECT_FALSE(bench.cam.refuses(2, Column::codeQs));
  bench.run(150);
  EXPECT_FALSE(bench.cam.refuses(1, Column::codeQs));
  EXPECT_TRUE(bench.cam.refuses(2, Column::codeQs));
  bench.cam.stop();
  EXPECT_FALSE(bench.cam.refuses(2, Column::codeQs));
}

TEST(CamEngine, StopLeavesTheCamWithPositionAndRatioForTheRamp) {
  CamBench bench = started({{154, 100, 150}, end_row});
  bench.run(10);
  bench.cam.stop();
  EXPECT_FALSE(bench.cam.running());
  EXPECT_EQ(bench.cam.step().row, 0);
  EXPECT_EQ(bench.cam.step().slave_bits, 15);
  EXPECT_NEAR(bench.cam.step().ratio, 1.5, tolerance);
  bench.start();
  EXPECT_EQ(bench.to(20).row, 1);  // from row 1 again
}

TEST(CamEngine, ACopyRunsOnItsOwn) {
  CamBench bench = introduction();
  bench.run(123);
  CamBench copy = bench;
  bench.run(400);
  EXPECT_EQ(copy.run(400, 50).slave_bits, bench.cam.step().slave_bits);
  EXPECT_EQ(copy.cam.step().row, 3);
}

TEST(CamBackwards, LawIsFollowedBackIntoSectorsRunInSequence) {
  CamBench bench = introduction({.master = {1, 4}, .slave = {1, 4}, .decpt = 0});
  std::vector<double> there;
  for (std::int64_t count = 0; count <= 2600; count += 20) {
    bench.to(count);
    there.push_back(bench.slave_um());
  }
  EXPECT_EQ(bench.cam.step().row, 5);
  for (std::int64_t count = 2600; count >= 0; count -= 20) {
    bench.to(count);
    EXPECT_NEAR(bench.slave_um(), there[static_cast<std::size_t>(count / 20)], tolerance) << count;
  }
  EXPECT_EQ(bench.cam.step().row, 1);
  EXPECT_EQ(bench.cam.slave_origin(), (Point{0, 0, 0}));
  bench.run(2799, 20);
  EXPECT_EQ(bench.to(2800).slave_bits, 565 * 4);
}

TEST(CamBackwards, SlaveWaitsAtTheStartOfTheFirstSector) {
  CamBench bench = started({{154, 100, 100}, end_row});
  bench.run(10);
  EXPECT_EQ(bench.run(-30).row, 1);
  EXPECT_EQ(bench.slave, 0);
  EXPECT_EQ(bench.cam.step().ratio, 0);
  EXPECT_TRUE(bench.cam.running());
  EXPECT_NEAR(bench.slave_at(25), 25, tolerance);
}

TEST(CamBackwards, SlaveWaitsAtABoundaryWithARowWithoutMasterSpace) {
  for (const int code : {130, 139, 140, 141, 142, 143, 144, 145, 146, 180}) {
    SCOPED_TRACE(code);
    CamBench bench = started({{154, 100, 100}, {code, 0, 0}, {154, 100, 50}, end_row});
    bench.run(120);
    EXPECT_EQ(bench.run(60).row, 3);
    EXPECT_NEAR(bench.slave_um(), 100, tolerance);
    EXPECT_EQ(bench.cam.step().ratio, 0);
    EXPECT_NEAR(bench.slave_at(140), 120, tolerance);
  }
}

TEST(CamBackwards, SlaveWaitsAtABoundaryEnteredByAJump) {
  // Row 3 follows row 2, a movement, but was entered from row 1.
  CamBench bench = started({{154, 100, 100}, {137, 4}, {154, 100, 100}, {154, 100, 50}, end_row});
  bench.run(120);
  EXPECT_EQ(bench.run(60).row, 4);
  EXPECT_NEAR(bench.slave_um(), 100, tolerance);
}

TEST(CamBackwards, SlaveWaitsAtTheQuotaOfTheStartSync) {
  CamBench bench = started({{160, 50}, {154, 100, 100}, end_row});
  bench.run(70);
  EXPECT_EQ(bench.run(30).row, 2);
  EXPECT_FALSE(bench.cam.step().waiting);
  EXPECT_NEAR(bench.slave_um(), 0, tolerance);
  EXPECT_NEAR(bench.slave_at(70), 20, tolerance);
}

TEST(CamBackwards, LoopIsNotUndone) {
  CamBench bench = started({{154, 100, 100}, {138}});
  bench.run(110);
  EXPECT_EQ(bench.positm(), 10);
  bench.run(80);
  EXPECT_EQ(bench.positm(), -20);
  EXPECT_NEAR(bench.slave_um(), 100, tolerance);
  EXPECT_EQ(bench.cam.step().row, 1);
}

}  // namespace
}  // namespace drycut::devices::camming4
