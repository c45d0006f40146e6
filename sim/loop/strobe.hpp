#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/loop/shutter.hpp"

namespace drycut::sim::loop {

// The stroboscopic effect: what turns by more than half of its pitch from frame to frame, as a drum with
// blades, seems to turn slower, backwards or not at all.

/// A part that looks the same again after `pitch` [rad].
struct PartWithPitch {
  std::string name;  ///< "knife.drum"
  double pitch = 0;
};

/// A part that does so in a frame.
struct Strobe {
  std::string part;
  double pitches = 0;  ///< that it turned by since the frame before, more than a half
};

/// For each frame the part that turned furthest in its pitches, if by more than half of one. `parts`: those
/// with a pitch, in the order of the frames' `turned`.
std::vector<std::optional<Strobe>> strobes(const std::vector<PartWithPitch>& parts,
                                           const std::vector<Snapshot>& frames);
/// The worst of all frames.
std::optional<Strobe> worst_strobe(const std::vector<std::optional<Strobe>>& frames);

/// What to tell of it, with the `frames.every` at which the part turns by a quarter of its pitch at most.
std::string text_of(const Strobe& strobe, const scenario::PicturesSection& pictures, Time step);

}  // namespace drycut::sim::loop
