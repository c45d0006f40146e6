#include "sim/studies/fit/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/units.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/bode/loop.hpp"
#include "sim/studies/fit/machine.hpp"
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
constexpr double seconds_a_minute = 60;

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

/// Whether what goes back is less than a hundredth of what goes forwards, or the other way round.
bool is_one_way(const recordings::Series& motion) {
  constexpr double little = 0.01;
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

std::vector<double> step_times(double from, double step, std::size_t count) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = from + static_cast<double>(i) * step;
  return times;
}

/// A channel of the running machine without jumps, its speeds added up.
class Followed {
 public:
  Followed(loop::Simulation& simulation, const std::string& channel, Kind kind)
      : read_(simulation.names().reading(channel)->read), kind_(kind) {}

  /// Its value now, `h` seconds after the last time.
  double now(double h) {
    const double value = read_();
    if (kind_ == Kind::position) return value;
    if (kind_ == Kind::speed) return sum_ += value * h;
    if (begun_) sum_ += std::remainder(value - before_, 360.0);
    if (!begun_) sum_ = value;
    begun_ = true;
    before_ = value;
    return sum_;
  }

 private:
  std::function<double()> read_;
  Kind kind_;
  bool begun_ = false;
  double before_ = 0;
  double sum_ = 0;
};

/// Where the recorded motion stands or turns, and as far as the filter takes that: a value a group of steps.
std::vector<bool> standstills(const std::vector<double>& motion, std::size_t group, double step,
                              double cutoff) {
  constexpr double slow = 0.02;
  std::vector<double> places;
  for (std::size_t i = group - 1; i < motion.size(); i += group) places.push_back(motion[i]);
  places = smoothed(places, step, cutoff);
  std::vector<double> speeds(places.size());
  double fastest = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    speeds[i] = places[i] - places[i - 1];
    fastest = std::max(fastest, std::abs(speeds[i]));
  }
  std::vector<bool> near(places.size());
  const auto reach = static_cast<std::size_t>(std::ceil(reach_of(cutoff) / step));
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (std::abs(speeds[i]) > slow * fastest && speeds[i] * speeds[i - 1] >= 0) continue;
    for (std::size_t j = i > reach ? i - reach : 0; j < std::min(i + reach, near.size()); ++j) near[j] = true;
  }
  return near;
}

/// Where a sample is missing, as far as the filter takes that.
std::vector<bool> near_clipped(const ReplaySeries& series, std::size_t count, double step, double cutoff) {
  std::vector<bool> near(count);
  const double reach = reach_of(cutoff) + series.sampling;
  for (const auto* one : {&series.torque, &series.motion})
    for (const auto sample : one->clipped) {
      const double at = one->time_s[sample] - series.from;
      const double first = std::max(0.0, (at - reach) / step);
      const double last = std::min(static_cast<double>(count), (at + reach) / step);
      for (auto i = static_cast<std::size_t>(first); static_cast<double>(i) < last; ++i) near[i] = true;
    }
  return near;
}

std::string test_torque(const ReplaySeries& series) { return series.plant + ".servo.test_torque"; }

std::unique_ptr<loop::Simulation> machine_of(const scenario::Scenario& scenario) {
  Problems problems;
  auto simulation = std::make_unique<loop::Simulation>(scenario, problems);
  if (!problems.empty()) throw std::runtime_error(problems.front().what);
  simulation->keep_nothing();
  disarm(*simulation);
  return simulation;
}

}  // namespace

