#include "sim/studies/why/branches.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/loop/names.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

/// What the controller was given before it was switched on, and what of a machine can be changed while it
/// runs, is part of what they have come to: it is given anew.
struct GivenAgain {
  std::string name;
  double number;
  std::string unit;
};

std::string name_while_it_runs(const Difference& difference) {
  constexpr std::string_view plants = "plants.";
  return difference.where.starts_with(plants) ? difference.where.substr(plants.size()) : difference.preset();
}

std::vector<GivenAgain> given_again(const Mixture& mixture, const Subset& cause, loop::Simulation& good) {
  std::vector<GivenAgain> given;
  for (const auto number : cause) {
    const auto& difference = mixture.differences()[number];
    const auto name = name_while_it_runs(difference);
    if (name.empty() || !good.names().target(name)) continue;
    if (const auto reading = good.names().reading(name)) {
      given.push_back({name, reading->read(), reading->unit});
    } else if (const auto quantity = scenario::parse_quantity(difference.good)) {
      given.push_back({name, quantity->number, quantity->unit});
    }
  }
  return given;
}

enum class BranchCame { saved, lost, unfit };

BranchCame branch_off(const Mixture& mixture, const Subset& cause, const KeptBranches& kept,
                      std::size_t number, const std::vector<std::string>& channels, const FailedCheck& check,
                      std::string& why) {
  MixedRun without(mixture.with(cause, true), &channels);  // what is looked at is part of a state
  if (!without.problems().empty()) {
    why = to_string(without.problems().front());
    return BranchCame::unfit;
  }
  auto& simulation = without.simulation();
  // Bytes have no names: of other members they would be taken for what they are not.
  if (members_of(simulation) != kept.members) {
    why = "they are made of other parts";
    return BranchCame::unfit;
  }
  const auto given = given_again(mixture, cause, simulation);
  try {
    simulation.restore(kept.moments[number].state, {}, true);
  } catch (const BadState& bad) {
    why = bad.what();
    return BranchCame::unfit;
  }
  for (const auto& [name, number, unit] : given) {
    scenario::Stimulus again;
    again.at = simulation.time();
    again.set.push_back({{name, {1, 1, 0}, {}}, {number, unit, {1, 1, 0}}});
    Problems problems;
    if (simulation.act(again, problems)) continue;
    why = fmt::format("{} cannot be set while it runs", name);
    return BranchCame::unfit;
  }
  return check.of(without.run()) == TrialCame::passed ? BranchCame::saved : BranchCame::lost;
}

}  // namespace

std::vector<std::string> members_of(loop::Simulation& simulation) {
  simulation.begin();
  StateArchive::Bytes bytes;
  std::vector<StateArchive::Member> members;
  StateArchive::save(bytes, simulation, &members);
  std::vector<std::string> names;
  for (auto& member : members) names.push_back(std::move(member.name));
  return names;
}

PointOfReturn point_of_return(const Mixture& mixture, const Subset& cause, const KeptBranches& kept,
                              const std::vector<std::string>& channels, double failed_at,
                              const FailedCheck& check, MixedTrials& trials) {
  const auto& moments = kept.moments;
  const auto unknown = [](std::string why) { return PointOfReturn{{}, {}, std::move(why)}; };
  if (!mixture.states_fit(cause))
    return unknown("the programs differ, and what one has come to does not fit the other");
  const auto late = std::ranges::find_if(moments, [&](const auto& moment) { return moment.at >= failed_at; });
  const auto count = static_cast<std::size_t>(late - moments.begin());
  if (count == 0) return unknown("no moment before it was kept");
  std::string why;
  const auto try_from = [&](std::size_t number) {
    return branch_off(mixture, cause, kept, number, channels, check, why);
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
