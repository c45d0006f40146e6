#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plants/rotary_knife.hpp"
#include "plants/section.hpp"
#include "tests/plants/flying_saw_line.hpp"

namespace drycut::plants {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Section, TheChordsOfATubeSumUpToItsArea) {
  for (const Section& s : {Section{0.04, 2e-3, true}, Section{0.06, 0.03, true}, Section{0.3, 5e-3, false}}) {
    const int slices = 200000;
    const double height = section_height(s);
    double area = 0;
    for (int i = 0; i < slices; ++i) area += section_chord(s, (i + 0.5) * height / slices) * height / slices;
    EXPECT_NEAR(area / section_area(s), 1, 1e-6);
    EXPECT_EQ(section_chord(s, -1e-9), 0);
    EXPECT_EQ(section_chord(s, height), 0);
  }
  EXPECT_NEAR(section_area({0.04, 2e-3, true}), std::numbers::pi * (0.02 * 0.02 - 0.018 * 0.018), 1e-15);
  EXPECT_NEAR(section_chord({0.04, 2e-3, true}, 0.02), 4e-3, 1e-15);  // both walls, half-way
  EXPECT_EQ(section_height({0.3, 5e-3, false}), 5e-3);
}

TEST(Section, ATubeHasRoomForItsWalls) {
  WebDefinition web;
  web.data.section = "tube";
  web.data.width = 0.02;
  web.data.thickness = 0.011;
  EXPECT_THAT(objections_of(web), ElementsAre("thickness: a tube of 20 mm has no wall of 11 mm"));
  web.data.thickness = 0.01;  // a bar
  EXPECT_THAT(objections_of(web), ElementsAre());
}

TEST(Section, TheKnifeRefusesATube) {
  WebDefinition web = tube(1);
  RotaryKnifeDefinition knife;
  const auto objections = [&] { return objections_of(knife, h, &web); };
  EXPECT_THAT(objections(), ElementsAre(StartsWith("web: a rotary knife cuts no tube")));
  web.data.section = "strip";
  web.data.thickness = 0.2;
  EXPECT_THAT(objections(), ElementsAre(StartsWith("circumference: ")));
  web.data.thickness = 0.02;
  knife.data.blade_count = 12;
  EXPECT_THAT(objections(), ElementsAre(StartsWith("blade_count: ")));
  web.data.thickness = 1e-3;
  EXPECT_THAT(objections(), ElementsAre());
  EXPECT_THAT(objections_of(knife), ElementsAre());
}

TEST(FlyingSawDefinition, WhatCannotBeBuiltIsRefused) {
  expect_refusals<FlyingSawDefinition>({
      {[](auto& d) { d.gear.stiffness = 1e8; }, {"gear.stiffness: "}},
      {[](auto& d) { d.stop.damping = 2e6; }, {"stop.damping: "}},
      {[](auto& d) { d.head.mass = 1; }, {"head.mass: "}},
      {[](auto& d) { d.motor_friction.viscous = 99; }, {"motor_friction.viscous: "}},
      {[](auto& d) { d.guide_friction.viscous = 1e6; }, {"carriage_friction.viscous: "}},
      {[](auto& d) { d.travel_max = -1; }, {"travel_max: "}},
      {[](auto& d) { d.start = 2; }, {"start: "}},
      {[](auto& d) { d.sensors.limit_max = -1; }, {"limit_max: "}},
      {[](auto& d) { d.head.up_force = 100; }, {"head.up_force: "}},
      {[](auto& d) { d.drive.servo.max_speed = 1; }, {"servo.max_speed: "}},
  });
}

