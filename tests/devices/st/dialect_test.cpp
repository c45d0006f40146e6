// Each row of `differences`: what either dialect does, and what a program is told that names none.
#include <gmock/gmock.h>

#include <limits>

#include "devices/plcopen/st/dialect.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr CompileOptions iec{.dialect = StDialect::iec};
constexpr CompileOptions codesys{.dialect = StDialect::codesys};

/// The notes of differences among those of a program.
std::vector<std::string> differences_in(const Bench& bench) {
  std::vector<std::string> noted;
  for (const auto& doubt : bench.doubts)
    if (doubt.find("taken as CODESYS takes it") != std::string::npos) noted.push_back(doubt);
  return noted;
}

/// A value of a program of one scan; the statement is line 2.
double result(const std::string& vars, const std::string& statement, const CompileOptions& options) {
  Bench bench("PROGRAM p VAR x : LREAL; " + vars + " END_VAR\n" + statement + "\nEND_PROGRAM", options);
  bench.scan();
  if (options.dialect) {
    EXPECT_THAT(differences_in(bench), IsEmpty());
  }
  return bench["x"];
}

std::vector<std::string> problems_in(const std::string& vars, const std::string& statement,
                                     const CompileOptions& options) {
  return problems_of("PROGRAM p VAR x : LREAL; " + vars + " END_VAR\n" + statement + "\nEND_PROGRAM",
                     options);
}

std::vector<std::string> notes_of(const std::string& vars, const std::string& statements) {
  return differences_in(
      Bench("PROGRAM p VAR x : LREAL; " + vars + " END_VAR\n" + statements + "\nEND_PROGRAM"));
}

/// The same value under both, and the note without a dialect.
void expect_both(const std::string& vars, const std::string& statement, double of_iec, double of_codesys,
                 const std::string& note) {
  EXPECT_EQ(result(vars, statement, iec), of_iec) << statement;
  EXPECT_EQ(result(vars, statement, codesys), of_codesys) << statement;
  EXPECT_EQ(result(vars, statement, {}), of_codesys) << statement;
  EXPECT_THAT(notes_of(vars, statement), ElementsAre(StartsWith(note))) << statement;
}

TEST(StDialect, TimesBelowZero) {
  expect_both("t : TIME := T#1s; u : TIME := T#2s;", "x := TIME_TO_LREAL(t - u);", -1000, 4294966296,
              "2:22: a TIME below 0");
  expect_both("t : TIME := T#1s;", "x := TIME_TO_LREAL(t * -2);", -2000, 4294965296, "2:22: a TIME below 0");
  expect_both("t : DT := DT#2024-01-01-00:00:00; u : DT := DT#2024-01-01-00:00:05;",
              "x := TIME_TO_LREAL(t - u);", -5000, 4294962296, "2:22: a TIME below 0");
  EXPECT_EQ(result("t : TIME := T#-5s;", "x := TIME_TO_LREAL(-t + T#1ms);", iec), 5001);
  EXPECT_EQ(result("t : TIME := T#-5s; b : BOOL;", "b := t < T#0s; x := BOOL_TO_LREAL(b);", iec), 1);
  EXPECT_EQ(result("d : DINT;", "d := TIME_TO_DINT(DINT_TO_TIME(-7)); x := d;", iec), -7);
  EXPECT_EQ(
      result("s : STRING;",
             "s := TIME_TO_STRING(T#-1s500ms); x := LEN(s); IF s = 'T#-1s500ms' THEN x := -x; END_IF", iec),
      -10);
  EXPECT_THAT(problems_in("", "x := TIME_TO_LREAL(T#-5s);", codesys),
              ElementsAre(StartsWith("2:20: 'T#-5s' is out of the range of TIME; a TIME is below 0 under "
                                     "controller.plcopen.dialect: iec")));
  EXPECT_THAT(problems_in("t : TIME;", "t := -t;", {}),
              ElementsAre(StartsWith("2:6: '-' does not go with TIME")));
  EXPECT_THAT(problems_in("t : TIME;", "t := T#25d;", iec),
              ElementsAre(StartsWith("2:6: 'T#25d' is out of the range of TIME; it goes from T#-24d")));
  // What has been since a moment before is not below 0.
  EXPECT_THAT(notes_of("t, since : TIME;", "t := TIME() - since; t := T#2s - T#1s;"), IsEmpty());
  Bench bench("PROGRAM p VAR t : TIME; END_VAR t := T#0s - T#1500ms; END_PROGRAM", iec);
  bench.scan();
  EXPECT_EQ(bench["t"], -1.5);
  bench.set("t", -2);
  EXPECT_EQ(bench["t"], -2);
}

