#include "renders/quota_gauge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "renders/cairo_image.hpp"
#include "renders/tiles.hpp"

namespace drycut::renders {
namespace {

constexpr double kReach = 4;  ///< tolerances from the middle to an end
constexpr Ink kIn = {0.25, 0.88, 0.35};
constexpr Ink kOut = {1.0, 0.55, 0.15};
constexpr Ink kWords = {0.97, 0.98, 0.99};

}  // namespace

Box gauge_box(const Film& film) {
  const double scale = picture_scale(film.height);
  const double right = tiles_of(film).front().width - 10 * scale;
  return {right - 104 * scale, 10 * scale, right, 230 * scale};
}

void draw_gauge(cairo_t* pen, const Film& film, const DrawnQuota& quota) {
  const double scale = picture_scale(film.height);
  const Box box = gauge_box(film);
  set_ink(pen, kGround, 0.85);
  fill_box(pen, box.left, box.top, box.right - box.left, box.bottom - box.top);
  const double size = 12 * scale;
  set_font(pen, size);
  const auto words = [&](double x, double middle, const std::string& text, const Ink& colour) {
    set_ink(pen, colour);
    write_text(pen, x, middle + 0.36 * size, text);
  };
  const double middle = (box.top + box.bottom) / 2;
  const double half = 72 * scale;
  const double left = box.left + 12 * scale;
  const double wide = 16 * scale;
  const auto y = [&](double tolerances) { return middle - half * tolerances / kReach; };
  words(left, box.top + 1.2 * size, "from quota", kWords);
  set_ink(pen, {0.35, 0.40, 0.46});
  fill_box(pen, left, middle - half, wide, 2 * half);
  set_ink(pen, kIn, 0.75);
  fill_box(pen, left, y(1), wide, y(-1) - y(1));
  for (const double end : {1.0, -1.0})
    words(left + wide + 14 * scale, y(end) - end * 0.3 * size,
          fmt::format("{:+g} mm", end * quota.tolerance * 1e3), kWords);
  const double off = quota.miss / quota.tolerance;
  const bool in = std::abs(off) <= 1;
  const double at = y(std::clamp(off, -kReach, kReach));
  cairo_new_path(pen);
  cairo_move_to(pen, left + wide - 4 * scale, at);
  cairo_line_to(pen, left + wide + 11 * scale, at - 6 * scale);
  cairo_line_to(pen, left + wide + 11 * scale, at + 6 * scale);
  cairo_close_path(pen);
  set_ink(pen, in ? kIn : kOut);
  cairo_fill(pen);
  words(left, box.bottom - 1.2 * size, fmt::format("{:+.2f} mm", quota.miss * 1e3), in ? kIn : kOut);
}

}  // namespace drycut::renders
