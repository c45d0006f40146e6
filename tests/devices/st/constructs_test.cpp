// What real programs have beside the plain language: counters of all types, enumerations with a type, initial
// values of types, flat lists, edges, functions without a result, texts of any length.
#include <gmock/gmock.h>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

TEST(StConstructs, CountersTakeAndGiveNumbersOfTheirType) {
  Bench bench(R"(PROGRAM p
VAR up : BOOL; plain : CTU; wide : CTU_DINT; down : CTD_UDINT; i : INT; u : UINT; w : WORD; d : DINT; n : UDINT; END_VAR
up := NOT up;
plain(CU := up, PV := i); wide(CU := up, R := FALSE, PV := 100000); down(CD := up, LD := d = 0, PV := 5);
i := plain.CV; u := plain.CV; w := plain.CV; d := wide.CV; n := down.CV;
END_PROGRAM)");
  bench.scan(5);
  bench.expect({{"i", 3}, {"u", 3}, {"w", 3}, {"d", 3}, {"n", 3}, {"wide.Q", 0}});
  EXPECT_THAT(problems_of("PROGRAM p VAR c : CTU; s : SINT; END_VAR\ns := c.CV;\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:6: 'c.CV' is INT (0..32767), which does not go into SINT")));
}

TEST(StConstructs, EnumerationsHaveATypeAndTypesBeginWithValues) {
  const char* types = R"(TYPE
  Level : BYTE (Low := 10, High := 20) := High;
  Mode : (Off, On := 4) INT;
  Count : INT := 7;
  Point : STRUCT x : INT := 1; y : INT; END_STRUCT := (y := 2);
  Row : ARRAY [0..2] OF INT := [4, 5, 6];
END_TYPE )";
  Bench bench(
      types +
      std::string("PROGRAM p VAR l : Level; m : Mode := On; c : Count; p0 : Point; r : Row; c2 : Count := 9; "
                  "END_VAR END_PROGRAM"));
  bench.expect({{"l", 20}, {"m", 4}, {"c", 7}, {"p0.x", 1}, {"p0.y", 2}, {"r[2]", 6}, {"c2", 9}});
  EXPECT_THAT(problems_of("TYPE a : USINT (b := 300); END_TYPE PROGRAM p END_PROGRAM"),
              ElementsAre(StartsWith("1:17: 'b' is 300, which is no USINT; 0 to 255")));
  EXPECT_THAT(
      problems_of("TYPE a : (b := 1, c := 60000) UINT; END_TYPE PROGRAM p END_PROGRAM"),
      ElementsAre(StartsWith(
          "1:19: 'c' is 60000; an enumeration is kept as an INT here, of UINT too; -32768 to 32767")));
  EXPECT_THAT(
      problems_of("TYPE a : (b := 32767, c, d); END_TYPE PROGRAM p VAR v : a := d; END_VAR END_PROGRAM"),
      ElementsAre(StartsWith("1:23: 'c' is 32768, which is no INT")));
  EXPECT_THAT(problems_of("TYPE a : (b, c) REAL; END_TYPE PROGRAM p END_PROGRAM"),
              ElementsAre(StartsWith("1:17: an enumeration of REAL")));
}

TEST(StConstructs, FlatListsFillAllDimensions) {
  Bench bench(R"(PROGRAM p
VAR a : ARRAY [0..1, 0..2] OF INT := [1, 2, 3, 4, 5]; b : ARRAY [0..1, 0..1] OF INT := [[1], [3, 4]];
  c : ARRAY [1..4] OF INT := 7, 2(8), 9; END_VAR END_PROGRAM)");
  bench.expect({{"a[0][2]", 3},
                {"a[1][1]", 5},
                {"a[1][2]", 0},
                {"b[0][1]", 0},
                {"b[1][0]", 3},
                {"c[1]", 7},
                {"c[3]", 8},
                {"c[4]", 9}});
  EXPECT_THAT(
      problems_of("PROGRAM p VAR a : ARRAY [0..3] OF INT := 0; END_VAR END_PROGRAM"),
      ElementsAre(StartsWith("1:42: one value for an ARRAY [0..3] OF INT; [4(value)] gives it to all")));
}

