// Compile errors: what is said, where, and that nothing else is. tests/scenes/bad/program.st has those of a
// whole file; here are the ones that spoil the rest of a file or stand alone.
#include <gmock/gmock.h>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// The one problem of statements in a program with some variables; the statements are line 2.
std::vector<std::string> in_program(const std::string& statements, const std::string& units = "") {
  return problems_of(
      units +
      "PROGRAM main VAR i, j : INT; r : REAL; x : LREAL; b : BOOL; s : STRING; t : TON; d : DINT; END_VAR\n" +
      statements + "\nEND_PROGRAM");
}

struct Row {
  const char* statements;
  const char* problem;
};

TEST(StErrors, OfStatementsAreToldOnceAtTheirPlace) {
  for (const Row& row : {
           Row{"i := d + 1;",
               "2:8: a value of type DINT does not go into INT by itself; DINT_TO_INT(...) converts"},
           {"x := TRUE;",
            "2:6: a value of type BOOL does not go into LREAL by itself; BOOL_TO_LREAL(...) converts"},
           {"t(IN := T#5s);", "2:9: a value of type TIME does not go into BOOL by itself; TIME_TO_BOOL"},
           {"r := x;",
            "2:6: 'x' is LREAL, which does not go into REAL by itself; LREAL_TO_REAL(...) converts"},
           {"r := 1E39;", "2:6: the constant 1e+39 is out of the range of REAL"},
           {"b := i;", "2:6: 'i' is INT, which does not go into BOOL by itself; INT_TO_BOOL(...) converts"},
           {"s := i;",
            "2:6: 'i' is INT, which does not go into STRING by itself; INT_TO_STRING(...) converts"},
           {"t := 1;", "2:1: 't' is TON and is not assigned; assign its inputs"},
           // What other languages write.
           {"IF i := 1 THEN j := 1; END_IF", "2:6: ':=' assigns; '=' compares"},
           {"IF i == 1 THEN j := 1; END_IF", "2:6: there is no '=='; '=' compares"},
           {"IF i != 1 THEN j := 1; END_IF", "2:6: there is no '!='; '<>' compares"},
           {"IF !b THEN j := 1; END_IF", "2:4: there is no '!'; NOT inverts"},
           {"b := b && b;", "2:8: there is no '&&'; AND combines"},
           {"b := b || b;", "2:8: there is no '||'; OR combines"},
           {"i++;", "2:2: there is no '++;'; write i := i + 1;"},
           {"i--;", "2:2: there is no '--;'; write i := i - 1;"},
           {"i += 1;", "2:3: there is no '+='; write i := i + 1;"},
           {"i -= 1;", "2:3: there is no '-='; write i := i - 1;"},
           {"i *= 2;", "2:3: there is no '*='; write i := i * 2;"},
           {"i /= 2;", "2:3: there is no '/='; write i := i / 2;"},
           {"i := i << 2;", "2:8: there is no '<<'; SHL(word, bits)"},
           {"i := i >> 2;", "2:8: there is no '>>'; SHR(word, bits)"},
           {"i := b ? 1 : 2;", "2:8: there is no '?'; SEL("},
           {"i := j % 3;", "2:8: there is no '%'; MOD gives the remainder"},
           {"i := t->ET;", "2:7: there is no '->'; '^' follows a reference"},
           {"x := .5;", "2:6: a number begins with a digit; write 0.5"},
           {"i := INT#10#5;", "2:10: '10#5' has no base that is known"},
           {"GOTO 5;", "2:1: 'GOTO' is not declared"},
           {"REPEAT i := 1; UNTIL b DO END_REPEAT", "2:24: END_REPEAT is missing before 'DO'"},
           {"t;", "2:2: '(' is missing before ';'"},
           {"i(1);", "2:1: 'i' is INT and cannot be called"},
           {"i := j(1);", "2:6: 'j' is INT and cannot be called here; a variable hides a function"},
           {"b := t(IN := b);", "2:6: 't' is TON and cannot be called here; call it in a statement"},
           {"i[1] := 2;", "2:3: 'i' is INT and has no elements; only an ARRAY has an index"},
           {"i.q := 2;", "2:3: 'i' is INT and has no members; use it without '.'"},
           {"b := j.16;", "2:8: INT has no part '16'; 0 to 15"},
           {"b := x.3;", "2:8: 'x' is LREAL and has no part '3'; whole numbers have bits, from 0"},
           {"b := j.%Q3;", "2:8: '%Q3' is no part of a number; %X3 is a bit, %B1 a byte"},
           {"FOR b := 1 TO 2 DO END_FOR", "2:5: FOR counts 'b', which is BOOL"},
           {"x := SQRT(-1);", "2:6: SQRT of -1; it takes 0 and more: test the value before"},
           {"x := LN(0);", "2:6: LN of 0; it takes more than 0"},
           {"x := 0 ** -1;", "2:8: 0 to the power of -1 is no finite number"},
           {"i := 1 MOD 0;", "2:8: division by the constant 0"},
           {"x := 1.0 / 0.0;", "2:10: division by the constant 0"},
           {"x := x MOD 2.0;", "2:8: 'MOD' does not go with LREAL and a real number; it takes whole numbers"},
           {"b := b AND i;", "2:8: 'AND' does not go with BOOL and INT"},
           {"b := i AND_THEN j;", "2:8: 'AND_THEN' does not go with INT and INT; it takes BOOL"},
           {"b := s = i;", "2:8: '=' does not go with STRING and INT; compare two of one type"},
           {"x := NOT 1;", "2:6: NOT of a number without a type; give it one: WORD#16#FF"},
           {"x := SHL(1, 2);", "2:10: SHL of a number without a type"},
           {"b := ADD(i, j) > ADD(b, i);", "2:18: 'ADD' does not go with BOOL and INT; convert one"},
           {"i := ADD(IN1 := i, IN3 := j);", "2:6: ADD has 2 values; it takes 2 to 64"},
           {"i := ADD(IN1 := i, IN1 := j);", "2:20: 'IN1' is given twice; once a call"},
           {"i := ADD(i);", "2:6: ADD has 1 value; it takes 2 to 64"},
           {"i := ADD(EN := j, i, 1);", "2:16: 'j' is INT, which does not go into BOOL by itself"},
           {"i := ADD(EN := b, EN := b, i, 1);", "2:19: 'EN' is given twice; once a call"},
           {"i := LEN(j);", "2:10: LEN does not take INT; it takes a STRING: X_TO_STRING(...) makes one"},
           {"s := LEFT(s, x);",
            "2:14: LEFT does not take LREAL; lengths and places are whole numbers, from 1"},
           {"i := STRING_TO_INT(i);", "2:20: 'i' is INT, which does not go into STRING by itself"},
           {"d := TIME_TO_DATE(T#1s);", "2:19: TIME_TO_DATE does not take TIME"},
           {"b := TOD#12:00:00 + TOD#1:00:00 > TOD#3:00:00;",
            "2:19: '+' does not go with TOD and TOD; a TIME goes to a TOD or DT, and lies between two of a "
            "kind"},
           {"b := D#2023-02-29 > D#2023-02-28;",
            "2:6: 'D#2023-02-29' is no DATE; D#1970-01-01 to D#2106-02-06"},
           {"b := TOD#24:00:00 > TOD#1:00:00;",
            "2:6: 'TOD#24:00:00' is no TOD; TOD#00:00:00 to TOD#23:59:59.999"},
           {"d := 16#FFFF_FFFF_FFFF_FFFF;",
            "2:6: the constant 18446744073709551615 is out of the range of DINT"},
           {"x := SQRT(1, 2);", "2:6: SQRT has 2 values; it takes 1"},
           {"x := SQRT(INN := 1);",
            "2:11: SQRT has no input 'INN'; give the values in their order, without names"},
           {"i := TRUNC(i);", "2:12: TRUNC does not take INT; it takes REAL and LREAL"},
           {"i := MUX(5, i, j);", "2:10: MUX has no value 5; 0 to 1"},
           {"TON(IN := b);", "2:1: there is no function 'TON'; it is a kind of function block"},
           {"t(b, T#1s, 3);", "2:12: TON has 2 inputs; leave the rest out"},
           {"t(b, T#1s, 3, 4);", "2:12: TON has 2 inputs; leave the rest out"},
           {"t(b, PT := T#1s);", "2:3: an argument of 't' without a name; name its input: IN := value"},
           {"t(IN := b, IN := b);", "2:12: 'IN' is given twice; once a call"},
           {"t(Q => 5);", "2:8: the output 'Q' goes into a variable"},
           {"t(IN => b);", "2:3: 'IN' is an input of TON; IN := value gives it"},
           {"IF b i := 1; END_IF", "2:6: THEN is missing before 'i'"},
           {"IF b := TRUE THEN i := 1; END_IF", "2:6: ':=' assigns; '=' compares"},
           {"WHILE b DO i := 1;",
            "3:1: END_WHILE is missing before 'END_PROGRAM'; it closes the WHILE of line 2"},
           {"FOR i := 0 TO 9 BY 0 DO END_FOR", "2:20: FOR with a step of 0 never ends"},
           {"REPEAT i := 1; END_REPEAT", "2:16: UNTIL is missing before 'END_REPEAT'"},
           {"CASE i OF j: b := TRUE; END_CASE", "2:11: a label of a CASE that is not constant"},
           {"CASE x OF 1: b := TRUE; END_CASE", "2:6: CASE chooses by LREAL"},
           {"i := SUPER^.M();", "2:6: there is no SUPER here; it is what a block EXTENDS"},
           {"CASE i OF 3..1: b := TRUE; END_CASE", "2:11: 3..1 is empty"},
           {"END_IF", "2:1: 'END_IF' closes nothing"},
           {"IF b THEN i := 1; ENDIF", "2:19: there is no word 'ENDIF'; did you mean 'END_IF'?"},
           {"IF b THEN i := 1; ELSEIF (i > j) THEN i := 2; END_IF",
            "2:19: there is no word 'ELSEIF'; did you mean 'ELSIF'?"},
           {"WHILE b DO i := 1; EndWhile;", "2:20: there is no word 'EndWhile'; did you mean 'END_WHILE'?"},
           {"FOR i := 0 TO 9 DO j := i; ENDFOR;", "2:28: there is no word 'ENDFOR'; did you mean 'END_FOR'?"},
           {"CASE i OF 1: b := TRUE; ENDCASE;", "2:25: there is no word 'ENDCASE'; did you mean 'END_CASE'?"},
           {"REPEAT i := 1; UNTIL b ENDREPEAT",
            "2:24: there is no word 'ENDREPEAT'; did you mean 'END_REPEAT'?"},
           {"CONTINUE;", "2:1: CONTINUE stands in no loop"},
           {"i := 1", "2:7: ';' is missing before 'END_PROGRAM'"},
           {"i := (1 + 2;", "2:12: ')' is missing before ';'"},
           {"VAR k : INT; END_VAR", ""},
           {"s := 'abc;", "2:6: a string is not closed on its line; end it with '"},
           {"s := 'a$qb';", "2:8: '$' begins no character that is known"},
           {"i := 99999999999999999999;", "2:6: '99999999999999999999' is out of range"},
           {"i := 5x;", "2:6: '5x' is neither a number nor a name; names begin with a letter"},
           {"t(PT := 5s);", "2:9: '5s' is neither a number nor a name; a TIME is written T#5s"},
           {"t(PT := 1.5s);", "2:9: '1.5s' is neither a number nor a name; a TIME is written T#1.5s"},
           {"t(PT := 5);", "2:9: the number 5 is no TIME; a TIME is written T#500ms"},
           {"i := INT#x;", "2:10: INT# has no number"},
           {"b := T#0.5ms > T#1s;", "2:6: 'T#0.5ms' is finer than a TIME"},
           {"i := 3#12;", "2:6: '3#12' has no base that is known"},
           {"(* i := 1;", ""},
       }) {
    const auto problems = in_program(row.statements);
    if (*row.problem == '\0') continue;
    EXPECT_THAT(problems, ElementsAre(StartsWith(row.problem))) << row.statements;
  }
}

