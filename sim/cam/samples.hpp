#pragma once
#include <string>
#include <vector>

#include "sim/cam/run.hpp"

namespace drycut::sim {

/// The cam at one master position: full precision, before any quantisation. Derivatives are with respect to
/// the master: slave Um per master Um, Um2, Um3.
struct CamPoint {
  double master = 0;  ///< [Um], counts on across loops and counter updates
  double slave = 0;   ///< [Um]
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
  int row = 0;  ///< 0: the cam has released the slave
};

/// 1000 points a pass, evenly spaced, and every boundary of sectors and of the phases inside them; where the
/// velocity steps, before and after. With `both_sides`, for drawing, before and after at every boundary and
/// at least 64 points a sector.
std::vector<CamPoint> sample_cam(const CamRun& run, bool both_sides = false);

/// At the given positions, each 0 .. run.master_total, in the order of running; a boundary belongs to the
/// sector that it begins.
std::vector<CamPoint> sample_cam_at(const CamRun& run, std::vector<double> masters);

/// `master,slave,velocity,acceleration,jerk,sector`, and with the master's speed [Um/s]
/// `time,velocity_t,acceleration_t,jerk_t` [s, slave Um/s, Um/s2, Um/s3]. Numbers read back to the same bits.
std::string cam_csv(const std::vector<CamPoint>& points, std::optional<double> master_um_per_s);

}  // namespace drycut::sim
