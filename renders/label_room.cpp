#include "renders/label_room.hpp"

#include <algorithm>

namespace drycut::renders {

std::optional<std::array<double, 2>> LabelRoom::place(const std::array<double, 2>& wanted, double width,
                                                      double height, bool aside) {
  constexpr int kFurthest = 6;
  constexpr double kStep = 1.15;  // heights: two labels do not touch
  const double half = width / 2;
  const double high = height / 2;
  if (wanted[0] < -half || wanted[0] > width_ + half || wanted[1] < -high || wanted[1] > height_ + high)
    return std::nullopt;
  const double x = std::clamp(wanted[0], half, std::max(half, width_ - half));
  const double y = std::clamp(wanted[1], high, std::max(high, height_ - high));
  const auto try_at = [&](double middle) {
    const Box box = {x - half, middle - high, x + half, middle + high};
    if (box.top < 0 || box.bottom > std::max(height_, height)) return false;
    if (std::any_of(taken_.begin(), taken_.end(), [&](const Box& other) { return box.meets(other); }))
      return false;
    take(box);
    return true;
  };
  if (!aside && try_at(y)) return {{x, y}};
  for (int steps = 1; steps <= kFurthest; ++steps)
    for (const int direction : {-1, 1})
      if (const double middle = y + direction * steps * kStep * height; try_at(middle)) return {{x, middle}};
  return std::nullopt;
}

}  // namespace drycut::renders
