#pragma once
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "plants/looks.hpp"
#include "plants/pose_math.hpp"

namespace drycut::plants {

inline constexpr double floor_y = -0.9;  ///< the floor under the line [m]

// The three ways in which a cylinder, whose axis is z, and a model lie otherwise.
inline const Pose along_line = about_y(std::numbers::pi / 2);     ///< their z along the line
inline const Pose against_line = about_y(-std::numbers::pi / 2);  ///< against it
inline const Pose upright = about_x(-std::numbers::pi / 2);       ///< their z upwards
inline const Pose downward = about_x(std::numbers::pi / 2);

/// "leg 1" for the side -1, "leg 2" for 1.
[[nodiscard]] inline std::string numbered(const std::string& name, double side) {
  return name + (side < 0 ? " 1" : " 2");
}

/// The same parts further down the line [m].
[[nodiscard]] inline std::vector<Part> moved_along(std::vector<Part> parts, double distance) {
  if (distance == 0) return parts;
  for (Part& part : parts) {
    if (!part.frame) {
      part.offset = at(distance, 0, 0) * part.offset;
      continue;
    }
    part.frame = [distance, frame = std::move(part.frame)] {
      PartPose now = frame();
      now.pose = at(distance, 0, 0) * now.pose;
      return now;
    };
  }
  return parts;
}

/// Collects the parts of a machine as they are put on each other. Each part is at `offset` in the frame
/// that was named last; at first that is the floor.
class Assembly {
 public:
  void on(Frame frame) { frame_ = std::move(frame); }
  /// What stands on the floor itself.
  void on_floor() { frame_ = nullptr; }

  /// Sides in x, y, z [m].
  Part& box(std::string name, const std::array<double, 3>& size, const looks::Look& look, const Pose& offset,
            const char* model = "") {
    return add(Part::Shape::box, std::move(name), size, look, offset, model);
  }
  /// Diameter and length along z [m].
  Part& rod(std::string name, double diameter, double length, const looks::Look& look, const Pose& offset,
            const char* model = "") {
    return add(Part::Shape::cylinder, std::move(name), {diameter, diameter, length}, look, offset, model);
  }
  /// A blade with its edge downwards; `tip` leaves a trail.
  Part& wedge(std::string name, const std::array<double, 3>& size, const looks::Look& look,
              const Pose& offset, const std::array<double, 3>& tip, const char* model = "") {
    Part& part = add(Part::Shape::wedge, std::move(name), size, look, offset, model);
    part.tip = tip;
    return part;
  }

  [[nodiscard]] std::vector<Part> take() { return std::move(parts_); }

 private:
  Part& add(Part::Shape shape, std::string name, const std::array<double, 3>& size, const looks::Look& look,
            const Pose& offset, const char* model) {
    parts_.push_back(
        {std::move(name), shape, size, look.colour, std::string(look.material), model, frame_, offset});
    return parts_.back();
  }

  std::vector<Part> parts_;
  Frame frame_;
};

}  // namespace drycut::plants
