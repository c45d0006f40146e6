#include <gtest/gtest.h>

#include <cmath>

#include "devices/camming4/sector.hpp"

namespace drycut::devices::camming4 {
namespace {

TEST(CamExact, MovingByGrainsCarriesWholeBitsBothWays) {
  const Point start{5, 2, 0};
  EXPECT_EQ(moved(start, {3, 0}, 7), (Point{5, 5, 0}));
  EXPECT_EQ(moved(start, {5, 0}, 7), (Point{6, 0, 0}));
  EXPECT_EQ(moved(start, {-3, 0}, 7), (Point{4, 6, 0}));
  EXPECT_EQ(moved(start, {-37, 0}, 7), (Point{0, 0, 0}));
}

TEST(CamExact, FractionsCarryIntoGrains) {
  EXPECT_EQ((Space{1, 0.75} + Space{2, 0.5}), (Space{4, 0.25}));
  EXPECT_EQ((-Space{1, 0.25}), (Space{-2, 0.75}));
  EXPECT_EQ((-Space{3, 0}), (Space{-3, 0}));
  EXPECT_EQ(space(-1.25), (Space{-2, 0.75}));
  EXPECT_EQ(moved({0, 6, 0.5}, {0, 0.5}, 7), (Point{1, 0, 0}));
}

TEST(CamExact, BetweenIsTheInverseOfMoved) {
  const Point start{-3, 4, 0.5};
  for (const Space length :
       {Space{0, 0}, Space{1, 0}, Space{-1, 0.25}, Space{1000, 0.75}, Space{-12345, 0.5}})
    EXPECT_EQ(between(start, moved(start, length, 7), 7), length);
}

TEST(CamExact, PointKeepsAFractionOfABit) {
  EXPECT_EQ(point(-4, 0.5, 10), (Point{-4, 5, 0}));
  EXPECT_EQ(point(9, 0.25, 10), (Point{9, 2, 0.5}));
}

TEST(CamExact, SpacesCompareByGrainsThenFraction) {
  EXPECT_LT((Space{1, 0.5}), (Space{2, 0}));
  EXPECT_LT((Space{2, 0}), (Space{2, 0.5}));
  EXPECT_FALSE((Space{2, 0.5}) < (Space{2, 0.5}));
  EXPECT_EQ(to_double({-2, 0.75}), -1.25);
}

TEST(CamExact, SumsAndProductsStopAtTheirLimit) {
  constexpr std::int64_t most = std::int64_t{0x7fffffffffffffff};
  EXPECT_EQ(add(most, most), grain_limit);
  EXPECT_EQ(add(-most, -most), -grain_limit);
  EXPECT_EQ(subtract(-most, most), -grain_limit);
  EXPECT_EQ(subtract(most, -most - 1), grain_limit);
  EXPECT_EQ(multiply(most, -2), -grain_limit);
  EXPECT_EQ(multiply(-most, -2), grain_limit);
  EXPECT_EQ(multiply(-7, 6), -42);
  EXPECT_EQ(space(1e300).grains, grain_limit);
}

TEST(CamExact, UnusableResolutionsActAsTheNearestUsable) {
  EXPECT_EQ(usable({0, -5}).measure, 1);
  EXPECT_EQ(usable({0, -5}).pulse, 1);
  EXPECT_EQ(usable({3600, 4096}).measure, 3600);
  EXPECT_EQ(usable({std::int64_t{1} << 40, 1}).measure, std::int64_t{1} << 30);
}

}  // namespace
}  // namespace drycut::devices::camming4
