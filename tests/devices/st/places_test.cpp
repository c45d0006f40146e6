// %IX0.0, %IW0, %QW2, %MD4: places that the text names by their addresses.
#include <gmock/gmock.h>

#include <set>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

/// The terminals of a program by their addresses, as the controller gives and takes them.
struct Terminals {
  explicit Terminals(const std::string& text) : bench(text), program(compile(text, "f", problems)) {}

  void set(Kind kind, int number, bool level) {
    for (std::size_t i = 0; i < program.located().size(); ++i)
      if (program.located()[i].address == Address{kind, 0, number}) bench.runtime->set_located(i, level);
  }
  /// The numbers of the outputs that are on.
  std::set<int> on() const {
    std::set<int> numbers;
    for (std::size_t i = 0; i < program.located().size(); ++i)
      if (program.located()[i].address.kind == Kind::output && bench.runtime->located(i))
        numbers.insert(program.located()[i].address.number);
    return numbers;
  }

  Problems problems;
  Bench bench;
  Program program;
};

TEST(StPlaces, TerminalsWithoutVariables) {
  Terminals line(
      "PROGRAM p VAR w : WORD; END_VAR %QX0.1 := %IX0.0 AND NOT %ix0.1; w := %IW0; %QB1 := 16#81; "
      "END_PROGRAM");
  line.set(Kind::input, 0, true);
  line.set(Kind::input, 15, true);
  line.bench.scan();
  EXPECT_EQ(line.bench["w"], 0x8001);
  EXPECT_EQ(line.on(), (std::set<int>{1, 8, 15}));
  line.set(Kind::input, 1, true);
  line.bench.scan();
  EXPECT_EQ(line.bench["w"], 0x8003);
  EXPECT_EQ(line.on(), (std::set<int>{8, 15}));
  EXPECT_EQ(line.bench["%IX0.1"], 1);
}

TEST(StPlaces, WordsAtTerminals) {
  Terminals line(
      "PROGRAM p VAR i AT %IW1 : INT; q AT %QD0 : UDINT; END_VAR q := INT_TO_UDINT(-i); END_PROGRAM");
  for (int bit = 16; bit < 32; ++bit) line.set(Kind::input, bit, true);
  line.bench.scan();
  EXPECT_EQ(line.bench["i"], -1);
  EXPECT_EQ(line.on(), std::set<int>{0});
}

TEST(StPlaces, MeanTheVariableThatIsThere) {
  Terminals line(R"(VAR_GLOBAL g AT %QX2.0 : BOOL; END_VAR
FUNCTION_BLOCK f VAR_OUTPUT x : WORD; END_VAR %QX2.0 := NOT %QX2.0; %MW5 := %MW5 + 1; x := %MW7; END_FUNCTION_BLOCK
PROGRAM p VAR start AT %IX0.0 : BOOL; level AT %MW10 : INT; row AT %MW20 : ARRAY [0..3] OF INT; b : BOOL; i : INT; u : UINT; a : f; END_VAR
b := %IX0.0; %MW10 := -3; i := %MW10; %MW22 := i - 1; u := %MW10; a(); %MD20 := 70000; END_PROGRAM)");
  line.set(Kind::input, 0, true);
  line.bench.scan();
  line.bench.expect({{"b", 1},
                     {"level", -3},
                     {"i", -3},
                     {"row[2]", -4},
                     {"u", 65533},
                     {"g", 1},
                     {"%MW5", 1},
                     {"%MD20", 70000}});
}

TEST(StPlaces, AreRefusedWhereTheyCannotBe) {
  const auto told = [](const std::string& statements) {
    return problems_of(
        "VAR_GLOBAL d AT %MD5 : DINT; q AT %QX0.0 : BOOL; END_VAR PROGRAM p VAR i : INT; r : REAL; "
        "END_VAR\n" +
        statements + "\nEND_PROGRAM");
  };
  EXPECT_THAT(told("%IX0.0 := TRUE;"), ElementsAre(StartsWith("2:1: '%IX0.0' is an input terminal")));
  EXPECT_THAT(told("i := %MW10;"), ElementsAre(StartsWith("2:6: '%MW10' and 'd' share memory")));
  EXPECT_THAT(told("%QW0 := 3; %QW0 := 4;"),
              ElementsAre(StartsWith("2:1: '%QW0' and 'q' are at one terminal")));
  EXPECT_THAT(told("i := %MB3;"), ElementsAre(StartsWith("2:6: '%MB3' is no memory that is known")));
  EXPECT_THAT(problems_of("PROGRAM p VAR x AT %I* : BOOL; END_VAR END_PROGRAM"),
              ElementsAre(StartsWith("1:20: '%I*' says no place")));
  EXPECT_THAT(told("i := %ZX1;"), ElementsAre(StartsWith("2:6: '%ZX1' is no terminal that is known")));
  EXPECT_THAT(told("r := %ML3;"), ElementsAre(StartsWith("2:6: %ML3 stands without a variable")));
  EXPECT_THAT(told("i := %IB3;"), IsEmpty());
  EXPECT_THAT(problems_of("PROGRAM p VAR w : WORD := %MW0; END_VAR END_PROGRAM"),
              ElementsAre(StartsWith("1:27: '%MW0' is not constant; an address stands in statements")));
  EXPECT_THAT(told("r := %MD0;").size(), 1);
  EXPECT_THAT(problems_of("PROGRAM a VAR x AT %IX0.0 : BOOL; END_VAR END_PROGRAM PROGRAM b VAR y : BOOL; "
                          "END_VAR\ny := %IX0.0; END_PROGRAM"),
              ElementsAre(StartsWith("2:6: '%IX0.0' is 'x' of another PROGRAM")));
  EXPECT_THAT(problems_of("PROGRAM a VAR x AT %IW0 : BYTE; END_VAR END_PROGRAM"),
              ElementsAre(StartsWith("1:15: 'x' at 16 terminals is a whole number of that width, not BYTE")));
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
