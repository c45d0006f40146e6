// The models of scenes/meshes/ as they are built in: sound surfaces, small files, all there.
#include "renders/part_models.hpp"

#include <gmock/gmock.h>

#include <cmath>
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

TEST(RendersPartModels, OneWithItsEndsKeptStretchesInTheMiddle) {
  const Mesh leg = part_model("leg");  // its feet are 244 mm over all, its posts reach 73 mm in
  const Vec3 size = {0.09, 0.75, 2.1};
  const Mesh uniform = stretched(leg, size);
  const Mesh kept = stretched(leg, size, true);
  for (const Mesh* mesh : {&uniform, &kept})
    EXPECT_LT((extent_of(*mesh).sizes() - size).norm(), 1e-6) << "as long as it has to be";
  // How far the posts at the end reach in: corners at half the height.
  const auto reach = [&](const Mesh& mesh) {
    double innermost = 2.1;
    for (const auto& corner : mesh.corners)
      if (std::abs(corner.position[2]) > 0.3 && corner.position[1] > 0.2)
        innermost = std::min<double>(innermost, std::abs(corner.position[2]));
    return extent_of(mesh).max().z() - innermost;
  };
  EXPECT_NEAR(reach(uniform), 2.1 / 0.244 * 0.073, 0.01);
  EXPECT_NEAR(reach(kept), 1.5 * 0.073, 0.01);
  const auto as_before = stretched(leg, {0.09, 0.75, 0.3}, true);
  const auto plain = stretched(leg, {0.09, 0.75, 0.3});
  for (std::size_t i = 0; i < plain.corners.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(as_before.corners[i].position[axis], plain.corners[i].position[axis], 1e-6);
      EXPECT_NEAR(as_before.corners[i].normal[axis], plain.corners[i].normal[axis], 1e-6);
    }
  }
}

TEST(RendersPartModels, AnUnknownNameIsABugOfThePlant) {
  EXPECT_TRUE(part_model_file("warp_core").empty());
  EXPECT_THROW(part_model("warp_core"), std::logic_error);
}

}  // namespace
}  // namespace drycut::renders
