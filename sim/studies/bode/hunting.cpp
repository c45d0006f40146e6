#include "sim/studies/bode/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "plants/plant.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/bode/twins.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double finest = 1e-9;     // far below a step of the DAC [V]
constexpr double least_own = 0.02;  // less than that an axis at rest may move by itself [V]
constexpr double dac_end = devices::dac_full_scale_volts;

/// A stretch of the controller's output.
struct Stretch {
  double low = 0;
  double high = 0;
  int crossings = 0;  ///< of its middle

  explicit Stretch(std::span<const double> volts) {
    const auto [least, most] = std::minmax_element(volts.begin(), volts.end());
    low = *least;
    high = *most;
    int side = 0;
    for (const double v : volts) {
      if (std::abs(v - (low + high) / 2) < swing() / 8) continue;
      const int now = v > (low + high) / 2 ? 1 : -1;
      if (side == -now) ++crossings;
      side = now;
    }
  }
  [[nodiscard]] double swing() const { return high - low; }
};

/// The loop with its gain taken `factor` times.
class Pushed {
 public:
  Pushed(loop::Simulation& excited, loop::Simulation& still, std::size_t wire, Time sampling, double period)
      : twins_(excited, still, wire, ""), sampling_(sampling) {
    constexpr double unknown_period = 0.08;  // [s]
    constexpr double periods = 12;
    const double of_one = period > 0 ? period : unknown_period;
    push_ = std::max<Time>(static_cast<Time>(of_one / 4 * 1e9) / sampling, 1) * sampling;
    window_ = static_cast<Time>(std::clamp(periods * of_one, 0.6, 10.0) * 1e9) / sampling * sampling;
  }

  void wait(Time at) { twins_.wait_for_sampling(at, sampling_); }
  [[nodiscard]] std::string failure() const {
    return own_high_ - own_low_ > std::max(rest(), least_own)
               ? "the axis moves meanwhile; measure while it stands (--at), or with timeline: []"
               : twins_.failure();
  }

  /// What the machine does undisturbed: an even oscillation of its own is hunting, any other motion hides
  /// what pushes do.
  enum class Own { rests, hunts, moves };
  Own own() {
    output_.clear();
    own_.clear();
    run(window_, 1, 0);
    const std::span<const double> all = own_;
    const auto third = all.size() / 3;
    if (third < 4) return Own::moves;
    const Stretch first(all.first(third));
    const Stretch last(all.last(third));
    if (Stretch(all).swing() <= std::max(rest(), least_own)) return Own::rests;
    const bool even = last.crossings >= 4 && std::abs(last.swing() - first.swing()) < 0.1 * last.swing();
    if (even) note(last, third, 1);
    return even ? Own::hunts : Own::moves;
  }

  /// True if the loop hunts behind a push of `volts`.
  bool hunts_after(double volts, double factor) {
    run(push_, factor, volts);
    return goes_on(factor);
  }
  /// True if what swings now keeps itself up.
  bool goes_on(double factor) {
    constexpr int most_windows = 8;
    for (int i = 0; i < most_windows && failure().empty(); ++i) {
      output_.clear();
      own_.clear();
      run(window_, factor, 0);
      const std::span<const double> all = output_;
      const auto third = all.size() / 3;
      if (third < 4) return false;
      const Stretch first(all.first(third));
      const Stretch last(all.last(third));
      if (last.swing() <= rest()) return false;
      if (last.crossings < 4) continue;
      note(last, third, factor);
      if (last.swing() > 0.95 * first.swing()) return true;
    }
    return false;
  }

  double frequency = 0;  ///< of what went on [Hz]
  double amplitude = 0;  ///< [V]

 private:
  void note(const Stretch& swings, std::size_t samples, double factor) {
    frequency = swings.crossings / 2.0 / (static_cast<double>(samples) * seconds(sampling_));
    amplitude = factor * swings.swing() / 2;
  }
  /// Bits that toggle are rest: of so few their size alone keeps an oscillation up.
  [[nodiscard]] double rest() const {
    constexpr double most = 0.02;  // a swing from limit to limit knows no smaller step [V]
    constexpr double bits = 12;
    return bits * std::min(quantum_, most);
  }
  void run(Time span, double factor, double push) {
    const Time end = twins_.time() + span;
    while (twins_.time() < end) {
      // As a DAC would put out that much more, to its end. What is added comes a step later than the output
      // that it follows: the next step makes good for it, so that over a sampling it is as much as it should
      // be.
      const double own = twins_.own();
      const double more =
          std::clamp(own + factor * twins_.output(), -dac_end, dac_end) - own - twins_.output();
      const double late = more - std::exchange(more_, more);
      if (!twins_.advance(more + late + push)) return;
      if (twins_.time() % sampling_ != 0) continue;
      const double volts = twins_.output();
      learn(output_, volts);
      learn(own_, own);
      own_low_ = std::min(own_low_, own);
      own_high_ = std::max(own_high_, own);
      own_.push_back(own);
      output_.push_back(volts);
    }
  }

  void learn(const std::vector<double>& before, double volts) {
    const double change = before.empty() ? 0 : std::abs(volts - before.back());
    if (change > finest) quantum_ = std::min(quantum_, change);
  }

  Twins twins_;
  Time sampling_;
  Time push_ = 0;
  Time window_ = 0;
  double more_ = 0;       ///< added in the step before, what came late left out [V]
  double own_low_ = 1e9;  ///< of the undisturbed output [V]
  double own_high_ = -1e9;
  double quantum_ = 1;  ///< smallest change of the output that was seen [V]
  std::vector<double> output_;
  std::vector<double> own_;
};

bool is_play(const std::string& name) {
  return name == "gap" || name.ends_with("backlash") || name.ends_with("breakaway");
}

}  // namespace

HuntingPoint find_hunting(loop::Simulation& excited, loop::Simulation& still, std::size_t wire, Time at,
                          Time sampling, double period) {
  constexpr double up = 1.25;
  constexpr double down = 1.02;
  constexpr double most = 100;
  constexpr double least = 0.2;
  HuntingPoint found;
  Pushed loop(excited, still, wire, sampling, period);
  loop.wait(at);
  const auto own = loop.own();
  if (own == Pushed::Own::hunts) return {1, 0, loop.frequency, loop.amplitude, ""};
  if (found.failure = loop.failure(); !found.failure.empty()) return found;
  double factor = 1;
  const auto pushed = [&] {
    for (double volts = least_push; volts <= largest_push; volts *= 2)
      if (loop.hunts_after(volts, factor)) return true;
    return false;
  };
  for (; factor < most; factor *= up) {
    const bool hunts = pushed();
    if (found.failure = loop.failure(); !found.failure.empty()) return found;
    if (hunts) break;
    found.tried = factor;
  }
  if (factor >= most) return found;
  do {
    found.from = factor;
    found.frequency = loop.frequency;
    found.amplitude = loop.amplitude;
    factor /= down;
  } while (factor > least && loop.goes_on(factor));
  found.failure = loop.failure();
  return found;
}

std::string play_of(const scenario::Scenario& scenario, const std::string& plug) {
  std::string text;
  for (const auto& plant : scenario.plants) {
    if (!plug.starts_with(plant.name.text + ".")) continue;
    for (const auto& row : plant.definition->parameters()) {
      const auto* value = std::get_if<double*>(&row.value);
      if (value == nullptr || !is_play(row.name) || !(**value > 0)) continue;
      text += fmt::format("{}{}.{} {}", text.empty() ? "" : ", ", plant.name.text, row.name,
                          scenario::format_quantity(**value, row.unit));
    }
  }
  return text;
}

}  // namespace drycut::sim::studies
