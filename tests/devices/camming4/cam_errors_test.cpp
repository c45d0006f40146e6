#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/devices/camming4/cam_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Row move{154, 100, 100};
constexpr Row stand{133, 100, 0};

/// Runs 1000 Um of master at 1000 Um/s and gives the cam's end.
CamBench ran(std::initializer_list<Row> rows, std::int64_t stride = 1) {
  CamBench bench(rows);
  bench.master_speed = 1000;
  bench.start();
  bench.to(0);
  bench.run(1000, stride);
  return bench;
}

CamEvent error_of(std::initializer_list<Row> rows, std::int64_t stride = 1) {
  const CamBench bench = ran(rows, stride);
  EXPECT_LE(bench.errors.size(), 1U);
  EXPECT_FALSE(bench.cam.running());  // every table here ends, one way or the other
  return bench.errors.empty() ? CamEvent{} : bench.errors.front();
}
constexpr CamEvent fine{};

std::vector<CamEvent> warnings_of(std::initializer_list<Row> rows) {
  const CamBench bench = ran(rows);
  EXPECT_THAT(bench.errors, IsEmpty());
  return bench.warnings;
}

TEST(CamErrors, OneMoreThanNineRowsWithoutMasterSpace) {
  const Row nop{130};
  EXPECT_EQ(error_of({move, nop, nop, nop, nop, nop, nop, nop, nop, end_row}), fine);
  EXPECT_EQ(error_of({move, nop, nop, nop, nop, nop, nop, nop, nop, nop, end_row}), (CamEvent{1, 11}));
  EXPECT_EQ(error_of({move, {133}, {134}, {233}, {234}, {180}, nop, nop, nop, nop, nop, move, end_row}),
            (CamEvent{1, 11}));
  EXPECT_EQ(error_of({nop, nop, nop, nop, nop, nop, nop, nop, nop, nop}), (CamEvent{1, 10}));
}

TEST(CamErrors, JumpsThatNeverReachAMovement) {
  EXPECT_EQ(error_of({{137, 1}}), (CamEvent{1, 1}));
  EXPECT_EQ(error_of({{138}}), (CamEvent{1, 1}));
  EXPECT_EQ(error_of({{130}, {190, 1, 999999}}), (CamEvent{1, 2}));
}

TEST(CamErrors, OneMoreThanFourUpdates) {
  const Row update{139};
  EXPECT_EQ(error_of({move, update, update, update, update, end_row}), fine);
  EXPECT_EQ(error_of({move, update, {140}, {143}, {146}, update, end_row}), (CamEvent{1, 6}));
}

TEST(CamErrors, UpdatesAndOtherRowsAreCountedApart) {
  const Row nop{130};
  const Row update{139};
  EXPECT_EQ(error_of({move, nop, update, nop, update, nop, update, nop, update, nop, nop, nop, nop, end_row}),
            fine);
  EXPECT_EQ(error_of({move, update, update, nop, nop, update, update, nop, update, end_row}),
            (CamEvent{1, 9}));
}

TEST(CamErrors, StartSyncBeginsTheCountOfRowsAgain) {
  const Row nop{130};
  EXPECT_EQ(error_of({nop, nop, nop, nop, nop, nop, {160, 10}, nop, nop, nop, nop, nop, move, end_row}),
            fine);
}

TEST(CamErrors, JumpFromAMovingSlaveToAStartFromStandstill) {
  for (const int code : {131, 132, 150, 152, 231, 232, 252}) {
    SCOPED_TRACE(code);
    const Row start{code, 100, 50, 100, 50};
    EXPECT_EQ(error_of({move, {137, 4}, end_row, start, end_row}), (CamEvent{2, 4}));
    EXPECT_EQ(error_of({move, {190, 4, 1}, end_row, start, end_row}), (CamEvent{2, 4}));
    EXPECT_EQ(error_of({start, {138}}), (CamEvent{2, 1}));
    EXPECT_EQ(error_of({move, stand, {137, 5}, end_row, start, end_row}), (CamEvent{2, 5}));
    EXPECT_EQ(error_of({{135, 100, 50}, {137, 4}, end_row, start, end_row}), fine);
    EXPECT_EQ(error_of({move, {190, 4, 0}, start, end_row}), fine);  // no jump was made: warning 6
  }
  EXPECT_EQ(error_of({move, {137, 4}, end_row, {133, 100, 50}, end_row}), fine);
}

