#include "renders/gltf_track.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

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

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double place_off = 1e-4;        // [m]
constexpr double turn_off = 0.1;          // [deg]
constexpr double scale_off = 1e-4;        // times
constexpr double furthest_turn = 120;     // [deg], from key to key
constexpr std::size_t most_skipped = 40;  // keys in a row: so long it is worth looking

Eigen::Quaterniond turn_of(const Placement& placement) { return Eigen::Quaterniond(placement.rotation); }

Placement between(const TrackKey& a, const TrackKey& b, double time_s) {
  const double stretch = b.time_s - a.time_s;
  const double share = stretch > 0 ? (time_s - a.time_s) / stretch : 1;
  const auto& [from, to] = std::pair<const Placement&, const Placement&>(a.placement, b.placement);
  Placement made;
  made.position = from.position + share * (to.position - from.position);
  made.rotation = turn_of(from).slerp(share, turn_of(to)).coeffs();
  made.scale = from.scale + share * (to.scale - from.scale);
  made.visible = made.scale != Vec3::Zero();
  return made;
}

bool near(const Placement& a, const Placement& b) {
  return (a.position - b.position).norm() <= place_off && (a.scale - b.scale).norm() <= scale_off &&
         turn_of(a).angularDistance(turn_of(b)) <= turn_off * degree;
}

/// Whether the keys between `from` and `to` can be told from these two.
bool tells(const Track& track, std::size_t from, std::size_t to) {
  for (auto k = from + 1; k < to; ++k)
    if (!near(between(track[from], track[to], track[k].time_s), track[k].placement)) return false;
  return true;
}

}  // namespace

Placement placement_at(const Track& track, double time_s) {
  const auto after = std::upper_bound(track.begin(), track.end(), time_s,
                                      [](double at, const TrackKey& key) { return at < key.time_s; });
  if (after == track.begin()) return track.front().placement;
  if (after == track.end()) return track.back().placement;
  return between(*(after - 1), *after, time_s);
}

Track thinned(const Track& track) {
  Track few;
  if (track.empty()) return few;
  std::size_t from = 0;
  few.push_back(track.front());
  while (from + 1 < track.size()) {
    auto to = from + 1;
    double turned = turn_of(track[from].placement).angularDistance(turn_of(track[to].placement));
    while (to + 1 < track.size() && to - from < most_skipped) {
      turned += turn_of(track[to].placement).angularDistance(turn_of(track[to + 1].placement));
      if (turned > furthest_turn * degree || !tells(track, from, to + 1)) break;
      ++to;
    }
    few.push_back(track[to]);
    from = to;
  }
  return few;
}

}  // namespace drycut::renders
