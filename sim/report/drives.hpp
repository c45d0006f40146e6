#pragma once
#include <vector>

#include "plants/power_stage.hpp"
#include "renders/plots.hpp"
#include "renders/report.hpp"
#include "sim/loop/drive_judge.hpp"

namespace drycut::sim::report {

/// The border of what a motor can give for a short time, or for ever, over its speed: once round, backwards
/// too where `both_ways`. Numbers are rad/s over `speed_unit` and N m over `torque_unit`.
renders::Curve peak_curve(const plants::DriveRatings& ratings, bool both_ways, double speed_unit = 1,
                          double torque_unit = 1);
renders::Curve continuous_curve(const plants::DriveRatings& ratings, bool both_ways, double speed_unit = 1,
                                double torque_unit = 1);

/// Every figure of every drive beside its rating, with a verdict each.
renders::ReportTable drive_table(const std::vector<loop::DriveVerdict>& verdicts);

/// For each drive torque over speed: its curves, its operating points, and a point for each machine cycle.
std::vector<renders::Plot> drive_plots(const std::vector<loop::DriveVerdict>& verdicts);

}  // namespace drycut::sim::report