TEST(FlyingSawDefinition, AStrokeThatCannotFitIsPredicted) {
  WebDefinition web = tube(2);
  FlyingSawDefinition saw;
  const auto objections = [&] { return objections_of(saw, h, &web); };
  const auto remedy = [&] {
    return saw.objections_with([&](std::string_view) { return &web; }, h).at(0).remedy;
  };
  EXPECT_THAT(objections(), ElementsAre());
  saw.data.travel_max = 0.3;
  EXPECT_THAT(objections(),
              ElementsAre(AllOf(StartsWith("travel_max: at 120 m/min a cut takes the carriage at least"),
                                HasSubstr("340 mm are there: it would crash into the end stop"))));
  EXPECT_THAT(remedy(), HasSubstr("stroke_check: off"));
  saw.data.stroke_check = false;
  EXPECT_THAT(objections(), ElementsAre());
  saw.data.head.stroke = 0.05;
  EXPECT_THAT(objections(), ElementsAre(AllOf(StartsWith("head.stroke: "),
                                              HasSubstr("do not go through 40 mm of material"))));
  EXPECT_THAT(remedy(), HasSubstr("more than 57 mm"));
}

TEST(FlyingSawDefinition, TheLeastStrokeIsNeverMoreThanACutTakes) {
  // The quickest sequence that a program can give, at full speed from the start: its way is the stroke of the
  // constant speed, and it takes as long as the prediction or a little longer.
  FlyingSawDefinition definition;
  const Section section = {0.04, 2e-3, true};
  const LeastStroke least = least_stroke(definition.data, section, 0.5);
  SawLine line(definition, tube(0));
  line.command("clamp", true);
  double open = 0;
  for (int i = 0; i < 10000 && open == 0; ++i) {
    line.step();
    const bool grips = line.plug<SignalPort>("clamp.closed").level;
    if (grips && line.events.empty()) line.command("head.plunge", true);
    if (line.events.empty()) continue;
    line.command("head.plunge", false);
    if (line.read("blade.engaged") == 0) line.command("clamp", false);
    if (!grips) open = line.steps * h;
  }
  EXPECT_GT(open, least.cycle);
  EXPECT_LT(open, least.cycle * 1.5);
  EXPECT_GT(least.stroke, 0.5 * least.cycle);
}

TEST(FlyingSawDefinition, TheWebMustBeOne) {
  FlyingSawDefinition definition;
  World world;
  EXPECT_THAT([&] { definition.build(world, [](std::string_view) { return nullptr; }); },
              ::testing::ThrowsMessage<std::invalid_argument>(HasSubstr("'web' is no plant of type web")));
}

TEST(FlyingSawDefinition, TheCarriageTakesItsPartsAlongAndTheBedStands) {
  for (const double lead : {0.2, 0.02}) {  // rack, screw
    FlyingSawDefinition definition;
    definition.data.lead = lead;
    definition.data.gear.ratio = lead > 0.1 ? 4 : 1;
    SawLine line(definition);
    const auto way = [&](const char* name) {
      const double before = pose_of(*line.plant, name).pose.position[0];
      line.carriage().position += 0.25;
      return pose_of(*line.plant, name).pose.position[0] - before;
    };
    for (const char* name : {"bed", "rail 1", "stop 2", lead > 0.1 ? "rack" : "screw"})
      EXPECT_EQ(way(name), 0) << name;
    for (const char* name : {"carriage", "saw blade"}) EXPECT_NEAR(way(name), 0.25, 1e-12) << name;
  }
}

TEST(FlyingSawDefinition, APieceLeavesTheCutWhereItWasMade) {
  FlyingSawDefinition definition;
  definition.data.start = 0.4;
  WebDefinition web = tube(0);
  web.data.lead = 1;
  SawLine line(definition, web);
  line.command("head.plunge", true);
  line.run(0.5);
  ASSERT_EQ(line.events.size(), 1U);
  EXPECT_NEAR(value(line.events[0], "length"), 600, 1e-6);
  const auto& outfeed = static_cast<Web&>(*line.supply).outfeed();
  EXPECT_NEAR(outfeed.pieces()[0].body->position, 0.7, 1e-6);
  EXPECT_NEAR(outfeed.pieces()[0].length, 0.6, 1e-9);
}

}  // namespace
}  // namespace drycut::plants
