#pragma once
#include <string>
#include <vector>

#include "renders/gltf_track.hpp"

namespace drycut::renders {

/// A machine that a page shows in 3-D, at any time of a stretch of its run.
struct MachineView {
  std::string machine;             ///< all its parts as a .glb, see gltf_of_parts()
  std::vector<std::string> parts;  ///< their names
  std::vector<Track> tracks;       ///< one a part, in time since the begin of the run [s]
  double from_s = 0;
  double until_s = 0;
  double recorded_until_s = 0;  ///< later than `until_s` if the rest would be too much for a page
};

/// The film as such a view: no more keys than a picture needs, see thinned(), and `most_keys` altogether;
/// what comes later is left out. Throws std::invalid_argument if the film cannot be drawn or has no frames.
MachineView machine_view(const Film& film, std::size_t most_keys = 300'000);

/// The figure in a page where the view is to be.
std::string view_figure(const MachineView& view);

/// What the end of a page needs to show it: three.js from the folder where its package (libjs-three) puts it,
/// the machine, its motion and the scripts. Without three.js, and where all that would take more than
/// `most_bytes`, a line that says so.
std::string live_view(const MachineView& view, const std::string& folder = "/usr/share/javascript/three",
                      std::size_t most_bytes = 24U << 20U);

}  // namespace drycut::renders
