#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "plants/guest.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// The definition of a plant that is a foreign FMU; nullptr of another plant.
const plants::GuestDefinition* guest_of(const scenario::PlantEntry& plant);

/// A problem where the FMU of `plant` stands in the scenario.
Problem problem_of_guest(Code code, const scenario::Scenario& scenario, const scenario::PlantEntry& plant,
                         const std::string& what, const std::string& remedy);

/// True if one of them ended the run: it crashed, hung, or refused to go on.
bool has_failed_guest(const std::vector<std::unique_ptr<plants::Plant>>& plants);

/// What the report says of each foreign FMU: that it is a guest, and how it steps.
std::vector<Finding> notes_of_guests(const scenario::Scenario& scenario);

/// A problem for each foreign FMU that cannot keep its state, before moments of the line are kept.
/// `otherwise`: what goes without them: "run it without --states".
void refuse_guests_without_state(const scenario::Scenario& scenario, std::string_view otherwise,
                                 Problems& problems);

}  // namespace drycut::sim::loop
