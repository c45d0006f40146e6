#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/devices/camming4/cam_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(CamSoftening, RampRunsOverTheStatedPartOfTheSmallerSector) {
  for (const int code : {154, 254})
    for (int softening = 1; softening <= 4; ++softening) {
      SCOPED_TRACE(code * 10 + softening);
      const double w = 60.0 / (softening + 1);
      CamBench bench = started({{code, 100, 50, softening}, {code, 60, 120}, end_row}, hundredths);
      const auto to = [&](double m) { bench.run(std::llround(m * 100)); };
      to(100 - w);
      EXPECT_NEAR(bench.cam.step().ratio, 0.5, tolerance);
      EXPECT_NEAR(bench.slave_um(), (100 - w) / 2, tolerance);
      to(100 - w / 2);
      const double quarter = code == 154 ? 0.25 : 0.25 - 1 / (2 * std::acos(-1.0));
      EXPECT_NEAR(bench.cam.step().ratio, 0.5 + 1.5 * quarter, tolerance);
      to(100);
      EXPECT_NEAR(bench.cam.step().ratio, 1.25, tolerance);
      to(100 + w);
      EXPECT_NEAR(bench.cam.step().ratio, 2, tolerance);
      EXPECT_NEAR(bench.slave_um(), 50 + 2 * w, tolerance);
      to(159);
      EXPECT_NEAR(bench.slave_um(), 50 + 118, tolerance);
      to(160);
      EXPECT_EQ(bench.cam.step().slave_bits, 17000);
      EXPECT_THAT(bench.warnings, IsEmpty());
    }
}

TEST(CamSoftening, SpeedIsContinuousThroughAChainOfSoftenedSectors) {
  CamBench bench =
      started({{154, 100, 50, 1}, {154, 40, 80, 1}, {254, 70, 10, 2}, {154, 50, 50}, end_row}, hundredths);
  bench.to(0);
  double ratio = bench.cam.step().ratio;
  double slave = 0;
  for (int count = 1; count < 26000; ++count) {
    EXPECT_NEAR(bench.to(count).ratio, ratio, 2e-3) << count;
    EXPECT_NEAR(bench.slave_um(), slave + ratio * 0.01, 2e-5) << count;
    ratio = bench.cam.step().ratio;
    slave = bench.slave_um();
  }
  EXPECT_EQ(bench.to(26000).slave_bits, 19000);
}

TEST(CamSoftening, RunsBackwardsOnTheSamePath) {
  CamBench bench = started({{154, 100, 50, 1}, {154, 60, 120}, end_row}, hundredths);
  bench.run(9500, 5);
  const double before = bench.slave_um();
  bench.run(10500, 5);
  const double after = bench.slave_um();
  EXPECT_NEAR(bench.slave_at(9500, 5), before, tolerance);
  EXPECT_NEAR(bench.slave_at(10500, 5), after, tolerance);
}

TEST(CamSoftening, NoneAtTheStartAndBeforeAStop) {
  CamBench bench = started({{154, 100, 50, 1, 1}, {133, 100, 0}, end_row}, hundredths);
  EXPECT_NEAR(bench.to(1).ratio, 0.5, tolerance);
  EXPECT_NEAR(bench.run(9999, 7).ratio, 0.5, tolerance);
  EXPECT_NEAR(bench.to(10001).ratio, 0, tolerance);
  EXPECT_EQ(bench.cam.step().slave_bits, 5000);
}

