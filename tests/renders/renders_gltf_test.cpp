// The run as an animated glTF file, read back: nodes, materials, key times and poses are those of the film.
#include "renders/gltf.hpp"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>

#include "renders/geometry.hpp"
#include "renders/gltf_track.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

Placement turned(double x, double angle) {
  Placement placement;
  placement.position = {x, 1, -2};
  placement.rotation = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
  return placement;
}

/// A drum that turns by 50 degrees a frame, a frame that stands, a piece from frame 3 to 6, one never seen.
Film line() {
  Film film;
  film.title = "line";
  film.parts = {{"knife.drum", SolidPart::Shape::cylinder, {0.2, 0.2, 0.4}, {0.5F, 0.5F, 0.5F}, "steel"},
                {"knife.back plate", SolidPart::Shape::box, {0.3, 0.6, 0.1}, {0.2F, 0.3F, 0.4F}, "paint"},
                {"web.piece 1", SolidPart::Shape::box, {1, 0.1, 0.3}, {1, 0.6F, 0}, "web"},
                {"web.piece 2", SolidPart::Shape::box, {1, 0.1, 0.3}, {1, 0.6F, 0}, "web"}};
  for (int i = 0; i < 9; ++i) {
    Frame frame;
    frame.time_s = 0.5 + 0.04 * i;
    Placement piece = turned(0.1 * i, 0);
    piece.scale = {0.8, 1, 1};
    piece.visible = i >= 3 && i <= 6;
    Placement never;
    never.visible = false;
    frame.placements = {turned(0, i * 50 % 360 * std::numbers::pi / 180), turned(4, 0.3), piece, never};
    film.frames.push_back(frame);
  }
  return film;
}

const aiNodeAnim* channel_of(const aiScene& scene, const std::string& node) {
  for (unsigned i = 0; i < scene.mAnimations[0]->mNumChannels; ++i)
    if (scene.mAnimations[0]->mChannels[i]->mNodeName.C_Str() == node)
      return scene.mAnimations[0]->mChannels[i];
  return nullptr;
}

std::vector<double> seconds_of(const aiScene& scene, const aiNodeAnim& channel) {
  const double ticks = scene.mAnimations[0]->mTicksPerSecond > 0 ? scene.mAnimations[0]->mTicksPerSecond : 1;
  std::vector<double> times;
  for (unsigned i = 0; i < channel.mNumPositionKeys; ++i)
    times.push_back(channel.mPositionKeys[i].mTime / ticks);
  return times;
}

void expect_rotation(const aiQuaternion& found, const Vec4& wanted) {
  const double along = found.x * wanted[0] + found.y * wanted[1] + found.z * wanted[2] + found.w * wanted[3];
  EXPECT_NEAR(std::abs(along), 1, 1e-6);
}

class RendersGltf : public ::testing::Test {
 protected:
  const aiScene& written(const Film& film, int slow = 1) {
    write_gltf(film, scratch_ / "line.glb", slow);
    const auto* scene = importer_.ReadFile((scratch_ / "line.glb").string(), 0);
    if (scene == nullptr) throw std::runtime_error(importer_.GetErrorString());
    return *scene;
  }
  Scratch scratch_;
  Assimp::Importer importer_;
};

TEST_F(RendersGltf, EveryPartThatIsEverSeenIsANodeWithItsMesh) {
  const aiScene& scene = written(line());
  for (const char* name : {"knife.drum", "knife.back plate", "web.piece 1"}) {
    const aiNode* node = scene.mRootNode->FindNode(name);
    ASSERT_NE(node, nullptr) << name;
    ASSERT_EQ(node->mNumMeshes, 1U) << name;
    EXPECT_GT(scene.mMeshes[node->mMeshes[0]]->mNumFaces, 10U) << name;
  }
  EXPECT_EQ(scene.mRootNode->FindNode("web.piece 2"), nullptr);
}

TEST_F(RendersGltf, MeshesAreInMetresAndMaterialsHaveTheirNames) {
  const aiScene& scene = written(line());
  const aiMesh& drum = *scene.mMeshes[scene.mRootNode->FindNode("knife.drum")->mMeshes[0]];
  float widest = 0;
  for (unsigned i = 0; i < drum.mNumVertices; ++i) widest = std::max(widest, drum.mVertices[i].x);
  EXPECT_NEAR(widest, 0.1, 1e-6);
  EXPECT_STREQ(scene.mMaterials[drum.mMaterialIndex]->GetName().C_Str(), "steel");
}

TEST_F(RendersGltf, KeysStandAtTheFramesAndPosesAreTheRecordedOnes) {
  const Film film = line();
  const aiScene& scene = written(film);
  ASSERT_EQ(scene.mNumAnimations, 1U);
  const aiNodeAnim* drum = channel_of(scene, "knife.drum");
  ASSERT_NE(drum, nullptr);
  const auto times = seconds_of(scene, *drum);
  ASSERT_EQ(times.size(), film.frames.size());
  ASSERT_EQ(drum->mNumRotationKeys, film.frames.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], 0.04 * static_cast<double>(i), 1e-6);
    expect_rotation(drum->mRotationKeys[i].mValue, film.frames[i].placements[0].rotation);
  }
}

