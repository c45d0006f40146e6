// pictures.meshes: how a user's own mesh takes the place of a part, and what is refused.
#include "sim/report/part_meshes.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "plants/world.hpp"
#include "renders/part_models.hpp"
#include "sim/report/film.hpp"
#include "tests/loop/scenario/fake_plants.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::report {
namespace {

using fakes::problems_of;
using fakes::read;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(MeshRequests, AreReadAndWritten) {
  std::vector<std::string> problems;
  const auto scenario = read(
      "pictures: {meshes: {knife.drum: {file: my.stl, scale: 25.4, at: [0 mm, 2 cm, -5 mm], rotate: [90 deg, "
      "0 "
      "deg, 0 deg]}, web.table: {file: t.obj}}}\n",
      problems);
  EXPECT_THAT(problems, IsEmpty());
  const auto check = [](const scenario::PicturesSection& pictures) {
    ASSERT_EQ(pictures.meshes.size(), 2U);
    const auto& drum = pictures.meshes[0];
    EXPECT_EQ(drum.part.text, "knife.drum");
    EXPECT_EQ(drum.file.text, "my.stl");
    EXPECT_EQ(drum.scale, 25.4);
    EXPECT_EQ(drum.at, (std::array<double, 3>{0, 0.02, -0.005}));
    EXPECT_NEAR(drum.rotate[0], std::numbers::pi / 2, 1e-12);
    EXPECT_EQ(pictures.meshes[1].scale, 1);
    EXPECT_EQ(pictures.meshes[1].at, (std::array<double, 3>{0, 0, 0}));
  };
  check(scenario.pictures);
  const auto again = read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  check(again.pictures);
}

TEST(MeshRequests, WhatIsWrong) {
  const auto wrong = [](const std::string& mesh) {
    return problems_of("pictures: {meshes: {a.b: " + mesh + "}}\n");
  };
  EXPECT_THAT(wrong("{}"), ElementsAre("1:26: pictures.meshes.a.b.file is missing; name a mesh file: file: "
                                       "meshes/my_drum.stl [scenario.missing-key]"));
  EXPECT_THAT(wrong("x.stl"), ElementsAre(::testing::StartsWith("1:26: pictures.meshes.a.b must be a map")));
  EXPECT_THAT(wrong("{file: x.stl, scale: 0}"),
              ElementsAre("1:47: pictures.meshes.a.b.scale is 0, out of range; 1e-6 to 1e6; 1 takes the file "
                          "as it is [scenario.out-of-range]"));
  EXPECT_THAT(wrong("{file: x.stl, scale: 2 mm}"),
              ElementsAre(::testing::StartsWith("1:49: pictures.meshes.a.b.scale is a pure number, not ")));
  EXPECT_THAT(wrong("{file: x.stl, at: [1 mm, 2 mm]}"),
              ElementsAre("1:40: pictures.meshes.a.b.at has 2 numbers; write three, along x, y and z: [0 mm, "
                          "20 mm, 0 mm] [scenario.not-a-number]"));
  EXPECT_THAT(wrong("{file: x.stl, at: [1 mm, 2, 3 kg]}"),
              ElementsAre(::testing::StartsWith("1:51: pictures.meshes.a.b.at.1: '2' has no unit"),
                          ::testing::StartsWith("1:56: pictures.meshes.a.b.at.2 is ")));
  EXPECT_THAT(wrong("{file: x.stl, turn: 1}"),
              ElementsAre(::testing::StartsWith("1:40: unknown key 'turn' in pictures.meshes.a.b; ")));
  EXPECT_THAT(problems_of("pictures: {meshes: {a.b: {file: x.stl}, a.b: {file: y.stl}}}\n"),
              ElementsAre(::testing::HasSubstr("a.b")));
}

class PartMeshesTest : public ::testing::Test {
 protected:
  PartMeshes load(const std::string& meshes) {
    Problems problems;
    scenario_ = scenario::read_scenario_text(
        "scene: {duration: 100 ms}\n"
        "plants: {web: {type: web}, knife: {type: rotary_knife, web: web}}\n"
        "pictures: {frames: {every: 50 ms}, meshes: {" +
            meshes + "}}\n",
        folder_ / "line.yaml", {}, problems);
    simulation_ = std::make_unique<loop::Simulation>(scenario_, problems);
    auto loaded = load_part_meshes(scenario_, simulation_->plants(), problems);
    problems_.clear();
    for (const auto& problem : problems) {
      auto text = to_string(problem);
      const auto file = (folder_ / "line.yaml").string() + ":";
      if (text.starts_with(file)) text.erase(0, file.size());
      problems_.push_back(text);
    }
    return loaded;
  }

