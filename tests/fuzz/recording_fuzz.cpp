// Exports of scopes and drive tools: what they seem to be, and what comes of them then.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sim/recordings/guess.hpp"
#include "sim/recordings/recording.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  using namespace sim::recordings;
  static const auto file =
      std::filesystem::temp_directory_path() / ("drycut_fuzz_" + std::to_string(getpid()) + ".csv");
  std::ofstream(file, std::ios::binary) << text;
  Problems problems;
  auto made = guess(file, file.parent_path() / "x.yaml", problems);
  fuzz::expect_placed(problems, text);
  if (!problems.empty()) return;
  // What a user adds to it.
  auto& recording = made.recording;
  if (recording.time.unit.text.empty() && recording.time.rate == 0) recording.time.rate = 1000;
  for (auto& channel : recording.channels) channel.unit.text = "V";
  const auto yaml = write(recording);
  const auto again = read_recording_text(yaml, recording.path, problems);
  fuzz::expect_placed(problems, yaml);
  if (!problems.empty()) return;
  std::vector<Finding> findings;
  const auto read = load(again, problems, findings);
  // Some stand in the YAML, some in the export.
  for (const auto& problem : problems)
    fuzz::expect_placed({problem}, problem.file == file.string() ? text : yaml);
  for (const auto& series : read.series)
    for (std::size_t i = 1; i < series.time_s.size(); ++i)
      if (!(series.time_s[i] > series.time_s[i - 1])) fuzz::broken("times rise");
}

}  // namespace drycut
