#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/fit/replay.hpp"
#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {

namespace {

using Kind = ReplaySeries::Kind;

/// Channels of a plant that tell its motion, the ones nearest to the motor first.
struct MotionChannel {
  std::string_view name;
  Kind kind;
  bool of_load;
};
constexpr std::array motion_channels = {MotionChannel{"motor.position", Kind::position, false},
                                        MotionChannel{"motor.speed", Kind::speed, false},
                                        MotionChannel{"angle.total", Kind::position, true},
                                        MotionChannel{"position", Kind::position, true},
                                        MotionChannel{"angle", Kind::wrapped, true},
                                        MotionChannel{"speed", Kind::speed, true}};
constexpr std::string_view encoder = "encoder.count";

const recordings::Series* find(const recordings::Recording& recording, const std::string& channel) {
  const auto found = std::ranges::find(recording.series, channel, &recordings::Series::channel);
  return found == recording.series.end() ? nullptr : &*found;
}

/// The series in another unit of its dimension.
recordings::Series in_unit(recordings::Series series, const std::string& unit) {
  for (double& value : series.value) value = scenario::from_si(scenario::to_si(value, series.unit), unit);
  series.unit = unit;
  return series;
}

/// A series that goes round in 360 degrees, without its jumps.
void unwrap(recordings::Series& series) {
  constexpr double turn = 360;
  double turns = 0;
  for (std::size_t i = 1; i < series.value.size(); ++i) {
    const double jump = series.value[i] + turns - series.value[i - 1];
    turns -= turn * std::nearbyint(jump / turn);
    series.value[i] += turns;
  }
}

/// Whether what goes back is less than a fiftieth of what goes forwards, or the other way round.
bool is_one_way(const recordings::Series& motion) {
  constexpr double little = 0.02;
  double forwards = 0;
  double backwards = 0;
  for (std::size_t i = 1; i < motion.value.size(); ++i) {
    const double moved = motion.value[i] - motion.value[i - 1];
    (moved > 0 ? forwards : backwards) += std::abs(moved);
  }
  return std::min(forwards, backwards) < little * std::max(forwards, backwards);
}

/// Counts of an encoder on the motor as what its speed would add up to.
std::optional<recordings::Series> as_motion_of_motor(scenario::Scenario& scenario, const std::string& plant,
                                                     recordings::Series counts) {
  const auto entry = std::ranges::find(scenario.plants, plant, [](const auto& one) { return one.name.text; });
  int lines = 0;
  bool reversed = false;
  for (const auto& row : entry->definition->parameters()) {
    if (row.name == "encoder.lines") lines = *std::get<int*>(row.value);
    if (row.name == "encoder.reverse") reversed = *std::get<bool*>(row.value);
    if (row.name.starts_with("encoder.on_") && *std::get<bool*>(row.value)) return {};
  }
  if (lines <= 0) return {};
  constexpr double counted = 4;
  for (double& value : counts.value) value *= (reversed ? -1 : 1) * seconds_a_minute / (counted * lines);
  return counts;
}

/// Each recording is replayed with its own inputs.
void refuse_without_inputs(const recordings::Recording& recording, const std::filesystem::path& file,
                           const scenario::Scenario& scenario, Problems& problems) {
  for (const auto& input : scenario.inputs)
    if (find(recording, input.channel.text) == nullptr)
      problems.push_back({"fit.no-channel"_code, file.string(), 1, 1,
                          fmt::format("it has no channel {}, which {} takes in {}", input.channel.text,
                                      input.name.text, scenario.file.string()),
                          "each recording needs what drives the line"});
}

/// Distance of the motion that is followed over that of recorded speeds, by their common times.
std::optional<double> counts_over_speed(const recordings::Series& counts, recordings::Series speed,
                                        const std::string& unit) {
  if (speed.time_s.size() < 2 || counts.time_s.size() < 2) return {};
  speed = in_unit(std::move(speed), unit);
  const double step = sampling_of(speed);
  const double from = std::max(counts.time_s.front(), speed.time_s.front());
  const double until = std::min(counts.time_s.back(), speed.time_s.back());
  if (!(until > from)) return {};
  const auto count = static_cast<std::size_t>((until - from) / step);
  const auto places = resampled(counts, from, step, count);
  const auto speeds = resampled(speed, from, step, count);
  // Least squares over the speeds: noise of counts is in no denominator.
  double both = 0;
  double square = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const double mean = (speeds[i] + speeds[i - 1]) / 2;
    both += (places[i] - places[i - 1]) / step * mean;
    square += mean * mean;
  }
  return square > 0 ? std::optional(both / square) : std::nullopt;
}