TEST(StDialect, RealsOfBits) {
  expect_both("", "x := DWORD_TO_REAL(16#3F800000);", 1, 1065353216, "2:6: DWORD_TO_REAL, REAL_TO_DWORD");
  expect_both("r : REAL := 1.0; d : DWORD;", "d := REAL_TO_DWORD(r); x := DWORD_TO_LREAL(d);", 1065353216, 1,
              "2:6: DWORD_TO_REAL, REAL_TO_DWORD");
  expect_both("l : LWORD := 16#4000000000000000;", "x := LWORD_TO_LREAL(l);", 2, 4611686018427387904.0,
              "2:6: DWORD_TO_REAL, REAL_TO_DWORD");
  EXPECT_THAT(notes_of("w : WORD; u : UDINT;", "x := WORD_TO_REAL(w); x := UDINT_TO_REAL(u);"), IsEmpty());
}

/// What one dialect refuses and the other takes, with a note without a dialect.
void expect_refused(const std::string& vars, const std::string& statement, const std::string& problem,
                    double taken, const std::string& note) {
  EXPECT_THAT(problems_in(vars, statement, iec), ElementsAre(StartsWith(problem))) << statement;
  EXPECT_EQ(result(vars, statement, codesys), taken) << statement;
  EXPECT_THAT(notes_of(vars, statement), ElementsAre(StartsWith(note))) << statement;
}

TEST(StDialect, BitsAreNoNumbers) {
  const std::string vars = "b : BYTE := 250; c : BYTE := 10; i : INT := 6; u : USINT; w : WORD := 7; ";
  expect_refused(vars, "b := b + c; u := BYTE_TO_USINT(b); x := u;",
                 "2:8: '+' does not go with BYTE and BYTE; bits are no numbers", 4, "2:8: + - * / MOD **");
  expect_refused(vars, "w := w MOD 4; x := WORD_TO_LREAL(w);", "2:8: 'MOD' does not go with WORD", 3,
                 "2:8: + - *");
  expect_refused(vars, "x := SQRT(WORD_TO_DWORD(w) AND 4);", "2:28: SQRT does not take DWORD", 2,
                 "2:6: + - *");
  expect_refused(vars, "i := i AND 3; x := i;",
                 "2:8: 'AND' does not go with INT and a whole number; numbers are no bits in IEC 61131-3: "
                 "INT_TO_WORD(...)",
                 2, "2:8: AND OR XOR");
  expect_refused(vars, "i := NOT i; x := i;", "2:6: 'NOT' does not go with INT", -7, "2:6: AND OR XOR");
  expect_refused("i : DINT := 6;", "i := NOT i; x := i;",
                 "2:6: 'NOT' does not go with DINT; it takes BOOL and bits: DINT_TO_DWORD(...)", -7,
                 "2:6: AND OR XOR");
  expect_refused(vars, "i := SHL(i, 1); x := i;", "2:", 12, "2:6: AND OR XOR");
  expect_refused(vars, "i := b; x := i;",
                 "2:6: a value of type BYTE does not go into INT by itself; BYTE_TO_INT", 250,
                 "2:6: BYTE to LWORD where a number");
  // Bits with bits, numbers with numbers, literals with both.
  const std::string plain =
      "w := w AND 16#F; w := SHL(w, 2) OR b; i := i * 2 + 1; u := BYTE_TO_USINT(b); x := i;";
  EXPECT_EQ(result(vars, plain, iec), 13);
  EXPECT_THAT(notes_of(vars, plain), IsEmpty());
}

TEST(StDialect, PowersOfSigns) {
  expect_both("", "x := -2 ** 2;", 4, -4, "2:6: -a ** b");
  expect_both("y : LREAL := 3.0;", "x := -y ** 2 ** 2;", 81, -81, "2:6: -a ** b");
  for (const char* statement : {"x := -2 ** 3;", "x := (-2) ** 2;", "x := 2 ** -2;", "x := -(2 ** 2);"}) {
    EXPECT_EQ(result("", statement, iec), result("", statement, codesys)) << statement;
    EXPECT_THAT(notes_of("", statement), IsEmpty()) << statement;
  }
}

TEST(StDialect, FallingEdgesOfTheFirstScan) {
  const std::string text = R"(FUNCTION_BLOCK Falls
VAR_INPUT c : BOOL F_EDGE; END_VAR VAR_OUTPUT n : INT; END_VAR
IF c THEN n := n + 1; END_IF END_FUNCTION_BLOCK
PROGRAM p VAR b : BOOL; f : F_TRIG; falls : Falls; n : INT; END_VAR
f(CLK := b); IF f.Q THEN n := n + 1; END_IF falls(c := b);
END_PROGRAM)";
  for (const auto& [options, first] : {std::pair{iec, 1}, {codesys, 0}, {CompileOptions{}, 0}}) {
    Bench bench(text, options);
    bench.scan(3);
    EXPECT_EQ(bench["n"], first);
    EXPECT_EQ(bench["falls.n"], first);
    bench.set("b", 1);
    bench.scan(2);
    bench.set("b", 0);
    bench.scan(2);
    EXPECT_EQ(bench["n"], first + 1);
    EXPECT_EQ(bench["falls.n"], first + 1);
    EXPECT_EQ(differences_in(bench).size(), options.dialect ? 0 : 1);
  }
}

