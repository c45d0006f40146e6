#pragma once

namespace drycut {

/// What a picture of the machine may be wide and high [pixels]: below, caption and machine have no room;
/// above, a frame takes gigabytes. Scenarios refuse the rest at their line, before anything runs; the
/// renderer draws all of it.
inline constexpr int smallest_picture = 160;
inline constexpr int largest_picture = 4096;

}  // namespace drycut
