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

/// What may be left of |L| at the last frequency, for what comes after it is not known.
constexpr double most_left = 0.4;

/// By which 1 + L turns from the first frequency to the last [rad].
double turned(const std::vector<BodePoint>& points, double factor) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += std::arg((1.0 + factor * points[i].open_loop) / (1.0 + factor * points[i - 1].open_loop));
  return sum;
}

/// `as`: as the loop turns that was measured, which is stable; one that turns otherwise goes round -1
/// (Nyquist).
bool is_kept(const std::vector<BodePoint>& points, double factor, double as) {
  return factor * std::abs(points.back().open_loop) <= most_left &&
         std::all_of(points.begin(), points.end(),
                     [&](const BodePoint& point) {
                       return std::abs(1.0 + factor * point.open_loop) * kept_sensitivity >= 1;
                     }) &&
         std::abs(turned(points, factor) - as) < std::numbers::pi / 2;
}

/// Every factor above which a loop may be kept no more.
std::vector<double> ends_of(const std::vector<BodePoint>& points) {
  std::vector<double> ends = {most_left / std::abs(points.back().open_loop)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    // |1 + k L| is 1/S where k2 |L|2 + 2 k re L + 1 - 1/S2 = 0, and less up to the other root.
    const auto now = points[i].open_loop;
    const double square = std::norm(now);
    const double under = now.real() * now.real() - (1 - 1 / (kept_sensitivity * kept_sensitivity)) * square;
    if (now.real() < 0 && under > 0) ends.push_back((-now.real() - std::sqrt(under)) / square);
    if (i == 0) continue;
    // And 1 + k L turns the other way round where -1 lies between two points.
    const auto before = points[i - 1].open_loop;
    if ((before.imag() > 0) == (now.imag() > 0)) continue;
    const double share = before.imag() / (before.imag() - now.imag());
    const double crossed = before.real() + share * (now.real() - before.real());
    if (crossed < 0) ends.push_back(-1 / crossed);
  }
  return ends;
}

/// The largest factor of gain, from the gain in force on, that keeps the sensitivity: it goes up from there,
/// or down to where it is kept. `as`: see is_kept().
double most_gain(const std::vector<BodePoint>& points, double as) {
  auto ends = ends_of(points);
  if (is_kept(points, 1, as)) {
    double most = largest_factor;
    for (const double end : ends)
      if (end >= 1) most = std::min(most, end);
    return most;
  }
  std::sort(ends.begin(), ends.end(), std::greater<>());
  constexpr double just_below = 1 - 1e-9;
  for (const double end : ends)
    if (end < 1 && end > 1 / largest_factor && is_kept(points, end * just_below, as)) return end;
  return 1 / largest_factor;
}

