#pragma once
#include <string>
#include <vector>

#include "renders/map_plot.hpp"
#include "renders/plots.hpp"

namespace drycut::renders {

/// A map in a report, with what each of its points says where a script runs: under the pointer, or where the
/// arrow keys have gone.
struct ReportMap {
  MapPlot map;
  std::filesystem::path png;  ///< the map as it was drawn
  std::string caption;
  std::vector<std::string> headings;            ///< of what is told: "length [mm]", "verdict", ...
  std::vector<std::vector<std::string>> cells;  ///< a row a point, in the map's order
  std::string
      command;  ///< repeats a point; {0} stands for its first cell, {1} for the next; none where one is empty
};

/// The figure of a page; `number` tells its maps apart.
std::string map_figure(const ReportMap& map, std::size_t number);
/// What the end of a page needs to make its maps tell their points; "" without maps.
std::string live_maps(const std::vector<ReportMap>& maps);

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
