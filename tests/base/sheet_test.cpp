#include "base/sheet.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <cstdlib>

namespace drycut {
namespace {

Sheet words() {
  Sheet sheet("words", "Words of the block", {"offset=word", "words=", "=range", "meaning"});
  sheet.add({{2, "2-3"}, 2, "1..200000", "the highest frequency of the pulses"});
  sheet.add({4, 1, "", "flags"});
  return sheet;
}

TEST(Sheet, IsTextUnderItsTitleAndHeadings) {
  EXPECT_EQ(words().text(0),
            "\n"
            "Words of the block\n"
            "  word  range      meaning\n"
            "  2-3   1..200000  the highest frequency of the pulses\n"
            "  4                flags\n");
}

TEST(Sheet, IsJsonWithNumbersAsNumbersInTheOrderOfItsColumns) {
  EXPECT_EQ(words().json().dump(),
            R"([{"offset":2,"words":2,"meaning":"the highest frequency of the pulses"},)"
            R"({"offset":4,"words":1,"meaning":"flags"}])");
}

TEST(Sheet, LeavesOutWhatIsAbsent) {
  Sheet sheet("results", "Results", {"result", "meaning", "kinds"});
  EXPECT_EQ(sheet.text(0), "");
  EXPECT_EQ(sheet.json().dump(), "[]");
  sheet.add({{nullptr, "above 0"}, {nullptr, "rows"}, nullptr});         // for text alone
  sheet.add({{-1, ""}, {"told to programs", ""}, nullptr});              // for JSON alone
  sheet.add({-2, nullptr, std::vector<std::string>{"saw", "S-curve"}});  // no meaning
  EXPECT_EQ(sheet.text(0),
            "\nResults\n  result   meaning  kinds\n  above 0  rows\n  -2                saw, S-curve\n");
  EXPECT_EQ(sheet.json().dump(),
            R"([{"result":-1,"meaning":"told to programs"},{"result":-2,"kinds":["saw","S-curve"]}])");
}

TEST(Sheet, WithoutATitleIsForJsonAlone) {
  Sheet sheet("fields", "", {"name"});
  sheet.add({"TCamp"});
  EXPECT_EQ(sheet.text(0), "");
  EXPECT_EQ(sheet.json().dump(), R"([{"name":"TCamp"}])");
}

TEST(Sheet, WrapsTheLastColumnUnderItself) {
  EXPECT_EQ(words().text(40),
            "\n"
            "Words of the block\n"
            "  word  range      meaning\n"
            "  2-3   1..200000  the highest frequency\n"
            "                   of the pulses\n"
            "  4                flags\n");
}

TEST(Columns, GiveWayOnlyWhereTheyMustAndTheWidestFirst) {
  const std::vector<std::vector<std::string>> rows = {{"a", "one two three four", "five six seven"}};
  EXPECT_EQ(in_columns(rows, 39), "  a  one two three four  five six seven\n");
  EXPECT_EQ(in_columns(rows, 38), "  a  one two three      five six seven\n     four\n");
  EXPECT_EQ(in_columns(rows, 24), "  a  one two   five six\n     three     seven\n     four\n");
}

// Then lines are longer than the terminal's, which breaks them itself: no name is cut in two.
TEST(Columns, KeepTheirLongestWord) {
  EXPECT_EQ(in_columns({{"follerr", "the servo's following error"}}, 10),
            "  follerr  the\n           servo's\n           following\n           error\n");
  EXPECT_EQ(in_columns({{"servo.torque_at_max_speed"}}, 10), "  servo.torque_at_max_speed\n");
}

TEST(Columns, CountCharactersNotBytes) {
  EXPECT_EQ(characters("±10 V, 90°, pulses/s²"), 21u);
  EXPECT_EQ(in_columns({{"±10 V", "ä"}, {"5 V", "b"}}, 0), "  ±10 V  ä\n  5 V    b\n");
  EXPECT_EQ(in_columns({{"90° ± 5°", "b"}}, 13), "  90° ± 5°  b\n");
  EXPECT_EQ(in_columns({{"90° ± 5°", "b"}}, 12), "  90° ±    b\n  5°\n");
}

TEST(Columns, StandToTheRightWhereAsked) {
  EXPECT_EQ(in_columns({{"row", "law"}, {"7", "line"}, {"12"}}, 0, {true, false}),
            "  row  law\n    7  line\n   12\n");
}

TEST(OutputWidth, IsTheTerminalsElseThatOfColumnsElseNone) {
  setenv("COLUMNS", "120", 1);
  testing::internal::CaptureStdout();
  EXPECT_EQ(output_width(), 120u);
  for (const char* none : {"", "0", "wide", "-3"}) {
    setenv("COLUMNS", none, 1);
    EXPECT_EQ(output_width(), 0u) << none;
  }
  unsetenv("COLUMNS");
  EXPECT_EQ(output_width(), 0u);
  testing::internal::GetCapturedStdout();

  setenv("COLUMNS", "120", 1);
  const winsize size{40, 77, 0, 0};
  int terminal = -1;
  int program = -1;
  ASSERT_EQ(openpty(&terminal, &program, nullptr, nullptr, &size), 0);
  const int before = dup(STDOUT_FILENO);
  dup2(program, STDOUT_FILENO);
  const auto width = output_width();
  dup2(before, STDOUT_FILENO);
  for (const int file : {terminal, program, before}) close(file);
  unsetenv("COLUMNS");
  EXPECT_EQ(width, 77u);
}

}  // namespace
}  // namespace drycut
