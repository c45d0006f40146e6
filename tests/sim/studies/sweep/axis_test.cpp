// The axes of a sweep and the points over them.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "sim/studies/sweep/axis.hpp"

namespace drycut::sim::studies {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

SweepAxis sound(const std::string& text, bool sampled = false) {
  Problems problems;
  auto axis = parse_axis(text, "--over", sampled, problems);
  EXPECT_TRUE(axis) << text;
  EXPECT_TRUE(problems.empty()) << text << ": " << (problems.empty() ? "" : to_string(problems[0]));
  if (!axis) return {};
  fill_axis(*axis, problems);
  EXPECT_TRUE(problems.empty()) << text;
  return *axis;
}

TEST(SweepAxis, GoesFromEndToEnd) {
  const auto axis = sound("variables.length=500..3000 mm:6");
  EXPECT_EQ(axis.parameter.path, "variables.length");
  EXPECT_EQ(heading(axis.parameter), "variables.length [mm]");
  EXPECT_THAT(axis.values, ElementsAre("500", "1000", "1500", "2000", "2500", "3000"));
  EXPECT_THAT(sound("x=0.1..0.7:7").values, ElementsAre("0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"));
  EXPECT_THAT(sound("x=1..1000 Hz:4:log").values, ElementsAre("1", "10", "100", "1000"));
  EXPECT_THAT(sound("x=-1..1 V:3").values, ElementsAre("-1", "0", "1"));
}

TEST(SweepAxis, IsAListOfNumbersOrWords) {
  const auto numbers = sound("x=1, 2,5.5 mm");
  EXPECT_THAT(numbers.values, ElementsAre("1", "2", "5.5"));
  EXPECT_EQ(numbers.parameter.unit, "mm");
  const auto overrides = overrides_of({numbers}, {"5.5"});
  EXPECT_EQ(overrides[0].path, "x");
  EXPECT_EQ(overrides[0].value, "5.5 mm");
  const auto words = sound("plants.knife.drive=servo,pulses");
  EXPECT_THAT(words.values, ElementsAre("servo", "pulses"));
  EXPECT_EQ(overrides_of({words}, {"servo"})[0].value, "servo");
  EXPECT_THAT(sound("plants.knife.servo.model=1FK7,HG").values, ElementsAre("1FK7", "HG"));
}

TEST(SweepAxis, RefusesWhatIsNone) {
  struct Case {
    const char* text;
    int column;
    const char* what;
  };
  for (const auto& [text, column, what] : {
           Case{"x", 1, "'x' gives no values to a path"},
           Case{"=1,2", 1, "gives no values to a path"},
           Case{"x=1..2 mm", 10, "does not say how many values"},
           Case{"x=1..2 mm:", 11, "'' is no number of values"},
           Case{"x=1..2 mm:many", 11, "'many' is no number of values"},
           Case{"x=1..2 mm:1", 11, "1 values from end to end"},
           Case{"x=1..2 mm:1000000000", 11, "1000000000 values from end to end"},
           Case{"x=1..2 mm:99999999999999", 11, "99999999999999 values from end to end"},
           Case{"x=3..2 mm:4", 3, "is empty"},
           Case{"x=2..2 mm:4", 3, "is empty"},
           Case{"x=1 mm..2 m:4", 3, "the ends are in mm and m"},
           Case{"x=0..2 mm:4:log", 3, "a logarithmic range begins above 0"},
           Case{"x=1,,2", 5, "an empty value"},
           Case{"x=1,2,", 7, "an empty value"},
           Case{"x=1 mm,2 m", 3, "values in mm and m"},
           Case{"x=1,2,1", 7, "1 is given twice"},
           Case{"x=1, 1.0 mm", 6, "1 is given twice"},
           Case{"x=1,abc,3 mm", 5, "'abc' is no number as the others are"},
           Case{"x=1,2, 3 mmm", 8, "'3 mmm' is no number as the others are"},
           Case{"x=servo,3", 3, "'servo' is no number as the others are"},
       }) {
    Problems problems;
    EXPECT_FALSE(parse_axis(text, "--over", false, problems)) << text;
    ASSERT_EQ(problems.size(), 1U) << text;
    EXPECT_EQ(problems[0].column, column) << text;
    EXPECT_THAT(problems[0].what, HasSubstr(what)) << text;
  }
}

TEST(SweepAxis, ASampleHasNoNumberOfValues) {
  EXPECT_TRUE(sound("x=1..2 mm", true).is_range());
  EXPECT_TRUE(sound("x=1..2 mm:log", true).logarithmic);
  for (const auto* text : {"x=1..2 mm:5", "x=1..2 mm:5:log"}) {
    Problems problems;
    EXPECT_FALSE(parse_axis(text, "--over", true, problems)) << text;
    ASSERT_EQ(problems.size(), 1U) << text;
    EXPECT_EQ(problems[0].column, 10) << text;
    EXPECT_THAT(problems[0].what, HasSubstr("a sample has none")) << text;
  }
}

TEST(SweepAxis, WholeNumbersStayWhole) {
  Problems problems;
  auto axis = parse_axis("x=1..10:4", "--over", false, problems).value();
  axis.parameter.integer = true;
  fill_axis(axis, problems);
  EXPECT_TRUE(problems.empty());
  auto torn = parse_axis("x=1..10:3", "--over", false, problems).value();
  torn.parameter.integer = true;
  fill_axis(torn, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].what, "x is a whole number, and 5.5 is none");
}

