#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/sim/cams/bench.hpp"
#include "tests/sim/cams/command_bench.hpp"

namespace drycut::sim::cams {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

using CamCommand = CamCommandTest;

TEST_F(CamCommand, TheShippedCamsAreSound) {
  for (const auto* name : {"introduction.csv", "wire_guide.csv", "fly_cut.csv", "rotary_knife.csv"}) {
    auto made = options(shipped_cams / name);
    EXPECT_EQ(run(made), cli::all_passed) << out << err;
    made.duty.master_speed = name == std::string("introduction.csv") ? 1000 : 36000;
    EXPECT_EQ(run(made), cli::all_passed) << out << err;
    EXPECT_THAT(out, Not(HasSubstr("warning")));
  }
}

TEST_F(CamCommand, PrintsTheSectorsAndTheTotals) {
  EXPECT_EQ(run(options(shipped_cams / "introduction.csv")), cli::all_passed);
  EXPECT_THAT(out,
              HasSubstr("\n    3  134 RCC     160    120      1     1       1    0.00625  makes up a space"));
  EXPECT_THAT(out, HasSubstr("\n    6  136 END "));
  EXPECT_THAT(out, HasSubstr("\nno finding\nmaster total 700 Um, slave total 565 Um\n"));
  EXPECT_THAT(err, IsEmpty());
}

TEST_F(CamCommand, WithTheMastersSpeedAlsoInTime) {
  auto made = options_of("# decpt: 1\n# unitvel: 0\n" + cams::header + "1,132,100,50\n2,135,100,50\n3,136\n");
  made.duty.master_speed = 60;  // 10 Um/s
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_THAT(
      out,
      HasSubstr("master at 60 unit/min = 10 Um/s, sampled every 2 ms\nspeeds in units of 10 Um (decpt 1)"));
  EXPECT_THAT(
      out, HasSubstr("    1  132 AZM     100     50      0     1       1    0.01    10        60       1  "));
  EXPECT_THAT(out, HasSubstr("slave total 100 Um, 20 s\n"));
}

TEST_F(CamCommand, LoopsAreCountedInTheTable) {
  auto made = options(shipped_cams / "rotary_knife.csv");
  made.loops = 3;
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("master total 28200 Um, slave total 20700 Um in 3 passes\n"));
  EXPECT_THAT(out, testing::ContainsRegex("\n +4  234 RCCE .* 3  makes up"));
}

TEST_F(CamCommand, ExitStatusTellsErrorsLimitsAndStrictness) {
  EXPECT_EQ(run(options_of(cams::header + "1,133,100,0\n")), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("sector 2: error 3: "));
  auto warned = options_of(cams::header + "1,131,100,50\n2,135,100,20\n3,136\n");
  EXPECT_EQ(run(warned), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("sector 2 (135 DZC): warning 7: "));
  warned.strict = true;
  EXPECT_EQ(run(warned), cli::check_failed);
  warned.strict = false;
  warned.duty = {.master_speed = 100.0, .max_velocity = 99.0};
  EXPECT_EQ(run(warned), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("sector 1 (131 AZL): limit: velocity 100 Um/s above 99; "));
}

TEST_F(CamCommand, BadInputWritesNothing) {
  auto made = options_of(cams::header + "1,999\n1,xx\n");
  made.csv = (folder / "out.csv").string();
  made.png = (folder / "out.png").string();
  EXPECT_EQ(run(made), cli::bad_input);
  EXPECT_THAT(out, IsEmpty());
  EXPECT_THAT(err, HasSubstr("cam.csv:2:3: there is no codeG 999; "));
  EXPECT_THAT(err, HasSubstr("cam.csv:3:3: codeG 'xx' is not a whole number; "));
  EXPECT_FALSE(fs::exists(made.csv));
  EXPECT_FALSE(fs::exists(made.png));
}

TEST_F(CamCommand, FaultsOfTheOptions) {
  auto made = options(shipped_cams / "introduction.csv");
  const auto refused = [&](const cli::CamOptions& wrong, const std::string& words) {
    EXPECT_EQ(run(wrong), cli::bad_input);
    EXPECT_THAT(err, HasSubstr(words));
    EXPECT_THAT(out, IsEmpty());
  };
  auto wrong = made;
  for (const double speed :
       {0.0, -1.0, 1e10, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    wrong.duty = {.master_speed = speed};
    refused(wrong, "--master-speed:1:1: ");
    wrong.duty = {.master_speed = 1.0, .max_velocity = speed};
    refused(wrong, "--max-velocity:1:1: ");
    wrong.duty = {.master_speed = 1.0, .max_velocity = 1.0, .max_acceleration = speed};
    refused(wrong, "--max-acceleration:1:1: ");
  }
  wrong = made;
  wrong.duty.max_velocity = 10;
  refused(wrong,
          "--max-velocity:1:1: a limit in time means nothing without the master's speed; give --master-speed "
          "too [option.does-not-apply]");
  wrong = made;
  for (const double at : {-1.0, 700.5, std::numeric_limits<double>::quiet_NaN()}) {
    wrong.at = {5, at};
    refused(wrong, "--at:1:1: the cam has no master position ");
  }
  EXPECT_THAT(err, HasSubstr("give positions from 0 to 700 Um"));
  wrong = made;
  wrong.csv = made.table.string();
  refused(wrong, " is the table itself; name another file");
  wrong.csv = folder.string();
  refused(wrong, " is a directory; name a file");
  wrong.csv = (folder / "none/out.csv").string();
  refused(wrong, "--csv:1:1: there is no directory ");
  wrong = made;
  wrong.png = (folder / "out.jpg").string();
  refused(wrong, "out.jpg does not end in .png; name it x.png");
  wrong.png = wrong.csv = (folder / "out.png").string();
  refused(wrong, "--png:1:1: it is the file of --csv; name another file [option.file-name]");
  wrong = made;
  wrong.table = folder / "none.csv";
  refused(wrong, "none.csv:1:1: there is no file ");
}

TEST_F(CamCommand, CsvGoesToAFileOrAloneToStandardOutput) {
  auto made = options(shipped_cams / "fly_cut.csv");
  made.duty.master_speed = 36000;
  made.csv = "-";
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_THAT(out, StartsWith("master,slave,velocity,acceleration,jerk,sector,time,velocity_t,"));
  EXPECT_THAT(err, HasSubstr("master total 11800 Um"));
  const auto printed = out;
  made.csv = (folder / "out.csv").string();
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("master total 11800 Um"));
  EXPECT_EQ(content(made.csv), printed);
  EXPECT_FALSE(fs::exists(made.csv + ".part"));
}