TEST_F(RendersGltf, WhatStandsStillHasAPlaceAndNoKeys) {
  const aiScene& scene = written(line());
  EXPECT_EQ(channel_of(scene, "knife.back plate"), nullptr);
  aiVector3D scale;
  aiVector3D position;
  aiQuaternion rotation;
  scene.mRootNode->FindNode("knife.back plate")->mTransformation.Decompose(scale, rotation, position);
  EXPECT_NEAR(position.x, 4, 1e-6);
  expect_rotation(rotation, line().frames[0].placements[1].rotation);
}

TEST_F(RendersGltf, APieceComesAndGoesWithinAThousandthOfAFrame) {
  const aiScene& scene = written(line());
  const aiNodeAnim* piece = channel_of(scene, "web.piece 1");
  ASSERT_NE(piece, nullptr);
  const double ticks = scene.mAnimations[0]->mTicksPerSecond > 0 ? scene.mAnimations[0]->mTicksPerSecond : 1;
  const auto scale_at = [&](double time) {
    const aiVectorKey* key = piece->mScalingKeys;
    while (key + 1 < piece->mScalingKeys + piece->mNumScalingKeys && (key + 1)->mTime / ticks <= time) ++key;
    return key->mValue.x;
  };
  EXPECT_EQ(scale_at(0), 0);
  EXPECT_EQ(scale_at(0.11998), 0);
  EXPECT_NEAR(scale_at(0.1201), 0.8, 1e-6);
  EXPECT_NEAR(scale_at(0.27998), 0.8, 1e-6);
  EXPECT_EQ(scale_at(0.2801), 0);
}

TEST_F(RendersGltf, SlowMotionStretchesTheTimes) {
  const aiScene& scene = written(line(), 5);
  EXPECT_NEAR(seconds_of(scene, *channel_of(scene, "knife.drum")).back(), 8 * 0.04 * 5, 1e-5);
}

TEST_F(RendersGltf, TheSameFilmGivesTheSameBytes) {
  const auto bytes = [&] {
    write_gltf(line(), scratch_ / "line.glb");
    std::ifstream file(scratch_ / "line.glb", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto first = bytes();
  EXPECT_GT(first.size(), 1000U);
  EXPECT_EQ(first, bytes());
}

TEST_F(RendersGltf, WhatCannotBeDrawnOrWrittenIsTold) {
  Film film = line();
  EXPECT_NE(message_of<std::runtime_error>([&] { write_gltf(film, scratch_ / "no" / "line.glb"); }), "");
  film.parts[0].material = "gold";
  EXPECT_THAT(message_of<std::invalid_argument>([&] { write_gltf(film, scratch_ / "line.glb"); }),
              ::testing::HasSubstr("gold"));
  EXPECT_EQ(message_of<std::invalid_argument>([&] { write_gltf({}, scratch_ / "line.glb"); }),
            "glTF: the film has no frames");
}

TEST(RendersGltfTrack, WaypointsAreKeysOfTheirPart) {
  Film film = line();
  film.frames[2].before = {
      {0, 0.55, turned(0.1, 1.0)}, {1, 0.555, turned(4, 0.5)}, {0, 0.56, turned(0.2, 1.3)}};
  film.frames[0].before = {{0, 0.4, turned(9, 0)}};
  const Track drum = track_of(film, 0, 2);
  ASSERT_EQ(drum.size(), film.frames.size() + 2);
  EXPECT_NEAR(drum[0].time_s, 0, 1e-12) << "nothing before the first frame";
  EXPECT_NEAR(drum[2].time_s, 2 * 0.05, 1e-12);
  EXPECT_NEAR(drum[3].time_s, 2 * 0.06, 1e-12);
  EXPECT_NEAR(drum[3].placement.position.x(), 0.2, 1e-12);
  EXPECT_NEAR(drum[4].time_s, 2 * 0.08, 1e-12);
  EXPECT_GT(track_of(film, 1, 1).size(), 1U) << "the plate moved between two frames";
}

TEST(RendersGltfTrack, RotationsGoTheShortWay) {
  const Film film = line();
  const Track track = track_of(film, 0, 1);
  for (std::size_t i = 1; i < track.size(); ++i) {
    double along = 0;
    for (std::size_t k = 0; k < 4; ++k)
      along += track[i].placement.rotation[k] * track[i - 1].placement.rotation[k];
    EXPECT_NEAR(along, std::cos(25 * std::numbers::pi / 180), 1e-12);
  }
}

TEST(RendersGltfTrack, AStretchWithoutChangeKeepsItsEnds) {
  Film film;
  film.parts.resize(1);
  for (int i = 0; i < 10; ++i) {
    Frame frame;
    frame.time_s = i;
    frame.placements = {turned(i < 2 ? i : i < 7 ? 2 : i, 0)};
    film.frames.push_back(frame);
  }
  std::vector<double> times;
  for (const TrackKey& key : track_of(film, 0, 1)) times.push_back(key.time_s);
  EXPECT_THAT(times, ::testing::ElementsAre(0, 1, 2, 6, 7, 8, 9));
}

}  // namespace
}  // namespace drycut::renders
