// Histograms of event values and the operating points of motors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/units.hpp"
#include "renders/decimate.hpp"
#include "sim/loop/bindings.hpp"
#include "sim/loop/statistics.hpp"
#include "sim/report/drives.hpp"
#include "sim/report/gallery_plots.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::report {

namespace {

// ---- histogram ----

/// The next of 1, 2, 5 times a power of ten.
double round_width(double width) {
  const double decade = std::pow(10, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (width <= factor * decade * (1 + 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

/// Bars of equal width around multiples of it, so that a round number lies inside a bar and not between two.
renders::Curve bars_of(const std::vector<double>& numbers, double low, double high) {
  constexpr int wanted = 40;
  const double size = std::max(std::abs(low), std::abs(high));
  const double width = round_width(std::max((high - low) / wanted, std::max(size, 1e-9) * 1e-9));
  const auto bar = [&](double number) { return std::llround(number / width); };
  std::map<long long, int> counts;
  for (const double number : numbers) ++counts[bar(number)];
  renders::Curve curve;
  curve.style = renders::Curve::Style::area;
  for (auto k = bar(low); k <= bar(high); ++k) {
    const auto found = counts.find(k);
    const double count = found == counts.end() ? 0 : found->second;
    const double left = (static_cast<double>(k) - 0.5) * width;
    curve.x.insert(curve.x.end(), {left, left, left + width, left + width});
    curve.y.insert(curve.y.end(), {0, count, count, 0});
  }
  return curve;
}

std::string capability_text(double value) { return value > 100 ? "above 100" : fmt::format("{:.2f}", value); }

std::string statistics_text(const loop::EventNumbers& series,
                            const std::optional<std::pair<double, double>>& limits) {
  const auto figures = loop::statistics(series.numbers);
  const auto [mean, least, greatest, sd, slope, slope_error] = figures;
  const auto unit = series.unit.empty() ? "" : " " + series.unit;
  auto text = fmt::format("{} values, mean {:.7g}{}, from {:.7g} to {:.7g}, standard deviation {:.3g}{}",
                          series.numbers.size(), mean, unit, least, greatest, sd, unit);
  if (!limits) return text;
  const bool beyond = least < limits->first || greatest > limits->second;
  if (series.numbers.size() < 2) return text + ", too few for a Cpk";
  const auto found = loop::capability(figures, limits->first, limits->second);
  if (!found) return text + (beyond ? ", beyond a limit" : ", no spread");
  return text + fmt::format(", Cp {}, Cpk {}", capability_text(found->cp), capability_text(found->cpk));
}

}  // namespace

void draw_histogram(const record::Recording& recording, const scenario::PlotRequest& request,
                    renders::Plot& plot) {
  const auto& panel = request.panels.front();
  const auto series = event_numbers(recording.events(), panel.event.text, panel.values.front().text, request);
  renders::Panel shown;
  shown.y_label = panel.event.text + " events";
  shown.title = panel.title;
  plot.x_label = axis_label(panel.values.front().text, {series.unit});
  if (!series.numbers.empty()) {
    auto [low, high] = std::minmax_element(series.numbers.begin(), series.numbers.end());
    double from = *low;
    double until = *high;
    if (panel.limits) {
      from = std::min(from, panel.limits->first);
      until = std::max(until, panel.limits->second);
      plot.marks.push_back({panel.limits->first, fmt::format("{:g}", panel.limits->first), true});
      plot.marks.push_back({panel.limits->second, fmt::format("{:g}", panel.limits->second), true});
    }
    plot.marks.push_back({loop::statistics(series.numbers)[0], "mean"});
    std::stable_sort(plot.marks.begin(), plot.marks.end(),
                     [](const auto& a, const auto& b) { return a.x < b.x; });
    shown.curves.push_back(bars_of(series.numbers, from, until));
    const auto& counts = shown.curves.front().y;
    shown.y_range = {0, 1.08 * *std::max_element(counts.begin(), counts.end())};
    shown.title += (shown.title.empty() ? "" : ": ") + statistics_text(series, panel.limits);
  }
  plot.panel_height = 360;
  plot.panels.push_back(std::move(shown));
}

void draw_motor(const MachineFacts& machine, const record::Recording& recording,
                const scenario::PlotRequest& request, renders::Plot& plot) {
  const auto& panel = request.panels.front();
  const auto names = loop::motor_channels(panel.motor.text);
  const auto& speed = *recording.column(names[0]);
  const auto& torque = *recording.column(names[1]);
  const auto& drive = *drive_of(machine.drives, panel.motor.text);
  const auto& ratings = drive.ratings;
  const double rpm = scenario::to_si(1, speed.unit) * units::rpm;
  const double newton_metres = scenario::to_si(1, torque.unit);

  double squares = 0;
  double largest_torque = 0;
  double largest_speed = 0;
  const auto rows = rows_between(recording, request.from, request.until);
  for (auto row = rows.first; row < rows.end; ++row) {
    squares += torque.values[row] * torque.values[row];
    largest_torque = std::max(largest_torque, std::abs(torque.values[row]));
    largest_speed = std::max(largest_speed, std::abs(speed.values[row]));
  }
  largest_torque *= newton_metres;
  largest_speed *= rpm;
  renders::Cloud cloud(rows.count(), {-largest_speed, largest_speed, -largest_torque, largest_torque}, false);
  for (auto row = rows.first; row < rows.end; ++row)
    cloud.add(speed.values[row] * rpm, torque.values[row] * newton_metres);
  auto kept = cloud.take();
  renders::Curve points;
  points.x = std::move(kept.x);
  points.y = std::move(kept.y);
  const double rms =
      rows.count() == 0 ? 0 : newton_metres * std::sqrt(squares / static_cast<double>(rows.count()));
  const auto title = fmt::format(
      "{}{}rms {:.3g} N m ({:.0f} % of rated), largest {:.3g} N m ({:.0f} % of peak), "
      "up to {:.4g} rpm ({:.0f} % of max_speed)",
      panel.title, panel.title.empty() ? "" : ": ", rms, 100 * rms / ratings.rated_torque, largest_torque,
      100 * largest_torque / ratings.peak_torque, largest_speed,
      100 * largest_speed / (ratings.max_speed * units::rpm));
  draw_torque_over_speed(drive, std::move(points), title, plot);
}

}  // namespace drycut::sim::report
