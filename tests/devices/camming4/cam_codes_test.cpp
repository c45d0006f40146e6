#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "tests/devices/camming4/cam_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

constexpr CamSettings tenths{.master = {1, 10}, .slave = {1, 10}, .decpt = 1};  // 10 bits a Um

/// A movement row run from a given entry speed: where it ends, and the speed a little inside.
struct MovementCase {
  int entry;  ///< speed before, in hundredths: made by a 154 over 100 Um
  Row row;
  double master;  ///< [Um]
  double slave;   ///< [Um]
  double exit;
  double middle;  ///< speed at half of the sector
};

const double quarter = 50 * std::numbers::pi;  // arc of radius 100

const std::vector<MovementCase>& movement_cases() {
  static const std::vector<MovementCase> cases{
      {0, {131, 100, 30}, 100, 30, 0.6, 0.3},
      {0, {131, 100, -30}, 100, -30, -0.6, -0.3},
      {0, {132, 100, 50}, 100, 50, 1, 0.5},
      {0, {132, 100, 60}, 100, 60, 1, 0.7},
      {0, {132, 100, -50}, 100, -50, -1, -0.5},
      {100, {133, 100, 120}, 100, 120, 1.4, 1.2},
      {0, {133, 100, 0}, 100, 0, 0, 0},
      {100, {134, 100, 80}, 100, 80, 1, 0.6},
      {100, {135, 100, 50}, 100, 50, 0, 0.5},
      {100, {135, 100, 70}, 100, 70, 0, 0.9},
      {0, {150, 100, 50, 100, 250}, 200, 75, 0.5, 0.5},
      {50, {151, 100, 50, 100, 250}, 200, 75, 0, 0.5},
      {0, {152, 4, 3, 100, 375}, 100, 37.5, 0.75, 0.375},
      {0, {152, 4, 3, 100, 400}, 100, 40, 0.75, 0.425},
      {25, {153, 4, 3, 100, 500}, 100, 50, 0.75, 0.5},
      {25, {154, 50, 100}, 50, 100, 2, 2},
      {0, {170, 100, 100, 0, 100}, quarter, 100, 1, std::sqrt(0.5)},
      {0, {171, 100, 100, 0, 100}, quarter, 100, 0, std::sqrt(0.5)},
      {0, {172, 100, 100, 0, 100}, quarter, 100, 0, std::sqrt(0.5)},
      {0, {173, 100, 100, 0, 100}, quarter, 100, 1, std::sqrt(0.5)},
      {0, {174, 100, 100, 0, 100}, quarter, -900, -900 / quarter, -900 / quarter},
      {0, {175, 100, 100, 0, 100}, quarter, 900, 900 / quarter, 900 / quarter},
      {0, {231, 100, 30}, 100, 30, 0.6, 0.3},
      {0, {232, 100, 50}, 100, 50, 1, 0.5},
      {0, {232, 100, 60}, 100, 60, 1, 0.7},
      {100, {233, 100, 120}, 100, 120, 1.4, 1.2},
      {100, {234, 100, 80}, 100, 80, 1, 0.6},
      {100, {235, 100, 70}, 100, 70, 0, 0.9},
      {0, {252, 4, 3, 100, 375}, 100, 37.5, 0.75, 0.375},
      {25, {253, 4, 3, 100, 500}, 100, 50, 0.75, 0.5},
      {25, {254, 50, 100}, 50, 100, 2, 2},
  };
  return cases;
}

TEST(CamCodes, MovementsRunTheirSpacesAndLeaveAtTheirSpeed) {
  for (const MovementCase& expected : movement_cases()) {
    SCOPED_TRACE(expected.row.codeG);
    CamBench bench = started({{154, 100, expected.entry}, expected.row, {133, 100, 0}, end_row}, tenths);
    bench.run(1000);
    ASSERT_EQ(bench.to(1001).row, 2);
    const double base = expected.entry;
    EXPECT_NEAR(bench.run(1000 + std::lround(expected.master * 5)).ratio, expected.middle,
                2e-3 * std::abs(expected.middle) + tolerance);
    const auto last = static_cast<std::int64_t>(std::ceil(1000 + expected.master * 10)) - 1;
    EXPECT_EQ(bench.run(last).row, 2);
    EXPECT_EQ(bench.run(last + 1).row, 3);
    EXPECT_NEAR(bench.cam.sector().entry_speed, expected.exit, tolerance);
    const double into =
        static_cast<double>(last + 1) / 10 - 100 - expected.master;  // 133 from the exit speed to -exit
    EXPECT_NEAR(bench.slave_um(), base + expected.slave + expected.exit * into * (1 - into / 100), 1e-6);
    EXPECT_TRUE(bench.errors.empty());
  }
}

