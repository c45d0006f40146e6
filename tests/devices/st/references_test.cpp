// REF_TO, ^, REF(), counting with references as with addresses; nothing outside of what they are of is
// touched.
#include <gmock/gmock.h>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(StReferences, ReadAndWriteWhatTheyAreOf) {
  Bench bench(R"(TYPE Node : STRUCT value : INT; next : REF_TO Node; END_STRUCT END_TYPE
FUNCTION Sum : INT VAR_INPUT first : REF_TO Node; END_VAR
WHILE first <> NULL DO Sum := Sum + first^.value; first := first^.next; END_WHILE END_FUNCTION
PROGRAM p VAR a, b, c : Node; i, x : INT; r : REF_TO INT; t : TON; rt : REF_TO TON; q : BOOL; END_VAR
a.value := 1; b.value := 20; c.value := 300; a.next := REF(b); b.next := REF(c);
r := REF(i); r^ := 5; x := Sum(REF(a)) + r^;
rt := REF(t); rt^(IN := TRUE, PT := T#0s); q := rt^.Q;
END_PROGRAM)");
  bench.scan();
  bench.expect({{"i", 5}, {"x", 326}, {"q", 1}});
}

// As OSCAT has it: a text byte by byte, the bits of a REAL, an array behind an untyped address.
TEST(StReferences, SeeBytesWhateverTheTypeIs) {
  EXPECT_EQ(
      run("s : STRING := 'abc'; p : REF_TO BYTE; x : INT;",
          "p := REF(s) + 1; p^ := 16#58; x := BYTE_TO_INT(p^); IF s = 'aXc' THEN x := x + 1000; END_IF"),
      1000 + 0x58);
  EXPECT_EQ(run("r : REAL := 1.0; p : REF_TO DWORD; x : DWORD;",
                "p := REF(r); x := p^; p^ := p^ + 16#800000; "
                "IF r <> 2.0 THEN x := 0; END_IF"),
            0x3F800000);
  EXPECT_EQ(run("a : ARRAY [1..4] OF WORD := [4(16#1122)]; p : POINTER TO ARRAY [0..32000] OF BYTE; l : "
                "LWORD; x : INT;",
                "p := ADR(a); p^[7] := 16#AA; x := BYTE_TO_INT(p^[6]); l := p; p := l + 2; "
                "IF a[4] = 16#AA22 AND p^[0] = 16#22 THEN x := x + 1000; END_IF"),
            1000 + 0x22);
  EXPECT_EQ(run("a : ARRAY [0..9] OF DINT; s : STRING(20); x : DINT;",
                "x := SIZEOF(a) * 100 + SIZEOF(s) + SIZEOF(LREAL);"),
            4029);
}

TEST(StReferences, BeginWithWhatHasItsPlace) {
  Bench bench(R"(VAR_GLOBAL g : INT := 7; pg : REF_TO INT := REF(g); END_VAR
FUNCTION_BLOCK B VAR x : INT; p : REF_TO INT := REF(x); END_VAR VAR_INPUT step : INT; END_VAR VAR_OUTPUT q : INT; END_VAR
p^ := p^ + step; q := x; END_FUNCTION_BLOCK
FUNCTION_BLOCK C EXTENDS B VAR own : REF_TO INT := REF(x); END_VAR
SUPER^(); q := q + own^; END_FUNCTION_BLOCK
PROGRAM m VAR a : ARRAY [0..2] OF INT := [1, 2, 3]; p : REF_TO INT := REF(a[1]); n : REF_TO INT := NULL;
b : ARRAY [0..1] OF B; c : C; x : INT; END_VAR
b[0](step := 1); b[1](step := 10); c(step := 100); x := p^; pg^ := pg^ + 1;
END_PROGRAM)");
  bench.scan(2);
  bench.expect({{"b[0].q", 2}, {"b[1].q", 20}, {"c.q", 400}, {"x", 2}, {"g", 9}});
  for (const char* text :
       {"FUNCTION F : INT VAR x : INT; p : REF_TO INT := REF(x); END_VAR F := p^; END_FUNCTION",
        "FUNCTION_BLOCK F VAR x : INT; END_VAR VAR_TEMP p : REF_TO INT := REF(x); END_VAR "
        "END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK F VAR x : TON; p : REF_TO INT := REF(x); END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK F VAR x : INT; p : ARRAY [0..1] OF REF_TO INT := [REF(x), NULL]; END_VAR "
        "END_FUNCTION_BLOCK"})
    EXPECT_THAT(problems_of(text + std::string(" PROGRAM m END_PROGRAM")), testing::SizeIs(1)) << text;
}

TEST(StReferences, StopTheProgramWhereTheyAreOfNothing) {
  const auto fault = [](const std::string& statements) {
    const auto found = fault_in_first_scan(
        "PROGRAM p VAR i : INT; p : REF_TO INT; s : STRING(15); c : REF_TO BYTE; "
        "n : LWORD; t : TON; END_VAR\n" +
        statements + "\nEND_PROGRAM");
    return found ? found->text : "";
  };
  EXPECT_THAT(fault("i := p^;"), HasSubstr("the reference is NULL"));
  EXPECT_THAT(fault("c := REF(s); c := c + 16; c^ := 0;"), HasSubstr("outside of what it is of"));
  EXPECT_THAT(fault("c := REF(s); c := c - 1; i := BYTE_TO_INT(c^);"), HasSubstr("outside of what it is of"));
  // Another place under the same kind: only plain data of that type may be seen.
  EXPECT_THAT(fault("c := REF(s); n := c; n := n + SHL(LWORD#1000, 24); c := n; c^ := 1;"),
              HasSubstr("outside of what it is of"));
}

TEST(StReferences, AreToldWhereTheyDoNotFit) {
  const auto told = [](const std::string& statements) {
    return problems_of(
        "TYPE S : STRUCT a : INT; END_STRUCT END_TYPE PROGRAM p VAR CONSTANT k : INT := 1; END_VAR "
        "VAR i : INT; p : REF_TO INT; s : S; q : REF_TO S; END_VAR\n" +
        statements + "\nEND_PROGRAM");
  };
  EXPECT_THAT(told("i := i^;"),
              ElementsAre(StartsWith("2:7: 'i' is INT, no reference; '^' stands behind a REF_TO")));
  EXPECT_THAT(told("q := REF(i);"),
              ElementsAre(StartsWith("2:6: a value of type REF_TO INT does not go into REF_TO S")));
  EXPECT_THAT(told("p := REF(1);"), ElementsAre(StartsWith("2:10: REF of what is no variable")));
  EXPECT_THAT(told("p := i;"),
              ElementsAre(StartsWith("2:6: a value of type INT does not go into REF_TO INT")));
  EXPECT_THAT(
      told("IF p = 5 THEN i := 1; END_IF"),
      ElementsAre(StartsWith("2:6: '=' does not go with REF_TO INT and a whole number; a reference is "
                             "compared with another one")));
  EXPECT_THAT(told("IF p < DWORD#5 THEN i := 1; END_IF"),
              ElementsAre(StartsWith("2:6: '<' does not go with REF_TO INT and DWORD")));
  EXPECT_THAT(told("p := p * 2;"),
              ElementsAre(StartsWith("2:8: '*' does not go with REF_TO INT and a whole number")));
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
