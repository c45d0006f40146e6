#include "renders/loaded/faces.hpp"

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "renders/geometry.hpp"
#include "renders/gltf_track.hpp"
#include "renders/png_image.hpp"
#include "renders/solid_mesh.hpp"

namespace drycut::renders {
namespace {

// assimp's scene owns what hangs on it and deletes it: here, and only here, things are made with `new`.

constexpr double ticks_per_second = 1000;
const Vec3 tiny = Vec3::Constant(1e-6);

aiVector3D vector_of(const Vec3& v) {
  const Eigen::Vector3f f = v.cast<float>();
  return {f.x(), f.y(), f.z()};
}
aiQuaternion quaternion_of(const Vec4& q) {
  const Eigen::Vector4f f = q.cast<float>();
  return {f.w(), f.x(), f.y(), f.z()};
}

/// As the pictures have it: colours of the scene are shown values, glTF wants linear ones.
float linear(float shown) { return shown * shown; }

aiMaterial* material_of(const std::string& name) {
  const Material& look = *find_material(name);
  auto* material = new aiMaterial;
  const aiString title(name);
  const aiColor4D white(1, 1, 1, 1);
  const bool metal = look.reflection > 0.3F;
  const float metallic = metal ? 0.85F : 0.0F;
  const float roughness = std::sqrt(2 / (look.gloss + 2)) + (metal ? 0.15F : 0.3F);
  material->AddProperty(&title, AI_MATKEY_NAME);
  material->AddProperty(&white, 1, AI_MATKEY_BASE_COLOR);
  material->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  material->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  return material;
}

aiMesh* mesh_of(const SolidPart& part, const std::vector<Vertex>& corners, unsigned material) {
  const auto count = static_cast<unsigned>(corners.size());
  auto* mesh = new aiMesh;
  mesh->mName = part.name;
  mesh->mMaterialIndex = material;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = count;
  mesh->mVertices = new aiVector3D[count];
  mesh->mNormals = new aiVector3D[count];
  mesh->mColors[0] = new aiColor4D[count];
  mesh->mNumFaces = count / 3;
  mesh->mFaces = new aiFace[count / 3];
  for (unsigned i = 0; i < count; ++i) {
    const Vertex& v = corners[i];
    mesh->mVertices[i] = {v.position[0], v.position[1], v.position[2]};
    mesh->mNormals[i] = aiVector3D(v.normal[0], v.normal[1], v.normal[2]).NormalizeSafe();
    mesh->mColors[0][i] = {linear(v.colour[0]), linear(v.colour[1]), linear(v.colour[2]), 1};
  }
  for (unsigned i = 0; i < count / 3; ++i) {
    mesh->mFaces[i].mNumIndices = 3;
    mesh->mFaces[i].mIndices = new unsigned[3]{3 * i, 3 * i + 1, 3 * i + 2};
  }
  return mesh;
}

template <typename Item>
Item** owned(const std::vector<Item*>& items) {
  auto** array = new Item*[items.size()];
  std::copy(items.begin(), items.end(), array);
  return array;
}

/// Parts of the same look share a mesh: cut pieces, belt marks.
using Look =
    std::tuple<SolidPart::Shape, double, double, double, std::array<float, 3>, std::string, const Mesh*>;

class GltfBuilder {
 public:
  void add(const SolidPart& part, const Track& track) {
    auto* node = new aiNode(part.name);
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{mesh(part)};
    // Where it stands without the animation. A matrix of scale 0 could not be taken apart again.
    const Placement& first = track.front().placement;
    node->mTransformation = aiMatrix4x4(vector_of(first.visible ? first.scale : tiny),
                                        quaternion_of(first.rotation), vector_of(first.position));
    nodes_.push_back(node);
    if (track.size() > 1) channels_.push_back(channel(part.name, track));
  }

