#pragma once
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "tests/sim/studies/fit/witness/hidden_axis.hpp"

namespace drycut::sim::studies {

using plants::witness::Leg;

/// A belt axis; the scenario has other values than the one that was recorded.
inline plants::LinearAxisData belt_axis() {
  plants::LinearAxisData data;
  data.mass = 37;
  data.lead = 0.1;
  data.start = 0;
  data.travel_min = -100;
  data.travel_max = 100;
  data.gear.stiffness = 5000;
  data.gear.damping = 1;
  data.guide_friction = {120, 80, 0, 0.01};
  data.drive.servo.inertia_ratio = 1;
  data.drive.servo.speed_gain = 60;
  return data;
}

/// Constant speeds both ways, and ramps between them.
inline std::vector<Leg> both_ways() {
  std::vector<Leg> legs;
  double until = 0;
  double now = 0;
  for (const double volts : {3.0, -3.0, 1.0, -1.0, 5.0, -5.0, 0.5, -0.5, 2.0, -4.0}) {
    until += 0.2;
    legs.push_back({until, now, volts});
    until += 0.4;
    legs.push_back({until, volts, volts});
    now = volts;
  }
  return legs;
}

/// The same speeds forwards only.
inline std::vector<Leg> one_way() {
  std::vector<Leg> legs;
  double until = 0;
  double now = 0;
  for (const double volts : {3.0, 1.0, 5.0, 2.0, 4.0, 0.5, 3.0, 1.0}) {
    until += 0.2;
    legs.push_back({until, now, volts});
    until += 0.4;
    legs.push_back({until, volts, volts});
    now = volts;
  }
  return legs;
}

/// Slow speeds both ways with a shake on top, up to a frequency of 20 Hz.
inline std::vector<Leg> shaken() {
  std::vector<Leg> legs;
  double until = 0;
  double now = 0;
  for (int i = 0; i < 150; ++i) {
    const double slow = i / 25 % 2 == 0 ? 1 : -1;
    const double volts = slow + (i % 2 == 0 ? 0.8 : -0.8);
    until += 0.025 + 0.001 * (i % 25);
    legs.push_back({until, now, volts});
    now = volts;
  }
  return legs;
}

/// The reference that a move follows [V].
inline double volts_at(const std::vector<Leg>& legs, double time) {
  double from = 0;
  for (const auto& leg : legs) {
    if (time <= leg.until) return leg.from + (leg.to - leg.from) * (time - from) / (leg.until - from);
    from = leg.until;
  }
  return legs.back().to;
}

/// What scenes/recordings/ holds: the axis as a drive's scope would export it, torque in % of 9.5 N m, a
/// second move for a cross test, and one that goes forwards only.
inline std::map<std::string, std::string> shipped_recordings() {
  constexpr double rated = 9.5;
  constexpr double percent = 100;
  const auto text_of = [&](const std::vector<Leg>& legs, std::uint64_t seed) {
    const auto recording = HiddenAxis(belt_axis(), legs).recorded({}, seed);
    const auto& torque = recording.series[0];
    const auto& counts = recording.series[1];
    std::string text = "Time;ActTorque;ActPosition;Reference\nms;%;inc;V\n";
    for (std::size_t i = 0; i < torque.value.size(); ++i)
      text +=
          fmt::format("{:.0f};{:.1f};{:.0f};{:.3f}\n", torque.time_s[i] * 1000,
                      torque.value[i] / rated * percent, counts.value[i], volts_at(legs, torque.time_s[i]));
    return text;
  };
  std::vector<Leg> other;
  double until = 0;
  double now = 0;
  for (const double volts : {1.5, -2.0, 4.0, -1.0, 0.0}) {
    until += 0.15;
    other.push_back({until, now, volts});
    until += 0.35;
    other.push_back({until, volts, volts});
    now = volts;
  }
  return {{"belt_axis_move.csv", text_of(both_ways(), 11)},
          {"belt_axis_one_way.csv", text_of(one_way(), 13)},
          {"belt_axis_other_move.csv", text_of(other, 12)}};
}

}  // namespace drycut::sim::studies
