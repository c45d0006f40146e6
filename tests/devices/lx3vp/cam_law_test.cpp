// The law of the cam in whole numbers: against closed forms, and that nothing is ever lost.
#include <gmock/gmock.h>

#include <cmath>
#include <numeric>
#include <random>

#include "devices/lx3vp/cam_law.hpp"

namespace drycut::devices::lx3vp {
namespace {

using Rows = std::vector<RowLaw::Row>;

TEST(Lx3vpCamLaw, LinesRunBetweenTheRows) {
  const RowLaw law(Rows{{0, 0}, {100, 30}, {400, -30}, {500, 20}}, {}, {});
  const auto at = [&](std::int64_t counts) { return law.pulses(law.place(counts)); };
  EXPECT_EQ(at(0), 0);
  EXPECT_EQ(at(50), 15);
  EXPECT_EQ(at(100), 30);
  EXPECT_EQ(at(250), 0);
  EXPECT_EQ(at(400), -30);
  EXPECT_EQ(at(499), 20);  // 19.5 goes upwards
  EXPECT_EQ(at(500), 20);
  EXPECT_EQ(at(550), 35);
}

TEST(Lx3vpCamLaw, BackwardsIsTheSameCurve) {
  const RowLaw law(Rows{{0, 0}, {300, 100}, {1000, 50}}, {}, {});
  for (std::int64_t counts = -5000; counts <= 5000; counts += 7) {
    const auto place = law.place(counts);
    const std::int64_t cycle = static_cast<std::int64_t>(std::floor(static_cast<double>(counts) / 1000));
    EXPECT_EQ(place.cycle, cycle);
    EXPECT_EQ(law.master_position(place), counts - 1000 * cycle);
    EXPECT_EQ(law.pulses(place) - 50 * cycle, law.pulses(law.place(counts - 1000 * cycle)));
  }
  EXPECT_EQ(law.pulses(law.place(-1000)), -50);
}

TEST(Lx3vpCamLaw, TheFirstRowIsTheBeginningWhereverItStands) {
  const RowLaw law(Rows{{5000, 700}, {6000, 900}}, {}, {});
  EXPECT_EQ(law.pulses(law.place(0)), 0);
  EXPECT_EQ(law.pulses(law.place(500)), 100);
  EXPECT_EQ(law.pulses(law.place(1500)), 300);
  EXPECT_EQ(law.master_position(law.place(1500)), 5500);
  EXPECT_EQ(law.slave_position(law.place(1500)), 800);
  EXPECT_EQ(law.pulses(law.place(0, 250)), 50);
}

TEST(Lx3vpCamLaw, TheEndOfACycleIsAPlaceOfItsOwn) {
  const RowLaw law(Rows{{0, 0}, {1000, 77}}, {3, 7}, {});
  const RowLaw::Place end{2, law.length()};
  EXPECT_EQ(law.pulses(end), 3 * 77);
  EXPECT_EQ(law.master_position(end), 1000);
  EXPECT_EQ(law.slave_position(end), 77);
}

// One rounding at the end: after any number of counts the pulses are the nearest to the true ratio.
TEST(Lx3vpCamLaw, CoprimeZoomsNeverDrift) {
  const RowLaw law(Rows{{0, 0}, {9973, 10007}}, {65521, 65519}, {32749, 32771});
  // Pulses a count as one fraction, too long for 64 bit only when multiplied.
  const auto expected = [](std::int64_t counts) {
    const Wide numerator = Wide{counts} * 65521 * 10007 * 32749;
    const Wide denominator = Wide{65519} * 9973 * 32771;
    const Wide twice = 2 * numerator + denominator;
    Wide quotient = twice / (2 * denominator);
    if (quotient * 2 * denominator > twice) --quotient;
    return static_cast<std::int64_t>(quotient);
  };
  for (std::int64_t counts = 1; counts < 1'000'000'000'000; counts = counts * 3 + 1) {
    EXPECT_EQ(law.pulses(law.place(counts)), expected(counts)) << counts;
    EXPECT_EQ(law.pulses(law.place(-counts)), expected(-counts)) << counts;
  }
}

// Against the definition, in floating point of 64 bit mantissa, with random tables and zooms.
TEST(Lx3vpCamLaw, RandomTablesFollowTheDefinition) {
  std::mt19937 random(11);
  const auto draw = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  for (int round = 0; round < 2000; ++round) {
    Rows rows;
    std::int32_t master = static_cast<std::int32_t>(draw(0, 100));
    for (std::int64_t count = draw(2, 12); count > 0; --count) {
      rows.push_back({master, static_cast<std::int32_t>(draw(-20'000, 20'000))});
      master += static_cast<std::int32_t>(draw(1, 5'000));
    }
    const Zoom in{static_cast<std::uint16_t>(draw(1, 1000)), static_cast<std::uint16_t>(draw(1, 1000))};
    const Zoom out{static_cast<std::uint16_t>(draw(1, 1000)), static_cast<std::uint16_t>(draw(1, 1000))};
    const RowLaw law(rows, in, out);
    const std::int64_t counts = draw(-1'000'000, 1'000'000);
    const long double length = rows.back().master - rows.front().master;
    const long double travelled = static_cast<long double>(counts) * in.numerator / in.denominator;
    const long double cycle = std::floor(travelled / length);
    const long double phase = rows.front().master + (travelled - cycle * length);
    std::size_t i = 1;
    while (i + 1 < rows.size() && static_cast<long double>(rows[i].master) <= phase) ++i;
    const long double slope =
        static_cast<long double>(rows[i].slave - rows[i - 1].slave) / (rows[i].master - rows[i - 1].master);
    const long double slave = rows[i - 1].slave + slope * (phase - rows[i - 1].master) - rows.front().slave +
                              cycle * (rows.back().slave - rows.front().slave);
    const long double exact = slave * out.numerator / out.denominator;
    EXPECT_LE(std::abs(static_cast<long double>(law.pulses(law.place(counts))) - exact), 0.5L + 1e-9L)
        << "round " << round;
  }
}

// It looks first where it found the piece last: a law that is asked the same without such a memory.
TEST(Lx3vpCamLaw, WhereItWasAskedBeforeChangesNothing) {
  Rows rows;
  for (std::int32_t i = 0; i <= 50; ++i) rows.push_back({i * (i + 7), 400 * (i % 5) - 17 * i});
  const RowLaw law(rows, {3, 2}, {5, 7});
  std::mt19937 random(5);
  std::int64_t counts = 0;
  for (int i = 0; i < 5000; ++i) {
    counts += std::uniform_int_distribution<std::int64_t>(-40, 40)(random) * (i % 100 == 0 ? 1000 : 1);
    const RowLaw fresh(rows, {3, 2}, {5, 7});
    const auto place = law.place(counts);
    const auto slave = law.slave(place);
    const auto expected = fresh.slave(place);
    ASSERT_EQ(slave.pulses, expected.pulses) << counts;
    ASSERT_EQ(slave.before, expected.before) << counts;
    ASSERT_EQ(slave.position, expected.position) << counts;
  }
}

// On either side of where 64 bits are enough for all products, and where they are enough for the place.
TEST(Lx3vpCamLaw, WhereTheProductsGetLongerNothingChanges) {
  const RowLaw law(Rows{{0, 0}, {1000, 2000}}, {3, 1}, {1, 3});
  for (const int bits : {30, 40, 43, 44, 45, 46}) {
    for (std::int64_t counts = (std::int64_t{1} << bits) - 2000; counts < (std::int64_t{1} << bits) + 2000;
         counts += 7) {
      EXPECT_EQ(law.pulses(law.place(counts)), 2 * counts);
      EXPECT_EQ(law.pulses(law.place(-counts)), -2 * counts);
    }
  }
}

TEST(Lx3vpCamLaw, ExtremeValuesStayDefined) {
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  const Zoom up{65535, 1};
  const Zoom down{1, 65535};
  for (const Zoom in : {up, down}) {
    for (const Zoom out : {up, down}) {
      for (const Rows& rows : {Rows{{0, least}, {1, most}}, Rows{{0, most}, {most, least}}}) {
        const RowLaw law(rows, in, out);
        for (const std::int64_t counts : {std::int64_t{1}, std::int64_t{most}, std::int64_t{1} << 62,
                                          -(std::int64_t{1} << 62), std::int64_t{-1}}) {
          const auto place = law.place(counts);
          EXPECT_GE(place.part, 0);
          EXPECT_LE(place.part, law.length());
          EXPECT_LT(std::abs(law.pulses(place)), std::numeric_limits<std::int64_t>::max() / 2);
          EXPECT_GE(law.master_position(place), 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace drycut::devices::lx3vp
