// What a saw must not pass with, from 10 to 40 m/min: it stands, its pulse cable breaks, its clamps open
// early, its measuring wheel stands. The first sentence has the cause.
#include <gmock/gmock.h>

#include "sim/cli/new_command.hpp"
#include "sim/cli/run_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

struct Slip {
  const char* name;
  const char* file;      ///< of the line that it is in
  const char* right;     ///< what stands there
  const char* wrong;     ///< in place of it
  const char* sentence;  ///< that the verdict has, as a regular expression
};

constexpr const char* starts = "  - {when: M11 == 1, after: 100 ms, set: {panel.start: 1}}\n";

const Slip slips[] = {
    {"PulsesGoElsewhere", "programs/flying_saw.il", "M15 Y0 Y4", "M15 Y1 Y4",
     "because Y1 gives pulses, and nothing is wired to it; saw at [0-9.]+ s: the clamps took hold of "
     "material "
     "that ran [0-9.]+ mm/s faster than the carriage"},
    {"BrokenCable", "line.yaml", starts,
     "  - {when: M11 == 1, after: 100 ms, set: {panel.start: 1}}\n"
     "  - {at: 9 s, fault: {saw.servo: {broken_cable: 1}}}\n",
     "because the timeline had at 9 s: fault saw.servo.broken_cable = 1"},
    {"ClampsOpenEarly", "programs/flying_saw.il", "AND     X12\nRST     Y11\n",
     "AND     X12\nRST     Y11\nRST     Y10\n",
     "because saw at [0-9.]+ s: the clamps let go with the blade in the material"},
    {"WheelStands", "line.yaml", starts,
     "  - {when: M11 == 1, after: 100 ms, set: {panel.start: 1}}\n"
     "  - {at: 9 s, fault: {tube.wheel: {stuck: 1}}}\n",
     "(because|after) the timeline had at 9 s: fault tube.wheel.stuck = 1"},
};

struct SawSlips : CommandTest, testing::WithParamInterface<std::tuple<Slip, int>> {
  int run_at(int speed) {
    RunOptions options;
    options.scenarios = {folder / "line/line.yaml"};
    options.out = folder / "out";
    options.pictures = false;
    options.set = {"variables.speed=" + std::to_string(speed) + " m/min"};
    return captured([&] { return run_scenarios(options); });
  }
  TestFolder folder;
};

TEST_P(SawSlips, FailWithTheCauseInTheFirstSentence) {
  const auto& [slip, speed] = GetParam();
  ASSERT_EQ(captured([&] { return make_line({folder / "line", "flying_saw", "lx3vp"}); }), all_passed);
  ASSERT_EQ(run_at(speed), all_passed) << out << "the line itself";
  auto text = content(folder / ("line/" + std::string(slip.file)));
  const auto at = text.find(slip.right);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(slip.right).size(), slip.wrong);
  folder.file(std::string("line/") + slip.file, text);
  EXPECT_EQ(run_at(speed), check_failed) << out;
  EXPECT_THAT(out.substr(0, out.find('\n')),
              testing::ContainsRegex(std::string("checks failed, ") + slip.sentence));
}

INSTANTIATE_TEST_SUITE_P(Speeds, SawSlips,
                         testing::Combine(testing::ValuesIn(slips), testing::Values(10, 20, 30, 40)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) +
                                  std::to_string(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace drycut::sim::cli
