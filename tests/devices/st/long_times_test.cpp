// LTIME, LTOD, LDATE, LDT in nanoseconds; CHAR and WCHAR.
#include <gmock/gmock.h>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

TEST(StLongTimes, LiteralsAreExact) {
  constexpr double day = 86400e9;
  expect_values("LINT", {{"LTIME_TO_LINT(LTIME#1d2h3m4s5ms6us7ns)", day + 7384005006007.0},
                         {"LTIME_TO_LINT(LT#-1.5us)", -1500},
                         {"LTIME_TO_LINT(LTIME#0.000000001s)", 1},
                         {"LTIME_TO_LINT(LTIME#1_000ns)", 1000},
                         {"LTOD_TO_LINT(LTOD#00:00:01.000000002)", 1000000002},
                         {"LDATE_TO_LINT(LDATE#1970-01-03)", 2 * day},
                         {"LDATE_TO_LINT(LD#1970-01-02)", day},
                         {"LDT_TO_LINT(LDT#1970-01-02-00:00:00.5)", day + 5e8}});
  EXPECT_EQ(value_of("BOOL", "LTIME_TO_LINT(LTIME#106751d23h47m16s854ms775us807ns) = 9223372036854775807"),
            1);
  for (const char* literal : {"LTIME#106751d23h47m16s854ms775us808ns", "LTIME#1.5ns"})
    EXPECT_THAT(problems_of("PROGRAM p VAR t : LTIME := " + std::string(literal) + "; END_VAR END_PROGRAM"),
                ElementsAre(StartsWith("1:28: '" + std::string(literal) +
                                       "' is out of range, or finer than an LTIME")));
  for (const char* literal : {"LTIME#1ns2us", "LTIME#5", "LTIME#5x"})
    EXPECT_THAT(problems_of("PROGRAM p VAR t : LTIME := " + std::string(literal) + "; END_VAR END_PROGRAM"),
                ElementsAre(StartsWith("1:28: '" + std::string(literal) + "' is no time")));
  for (const char* literal : {"LTOD#24:00:00", "LTOD#00:00:00.0000000001"})
    EXPECT_THAT(problems_of("PROGRAM p VAR t : LTOD := " + std::string(literal) + "; END_VAR END_PROGRAM"),
                ElementsAre(StartsWith("1:27: '" + std::string(literal) + "' is no LTOD")));
  EXPECT_THAT(problems_of("PROGRAM p VAR t : LDATE := LDATE#2263-01-01; END_VAR END_PROGRAM"),
              ElementsAre(StartsWith("1:28: 'LDATE#2263-01-01' is no LDATE; LDATE#1970-01-01 to")));
}

TEST(StLongTimes, PartsGoAsFarAsAnLdt) {
  Bench bench(
      "PROGRAM p VAR m : LDT; back : BOOL; y, mo, d, h, mi, s, ms : INT; END_VAR\n"
      "SPLIT_LDT(LDT#2262-04-11-23:47:16.854, YEAR => y, MONTH => mo, DAY => d, HOUR => h, MINUTE => mi,\n"
      "  SECOND => s, MILLISECOND => ms);\n"
      "m := CONCAT_LDT(y, mo, d, h, mi, s, ms);\n"
      "back := m = LDT#2262-04-11-23:47:16.854 AND CONCAT_LDT(2107, 1, 1, 0, 0, 0, 0) = "
      "LDT#2107-01-01-00:00:00;\n"
      "END_PROGRAM");
  bench.scan();
  bench.expect(
      {{"y", 2262}, {"mo", 4}, {"d", 11}, {"h", 23}, {"mi", 47}, {"s", 16}, {"ms", 854}, {"back", 1}});
  EXPECT_THAT(bench.runtime->take_losses(), testing::IsEmpty());
  // Before 1970 it counts from the midnight before, as LDT_TO_STRING does.
  Bench before(
      "PROGRAM p VAR y, mo, d, h, mi, s, ms : INT; END_VAR\n"
      "SPLIT_LDT(LDT#1970-01-01-00:00:00 - LTIME#1ms, YEAR => y, MONTH => mo, DAY => d, HOUR => h,\n"
      "  MINUTE => mi, SECOND => s, MILLISECOND => ms);\nEND_PROGRAM");
  before.scan();
  before.expect({{"y", 1969}, {"mo", 12}, {"d", 31}, {"h", 23}, {"mi", 59}, {"s", 59}, {"ms", 999}});
}

