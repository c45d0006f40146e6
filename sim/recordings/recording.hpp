#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/recording_file.hpp"

namespace drycut::sim::recordings {

/// A channel of a recording, each sample with its own time, which rises strictly. What the file leaves out or
/// has as NaN is no sample.
struct Series {
  std::string channel;              ///< "knife.motor.torque"
  std::string unit;                 ///< SI unit of `value`: "N m", "rad/s"; "" = pure number
  std::vector<double> time_s = {};  ///< when it was, the channel's delay taken off
  std::vector<double> value = {};
  std::vector<std::size_t> clipped = {};  ///< samples whose value could not be recorded: not to be used
};

/// Only the samples that are to be used.
Series without_clipped(const Series& series);

/// An export, read as its YAML says.
struct Recording {
  std::filesystem::path file;       ///< the export
  std::uint64_t checksum = 0;       ///< FNV-1a of its bytes
  std::size_t rows = 0;             ///< of data that were taken
  std::vector<Series> series = {};  ///< in the order of the YAML

  /// When the first of its samples was, of whichever channel [s]; infinite without any.
  [[nodiscard]] double begin() const;
};

/// Reads the export that a recording names. What cannot be read is a problem, at its place in the YAML or in
/// the export; what is doubtful a warning or note in `findings`, with the export's line in its text.
Recording load(const RecordingFile& recording, Problems& problems, std::vector<Finding>& findings);
/// The same of an export that is in memory.
Recording load(const RecordingFile& recording, std::string bytes, Problems& problems,
               std::vector<Finding>& findings);

}  // namespace drycut::sim::recordings