TEST(StErrors, StructuresOfDifferentTypesAreNotAssigned) {
  expect_problems(
      "TYPE A : STRUCT u : INT; END_STRUCT; B : STRUCT u : INT; v : INT; END_STRUCT; E : "
      "(P1, P2); F : (Q1); END_TYPE\n"
      "PROGRAM m VAR a : A; b : B; e : E; f : F; g : ARRAY [0..1] OF INT; h : ARRAY "
      "[0..2] OF INT; END_VAR\n"
      "a := b;\ne := f;\ng := h;\ne := Q1;\nIF e = f THEN END_IF\nEND_PROGRAM",
      {"3:6: 'b' is B, which does not go into A", "4:6: 'f' is F, which does not go into E",
       "5:6: 'h' is ARRAY [0..2] OF INT", "6:6: ", "7:6: '=' does not go with E and F"});
}

TEST(StErrors, AnArgumentWithoutANameIsToldTheBlocksOwnInput) {
  expect_problems(
      "PROGRAM m VAR_EXTERNAL Slide : AXIS_REF; END_VAR VAR pwS : MC_Power; END_VAR\n"
      "pwS(Slide, Enable := TRUE);\nEND_PROGRAM",
      {"2:5: an argument of 'pwS' without a name; name its input: Axis := value$"});
}

