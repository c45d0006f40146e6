#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace drycut::renders {

// What the renderer draws: plain data, filled by the simulation from recorded poses. Metres; x along the line
// in web direction, y up, z across the line towards the operator.

using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
/// Numbers of a scenario or of a plant.
inline Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// A surface of triangles in a part's own coordinates [m].
struct Mesh {
  struct Corner {
    std::array<float, 3> position;
    std::array<float, 3> normal;
  };
  std::vector<Corner> corners;  ///< three a triangle, counter-clockwise seen from outside
  std::vector<Vec3> hull;       ///< those that stand out: what a camera must see
};

struct SolidPart {
  enum class Shape { box, cylinder, wedge };  ///< cylinder axis: z; wedge: a blade, edge towards -y
  std::string name;
  Shape shape = Shape::box;
  Vec3 size = {1, 1, 1};  ///< box: x y z; cylinder: diameter, diameter, length; wedge: x y z
  std::array<float, 3> colour = {0.6F, 0.6F, 0.6F};
  std::string material = "steel";         ///< "steel", "paint", "rubber", "web", "blade"
  std::shared_ptr<const Mesh> mesh = {};  ///< drawn in place of the shape; null = none
  std::optional<Vec3> tip = {};           ///< point of it that leaves a trail [m, its own coordinates]
};

/// Where a part is in one frame.
struct Placement {
  Vec3 position = {0, 0, 0};
  Vec4 rotation = {0, 0, 0, 1};  ///< quaternion x y z w
  Vec3 scale = {1, 1, 1};
  bool visible = true;
};

/// One number of the caption bar, or a lamp.
struct CaptionItem {
  std::string label;              ///< "web.speed"
  std::string value = {};         ///< "60.0 m/min"
  std::optional<bool> lamp = {};  ///< a lamp in place of the value: on or off
};

/// Something pointed out in the picture: a length between two points, a force, or a speed.
struct DrawnCallout {
  enum class Kind { length, force, speed };
  Kind kind = Kind::length;
  std::string text;     ///< a length: "800.0 mm"; a force: what it is; a speed: what moves
  Vec3 at = {0, 0, 0};  ///< one end of the length, or where the arrow begins [m]
  Vec3 to = {0, 0, 0};  ///< the other end [m], the force [N], the speed [m/s]
};

/// Where an axis is to go: a line across it, and how far off it is.
struct DrawnQuota {
  Vec3 left = {0, 0, 0};   ///< ends of the line [m]
  Vec3 right = {0, 0, 0};  ///< the one with the words
  double place = 0;        ///< [m]
  double miss = 0;         ///< where the axis is less that [m]
  double tolerance = 0;    ///< on either side [m], > 0
};

/// A channel that runs along in the corner of the picture.
struct LiveCurve {
  std::string label;
  std::string unit;
  std::vector<double> times_s;  ///< in ascending order
  std::vector<double> values;   ///< as many
};

/// Where a part was between two frames.
struct Waypoint {
  std::size_t part = 0;
  double time_s = 0;
  Placement placement;
};

struct Frame {
  double time_s = 0;
  std::vector<Placement> placements;  ///< one a part, same order
  std::vector<Waypoint> before = {};  ///< since the frame before, those of each part in order of time
  std::vector<CaptionItem> caption;
  std::vector<DrawnCallout> callouts;
  std::optional<DrawnQuota> quota = {};
};

struct Camera {
  Vec3 eye = {1, 1, 2};
  Vec3 target = {0, 0, 0};
  double field_of_view_deg = 35;  ///< vertical
  bool operator==(const Camera&) const = default;
};

/// One of several cameras.
struct View {
  std::string name;  ///< written into its part of the picture
  Camera camera;
};

/// A run as the renderer sees it.
struct Film {
  std::string title;
  std::vector<SolidPart> parts;
  std::vector<Frame> frames;
  Camera camera;                      ///< in the first frame, if it follows a part
  std::optional<std::size_t> follow;  ///< number of the part with which the camera goes
  std::string camera_name;            ///< written into its part of the picture, if there are others
  std::vector<View> beside;           ///< up to three cameras more, which stand: the picture is split
  bool trails = false;                ///< parts with a tip draw where it has just been
  std::vector<LiveCurve> live;        ///< drawn in the corner
  double live_window_s = 2;           ///< how much of them
  int width = 960;                    ///< pixels
  int height = 540;                   ///< pixels
};

}  // namespace drycut::renders
