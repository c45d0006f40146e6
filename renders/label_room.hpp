#pragma once
#include <array>
#include <optional>
#include <vector>

namespace drycut::renders {

/// A rectangle of a picture [pixels from the upper left corner].
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool meets(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

/// The room for words in a picture: each gets a place where it covers none that came before.
class LabelRoom {
 public:
  /// Of a picture of that size [pixels].
  LabelRoom(double width, double height) : width_(width), height_(height) {}

  void take(const Box& box) { taken_.push_back(box); }
  /// The middle of a free place for a box of that size: at `wanted`, moved into the picture if it sticks out,
  /// else as few of its heights above or below as can be, above first; at least one if it must stand `aside`.
  /// Takes it. nullopt if `wanted` is out of the picture or nothing within six heights is free.
  std::optional<std::array<double, 2>> place(const std::array<double, 2>& wanted, double width, double height,
                                             bool aside);

 private:
  double width_, height_;
  std::vector<Box> taken_;
};

}  // namespace drycut::renders
