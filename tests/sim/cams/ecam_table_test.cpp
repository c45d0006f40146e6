// Cam tables of LX3VP as text: rows, parameters of ECAMTBX, every fault by its message.
#include <gmock/gmock.h>

#include "devices/plcopen/tab_file.hpp"
#include "sim/cams/study.hpp"
#include "tests/sim/cams/ecam_bench.hpp"

namespace drycut::sim::cams {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EcamTable, ReadsRows) {
  const auto table = ecams::table(
      "# a remark\n# max_frequency: 100000\n# max_ratio: 5/2\n# cyclic: 0\nmaster,slave\n0,0\n\n100, -250\n");
  EXPECT_EQ(table.rows, (std::vector<devices::lx3vp::CamTableRow>{{0, 0}, {100, -250}}));
  EXPECT_THAT(table.lines, ElementsAre(6, 8));
  EXPECT_EQ(table.max_frequency, 100000);
  EXPECT_DOUBLE_EQ(*table.max_ratio, 2.5);
  EXPECT_FALSE(table.cyclic);
  EXPECT_FALSE(table.is_made());
}

TEST(EcamTable, MakesRowsFromParameters) {
  const auto table = ecams::table(ecams::rotary());
  EXPECT_EQ(table.rows.size(), 200U);
  EXPECT_EQ(table.rows.back(), (devices::lx3vp::CamTableRow{3183, 1000}));
  EXPECT_EQ(table.saw.acceleration, 1);
  EXPECT_EQ(table.saw.curve, 0);
  EXPECT_TRUE(table.cyclic);
  EXPECT_FLOAT_EQ(static_cast<float>(*table.max_ratio), 50.0F / 3);
  const auto s_curve = ecams::table(ecams::s_curve());
  EXPECT_EQ(s_curve.time_axis, 1);
  EXPECT_FALSE(s_curve.cyclic);
}

TEST(EcamTable, ThePatternOfP6) {
  for (const auto* P6 : {"H10050001", "K268763137", "268763137"}) {
    const auto table = ecams::table(ecams::rotary("50/3", P6));
    EXPECT_EQ(table.saw.acceleration, 1) << P6;
    EXPECT_EQ(table.saw.curve, 0x1005) << P6;
  }
  const auto words = ecams::table(
      "# ecamtbx: "
      "100\nparameter,value\nP1,3183\nP2,1000\nP3,333\nP4,1.6666667\nP5,20\nP6L,2\nP6H,H1003\nP7,50\n");
  EXPECT_EQ(words.saw.acceleration, 2);
  EXPECT_EQ(words.saw.curve, 0x1003);
  EXPECT_EQ(words.rows.size(), 50U);
}

TEST(EcamTable, ItsRowsReadBack) {
  for (const auto& text : {ecams::rotary(), ecams::s_curve(),
                           std::string("# max_frequency: 5\n# time_axis: 10\nmaster,slave\n5,0\n9,-4\n")}) {
    const auto table = ecams::table(text);
    const auto again = ecams::table(ecam_rows_csv(table));
    EXPECT_EQ(again.rows, table.rows);
    EXPECT_EQ(again.max_frequency, table.max_frequency);
    EXPECT_EQ(again.time_axis, table.time_axis);
    EXPECT_EQ(again.max_ratio, table.max_ratio);
    EXPECT_EQ(again.cyclic, table.cyclic);
  }
}