TEST(StConstructs, InputsWithAnEdgeSeeTheEdge) {
  Bench bench(R"(FUNCTION_BLOCK Count
VAR_INPUT start : BOOL R_EDGE; stop : BOOL F_EDGE; END_VAR VAR_OUTPUT rises, falls : INT; END_VAR
IF start THEN rises := rises + 1; END_IF IF stop THEN falls := falls + 1; END_IF
END_FUNCTION_BLOCK
PROGRAM p VAR b : BOOL; c : Count; END_VAR c(start := b, stop := b); END_PROGRAM)");
  bench.scan(2);
  bench.set("b", 1);
  bench.scan(3);
  bench.set("b", 0);
  bench.scan(3);
  bench.expect({{"c.rises", 1}, {"c.falls", 1}});
  EXPECT_EQ(bench.find("c.start'edge"), -1);
  EXPECT_THAT(
      problems_of(
          "FUNCTION_BLOCK f VAR_INPUT\ni : INT R_EDGE; END_VAR END_FUNCTION_BLOCK PROGRAM p END_PROGRAM"),
      ElementsAre(StartsWith("2:9: R_EDGE stands behind no input")));
}

TEST(StConstructs, FunctionsNeedNoResultAndBlocksNoNames) {
  Bench bench(
      R"(FUNCTION Add VAR_INPUT a, b : INT; END_VAR VAR_OUTPUT sum : INT; END_VAR sum := a + b; END_FUNCTION
FUNCTION_BLOCK Outer VAR_INPUT i : BOOL; END_VAR VAR_OUTPUT t : TON; q : BOOL; END_VAR
t(i, T#4ms); q := t.Q; END_FUNCTION_BLOCK
PROGRAM p VAR x : INT; o : Outer; off, seen : BOOL; et : TIME; END_VAR
Add(2, 3, sum => x); o(TRUE, NOT q => off); seen := o.t.Q; et := o.t.ET;
END_PROGRAM)");
  bench.scan();
  bench.expect({{"x", 5}, {"off", 1}});
  bench.scan(3);
  bench.expect({{"off", 0}, {"seen", 1}});
  const std::string units =
      "FUNCTION f VAR_INPUT a : INT; END_VAR END_FUNCTION PROGRAM p VAR x : INT; t : TON; END_VAR\n";
  EXPECT_THAT(problems_of(units + "x := f(1);\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:6: f gives no value; call it in a statement of its own")));
  EXPECT_THAT(problems_of(units + "t(IN := TRUE, NOT ET => x);\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:15: 'NOT' does not go with TIME")));
}

TEST(StConstructs, TextsAreLongWideAndHoldQuotes) {
  EXPECT_EQ(run("s : STRING[600]; x : INT; i : INT;",
                "FOR i := 1 TO 50 DO s := CONCAT(s, '0123456789'); END_FOR x := LEN(s);"),
            500);
  EXPECT_EQ(run("x : INT;", "x := LEN('it''s') * 10 + LEN('');"), 40);
  EXPECT_EQ(run("w, v : WSTRING := \"größer\"; x : INT;",
                "v := MID(w, 2, 3); x := LEN(w) * 100 + LEN(v) * 10 + FIND(w, v);"),
            623);
}

TEST(StConstructs, DatesAreTakenApartAndPutTogether) {
  EXPECT_EQ(run("x, y, m, d : INT;",
                "SPLIT_DATE(D#2024-02-29, YEAR => y, MONTH => m, DAY => d); x := y + 100 * m + d;"),
            2253);
  EXPECT_EQ(run("x : BOOL;",
                "x := CONCAT_DATE(2024, 12, 31) = D#2024-12-31 AND CONCAT_DATE(1970, 1, 1) = D#1970-01-01;"),
            1);
  EXPECT_EQ(run("x : BOOL;", "x := CONCAT_DT(2001, 9, 9, 1, 46, 40, 0) = DT#2001-09-09-01:46:40;"), 1);
  EXPECT_EQ(run("x, h, m, s, ms, y, o, d : INT;",
                "SPLIT_DT(DT#2001-09-09-01:46:40, YEAR => y, MONTH => o, DAY => d, HOUR => h, MINUTE => m, "
                "SECOND => s, "
                "MILLISECOND => ms); x := y + o + d + h + m + s;"),
            2001 + 9 + 9 + 1 + 46 + 40);
  EXPECT_EQ(run("x : INT;", "x := DAY_OF_WEEK(D#2024-02-29) * 10 + DAY_OF_WEEK(D#2024-03-03);"), 40);
  EXPECT_EQ(run("x : DINT;", "x := WORD_BCD_TO_UINT(16#1234) + USINT_TO_BCD_BYTE(42);"), 1234 + 0x42);
  EXPECT_EQ(
      run("x : INT;", "x := DAY_OF_WEEK();", "FUNCTION DAY_OF_WEEK : INT DAY_OF_WEEK := 77; END_FUNCTION "),
      77)
      << "a user's own stands instead";
}

