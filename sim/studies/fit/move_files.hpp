#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/studies/fit/move.hpp"

namespace drycut::sim::studies {

/// What a plan may write into its folder.
inline const std::vector<std::string> move_files = {
    "move.csv",        "move.txt", "machine.yaml", "plan_qmove.yaml", "plan_plcopen.yaml",
    "plan_lx3vp.yaml", "plan.cnf", "plan.mod",     "plan.st",         "plan.il"};

/// What a part is for, in words.
std::string_view words_of(MovePart part);

/// The move for the drive's own generator, and what to record: move.txt.
std::string move_text(const FitMove& move);
/// What a terminal is told.
std::string move_summary(const FitMove& move);
/// Time, speed of the motor, position and the part at each end of a segment; a chirp's torque is not in it.
std::string move_table(const FitMove& move);

/// Writes all of it. Throws std::runtime_error if something cannot be written.
void write_move(const FitPlan& plan, const FitMove& move, OutputFolder& folder);

}  // namespace drycut::sim::studies
