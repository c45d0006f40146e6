// What ordinary programs contain beside the plainest: literals in their context, operators as functions, EN
// and ENO, texts, dates, 64 bits, single bits, ranges, blocks in structures, constants as bounds.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// The text of a STRING expression, by its characters' comparison.
void expect_text(const std::string& expression, const std::string& wanted, const std::string& vars = "") {
  EXPECT_EQ(run("x : BOOL; " + vars, "x := (" + expression + ") = '" + wanted + "';"), 1)
      << expression << " is not '" << wanted << "'";
}

TEST(StLanguage, LiteralsTakeTheTypeThatTheContextWants) {
  EXPECT_EQ(value_of("REAL", "i * 1.5", "i : INT := 3;"), 4.5);
  EXPECT_EQ(value_of("REAL", "0.1 * (i + 1.5) / 2 - j ** 2", "i : INT := 3; j : SINT := 2;"),
            static_cast<double>(0.1F * 4.5F / 2 - 4));
  EXPECT_EQ(value_of("REAL", "MAX(SQRT(i), i * 0.25) + SEL(TRUE, 1.5, i)", "i : INT := 4;"), 6);
  EXPECT_EQ(value_of("REAL", "ABS(-i / 4.0)", "i : INT := 3;"), 0.75);
  EXPECT_EQ(value_of("LREAL", "i * 0.1", "i : INT := 1;"), 0.1) << "not by way of a REAL";
  EXPECT_EQ(value_of("WORD", "NOT 16#0F"), 0xFFF0);
  EXPECT_EQ(value_of("BYTE", "SHL(16#81, 1) OR 1"), 3);
  EXPECT_EQ(run("x : REAL; i : INT := 3;", "x := Half(i * 1.5);",
                "FUNCTION Half : REAL VAR_INPUT v : REAL; END_VAR Half := v / 2; END_FUNCTION "),
            2.25);
  EXPECT_EQ(run("x : INT; s : S2;",
                "s := B; IF s = B THEN x := 1; END_IF CASE s OF A: x := 9; B: x := x + 1; END_CASE",
                "TYPE S1 : (A, B); S2 : (B, A); END_TYPE "),
            2)
      << "a name of two enumerations is that of the variable's";
}

TEST(StLanguage, ALrealVariableIsNotMadeARealByItsContext) {
  expect_problems(
      "PROGRAM p VAR r : REAL; i : INT; d : DINT; l : LREAL; END_VAR\nr := i * l;\nr := d * 1.5;\n"
      "END_PROGRAM",
      {"2:8: a value of type LREAL does not go into REAL by itself",
       "3:8: a value of type LREAL does not go into REAL by itself"});
}

TEST(StLanguage, OperatorsAreFunctions) {
  const std::string v =
      "a : INT := 12; b : INT := 10; c : INT := 3; p : BOOL := TRUE; q : BOOL; w : WORD := 16#F0;";
  expect_values("LREAL",
                {{"ADD(a, b, c, 1)", 26},
                 {"SUB(a, b)", 2},
                 {"MUL(a, b, c)", 360},
                 {"DIV(a, 5)", 2},
                 {"MOD(a, 5)", 2},
                 {"a MOD 5", 2},
                 {"EXPT(c, 2)", 9},
                 {"MOVE(a)", 12},
                 {"MOVE(a + 1)", 13},
                 {"SEL(p, a, b)", 10},
                 {"MUX(1, a, b, c)", 10},
                 {"LIMIT(0, a, 5)", 5},
                 {"MIN(a, b, c)", 3},
                 {"MAX(a, b, c)", 12},
                 {"ABS(-a)", 12}},
                v);
  expect_values("BOOL",
                {{"AND(p, q)", 0},
                 {"AND(p, p, p)", 1},
                 {"OR(q, p) AND p", 1},
                 {"XOR(p, p, p)", 1},
                 {"NOT(q)", 1},
                 {"NOT(IN := q) AND p", 1},
                 {"NOT(q) AND q", 0},
                 {"GT(a, b)", 1},
                 {"GT(a, b, c)", 1},
                 {"GT(a, c, b)", 0},
                 {"GE(a, a, c)", 1},
                 {"EQ(a, 12)", 1},
                 {"LE(c, b, a)", 1},
                 {"LT(a, a)", 0},
                 {"NE(a, b)", 1},
                 {"EQ('ab', 'ab')", 1}},
                v);
  EXPECT_EQ(value_of("WORD", "AND(w, 16#30)", v), 0x30);
  EXPECT_EQ(value_of("TIME", "ADD_TIME(T#1s, MULTIME(T#2s, 1.5))"), 4);
}

TEST(StLanguage, InputsOfStandardFunctionsHaveNames) {
  const std::string v = "a : INT := 12; b : INT := 10; w : WORD := 16#81;";
  expect_values("LREAL",
                {{"SUB(IN2 := a, IN1 := b)", -2},
                 {"ADD(IN1 := a, IN2 := b, IN3 := 1)", 23},
                 {"SEL(IN1 := 7, G := TRUE, IN0 := 3)", 7},
                 {"MUX(K := 1, IN0 := 5, IN1 := 6)", 6},
                 {"LIMIT(MX := 5, IN := a, MN := 0)", 5},
                 {"LIMIT(Min := 0, IN := a, Max := 5)", 5},
                 {"SHL(IN := w, N := 1)", 0x102},
                 {"ABS(IN := -5)", 5},
                 {"FIND(STR1 := 'abc', STR2 := 'c')", 3},
                 {"MOVE(IN := a)", 12}},
                v);
}

