#include "sim/studies/fit/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "sim/studies/fit/noise.hpp"
#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {

namespace {

using Set = std::vector<double>;

double square_sum(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

bool is_whole(const FitBench::OfRecordings& all) {
  return std::ranges::all_of(all, [](const auto& one) { return one.has_value(); });
}

Residuals weighted(const FitBench::OfRecordings& all, double load_weight) {
  Residuals blocks;
  if (!is_whole(all)) return blocks;
  for (const auto& one : all) {
    const auto torques = static_cast<Eigen::Index>(one->torque_left.size());
    auto& block = blocks.emplace_back(torques + std::ssize(one->load_left));
    block.head(torques) = Eigen::Map<const Eigen::VectorXd>(one->torque_left.data(), torques);
    block.tail(std::ssize(one->load_left)) =
        load_weight * Eigen::Map<const Eigen::VectorXd>(one->load_left.data(), std::ssize(one->load_left));
  }
  return blocks;
}

double norm_of(const Residuals& blocks) {
  double sum = 0;
  for (const auto& block : blocks) sum += block.squaredNorm();
  return blocks.empty() ? std::numeric_limits<double>::infinity() : std::sqrt(sum);
}

/// The weight at which position of the load and torque of the motor are left unexplained alike; 0 without a
/// load.
double load_weight(const FitBench::OfRecordings& all) {
  double torque = 0;
  double load = 0;
  for (const auto& one : all) {
    torque += square_sum(one->torque_left);
    load += square_sum(one->load_left);
  }
  return load > 0 ? std::sqrt(torque / load) : 0;
}

/// The cutoffs that are tried, each twice the one before.
std::vector<double> cutoffs_for(const FitBench& bench) {
  constexpr double least = 4;
  double widest = least;
  for (std::size_t i = 0; i < bench.recordings().size(); ++i)
    widest = std::max(widest, std::min(bandwidth_of(bench.recordings()[i].torque), bench.resolved(i)));
  constexpr std::size_t most = 4;
  std::vector<double> cutoffs = {widest};
  while (cutoffs.size() < most && cutoffs.back() / 2 >= least) cutoffs.push_back(cutoffs.back() / 2);
  std::ranges::reverse(cutoffs);
  return cutoffs;
}

/// By how many of their limits two fits differ, at most, in what was looked for.
double apart(const AtCutoff& one, const AtCutoff& other, std::size_t values) {
  constexpr double rounding = 1e-3;
  double most = 0;
  for (std::size_t i = 0; i < values; ++i) {
    const auto& a = one.solution.estimates[i];
    const auto& b = other.solution.estimates[i];
    if (a.known != b.known) return std::numeric_limits<double>::infinity();
    if (a.known != FitKnown::yes) continue;
    const double limits = (a.high - a.low + b.high - b.low) / 2 + rounding * std::abs(a.value);
    most = std::max(most, std::abs(a.value - b.value) / limits);
  }
  return most;
}

/// How many values it knows, and how narrow their limits are: the sum of the logarithms.
std::pair<std::ptrdiff_t, double> worth(const AtCutoff& one, std::size_t values) {
  std::pair<std::ptrdiff_t, double> sum{0, 0};
  for (std::size_t i = 0; i < values; ++i) {
    const auto& estimate = one.solution.estimates[i];
    if (estimate.known != FitKnown::yes) continue;
    ++sum.first;
    sum.second -= std::log(estimate.high - estimate.low);
  }
  return sum;
}

/// The cutoff with the narrowest limits, of those that say the same as the one below them: from the lowest up
/// to where something is in the data that the model does not explain. A cutoff that knows more values than
/// those below begins anew.
std::size_t best_of(const std::vector<AtCutoff>& tried, std::size_t values) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < tried.size(); ++i) {
    const bool knows_more = worth(tried[i], values).first > worth(tried[best], values).first;
    if (!knows_more && apart(tried[i], tried[i - 1], values) > 1) break;
    if (worth(tried[i], values) > worth(tried[best], values)) best = i;
  }
  return best;
}

/// The fit without delays where it explains the recordings as well: slow motions hardly tell them, and then
/// they bend the other values.
AtCutoff simplest(FitBench& bench, AtCutoff with) {
  std::vector<std::pair<std::size_t, FitUnknown>> held;
  for (std::size_t i = 0; i < bench.recordings().size(); ++i)
    for (const auto number : {std::optional(bench.torque_delay(i)), bench.load_delay(i)})
      if (number) held.emplace_back(*number, bench.fix(*number, 0));
  auto start = with.values;
  for (const auto& [number, was] : held) start[number] = 0;
  auto without = solve_at(bench, with.cutoff, {start});
  for (const auto& [number, was] : held) bench.release(number, was);
  // A few samples are usual; who claims more must explain much more by it.
  constexpr double usual = 3;
  double longest = 0;
  for (std::size_t i = 0; i < bench.recordings().size(); ++i)
    longest =
        std::max(longest, std::abs(with.values[bench.torque_delay(i)]) / bench.recordings()[i].sampling);
  const double as_well = longest > usual ? 0.7 : 0.95;
  const bool explains_more =
      error_of(replayed_with(bench, with)) < as_well * error_of(replayed_with(bench, without));
  return explains_more ? with : without;
}

