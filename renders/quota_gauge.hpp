#pragma once
#include <cairo.h>

#include "renders/label_room.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// How far off its quota the machine is, which is far too little to be seen on it, on a scale of its own: the
/// band of the tolerance in the middle, four tolerances to either end; what lies beyond is shown there. Its
/// place, in the upper right corner of what the first camera sees [pixels of a frame].
Box gauge_box(const Film& film);
void draw_gauge(cairo_t* pen, const Film& film, const DrawnQuota& quota);

}  // namespace drycut::renders
