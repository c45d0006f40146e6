#include "sim/scenario/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "sim/scenario/scenario.hpp"

namespace drycut::sim::scenario {
namespace {

using Numbers = std::map<std::string, double>;

std::optional<Expression> compile(std::string_view text, const Numbers& numbers,
                                  std::vector<ExpressionFault>& faults) {
  std::vector<std::string> known;
  for (const auto& [name, number] : numbers) known.push_back(name);
  return Expression::compile(
      text,
      [&numbers](const std::string& name) {
        const auto found = numbers.find(name);
        return found == numbers.end() ? nullptr : &found->second;
      },
      known, faults);
}

Evaluation evaluate(std::string_view text, const Numbers& numbers) {
  std::vector<ExpressionFault> faults;
  const auto expression = compile(text, numbers, faults);
  if (!expression) {
    ADD_FAILURE() << text << ": " << faults.at(0).what;
    return {};
  }
  return expression->evaluate();
}

// "offset: what; remedy" of all faults, separated by " | ".
std::string faults_of(std::string_view text, const Numbers& numbers = {{"x", 1}, {"AxisX.posit", 2}}) {
  std::vector<ExpressionFault> faults;
  EXPECT_FALSE(compile(text, numbers, faults)) << text;
  std::string all;
  for (const auto& fault : faults) {
    all +=
        (all.empty() ? "" : " | ") + std::to_string(fault.offset) + ": " + fault.what + "; " + fault.remedy;
  }
  return all;
}

TEST(Expression, OfManyNamesThoseThatBeginAlikeAreTold) {
  Numbers many;
  for (int i = 0; i < 100; ++i) many["AxisX.value" + std::to_string(i)] = 0;
  for (const auto* name : {"gbStep", "gbTour", "slLength"}) many[name] = 0;
  EXPECT_EQ(
      faults_of("gbPhase == 1", many),
      "0: unknown name 'gbPhase'; known are gbStep, gbTour, AxisX.value0, AxisX.value1, AxisX.value10 and 98 "
      "more");
  EXPECT_EQ(faults_of("gbPhase == 1", {}), "0: unknown name 'gbPhase'; no name is known here; write numbers");
}

// Below 100 there is a hundred to use up; between two limits what counts is the way from their middle.
TEST(Expression, HowMuchOfTheLimitIsUsed) {
  const struct {
    const char* text;
    double x;
    std::optional<double> used;
  } cases[] = {{"x < 100", 24, 0.24},
               {"100 > x", 24, 0.24},
               {"x <= 100", 150, 1.5},
               {"x < 100", -5, 0},
               {"x > 100", 400, 0.25},
               {"x >= 100", 50, 2},
               {"x < -30", -60, 0.5},
               {"x < -30", -15, 2},
               {"x > -30", -15, 0.5},
               {"abs(x - 800) <= 0.5", 800.25, 0.5},
               {"x >= 799.5 && x <= 800.5", 800.25, 0.5},
               {"799.5 < x && 800.5 > x", 799.75, 0.5},
               {"x < 100 && y < 10", 90, 0.5},
               {"x < 5 * y", 10, 0.4},
               {"x <= 0", -3, {}},
               {"x == 3", 3, {}},
               {"x", 1, {}}};
  for (const auto& [text, x, used] : cases) {
    const Numbers numbers = {{"x", x}, {"y", 5}};
    std::vector<ExpressionFault> faults;
    const auto expression = compile(text, numbers, faults);
    ASSERT_TRUE(expression) << text;
    const auto found = expression->used(expression->evaluate().term);
    ASSERT_EQ(found.has_value(), used.has_value()) << text;
    EXPECT_NEAR(found.value_or(0), used.value_or(0), 1e-9) << text;
  }
  const Numbers beyond = {{"x", 3}};
  std::vector<ExpressionFault> faults;
  const auto expression = compile("x < -30", beyond, faults);
  EXPECT_TRUE(std::isinf(*expression->used(expression->evaluate().term))) << "on the wrong side of 0";
}

TEST(Expression, WhichRangeTheTermsLeaveAName) {
  constexpr double open = std::numeric_limits<double>::infinity();
  const struct {
    const char* text;
    double low;
    double high;
  } cases[] = {{"abs(x - 800) <= 0.1", 799.9, 800.1},
               {"0.1 >= abs(800 - x)", 799.9, 800.1},
               {"abs(2 * x) < 10", -5, 5},
               {"x < 800.1 && x > 799.9", 799.9, 800.1},
               {"800.1 > x", -open, 800.1},
               {"-1 * x < 3", -3, open},
               {"x > 1 && x > 2 && x < 9 && x < 7", 2, 7},
               {"abs(x) <= 2 && y < 1", -2, 2},
               {"abs(x) > 2", -open, open},
               {"x < y", -open, open},
               {"x * x < 4", -open, open},
               {"y < 4", -open, open},
               {"x == 3", -open, open}};
  for (const auto& [text, low, high] : cases) {
    const Numbers numbers = {{"x", 1}, {"y", 5}};
    std::vector<ExpressionFault> faults;
    const auto expression = compile(text, numbers, faults);
    ASSERT_TRUE(expression) << text;
    EXPECT_FALSE(std::isnan(expression->evaluate().margin.value_or(0)));
    const auto [from, until] = expression->range_of(&numbers.at("x"));
    EXPECT_DOUBLE_EQ(from, low) << text;
    EXPECT_DOUBLE_EQ(until, high) << text;
  }
}

TEST(Expression, HoldsOrNot) {
  const Numbers numbers = {{"x", 3}, {"y", -2}, {"zero", 0}};
  const struct {
    const char* text;
    bool holds;
  } cases[] = {{"x == 3", true},
               {"x != 3", false},
               {"x", true},
               {"zero", false},
               {"!zero", true},
               {"!x", false},
               {"!(x < 5)", false},
               {"x < 5 && y < 0", true},
               {"x > 5 || y < 0", true},
               {"x > 5 || y > 0", false},
               {"x > 5 ? y > 0 : y < 0", true},
               {"x + y == 1", true},
               {"2 * x - -y == 4", true},
               {"x ^ 2 == 9", true},
               {"-x < y", true},
               {"1 / zero > 1e300", true},
               {"sqrt(y) < 100", false},
               {"(x < 5) && ((y < 0))", true},
               {"x > 3", false},
               {"x >= 3", true},
               {"x < 3", false},
               {"x <= 3", true},
               {"x == 3 && y == -2", true},
               {"x == 3 && y == 2", false},
               {"2e0 < x", true},
               {".5e+1 > x", true}};
  for (const auto& [text, holds] : cases) EXPECT_EQ(evaluate(text, numbers).holds, holds) << text;
}

TEST(Expression, KnowsTheFunctions) {
  const Numbers numbers = {{"x", -2.25}};
  for (const char* text : {"abs(x) == 2.25", "abs (x) == 2.25", "min(x, 1, 2) == -2.25", "max(x, 1) == 1",
                           "sqrt(-x) == 1.5", "sign(x) == -1", "rint(x) == -2", "sin(0) == 0",
                           "abs(cos(_pi) + 1) < 1e-15", "sum(1, 2, 3) == 6", "avg(1, 3) == 2"}) {
    EXPECT_TRUE(evaluate(text, numbers).holds) << text;
  }
}

TEST(Expression, NamesMayHaveDotsIndicesAndLeadingDigits) {
  const Numbers numbers = {
      {"AxisX.st_sync", 1}, {"2.AN01", 5}, {"table[3]", 7}, {"recipe[2,5]", 9}, {"knife.servo.torque", 4}};
  for (const char* text :
       {"AxisX.st_sync == 1", "2.AN01 == 5", "table[3] == 7", "recipe[2, 5] == 9",
        "recipe[2,5]-table[3] == 2", "knife.servo.torque*2.AN01 == 20", "max(table[3],recipe[2,5]) == 9"}) {
    EXPECT_TRUE(evaluate(text, numbers).holds) << text;
  }
}

TEST(Expression, FollowsTheNumbersThatItReads) {
  Numbers numbers = {{"x", 1}};
  std::vector<ExpressionFault> faults;
  const auto expression = compile("abs(x) < 4", numbers, faults);
  ASSERT_TRUE(expression);
  for (double x = -10; x <= 10; x += 0.25) {
    numbers["x"] = x;
    const auto now = expression->evaluate();
    EXPECT_EQ(now.holds, std::abs(x) < 4);
    EXPECT_EQ(now.margin, 4 - std::abs(x));
  }
}

TEST(Expression, MarginIsTheLeastRoomOfAConjunction) {
  const Numbers numbers = {{"length", 500.05}, {"force", 130}, {"speed", 60}};
  const struct {
    const char* text;
    double margin;
    int term;
    bool holds;
  } cases[] = {
      {"abs(length - 500) <= 0.2", 0.2 - std::abs(500.05 - 500), 0, true},
      {"length > 499", 500.05 - 499, 0, true},
      {"length >= 501", 500.05 - 501, 0, false},
      {"499 < length", 500.05 - 499, 0, true},
      {"length < 510 && force < 131 && speed > 50", 1, 1, true},
      {"(length < 510) && (force < 131 && (speed > 59.5))", 0.5, 2, true},
      {"length < 510 && force < 100 && speed > 70", -30, 1, false},
      {"speed < 60", 0, 0, false},
      {"speed <= 60", 0, 0, true},
  };
  for (const auto& [text, margin, term, holds] : cases) {
    const auto result = evaluate(text, numbers);
    ASSERT_TRUE(result.margin) << text;
    EXPECT_DOUBLE_EQ(*result.margin, margin) << text;
    EXPECT_EQ(result.term, term) << text;
    EXPECT_EQ(result.holds, holds) << text;
  }
}

TEST(Expression, OtherFormsPassOrFailOnly) {
  const Numbers numbers = {{"x", 3}, {"y", 1}};
  for (const char* text :
       {"x == 3", "x < 5 || y < 0", "x < 5 && y == 1", "!(x > 5)", "x < 5 ? 1 : 0", "(x < 5) * 1", "x"}) {
    const auto result = evaluate(text, numbers);
    EXPECT_TRUE(result.holds) << text;
    EXPECT_FALSE(result.margin) << text;
  }
  EXPECT_EQ(evaluate("x == 3 && y == 2 && x == 4", numbers).term, 1);  // the first that fails
}

TEST(Expression, TermsAreTheTextsBetweenTheAnds) {
  std::vector<ExpressionFault> faults;
  const Numbers numbers = {{"a", 1}, {"b", 2}};
  const auto expression = compile(" (a <  1 && abs( b )>2)&& (a == 1 || b == 2) ", numbers, faults);
  ASSERT_TRUE(expression);
  EXPECT_EQ(expression->terms(), (std::vector<std::string>{"a <  1", "abs( b )>2", "a == 1 || b == 2"}));
  EXPECT_FALSE(expression->has_margin());
}

TEST(Expression, NothingHoldsWithoutANumber) {
  const Numbers numbers = {{"nan", std::numeric_limits<double>::quiet_NaN()}, {"x", 1}};
  for (const char* text :
       {"nan < 1", "nan > 1", "nan != 1", "!(nan > 5)", "nan", "x < 2 && nan < 1", "nan < 1 || x < 2"}) {
    const auto result = evaluate(text, numbers);
    EXPECT_FALSE(result.holds) << text;
    EXPECT_FALSE(result.margin) << text;
  }
  EXPECT_EQ(evaluate("x < 2 && nan < 1", numbers).term, 1);
  EXPECT_FALSE(evaluate("sqrt(-x) < 1", numbers).holds);
  EXPECT_FALSE(evaluate("sqrt(-x) < 1", numbers).margin);
}

TEST(Expression, SaysWhatIsWrongAndWhere) {
  const struct {
    const char* text;
    const char* fault;
  } cases[] = {
      {"", "0: the expression is empty; write a comparison, for example follerr < 400"},
      {"  ", "0: the expression is empty; write a comparison, for example follerr < 400"},
      {"x <", "3: the expression ends where a value must follow; add a name or a number"},
      {"x + 9000", "0: 'x + 9000' is a number, not a condition; compare it with a limit: < <= > >= == !="},
      {"x < 3 && abs(x)",
       "9: 'abs(x)' is a number, not a condition; compare it with a limit: < <= > >= == !="},
      {"1", "0: '1' is a number, not a condition; compare it with a limit: < <= > >= == !="},
      {"x < * 3", "4: a value is missing before '*'; add a name or a number"},
      {"&& x", "0: a value is missing before '&&'; add a name or a number"},
      {"abs()", "4: a value is missing before ')'; add a name or a number"},
      {"x < 3 mn",
       "6: an operator is missing before 'mn'; add + - * / < > == && or ||; a unit stands behind its number: "
       "9.5 N m, 60 m/min"},
      {"x (3)",
       "0: unknown function 'x'; known: abs, acos, acosh, asin, asinh, atan, atan2, atanh, avg, cos, "
       "cosh, exp, ln, log, log10, log2, max, min, rint, sign, sin, sinh, sqrt, sum, tan, tanh"},
      {"(x < 3", "0: this ( is not closed; add )"},
      {"x < 3)", "5: this ) closes nothing; remove it"},
      {"x = 3", "2: '=' does not compare; write =="},
      {"x =< 3", "2: '=<' does not compare; write <="},
      {"x => 3", "2: '=>' does not compare; write >="},
      {"x < 3 & x > 1", "6: '&' is not known; write &&"},
      {"x < 3 | x > 1", "6: '|' is not known; write ||"},
      {"x < 3, 4", "5: ',' stands only between the arguments of a function; write . in decimals"},
      {"1 < x < 3", "6: comparisons cannot be chained; write a < b && b < c"},
      {"x == 1 == 1", "7: comparisons cannot be chained; write a < b && b < c"},
      {"x ? 1", "5: ? without :; write condition ? value : other value"},
      {"(x ? 1) < 2", "6: ? without :; write condition ? value : other value"},
      {"x : 1", "2: ':' without '?'; write condition ? value : other value"},
      {"AxisX.posti < 3", "0: unknown name 'AxisX.posti'; did you mean AxisX.posit?"},
      {"x < 3 && AxisY.posit > 2 && z < 1",
       "9: unknown name 'AxisY.posit'; did you mean AxisX.posit? | 28: unknown name 'z'; known: AxisX.posit, "
       "x"},
      {"sqr(x) < 3", "0: unknown function 'sqr'; did you mean sqrt?"},
      {"1 + sin(1, x) < 3", "4: sin has too many arguments; remove some"},
      {"atan2(x) < 3", "0: atan2 has too few arguments; add what is missing"},
      {"x < mm", "4: unknown name 'mm'; a unit stands behind its number: 9.5 N m, 60 m/min"},
      {"rms(x) < 3", "0: rms looks at a window, and there is none; statistics stand in checks and metrics"},
      {"x < table[3", "9: this [ is not closed; write ] after the index"},
      {"x < table[i]", "10: 'i' in an index; an index is a number, or two: [3], [2,5]"},
      {"x < \"3\"",
       "4: '\"' has no meaning in an expression; use numbers, names, + - * / ^ < <= > >= == != && "
       "|| ! ?: and functions"},
      {"x \xE2\x89\xA4 3",
       "2: '\xE2\x89\xA4' has no meaning in an expression; use numbers, names, + - * / ^ < "
       "<= > >= == != && || ! ?: and functions"},
      {"x and 3",
       "2: an operator is missing before 'and'; add + - * / < > == && or ||; a unit stands behind its "
       "number: "
       "9.5 N m, 60 m/min"},
  };
  for (const auto& [text, fault] : cases) EXPECT_EQ(faults_of(text), fault) << text;
  EXPECT_EQ(faults_of(std::string(2001, ' ')), "0: the expression has 2001 characters; at most 2000");
}

TEST(Expression, FaultsOfAScenarioStandAtTheirPlaceInTheFile) {
  Scenario scenario;
  scenario.sources = {"line.yaml", "--set checks.0.expect"};
  const Text text{"length < y", {7, 20, 0}};
  const Text overridden{"length < y", {1, 1, 1}};
  Problems problems;
  const double length = 1;
  const auto resolve = [&](const std::string& name) { return name == "length" ? &length : nullptr; };
  EXPECT_FALSE(Expression::compile(text, scenario, resolve, {"length"}, problems));
  EXPECT_FALSE(Expression::compile(overridden, scenario, resolve, {"length"}, problems));
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(to_string(problems[0]),
            "line.yaml:7:29: unknown name 'y'; known: length [expression.unknown-name]");
  EXPECT_EQ(to_string(problems[1]),
            "--set checks.0.expect:1:10: unknown name 'y'; known: length [expression.unknown-name]");
}

TEST(Expression, NoTextCrashesIt) {
  std::mt19937_64 random(7);
  const std::string_view pieces[] = {"x",    "(",    ")", "<", "&&",   "||", "!",  "?",  ":",
                                     "abs(", "max(", ",", "1", "-",    "+",  "^",  "==", "[",
                                     "]",    "3.",   ".", "e", "\xC3", " ",  "_pi"};
  int compiled = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (auto n = random() % 12; n > 0; --n) text += pieces[random() % std::size(pieces)];
    std::vector<ExpressionFault> faults;
    const auto expression = compile(text, {{"x", 1}}, faults);
    EXPECT_EQ(expression.has_value(), faults.empty()) << text;
    for (const auto& fault : faults) EXPECT_LE(fault.offset, text.size()) << text;
    if (expression) ++compiled;
  }
  EXPECT_GT(compiled, 100);
  const std::string deep = std::string(900, '(') + "x" + std::string(900, ')');
  EXPECT_TRUE(evaluate(deep, {{"x", 1}}).holds);
  EXPECT_TRUE(evaluate("x" + std::string(900, ' ') + "< 2", {{"x", 1}}).holds);
}

}  // namespace
}  // namespace drycut::sim::scenario
