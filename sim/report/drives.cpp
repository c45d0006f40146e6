#include "sim/report/drives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"

namespace drycut::sim::report {

namespace {

std::string grade_text(const loop::DriveFigure& figure) {
  const auto* word = !figure.judged       ? "not judged,"
                     : figure.share > 1   ? "FAIL"
                     : figure.share > 0.9 ? "close,"
                                          : "PASS";
  return fmt::format("{} {:.0f} %", word, 100 * figure.share);
}

renders::Curve points_of(const std::vector<std::pair<double, double>>& points, std::string label) {
  renders::Curve curve;
  curve.label = std::move(label);
  curve.style = renders::Curve::Style::points;
  curve.x.reserve(points.size());
  curve.y.reserve(points.size());
  for (const auto& [speed, torque] : points) {
    curve.x.push_back(speed * units::rpm);
    curve.y.push_back(torque);
  }
  return curve;
}

}  // namespace

renders::Curve peak_curve(const plants::DriveRatings& ratings, bool both_ways, double speed_unit,
                          double torque_unit) {
  // The law has its corners at rated and at largest speed and is straight between them.
  std::vector<double> corners = {0, ratings.rated_speed, ratings.max_speed};
  if (both_ways) corners.insert(corners.begin(), {-ratings.max_speed, -ratings.rated_speed});
  renders::Curve curve;
  curve.label = "peak torque";
  const auto add = [&](double speed, double torque) {
    curve.x.push_back(speed / speed_unit);
    curve.y.push_back(torque / torque_unit);
  };
  for (const double speed : corners) add(speed, speed > 0 ? ratings.peak(speed) : ratings.peak_torque);
  std::reverse(corners.begin(), corners.end());
  for (const double speed : corners) add(speed, speed < 0 ? -ratings.peak(speed) : -ratings.peak_torque);
  if (both_ways) add(corners.back(), ratings.peak_torque);
  return curve;
}

renders::Curve continuous_curve(const plants::DriveRatings& ratings, bool both_ways, double speed_unit,
                                double torque_unit) {
  std::vector<double> corners = {0, ratings.rated_speed};
  if (both_ways) corners.insert(corners.begin(), -ratings.rated_speed);
  renders::Curve curve;
  curve.label = "continuous torque (S1)";
  const auto add = [&](double speed, double sign) {
    curve.x.push_back(speed / speed_unit);
    curve.y.push_back(sign * ratings.continuous(speed) / torque_unit);
  };
  for (const double speed : corners) add(speed, 1);
  std::reverse(corners.begin(), corners.end());
  for (const double speed : corners) add(speed, -1);
  if (both_ways) add(corners.back(), 1);
  return curve;
}

renders::ReportTable drive_table(const std::vector<loop::DriveVerdict>& verdicts) {
  renders::ReportTable table{
      "Drives and their ratings", {"drive", "", "is", "may be", "used"}, {}, false, true};
  for (const auto& verdict : verdicts) {
    auto name = verdict.drive + "\n" + verdict.cycles;
    for (const auto& figure : verdict.figures) {
      table.rows.push_back({{name, figure.name, fmt::format("{:.4g} {}", figure.value, figure.unit),
                             fmt::format("{:.4g} {}", figure.rating, figure.unit), grade_text(figure)}});
      name.clear();
    }
    table.rows.push_back(
        {{"", "load over rotor inertia", fmt::format("{:.3g}", verdict.inertia_ratio), "", ""}});
    table.rows.push_back(
        {{"", "energy a cycle, from the mains", fmt::format("{:.4g} J", verdict.energy), "", ""}});
    if (!verdict.trips.empty())
      table.rows.push_back(
          {{"", "trips", fmt::format("{}", fmt::join(verdict.trips, ", ")), "none", "FAIL"}});
    if (verdict.advised < 1 && !verdict.holds())
      table.rows.push_back({{"", "within 90 % of all",
                             fmt::format("at {:.0f} % of this speed\nby a cautious estimate",
                                         std::floor(100 * verdict.advised)),
                             "", ""}});
  }
  return table;
}

std::vector<renders::Plot> drive_plots(const std::vector<loop::DriveVerdict>& verdicts) {
  std::vector<renders::Plot> plots;
  plots.reserve(verdicts.size());
  for (const auto& verdict : verdicts) {
    const bool both_ways = std::any_of(verdict.points.begin(), verdict.points.end(), [&](const auto& point) {
      return point.first < -0.02 * verdict.ratings.max_speed;
    });
    renders::Plot plot;
    plot.name = "drive_" + verdict.drive;
    std::replace(plot.name.begin(), plot.name.end(), '.', '_');
    plot.title = fmt::format("{}: torque over speed, {}", verdict.drive, verdict.cycles);
    plot.x_label = "motor speed [rpm]";
    plot.panel_height = 520;
    renders::Panel panel;
    panel.y_label = "motor torque [N m]";
    const auto& most = verdict.tightest();
    panel.title = fmt::format("{} {:.4g} of {:.4g} {}: {:.0f} %", most.name, most.value, most.rating,
                              most.unit, 100 * most.share);
    panel.curves.push_back(points_of(verdict.points, "operating points"));
    if (!verdict.cycle_points.empty())
      panel.curves.push_back(points_of(verdict.cycle_points, "rms of a cycle, at its mean speed"));
    panel.curves.push_back(peak_curve(verdict.ratings, both_ways, 1 / units::rpm));
    panel.curves.push_back(continuous_curve(verdict.ratings, both_ways, 1 / units::rpm));
    plot.panels.push_back(std::move(panel));
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace drycut::sim::report