TEST(StErrors, OfWholeFiles) {
  expect_problems(
      "", {"1:1: the file has no PROGRAM; PROGRAM name ... END_PROGRAM is what the controller runs$"});
  expect_problems("PROGRAM m\nVAR i : INT; END_VAR i := 1;",
                  {"1:1: PROGRAM has no END_PROGRAM; write END_PROGRAM at the end"});
  expect_problems("i := 1;\nPROGRAM m END_PROGRAM", {"1:1: 'i' stands outside of all units"});
  expect_problems("PROGRAM m (* open\nEND_PROGRAM", {"1:11: '(*' is never closed; end it with '*)'"});
  expect_problems("FUNCTION_BLOCK F END_FUNCTION_BLOCK FUNCTION F : INT END_FUNCTION PROGRAM m END_PROGRAM",
                  {"1:46: 'F' is declared twice"});
  expect_problems("FUNCTION_BLOCK MC_Power END_FUNCTION_BLOCK PROGRAM m END_PROGRAM",
                  {"1:16: 'MC_Power' is a type of the controller"});
}

TEST(StErrors, OfDeclarations) {
  for (const Row& row :
       {Row{"a : INT (3..1);", "1:23: a range from 3 to 1 is empty; the lower bound stands first$"},
        {"a : ULINT := -1;",
         "1:28: the constant -1 is out of the range of ULINT; 0 to 18446744073709551615$"},
        {"a : REAL (1..3);", "1:24: a range of REAL; whole numbers have ranges"},
        {"a : INT (0..9) := 10;", "1:33: the constant 10 is out of the range of INT (0..9); 0 to 9$"},
        {"a : ARRAY [3..1] OF INT;", "1:26: an array from 3 to 1 is empty"},
        {"a : ARRAY [0..9999999] OF INT;", "1:26: the array is too large"},
        {"a : INT; b : INT := a;", "1:35: a value that is not constant"},
        {"a : LREAL := SQRT(-1);", "1:28: SQRT of -1; it takes 0"},
        {"if : INT;", "1:15: the name of a variable is missing before 'if'; IF is a word of the language"},
        {"a, b AT %IX0.0 : BOOL;", "1:18: two variables at one place"},
        {"a AT %QX0.0 : INT;", "1:15: 'a' at a terminal is a BOOL, not INT"}})
    expect_problems("PROGRAM m VAR " + std::string(row.statements) + " END_VAR END_PROGRAM", {row.problem});
  EXPECT_THAT(problems_of("PROGRAM m VAR a : ARRAY [0..1] OF INT := [1, 2, 3]; END_VAR END_PROGRAM"),
              ElementsAre(HasSubstr("more values than the 2 elements")));
  EXPECT_THAT(problems_of("FUNCTION F : INT VAR t : TON; END_VAR END_FUNCTION PROGRAM m END_PROGRAM"),
              ElementsAre(HasSubstr("the function block 't' cannot be in VAR here")));
  expect_problems("PROGRAM m VAR CONSTANT a : INT; END_VAR END_PROGRAM",
                  {"1:24: 'a' is a constant without a value"});
  EXPECT_THAT(problems_of("PROGRAM m VAR a : INT;\na := 1;\nEND_PROGRAM"),
              testing::Contains(StartsWith("1:11: VAR has no END_VAR")));
}

