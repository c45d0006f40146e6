#include "sim/report/drives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"

namespace drycut::sim::report {

namespace {

std::string grade_text(const record::DriveFigure& figure, bool judged) {
  const auto* word = !figure.judged || !judged ? (figure.share > 1 ? "over, not judged," : "not judged,")
                     : figure.share > 1        ? "FAIL"
                     : figure.share > 0.9      ? "close,"
                                               : "PASS";
  return fmt::format("{} {:.0f} %", word, 100 * figure.share);
}

/// Kept together in a narrow cell by spaces that do not break.
std::string number_text(double number, std::string unit) {
  constexpr auto* no_break = "\u00a0";
  for (auto at = unit.find(' '); at != std::string::npos; at = unit.find(' ', at + 2))
    unit.replace(at, 1, no_break);
  return fmt::format("{:.4g}{}{}", number, no_break, unit);
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

// The law has its corners at rated and at largest speed and is straight between them.
renders::Curve peak_curve(const plants::DriveRatings& ratings, bool both_ways) {
  std::vector<double> corners = {0, ratings.rated_speed, ratings.max_speed};
  if (both_ways) corners.insert(corners.begin(), {-ratings.max_speed, -ratings.rated_speed});
  renders::Curve curve;
  curve.label = ratings.works_at_limit ? "pull-out torque" : "peak torque";
  const auto add = [&](double speed, double torque) {
    curve.x.push_back(speed * units::rpm);
    curve.y.push_back(torque);
  };
  for (const double speed : corners) add(speed, speed > 0 ? ratings.peak(speed) : ratings.peak_torque);
  std::reverse(corners.begin(), corners.end());
  for (const double speed : corners) add(speed, speed < 0 ? -ratings.peak(speed) : -ratings.peak_torque);
  if (both_ways) add(corners.back(), ratings.peak_torque);
  return curve;
}

renders::Curve continuous_curve(const plants::DriveRatings& ratings, bool both_ways) {
  std::vector<double> corners = {0, ratings.rated_speed};
  if (both_ways) corners.insert(corners.begin(), -ratings.rated_speed);
  renders::Curve curve;
  curve.label = "continuous torque (S1)";
  const auto add = [&](double speed, double sign) {
    curve.x.push_back(speed * units::rpm);
    curve.y.push_back(sign * ratings.continuous(speed));
  };
  for (const double speed : corners) add(speed, 1);
  std::reverse(corners.begin(), corners.end());
  for (const double speed : corners) add(speed, -1);
  if (both_ways) add(corners.back(), 1);
  return curve;
}

void draw_torque_over_speed(const record::DriveVerdict& drive, renders::Curve points,
                            const std::string& title, renders::Plot& plot) {
  const double backwards = -0.02 * drive.ratings.max_speed * units::rpm;
  const bool both_ways =
      std::any_of(points.x.begin(), points.x.end(), [&](double speed) { return speed < backwards; });
  plot.x_label = "motor speed [rpm]";
  plot.panel_height = 520;
  renders::Panel panel;
  panel.title = title;
  panel.y_label = "motor torque [N m]";
  points.label = "operating points";
  points.style = renders::Curve::Style::points;
  panel.curves.push_back(std::move(points));
  if (!drive.cycle_points.empty())
    panel.curves.push_back(points_of(drive.cycle_points, "rms of a cycle, at its mean speed"));
  panel.curves.push_back(peak_curve(drive.ratings, both_ways));
  panel.curves.push_back(continuous_curve(drive.ratings, both_ways));
  plot.panels.push_back(std::move(panel));
}

renders::ReportTable drive_table(const std::vector<record::DriveVerdict>& verdicts, bool judged) {
  renders::ReportTable table{
      "Drives and their ratings", {"drive", "", "value", "limit", "used"}, {}, false, true};
  for (const auto& verdict : verdicts) {
    auto name = fmt::format("{}\n{}{}", verdict.drive, verdict.cycles,
                            judged ? "" : "; judging is off (drives: judge)");
    for (const auto& figure : verdict.figures) {
      table.rows.push_back({{name,
                             fmt::format("{}\n{}{}{}", figure.name, figure.window,
                                         figure.remark.empty() ? "" : "; ", figure.remark),
                             number_text(figure.value, figure.unit), number_text(figure.rating, figure.unit),
                             grade_text(figure, judged)}});
      name.clear();
    }
    table.rows.push_back({{"", "load over rotor inertia\nas the scenario begins",
                           fmt::format("{:.3g}", verdict.inertia_ratio), "", ""}});
    table.rows.push_back(
        {{"",
          fmt::format("efficiency from motor to load{}",
                      verdict.efficiency < 1 ? "" : "\nno losses of gear or screw are counted"),
          fmt::format("{:.3g}", verdict.efficiency), "", ""}});
    if (!verdict.ratings.works_at_limit) {
      const bool even = verdict.cogging <= 0 && verdict.torque_ripple <= 0;
      table.rows.push_back(
          {{"",
            fmt::format("cogging; ripple of the torque\n{}",
                        even ? "none is counted" : "amplitudes, not in the motor's rms torque"),
            fmt::format("{}; {:.3g} %", number_text(verdict.cogging, "N m"), 100 * verdict.torque_ripple), "",
            ""}});
    }
    const auto of = verdict.energy_cycles == 0   ? std::string("whole run")
                    : verdict.energy_cycles == 1 ? "the one cycle"
                                                 : fmt::format("mean of {} cycles", verdict.energy_cycles);
    table.rows.push_back(
        {{"", fmt::format("energy from the mains\n{}", of), number_text(verdict.energy, "J"), "", ""}});
    if (!verdict.trips.empty())
      table.rows.push_back({{"", "trips", fmt::format("{}", fmt::join(verdict.trips, ", ")), "none",
                             judged ? "FAIL" : "not judged"}});
    if (!verdict.limit_elsewhere.empty())
      table.rows.push_back(
          {{"", "at the torque limit\noutside of these cycles", verdict.limit_elsewhere, "", ""}});
    if (judged && verdict.advised < 1 && std::floor(100 * verdict.advised) > 0 &&
        verdict.tightest().share > 1)
      table.rows.push_back({{"", "within 90 % of all",
                             fmt::format("at {:.0f} % of this speed\nby a cautious estimate",
                                         std::floor(100 * verdict.advised)),
                             "", ""}});
  }
  return table;
}

const record::DriveVerdict* drive_of(const std::vector<record::DriveVerdict>& verdicts,
                                     const std::string& plant) {
  const auto found = std::find_if(verdicts.begin(), verdicts.end(), [&](const auto& verdict) {
    return verdict.drive.starts_with(plant + ".");
  });
  return found == verdicts.end() ? nullptr : &*found;
}

std::vector<renders::Plot> drive_plots(const std::vector<record::DriveVerdict>& verdicts,
                                       const std::vector<scenario::PlotRequest>& requests) {
  std::vector<renders::Plot> plots;
  plots.reserve(verdicts.size());
  for (const auto& verdict : verdicts) {
    const bool asked_for = std::any_of(requests.begin(), requests.end(), [&](const auto& request) {
      return std::any_of(request.panels.begin(), request.panels.end(), [&](const auto& panel) {
        return !panel.motor.text.empty() && drive_of(verdicts, panel.motor.text) == &verdict;
      });
    });
    if (asked_for) continue;
    renders::Plot plot;
    plot.name = "drive_" + verdict.drive;
    std::replace(plot.name.begin(), plot.name.end(), '.', '_');
    plot.title = fmt::format("{}: torque over speed, {}", verdict.drive, verdict.cycles);
    const auto& most = verdict.tightest();
    draw_torque_over_speed(verdict, points_of(verdict.points, ""),
                           fmt::format("{} {:.4g} of {:.4g} {}: {:.0f} %", most.name, most.value, most.rating,
                                       most.unit, 100 * most.share),
                           plot);
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace drycut::sim::report
