#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/recording_file.hpp"

namespace drycut::sim::recordings {

/// What an export seems to be.
struct Guess {
  RecordingFile recording;
  /// What a key's guess rests on, or what the file leaves open, by the beginning of the key's line in YAML.
  std::vector<std::pair<std::string, std::string>> remarks = {};
};

/// Guesses from the first lines of an export what it is. `yaml` is where the recording is going to stand, and
/// its `file` is relative to. What cannot be read is a problem at its place in the export.
Guess guess(const std::filesystem::path& file, const std::filesystem::path& yaml, Problems& problems);

/// The guess as YAML, with its remarks as comments.
std::string write(const Guess& guess);

}  // namespace drycut::sim::recordings
