#pragma once
#include <string>

#include "base/problem.hpp"
#include "renders/plots.hpp"
#include "sim/studies/fit/replay.hpp"

namespace drycut::sim::studies {

/// Recorded torque and that of the model, what is unexplained, and the speed. A stretch that the fit left out
/// is a gap.
renders::Plot replay_over_time(const std::string& name, const Prose& title, const Replayed& one);
/// What is unexplained, a dot an instant.
renders::Plot unexplained_over_speed(const std::string& name, const Replayed& one);
renders::Plot unexplained_over_position(const std::string& name, const Replayed& one);

}  // namespace drycut::sim::studies
