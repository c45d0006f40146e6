#pragma once
#include <filesystem>
#include <string_view>

namespace drycut::sim::record {

/// How the first lines of drycut's traces and events begin.
inline constexpr std::string_view trace_header = "time [s]";
inline constexpr std::string_view events_header = "time [s],source,event,values";

/// The file of the events that belong to a trace in CSV: events.csv to trace.csv, x.events.csv to x.csv.
inline std::filesystem::path events_beside(const std::filesystem::path& trace) {
  const auto stem = trace.stem();
  return trace.parent_path() / (stem == "trace" ? "events.csv" : stem.string() + ".events.csv");
}

}  // namespace drycut::sim::record
