#pragma once
#include <optional>

namespace drycut::sim {

/// What a cam is judged at. Speeds are in the table's own unit: of CAMMING4 10^decpt Um (the unit that the
/// decimal point makes) per unitvel time, as the device's maxvel; of LX3VP pulses per second; of MC_CamIn deg
/// or mm per second.
struct CamDuty {
  std::optional<double> master_speed = {};
  std::optional<double> max_velocity = {};      ///< of the slave
  std::optional<double> max_acceleration = {};  ///< of the slave, [Um/s2, pulses/s2, deg/s2 or mm/s2]
};

}  // namespace drycut::sim
