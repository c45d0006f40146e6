#include "sim/studies/tune/trials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <numeric>

namespace drycut::sim::studies {

namespace {

/// What the subplex method calls: a place in the unit cube, looked up in the trials or tried.
struct Descent {
  Trials& trials;
  int budget;  ///< [runs]
  int repeats = 0;
  bool out_of_runs = false;

  static double cost(const std::vector<double>& unit, std::vector<double>&, void* self) {
    return static_cast<Descent*>(self)->at(unit);
  }
  double at(const std::vector<double>& unit) {
    constexpr int most_repeats = 2000;  // integers: many places of the cube are one set of values
    const auto point = from_unit(trials.parameters(), unit);
    if (trials.has(point)) {
      if (++repeats > most_repeats) throw nlopt::forced_stop();
    } else if (trials.runs() + trials.runs_of_a_trial() > budget) {
      out_of_runs = true;
      throw nlopt::forced_stop();
    }
    const auto& best = trials.at(trials.best()).verdict;
    const double to_beat = best.feasible() ? best.metric : std::numeric_limits<double>::infinity();
    return trials.at(trials.run("search", {point}, to_beat)[0]).verdict.rank();
  }
};

/// Whether it came to a bottom before its runs were used up.
bool descend(Trials& trials, const Point& from, int budget) {
  constexpr double first_step = 0.1;
  constexpr double last_step = 1e-4;
  Descent descent{trials, budget};
  auto unit = to_unit(trials.parameters(), from);
  nlopt::opt method(nlopt::LN_SBPLX, static_cast<unsigned>(unit.size()));
  method.set_lower_bounds(0);
  method.set_upper_bounds(1);
  method.set_min_objective(&Descent::cost, &descent);
  method.set_initial_step(first_step);
  method.set_xtol_abs(last_step);
  for (auto& x : unit) x = std::clamp(x, 0.0, 1.0);
  double least = 0;
  try {
    method.optimize(unit, least);
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {
  }
  return !descent.out_of_runs;
}

/// A loop that gave all its figures, or of which nothing can be told.
std::optional<std::size_t> first_judged(const Trials& trials) {
  for (std::size_t i = 0; i < trials.trials().size(); ++i) {
    const auto& verdict = trials.at(i).verdict;
    const bool whole =
        std::none_of(verdict.room.begin(), verdict.room.end(), [](double x) { return std::isnan(x); });
    if (trials.has_loop(verdict) && (whole || verdict.doubtful)) return i;
  }
  return {};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

bool search(Trials& trials, int most_runs, std::uint64_t seed) {
  const auto& parameters = trials.parameters();
  const int least = static_cast<int>(2 * parameters.size()) + 2;
  const int sets = std::max(1, (most_runs - trials.runs()) / trials.runs_of_a_trial());
  const int samples = std::clamp(sets * 2 / 5, std::min(least, sets), sets);
  auto points = latin_hypercube(parameters, samples, plants::Random(seed, "drycut tune"));
  // One by one until a loop is measured: where nothing can be told of it, all others would be in vain.
  auto rest = points.begin();
  while (rest != points.end() && trials.measures_loop() && !first_judged(trials))
    trials.run("sample", {*rest++});
  if (is_unmeasurable(trials)) return false;
  trials.run("sample", {rest, points.end()});

  std::vector<std::size_t> order(trials.trials().size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return trials.at(a).verdict.rank() < trials.at(b).verdict.rank();
  });
  constexpr double elsewhere = 0.1;  // of the range, in one parameter at least
  std::vector<std::vector<double>> begun;
  bool settled = false;
  for (const auto index : order) {
    if (trials.runs() + trials.runs_of_a_trial() > most_runs) break;
    const Point point = trials.at(index).point;
    const auto unit = to_unit(parameters, point);
    if (std::any_of(begun.begin(), begun.end(),
                    [&](const auto& other) { return distance(unit, other) < elsewhere; }))
      continue;
    begun.push_back(unit);
    const auto before = trials.best();
    const bool at_bottom = descend(trials, point, most_runs);
    if (begun.size() == 1 || trials.best() != before) settled = at_bottom;
    begun.push_back(to_unit(parameters, trials.at(trials.best()).point));
  }
  return settled;
}

bool is_unmeasurable(const Trials& trials) {
  const auto judged = first_judged(trials);
  return judged && trials.at(*judged).verdict.doubtful;
}

std::vector<Slice> look_around(Trials& trials, std::size_t& best, int most_runs) {
  constexpr std::array<double, 3> half_widths = {0.05, 0.1, 0.02};
  constexpr int most_rounds = 8;
  const auto& parameters = trials.parameters();
  std::vector<Slice> slices;
  for (int round = 1; round <= most_rounds; ++round) {
    const int sets = (most_runs - trials.runs()) / trials.runs_of_a_trial();
    const auto pairs = std::min<std::size_t>(
        static_cast<std::size_t>(std::max(sets, 0)) / (2 * parameters.size()), half_widths.size());
    if (pairs == 0) return slices;
    std::vector<Point> points;
    slices.clear();
    const auto centre = trials.at(best).point;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      for (std::size_t k = 0; k < 2 * pairs; ++k) {
        const double share = k % 2 == 0 ? -half_widths[k / 2] : half_widths[k / 2];
        const double moved = centre[i] + share * (parameters[i].high - parameters[i].low);
        if (moved < parameters[i].low || moved > parameters[i].high) continue;
        auto point = centre;
        point[i] = parameters[i].integer ? std::rint(moved) : moved;
        points.push_back(point);
        slices.push_back({i, share, 0});
      }
    }
    const auto tried = trials.run("around", points);
    for (std::size_t i = 0; i < tried.size(); ++i) slices[i].trial = tried[i];
    const auto found = trials.best();
    if (!(trials.at(found).verdict.rank() < trials.at(best).verdict.rank())) return slices;
    best = found;
  }
  return slices;
}

}  // namespace drycut::sim::studies
