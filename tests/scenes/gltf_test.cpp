// `drycut run --gltf`: the run as an animated scene for any 3D viewer, with and without pictures.
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

namespace {

namespace fs = std::filesystem;

struct GltfTest : testing::Test {
  GltfTest() { fs::remove_all(out); }
  ~GltfTest() override { fs::remove_all(out); }
  int run(const std::string& arguments) const {
    const auto command = std::string("'") + DRYCUT_PROGRAM + "' run '" + DRYCUT_SOURCE_DIR +
                         "/scenes/rotary_knife_short.yaml' --set scene.duration='4 s' --set "
                         "pictures.frames.every='40 ms' --out '" +
                         out.string() + "' --no-pictures " + arguments + " > /dev/null 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  fs::path out = fs::path(testing::TempDir()) /
                 ("drycut_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  fs::path folder = out / "rotary_knife_short";
};

/// knife.angle [deg] at the times of trace.csv.
std::vector<std::pair<double, double>> angles(const fs::path& trace) {
  std::ifstream file(trace);
  std::string line;
  std::getline(file, line);
  std::size_t column = 0;
  std::stringstream heading(line);
  for (std::string cell; std::getline(heading, cell, ',') && !cell.starts_with("knife.angle");) ++column;
  std::vector<std::pair<double, double>> all;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::string cell;
    std::vector<double> numbers;
    while (std::getline(cells, cell, ',')) numbers.push_back(std::atof(cell.c_str()));
    all.emplace_back(numbers.at(0), numbers.at(column));
  }
  return all;
}

TEST_F(GltfTest, TheDrumTurnsAsItWasRecorded) {
  run("--gltf");
  ASSERT_TRUE(fs::exists(folder / "rotary_knife_short.glb"));
  EXPECT_FALSE(fs::exists(folder / "frames")) << "no pictures were wanted";
  Assimp::Importer importer;
  const auto* scene = importer.ReadFile((folder / "rotary_knife_short.glb").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumAnimations, 1U);
  const auto& animation = *scene->mAnimations[0];
  const aiNodeAnim* drum = nullptr;
  for (unsigned i = 0; i < animation.mNumChannels; ++i)
    if (animation.mChannels[i]->mNodeName == aiString("knife.drum")) drum = animation.mChannels[i];
  ASSERT_NE(drum, nullptr);
  const auto recorded = angles(folder / "trace.csv");
  const double ticks = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 1;
  int compared = 0;
  for (unsigned i = 0; i < drum->mNumRotationKeys; ++i) {
    const double time = drum->mRotationKeys[i].mTime / ticks + 0.04;  // of the first frame
    const auto row = std::lower_bound(recorded.begin(), recorded.end(), std::pair(time - 1e-4, -1e9));
    if (row == recorded.end() || std::abs(row->first - time) > 1e-4) continue;
    ++compared;
    const double half = row->second * std::numbers::pi / 360;
    const auto& q = drum->mRotationKeys[i].mValue;
    EXPECT_NEAR(std::abs(q.z * std::sin(half) + q.w * std::cos(half)), 1, 1e-6) << time;
  }
  EXPECT_GT(compared, 90);
}

TEST_F(GltfTest, NothingTurnsMoreThanThirtyDegreesFromKeyToKey) {
  run("--gltf --set pictures.frames.every='1 s'");
  Assimp::Importer importer;
  const auto* scene = importer.ReadFile((folder / "rotary_knife_short.glb").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  unsigned fast = 0;
  for (unsigned i = 0; i < scene->mAnimations[0]->mNumChannels; ++i) {
    const auto& part = *scene->mAnimations[0]->mChannels[i];
    for (unsigned k = 1; k < part.mNumRotationKeys; ++k) {
      const auto& a = part.mRotationKeys[k - 1].mValue;
      const auto& b = part.mRotationKeys[k].mValue;
      const double along = std::abs(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w);
      ASSERT_LE(2 * std::acos(std::min(1.0, along)), 30.1 * std::numbers::pi / 180) << part.mNodeName.C_Str();
    }
    fast = std::max(fast, part.mNumRotationKeys);
  }
  EXPECT_GT(fast, 100U) << "the motor turns about ten times a second";
}

TEST_F(GltfTest, TheFileGoesWhenARunIsNotAskedForIt) {
  run("--gltf");
  ASSERT_TRUE(fs::exists(folder / "rotary_knife_short.glb"));
  run("");
  EXPECT_FALSE(fs::exists(folder / "rotary_knife_short.glb"));
}

}  // namespace
