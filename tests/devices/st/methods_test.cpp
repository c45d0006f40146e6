// METHOD, PROPERTY, ACTION, EXTENDS, INTERFACE.
#include <gmock/gmock.h>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string shapes =
    R"(INTERFACE Shape METHOD Area : LREAL VAR_INPUT scale : LREAL; END_VAR END_METHOD END_INTERFACE
FUNCTION_BLOCK Base
VAR calls : INT; END_VAR VAR_OUTPUT runs : INT; END_VAR
runs := runs + 1;
METHOD PUBLIC Name : INT Name := 1; calls := calls + 1; END_METHOD
METHOD PUBLIC Twice : INT Twice := 2 * THIS^.Name(); END_METHOD
METHOD PROTECTED Hidden : INT Hidden := calls; END_METHOD
PROPERTY Calls2 : INT GET Calls2 := calls * 2; END_GET SET calls := Calls2 / 2; END_SET END_PROPERTY
ACTION clear: calls := 0; END_ACTION
END_FUNCTION_BLOCK
FUNCTION_BLOCK Square EXTENDS Base IMPLEMENTS Shape
VAR_INPUT side : LREAL := 3.0; END_VAR
SUPER^();
METHOD Name : INT Name := 10 + SUPER^.Name(); END_METHOD
METHOD Area : LREAL VAR_INPUT scale : LREAL; END_VAR Area := side * side * scale; END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Disc IMPLEMENTS Shape
METHOD Area : LREAL VAR_INPUT scale : LREAL; END_VAR VAR local : LREAL; END_VAR local := 7.0; Area := local * scale;
END_METHOD END_FUNCTION_BLOCK
)";

TEST(StMethods, RunOnTheirInstance) {
  Bench bench(shapes + R"(PROGRAM p VAR b, b2 : Base; x, y, z : INT; END_VAR
x := b.Name() + b.Name(); y := b.Calls2; b.Calls2 := 10; z := b.Calls2 * 100 + b2.Calls2; b2.clear(); b();
END_PROGRAM)");
  bench.scan();
  bench.expect({{"x", 2}, {"y", 4}, {"z", 1000}, {"b.runs", 1}, {"b2.runs", 0}});
  EXPECT_EQ(bench.find("b.'kind"), -1);
}

TEST(StMethods, OverrideThoseOfWhatIsExtended) {
  Bench bench(shapes + R"(FUNCTION NameOf : INT VAR_IN_OUT b : Base; END_VAR NameOf := b.Name(); END_FUNCTION
PROGRAM p VAR b : Base; s : Square; x, y, z, runs : INT; a, c, d : LREAL; shape : Shape; disc : Disc; END_VAR
x := s.Twice(); y := b.Twice(); z := NameOf(s) * 100 + NameOf(b); s(); runs := s.runs;
shape := s; a := shape.Area(2.0); shape := disc; c := shape.Area(scale := 3.0); d := disc.Area(1.0);
END_PROGRAM)");
  bench.scan();
  bench.expect({{"x", 22}, {"y", 2}, {"z", 1101}, {"a", 18}, {"c", 21}, {"d", 7}, {"runs", 1}});
}

TEST(StMethods, AreToldWhereTheyDoNotFit) {
  const auto told = [](const std::string& statements, const std::string& units = "") {
    return problems_of(shapes + units +
                       "PROGRAM p VAR b : Base; s : Square; i : INT; shape : Shape; END_VAR\n" + statements +
                       "\nEND_PROGRAM");
  };
  EXPECT_THAT(told(""), IsEmpty());
  EXPECT_THAT(told("i := b.Hidden();"), ElementsAre(HasSubstr(":8: Hidden of Base is PRIVATE or PROTECTED")));
  EXPECT_THAT(told("shape := b;"),
              ElementsAre(HasSubstr(":10: a value of type Base does not go into Shape")));
  EXPECT_THAT(told("b.clear(1);"), ElementsAre(HasSubstr("clear has 0 inputs; leave the rest out")));
  EXPECT_THAT(told("i := b.clear();"), ElementsAre(HasSubstr("clear gives no value")));
  EXPECT_THAT(told("", "FUNCTION_BLOCK Lacks IMPLEMENTS Shape END_FUNCTION_BLOCK "),
              ElementsAre(HasSubstr("Lacks lacks Area of Shape; METHOD Area ... END_METHOD")));
  EXPECT_THAT(told("", "FUNCTION_BLOCK Other EXTENDS Base METHOD Name : REAL END_METHOD END_FUNCTION_BLOCK "),
              ElementsAre(HasSubstr("Name of Other has not the pins of that of Base")));
  EXPECT_THAT(told("",
                   "FUNCTION_BLOCK ABSTRACT A END_FUNCTION_BLOCK FUNCTION_BLOCK B VAR a1 : A; END_VAR "
                   "END_FUNCTION_BLOCK "),
              ElementsAre(HasSubstr("A is ABSTRACT and has no instances")));
  EXPECT_THAT(
      told("", "FUNCTION_BLOCK FINAL F END_FUNCTION_BLOCK FUNCTION_BLOCK G EXTENDS F END_FUNCTION_BLOCK "),
      ElementsAre(HasSubstr("'F' is FINAL")));
  EXPECT_THAT(told("", "FUNCTION_BLOCK G EXTENDS Nobody END_FUNCTION_BLOCK "),
              ElementsAre(HasSubstr("there is no FUNCTION_BLOCK 'Nobody'")));
  EXPECT_THAT(told("", "FUNCTION_BLOCK H METHOD m : INT m := 1; END_FUNCTION_BLOCK "),
              ElementsAre(HasSubstr("METHOD has no END_METHOD")));
}

TEST(StMethods, StopTheProgramWhereTheyCallThemselves) {
  const auto fault = fault_in_first_scan(
      "INTERFACE I METHOD m : INT END_METHOD END_INTERFACE FUNCTION_BLOCK F IMPLEMENTS I VAR_INPUT other : "
      "I; END_VAR "
      "METHOD m : INT m := other.m(); END_METHOD END_FUNCTION_BLOCK PROGRAM p VAR f1 : F; x : INT; END_VAR "
      "f1.other := f1; x := f1.m(); END_PROGRAM");
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->text, StartsWith("m calls itself"));
  const auto nothing = fault_in_first_scan(
      "INTERFACE I METHOD m : INT END_METHOD END_INTERFACE PROGRAM p VAR i : I; x : INT; END_VAR x := i.m(); "
      "END_PROGRAM");
  ASSERT_TRUE(nothing);
  EXPECT_THAT(nothing->text, StartsWith("the interface stands for nothing"));
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
