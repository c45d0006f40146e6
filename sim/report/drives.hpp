#pragma once
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "renders/report.hpp"
#include "sim/loop/drive_judge.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::report {

/// Every figure of every drive beside its rating, with a verdict each.
renders::ReportTable drive_table(const std::vector<record::DriveVerdict>& verdicts, bool judged);

/// The drive of a plant; nullptr where it has none.
const record::DriveVerdict* drive_of(const std::vector<record::DriveVerdict>& verdicts,
                                     const std::string& plant);

/// The border of what a motor can give for a short time over its speed: once round, backwards too where
/// `both_ways`; the same of what it can give for ever (S1). Speed [rpm], torque [N m].
renders::Curve peak_curve(const plants::DriveRatings& ratings, bool both_ways);
renders::Curve continuous_curve(const plants::DriveRatings& ratings, bool both_ways);

/// Adds to a plot the operating points of a drive, speed [rpm] and torque [N m], in the borders of what its
/// motor can give for a short time and for ever, and a point for each machine cycle.
void draw_torque_over_speed(const record::DriveVerdict& drive, renders::Curve points,
                            const std::string& title, renders::Plot& plot);

/// That of each drive over the whole run; not of those that the scenario has a plot of by itself.
std::vector<renders::Plot> drive_plots(const std::vector<record::DriveVerdict>& verdicts,
                                       const std::vector<scenario::PlotRequest>& requests);

}  // namespace drycut::sim::report
