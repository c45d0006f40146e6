// Meshes from files: what is taken, in which unit, where it comes to stand, and what is refused, with the
// reason.
#include "renders/mesh_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "renders/mesh.hpp"
#include "renders/process.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::HasSubstr;

/// A box from (0, 0, 0) to `size` as an OBJ.
std::string box_obj(double x, double y, double z) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string((i & 1) != 0 ? x : 0) + " " + std::to_string((i & 2) != 0 ? y : 0) + " " +
            std::to_string((i & 4) != 0 ? z : 0) + "\n";
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// A binary STL of so many copies of the triangle `corners`.
std::string stl(std::uint32_t triangles, const std::array<float, 9>& corners) {
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&triangles), 4);
  std::string one(12, '\0');
  one.append(reinterpret_cast<const char*>(corners.data()), 36);
  one += std::string(2, '\0');
  for (std::uint32_t i = 0; i < triangles; ++i) bytes += one;
  return bytes;
}

class RendersMeshFile : public ::testing::Test {
 protected:
  std::variant<Mesh, MeshProblem> load(const std::string& name, const std::string& text,
                                       const MeshPlacing& placing = {}) {
    std::ofstream(scratch_ / name, std::ios::binary) << text;
    return load_mesh(scratch_ / name, placing);
  }
  Mesh good(const std::string& name, const std::string& text, const MeshPlacing& placing = {}) {
    auto loaded = load(name, text, placing);
    if (const auto* problem = std::get_if<MeshProblem>(&loaded)) {
      ADD_FAILURE() << name << ": " << problem->what;
      return {};
    }
    return std::get<Mesh>(std::move(loaded));
  }
  std::string refusal(const std::string& name, const std::string& text, const MeshPlacing& placing = {}) {
    const auto loaded = load(name, text, placing);
    const auto* problem = std::get_if<MeshProblem>(&loaded);
    return problem == nullptr ? "taken" : problem->what + "; " + problem->remedy;
  }
  Scratch scratch_;
};

/// A library of materials that is a FIFO, which nobody writes: the attempt took its two minutes.
TEST_F(RendersMeshFile, AFifoBesideItIsNotWaitedFor) {
  ASSERT_EQ(mkfifo((scratch_ / "box.mtl").c_str(), 0600), 0);
  EXPECT_EQ(good("box.obj", "mtllib box.mtl\n" + box_obj(200, 100, 50)).corners.size(), 36U);
}

void expect_near(const Vec3& a, const Vec3& b) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-6) << i;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
    sum +=
        as_doubles(mesh.corners[i].position)
            .dot(as_doubles(mesh.corners[i + 1].position).cross(as_doubles(mesh.corners[i + 2].position))) /
        6;
  return sum;
}

TEST_F(RendersMeshFile, AnObjIsInMillimetres) {
  const Mesh mesh = good("box.obj", box_obj(200, 100, 50));
  EXPECT_EQ(mesh.corners.size(), 36U);
  expect_near(extent_of(mesh).min(), {0, 0, 0});
  expect_near(extent_of(mesh).max(), {0.2, 0.1, 0.05});
  EXPECT_NEAR(volume(mesh), 1e-3, 1e-9);
}

TEST_F(RendersMeshFile, APlyAndAnOffAreInMillimetresToo) {
  const std::string corners = "0 0 0\n300 0 0\n0 100 0\n0 0 50\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"a.ply", ply + corners + faces}, {"a.off", "OFF\n4 4 6\n" + corners + faces}}) {
    const Mesh mesh = good(name, text);
    expect_near(extent_of(mesh).max(), {0.3, 0.1, 0.05});
    EXPECT_NEAR(volume(mesh), 0.3 * 0.1 * 0.05 / 6, 1e-9) << name;
  }
}

