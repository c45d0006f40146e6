#include "renders/gltf_track.hpp"

namespace drycut::renders {
namespace {

constexpr double blink = 1e-3;  ///< in which a part appears or goes, in times between two keys
const Vec3 nothing = Vec3::Zero();

/// The rotation of unit length, with the sign that is nearer to `before`.
Vec4 beside(const Vec4& before, const Vec4& rotation) {
  return rotation.dot(before) < 0 ? -rotation.normalized() : rotation.normalized();
}

bool same(const Placement& a, const Placement& b) {
  return a.position == b.position && a.rotation == b.rotation && a.scale == b.scale;
}

}  // namespace

Track track_of(const Film& film, std::size_t part, int slow) {
  Track track;
  const auto add = [&](double time_s, const Placement& placement) {
    const auto size = track.size();
    const bool still =
        size > 1 && same(track[size - 1].placement, placement) && same(track[size - 2].placement, placement);
    if (still)
      track.back().time_s = time_s;
    else
      track.push_back({time_s, placement});
  };
  double last_s = 0;
  Placement last;
  const auto go_on = [&](double at_s, Placement now) {
    const double time_s = (at_s - film.frames.front().time_s) * slow;
    if (!now.visible) {
      now = last;
      now.visible = false;
      now.scale = nothing;
    }
    now.rotation = beside(last.rotation, now.rotation);
    if (!track.empty() && now.visible != last.visible) {
      // Until just before it stays as it was; what appears does so in its new place.
      Placement until = now.visible ? now : last;
      until.scale = last.visible ? last.scale : nothing;
      add(time_s - blink * (time_s - last_s), until);
    }
    add(time_s, now);
    last = now;
    last_s = time_s;
  };
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    const Frame& frame = film.frames[i];
    for (const Waypoint& way : frame.before)
      if (i > 0 && way.part == part) go_on(way.time_s, way.placement);
    go_on(frame.time_s, frame.placements[part]);
  }
  if (track.size() == 2 && same(track[0].placement, track[1].placement)) track.pop_back();
  return track;
}

}  // namespace drycut::renders