std::optional<ReplaySeries> replay_series(const recordings::Recording& recording,
                                          const std::filesystem::path& file, const std::string& plant,
                                          scenario::Scenario& scenario, Problems& problems) {
  ReplaySeries made;
  made.plant = plant;
  made.name = file.filename().string();
  const auto* torque = find(recording, plant + ".motor.torque");
  if (torque == nullptr) {
    problems.push_back({"fit.no-torque"_code, file.string(), 1, 1,
                        fmt::format("it has no channel {}.motor.torque", plant),
                        "the measured torque of the motor, or its current times the torque constant"});
    return {};
  }
  made.torque = in_unit(*torque, "N m");
  const auto machine = machine_of(scenario);
  const auto unit_of = [&](const std::string& channel) -> std::optional<std::string> {
    const auto reading = machine->names().reading(channel);
    return reading ? std::optional(reading->unit) : std::nullopt;
  };
  const auto take_motion = [&](const recordings::Series& series, const std::string& channel, Kind kind) {
    made.motion = series;
    made.channel = channel;
    made.kind = kind;
  };
  bool found = false;
  if (const auto* counts = find(recording, plant + "." + std::string(encoder)))
    if (auto motion = as_motion_of_motor(scenario, plant, *counts)) {
      take_motion(*motion, plant + ".motor.speed", Kind::speed);
      found = true;
    }
  const bool counted = found;
  for (const auto& one : motion_channels) {
    const auto channel = plant + "." + std::string(one.name);
    const auto* series = find(recording, channel);
    const auto unit = unit_of(channel);
    if (series == nullptr || !unit) continue;
    auto own = in_unit(*series, *unit);
    if (one.kind == Kind::wrapped) unwrap(own);
    if (one.kind != Kind::speed && !made.start) made.start = scenario::to_si(own.value.front(), *unit);
    if (!found) {
      if (one.kind == Kind::speed) {
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
    if (machine->names().target(series.channel))
      made.inputs.push_back(in_unit(series, scenario::si_unit(series.unit)));
    else
      made.unused.push_back(series.channel);
  }
  made.from = std::max(made.torque.time_s.front(), made.motion.time_s.front());
  made.until = std::min(made.torque.time_s.back(), made.motion.time_s.back());
  made.sampling = std::max(sampling_of(made.torque), sampling_of(made.motion));
  made.one_way = is_one_way(made.motion);
  return made;
}

Plausible measure_answer(const scenario::Scenario& scenario, const ReplaySeries& series) {
  double largest = 0;
  for (const double value : series.torque.value) largest = std::max(largest, std::abs(value));
  if (largest <= 0) throw std::runtime_error("the recorded torque is 0 throughout");
  // Two torques, both far above friction; what the speeds differ by is the inertia's.
  constexpr double until = 0.03;
  const double h = seconds(scenario.scene.step);
  double first = 0;
  double speeds = 0;
  double moved = 0;
  double turned = 0;
  for (const double times : {3.0, 6.0}) {
    const auto machine = machine_of(scenario);
    const auto speed = machine->names().reading(series.plant + ".motor.speed")->read;
    Followed channel(*machine, series.channel, series.kind);
    machine->names().target(test_torque(series))->write(times * largest);
    const double begin = channel.now(h);
    double angle = 0;
    double end = begin;
    while (seconds(machine->time()) < until && machine->advance()) {
      angle += speed() / units::rpm * h;
      end = channel.now(h);
    }
    first = std::exchange(speeds, speed() / units::rpm - speeds);
    moved = end - begin - moved;
    turned = angle - turned;
  }
  const double inertia = 3 * largest * until / speeds;
  return {inertia, moved / turned, 3 * largest - inertia * first / until};
}

std::optional<Replayed> replay(const scenario::Scenario& scenario, const ReplaySeries& series,
                               const ReplaySetup& setup, const ReplayErrors& errors) {
  const auto machine = machine_of(scenario);
  const double h = seconds(scenario.scene.step);
  const auto steps = static_cast<std::size_t>((series.until - series.from) / h);
  // A step takes speed and then place: places are those of half a step later, and torques are between.
  auto torque = resampled(series.torque, series.from + errors.torque_delay, h, steps);
  for (double& value : torque) value = errors.torque_scale * value - errors.torque_offset;
  const auto motion = resampled(series.motion, series.from, h, steps);
  std::vector<double> load;
  std::optional<Followed> load_now;
  if (series.load) {
    load = resampled(*series.load, series.from + errors.load_delay, h, steps);
    load_now.emplace(*machine, series.load->channel, series.load_kind);
  }
  std::vector<std::pair<std::vector<double>, devices::ControllerValue>> inputs;
  for (const auto& one : series.inputs)
    inputs.emplace_back(resampled(one, series.from, h, steps), *machine->names().target(one.channel));
  const auto give = machine->names().target(test_torque(series))->write;
  const auto motor_speed = machine->names().reading(series.plant + ".motor.speed")->read;

  constexpr double faster = 2;
  constexpr double most_a_step = 0.2;
  const double omega = std::min(2 * std::numbers::pi * faster * setup.cutoff, most_a_step / h);
  const double gain = setup.about.inertia / setup.about.scale;
  const auto group = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(series.sampling / h)));

  Replayed found;
  found.step = static_cast<double>(group) * h;
  found.position_unit = series.kind == Kind::speed ? "turns" : series.motion.unit;
  Followed followed(*machine, series.channel, series.kind);
  const double offset = motion.front() - followed.now(0);
  double error = 0;
  struct Sums {
    double left = 0, load = 0, torque = 0, speed = 0, position = 0;
  } sums;
  for (std::size_t k = 0; k < steps; ++k) {
    const double now = k == 0 ? motion.front() : followed.now(h) + offset;
    const double before = error;
    error = motion[k] - now;
    const double rate = k == 0 ? 0 : (error - before) / h;
    const double added = gain * (omega * omega * error + 2 * omega * rate);
    if (!std::isfinite(added)) return {};
    for (const auto& [values, target] : inputs) target.write(values[k]);
    give(torque[k] + added);
    sums.left += added;
    sums.torque += torque[k];
    sums.speed += motor_speed();
    sums.position += series.kind == Kind::speed ? now / seconds_a_minute : now;
    if (load_now) sums.load += load_now->now(h) - load[k];
    if (!machine->advance()) return {};
    if ((k + 1) % group != 0) continue;
    const auto count = static_cast<double>(group);
    found.torque_left.push_back(sums.left / count);
    if (load_now) found.load_left.push_back(sums.load / count);
    found.torque.push_back(sums.torque / count);
    found.speed.push_back(sums.speed / count);
    found.position.push_back(sums.position / count);
    sums = {};
  }

  // Smooth, and no more values than the cutoff asks for; none of the beginning and of the end.
  const double settled = 8 / omega + reach_of(setup.cutoff);
  const auto skip = static_cast<std::size_t>(std::ceil(settled / found.step));
  const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(0.25 / setup.cutoff / found.step));
  const auto all = found.torque_left.size();
  std::vector<std::size_t> chosen;
  const auto near =
      setup.standstill ? std::vector<bool>(all) : standstills(motion, group, found.step, setup.cutoff);
  const auto lost = near_clipped(series, all, found.step, setup.cutoff);
  for (std::size_t i = skip; i + skip < all; i += stride)
    if (!near[i] && !lost[i]) chosen.push_back(i);
  const auto thin = [&](std::vector<double>& values) {
    if (values.empty()) return;
    const auto smooth = smoothed(values, found.step, setup.cutoff);
    values.clear();
    for (const auto i : chosen) values.push_back(smooth[i]);
  };
  const auto times = step_times(series.from + found.step / 2, found.step, all);
  for (auto* values : {&found.torque_left, &found.load_left, &found.torque, &found.speed, &found.position})
    thin(*values);
  for (const auto i : chosen) found.times.push_back(times[i]);
  if (!found.load_left.empty()) {
    const double mean = std::accumulate(found.load_left.begin(), found.load_left.end(), 0.0) /
                        static_cast<double>(found.load_left.size());
    for (double& value : found.load_left) value -= mean;
  }
  found.step *= static_cast<double>(stride);
  return found;
}

}  // namespace drycut::sim::studies
