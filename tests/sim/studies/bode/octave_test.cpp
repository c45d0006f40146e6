// Octave's margin() of a loop that is known, beside what drycut bode measures. Skipped without
// octave-control.
#include "renders/process.hpp"
#include "sim/cli/bode_command.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/studies/bode/axis.hpp"

namespace drycut::sim::studies {
namespace {

std::string octave(const std::string& script) {
  try {
    return renders::run_process({"octave-cli", "octave", {"-q", "--eval", "pkg load control; " + script}})
        .output;
  } catch (const renders::HelperFailed&) {
    return "";
  }
}

struct OctaveMargin : CommandTest, testing::WithParamInterface<int> {
  /// The number behind these words in what the command printed.
  double printed_number(const std::string& words) const {
    const auto at = out.find(words);
    EXPECT_NE(at, std::string::npos) << out;
    return at == std::string::npos ? 0 : std::strtod(out.c_str() + at + words.size(), nullptr);
  }
  bode_axis::Folder folder;
};

// The loop round the ideal axis is L(z) = pgain / 1000 / (z - 1), sampled every 4 ms.
TEST_P(OctaveMargin, IsThatOfBode) {
  if (octave("disp(1)").empty()) GTEST_SKIP() << "needs octave and octave-control";
  cli::BodeOptions options;
  options.scenario = folder.path / "axis.yaml";
  options.loop.amplitude = 4;  // hundreds of counts at every frequency
  options.set = {"controller.qmove.set.Axis.pgain=" + std::to_string(GetParam())};
  ASSERT_EQ(captured([&] { return cli::measure_bode(options); }), cli::all_passed) << err;
  const auto said = octave(fmt::format(
      "[gain, phase] = margin(tf({}, [1 -1], 0.004)); printf(\"%.6f %.6f\\n\", 20 * log10(gain), phase)",
      GetParam() / 1000.0));
  double gain = 0;
  double phase = 0;
  ASSERT_TRUE(std::istringstream(said) >> gain >> phase) << said;
  EXPECT_NEAR(printed_number("gain margin"), gain, 0.1);
  EXPECT_NEAR(printed_number("phase margin"), phase, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Gains, OctaveMargin, testing::Values(100, 300, 1000));

}  // namespace
}  // namespace drycut::sim::studies
