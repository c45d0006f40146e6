// Numbers with units, and statistics, in expressions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "sim/scenario/expression.hpp"
#include "sim/scenario/statistic.hpp"

namespace drycut::sim::scenario {
namespace {

struct Name {
  double number;
  std::string unit;
};
using Machine = std::map<std::string, Name>;

const Machine machine = {
    {"torque", {9, "N m"}}, {"speed", {60, "m/min"}}, {"slip", {2, "mm/s"}},       {"x", {3, "mm"}},
    {"y", {4, "mm"}},       {"angle", {90, "deg"}},   {"AxisX.posit", {50, "Um"}}, {"on", {1, ""}},
    {"share", {0.25, ""}}};

struct Compiled {
  std::optional<Expression> expression;
  std::string faults;  ///< "offset: what; remedy", separated by " | "
};

Compiled compile(const std::string& text, const Machine& names = machine) {
  std::vector<ExpressionFault> faults;
  const auto resolve = [&](const std::string& name) -> Expression::Operand {
    const auto found = names.find(name);
    if (found == names.end()) return nullptr;
    return {&found->second.number, found->second.unit};
  };
  Compiled made;
  made.expression =
      Expression::compile(text, resolve, {"x", "y"}, faults, Expression::Kind::condition, resolve);
  for (const auto& [code, offset, what, remedy, of] : faults)
    made.faults += (made.faults.empty() ? "" : " | ") + std::to_string(offset) + ": " + what + "; " + remedy;
  return made;
}

TEST(ExpressionUnits, NumbersArePutIntoTheUnitOfWhatTheyMeet) {
  const struct {
    const char* text;
    double margin;  ///< in the unit of the names
  } cases[] = {{"torque <= 9.5 N m", 0.5},
               {"torque <= 9500 mN m", 0.5},
               {"9.5 Nm >= torque", 0.5},
               {"torque <= 9.5", 0.5},
               {"speed < 2 m/s", 60},
               {"speed < 120m/min", 60},
               {"x <= 1 cm", 7},
               {"abs(x - 0.1 cm) <= 0.01 m", 8},
               {"-1 cm < x", 13},
               {"x <= 1 cm - 5 mm", 2},
               {"x <= 2 * 1 cm", 17},
               {"sqrt(x^2 + y^2) <= 6 mm", 1},
               {"rint(1.2346 m / 5 mm) <= 250", 3},
               {"rint(4 s / 100 ms) <= 50", 10},
               {"rint(x / 2 mm) <= 5", 3},
               {"rint(x) <= 5 mm", 2},
               {"sqrt(x*x + y*y) <= 0.6 cm", 1},
               {"max(x, y, 1 cm) <= 11", 1},
               {"(on ? x : 1 m) <= 5 mm", 2},
               {"x * slip <= 7 mm^2/s", 1},
               {"x / slip <= 2 s", 0.5},
               {"slip / x <= 1 1/s", 1.0 / 3},
               {"share <= 50 %", 0.25},
               {"angle <= 0.5 turn", 90},
               {"sin(30 deg) * x <= 2 mm", 0.5},
               {"acos(share * 4 - 1) <= 90 deg", 0.0},
               {"x + 1 cm <= 0.02 m && y < 5 mm", 1},
               {"1 cm <= x", -7},
               {"x < 10 mm / 2", 2},
               {"AxisX.posit <= 60", 10}};
  for (const auto& [text, margin] : cases) {
    const auto [expression, faults] = compile(text);
    ASSERT_TRUE(expression) << text << ": " << faults;
    const auto now = expression->evaluate();
    ASSERT_TRUE(now.margin) << text;
    EXPECT_NEAR(*now.margin, margin, 1e-12) << text;
  }
}

TEST(ExpressionUnits, AWrongDimensionIsToldAtItsPlace) {
  const struct {
    const char* text;
    const char* fault;
  } cases[] = {
      {"torque <= 9.5 mm", "10: '9.5 mm' is a length, but 'torque' is a torque; write it in N m"},
      {"x < 3 && abs(y - 1 s) < 2", "17: '1 s' is a time, but 'y' is a length; write it in mm"},
      {"on == 3 mm", "6: '3 mm' is a length, but 'on' is a pure number; write the number without a unit"},
      {"AxisX.posit < 3 mm",
       "14: '3 mm' is a length, but 'AxisX.posit' is in Um; write the number without a unit, in Um"},
      {"rms(torque) <= 3 m/s", "15: '3 m/s' is a speed, but 'rms(torque)' is a torque; write it in N m"},
      {"count(torque) <= 3 N m",
       "17: '3 N m' is a torque, but 'count(torque)' is a pure number; write the number without a unit"},
      {"settling(x, 1 s) < 2", "12: '1 s' is a time, but 'x' is a length; write it in mm"},
      {"x + torque < 3 mm",
       "13: 'x + torque' is in no unit that could be said; write numbers without units there"},
      {"sin(3 mm) < 1", "4: '3 mm' is a length, but 'sin' is an angle; write it in rad"},
      {"x < 3 mm 4",
       "9: an operator is missing before '4'; add + - * / < > == && or ||; a unit stands behind "
       "its number: 9.5 N m, 60 m/min"},
  };
  for (const auto& [text, fault] : cases) EXPECT_EQ(compile(text).faults, fault) << text;
}

// The statistic of x over 0, 1, ... as `wave` has it.
double over(const std::string& term, int count, const std::function<double(int)>& wave) {
  Machine names = {{"x", {0, "mm"}}};
  auto [expression, faults] = compile(term + " < 0", names);
  EXPECT_TRUE(expression) << faults;
  if (!expression) return NAN;
  expression->start(0);
  for (int i = 0; i < count; ++i) {
    names.at("x").number = wave(i);
    expression->take(i);
  }
  expression->finish();
  const auto margin = expression->evaluate().margin;
  return margin ? -*margin : NAN;
}

TEST(ExpressionStatistics, AgreeWithClosedForms) {
  const auto sine = [](int i) { return 5 * std::sin(2 * std::numbers::pi * i / 360); };
  const auto ramp = [](int i) { return 2.0 * i; };
  EXPECT_NEAR(over("rms(x)", 720, sine), 5 / std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(over("mean(x)", 720, sine), 0, 1e-12);
  EXPECT_NEAR(over("sd(x)", 720, sine), 5 * std::sqrt(720.0 / 719 / 2), 1e-12);
  EXPECT_NEAR(over("sd(x + 1e6)", 720, sine), 5 * std::sqrt(720.0 / 719 / 2), 1e-6);
  EXPECT_DOUBLE_EQ(over("max(abs(x))", 720, sine), 5);
  EXPECT_DOUBLE_EQ(over("min(x)", 720, sine), -5);
  EXPECT_DOUBLE_EQ(over("p99(x)", 101, ramp), 198);
  EXPECT_DOUBLE_EQ(over("p99.9(x)", 101, ramp), 199.8);
  EXPECT_DOUBLE_EQ(over("p50(x)", 4, ramp), 3);  // between the second and the third
  EXPECT_DOUBLE_EQ(over("p0(x)", 4, ramp), 0);
  EXPECT_DOUBLE_EQ(over("p100(x)", 4, ramp), 6);
  EXPECT_DOUBLE_EQ(over("p90(x)", 1, ramp), 0);
  EXPECT_DOUBLE_EQ(over("count(x)", 7, ramp), 7);
  EXPECT_DOUBLE_EQ(over("settling(x - 20, 0.6 cm)", 11, ramp), 7);
  EXPECT_DOUBLE_EQ(over("max(x) - max(min(x), 3)", 7, ramp), 9);
  EXPECT_DOUBLE_EQ(over("2 * max(x) + mean(x)", 3, ramp), 10);
}

TEST(ExpressionStatistics, APercentileKeepsEveryFourthNumberOfTwoAndAHalfMillion) {
  auto median = RunningStatistic::named("p50");
  ASSERT_TRUE(median);
  median->start(0);
  for (int i = 0; i < 1001; ++i) median->take(i, i);
  EXPECT_EQ(median->result(), 500);
  median->start(0);
  for (int i = 0; i < 2'500'000; ++i) median->take(i, i);
  EXPECT_EQ(median->result(), 1'249'998);  // of 0, 4, 8 .. 2 499 996
}

TEST(ExpressionStatistics, NothingIsNoNumber) {
  for (const auto* term : {"rms(x)", "p99(x)", "max(x)", "settling(x, 1)"}) {
    EXPECT_TRUE(std::isnan(over(term, 0, [](int) { return 0.0; }))) << term;
    EXPECT_TRUE(std::isnan(over(term, 3, [](int i) { return i == 1 ? NAN : 1; }))) << term;
  }
  EXPECT_TRUE(std::isnan(over("sd(x)", 1, [](int) { return 1.0; })));
  EXPECT_EQ(over("count(x)", 0, [](int) { return 0.0; }), 0);
}

TEST(ExpressionStatistics, SayWhatTheyLookAt) {
  const auto [expression, faults] =
      compile("rms(torque - torque / 2) <= 9.5 N m && settling(x + y, 1) < 2 s");
  ASSERT_TRUE(expression) << faults;
  const auto& statistics = expression->statistics();
  ASSERT_EQ(statistics.size(), 2U);
  EXPECT_EQ(statistics[0].text, "rms(torque - torque / 2)");
  EXPECT_EQ(statistics[0].unit, "N m");
  ASSERT_EQ(statistics[0].names.size(), 1U);
  EXPECT_EQ(statistics[0].names[0].offset, 4U);
  EXPECT_EQ(statistics[1].unit, "s");
  EXPECT_EQ(statistics[1].names.size(), 2U);
  EXPECT_TRUE(expression->has_margin());
}

TEST(ExpressionStatistics, SayWhatIsWrongAndWhere) {
  const struct {
    const char* text;
    const char* fault;
  } cases[] = {
      {"rms(mean(x)) < 3", "4: mean inside rms; a term looks at channels or event values"},
      {"rms(x, y) < 3", "0: rms has 2 arguments; it takes one"},
      {"rms(3) < 3", "4: no channel and no event value is in it; for example rms(AxisX.follerr)"},
      {"settling(x) < 3",
       "0: settling has 1 arguments; write settling(AxisX.follerr, 10): the expression and "
       "its band"},
      {"settling(x, y) < 3",
       "11: the band of settling is no number from 0 on; for example "
       "settling(AxisX.follerr, 10)"},
      {"rsm(x) < 3", "0: unknown function 'rsm'; did you mean rms?"},
      {"p101(x) < 3",
       "0: unknown function 'p101'; known: abs, acos, acosh, asin, asinh, atan, atan2, atanh, "
       "avg, cos, cosh, exp, ln, log, log10, log2, max, min, rint, sign, sin, sinh, sqrt, sum, "
       "tan, tanh"},
      {"rms(x)", "0: 'rms(x)' is a number, not a condition; compare it with a limit: < <= > >= == !="},
      {"rms(z) < 3", "4: unknown name 'z'; known: x, y"},
  };
  for (const auto& [text, fault] : cases) EXPECT_EQ(compile(text).faults, fault) << text;
}

}  // namespace
}  // namespace drycut::sim::scenario
