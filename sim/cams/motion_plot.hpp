#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/cams/course.hpp"

namespace drycut::sim::cams {

/// Velocity, acceleration or jerk as it is drawn and judged, with what it must not pass to both sides.
struct CamQuantity {
  struct Limit {
    std::string name;  ///< in the drawing
    double value = 0;
    /// What is found of a peak: "velocity {is} {unit} above {limit}"; "" = it is drawn only.
    std::string found = {};
    /// What else than a slower master is right: "lower its ratio {is} to {most}, or ".
    std::string instead = {};
  };
  std::string unit;  ///< "Um", "Um/Um2"
  double scale = 1;  ///< of what a point holds
  std::vector<Limit> limits = {};

  void limit(std::string name, std::optional<double> value, std::string found = "", std::string instead = "");
};

/// The largest value of what is drawn.
struct CamPeak {
  std::string name;  ///< "velocity"
  CamQuantity quantity;
  double value = 0;  ///< with its sign, in the quantity's unit
  double master = 0;
};

/// What a kind calls the motion of a cam, drawn and judged: position, velocity, acceleration and jerk against
/// the master, with their units and limits.
struct CamMotionWords {
  std::string title = {};
  std::string position = {};         ///< unit of master and slave as they are shown
  std::string master_position = {};  ///< unit of the master if it is another, as counts of time
  double per_unit = 1;               ///< of the table's units in a shown one
  CamQuantity velocity = {};
  CamQuantity acceleration = {};
  CamQuantity jerk = {};
  double master_speed = 0;                    ///< that the limits are judged at, in the next unit
  std::string speed_unit = {};                ///< of the master
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
CamDrawing motion_plot(const CamCourse& course, const std::vector<CamZone>& zones, const CamMotionWords& how,
                       const std::string& name);

}  // namespace drycut::sim::cams