/// The same fit with as much noise again in the motion: by how much each value moves, largest of some tries.
Set moved_by_noise(const FitBench& bench, const AtCutoff& chosen) {
  constexpr std::uint64_t tries = 2;
  constexpr int most_trials = 15;
  Set most(bench.values() + 1);
  for (std::uint64_t seed = 1; seed <= tries; ++seed) {
    std::vector<ReplaySeries> noisy;
    for (const auto& one : bench.recordings()) noisy.push_back(with_noise_again(one, seed));
    FitBench again(bench.question(), noisy, bench.jobs(), bench.standstill());
    for (std::size_t i = 0; i < chosen.values.size(); ++i)
      if (i > bench.torque_offset() || bench.unknowns()[i].is_held()) again.fix(i, chosen.values[i]);
    const auto moved = solve_at(again, chosen.cutoff, {chosen.values}, most_trials);
    for (std::size_t i = 0; i < most.size(); ++i)
      most[i] = std::max(most[i], std::abs(moved.values[i] - chosen.values[i]));
  }
  return most;
}

/// Limits hold what as much noise again would have found; what it moves far was found in noise.
void widen_by_noise(const FitBench& bench, AtCutoff& chosen) {
  constexpr double far = 0.1;
  if (bench.question().closed) return;
  const auto moved = moved_by_noise(bench, chosen);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    auto& one = chosen.solution.estimates[i];
    if (one.known != FitKnown::yes) continue;
    const double half = std::hypot((one.high - one.low) / 2, moved[i]);
    one.low = one.value - half;
    one.high = one.value + half;
    if (bench.unknowns()[i].never_zero && moved[i] > far * std::abs(one.value)) one.known = FitKnown::no;
  }
}

}  // namespace

double error_of(const std::vector<Replayed>& all) {
  double left = 0;
  double whole = 0;
  for (const auto& one : all) {
    left += square_sum(one.torque_left);
    whole += square_sum(one.torque);
  }
  return std::sqrt(left / whole);
}

AtCutoff solve_at(FitBench& bench, double cutoff, const std::vector<Set>& starts, int most_trials) {
  const auto tried = bench.replay(starts, cutoff);
  const auto sound = std::ranges::find_if(tried, is_whole);
  if (sound == tried.end())
    throw std::runtime_error(bench.question().closed
                                 ? "the loop of the scenario does not come through the recording"
                                 : "the machine of the scenario cannot follow the recorded motion");
  double weight = load_weight(*sound);
  double whole = 0;
  std::size_t count = 0;
  for (const auto& one : *sound) {
    whole += square_sum(one->torque);
    count += one->torque.size();
  }
  constexpr std::size_t least_a_value = 4;
  if (count < least_a_value * bench.unknowns().size())
    throw std::runtime_error(
        fmt::format("too little of the recorded motion is of use: {} independent instants for {} values, an "
                    "offset and a delay among them. What stands or turns tells nothing: record a longer move",
                    count, bench.unknowns().size()));
  AtCutoff found{cutoff, starts.front(), {}};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double norm = norm_of(weighted(tried[i], weight));
    if (norm < least) found.values = starts[i];
    least = std::min(least, norm);
  }
  // The load's weight follows from what is left, so twice where there is one.
  auto unknowns = bench.unknowns();
  for (int round = 0; round < (weight > 0 ? 2 : 1); ++round) {
    for (std::size_t i = 0; i < unknowns.size(); ++i) unknowns[i].start = found.values[i];
    if (round > 0) weight = load_weight(bench.replay({found.values}, cutoff).front());
    const auto residuals = [&](const std::vector<Set>& sets) {
      std::vector<Residuals> all;
      for (const auto& one : bench.replay(sets, cutoff)) all.push_back(weighted(one, weight));
      return all;
    };
    found.solution = solve_fit(unknowns, residuals, std::sqrt(whole), most_trials);
    for (std::size_t i = 0; i < unknowns.size(); ++i) found.values[i] = found.solution.estimates[i].value;
  }
  return found;
}

std::vector<Set> starts_of(const FitBench& bench) {
  const auto values = bench.start();
  std::vector<Set> starts = {values};
  for (std::size_t i = 0; i < bench.values(); ++i) {
    if (!bench.question().vary[i].row.ends_with("stiffness")) continue;
    for (const double times : {0.25, 4.0}) starts.emplace_back(values)[i] *= times;
  }
  for (const int samples : {-6, -3, 3, 6}) {
    auto& other = starts.emplace_back(values);
    for (std::size_t i = 0; i < bench.recordings().size(); ++i) {
      const double late = samples * bench.recordings()[i].sampling;
      other[bench.torque_delay(i)] += late;
      // Against the input of a closed loop all of it may be late.
      if (bench.question().closed) other[*bench.load_delay(i)] += late;
    }
  }
  return starts;
}

Solved search_fit(FitBench& bench) {
  Solved solved;
  auto& tried = solved.tried;
  for (const double cutoff : cutoffs_for(bench)) {
    auto starts = starts_of(bench);
    if (!tried.empty()) starts.push_back(tried.back().values);
    tried.push_back(solve_at(bench, cutoff, starts));
  }
  // More is unexplained at a higher cutoff; where it is less, the search below ended in the wrong valley.
  for (std::size_t i = tried.size(); i-- > 1;)
    if (tried[i - 1].solution.norm > tried[i].solution.norm)
      tried[i - 1] = solve_at(bench, tried[i - 1].cutoff, {tried[i].values});
  for (auto& one : tried) one = simplest(bench, std::move(one));
  solved.best = best_of(tried, bench.values());
  widen_by_noise(bench, tried[solved.best]);
  return solved;
}

std::vector<Replayed> replayed_with(FitBench& bench, const AtCutoff& solved) {
  auto all = bench.replay({solved.values}, solved.cutoff).front();
  std::vector<Replayed> whole;
  for (auto& one : all)
    if (one) whole.push_back(std::move(*one));
  return whole;
}

}  // namespace drycut::sim::studies
