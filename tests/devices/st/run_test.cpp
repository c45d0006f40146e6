// Statements, calls and types of Structured Text step what they do.
#include "devices/plcopen/terminals.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

TEST(StRun, IfTakesTheFirstBranchThatHolds) {
  for (const auto& [n, wanted] : {std::pair{1, 10.0}, {2, 20.0}, {3, 30.0}, {4, 40.0}}) {
    const std::string text =
        "IF n = 1 THEN x := 10; ELSIF n = 2 THEN x := 20; ELSIF n = 3 THEN x := 30; "
        "ELSE x := 40; END_IF";
    EXPECT_EQ(run("x : INT; n : INT := " + std::to_string(n) + ";", text), wanted);
  }
}

TEST(StRun, CaseHasListsRangesNamesAndElse) {
  const std::string units =
      "TYPE State : (Idle, Fast := 7, Slow); END_TYPE VAR_GLOBAL CONSTANT ten : INT := 10; END_VAR";
  const std::string text =
      "CASE n OF 0, 2: x := 1; 3..5: x := 2; y := 1; ten: x := 3; -1: x := 4; ELSE x := 9; END_CASE";
  for (const auto& [n, wanted] :
       {std::pair{0, 1.0}, {1, 9.0}, {2, 1.0}, {3, 2.0}, {5, 2.0}, {6, 9.0}, {10, 3.0}, {-1, 4.0}})
    EXPECT_EQ(run("x, y : INT; n : INT := " + std::to_string(n) + ";", text, units), wanted) << n;
  const std::string named = "CASE s OF Idle: x := 1; State.Fast: x := 2; State#Slow: x := 3; END_CASE";
  EXPECT_EQ(run("x : INT; s : State;", named, units), 1);
  EXPECT_EQ(run("x : INT; s : State := Fast;", named, units), 2);
  EXPECT_EQ(run("x : INT; s : State := Slow;", named, units), 3);
}

TEST(StRun, ForCountsUpAndDownAndKeepsItsEnd) {
  EXPECT_EQ(run("x, i : INT;", "FOR i := 1 TO 10 DO x := x + i; END_FOR"), 55);
  EXPECT_EQ(run("x, i : INT;", "FOR i := 10 TO 1 BY -3 DO x := x + i; END_FOR"), 10 + 7 + 4 + 1);
  EXPECT_EQ(run("x, i : INT;", "FOR i := 1 TO 0 DO x := 1; END_FOR"), 0);
  EXPECT_EQ(run("i, n : INT := 3; x : INT;", "FOR i := 1 TO n DO n := 100; x := x + 1; END_FOR"), 3);
  EXPECT_EQ(run("x : INT;", "FOR x := 0 TO 4 BY 2 DO END_FOR"), 6);
}

TEST(StRun, WhileRepeatExitContinueReturn) {
  EXPECT_EQ(run("x : INT;", "WHILE x < 5 DO x := x + 1; END_WHILE"), 5);
  EXPECT_EQ(run("x : INT := 9;", "REPEAT x := x + 1; UNTIL x > 5 END_REPEAT"), 10);
  EXPECT_EQ(run("x : INT;", "WHILE TRUE DO x := x + 1; IF x = 4 THEN EXIT; END_IF END_WHILE"), 4);
  EXPECT_EQ(run("x, i : INT;", "FOR i := 1 TO 6 DO IF i MOD 2 = 0 THEN CONTINUE; END_IF x := x + i; END_FOR"),
            9);
  EXPECT_EQ(run("x : INT;", "x := 1; RETURN; x := 2;"), 1);
  EXPECT_EQ(
      run("x, i, j : INT;",
          "FOR i := 1 TO 3 DO FOR j := 1 TO 3 DO IF j = 2 THEN EXIT; END_IF x := x + 1; END_FOR END_FOR"),
      3);
}

