#pragma once
#include <drycut/problem.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "renders/axes.hpp"

namespace drycut::renders {

/// One quantity that a map lies over.
struct MapAxis {
  std::string label;           ///< with unit: "length [mm]"
  std::vector<double> values;  ///< ascending, two or more
};

/// What a point of a map belongs to.
struct MapRegion {
  std::string label;  ///< "passed", "fails: rms torque"
  /// A round dot, a square one in a colour of its own, a grey cross: there is no verdict.
  enum class Kind { good, bad, none } kind = Kind::bad;
};

/// Lines of equal value over a map. A level whose line is in pieces all over is noise and not drawn; where
/// none is left, the legend says so.
struct MapLines {
  std::string label;           ///< with unit: "rms torque [N m]"
  std::vector<double> values;  ///< a number a point; not a number where there is none
  /// Empty: some between the least and the greatest value, in steps of 1, 2 or 5.
  std::vector<double> levels = {};
};

/// A border that is known from elsewhere: a closed form, an envelope.
struct MapCurve {
  std::string label;
  std::vector<std::pair<double, double>> points;
};

/// Two quantities against each other: a dot for every point of the grid, coloured by what it belongs to, with
/// lines of equal value over them. What lies between the points stays white, and the axes end at the
/// outermost points. Points are in rows of y, each with a point for each x.
struct MapPlot {
  std::string name;  ///< file name without extension
  Prose title;
  MapAxis x;
  MapAxis y;
  std::vector<MapRegion> regions;
  std::vector<std::size_t> region;  ///< of each point
  /// In the legend: the marks between a good point and a bad one beside it. "": there are none.
  std::string bound = {};
  std::vector<MapLines> lines = {};
  std::vector<MapCurve> curves = {};
  int width = 1200;  ///< pixels, with the legend on the right
  int height = 700;
};

/// Where the axes of its picture are [pixels].
PlotArea map_area(const MapPlot& map);

/// Draws the map into `directory` as <name>.png. Throws std::invalid_argument if it cannot be drawn,
/// std::runtime_error if the file cannot be written. Same data, same bytes.
std::filesystem::path draw_map(const MapPlot& map, const std::filesystem::path& directory);

}  // namespace drycut::renders