TEST(StLanguage, EnAndEnoOfFunctionsAndBlocks) {
  const std::string units =
      "VAR_GLOBAL calls : INT; END_VAR FUNCTION F : INT VAR_INPUT a : INT; END_VAR calls := calls + 1; F := "
      "2 * a; "
      "END_FUNCTION FUNCTION T : STRING VAR_INPUT a : INT; END_VAR T := INT_TO_STRING(a); END_FUNCTION "
      "FUNCTION_BLOCK C VAR_INPUT step : INT; END_VAR VAR_OUTPUT n : INT; END_VAR n := n + step; "
      "END_FUNCTION_BLOCK ";
  Bench bench(
      units +
      "PROGRAM p VAR on, ok, ok2, ok3, none : BOOL; x, y, z : INT; s : STRING; c : C; empty : BOOL; END_VAR "
      "x := F(EN := on, a := 4, ENO => ok); y := ADD(EN := on, IN1 := 3, IN2 := 4, ENO => ok2); "
      "z := MUL(z, 1, ENO => none); c(EN := on, step := 2, ENO => ok3); "
      "s := T(EN := on, a := 7); empty := s = ''; END_PROGRAM");
  bench.scan(2);
  for (const char* name : {"x", "y", "c.n", "calls", "ok", "ok2", "ok3"}) EXPECT_EQ(bench[name], 0) << name;
  bench.expect({{"none", 1}, {"empty", 1}});
  bench.set("on", 1);
  bench.scan(3);
  bench.expect({{"x", 8}, {"y", 7}, {"c.n", 6}, {"calls", 3}});
  for (const char* name : {"ok", "ok2", "ok3"}) EXPECT_EQ(bench[name], 1) << name;
  EXPECT_EQ(bench["empty"], 0);
  bench.set("on", 0);
  bench.scan();
  EXPECT_EQ(bench["x"], 0);
  EXPECT_EQ(bench["c.n"], 6) << "a block that is not enabled keeps its outputs";
  EXPECT_EQ(bench["ok3"], 0);
}

TEST(StLanguage, InputsAreAssignedInsideAFunction) {
  EXPECT_EQ(
      run("x : INT; n : INT := 5;", "x := F(n) * 100 + n;",
          "FUNCTION F : INT VAR_INPUT a : INT; END_VAR IF a > 3 THEN a := 3; END_IF F := a; END_FUNCTION "),
      305);
  EXPECT_THAT(
      problems_of(
          "FUNCTION_BLOCK B VAR_INPUT a : INT; END_VAR\na := 3;\nEND_FUNCTION_BLOCK PROGRAM p END_PROGRAM"),
      testing::IsEmpty())
      << "CODESYS takes it: a note, see doubts_test.cpp";
}

TEST(StLanguage, BlocksHaveThePinsOfIecBesideThoseOfCodesys) {
  Bench bench(
      "PROGRAM p VAR up, res : BOOL; a, a2 : SR; b, b2 : RS; c : CTU; d : CTD; e : CTUD; f : SR := (S1 := "
      "TRUE); END_VAR "
      "a(S1 := up, R := res); a2(SET1 := up, RESET := res); b(S := up, R1 := res); b2(SET := up, RESET1 := "
      "res); "
      "c(CU := up, R := res, PV := 1); d(CD := up, LD := res, PV := 3); e(CU := up, CD := FALSE, R := res, "
      "LD := FALSE, PV := 1); "
      "END_PROGRAM");
  bench.set("up", 1);
  bench.scan();
  for (const char* name : {"a.Q1", "a2.Q1", "b.Q1", "b2.Q1", "c.Q", "e.QU"})
    EXPECT_EQ(bench[name], 1) << name;
  bench.set("up", 0);
  bench.set("res", 1);
  bench.scan();
  for (const char* name : {"a.Q1", "a2.Q1", "b.Q1", "b2.Q1", "c.CV", "e.CV"})
    EXPECT_EQ(bench[name], 0) << name;
  bench.expect({{"d.CV", 3}, {"f.SET1", 1}});
}

TEST(StLanguage, ConstantsAreBoundsInTypes) {
  const std::string units =
      "TYPE A : ARRAY [0..n - 1] OF INT; P : INT (low..n); S : STRUCT s : STRING[n]; v : ARRAY [low..n] OF "
      "LREAL; END_STRUCT; "
      "E : (first, last := 7); END_TYPE VAR_GLOBAL CONSTANT n : INT := 4; low : INT := -1; e : INT := "
      "E#last; END_VAR ";
  EXPECT_EQ(run("x : INT; a : A; s : S;",
                "a[n - 1] := 5; s.v[low] := 2; s.v[n] := 3; x := a[3] + LREAL_TO_INT(s.v[-1]) + e;", units),
            5 + 2 + 7);
  expect_problems(units + "PROGRAM m VAR a : A; v : P; END_VAR\na[n] := 1;\nv := 5;\nEND_PROGRAM",
                  {"2:3: the index 4 is out of the bounds of 'a'; 0 to 3 [st.out-of-range]",
                   "3:6: the constant 5 is out of the range of INT (-1..4); -1 to 4$"});
}

