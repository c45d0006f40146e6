#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "devices/cam/table.hpp"
#include "sim/cams/course.hpp"
#include "sim/studies/design/cam.hpp"

namespace drycut::sim::studies {

/// A way in pulses, exactly: `millimetres` over `count` of them.
struct PulseWay {
  double millimetres = 0.01;
  double count = 1;

  [[nodiscard]] double metres() const { return millimetres / count / 1000; }
  [[nodiscard]] double pulses(double metres) const { return metres * 1000 / millimetres * count; }
};

/// What a device needs to know of the machine.
struct DesignAxes {
  PulseWay master;
  PulseWay slave;
  std::optional<int> decpt = {};  ///< CAMMING4: 1 Um = 10^-decpt mm; absent = the coarsest that fits the job
  /// MC_CamIn: where the middle of the synchronous way is to be; absent = half of it behind the beginning.
  struct Cut {
    double master = 0;  ///< [m]
    double slave = 0;   ///< at the blade [m]
  };
  std::optional<Cut> cut = {};
};

/// A cam as a device plays it.
struct DeviceCam {
  devices::CamTable table = {};
  DesignJob job = {};       ///< with the synchronous way of the table
  CamFigures figures = {};  ///< of what the device makes of the table
  double sync_begin = 0;    ///< master in the table's unit, in the cycle that repeats itself
  double sync_end = 0;
  std::string unit = {};                ///< of the master in the table
  std::vector<std::string> notes = {};  ///< what the table consists of
  /// Of what was to be small, the least that the device can do, where that is known and more than the cam's.
  std::optional<double> least = {};
  std::string why = {};     ///< it is not less
  cams::CamDuty duty = {};  ///< of the job, in the table's units
};

/// Each fits the cam to what its device can play, and tells in `problems` what it cannot.
std::optional<DeviceCam> fit_camming4(const DesignJob& job, const DesignAxes& axes, Problems& problems);
std::optional<DeviceCam> fit_lx3vp(const DesignJob& job, const DesignAxes& axes, Problems& problems);
std::optional<DeviceCam> fit_mc_camin(const DesignJob& job, const DesignAxes& axes, Problems& problems);

/// Gives `fit` best cams of a job, each a little farther inside its limits than the one before, until one
/// fits: what a device rounds passes limits that the cam itself just keeps.
void fit_with_room(const DesignJob& job, const std::function<bool(const DesignedCam&)>& fit,
                   const DesignGrid& grid = {});

/// True if what a device plays keeps the job's limits.
bool keeps_limits(const DesignJob& job, const CamFigures& figures);

/// A way as a whole number of units, or a problem of `option` with the nearest that is one.
std::optional<double> whole_units(const char* option, double metres, double unit, const char* name,
                                  Problems& problems);

}  // namespace drycut::sim::studies