TEST_F(RendersMeshFile, IsScaledThenTurnedAboutXYZThenMoved) {
  const double quarter = std::numbers::pi / 2;
  // (200, 100, 50) mm twice as large; about x: y to z, z to -y; then about z: x to y, y to -x.
  const Mesh mesh = good("box.obj", box_obj(200, 100, 50), {2, {quarter, 0, quarter}, {1, 2, 3}});
  expect_near(extent_of(mesh).min(), {1, 2, 3});
  expect_near(extent_of(mesh).max(), {1.1, 2.4, 3.2});
  EXPECT_NEAR(volume(mesh), 8e-3, 1e-8);
}

TEST_F(RendersMeshFile, EdgesStaySharpAndRoundSurfacesBecomeSmooth) {
  for (const auto& corner : good("box.obj", box_obj(200, 100, 50)).corners) {
    const Vec3 n = as_doubles(corner.normal);
    EXPECT_NEAR(std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])}), 1, 1e-6);
  }
  // A tube of 24 sides: 15 degrees between them.
  std::string tube;
  for (int i = 0; i < 24; ++i)
    for (const int z : {0, 40})
      tube += "v " + std::to_string(100 * std::cos(i * std::numbers::pi / 12)) + " " +
              std::to_string(100 * std::sin(i * std::numbers::pi / 12)) + " " + std::to_string(z) + "\n";
  for (int i = 0; i < 24; ++i) {
    const int next = (i + 1) % 24;
    tube += "f " + std::to_string(2 * i + 1) + " " + std::to_string(2 * next + 1) + " " +
            std::to_string(2 * next + 2) + " " + std::to_string(2 * i + 2) + "\n";
  }
  for (const auto& corner : good("tube.obj", tube).corners) {
    const Vec3 p = as_doubles(corner.position);
    const Vec3 n = as_doubles(corner.normal);
    EXPECT_GT((p[0] * n[0] + p[1] * n[1]) / 0.1, std::cos(6 * std::numbers::pi / 180));
  }
}

TEST_F(RendersMeshFile, TheSameFileGivesTheSameMesh) {
  const Mesh a = good("box.obj", box_obj(200, 100, 50));
  const Mesh b = good("box.obj", box_obj(200, 100, 50));
  ASSERT_EQ(a.corners.size(), b.corners.size());
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    EXPECT_EQ(a.corners[i].position, b.corners[i].position);
    EXPECT_EQ(a.corners[i].normal, b.corners[i].normal);
  }
}

TEST_F(RendersMeshFile, WhatIsNoMeshIsRefused) {
  const auto missing = load_mesh(scratch_ / "none.stl", {});
  EXPECT_EQ(std::get<MeshProblem>(missing).what, "there is no such file");
  const auto folder = load_mesh(scratch_.path, {});
  EXPECT_EQ(std::get<MeshProblem>(folder).what, "there is no such file");
  EXPECT_EQ(
      refusal("part.step", "ISO-10303-21;"),
      "'.step' is not a kind of mesh that is known; export STL, OBJ, PLY, OFF, glTF, GLB or DAE from the "
      "CAD program");
  EXPECT_EQ(refusal("part.stl", ""), "the file is empty; export the part again");
  for (const char* name : {"a.stl", "a.obj", "a.ply", "a.off", "a.gltf", "a.glb", "a.dae"})
    EXPECT_THAT(
        refusal(name, "this is no mesh at all, only a long line of words for a reader to stumble over"),
        ::testing::AnyOf(HasSubstr("the mesh cannot be read: "), HasSubstr("the mesh has no triangles")))
        << name;
}

TEST_F(RendersMeshFile, BrokenEmptyAndHugeMeshesAreRefused) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal("a.stl", stl(2, {0, 0, 0, 100, 0, 0, 0, none, 0})),
            "corner 3 is not at a finite place; export the part again");
  EXPECT_THAT(refusal("a.stl", stl(2, {0, 0, 0, 100, 0, 0, 0, 100, 0}).substr(0, 120)),
              HasSubstr("the mesh cannot be read: "));
  EXPECT_THAT(refusal("a.stl", stl(0, {})), HasSubstr("; export"));
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 100 0 0\nv 0 100 0\nl 1 2\n"),
            "the mesh has no triangles; export a surface, not points, curves or a sketch");
  EXPECT_EQ(refusal("a.stl", stl(5, {7, 7, 7, 7, 7, 7, 7, 7, 7})),
            "all triangles of the mesh are without area; export the part again");
  EXPECT_EQ(refusal("a.stl", stl(mesh_triangles_max + 1, {0, 0, 0, 100, 0, 0, 0, 100, 0})),
            "the mesh has 200001 triangles, more than 200000; export it with a coarser tolerance");
  std::ofstream(scratch_ / "big.stl") << "solid";
  std::filesystem::resize_file(scratch_ / "big.stl", mesh_bytes_max + (1U << 20U));
  EXPECT_EQ(std::get<MeshProblem>(load_mesh(scratch_ / "big.stl", {})).what,
            "the file has 65 MB, more than 64");
}

