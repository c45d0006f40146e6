#pragma once
#include <filesystem>
#include <string>

#include "renders/scene3d.hpp"

namespace drycut::renders {

/// The film as a binary glTF 2.0 file: a node a part, named as the part, with its mesh and material, and one
/// animation that moves them. Metres, y up. Time zero is the first frame; a key stands at every frame and
/// waypoint where a part moves, at `slow` times the time that has passed since the first one. A part that is
/// not visible has scale 0 meanwhile, one that is never seen has no node. Throws std::invalid_argument if the
/// film cannot be drawn.
std::string gltf(const Film& film, int slow = 1);

/// All parts of the film as such a file, where they are in the first frame, seen there or not; none moves.
std::string gltf_of_parts(const Film& film);

/// Writes gltf() to a file. Throws std::runtime_error if it cannot be written.
void write_gltf(const Film& film, const std::filesystem::path& file, int slow = 1);

}  // namespace drycut::renders
