#include "renders/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renders/pictures.hpp"
#include "renders/tiles.hpp"

namespace drycut::renders {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
const Vec3 kFromOperator = {-0.42, 0.40, 1.0};  ///< towards the eye: upstream, above, operator's side
constexpr double kBorder = 0.1;                 ///< around the mechanism, in its longest side
constexpr double kPictureUsed = 0.95;           ///< share of the picture that the mechanism may fill

/// What a part does over the film.
struct Course {
  bool seen = false;
  bool always = true;
  bool product = false;  ///< of web material: what the machine works on
  double length = 0;     ///< longest side, at its longest [m]
  Extent swept;
};

bool belongs_to_machine(const Course& course) { return course.seen && course.always && !course.product; }

std::vector<Course> courses(const Film& film) {
  std::vector<Course> all(film.parts.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i].product = film.parts[i].material == "web";
  for (const Frame& frame : film.frames) {
    const std::size_t count = std::min(frame.placements.size(), all.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Placement& placement = frame.placements[i];
      if (!placement.visible) {
        all[i].always = false;
        continue;
      }
      all[i].seen = true;
      all[i].length = std::max(all[i].length, film.parts[i].size.cwiseProduct(placement.scale).maxCoeff());
      for (const Vec3& point : outline(film.parts[i], placement)) all[i].swept.extend(point);
    }
  }
  return all;
}

double median_length(const std::vector<Course>& all) {
  std::vector<double> lengths;
  for (const Course& course : all) {
    if (belongs_to_machine(course)) lengths.push_back(course.length);
  }
  if (lengths.empty()) return 0;
  std::sort(lengths.begin(), lengths.end());
  return lengths[lengths.size() / 2];
}

}  // namespace

Vec3 placed(const Placement& placement, const Vec3& point) {
  return placement.position + rotation_of(placement.rotation) * placement.scale.cwiseProduct(point);
}

std::vector<Vec3> outline(const SolidPart& part, const Placement& placement) {
  std::vector<Vec3> points;
  if (part.mesh) {
    for (const Vec3& corner : part.mesh->hull) points.push_back(placed(placement, corner));
    return points;
  }
  const Vec3 half = 0.5 * part.size;
  const auto add = [&](double x, double y) {
    for (const double z : {-half[2], half[2]})
      points.push_back(placed(placement, {x * half[0], y * half[1], z}));
  };
  if (part.shape == SolidPart::Shape::cylinder) {
    constexpr int kRim = 16;
    for (int i = 0; i < kRim; ++i) {
      const double angle = 2 * std::numbers::pi * i / kRim;
      add(std::cos(angle), std::sin(angle));
    }
  } else if (part.shape == SolidPart::Shape::wedge) {
    add(-1, 1);
    add(1, 1);
    add(0, -1);
  } else {
    add(-1, -1);
    add(1, -1);
    add(-1, 1);
    add(1, 1);
  }
  return points;
}

Extent mechanism_extent(const Film& film) {
  const std::vector<Course> all = courses(film);
  const double limit = 3 * median_length(all);

  Extent mechanism;
  Extent everything;
  for (const Course& course : all) {
    everything.extend(course.swept);
    if (belongs_to_machine(course) && course.length <= limit) mechanism.extend(course.swept);
  }
  if (everything.isEmpty()) return {Vec3::Constant(-0.5), Vec3::Constant(0.5)};
  if (mechanism.isEmpty()) return everything;

  const Vec3 border = Vec3::Constant(kBorder * mechanism.sizes().maxCoeff());
  const Extent surroundings(mechanism.min() - border, mechanism.max() + border);
  Extent shown = mechanism;
  for (const Course& course : all) {
    const Extent common = course.swept.intersection(surroundings);
    if (!common.isEmpty()) shown.extend(common);
  }
  return shown;
}

double floor_level(const Film& film) {
  double level = kFar;
  for (const Course& course : courses(film)) {
    if (course.seen) level = std::min(level, course.swept.min().y());
  }
  return std::isfinite(level) ? level : -0.5;
}

Camera camera_of(const Film& film, std::size_t frame, std::size_t view) {
  if (view > 0) return film.beside[view - 1].camera;
  Camera camera = film.camera;
  if (!film.follow) return camera;
  const Vec3 way = film.frames[frame].placements[*film.follow].position -
                   film.frames.front().placements[*film.follow].position;
  camera.eye += way;
  camera.target += way;
  return camera;
}

Matrix4 view_projection(const Camera& camera, double aspect, const Extent& extent) {
  const double radius = extent.diagonal().norm() / 2;
  const double distance = (extent.center() - camera.eye).norm();
  const double near = std::max(0.02 * radius, 0.25 * (distance - radius));
  const double far = distance + 60 * radius;
  return perspective(camera.field_of_view_deg * std::numbers::pi / 180, aspect, near, far) *
         look_at(camera.eye, camera.target);
}

std::array<double, 2> projected(const Camera& camera, int width, int height, const Vec3& point) {
  const Vec4 seen = perspective(camera.field_of_view_deg * std::numbers::pi / 180,
                                static_cast<double>(width) / height, 0.1, 10) *
                    look_at(camera.eye, camera.target) * point.homogeneous();
  return {(seen.x() / seen.w() + 1) / 2 * width, (1 - seen.y() / seen.w()) / 2 * height};
}

Camera operator_camera(const Film& film, std::size_t view) {
  Camera camera;
  const Extent extent = mechanism_extent(film);
  const Vec3 forward = -kFromOperator.normalized();
  const Vec3 right = forward.cross(Vec3::UnitY()).normalized();
  const Vec3 up = right.cross(forward);

  const Tile tile = tiles_of(film).at(view);
  const double tan_up = std::tan(camera.field_of_view_deg * std::numbers::pi / 360) * kPictureUsed;
  const double tan_right = tan_up * tile.width / tile.height;

  // A point is in the picture if |its offset sideways| <= tangent * its depth: each picture edge is a plane
  // through the eye, so the nearest eye that sees all points comes from four extremes.
  double left = kFar, low = kFar, rightmost = -kFar, high = -kFar;
  for (const Vec3& point : corners_of(extent)) {
    const double depth = point.dot(forward);
    left = std::min(left, point.dot(right) + tan_right * depth);
    rightmost = std::max(rightmost, point.dot(right) - tan_right * depth);
    low = std::min(low, point.dot(up) + tan_up * depth);
    high = std::max(high, point.dot(up) - tan_up * depth);
  }
  const double depth_of_eye = std::min((left - rightmost) / (2 * tan_right), (low - high) / (2 * tan_up));
  camera.eye = ((left + rightmost) / 2) * right + ((low + high) / 2) * up + depth_of_eye * forward;

  const double depth_of_centre = extent.center().dot(forward);
  camera.target = camera.eye + (depth_of_centre - depth_of_eye) * forward;
  return camera;
}

}  // namespace drycut::renders
