#pragma once
#include <filesystem>

#include "renders/scene3d.hpp"

namespace drycut::renders {

/// Writes the film as a binary glTF 2.0 file: a node a part, named as the part, with its mesh and material,
/// and one animation that moves them. Metres, y up. Time zero is the first frame; a key stands at every frame
/// and waypoint where a part moves, at `slow` times the time that has passed since the first one. A part that
/// is not visible has scale 0 meanwhile, one that is never seen has no node. Throws std::invalid_argument if
/// the film cannot be drawn, std::runtime_error if the file cannot be written.
void write_gltf(const Film& film, const std::filesystem::path& file, int slow = 1);

}  // namespace drycut::renders
