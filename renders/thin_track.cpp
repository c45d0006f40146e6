#include "renders/thin_track.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace drycut::renders {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double place_off = 1e-4;        // [m]
constexpr double turn_off = 0.1;          // [deg]
constexpr double scale_off = 1e-4;        // times
constexpr double furthest_turn = 120;     // [deg], from key to key
constexpr std::size_t most_skipped = 40;  // keys in a row: so long it is worth looking

Eigen::Quaterniond turn_of(const Placement& placement) { return Eigen::Quaterniond(placement.rotation); }

Placement between(const Key& a, const Key& b, double time_s) {
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
                                      [](double at, const Key& key) { return at < key.time_s; });
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