TEST(StLanguage, RangesAreKept) {
  Bench bench(
      "TYPE P : INT (1..9); END_TYPE PROGRAM m VAR v : P; w : P := 3; i, k, sum : INT; END_VAR "
      "i := w + 20; FOR w := 1 TO 9 DO sum := sum + 1; END_FOR w := 4; IF k > 0 THEN v := k; END_IF "
      "END_PROGRAM");
  bench.scan();
  EXPECT_EQ(bench["v"], 1) << "it begins at the lower bound";
  bench.expect({{"i", 23}, {"sum", 9}});
  bench.set("w", 100);
  EXPECT_EQ(bench["w"], 9) << "from outside too";
  bench.set("k", 10);
  bench.runtime->scan(bench.time_ns);
  ASSERT_TRUE(bench.runtime->fault());
  EXPECT_EQ(bench.runtime->fault()->text, "10 is out of the range; 1 to 9");
}

TEST(StLanguage, FunctionBlocksStandInStructures) {
  Bench bench(
      "TYPE Station : STRUCT power : MC_Power; delay : TON; done : BOOL; END_STRUCT; Line : ARRAY [1..2] OF "
      "Station; END_TYPE "
      "PROGRAM p VAR_EXTERNAL Knife : AXIS_REF; END_VAR VAR line : Line; one : Station; END_VAR "
      "one.power(Axis := Knife, Enable := TRUE); line[2].delay(IN := one.power.Status, PT := T#4ms); "
      "line[2].done := line[2].delay.Q; END_PROGRAM");
  bench.scan(2);
  EXPECT_EQ(bench["line[2].done"], 0);
  bench.scan(5);
  bench.expect({{"one.power.Status", 1}, {"line[2].done", 1}, {"line[1].delay.Q", 0}});
  expect_problems(
      "TYPE S : STRUCT t : TON; END_STRUCT; END_TYPE PROGRAM p VAR a, b : S; END_VAR\na := "
      "b;\nEND_PROGRAM",
      {"2:1: 'a' is S and is not assigned; it holds function blocks: assign its other members$"});
}

TEST(StLanguage, TextsByTheirFunctions) {
  expect_text("LEFT('astr', 3)", "ast");
  expect_text("LEFT('astr', 9)", "astr");
  expect_text("LEFT('astr', 0)", "");
  expect_text("RIGHT('astr', 3)", "str");
  expect_text("MID('astr', 2, 2)", "st");
  expect_text("MID('astr', 9, 3)", "tr");
  expect_text("CONCAT('AB', 'CD', 'E')", "ABCDE");
  expect_text("INSERT('ABC', 'XY', 2)", "ABXYC");
  expect_text("INSERT('ABC', 'XY', 0)", "XYABC");
  expect_text("DELETE('ABXYC', 2, 3)", "ABC");
  expect_text("REPLACE('ABCDE', 'X', 2, 3)", "ABXE");
  expect_values("INT", {{"LEN('ASTRING')", 7}, {"FIND('ABCBC', 'BC')", 2}, {"FIND('ABC', 'X')", 0}});
}

TEST(StLanguage, TextsGrowInPlaceAndAreCutAtTheirEnd) {
  EXPECT_EQ(run("x : BOOL; s : STRING := 'ab'; i : INT;",
                "FOR i := 1 TO 5 DO s := CONCAT(s, MID(s, 1, i)); END_FOR x := s = 'abababa';"),
            1);
  EXPECT_EQ(run("x : INT; s : STRING[255]; i : INT;",
                "FOR i := 1 TO 300 DO s := CONCAT(s, 'x'); END_FOR x := LEN(s);"),
            255);
  EXPECT_EQ(run("x : INT; s : STRING[5]; i : INT;",
                "FOR i := 1 TO 300 DO s := CONCAT(s, 'x'); END_FOR x := LEN(s);"),
            5);
  expect_text("SEL(b, 'off', 'on')", "on", "b : BOOL := TRUE;");
  expect_text("MUX(i, 'a', 'bcd')", "bcd", "i : INT := 1;");
}

