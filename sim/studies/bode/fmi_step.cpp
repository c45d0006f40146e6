#include "sim/studies/bode/fmi_step.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

std::optional<double> fmi_step_of(const std::string& text) {
  const auto given = scenario::parse_quantity(text);
  if (!given || given->unit.empty() || !scenario::same_dimension(given->unit, "s")) return {};
  const double step = scenario::to_si(given->number, given->unit);
  return step > 0 && step <= 1 ? std::optional(step) : std::nullopt;
}

Margins margins_behind(std::vector<BodePoint> points, double dead_time) {
  for (auto& point : points)
    point.open_loop *= std::polar(1.0, -2 * std::numbers::pi * point.frequency * dead_time);
  return margins_of(points);
}

std::string fmi_step_text(const LoopResult& result, double step) {
  const auto phase = result.known_phase();
  if (!phase || phase->value <= 0) return "";
  // A dead time leaves the crossover where it is; the phase of what was measured would be read a turn too
  // high.
  constexpr double turn = 360;
  const double left = phase->value - turn * phase->frequency * step;
  if (left <= 0)
    return fmt::format(
        "unstable behind an FMI step of {:g} ms: {:.1f} deg are lost of a phase margin of {:.2f} deg at {}; "
        "it swings from {:.3g} ms on\n",
        step * 1e3, phase->value - left, phase->value, hertz_text(phase->frequency),
        phase->value / turn / phase->frequency * 1e3);
  auto behind = margins_behind(result.sweep.points, step);
  behind.phase = AtFrequency{phase->frequency, left};
  std::string text;
  const auto line = [&](const char* margin, const std::optional<AtFrequency>& value, const char* unit) {
    text += value ? fmt::format("{} behind an FMI step of {:g} ms: {:.2f} {} at {}\n", margin, step * 1e3,
                                value->value, unit, hertz_text(value->frequency))
                  : fmt::format("{} behind an FMI step of {:g} ms: not between these frequencies\n", margin,
                                step * 1e3);
  };
  line("phase margin", behind.phase, "deg");
  line("gain margin", behind.gain, "dB");
  text += fmt::format("a tenth of the phase margin goes with a step of {:.3g} ms\n",
                      phase->value / 10 / turn / phase->frequency * 1e3);
  return text;
}

}  // namespace drycut::sim::studies
