#include "sim/studies/bode/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "sim/studies/bode/twins.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double nothing = 1e-9;      // far below a step of the DAC [V]
constexpr double output_limit = 9.9;  // from here on an output stands at its end [V]

/// What a push left behind, in thirds of the samples: whether the loop came to rest, swings on, runs away, or
/// cannot be told yet.
Sweep::Loop judge_push(std::span<const double> output) {
  if (output.size() < 3) return Sweep::Loop::restless;
  struct Third {
    double low, high;
    [[nodiscard]] double swing() const { return high - low; }
  };
  const auto third = [&](std::size_t i) {
    const auto part = output.subspan(i * output.size() / 3, output.size() / 3);
    const auto [low, high] = std::minmax_element(part.begin(), part.end());
    return Third{*low, *high};
  };
  double quantum = 0.02;  // at most [V]: a swing from limit to limit knows no smaller step
  for (std::size_t k = 1; k < output.size(); ++k) {
    const double change = std::abs(output[k] - output[k - 1]);
    if (change > nothing) quantum = std::min(quantum, change);
  }
  const auto first = third(0);
  const auto last = third(2);
  if (last.low > output_limit || last.high < -output_limit) return Sweep::Loop::runaway;
  // A rest offset in play, and the last bit that toggles, are rest.
  const bool rests = !(last.swing() > 2.5 * quantum);
  if (rests || last.swing() < 0.9 * first.swing()) return Sweep::Loop::closed;
  constexpr int enough = 4;  // two periods in the last third
  const double middle = (last.low + last.high) / 2;
  int crossings = 0;
  int side = 0;
  for (const double volts : output.subspan(2 * output.size() / 3)) {
    if (std::abs(volts - middle) < last.swing() / 8) continue;
    const int now = volts > middle ? 1 : -1;
    if (side == -now) ++crossings;
    side = now;
  }
  return crossings >= enough ? Sweep::Loop::unstable : Sweep::Loop::restless;
}

/// Pushes the drive for a moment and looks whether the loop comes to rest; `waited` tells for how long [s].
Sweep::Loop push(Twins& twins, const SweepPlan& plan, double& waited) {
  constexpr int push_samples = 10;
  const Time start = twins.time();
  while (twins.time() < start + push_samples * plan.sampling)
    if (!twins.advance(plan.amplitude)) return Sweep::Loop::closed;
  // A loop of low gain takes its time: twice as long, as long as it cannot be told.
  constexpr int most_windows = 8;
  const auto window = static_cast<Time>(std::max(plan.settle, 1.0) * 1e9);
  std::vector<double> output;
  double own_low = 0;
  double own_high = 0;
  const Time begin = twins.time();
  for (int windows = 1;; windows *= 2) {
    while (twins.time() < begin + windows * window) {
      if (!twins.advance(0)) return Sweep::Loop::closed;
      own_low = std::min(own_low, twins.own());
      own_high = std::max(own_high, twins.own());
      if ((twins.time() - begin) % plan.sampling == 0) output.push_back(twins.output());
    }
    waited = seconds(windows * window);
    if (std::all_of(output.begin(), output.end(), [](double volts) { return volts == 0; })) {
      // A loop that swings from limit to limit takes no notice of a push.
      return own_low < -output_limit && own_high > output_limit ? Sweep::Loop::unstable : Sweep::Loop::open;
    }
    const auto judged = judge_push(output);
    if (judged != Sweep::Loop::restless || windows == most_windows) return judged;
  }
}

