#pragma once
#include <string>
#include <string_view>

#include "sim/fmi/machine/resolved.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::fmi {

/// Version of drycut, and the sum of the library that builds it again: what an FMU's resources begin with.
std::string made_by(std::string_view binary);

/// The machine of a scenario: its plants, with every parameter in force, made for `binary`, the library that
/// builds it again.
ResolvedMachine resolve(const scenario::Scenario& scenario, std::string_view binary);

}  // namespace drycut::sim::fmi
