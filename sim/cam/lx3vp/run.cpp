#include "sim/cam/lx3vp/table.hpp"

namespace drycut::sim {

namespace {

/// The pieces between given rows; none if they do not ascend.
devices::CamLaw straight_pieces(const EcamTable& table) {
  devices::CamLaw law;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const double length = static_cast<double>(table.rows[i].master) - table.rows[i - 1].master;
    const double rise = static_cast<double>(table.rows[i].slave) - table.rows[i - 1].slave;
    if (length <= 0) return {};
    const double ratio = rise / length;
    law.pieces.push_back({law.master_length, length, law.slave_length, static_cast<int>(i),
                          devices::CamTransition{ratio, ratio}});
    law.master_length += length;
    law.slave_length += rise;
  }
  return law;
}

}  // namespace

CamCourse run_ecam(const EcamTable& table, const CamDuty& duty, int loops) {
  constexpr double ticks_per_second = 10000;
  CamCourse run;
  run.loops = loops;
  run.master_speed = duty.master_speed;
  if (table.time_axis > 0) run.master_speed = ticks_per_second / table.time_axis;
  if (table.is_made()) {
    run.law = table.made.profile;
  } else if (!table.rows.empty()) {
    run.law = straight_pieces(table);
    run.first_master = table.rows.front().master;
    run.first_slave = table.rows.front().slave;
  }
  return run;
}

}  // namespace drycut::sim
