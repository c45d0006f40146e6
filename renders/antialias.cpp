#include "renders/antialias.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

namespace drycut::renders {
namespace {

constexpr std::uint8_t kFaintest = 10;  ///< contrast of an edge that one sees, of 255
constexpr int kRelative = 3;            ///< and at least 1 / 2^3 of the brighter side
constexpr int kReach = 16;              ///< a stair is looked at so far to each side [pixels]
constexpr double kSinglePixels = 0.5;   ///< how much dots and thin lines are softened

/// Brightness of the picture, a byte a pixel.
struct Brightness {
  int width;
  std::vector<std::uint8_t> values;
  const std::uint8_t* at(int x, int y) const {
    return values.data() + static_cast<std::ptrdiff_t>(y) * width + x;
  }
};

Brightness brightness_of(const Image& image, int rows) {
  Brightness b{image.width, {}};
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(rows);
  b.values.resize(count);
  const std::uint8_t* rgb = image.rgb.data();
  for (std::size_t i = 0; i < count; ++i)
    b.values[i] =
        static_cast<std::uint8_t>((77 * rgb[3 * i] + 150 * rgb[3 * i + 1] + 29 * rgb[3 * i + 2]) >> 8);
  return b;
}

/// The side on which a pixel's edge is and how much of the neighbour there shows in it, 0..1.
struct Overlap {
  int toward;  ///< step in memory to the neighbour [pixels]
  double share;
};

/// How far the edge between the pixel and its neighbour `toward` goes on in direction `along` [pixels], and
/// whether the brightness rises where it ends.
struct End {
  int distance;
  bool found;  ///< it ends there; else it goes on out of reach or out of the picture
  bool brighter;
};
End end_of(const std::uint8_t* pixel, int toward, int along, int room, int edge, int tolerance) {
  int difference = 0;
  int distance = 0;
  do {
    ++distance;
    const std::uint8_t* p = pixel + static_cast<std::ptrdiff_t>(distance) * along;
    difference = p[0] + p[toward] - edge;
  } while (distance < std::min(kReach, room) && std::abs(difference) < tolerance);
  return {distance, std::abs(difference) >= tolerance, difference >= 0};
}

Overlap overlap_of(const Brightness& b, int x, int y, int rows) {
  const std::uint8_t* p = b.at(x, y);
  const int w = b.width;
  const int m = p[0], n = p[-w], s = p[w], e = p[1], west = p[-1];
  const int ne = p[1 - w], nw = p[-1 - w], se = p[1 + w], sw = p[-1 + w];
  const int across_rows =
      2 * std::abs(n + s - 2 * m) + std::abs(ne + se - 2 * e) + std::abs(nw + sw - 2 * west);
  const int across_columns =
      2 * std::abs(e + west - 2 * m) + std::abs(ne + nw - 2 * n) + std::abs(se + sw - 2 * s);
  const bool level = across_rows >= across_columns;  // the edge runs along a row

  const int before = level ? -w : -1;
  const int after = level ? w : 1;
  const int toward = std::abs(p[after] - m) >= std::abs(p[before] - m) ? after : before;
  const int step = std::abs(p[toward] - m);
  const int edge = m + p[toward];               // twice the mean, as what it is compared with
  const int tolerance = std::max(1, step / 2);  // twice a quarter of the step
  const int along = level ? 1 : w;
  const int place = level ? x : y;
  const int last = (level ? w : rows) - 1;
  const End forward = end_of(p, toward, along, last - place, edge, tolerance);
  const End backward = end_of(p, toward, -along, place, edge, tolerance);
  const End& nearer = forward.distance <= backward.distance ? forward : backward;
  const bool brighter = 2 * m >= edge;
  const double stair =
      !nearer.found || nearer.brighter == brighter
          ? 0.0
          : 0.5 - static_cast<double>(nearer.distance) / (forward.distance + backward.distance);

  const int darkest = std::min({m, n, s, e, west});
  const int brightest = std::max({m, n, s, e, west});
  const double around = (2.0 * (n + s + e + west) + ne + nw + se + sw) / 12;
  double dot = std::min(1.0, std::abs(around - m) / (brightest - darkest));
  dot = dot * dot * (3 - 2 * dot);
  return {toward, std::max(stair, kSinglePixels * dot * dot)};
}

std::uint8_t darker(std::uint8_t a, std::uint8_t b) { return a < b ? a : b; }
std::uint8_t brighter(std::uint8_t a, std::uint8_t b) { return a < b ? b : a; }

/// Marks those of a row's pixels, but for the outermost two, that have an edge. Nearly all have none, and
/// vectors of bytes find that out: no branches, nothing wider than a byte.
void mark_edges(const std::uint8_t* row, int width, std::uint8_t* edge) {
  for (int x = 1; x + 1 < width; ++x) {
    const std::uint8_t* q = row + x;
    const std::uint8_t darkest = darker(darker(darker(q[0], q[-width]), darker(q[width], q[-1])), q[1]);
    const std::uint8_t brightest =
        brighter(brighter(brighter(q[0], q[-width]), brighter(q[width], q[-1])), q[1]);
    const auto least = brighter(kFaintest, static_cast<std::uint8_t>(brightest >> kRelative));
    edge[x] = static_cast<std::uint8_t>(brightest - darkest) > least ? 1 : 0;
  }
}

/// True if none of the next pixels has an edge.
bool none_of_eight(const std::uint8_t* edge) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, edge, sizeof eight);
  return eight == 0;
}

}  // namespace

void antialias(Image& image, int rows) {
  if (rows < 3 || image.width < 3) return;
  const Brightness b = brightness_of(image, rows);
  const int w = image.width;
  // Rows as they were: the one above and this one.
  const std::size_t bytes = static_cast<std::size_t>(w) * 3;
  std::vector<std::uint8_t> above(image.row(0), image.row(0) + bytes);
  std::vector<std::uint8_t> own(bytes);
  std::vector<std::uint8_t> edge(static_cast<std::size_t>(w));
  for (int y = 1; y + 1 < rows; ++y, std::swap(above, own)) {
    std::copy_n(image.row(y), bytes, own.data());
    mark_edges(b.at(0, y), w, edge.data());
    for (int x = 1; x + 1 < w; ++x) {
      if (x + 8 < w && none_of_eight(edge.data() + x)) {
        x += 7;
        continue;
      }
      if (edge[static_cast<std::size_t>(x)] == 0) continue;
      const Overlap overlap = overlap_of(b, x, y, rows);
      const int share = static_cast<int>(overlap.share * 256);
      const std::uint8_t* self = own.data() + 3 * x;
      const std::uint8_t* other = overlap.toward == -w  ? above.data() + 3 * x
                                  : overlap.toward == w ? image.row(y + 1) + 3 * x
                                                        : self + 3 * overlap.toward;
      std::uint8_t* to = image.row(y) + 3 * x;
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>(((256 - share) * self[c] + share * other[c] + 128) >> 8);
    }
  }
}

}  // namespace drycut::renders
