// Random tables of every code: whatever they hold, the run ends, hangs together and can be told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "devices/camming4/sector.hpp"
#include "tests/sim/cams/bench.hpp"

namespace drycut::sim::cams {
namespace {

class Tables {
 public:
  explicit Tables(std::uint32_t seed) : random_(seed) {}

  std::string text() {
    std::string text = "# pulsem: " + std::to_string(number(1, 5)) +
                       "\n# measure: " + std::to_string(number(1, 5)) + "\n# maxvel: 100\n# taccmax: 20\n" +
                       cams::header;
    const int count = number(1, 30);
    for (int row = 1; row <= count; ++row) {
      const auto& code = devices::camming4::codes.at(static_cast<std::size_t>(number(0, 38)));
      const bool hostile = number(0, 20) == 0;
      const int most = hostile ? 159154 : 300;
      const bool jump = code.code == 137 || code.code == 190;
      const int Qm = jump ? number(1, count) : number(0, most);
      text += std::to_string(row) + "," + std::to_string(code.code) + "," + std::to_string(Qm) + "," +
              std::to_string(number(-most, most)) + "," +
              std::to_string(number(0, number(0, 1) == 0 ? 4 : most)) + "," +
              std::to_string(number(0, 1) == 0 ? number(0, 2) : number(-most, most)) + "\n";
    }
    return text;
  }

 private:
  int number(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint32_t>(high - low + 1));
  }
  std::mt19937 random_;
};

void expect_joined(const CamRun& run, const std::string& text) {
  for (std::size_t i = 1; i < run.visits.size(); ++i) {
    const auto& before = run.visits[i - 1];
    const auto& after = run.visits[i];
    ASSERT_NEAR(before.master_end(), after.master_start, 1e-9 * (1 + after.master_start)) << text;
    const double left = cams::at(before, before.master_length).position;
    const double right = cams::at(after, 0).position;
    // A ramp of 232, 252 and 253 that fits its space to one bit spreads the rest; nothing jumps.
    if (!before.waiting) {
      ASSERT_NEAR(left, right, 1e-6 * (1 + std::abs(right) + before.master_length)) << text;
    }
  }
}

TEST(CamFuzz, RandomTablesEndAndHangTogether) {
  int ended = 0;
  int warned = 0;
  for (std::uint32_t seed = 1; seed <= 1500; ++seed) {
    const auto text = Tables(seed).text();
    const auto table = cams::table(text);
    const CamDuty duty{.master_speed = 100.0, .max_velocity = 150.0, .max_acceleration = 300.0};
    const auto run = run_cam(table, duty, 2);
    ASSERT_LE(run.visits.size(), CamRun::most_visits);
    ASSERT_LE(run.shown, run.visits.size());
    expect_joined(run, text);
    if (HasFatalFailure()) return;
    const auto findings = judge(table, duty, run);
    const double last = std::max(0.0, cams::expect_sane(sample_cam(run), findings, text));
    ASSERT_NEAR(last, run.master_total(), 1e-9 * (1 + last)) << text;
    warned += static_cast<int>(std::count_if(findings.begin(), findings.end(), [](const CamFinding& finding) {
      return finding.grade == CamFinding::Grade::warning;
    }));
    if (HasFailure()) return;
    ASSERT_FALSE(cams::study(table, {duty}).text.tables.empty());
    if (run.end == CamRun::End::failed) {
      EXPECT_TRUE(is_unsound(findings, false)) << text;
    }
    ended += run.end == CamRun::End::failed ? 0 : 1;
  }
  EXPECT_GT(ended, 50);  // the tables reach all of the engine, not only its first error
  EXPECT_GT(warned, 500);
}

}  // namespace
}  // namespace drycut::sim::cams
