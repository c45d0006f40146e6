#include "sim/scenario/units.hpp"
#include "sim/scenario/everyday_units.hpp"
#include "sim/scenario/unit_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

namespace drycut::sim::scenario {
namespace {

TEST(Units, ConvertsTheUnitsOfTheField) {
  const struct {
    double number;
    const char* unit;
    double si;
  } cases[] = {{60, "m/min", 1},
               {3, "mm", 0.003},
               {7, "um", 7e-6},
               {100, "us", 1e-4},
               {300, "rpm", 10 * std::numbers::pi},
               {90, "deg", std::numbers::pi / 2},
               {1, "rev", 2 * std::numbers::pi},
               {1, "turn", 2 * std::numbers::pi},
               {1, "revolution", 2 * std::numbers::pi},
               {9.5, "N m", 9.5},
               {9.5, "Nm", 9.5},
               {2, "kg m^2", 2},
               {4000, "N m/rad", 4000},
               {180, "deg/s", std::numbers::pi},
               {120, "1/min", 2},
               {5, "%", 0.05},
               {6, "bar", 6e5},
               {10, "V", 10},
               {2500, "lines", 2500},
               {4, "counts", 4},
               {3, "pieces", 3},
               {20, "celsius", 293.15},
               {2, "m2", 2},
               {3, "mNm", 0.003},
               {0.5, "", 0.5}};
  for (const auto& [number, unit, si] : cases) {
    ASSERT_TRUE(is_unit(unit)) << unit;
    EXPECT_NEAR(to_si(number, unit), si, 4e-16 * std::abs(si)) << unit;
    EXPECT_NEAR(from_si(si, unit), number, 4e-14 * number) << unit;
  }
}

// As American sheets spell them, by the definitions of pound, inch and standard gravity.
TEST(Units, ReadsAmericanSheets) {
  constexpr double pound = 0.45359237;
  constexpr double inch = 0.0254;
  constexpr double gravity = 9.80665;
  constexpr double torque = pound * gravity * inch;
  const struct {
    double si;
    std::vector<const char*> units;
    const char* like;
  } cases[] = {
      {torque,
       {"lbf in", "lb in", "in lb", "lb-in", "in-lb", "lbs in", "lbf-in", "in lbf", "lb*in", "lb.in"},
       "N m"},
      {torque * 12, {"lbf ft", "lb ft", "ft lb", "ft-lb", "lb-ft", "foot pound"}, "N m"},
      {torque / 16, {"oz in", "ozf in", "oz-in", "in-oz", "ounce inch"}, "N m"},
      {torque, {"lb in s2", "lbf in s2", "lb-in-s2", "lb in s^2", "in lb s2", "lb in sec2"}, "kg m2"},
      {torque / 16, {"oz in s2", "ozf in s2", "oz-in-s2", "oz-in-sec^2"}, "kg m2"},
      {torque * 12, {"lb ft s2"}, "kg m2"},
      {pound * inch * inch, {"lb in2", "lb-in2", "lb in^2"}, "kg m2"},
      {pound * inch * inch / 16, {"oz in2", "oz-in2"}, "kg m2"},
      {torque / 16, {"oz in/A", "oz-in/A", "ozf in/A"}, "N m/A"},
      {torque, {"lb in/rad"}, "N m/rad"},
      {550 * 12 * torque, {"hp", "HP"}, "W"},
      {inch, {"in", "inch"}, "m"},
      {12 * inch, {"ft", "foot"}, "m"},
      {pound, {"lb", "lbs", "pound"}, "kg"},
      {pound / 16, {"oz", "ounce"}, "kg"},
      {pound * gravity, {"lbf"}, "N"},
      {pound * gravity / inch, {"lbf/in"}, "N/m"},
      {std::numbers::pi / 30, {"rpm"}, "rad/s"},
      // A force already, and no force at all.
      {pound * 12 * inch, {"lb ft/s2"}, "N"},
  };
  for (const auto& [si, units, like] : cases)
    for (const auto* unit : units) {
      ASSERT_TRUE(is_unit(unit)) << unit;
      EXPECT_TRUE(same_dimension(unit, like)) << unit;
      EXPECT_NEAR(to_si(1, unit), si, 1e-12 * si) << unit;
    }
}

TEST(Units, OfThePageAreOfTheirQuantity) {
  for (const auto& group : unit_groups()) {
    EXPECT_FALSE(group.units.empty());
    for (const auto& unit : group.units) {
      ASSERT_TRUE(is_unit(unit)) << unit;
      EXPECT_TRUE(same_dimension(unit, group.units.front())) << group.quantity << ": " << unit;
    }
    // In SI itself, so that a reader can convert by the page alone.
    EXPECT_TRUE(group.units.front() == "%" || to_si(1, group.units.front()) == 1) << group.quantity;
  }
}

TEST(Units, DecimalFractionsOfSiAreTheNearestDouble) {
  // A literal in the plants and the same number in a scenario must be the same bits.
  for (int n = 1; n <= 2000; ++n) {
    EXPECT_EQ(to_si(n, "mm"), n / 1e3);
    EXPECT_EQ(to_si(n, "us"), n / 1e6);
    EXPECT_EQ(to_si(n, "m/min"), n / 60.0);
  }
}

TEST(Units, RefusesWhatIsNoUnit) {
  for (const char* text : {"mmm", "foo", "10 mm", "mm 10", "m / 2", "2", "s since 2000-01-01", "lg(re 1 mW)",
                           "m @ 3", "m/", "-m", " m", "m ", "m;", "\n", "m\x01", "m**", "("}) {
    EXPECT_FALSE(is_unit(text)) << text;
  }
  EXPECT_FALSE(is_unit(std::string(100, 'm')));
}

TEST(Units, AngleIsADimensionOfItsOwn) {
  EXPECT_TRUE(same_dimension("deg", "rad"));
  EXPECT_FALSE(same_dimension("deg", ""));
  EXPECT_FALSE(same_dimension("rpm", "1/min"));  // UDUNITS alone would take 1/min for 1 rad/min
  EXPECT_FALSE(same_dimension("N m", "N m/rad"));
  EXPECT_TRUE(same_dimension("rpm", "deg/s"));
  EXPECT_TRUE(same_dimension("%", "count"));
  EXPECT_FALSE(same_dimension("mm", "ms"));
  EXPECT_FALSE(same_dimension("mm", "foo"));
  EXPECT_FALSE(same_dimension("foo", "foo"));
}

TEST(Units, NamesDimensions) {
  EXPECT_EQ(dimension_name("mm"), "a length");
  EXPECT_EQ(dimension_name("m/min"), "a speed");
  EXPECT_EQ(dimension_name("rpm"), "a rotational speed");
  EXPECT_EQ(dimension_name("kg cm^2"), "an inertia");
  EXPECT_EQ(dimension_name("Nm"), "a torque");
  EXPECT_EQ(dimension_name("N m/deg"), "a torsional stiffness");
  EXPECT_EQ(dimension_name(""), "a pure number");
  EXPECT_EQ(dimension_name("%"), "a percentage");
  EXPECT_EQ(dimension_name("m^5"), "a quantity in m^5");
}

TEST(Units, GivesTheSiUnit) {
  EXPECT_EQ(si_unit("m/min"), "m.s-1");
  EXPECT_EQ(si_unit("count"), "");
  EXPECT_EQ(to_si(2.5, si_unit("N m/rad")), 2.5);
}

TEST(Quantity, SplitsNumberAndUnit) {
  const struct {
    const char* text;
    double number;
    const char* unit;
    std::size_t offset;
  } cases[] = {{"1200 mm", 1200, "mm", 5},   {"-0.5", -0.5, "", 4},    {"+5 V", 5, "V", 3},
               {"60 m/min", 60, "m/min", 3}, {"1e-3 m", 1e-3, "m", 5}, {".5 m", 0.5, "m", 3},
               {"12mm", 12, "mm", 2},        {"5  N m ", 5, "N m", 3}};
  for (const auto& [text, number, unit, offset] : cases) {
    const auto parsed = parse_quantity(text);
    ASSERT_TRUE(parsed) << text;
    EXPECT_EQ(parsed->number, number) << text;
    EXPECT_EQ(parsed->unit, unit) << text;
    EXPECT_EQ(parsed->unit_offset, offset) << text;
  }
}

TEST(Quantity, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "mm", "inf", "nan", "-inf m", "1e999", "- 5", "+-5", "--5", "e5", " 5", "."}) {
    EXPECT_FALSE(parse_quantity(text)) << text;
  }
}