TEST(StConstructs, TakeTheTypeThatTheContextWants) {
  EXPECT_EQ(run("x : INT; r : REAL := 3.9;", "x := TRUNC(r) + 1;"), 4);
  EXPECT_EQ(run("x : BYTE; b : BOOL := TRUE;", "x := SEL(b, 0, 255);"), 255);
  EXPECT_EQ(run("x : USINT; i : INT := 1;", "x := MUX(i, 1, 200, 3);"), 200);
  EXPECT_EQ(run("x : TIME; e : TIME := T#2s;", "x := T#5s-e;"), 3);
  EXPECT_THAT(problems_of("PROGRAM p VAR b : BYTE; END_VAR\nb := SEL(TRUE, 0, 256);\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:19: the constant 256 is out of the range of BYTE")));
}

TEST(StConstructs, MuxOfLiteralsIsAReal) {
  EXPECT_EQ(run("x : REAL; k : INT := 1;", "x := MUX(k, 1.5, 2.5);"), 2.5);
  EXPECT_EQ(run("x : REAL; k : INT;", "x := MUX(K := k, IN0 := 1.5, IN1 := 2.5) + SEL(k = 0, 1.5, 2.5);"), 4);
  EXPECT_EQ(run("x : LREAL; k : INT;", "x := MUX(k, 0.1, 2.5);"), 0.1);
  EXPECT_EQ(run("x : REAL; k : INT := 1;", "x := F(k);",
                "FUNCTION F : REAL VAR_INPUT k : INT; END_VAR F := MUX(k, 1.5, 2); END_FUNCTION"),
            2);
}

TEST(StConstructs, CharactersCompareWithLiterals) {
  EXPECT_EQ(run("x : INT; c : CHAR := 'A'; wc : WCHAR := \"x\";",
                "IF c = 'A' AND 'B' > c AND wc = \"x\" AND NOT (c <> 'A') THEN x := 1; END_IF "
                "CASE c OF 'B': x := x + 10; 'A', 'C'..'E': x := x + 100; ELSE x := 0; END_CASE"),
            101);
  const std::string vars = "PROGRAM p VAR c : CHAR; b : BOOL; END_VAR\n";
  EXPECT_THAT(problems_of(vars + "b := c = 'AB';\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:10: 2 characters for a CHAR; it holds one")));
  EXPECT_THAT(problems_of(vars + "b := c = \"A\";\nEND_PROGRAM"), testing::SizeIs(1));
  EXPECT_THAT(problems_of(vars + "CASE c OF 'A': b := TRUE; 'A': b := FALSE; END_CASE\nEND_PROGRAM"),
              ElementsAre(StartsWith("2:27: the label 65 is there already")));
}

TEST(StConstructs, ConstantsMayStandBehindWhatNeedsThem) {
  EXPECT_EQ(run("a : ARRAY [0..n] OF INT; x : INT; END_VAR VAR CONSTANT m : INT := n + 1; n : INT := k; "
                "k : INT := 3;",
                "a[n] := m; x := UPPER_BOUND(a, 1) * 10 + a[3];"),
            34);
  EXPECT_EQ(
      run("x : INT;", "x := F();",
          "FUNCTION F : INT VAR a : ARRAY [1..n] OF INT := [2, 2, 2, 2]; END_VAR VAR CONSTANT n : INT := 4; "
          "END_VAR F := a[1] + a[n]; END_FUNCTION"),
      4);
  // Of the unit before those of all units.
  EXPECT_EQ(run("a : ARRAY [0..n] OF INT; x : INT; END_VAR VAR CONSTANT n : INT := 3;",
                "x := UPPER_BOUND(a, 1);", "VAR_GLOBAL CONSTANT n : INT := 7; END_VAR"),
            3);
  EXPECT_THAT(problems_of("PROGRAM p VAR CONSTANT\nn : INT := m;\nm : INT := n;\nEND_VAR END_PROGRAM"),
              testing::Not(IsEmpty()));
  EXPECT_THAT(problems_of("PROGRAM p VAR\na : ARRAY [0..n] OF INT; n : INT := 3;\nEND_VAR END_PROGRAM"),
              ElementsAre(StartsWith("2:15: 'n' is not declared")));
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
