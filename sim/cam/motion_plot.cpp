#include "sim/cam/motion_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/cam/findings.hpp"

namespace drycut::sim {

namespace {

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

}  // namespace

renders::Plot motion_plot(const std::vector<CamPoint>& points, const MotionPlot& how) {
  renders::Plot plot;
  plot.name = how.name;
  plot.title = how.title;
  plot.x_label = fmt::format("master [{}]", how.master_position.empty() ? how.position : how.master_position);
  plot.width = 1600;
  plot.panel_height = 240;
  const auto panel = [&](double CamPoint::*number, const MotionPlot::Unit& unit, const std::string& title) {
    return panel_of(points, number, unit.scale, title, unit.text);
  };
  plot.panels = {panel(&CamPoint::slave, {how.position, 1}, "slave position"),
                 panel(&CamPoint::velocity, how.velocity, "velocity"),
                 panel(&CamPoint::acceleration, how.acceleration, "acceleration"),
                 panel(&CamPoint::jerk, how.jerk, "jerk, between the steps of acceleration")};
  for (const auto& limit : how.velocity_limits)
    draw_limit(plot.panels[1], limit.name, limit.value, how.velocity.text);
  for (const auto& limit : how.acceleration_limits)
    draw_limit(plot.panels[2], limit.name, limit.value, how.acceleration.text);
  plot.marks = how.marks;
  return plot;
}

}  // namespace drycut::sim
