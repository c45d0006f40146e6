#include "sim/studies/bode/advice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlopt.hpp>
#include <numbers>
#include <utility>

namespace drycut::sim::studies {

namespace {

/// What a filter, and each further one, must gain: 1 dB.
constexpr double worth_having = 1.122;

plants::NotchData no_notch() { return {}; }

/// Of a closed loop at some factor of its gain.
struct Closed {
  double sensitivity = 0;  ///< largest
  double turned = 0;       ///< by which 1 + L turns from the first frequency to the last [rad]
  double left = 0;         ///< |L| at the last frequency
};

Closed closed(const std::vector<BodePoint>& points, double factor) {
  Closed loop;
  std::complex<double> before;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto now = 1.0 + factor * points[i].open_loop;
    loop.sensitivity = std::max(loop.sensitivity, 1 / std::abs(now));
    if (i > 0) loop.turned += std::arg(now / before);
    before = now;
  }
  if (!points.empty()) loop.left = factor * std::abs(points.back().open_loop);
  return loop;
}

/// The largest factor of gain, from the gain in force on, that keeps the sensitivity: it goes up from there,
/// or down to where it is kept. `turned`: as the loop turns that was measured, which is stable; one that
/// turns otherwise goes round -1 (Nyquist). What comes after the last frequency is not known: little may be
/// left there.
double most_gain(const std::vector<BodePoint>& points, double turned) {
  constexpr double step = 1.1;
  constexpr double most_left = 0.4;
  const auto is_kept = [&](double factor) {
    const auto loop = closed(points, factor);
    return loop.sensitivity <= kept_sensitivity && loop.left <= most_left &&
           std::abs(loop.turned - turned) < std::numbers::pi / 2;
  };
  double kept = 1;
  if (!is_kept(kept)) {
    while (kept > 1 / largest_factor && !is_kept(kept)) kept /= step;
    if (!is_kept(kept)) return 1 / largest_factor;
  } else {
    while (kept < largest_factor && is_kept(kept * step)) kept *= step;
  }
  double over = kept * step;
  for (int i = 0; i < 12; ++i) {
    const double middle = std::sqrt(kept * over);
    (is_kept(middle) ? kept : over) = middle;
  }
  return kept;
}

/// The least of it with the filters a little beside their place, for no machine resonates where it was
/// measured.
double most_gain(const SpeedLoop& loop, const plants::TorqueFilterData& filters) {
  constexpr double beside = 0.05;
  const double turned = closed(loop.points, 1).turned;
  double least = largest_factor;
  for (const double times : {1 - beside, 1.0, 1 + beside}) {
    auto moved = filters;
    moved.low_pass /= times;
    for (auto& notch : moved.notches) notch.frequency *= times;
    least = std::min(least, most_gain(points_with(loop, moved), turned));
  }
  return least;
}

/// The same for who chooses filters: none that costs the loop more phase at the gain in force than may be, or
/// any of its gain margin.
double most_with(const SpeedLoop& loop, const Margins& present, const plants::TorqueFilterData& filters) {
  const auto margins = margins_of(points_with(loop, filters));
  const auto short_of = [](const std::optional<AtFrequency>& now, const std::optional<AtFrequency>& before,
                           double less) {
    return before ? std::max(0.0, before->value - less - (now ? now->value : before->value)) : 0;
  };
  // Steep, so that the search finds back.
  const double over =
      short_of(margins.phase, present.phase, most_cost) + short_of(margins.gain, present.gain, 0);
  return std::log(most_gain(loop, filters)) - over;
}

using Merit = std::function<double(const std::vector<double>&)>;

/// A kind of filter with its values as numbers from 0 to 1.
struct Family {
  std::size_t values;
  std::function<plants::TorqueFilterData(const std::vector<double>&)> filters;
};

double between(double low, double high, double share) { return low * std::pow(high / low, share); }

plants::NotchData notch_of(const SpeedLoop& loop, const std::vector<double>& x) {
  const double highest = std::min(0.2 / loop.step, loop.points.back().frequency);
  return {between(10, highest, x[0]), between(0.03, 0.7, x[1]), between(0.2, 1, x[2])};
}

/// Where on a grid, finer in its first value than in the others, `merit` is the largest.
std::vector<double> best_of_grid(std::size_t values, const Merit& merit) {
  const auto steps = [values](std::size_t i) { return i > 0 ? 4 : values == 1 ? 60 : 24; };
  std::vector<double> best;
  double most = -1e9;
  std::vector<double> x(values, 0);
  std::vector<int> place(values, 0);
  for (bool more = true; more;) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = place[i] / static_cast<double>(steps(i));
    if (const double now = merit(x); now > most) {
      most = now;
      best = x;
    }
    more = false;
    for (std::size_t i = 0; i < place.size() && !more; ++i) {
      more = place[i] < steps(i);
      place[i] = more ? place[i] + 1 : 0;
    }
  }
  return best;
}