TEST(StLanguage, NumbersAndTimesBecomeTextsAndBack) {
  expect_text("INT_TO_STRING(i)", "-12", "i : INT := -12;");
  expect_text("REAL_TO_STRING(r)", "1.5", "r : REAL := 1.5;");
  expect_text("LREAL_TO_STRING(r)", "0.1", "r : LREAL := 0.1;");
  expect_text("BOOL_TO_STRING(b)", "TRUE", "b : BOOL := TRUE;");
  expect_text("TO_STRING(t)", "T#1m2s30ms", "t : TIME := T#62s30ms;");
  expect_text("TIME_TO_STRING(t)", "T#0ms", "t : TIME;");
  expect_text("DATE_TO_STRING(d)", "D#2024-02-29", "d : DATE := D#2024-2-29;");
  expect_text("TOD_TO_STRING(d)", "TOD#06:07:08.090", "d : TOD := TOD#6:7:8.09;");
  expect_text("DT_TO_STRING(d)", "DT#1996-08-15-15:36:55", "d : DT := DT#1996-08-15-15:36:55;");
  expect_text("ULINT_TO_STRING(u)", "18446744073709551615", "u : ULINT := 16#FFFF_FFFF_FFFF_FFFF;");
  expect_values("INT", {{"STRING_TO_INT('-34 mm')", -34}, {"STRING_TO_INT('mm')", 0}});
  EXPECT_EQ(value_of("LREAL", "STRING_TO_LREAL('2.5E1')"), 25);
  EXPECT_EQ(value_of("BOOL", "STRING_TO_BOOL('true')"), 1);
  EXPECT_EQ(value_of("TIME", "STRING_TO_TIME('T#1s5ms')"), 1.005);
  EXPECT_EQ(value_of("TOD", "STRING_TO_TOD('TOD#01:00:00')"), 3600);
}

TEST(StLanguage, FunctionsGiveTextsAndStructures) {
  const std::string units =
      "TYPE P : STRUCT u : INT; v : INT; END_STRUCT; END_TYPE "
      "FUNCTION Name : STRING[20] VAR_INPUT n : INT; END_VAR Name := CONCAT('piece ', INT_TO_STRING(n)); "
      "END_FUNCTION "
      "FUNCTION Both : P VAR_INPUT u, v : INT; END_VAR Both.u := u; Both.v := v; END_FUNCTION ";
  EXPECT_EQ(run("x : BOOL;", "x := CONCAT(Name(1), Name(23)) = 'piece 1piece 23';", units), 1)
      << "the second call does not spoil what the first one gave";
  EXPECT_EQ(run("x : INT; a, b : P;",
                "a := Both(1, 2); b := Both(v := 30, u := a.v); x := a.u * 100 + b.u * 10 + b.v;",
                "TYPE P : STRUCT u : INT; v : INT; END_STRUCT; END_TYPE FUNCTION Both : P VAR_INPUT u, v : "
                "INT; END_VAR Both.u := u; "
                "Both.v := v; END_FUNCTION "),
            150);
}

TEST(StLanguage, DatesAreReckoned) {
  expect_values("DATE", {{"D#1970-01-02", 86400}, {"DATE#2000-03-01", 951868800}});
  EXPECT_EQ(value_of("DT", "DATE_AND_TIME#2000-03-01-01:00:00"), 951868800 + 3600);
  EXPECT_EQ(value_of("TOD", "TIME_OF_DAY#23:59:59.5"), 86399.5);
  EXPECT_EQ(value_of("TOD", "t + T#2h", "t : TOD := TOD#23:00:00;"), 3600) << "the clock begins anew";
  EXPECT_EQ(value_of("TOD", "t - T#2h", "t : TOD := TOD#01:00:00;"), 23 * 3600);
  EXPECT_EQ(value_of("TIME", "t - TOD#01:00:00", "t : TOD := TOD#02:30:00;"), 5400);
  EXPECT_EQ(value_of("DT", "t + T#1d2s", "t : DT := DT#2024-02-28-00:00:00;"), 1709164800 + 2);
  EXPECT_EQ(value_of("TIME", "SUB_DATE_DATE(D#2024-03-01, d)", "d : DATE := D#2024-02-28;"), 2 * 86400);
  EXPECT_EQ(value_of("TOD", "DT_TO_TOD(d)", "d : DT := DT#2024-02-28-06:00:01;"), 6 * 3600 + 1);
  EXPECT_EQ(value_of("DATE", "DT_TO_DATE(d)", "d : DT := DT#1970-01-03-06:00:01;"), 2 * 86400);
  EXPECT_EQ(value_of("DT", "CONCAT_DATE_TOD(D#1970-01-02, t)", "t : TOD := TOD#00:00:05;"), 86405);
  EXPECT_EQ(value_of("BOOL", "d > D#2000-01-01", "d : DATE := D#2024-01-01;"), 1);
}