TEST_F(RendersMeshFile, ASizeThatNoPartHasIsRefusedWithTheUnit) {
  EXPECT_EQ(
      refusal("a.obj", box_obj(200, 100, 50), {1000}),
      "its longest side is 2e+05 mm; parts have 0.1 to 100000 mm; the file is taken in millimetres; set "
      "scale");
  EXPECT_THAT(refusal("a.obj", box_obj(200, 100, 50), {1e-4}), HasSubstr("its longest side is 0.02 mm"));
  good("a.obj", box_obj(200, 100, 50), {499});
}

/// A triangle of 200 by 100 mm as a glTF with these nodes, the first of which is shown.
std::string gltf(const std::string& nodes) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" + nodes +
         R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAzcxMPgAAAAAAAAAAAAAAAM3MzD0AAAAAAAABAAIA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";
}

/// `text` so many times.
std::string repeated(int times, const std::string& text) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// The same as a DAE whose scene holds `nodes`; the triangle may be there many times.
std::string dae(const std::string& nodes, int triangles = 1) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 0.2 0 0 0 0.1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count=")" +
         std::to_string(triangles) + R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
         repeated(triangles, "0 1 2 ") +
         R"(</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">)" +
         nodes +
         R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST_F(RendersMeshFile, AGltfAndADaeAreInMetresAndComeOverToTheBit) {
  const std::string node = R"(<node><instance_geometry url="#g"/></node>)";
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"a.gltf", gltf(R"({"mesh": 0})")}, {"a.dae", dae(node)}}) {
    const Mesh mesh = good(name, text);
    ASSERT_EQ(mesh.corners.size(), 3U) << name;
    const std::vector<std::array<float, 3>> corners = {{0, 0, 0}, {0.2F, 0, 0}, {0, 0.1F, 0}};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(mesh.corners[i].position, corners[i]) << name;
      EXPECT_EQ(mesh.corners[i].normal, (std::array<float, 3>{0, 0, 1})) << name;
    }
    EXPECT_FALSE(mesh.hull.empty()) << name;
  }
}

TEST_F(RendersMeshFile, AnotherProcessReadsTheSameBits) {
  const auto file = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/meshes/anvil_roll.stl";
  const auto here = std::get<Mesh>(read_stl(content(file)));
  const auto there = std::get<Mesh>(load_mesh(file, {}));
  ASSERT_EQ(there.corners.size(), here.corners.size());
  for (std::size_t i = 0; i < here.corners.size(); ++i) {
    EXPECT_EQ(there.corners[i].position, here.corners[i].position) << i;
    EXPECT_EQ(there.corners[i].normal, here.corners[i].normal) << i;
  }
  EXPECT_EQ(there.hull, here.hull);
}

const std::string again = "; export the part again, as STL or OBJ";

TEST_F(RendersMeshFile, ANestTooDeepForTheReaderIsRefused) {
  const std::string crashed = "the mesh cannot be read: the attempt crashed (Segmentation fault)" + again;
  const int deep = 200'000;
  std::string chain;
  for (int i = 1; i <= deep; ++i) chain += R"({"children": [)" + std::to_string(i) + "]}, ";
  EXPECT_EQ(refusal("a.gltf", gltf(chain + R"({"mesh": 0})")), crashed);
  EXPECT_EQ(refusal("a.dae", dae(repeated(deep, "<node>") + R"(<instance_geometry url="#g"/>)" +
                                 repeated(deep, "</node>"))),
            crashed);
}

