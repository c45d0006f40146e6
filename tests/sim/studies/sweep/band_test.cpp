// The limits of a fit as axes: a sweep over their corners, and the band that they leave of a bound.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "sim/cli/sweep_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// The largest speed that holds is the limit, which the fit knows as 90 to 110 m/min.
const std::string banded = R"(variables: {limit: 100 m/min, speed: 60 m/min, end: 0.2 s}
scene: {step: 1 ms, duration: "${end}"}
plants: {web: {type: web, speed: "${speed}"}}
record: {every: 10 ms, channels: [web.speed]}
checks:
  - {name: slow enough, always: "web.speed <= ${limit}"}
)";
const std::string learnt_limits =
    R"({"format": 1, "parameters": [{"path": "variables.limit", "value": 100, "low": 90, "high": 110, "unit": "m/min"}]})";

std::string read_all(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct FitBand : CommandTest {
  FitBand() {
    sweep.scenario = folder.file("web.yaml", banded);
    envelope.scenarios = {sweep.scenario};
    envelope.find_max = {"variables.speed=20..200 m/min:1"};
    sweep.out = folder / "sweep";
    envelope.out = folder / "envelope";
    file = folder.file("fit.json", learnt_limits).string();
  }
  int run_sweep() {
    return captured([&] { return sweep_scenario(sweep); });
  }
  int run_envelope() {
    return captured([&] { return envelope_scenario(envelope); });
  }
  /// The first cells of each row of a table, as numbers.
  std::vector<std::vector<double>> rows(const char* name, int columns) const {
    std::vector<std::vector<double>> all;
    std::istringstream text(read_all(folder / name));
    std::string line;
    std::getline(text, line);
    while (std::getline(text, line)) {
      std::istringstream cells(line);
      auto& row = all.emplace_back();
      for (std::string cell; std::ssize(row) < columns && std::getline(cells, cell, ',');)
        row.push_back(std::stod(cell));
    }
    return all;
  }

  TestFolder folder;
  SweepOptions sweep;
  EnvelopeOptions envelope;
  std::string file;
};

TEST_F(FitBand, ASweepGoesOverBothLimits) {
  sweep.over = {"variables.speed=95,105 m/min", file};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(rows("sweep/sweep.csv", 2), ElementsAre(ElementsAre(95, 90), ElementsAre(95, 110),
                                                      ElementsAre(105, 90), ElementsAre(105, 110)));
  EXPECT_THAT(out, HasSubstr("4 points, 2 passed, 2 failed"));
}

TEST_F(FitBand, ASampleLiesBetweenThem) {
  sweep.over = {file};
  sweep.sample = "sobol:16";
  ASSERT_EQ(run_sweep(), all_passed) << err;
  const auto points = rows("sweep/sweep.csv", 1);
  ASSERT_EQ(points.size(), 16U);
  double low = 110;
  double high = 90;
  for (const auto& point : points) {
    low = std::min(low, point[0]);
    high = std::max(high, point[0]);
  }
  EXPECT_GE(low, 90);
  EXPECT_LE(high, 110);
  EXPECT_GT(high - low, 15) << "they fill the range";
}

TEST_F(FitBand, TheBoundHasABand) {
  envelope.over = {file};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  const auto points = rows("envelope/envelope.csv", 2);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[0][1], 90, 1);
  EXPECT_NEAR(points[1][1], 110, 1);
  const auto band = fmt::format("{:.0f} to {:.0f} m/min", std::floor(points[0][1]), std::floor(points[1][1]));
  EXPECT_THAT(out,
              HasSubstr("Largest variables.speed: " + band + " at the 2 corners of the limits of " + file));
  EXPECT_THAT(out, HasSubstr("  note a corner has every value of the fit at one of its limits"));
  const auto page = read_all(folder / "envelope/report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("at the corners of the limits of"), HasSubstr("the lowest is at"),
                          HasSubstr("variables.limit 90 m/min")));
}

// A band a point of the other axes, whichever axis comes first.
TEST_F(FitBand, EveryPointOfAnotherAxisHasItsOwn) {
  envelope.over = {file, "variables.end=0.2,0.3 s"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_THAT(out, AllOf(HasSubstr("  0.2 s: "), HasSubstr("  0.3 s: "),
                         HasSubstr(" over 2 points, each at the 2 corners of the limits of ")));
  EXPECT_TRUE(std::filesystem::exists(folder / "envelope/plots/band.svg") ||
              std::filesystem::exists(folder / "envelope/plots/band.png"));
}

TEST_F(FitBand, ACornerWhereNothingHoldsIsTold) {
  envelope.over = {file};
  envelope.find_max = {"variables.speed=100..200 m/min:1"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("  none at 1 of 2 corners, else 1"));
}

TEST_F(FitBand, WithoutAFitNothingIsSaidOfOne) {
  envelope.over = {"variables.limit=90,110 m/min"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_THAT(out, Not(HasSubstr("corner")));
  EXPECT_THAT(read_all(folder / "envelope/report.html"), Not(HasSubstr("corners of the limits")));
}

// The name of a scenario stands before the file as before a path, and counts for the column.
TEST_F(FitBand, AFileBehindANameIsForThatScenario) {
  envelope.over = {"web:" + file};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_EQ(rows("envelope/envelope.csv", 1).size(), 2U);
  folder.file(
      "fit.json",
      R"({"format": 1, "parameters": [{"path": "variables.none", "value": 1, "low": 0, "high": 2}]})");
  EXPECT_EQ(run_envelope(), bad_input);
  EXPECT_THAT(err, HasSubstr("variables.none"));
  folder.file("fit.json", R"({"format": 1, "parameters": [{"path": "variables.limit", "unit": "m/min"}]})");
  EXPECT_EQ(run_envelope(), bad_input);
  EXPECT_THAT(err, AllOf(HasSubstr("--over:1:5: "), HasSubstr("[fit.not-known]")));
  envelope.over.push_back("web:variables.limit=80,120 m/min");
  EXPECT_EQ(run_envelope(), all_passed) << err;
}

}  // namespace
}  // namespace drycut::sim::cli
