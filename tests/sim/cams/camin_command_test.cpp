// drycut cam and drycut check with cams of MC_CamIn.
#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>

#include "tests/sim/cams/camin_bench.hpp"
#include "tests/sim/cams/command_bench.hpp"

namespace drycut::sim::cams {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

struct CamInCommand : CamCommandTest {
  /// The samples at these master positions, line by line, without the header.
  std::vector<std::vector<double>> samples(cli::CamOptions made, std::vector<double> at) {
    made.csv = "-";
    made.at = std::move(at);
    EXPECT_NE(run(made), cli::bad_input) << err;
    std::istringstream lines(out);
    std::string line;
    std::getline(lines, line);
    std::vector<std::vector<double>> rows;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::vector<double> row;
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
      rows.push_back(row);
    }
    return rows;
  }
};

TEST_F(CamInCommand, TheShippedCamsAreSoundAtTheirSpeed) {
  struct Shipped {
    const char* name;
    double speed;
    const char* says;
  };
  for (const Shipped& cam :
       {Shipped{"mc_rotary_knife.tab", 1000, "2 rows, POLY5_LINE, endless positive, periodic"},
        Shipped{"mc_to_and_fro.csv", 360, "24 rows, POLYNOM_3, periodic"},
        Shipped{"mc_eject.csv", 360, "4 rows, POLYNOM_3_KOEFF, one pass"},
        Shipped{"mc_traverse.csv", 500, "36 rows, POLYNOM_3_KOEFF, periodic"},
        Shipped{"mc_flying_saw.csv", 667, "66 rows, POLYNOM_3_KOEFF, one pass"},
        Shipped{"mc_flying_saw_2m.csv", 667, "200 rows, POLYNOM_3_KOEFF, one pass"}}) {
    auto made = options(shipped_cams / cam.name);
    made.strict = true;
    EXPECT_EQ(run(made), cli::all_passed) << out << err;
    made.duty.master_speed = cam.speed;
    EXPECT_EQ(run(made), cli::all_passed) << out << err;
    EXPECT_THAT(out, HasSubstr(cam.says));
  }
}

TEST_F(CamInCommand, TheSawsZoneIsALineWhateverThePiece) {
  for (const char* name : {"mc_flying_saw.csv", "mc_flying_saw_2m.csv"}) {
    const auto made = options(shipped_cams / name);
    const auto rows = samples(made, {0, 8e5, 1'234'567, 1'999'999, 2.699e6, 4.5e6, 6'599'999});
    ASSERT_EQ(rows.size(), 7U);
    for (std::size_t i = 1; i < 5; ++i) {
      EXPECT_NEAR(rows[i][1], rows[i][0] - 4e5, 1e-4) << name << " runs 40 mm behind the tube";
      EXPECT_NEAR(rows[i][2], 1, 1e-9);
    }
    EXPECT_NEAR(rows[0][1], 0, 1e-9);
    EXPECT_NEAR(rows[5][2], -1.28, 1e-9) << "on the way home";
    EXPECT_NEAR(rows[6][1], 0, 1e-3) << "at home again after 660 mm";
    EXPECT_NEAR(rows[6][2], 0, 1e-6);
  }
}

