#pragma once
#include "sim/fmi/machine/resolved.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::fmi {

/// The machine of a scenario: its plants, with every parameter in force, made for `binary`, the library that
/// builds it again.
ResolvedMachine resolve(const scenario::Scenario& scenario, std::string_view binary);

}  // namespace drycut::sim::fmi
