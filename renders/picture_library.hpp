#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "renders/mesh_file.hpp"

namespace drycut::renders {

struct Image;
struct Stage;

/// Draws the parts, placed one by one, as the camera sees them, into the upper part of the image.
using DrawParts = std::function<void(const std::vector<Placement>&, const Camera&, Image&)>;

/// Corners and normals of a mesh, without its hull.
using MeshRead = std::variant<Mesh, MeshProblem>;

inline MeshProblem unreadable(std::string_view why) {
  return {fmt::format("the mesh cannot be read: {}", why), "export the part again, as STL or OBJ"};
}
inline MeshProblem corner_nowhere(std::size_t corner) {
  return {fmt::format("corner {} is not at a finite place", corner + 1)};
}

/// What needs OpenGL or assimp, all of it in renders/loaded/: a library of its own, which is loaded when the
/// first picture or mesh is asked for.
struct PictureLibrary {
  std::string (*assimp_version)();
  /// Of a file of a known kind, whose unit is so long [m], or of the bytes of an STL.
  MeshRead (*read_file)(const std::filesystem::path& file, double unit, const MeshPlacing& placing);
  MeshRead (*read_stl)(std::string_view bytes, double unit);
  std::string (*glb)(const Film& film, int slow);  ///< of a film that can be drawn: gltf()
  /// By a GlRenderer of its own; `stage` must outlive it. Throws as GlRenderer does.
  DrawParts (*drawer)(const Stage& stage);
};

/// Throws std::runtime_error if a package that it stands on is missing.
const PictureLibrary& picture_library();

}  // namespace drycut::renders
