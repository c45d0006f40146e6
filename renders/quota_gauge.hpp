#pragma once
#include <cairo.h>

#include "renders/label_room.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// The miss as a gauge in the corner shows it, for what is far too small to be seen on the machine: the band
/// of the tolerance in the middle, four tolerances to either end. Where it stands in a frame of the film
/// [pixels].
Box gauge_box(const Film& film);
/// What lies beyond an end is shown there.
void draw_gauge(cairo_t* pen, const Film& film, const Quota& quota);

}  // namespace drycut::renders
