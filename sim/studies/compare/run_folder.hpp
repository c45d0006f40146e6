#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/record.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::studies {

/// The tolerance of an event's value, as a plot of the scenario states it: limits of a panel with one value.
struct Tolerance {
  std::string event;  ///< "cut" or "knife.cut"
  std::string value;  ///< "length"
  double low = 0;     ///< [the value's unit]
  double high = 0;
  double from = 0;              ///< [s] the plot's window: what it leaves out is not judged
  std::optional<double> until;  ///< [s]
};

/// A run as its folder tells it.
struct ComparedRun {
  std::string label;  ///< what the comparison calls it
  std::filesystem::path folder;
  std::string version;  ///< of the drycut that made it
  record::Outcome outcome;
  record::Recording recording;
  std::map<std::string, double> turns;  ///< of channels that begin again: how far they count, in their unit
  /// The scenario with every default in force, path and value: "plants.web.speed", "60 m/min". Entries of a
  /// list go by their name, "checks[cut length].expect", else by index. Pictures are left out.
  std::vector<std::pair<std::string, std::string>> parameters;
  std::vector<Tolerance> tolerances;
  /// Events that checks look at one by one or all of, and from when on [s]: "knife.cut", 4.
  std::vector<std::pair<std::string, double>> starts;

  [[nodiscard]] const std::string* parameter(const std::string& path) const;
  /// Of a value of "knife", "cut"; nullptr if the scenario states none.
  [[nodiscard]] const Tolerance* tolerance(const std::string& source, const std::string& event,
                                           const std::string& value) const;
};

/// Reads what a run recorded, from its folder or from a file of it: trace.csv, with its events beside it, or
/// trace.h5. Whatever is missing or broken is told in `problems`; then the result is not to be used.
record::Record read_record(const std::filesystem::path& run, Problems& problems);

/// Reads the folder that `drycut run` made of one scenario. Whatever is missing or broken in it is told in
/// `problems` with file, line and column; then the result is not to be used.
ComparedRun read_run(const std::filesystem::path& folder, Problems& problems);

/// What the runs are called: their paths without what all of these begin and end with, "a" and "b" for
/// a/rotary_knife and b/rotary_knife. A folder that is given twice is a problem.
std::vector<std::string> labels_of(const std::vector<std::filesystem::path>& folders, Problems& problems);

}  // namespace drycut::sim::studies
