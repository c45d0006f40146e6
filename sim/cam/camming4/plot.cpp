#include "sim/cam/camming4/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "sim/cam/findings.hpp"
#include "sim/cam/motion_plot.hpp"

namespace drycut::sim {

namespace {

constexpr std::size_t most_marks = 1000;

std::vector<renders::Mark> marks_of(const CamTable& table, const CamRun& run) {
  std::vector<renders::Mark> marks;
  for (std::size_t i = 0; i < std::min(run.shown, most_marks); ++i) {
    const auto& visit = run.visits[i];
    const auto* code = devices::camming4::find_code(table.sector(visit.row).row.codeG);
    if (visit.master_length > 0)
      marks.push_back({visit.master_start, fmt::format("{} {}", visit.row, code->mnemonic)});
  }
  return marks;
}

}  // namespace

renders::Plot cam_plot(const CamTable& table, const CamDuty& duty, const CamRun& run,
                       const std::string& name) {
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
  how.marks = marks_of(table, run);
  return motion_plot(sample_cam(run, true), how);
}

}  // namespace drycut::sim
