#pragma once
#include <cstddef>
#include <functional>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::scenario {

/// Gives the variable that value, as if the file had it.
void put_on_trial(YamlNode& root, const Trial& trial);

/// A slip in `variables` makes problems wherever the variable is used. Of those from `first` on, which are
/// the scenario's, the ones that another value takes away (with a unit, of another dimension, without the
/// minus) are told once, where the variable stands. `again`: the problems that the scenario has on trial.
/// Does nothing on a trial.
void blame_variables(const Scenario& scenario, Problems& problems, std::size_t first,
                     const std::function<Problems(const Trial&)>& again);

}  // namespace drycut::sim::scenario
