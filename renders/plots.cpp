#include "renders/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/output_file.hpp"
#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

/// The plot over log10(x), for an axis in decades.
Plot in_decades(Plot plot) {
  const auto shrink = [](double& x) { x = std::log10(x); };
  for (Panel& panel : plot.panels) {
    for (Curve& curve : panel.curves) std::for_each(curve.x.begin(), curve.x.end(), shrink);
    for (NamedPoint& point : panel.points) shrink(point.x);
    for (Lane& lane : panel.lanes) std::for_each(lane.x.begin(), lane.x.end(), shrink);
  }
  for (Mark& mark : plot.marks) shrink(mark.x);
  return plot;
}

void require_drawable(const Plot& plot) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("plot '" + one_line(plot.name) + "': " + why);
  };
  if (plot.name.empty() || plot.name.find('/') != std::string::npos || plot.name == "." ||
      plot.name == "..") {
    refuse("its name must be a file name without extension");
  }
  if (plot.panels.empty()) refuse("it has no panel");
  if (plot.width < 400 || plot.width > 10000 || plot.panel_height < 120 || plot.panel_height > 5000) {
    refuse(
        fmt::format("width {} and panel height {} cannot be drawn; 400 to 10000 and 120 to 5000 pixels can",
                    plot.width, plot.panel_height));
  }
  const auto above_zero = [](double x) { return x > 0; };
  for (const Panel& panel : plot.panels) {
    for (const Curve& curve : panel.curves) {
      if (plot.log_x && !std::all_of(curve.x.begin(), curve.x.end(), above_zero))
        refuse(fmt::format("curve '{}' has x that a logarithmic axis cannot show", one_line(curve.label)));
      if (curve.x.size() == curve.y.size()) continue;
      refuse(fmt::format("curve '{}' has {} x and {} y values", one_line(curve.label), curve.x.size(),
                         curve.y.size()));
    }
    for (const Lane& lane : panel.lanes) {
      if (lane.x.size() != lane.y.size())
        refuse(fmt::format("lane '{}' has {} x and {} states", one_line(lane.label), lane.x.size(),
                           lane.y.size()));
      if (!std::is_sorted(lane.x.begin(), lane.x.end()))
        refuse(fmt::format("lane '{}' does not run from left to right", one_line(lane.label)));
    }
    const bool ordered =
        !panel.y_range || (std::isfinite(panel.y_range->first) && std::isfinite(panel.y_range->second) &&
                           panel.y_range->first < panel.y_range->second);
    if (!ordered)
      refuse(fmt::format("panel '{}': the y range must go from low to high", one_line(panel.title)));
    for (const NamedPoint& point : panel.points) {
      if (std::isfinite(point.x) && std::isfinite(point.y)) continue;
      refuse(fmt::format("point '{}' is not at a finite place", one_line(point.label)));
    }
  }
}

}  // namespace

std::vector<std::filesystem::path> draw_plots(const std::vector<Plot>& plots,
                                              const std::filesystem::path& directory) {
  for (const Plot& plot : plots) require_drawable(plot);
  std::vector<std::filesystem::path> files;
  if (plots.empty()) return files;
  std::filesystem::create_directories(directory);
  constexpr int kEffort = 6;  // a report has many of them inside
  for (const Plot& plot : plots) {
    files.push_back(directory / (plot.name + ".png"));
    const Plot shown = plot.log_x ? in_decades(plot) : plot;
    write_file(files.back(), png_bytes(painted(shown, laid_out(shown)), kEffort));
  }
  return files;
}

}  // namespace drycut::renders
