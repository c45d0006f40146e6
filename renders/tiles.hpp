#pragma once
#include <vector>

#include "renders/png_image.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// What a camera has of a picture [pixels from the upper left corner].
struct Tile {
  int left = 0, top = 0;
  int width = 0, height = 0;
  bool operator==(const Tile&) const = default;
};

/// A picture of that size split among one to four cameras, with a gap between: two side by side; of three
/// the first has the left half; four have a quarter each.
std::vector<Tile> tiles_of(std::size_t cameras, int width, int height);
/// The tiles of the film's cameras above its caption, in their order.
std::vector<Tile> tiles_of(const Film& film);

/// Puts the upper left part of a picture, as large as the tile, where the tile is.
void paste(const Image& part, const Tile& tile, Image& image);

}  // namespace drycut::renders
