#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/headers.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::scenario {
class Archive;
}

namespace drycut::sim::recordings {

/// How a number stands in its column.
enum class Numbers { plain, sign_magnitude, twos_complement };

/// A recording of a real machine: an export of its tool, and what its columns are. A YAML file, visited once
/// as scenarios are (sim/scenario/archive.hpp).
struct RecordingFile {
  std::filesystem::path path;  ///< of the YAML

  scenario::Text file;  ///< the export, relative to the YAML
  Format format = Format::csv;
  std::optional<char> separator = {};
  std::optional<char> decimal = {};
  scenario::ScenePlace separator_place = {};  ///< where it is given, of the value
  scenario::ScenePlace decimal_place = {};
  /// Its own column, a rate, or the number of the sample and the rate; nothing of it: as the format has it.
  struct TimeBase {
    scenario::Text column;  ///< a header's name, or its number from 1; "" = none
    scenario::Text unit;    ///< of the column
    double rate = 0;        ///< [Hz]; 0 = not given
    double start = 0;       ///< of the first sample, where no column says it [s]
  };
  TimeBase time;
  std::optional<std::pair<double, double>> rows = {};  ///< of the data, from 1, both included
  scenario::ScenePlace rows_place = {};

  struct Channel {
    scenario::Text name;    ///< "knife.motor.torque"
    scenario::Text column;  ///< a header's name, or its number from 1
    scenario::Text time;    ///< the column with its time, where it has one of its own
    scenario::Text unit;
    scenario::Quantity of = {};  ///< what `full` of the column are; without a unit: not given
    double full = 1;
    double scale = 1;
    double sign = 1;
    double delay = 0;  ///< so much later than it was does the file have it [s]
    Numbers numbers = Numbers::plain;
    std::optional<double> clipped = {};  ///< the number that stands for what could not be recorded
  };
  std::vector<Channel> channels;

  [[nodiscard]] Problem problem(Code code, const scenario::ScenePlace& place, std::string what,
                                std::string remedy) const;
  /// Of the export, relative to the working folder.
  [[nodiscard]] std::filesystem::path export_path() const { return path.parent_path() / file.text; }
};

void visit(scenario::Archive& archive, RecordingFile& recording);

/// True of a YAML text that is a recording, by its key `file`.
bool is_recording(std::string_view text);
/// Reads the YAML, not the export. All that is wrong goes to `problems`; the result is not to be used then.
RecordingFile read_recording_file(const std::filesystem::path& file, Problems& problems);
RecordingFile read_recording_text(std::string_view text, const std::filesystem::path& file,
                                  Problems& problems);
/// As YAML.
std::string write(const RecordingFile& recording);

/// The quantity of a channel of its kind in the machines: "N m" for "knife.motor.torque"; several where
/// machines differ, none where no machine has such a channel.
std::vector<std::string> units_of_channel(const std::string& name);

/// The channel of the machines that was probably meant, "axis.motor.torque" for "axis.motor.torqe"; "" if
/// they have such a channel, or none that is near, or a device of a controller has a variable of that name.
std::string channel_meant_by(const std::string& name);

/// "semicolon" for ';' between cells, "point" for '.' in numbers.
std::string_view word_of_separator(char sign);
std::string_view word_of_decimal(char sign);

/// A unit of time as a header writes it, "Second", "ms"; "" if it is none.
std::string unit_of_time(const std::string& written);

/// What a number of the column is worth: si = number * factor + offset.
struct Worth {
  double factor = 1;
  double offset = 0;
  std::string unit;  ///< SI: "N m"
};
/// The units must be sound.
Worth worth_of(const RecordingFile::Channel& channel);

}  // namespace drycut::sim::recordings