TEST(StRun, FunctionsTakeInputsByPlaceAndName) {
  const std::string units =
      "FUNCTION Scaled : LREAL VAR_INPUT v : LREAL; step : LREAL := 2.0; END_VAR Scaled := v * step; "
      "END_FUNCTION ";
  EXPECT_EQ(run("x : LREAL;", "x := Scaled(3, 4);", units), 12);
  EXPECT_EQ(run("x : LREAL;", "x := Scaled(v := 3);", units), 6);
  EXPECT_EQ(run("x : LREAL;", "x := Scaled(Scaled(1, 3), Scaled(2, 5));", units), 30);
}

TEST(StRun, FunctionStartsAfreshAtEachCall) {
  const std::string units = "FUNCTION F : INT VAR n : INT := 5; END_VAR n := n + 1; F := n; END_FUNCTION ";
  EXPECT_EQ(run("x : INT;", "x := F(); x := F();", units), 6);
}

TEST(StRun, FunctionWritesItsVarInOutAndOutputs) {
  const std::string units =
      "FUNCTION Swap : BOOL VAR_IN_OUT a, b : INT; END_VAR VAR_OUTPUT sum : INT; END_VAR "
      "VAR t : INT; END_VAR t := a; a := b; b := t; sum := a + b; Swap := TRUE; END_FUNCTION ";
  EXPECT_EQ(run("x : INT := 3; y : INT := 4;", "Swap(x, y);", units), 4);
  EXPECT_EQ(run("x, s : INT; f : ARRAY [1..2] OF INT := [8, 9];",
                "Swap(a := f[1], b := f[2], sum => s); x := f[1] * 100 + s;", units),
            917);
}

TEST(StRun, BlocksKeepTheirStateAndHaveInstances) {
  const std::string units =
      "FUNCTION_BLOCK Count VAR_INPUT step : INT := 1; END_VAR VAR_OUTPUT n : INT; END_VAR "
      "VAR_TEMP t : INT := 3; END_VAR VAR start : BOOL := TRUE; END_VAR "
      "t := t + step; n := n + step; IF t <> 3 + step THEN n := -1000; END_IF END_FUNCTION_BLOCK ";
  Bench bench(
      units +
      "PROGRAM p VAR a : Count; b : Count := (step := 10); many : ARRAY [0..2] OF Count; i, x : INT; END_VAR "
      "a(); a(step := 2, n => x); b(); FOR i := 0 TO 2 DO many[i](step := i); END_FOR END_PROGRAM");
  bench.scan(2);
  EXPECT_EQ(bench["a.n"], 1 + 2 + 2 + 2);  // step keeps the value of the last call
  bench.expect({{"x", 7}, {"b.n", 20}, {"many[2].n", 4}});
}

TEST(StRun, BlocksWriteThroughVarInOut) {
  const std::string units =
      "TYPE P : STRUCT u : INT; v : ARRAY [0..1] OF LREAL; END_STRUCT END_TYPE "
      "FUNCTION_BLOCK Inner VAR_IN_OUT q : P; END_VAR q.u := q.u + 1; q.v[1] := 2.5; END_FUNCTION_BLOCK "
      "FUNCTION_BLOCK Outer VAR_IN_OUT o : P; END_VAR VAR i : Inner; END_VAR i(q := o); END_FUNCTION_BLOCK ";
  Bench bench(
      units +
      "PROGRAM main VAR s : ARRAY [0..2] OF P; k : INT := 2; f : Outer; END_VAR f(o := s[k]); END_PROGRAM");
  bench.scan(3);
  bench.expect({{"s[2].u", 3}, {"s[2].v[1]", 2.5}, {"s[0].u", 0}});
}

TEST(StRun, StructuresAndArraysAreCopiedAndBegun) {
  const std::string units =
      "TYPE P : STRUCT u : INT := 4; w : STRING[5] := 'ab'; END_STRUCT Q : ARRAY [0..1, 1..3] OF INT; "
      "END_TYPE ";
  EXPECT_EQ(run("x : INT; a : P; b : P := (u := 9);", "a := b; x := a.u;", units), 9);
  EXPECT_EQ(run("x : INT; a : P;", "x := a.u;", units), 4);
  EXPECT_EQ(run("x : INT; q : Q := [[1, 2, 3], [4, 5, 6]];", "x := q[1, 2] * 10 + q[0][3];", units), 53);
  EXPECT_EQ(run("x : INT; f : ARRAY [-1..4] OF INT := [7, 3(5), 1];",
                "x := f[-1] * 1000 + f[2] * 100 + f[3] * 10 + f[4];"),
            7510);
}

