#include "sim/bode/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/recorder.hpp"

namespace drycut::sim {

namespace {

/// A response over all points: gain [dB] and phase [deg].
struct Columns {
  std::vector<double> gain;
  std::vector<double> phase;
};

Columns columns_of(const std::vector<BodePoint>& points,
                   const std::function<std::complex<double>(const BodePoint&)>& response) {
  std::vector<std::complex<double>> values;
  Columns columns;
  for (const auto& point : points) {
    values.push_back(response(point));
    columns.gain.push_back(decibels(values.back()));
  }
  columns.phase = phases(values);
  return columns;
}

struct Table {
  Columns open;
  Columns closed;
  Columns sensitivity;
  Columns speed;  ///< empty if not measured
};

Table table_of(const BodeResult& result) {
  const auto& points = result.sweep.points;
  Table table;
  table.open = columns_of(points, [](const BodePoint& p) { return p.open_loop; });
  table.closed = columns_of(points, [](const BodePoint& p) { return p.closed_loop(); });
  table.sensitivity = columns_of(points, [](const BodePoint& p) { return p.sensitivity(); });
  if (!result.speed.empty()) table.speed = columns_of(points, [](const BodePoint& p) { return *p.speed; });
  return table;
}

std::string hertz(double frequency) { return fmt::format("{:.4g} Hz", frequency); }

std::string margins_text(const BodeResult& result) {
  const auto& margins = result.margins;
  const auto row = [](const char* name, const std::string& value) {
    return fmt::format("{:<24}{}\n", name, value);
  };
  const std::string absent = "not between these frequencies";
  std::string text;
  text +=
      row("phase margin", margins.phase ? fmt::format("{:.1f} deg at the crossover of {}",
                                                      margins.phase->value, hertz(margins.phase->frequency))
                                        : "no crossover between these frequencies");
  text +=
      row("gain margin", margins.gain ? fmt::format("{:.2f} dB at {}: unstable from {:.3g} times the gain on",
                                                    margins.gain->value, hertz(margins.gain->frequency),
                                                    std::pow(10, margins.gain->value / 20))
                                      : absent);
  if (margins.gain_down)
    text +=
        row("gain margin downwards",
            fmt::format("{:.2f} dB at {}: unstable below {:.3g} times the gain", margins.gain_down->value,
                        hertz(margins.gain_down->frequency), std::pow(10, margins.gain_down->value / 20)));
  if (margins.sensitivity)
    text += row("largest sensitivity", fmt::format("{:.2f} at {}", margins.sensitivity->value,
                                                   hertz(margins.sensitivity->frequency)));
  text += row("position loop -3 dB", margins.closed_bandwidth ? hertz(*margins.closed_bandwidth) : absent);
  if (!result.speed.empty())
    text += row("speed loop -3 dB", margins.speed_bandwidth ? hertz(*margins.speed_bandwidth) : absent);
  return text;
}

std::string table_text(const BodeResult& result) {
  const auto& points = result.sweep.points;
  const auto table = table_of(result);
  const bool speed = !result.speed.empty();
  std::string text = fmt::format("{:>10}{:>20}{:>20}{:>20}{:>9}\n{:>10}{:>20}{:>20}{:>20}{:>9}\n",
                                 "frequency", "open loop", "closed loop", speed ? result.speed : "", "error",
                                 "Hz", "dB    deg", "dB    deg", speed ? "dB    deg" : "", "%");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pair = [&](const Columns& columns) {
      // Of the speed only the change counts: it begins at 0 dB.
      const double zero = &columns == &table.speed ? columns.gain.front() : 0;
      return fmt::format("{:>12.2f}{:>8.1f}", columns.gain[i] - zero, columns.phase[i]);
    };
    text += fmt::format("{:>10.4g}{}{}{:>20}{:>9.2f}\n", points[i].frequency, pair(table.open),
                        pair(table.closed), speed ? pair(table.speed) : "", points[i].error * 100);
  }
  return text;
}

}  // namespace