  TestFolder folder_;
  scenario::Scenario scenario_;
  std::unique_ptr<loop::Simulation> simulation_;
  std::vector<std::string> problems_;
};

TEST_F(PartMeshesTest, AMeshTakesThePlaceOfThePartAndOfNoOther) {
  std::ofstream(folder_ / "a.obj") << "v 0 0 0\nv 400 0 0\nv 0 300 0\nf 1 2 3\n";
  const auto meshes = load("knife.drum: {file: a.obj, at: [0 mm, 0 mm, 7 mm]}");
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_EQ(meshes.size(), 1U);
  simulation_->run();
  const auto film = film_of(scenario_, *simulation_, meshes);
  int own = 0;
  for (const auto& part : film.parts) {
    if (part.mesh != meshes.at("knife.drum")) continue;
    ++own;
    EXPECT_EQ(part.name, "knife.drum");
    EXPECT_NEAR(part.mesh->corners[0].position[2], 0.007, 1e-7);
  }
  EXPECT_EQ(own, 1);
  EXPECT_EQ(film.frames.size(), 2U);
}

TEST_F(PartMeshesTest, PartsAndFilesThatAreNotThereAreToldAllAtOnce) {
  std::ofstream(folder_ / "empty.stl");
  const auto meshes = load(
      "knife.drun: {file: a.stl}, nife.drum: {file: a.stl}, web.table: {file: a.stl}, "
      "web.web: {file: empty.stl}");
  EXPECT_THAT(meshes, IsEmpty());
  EXPECT_THAT(
      problems_,
      ElementsAre("3:45: there is no part 'knife.drun'; did you mean knife.drum? [scenario.unknown-name]",
                  "3:72: there is no part 'nife.drum'; did you mean knife.drum? [scenario.unknown-name]",
                  "3:116: mesh " + (folder_ / "a.stl").string() +
                      ": there is no such file; name a mesh file relative to the scenario [mesh.no-file]",
                  "3:140: mesh " + (folder_ / "empty.stl").string() +
                      ": the file is empty; export the part again [mesh.unreadable]"));
}

TEST_F(PartMeshesTest, APartThatIsNearNoneIsAnsweredByTheList) {
  load("knife.zzzzzzzzzz: {file: a.stl}, quux: {file: a.stl}");
  EXPECT_THAT(
      problems_,
      ElementsAre(::testing::HasSubstr("'knife.zzzzzzzzzz'; parts: drum, drum shaft, drum mark, anvil roll,"),
                  ::testing::HasSubstr("'quux'; write PLANT.PART; `drycut plants TYPE` lists the parts")));
}

TEST(PartModels, EveryModelThatAPlantNamesIsBuiltIn) {
  std::size_t modelled = 0;
  for (const auto& type : plants::plant_types()) {
    plants::World world(1);
    std::vector<std::unique_ptr<plants::PlantDefinition>> definitions;
    std::vector<std::unique_ptr<plants::Plant>> built;
    for (const std::string_view name : {std::string_view("web"), type.name}) {
      for (const auto& other : plants::plant_types())
        if (other.name == name) definitions.push_back(other.define());
      built.push_back(definitions.back()->build(
          world, [&](std::string_view wanted) { return wanted == "web" ? built.front().get() : nullptr; }));
    }
    for (const auto& part : built.back()->parts()) {
      if (part.model.empty()) continue;
      ++modelled;
      EXPECT_FALSE(renders::part_model_file(part.model).empty()) << type.name << ": " << part.model;
    }
  }
  EXPECT_GT(modelled, 60U);
}

}  // namespace
}  // namespace drycut::sim::report
