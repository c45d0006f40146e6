#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/record/recording.hpp"

namespace drycut::sim::record {

/// A text file that has its own name from its first line on and can be read while it grows. Lines go out
/// whole, many at a time. Throws std::runtime_error when something cannot be written; what was written before
/// stays whole lines.
class GrowingFile {
 public:
  /// Makes the file anew, or goes on at its end.
  explicit GrowingFile(std::filesystem::path file, bool goes_on = false);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  /// One or more whole lines.
  void write(std::string_view lines);
  void flush();
  /// Bytes that it has, with those that are not written yet.
  [[nodiscard]] std::uint64_t end() const { return end_; }

 private:
  std::filesystem::path file_;
  int descriptor_;
  std::uint64_t end_ = 0;
  std::string lines_;  ///< not written yet
};

/// trace.csv and events.csv (design §6), written while the run goes on: after a second of machine time at the
/// latest a row or an event is in its file.
class TraceFiles : public Observer {
 public:
  /// `recording` has all its channels and outlives this. `goes_on`: behind what is in the files, which are of
  /// that recording; else they are made anew.
  TraceFiles(const Recording& recording, const std::filesystem::path& trace,
             const std::filesystem::path& events, bool goes_on = false);
  /// The present values of the recording's channels.
  void sample(Time time) override;
  void happened(const RecordedEvent& event) override;
  /// Everything is in the files.
  void finish() override;
  /// Bytes that trace and events have.
  [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> ends() const { return {trace_.end(), events_.end()}; }

 private:
  void flush_at(Time time);

  const Recording& recording_;
  GrowingFile trace_;
  GrowingFile events_;
  static constexpr std::size_t longest = 32;  ///< [bytes] of a cell: the longest number takes 24
  /// A value of the last row.
  struct Cell {
    std::uint64_t bits = 0;
    std::size_t size = 0;  ///< of its text, with the comma before it; 0: there was none
    std::array<char, longest> text;
  };
  std::vector<Cell> cells_;
  std::string row_;  ///< with room for the longest one
  Time next_flush_ = 0;
};

/// How the first lines of drycut's traces and events begin.
inline constexpr std::string_view trace_header = "time [s]";
inline constexpr std::string_view events_header = "time [s],source,event,values";

/// The file of the events that belong to a trace in CSV: events.csv to trace.csv, x.events.csv to x.csv.
inline std::filesystem::path events_beside(const std::filesystem::path& trace) {
  const auto stem = trace.stem();
  return trace.parent_path() / (stem == "trace" ? "events.csv" : stem.string() + ".events.csv");
}

}  // namespace drycut::sim::record
