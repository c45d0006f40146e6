#pragma once
#include <cairo.h>

#include <vector>

#include "renders/live_plot.hpp"
#include "renders/png_image.hpp"
#include "renders/scene3d.hpp"
#include "renders/tiles.hpp"

namespace drycut::renders {

/// What is written over the picture of the machine: trails of tips, lengths, forces, speeds, the quota with
/// its gauge, and the live curves in the corner. Nothing of it hides behind parts, and no words cover others.
class Overlays {
 public:
  /// For a picture whose lowest `caption_height` pixels belong to the caption. `film` must outlive it.
  Overlays(const Film& film, int caption_height);

  /// Draws what belongs to that frame of the film.
  void draw(std::size_t frame, Image& image) const;

 private:
  void draw_view(std::size_t frame, std::size_t view, cairo_t* pen) const;

  const Film& film_;
  LivePlot live_;
  int height_;               ///< of the picture of the machine [pixels]
  std::vector<Tile> tiles_;  ///< of the cameras
  double largest_ = 0;       ///< of all forces of the film [N]
  double fastest_ = 0;       ///< of all its speeds [m/s]
  bool empty_ = true;
};

}  // namespace drycut::renders
