// drycut run --verify-step: the margins at half the step beside those at the step.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/cli/run_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::studies {
namespace {

using testing::HasSubstr;
using testing::Not;

struct HalfStepTest : CommandTest {
  /// A web that is made faster; `limit` of its speed [m/min].
  void write(double limit, const std::string& step = "100 us") {
    options.scenarios = {
        folder.file("line.yaml", fmt::format("scene: {{step: {}, duration: 1 s}}\nplants: {{web: {{type: "
                                             "web, drive: {{damping: 0 N s/m}}}}}}\n"
                                             "timeline: [{{at: 0.1 s, set: {{web.speed: 80 m/min}}}}]\n"
                                             "record: {{every: {}, channels: [web.speed]}}\nchecks:\n"
                                             "  - {{name: not too fast, always: \"web.speed < {}\"}}\n"
                                             "  - {{name: not too slow, always: \"web.speed > 50\"}}\n",
                                             step, step, limit))};
    options.out = folder / "out";
    options.pictures = false;
  }
  int run() {
    return captured([&] { return cli::run_scenarios(options); });
  }
  [[nodiscard]] nlohmann::json results() const {
    return nlohmann::json::parse(content(folder / "out" / "line" / "checks.json"));
  }

  TestFolder folder;
  cli::RunOptions options;
};

TEST_F(HalfStepTest, TellsHowFarEveryMarginMoved) {
  write(100);
  ASSERT_EQ(run(), cli::all_passed) << err;
  const auto plain = results();
  EXPECT_FALSE(plain.contains("half_step"));
  EXPECT_THAT(out, Not(HasSubstr("margin at")));
  options.set = {"scene.step=50 us"};
  ASSERT_EQ(run(), cli::all_passed) << err;
  const auto fine = results();
  options.set = {};
  options.verify_step = true;
  options.pictures = true;
  ASSERT_EQ(run(), cli::all_passed) << err;
  auto verified = results();
  EXPECT_EQ(verified["half_step"]["step"], 50e-6);
  for (std::size_t i = 0; i < 2; ++i) {
    auto check = verified["checks"][i];
    const double margin = plain["checks"][i]["margin"];
    const double at_half = fine["checks"][i]["margin"];
    EXPECT_EQ(check["margin"], margin);
    EXPECT_EQ(check["half_step"]["margin"], at_half);
    EXPECT_EQ(check["half_step"]["moved"], at_half - margin);
    EXPECT_EQ(check["half_step"]["passed"], true);
    EXPECT_EQ(margin == at_half, i == 1) << "the overshoot hangs on the step, the start does not";
    EXPECT_NEAR(margin, at_half, 0.01);
  }
  EXPECT_THAT(out, HasSubstr("margin at 100 us"));
  EXPECT_THAT(out, HasSubstr("margin at 50 us"));
  EXPECT_THAT(out, Not(HasSubstr("depends on the step")));
  const auto page = content(folder / "out" / "line" / "report.html");
  EXPECT_THAT(page, HasSubstr("Margins at half the step"));
  EXPECT_THAT(page, HasSubstr("margin at 50 us"));
}

TEST_F(HalfStepTest, AVerdictThatHangsOnTheStepIsTold) {
  options.verify_step = true;
  write(100);
  ASSERT_EQ(run(), cli::all_passed) << err;
  const auto check = results()["checks"][0];
  const double moved = check["half_step"]["moved"];
  write(100 - check["margin"].get<double>() - moved / 2);
  const bool passes = moved < 0;  // more room at the step itself
  EXPECT_EQ(run(), passes ? cli::all_passed : cli::check_failed) << "the scenario's own step judges";
  EXPECT_EQ(results()["checks"][0]["half_step"]["passed"], !passes);
  EXPECT_THAT(out, HasSubstr("the verdict depends on the step"));
}

TEST_F(HalfStepTest, AStepWithoutAHalfIsRefused) {
  write(100, "100.001 us");
  options.verify_step = true;
  EXPECT_EQ(run(), cli::bad_input);
  EXPECT_THAT(err,
              HasSubstr("line.yaml:1:15: --verify-step: half of scene.step 100.001 us is no whole number of "
                        "nanoseconds; choose an even number of nanoseconds"));
  options.verify_step = false;
  EXPECT_EQ(run(), cli::all_passed) << err;
}

}  // namespace
}  // namespace drycut::sim::studies
