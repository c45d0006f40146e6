#pragma once
#include <vector>

#include "renders/scene3d.hpp"

namespace drycut::renders {

/// Where a part is at a time of an animation, which goes straight from one key to the next.
struct TrackKey {
  double time_s = 0;    ///< from the first frame, at the film's pace
  Placement placement;  ///< scale 0 = not visible; rotation of unit length
};
/// At least one key; only one for a part that stays where it is.
using Track = std::vector<TrackKey>;

/// The keys of part number `part` over the film, which must have frames: a key a frame and a waypoint, at
/// `slow` times the time that has passed since the first frame. Rotations turn the short way; stretches
/// without change keep only their first and last key. A part that comes or goes does so in a thousandth of
/// the time between two of them.
Track track_of(const Film& film, std::size_t part, int slow);

/// Where a part with that track is at `time_s`: straight between two keys, turning evenly the short way;
/// before the first key and behind the last one as there. The track has a key.
Placement placement_at(const Track& track, double time_s);

/// The track with no more keys than a picture needs: places within 0.1 mm of what they were, turns within
/// 0.1 degree, scales within 0.0001; from key to key nothing turns by more than 120 degrees.
Track thinned(const Track& track);

}  // namespace drycut::renders
