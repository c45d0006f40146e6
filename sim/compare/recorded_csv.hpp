#pragma once
#include <string>
#include <string_view>

#include "base/problem.hpp"
#include "sim/recorder.hpp"

namespace drycut::sim {

/// The remedy for a file of results that is not as it was written.
inline constexpr auto* run_again = "run the scenario again: drycut run writes the file";

// trace.csv and events.csv read back (sim/recorder.hpp writes them). `file` names the text in messages; what
// is wrong goes to `problems`, and then the result is not to be used.

/// The channels of a run: first column `time [s]`, ascending, then `channel [unit]`.
Recording read_trace(std::string_view text, const std::string& file, Problems& problems);
/// Adds the events of a run to its recording. Times have nine digits behind the point, values nine in all.
void read_events(std::string_view text, const std::string& file, Recording& recording, Problems& problems);

}  // namespace drycut::sim
