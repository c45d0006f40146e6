// What came of a run goes through every archive and back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "sim/cli/run_cache.hpp"
#include "sim/record/hdf5_file.hpp"
#include "sim/record/json.hpp"
#include "sim/record/outcome.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::record {
namespace {

/// Fills visited values with anything but points, which files leave out.
class Anything {
 public:
  explicit Anything(unsigned seed) : random_(seed) {}

  template <typename T>
  void operator()(const char*, T&& member) {
    if constexpr (!is_cloud<std::remove_cvref_t<T>>) fill(member);
  }
  template <typename T>
  T made() {
    T value;
    fill(value);
    return value;
  }

 private:
  template <typename T>
  void fill(T& value) {
    if constexpr (Visited<T>) {
      T::visit(*this, value);
    } else if constexpr (is_optional<T>) {
      if (below(3) > 0)
        fill(value.emplace());
      else
        value.reset();
    } else if constexpr (is_list<T>) {
      value.resize(below(4));
      for (auto& item : value) fill(item);
    } else if constexpr (is_time<T>) {
      value = static_cast<Time>(below(1U << 30U)) * 12'345;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(below(words_of(value).size()));
    } else if constexpr (std::is_same_v<T, std::string>) {
      constexpr std::array<const char*, 6> parts = {"a", "\"", "\n", ", ", "\u00b5m", "\\"};
      value.clear();
      for (auto left = below(80); left > 0; --left) value += parts[below(parts.size())];
    } else if constexpr (std::is_same_v<T, bool>) {
      value = below(2) > 0;
    } else if constexpr (std::is_floating_point_v<T>) {
      value = std::ldexp(static_cast<double>(below(1U << 31U)) - 1e9, static_cast<int>(below(200)) - 100);
    } else {
      value = static_cast<T>(below(1000));
    }
  }
  std::size_t below(std::size_t end) { return random_() % end; }

  std::mt19937 random_;
};

template <typename T>
struct VisitedType : testing::Test {};
using VisitedTypes = testing::Types<Tolerance, CheckResult, DriveFigure, plants::DriveRatings, DriveVerdict,
                                    Alarm, HalfStep, Outcome>;
TYPED_TEST_SUITE(VisitedType, VisitedTypes);

TYPED_TEST(VisitedType, GoesThroughJsonAndBack) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto value = Anything(seed).made<TypeParam>();
    TypeParam back;
    take_json(Json::parse(json_text(json_of(value))), back);
    EXPECT_TRUE(back == value) << seed << json_text(json_of(value), 1);
  }
}

struct Count {
  std::size_t members = 0;
  template <typename T>
  void operator()(const char*, T&&) {
    if (!is_cloud<std::remove_cvref_t<T>>) ++members;
  }
};

TYPED_TEST(VisitedType, NamesNoMemberTwice) {
  const auto value = Anything(1).made<TypeParam>();
  Count count;
  TypeParam::visit(count, value);
  EXPECT_EQ(json_of(value).size(), count.members);
}

TEST(VisitedOutcome, GoesThroughAFileOfHdf5AndBack) {
  const TestFolder folder;
  const auto file = folder / "trace.h5";
  const Recording recording;
  for (unsigned seed = 0; seed < 20; ++seed) {
    hdf5_writer(recording, file, {})->finish();
    const auto outcome = Anything(seed).made<Outcome>();
    add_outcome(file, outcome);
    Problems problems;
    EXPECT_TRUE(read_hdf5(file, problems).outcome == outcome) << seed;
    EXPECT_EQ(lines_of(problems), "");
  }
}

TEST(VisitedOutcome, IsReadFromAnOlderFile) {
  CheckResult check;
  take_json(Json::parse(R"({"name": "cut length", "passed": true, "margin": null, "at": 0.5})"), check);
  EXPECT_EQ(check.name, "cut length");
  EXPECT_FALSE(check.margin);
  EXPECT_EQ(check.at, 0.5);
  EXPECT_EQ(check.used, std::nullopt);
  EXPECT_THROW(take_json(Json::parse(R"({"name": 3})"), check), Json::exception);
  EXPECT_THROW(take_json(Json::parse("[]"), check), Json::exception);
}

TEST(VisitedOutcome, SaysInJsonThatThereIsNoLimit) {
  Tolerance tolerance;
  tolerance.high = 10;
  EXPECT_EQ(json_text(json_of(tolerance)),
            R"({"event":"","value":"","low":null,"high":10.0,"from":0.0,"until":null})");
}

TEST(VisitedOutcome, IsKeptWholeByTheCache) {
  const auto outcome = Anything(7).made<Outcome>();
  cli::CachedRun back;
  take_json(json_of(cli::CachedRun{outcome, true, {{"loop.warning"_code, "a note"}}, "line.glb"}), back);
  EXPECT_TRUE(back.outcome == outcome);
  EXPECT_TRUE(back.has_report);
  EXPECT_THAT(lines_of(back.notes), testing::ElementsAre("a note [loop.warning]"));
  EXPECT_EQ(back.scene, "line.glb");
}

}  // namespace
}  // namespace drycut::sim::record
