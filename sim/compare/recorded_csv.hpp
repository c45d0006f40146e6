#pragma once
#include <string>
#include <string_view>

#include "devices/problem.hpp"
#include "sim/recorder.hpp"

namespace drycut::sim {

// trace.csv and events.csv read back (sim/recorder.hpp writes them). `file` names the text in messages; what
// is wrong goes to `problems`, and then the result is not to be used.

/// The channels of a run: first column `time [s]`, ascending, then `channel [unit]`.
Recording read_trace(std::string_view text, const std::string& file, devices::Problems& problems);
/// Adds the events of a run to its recording. Times have nine digits behind the point, values nine in all.
void read_events(std::string_view text, const std::string& file, Recording& recording,
                 devices::Problems& problems);

}  // namespace drycut::sim