TEST(StLanguage, SixtyFourBitsWithoutASign) {
  const std::string v =
      "u : ULINT := 16#FFFF_FFFF_FFFF_FFFF; one : ULINT := 1; w : LWORD := 16#8000_0000_0000_0001;";
  EXPECT_EQ(value_of("ULINT", "u", v), 18446744073709551615.0);
  EXPECT_EQ(value_of("BOOL", "u > one AND one < u AND NOT (u <= one) AND u >= u", v), 1);
  expect_values(
      "ULINT",
      {{"u + 1", 0}, {"u / 16#8000_0000_0000_0000 + u MOD 10", 6}, {"MAX(one, u)", 18446744073709551615.0}},
      v);
  EXPECT_EQ(value_of("LREAL", "ULINT_TO_LREAL(u)", v), 18446744073709551616.0);
  EXPECT_EQ(value_of("ULINT", "LREAL_TO_ULINT(1.0E19)"), 1e19);
  EXPECT_EQ(value_of("LWORD", "SHR(w, 63) OR ROL(w, 1)", v), 3);
  EXPECT_EQ(value_of("BOOL", "w.63 AND w.0 AND NOT w.1", v), 1);
  EXPECT_EQ(value_of("ULINT", "i", "i : UDINT := 5;"), 5);
  EXPECT_EQ(run("x : INT; k : ULINT;",
                "FOR k := 16#FFFF_FFFF_FFFF_FFF0 TO 16#FFFF_FFFF_FFFF_FFF4 DO x := x + 1; END_FOR"),
            5);
  Bench bench("PROGRAM p VAR u : ULINT; END_VAR END_PROGRAM");
  bench.set("u", 1e19);
  EXPECT_EQ(bench["u"], 1e19);
  bench.set("u", 1e30);
  EXPECT_EQ(bench["u"], 18446744073709551615.0);
}

TEST(StLanguage, SingleBitsAreReadAndWritten) {
  EXPECT_EQ(run("x : WORD; b : BOOL := TRUE;", "x.0 := b; x.15 := x.0; x.%X3 := TRUE; x.0 := FALSE;"),
            0x8008);
  EXPECT_EQ(run("x : DWORD;", "x.%B1 := 16#AB; x.%W1 := 16#1234;"), 0x1234AB00);
  EXPECT_EQ(run("x : INT;", "x.15 := TRUE;"), -32768);
  EXPECT_EQ(run("x : BYTE; w : ARRAY [0..1] OF WORD := [0, 16#0400]; i : INT := 1;",
                "x.7 := w[i].10; w[i].0 := x.7; x.%X0 := w[1].0;"),
            0x81);
  EXPECT_EQ(run("x : BOOL; t : TON; s : W; k : INT := 3;",
                "s.w.4 := TRUE; t(IN := s.w.4, PT := T#1s, Q => s.w.4); x := NOT s.w.4 AND k.0;",
                "TYPE W : STRUCT w : WORD; END_STRUCT; END_TYPE "),
            1);
  expect_problems(
      "FUNCTION F : BOOL VAR_IN_OUT b : BOOL; END_VAR END_FUNCTION PROGRAM p VAR w : WORD; END_VAR\n"
      "F(b := w.3);\nEND_PROGRAM",
      {"2:8: 'b' takes a variable"});
}

TEST(StPragmas, DecideWhatIsCompiled) {
  const auto x = [](const std::string& text) { return run("x : INT;", text); };
  EXPECT_EQ(x("{IF defined(FAST)} x := 1; {ELSE} x := 2; {END_IF}"), 2);
  EXPECT_EQ(x("{define FAST} {IF defined(FAST)} x := 1; {ELSE} x := 2; {END_IF}"), 1);
  EXPECT_EQ(x("{define FAST} {undefine fast} {IF defined (FAST)} x := 1; {ELSE} x := 2; {END_IF}"), 2);
  EXPECT_EQ(x("{define K 'b'} {IF hasvalue(K, 'a')} x := 1; {ELSIF hasvalue(K, 'b')} x := 2; {ELSIF "
              "defined(K)} x := 3; "
              "{ELSE} x := 4; {END_IF}"),
            2);
  EXPECT_EQ(
      x("{define A} {IF NOT (defined(A) AND defined(B)) OR defined(C)} x := 1; {ELSE} x := 2; {END_IF}"), 1);
  EXPECT_EQ(x("x := 1; {IF defined(A)} {IF defined(B)} x := 2; {ELSE} x := 3; {END_IF} {define C} this is "
              "'no } text $' (* {END_IF} *) "
              "\n{END_IF} {IF defined(C)} x := 4; {END_IF}"),
            1);
  EXPECT_EQ(x("{attribute 'qualified_only'} {region 'a'} x := 5; {endregion} {IF defined(A)} {error 'no'} "
              "{END_IF}"),
            5);
}

TEST(StPragmas, AreRefusedWhereTheyAreNotKnown) {
  expect_problems(
      "PROGRAM p\n{IF hasattribute(pou: X, 'a')} x := ; {ELSE} {END_IF}\n{ELSE}\n{END_IF}\n"
      "{IF defined(A)}\n{define}\n{error 'off'} {END_IF} {error 'wrong "
      "target'}\nEND_PROGRAM\n{IF NOT defined(A)}",
      {"2:1: the condition '{IF hasattribute(pou: X, 'a')}' is not known here; defined(NAME)",
       "3:1: {ELSE} without an {IF}; {IF condition} opens it$",
       "4:1: {END_IF} without an {IF}; {IF condition} opens it$", "7:24: the program says: 'wrong target'",
       "9:1: {IF} has no {END_IF}"});
}

constexpr const char* two_programs = R"(PROGRAM Fast
VAR_INPUT step : INT := 1; END_VAR VAR_OUTPUT n : INT; END_VAR
n := n + step; total := total * 10 + 1;
END_PROGRAM
PROGRAM Slow
VAR n : INT; END_VAR
n := n + 1; total := total * 10 + 2;
END_PROGRAM
)";