TEST(Quantity, IsWrittenShortAndReadsBackExactly) {
  EXPECT_EQ(format_quantity(1, "m/min"), "60 m/min");
  EXPECT_EQ(format_quantity(0.6, "mm"), "600 mm");
  EXPECT_EQ(format_quantity(0.05, "%"), "5 %");
  EXPECT_EQ(format_quantity(0.3, ""), "0.3");
  EXPECT_EQ(format_quantity(0, "mm"), "0 mm");
  double si = 1e-7;
  for (const char* unit : {"mm", "m/min", "deg", "rpm", "%", "bar", "N m/rad", "1/min", "count"}) {
    for (int i = 0; i < 2000; ++i) {
      si = si * 1.0137 + 1e-9;
      if (si > 1e9) si = 1e-7;
      const auto text = format_quantity(si, unit);
      const auto back = parse_quantity(text);
      ASSERT_TRUE(back) << text;
      EXPECT_EQ(to_si(back->number, back->unit), si) << text;
    }
  }
}

TEST(Units, MayBeAskedByManyThreads) {
  std::vector<std::thread> threads;
  std::vector<int> right(4, 0);
  for (int& count : right) {
    threads.emplace_back([&count] {
      for (int i = 1; i <= 500; ++i) {
        const auto unit = "m" + std::to_string(i % 7 + 1);
        count += to_si(i, unit) == i && is_unit("m/min") ? 1 : 0;
      }
    });
  }
  for (auto& thread : threads) thread.join();
  for (const int count : right) EXPECT_EQ(count, 500);
}

// In the order that they are looked up in, and as UDUNITS has them, to the bit.
TEST(Units, EverydayUnitsAreThoseOfUdunits) {
  EXPECT_TRUE(std::ranges::is_sorted(everyday_units, {}, &EverydayUnit::unit));
  for (const auto& unit : everyday_units) {
    const auto meant = udunits_conversion(unit.unit);
    ASSERT_TRUE(meant) << unit.unit;
    EXPECT_EQ(unit.factor, meant->factor) << unit.unit;
    EXPECT_EQ(unit.divisor, meant->divisor) << unit.unit;
    EXPECT_EQ(unit.offset, meant->offset) << unit.unit;
    EXPECT_EQ(unit.dimension, meant->dimension) << unit.unit;
  }
}

}  // namespace
}  // namespace drycut::sim::scenario
