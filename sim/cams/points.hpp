#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/cam/law.hpp"

namespace drycut::sim::cams {

/// A cam at one master position: full precision, before any quantisation. Positions in the table's unit (Um,
/// pulses, increments).
struct CamPoint : devices::CamMotion {
  double master = 0;  ///< counts on across loops and counter updates
  int row = 0;  ///< sector, or row of the table, that begins the piece; 0: the cam has released the slave
};

inline constexpr std::string_view cam_csv_header = "master,slave,velocity,acceleration,jerk,sector";
/// A table of these columns, and with the master's speed [units/s] `time,velocity_t,acceleration_t,jerk_t`
/// [s, slave units/s, /s2, /s3]. Numbers read back to the same bits.
std::string cam_csv(const std::vector<CamPoint>& points, std::optional<double> master_per_s);

/// The samples of `--at` as a table.
std::string cam_samples_text(const std::vector<CamPoint>& points);

}  // namespace drycut::sim::cams
