#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using testing::text_of;

struct Case {
  std::string expression;
  double value;
};

// What `slR = expression` leaves in the long slR, with slA = 7 and slB = 2.
double evaluated(const std::string& expression, const std::string& variable = "slR") {
  Bench bench({"slA = 7\nslB = 2\nssA = 2.5\nagTemp[3] = 30\nddbCode[2, 3] = 23\nddlHead[2] = 200\n" +
               variable + " = " + expression + "\nEND\n"});
  if (!bench.controller) {
    ADD_FAILURE() << expression << ": " << text_of(bench.problems);
    return 0;
  }
  bench.step();
  EXPECT_EQ(bench["QMOS.oserr"], 0) << expression;
  return bench[variable];
}

TEST(QmoveExpression, Operators) {
  const std::vector<Case> cases = {{"slA + slB", 9},
                                   {"slA - slB", 5},
                                   {"slA * slB", 14},
                                   {"slA / slB", 3},
                                   {"slA % slB", 1},
                                   {"- slA / slB", -3},
                                   {"- slA % slB", -1},
                                   {"-slA", -7},
                                   {"- 100", -100},
                                   {"- - 3", 3},
                                   {"slA EQ 7", 1},
                                   {"slA EQ 6", 0},
                                   {"slA NEQ 7", 0},
                                   {"slA NE 6", 1},
                                   {"slA LT 7", 0},
                                   {"slA LT 8", 1},
                                   {"slA LE 7", 1},
                                   {"slA LE 6", 0},
                                   {"slA GT 6", 1},
                                   {"slA GT 7", 0},
                                   {"slA GE 7", 1},
                                   {"slA GE 8", 0},
                                   {"slA AND slB", 1},
                                   {"slA AND 0", 0},
                                   {"0 OR slB", 1},
                                   {"0 OR 0", 0},
                                   {"NOT slA", 0},
                                   {"NOT 0", 1},
                                   {"12 ANDB 10", 8},
                                   {"12 ORB 10", 14},
                                   {"12 XORB 10", 6},
                                   {"NOTB 0", -1},
                                   {"NOTB 5", -6},
                                   {"slA eq 7", 1},
                                   {"not 0", 1},
                                   {"(slA)", 7},
                                   {"cTen", 10},
                                   {"cMinus", -3},
                                   {"agTemp[3]", 30},
                                   {"ddbCode[2,3]", 23},
                                   {"ddlHead [ 2 ]", 200},
                                   {"agTemp[slB + 1]", 30},
                                   {"ddbCode [slB , slA - 4]", 23},
                                   {"0004", 4}};
  for (const Case& c : cases) EXPECT_EQ(evaluated(c.expression), c.value) << c.expression;
}

// Each line would give another value if its two operators bound the other way round (spec D8).
TEST(QmoveExpression, Precedence) {
  const std::vector<Case> cases = {
      {"2 + 3 * 4", 14},       // * over +
      {"2 * 3 + 4", 10},       //
      {"20 - 8 / 4", 18},      // / over -
      {"20 - 9 % 4", 19},      // % over -
      {"20 - 5 - 3", 12},      // from the left
      {"100 / 10 / 5", 2},     //
      {"100 / 10 * 5", 50},    // * and / alike
      {"- 2 + 5", 3},          // sign over +
      {"1 + 1 EQ 2", 1},       // + over comparison
      {"2 EQ 1 + 1", 1},       //
      {"5 GT 3 GT 2", 0},      // comparisons from the left: (5 GT 3) GT 2
      {"6 ANDB 3 EQ 3", 0},    // comparison over ANDB: 6 ANDB 1
      {"6 XORB 3 ANDB 2", 4},  // ANDB over XORB: 6 XORB 2
      {"1 ORB 3 XORB 2", 1},   // XORB over ORB: 1 ORB 1
      {"1 ORB 2 AND 0", 0},    // ORB over AND: 3 AND 0
      {"1 OR 1 AND 0", 1},     // AND over OR
      {"0 AND 1 OR 1", 1},     //
      {"NOT 0 AND 0", 0},      // NOT over AND
      {"NOT 1 EQ 0", 1},       // NOT over comparison: (NOT 1) EQ 0
      {"NOT 3 + 1", 1},        // NOT over +
      {"NOTB 0 ANDB 1", 1},    //
      {"NOT (1 EQ 0)", 1},     // parentheses over all
      {"(2 + 3) * 4", 20},     //
      {"- (2 + 3)", -5},       //
      {"NOT NOT 5", 1},        //
  };
  for (const Case& c : cases) EXPECT_EQ(evaluated(c.expression), c.value) << c.expression;
}