TEST(StRun, TextsAreAssignedCutAndCompared) {
  EXPECT_EQ(run("x : BOOL; a : STRING := 'knife.tab';", "x := a = 'knife.tab';"), 1);
  EXPECT_EQ(run("x : BOOL; a : STRING[3]; b : STRING := 'abcdef';", "a := b; x := a = 'abc';"), 1);
  EXPECT_EQ(run("x : BOOL; a : STRING;", "a := 'it$'s'; x := a > 'is' AND a < 'iu' AND a <> '';"), 1);
  const std::string units =
      "FUNCTION Same : BOOL VAR_INPUT a : STRING[4]; END_VAR Same := a = 'abcd'; END_FUNCTION ";
  EXPECT_EQ(
      run("x : BOOL; t : STRING := 'abcdef';", "x := Same('abcd') AND Same(t) AND NOT Same('abc');", units),
      1);
}

TEST(StRun, GlobalsAreSeenEverywhereAndConstantsAreValues) {
  const std::string units =
      "VAR_GLOBAL g : INT := 5; END_VAR VAR_GLOBAL CONSTANT n : INT := 3; END_VAR "
      "FUNCTION F : INT F := g * n; END_FUNCTION ";
  EXPECT_EQ(run("x : INT; h : ARRAY [0..n - 1] OF INT;", "g := g + 1; h[n - 1] := F(); x := h[2];", units),
            18);
}

TEST(StRun, NamesAreOfAnyCase) {
  EXPECT_EQ(run("x, Abc : int;", "aBC := 3; if ABC = 3 then X := 1; end_if"), 1);
}

TEST(StRun, CommentsNestAndPragmasArePassedOver) {
  EXPECT_EQ(run("x : INT;", "{warning disable} (* a (* b *) c *) x := 1; // x := 2;\n /* x := 3; */"), 1);
}

TEST(StRun, RetainOutlivesAColdStart) {
  Bench bench(
      "PROGRAM p VAR RETAIN kept : INT := 5; END_VAR VAR lost : INT := 5; END_VAR kept := kept + 1; lost := "
      "lost + 1; END_PROGRAM");
  bench.scan(2);
  bench.runtime->cold_start();
  bench.expect({{"kept", 7}, {"lost", 5}});
  bench.runtime->cold_start(true);
  EXPECT_EQ(bench["kept"], 5);
}

TEST(StRun, TerminalsAreReadAndWritten) {
  Bench bench(
      "PROGRAM p VAR start AT %IX1.3 : BOOL; lamp AT %QX0.7 : BOOL; END_VAR lamp := NOT start; END_PROGRAM");
  const auto& located = std::vector<Program::Located>{
      compile("PROGRAM p VAR start AT %IX1.3 : BOOL; END_VAR END_PROGRAM", "f", bench.problems).located()};
  ASSERT_EQ(located.size(), 1U);
  EXPECT_EQ(located[0].name, "start");
  EXPECT_EQ(located_name(located[0].address), "IX1.3");
  bench.scan();
  EXPECT_TRUE(bench.runtime->located(1));
  bench.runtime->set_located(0, true);
  bench.scan();
  EXPECT_FALSE(bench.runtime->located(1));
  EXPECT_EQ(bench["start"], 1);
  bench.set("start", 0);
  EXPECT_EQ(bench["start"], 1) << "an input terminal is not written";
}