TEST(CamGearing, RatioHoldsForEverAndCountsStayBelowTheLap) {
  const CamSettings settings{.master = {7, 10}, .slave = {3, 11}, .decpt = 0};
  CamBench bench = started({{154, 30, -20, 0, 2}, end_row}, settings);
  for (std::int64_t count = 0; count <= 700'000; count += 25) {
    bench.to(count);
    ASSERT_LT(bench.positm(), 30);
    ASSERT_GT(bench.posit(), -20);
    ASSERT_LE(bench.posit(), 0);
  }
  // 490 000 Um of master: 490000 * -2/3 Um of slave * 11/3 bits.
  EXPECT_EQ(bench.cam.step().slave_bits, static_cast<std::int64_t>(std::floor(-490000.0 * 22 / 9)));
  EXPECT_EQ(bench.master_grains, 490'000 % 30 * 10);
  EXPECT_TRUE(bench.cam.running());
}

TEST(CamGearing, CountsWrapAtTheirOwnValues) {
  CamBench bench({{154, 100, 100, 0, 2}, end_row});
  bench.master_grains = 60;
  bench.slave_grains = 20;
  bench.start();
  bench.run(39);
  EXPECT_EQ(bench.positm(), 99);
  EXPECT_EQ(bench.posit(), 59);
  bench.run(41);
  EXPECT_EQ(bench.positm(), 1);
  EXPECT_EQ(bench.posit(), 61);
  bench.run(80);
  EXPECT_EQ(bench.posit(), 0);
}

TEST(CamGearing, NewRatioActsWithTheNextSamplingWithoutAStepOfPosition) {
  CamBench bench = started({{154, 100, 50, 0, 2}, end_row}, hundredths);
  EXPECT_NEAR(bench.slave_at(2100, 7), 10.5, tolerance);
  EXPECT_FALSE(bench.cam.refuses(1, Column::codeQs));
  bench.cam.write(1, Column::codeQs, -300);
  EXPECT_NEAR(bench.to(2107).ratio, -3, tolerance);
  EXPECT_NEAR(bench.slave_um(), 10.5 - 0.21, tolerance);
  bench.cam.write(1, Column::codeQs, 0);
  bench.to(2114);
  EXPECT_NEAR(bench.slave_um(), 10.5 - 0.21, tolerance);
  bench.cam.write(1, Column::codeQs, 100);
  EXPECT_NEAR(bench.slave_at(22114, 500), 10.5 - 0.21 + 200, tolerance);
  EXPECT_THAT(bench.errors, IsEmpty());
}

TEST(CamGearing, OnlyRatioAndTypeMayBeWritten) {
  CamBench bench = started({{154, 100, 50, 0, 2}, end_row});
  bench.to(1);
  EXPECT_FALSE(bench.cam.refuses(1, Column::codeQs));
  EXPECT_FALSE(bench.cam.refuses(1, Column::codeQsa));
  for (const Column column : {Column::codeG, Column::codeQm, Column::codeQma, Column::codeM})
    EXPECT_TRUE(bench.cam.refuses(1, column));
}

TEST(CamGearing, ReleaseGoesOnWithTheNextRowAtOnce) {
  for (const int type : {0, 1}) {
    SCOPED_TRACE(type);
    CamBench bench = started({{154, 100, 50, 0, 2}, {133, 100, 50}, end_row}, hundredths);
    bench.run(4000, 7);
    bench.cam.write(1, Column::codeQsa, type);
    EXPECT_EQ(bench.to(4010).row, 2);
    EXPECT_NEAR(bench.cam.sector().entry_speed, type == 0 ? 0.5 : 0, tolerance);
    bench.run(13999, 7);
    EXPECT_TRUE(bench.to(14000).ended);
    EXPECT_EQ(bench.cam.step().slave_bits, 7000);
  }
}

// 000 1.2.3.2 and 1.2.9: each takes off what the other has not.
TEST(CamGearing, ALoopAfterItsReleaseBringsTheCountsBackToWhereTheyBegan) {
  for (const std::int32_t slave : {50, -50}) {
    SCOPED_TRACE(slave);
    CamBench bench({{154, 100, slave, 0, 2}, {133, 100, slave}, {138}});
    bench.master_grains = 10;
    bench.slave_grains = -4;
    bench.start();
    bench.run(1048, 3);
    EXPECT_EQ(bench.positm(), 1058 % 100);
    bench.cam.write(1, Column::codeQsa, 0);
    bench.run(1147, 3);
    EXPECT_EQ(bench.cam.step().row, 2);
    bench.cam.write(1, Column::codeQsa, 2);
    EXPECT_EQ(bench.to(1150).row, 1);
    EXPECT_THAT(bench.errors, IsEmpty());
    EXPECT_EQ(bench.positm(), 10 + 2);
    EXPECT_EQ(bench.posit(), -4 + slave / 50);
    EXPECT_EQ(bench.cam.step().slave_bits, 1150 * slave / 100);  // the axis has not noticed
  }
}

TEST(CamGearing, MasterFasterThanALapASamplingIsError4) {
  CamBench bench = started({{154, 100, 50, 0, 2}, end_row});
  bench.to(50);
  bench.to(149);
  EXPECT_THAT(bench.errors, IsEmpty());
  bench.to(249);
  EXPECT_THAT(bench.errors, ElementsAre(CamEvent{4, 1}));
}

TEST(CamGearing, FollowsBackwardsToItsStartAndIntoTheSectorBefore) {
  CamBench bench = started({{154, 100, 100}, {154, 10, 20, 0, 2}, end_row});
  EXPECT_NEAR(bench.slave_at(155, 5), 210, tolerance);
  EXPECT_NEAR(bench.slave_at(102, 3), 104, tolerance);
  EXPECT_EQ(bench.run(40, 3).row, 1);
  EXPECT_NEAR(bench.slave_um(), 40, tolerance);
  EXPECT_NEAR(bench.slave_at(130, 3), 160, tolerance);
}

TEST(CamGearing, WaitsAtItsStartWithoutASectorBefore) {
  CamBench bench = started({{154, 10, 20, 0, 2}, end_row});
  bench.run(25, 5);
  EXPECT_NEAR(bench.slave_at(-15, 5), 0, tolerance);
  EXPECT_NEAR(bench.slave_at(5, 5), 10, tolerance);
}

TEST(CamGearing, WithANewRatioItFollowsBackwardsForEver) {
  CamBench bench = started({{154, 10, 20, 0, 2}, end_row});
  bench.run(25, 5);
  bench.cam.write(1, Column::codeQs, 10);
  EXPECT_NEAR(bench.slave_at(-75, 5), 50 - 100, tolerance);
}

TEST(CamGearing, SoftenedChangeIntoAGearingIsAStepWithWarning10) {
  CamBench bench = started({{154, 100, 100, 1}, {154, 10, 20, 0, 2}, end_row});
  EXPECT_NEAR(bench.run(99).ratio, 1, tolerance);
  bench.run(101);
  EXPECT_THAT(bench.warnings, ElementsAre(CamEvent{10, 2}));
  EXPECT_NEAR(bench.cam.step().ratio, 2, tolerance);
}

}  // namespace
}  // namespace drycut::devices::camming4
