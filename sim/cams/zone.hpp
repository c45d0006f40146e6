#pragma once
#include <string>

namespace drycut::sim::cams {

/// A stretch of a cam: a sector, a phase, a segment.
struct CamZone {
  double from = 0;  ///< master, in the table's unit
  double to = 0;
  std::string name;          ///< "2 RSC synchronism"
  bool synchronous = false;  ///< the slave runs with the web: at the master's speed, or at a steady ratio
};

/// Names a stretch by the slave's speeds at its ends, in masters: "acceleration", "synchronism", "dwell" ...
/// `steady`: they do not change between.
std::string motion_name(double entry, double exit, bool steady);
/// True at the speed of the master itself.
bool is_master_speed(double speed);

}  // namespace drycut::sim::cams