TEST(CamErrors, UnknownCode) {
  EXPECT_EQ(error_of({{0}}), (CamEvent{3, 1}));
  EXPECT_EQ(error_of({move, {129}}), (CamEvent{3, 2}));
  EXPECT_EQ(error_of({move, {130}, {155, 10, 10}}), (CamEvent{3, 3}));
  EXPECT_EQ(error_of({move, {137, 4}, {255}, end_row}), fine);
}

TEST(CamErrors, MasterSpaceNotPositive) {
  for (const Code& code : codes) {
    if (code.what != CodeClass::movement || code.qm == Use::radius) continue;
    SCOPED_TRACE(code.code);
    EXPECT_EQ(error_of({{code.code, 0, 10, 100, 10}, end_row}), (CamEvent{4, 1}));
    EXPECT_EQ(error_of({{code.code, -5, 10, 100, 10}, end_row}), (CamEvent{4, 1}));
    const bool uses_auxiliary = code.qma == Use::master_space;
    EXPECT_EQ(error_of({{code.code, 100, 10, 0, 0}, end_row}), uses_auxiliary ? (CamEvent{4, 1}) : fine);
  }
  EXPECT_EQ(error_of({{131, 0, 0}, end_row}), (CamEvent{4, 1}));
  EXPECT_EQ(error_of({{133, 0, 0}, end_row}), fine);
  EXPECT_EQ(error_of({{133, 0, 1}, end_row}), (CamEvent{4, 1}));
}

TEST(CamErrors, SectorEnteredAndLeftInOneSampling) {
  EXPECT_EQ(error_of({move, {154, 9, 9}, move, end_row}, 10), fine);         // 100..109, sampled at 100
  EXPECT_EQ(error_of({move, {130}, {154, 9, 9}, move, end_row}, 15), fine);  // at 105
  EXPECT_EQ(error_of({move, {130}, {154, 9, 9}, move, end_row}, 30), (CamEvent{4, 3}));  // at 90 and 120
}

TEST(CamErrors, SectorEnteredAndLeftBackwardsInOneSampling) {
  CamBench bench = started({move, move, move, end_row});
  bench.run(210, 50);
  bench.to(99);
  ASSERT_EQ(bench.errors.size(), 1U);
  EXPECT_EQ(bench.errors[0], (CamEvent{4, 2}));
}

TEST(CamErrors, JumpOutsideTheTable) {
  EXPECT_EQ(error_of({move, {137, 0}}), (CamEvent{6, 2}));
  EXPECT_EQ(error_of({move, {137, 129}}), (CamEvent{6, 2}));
  EXPECT_EQ(error_of({move, {137, -1}}), (CamEvent{6, 2}));
  EXPECT_EQ(error_of({move, {190, 129, 1}, end_row}), (CamEvent{6, 2}));
  EXPECT_EQ(error_of({move, {190, 129, 0}, end_row}), fine);
  EXPECT_EQ(error_of({move, {137, 128}}), (CamEvent{3, 128}));  // a row, though an empty one
}

TEST(CamErrors, TableWithoutAnEnd) {
  CamBench bench({});
  for (int row = 1; row <= cam_rows; ++row) bench.put(row, {154, 2, 1});
  bench.start();
  bench.run(1000);
  EXPECT_THAT(bench.errors, ElementsAre(CamEvent{6, 128}));
  EXPECT_EQ(bench.master, 256);
}

TEST(CamErrors, StartSyncNotAtTheBeginning) {
  const Row sync{160, 10};
  EXPECT_EQ(error_of({{130}, {139}, sync, move, end_row}), fine);
  EXPECT_EQ(error_of({move, sync, move, end_row}), (CamEvent{7, 2}));
  EXPECT_EQ(error_of({{137, 2}, sync, move, end_row}), (CamEvent{7, 2}));
  EXPECT_EQ(error_of({{190, 2, 1}, sync, move, end_row}), (CamEvent{7, 2}));
  EXPECT_EQ(error_of({{190, 2, 0}, sync, move, end_row}), fine);
  EXPECT_EQ(error_of({sync, move, {138}}), (CamEvent{7, 1}));
  EXPECT_EQ(error_of({sync, sync, move, end_row}), (CamEvent{7, 2}));
  EXPECT_EQ(error_of({{180, 0, 300}, sync, move, end_row}), (CamEvent{7, 2}));  // it moves the slave
  EXPECT_EQ(error_of({sync, {180, 0, 300}, move, end_row}), fine);
}

