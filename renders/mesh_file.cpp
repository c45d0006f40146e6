#include "renders/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/problem.hpp"
#include "renders/mesh.hpp"
#include "renders/picture_library.hpp"
#include "renders/process.hpp"

namespace drycut::renders {
namespace {

constexpr double millimetre = 1e-3;

/// Kinds of files, and how long their unit is [m].
struct MeshKind {
  std::string_view extension;
  double unit;
};
constexpr std::array<MeshKind, 7> kinds = {{{".stl", millimetre},
                                            {".obj", millimetre},
                                            {".ply", millimetre},
                                            {".off", millimetre},
                                            {".gltf", 1},
                                            {".glb", 1},
                                            {".dae", 1}}};

const MeshKind* kind_of(const std::filesystem::path& file) {
  auto extension = file.extension().string();
  for (auto& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto* const found = std::find_if(kinds.begin(), kinds.end(),
                                         [&](const MeshKind& kind) { return kind.extension == extension; });
  return found == kinds.end() ? nullptr : found;
}

std::optional<MeshProblem> refused_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    return MeshProblem{"there is no such file", "name a mesh file relative to the scenario",
                       "mesh.no-file"_code};
  if (kind_of(file) == nullptr)
    return MeshProblem{fmt::format("'{}' is not a kind of mesh that is known", file.extension().string()),
                       "export STL, OBJ, PLY, OFF, glTF, GLB or DAE from the CAD program",
                       "mesh.unknown-kind"_code};
  const auto size = std::filesystem::file_size(file, error);
  if (error) return MeshProblem{"its size cannot be found out", "name a file that can be read"};
  if (size == 0) return MeshProblem{"the file is empty"};
  if (size > mesh_bytes_max)
    return MeshProblem{fmt::format("the file has {} MB, more than {}", size >> 20U, mesh_bytes_max >> 20U),
                       "export it with a coarser tolerance", "mesh.too-large"_code};
  return std::nullopt;
}

/// `loaded` with its hull, or what is wrong with its size.
MeshRead judged(MeshRead loaded, double unit) {
  if (std::holds_alternative<MeshProblem>(loaded)) return loaded;
  auto& mesh = std::get<Mesh>(loaded);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const auto& p = mesh.corners[i].position;
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return corner_nowhere(i);
  }
  find_hull(mesh);
  const double longest = extent_of(mesh).sizes().maxCoeff();
  if (!(longest >= mesh_smallest && longest <= mesh_largest))
    return MeshProblem{
        fmt::format("its longest side is {:.4g} mm; parts have {} to {} mm", longest / millimetre,
                    mesh_smallest / millimetre, mesh_largest / millimetre),
        unit == 1 ? "the file is taken in metres; set scale" : "the file is taken in millimetres; set scale",
        "mesh.scale"_code};
  return loaded;
}

// A file's mesh on its way from the process that reads it: 'm' and the corners, or 'p' and the problem's
// code and two texts with a 0 between.

constexpr std::size_t triangle_bytes = 3 * sizeof(Mesh::Corner);
static_assert(std::is_trivially_copyable_v<Mesh::Corner>);

/// Files of the largest size that is taken need a quarter of this.
constexpr WorkLimits reading_limits = {std::chrono::seconds(20), std::chrono::minutes(2), 2ULL << 30U,
                                       1 + mesh_triangles_max* triangle_bytes};

std::string packed(const MeshRead& loaded) {
  if (const auto* problem = std::get_if<MeshProblem>(&loaded))
    return fmt::format("p{0}{3}{1}{3}{2}", problem->code.text(), problem->what, problem->remedy, '\0');
  const auto& corners = std::get<Mesh>(loaded).corners;
  std::string bytes = "m";
  return bytes.append(reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(Mesh::Corner));
}

MeshRead unpacked(std::string_view bytes) {
  const auto rest = bytes.substr(std::min<std::size_t>(1, bytes.size()));
  if (bytes.starts_with('p')) {
    const auto first = std::min(rest.find('\0'), rest.size());
    const auto second = std::min(rest.find('\0', first + 1), rest.size());
    if (const auto code = CodeTable::named(rest.substr(0, first)); code && second < rest.size())
      return MeshProblem{std::string(rest.substr(first + 1, second - first - 1)),
                         std::string(rest.substr(second + 1)), *code};
  }
  if (!bytes.starts_with('m') || rest.empty() || rest.size() % triangle_bytes != 0)
    throw WorkFailed("answered nonsense");
  Mesh mesh;
  mesh.corners.resize(rest.size() / sizeof(Mesh::Corner));
  std::memcpy(mesh.corners.data(), rest.data(), rest.size());
  return mesh;
}

}  // namespace

std::variant<Mesh, MeshProblem> load_mesh(const std::filesystem::path& file, const MeshPlacing& placing) {
  if (auto problem = refused_file(file)) return *problem;
  const double unit = kind_of(file)->unit;
  const auto& library = picture_library();
  const auto read = [&] { return packed(library.read_file(file, unit, placing)); };
  try {
    return judged(unpacked(run_apart(read, reading_limits)), unit);
  } catch (const WorkFailed& failed) {
    return unreadable(fmt::format("the attempt {}", failed.what()));
  }
}

std::variant<Mesh, MeshProblem> read_stl(std::string_view bytes) {
  return judged(picture_library().read_stl(bytes, millimetre), millimetre);
}

}  // namespace drycut::renders
