#include "renders/tiles.hpp"

#include <algorithm>
#include <stdexcept>

#include "renders/caption_bar.hpp"

namespace drycut::renders {

std::vector<Tile> tiles_of(std::size_t cameras, int width, int height) {
  constexpr int kGap = 2;
  const Tile whole = {0, 0, width, height};
  const int left = (width - kGap) / 2;
  const int upper = (height - kGap) / 2;
  const auto cut = [&](bool right, bool low, bool is_high) {
    return Tile{right ? left + kGap : 0, low ? upper + kGap : 0, right ? width - left - kGap : left,
                is_high ? height
                : low   ? height - upper - kGap
                        : upper};
  };
  switch (cameras) {
    case 1:
      return {whole};
    case 2:
      return {cut(false, false, true), cut(true, false, true)};
    case 3:
      return {cut(false, false, true), cut(true, false, false), cut(true, true, false)};
    case 4:
      return {cut(false, false, false), cut(true, false, false), cut(false, true, false),
              cut(true, true, false)};
    default:
      throw std::invalid_argument("pictures: one to four cameras share a picture");
  }
}

std::vector<Tile> tiles_of(const Film& film) {
  return tiles_of(1 + film.beside.size(), film.width,
                  std::max(1, film.height - CaptionLayout(film).height()));
}

void paste(const Image& part, const Tile& tile, Image& image) {
  for (int y = 0; y < tile.height; ++y)
    std::copy_n(part.row(y), 3 * tile.width, image.row(tile.top + y) + 3 * tile.left);
}

}  // namespace drycut::renders
