#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// The controller that the scenario names, with its programs read and compiled and its values set; nullptr if
/// there is none or it has problems, which are told in `problems` by the program's own file, line and column.
/// Retentive values come from the scenario's retentive file where it names one that exists; what the scenario
/// sets itself comes after. `notes` takes what a reader should know that is no fault.
std::unique_ptr<devices::Controller> load_controller(const scenario::Scenario& scenario, Problems& problems,
                                                     std::vector<Finding>* notes = nullptr);

/// The files that the controller is made of, as the scenario names them.
std::vector<scenario::Text> controller_files(const scenario::Scenario& scenario);

/// The file that keeps the controller's retentive values from run to run, if the scenario names one.
std::optional<std::filesystem::path> retentive_file(const scenario::Scenario& scenario);
/// Writes it at the end of a run, where the scenario names one. Throws std::runtime_error.
void keep_retentive(const scenario::Scenario& scenario, const std::string& state);

}  // namespace drycut::sim::loop