TEST(CamErrors, ArcsThatDoNotExist) {
  for (const int code : {170, 171, 172, 173, 174, 175}) {
    SCOPED_TRACE(code);
    EXPECT_EQ(error_of({move, {code, 50, 60, 0, 80}, end_row}), fine);
    EXPECT_EQ(error_of({move, {code, 50, 60, 0, 81}, end_row}), (CamEvent{50, 2}));
    EXPECT_EQ(error_of({move, {code, 50, 0, 0, 0}, end_row}), (CamEvent{51, 2}));
    EXPECT_EQ(error_of({move, {code, 0, 0, 0, 0}, end_row}), fine);
  }
}

TEST(CamErrors, ErrorStopsTheCamWhereItWas) {
  CamBench bench = started({move, {3}});
  bench.run(99);
  const CamStep& step = bench.to(110);
  EXPECT_FALSE(step.running);
  EXPECT_FALSE(step.ended);
  EXPECT_EQ(step.row, 0);
  EXPECT_EQ(step.slave_bits, 99);
  EXPECT_EQ(step.ratio, 0);
  EXPECT_EQ(bench.to(120).error, fine);
  EXPECT_EQ(bench.cam.step().slave_bits, 99);
}

TEST(CamWarnings, AccelerationAndDecelerationLimits) {
  // Gradients at 1000 Um/s: 131 2S/M2*V2 = 10000 Um/s2; twice that as a cycloid.
  const auto warnings = [](int code, double acceleration, double deceleration) {
    const Row row{code, 100, code == 131 || code == 231 ? 50 : -50};
    CamBench bench({row, {code < 200 ? 135 : 235, 100, code == 131 || code == 231 ? 50 : -50}, end_row});
    bench.cam.set(CamLimits{acceleration, deceleration});
    bench.master_speed = 1000;
    bench.start();
    bench.run(200);
    return bench.warnings;
  };
  EXPECT_THAT(warnings(131, 10000, 10000), IsEmpty());
  EXPECT_THAT(warnings(131, 9999, 10000), ElementsAre(CamEvent{1, 1}));
  EXPECT_THAT(warnings(131, 10000, 9999), ElementsAre(CamEvent{2, 2}));
  EXPECT_THAT(warnings(231, 20000, 20000), IsEmpty());
  EXPECT_THAT(warnings(231, 19999, 19999), ElementsAre(CamEvent{1, 1}, CamEvent{2, 2}));
  EXPECT_THAT(warnings(232, 19999, 20000), ElementsAre(CamEvent{1, 1}));  // backwards all the same
}

TEST(CamWarnings, FinalSpeedOppositeToTheInitialSpeed) {
  EXPECT_THAT(warnings_of({move, {133, 100, 49}, end_row}), ElementsAre(CamEvent{5, 2}));
  EXPECT_THAT(warnings_of({move, {133, 100, 50}, end_row}), IsEmpty());
  EXPECT_THAT(warnings_of({move, {133, 100, 51}, end_row}), IsEmpty());
  EXPECT_THAT(warnings_of({move, {151, 100, 49, 100, -1}, end_row}), ElementsAre(CamEvent{5, 2}));
  EXPECT_THAT(warnings_of({move, {153, 10, -10, 100, 0}, end_row}), ElementsAre(CamEvent{5, 2}));
  EXPECT_THAT(warnings_of({move, {154, 100, -100}, end_row}), IsEmpty());  // a step is what it is for
}

TEST(CamWarnings, StartFromStandstillMetWhileMoving) {
  for (const int code : {131, 132, 150, 152, 231, 232, 252}) {
    SCOPED_TRACE(code);
    const Row start{code, 100, 50, 100, 25};
    EXPECT_THAT(warnings_of({{135, 100, 50}, start, end_row}), IsEmpty());
    CamBench bench = started({move, start, end_row});
    bench.run(150);
    EXPECT_THAT(bench.warnings, ElementsAre(CamEvent{6, 2}));
  }
}

