#include "sim/cam/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "sim/cam/findings.hpp"

namespace drycut::sim {

namespace {

constexpr std::size_t most_marks = 1000;

/// A panel of one of the points' numbers times `scale`.
renders::Panel panel_of(const std::vector<CamPoint>& points, double CamPoint::*number, double scale,
                        const std::string& title, const std::string& unit) {
  renders::Panel panel;
  panel.title = title;
  panel.y_label = fmt::format("[{}]", unit);
  renders::Curve curve;
  for (const auto& point : points) {
    curve.x.push_back(point.master);
    curve.y.push_back(point.*number * scale);
  }
  panel.curves.push_back(std::move(curve));
  return panel;
}

/// A limit to both sides. One far outside what the curve needs would flatten it: then only the title tells.
void draw_limit(renders::Panel& panel, const std::string& name, double limit, const std::string& unit) {
  constexpr double far = 4;
  double peak = 0;
  for (const double y : panel.curves.front().y) peak = std::max(peak, std::abs(y));
  const auto label = fmt::format("{} {} {}", name, number_text(limit, 6), unit);
  if (limit > far * peak) {
    panel.title += fmt::format("   (far below {})", label);
    return;
  }
  panel.bands.push_back({label, limit, limit});
  const auto& y = panel.curves.front().y;
  if (std::any_of(y.begin(), y.end(), [](double value) { return value < 0; }))
    panel.bands.push_back({"", -limit, -limit});
}

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
  const auto points = sample_cam(run, true);
  const bool timed = duty.master_speed.has_value();
  const double scale = um_per_second(table);
  const double master = timed ? *duty.master_speed * scale : 1;
  const auto speed = timed ? speed_unit(table) : "Um/Um";
  renders::Plot plot;
  plot.name = name;
  plot.title = "Cam " + std::filesystem::path(table.file).filename().string();
  if (timed) plot.title += fmt::format(", master at {} {}", number_text(*duty.master_speed, 6), speed);
  plot.x_label = "master [Um]";
  plot.width = 1600;
  plot.panel_height = 240;
  plot.panels = {
      panel_of(points, &CamPoint::slave, 1, "slave position", "Um"),
      panel_of(points, &CamPoint::velocity, timed ? *duty.master_speed : 1, "velocity", speed),
      panel_of(points, &CamPoint::acceleration, master * master, "acceleration", timed ? "Um/s²" : "Um/Um²"),
      panel_of(points, &CamPoint::jerk, master * master * master, "jerk, between the steps of acceleration",
               timed ? "Um/s³" : "Um/Um³")};
  if (timed) {
    if (duty.max_velocity) draw_limit(plot.panels[1], "max velocity", *duty.max_velocity, speed);
    if (table.maxvel > 0) draw_limit(plot.panels[1], "maxvel", table.maxvel, speed);
    if (duty.max_acceleration)
      draw_limit(plot.panels[2], "max acceleration", *duty.max_acceleration, "Um/s²");
    if (table.maxvel > 0 && table.taccmax > 0)
      draw_limit(plot.panels[2], table.tdecmax == table.taccmax ? "taccmax, tdecmax" : "taccmax",
                 table.maxvel * scale * 100 / table.taccmax, "Um/s²");
    if (table.maxvel > 0 && table.tdecmax > 0 && table.tdecmax != table.taccmax)
      draw_limit(plot.panels[2], "tdecmax", table.maxvel * scale * 100 / table.tdecmax, "Um/s²");
  }
  plot.marks = marks_of(table, run);
  return plot;
}

}  // namespace drycut::sim
