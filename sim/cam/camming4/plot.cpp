#include "sim/cam/camming4/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "sim/cam/findings.hpp"
#include "sim/cam/motion_plot.hpp"

namespace drycut::sim {

namespace {

std::string zone_name(const CamTable& table, const CamVisit& visit, bool steady) {
  using Kind = devices::camming4::Sector::Kind;
  const auto* code = devices::camming4::find_code(table.sector(visit.row).row.codeG);
  const auto kind = visit.sector.kind;
  const auto name = visit.waiting           ? "wait"
                    : kind == Kind::gearing ? "gearing"
                    : kind == Kind::arc_x || kind == Kind::arc_y
                        ? "arc"
                        : motion_name(visit.entry_speed(), visit.exit_speed(), steady);
  return fmt::format("{} {} {}", visit.row, code->mnemonic, name);
}

}  // namespace

std::vector<CamZone> zones_of(const CamTable& table, const CamRun& run) {
  std::vector<CamZone> zones;
  for (std::size_t i = 0; i < run.shown; ++i) {
    const auto& visit = run.visits[i];
    if (visit.master_length <= 0) continue;
    const bool steady = !visit.waiting && peak_gradient(visit) == 0;
    zones.push_back({visit.master_start, visit.master_end(), zone_name(table, visit, steady),
                     steady && is_master_speed(visit.entry_speed())});
  }
  return zones;
}

CamDrawing cam_plot(const CamTable& table, const CamDuty& duty, const CamRun& run, const std::string& name) {
  const bool timed = duty.master_speed.has_value();
  const double scale = um_per_second(table);
  const double master = timed ? *duty.master_speed * scale : 1;
  const auto speed = timed ? speed_unit(table) : "Um/Um";
  MotionPlot how;
  how.name = name;
  how.title = "Cam " + std::filesystem::path(table.file).filename().string();
  if (timed) how.title += fmt::format(", master at {} {}", number_text(*duty.master_speed, 6), speed);
  how.position = "Um";
  how.velocity = {speed, timed ? *duty.master_speed : 1};
  how.acceleration = {timed ? "Um/s²" : "Um/Um²", master * master};
  how.jerk = {timed ? "Um/s³" : "Um/Um³", master * master * master};
  if (timed) {
    if (duty.max_velocity) how.velocity_limits.push_back({"max velocity", *duty.max_velocity});
    if (table.maxvel > 0) how.velocity_limits.push_back({"maxvel", static_cast<double>(table.maxvel)});
    if (duty.max_acceleration)
      how.acceleration_limits.push_back({"max acceleration", *duty.max_acceleration});
    if (table.maxvel > 0 && table.taccmax > 0)
      how.acceleration_limits.push_back({table.tdecmax == table.taccmax ? "taccmax, tdecmax" : "taccmax",
                                         table.maxvel * scale * 100 / table.taccmax});
    if (table.maxvel > 0 && table.tdecmax > 0 && table.tdecmax != table.taccmax)
      how.acceleration_limits.push_back({"tdecmax", table.maxvel * scale * 100 / table.tdecmax});
  }
  how.zones = zones_of(table, run);
  if (timed) how.master_per_s = master;
  return motion_plot(sample_cam(run, true), how);
}

}  // namespace drycut::sim
