#pragma once
#include <string>
#include <vector>

#include "renders/plots.hpp"

namespace drycut::renders {

/// True if a plot can be shown to zoom: curves and points that run from left to right, and lanes.
bool can_be_live(const Plot& plot);

/// The plots as JSON: "columns" of numbers in base64 (little-endian; x as 64-bit floats, y as 32-bit), each
/// written once, and "plots" that refer to them by index. Every sample of the plots is in it. Safe inside a
/// script element.
std::string plot_data(const std::vector<Plot>& plots);

/// A plot in words, for who cannot see it: "Motion: speed [m/min] of web, knife; over time [s]".
std::string plot_words(const Plot& plot);

/// What the end of a page needs to make its plots live: dygraphs, from the folder where its package
/// (libjs-dygraphs) puts it, the data and the script; without dygraphs a line that says so, "" if no plot
/// can be live.
std::string live_plots(const std::vector<Plot>& plots,
                       const std::string& folder = "/usr/share/javascript/dygraphs");

}  // namespace drycut::renders
