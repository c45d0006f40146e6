#pragma once
#include "renders/gltf_track.hpp"

namespace drycut::renders {

/// Where a part with that track is at `time_s`: straight between two keys, turning evenly the short way;
/// before the first key and behind the last one as there. The track has a key.
Placement placement_at(const Track& track, double time_s);

/// The track with no more keys than a picture needs: places within 0.1 mm of what they were, turns within
/// 0.1 degree, scales within 0.0001; from key to key nothing turns by more than 120 degrees.
Track thinned(const Track& track);

}  // namespace drycut::renders
