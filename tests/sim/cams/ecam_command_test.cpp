// drycut cam and drycut check with cams of LX3VP.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "devices/plcopen/cam_table.hpp"
#include "tests/sim/cams/command_bench.hpp"
#include "tests/sim/cams/ecam_bench.hpp"

namespace drycut::sim::cams {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

using EcamCommand = CamCommandTest;

TEST_F(EcamCommand, TheShippedCamsAreSound) {
  for (const auto* name : {"ecam_rotary_saw.csv", "ecam_fly_saw.csv", "ecam_s_curve.csv"}) {
    auto made = options(shipped_cams / name);
    made.strict = true;
    EXPECT_EQ(run(made), cli::all_passed) << out << err;
    EXPECT_THAT(out, HasSubstr("LX3VP, 200 rows made by ECAMTBX"));
  }
}

TEST_F(EcamCommand, TheRowsCanBeWrittenAndReadBack) {
  auto made = options_of(ecams::rotary());
  made.rows = folder / "rows.csv";
  EXPECT_EQ(run(made), cli::all_passed) << err;
  const auto text = content(made.rows);
  EXPECT_THAT(text, HasSubstr("master,slave\n0,0\n200,333\n"));
  EXPECT_TRUE(text.ends_with("\n3183,1000\n"));
  EXPECT_EQ(run(options(made.rows)), cli::all_passed) << out << err;
  EXPECT_THAT(out, HasSubstr("rows.csv: LX3VP, 200 rows, cyclic\n"));
  EXPECT_THAT(out, HasSubstr("  ... and 139 more\n"));
}

TEST_F(EcamCommand, SamplesInTheColumnsOfEveryCam) {
  auto made = options_of("master,slave\n0,0\n100,50\n200,50\n");
  made.csv = "-";
  made.at = {50, 150};
  made.duty.master_speed = 1000;
  EXPECT_EQ(run(made), cli::all_passed);
  EXPECT_EQ(out,
            "master,slave,velocity,acceleration,jerk,sector,time,velocity_t,acceleration_t,jerk_t\n"
            "50,25,0.5,0,0,1,0.05,500,0,0\n150,50,0,0,0,2,0.15,0,0,0\n");
}

TEST_F(EcamCommand, ARefusedTableIsUnsoundAndDrawsNothing) {
  auto made = options_of(ecams::rotary("1"));
  made.png = folder / "cam.png";
  made.rows = folder / "rows.csv";
  EXPECT_EQ(run(made), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("nothing to run\n\nerror -4: ECAMTBX makes no table: "));
  EXPECT_FALSE(fs::exists(made.png));
  EXPECT_FALSE(fs::exists(made.rows));
}

TEST_F(EcamCommand, BadOptions) {
  auto given = options_of("master,slave\n10,0\n110,50\n");
  given.rows = folder / "rows.csv";
  EXPECT_EQ(run(given), cli::bad_input);
  EXPECT_EQ(err,
            "--table:1:1: the table's rows were given, not made; leave it out [option.does-not-apply]\n");
  given.rows = given.table.string();
  EXPECT_EQ(run(given), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("cam.csv is the table itself; name another file [option.file-name]\n"));
  given.rows.clear();
  given.at = {5, 111};
  EXPECT_EQ(run(given), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("--at:1:1: the cam has no master position 5; give positions from 10 to 110 "
                             "pulses [cam.out-of-range]\n"));
  auto timed = options_of(ecams::s_curve());
  timed.duty.max_velocity = 60000;  // its speed is known
  EXPECT_EQ(run(timed), cli::all_passed) << err;
  timed.duty.master_speed = 5;
  EXPECT_EQ(run(timed), cli::bad_input);
  EXPECT_EQ(err,
            "--master-speed:1:1: the master is time and has its own speed; leave it out, or give another # "
            "time_axis [option.does-not-apply]\n");
  auto wrong = options_of(ecams::rotary());
  wrong.device = "camming4";
  EXPECT_EQ(run(wrong), cli::bad_input);
  EXPECT_THAT(err,
              HasSubstr("cam.csv:1:1: this is a cam of lx3vp, not of camming4; leave --device out, or write "
                        "--device lx3vp [file.other-kind]\n"));
}

TEST_F(EcamCommand, AStrokeThatDoesNotFitTheTravelFails) {
  const std::string saw = "parameter,value\nP1,6600\nP2,12900\nP3,9400\nP4,2.5\nP5,2.5\nP6,1\nP7,400\n";
  EXPECT_EQ(run(options_of("# ecamtbx: K101\n# max_position: 12900\n" + saw)), cli::all_passed);
  EXPECT_EQ(run(options_of("# ecamtbx: K101\n# max_position: 12899\n" + saw)), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("limit: the stroke does not fit the travel: slave at 12900 pulses"));
}

TEST_F(EcamCommand, CheckReadsCamsRegistersAndInstructionLists) {
  const auto faults = [&](const std::string& name, const std::string& text) {
    const int status = check(file(text, name));
    EXPECT_EQ(status, err.empty() ? cli::all_passed : cli::bad_input);
    return err;
  };
  EXPECT_THAT(faults("a.csv", "master,slave\n0,0\n5,x\n"),
              HasSubstr("a.csv:3:3: slave 'x' is not a whole number"));
  EXPECT_THAT(faults("b.csv", "address,value\nD10,5\n"), IsEmpty());
  EXPECT_THAT(faults("b.csv", "D10,5\nQ10,5\n"), HasSubstr("b.csv:2:1: "));
  EXPECT_THAT(faults("b.csv", "; presets of the saw\nD10,5\n"), IsEmpty());
  EXPECT_THAT(faults("b.csv", "Q10,5\nM0,1\n"), HasSubstr("b.csv:1:1: 'Q10' is no register; write D10, "));
  EXPECT_THAT(faults("c.il", "LD X0\nOUT Y0\nEND\n"), IsEmpty());
  EXPECT_THAT(faults("c.il", "LD X8\nOUT Y0\nEND\n"), HasSubstr("c.il:1:4: 'X8' is not octal"));
}

}  // namespace
}  // namespace drycut::sim::cams
