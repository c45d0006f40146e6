#include "renders/loaded/faces.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "renders/geometry.hpp"
#include "renders/mesh.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr float smooth_up_to = 30;  // [deg]

/// assimp's words for what is wrong, on one line.
std::string in_a_line(std::string text) {
  if (const auto end = text.find_first_of("\r\n"); end != std::string::npos) text.resize(end);
  return text;
}

MeshProblem broken(const Assimp::Importer& importer) {
  return unreadable(one_line(in_a_line(importer.GetErrorString())));
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
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return corner_nowhere(v);
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

/// What assimp makes of a file: the corners.
MeshRead corners_of(Assimp::Importer& importer, const aiScene* scene, double unit,
                    const MeshPlacing& placing) {
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

}  // namespace

MeshRead corners_of_file(const std::filesystem::path& file, double unit, const MeshPlacing& placing) {
  Assimp::Importer importer;
  choose_settings(importer);
  importer.SetIOHandler(std::make_unique<FilesOnly>().release());  // the importer's from here on
  return corners_of(importer, importer.ReadFile(file.string(), aiProcess_ValidateDataStructure), unit,
                    placing);
}

MeshRead corners_of_stl(std::string_view bytes, double unit) {
  Assimp::Importer importer;
  choose_settings(importer);
  return corners_of(importer, importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "stl"), unit, {});
}

}  // namespace drycut::renders