TEST(StRun, SymbolsHaveTypesRangesAndLimits) {
  Bench bench(
      "TYPE S : (A, B := 5); END_TYPE PROGRAM p VAR b : BOOL; i : SINT; w : WORD; r : REAL; t : TIME; s : S; "
      "c : TON; END_VAR "
      "VAR CONSTANT k : INT := 3; END_VAR c(IN := b, PT := T#1s); END_PROGRAM");
  const auto symbol = [&](const char* name) {
    return bench.runtime->symbols()[static_cast<std::size_t>(bench.find(name))];
  };
  EXPECT_EQ(symbol("i").type, "SINT");
  EXPECT_EQ(symbol("i").min, -128);
  EXPECT_EQ(symbol("w").max, 65535);
  EXPECT_EQ(symbol("s").type, "S");
  EXPECT_EQ(symbol("s").max, 5);
  EXPECT_FALSE(symbol("k").writable);
  EXPECT_FALSE(symbol("c.Q").writable);
  EXPECT_TRUE(symbol("c.IN").writable);
  EXPECT_EQ(bench.find("c.since"), -1) << "a standard block's own variables are not shown";
  bench.set("i", 1000);
  EXPECT_EQ(bench["i"], 127);
  bench.set("t", 1.5);
  EXPECT_EQ(bench["t"], 1.5);
  bench.set("k", 4);
  EXPECT_EQ(bench["k"], 3);
  bench.set("r", 0.1);
  EXPECT_EQ(bench["r"], static_cast<double>(0.1F));
}

std::string fault_of(const std::string& text) {
  const auto fault = fault_in_first_scan(text);
  return fault ? std::to_string(fault->line) + ":" + std::to_string(fault->column) + ": " + fault->text : "";
}

/// The fault of `x := expression`, with variables that the compiler does not know the values of.
std::string fault_of_value(const std::string& type, const std::string& expression) {
  return fault_of("PROGRAM p VAR x, null : " + type + "; minus : " + type + " := -2; big : " + type +
                  " := 500; i : INT; t : TIME := T#1s; END_VAR\nx := " + expression + ";\nEND_PROGRAM");
}

TEST(StFault, DivisionByZeroStopsTheProgram) {
  EXPECT_EQ(fault_of("PROGRAM p VAR a, b : INT; END_VAR\na := 5 / b;\nEND_PROGRAM"),
            "2:8: division by 0; test the divisor before");
  EXPECT_EQ(fault_of("PROGRAM p VAR a, b : INT; END_VAR\na := 5 MOD b;\nEND_PROGRAM"),
            "2:8: division by 0; test the divisor before");
  for (const std::string type : {"REAL", "LREAL"}) {
    EXPECT_EQ(fault_of_value(type, "5 / null"), "2:8: division by 0; test the divisor before");
    EXPECT_EQ(fault_of_value(type, "null / -null"), "2:11: division by 0; test the divisor before");
    EXPECT_EQ(fault_of_value(type, "null / minus"), "");
  }
  EXPECT_EQ(fault_of("PROGRAM p VAR t : TIME; x : REAL; END_VAR\nt := t / x;\nEND_PROGRAM"),
            "2:8: division by 0; test the divisor before");
}

TEST(StFault, AFunctionOutsideOfWhatItTakesStopsTheProgram) {
  struct Row {
    const char* expression;
    const char* fault;
  };
  for (const std::string type : {"REAL", "LREAL"})
    for (const Row& row :
         {Row{"SQRT(minus)", "2:6: SQRT of -2; it takes 0 and more: test the value before"},
          {"SQRT(null)", ""},
          {"LN(null)", "2:6: LN of 0; it takes more than 0: test the value before"},
          {"LN(minus)", "2:6: LN of -2; it takes more than 0: test the value before"},
          {"LOG(null)", "2:6: LOG of 0; it takes more than 0: test the value before"},
          {"1 + ASIN(minus)", "2:10: ASIN of -2; it takes -1 to 1: test the value before"},
          {"ASIN(big)", "2:6: ASIN of 500; it takes -1 to 1: test the value before"},
          {"ASIN(minus / 2)", ""},
          {"ACOS(big)", "2:6: ACOS of 500; it takes -1 to 1: test the value before"},
          {"ACOS(big / 500)", ""},
          {"EXPT(null, -1)", "2:6: 0 to the power of -1 is no finite number; test both before"},
          {"minus ** 0.5", "2:12: -2 to the power of 0.5 is no finite number; test both before"},
          {"big ** big", "2:10: 500 to the power of 500 is no finite number; test both before"},
          {"null ** 0", ""},
          {"EXP(big * 2)", "2:6: EXP of 1000 is no finite number; test the value before"}})
      EXPECT_EQ(fault_of_value(type, row.expression), row.fault) << type << " " << row.expression;
  EXPECT_EQ(fault_of_value("REAL", "EXP(big / 5)"),
            "2:6: EXP of 100 is no finite number; test the value before")
      << "beyond REAL, not beyond LREAL";
  EXPECT_EQ(fault_of_value("LREAL", "EXP(big / 5)"), "");
  EXPECT_EQ(fault_of_value("LREAL", "LN(i)"), "2:6: LN of 0; it takes more than 0: test the value before");
}

