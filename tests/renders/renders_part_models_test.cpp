// The models of scenes/meshes/ as they are built in: sound surfaces, small files, all there.
#include "renders/part_models.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "renders/mesh.hpp"

namespace drycut::renders {
namespace {

const std::filesystem::path sources = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/meshes";

TEST(RendersPartModels, EveryModelIsASoundSurface) {
  ASSERT_GE(part_model_names().size(), 40U);
  for (const auto name : part_model_names()) {
    const Mesh mesh = part_model(name);
    Vec3 net = {0, 0, 0};
    double area = 0;
    double volume = 0;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
      const Vec3 a = as_doubles(mesh.corners[i].position);
      const Vec3 b = as_doubles(mesh.corners[i + 1].position);
      const Vec3 c = as_doubles(mesh.corners[i + 2].position);
      const Vec3 face = 0.5 * (b - a).cross(c - a);
      net += face;
      area += face.norm();
      volume += a.dot(b.cross(c)) / 6;
    }
    EXPECT_LT(net.norm(), 1e-4 * area) << name << " has holes";
    EXPECT_GT(volume, 0) << name << " is inside out";
  }
}

TEST(RendersPartModels, FilesAreSmallAndEachHasItsSource) {
  std::size_t all = 0;
  for (const auto name : part_model_names()) {
    const auto size = part_model_file(name).size();
    EXPECT_LT(size, 100'000U) << name;
    all += size;
    EXPECT_TRUE(std::filesystem::exists(sources / (std::string(name) + ".scad"))) << name;
    EXPECT_EQ(std::filesystem::file_size(sources / (std::string(name) + ".stl")), size) << name;
  }
  EXPECT_LT(all, 1'500'000U);
}

TEST(RendersPartModels, AnUnknownNameIsABugOfThePlant) {
  EXPECT_TRUE(part_model_file("warp_core").empty());
  EXPECT_THROW(part_model("warp_core"), std::logic_error);
}

}  // namespace
}  // namespace drycut::renders
