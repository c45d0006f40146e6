#pragma once
#include <optional>
#include <string>

#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::studies {

/// The communication step of a master [s]: "1 ms", "0.001"; nothing if it is no time up to 1 s.
std::optional<double> fmi_step_of(const std::string& text);

/// The margins of a measured loop whose reference comes `dead_time` [s] later, as behind a master that
/// exchanges values when all its parts have stepped.
Margins margins_behind(std::vector<BodePoint> points, double dead_time);

/// What is left of the margins, and from which step on less than nine tenths of the phase margin are; lines.
/// "" where no phase margin is known.
std::string fmi_step_text(const LoopResult& result, double step);

}  // namespace drycut::sim::studies
