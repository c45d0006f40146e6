#pragma once
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/compare/comparison.hpp"

namespace drycut::sim::studies {

/// A plot of a run, to be drawn of several over each other.
struct OverlayRequest {
  scenario::PlotRequest plot;
  /// Instead of the plot's window: about an event of each run, from where its time then counts.
  std::optional<scenario::PicturesSection::Around> around;
  /// Instead of the plot's window: events of each run behind its start-up, which are counted from there.
  std::string behind_start = {};    ///< "knife.cut", "" = not asked
  std::optional<double> from = {};  ///< [s] in place of the runs' own start-up
};

/// A name of channels as a part of a file's: "Axis_position".
std::string as_file_name(const std::string& name);

/// The plots with the curves of every run that has what they show, named by the run.
std::vector<renders::Plot> overlay(const std::vector<ComparedRun>& runs,
                                   const std::vector<OverlayRequest>& requests);

/// What is overlaid without a request: channels that runs share, a plot for each part of the machine; the
/// values of each kind of event against their number.
std::vector<OverlayRequest> usual_overlays(const Comparison& comparison);

}  // namespace drycut::sim::studies
