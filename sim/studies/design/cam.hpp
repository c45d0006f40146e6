#pragma once
#include <optional>
#include <vector>

#include "devices/cam/law.hpp"
#include "sim/studies/design/job.hpp"

namespace drycut::sim::studies {

/// A job's best cam. A cycle begins where the synchronous way does.
struct DesignedCam {
  DesignJob job;  ///< with the synchronous way that it has
  devices::CamLaw
      law;  ///< a line, or cubics where a blade swings through material; then cubics of one length [m]
  double home = 0;  ///< where in the cycle a device's table begins [m of the master]
  int steps = 0;    ///< cubics
  /// The slave at any master position, cycle after cycle.
  [[nodiscard]] devices::CamMotion at(double master) const;
};

/// How finely it is made. A device's own grid may be coarser.
struct DesignGrid {
  int steps = 100;              ///< of half the way from cut to cut
  bool stands_at_step = false;  ///< the slave turns round at the end of a step, not within
  int swing = 64;               ///< cubics of a synchronous way on which the blade swings through material
};

/// The best cam for a job that nothing hinders; nothing if there is none on this grid. Its home: where a
/// flying saw turns round before the cut, in the middle between the cuts of a knife, of a feed where it
/// stands.
std::optional<DesignedCam> design_cam(const DesignJob& job, const DesignGrid& grid = {});

/// What a cam asks of its drive in a cycle; everything with respect to the master, in m.
struct CamFigures {
  double squares = 0;   ///< integral of the acceleration squared [1/m]
  double forces = 0;    ///< the same with friction
  double ratio = 0;     ///< largest
  double gradient = 0;  ///< largest acceleration [1/m]
  double jerk = 0;      ///< largest between the steps of acceleration [1/m2]
  double low = 0;       ///< where the slave is at most [m]
  double high = 0;
};
/// Of a law over a cycle of it from master position `from` on, its units in m.
CamFigures figures_of(const devices::CamLaw& law, double from, double length, double master_unit,
                      double slave_unit, const DesignJob& job);
inline CamFigures figures_of(const DesignedCam& cam) {
  return figures_of(cam.law, 0, cam.job.length, 1, 1, cam.job);
}

/// A classical move: factors of distance^2/way^3, distance/way, distance/way^2, distance/way^3.
struct ClassicalMove {
  const char* name;
  double squares;
  double speed;
  double gradient;
  double jerk;
};
extern const ClassicalMove quintic;
extern const ClassicalMove cycloid;
/// Its figures for a job.
CamFigures figures_of(const ClassicalMove& move, const DesignJob& job);

/// The integral of a^2 times way^3/distance^2, the measure of cams of any size; of a steady job 0.
double factor_of(const CamFigures& figures, const DesignJob& job);

}  // namespace drycut::sim::studies
