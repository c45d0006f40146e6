#include "renders/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/problem.hpp"
#include "renders/geometry.hpp"
#include "renders/mesh.hpp"
#include "renders/process.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr float smooth_up_to = 30;  // [deg]
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

/// assimp's words for what is wrong, on one line.
std::string in_a_line(std::string text) {
  if (const auto end = text.find_first_of("\r\n"); end != std::string::npos) text.resize(end);
  return text;
}

MeshProblem unreadable(const std::string& why) {
  return {fmt::format("the mesh cannot be read: {}", why), "export the part again, as STL or OBJ"};
}

MeshProblem broken(const Assimp::Importer& importer) {
  return unreadable(one_line(in_a_line(importer.GetErrorString())));
}

MeshProblem nowhere(std::size_t corner) {
  return {fmt::format("corner {} is not at a finite place", corner + 1)};
}

std::uint64_t triangles_in(const aiMesh& mesh) {
  std::uint64_t triangles = 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f)
    triangles += mesh.mFaces[f].mNumIndices < 3 ? 0 : mesh.mFaces[f].mNumIndices - 2;
  return triangles;
}

/// Triangles that the nodes show: one mesh may be shown by many.
std::uint64_t triangles_shown(const aiScene& scene) {
  std::vector<std::uint64_t> of_mesh;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) of_mesh.push_back(triangles_in(*scene.mMeshes[m]));
  std::uint64_t triangles = 0;
  std::vector<const aiNode*> open = {scene.mRootNode};
  while (!open.empty()) {
    const aiNode& node = *open.back();
    open.pop_back();
    for (unsigned m = 0; m < node.mNumMeshes; ++m) triangles += of_mesh.at(node.mMeshes[m]);
    open.insert(open.end(), node.mChildren, node.mChildren + node.mNumChildren);
  }
  return triangles;
}

std::optional<MeshProblem> refused_scene(const aiScene& scene) {
  const MeshProblem empty = {"the mesh has no triangles", "export a surface, not points, curves or a sketch"};
  if ((scene.mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0 || scene.mNumMeshes == 0) return empty;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return nowhere(v);
    }
  }
  const std::uint64_t triangles = triangles_shown(scene);
  if (triangles == 0) return empty;
  if (triangles > mesh_triangles_max)
    return MeshProblem{fmt::format("the mesh has {} triangles, more than {}", triangles, mesh_triangles_max),
                       "export it with a coarser tolerance", "mesh.too-large"_code};
  return std::nullopt;
}

/// The triangles of a scene in metres, scaled, turned and moved.
Mesh placed(const aiScene& scene, double unit, const MeshPlacing& placing) {
  const double scale = unit * placing.scale;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // about x, y and z in this order
  for (int axis = 0; axis < 3; ++axis)
    turn = Eigen::AngleAxisd(placing.rotate[axis], Vec3::Unit(axis)) * turn;
  Mesh all;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;
      for (unsigned c = 0; c < 3; ++c) {
        const unsigned index = mesh.mFaces[f].mIndices[c];
        const aiVector3D& p = mesh.mVertices[index];
        const aiVector3D& n = mesh.mNormals[index];
        all.corners.push_back({as_floats(turn * (scale * Vec3(p.x, p.y, p.z)) + placing.at),
                               as_floats(turn * Vec3(n.x, n.y, n.z))});
      }
    }
  }
  return all;
}

/// A mesh may name files beside it. Of those only what is a file is opened: a FIFO would be waited for.
class FilesOnly : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }
  bool Exists(const char* file) const override {
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored);
  }
};

void choose_settings(Assimp::Importer& importer) {
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, smooth_up_to);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyBool(AI_CONFIG_PP_FD_REMOVE, true);
  // Its limit of area is a fixed number, whatever the unit.
  importer.SetPropertyBool(AI_CONFIG_PP_FD_CHECKAREA, false);
}

using Loaded = std::variant<Mesh, MeshProblem>;

/// What assimp makes of a file: the corners.
Loaded corners_of(Assimp::Importer& importer, const aiScene* scene, double unit, const MeshPlacing& placing) {
  if (scene == nullptr) return broken(importer);
  if (auto problem = refused_scene(*scene)) return *problem;
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_FindDegenerates |
                                       aiProcess_SortByPType | aiProcess_PreTransformVertices |
                                       aiProcess_GenSmoothNormals | aiProcess_ForceGenNormals);
  if (scene == nullptr) return broken(importer);
  Mesh mesh = placed(*scene, unit, placing);
  if (mesh.corners.empty()) return MeshProblem{"all triangles of the mesh are without area"};
  return mesh;
}

/// `loaded` with its hull, or what is wrong with its size.
Loaded judged(Loaded loaded, double unit) {
  if (std::holds_alternative<MeshProblem>(loaded)) return loaded;
  auto& mesh = std::get<Mesh>(loaded);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const auto& p = mesh.corners[i].position;
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return nowhere(i);
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

std::string packed(const Loaded& loaded) {
  if (const auto* problem = std::get_if<MeshProblem>(&loaded))
    return fmt::format("p{0}{3}{1}{3}{2}", problem->code.text(), problem->what, problem->remedy, '\0');
  const auto& corners = std::get<Mesh>(loaded).corners;
  std::string bytes = "m";
  return bytes.append(reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(Mesh::Corner));
}

Loaded unpacked(std::string_view bytes) {
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
  const auto read = [&] {
    Assimp::Importer importer;
    choose_settings(importer);
    importer.SetIOHandler(std::make_unique<FilesOnly>().release());  // the importer's from here on
    return packed(corners_of(importer, importer.ReadFile(file.string(), aiProcess_ValidateDataStructure),
                             unit, placing));
  };
  try {
    return judged(unpacked(run_apart(read, reading_limits)), unit);
  } catch (const WorkFailed& failed) {
    return unreadable(fmt::format("the attempt {}", failed.what()));
  }
}

std::variant<Mesh, MeshProblem> read_stl(std::string_view bytes) {
  Assimp::Importer importer;
  choose_settings(importer);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "stl");
  return judged(corners_of(importer, scene, millimetre, {}), millimetre);
}

}  // namespace drycut::renders
