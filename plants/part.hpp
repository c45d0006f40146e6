#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace drycut::plants {

/// A rigid pose in the world [m], quaternion x y z w. World axes: x along the line in web direction, y up,
/// z across the line towards the operator.
struct Pose {
  std::array<double, 3> position = {0, 0, 0};
  std::array<double, 4> rotation = {0, 0, 0, 1};
};

/// Where a part is now. Parts that come and go (cut pieces) are of a fixed set and hidden while unused.
struct PartPose {
  PartPose(const Pose& where = {}, bool shown = true, const std::array<double, 3>& stretch = {1, 1, 1})
      : pose(where), visible(shown), scale(stretch) {}
  Pose pose;
  bool visible;
  std::array<double, 3> scale;  ///< of the part along its own axes
};

/// What parts are fastened to, a carriage or a drum: tells where it is now, and whether and how stretched its
/// parts are seen. Empty: the floor, which is the world.
using Frame = std::function<PartPose()>;

/// What a machine part looks like: a primitive, or a model of scenes/meshes/ stretched to the same size. For
/// pictures only, physics never reads it.
struct Part {
  enum class Shape { box, cylinder, wedge };  ///< cylinder axis: z; wedge: a blade, edge towards -y
  std::string name;                           ///< unique in its plant: "drum", "blade 1"
  Shape shape = Shape::box;
  std::array<double, 3> size = {1, 1,
                                1};  ///< box: x y z; cylinder: diameter, diameter, length; wedge: x y z [m]
  std::array<float, 3> colour = {0.6F, 0.6F, 0.6F};
  std::string material = "steel";  ///< "steel", "paint", "rubber", "web", "blade"
  std::string model = {};          ///< drawn in place of the shape: "servo_motor"; "" = none
  Frame frame = {};
  Pose offset = {};  ///< of its middle in the frame
  std::optional<std::array<double, 3>> tip =
      {};                  ///< in its own coordinates [m]: what leaves a trail in pictures
  bool ends_kept = false;  ///< one long across the line (z) stretches its model in the middle only
  double pitch = 0;  ///< it looks the same again after this angle, as a drum after one of its blades [rad];
                     ///< 0 = a film need not show how it turns

  [[nodiscard]] PartPose now() const;
};

/// What a picture points out on the machine at this instant.
struct Callout {
  enum class Kind { length, force, speed };
  Kind kind = Kind::length;
  std::string text;  ///< a length: "800.0 mm"; a force: what it is, "cut"; a speed: what moves, "tube"
  std::array<double, 3> at = {0, 0, 0};  ///< one end of the length, or where the arrow begins [m, world]
  std::array<double, 3> to = {0, 0, 0};  ///< the other end [m, world], the force [N], the speed [m/s]
};

/// Where an axis is to go, as a picture shows it: a line across it [m, world].
struct QuotaLine {
  std::array<double, 3> left = {0, 0, 0};
  std::array<double, 3> right = {0, 0, 0};
  double miss = 0;  ///< where the axis is now less the quota [m]
};

}  // namespace drycut::plants
