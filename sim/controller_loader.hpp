#pragma once
#include <memory>

#include "devices/controller.hpp"
#include "devices/problem.hpp"
#include "sim/scenario.hpp"

namespace drycut::sim {

/// The controller that the scenario names, with its programs read and compiled and its values set; nullptr if
/// there is none or it has problems, which are told in `problems` by the program's own file, line and column.
std::unique_ptr<devices::Controller> load_controller(const Scenario& scenario, devices::Problems& problems);

}  // namespace drycut::sim
