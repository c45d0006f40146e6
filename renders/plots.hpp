#pragma once
#include <drycut/problem.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drycut::renders {

struct Curve {
  enum class Style { line, steps, points, area };  ///< area: a line, filled down to 0
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
  Style style = Style::line;
  bool faint = false;  ///< pale: what lies behind the curves that matter
};

/// A horizontal limit or band drawn behind the curves.
struct Band {
  std::string label;  ///< "tolerance ±0.1 mm"
  double low = 0;
  double high = 0;  ///< equal to `low`: a single limit line
};

/// A vertical line through all panels of a plot; its label, above the first panel, tells what begins there.
struct Mark {
  double x = 0;
  std::string label;
  bool strong = false;  ///< drawn to catch the eye: a fault, a limit
};

/// A stretch of x, shaded behind all panels of a plot.
struct Zone {
  double from = 0;
  double to = 0;
  bool strong = false;  ///< in a colour of its own; of the others every second one is shaded
};

/// Another scale of the same x axis, drawn below the first: the time of a master that runs evenly.
struct SecondScale {
  std::string label;  ///< with unit: "time [s]"
  double factor = 1;  ///< of a unit of x, above 0
};

/// A state over time as a timing diagram shows it: high and low if it is only ever 0 or 1, else a labelled
/// band for each value.
struct Lane {
  std::string label;
  std::vector<double> x;  ///< ascending
  std::vector<double> y;  ///< the state from there to the next x
};

/// A named point of a panel: a dot with its label beside it.
struct NamedPoint {
  std::string label;
  double x = 0;
  double y = 0;
};

/// One pair of axes.
struct Panel {
  Prose title;
  std::string y_label;  ///< with unit: "following error [counts]"
  std::vector<Curve> curves;
  std::vector<Band> bands;
  std::optional<std::pair<double, double>> y_range;  ///< automatic if absent
  std::vector<NamedPoint> points = {};
  bool equal_scale = false;      ///< a unit is as long in x as in y, for a path in a plane; y_range may grow
  std::vector<Lane> lanes = {};  ///< instead of all the above: from the top, on the plot's x axis
};

/// Panels above each other that share the x axis: one PNG.
struct Plot {
  std::string name;  ///< file name without extension
  Prose title;
  std::string x_label;  ///< with unit: "time [s]"
  std::vector<Panel> panels;
  int width = 1200;              ///< pixels
  int panel_height = 300;        ///< pixels
  std::vector<Mark> marks = {};  ///< in ascending order of x
  std::vector<Zone> zones = {};  ///< in ascending order of x
  std::optional<SecondScale> second_x = {};
  bool log_x = false;  ///< decades of x are as wide as each other; all x above 0
};

/// Draws the plots into `directory` as <name>.png and returns the paths. Throws std::invalid_argument if a
/// plot cannot be drawn, std::runtime_error if a file cannot be written. Same data, same bytes.
std::vector<std::filesystem::path> draw_plots(const std::vector<Plot>& plots,
                                              const std::filesystem::path& directory);

}  // namespace drycut::renders
