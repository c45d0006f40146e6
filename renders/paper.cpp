#include "renders/paper.hpp"

#include <cmath>
#include <numbers>

#include "renders/text.hpp"

namespace drycut::renders {

double crisp(double place) { return std::floor(place) + 0.5; }

std::string fitted(const std::string& words, double size, double room, bool bold) {
  return fitted_text(one_line(words), size, room, bold);
}

void Paper::blank() const {
  set_ink(pen_, kPaper);
  cairo_paint(pen_);
}

void Paper::text(double x, double y, const std::string& words, Align align, double size, bool bold,
                 const Ink& colour, bool across) const {
  set_font(pen_, size, bold);
  set_ink(pen_, colour);
  cairo_save(pen_);
  cairo_translate(pen_, x, y);
  if (across) cairo_rotate(pen_, -std::numbers::pi / 2);
  const double before = align == Align::left ? 0 : align == Align::middle ? 0.5 : 1;
  write_text(pen_, before > 0 ? -before * text_width(pen_, words) : 0, 0.36 * size, words);
  cairo_restore(pen_);
}

void Paper::stroke(const Ink& colour, double line_width, const Dash& dash) const {
  set_ink(pen_, colour);
  cairo_set_line_width(pen_, line_width);
  cairo_set_line_join(pen_, CAIRO_LINE_JOIN_ROUND);  // a peak of one sample has no tip of its own
  cairo_set_dash(pen_, dash.data(), static_cast<int>(dash.size()), 0);
  cairo_stroke(pen_);
}

void Paper::line(double from_x, double from_y, double to_x, double to_y, const Ink& colour, double line_width,
                 const Dash& dash) const {
  cairo_new_path(pen_);
  cairo_move_to(pen_, from_x, from_y);
  cairo_line_to(pen_, to_x, to_y);
  stroke(colour, line_width, dash);
}

void Paper::box(double left, double top, double right, double bottom, const Ink& colour,
                double opacity) const {
  set_ink(pen_, colour, opacity);
  fill_box(pen_, left, top, right - left, bottom - top);
}

void Paper::dot(double x, double y, double radius, const Ink& colour) const {
  set_ink(pen_, colour);
  cairo_new_path(pen_);
  cairo_arc(pen_, x, y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(pen_);
}

}  // namespace drycut::renders
