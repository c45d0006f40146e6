#pragma once
#include <string>

#include "sim/studies/tune/report.hpp"

namespace drycut::sim::studies {

/// What to paste: the tuned values and those of `--set`, as YAML for a scenario, each with who set it; as
/// comments in it QCL lines and the arguments of drycut run.
std::string patch_text(const Tuning& tuning);

}  // namespace drycut::sim::studies
