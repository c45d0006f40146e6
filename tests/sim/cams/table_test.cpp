#include <gmock/gmock.h>

#include "tests/sim/cams/bench.hpp"

namespace drycut::sim::cams {
namespace {

using cams::faults;
using cams::header;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(CamTable, ReadsSettingsAndRowsInAnyOrder) {
  const auto table = cams::table(
      "# a remark: with words\r\n# measure: 6000\r\n#pulse:40960\n# measurem: 5000\n# pulsem: "
      "10000\n"
      "# decpt: 2\n# unitvel: 0\n# maxvel: 1000\n# taccmax: 30\n# tdecmax: 40\n# TCamp: 4 ms\n\n"
      "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM\r\n"
      " 3 , 136\n1,150,100,-50,+7,8,9\r\n# nothing: here\n2,170,-26,15,,-33,\n");
  EXPECT_EQ(table.settings.slave.measure, 6000);
  EXPECT_EQ(table.settings.slave.pulse, 40960);
  EXPECT_EQ(table.settings.master.measure, 5000);
  EXPECT_EQ(table.settings.master.pulse, 10000);
  EXPECT_EQ(table.settings.decpt, 2);
  EXPECT_EQ(table.unitvel, 0);
  EXPECT_EQ(table.maxvel, 1000);
  EXPECT_EQ(table.taccmax, 30);
  EXPECT_EQ(table.tdecmax, 40);
  EXPECT_EQ(table.TCamp, 4);
  EXPECT_EQ(table.count(), 3);
  EXPECT_EQ(table.sector(1).row, (devices::camming4::Row{150, 100, -50, 7, 8, 9}));
  EXPECT_EQ(table.sector(2).row, (devices::camming4::Row{170, -26, 15, 0, -33, 0}));
  EXPECT_EQ(table.sector(3).row.codeG, 136);
  EXPECT_EQ(table.sector(1).line, 15);
  EXPECT_FALSE(table.has(4));
}

TEST(CamTable, DefaultsAreOneUmABitAndTwoMilliseconds) {
  const auto table = cams::rows("1,136\n");
  EXPECT_EQ(table.settings.slave.measure, 1);
  EXPECT_EQ(table.settings.slave.pulse, 1);
  EXPECT_EQ(table.settings.master.measure, 1);
  EXPECT_EQ(table.settings.master.pulse, 1);
  EXPECT_EQ(table.settings.decpt, 0);
  EXPECT_EQ(table.unitvel, 1);
  EXPECT_EQ(table.maxvel, 0);
  EXPECT_EQ(table.TCamp, 2);
}

TEST(CamTable, ColumnsStandWhereTheHeaderSays) {
  const auto table = cams::table("codeQs,sector,codeG,codeQm\n-5,1,133,20\n,2,136\n");
  EXPECT_EQ(table.sector(1).row, (devices::camming4::Row{133, 20, -5, 0, 0, 0}));
  EXPECT_EQ(table.sector(2).row.codeG, 136);
}

TEST(CamTable, FaultsOfSettings) {
  const std::string rest = header + "1,136\n";
  cams::expect_faults(
      {{"# tacmax: 5\n" + rest,
        {"1:3: there is no setting 'tacmax'; did you mean taccmax?; a remark begins with ## "
         "[cam.unknown-key]"}},
       {"# colour: red\n" + rest,
        {"1:3: there is no setting 'colour'; there are TCamp, decpt, maxpos, maxvel, measure, measurem, "
         "minpos, pulse, pulsem, taccmax, tdecmax, unitvel; a remark begins with ## [cam.unknown-key]"}},
       {"#  measure: 0\n" + rest,
        {"1:13: measure '0' is out of range; write a whole number from 1 to 999999 [cam.out-of-range]"}},
       {"# decpt: 4\n" + rest,
        {"1:10: decpt '4' is out of range; write a whole number from 0 to 3 [cam.out-of-range]"}},
       {"# TCamp: 251\n" + rest,
        {"1:10: TCamp '251' is out of range; write a whole number from 1 to 250 [cam.out-of-range]"}},
       {"# pulse: 1.5\n" + rest,
        {"1:10: pulse '1.5' is not a whole number; write a whole number from 1 to 999999 [cam.value]"}},
       {"# pulse: many bits\n" + rest,
        {"1:10: pulse 'many bits' is not a whole number; write a whole number from 1 to 999999 [cam.value]"}},
       {"# pulse:\n" + rest,
        {"1:9: pulse has no value; write a whole number from 1 to 999999 [cam.missing]"}},
       {"# pulse: 4\n# pulse: 4\n" + rest,
        {"2:3: pulse is given twice; it was first given in line 1; keep one [cam.twice]"}},
       {header + "# pulse: 4\n1,136\n",
        {"2:3: pulse stands below the header; give settings above the header [cam.table-form]"}},
       {"# taccmax: 10\n" + rest,
        {"1:1: taccmax means nothing without maxvel; give the speed at 10 V too: # maxvel: 1000 "
         "[cam.needs-another]"}},
       {"## colour: red\n" + rest, {}}});
}

TEST(CamTable, FaultsOfTheHeader) {
  cams::expect_faults(
      {{"1,132,100,50\n2,136\n",
        {"1:1: the header is missing; begin with the line sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM "
         "[cam.missing]"}},
       {"",
        {"1:1: there is no table: the header is missing; give the line "
         "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM and a line for each sector [cam.missing]"}},
       {header,
        {"1:1: the table has no sector; give a line for each sector, such as 1,132,100,50 [cam.missing]"}},
       {"sector,codeG,codeQn\n1,136\n",
        {"1:14: there is no column 'codeQn'; did you mean codeQm? [cam.unknown-key]"}},
       {"sector,codeG,speed limit\n1,136\n",
        {"1:14: there is no column 'speed limit'; the columns are "
         "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM [cam.unknown-key]"}},
       {"sector,codeG,codeG\n1,136\n", {"1:14: column codeG is there twice; keep one [cam.twice]"}},
       {"sector,codeQm\n1,136\n",
        {"1:1: the header has no column codeG; the header is "
         "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM [cam.unknown-key]"}}});
  EXPECT_THAT(
      faults("sector;codeG\n1;136\n"),
      testing::Contains(
          "1:1: there is no column 'sector;codeG'; separate the columns with commas [cam.unknown-key]"));
}

TEST(CamTable, FaultsOfSectors) {
  cams::expect_faults(
      {{header + "0,136\n",
        {"2:1: sector '0' is out of range; write a whole number from 1 to 128 [cam.out-of-range]"}},
       {header + " 129,136\n",
        {"2:2: sector '129' is out of range; write a whole number from 1 to 128 [cam.out-of-range]"}},
       {header + ",136\n", {"2:1: sector has no value; write a whole number from 1 to 128 [cam.missing]"}},
       {header + "1,136\n1,130\n",
        {"3:1: sector 1 is given twice; it was first given in line 2; number each sector once [cam.twice]"}},
       {header + "1,136,0,0,0,0,0,7\n",
        {"2:17: '7' is in no column of the header; the header has 7 columns [cam.unknown-key]"}}});
}

TEST(CamTable, FaultsOfCodes) {
  cams::expect_faults(
      {{header + "1,176\n",
        {"2:3: there is no codeG 176; the nearest is 175 UT: tangent axis of a counterclockwise arc "
         "[cam.unknown-key]"}},
       {header + "1,0\n",
        {"2:3: there is no codeG 0; the nearest is 130 NOP: does nothing [cam.unknown-key]"}},
       {header + "1\n",
        {"2:1: codeG has no value; write an operating instruction, such as 133; 130 does nothing "
         "[cam.missing]"}},
       {header + "1,AZM,100,50\n",
        {"2:3: codeG 'AZM' is a name, not a number; write 132: AZM accelerates from standstill to the "
         "master's speed [cam.value]"}},
       {header + "1,xyz\n",
        {"2:3: codeG 'xyz' is not a whole number; write a whole number from 0 to 32767 [cam.value]"}}});
}

TEST(CamTable, FaultsOfNumbers) {
  cams::expect_faults(
      {{header + "1,133,10.5,1e3\n",
        {"2:7: codeQm '10.5' is not a whole number; write a whole number from 0 to 999999 [cam.value]",
         "2:12: codeQs '1e3' is not a whole number; write a whole number from -999999 to 999999 "
         "[cam.value]"}},
       {header + "1,133,1000000,-1000000\n",
        {"2:7: codeQm '1000000' is out of range; write a whole number from 0 to 999999 [cam.out-of-range]",
         "2:15: codeQs '-1000000' is out of range; write a whole number from -999999 to 999999 "
         "[cam.out-of-range]"}},
       {header + "1,133,-5,0\n",
        {"2:7: codeQm '-5' is out of range; write a whole number from 0 to 999999 [cam.out-of-range]"}},
       {header + "1,171,159155,318309,0,-318309\n",
        {"2:7: codeQm '159155' is out of range; write a whole number from -159154 to 159154 "
         "[cam.out-of-range]",
         "2:14: codeQs '318309' is out of range; write a whole number from -318308 to 318308 "
         "[cam.out-of-range]",
         "2:23: codeQsa '-318309' is out of range; write a whole number from -318308 to 318308 "
         "[cam.out-of-range]"}},
       {header + "1,180,0,318309\n",
        {"2:9: codeQs '318309' is out of range; write a whole number from -318308 to 318308 "
         "[cam.out-of-range]"}},
       {header + "1,136,0,0,-1\n",
        {"2:11: codeQma '-1' is out of range; write a whole number from 0 to 999999 [cam.out-of-range]"}},
       {header + "1,136,99999999999999999999999\n",
        {"2:7: codeQm '99999999999999999999999' is out of range; write a whole number from -159154 to 999999 "
         "[cam.out-of-range]"}},
       {header + "1,136,+-5\n",
        {"2:7: codeQm '+-5' is not a whole number; write a whole number from -159154 to 999999 [cam.value]"}},
       {header + std::string("1,136,nan\n1\0,136\n", 16),
        {"2:7: codeQm 'nan' is not a whole number; write a whole number from -159154 to 999999 [cam.value]",
         "3:1: sector '1\\x00' is not a whole number; write a whole number from 1 to 128 [cam.value]"}}});
}

TEST(CamTable, AllFaultsInOneRun) {
  EXPECT_THAT(faults("# pulse: 0\nsector,codeG,codeQm\n1,999,a\n200,136\n").size(), 4U);
}

TEST(CamTable, AHostileFileEndsAfterAThousandFaults) {
  std::string text = header;
  for (int i = 0; i < 200'000; ++i) text += "x,y,z\n";
  const auto told = faults(text);
  ASSERT_EQ(told.size(), 1001U);
  EXPECT_THAT(told.back(),
              testing::HasSubstr("too many problems: the rest is not told; is this a cam table?"));
}

TEST(CamTable, AMessageQuotesLittleOfALongCell) {
  const auto told = faults(header + "1," + std::string(1'000'000, 'x') + "\n");
  ASSERT_EQ(told.size(), 1U);
  EXPECT_LT(told.front().size(), 200U);
}

}  // namespace
}  // namespace drycut::sim::cams
