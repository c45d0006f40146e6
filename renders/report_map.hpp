#pragma once
#include <string>
#include <vector>

#include "renders/map_plot.hpp"

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

}  // namespace drycut::renders