TEST(StLongTimes, Arithmetic) {
  expect_values("LINT",
                {{"LTIME_TO_LINT(LTIME#1s - LTIME#3s)", -2000000000},
                 {"LTIME_TO_LINT(-LTIME#3ns)", -3},
                 {"LTIME_TO_LINT(LTIME#3ns * 4)", 12},
                 {"LTIME_TO_LINT(LTIME#3us / 2.0)", 1500},
                 {"LTIME_TO_LINT(T#2ms + LTIME#1ns)", 2000001},
                 {"LTIME_TO_LINT(LDT#1970-01-02-00:00:00 - LDT#1970-01-01-23:59:59.999999999)", 1},
                 {"LTIME_TO_LINT(SUB_LDATE_LDATE(LDATE#1970-01-01, LDATE#1970-01-02))", -86400e9},
                 {"LTOD_TO_LINT(LTOD#23:59:59 + LTIME#2s)", 1e9},
                 {"LTOD_TO_LINT(TOD#00:00:01 - LTIME#2s)", 86399e9},
                 {"LDT_TO_LINT(DT#1970-01-01-00:00:01 + LTIME#1ns)", 1000000001},
                 {"LDT_TO_LINT(CONCAT_DATE_LTOD(DATE#1970-01-02, LTOD#00:00:00.000000007))", 86400e9 + 7},
                 {"LDT_TO_LINT(CONCAT_LDT(1970, 1, 2, 0, 0, 1, 5))", 86401.005e9}});
  expect_values("BOOL", {{"LTIME#1s = T#1s", 1},
                         {"LTIME#-1s < T#0s", 1},
                         {"DT#2024-02-29-01:00:00 = LDT#2024-02-29-01:00:00", 1}});
  EXPECT_THAT(
      problems_of(
          "PROGRAM p VAR t : TIME; l : LTIME; d : LDT; END_VAR\nt := l;\nd := l;\nt := d - d;\nEND_PROGRAM"),
      ElementsAre(StartsWith("2:6: 'l' is LTIME, which does not go into TIME by itself; LTIME_TO_TIME"),
                  StartsWith("3:6: 'l' is LTIME"), StartsWith("4:")));
}

TEST(StLongTimes, Conversions) {
  expect_values("LINT", {{"TIME_TO_DINT(LTIME_TO_TIME(LTIME#1500us))", 1},
                         {"LTIME_TO_LINT(TIME_TO_LTIME(T#1500ms))", 1500000000},
                         {"TOD_TO_DINT(LDT_TO_TOD(LDT#2024-02-29-00:00:01.002003))", 1002},
                         {"LTOD_TO_LINT(DT_TO_LTOD(DT#2024-02-29-00:00:01))", 1000000000},
                         {"LDATE_TO_LINT(LDT_TO_LDATE(LDT#1970-01-02-12:00:00))", 86400e9},
                         {"DATE_TO_UDINT(LDATE_TO_DATE(LDATE#1970-01-02))", 86400},
                         {"LEN(LTIME_TO_STRING(LTIME#-1s2us))", 12}});
  const auto text = [](const std::string& expression, const std::string& wanted) {
    EXPECT_EQ(value_of("BOOL", expression + " = '" + wanted + "'"), 1) << expression;
  };
  text("LTIME_TO_STRING(LTIME#1500ms7ns)", "LTIME#1s500ms7ns");
  text("LTIME_TO_STRING(LTIME#-2us)", "LTIME#-2us");
  text("LTOD_TO_STRING(LTOD#01:02:03.5)", "LTOD#01:02:03.500000000");
  text("LDATE_TO_STRING(LDATE#2024-02-29)", "LDATE#2024-02-29");
  text("LDT_TO_STRING(LDT#2024-02-29-01:02:03.000000001)", "LDT#2024-02-29-01:02:03.000000001");
  expect_values("BOOL", {{"STRING_TO_LTIME('LTIME#5us') = LTIME#5us", 1},
                         {"STRING_TO_LDT('LDT#2024-02-29-01:02:03.5') = LDT#2024-02-29-01:02:03.5", 1}});
  EXPECT_THAT(
      problems_of("PROGRAM p VAR t : LTIME; d : LDATE; END_VAR t := LDATE_TO_LTIME(d);\nEND_PROGRAM").size(),
      1);
}