TEST_F(CamCommand, AtPrintsOrWritesJustThesePositions) {
  auto made = options(shipped_cams / "introduction.csv");
  made.at = {655, 340};
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("master   slave  velocity    acceleration  jerk  sector\n     340     285 "));
  made.csv = "-";
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_EQ(out,
            "master,slave,velocity,acceleration,jerk,sector\n340,285,0.75,-0.00625,0,3\n"
            "655,553.75,0.5,-0.011111111111111112,0,5\n");
}

TEST_F(CamCommand, DrawsTheSamePictureTwice) {
  auto made = options(shipped_cams / "fly_cut.csv");
  made.duty = {.master_speed = 36000.0, .max_velocity = 80000.0, .max_acceleration = 60000.0};
  made.png = (folder / "one.png").string();
  EXPECT_EQ(run(made), cli::all_passed) << out;
  const auto first = content(made.png);
  EXPECT_THAT(first, StartsWith("\x89PNG"));
  made.png = (folder / "two.png").string();
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_EQ(first, content(made.png));
}

TEST_F(CamCommand, ThePlotHasFourPanelsMarksAndLimits) {
  const auto table = cams::table("# maxvel: 1000\n# taccmax: 50\n# tdecmax: 50\n" + cams::header +
                                 "1,132,100,50\n2,133,200,200\n3,130\n4,135,90,45\n5,136\n");
  const CamDuty duty{.master_speed = 300.0, .max_velocity = 400.0, .max_acceleration = 1e6};
  const auto plot = cams::study(table, {duty}).plot;
  ASSERT_EQ(plot.panels.size(), 4U);
  EXPECT_EQ(plot.panels[1].y_label, "[Um/s]");
  EXPECT_EQ(plot.panels[2].y_label, "[Um/s²]");
  ASSERT_EQ(plot.panels[1].bands.size(), 2U);  // no negative velocity: no negative limit
  EXPECT_EQ(plot.panels[1].bands[0].label, "max velocity 400 Um/s");
  EXPECT_EQ(plot.panels[1].bands[1].label, "maxvel 1000 Um/s");
  EXPECT_THAT(plot.panels[2].title, HasSubstr("far below max acceleration 1e+06 Um/s²"));
  ASSERT_EQ(plot.panels[2].bands.size(), 2U);
  EXPECT_EQ(plot.panels[2].bands[0].label, "taccmax, tdecmax 2000 Um/s²");
  EXPECT_EQ(plot.panels[2].bands[0].high, 2000);
  EXPECT_EQ(plot.panels[2].bands[1].low, -2000);
  ASSERT_EQ(plot.marks.size(), 3U);
  EXPECT_EQ(plot.marks[2].label, "4 DZC deceleration");
  EXPECT_EQ(plot.marks[2].x, 300);
  const auto& acceleration = plot.panels[2].curves.front().y;
  EXPECT_NEAR(*std::max_element(acceleration.begin(), acceleration.end()), 300.0 * 300 / 100, 1e-9);
}

TEST_F(CamCommand, CheckParsesATableToo) {
  EXPECT_EQ(check(shipped_cams / "introduction.csv"), cli::all_passed);
  EXPECT_EQ(check(file(cams::header + "1,999\n")), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("cam.csv:2:3: there is no codeG 999; "));
}

TEST_F(CamCommand, ALargeTableEndsSoon) {
  std::string text = "# measurem: 999999\n# pulsem: 1\n# measure: 1\n# pulse: 999999\n" + cams::header;
  for (int row = 1; row <= 126; ++row)
    text += std::to_string(row) + (row % 2 == 0 ? ",233,999999,999999\n" : ",234,999999,-999999\n");
  text += "127,190,1,999999\n128,138\n";
  auto made = options_of(text);
  made.loops = 100;
  EXPECT_THAT(run(made), testing::AnyOf(cli::all_passed, cli::check_failed));
  EXPECT_THAT(out, HasSubstr("the cam was left after 20000 sectors"));
}

}  // namespace
}  // namespace drycut::sim::cams
