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

std::vector<std::string> names(const std::vector<PlantDefinition::Objection>& objections) {
  std::vector<std::string> found;
  for (const auto& o : objections) {
    EXPECT_FALSE(o.what.empty());
    EXPECT_FALSE(o.remedy.empty());
    found.push_back(o.parameter);
  }
  return found;
}

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
  ASSERT_THAT(names(web.objections(1e-4)), ElementsAre("thickness"));
  EXPECT_THAT(web.objections(1e-4)[0].what, HasSubstr("a tube of 20 mm has no wall of 11 mm"));
  web.data.thickness = 0.01;  // a bar
  EXPECT_THAT(names(web.objections(1e-4)), ElementsAre());
}

TEST(Section, TheKnifeRefusesATube) {
  WebDefinition web = tube(1);
  RotaryKnifeDefinition knife;
  const auto found = knife.objections_with([&](std::string_view) { return &web; }, 1e-4);
  ASSERT_THAT(names(found), ElementsAre("web"));
  EXPECT_THAT(found[0].what, HasSubstr("a rotary knife cuts no tube"));
  web.data.section = "strip";
  web.data.thickness = 0.2;
  EXPECT_THAT(names(knife.objections_with([&](std::string_view) { return &web; }, 1e-4)),
              ElementsAre("circumference"));
  web.data.thickness = 0.02;
  knife.data.blade_count = 12;
  EXPECT_THAT(names(knife.objections_with([&](std::string_view) { return &web; }, 1e-4)),
              ElementsAre("blade_count"));
  web.data.thickness = 1e-3;
  EXPECT_THAT(names(knife.objections_with([&](std::string_view) { return &web; }, 1e-4)), ElementsAre());
  EXPECT_THAT(names(knife.objections_with([](std::string_view) { return nullptr; }, 1e-4)), ElementsAre());
}

TEST(FlyingSawDefinition, WhatCannotBeBuiltIsRefused) {
  const auto objections = [](auto change) {
    FlyingSawDefinition definition;
    change(definition.data);
    return names(definition.objections(1e-4));
  };
  using Data = FlyingSawData;
  EXPECT_THAT(objections([](Data&) {}), ElementsAre());
  EXPECT_THAT(objections([](Data& d) { d.gear.stiffness = 1e8; }), ElementsAre("gear.stiffness"));
  EXPECT_THAT(objections([](Data& d) { d.stop.damping = 2e6; }), ElementsAre("stop.damping"));
  EXPECT_THAT(objections([](Data& d) { d.head.mass = 1; }), ElementsAre("head.mass"));
  EXPECT_THAT(objections([](Data& d) { d.motor_friction.viscous = 99; }),
              ElementsAre("motor_friction.viscous"));
  EXPECT_THAT(objections([](Data& d) { d.carriage_friction.viscous = 1e6; }),
              ElementsAre("carriage_friction.viscous"));
  EXPECT_THAT(objections([](Data& d) { d.travel_max = -1; }), ElementsAre("travel_max"));
  EXPECT_THAT(objections([](Data& d) { d.start = 2; }), ElementsAre("start"));
  EXPECT_THAT(objections([](Data& d) { d.sensors.limit_max = -1; }), ElementsAre("limit_max"));
  EXPECT_THAT(objections([](Data& d) { d.head.up_force = 100; }), ElementsAre("head.up_force"));
  EXPECT_THAT(objections([](Data& d) { d.drive.servo.max_speed = 1; }), ElementsAre("servo.max_speed"));
}

