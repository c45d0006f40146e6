#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/cam/duty.hpp"
#include "sim/cam/lx3vp/table.hpp"
#include "sim/cam/points.hpp"

namespace drycut::sim {

/// A cam of LX3VP run without a machine: the laws that ECAMTBX rounded to its rows, or the straight pieces
/// between rows that were given.
struct EcamRun {
  devices::lx3vp::CamProfile law;  ///< of one cycle, from its own first master position on
  double first_master = 0;         ///< of a cycle in the table [pulses]
  double first_slave = 0;
  int loops = 1;
  std::optional<double> master_speed;  ///< [pulses/s]; of a time axis always known

  [[nodiscard]] double cycle() const { return law.master_length; }
  [[nodiscard]] double master_total() const { return loops * law.master_length; }
  [[nodiscard]] double slave_total() const { return loops * law.slave_length; }
};

/// Empty pieces if the table has no two rows in ascending order or ECAMTBX refused it.
EcamRun run_ecam(const EcamTable& table, const CamDuty& duty, int loops);

/// 1000 points a cycle, evenly spaced, and every boundary of pieces; where the ratio steps, before and after.
/// With `both_sides`, for drawing, before and after at every boundary.
std::vector<CamPoint> sample_ecam(const EcamRun& run, bool both_sides = false);
/// At the given positions of the master, each within the run, in the order of running.
std::vector<CamPoint> sample_ecam_at(const EcamRun& run, std::vector<double> masters);

}  // namespace drycut::sim
