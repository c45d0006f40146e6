#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/file.hpp"
#include "sim/fmi/model_description.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::fmi {

/// What was written.
struct WrittenFmu {
  std::size_t inputs = 0;
  std::size_t outputs = 0;
  std::size_t parameters = 0;
  std::vector<std::string> files = {};  ///< of the user, that it carries whole
  std::string own_licence = {};         ///< a sentence on Drycut's own library in it
};

/// Writes the machine of a scenario, all its plants without the controller, as an FMU for co-simulation of
/// 64-bit Linux; the same scenario gives the same bytes. The scenario must have no problems. Throws
/// std::exception if it cannot be written.
WrittenFmu write_machine(const scenario::Scenario& scenario, Standard standard,
                         const std::filesystem::path& out);

/// The same of the line with its controller; `files`: all that was read for it.
WrittenFmu write_line(const scenario::Scenario& scenario, const FileSet& files, Standard standard,
                      const std::filesystem::path& out);

}  // namespace drycut::sim::fmi