  /// Hands everything over to `scene`.
  void finish(aiScene& scene, const std::string& title) {
    scene.mRootNode = new aiNode(title.empty() ? "drycut" : title);
    for (auto* node : nodes_) node->mParent = scene.mRootNode;
    scene.mRootNode->mNumChildren = static_cast<unsigned>(nodes_.size());
    scene.mRootNode->mChildren = owned(nodes_);
    scene.mNumMeshes = static_cast<unsigned>(meshes_.size());
    scene.mMeshes = owned(meshes_);
    scene.mNumMaterials = static_cast<unsigned>(materials_.size());
    scene.mMaterials = owned(materials_);
    if (channels_.empty()) return;
    auto* animation = new aiAnimation;
    animation->mName = "run";
    animation->mTicksPerSecond = ticks_per_second;
    for (const auto* channel : channels_)
      animation->mDuration =
          std::max(animation->mDuration, channel->mPositionKeys[channel->mNumPositionKeys - 1].mTime);
    animation->mNumChannels = static_cast<unsigned>(channels_.size());
    animation->mChannels = owned(channels_);
    scene.mNumAnimations = 1;
    scene.mAnimations = new aiAnimation* [1] { animation };
  }

 private:
  unsigned material(const std::string& name) {
    const auto [found, fresh] = material_numbers_.emplace(name, materials_.size());
    if (fresh) materials_.push_back(material_of(name));
    return static_cast<unsigned>(found->second);
  }

  unsigned mesh(const SolidPart& part) {
    const Look look = {part.shape,  part.size.x(), part.size.y(),  part.size.z(),
                       part.colour, part.material, part.mesh.get()};
    const auto [found, fresh] = mesh_numbers_.emplace(look, meshes_.size());
    if (fresh) {
      meshes_.push_back(mesh_of(part, solid_surface(part), material(part.material)));
    }
    return static_cast<unsigned>(found->second);
  }

  static aiNodeAnim* channel(const std::string& name, const Track& track) {
    const auto count = static_cast<unsigned>(track.size());
    auto* channel = new aiNodeAnim;
    channel->mNodeName = name;
    channel->mNumPositionKeys = channel->mNumRotationKeys = channel->mNumScalingKeys = count;
    channel->mPositionKeys = new aiVectorKey[count];
    channel->mRotationKeys = new aiQuatKey[count];
    channel->mScalingKeys = new aiVectorKey[count];
    for (unsigned i = 0; i < count; ++i) {
      const double time = track[i].time_s * ticks_per_second;
      const Placement& placement = track[i].placement;
      channel->mPositionKeys[i] = {time, vector_of(placement.position)};
      channel->mRotationKeys[i] = {time, quaternion_of(placement.rotation)};
      channel->mScalingKeys[i] = {time, vector_of(placement.scale)};
    }
    return channel;
  }

  std::vector<aiNode*> nodes_;
  std::vector<aiMesh*> meshes_;
  std::vector<aiMaterial*> materials_;
  std::vector<aiNodeAnim*> channels_;
  std::map<std::string, std::size_t> material_numbers_;
  std::map<Look, std::size_t> mesh_numbers_;
};

}  // namespace

std::string glb(const Film& film, int slow) {
  aiScene scene;
  GltfBuilder builder;
  for (std::size_t part = 0; part < film.parts.size(); ++part) {
    const bool seen = std::any_of(film.frames.begin(), film.frames.end(),
                                  [&](const Frame& frame) { return frame.placements[part].visible; });
    if (seen) builder.add(film.parts[part], track_of(film, part, slow));
  }
  builder.finish(scene, film.title);

  Assimp::Exporter exporter;
  const auto* blob = exporter.ExportToBlob(&scene, "glb2", aiProcess_JoinIdenticalVertices);
  if (blob == nullptr) throw std::runtime_error(fmt::format("glTF: {}", exporter.GetErrorString()));
  return {static_cast<const char*>(blob->data), blob->size};
}

}  // namespace drycut::renders
