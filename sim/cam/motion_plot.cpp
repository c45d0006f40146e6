#include "sim/cam/motion_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/cam/findings.hpp"

namespace drycut::sim {

namespace {

/// A panel of one of the points' numbers times `scale`.
renders::Panel panel_of(const std::vector<CamPoint>& points, double devices::CamMotion::*number, double scale,
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

CamPeak peak_of(const std::vector<CamPoint>& points, double devices::CamMotion::*number,
                const std::string& name, const MotionPlot::Unit& unit,
                const std::vector<MotionPlot::Limit>& limits) {
  CamPeak peak{name, unit.text, 0, 0, limits};
  for (const auto& point : points) {
    const double value = point.*number * unit.scale;
    if (std::abs(value) <= std::abs(peak.value)) continue;
    peak.value = value;
    peak.master = point.master;
  }
  return peak;
}

std::vector<CamPeak> motion_peaks(const std::vector<CamPoint>& points, const MotionPlot& how) {
  return {
      peak_of(points, &CamPoint::velocity, "velocity", how.velocity, how.velocity_limits),
      peak_of(points, &CamPoint::acceleration, "acceleration", how.acceleration, how.acceleration_limits),
      peak_of(points, &CamPoint::jerk, "jerk, between the steps of acceleration", how.jerk, how.jerk_limits)};
}

}  // namespace

void draw_zones(renders::Plot& plot, const std::vector<CamZone>& zones) {
  constexpr std::size_t most = 1000;
  for (std::size_t i = 0; i < std::min(zones.size(), most); ++i) {
    const CamZone& zone = zones[i];
    plot.zones.push_back({zone.from, zone.to, zone.synchronous});
    plot.marks.push_back({zone.from, zone.name});
  }
}

CamDrawing motion_plot(const std::vector<CamPoint>& points, const MotionPlot& how) {
  renders::Plot plot;
  plot.name = how.name;
  plot.title = how.title;
  plot.x_label = fmt::format("master [{}]", how.master_position.empty() ? how.position : how.master_position);
  plot.width = 1600;
  plot.panel_height = 240;
  const auto panel = [&](double devices::CamMotion::*number, const MotionPlot::Unit& unit,
                         const std::string& title) {
    return panel_of(points, number, unit.scale, title, unit.text);
  };
  plot.panels = {panel(&CamPoint::position, {how.position, 1}, "slave position"),
                 panel(&CamPoint::velocity, how.velocity, "velocity"),
                 panel(&CamPoint::acceleration, how.acceleration, "acceleration"),
                 panel(&CamPoint::jerk, how.jerk, "jerk, between the steps of acceleration")};
  for (const auto& limit : how.velocity_limits)
    draw_limit(plot.panels[1], limit.name, limit.value, how.velocity.text);
  for (const auto& limit : how.acceleration_limits)
    draw_limit(plot.panels[2], limit.name, limit.value, how.acceleration.text);
  for (const auto& limit : how.jerk_limits)
    draw_limit(plot.panels[3], limit.name, limit.value, how.jerk.text);
  draw_zones(plot, how.zones);
  if (how.master_per_s) plot.second_x = renders::SecondScale{"time [s]", 1 / *how.master_per_s};
  return {std::move(plot), motion_peaks(points, how)};
}

}  // namespace drycut::sim
