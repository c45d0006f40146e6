#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "sim/scenario/scenario.hpp"

namespace drycut::sim {

/// A scenario for a program that runs it itself: `set` as with --set, and nothing is drawn. Throws BadInput
/// with every problem.
scenario::Scenario read_for_program(const std::filesystem::path& file,
                                    const std::map<std::string, std::string>& set);

}  // namespace drycut::sim
