#pragma once
#include <cairo.h>

#include <string>

#include "renders/palette.hpp"

namespace drycut::renders {

// The look of plots and maps on white paper.

inline constexpr double kGridWidth = 1;  ///< [pixels]
inline constexpr double kTickLength = 5;

enum class Align { left, middle, right };

/// Where a thin line along an axis is one row of pixels and not two pale ones.
double crisp(double place);
/// `words` in one line, or their beginning and an ellipsis, no wider than `room` [pixels].
std::string fitted(const std::string& words, double size, double room, bool bold = false);

/// Ink on paper: words, lines, boxes [pixels from the upper left corner].
class Paper {
 public:
  explicit Paper(cairo_t* pen) : pen_(pen) {}
  [[nodiscard]] cairo_t* pen() const { return pen_; }

  /// White all over.
  void blank() const;
  /// Words of one line, the middle of their height at `y`; upwards from there if `across`.
  void text(double x, double y, const std::string& words, Align align, double size, bool bold = false,
            const Ink& colour = kText, bool across = false) const;
  /// Draws the pen's path.
  void stroke(const Ink& colour, double line_width, const Dash& dash = {}) const;
  void line(double from_x, double from_y, double to_x, double to_y, const Ink& colour, double line_width,
            const Dash& dash = {}) const;
  void box(double left, double top, double right, double bottom, const Ink& colour, double opacity = 1) const;
  void dot(double x, double y, double radius, const Ink& colour) const;
  /// What `draw` draws ends at the border of the area.
  template <typename Area, typename Draw>
  void clipped(const Area& area, const Draw& draw) const {
    cairo_save(pen_);
    cairo_rectangle(pen_, area.left, area.top, area.right - area.left, area.bottom - area.top);
    cairo_clip(pen_);
    draw();
    cairo_restore(pen_);
  }

 private:
  cairo_t* pen_;
};

}  // namespace drycut::renders
