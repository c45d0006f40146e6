#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::controllers {

/// Reads the text of a program that stands under `key` of a controller, "qmove.tasks". What cannot be read,
/// or by its ending belongs under another key, is a problem at its name.
std::optional<std::string> read_program(std::string_view key, const scenario::Text& path,
                                        const scenario::Scenario& scenario, Problems& problems);

}  // namespace drycut::sim::controllers
