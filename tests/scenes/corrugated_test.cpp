// The program of the corrugated cut-off: orders that change, and stops, at any moment of a cut.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

// The first sheet of an order is cut with the following error of the one before and that of its own [mm].
constexpr double tolerance = 0.8;

/// A cut of the run.
struct Sheet {
  double at;  ///< [s]
  double length;
  double skew;
};

std::vector<Sheet> sheets_of(const std::vector<scenario::Override>& overrides, const std::string& more = "") {
  Problems problems;
  auto scenario =
      scenario::read_scenario(source_root / "scenes/rotary_knife_corrugated.yaml", overrides, problems);
  EXPECT_EQ(lines_of(problems), "");
  scenario.pictures.frames = false;
  loop::Simulation simulation(scenario, problems);
  EXPECT_EQ(lines_of(problems), "");
  if (!problems.empty()) return {};
  const auto outcome = simulation.run();
  EXPECT_EQ(outcome.failure, "");
  std::vector<Sheet> sheets;
  const auto& events = simulation.recording().events();
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto event = events[i];
    EXPECT_NE(event.event, "tear") << more;
    EXPECT_NE(event.event, "buckle") << more;
    if (event.event != "cut") continue;
    Sheet sheet{event.at_seconds(), 0, 0};
    for (const auto& value : event.values) {
      if (value.name == "length") sheet.length = value.number;
      if (value.name == "skew") sheet.skew = value.number;
    }
    sheets.push_back(sheet);
  }
  return sheets;
}

// A sheet of 700 mm lasts 210 ms. Whenever in it the order changes, the next but one is of the new length at
// the latest, and none is of any other.
TEST(CorrugatedOrders, NoSheetComesBetweenTwoLengthsWheneverTheOrderChanges) {
  for (const int length : {5600, 9000, 30000})
    for (int ms = 0; ms < 210; ms += 35) {
      const double change = 12 + ms * 1e-3;
      const auto what = std::to_string(length) + " at " + std::to_string(change);
      SCOPED_TRACE(what);
      const auto sheets = sheets_of({{"scene.duration", "15 s"},
                                     {"timeline.2.at", std::to_string(change) + " s"},
                                     {"timeline.2.set.slLength", std::to_string(length)}},
                                    what);
      ASSERT_GT(sheets.size(), 10U);
      int old_ones = 0;
      int new_ones = 0;
      for (const Sheet& sheet : sheets) {
        if (sheet.at < 9) continue;
        const bool is_new = std::abs(sheet.length - length * 0.1) < tolerance;
        EXPECT_TRUE(is_new || std::abs(sheet.length - 700) < tolerance) << sheet.length << " at " << sheet.at;
        EXPECT_NEAR(sheet.skew, 0, 1);
        if (is_new) ++new_ones;
        EXPECT_TRUE(is_new || new_ones == 0) << "the old order again";
        if (!is_new && sheet.at > change) ++old_ones;
      }
      EXPECT_GE(new_ones, 1);
      EXPECT_LE(old_ones, 2);
    }
}

TEST(CorrugatedOrders, AStopAtAnyMomentIsOverTheTopAndTheNextSheetsAreRight) {
  for (int ms = 0; ms < 210; ms += 42) {
    const double stop = 12 + ms * 1e-3;
    SCOPED_TRACE(stop);
    // The second and the third order are the stop and the start.
    const auto sheets =
        sheets_of({{"scene.duration", "17 s"},
                   {"timeline.2", "{at: " + std::to_string(stop) + " s, set: {panel.start: 0}}"},
                   {"timeline.3", "{at: 14 s, set: {panel.start: 1}}"}},
                  std::to_string(stop));
    std::size_t wrong = 0;
    std::size_t after = 0;
    for (const Sheet& sheet : sheets) {
      if (sheet.at < 9) continue;
      if (std::abs(sheet.length - 700) > tolerance) ++wrong;
      if (sheet.at > 15) ++after;
    }
    EXPECT_EQ(wrong, 1U) << "the board that ran through";
    EXPECT_GT(after, 5U);
  }
}

}  // namespace
}  // namespace drycut::sim