TEST(StErrors, OfWhatHasNoValueSayWhatItIs) {
  expect_problems("FUNCTION G\nG := 1;\nEND_FUNCTION PROGRAM m END_PROGRAM",
                  {"2:1: 'G' has no result; give it one where it is declared: G : INT$"});
  expect_problems(
      "FUNCTION G : INT G := 1; END_FUNCTION PROGRAM m VAR i : INT; END_VAR\ni := G;\nEND_PROGRAM",
      {"2:6: 'G' is no variable; it is a FUNCTION: G(...) calls it$"});
  expect_problems(
      "TYPE P2 : STRUCT x : INT; END_STRUCT END_TYPE PROGRAM m VAR a, b : P2; c : BOOL; END_VAR\n"
      "a := SEL(c, a, b);\nEND_PROGRAM",
      {"2:13: SEL does not take P2; numbers, bits, times and texts; IF chooses between others$"});
  expect_problems("TYPE c : REAL (a, b); END_TYPE PROGRAM m VAR v : c; END_VAR END_PROGRAM",
                  {"1:10: an enumeration of REAL; its values are whole numbers: (a, b) or INT (a, b)"});
  // Its values are known for all that.
  expect_problems("TYPE c : TIME (a, b); END_TYPE PROGRAM m VAR v : c := b; END_VAR v := a; END_PROGRAM",
                  {"1:10: an enumeration of TIME"});
}

TEST(StErrors, UnknownNamesAreToldOncePerPou) {
  EXPECT_THAT(in_program("i := kk; j := kk; kk := 3; kk.a[2](x := 1);"),
              ElementsAre(StartsWith("2:6: 'kk' is not declared")));
}

TEST(StErrors, AxesAndTablesThatTheTextNamesAreListed) {
  Problems problems;
  const Program program = compile(
      "PROGRAM m VAR_EXTERNAL Web, Knife : AXIS_REF; END_VAR VAR a : MC_CAM_REF := (File := 'a.tab'); b : "
      "MC_CAM_REF; END_VAR\n"
      "b.File := 'b.tab'; b.File := 'a.tab'; END_PROGRAM",
      "f", problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(program.externals().size(), 2U);
  EXPECT_EQ(program.externals()[1].name, "Knife");
  EXPECT_EQ(program.externals()[1].column, 29);
  ASSERT_EQ(program.tables().size(), 2U);
  EXPECT_EQ(program.tables()[0].name, "a.tab");
  EXPECT_EQ(program.tables()[1].name, "b.tab");
  EXPECT_EQ(program.tables()[1].line, 2);
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
