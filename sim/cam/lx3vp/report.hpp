#pragma once
#include <string>

#include "renders/plots.hpp"
#include "sim/cam/lx3vp/table.hpp"
#include "sim/cam/study.hpp"

namespace drycut::sim {

/// The pieces of the cam and its totals, in words.
CamText ecam_text(const EcamTable& table, const CamCourse& run);

/// Position and ratio against the master; of a table that was made acceleration and jerk, and the ratio of
/// the straight pieces too. No panels if there is nothing to draw.
CamDrawing ecam_plot(const EcamTable& table, const CamDuty& duty, const CamCourse& run,
                     const std::string& name);

/// What the pieces of one cycle do, from its first master position on. Of many given rows only what is long
/// at one ratio.
std::vector<CamZone> zones_of(const EcamTable& table, const CamCourse& run);

}  // namespace drycut::sim
