#pragma once
#include <string>
#include <utility>
#include <vector>

#include "sim/loop/known_events.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/studies/compare/comparison.hpp"
#include "sim/studies/compare/report.hpp"
#include "sim/studies/compare/scene.hpp"

namespace drycut::sim::studies {

/// What a member of a comparison can be asked for.
struct MemberNames {
  std::vector<std::pair<std::string, std::string>> channels;  ///< recorded: name, unit
  std::vector<loop::KnownEvent> events;
};
MemberNames names_of(const loop::Simulation& simulation);

/// Tells in `problems` what of the scene's channels, figures, plots and checks its members cannot give;
/// `names` in the order of the members.
void check_comparison(const ComparisonScene& scene, const std::vector<MemberNames>& names,
                      Problems& problems);

/// The comparison of the members' runs and the page about it. The scene must have passed check_comparison;
/// the runs are in the order of the members and have their names. The scene passes if every run passed and
/// every check of its own holds; a figure that has nothing to look at is NaN, and no check on it holds.
struct ComparedScene {
  Comparison comparison;
  ComparisonPage page;
};
ComparedScene compare_members(const ComparisonScene& scene, const std::vector<MemberNames>& names,
                              std::vector<ComparedRun> runs);

}  // namespace drycut::sim::studies