TEST(StFault, IndexOutOfBoundsStopsTheProgram) {
  EXPECT_EQ(fault_of("PROGRAM p VAR f : ARRAY [1..4] OF INT; i : INT := 5; END_VAR\nf[i] := 1;\nEND_PROGRAM"),
            "2:3: the index 5 is out of bounds; 1 to 4");
  EXPECT_EQ(fault_of("PROGRAM p VAR f : ARRAY [1..4] OF INT; i : INT; END_VAR\ni := f[i];\nEND_PROGRAM"),
            "2:8: the index 0 is out of bounds; 1 to 4");
}

TEST(StFault, EndlessLoopsAndMuxStopTheProgram) {
  EXPECT_EQ(
      fault_of("PROGRAM p\nWHILE TRUE DO END_WHILE\nEND_PROGRAM"),
      "2:1: more than 10000000 operations in one scan; a loop does not end, or there is more to do than a "
      "scan can hold");
  EXPECT_EQ(
      fault_of("PROGRAM p VAR i : SINT; END_VAR\nFOR i := 0 TO 127 DO END_FOR\nEND_PROGRAM").substr(0, 4),
      "2:1:")
      << "the counter wraps, as on the machine";
  EXPECT_EQ(fault_of("PROGRAM p VAR i : INT := 2; END_VAR\ni := MUX(i, 1, 2);\nEND_PROGRAM"),
            "2:6: MUX has no value 2; 0 to 1");
}

TEST(StOrder, OperandsAreComputedFromTheLeft) {
  const std::string functions =
      "VAR_GLOBAL g : INT := 1; END_VAR FUNCTION F : INT g := g + 10; F := 100; END_FUNCTION "
      "FUNCTION Weighed : INT VAR_INPUT a, b, c : INT; END_VAR Weighed := a + 2 * b + 4 * c; END_FUNCTION ";
  EXPECT_EQ(run("x : INT;", "x := g + F() + g;", functions), 1 + 100 + 11);
  EXPECT_EQ(run("x : INT;", "x := Weighed(g, F(), g);", functions), 1 + 200 + 44);
  EXPECT_EQ(run("x : INT; many : ARRAY [0..20] OF INT;",
                "many[11] := 3; many[g + 0 * F()] := g; x := many[1];", functions),
            1);
  EXPECT_EQ(run("x : INT;", "IF g < F() - 98 THEN x := g; END_IF", functions), 11);
  EXPECT_EQ(run("x : INT; s : STRING := 'abc';",
                "s := CONCAT(INT_TO_STRING(g), INT_TO_STRING(F() + g)); "
                "x := STRING_TO_INT(s);",
                functions),
            1111);
}

