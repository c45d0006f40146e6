#pragma once
#include <cairo.h>

#include <memory>

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

}  // namespace drycut::renders