TEST(CamCodes, EpicycloidalSectorsPeakAtTwiceTheGradient) {
  for (const Code& code : codes) {
    if (!code.epicycloidal || code.code == 254) continue;
    SCOPED_TRACE(code.code);
    const Row row{code.code, 100, 70, 100, 700};
    const SectorEntry entry{.speed = code.zero_start ? 0.0 : 1.0, .softening = {}};
    const SectorResult cycloid = make_sector(code, row, 1, tenths, entry);
    const SectorResult straight = make_sector(*find_code(code.code - 100), row, 1, tenths, entry);
    EXPECT_NEAR(std::max(peak_acceleration(cycloid.sector), peak_deceleration(cycloid.sector)),
                2 * std::max(peak_acceleration(straight.sector), peak_deceleration(straight.sector)),
                tolerance);
    EXPECT_EQ(cycloid.sector.master, straight.sector.master);
    EXPECT_EQ(cycloid.sector.slave, straight.sector.slave);
    EXPECT_NEAR(cycloid.sector.exit_speed, straight.sector.exit_speed, tolerance);
  }
}

TEST(CamCodes, NopAndEmptyMovementsTakeNoSpace) {
  CamBench bench =
      started({{133, 100, 50}, {130}, {133}, {134}, {233}, {234}, {170}, {175}, {133, 100, 50}, end_row});
  bench.run(99);
  EXPECT_EQ(bench.to(101).row, 9);
  EXPECT_NEAR(bench.slave_um(), 50 + 1 - 0.01 / 2, 1e-2);  // entry speed 1 is kept
  EXPECT_NEAR(bench.cam.sector().entry_speed, 1, tolerance);
}

TEST(CamCodes, EndHoldsTheLastPositionExactly) {
  CamBench bench = started({{132, 100, 50}, {135, 100, 50, 0, 0, 7}, end_row});
  EXPECT_EQ(bench.run(150, 10).codeM, 7);
  bench.run(190, 10);
  const CamStep& step = bench.to(212);
  EXPECT_TRUE(step.ended);
  EXPECT_FALSE(step.running);
  EXPECT_EQ(step.row, 0);
  EXPECT_EQ(step.codeM, 0);
  EXPECT_EQ(step.slave_bits, 100);
  EXPECT_EQ(step.slave_fraction, 0);
  EXPECT_EQ(step.ratio, 0);
  EXPECT_FALSE(bench.to(300).ended);
  EXPECT_EQ(bench.cam.step().slave_bits, 100);
}

TEST(CamCodes, AbsoluteJumpKeepsSpeedAndCounts) {
  CamBench bench = started({{133, 100, 50}, {137, 4}, {131, 1, 1}, {134, 100, 100}, end_row});
  EXPECT_EQ(bench.run(110).row, 4);
  EXPECT_NEAR(bench.cam.sector().entry_speed, 1, tolerance);
  EXPECT_EQ(bench.positm(), 110);
  EXPECT_EQ(bench.posit(), 60);
}

TEST(CamCodes, LoopTakesTheExecutedSpacesOffTheCounts) {
  CamBench bench({{133, 100, 40}, {133, 100, 120}, {138}});
  bench.master_grains = 5000;
  bench.slave_grains = -300;
  bench.start();
  bench.run(199, 3);
  EXPECT_EQ(bench.to(203).row, 1);
  EXPECT_EQ(bench.cam.step().master_shift, 200);
  EXPECT_EQ(bench.cam.step().slave_shift, 160);
  EXPECT_EQ(bench.positm(), 5003);
  EXPECT_NEAR(bench.cam.sector().entry_speed, 1.6, tolerance);
}

TEST(CamCodes, UpdatesActAtTheBoundaryAndKeepTheOvershoot) {
  // Resolutions with a remainder: a Um is 7/3 master bits and 11/5 slave bits.
  const CamSettings settings{.master = {3, 7}, .slave = {5, 11}, .decpt = 0};
  struct Case {
    int code;
    std::int64_t master;  ///< value of the master at the boundary [grains], -1 = not changed
    std::int64_t slave;
  };
  constexpr std::int64_t same = -1;
  for (const Case& expected :
       {Case{139, (300 - 120) * 7, (60 - 40) * 11}, Case{140, 120 * 7, same}, Case{141, same, 40 * 11},
        Case{142, 120 * 7, 40 * 11}, Case{143, 300 * 7 - 120 * 3, 60 * 11 - 40 * 5}, Case{144, 120 * 3, same},
        Case{145, same, 40 * 5}, Case{146, 120 * 3, 40 * 5}}) {
    SCOPED_TRACE(expected.code);
    CamBench bench = started({{154, 300, 60}, {expected.code, 120, 40}, {154, 300, 60}, end_row}, settings);
    bench.run(699);
    bench.to(711);  // 11 bits = 33 grains beyond 300 Um
    EXPECT_EQ(bench.cam.step().row, 3);
    EXPECT_EQ(bench.master_grains, (expected.master == same ? 300 * 7 : expected.master) + 33);
    const double slave = static_cast<double>(bench.slave_grains) + 5 * bench.cam.step().slave_fraction;
    EXPECT_NEAR(slave,
                static_cast<double>(expected.slave == same ? 60 * 11 : expected.slave) + 33.0 / 7 * 0.2 * 11,
                1e-9);
    EXPECT_NEAR(bench.slave_um(), 60 + 33.0 / 7 * 0.2, 1e-9);  // the axis has not noticed
  }
}