TEST(EcamTable, FaultsOfRows) {
  ecams::expect_faults(
      {{"",
        {"1:1: there is no table: the header is missing; give the line master,slave and a line for each row, "
         "or # ecamtbx: K100 and parameter,value [cam.missing]"}},
       {"master,slave\n", {"1:1: the table has no row; give a line for each row, such as 0,0 [cam.missing]"}},
       {"0,0\n1,1\n", {"1:1: the header is missing; begin with the line master,slave [cam.missing]"}},
       {"master,slvae\n0,0\n",
        {"1:8: there is no column 'slvae'; did you mean slave? [cam.unknown-key]",
         "1:1: the header has no column slave; the header is master,slave [cam.unknown-key]"}},
       {"master,slave\n0,0\n1.5,2\n3,x\n4,5,6\n9999999999,0\n5\n",
        {"3:1: master '1.5' is not a whole number; write a whole number from -2147483648 to 2147483647 "
         "[cam.value]",
         "4:3: slave 'x' is not a whole number; write a whole number from -2147483648 to 2147483647 "
         "[cam.value]",
         "5:5: '6' is in no column of the header; the header has 2 columns [cam.unknown-key]",
         "6:1: master '9999999999' is out of range; write a whole number from -2147483648 to 2147483647 "
         "[cam.out-of-range]",
         "7:1: slave has no value; write a whole number from -2147483648 to 2147483647 [cam.missing]"}}});
}

TEST(EcamTable, FaultsOfSettings) {
  ecams::expect_faults(
      {{"# max_frequency: 200001\n# time_axis: 0\n# cyclic: 2\n# max_ratio: 0\n# frequncy: "
        "5\nmaster,slave\n0,0\n",
        {"1:18: max_frequency '200001' is out of range; write a whole number from 1 to 200000 "
         "[cam.out-of-range]",
         "2:14: time_axis '0' is out of range; write a whole number from 1 to 2147483647 [cam.out-of-range]",
         "3:11: cyclic '2' is out of range; write a whole number from 0 to 1 [cam.out-of-range]",
         "4:14: max_ratio '0' is out of range; write a number or a fraction (5/3) from 1e-09 to 1e+09 "
         "[cam.out-of-range]",
         "5:3: there is no setting 'frequncy'; there are cyclic, ecamtbx, max_frequency, max_position, "
         "max_ratio, min_position, time_axis; a remark begins with ## [cam.unknown-key]"}},
       {"# max_ratio: 5/0\n# max_ratio: 3\nmaster,slave\n0,0\n# cyclic: 1\n",
        {"1:14: max_ratio '5/0' is not a number; write a number or a fraction (5/3) from 1e-09 to 1e+09 "
         "[cam.value]",
         "2:3: max_ratio is given twice; it was first given in line 1; keep one [cam.twice]",
         "5:3: cyclic stands below the header; give settings above the header [cam.table-form]"}}});
}

TEST(EcamTable, FaultsOfParameters) {
  ecams::expect_faults(
      {{"parameter,value\nP1,5\n",
        {"1:1: parameters of what?; say it above: # ecamtbx: K100 (K101, K0, K1) [cam.missing]"}},
       {"# ecamtbx: K102\nparameter,value\n",
        {"1:12: there is no ecamtbx 'K102'; write K0 or K1 S-curve, K100 rotary saw, K101 fly saw "
         "[cam.unknown-key]"}},
       {"# ecamtbx: K0\n",
        {"1:1: there are no parameters: the header is missing; give the line parameter,value and a line for "
         "each, such as P1,3183 [cam.unknown-key]"}},
       {"# ecamtbx: K0\nparameter,value\nP1,100\nP2,abc\nP3,1\nP1,5\nP4,40000\nP6,100\n",
        {"4:4: P2 'abc' is not a whole number; write a whole number from -2147483648 to 2147483647 "
         "[cam.value]",
         "5:1: there is no parameter 'P3'; there are P1, P2, P4, P5, P6 [cam.unknown-key]",
         "6:1: P1 is given twice; it was first given in line 3; keep one [cam.twice]",
         "7:4: P4 '40000' is out of range; write a whole number from -32768 to 32767 [cam.out-of-range]",
         "8:1: P5 is missing; give a line P5,value [cam.missing]"}},
       {ecams::rotary() + "P6H,0\n",
        {"9:1: P6H is a word of P6, which is given too; give P6, or P6L (acceleration) and P6H (cam curve) "
         "[cam.twice]"}},
       {"# ecamtbx: K100\nmaster,slave\n0,0\n",
        {"2:1: there is no column 'master'; the columns are parameter,value [cam.unknown-key]",
         "2:8: there is no column 'slave'; the columns are parameter,value [cam.unknown-key]",
         "2:1: the header has no column parameter; the header is parameter,value [cam.unknown-key]",
         "2:1: the header has no column value; the header is parameter,value [cam.unknown-key]",
         "3:1: P1 is missing; give a line P1,value [cam.missing]",
         "3:1: P2 is missing; give a line P2,value [cam.missing]",
         "3:1: P3 is missing; give a line P3,value [cam.missing]",
         "3:1: P4 is missing; give a line P4,value [cam.missing]",
         "3:1: P5 is missing; give a line P5,value [cam.missing]"}}});
}

