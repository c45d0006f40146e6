#include "sim/studies/fit/replay.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/units.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/studies/fit/machine.hpp"
#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {

namespace {

using Kind = ReplaySeries::Kind;

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
/// Of a motion that is to go one way the few moments that it goes back count as standing.
std::vector<bool> standstills(const std::vector<double>& motion, std::size_t group, double step,
                              double cutoff, bool one_way) {
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
    const bool back = one_way && speeds[i] * (motion.back() - motion.front()) < 0;
    if (std::abs(speeds[i]) > slow * fastest && speeds[i] * speeds[i - 1] >= 0 && !back) continue;
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

}  // namespace

Plausible measure_answer(const scenario::Scenario& scenario, const ReplaySeries& series) {
  double largest = 0;
  for (const double value : series.torque.value) largest = std::max(largest, std::abs(value));
  if (largest <= 0) throw std::runtime_error("the recorded torque is 0 throughout");
  // Two torques, both far above friction; what the speeds differ by is the inertia's.
  constexpr double until = 0.03;
  const double h = seconds(scenario.scene.step);
  double first = 0;
  double speeds = 0;
  double halfway = 0;  // what the speeds differ by there
  double moved = 0;
  double turned = 0;
  for (const double times : {3.0, 6.0}) {
    const auto machine = machine_of(scenario, false);
    const auto speed = machine->names().reading(series.plant + ".motor.speed")->read;
    Followed channel(*machine, series.channel, series.kind);
    machine->names().target(test_torque(series))->write(times * largest);
    const double begin = channel.now(h);
    double angle = 0;
    double end = begin;
    bool is_past = false;
    while (seconds(machine->time()) < until && machine->advance()) {
      angle += speed() / units::rpm * h;
      end = channel.now(h);
      if (is_past || seconds(machine->time()) < until / 2) continue;
      is_past = true;
      halfway = speed() / units::rpm - halfway;
    }
    first = std::exchange(speeds, speed() / units::rpm - speeds);
    moved = end - begin - moved;
    turned = angle - turned;
  }
  // What grows with speed makes it look larger with time.
  const double apparent = 3 * largest * until / speeds;
  const double inertia = 2 * (3 * largest * until / 2 / halfway) - apparent;
  return {inertia, moved / turned, 3 * largest - apparent * first / until};
}

std::optional<Replayed> replay(const scenario::Scenario& scenario, const ReplaySeries& series,
                               const ReplaySetup& setup, const ReplayErrors& errors) {
  const auto machine = machine_of(scenario, setup.closed);
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
    inputs.emplace_back(straight(one, series.from, h, steps), *machine->names().target(one.channel));
  for (std::size_t i = 0; i < errors.shares.size(); ++i)
    for (double& value : inputs[i].first) value *= errors.shares[i];
  const auto give =
      setup.closed ? std::function<void(double)>() : machine->names().target(test_torque(series))->write;
  const auto motor_speed = machine->names().reading(series.plant + ".motor.speed")->read;
  const auto motor_torque = machine->names().reading(series.plant + ".motor.torque")->read;

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
    double left = gain * (omega * omega * error + 2 * omega * rate);
    for (const auto& [values, target] : inputs) target.write(values[k]);
    if (!setup.closed) give(torque[k] + left);
    sums.speed += motor_speed();
    sums.position += series.kind == Kind::speed ? now / seconds_a_minute : now;
    if (load_now) sums.load += load_now->now(h) - load[k];
    if (!machine->advance()) return {};
    if (setup.closed) left = motor_torque() - torque[k];
    if (!std::isfinite(left)) return {};
    sums.left += left;
    sums.torque += torque[k];
    if ((k + 1) % group != 0) continue;
    const auto count = static_cast<double>(group);
    found.torque_left.push_back(sums.left / count);
    if (load_now) found.load_left.push_back(sums.load / count);
    found.torque.push_back(sums.torque / count);
    found.speed.push_back(sums.speed / count);
    found.position.push_back(sums.position / count);
    sums = {};
  }

  // Smooth, and no more values than the cutoff asks for; none of the end, and none of the beginning: the
  // machine is at rest there, the recording may not be. Of that 1e-5 is left.
  const double settled = 14 / omega + reach_of(setup.cutoff);
  const auto skip = static_cast<std::size_t>(std::ceil(settled / found.step));
  const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(0.25 / setup.cutoff / found.step));
  const auto all = found.torque_left.size();
  std::vector<std::size_t> chosen;
  const auto near = setup.standstill ? std::vector<bool>(all)
                                     : standstills(motion, group, found.step, setup.cutoff, series.one_way);
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
