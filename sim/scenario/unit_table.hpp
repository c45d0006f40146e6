#pragma once
#include <filesystem>

namespace drycut::sim::scenario {

/// Has the table of units read from this udunits2.xml, for a system that has none in its place: before any
/// unit is asked for in this process; later it does nothing. Safe to call from several threads.
void read_units_from(const std::filesystem::path& xml);

}  // namespace drycut::sim::scenario