TEST(StTasks, AConfigurationSaysWhatRunsWhen) {
  Bench bench(std::string(two_programs) + R"(
CONFIGURATION Plant
VAR_GLOBAL total : LINT; seen : INT; go : BOOL; END_VAR
VAR_GLOBAL CONSTANT two : INT := 2; END_VAR
RESOURCE Cpu ON PLC
  TASK quick(INTERVAL := T#4ms, PRIORITY := 1);
  TASK later(INTERVAL := T#8ms, PRIORITY := 5);
  TASK event(SINGLE := go, PRIORITY := 0);
  PROGRAM b WITH later : Slow;
  PROGRAM a WITH quick : Fast(step := two, n => seen);
  PROGRAM c WITH event : Fast;
END_RESOURCE
END_CONFIGURATION)");
  bench.scan();  // 0 ms
  EXPECT_EQ(bench["total"], 12) << "the lower number first";
  bench.scan(4);  // 2 to 8 ms
  bench.expect({{"total", 12112}, {"a.n", 6}, {"seen", 6}, {"b.n", 2}, {"c.n", 0}});
  bench.set("go", 1);
  bench.scan(2);
  EXPECT_EQ(bench["c.n"], 1) << "once an edge, with variables of its own";
  bench.set("go", 0);
  bench.scan();
  bench.set("go", 1);
  bench.scan();
  EXPECT_EQ(bench["c.n"], 2);
}

TEST(StTasks, WithoutAConfigurationEachProgramRunsUnderItsName) {
  Bench bench(std::string("VAR_GLOBAL total : LINT; END_VAR ") + two_programs);
  bench.scan(2);
  bench.expect({{"Fast.n", 2}, {"Slow.n", 2}, {"total", 1212}});
}

TEST(StTasks, FaultsOfAConfigurationAreTold) {
  expect_problems(
      "PROGRAM P VAR_INPUT v : INT; END_VAR VAR_IN_OUT w : INT; END_VAR END_PROGRAM "
      "PROGRAM Q VAR i AT %IX0.0 : BOOL; END_VAR END_PROGRAM\n"
      "CONFIGURATION C VAR_GLOBAL g : INT; END_VAR\n"
      "TASK a(PRIORITY := 1);\n"
      "TASK b(INTERVALL := T#1s);\n"
      "TASK c(SINGLE := g, PRIORITY := 1);\n"
      "TASK a(INTERVAL := T#1s);\n"
      "PROGRAM p WITH aa : P(v := g, w := g);\n"
      "PROGRAM p WITH a : PP;\n"
      "PROGRAM r WITH a : P;\n"
      "PROGRAM g : P(v := TRUE, w := g);\n"
      "PROGRAM q1 : Q; PROGRAM q2 : Q; PROGRAM RETAIN q3 : P;\n"
      "VAR_ACCESS END_VAR\n"
      "nonsense;\n"
      "END_CONFIGURATION",
      {"1:92: 'i' is in 2 programs at one terminal; declare it in VAR_GLOBAL",
       "3:6: the task 'a' never runs; INTERVAL := T#10ms, or SINGLE",
       "4:8: a task has no 'INTERVALL'; INTERVAL, PRIORITY or SINGLE",
       "5:18: SINGLE is no BOOL of VAR_GLOBAL", "6:6: 'a' is declared twice; the first one is in line 3",
       "7:16: there is no task 'aa'; did you mean 'a'?", "8:20: there is no PROGRAM 'PP'; did you mean 'P'?",
       "9:9: w is not connected in the call of 'r'", "10:9: 'g' is declared twice",
       "10:20: a value of type BOOL does not go into INT by itself",
       "11:41: RETAIN of a whole program; VAR RETAIN", "12:1: VAR_ACCESS is not known here",
       "13:1: 'nonsense' stands in the CONFIGURATION"});
}

TEST(StMemory, VariablesHaveTheirPlacesByTheNamesThatPeopleGiveThem) {
  Problems problems;
  const auto program = compile(
      "VAR_GLOBAL g AT %MD6 : REAL; END_VAR\n"
      "PROGRAM P VAR a AT %MW5 : ARRAY [-1..2] OF WORD; END_VAR END_PROGRAM\n"
      "PROGRAM Q VAR b AT %MX0.7 : BOOL; c AT %ML9 : LREAL; END_VAR END_PROGRAM\n"
      "PROGRAM R VAR d AT %MW100 : INT; END_VAR END_PROGRAM\n"
      "CONFIGURATION C TASK t(INTERVAL := T#1ms); PROGRAM one WITH t : P; PROGRAM two WITH t : Q; "
      "END_CONFIGURATION\n",
      "memory.st", problems);
  EXPECT_EQ(problems.size(), 0U);
  std::string all;
  for (const auto& variable : program.in_memory())
    all += fmt::format("{} {}{} x{} {};", variable.name, plcopen::to_string(variable.place),
                       variable.low ? fmt::format(" from {}", *variable.low) : "", variable.count,
                       static_cast<int>(variable.format));
  EXPECT_EQ(all, "g %MD6 x1 5;one.a %MW5 from -1 x4 2;two.b %MX0.7 x1 0;two.c %ML9 x1 6;")
      << "R runs nowhere";
}

TEST(StMemory, TakesWhatFitsThePlaceAndEachPlaceOnce) {
  expect_problems(
      "PROGRAM P VAR\n"
      "a AT %MW3 : REAL;\n"
      "b AT %MX0.0 : INT;\n"
      "c AT %MD1 : INT;\n"
      "d AT %ML1 : LINT;\n"
      "e AT %MW0 : ARRAY [0..2, 0..2] OF INT;\n"
      "f AT %MW10 : ARRAY [1..4] OF INT;\n"
      "g AT %MD6 : DINT;\n"
      "h AT %MX10.0 : BOOL;\n"
      "i AT %MW65535 : ARRAY [0..1] OF INT;\n"
      "j, k AT %MW20 : INT;\n"
      "l AT %MB7 : BYTE;\n"
      "m AT %MW21 : TIME;\n"
      "END_VAR END_PROGRAM\n"
      "FUNCTION_BLOCK B VAR n AT %MW30 : INT; END_VAR END_FUNCTION_BLOCK\n"
      "PROGRAM Q VAR o AT %MW40 : INT; END_VAR END_PROGRAM\n"
      "CONFIGURATION C PROGRAM q1 : Q; PROGRAM q2 : Q; END_CONFIGURATION",
      {"2:1: 'a' at %MW3 is an INT, UINT or WORD, or an array of them, not REAL",
       "3:1: 'b' at %MX0.0 is a BOOL, or an array of them, not INT",
       "4:1: 'c' at %MD1 is a DINT, UDINT, DWORD or REAL, or an array of them, not INT",
       "5:1: 'd' at %ML1 is an LREAL, or an array of them, not LINT",
       "6:1: 'e' at %MW0 is an INT, UINT or WORD, or an array of them", "8:1: 'g' and 'f' share memory",
       "10:1: 'i' does not end within the memory", "11:4: two variables at one place",
       "12:6: '%MB7' is no memory that is known", "13:1: 'm' at %MW21 is an INT",
       "15:22: 'n' cannot have a place in memory here",
       "16:15: 'o' is in 2 programs at one place in memory; declare it in VAR_GLOBAL"});
}

TEST(StBudget, CountsWorkNotStatements) {
  // Fewer than 10000 statements each: what they do is too much.
  for (const auto& [line, text] : std::vector<std::pair<int, std::string>>{
           {2,
            "PROGRAM p VAR a, b : ARRAY [0..199999] OF LREAL; i : INT; END_VAR\nFOR i := 1 TO 5000 DO a := "
            "b; END_FOR\nEND_PROGRAM"},
           {3,
            "FUNCTION F : INT VAR a : ARRAY [0..199999] OF INT; END_VAR F := 1; END_FUNCTION PROGRAM p VAR i "
            ": INT; END_VAR\n"
            "FOR i := 1 TO 5000 DO\ni := i + F() - 1; END_FOR\nEND_PROGRAM"},
           {2,
            "PROGRAM p VAR s, t : STRING[255]; i, j : INT; x : DINT; END_VAR\nFOR i := 1 TO 255 DO s := "
            "CONCAT(s, 'x'); END_FOR "
            "FOR i := 0 TO 9000 DO "
            "x := FIND(s, 'y') + FIND(s, 'y') + FIND(s, 'y') + FIND(s, 'y') + FIND(s, 'y') + FIND(s, 'y'); "
            "END_FOR\nEND_PROGRAM"}}) {
    const auto fault = fault_in_first_scan(text);
    ASSERT_TRUE(fault) << text;
    EXPECT_EQ(fault->line, line) << text;
    EXPECT_THAT(fault->text, StartsWith("more than 10000000 operations in one scan; a loop does not end"));
  }
  // Twice as many calls with each function: 2^30 in the end.
  std::string text = "FUNCTION F0 : INT F0 := 1; END_FUNCTION\n";
  for (int i = 1; i <= 30; ++i)
    text += "FUNCTION F" + std::to_string(i) + " : INT F" + std::to_string(i) + " := F" +
            std::to_string(i - 1) + "() + F" + std::to_string(i - 1) + "(); END_FUNCTION\n";
  const auto fault = fault_in_first_scan(text + "PROGRAM p VAR x : INT; END_VAR x := F30(); END_PROGRAM");
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->text, StartsWith("more than 10000000 operations"));
}

TEST(StBudget, IsNewInEachScan) {
  Bench bench("PROGRAM p VAR i, x : DINT; END_VAR FOR i := 1 TO 300000 DO x := x + 1; END_FOR END_PROGRAM");
  bench.scan(5);
  EXPECT_EQ(bench["x"], 1500000);
}

std::string numbered(int count, const std::function<std::string(int)>& part) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part(i);
  return text;
}

