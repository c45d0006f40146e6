#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "renders/scene3d.hpp"

namespace drycut::renders {

/// Throws std::invalid_argument if the film cannot be drawn: sizes, materials, poses that are not finite.
void require_drawable(const Film& film);

/// Draws every frame of `film` to `directory`/frame_00000.png ... and returns the paths. `progress` is called
/// with the number of frames done, by one thread at a time. Same film, same bytes on the same machine,
/// whatever the number of `threads` that draw. Throws std::runtime_error if the context cannot be made or a
/// file not written, std::invalid_argument if the film cannot be drawn (sizes, materials, poses that are not
/// finite).
std::vector<std::filesystem::path> draw_film(const Film& film, const std::filesystem::path& directory,
                                             const std::function<void(int)>& progress = {}, int threads = 1);

/// The names of the files that draw_film makes.
std::vector<std::string> frame_names(const Film& film);

/// A camera that sees all `placements` of `parts` of the film's frames in the part of the picture that its
/// camera of this number has: from the operator's side, slightly above and upstream.
Camera operator_camera(const Film& film, std::size_t view = 0);

}  // namespace drycut::renders