bool is_input(const scenario::Scenario& scenario, const std::string& channel) {
  return std::ranges::any_of(scenario.inputs,
                             [&](const auto& input) { return input.channel.text == channel; });
}

}  // namespace

bool ReplaySeries::is_effort(std::size_t input) const {
  const auto& unit = inputs[input].unit;
  return scenario::same_dimension(unit, "N") || scenario::same_dimension(unit, "N m");
}

std::optional<ReplaySeries> replay_series(const recordings::Recording& recording,
                                          const std::filesystem::path& file, const FitQuestion& question,
                                          scenario::Scenario& scenario, Problems& problems) {
  const auto& plant = question.plant;
  ReplaySeries made;
  made.plant = plant;
  made.file = file;
  const auto* torque = find(recording, plant + ".motor.torque");
  if (torque == nullptr) {
    problems.push_back({"fit.no-torque"_code, file.string(), 1, 1,
                        fmt::format("it has no channel {}.motor.torque", plant),
                        "the measured torque of the motor, or its current times the torque constant"});
    return {};
  }
  made.torque = in_unit(*torque, "N m");
  if (question.closed) refuse_without_inputs(recording, file, scenario, problems);
  const auto machine = machine_of(scenario, question.closed);
  const auto unit_of = [&](const std::string& channel) -> std::optional<std::string> {
    const auto reading = machine->names().reading(channel);
    return reading ? std::optional(reading->unit) : std::nullopt;
  };
  const auto take_motion = [&](const recordings::Series& series, const std::string& channel, Kind kind) {
    made.motion = series;
    made.channel = channel;
    made.kind = kind;
  };
  if (!unit_of(torque->channel)) {
    problems.push_back({"fit.no-servo"_code, "--vary", 1, 1,
                        fmt::format("{} has no {}", scenario.file.string(), torque->channel),
                        "a plant with a motor whose torque is simulated"});
    return {};
  }
  bool found = false;
  if (const auto* counts = find(recording, plant + "." + std::string(encoder)))
    if (auto motion = as_motion_of_motor(scenario, plant, *counts)) {
      take_motion(*motion, plant + ".motor.speed", Kind::speed);
      found = true;
    }
  const bool counted = found;
  if (const auto* speed = find(recording, plant + ".motor.speed"); counted && speed != nullptr)
    made.counts_over_speed = counts_over_speed(made.motion, *speed, *unit_of(speed->channel));
  for (const auto& one : motion_channels) {
    const auto channel = plant + "." + std::string(one.name);
    const auto* series = find(recording, channel);
    const auto unit = unit_of(channel);
    if (series == nullptr || !unit) continue;
    auto own = in_unit(*series, *unit);
    if (one.kind == Kind::wrapped) unwrap(own);
    if (one.kind != Kind::speed && !made.start) made.start = scenario::to_si(own.value.front(), *unit);
    if (!found) {
      made.summed = one.kind == Kind::speed;
      if (made.summed) {
        // Followed by what it adds up to.
        double sum = 0;
        double before = own.value.front();
        for (std::size_t i = 0; i < own.value.size(); ++i) {
          const double now = own.value[i];
          if (i > 0) sum += (now + before) / 2 * (own.time_s[i] - own.time_s[i - 1]);
          before = now;
          own.value[i] = sum;
        }
      }
      take_motion(own, channel, one.kind);
      found = true;
    } else if (one.of_load && one.kind != Kind::speed && !made.load &&
               (counted || made.channel.find(".motor.") != std::string::npos)) {
      made.load = own;
      made.load_kind = one.kind;
    }
  }
  if (!found) {
    problems.push_back({"fit.no-motion"_code, file.string(), 1, 1,
                        fmt::format("it has no motion of {0}: none of {0}.encoder.count, motor.position, "
                                    "motor.speed, angle.total, position, angle, speed",
                                    plant),
                        "the position of the motor"});
    return {};
  }
  for (const auto& series : recording.series) {
    if (series.channel == torque->channel || series.channel == made.channel ||
        (made.load && series.channel == made.load->channel) || (counted && series.channel.ends_with(encoder)))
      continue;
    if (question.closed && is_input(scenario, series.channel)) continue;
    if (!question.closed && machine->names().target(series.channel))
      made.inputs.push_back(in_unit(series, scenario::si_unit(series.unit)));
    else
      made.unused.push_back(series.channel);
  }
  made.from =
      question.closed ? recording.begin() : std::max(made.torque.time_s.front(), made.motion.time_s.front());
  made.until = std::min(made.torque.time_s.back(), made.motion.time_s.back());
  made.sampling = std::max(sampling_of(made.torque), sampling_of(made.motion));
  made.one_way = is_one_way(made.motion);
  return made;
}

}  // namespace drycut::sim::studies