TEST(StOrder, WhatIsAssignedIsReadBefore) {
  EXPECT_EQ(run("x : BOOL := TRUE; t : BOOL := TRUE;", "x := t AND_THEN (NOT x OR_ELSE x);"), 1);
  EXPECT_EQ(run("x : BOOL := TRUE; f : BOOL;", "x := f OR_ELSE (f OR_ELSE x);"), 1);
  EXPECT_EQ(run("x : INT := 2;", "x := MUX(x, 5, 6, x + 7);"), 9);
  EXPECT_EQ(
      run("x : INT;", "x := Both(3, twice => x);",
          "FUNCTION Both : INT VAR_INPUT a : INT; END_VAR VAR_OUTPUT twice : INT; END_VAR twice := 2 * a; "
          "Both := a; END_FUNCTION"),
      3)
      << "the result is stored behind the outputs";
}

TEST(StOrder, AFunctionThatGivesATextRunsOnce) {
  EXPECT_EQ(run("x : INT; s : STRING; w : WSTRING;", "s := Told(); w := ToldWide(); x := g;",
                "VAR_GLOBAL g : INT; END_VAR FUNCTION Told : STRING g := g + 1; Told := 'a'; END_FUNCTION "
                "FUNCTION ToldWide : WSTRING g := g + 10; ToldWide := \"a\"; END_FUNCTION"),
            11);
}

TEST(StOrder, ABlockThatIsRunWithinItselfKeepsWhatItHasComputed) {
  // By an interface another instance's body runs while the first one's expression waits.
  Bench bench(
      "INTERFACE I METHOD m : INT END_METHOD END_INTERFACE\n"
      "FUNCTION_BLOCK A VAR_INPUT other : I; n : INT; deep : BOOL; END_VAR VAR_OUTPUT y : INT; END_VAR\n"
      "IF deep THEN y := (n + 1) * (n + 2) + other.m() * (n + 3); ELSE y := (n + 4) * (n + 5); END_IF\n"
      "END_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK B IMPLEMENTS I VAR_INPUT p : REF_TO A; END_VAR\n"
      "METHOD m : INT p^(n := 20); m := p^.y; END_METHOD END_FUNCTION_BLOCK\n"
      "PROGRAM main VAR a1, a2 : A; b : B; END_VAR\n"
      "b.p := REF(a2); a1.other := b; a1(n := 1, deep := TRUE); END_PROGRAM");
  bench.scan();
  bench.expect({{"a2.y", 24 * 25}, {"a1.y", 2 * 3 + 24 * 25 * 4}});
}

TEST(StOrder, LoopsLeaveAndGoOn) {
  EXPECT_EQ(run("x, i, j : INT;",
                "FOR i := 1 TO 5 DO FOR j := 1 TO 5 DO IF j = 2 THEN CONTINUE; END_IF "
                "IF j = 4 THEN EXIT; END_IF x := x + j; END_FOR IF i = 3 THEN EXIT; END_IF END_FOR"),
            3 * 4);
  EXPECT_EQ(run("x, i : INT;",
                "REPEAT i := i + 1; IF i MOD 2 = 0 THEN CONTINUE; END_IF x := x + i; UNTIL i >= 6 "
                "END_REPEAT"),
            1 + 3 + 5);
  EXPECT_EQ(run("x : INT; i : INT; step : INT := -2;", "FOR i := 6 TO 1 BY step DO x := 10 * x + i; END_FOR"),
            642);
  EXPECT_EQ(run("x : INT; i : INT;", "FOR i := 6 TO 1 BY -3 DO x := 10 * x + i; END_FOR"), 63);
}

TEST(StInstructions, AreCountedWhereAValueStandsInSeveralPlaces) {
  // What is left of a DT without its seconds: each takes the value before twice.
  const auto program = [](int times) {
    std::string value = "now";
    for (int i = 0; i < times; ++i) value = "DATE_TO_DT(DT_TO_DATE(" + value + "))";
    return "PROGRAM p VAR now, x : DT := DT#2024-02-29-06:30:00; END_VAR x := " + value + "; END_PROGRAM";
  };
  Bench bench(program(10));
  bench.scan();
  EXPECT_EQ(bench["x"], bench["now"] - 6.5 * 3600);
  expect_problems(program(24), {"1:1: the statements and operations are too many; 1000000 at most$"});
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
