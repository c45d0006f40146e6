#pragma once
#include <cairo.h>

#include "renders/scene3d.hpp"

namespace drycut::renders {

/// Draws the film's live curves up to `now` [s] into the lower right corner of a picture of that size. Each
/// curve has a scale of its own, the same over the whole film, and says its present value.
void draw_live_plot(cairo_t* pen, const Film& film, double now, int width, int height);

}  // namespace drycut::renders
