#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/cams/course.hpp"
#include "sim/cams/zone.hpp"

namespace drycut::sim::cams {

/// Velocity, acceleration or jerk as it is drawn, with what it must not pass to both sides.
struct CamQuantity {
  struct Limit {
    std::string name;
    double value = 0;
  };
  std::string unit;  ///< "Um", "Um/Um2"
  double scale = 1;  ///< of what a point holds
  std::vector<Limit> limits = {};

  void limit(const std::string& limited_by, std::optional<double> value);
};

/// The largest value of what is drawn.
struct CamPeak {
  std::string name;  ///< "velocity"
  CamQuantity quantity;
  double value = 0;  ///< with its sign, in the quantity's unit
  double master = 0;
};

/// How a cam of any device is drawn: position, velocity, acceleration and jerk against the master.
struct MotionPlot {
  std::string title = {};
  std::string position = {};         ///< unit of master and slave as they are shown
  std::string master_position = {};  ///< unit of the master if it is another, as counts of time
  double per_unit = 1;               ///< of the table's units in a shown one
  CamQuantity velocity = {};
  CamQuantity acceleration = {};
  CamQuantity jerk = {};
  bool straight = false;                      ///< pieces of one ratio each: nothing but velocity is told
  std::optional<renders::Curve> played = {};  ///< velocity that the device makes of the law
};

/// Draws the stretches as bands and their names as marks over them.
void draw_zones(renders::Plot& plot, const std::vector<CamZone>& zones);

/// A cam drawn, and its peaks.
struct CamDrawing {
  renders::Plot plot;
  std::vector<CamPeak> peaks = {};
};
/// `zones` are those of one cycle; behind a master of known speed time is told beside it.
CamDrawing motion_plot(const CamCourse& course, const std::vector<CamZone>& zones, const MotionPlot& how,
                       const std::string& name);

}  // namespace drycut::sim::cams
