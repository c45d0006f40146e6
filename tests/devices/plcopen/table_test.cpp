#include <gmock/gmock.h>

#include "devices/plcopen/tab_file.hpp"
#include "tests/devices/plcopen/covers.hpp"

namespace drycut::devices::plcopen {
namespace {

using testing::ElementsAre;

std::vector<std::string> faults(const Problems& problems) {
  std::vector<std::string> texts;
  for (const Problem& problem : problems) texts.push_back(to_string(problem));
  return texts;
}
std::vector<std::string> tab_faults(const std::string& text) {
  Problems problems;
  const bool read = parse_tab(text, "c.tab", problems).has_value();
  EXPECT_EQ(read, problems.empty());
  return faults(problems);
}
std::vector<std::string> csv_faults(const std::string& text) {
  Problems problems;
  const bool read = parse_cam_csv(text, "c.csv", problems).has_value();
  EXPECT_EQ(read, problems.empty());
  return faults(problems);
}

TEST(PlcopenTable, ATabFileIsReadWithDecimalCommaAndPoint) {
  Problems problems;
  const auto table = parse_tab(
      "# a remark\nTablename = Profile-1\r\nTabletype = 5 # REAL64\nTable-ID=123\nFunctiontype = 3\nLines = "
      "2\n"
      "Begintable\n0,5 1.25  -2 6,12574E-17\n\n1 2 3 4 # last\nEndTable\n",
      "c.tab", problems);
  ASSERT_TRUE(table) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(table->file, "c.tab");
  EXPECT_EQ(table->name, "Profile-1");
  EXPECT_EQ(table->id, 123);
  EXPECT_EQ(table->type, 5);
  EXPECT_EQ(table->interpolation, Interpolation::polynom_3_koeff);
  EXPECT_THAT(table->values, ElementsAre(0.5, 1.25, -2, 6.12574e-17, 1, 2, 3, 4));
  EXPECT_EQ(table->lines(), 2u);
  EXPECT_EQ(table->value(1, 2), 3);
  covers({"type 5"});
}

TEST(PlcopenTable, ATabFilesFaultsAreAllToldAtTheirPlace) {
  EXPECT_THAT(
      tab_faults("Tabelname = x\nTabletype = 6\nTabletype = 1\nTable-ID = 0\nFunctiontype = 6\nLines = "
                 "2\nFoo\nBegintable\n"
                 "1 2\n40000\n1.5\nx\nEndTable\nmore\n"),
      ElementsAre("c.tab:1:1: unknown key 'Tabelname'; did you mean Tablename? [cam.unknown-key]",
                  "c.tab:2:13: type 6 is of the maker only; use 1..5 or 7 [cam.table-form]",
                  "c.tab:3:1: a second Tabletype; the first is in line 2 [cam.twice]",
                  "c.tab:4:12: '0' is out of range; write a whole number, 1 to 65535 [cam.value]",
                  "c.tab:5:16: '6' is no interpolation (error 42006); write 0 STEP_DIRECT .. 5 POLY5_LINE "
                  "[cam.interpolation]",
                  "c.tab:7:1: unknown key 'Foo'; known are Tablename, Tabletype, Table-ID, Functiontype, "
                  "Lines [cam.unknown-key]",
                  "c.tab:14:1: text after EndTable; take it away [cam.table-form]",
                  "c.tab:6:1: Lines = 2, but there are 4; write 4 [cam.table-form]"));
  EXPECT_THAT(
      tab_faults("Tabletype = 1\nTable-ID = 5\nLines = 3\nBegintable\n1 2\n 40000\n1,5\nx\nEndTable\n"),
      ElementsAre("c.tab:5:1: 2 numbers; a line of type 1 (slave positions, SGN16) has 1 [cam.value]",
                  "c.tab:6:2: 40000 does not fit slave positions, SGN16; write a whole number, -32768 to "
                  "32767 [cam.value]",
                  "c.tab:7:1: 1,5 does not fit slave positions, SGN16; write a whole number, -32768 to 32767 "
                  "[cam.value]",
                  "c.tab:8:1: 'x' is no number; write digits [cam.value]",
                  "c.tab:3:1: Lines = 3, but there are 4; write 4 [cam.table-form]"));
  EXPECT_THAT(tab_faults(""),
              ElementsAre("c.tab:1:1: Begintable is missing; write it above the rows [cam.missing]"));
  EXPECT_THAT(tab_faults("Lines\nBegintable\n"),
              ElementsAre("c.tab:1:1: 'Lines' without a value; write Lines = ... [cam.missing]",
                          "c.tab:2:1: tabletype is missing above; write it [cam.missing]",
                          "c.tab:2:1: table-id is missing above; write it [cam.missing]",
                          "c.tab:2:1: lines is missing above; write it [cam.missing]",
                          "c.tab:2:1: EndTable is missing; write it below the rows [cam.missing]"));
  // What is missing at the end is told in the last line there is.
  EXPECT_THAT(tab_faults("Tablename = x"),
              ElementsAre("c.tab:1:1: Begintable is missing; write it above the rows [cam.missing]"));
}

TEST(PlcopenTable, ACsvGivesTheTableItsLawsAndItsAxes) {
  Problems problems;
  const auto cam = parse_cam_csv(
      "# Rotary knife, 3 cuts: a remark\n# interpolation: POLYNOM_3\n# endless: positive\n# master_modulo: "
      "1000\n"
      "# slave_modulo: 2000\n# name: knife\n# id: 4\nslave\n0\n500.5\n1500\n",
      "c.csv", problems);
  ASSERT_TRUE(cam) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(cam->interpolation, Interpolation::polynom_3);
  EXPECT_EQ(cam->endless, Endless::positive);
  EXPECT_EQ(cam->master_modulo, 1000);
  EXPECT_EQ(cam->slave_modulo, 2000);
  EXPECT_EQ(cam->table.name, "knife");
  EXPECT_EQ(cam->table.id, 4);
  EXPECT_THAT(cam->table.values, ElementsAre(0, 500.5, 1500));
  // By the header alone the law is LINEAR, coefficients, or POLY5_LINE.
  EXPECT_EQ(parse_cam_csv("slave\n1\n", "c", problems)->interpolation, Interpolation::linear);
  EXPECT_EQ(parse_cam_csv("a0;a1;a2;a3\n1,5;0;0;0\n", "c", problems)->table.values[0], 1.5);
  EXPECT_EQ(parse_cam_csv("master,slave\n0,0\n1000,5\n", "c", problems)->interpolation,
            Interpolation::poly5_line);
  EXPECT_EQ(parse_cam_csv("# slave_modulo: 0\nslave\n1\n", "c", problems)->slave_modulo, 0);
}

TEST(PlcopenTable, AByteOrderMarkIsNoPartOfAnyFile) {
  const std::string mark = "\xEF\xBB\xBF";
  Problems problems;
  EXPECT_TRUE(
      parse_tab(mark + "Tabletype = 1\nTable-ID = 5\nLines = 1\nBegintable\n1\nEndTable\n", "c", problems));
  EXPECT_TRUE(
      read_cam(mark + "Tabletype = 1\nTable-ID = 5\nLines = 1\nBegintable\n1\nEndTable\n", "c", problems));
  for (const char* csv : {"slave\n1\n", "# interpolation: LINEAR\nslave\n1\n"}) {
    EXPECT_TRUE(parse_cam_csv(mark + csv, "c", problems));
    EXPECT_TRUE(read_cam(mark + csv, "c", problems));
  }
  EXPECT_THAT(faults(problems), testing::IsEmpty());
}

TEST(PlcopenTable, ATableWithoutMasterModuloIsJudgedByTheMastersThatThereAre) {
  const std::string text = "master,slave\n0,0\n5000000,100\n";  // beyond 360 deg
  const auto told = [&](const std::string& csv, const std::vector<MasterTurn>& masters) {
    Problems problems;
    parse_cam_csv(csv, "c.csv", problems, masters);
    return faults(problems);
  };
  EXPECT_THAT(told(text, {{"Web", 8'000'000}}), testing::IsEmpty());
  EXPECT_THAT(told(text, {{"Short", 4'000'000}, {"Web", 8'000'000}}), testing::IsEmpty());
  const std::string what =
      ": masters must ascend by 0.1 deg (1000) at least, over the wrap too; let the masters ascend inside "
      "one turn [cam.refused-by-device]";
  EXPECT_THAT(told(text, {{"Short", 4'000'000}, {"Shorter", 3'000'000}}),
              ElementsAre("c.csv:3:1: error 60260 behind Short, whose turn is 4000000" + what));
  EXPECT_THAT(told(text, {}), ElementsAre("c.csv:3:1: error 60260" + what));
  EXPECT_THAT(told("# master_modulo: 4000000\n" + text, {{"Web", 8'000'000}}),
              ElementsAre("c.csv:4:1: error 60260" + what));
  // A table that a turn of 360 deg would take, but not the one that there is.
  EXPECT_THAT(told("master,slave\n0,0\n2000000,100\n", {{"Short", 1'000'000}}),
              ElementsAre("c.csv:3:1: error 60260 behind Short, whose turn is 1000000" + what));
}

TEST(PlcopenTable, ASlipInATabsRemarksIsToldOtherRemarksAreItsMakers) {
  const std::string table = "Tabletype = 1\nTable-ID = 5\nLines = 1\nBegintable\n1\nEndTable\n";
  Problems problems;
  EXPECT_FALSE(read_cam("# maxvl: 1200\n# master_modlo: 8000000\n" + table, "c.tab", problems));
  EXPECT_THAT(
      faults(problems),
      ElementsAre(
          "c.tab:1:3: unknown key 'maxvl'; did you mean maxvel?; a remark begins with ## [cam.unknown-key]",
          "c.tab:2:3: unknown key 'master_modlo'; did you mean master_modulo?; a "
          "remark begins with ## [cam.unknown-key]"));
  problems.clear();
  EXPECT_TRUE(read_cam("# Author: J. Doe\n## maxvl: 1200\n" + table, "c.tab", problems));
}

TEST(PlcopenTable, ACsvsFaultsAreAllToldAtTheirPlace) {
  EXPECT_THAT(
      csv_faults("# interpolaton: LINEAR\n# endless: up\n# interpolation: SPLINE\nslave\n1,2\nx\n"),
      ElementsAre("c.csv:1:3: unknown key 'interpolaton'; did you mean interpolation?; a "
                  "remark begins with ## [cam.unknown-key]",
                  "c.csv:2:12: endless cannot be 'up'; write positive, negative or no [cam.value]",
                  "c.csv:3:18: 'SPLINE' is no interpolation (error 42006); write STEP_DIRECT, "
                  "LINEAR, POLYNOM_3, POLYNOM_3_KOEFF, "
                  "LINE_POLY5 or POLY5_LINE [cam.interpolation]",
                  "c.csv:5:1: 2 numbers; a line of type 3 (slave positions, REAL64) has 1 [cam.value]",
                  "c.csv:6:1: 'x' is no number; write digits [cam.value]"));
  EXPECT_THAT(csv_faults("position\n"), ElementsAre("c.csv:1:1: unknown header 'position'; write slave, or "
                                                    "master,slave, or a0,a1,a2,a3 [cam.unknown-key]"));
  EXPECT_THAT(
      csv_faults("\n"),
      ElementsAre(
          "c.csv:1:1: there is no header; write slave, or master,slave, or a0,a1,a2,a3 [cam.unknown-key]"));
  EXPECT_THAT(csv_faults("master,slave\n0,0\n500,0\n"),
              ElementsAre("c.csv:3:1: error 60260: masters must ascend by 0.1 deg (1000) at least, over the "
                          "wrap too; let the masters ascend "
                          "inside one turn [cam.refused-by-device]"));
  EXPECT_THAT(csv_faults("master,slave\n0,0\n"),
              ElementsAre("c.csv:1:1: error 60261: LINE/POLY5 needs an even number of lines, 2..360; add or "
                          "take away a line [cam.refused-by-device]"));
  EXPECT_THAT(
      csv_faults("slave\n"),
      ElementsAre(
          "c.csv:1:1: error 42007: the table has no lines; write one line at least [cam.refused-by-device]"));
  EXPECT_THAT(csv_faults("# slave_modulo: 0\n# endless: positive\nslave\n0\n"),
              ElementsAre("c.csv:3:1: error 60181: this cam needs modulo axes; give slave_modulo a length "
                          "[cam.refused-by-device]"));
  EXPECT_THAT(csv_faults("slave\n1e200\n"),
              ElementsAre("c.csv:1:1: error 44003: Position outside its range; keep positions within +-1e12 "
                          "[cam.refused-by-device]"));
  EXPECT_EQ(csv_faults("# interpolation: POLYNOM_3_KOEFF\nslave\n1\n").size(), 1u);
}

TEST(PlcopenTable, EachTypeGoesWithItsInterpolationsOnly) {
  // 1..3 with 0..2, 4 and 5 with 3, 7 with 4 and 5, 6 with none.
  for (int type = 1; type <= 7; ++type) {
    for (int wanted = 0; wanted <= 5; ++wanted) {
      const McCamTable table{.file = {}, .name = {}, .id = 1, .type = type, .values = {0, 0, 5'000, 0}};
      const bool fits = (type <= 3 && wanted <= 2) || ((type == 4 || type == 5) && wanted == 3) ||
                        (type == 7 && wanted >= 4);
      EXPECT_EQ(check(table, static_cast<Interpolation>(wanted), 3'600'000),
                fits ? ErrorId::none : ErrorId::table_type_mismatch)
          << type << " " << wanted;
    }
    covers({"type " + std::to_string(type)});
  }
  EXPECT_EQ(check({.file = {}, .name = {}, .type = 8, .values = {}}, Interpolation::linear, 1),
            ErrorId::table_type_unknown);
  covers({"60172"});
}

TEST(PlcopenTable, PairsAscendByATenthOfADegreeOverTheWrapTooAndAreEven) {
  const auto judge = [](std::vector<double> values) {
    return check({.file = {}, .name = {}, .id = 1, .type = 7, .values = std::move(values)},
                 Interpolation::line_poly5, 3'600'000);
  };
  EXPECT_EQ(judge({0, 0, 1000, 0}), ErrorId::none);
  EXPECT_EQ(judge({0, 0, 999, 0}), ErrorId::table_master_order);
  EXPECT_EQ(judge({500, 0, 3'599'500, 0}), ErrorId::none);
  EXPECT_EQ(judge({500, 0, 3'599'501, 0}), ErrorId::table_master_order);
  EXPECT_EQ(judge({-1, 0, 2000, 0}), ErrorId::table_master_order);
  EXPECT_EQ(judge({0, 0}), ErrorId::table_line_count);
  EXPECT_EQ(judge({0, 0, 2000, 0, 4000, 0}), ErrorId::table_line_count);
  std::vector<double> most;
  for (int i = 0; i < 360; ++i) most.insert(most.end(), {i * 10'000.0, 0});
  EXPECT_EQ(judge(most), ErrorId::none);
  most.insert(most.end(), {3'591'000, 0, 3'593'000, 0});
  EXPECT_EQ(judge(most), ErrorId::table_line_count);
  covers({"60260", "60261"});
}

TEST(PlcopenTable, TheStoreRefusesWhatItCannotHold) {
  CamTables tables;
  const auto table = [](int type, std::uint16_t id, std::vector<double> values) {
    return McCamTable{.file = "a.tab", .name = {}, .id = id, .type = type, .values = std::move(values)};
  };
  EXPECT_EQ(tables.add(table(1, 0, {1})), ErrorId::table_id);
  EXPECT_EQ(tables.add(table(6, 1, {1})), ErrorId::table_type_unknown);
  EXPECT_EQ(tables.add(table(9, 1, {1})), ErrorId::table_type_unknown);
  EXPECT_EQ(tables.add(table(4, 1, {1, 2, 3})), ErrorId::too_few_columns);
  EXPECT_EQ(tables.find(1), nullptr);
  EXPECT_EQ(tables.write(1, 0, 0, 1), ErrorId::no_such_table);
  EXPECT_EQ(tables.begin_change(1), ErrorId::no_such_table);
  EXPECT_EQ(tables.add(table(1, 1, {1, 2})), ErrorId::none);
  EXPECT_EQ(tables.write(1, 2, 0, 1), ErrorId::too_few_lines);
  EXPECT_EQ(tables.write(1, 1, 1, 1), ErrorId::too_few_columns);
  EXPECT_EQ(tables.write(1, 1, 0, 40'000), ErrorId::position_range);
  EXPECT_EQ(tables.write(1, 1, 0, 0.5), ErrorId::position_range);
  EXPECT_EQ(tables.write(1, 1, 0, -32'768), ErrorId::none);
  EXPECT_EQ(tables.find(1)->values[1], -32'768);
  EXPECT_EQ(tables.revision(1), 2u);
  EXPECT_EQ(tables.find_file("a.tab"), tables.find(1));
  EXPECT_EQ(tables.find_file("b.tab"), nullptr);
  EXPECT_EQ(tables.find_file(""), nullptr);
  covers({"240013", "240011", "42004", "42007", "42003"});
}

TEST(PlcopenTable, InterpolationsAreKnownByNameAndNumber) {
  EXPECT_EQ(parse_interpolation("poly5_line"), Interpolation::poly5_line);
  EXPECT_EQ(parse_interpolation("2"), Interpolation::polynom_3);
  EXPECT_FALSE(parse_interpolation("7"));
  EXPECT_FALSE(parse_interpolation(""));
  EXPECT_EQ(name_of(Interpolation::table_defined), "TABLE_DEFINED");
}

}  // namespace
}  // namespace drycut::devices::plcopen