TEST_F(RendersMeshFile, ANodeWithinItselfIsRefused) {
  EXPECT_THAT(refusal("a.gltf", gltf(R"({"children": [1]}, {"mesh": 0, "children": [0]})")),
              HasSubstr("recursive reference to itself" + again));
  EXPECT_EQ(
      refusal("a.dae", dae(R"(<node id="n"><instance_geometry url="#g"/><instance_node url="#n"/></node>)")),
      "the mesh cannot be read: the attempt crashed (Segmentation fault)" + again);
}

TEST_F(RendersMeshFile, AMeshShownTooOftenIsRefused) {
  const std::string node = R"(<node><instance_geometry url="#g"/></node>)";
  EXPECT_EQ(refusal("a.dae", dae(repeated(201, node), 1000)),
            "the mesh has 201000 triangles, more than 200000; export it with a coarser tolerance");
}

TEST_F(RendersMeshFile, ATruncatedGlbIsRefused) {
  const std::string glb("glTF\2\0\0\0\xe8\3\0\0\x1c\0\0\0JSON", 20);
  EXPECT_THAT(refusal("a.glb", glb + R"({"asset":{"version":"2.0"}})"),
              HasSubstr("the mesh cannot be read: "));
}

TEST_F(RendersMeshFile, AFileThatAnnouncesMoreThanThereIsMemoryForIsRefused) {
  if (!memory_is_limited) GTEST_SKIP() << "no limit of memory with AddressSanitizer";
  const std::string long_glb("glTF\2\0\0\0\xf0\xff\xff\xff\xf0\xff\xff\xffJSON", 20);
  EXPECT_THAT(refusal("a.glb", long_glb + gltf(R"({"mesh": 0})")), HasSubstr("the mesh cannot be read: "));
  for (const char* format : {"ascii", "binary_little_endian"})
    EXPECT_EQ(
        refusal("a.ply", std::string("ply\nformat ") + format +
                             " 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
                             "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                             "end_header\n0 0 0\n100 0 0\n0 100 0\n3 0 1 2\n"),
        "the mesh cannot be read: the attempt took more than 2048 MB of memory" + again);
}

TEST(RendersMesh, AStretchedMeshFillsItsBoxAboutTheMiddle) {
  Mesh mesh;
  const float slope = std::sqrt(0.5F);
  for (const auto& p : std::vector<std::array<float, 3>>{{1, 1, 1}, {3, 1, 1}, {1, 3, 5}})
    mesh.corners.push_back({p, {slope, slope, 0}});
  find_hull(mesh);
  const Mesh wide = stretched(mesh, {4, 2, 1});
  expect_near(extent_of(wide).min(), {-2, -1, -0.5});
  expect_near(extent_of(wide).max(), {2, 1, 0.5});
  // Twice as wide, the slope leans half as much in x.
  expect_near(as_doubles(wide.corners[0].normal), Vec3(0.5, 1, 0).normalized());
}

TEST(RendersMesh, TheHullStandsForTheMeshAlongEveryAxisAndDiagonal) {
  Mesh mesh;
  for (int i = 0; i < 300; ++i) {
    const double a = i * 2.4;
    const double h = (i - 150) / 150.0;
    const double r = std::sqrt(1 - h * h);
    mesh.corners.push_back({as_floats(Vec3{r * std::cos(a), r * std::sin(a), h}), {0, 0, 1}});
  }
  find_hull(mesh);
  EXPECT_LE(mesh.hull.size(), 26U);
  for (const Vec3& direction :
       {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{1, 1, -1}, Vec3{-1, 0, 1}}) {
    double all = -9;
    double hull = -9;
    for (const auto& corner : mesh.corners) all = std::max(all, direction.dot(as_doubles(corner.position)));
    for (const auto& point : mesh.hull) hull = std::max(hull, direction.dot(point));
    EXPECT_EQ(hull, all);
  }
}

}  // namespace
}  // namespace drycut::renders
