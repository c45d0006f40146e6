#pragma once
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

#include "renders/decimate.hpp"
#include "renders/gnuplot.hpp"
#include "renders/plot_layout.hpp"

namespace drycut::renders {

/// A plot's script as it grows; converts pixels from the upper left corner to gnuplot's screen coordinates.
class Script {
 public:
  explicit Script(const PlotLayout& layout) : layout_(layout) {}

  template <typename... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  std::string at(double x, double y) const {
    return fmt::format("screen {:.6f}, screen {:.6f}", x / layout_.width, 1 - y / layout_.height);
  }
  double screen_x(double x) const { return x / layout_.width; }
  double screen_y(double y) const { return 1 - y / layout_.height; }

  void text(double x, double y, const std::string& words, const char* placing, double size, bool bold = false,
            const char* colour = "#1f2933") {
    line("set label {} at {} {} front textcolor rgb '{}' font 'DejaVu Sans{},{:.2f}'", gnuplot_string(words),
         at(x, y), placing, colour, bold ? ":Bold" : "", points(size));
  }

  /// Font sizes are in points for gnuplot, which takes 96 dots an inch.
  static double points(double pixels) { return pixels * 0.75; }

  const std::string& str() const { return text_; }

 private:
  const PlotLayout& layout_;
  std::string text_;
};

/// A data block of that name; what is not finite interrupts the curve.
void write_points(Script& script, const std::string& name, const Points& points);

/// Writes the data of the lanes of panel number `index`; returns what to plot.
std::string write_lanes(Script& script, const Panel& panel, const PlotLayout& layout, std::size_t index);
/// The names of states in their bands, and lines between the lanes.
void write_lane_labels(Script& script, const Panel& panel, const PlotLayout& layout, std::size_t index);

}  // namespace drycut::renders
