#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "renders/report.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::report {

/// What the torque of a motor went into over its last machine cycles. The parts sum up to the torque at each
/// instant.
struct TorqueSplit {
  struct Part {
    std::string name;
    std::string meaning;
    std::vector<double> torque = {};  ///< every step of these cycles [N m]
    double rms = 0;                   ///< [N m]
    double peak = 0;                  ///< largest size [N m]
    /// Of the mean square of the torque: mean of part times torque. All shares sum up to 1; a part that
    /// relieves the motor has a negative one.
    double share = 0;
  };
  std::string drive;        ///< "knife.servo"
  std::size_t cycles = 0;   ///< 0: the run has none, it is all that was kept
  double begin = 0;         ///< [s]
  double end = 0;           ///< [s]
  bool has_cam = false;     ///< the first part is the ideal cam's; else the motion's as it was driven
  std::vector<Part> parts;  ///< those that are not 0
  Part torque;              ///< of the motor, all of them together
};

/// Before the run: its plants keep what the torques of their motors go into, every step of the last 10 s or
/// more, a machine cycle of up to 100 s among them where `drives` names one.
void follow_torques(const scenario::Scenario& scenario, loop::Simulation& simulation);
/// Of each drive that turned. The cycles are the last ten or fewer, as long as each other to 1 %: from cut to
/// cut of the drive's plant, or those of its verdict, as drives.cycle says; without cycles what its verdict
/// is of. The cam is that of the controller's axis whose position is the motor's; its acceleration is that of
/// the table's exact law under the master as it ran. What is left is the regulator's where it comes back in
/// every cycle, and counting noise where it does not. `simulation` has followed torques and cams.
std::vector<TorqueSplit> torque_splits(const scenario::Scenario& scenario, const loop::Simulation& simulation,
                                       const std::vector<record::DriveVerdict>& verdicts);

renders::ReportTable torque_table(const TorqueSplit& split);

}  // namespace drycut::sim::report
