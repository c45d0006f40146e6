#pragma once
#include <cairo.h>

#include <vector>

#include "renders/axes.hpp"
#include "renders/label_room.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// The film's live curves in the lower right corner of the picture of the machine. Each curve has a scale of
/// its own, the same over the whole film, and says its present value.
class LivePlot {
 public:
  /// `film` must outlive it.
  explicit LivePlot(const Film& film);

  /// What they cover in a picture `height` pixels high; empty if there are none.
  Box box(int height) const;
  /// Draws the curves up to `now` [s] into a picture as wide as the film and `height` pixels high.
  void draw(cairo_t* pen, double now, int height) const;

 private:
  const Film& film_;
  std::vector<Range> ranges_;  ///< lowest and highest value of each curve
};

}  // namespace drycut::renders
