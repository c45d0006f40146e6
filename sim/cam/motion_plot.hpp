#pragma once
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/cam/points.hpp"

namespace drycut::sim {

/// How a cam of any device is drawn: position, velocity, acceleration and jerk against the master.
struct MotionPlot {
  struct Limit {
    std::string name;
    double value = 0;
  };
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
  std::vector<renders::Mark> marks = {};
};

renders::Plot motion_plot(const std::vector<CamPoint>& points, const MotionPlot& how);

}  // namespace drycut::sim
