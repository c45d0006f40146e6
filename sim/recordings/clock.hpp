#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/headers.hpp"

namespace drycut::sim::recordings {

/// By what the times of a channel are told.
struct TimeSource {
  std::size_t column = none;  ///< none: every row is a step later
  double unit = 0;            ///< seconds that a number of the column is worth
  bool counts = false;        ///< the column has the number of the sample
  double step = 0;            ///< between two samples, by the YAML or the header [s]; 0 = not told
  double start = 0;           ///< [s]
  bool is_told = false;       ///< the step is the YAML's
  bool operator==(const TimeSource&) const = default;
};

/// The times of the channels that have one source.
struct Clock {
  TimeSource source;
  std::optional<double> now = {};  ///< of the row at hand [s]; nothing: it has none, or repeats the last one
  std::vector<double> times = {};  ///< [s]
  std::vector<std::pair<std::size_t, int>> lines = {};  ///< from this index on, a line a time from that one
  double origin = 0;                                    ///< what is 0 in `times` [s]
  int repeated = 0;
  int first_repeated = 0;  ///< line

  /// Takes the time of a row. From when to when it goes back, if it does; the row has no time then.
  std::optional<std::pair<double, double>> take(const DataCell& cell, int line);
  /// Where the time with that index stands.
  [[nodiscard]] int line_of(std::size_t index) const;
};

/// What is doubtful of the times, and where it was first.
struct Doubt {
  Code code;
  int line;
  std::string text;
};
std::vector<Doubt> doubts_of(const Clock& clock);

/// The usual distance of two of these times; 0 of fewer than two.
double step_of(const std::vector<double>& times);

}  // namespace drycut::sim::recordings
