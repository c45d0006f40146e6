// Random tables of LX3VP: whatever they hold, they are read, run and told without a crash.
#include <cmath>
#include <random>

#include "tests/sim/cams/bench.hpp"
#include "tests/sim/cams/ecam_bench.hpp"

namespace drycut::sim::cams {
namespace {

std::string random_text(std::mt19937& random) {
  const std::vector<std::string> pieces = {"master,slave",
                                           "parameter,value",
                                           "# ecamtbx: K100",
                                           "# ecamtbx: K0",
                                           "# cyclic: 0",
                                           "# time_axis: 5",
                                           "P1,3183",
                                           "P2,1000",
                                           "P3,5",
                                           "P4,5/3",
                                           "P5,9",
                                           "P6,1",
                                           "P7,20",
                                           "0,0",
                                           "5,7",
                                           "9,-3",
                                           "x",
                                           ",",
                                           "\xEF\xBB",
                                           "#"};
  const std::vector<std::string> rows = {"0,0", "5,7", "9,-3", "", "# a remark", "12,12"};
  std::string text;
  const bool mostly_sound = random() % 2 == 0;
  if (mostly_sound) text = "# cyclic: 0\nmaster,slave\n";
  const auto lines = random() % 14;
  for (unsigned i = 0; i < lines; ++i) {
    const auto& from = mostly_sound && random() % 8 != 0 ? rows : pieces;
    text += from[random() % from.size()] + "\n";
  }
  return text;
}

std::string random_rows(std::mt19937& random) {
  const auto number = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<std::uint32_t>(high - low + 1));
  };
  const int steepness = number(0, 1) == 0 ? 5 : 2000000;
  std::string text = "# max_ratio: " + std::to_string(number(1, 20)) + "\nmaster,slave\n";
  int master = number(-1, 3);
  const int count = number(1, 40);
  for (int i = 0; i < count; ++i) {
    text += std::to_string(master) + "," + std::to_string(number(-steepness, steepness)) + "\n";
    master += number(0, 60) == 0 ? number(-3, 0) : number(1, 300);
  }
  return text;
}

void expect_told(const EcamTable& table, const std::string& text) {
  const CamDuty duty{.master_speed = table.time_axis > 0 ? std::nullopt : std::optional(30000.0),
                     .max_velocity = 100000.0,
                     .max_acceleration = 1e6};
  const auto run = run_ecam(table, duty, 2);
  cams::expect_sane(sample_cam(run), judge_ecam(table, duty, run), text);
  ASSERT_FALSE(cams::study(table).text.totals.empty());
}

TEST(EcamFuzz, AnyTextIsReadOrRefused) {
  std::mt19937 random(11);
  int read = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto text = random_text(random);
    Problems problems;
    const auto table = read_lx3vp(text, "cam.csv", problems);
    for (const auto& problem : problems) ASSERT_FALSE(problem.remedy.empty()) << problem.what;
    if (!problems.empty()) continue;
    ++read;
    expect_told(table, text);
    if (HasFailure()) return;
  }
  EXPECT_GT(read, 20);
}

TEST(EcamFuzz, AnyRowsAreJudged) {
  std::mt19937 random(12);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto text = random_rows(random);
    const auto table = ecams::table(text);
    expect_told(table, text);
    if (HasFailure()) return;
    const bool runs = !run_ecam(table, {}, 1).law.pieces.empty();
    const auto findings = judge_ecam(table, {}, run_ecam(table, {}, 1));
    if (!runs) {
      EXPECT_TRUE(is_unsound(findings, false)) << text;
    }
    refused += runs ? 0 : 1;
  }
  EXPECT_GT(refused, 50);
  EXPECT_LT(refused, 800);
}

}  // namespace
}  // namespace drycut::sim::cams