TEST(SweepGrid, TheLastAxisGoesFastest) {
  const SweepAxes axes = {sound("a=1,2"), sound("b=1..3:3")};
  EXPECT_EQ(grid_size(axes, 6).value(), 6U);
  EXPECT_FALSE(grid_size(axes, 5));
  EXPECT_THAT(grid(axes), ElementsAre(SweepPoint{"1", "1"}, SweepPoint{"1", "2"}, SweepPoint{"1", "3"},
                                      SweepPoint{"2", "1"}, SweepPoint{"2", "2"}, SweepPoint{"2", "3"}));
  EXPECT_THAT(grid({}), ElementsAre(SweepPoint{}));
}

// Every 2^k points lie in 2^k different parts of each axis, and any two of the first axes form a net: each of
// the 2^k rectangles of equal size and shape holds one (k up to 4 for the first two).
TEST(Sobol, FillsEveryAxisEvenly) {
  constexpr std::size_t axes = 12;
  const auto points = sobol_shares(axes, 256);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    for (const std::size_t count : {2U, 16U, 256U}) {
      std::set<int> parts;
      for (std::size_t i = 0; i < count; ++i) {
        const double x = points[i][axis];
        EXPECT_GE(x, 0);
        EXPECT_LT(x, 1);
        parts.insert(static_cast<int>(x * static_cast<double>(count)));
      }
      EXPECT_EQ(parts.size(), count) << axis;
    }
    for (std::size_t other = 0; other < axis; ++other) {
      bool same = true;
      for (std::size_t i = 0; i < 64; ++i) same = same && points[i][axis] == points[i][other];
      EXPECT_FALSE(same) << axis << " is " << other;
    }
  }
  for (const int columns : {1, 2, 4, 8, 16}) {
    std::set<std::pair<int, int>> cells;
    for (std::size_t i = 0; i < 16; ++i)
      cells.emplace(static_cast<int>(points[i][0] * columns),
                    static_cast<int>(points[i][1] * (16 / columns)));
    EXPECT_EQ(cells.size(), 16U) << columns;
  }
}

// By the direction numbers of Joe and Kuo (2008), whose first rows give these by hand; it takes thousands of
// axes.
TEST(Sobol, HasThePublishedNumbers) {
  const auto points = sobol_shares(10, 6);
  const std::vector<double> third = {0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.25, 0.75, 0.75, 0.75};
  EXPECT_THAT(points[0], testing::Each(0));
  EXPECT_THAT(points[1], testing::Each(0.5));
  EXPECT_EQ(points[2], third);
  EXPECT_EQ(sobol_shares(sobol_axes, 3)[2].size(), sobol_axes);
}

TEST(Sobol, LiesInTheRanges) {
  const SweepAxes axes = {sound("a=500..3000 mm", true), sound("b=1..100:log", true), sound("c=x,y,z", true)};
  const auto points = sobol(axes, 8);
  ASSERT_EQ(points.size(), 8U);
  EXPECT_EQ(points[0], (SweepPoint{"500", "1", "x"}));
  EXPECT_EQ(points[1], (SweepPoint{"1750", "10", "y"}));
  // A longer sample begins with the shorter one.
  const auto longer = sobol(axes, 64);
  EXPECT_TRUE(std::equal(points.begin(), points.end(), longer.begin()));
}

}  // namespace
}  // namespace drycut::sim::studies
