#pragma once
#include <optional>
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/cam/points.hpp"
#include "sim/cam/zone.hpp"

namespace drycut::sim {

/// The largest value of one of the things that are drawn, and what it must not pass.
struct CamPeak {
  struct Limit {
    std::string name;
    double value = 0;
  };
  std::string name;  ///< "velocity"
  std::string unit;
  double value = 0;  ///< with its sign
  double master = 0;
  std::vector<Limit> limits = {};
};

/// A cam drawn.
struct CamDrawing {
  renders::Plot plot;
  std::vector<CamPeak> peaks = {};  ///< of velocity, acceleration and jerk
};

/// How a cam of any device is drawn: position, velocity, acceleration and jerk against the master.
struct MotionPlot {
  using Limit = CamPeak::Limit;
  struct Unit {
    std::string text;  ///< "Um", "Um/Um2"
    double scale = 1;  ///< of what a point holds
  };
  std::string name;  ///< of the picture's file
  std::string title;
  std::string position;              ///< unit of master and slave
  std::string master_position = {};  ///< unit of the master if it is another, as counts of time
  Unit velocity;
  Unit acceleration;
  Unit jerk;
  std::vector<Limit> velocity_limits = {};  ///< to both sides
  std::vector<Limit> acceleration_limits = {};
  std::vector<Limit> jerk_limits = {};
  std::vector<CamZone> zones = {};
  std::optional<double> master_per_s = {};  ///< speed of the master: then time is told beside it
};

/// Draws the stretches as bands and their names as marks over them.
void draw_zones(renders::Plot& plot, const std::vector<CamZone>& zones);

CamDrawing motion_plot(const std::vector<CamPoint>& points, const MotionPlot& how);

}  // namespace drycut::sim