TEST(StLong, ChainsOfTypesAndFunctionsAreReadInTime) {
  constexpr int many = 20000;
  const auto number = [](int i) { return std::to_string(i); };
  const std::string end = "PROGRAM p END_PROGRAM";
  EXPECT_THAT(
      problems_of("TYPE T0 : INT; " +
                  numbered(many, [&](int i) { return "T" + number(i + 1) + " : T" + number(i) + ";\n"; }) +
                  "END_TYPE PROGRAM p VAR x : T20000; END_VAR x := 1; END_PROGRAM"),
      ElementsAre());
  EXPECT_THAT(
      problems_of(numbered(many,
                           [&](int i) {
                             return "FUNCTION F" + number(i) + " : INT F" + number(i) +
                                    " := 1; END_FUNCTION\n";
                           }) +
                  "PROGRAM p VAR x : INT; END_VAR " +
                  numbered(many, [&](int i) { return "x := F" + number(i) + "();\n"; }) + "END_PROGRAM"),
      ElementsAre());
  EXPECT_THAT(
      problems_of("PROGRAM p VAR " + numbered(many, [&](int i) { return "v" + number(i) + " : INT;\n"; }) +
                  "END_VAR " + numbered(many, [&](int i) { return "v" + number(i) + " := 1;\n"; }) +
                  "END_PROGRAM"),
      ElementsAre());
  EXPECT_THAT(
      problems_of("TYPE " +
                  numbered(many,
                           [&](int i) {
                             return "E" + number(i) + " : (a" + number(i) + ", b" + number(i) + ");\n";
                           }) +
                  "END_TYPE PROGRAM p VAR x : INT; END_VAR " +
                  numbered(many, [&](int i) { return "x := a" + number(i) + ";\n"; }) + "END_PROGRAM"),
      ElementsAre());
  EXPECT_THAT(
      problems_of(
          "PROGRAM p VAR x : DINT; END_VAR CASE x OF " +
          numbered(many, [&](int i) { return number(2 * i) + ", " + number(2 * i + 1) + ": x := 1;\n"; }) +
          "END_CASE END_PROGRAM"),
      ElementsAre());
  // Each calls the next one: too deep for the machine, told once and not by a crash.
  EXPECT_THAT(problems_of("FUNCTION F0 : INT F0 := 1; END_FUNCTION\n" +
                          numbered(many,
                                   [&](int i) {
                                     return "FUNCTION F" + number(i + 1) + " : INT F" + number(i + 1) +
                                            " := F" + number(i) + "(); END_FUNCTION\n";
                                   }) +
                          "PROGRAM p VAR x : INT; END_VAR x := F20000(); END_PROGRAM"),
              ElementsAre(HasSubstr("levels deep; 4000 at most")));
  // Types within types, forwards and backwards.
  EXPECT_THAT(problems_of("TYPE T0 : STRUCT a : INT; END_STRUCT;\n" +
                          numbered(100,
                                   [&](int i) {
                                     return "T" + number(i + 1) + " : STRUCT a : T" + number(i) +
                                            "; END_STRUCT;\n";
                                   }) +
                          "END_TYPE " + end),
              testing::Contains(HasSubstr("the types are nested too deeply; 60 within each other at most")));
  EXPECT_THAT(
      problems_of("TYPE " +
                  numbered(many, [&](int i) { return "T" + number(i) + " : T" + number(i + 1) + ";\n"; }) +
                  "T20000 : INT; END_TYPE " + end),
      testing::Contains(
          HasSubstr("the types are nested too deeply; declare 'T101' before what is made of it")));
}

