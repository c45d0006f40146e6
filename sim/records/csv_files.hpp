#pragma once
#include <filesystem>

namespace drycut::sim::records {

/// The file of the events that belong to a trace in CSV: events.csv to trace.csv, x.events.csv to x.csv.
inline std::filesystem::path events_beside(const std::filesystem::path& trace) {
  const auto stem = trace.stem();
  return trace.parent_path() / (stem == "trace" ? "events.csv" : stem.string() + ".events.csv");
}

}  // namespace drycut::sim::records
