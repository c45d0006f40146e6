#include "sim/studies/tune/search.hpp"

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

  static double cost(const std::vector<double>& unit, std::vector<double>&, void* self) {
    return static_cast<Descent*>(self)->at(unit);
  }
  double at(const std::vector<double>& unit) {
    constexpr int most_repeats = 2000;  // integers: many places of the cube are one set of values
    const auto point = from_unit(trials.parameters(), unit);
    if (trials.has(point)) {
      if (++repeats > most_repeats) throw nlopt::forced_stop();
    } else if (trials.runs() + trials.runs_of_a_trial() > budget) {
      throw nlopt::forced_stop();
    }
    const auto& best = trials.at(trials.best()).verdict;
    const double to_beat = best.feasible() ? best.metric : std::numeric_limits<double>::infinity();
    return trials.at(trials.run("search", {point}, to_beat)[0]).verdict.rank();
  }
};

void descend(Trials& trials, const Point& from, int budget) {
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
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

std::size_t search(Trials& trials, const std::optional<Point>& start, int budget, std::uint64_t seed) {
  const auto& parameters = trials.parameters();
  const int least = static_cast<int>(2 * parameters.size()) + 2;
  const int sets = std::max(1, budget / trials.runs_of_a_trial());
  const int samples = std::clamp(sets * 2 / 5, std::min(least, sets), sets);
  auto points = latin_hypercube(parameters, samples, plants::Random(seed, "drycut tune"));
  if (start) points.front() = *start;
  const auto tried = trials.run("sample", points);

  std::vector<std::size_t> order = tried;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return trials.at(a).verdict.rank() < trials.at(b).verdict.rank();
  });
  constexpr double elsewhere = 0.1;  // of the range, in one parameter at least
  std::vector<std::vector<double>> begun;
  for (const auto index : order) {
    if (trials.runs() + trials.runs_of_a_trial() > budget) break;
    const Point point = trials.at(index).point;
    const auto unit = to_unit(parameters, point);
    if (std::any_of(begun.begin(), begun.end(),
                    [&](const auto& other) { return distance(unit, other) < elsewhere; }))
      continue;
    begun.push_back(unit);
    descend(trials, point, budget);
    begun.push_back(to_unit(parameters, trials.at(trials.best()).point));
  }
  return trials.best();
}

std::vector<Slice> look_around(Trials& trials, std::size_t& best) {
  constexpr std::array<double, 6> shares = {-0.1, -0.05, -0.02, 0.02, 0.05, 0.1};
  constexpr int most_rounds = 8;
  const auto& parameters = trials.parameters();
  for (int round = 1;; ++round) {
    std::vector<Point> points;
    std::vector<Slice> slices;
    const auto centre = trials.at(best).point;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      for (const double share : shares) {
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
    const bool moved = trials.at(found).verdict.rank() < trials.at(best).verdict.rank();
    if (!moved || round == most_rounds) return slices;
    best = found;
  }
}

}  // namespace drycut::sim::studies