TEST(StLong, TheDeepestChainThatIsTakenRuns) {
  const std::string chain = numbered(990, [](int i) {
    return "FUNCTION F" + std::to_string(i + 1) + " : INT F" + std::to_string(i + 1) + " := F" +
           std::to_string(i) + "(); END_FUNCTION\n";
  });
  EXPECT_EQ(run("x : INT;", "x := F990();", "FUNCTION F0 : INT F0 := 7; END_FUNCTION\n" + chain), 7);
}

TEST(StLong, UnknownNamesOfALongFileAreAllTold) {
  constexpr int many = 5000;
  EXPECT_EQ(
      problems_of("PROGRAM p VAR " +
                  numbered(many, [](int i) { return "v" + std::to_string(i) + " : INT;\n"; }) + "END_VAR " +
                  numbered(many, [](int i) { return "w" + std::to_string(i) + " := 1;\n"; }) + "END_PROGRAM")
          .size(),
      5000U);
}

TEST(StLong, MemoryThatTypesTakeHasAnEnd) {
  EXPECT_THAT(
      problems_of(
          "TYPE " +
          numbered(40, [](int i) { return "T" + std::to_string(i) + " : ARRAY [1..999999] OF INT;\n"; }) +
          "END_TYPE PROGRAM p END_PROGRAM"),
      testing::Contains(HasSubstr("the types and variables take too much memory; 128 MB at most")));
  EXPECT_THAT(
      problems_of(
          "TYPE E : STRUCT END_STRUCT; A : ARRAY [0..999999] OF E; B : ARRAY [0..999999] OF A; END_TYPE "
          "PROGRAM p VAR b : B; END_VAR END_PROGRAM"),
      testing::Contains(HasSubstr("the array is too large")));
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