TEST(FlyingSawDefinition, AStrokeThatCannotFitIsPredicted) {
  WebDefinition web = tube(2);
  FlyingSawDefinition saw;
  const auto found = [&] { return saw.objections_with([&](std::string_view) { return &web; }, 1e-4); };
  EXPECT_THAT(names(found()), ElementsAre());
  saw.data.travel_max = 0.3;
  ASSERT_THAT(names(found()), ElementsAre("travel_max"));
  EXPECT_THAT(found()[0].what, AllOf(HasSubstr("at 120 m/min a cut takes the carriage at least"),
                                     HasSubstr("340 mm are there: it would crash into the end stop")));
  EXPECT_THAT(found()[0].remedy, HasSubstr("stroke_check: off"));
  saw.data.stroke_check = false;
  EXPECT_THAT(names(found()), ElementsAre());
  saw.data.head.stroke = 0.05;
  ASSERT_THAT(names(found()), ElementsAre("head.stroke"));
  EXPECT_THAT(found()[0].what, HasSubstr("do not go through 40 mm of material"));
  EXPECT_THAT(found()[0].remedy, HasSubstr("more than 57 mm"));
}

TEST(FlyingSawDefinition, TheLeastStrokeIsNeverMoreThanACutTakes) {
  // The quickest sequence that a program can give, at full speed from the start: its way is the stroke of the
  // constant speed, and it takes as long as the prediction or a little longer.
  FlyingSawDefinition definition;
  const Section section = {0.04, 2e-3, true};
  const LeastStroke least = least_stroke(definition.data, section, 0.5);
  SawLine line(definition, tube(0));
  plug<CommandPort>(*line.saw, "clamp").level = true;
  double open = 0;
  for (int i = 0; i < 10000 && open == 0; ++i) {
    line.step();
    const bool grips = plug<SignalPort>(*line.saw, "clamp.closed").level;
    if (grips && line.events.empty()) plug<CommandPort>(*line.saw, "head.plunge").level = true;
    if (line.events.empty()) continue;
    plug<CommandPort>(*line.saw, "head.plunge").level = false;
    if (channel(*line.saw, "blade.engaged") == 0) plug<CommandPort>(*line.saw, "clamp").level = false;
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

TEST(FlyingSawDefinition, EveryPartHasAPoseAndTheCarriageTakesItsPartsAlong) {
  for (const double lead : {0.2, 0.02}) {  // rack, screw
    FlyingSawDefinition definition;
    definition.data.lead = lead;
    definition.data.gear.ratio = lead > 0.1 ? 4 : 1;
    SawLine line(definition);
    std::vector<PartPose> before;
    std::vector<PartPose> after;
    line.saw->poses(before);
    const auto parts = line.saw->parts();
    ASSERT_EQ(before.size(), parts.size());
    line.carriage().position += 0.25;
    line.saw->poses(after);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double way = after[i].pose.position[0] - before[i].pose.position[0];
      const bool bed = parts[i].name == "bed" || parts[i].name == "rail 1" || parts[i].name == "stop 2";
      const bool carried = parts[i].name == "carriage" || parts[i].name == "saw blade";
      if (bed) {
        EXPECT_EQ(way, 0) << parts[i].name;
      }
      if (carried) {
        EXPECT_NEAR(way, 0.25, 1e-12) << parts[i].name;
      }
    }
    line.web->poses(after);
    EXPECT_EQ(after.size(), line.web->parts().size());
  }
}

TEST(FlyingSawDefinition, APieceLeavesTheCutWhereItWasMade) {
  FlyingSawDefinition definition;
  definition.data.start = 0.4;
  WebDefinition web = tube(0);
  web.data.lead = 1;
  SawLine line(definition, web);
  plug<CommandPort>(*line.saw, "head.plunge").level = true;
  line.run(0.5);
  ASSERT_EQ(line.events.size(), 1U);
  EXPECT_NEAR(value(line.events[0], "length"), 600, 1e-6);
  const auto& outfeed = static_cast<Web&>(*line.web).outfeed();
  EXPECT_NEAR(outfeed.pieces()[0].body->position, 0.7, 1e-6);
  EXPECT_NEAR(outfeed.pieces()[0].length, 0.6, 1e-9);
}

}  // namespace
}  // namespace drycut::plants
