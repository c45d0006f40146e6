#include "sim/studies/why/branches.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/loop/names.hpp"

namespace drycut::sim::studies {

namespace {

/// What the controller was given before it was switched on is part of what it has come to: it is given anew.
struct PresetAgain {
  std::string name;
  double number;
};

std::vector<PresetAgain> presets_of(const Mixture& mixture, const Subset& cause, loop::Simulation& good) {
  std::vector<PresetAgain> presets;
  for (const auto number : cause) {
    const auto name = mixture.differences()[number].preset();
    const auto reading = name.empty() ? std::nullopt : good.names().reading(name);
    if (reading) presets.push_back({name, reading->read()});
  }
  return presets;
}

enum class BranchCame { saved, lost, unfit };

BranchCame branch_off(const Mixture& mixture, const Subset& cause, const KeptBranch& moment,
                      const FailedCheck& check, std::string& why) {
  MixedRun without(mixture.with(cause, true));
  if (!without.problems().empty()) {
    why = to_string(without.problems().front());
    return BranchCame::unfit;
  }
  auto& simulation = without.simulation();
  const auto presets = presets_of(mixture, cause, simulation);
  try {
    simulation.restore(moment.state, {}, true);
  } catch (const BadState& bad) {
    why = bad.what();
    return BranchCame::unfit;
  }
  for (const auto& [name, number] : presets) {
    scenario::Stimulus again;
    again.at = simulation.time();
    again.set.push_back({{name, {1, 1, 0}, {}}, {number, "", {1, 1, 0}}});
    Problems problems;
    if (simulation.act(again, problems)) continue;
    why = fmt::format("{} cannot be set while it runs", name);
    return BranchCame::unfit;
  }
  return check.of(without.run()) == TrialCame::passed ? BranchCame::saved : BranchCame::lost;
}

}  // namespace

PointOfReturn point_of_return(const Mixture& mixture, const Subset& cause,
                              const std::vector<KeptBranch>& moments, double failed_at,
                              const FailedCheck& check, MixedTrials& trials) {
  const auto unknown = [](std::string why) { return PointOfReturn{{}, {}, std::move(why)}; };
  if (!mixture.states_fit(cause))
    return unknown("the programs differ, and what one has come to does not fit the other");
  const auto late = std::ranges::find_if(moments, [&](const auto& moment) { return moment.at >= failed_at; });
  const auto count = static_cast<std::size_t>(late - moments.begin());
  if (count == 0) return unknown("no moment before it was kept");
  std::string why;
  const auto try_from = [&](std::size_t number) {
    return branch_off(mixture, cause, moments[number], check, why);
  };
  // From the very beginning it must pass: else what differs is part of what was kept.
  if (!trials.take()) return unknown("the budget ended before");
  const auto begun = try_from(0);
  if (begun == BranchCame::unfit) return unknown("a moment of the one does not fit the other: " + why);
  if (begun == BranchCame::lost)
    return unknown("what differs is part of what the run has come to from its beginning on");
  std::size_t saved = 0;
  std::size_t lost = count;
  while (lost - saved > 1) {
    const auto middle = saved + (lost - saved) / 2;
    if (!trials.take()) return unknown("the budget ended before");
    (try_from(middle) == BranchCame::saved ? saved : lost) = middle;
  }
  PointOfReturn found{moments[saved].at, {}, ""};
  found.lost = lost < count ? moments[lost].at : failed_at;
  return found;
}

}  // namespace drycut::sim::studies