TEST(QmoveExpression, LongsWrapAndNeverTrap) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  constexpr double least = std::numeric_limits<std::int32_t>::min();
  const std::vector<Case> cases = {{"2147483647 + 1", least},     {"-2147483648 - 1", most},
                                   {"65536 * 65536", 0},          {"-2147483648 / (0 - 1)", least},
                                   {"-2147483648 % (0 - 1)", 0},  {"-(-2147483648)", least},
                                   {"2147483647", most},          {"- 2147483648", least},
                                   {"2147483647 * 2147483647", 1}};
  for (const Case& c : cases) EXPECT_EQ(evaluated(c.expression), c.value) << c.expression;
}

TEST(QmoveExpression, StoresWrapToTheSizeOfTheirDestination) {
  EXPECT_EQ(evaluated("132", "sbKept"), -124);  // the G codes of the datagroup example
  EXPECT_EQ(evaluated("-129", "sbKept"), 127);
  EXPECT_EQ(evaluated("40000", "swKept"), 40000 - 65536);
  EXPECT_EQ(evaluated("256", "sfKept"), 1);  // not the lowest byte, which is 0
  EXPECT_EQ(evaluated("0", "sfKept"), 0);
  EXPECT_EQ(evaluated("0.25", "sfKept"), 1);
  EXPECT_EQ(evaluated("200", "agTemp[1]"), 200);
  EXPECT_EQ(evaluated("132", "ddbCode[1,2]"), -124);
}

TEST(QmoveExpression, Singles) {
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("1 / 4.0", "ssR")), 0.25F);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("ssA * 2", "ssR")), 5.0F);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("slA / slB", "ssR")), 3.0F);  // longs divide before
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("slA / ssA", "ssR")), 2.8F);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("cHalf - 1", "ssR")), -0.5F);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("-ssA", "ssR")), -2.5F);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("ssA", "asReal[2]")), 2.5F);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluated("ssA", "ddsReal[2,2]")), 2.5F);
  const std::vector<Case> cases = {{"ssA", 2},
                                   {"-ssA", -2},
                                   {"ssA + 0.5", 3},
                                   {"ssA GT 2", 1},
                                   {"2 GE ssA", 0},
                                   {"ssA LT 2.75", 1},
                                   {"ssA LE 2.5", 1},
                                   {"ssA EQ 2.5", 1},
                                   {"ssA NEQ 2.5", 0},
                                   {"ssA AND 1", 1},
                                   {"1 AND 0.0", 0},
                                   {"0.0 OR 0.25", 1},
                                   {"NOT ssA", 0},
                                   {"NOT 0.0", 1},
                                   {"NOT - 0.0", 1},
                                   {"1 AND - 0.0", 0},
                                   {"3000000000.0", 2147483647},
                                   {"-3000000000.0", -2147483648.0},
                                   {"agTemp[3.9]", 30}};
  for (const Case& c : cases) EXPECT_EQ(evaluated(c.expression), c.value) << c.expression;
}

TEST(QmoveExpression, ReadsInputsOutputsAndDevices) {
  Bench bench({"slA = ifStart + 2 * ofLamp\nslB = Axis:reading + axis.READING\nslR = Axis:code3\nEND\n"});
  ASSERT_TRUE(bench.controller) << text_of(bench.problems);
  bench.controller->cards().inputs.at({Kind::input, 2, 1}).level = true;
  bench.controller->cards().outputs.at({Kind::output, 2, 1}).level = true;
  bench.controller->cards().counters.at({Kind::counter, 2, 1}).count = 21;
  bench.set("Axis.code3", 99);
  bench.step();
  EXPECT_EQ(bench["slA"], 3);
  EXPECT_EQ(bench["slB"], 42);
  EXPECT_EQ(bench["slR"], 99);
}

// The deepest expression that compiles also runs; one level more is refused, not a crash.
TEST(QmoveExpression, DepthIsLimited) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '(') + "1" +
           std::string(static_cast<std::size_t>(depth), ')');
  };
  EXPECT_EQ(evaluated(nested(max_depth - 1)), 1);
  const auto right_deep = [](int depth) {
    std::string text;
    for (int i = 1; i < depth; ++i) text += "1 + (";
    return text + "1" + std::string(static_cast<std::size_t>(depth - 1), ')');
  };
  EXPECT_EQ(evaluated(right_deep(max_depth - 1)), max_depth - 1);
  for (const std::string& text :
       {nested(max_depth), nested(5000), right_deep(max_depth + 1), right_deep(3000)}) {
    const Bench bench({"slR = " + text + "\nEND\n"});
    ASSERT_EQ(bench.problems.size(), 1U) << text_of(bench.problems);
    EXPECT_EQ(bench.problems[0].what, "the expression is nested too deep");
  }
}

}  // namespace
}  // namespace drycut::devices::qmove
