#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "base/problem.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

// Meshes from files, by assimp. What cannot be drawn well is refused, with a reason, before anything runs.

/// How a file's mesh becomes a part's: scaled, then turned about x, y and z in this order, then moved.
struct MeshPlacing {
  double scale = 1;         ///< on millimetres, or metres where the format says so
  Vec3 rotate = {0, 0, 0};  ///< [rad]
  Vec3 at = {0, 0, 0};      ///< from the part's own middle [m]
};

/// Why a mesh is refused and what would be right.
struct MeshProblem {
  Prose what;
  Prose remedy = "export the part again";
  Code code = "mesh.unreadable"_code;
};

constexpr std::uintmax_t mesh_bytes_max = 64ULL << 20U;
constexpr unsigned mesh_triangles_max = 200'000;
constexpr double mesh_smallest = 1e-4;  ///< longest side of a mesh [m]
constexpr double mesh_largest = 100;    ///< [m]

/// Reads a mesh file: STL, OBJ, PLY, OFF (in millimetres), glTF, GLB, DAE (in metres, as those formats say).
/// Normals are made anew: an edge sharper than 30 degrees stays sharp. Refused are files that cannot be read,
/// are of another kind, broken, empty or too large (the limits above), corners that are no finite numbers,
/// and meshes whose longest side is not within the limits. A process of its own reads the file, for at most
/// 20 s of computing and with 2 GB of memory: a file that makes the reader crash or run on is refused like
/// any other. Throws std::runtime_error if the machine has no process to give.
std::variant<Mesh, MeshProblem> load_mesh(const std::filesystem::path& file, const MeshPlacing& placing);

/// The same from the bytes of a binary STL in millimetres.
std::variant<Mesh, MeshProblem> read_stl(std::string_view bytes);

}  // namespace drycut::renders
