#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "renders/report.hpp"
#include "sim/output_folder.hpp"

namespace drycut::sim {

/// Draws `plots` into plots/ of `folder` and adds their pictures to the report. No two share a file: a later
/// one with a name that is taken gets another. Without gnuplot they have no pictures; returns what is left
/// out and why, "" = nothing, and says so in the report. Throws std::runtime_error if something cannot be
/// written.
std::string add_plots(std::vector<renders::Plot>& plots, OutputFolder& folder, renders::Report& report);

/// Draws one plot as the file `png`. Returns what is left out because gnuplot is missing, "" = nothing.
std::string draw_png(renders::Plot plot, const std::filesystem::path& png);

}  // namespace drycut::sim