TEST(CamKinds, AreToldByTheHeader) {
  EXPECT_EQ(cam_kind("", "# remark\n\nsector,codeG\n").name, "camming4");
  EXPECT_EQ(cam_kind("", "# remark\n\nmaster,slave\n").name, "lx3vp");
  EXPECT_EQ(cam_kind("", ecams::rotary()).name, "lx3vp");
  EXPECT_EQ(cam_kind("", "").name, "camming4");
  EXPECT_EQ(cam_kind("", "0,0\n").name, "camming4");
  EXPECT_EQ(cam_kind("", "sektor,codeG\n").name, "camming4");
  EXPECT_EQ(cam_kind("", "mastr,slave\n").name, "lx3vp");
  EXPECT_EQ(cam_kind("", "foo,bar\n").name, "");
  EXPECT_EQ(cam_kind("lx3vp", "sector,codeG\n").name, "lx3vp");
  for (const auto& kind : cam_kinds()) EXPECT_EQ(cam_kind(kind.name, "").name, kind.name);
}

TEST(CamKinds, AHeaderOfNoneIsToldWithAllOfTheirs) {
  const std::string text = "# remark\n  foo,bar \n0,0\n";
  Problems problems;
  read_cam("", text, "a.csv", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(
      to_string(problems[0]),
      "a.csv:2:3: 'foo,bar' is the header of no cam table; CAMMING4's is "
      "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM; LX3VP's is master,slave, or parameter,value "
      "below a line # ecamtbx: K100 (K101, K0, K1); MC_CamIn's is slave, or a0,a1,a2,a3, or master,slave "
      "below a line # interpolation: POLY5_LINE [cam.unknown-key]");
}

TEST(EcamTable, TheTimeAxisAsTheProgramHasIt) {
  EXPECT_EQ(ecams::table("# time_axis: K10\nmaster,slave\n0,0\n5,5\n").time_axis, 10);
  EXPECT_EQ(ecams::table("# time_axis: k1\nmaster,slave\n0,0\n5,5\n").time_axis, 1);
  ecams::expect_faults({{"# time_axis: K0\nmaster,slave\n0,0\n",
                         {"1:15: time_axis '0' is out of range; write a whole number from 1 to 2147483647 "
                          "[cam.out-of-range]"}},
                        {"# time_axis: K\nmaster,slave\n0,0\n",
                         {testing::StartsWith("1:14: time_axis 'K' is not a whole number")}}});
}

TEST(EcamTable, SettingsWithoutAColon) {
  ecams::expect_faults(
      {{"# time_axis\n#cyclic 0\n# max_ratio = 5/2\n# max_position=\n# time_axis K5\n"
        "master,slave\n0,0\n",
        {"1:3: time_axis has no colon; write # time_axis: and its value; a remark begins with ## "
         "[cam.table-form]",
         "2:2: cyclic has no colon; write # cyclic: 0; a remark begins with ## [cam.table-form]",
         "3:3: max_ratio has no colon; write # max_ratio: 5/2; a remark begins with ## [cam.table-form]",
         "4:3: max_position has no colon; write # max_position: and its value; a remark begins with ## "
         "[cam.table-form]",
         "5:3: time_axis has no colon; write # time_axis: K5; a remark begins with ## [cam.table-form]"}},
       {"# time_axis in tenths of 1 ms\n# cyclic 1 means again\n## time_axis\n#\n"
        "# time\nmaster,slave\n0,0\n",
        {}}});
}

}  // namespace
}  // namespace drycut::sim::cams