TEST_F(CamInCommand, TheKnifesSamplesAreTheClosedForm) {
  auto made = options(shipped_cams / "mc_rotary_knife.tab");
  made.duty.master_speed = 1000;
  made.loops = 2;
  const double h = 6.8e6;
  const double d = 2.88e6 - 0.6 * h;
  const double u = 0.25;
  const double x = 1.2e6 + u * h;
  const auto rows = samples(made, {0, x, 8e6 + x});
  ASSERT_EQ(rows.size(), 3u);
  const double v = 1e7;  // 1000 mm/s
  const double y = 720'000 + 0.6 * h * u + d * u * u * u * (10 - 15 * u + 6 * u * u);
  const double dy = 0.6 + d / h * u * u * (30 - 60 * u + 30 * u * u);
  const double ddy = d / h / h * u * (60 - 180 * u + 120 * u * u);
  const double dddy = d / h / h / h * (60 - 360 * u + 360 * u * u);
  for (std::size_t i : {1u, 2u}) {
    const double turn = i == 2 ? 1 : 0;
    const std::vector<double> expected{
        turn * 8e6 + x, turn * 3.6e6 + y, dy, ddy, dddy, 2, rows[i][0] / v, dy * v,
        ddy * v * v,    dddy * v * v * v};
    ASSERT_EQ(rows[i].size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(rows[i][k], expected[k], 1e-11 * std::abs(expected[k])) << i << " " << k;
  }
}

TEST_F(CamInCommand, TheReportNamesPiecesAndKnots) {
  auto made = options(shipped_cams / "mc_rotary_knife.tab");
  made.duty.master_speed = 1000;
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_THAT(out,
              HasSubstr("master turn 8000000 (800 mm), slave turn 3600000 (360 deg); master at 1000 mm/s\n"));
  EXPECT_THAT(out, testing::ContainsRegex("1 +0 +0  line +600 +600 +600 +0 +0\n"));
  EXPECT_THAT(out, testing::ContainsRegex("2 +1200000 +720000  quintic +600 +600 +600 "));
  EXPECT_THAT(out, testing::ContainsRegex("1 +0 +C2 +0 +0 +0 +[0-9.-]+ +the table closes\n"));
  EXPECT_THAT(out,
              HasSubstr("master total 8000000 0.1 um, slave total 3600000 0.0001 deg (1 turn for each of the "
                        "master), 0.8 s\n"));
}

TEST_F(CamInCommand, AMastersTurnThatTheFileDoesNotGiveIsSaidToBeAssumed) {
  EXPECT_EQ(run(options_of("slave\n0\n1000\n")), cli::all_passed);
  EXPECT_THAT(
      out, HasSubstr("master turn 3600000 (360 deg) assumed, for there is no # master_modulo, slave turn"));
  out.clear();
  EXPECT_EQ(run(options_of("# master_modulo: 3600000\nslave\n0\n1000\n")), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("master turn 3600000 (360 deg), slave turn"));
}

TEST_F(CamInCommand, WhatRoundingLeavesIsNoJump) {
  EXPECT_EQ(run(options_of("a0,a1,a2,a3\n0,0,0,0\n0.005,0,0,0\n")), cli::all_passed);
  EXPECT_THAT(out, testing::ContainsRegex("2 +1800000 +C3 +0 +0 +0 +0\n"));
  EXPECT_EQ(run(options_of("a0,a1,a2,a3\n0,0,0,0\n0.5,0,0,0\n")), cli::all_passed);
  EXPECT_THAT(out, testing::ContainsRegex("2 +1800000 +jumps +0.5 +0 +0 +0\n"));
}

TEST_F(CamInCommand, ARefusedTableIsUnsoundAndDrawsNothing) {
  auto made = options_of("# interpolation: POLY5_LINE\nmaster,slave\n0,0\n500,0\n");
  made.png = folder / "cam.png";
  EXPECT_EQ(run(made), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("nothing to run\n\nrow 2 (line 4): error 60260: masters must ascend"));
  EXPECT_FALSE(fs::exists(made.png));
}

TEST_F(CamInCommand, ALimitFailsWhatIsOnlyACautionFailsWithStrict) {
  auto made = options_of("slave\n0\n900000\n");
  EXPECT_EQ(run(made), cli::all_passed);
  made.strict = true;
  EXPECT_EQ(run(made), cli::check_failed);
  auto fast = options_of(camin::knife());
  fast.duty = {.master_speed = 1000, .max_velocity = 599, .max_acceleration = {}};
  EXPECT_EQ(run(fast), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("limit: velocity 600 deg/s above 599"));
}

TEST_F(CamInCommand, BadInputIsToldAndNothingIsWritten) {
  auto made = options_of("# endless: up\nslave\nx\n");
  made.csv = folder / "samples.csv";
  EXPECT_EQ(run(made), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("cam.csv:1:12: endless cannot be 'up'"));
  EXPECT_THAT(err, HasSubstr("cam.csv:3:1: 'x' is no number"));
  EXPECT_FALSE(fs::exists(made.csv));
  auto far = options_of(camin::knife());
  far.at = {8'000'001};
  EXPECT_EQ(run(far), cli::bad_input);
  EXPECT_EQ(err,
            "--at:1:1: the cam has no master position 8000001; give positions from 0 to 8000000 0.1 um "
            "[cam.out-of-range]\n");
  far.loops = 2;
  EXPECT_EQ(run(far), cli::all_passed) << err;
}

TEST_F(CamInCommand, ThePictureIsDrawn) {
  auto made = options_of(camin::knife());
  made.png = folder / "knife.png";
  made.duty.master_speed = 1000;
  EXPECT_EQ(run(made), cli::all_passed) << err;
  EXPECT_GT(fs::file_size(made.png), 10'000u);
}

// A table with ${length} takes it from the scenario beside or above it that names it, or from the one that is
// named.
TEST_F(CamInCommand, ATableTakesTheValuesOfTheLineBesideIt) {
  const auto line = [&](const char* name, const char* length) {
    return test_folder.file(
        name, fmt::format("variables: {{length: {}}}\ncontroller: {{plcopen: {{program: a.st, tables: "
                          "[cams/knife.tab]}}}}\n",
                          length));
  };
  fs::create_directories(folder / "cams");
  test_folder.file(
      "other.yaml",
      "variables: {length: 3 m}\ncontroller: {plcopen: {program: a.st, tables: [cams/x.tab]}}\n");
  cli::CamOptions cam;
  cam.table =
      test_folder.file("cams/knife.tab", content(fs::path(DRYCUT_SOURCE_DIR) / "scenes/new/cams/knife.tab"));
  EXPECT_EQ(run(cam), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("has its value from a scenario; name it: drycut cam --scene"));
  const auto first = line("line.yaml", "900 mm");
  EXPECT_EQ(run(cam), cli::all_passed) << err;
  EXPECT_THAT(out,
              testing::AllOf(testing::StartsWith("with the values of " + first.lexically_normal().string()),
                             HasSubstr("turn 9000000 (900 mm)")));
  EXPECT_EQ(check(cam.table), cli::all_passed) << err;
  line("same.yaml", "0.9 m");  // says nothing else
  EXPECT_EQ(run(cam), cli::all_passed) << err;
  const auto third = line("third.yaml", "1 m");
  EXPECT_EQ(run(cam), cli::bad_input);
  EXPECT_THAT(err, testing::AllOf(HasSubstr("knife.tab:1:1: it has values from a scenario"),
                                  HasSubstr("third.yaml"), HasSubstr("name one: drycut cam --scene")));
  cam.scene = third;
  EXPECT_EQ(run(cam), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("turn 10000000 (1000 mm)"));
}

TEST_F(CamInCommand, CheckReadsTabFilesAndCsv) {
  EXPECT_EQ(check(file("Tabletype = 9\n", "a.tab")), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("a.tab:1:13: '9' is out of range; write a whole number, 1 to 7"));
  EXPECT_EQ(check(file(content(shipped_cams / "mc_rotary_knife.tab"), "b.tab")), cli::all_passed);
  EXPECT_EQ(check(file("# master_modulo: ${length}\n", "d.tab")), cli::bad_input);
  EXPECT_THAT(
      err, HasSubstr("'${length}' has its value from a scenario; name it: drycut cam --scene SCENARIO.yaml"));
  EXPECT_EQ(check(file("slave\n1,2\n", "c.csv")), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("c.csv:2:1: 2 numbers"));
}

}  // namespace
}  // namespace drycut::sim::cams
