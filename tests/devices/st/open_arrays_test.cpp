// ARRAY [*] and the bounds of arrays; FLOOR, CEIL, IS_VALID, orders of bytes, BCD; loops without an end.
#include <gmock/gmock.h>

#include <limits>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr const char* units = R"(TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
FUNCTION Sum : DINT VAR_INPUT v : ARRAY [*] OF INT; END_VAR VAR i : DINT; END_VAR
FOR i := LOWER_BOUND(v, 1) TO UPPER_BOUND(v, 1) DO Sum := Sum + v[i]; END_FOR END_FUNCTION
FUNCTION Fill VAR_IN_OUT v : ARRAY [*, *] OF INT; END_VAR VAR i, j : INT; END_VAR
FOR i := LOWER_BOUND(v, 1) TO UPPER_BOUND(v, 1) DO FOR j := LOWER_BOUND(v, 2) TO UPPER_BOUND(v, 2) DO
v[i, j] := 10 * i + j; END_FOR END_FOR END_FUNCTION
FUNCTION Outer : DINT VAR_IN_OUT v : ARRAY [*] OF INT; END_VAR v[UPPER_BOUND(v, 1)] := 100; Outer := Sum(v); END_FUNCTION
FUNCTION_BLOCK Last VAR_IN_OUT p : ARRAY [*] OF Pair; END_VAR VAR_OUTPUT a : INT; n : DINT; END_VAR
n := UPPER_BOUND(p, 1) - LOWER_BOUND(p, 1) + 1; a := p[UPPER_BOUND(p, 1)].b; p[0].a := p[0].a + 1; END_FUNCTION_BLOCK
)";

TEST(StOpenArrays, AreOfAnyLength) {
  Bench bench(std::string(units) + R"(PROGRAM p
VAR a : ARRAY [-1..2] OF INT := [1, 2, 3, 4]; b : ARRAY [5..5] OF INT := [9]; m : ARRAY [1..2, 0..2] OF INT;
  few : ARRAY [0..1] OF Pair; many : ARRAY [-2..0] OF Pair; l : Last; s, t, u, n1, n2 : DINT; b1 : INT; END_VAR
s := Sum(a); t := Sum(v := b); Fill(m); u := Outer(a);
few[1].b := 7; l(p := few); n1 := l.n; b1 := l.a; l(p := many); n2 := l.n;
END_PROGRAM)");
  bench.scan();
  bench.expect({{"s", 10},
                {"t", 9},
                {"m[1][0]", 10},
                {"m[1][2]", 12},
                {"m[2][1]", 21},
                {"u", 106},
                {"a[2]", 100},
                {"n1", 2},
                {"b1", 7},
                {"n2", 3},
                {"few[0].a", 1},
                {"many[0].a", 1}});
  expect_values("INT", {{"LOWER_BOUND(a, 1)", 3}, {"UPPER_BOUND(ARR := a, DIM := 2)", 9}},
                "a : ARRAY [3..4, 7..9] OF BOOL;");
}

TEST(StOpenArrays, KeepTheirBounds) {
  const auto fault = fault_in_first_scan(
      std::string(units) +
      "FUNCTION Get : INT VAR_INPUT v : ARRAY [*] OF INT; i : INT; END_VAR\nGet := v[i]; END_FUNCTION "
      "PROGRAM p VAR a : ARRAY [1..3] OF INT; x : INT; END_VAR x := Get(a, 4); END_PROGRAM");
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->text, "the index 4 is out of bounds; 1 to 3");
}

