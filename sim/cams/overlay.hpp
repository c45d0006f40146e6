#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/cams/course.hpp"
#include "sim/loop/played_cams.hpp"

namespace drycut::sim::cams {

/// A stretch of samples inside one cycle of the cam.
struct PlayedCycle {
  std::size_t cycle = 0;  ///< index in IdealCam::cycles
  std::size_t first = 0;  ///< samples
  std::size_t last = 0;
  bool whole = false;  ///< from end to end of the cycle
};

/// How far an axis was from its cam, in the ideal cam's error unit.
struct CamErrors {
  std::vector<double> set;  ///< set minus ideal position, one a sample; not a number where there is no ideal
  std::vector<double> behind;  ///< set minus measured position; not a number where nothing measures
};
CamErrors errors_of(const loop::PlayedCam& played, const IdealCam& ideal);

/// The cycles in the order of running.
std::vector<PlayedCycle> cycles_of(const loop::PlayedCam& played, const IdealCam& ideal);
/// The one to show: the last whole cycle, else the longest part of one; nothing if there is none.
const PlayedCycle* shown_cycle(const std::vector<PlayedCycle>& cycles);

/// The largest and the root of the mean square of errors, over what is a number.
struct ErrorFigures {
  std::size_t count = 0;
  double largest = 0;
  double rms = 0;
};
ErrorFigures figures_of(const std::vector<double>& errors);

/// An error of 0 or more for a reader: what is far below `step`, the least that the device counts, is not
/// told in digits.
std::string error_text(double error, double step);

/// One cycle: ideal, set and measured position over the master, and their differences magnified below, those
/// of all other cycles of this length pale behind. `shown` is one of `cycles`.
renders::Plot overlay_plot(const loop::PlayedCam& played, const IdealCam& ideal, const CamErrors& errors,
                           const std::vector<PlayedCycle>& cycles, const PlayedCycle& shown,
                           const std::string& name);

}  // namespace drycut::sim::cams
