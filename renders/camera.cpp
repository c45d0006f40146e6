#include "renders/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renders/caption_bar.hpp"
#include "renders/pictures.hpp"

namespace drycut::renders {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr Vec3 kFromOperator = {-0.42, 0.40, 1.0};  ///< towards the eye: upstream, above, operator's side
constexpr double kBorder = 0.1;                     ///< around the mechanism, in its longest side
constexpr double kPictureUsed = 0.95;               ///< share of the picture that the mechanism may fill

bool is_empty(const Extent& e) { return e.low[0] > e.high[0]; }

double longest_side(const SolidPart& part, const Placement& placement) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, part.size[i] * placement.scale[i]);
  return longest;
}

/// What a part does over the film.
struct Course {
  bool seen = false;
  bool always = true;
  bool product = false;  ///< of web material: what the machine works on
  double length = 0;     ///< longest side, at its longest [m]
  Extent swept = kNothing;
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
      all[i].length = std::max(all[i].length, longest_side(film.parts[i], placement));
      for (const Vec3& point : outline(film.parts[i], placement)) include(all[i].swept, point);
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

/// The part of `extent` that lies within `limit`, added to `sum`.
void include_within(Extent& sum, const Extent& extent, const Extent& limit) {
  Extent common;
  for (std::size_t i = 0; i < 3; ++i) {
    common.low[i] = std::max(extent.low[i], limit.low[i]);
    common.high[i] = std::min(extent.high[i], limit.high[i]);
    if (common.low[i] > common.high[i]) return;
  }
  include(sum, common.low);
  include(sum, common.high);
}

Extent grown(const Extent& extent, double border) {
  const Vec3 step = {border, border, border};
  return {extent.low - step, extent.high + step};
}

}  // namespace

void include(Extent& extent, const Vec3& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    extent.low[i] = std::min(extent.low[i], point[i]);
    extent.high[i] = std::max(extent.high[i], point[i]);
  }
}

Vec3 placed(const Placement& placement, const Vec3& point) {
  const auto& scale = placement.scale;
  return placement.position +
         rotated(placement.rotation, {point[0] * scale[0], point[1] * scale[1], point[2] * scale[2]});
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

  Extent mechanism = kNothing;
  Extent everything = kNothing;
  for (const Course& course : all) {
    if (!course.seen) continue;
    include(everything, course.swept.low);
    include(everything, course.swept.high);
    if (!belongs_to_machine(course) || course.length > limit) continue;
    include(mechanism, course.swept.low);
    include(mechanism, course.swept.high);
  }
  if (is_empty(everything)) return {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  if (is_empty(mechanism)) return everything;

  const Vec3 size = mechanism.high - mechanism.low;
  const Extent surroundings = grown(mechanism, kBorder * *std::max_element(size.begin(), size.end()));
  Extent shown = mechanism;
  for (const Course& course : all) {
    if (course.seen) include_within(shown, course.swept, surroundings);
  }
  return shown;
}

double floor_level(const Film& film) {
  double level = kFar;
  for (const Course& course : courses(film)) {
    if (course.seen) level = std::min(level, course.swept.low[1]);
  }
  return std::isfinite(level) ? level : -0.5;
}

Camera camera_of(const Film& film, std::size_t frame) {
  Camera camera = film.camera;
  if (!film.follow) return camera;
  const Vec3 way = film.frames[frame].placements[*film.follow].position -
                   film.frames.front().placements[*film.follow].position;
  camera.eye = camera.eye + way;
  camera.target = camera.target + way;
  return camera;
}

Matrix4 view_projection(const Camera& camera, double aspect, const Extent& extent) {
  const double radius = length(extent.high - extent.low) / 2;
  const double distance = length((0.5 * (extent.low + extent.high)) - camera.eye);
  const double near = std::max(0.02 * radius, 0.25 * (distance - radius));
  const double far = distance + 60 * radius;
  return multiplied(perspective(camera.field_of_view_deg * std::numbers::pi / 180, aspect, near, far),
                    look_at(camera.eye, camera.target));
}

std::array<double, 2> projected(const Camera& camera, int width, int height, const Vec3& point) {
  const Matrix4 m = multiplied(perspective(camera.field_of_view_deg * std::numbers::pi / 180,
                                           static_cast<double>(width) / height, 0.1, 10),
                               look_at(camera.eye, camera.target));
  const auto row = [&](std::size_t r) {
    return m[r] * point[0] + m[4 + r] * point[1] + m[8 + r] * point[2] + m[12 + r];
  };
  return {(row(0) / row(3) + 1) / 2 * width, (1 - row(1) / row(3)) / 2 * height};
}

Camera operator_camera(const Film& film) {
  Camera camera;
  const Extent extent = mechanism_extent(film);
  const Vec3 forward = normalised(-1.0 * kFromOperator);
  const Vec3 right = normalised(cross(forward, {0, 1, 0}));
  const Vec3 up = cross(right, forward);

  const int view_height = film.height - CaptionLayout(film).height();
  const double tan_up = std::tan(camera.field_of_view_deg * std::numbers::pi / 360) * kPictureUsed;
  const double tan_right = tan_up * film.width / std::max(1, view_height);

  // A point is in the picture if |its offset sideways| <= tangent * its depth: each picture edge is a plane
  // through the eye, so the nearest eye that sees all points comes from four extremes.
  double left = kFar, low = kFar, rightmost = -kFar, high = -kFar;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point = {(corner & 1) != 0 ? extent.high[0] : extent.low[0],
                        (corner & 2) != 0 ? extent.high[1] : extent.low[1],
                        (corner & 4) != 0 ? extent.high[2] : extent.low[2]};
    const double depth = dot(point, forward);
    left = std::min(left, dot(point, right) + tan_right * depth);
    rightmost = std::max(rightmost, dot(point, right) - tan_right * depth);
    low = std::min(low, dot(point, up) + tan_up * depth);
    high = std::max(high, dot(point, up) - tan_up * depth);
  }
  const double depth_of_eye = std::min((left - rightmost) / (2 * tan_right), (low - high) / (2 * tan_up));
  camera.eye = ((left + rightmost) / 2) * right + ((low + high) / 2) * up + depth_of_eye * forward;

  const double depth_of_centre = dot(0.5 * (extent.low + extent.high), forward);
  camera.target = camera.eye + (depth_of_centre - depth_of_eye) * forward;
  return camera;
}

}  // namespace drycut::renders