TEST(StDialect, InputsOfABlock) {
  const std::string text = R"(FUNCTION_BLOCK f VAR_INPUT i : INT; END_VAR
i := 3;
END_FUNCTION_BLOCK PROGRAM p VAR b : f; END_VAR b(); END_PROGRAM)";
  EXPECT_THAT(problems_of(text, iec), ElementsAre(StartsWith("2:1: i is an input of f and is assigned")));
  for (const auto& options : {codesys, CompileOptions{}})
    EXPECT_THAT(Bench(text, options).doubts, ElementsAre(StartsWith("2:1: i is an input of f")));
}

// The four examples of CODESYS's own help, "Overflow/underflow in the data type", and what follows from them.
TEST(StDialect, ResultsOnTheirWay) {
  expect_both("w : WORD := 65535; d : DWORD;",
              "d := UINT_TO_DWORD(WORD_TO_UINT(w) + 1); x := DWORD_TO_UDINT(d);", 0, 65536,
              "2:6: SINT to UINT");
  EXPECT_EQ(result("w : WORD := 65535; d : DWORD;", "d := w + 1; x := DWORD_TO_UDINT(d);", codesys), 65536);
  const std::string two = "u : UINT := 65535; v, k : UINT; b : BOOL;";
  EXPECT_EQ(result(two, "x := BOOL_TO_LREAL(u + 1 = v) + 2 * BOOL_TO_LREAL(v - 1 = u);", iec), 3);
  EXPECT_EQ(result(two, "x := BOOL_TO_LREAL(u + 1 = v) + 2 * BOOL_TO_LREAL(v - 1 = u);", codesys), 0);
  EXPECT_EQ(result(two, "k := u + 1; x := BOOL_TO_LREAL(k = v);", codesys), 1);
  EXPECT_EQ(
      result(two, "x := BOOL_TO_LREAL(TO_UINT(u + 1) = v) + 2 * BOOL_TO_LREAL(TO_UINT(v - 1) = u);", codesys),
      3);

  const std::string ints = "i : INT := 200; j : INT := 200; k : INT; d : DINT; s : SINT := 100;";
  expect_both(ints, "d := i * j; x := d;", -25536, 40000, "2:");
  expect_both(ints, "k := i * j / 8; x := k;", -3192, 5000, "2:");
  expect_both(ints, "d := s * s; x := d;", 16, 10000, "2:");
  expect_both(ints, "d := -(i * j); x := d;", 25536, -40000, "2:");
  // Taken by what has the width: nothing differs, nothing is told.
  for (const auto& options : {iec, codesys, CompileOptions{}}) {
    EXPECT_EQ(result(ints, "k := i * j; x := k;", options), -25536);
    EXPECT_EQ(result(ints, "k := MAX(i * j, -30000); x := k;", options), -25536);
    EXPECT_EQ(result(ints, "k := i * i - j * j + 7; x := k;", options), 7);
    EXPECT_EQ(result(ints, "k := -i; x := k;", options), -200);
  }
  EXPECT_THAT(notes_of(ints, "k := i * j; k := MAX(i * j, 0); IF i * j > 5 THEN k := -i; END_IF"), IsEmpty());
  // A difference of unsigned ones below 0 is one below 0 where a DINT takes it.
  EXPECT_EQ(result("a : UINT := 3; b : UINT := 5; d : DINT;", "d := a - b; x := d;", codesys), -2);
  // Its constants are computed alike.
  EXPECT_EQ(result("d : DINT;", "d := INT#30000 + INT#30000; x := d;", codesys), 60000);
  EXPECT_EQ(result("k : INT;", "k := INT#30000 + INT#30000; x := k;", codesys), -5536);
  for (const auto& options : {iec, codesys}) {
    EXPECT_EQ(result("i : INT := INT#30000 + INT#30000;", "x := i;", options), -5536);
    EXPECT_EQ(result("k : INT;", "k := MAX(INT#30000 + INT#30000, INT#0); x := k;", options), 0);
  }
  Bench named(
      "PROGRAM p VAR CONSTANT c : INT := INT#30000 + INT#30000; END_VAR VAR d : DINT; END_VAR d := c; "
      "END_PROGRAM",
      codesys);
  named.scan();
  EXPECT_EQ(named["d"], -5536);
  // Blocks of the standard count as ever.
  for (const auto& options : {iec, codesys}) {
    Bench bench("PROGRAM p VAR c : CTU; b : BOOL; END_VAR b := NOT b; c(CU := b, PV := 2); END_PROGRAM",
                options);
    bench.scan(5);
    EXPECT_EQ(bench["c.CV"], 3);
  }
}

TEST(StDialect, EachDifferenceIsNotedOnce) {
  EXPECT_THAT(notes_of("b : BYTE; i : INT;", "b := b + b;\nb := b * b;\ni := i AND 1;"),
              ElementsAre(StartsWith("2:8: + - *"), StartsWith("4:8: AND OR")));
  for (const auto& row : differences) {
    EXPECT_THAT(std::string(row.iec), testing::Not(testing::StrEq(std::string(row.codesys))));
    EXPECT_THAT(std::string(row.of), testing::Not(IsEmpty()));
  }
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
