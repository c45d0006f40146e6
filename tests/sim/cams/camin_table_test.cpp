// What drycut cam reads as a cam of MC_CamIn, and what it tells of a file that is wrong.
#include <gmock/gmock.h>

#include "sim/cams/study.hpp"
#include "tests/sim/cams/camin_bench.hpp"

namespace drycut::sim::cams {
namespace {

using devices::plcopen::Endless;
using devices::plcopen::Interpolation;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string tab =
    "# a knife: of 600 mm\n# endless: negative\n# master_modulo: 8000000 \nTablename = K\nTabletype = "
    "7\nTable-ID = "
    "3 # maxacc: 50\nFunctiontype = 5\nLines = 2\nBegintable\n0 0\n1200000 720000\nEndTable\n";

TEST(CamInTable, ATabFileTellsItsAxesInComments) {
  const auto cam = camin::table(tab);
  EXPECT_EQ(cam.table.id, 3);
  EXPECT_EQ(cam.interpolation, Interpolation::poly5_line);
  EXPECT_EQ(cam.endless, Endless::negative);
  EXPECT_EQ(cam.master_modulo, 8'000'000);
  EXPECT_EQ(cam.table.limits.acceleration, 50);
  EXPECT_THAT(cam.table.places, ElementsAre(10, 11));
  EXPECT_TRUE(cam.periodic);
}

TEST(CamInTable, SettingsHaveTheirDefaults) {
  const auto cam = camin::table("slave\n1\n2\n");
  EXPECT_EQ(cam.interpolation, Interpolation::linear);
  EXPECT_EQ(cam.endless, Endless::no);
  EXPECT_EQ(cam.master_modulo, 3'600'000);
  EXPECT_EQ(cam.slave_modulo, 3'600'000);
  EXPECT_EQ(cam.master_unit, "deg");
  EXPECT_EQ(cam.slave_unit, "deg");
  EXPECT_FALSE(cam.table.limits.velocity || cam.table.limits.acceleration || cam.table.limits.jerk ||
               cam.table.limits.least || cam.table.limits.most);
  EXPECT_EQ(camin::table("# slave_modulo: 0\nslave\n1\n").slave_unit, "mm");
  EXPECT_EQ(camin::table("# slave_modulo: 0\n# slave_unit: deg\nslave\n1\n").slave_unit, "deg");
}

TEST(CamInTable, EverySettingIsTaken) {
  const auto cam = camin::table(
      "## note: free\n# interpolation: polynom_3\n# endless: positive\n# master_modulo: 10000\n# "
      "slave_modulo: "
      "20000\n# periodic: no\n# master_unit: mm\n# slave_unit: mm\n# maxvel: 1.5\n# maxacc: 2.5\n# maxjerk: "
      "3.5\n# minpos: -4\n# maxpos: 5\nslave\n1\n2\n");
  EXPECT_EQ(cam.interpolation, Interpolation::polynom_3);
  EXPECT_EQ(cam.slave_modulo, 20'000);
  EXPECT_FALSE(cam.periodic);
  EXPECT_EQ(cam.master_unit + cam.slave_unit, "mmmm");
  EXPECT_EQ(cam.table.limits.velocity, 1.5);
  EXPECT_EQ(cam.table.limits.acceleration, 2.5);
  EXPECT_EQ(cam.table.limits.jerk, 3.5);
  EXPECT_EQ(cam.table.limits.least, -4);
  EXPECT_EQ(cam.table.limits.most, 5);
}

TEST(CamInTable, AllThatIsWrongWithACsvIsToldAtOnce) {
  EXPECT_THAT(
      camin::faults(
          "# endles: positive\n# periodic: maybe\n# master_unit: inch\n# maxvel: -1\n# maxjerk: x\n# "
          "master_modulo: 0\n# slave_modulo: 1.5\n# interpolation: SPLINE\n# minpos: 1\n# minpos: "
          "2\nmaster,slave\n0,1,2\n5,abc\n1.5,0\n3e9,0\n"),
      ElementsAre(
          "1:3: unknown key 'endles'; did you mean endless?; a remark begins with ## [cam.unknown-key]",
          "2:13: periodic cannot be 'maybe'; write yes or no [cam.value]",
          "3:16: master_unit cannot be 'inch'; write deg or mm [cam.value]",
          "4:11: '-1' is out of range; write a number, 1e-09 to 1000000000000 [cam.value]",
          "5:12: 'x' is out of range; write a number, 1e-09 to 1000000000000 [cam.value]",
          "6:18: '0' is out of range; write a whole number, 1 to 2147483647 [cam.value]",
          "7:17: '1.5' is out of range; write a whole number, 0 to 2147483647 [cam.value]",
          "8:18: 'SPLINE' is no interpolation (error 42006); write STEP_DIRECT, LINEAR, POLYNOM_3, "
          "POLYNOM_3_KOEFF, LINE_POLY5 or POLY5_LINE [cam.interpolation]",
          "10:3: a second minpos; the first is in line 9 [cam.twice]",
          "12:1: 3 numbers; a line of type 7 (master and slave positions, SGN32) has 2 [cam.value]",
          "13:3: 'abc' is no number; write digits [cam.value]",
          "14:1: 1.5 does not fit master and slave positions, SGN32; write a whole number, -2147483648 to "
          "2147483647 [cam.value]",
          "15:1: 3e9 does not fit master and slave positions, SGN32; write a whole number, -2147483648 to "
          "2147483647 [cam.value]"));
}

TEST(CamInTable, AllThatIsWrongWithATabFileIsToldAtOnce) {
  EXPECT_THAT(
      camin::faults("# endless: up\n# Date: today\nTablename = K\nTabletyp = 7\nTable-ID = 0\nLines = "
                    "2\nBegintable\n0 0\nEndTable\nmore\n"),
      ElementsAre("4:1: unknown key 'Tabletyp'; did you mean Tabletype? [cam.unknown-key]",
                  "5:12: '0' is out of range; write a whole number, 1 to 65535 [cam.value]",
                  "7:1: tabletype is missing above; write it [cam.missing]",
                  "10:1: text after EndTable; take it away [cam.table-form]",
                  "6:1: Lines = 2, but there are 1; write 1 [cam.table-form]",
                  "1:12: endless cannot be 'up'; write positive, negative or no [cam.value]"));
}

TEST(CamInTable, ATabFilesOtherCommentsAreRemarks) {
  EXPECT_THAT(camin::faults("# Name: whatever\n# id: none\n# Author: none\n" + tab), IsEmpty());
}

TEST(CamInTable, TheKindIsKnownByTheText) {
  EXPECT_EQ(cam_kind("", "slave\n1\n").name, "mc_camin");
  EXPECT_EQ(cam_kind("", "# interpolation: POLYNOM_3_KOEFF\r\na0,a1,a2,a3\r\n").name, "mc_camin");
  EXPECT_EQ(cam_kind("", camin::knife()).name, "mc_camin");
  EXPECT_EQ(cam_kind("", tab).name, "mc_camin");
  EXPECT_EQ(cam_kind("", "master,slave\n0,0\n1,1\n").name, "lx3vp");
  EXPECT_EQ(cam_kind("mc_camin", "master,slave\n0,0\n1,1\n").name, "mc_camin");
}

TEST(CamInTable, WhatMcCamInRefusesHasItsErrorAndItsRow) {
  const auto rows = [](const std::string& text) {
    return "# interpolation: POLY5_LINE\nmaster,slave\n" + text;
  };
  EXPECT_THAT(
      camin::findings(rows("0,0\n500,0\n9000,0\n9000,0\n")),
      ElementsAre("row 2 (line 4): error 60260: masters must ascend by 0.1 deg (1000) at least, over the "
                  "wrap too; let the masters ascend inside one turn [cam.device]",
                  HasSubstr("row 4 (line 6): error 60260: ")));
  EXPECT_THAT(camin::findings(rows("500,0\n3600000,0\n")),
              ElementsAre(HasSubstr("row 2 (line 4): error 60260")));
  EXPECT_THAT(camin::findings(rows("3600000,0\n3700000,0\n")),
              ElementsAre(HasSubstr("row 1 (line 3): error 60260")));
  EXPECT_THAT(camin::findings(rows("-1,0\n5000,0\n")), ElementsAre(HasSubstr("row 1 (line 3): error 60260")));
  EXPECT_THAT(camin::findings(rows("0,0\n200,0\n5000,0\n")),
              ElementsAre(HasSubstr("row 2 (line 4): error 60260"),
                          "error 60261: LINE/POLY5 needs an even number of lines, 2..360; add or take away a "
                          "line [cam.device]"));
  EXPECT_THAT(camin::findings("# interpolation: LINEAR\n# slave_modulo: 0\nmaster,slave\n0,0\n5,0\n"),
              ElementsAre(HasSubstr("error 60181: this cam needs modulo axes"), HasSubstr("error 60172: ")));
  EXPECT_THAT(camin::findings("# interpolation: POLY5_LINE\nslave\n0\n"),
              ElementsAre(HasSubstr("error 60172")));
  EXPECT_THAT(camin::findings("slave\n"), ElementsAre(HasSubstr("error 42007")));
  EXPECT_THAT(camin::findings("slave\n1e13\n"), ElementsAre(HasSubstr("error 44003")));
  const std::string without = "Tabletype = 2\nTable-ID = 1\nLines = 1\nBegintable\n5\nEndTable\n";
  EXPECT_THAT(
      camin::findings(without),
      ElementsAre(
          "error 42006: the interpolation is not one of 0..6, or the table names none; write "
          "Functiontype = 0..5, or # interpolation: LINEAR for the block's TableFctType [cam.device]"));
  EXPECT_THAT(camin::findings("# interpolation: LINEAR\n" + without), IsEmpty());
}

}  // namespace
}  // namespace drycut::sim::cams