TEST(CamWarnings, StartFromStandstillStartsFromZero) {
  CamBench bench = started({move, {131, 100, 50}, end_row});
  bench.run(150);
  EXPECT_THAT(bench.warnings, ElementsAre(CamEvent{6, 2}));
  EXPECT_NEAR(bench.slave_um(), 100 + 12.5, 1e-9);
}

TEST(CamWarnings, MediumSpeedOppositeToTheInitialSpeed) {
  EXPECT_THAT(warnings_of({move, {134, 100, 49}, end_row}), ElementsAre(CamEvent{7, 2}));  // vm = -0.02
  EXPECT_THAT(warnings_of({move, {134, 100, 50}, end_row}), IsEmpty());
  EXPECT_THAT(warnings_of({move, {135, 100, 24}, end_row}), ElementsAre(CamEvent{7, 2}));  // vm = -0.02
  EXPECT_THAT(warnings_of({move, {135, 100, 25}, end_row}), IsEmpty());
  EXPECT_THAT(warnings_of({move, {234, 100, 49}, {235, 100, 24}, end_row}),
              ElementsAre(CamEvent{7, 2}, CamEvent{7, 3}));
  EXPECT_THAT(warnings_of({{132, 100, 24}, end_row}), ElementsAre(CamEvent{7, 1}));
  EXPECT_THAT(warnings_of({{132, 100, 25}, end_row}), IsEmpty());
  EXPECT_THAT(warnings_of({{152, 1, 1, 100, 24}, end_row}), ElementsAre(CamEvent{7, 1}));
  EXPECT_THAT(warnings_of({{150, 100, 100, 100, 24}, end_row}), ElementsAre(CamEvent{7, 1}));
}

TEST(CamWarnings, QuotaAlreadyPassedAtTheStart) {
  CamBench bench({{160, 50}, {154, 100, 100}, end_row});
  bench.master = bench.master_grains = 51;
  bench.start();
  bench.to(60);
  EXPECT_THAT(bench.warnings, ElementsAre(CamEvent{9, 1}));
  EXPECT_TRUE(bench.run(200).waiting);
  bench.run(50);
  EXPECT_TRUE(bench.run(80).waiting);  // at the quota, never below it
  EXPECT_TRUE(bench.run(49).waiting);
  EXPECT_EQ(bench.run(80).row, 2);
  EXPECT_NEAR(bench.slave_um(), 30, 1e-9);
  EXPECT_EQ(bench.warnings.size(), 1U);
}

TEST(CamWarnings, MasterOnTheQuotaStartsAtOnce) {
  CamBench bench({{160, 50}, {154, 100, 100}, end_row});
  bench.master = bench.master_grains = 50;
  bench.start();
  bench.to(53);
  EXPECT_THAT(bench.warnings, IsEmpty());
  EXPECT_NEAR(bench.slave_um(), 3, 1e-9);
}

TEST(CamWarnings, SofteningNotExecuted) {
  const Row soft{154, 100, 100, 1};
  const Row next{154, 100, 50};
  EXPECT_THAT(warnings_of({soft, next, end_row}), IsEmpty());
  EXPECT_THAT(warnings_of({soft, {130}, next, end_row}), ElementsAre(CamEvent{10, 3}));
  EXPECT_THAT(warnings_of({soft, {139}, {254, 100, 50}, end_row}), ElementsAre(CamEvent{10, 3}));
  EXPECT_THAT(warnings_of({move, {130}, next, end_row}), IsEmpty());  // none was asked for
  EXPECT_THAT(warnings_of({soft, {133, 100, 100}, next, end_row}), IsEmpty());
  EXPECT_THAT(warnings_of({{154, 100, 100, 1, 1}, next, end_row}), ElementsAre(CamEvent{10, 2}));
  EXPECT_THAT(warnings_of({{154, 100, 100, 5}, {130}, next, end_row}), IsEmpty());  // no such softening
}

}  // namespace
}  // namespace drycut::devices::camming4
