#pragma once
#include <optional>
#include <string>
#include <vector>

#include "devices/plcopen/tab_file.hpp"
#include "sim/controllers/kinds.hpp"
#include "sim/studies/design/scene.hpp"

// How the files of a scene's controller are read for a cam.
namespace drycut::sim::studies {

/// A group of each match, line by line.
std::vector<std::string> found_in(const std::string& text, const std::string& pattern, std::size_t group = 1);
/// A file's text, "" after a problem.
std::string content_of(const scenario::Text& file, const scenario::Scenario& scene, Problems& problems);
/// The one table of a PLCopen controller, with the scene's values in it; nothing if there is not one.
std::optional<devices::plcopen::CamFile> present_table(const scenario::Scenario& scene, Problems& problems);

}  // namespace drycut::sim::studies
