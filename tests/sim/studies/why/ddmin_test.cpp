#include "sim/studies/why/ddmin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace drycut::sim::studies {
namespace {

using testing::ElementsAre;

bool has(const Subset& set, const Subset& all) { return std::ranges::includes(set, all); }

/// Fails where one of the causes is whole; counts the sets that were tried.
struct Machine {
  std::vector<Subset> causes;
  std::function<bool(const Subset&)> refuses = [](const Subset&) { return false; };
  int tried = 0;
  int budget = 100000;

  LeastSet least(std::size_t count) {
    return least_failing(count, [&](const std::vector<Subset>& sets) {
      std::vector<TrialCame> came;
      for (const auto& set : sets) {
        if (tried >= budget) break;
        ++tried;
        const bool fails = std::ranges::any_of(causes, [&](const auto& cause) { return has(set, cause); });
        came.push_back(refuses(set) ? TrialCame::unresolved : fails ? TrialCame::failed : TrialCame::passed);
      }
      return came;
    });
  }
};

TEST(Ddmin, FindsEachOfManyAlone) {
  for (std::size_t count = 1; count < 40; ++count)
    for (std::size_t cause = 0; cause < count; ++cause) {
      Machine machine{{{cause}}};
      const auto least = machine.least(count);
      EXPECT_THAT(least.set, ElementsAre(cause)) << count;
      EXPECT_TRUE(least.minimal);
      EXPECT_LE(machine.tried, 4 * 6) << count;  // halving, four at a time at most
    }
}

TEST(Ddmin, FindsEveryPairThatFailsOnlyTogether) {
  for (std::size_t a = 0; a < 20; ++a)
    for (std::size_t b = a + 1; b < 20; ++b) {
      Machine machine{{{a, b}}};
      const auto least = machine.least(20);
      EXPECT_THAT(least.set, ElementsAre(a, b));
      EXPECT_TRUE(least.minimal);
    }
}

TEST(Ddmin, WhatItFindsFailsAndFailsNoLongerWithoutAnyOne) {
  std::mt19937 draw(1);
  for (int round = 0; round < 200; ++round) {
    const std::size_t count = 2 + draw() % 30;
    Machine machine;
    for (int k = 0; k < 3; ++k) {
      Subset cause;
      for (std::size_t i = 0; i < count; ++i)
        if (draw() % 6 == 0) cause.push_back(i);
      if (cause.empty()) cause.push_back(draw() % count);
      machine.causes.push_back(cause);
    }
    // Every third of neighbours can only be had together, as lines of a program that need each other.
    machine.refuses = [](const Subset& set) {
      return std::ranges::any_of(
          set, [&](std::size_t one) { return one % 3 == 1 && !std::ranges::binary_search(set, one - 1); });
    };
    const auto fails = [&](const Subset& set) {
      return !machine.refuses(set) &&
             std::ranges::any_of(machine.causes, [&](const auto& cause) { return has(set, cause); });
    };
    const auto least = machine.least(count);
    ASSERT_TRUE(least.minimal);
    ASSERT_TRUE(fails(least.set));
    for (const auto one : least.set) {
      auto rest = least.set;
      std::erase(rest, one);
      EXPECT_FALSE(!rest.empty() && fails(rest)) << round;
    }
  }
}

TEST(Ddmin, EndsWithItsBudgetAndSaysSo) {
  for (int budget = 0; budget < 30; ++budget) {
    Machine machine{{{3, 11, 17}}};
    machine.budget = budget;
    const auto least = machine.least(20);
    EXPECT_TRUE(has(least.set, {3, 11, 17}));
    EXPECT_LE(machine.tried, budget);
    if (!least.minimal) {
      EXPECT_GT(least.set.size(), 3U);
    }
  }
}

}  // namespace
}  // namespace drycut::sim::studies