/// The least of it with the filters a little beside their place, for no machine resonates where it was
/// measured.
double most_gain(const SpeedLoop& loop, const plants::TorqueFilterData& filters) {
  constexpr double beside = 0.05;
  const double as = turned(loop.points, 1);
  double least = largest_factor;
  for (const double times : {1 - beside, 1.0, 1 + beside}) {
    auto moved = filters;
    moved.low_pass /= times;
    for (auto& notch : moved.notches) notch.frequency *= times;
    least = std::min(least, most_gain(points_with(loop, moved), as));
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

/// Whether point `i` and the next one have neighbours, all about evenly spaced: none between them was lost.
bool in_a_row(const std::vector<BodePoint>& points, std::size_t i) {
  if (i < 1 || i + 2 >= points.size()) return false;
  const auto gap = [&](std::size_t k) { return std::log(points[k + 1].frequency / points[k].frequency); };
  const auto [least, most] = std::minmax({gap(i - 1), gap(i), gap(i + 1)});
  return most < 1.5 * least;
}

/// L half-way between point `i` and the next one: over the logarithm of the frequency its own is taken as the
/// cubic through both and their neighbours.
BodePoint half_way(const std::vector<BodePoint>& points, std::size_t i) {
  auto point = points[i];
  point.frequency = std::sqrt(points[i].frequency * points[i + 1].frequency);
  std::complex<double> sum;
  for (std::size_t k = i - 1; k <= i + 2; ++k) {
    auto value = std::log(points[k].open_loop / points[i].open_loop);  // of phases the nearest turn
    for (std::size_t j = i - 1; j <= i + 2; ++j)
      if (j != k)
        value *= std::log(point.frequency / points[j].frequency) /
                 std::log(points[k].frequency / points[j].frequency);
    sum += value;
  }
  point.open_loop *= std::exp(sum);
  return point;
}

/// The loop with a point more between each two. A search ends at the edge of what is kept, and a resonance
/// would go over that between the points.
SpeedLoop finer(const SpeedLoop& loop) {
  auto fine = loop;
  fine.points.clear();
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    fine.points.push_back(loop.points[i]);
    if (in_a_row(loop.points, i)) fine.points.push_back(half_way(loop.points, i));
  }
  return fine;
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

/// A place with its merit.
struct Found {
  std::vector<double> x;
  double merit = -1e9;
};

/// The best at this first value, on a grid of the others.
Found best_at(double first, std::size_t values, const Merit& merit) {
  constexpr int steps = 4;
  Found best;
  std::vector<int> place(values, 0);
  for (bool more = true; more;) {
    std::vector<double> x = {first};
    for (std::size_t i = 1; i < values; ++i) x.push_back(place[i] / static_cast<double>(steps));
    if (const double now = merit(x); now > best.merit) best = {x, now};
    more = false;
    for (std::size_t i = 1; i < values && !more; ++i) {
      more = place[i] < steps;
      place[i] = more ? place[i] + 1 : 0;
    }
  }
  return best;
}

/// Where to start uphill: over the first value, which has one hill beside the other, the highest of those
/// that a grid shows.
std::vector<Found> best_of_grid(std::size_t values, const Merit& merit) {
  constexpr int steps = 48;
  constexpr std::size_t hills = 3;
  std::vector<Found> row;
  for (int i = 0; i <= steps; ++i) row.push_back(best_at(i / static_cast<double>(steps), values, merit));
  std::vector<Found> tops;
  for (std::size_t i = 0; i < row.size(); ++i)
    if ((i == 0 || row[i].merit > row[i - 1].merit) &&
        (i + 1 == row.size() || row[i].merit >= row[i + 1].merit))
      tops.push_back(row[i]);
  std::stable_sort(tops.begin(), tops.end(),
                   [](const Found& a, const Found& b) { return a.merit > b.merit; });
  if (tops.size() > hills) tops.resize(hills);
  return tops;
}

/// Uphill from there, and again from where that ended: a search can take the edge of a ridge for its top.
Found climbed(Found best, Merit merit) {
  nlopt::opt method(nlopt::LN_SBPLX, static_cast<unsigned>(best.x.size()));
  method.set_lower_bounds(0);
  method.set_upper_bounds(1);
  method.set_xtol_abs(1e-4);
  method.set_maxeval(300);
  method.set_initial_step(0.05);
  method.set_max_objective([](const std::vector<double>& at, std::vector<double>& /*gradient*/,
                              void* of) { return (*static_cast<Merit*>(of))(at); },
                           &merit);
  constexpr double hardly = 1e-3;
  for (bool higher = true; higher;) {
    Found found = best;
    try {
      method.optimize(found.x, found.merit);
    } catch (const nlopt::roundoff_limited&) {  // it is where it can be
      found.merit = merit(found.x);
    }
    higher = found.merit > best.merit + hardly;
    if (found.merit > best.merit) best = std::move(found);
  }
  return best;
}

FilterChoice best_of(const SpeedLoop& loop, const Margins& present, const Family& family) {
  const Merit merit = [&](const std::vector<double>& x) {
    return most_with(loop, present, family.filters(x));
  };
  Found best;
  for (auto& top : best_of_grid(family.values, merit))
    if (auto found = climbed(std::move(top), merit); found.merit > best.merit) best = std::move(found);
  return judged_with(loop, family.filters(best.x));
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
  if (advice.loop.points.empty()) return advice;
  const auto loop = finer(advice.loop);
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
