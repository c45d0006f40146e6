#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "sim/scenario/archive.hpp"

namespace drycut::sim::scenario {

// The steps of read_scenario.

/// Plants with their parameters, each after the plants that it refers to; judged for the scenario's step.
/// Models of motors are looked for in `catalogue/` of `folder` first.
std::vector<PlantEntry> read_plants(const YamlNode& node, std::span<const plants::PlantType> types, Time step,
                                    const std::filesystem::path& folder, Findings& findings);

/// Puts override number `source` (of Findings::sources) into the tree before it is read: lists by index,
/// missing keys added where a default stands.
void apply_override(YamlNode& root, const Override& override, int source, Findings& findings);

/// Keeps of `fitted` what is in force, tells the plants of it, and says what is wrong. `names_are_known`: a
/// plant that could not be read is no name that is wrong.
void take_fitted(Scenario& scenario, bool names_are_known, Findings& findings);

}  // namespace drycut::sim::scenario