TEST(CamCodes, StartSyncWaitsForItsQuotaAndCarriesTheOvershoot) {
  CamBench bench = started({{160, 50, 0, 0, 0, 9}, {133, 100, 100}, end_row});
  EXPECT_TRUE(bench.run(49, 7).waiting);
  EXPECT_TRUE(bench.cam.running());
  EXPECT_EQ(bench.cam.step().row, 1);
  EXPECT_EQ(bench.cam.step().codeM, 9);
  EXPECT_EQ(bench.cam.step().ratio, 0);
  EXPECT_FALSE(bench.to(60).waiting);
  EXPECT_EQ(bench.cam.step().row, 2);
  EXPECT_NEAR(bench.slave_um(), 10 * 10 / 100.0, tolerance);
}

TEST(CamCodes, StartSyncAfterUpdatesUsesTheUpdatedCount) {
  CamBench bench = started({{140, 1000}, {130}, {160, 1050}, {154, 100, 100}, end_row});
  EXPECT_TRUE(bench.run(49, 7).waiting);
  bench.to(55);
  EXPECT_NEAR(bench.slave_um(), 5, tolerance);
}

TEST(CamCodes, RecoveryIsReportedWithItsRowAndTakesNoMaster) {
  CamBench bench = started({{154, 100, 100}, {180, 0, -25}, {154, 100, 100}, end_row});
  EXPECT_EQ(bench.run(99).recovery, 0);
  EXPECT_EQ(bench.to(101).recovery, -25);
  EXPECT_EQ(bench.cam.step().recovery_row, 2);
  EXPECT_EQ(bench.cam.step().row, 3);
  EXPECT_NEAR(bench.slave_um(), 101, tolerance);
  EXPECT_EQ(bench.to(102).recovery, 0);
}

TEST(CamCodes, ConditionalJumpCountsItsJumpsAndStartsAgain) {
  CamBench bench = started({{154, 10, 10}, {190, 1, 2}, {154, 10, 20}, {137, 1}});
  std::vector<std::int32_t> done;
  std::vector<int> rows;
  for (int m = 0; m <= 85; m += 5) {
    const CamStep& step = bench.to(m);
    if (m % 10 == 5) rows.push_back(step.row);
    for (int i = 0; i < step.read_out_count; ++i) {
      EXPECT_EQ(step.read_outs[static_cast<std::size_t>(i)].row, 2);
      done.push_back(step.read_outs[static_cast<std::size_t>(i)].codeQma);
    }
  }
  EXPECT_EQ(rows, (std::vector{1, 1, 1, 3, 1, 1, 1, 3, 1}));
  EXPECT_EQ(done, (std::vector<std::int32_t>{1, 2, 0, 1, 2, 0}));
  EXPECT_EQ(bench.cam.row(2).codeQma, 0);
}

TEST(CamCodes, StartClearsTheJumpCounters) {
  CamBench bench = started({{154, 10, 10}, {190, 1, 2, 2}, {154, 10, 10}, end_row});
  EXPECT_EQ(bench.cam.row(2).codeQma, 0);
  EXPECT_EQ(bench.run(15).row, 1);
}

TEST(CamCodes, ArcsReadOutTheExecutedMasterSpace) {
  CamBench bench = started({{171, 100, 100, 0, 100}, {133, 100, 0}, end_row});
  bench.run(42, 6);
  EXPECT_EQ(bench.cam.row(1).codeQma, 42);
  ASSERT_EQ(bench.cam.step().read_out_count, 1);
  EXPECT_EQ(bench.cam.step().read_outs[0].row, 1);
  EXPECT_EQ(bench.cam.step().read_outs[0].codeQma, 42);
  EXPECT_EQ(bench.run(160, 6).row, 2);
  EXPECT_EQ(bench.cam.row(1).codeQma, 157);
}

TEST(CamCodes, TableIsAscendingAndFindable) {
  int previous = 0;
  for (const Code& code : codes) {
    EXPECT_GT(code.code, previous);
    previous = code.code;
    EXPECT_EQ(find_code(code.code), &code);
    EXPECT_FALSE(code.mnemonic.empty());
    EXPECT_FALSE(code.meaning.empty());
  }
  for (const int none : {0, 129, 147, 155, 176, 236, 251, 255, -124}) EXPECT_EQ(find_code(none), nullptr);
}

TEST(CamCodes, EveryCodeHasACase) {
  std::set<int> covered{130, 136, 137, 138, 139, 140, 141, 142, 143, 144, 145, 146, 160, 180, 190};
  for (const MovementCase& item : movement_cases()) covered.insert(item.row.codeG);
  std::set<int> all;
  for (const Code& code : codes) all.insert(code.code);
  EXPECT_EQ(covered, all);
}

}  // namespace
}  // namespace drycut::devices::camming4
