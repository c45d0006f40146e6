#include "sim/cams/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "sim/cams/motion_plot.hpp"
#include "sim/cams/report.hpp"

namespace drycut::sim::cams {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double length_of(const IdealCam& ideal, std::size_t cycle) {
  return ideal.cycles[cycle + 1] - ideal.cycles[cycle];
}

/// True if the samples reach both ends of the cycle, as near as they are taken.
bool is_whole(const loop::PlayedCam& played, const IdealCam& ideal, const PlayedCycle& part) {
  constexpr double share = 0.02;
  const auto& samples = played.samples;
  double low = samples[part.first].master;
  double high = low;
  double gap = 0;
  for (std::size_t i = part.first + 1; i <= part.last; ++i) {
    low = std::min(low, samples[i].master);
    high = std::max(high, samples[i].master);
    gap = std::max(gap, std::abs(samples[i].master - samples[i - 1].master));
  }
  const double near = std::max(share * length_of(ideal, part.cycle), gap);
  return low <= ideal.cycles[part.cycle] + near && high >= ideal.cycles[part.cycle + 1] - near;
}

/// A difference of positions that are known but for whole turns.
double shortest(double way, double turn) { return turn > 0 ? way - turn * std::round(way / turn) : way; }

/// What is drawn of one cycle: positions in the cycle, in the shown unit.
class CycleCurves {
 public:
  CycleCurves(const loop::PlayedCam& played, const IdealCam& ideal, const PlayedCycle& cycle)
      : played_(played), ideal_(ideal), cycle_(cycle) {}

  [[nodiscard]] double x(std::size_t sample) const {
    return (played_.samples[sample].master - ideal_.cycles[cycle_.cycle]) * ideal_.shown;
  }
  /// The slave's way in the cycle.
  [[nodiscard]] double y(double slave) const { return (slave - ideal_.origins[cycle_.cycle]) * ideal_.shown; }

  [[nodiscard]] renders::Curve ideal() const {
    constexpr int points = 1000;
    renders::Curve curve{"ideal", {}, {}};
    const double begin = ideal_.cycles[cycle_.cycle];
    const double length = length_of(ideal_, cycle_.cycle);
    for (int i = 0; i < points; ++i) {
      const double way = length * i / points;
      curve.x.push_back(way * ideal_.shown);
      curve.y.push_back(y(ideal_.slave(begin + way)));
    }
    return curve;
  }

  /// Where errors in the error unit put the slave beside the ideal.
  [[nodiscard]] renders::Curve beside_ideal(const std::string& label, const std::vector<double>& set,
                                            const std::vector<double>* behind) const {
    renders::Curve curve{label, {}, {}};
    for (std::size_t i = cycle_.first; i <= cycle_.last; ++i) {
      const double error = set[i] - (behind == nullptr ? 0 : (*behind)[i]);
      curve.x.push_back(x(i));
      curve.y.push_back(y(ideal_.slave(played_.samples[i].master) + error / ideal_.error_scale));
    }
    return in_order(std::move(curve));
  }

  [[nodiscard]] renders::Curve of(const std::vector<double>& errors, const std::string& label) const {
    renders::Curve curve{label, {}, {}};
    for (std::size_t i = cycle_.first; i <= cycle_.last; ++i) {
      curve.x.push_back(x(i));
      curve.y.push_back(errors[i]);
    }
    return in_order(std::move(curve));
  }

  /// A master may stand, tremble or run backwards: the reader wants to see the cam from left to right.
  static renders::Curve in_order(renders::Curve curve) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < curve.x.size(); ++i) points.emplace_back(curve.x[i], curve.y[i]);
    std::stable_sort(points.begin(), points.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < points.size(); ++i) std::tie(curve.x[i], curve.y[i]) = points[i];
    return curve;
  }

 private:
  const loop::PlayedCam& played_;
  const IdealCam& ideal_;
  const PlayedCycle& cycle_;
};

/// Errors of all other cycles that are as long as the shown one, as pale dots; no points if there are none.
renders::Curve other_cycles(const loop::PlayedCam& played, const IdealCam& ideal,
                            const std::vector<PlayedCycle>& cycles, const PlayedCycle& shown,
                            const std::vector<double>& errors) {
  constexpr double same = 1e-6;
  constexpr std::size_t most = 200;  // of the last ones
  renders::Curve pale{"", {}, {}, renders::Curve::Style::points, true};
  std::size_t count = 0;
  for (auto cycle = cycles.rbegin(); cycle != cycles.rend() && count < most; ++cycle) {
    const double length = length_of(ideal, shown.cycle);
    if (!cycle->whole || cycle->first == shown.first) continue;
    if (std::abs(length_of(ideal, cycle->cycle) - length) > same * length) continue;
    ++count;
    const auto one = CycleCurves(played, ideal, *cycle).of(errors, "");
    pale.x.insert(pale.x.end(), one.x.begin(), one.x.end());
    pale.y.insert(pale.y.end(), one.y.begin(), one.y.end());
  }
  pale.label = counted(count, "other cycle");
  return CycleCurves::in_order(std::move(pale));
}