TEST(StLongTimes, AreReadInSecondsAndCountTheController) {
  Bench bench(
      "PROGRAM p VAR t : LTIME; n : LTIME := LTIME#-1500us; first : LTIME; END_VAR t := LTIME(); "
      "END_PROGRAM");
  bench.scan(3);
  bench.expect({{"t", 0.004}, {"n", -0.0015}});
  bench.set("n", 2.5e-9);
  EXPECT_EQ(bench["n"], 2e-9);
}

TEST(StLongTimes, NamesMayBeTheUsers) {
  EXPECT_EQ(run("x : INT; LT : INT := 3; ltod : INT;", "ltod := LT; x := ltod;"), 3);
  EXPECT_EQ(run("x : INT; c : CHAR;", "c := CHAR#Two; x := c;", "TYPE CHAR : (One, Two); END_TYPE"), 1);
}

TEST(StCharacters, AreOneOfAText) {
  expect_values("INT", {{"CHAR_TO_INT(CHAR#'A')", 65},
                        {"WCHAR_TO_INT(WCHAR#\"ö\")", 0xF6},
                        {"WCHAR_TO_INT(WCHAR#\"€\")", 0x20AC},
                        {"CHAR_TO_INT(STRING_TO_CHAR('xyz'))", 120},
                        {"CHAR_TO_INT(BYTE_TO_CHAR(66))", 66},
                        {"LEN(CONCAT(CHAR_TO_STRING(CHAR#'a'), 'b'))", 2}});
  EXPECT_EQ(run("x : INT; c : CHAR := 'A'; s : STRING; w : WSTRING; u : WCHAR;",
                "s := c; IF s = 'A' THEN x := x + 1; END_IF c := 'B'; IF c = CHAR#'B' AND c > CHAR#'A' THEN "
                "x := x + 2; END_IF "
                "u := \"€\"; w := u; IF w = \"€\" THEN x := x + 4; END_IF"),
            7);
  EXPECT_THAT(problems_of("PROGRAM p VAR c : CHAR; w : WCHAR; END_VAR\nc := 'ab';\nc := 65;\nw := 'a';\nc := "
                          "c + c;\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:6: 2 characters for a CHAR; it holds one"),
                          StartsWith("3:6: the number 65 is no CHAR; a CHAR is written CHAR#'A'"),
                          StartsWith("4:6: "), StartsWith("5:8: '+' does not go with CHAR and CHAR")));
}

TEST(StCharacters, ShortTextsLeaveWhatStandsBehindThem) {
  // The place of a STRING on its way is a quarter of a WSTRING's.
  EXPECT_EQ(run("x, i : INT := 5; s : STRING; w : WSTRING;",
                "s := INT_TO_STRING(i); w := CONCAT(\"a\", \"b\"); IF s = '5' AND w = \"ab\" AND "
                "LEN(\"long\") = 4 THEN x := 1; END_IF"),
            1);
}

TEST(StCharacters, TextsOfTwoKindsDoNotMix) {
  for (const char* expression :
       {"SEL(b, 'a', \"b\")", "MUX(0, 'a', \"b\")", "CONCAT('a', \"b\")", "\"text\""})
    EXPECT_THAT(problems_of("PROGRAM p VAR s : STRING; b : BOOL; END_VAR s := " + std::string(expression) +
                            "; END_PROGRAM")
                    .size(),
                1)
        << expression;
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
