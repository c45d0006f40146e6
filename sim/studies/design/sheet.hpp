#pragma once
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/cams/report.hpp"
#include "sim/studies/design/fit.hpp"

namespace drycut::sim::studies {

/// What was designed: the best cam there is and, if a device was named, what it plays of it.
struct DesignSheet {
  DesignedCam cam;
  std::optional<DeviceCam> device;
  std::string device_name = {};
  std::vector<cams::CamFinding> findings = {};  ///< of `drycut cam` about the device's table
};

/// The sheet that `drycut design` prints.
std::string sheet_text(const DesignSheet& sheet);
/// The first lines of it, as remarks of a table's file.
std::string remarks_text(const DesignSheet& sheet);

/// Position, velocity, acceleration and jerk over the master, with the quintic behind them.
renders::Plot design_plot(const DesignSheet& sheet);

}  // namespace drycut::sim::studies