/// "0.00005", however small.
std::string in_decimals(double number) {
  auto text = fmt::format("{:.9f}", number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// Less than half of what the device can count is nothing.
bool is_nothing(const ErrorFigures& figures, const IdealCam& ideal) {
  return figures.largest < ideal.error_step / 2;
}

/// Adds the panel of an error; of one that is nothing in all cycles its name to `silent`: a flat line tells
/// no more.
void add_error_panel(renders::Plot& plot, const std::string& what, const IdealCam& ideal, renders::Curve pale,
                     renders::Curve shown, std::string& silent) {
  const auto figures = figures_of(shown.y);
  if (is_nothing(figures, ideal) && is_nothing(figures_of(pale.y), ideal)) {
    silent += fmt::format("; {} below {} {}", what, in_decimals(ideal.error_step / 2), ideal.error_unit);
    return;
  }
  renders::Panel panel;
  panel.title = fmt::format("{}: {} {} at most in this cycle", what,
                            error_text(figures.largest, ideal.error_step), ideal.error_unit);
  panel.y_label = fmt::format("[{}]", ideal.error_unit);
  if (!pale.x.empty()) panel.curves.push_back(std::move(pale));
  panel.curves.push_back(std::move(shown));
  plot.panels.push_back(std::move(panel));
}

}  // namespace

CamErrors errors_of(const loop::PlayedCam& played, const IdealCam& ideal) {
  CamErrors errors;
  for (const auto& sample : played.samples) {
    const double set = sample.set - (ideal.slave ? ideal.slave(sample.master) : nothing);
    errors.set.push_back(shortest(set, sample.turn) * ideal.error_scale);
    errors.behind.push_back(sample.behind * ideal.error_scale);
  }
  return errors;
}

std::vector<PlayedCycle> cycles_of(const loop::PlayedCam& played, const IdealCam& ideal) {
  std::vector<PlayedCycle> cycles;
  if (!ideal.runs()) return cycles;
  const auto& samples = played.samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto next = std::upper_bound(ideal.cycles.begin(), ideal.cycles.end(), samples[i].master);
    // The very end belongs to the last cycle.
    const bool inside = next != ideal.cycles.begin() &&
                        (next != ideal.cycles.end() || samples[i].master == ideal.cycles.back());
    if (!inside) continue;
    const auto place = static_cast<std::size_t>(next - ideal.cycles.begin()) - 1;
    const auto cycle = std::min(place, ideal.cycles.size() - 2);
    const bool goes_on =
        !cycles.empty() && cycles.back().cycle == cycle && cycles.back().last + 1 == i && !samples[i].begins;
    if (goes_on)
      cycles.back().last = i;
    else
      cycles.push_back({cycle, i, i, false});
  }
  for (auto& cycle : cycles) cycle.whole = is_whole(played, ideal, cycle);
  return cycles;
}

const PlayedCycle* shown_cycle(const std::vector<PlayedCycle>& cycles) {
  const auto whole =
      std::find_if(cycles.rbegin(), cycles.rend(), [](const auto& cycle) { return cycle.whole; });
  if (whole != cycles.rend()) return &*whole;
  const auto longest = std::max_element(cycles.begin(), cycles.end(), [](const auto& a, const auto& b) {
    return a.last - a.first < b.last - b.first;
  });
  return longest == cycles.end() ? nullptr : &*longest;
}

ErrorFigures figures_of(const std::vector<double>& errors) {
  ErrorFigures figures;
  double squares = 0;
  for (const double error : errors) {
    if (!std::isfinite(error)) continue;
    ++figures.count;
    figures.largest = std::max(figures.largest, std::abs(error));
    squares += error * error;
  }
  if (figures.count > 0) figures.rms = std::sqrt(squares / static_cast<double>(figures.count));
  return figures;
}

std::string error_text(double error, double step) {
  const double least = 1e-3 * step;
  return error > 0 && error < least ? "below " + in_decimals(least) : number_text(error, 4);
}

renders::Plot overlay_plot(const loop::PlayedCam& played, const IdealCam& ideal, const CamErrors& errors,
                           const std::vector<PlayedCycle>& cycles, const PlayedCycle& shown,
                           const std::string& name) {
  const CycleCurves curves(played, ideal, shown);
  const bool measured = figures_of(errors.behind).count > 0;
  renders::Plot plot;
  plot.name = name;
  plot.title =
      fmt::format("{}: {} from {:.3f} s to {:.3f} s", played.axis,
                  shown.whole ? "the last whole cycle of the cam, played" : "a part of the cam, played",
                  seconds(played.samples[shown.first].time), seconds(played.samples[shown.last].time));
  plot.x_label = fmt::format("master in the cycle [{}]", ideal.master_unit);
  plot.width = 1600;
  plot.panel_height = 240;

  renders::Panel position;
  position.title = "slave position";
  position.y_label = fmt::format("[{}]", ideal.slave_unit);
  position.curves = {curves.ideal(), curves.beside_ideal("set", errors.set, nullptr)};
  if (measured) position.curves.push_back(curves.beside_ideal("measured", errors.set, &errors.behind));
  plot.panels.push_back(std::move(position));

  const auto pale = [&](const std::vector<double>& of) {
    return other_cycles(played, ideal, cycles, shown, of);
  };
  std::string silent;
  add_error_panel(plot, "set minus ideal position", ideal, pale(errors.set),
                  curves.of(errors.set, "this cycle"), silent);
  if (measured)
    add_error_panel(plot, "following error, set minus measured position", ideal, pale(errors.behind),
                    curves.of(errors.behind, "this cycle"), silent);
  plot.panels.front().title += silent;

  const double begin = ideal.cycles[shown.cycle];
  const double end = ideal.cycles[shown.cycle + 1];
  std::vector<CamZone> zones;
  for (const auto& zone : ideal.zones)
    if (zone.from >= begin && zone.from < end)
      zones.push_back({(zone.from - begin) * ideal.shown, (std::min(zone.to, end) - begin) * ideal.shown,
                       zone.name, zone.synchronous});
  draw_zones(plot, zones);
  return plot;
}

}  // namespace drycut::sim::cams
