#pragma once
#include <string>
#include <utility>
#include <vector>

#include "renders/axes.hpp"
#include "renders/plots.hpp"
#include "renders/png_image.hpp"

namespace drycut::renders {

// Where everything of a plot goes, in pixels from the upper left corner.

/// Sizes of type in a plot [pixels].
struct PlotType {
  static constexpr double title = 20;
  static constexpr double panel_title = 16;
  static constexpr double text = 15;
  static constexpr double mark = 13;
};

/// One entry of a legend: sample and label. It stands for a curve, or for a band.
struct LegendEntry {
  bool band = false;
  std::size_t index = 0;  ///< of the curve or band in its panel
  std::string label;
  double left = 0;      ///< of the sample
  double baseline = 0;  ///< middle of the text's height
};

struct PanelLayout {
  double top = 0, bottom = 0;  ///< of the axes
  double title_y = 0;          ///< middle of the title's height
  Range y_range = {0, 1};
  std::vector<Tick> y_ticks;
  std::vector<LegendEntry> legend;
};

/// A mark's label: upright in a strip above the first panel, or across where the labels would touch.
struct MarkLayout {
  std::string label;  ///< "" = no room for it
  double line = 0;    ///< of the mark
  double text = 0;    ///< left end of an upright label, middle of one that stands across
  bool strong = false;
};

struct PlotLayout {
  int width = 0, height = 0;
  double left = 0, right = 0;  ///< of all axes
  Range x_range = {0, 1};
  std::vector<Tick> x_ticks;
  std::vector<Tick> second_ticks;  ///< of the second scale; values in x
  std::vector<PanelLayout> panels;
  std::vector<MarkLayout> marks;  ///< those inside x_range
  bool marks_across = false;
  double marks_bottom = 0;  ///< of the strip of labels
};

/// Below the last panel: how much the second scale adds, and from the picture's bottom to its ticks and
/// numbers [pixels].
inline constexpr double kSecondScale = 46;
inline constexpr double kSecondTicks = 52;
inline constexpr double kSecondNumbers = 40;
/// Length of a legend's sample and its distance from the label [pixels].
inline constexpr double kLegendSample = 34;
inline constexpr double kLegendGap = 7;
/// Between a label that stands across and the first panel: room for the line that leads to its mark.
inline constexpr double kMarkLeader = 14;

/// Ranges, ticks, margins and legends. With log_x the plot's x are logarithms already. Axes without points go
/// from 0 to 1.
PlotLayout laid_out(const Plot& plot);

/// The picture of a plot. With log_x the plot's x are logarithms already. Same plot, same bytes.
Image painted(const Plot& plot, const PlotLayout& layout);

}  // namespace drycut::renders