std::vector<std::string> bode_doubts(const BodeResult& result) {
  std::vector<std::string> doubts;
  if (!result.sweep.failure.empty()) doubts.push_back("the simulation stopped: " + result.sweep.failure);
  if (result.sweep.loop == Sweep::Loop::open)
    doubts.push_back(
        fmt::format("{} does not answer: the loop is open at {} s; measure while the axis regulates "
                    "(--at), or with more --amplitude",
                    result.terminal, seconds_text(result.plan.at)));
  if (result.sweep.loop == Sweep::Loop::unstable)
    doubts.emplace_back("the loop is not stable: after a push it swings on; lower the gain");
  const auto tell = [&](const std::string& what, const auto& doubted) {
    int count = 0;
    const BodePoint* first = nullptr;
    for (const auto& point : result.sweep.points) {
      if (!doubted(point)) continue;
      if (first == nullptr) first = &point;
      ++count;
    }
    if (count == 0) return;
    doubts.push_back(fmt::format("at {} of {} frequencies, the first {}, {}", count,
                                 result.sweep.points.size(), hertz(first->frequency), what));
  };
  tell(result.terminal + " stood at its limit of 10 V: take less --amplitude",
       [](const BodePoint& point) { return point.saturated; });
  tell(fmt::format(
           "the answer is lost in what else moves (error above {:.0f} %): measure while the axis stands or "
           "runs evenly (--at), or with another --amplitude",
           bode_error_limit * 100),
       [](const BodePoint& point) { return !(point.doubt() <= bode_error_limit); });
  return doubts;
}

std::string bode_report(const BodeResult& result) {
  const auto& plan = result.plan;
  std::string text = fmt::format("{}: {} from {}, sampled every {} ms; a sine of {} V added from {} s on\n",
                                 result.scenario, result.wire, result.terminal, seconds(plan.sampling) * 1000,
                                 plan.amplitude, seconds_text(plan.at));
  if (!result.sweep.points.empty()) {
    text += '\n' + table_text(result) + '\n' + margins_text(result);
    text += fmt::format(
        "Gains and phases are those of the simulated loop, the delay of sampling and hold included.\n");
  }
  for (const auto& doubt : bode_doubts(result)) text += doubt + '\n';
  return text;
}

std::string bode_csv(const BodeResult& result) {
  const auto table = table_of(result);
  const bool speed = !result.speed.empty();
  std::string text =
      "frequency [Hz],open_loop.gain [dB],open_loop.phase [deg],closed_loop.gain [dB],closed_loop.phase "
      "[deg],"
      "sensitivity.gain [dB],error";
  if (speed) text += fmt::format(",{0}.gain [{1}/V],{0}.phase [deg]", result.speed, result.speed_unit);
  text += '\n';
  const auto& points = result.sweep.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    text +=
        fmt::format("{},{},{},{},{},{},{}", points[i].frequency, table.open.gain[i], table.open.phase[i],
                    table.closed.gain[i], table.closed.phase[i], table.sensitivity.gain[i], points[i].error);
    if (speed) text += fmt::format(",{},{}", std::abs(*points[i].speed), table.speed.phase[i]);
    text += '\n';
  }
  return text;
}

renders::Plot bode_plot(const BodeResult& result, const std::string& name) {
  const auto table = table_of(result);
  std::vector<double> x;
  for (const auto& point : result.sweep.points) x.push_back(point.frequency);
  renders::Plot plot;
  plot.name = name;
  plot.title = fmt::format("{}: {}", result.scenario, result.wire);
  plot.x_label = "frequency [Hz]";
  plot.log_x = true;
  plot.panel_height = 340;
  renders::Panel gain;
  gain.title = "gain";
  gain.y_label = "[dB]";
  gain.bands = {{"0 dB", 0, 0}};
  renders::Panel phase;
  phase.title = "phase";
  phase.y_label = "[deg]";
  phase.bands = {{"-180 deg", -180, -180}};
  const auto draw = [&](const std::string& label, const Columns& columns, double zero) {
    auto gains = columns.gain;
    for (double& value : gains) value -= zero;
    gain.curves.push_back({label, x, gains});
    phase.curves.push_back({label, x, columns.phase});
  };
  draw("open loop", table.open, 0);
  draw("position loop", table.closed, 0);
  if (!result.speed.empty()) draw("speed loop", table.speed, table.speed.gain.front());
  plot.panels = {gain, phase};
  const auto& margins = result.margins;
  if (margins.phase)
    plot.marks.push_back({margins.phase->frequency, fmt::format("margin {:.1f}°", margins.phase->value)});
  if (margins.gain)
    plot.marks.push_back({margins.gain->frequency, fmt::format("margin {:.1f} dB", margins.gain->value)});
  if (plot.marks.size() == 2 && plot.marks[0].x > plot.marks[1].x) std::swap(plot.marks[0], plot.marks[1]);
  return plot;
}

}  // namespace drycut::sim
