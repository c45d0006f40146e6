#include "sim/studies/fit/ladder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/studies/fit/words.hpp"

namespace drycut::sim::studies {

namespace {

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

}  // namespace

void climb_ladder(const FitBench& bench, const AtCutoff& base, int jobs, FitFound& found) {
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

}  // namespace drycut::sim::studies
