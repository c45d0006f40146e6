#pragma once
#include <cairo.h>

#include <memory>
#include <string>

#include "renders/png_image.hpp"

namespace drycut::renders {

// Between our pictures and cairo's.

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Cairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// An empty RGB24 surface. Throws std::runtime_error if cairo refuses the size.
CairoSurface cairo_surface(int width, int height);
/// The upper `height` rows of the image.
CairoSurface cairo_surface_of(const Image& image, int height);
/// Copies the first `rows` rows of the surface, which is as wide as the image, to `first_row` and below.
void copy_rows(cairo_surface_t* from, int rows, Image& image, int first_row);

/// A pen for the surface that writes DejaVu Sans without hinting: widths are proportional to the font size
/// and the same on every machine.
Cairo cairo_pen(cairo_surface_t* surface);

/// Width of a line as the pen writes it [pixels].
double text_width(cairo_t* pen, const std::string& text);
/// `text`, or its beginning and an ellipsis, no wider than `room` [pixels].
std::string fitted_text(cairo_t* pen, std::string text, double room);

/// Size [pixels] and weight of what is written and measured from now on.
void set_font(cairo_t* pen, double size, bool bold = false);
/// A line of words that begins at `x`.
void write_text(cairo_t* pen, double x, double baseline, const std::string& words);
void fill_box(cairo_t* pen, double left, double top, double width, double height);

/// How large letters and lines are: 1 for a picture 540 pixels high.
double picture_scale(int height);

/// A colour, each from 0 to 1.
struct Ink {
  double red, green, blue;
};
/// 0xrrggbb
constexpr Ink ink(unsigned rgb) {
  return {(rgb >> 16U & 255U) / 255.0, (rgb >> 8U & 255U) / 255.0, (rgb & 255U) / 255.0};
}
/// What words in a film stand on.
constexpr Ink kGround = {0.105, 0.125, 0.150};
void set_ink(cairo_t* pen, const Ink& ink, double opacity = 1);

}  // namespace drycut::renders