/// Comes to rest with the tone, then measures it over its samples. False if the simulation failed.
bool measure_tone(Twins& twins, const SweepPlan& plan, const TestTone& tone, BodePoint& point) {
  const std::int64_t steps = plan.sampling / plan.step;  // in a sampling
  const double period = static_cast<double>(tone.samples) / static_cast<double>(tone.cycles);
  const auto settle =
      static_cast<std::int64_t>(std::ceil(std::max(plan.settle / seconds(plan.sampling), 2 * period)));
  Correlator output(tone.cycles, tone.samples);
  Correlator total(tone.cycles, tone.samples);
  Correlator drive(tone.cycles, tone.samples * steps);
  Correlator speed(tone.cycles, tone.samples * steps);
  double last = 0;  // output [V]
  // The tone's phase counts on from the settling, whose length is of no account then.
  const std::int64_t lead = tone.samples - settle % tone.samples;
  for (std::int64_t k = 0; k < settle + tone.samples; ++k) {
    const double volts = plan.amplitude * cosine_at(tone.cycles, tone.samples, lead + k);
    for (std::int64_t i = 0; i < steps; ++i) {
      if (!twins.advance(volts)) return false;
      if (k < settle) continue;
      if (i == 0) {
        output.add(twins.output());
        total.add(twins.total());
        const double change = std::abs(twins.output() - last);
        last = twins.output();
        if (k > settle && change > nothing && (point.quantum == 0 || change < point.quantum))
          point.quantum = change;
        point.saturated = point.saturated || twins.saturated();
      }
      if (!twins.has_speed()) continue;
      drive.add(twins.plug());
      speed.add(twins.speed());
    }
  }
  point.frequency = tone.frequency(plan.sampling);
  point.silent = point.quantum == 0;
  point.open_loop = -output.tone() / total.tone();
  point.error = std::hypot(output.error(), total.error());
  if (twins.has_speed()) point.speed = speed.tone() / drive.tone();
  return true;
}

/// Takes the highest points away where the answer has sunk below the resolution of count and DAC. A loop that
/// falls silent all at once, as in play, keeps them.
void drop_faded(const SweepPlan& plan, Sweep& sweep) {
  auto& points = sweep.points;
  auto last = points.size();
  while (last > 0 && points[last - 1].silent) --last;
  if (last == 0 || last == points.size()) return;
  constexpr double near_resolution = 5;
  const auto& heard = points[last - 1];
  if (std::abs(heard.open_loop) * plan.amplitude > near_resolution * heard.quantum) return;
  sweep.faded_from = points[last].frequency;
  points.resize(last);
}

/// Octave by octave down to where the loop has gain.
void measure_below(Twins& twins, const SweepPlan& plan, std::vector<BodePoint>& points) {
  while (!points.empty() && std::abs(points.front().open_loop) <= 1) {
    const double wanted = points.front().frequency / 2;
    if (wanted < plan.lowest) return;
    BodePoint point;
    if (!measure_tone(twins, plan, plan_tones(wanted, wanted, 1, plan.sampling, 0).front(), point)) return;
    points.insert(points.begin(), point);
  }
}

}  // namespace

std::vector<TestTone> plan_tones(double from, double to, int points, Time sampling, double window) {
  constexpr double least_periods = 4;
  const double rate = 1 / seconds(sampling);
  std::vector<TestTone> tones;
  for (int i = 0; i < points; ++i) {
    const double share = points > 1 ? static_cast<double>(i) / (points - 1) : 0;
    const double wanted = from * std::pow(to / from, share);
    TestTone tone;
    tone.cycles = std::llround(std::ceil(std::max(least_periods, wanted * window)));
    tone.samples = std::max<std::int64_t>(std::llround(static_cast<double>(tone.cycles) * rate / wanted),
                                          2 * tone.cycles);
    // Samples that fall on ever new phases average the rounding of counts and DAC: no common factor.
    if (tone.samples > 2 * tone.cycles)
      while (std::gcd(tone.cycles, tone.samples) > 1) ++tone.samples;
    const bool same = !tones.empty() && tone.frequency(sampling) <= tones.back().frequency(sampling);
    if (!same) tones.push_back(tone);
  }
  return tones;
}

Sweep measure(loop::Simulation& excited, loop::Simulation& still, const SweepPlan& plan,
              const std::function<void(double)>& progress) {
  Sweep sweep;
  Twins twins(excited, still, plan.wire, plan.speed);
  twins.wait_for_sampling(plan.at, plan.sampling);
  if (twins.failure().empty()) sweep.loop = push(twins, plan, sweep.waited);
  twins.wait_for_sampling(0, plan.sampling);
  sweep.failure = twins.failure();
  if (!sweep.failure.empty() || sweep.loop != Sweep::Loop::closed) return sweep;
  for (const auto& tone : plan.tones) {
    BodePoint point;
    if (!measure_tone(twins, plan, tone, point)) break;
    sweep.points.push_back(point);
    if (progress) progress(static_cast<double>(sweep.points.size()) / static_cast<double>(plan.tones.size()));
  }
  drop_faded(plan, sweep);
  if (plan.lowest > 0) measure_below(twins, plan, sweep.points);
  sweep.failure = twins.failure();
  return sweep;
}

}  // namespace drycut::sim::studies