TEST(StOpenArrays, AreRefusedWhereTheyHaveNoLength) {
  const auto told = [](const std::string& declarations, const std::string& statements) {
    return problems_of(
        "FUNCTION g : INT VAR_IN_OUT v : ARRAY [*] OF INT; END_VAR END_FUNCTION PROGRAM p VAR x : INT; r : "
        "ARRAY [0..1] OF REAL;\n" +
        declarations + " END_VAR\n" + statements + "\nEND_PROGRAM");
  };
  EXPECT_THAT(told("a : ARRAY [*] OF INT;", ""),
              ElementsAre(StartsWith("2:1: the ARRAY [*] OF INT 'a' in VAR has no length")));
  EXPECT_THAT(told("a : REF_TO ARRAY [*] OF INT;", ""),
              ElementsAre(StartsWith("2:12: ARRAY [*] OF INT has no length here")));
  EXPECT_THAT(told("a : ARRAY [0..1] OF ARRAY [*] OF INT;", "").size(), 1);
  EXPECT_THAT(told("", "x := g(r);"),
              ElementsAre(StartsWith("3:8: 'r' is ARRAY [0..1] OF REAL, not ARRAY [*] OF INT")));
  EXPECT_THAT(told("", "x := UPPER_BOUND(x, 1);"),
              ElementsAre(StartsWith("3:18: UPPER_BOUND of INT; only an ARRAY has bounds")));
  EXPECT_THAT(told("", "x := UPPER_BOUND(r, 2);"),
              ElementsAre(StartsWith("3:21: 'r' has no such dimension; a constant, 1 to 1")));
  EXPECT_THAT(
      problems_of("FUNCTION f : INT VAR_INPUT a, b : ARRAY [*] OF INT; END_VAR\na[0] := 1;\na := b;\nf := "
                  "a[1, 2];\nf := SIZEOF(a);\nEND_FUNCTION PROGRAM p END_PROGRAM"),
      ElementsAre(StartsWith("2:1: 'a' is an input without a copy of its own"), StartsWith("3:1: 'a'"),
                  StartsWith("4:"), StartsWith("5:13: SIZEOF of ARRAY [*] OF INT")));
}

TEST(StFunctions, FloorAndCeil) {
  expect_values("DINT", {{"FLOOR(-1.5)", -2}, {"CEIL(-1.5)", -1}, {"FLOOR(2.0)", 2}, {"CEIL(0.1)", 1}});
  expect_values("LREAL", {{"FLOOR(r)", 3e12}, {"CEIL(1.5) / 4", 0.5}}, "r : LREAL := 3000000000000.7;");
  EXPECT_THAT(problems_of("PROGRAM p VAR i : INT; END_VAR\ni := FLOOR(i);\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:12: FLOOR does not take INT; it takes REAL and LREAL")));
  // A user's own stands instead.
  EXPECT_EQ(run("x : INT;", "x := CEIL(5);",
                "FUNCTION CEIL : INT VAR_INPUT i : INT; END_VAR CEIL := i + 1; END_FUNCTION"),
            6);
}

TEST(StFunctions, ValidBytesAndDigits) {
  expect_values("BOOL",
                {{"IS_VALID(1.0)", 1},
                 {"IS_VALID(r * 10.0)", 0},
                 {"IS_VALID(r * 10.0 - r * 10.0)", 0},
                 {"IS_VALID_BCD(WORD#16#9870)", 1},
                 {"IS_VALID_BCD(w)", 0},
                 {"IS_VALID_BCD(LWORD#16#A000000000000000)", 0}},
                "r : REAL := 3E38; w : WORD := 16#00A0;");
  expect_values("UDINT",
                {{"WORD_TO_UDINT(TO_BIG_ENDIAN(WORD#16#1234))", 0x3412},
                 {"TO_BIG_ENDIAN(UDINT#16#12345678)", 0x78563412},
                 {"FROM_BIG_ENDIAN(TO_BIG_ENDIAN(n))", 70000},
                 {"TO_LITTLE_ENDIAN(n)", 70000},
                 {"FROM_LITTLE_ENDIAN(n)", 70000},
                 {"USINT_TO_UDINT(TO_BIG_ENDIAN(USINT#5))", 5},
                 {"BCD_TO_UINT(WORD#16#1234)", 1234},
                 {"DWORD_TO_UDINT(TO_BCD_DWORD(n))", 0x70000},
                 {"BYTE_TO_UDINT(TO_BCD_BYTE(42))", 0x42}},
                "n : UDINT := 70000;");
  EXPECT_EQ(value_of("INT", "TO_BIG_ENDIAN(INT#255)"), -256);
  for (const char* call : {"TO_BIG_ENDIAN(1.5)", "IS_VALID(1)", "IS_VALID_BCD(i)"})
    EXPECT_THAT(
        problems_of("PROGRAM p VAR i : INT; x : BOOL; END_VAR x := " + std::string(call) + "; END_PROGRAM")
            .size(),
        1)
        << call;
}