/// Uphill from `x`.
std::vector<double> climbed(std::vector<double> x, Merit merit) {
  nlopt::opt method(nlopt::LN_SBPLX, static_cast<unsigned>(x.size()));
  method.set_lower_bounds(0);
  method.set_upper_bounds(1);
  method.set_xtol_abs(1e-4);
  method.set_maxeval(600);
  method.set_initial_step(0.05);
  method.set_max_objective([](const std::vector<double>& at, std::vector<double>& /*gradient*/,
                              void* of) { return (*static_cast<Merit*>(of))(at); },
                           &merit);
  double found = 0;
  try {
    method.optimize(x, found);
  } catch (const nlopt::roundoff_limited&) {  // it is where it can be
  }
  return x;
}

FilterChoice best_of(const SpeedLoop& loop, const Margins& present, const Family& family) {
  const Merit merit = [&](const std::vector<double>& x) {
    return most_with(loop, present, family.filters(x));
  };
  return judged_with(loop, family.filters(climbed(best_of_grid(family.values, merit), merit)));
}

}  // namespace

bool FilterAdvice::worth() const {
  return !choices.empty() && present.factor < ample_factor &&
         choices.front().factor > worth_having * present.factor;
}

FilterChoice judged_with(const SpeedLoop& loop, const plants::TorqueFilterData& filters) {
  return {filters, margins_of(points_with(loop, filters)), most_gain(loop, filters)};
}

FilterAdvice advise(SpeedLoop measured) {
  FilterAdvice advice;
  advice.loop = std::move(measured);
  const auto& loop = advice.loop;
  if (loop.points.empty()) return advice;
  advice.present = judged_with(loop, loop.filters);
  const Family low_pass = {
      1, [&](const std::vector<double>& x) {
        return plants::TorqueFilterData{between(loop.step, 20e-3, x[0]), {no_notch(), no_notch()}};
      }};
  const Family notch = {3, [&](const std::vector<double>& x) {
                          return plants::TorqueFilterData{0, {notch_of(loop, x), no_notch()}};
                        }};
  advice.choices = {best_of(loop, advice.present.margins, low_pass),
                    best_of(loop, advice.present.margins, notch)};
  // A second one beside the first.
  const auto first = advice.choices[1].filters.notches[0];
  const Family second = {3, [&](const std::vector<double>& x) {
                           return plants::TorqueFilterData{0, {first, notch_of(loop, x)}};
                         }};
  advice.choices.push_back(best_of(loop, advice.present.margins, second));
  // What takes more filters must gain for it.
  const auto merit = [](const FilterChoice& choice) {
    const auto& [low, notches] = choice.filters;
    const int count =
        (low > 0 ? 1 : 0) + (notches[0].frequency > 0 ? 1 : 0) + (notches[1].frequency > 0 ? 1 : 0);
    return choice.factor / std::pow(worth_having, count - 1);
  };
  std::stable_sort(advice.choices.begin(), advice.choices.end(),
                   [&](const auto& a, const auto& b) { return merit(a) > merit(b); });
  return advice;
}

}  // namespace drycut::sim::studies
