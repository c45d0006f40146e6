#include "sim/studies/fit/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "sim/scenario/units.hpp"
#include "sim/studies/fit/signal.hpp"
#include "sim/studies/fit/words.hpp"

namespace drycut::sim::studies {

namespace {

using Set = std::vector<double>;

double square_sum(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

double error_of(const std::vector<Replayed>& all) {
  double left = 0;
  double whole = 0;
  for (const auto& one : all) {
    left += square_sum(one.torque_left);
    whole += square_sum(one.torque);
  }
  return std::sqrt(left / whole);
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

/// A fit at one cutoff.
struct AtCutoff {
  double cutoff = 0;
  Set values;
  FitSolution solution;
};

/// From the best of `starts`, at one cutoff.
AtCutoff solve_at(FitBench& bench, double cutoff, const std::vector<Set>& starts, int most_trials = 60) {
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
        fmt::format("too little of the recorded motion is of use: {} independent instants for {} values",
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

/// Where a search may begin: as the scenario has it, with springs four times as stiff and soft, and with the
/// recording late or early by some samples.
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

/// The cutoffs that are tried, each twice the one before.
std::vector<double> cutoffs_for(const std::vector<ReplaySeries>& recordings) {
  double widest = 0;
  for (const auto& one : recordings) widest = std::max(widest, bandwidth_of(one.torque));
  constexpr double least = 4;
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

/// The fits at all cutoffs, and the one that counts.
struct Solved {
  std::vector<AtCutoff> tried;
  std::size_t best = 0;

  [[nodiscard]] const AtCutoff& chosen() const { return tried[best]; }
};

Solved solve(FitBench& bench) {
  Solved solved;
  auto& tried = solved.tried;
  for (const double cutoff : cutoffs_for(bench.recordings())) {
    auto starts = starts_of(bench);
    if (!tried.empty()) starts.push_back(tried.back().values);
    tried.push_back(solve_at(bench, cutoff, starts));
  }
  // More is unexplained at a higher cutoff; where it is less, the search below ended in the wrong valley.
  for (std::size_t i = tried.size(); i-- > 1;)
    if (tried[i - 1].solution.norm > tried[i].solution.norm)
      tried[i - 1] = solve_at(bench, tried[i - 1].cutoff, {tried[i].values});
  solved.best = best_of(tried, bench.values());
  return solved;
}

std::vector<Replayed> replayed_with(FitBench& bench, const AtCutoff& solved) {
  auto all = bench.replay({solved.values}, solved.cutoff).front();
  std::vector<Replayed> whole;
  for (auto& one : all)
    if (one) whole.push_back(std::move(*one));
  return whole;
}

/// What a model without these values loses by Schwarz's criterion, above 0: they are worth it. Neighbours in
/// a residual are alike, a third of them count.
double bic_gain(const AtCutoff& without, const AtCutoff& with, std::size_t count) {
  constexpr double counted = 1.0 / 3;
  const double n = counted * static_cast<double>(count);
  const auto more = static_cast<double>(with.values.size() - without.values.size());
  return 2 * n * std::log(without.solution.norm / with.solution.norm) - more * std::log(n);
}

/// The models above the question's own, each with what varies besides.
std::vector<FitRung> rungs_for(const FitQuestion& question) {
  std::vector<FitRung> rungs;
  const auto varies = [&](const std::string& row) {
    return std::ranges::any_of(question.vary, [&](const FitPath& path) { return path.row == row; });
  };
  const auto path_of = [&](const std::string& row) { return FitPath{question.plant, row}.text(); };
  for (const auto& path : question.vary) {
    constexpr std::string_view coulomb = ".coulomb";
    if (!path.row.ends_with(coulomb)) continue;
    const auto group = path.row.substr(0, path.row.size() - coulomb.size());
    if (!varies(group + ".breakaway"))
      rungs.push_back({"more friction at low speed (Stribeck)",
                       {path_of(group + ".breakaway"), path_of(group + ".stribeck_speed")}});
  }
  for (const auto& path : question.vary) {
    constexpr std::string_view viscous = ".viscous";
    if (!path.row.ends_with(viscous) || varies(path.row + "_backward")) continue;
    rungs.push_back({"viscous friction that differs by direction", {path_of(path.row + "_backward")}});
  }
  if (!varies("unbalance"))
    rungs.push_back({"unbalance of what turns", {path_of("unbalance"), path_of("unbalance_angle")}});
  return rungs;
}

/// A model with more values, from where the question's own ended; both over the same data.
struct Compared {
  AtCutoff without;
  AtCutoff with;
  double error_without = 0;
  double error_with = 0;
  std::size_t count = 0;
};

Compared compare(const FitQuestion& richer, const FitBench& bench, const AtCutoff& base, int jobs,
                 std::size_t& runs) {
  constexpr int most_trials = 15;
  FitBench more(richer, bench.recordings(), jobs);
  auto start = more.start();
  const auto own = static_cast<std::ptrdiff_t>(bench.values());
  std::copy_n(base.values.begin(), own, start.begin());
  std::copy(base.values.begin() + own, base.values.end(), start.begin() + std::ssize(richer.vary));
  // Begins where it shows: some of what varies besides is 0 without it.
  for (std::size_t i = bench.values(); i < more.values(); ++i)
    if (start[i] == 0) start[i] = wakened(richer.vary[i], bench.question().vary, base.values);
  Compared both;
  both.with = solve_at(more, base.cutoff, {start}, most_trials);
  both.error_with = error_of(replayed_with(more, both.with));
  FitBench same(bench.question(), bench.recordings(), jobs, more.standstill());
  both.without = solve_at(same, base.cutoff, {base.values}, most_trials);
  const auto replayed = replayed_with(same, both.without);
  both.error_without = error_of(replayed);
  for (const auto& one : replayed) both.count += one.torque_left.size();
  runs += more.runs() + same.runs();
  return both;
}

/// Tries what each model gains.
void climb(const FitBench& bench, const AtCutoff& base, int jobs, FitFound& found) {
  for (auto& rung : rungs_for(bench.question())) {
    FitQuestion richer = bench.question();
    for (const auto& path : rung.paths) richer.vary.push_back(*fit_path(path));
    std::optional<Compared> both;
    try {
      both = compare(richer, bench, base, jobs, found.runs);
    } catch (const std::runtime_error&) {
      continue;  // the machine has no such value
    }
    rung.error_without = both->error_without;
    rung.error = both->error_with;
    rung.gain = bic_gain(both->without, both->with, both->count);
    if (rung.is_worth_it())
      found.tell(
          {"fit.ladder"_code,
           fmt::format("{} would lower the unexplained torque from {:.3g} to {:.3g} %: --vary {}", rung.model,
                       rung.error_without * 100, rung.error * 100, fmt::join(rung.paths, " --vary "))});
    found.ladder.push_back(rung);
  }
}

/// An offset of the torque may as well be dry friction that differs by direction: both are told.
void tell_offset(FitFound& found) {
  const auto& offset = found.torque_offset;
  if (!offset.value || *offset.low * *offset.high <= 0) return;
  for (const auto& value : found.parameters) {
    if (!value.value || !value.path.ends_with(".coulomb")) continue;
    found.tell(
        {"fit.offset-or-direction"_code,
         fmt::format("the recorded torque is {:.3g} N m too much in both directions: an offset of what "
                     "was measured, or dry friction of {} that is so much more one way; the recording "
                     "cannot tell which. With --vary ...backward it is taken for friction",
                     *offset.value, value.path.substr(0, value.path.rfind('.')))});
    return;
  }
}

/// Values as people have them, with the reasons of those that are not known.
void tell_values(const FitBench& bench, const Solved& solved, FitFound& found) {
  const auto& chosen = solved.chosen();
  const auto before = bench.start();
  const auto value_of = [&](std::size_t i) {
    const bool is_offset = i == bench.torque_offset();
    const auto& estimate = chosen.solution.estimates[i];
    FittedValue value;
    value.unit = is_offset ? "N m" : bench.unit(i);
    const auto shown = [&](double si) { return scenario::from_si(si, value.unit); };
    value.path = is_offset ? bench.question().plant + ".motor.torque" : bench.question().vary[i].text();
    value.known = estimate.known;
    value.before = shown(before[i]);
    value.used = shown(estimate.value);
    if (estimate.alone.size() > 1)
      for (const double alone : estimate.alone) value.alone.push_back(shown(alone));
    if (estimate.known == FitKnown::yes) {
      value.value = value.used;
      const auto& range = bench.unknowns()[i];
      value.low = shown(is_offset ? estimate.low : std::max(estimate.low, range.low));
      value.high = shown(is_offset ? estimate.high : std::min(estimate.high, range.high));
      const auto of = [&](std::size_t other) -> std::optional<double> {
        if (other >= solved.tried.size()) return {};
        return shown(solved.tried[other].values[i]);
      };
      value.coarser = solved.best > 0 ? of(solved.best - 1) : std::nullopt;
      value.finer = of(solved.best + 1);
      return value;
    }
    std::vector<FitPath> with;
    for (const auto other : estimate.with)
      if (other < bench.values()) with.push_back(bench.question().vary[other]);
    const bool with_offset = std::ranges::find(estimate.with, bench.torque_offset()) != estimate.with.end();
    value.why = why_not_known(is_offset ? FitPath{} : bench.question().vary[i], with, with_offset,
                              bench.recordings());
    return value;
  };
  for (std::size_t i = 0; i < bench.values(); ++i) found.parameters.push_back(value_of(i));
  found.torque_offset = value_of(bench.torque_offset());
}

/// A channel of a recording, where there are several with its name.
std::string name_in(const FitBench& bench, std::size_t recording, const std::string& channel) {
  const auto& all = bench.recordings();
  return all.size() > 1 ? all[recording].name() + ": " + channel : channel;
}

/// A force that was recorded may be in the torque already.
void tell_shares(const FitBench& bench, const AtCutoff& chosen, FitFound& found) {
  for (std::size_t i = 0; i < bench.recordings().size(); ++i) {
    const auto& inputs = bench.recordings()[i].inputs;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      const auto share = bench.share(i, j);
      if (!share) continue;
      const auto& estimate = chosen.solution.estimates[*share];
      auto& told = found.inputs.emplace_back();
      told.path = name_in(bench, i, inputs[j].channel);
      told.known = estimate.known;
      told.before = 1;
      told.used = estimate.value;
      if (estimate.known != FitKnown::yes) {
        told.why = "it hardly changes, or as another value does";
        continue;
      }
      told.value = estimate.value;
      told.low = estimate.low;
      told.high = estimate.high;
      constexpr double near = 0.05;
      if (estimate.low <= 1 + near && estimate.high >= 1 - near) continue;
      found.tell({"fit.disturbance"_code,
                  fmt::format("{} acts by {:.3g} of what was recorded ({:.3g} .. {:.3g}){}", told.path,
                              estimate.value, estimate.low, estimate.high,
                              estimate.low <= near && estimate.high >= -near
                                  ? ": not at all, or it is in the recorded torque already"
                                  : ": its scale or sign is another, or some of it is in the torque already"),
                  Finding::Role::warning});
    }
  }
}

void tell_delays(const FitBench& bench, const AtCutoff& chosen, FitFound& found) {
  for (std::size_t i = 0; i < bench.recordings().size(); ++i) {
    const auto& one = bench.recordings()[i];
    const auto key = [&](const std::string& channel) { return name_in(bench, i, channel); };
    found.delays[key(one.plant + ".motor.torque")] = chosen.values[bench.torque_delay(i)];
    if (const auto load = bench.load_delay(i)) found.delays[key(one.load->channel)] = chosen.values[*load];
  }
}

/// Limits hold what each recording alone says, where they know the value too.
void widen(FitFound& found) {
  for (auto& value : found.parameters) {
    if (!value.value || value.alone.size() < 2) continue;
    const auto [least, most] = std::ranges::minmax(value.alone);
    if (least < *value.low || most > *value.high)
      found.tell({"fit.differs"_code,
                  fmt::format("{}: the recordings alone say {:.5g} to {:.5g} {}, their limits together were "
                              "{:.5g} to {:.5g}; the limits hold both now",
                              value.path, least, most, value.unit, *value.low, *value.high),
                  Finding::Role::warning});
    value.low = std::min(*value.low, least);
    value.high = std::max(*value.high, most);
  }
}

void tell_unknown(FitFound& found) {
  const auto tell = [&](const FittedValue& value, const std::string& what) {
    if (value.value) return;
    const bool joined = value.known == FitKnown::joined;
    found.tell({joined ? "fit.joined"_code : "fit.not-known"_code,
                fmt::format("{} is {}: {}", what,
                            joined ? "known only together with another value" : "not known", value.why),
                Finding::Role::warning});
  };
  for (const auto& value : found.parameters) tell(value, value.path);
  tell(found.torque_offset, "The offset of " + found.torque_offset.path);
  found.passed =
      std::ranges::all_of(found.parameters, [](const auto& value) { return value.value.has_value(); });
}

}  // namespace

FitFound fit(const FitQuestion& question, const std::vector<ReplaySeries>& recordings, int jobs,
             const std::function<void(const char* doing)>& progress) {
  const auto doing = [&](const char* what) {
    if (progress) progress(what);
  };
  FitFound found;
  for (auto& doubt : doubts_of(recordings)) found.tell(std::move(doubt));
  doing("search");
  FitBench bench(question, recordings, jobs);
  const bool by_direction =
      std::ranges::any_of(question.vary, [](const FitPath& path) { return path.row.ends_with(".backward"); });
  if (by_direction) bench.fix(bench.torque_offset(), 0);
  const auto solved = solve(bench);
  doing("other models");
  climb(bench, solved.chosen(), jobs, found);
  found.cutoff = solved.chosen().cutoff;
  found.condition = solved.chosen().solution.condition;
  found.replayed = replayed_with(bench, solved.chosen());
  found.relative_error = error_of(found.replayed);
  tell_values(bench, solved, found);
  tell_delays(bench, solved.chosen(), found);
  tell_shares(bench, solved.chosen(), found);
  widen(found);
  tell_unknown(found);
  constexpr double much = 0.1;
  if (found.relative_error > much)
    found.tell(
        {"fit.unexplained"_code,
         fmt::format("{:.3g} % of the torque is left unexplained: something acts on the machine that the "
                     "model or the recording does not have, and the limits know nothing of it",
                     found.relative_error * 100),
         Finding::Role::warning});
  if (by_direction)
    found.tell(
        {"fit.offset-or-direction"_code,
         "the torque was taken to have no offset: an offset and dry friction that differs by direction "
         "are the same torque"});
  else
    tell_offset(found);
  found.runs += bench.runs();
  return found;
}

void cross_test(const FitQuestion& question, const std::vector<ReplaySeries>& tests,
                std::optional<double> limit, int jobs, FitFound& found) {
  constexpr double percent = 100;
  for (const auto& test : tests) {
    const std::vector<ReplaySeries> one = {test};
    FitBench bench(question, one, jobs);
    for (std::size_t i = 0; i < found.parameters.size(); ++i)
      bench.fix(i, scenario::to_si(found.parameters[i].used, found.parameters[i].unit));
    bench.fix(bench.torque_offset(), found.torque_offset.used);
    for (std::size_t i = 0; i < test.inputs.size(); ++i)
      for (const auto& input : found.inputs)
        if (bench.share(0, i) && input.path == test.inputs[i].channel)
          bench.fix(*bench.share(0, i), input.used);
    const auto solved = solve_at(bench, found.cutoff, starts_of(bench));
    auto replayed = replayed_with(bench, solved);
    found.cross_error = std::max(found.cross_error.value_or(0), error_of(replayed));
    for (auto& whole : replayed) found.tested.push_back(std::move(whole));
    found.runs += bench.runs();
  }
  if (!limit || !found.cross_error || *found.cross_error * percent <= *limit) return;
  found.passed = false;
  found.tell(
      {"fit.cross-test"_code,
       fmt::format("the values leave {:.3g} % of the torque of another recording unexplained, more than "
                   "{:.3g} %",
                   *found.cross_error * percent, *limit),
       Finding::Role::warning});
}

}  // namespace drycut::sim::studies