TEST(StMessages, SayWhatWouldBeRight) {
  const auto told = [](const std::string& statement) {
    return problems_of("PROGRAM p VAR d : DINT; i : INT; END_VAR\n" + statement + "\nEND_PROGRAM");
  };
  EXPECT_THAT(
      told("d := 2**3;"),
      ElementsAre(StartsWith(
          "2:7: 8 is an LREAL here, which does not go into DINT by itself; LREAL_TO_DINT(...) converts")));
  EXPECT_THAT(told("(d, i) := f(1);"),
              ElementsAre(StartsWith("2:1: no dialect assigns several variables at once")));
  EXPECT_THAT(told("IF d > 0 THEN d := 1; ENDIF"), ElementsAre(HasSubstr("did you mean 'END_IF'?")));
}

TEST(StMessages, LoopsThatWrapAreNoted) {
  const auto notes = [](const std::string& loop) {
    return Bench("PROGRAM p VAR i : SINT; u : USINT; n : SINT; END_VAR\n" + loop +
                 " DO n := n + 1; EXIT; END_FOR\nEND_PROGRAM")
        .doubts;
  };
  EXPECT_THAT(notes("FOR i := 0 TO 127"),
              ElementsAre(StartsWith("2:5: FOR counts i, which is SINT, to 127: behind it comes -128")));
  EXPECT_THAT(notes("FOR i := 0 TO 126 BY 3"),
              ElementsAre(StartsWith("2:5: FOR counts i, which is SINT, to 126: behind it comes -127")));
  EXPECT_THAT(notes("FOR u := 9 TO 255"), ElementsAre(HasSubstr("behind it comes 0")));
  EXPECT_THAT(notes("FOR i := 5 TO -128 BY -1"), ElementsAre(HasSubstr("behind it comes 127")));
  for (const char* loop : {"FOR i := 0 TO 127 BY 2", "FOR i := 5 TO 127 BY 10"})
    EXPECT_THAT(notes(loop), testing::SizeIs(1)) << loop;
  for (const char* loop : {"FOR i := 0 TO 126", "FOR u := 0 TO 254", "FOR i := n TO 127 BY 5"})
    EXPECT_THAT(notes(loop), IsEmpty()) << loop;
}

TEST(StMessages, NameAndThenWhereTheRightSideCounts) {
  const auto fault = [](const std::string& condition) {
    const auto found = fault_in_first_scan(
        "PROGRAM p VAR n : INT := 8; z : INT; a : ARRAY [0..7] OF INT; b : BOOL; q : REF_TO INT; END_VAR b "
        ":= " +
        condition + "; END_PROGRAM");
    return found ? found->text : "";
  };
  const std::string hint =
      " (AND and OR take both sides; AND_THEN and OR_ELSE the right one only where it counts)";
  EXPECT_EQ(fault("n < 8 AND a[n] > 0"), "the index 8 is out of bounds; 0 to 7" + hint);
  EXPECT_THAT(fault("z = 0 OR n / z > 1"), testing::EndsWith(hint));
  EXPECT_THAT(fault("q <> NULL & q^ > 1"), testing::EndsWith(hint));
  EXPECT_EQ(fault("a[n] > 0 AND n < 8"), "the index 8 is out of bounds; 0 to 7");
  EXPECT_EQ(fault("n < 8 AND_THEN a[n] > 0"), "");
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
