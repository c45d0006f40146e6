#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::scenario {

/// Gives every value of the tree with ${name} in it what it comes to, by the section `variables`, whose own
/// values are arithmetic too. A value that is arithmetic alone becomes a quantity, an expression with names
/// in it (a check) gets the variables' quantities, and in any other text they stand as they are written.
/// Unknown names, cycles and units that do not fit are problems where they stand; so is a value that measures
/// something else than the variable's first one. Returns where each that is used stands.
std::map<std::string, std::vector<ScenePlace>> resolve_variables(YamlNode& root, Findings& findings);

/// The same for a table in plain numbers (registers, a cam): every cell with ${name} in it is computed and
/// must be a number. A cell keeps its width, so that what stands behind it keeps its column.
std::string with_variables(std::string_view table, const std::vector<VariableEntry>& variables,
                           const std::string& file, Problems& problems);

/// Variables that neither the scenario nor a file of its controller uses, as notes.
std::vector<Finding> unused_variables(const Scenario& scenario);
/// One of them that looks like a slip for a variable of what the scenario extends is a problem.
void refuse_slips(const Scenario& scenario, Findings& findings);

}  // namespace drycut::sim::scenario
