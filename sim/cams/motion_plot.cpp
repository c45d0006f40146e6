#include "sim/cams/motion_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/cams/report.hpp"

namespace drycut::sim::cams {

namespace {

/// One of the points' numbers against the master.
struct DrawnCurve {
  std::string title;
  double devices::CamMotion::*number;
  CamQuantity quantity;
};

renders::Panel panel_of(const std::vector<CamPoint>& points, const DrawnCurve& drawn) {
  renders::Panel panel;
  panel.title = drawn.title;
  panel.y_label = fmt::format("[{}]", drawn.quantity.unit);
  renders::Curve curve;
  for (const auto& point : points) {
    curve.x.push_back(point.master);
    curve.y.push_back(point.*drawn.number * drawn.quantity.scale);
  }
  panel.curves.push_back(std::move(curve));
  return panel;
}

/// A limit to both sides. One far outside what the curve needs would flatten it: then only the title tells.
void draw_limit(renders::Panel& panel, const CamQuantity::Limit& limit, const std::string& unit) {
  constexpr double far = 4;
  const auto& y = panel.curves.front().y;
  double peak = 0;
  for (const double value : y) peak = std::max(peak, std::abs(value));
  const auto label = fmt::format("{} {} {}", limit.name, number_text(limit.value, 6), unit);
  if (limit.value > far * peak) {
    panel.title += fmt::format("   (far below {})", label);
    return;
  }
  panel.bands.push_back({label, limit.value, limit.value});
  if (std::any_of(y.begin(), y.end(), [](double value) { return value < 0; }))
    panel.bands.push_back({"", -limit.value, -limit.value});
}

CamPeak peak_of(const std::vector<CamPoint>& points, const DrawnCurve& drawn) {
  CamPeak peak{drawn.title, drawn.quantity};
  for (const auto& point : points) {
    const double value = point.*drawn.number * drawn.quantity.scale;
    if (std::abs(value) <= std::abs(peak.value)) continue;
    peak.value = value;
    peak.master = point.master;
  }
  return peak;
}

}  // namespace

void CamQuantity::limit(std::string name, std::optional<double> value, std::string found,
                        std::string instead) {
  if (value) limits.push_back({std::move(name), *value, std::move(found), std::move(instead)});
}

void draw_zones(renders::Plot& plot, const std::vector<CamZone>& zones) {
  constexpr std::size_t most = 1000;
  for (std::size_t i = 0; i < std::min(zones.size(), most); ++i) {
    const CamZone& zone = zones[i];
    plot.zones.push_back({zone.from, zone.to, zone.synchronous});
    plot.marks.push_back({zone.from, zone.name});
  }
}

CamDrawing motion_plot(const CamCourse& course, const std::vector<CamZone>& zones, const CamMotionWords& how,
                       const std::string& name) {
  CamDrawing drawing;
  renders::Plot& plot = drawing.plot;
  plot.name = name;
  plot.title = how.title;
  plot.x_label = fmt::format("master [{}]", how.master_position.empty() ? how.position : how.master_position);
  plot.width = 1600;
  plot.panel_height = 240;
  auto points = sample_cam(course, true);
  for (auto& point : points) {
    point.master /= how.per_unit;
    point.position /= how.per_unit;
  }
  plot.panels = {panel_of(points, {"slave position", &CamPoint::position, {how.position}})};
  std::vector<DrawnCurve> rates = {{"velocity", &CamPoint::velocity, how.velocity},
                                   {"acceleration", &CamPoint::acceleration, how.acceleration},
                                   {"jerk, between the steps of acceleration", &CamPoint::jerk, how.jerk}};
  // Straight pieces have no acceleration between their ends, and no end to it at them.
  if (how.straight) rates.resize(1);
  for (const auto& rate : rates) {
    auto& panel = plot.panels.emplace_back(panel_of(points, rate));
    for (const auto& limit : rate.quantity.limits) draw_limit(panel, limit, rate.quantity.unit);
    drawing.peaks.push_back(peak_of(points, rate));
  }
  if (how.played) {
    plot.panels[1].curves.front().label = "law";
    // Behind the law, which it follows closely.
    plot.panels[1].curves.insert(plot.panels[1].curves.begin(), *how.played);
  }
  std::vector<CamZone> repeated;
  for (int loop = 0; loop < course.loops; ++loop)
    for (const auto& zone : zones)
      repeated.push_back({(loop * course.law.master_length + zone.from) / how.per_unit,
                          (loop * course.law.master_length + zone.to) / how.per_unit, zone.name,
                          zone.synchronous});
  draw_zones(plot, repeated);
  if (course.master_speed)
    plot.second_x = renders::SecondScale{"time [s]", 1 / (*course.master_speed / how.per_unit)};
  return drawing;
}

}  // namespace drycut::sim::cams
