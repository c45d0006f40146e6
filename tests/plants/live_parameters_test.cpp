// Parameters that change while a machine runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "plants/backlash_axis.hpp"
#include "plants/linear_axis.hpp"
#include "plants/rotary_knife.hpp"
#include "plants/vertical_press.hpp"
#include "plants/web.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

using testing::Contains;
using testing::IsSupersetOf;

/// Writes a live parameter as the timeline does.
void change_live(Plant& plant, const std::string& name, double si) {
  for (const Parameter& row : plant.live_parameters()) {
    if (row.name != name) continue;
    *std::get<double*>(row.value) = si;
    return plant.parameters_changed();
  }
  ADD_FAILURE() << name << " is not live";
}

/// The quantities of a table that are live, by name.
std::map<std::string, double> live_values(Parameters rows) {
  std::map<std::string, double> found;
  for (const Parameter& row : live_rows(std::move(rows)))
    found.emplace(row.name, *std::get<double*>(row.value));
  return found;
}

// Every machine has the live rows of its table, with the values that it was built with; taking them over as
// they are changes nothing.
TEST(LiveParameters, AreTheRowsOfTheTableBoundToTheMachine) {
  for (const PlantType& type : plant_types()) {
    SCOPED_TRACE(type.name);
    WebDefinition web;
    auto definition = type.define();
    auto other = type.define();
    Machine changed(*definition, &web);
    Machine plain(*other, &web);
    const auto live = live_values(definition->parameters());
    EXPECT_EQ(live_values(changed.plant->live_parameters()), live);
    for (int i = 0; i < 100; ++i) {
      changed.plant->parameters_changed();
      changed.step();
      plain.step();
    }
    const auto channels = plain.plant->channels();
    for (const Channel& c : channels) EXPECT_EQ(channel(*changed.plant, c.name), c.read()) << c.name;
  }
}

TEST(LiveParameters, AreFrictionInertiaStiffnessGapAndMass) {
  const auto names = [](PlantDefinition&& definition) {
    std::vector<std::string> all;
    for (const auto& [name, value] : live_values(definition.parameters())) all.push_back(name);
    return all;
  };
  EXPECT_THAT(names(RotaryKnifeDefinition()),
              testing::UnorderedElementsAre(
                  "counter.inertia", "counter.friction.coulomb", "counter.friction.viscous", "drum_inertia",
                  "drum_friction.coulomb", "drum_friction.viscous", "drum_friction.breakaway",
                  "drum_friction.backward", "drum_friction.viscous_backward", "motor_friction.coulomb",
                  "motor_friction.viscous", "motor_friction.breakaway", "motor_friction.backward",
                  "motor_friction.viscous_backward", "gear.stiffness", "gear.damping", "gear.backlash"));
  EXPECT_THAT(names(WebDefinition()),
              testing::UnorderedElementsAre("mass", "drive.acceleration", "drive.stiffness", "drive.damping",
                                            "drive.max_force"));
  EXPECT_THAT(names(BacklashAxisDefinition()),
              IsSupersetOf({"gap", "contact.stiffness", "contact.restitution", "mass"}));
  EXPECT_THAT(names(LinearAxisDefinition()),
              IsSupersetOf({"mass", "gear.backlash", "carriage_friction.coulomb"}));
  EXPECT_THAT(names(VerticalPressDefinition()),
              IsSupersetOf({"mass", "counterbalance", "ram_friction.coulomb"}));
}

TEST(LiveParameters, ABodyOfAnotherMassOrInertiaKeepsItsSpeed) {
  World world;
  Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 2, .speed = 10});
  Slide& slide = world.add_slide({.name = "slide", .mass = 3, .speed = 1});
  const auto push = [&] {
    shaft.add_torque(6);
    slide.add_force(12);
    world.step(h);
  };
  push();
  EXPECT_NEAR(shaft.speed, 10 + 3 * h, 1e-12);
  EXPECT_NEAR(slide.speed, 1 + 4 * h, 1e-12);
  world.set_inertia(shaft, 0.5);
  world.set_mass(slide, 24);
  EXPECT_EQ(shaft.inertia, 0.5);
  push();
  EXPECT_NEAR(shaft.speed, 10 + 3 * h + 12 * h, 1e-12);
  EXPECT_NEAR(slide.speed, 1 + 4 * h + 0.5 * h, 1e-12);
  World other;
  EXPECT_THROW(other.set_inertia(shaft, 1), std::invalid_argument);
}

// Under dry friction alone drum and motor lose half their speed in inertia times speed over torque.
TEST(LiveParameters, ADrumOfAnotherInertiaCoastsAccordingly) {
  for (const double inertia : {0.2, 0.41, 1.5}) {
    RotaryKnifeDefinition knife;
    knife.data.motor_friction = {};
    knife.data.drum_friction = {20, 0, 0, 0};
    WebDefinition web;
    Machine line(knife, &web);
    auto& drum = static_cast<RotaryKnife&>(*line.plant).drum();
    auto& rotor = static_cast<RotaryKnife&>(*line.plant).rotor();
    line.command("servo.enable", false);
    drum.speed = 5;
    rotor.speed = 5 * knife.data.gear.ratio;
    change_live(*line.plant, "drum_inertia", inertia);
    EXPECT_EQ(drum.speed, 5);
    while (drum.speed > 2.5 && line.steps < 20000) line.step();
    const double total = inertia + rotor.inertia * knife.data.gear.ratio * knife.data.gear.ratio;
    EXPECT_NEAR(line.steps * h, total * 2.5 / 20, 0.01 * total * 2.5 / 20 + 2 * h);
  }
}

TEST(LiveParameters, AWiderGapIsTravelledThrough) {
  BacklashAxisDefinition definition;
  Machine axis(definition);
  const auto play = [&] {
    axis.reference(0.2);
    axis.run(1);
    const double one = axis.read("gear.ahead");
    axis.reference(-0.2);
    axis.run(1);
    return one - axis.read("gear.ahead");
  };
  EXPECT_NEAR(play(), 1, 0.02);
  change_live(*axis.plant, "gap", 2.5e-3);
  EXPECT_NEAR(play(), 2.5, 0.02);
}

TEST(LiveParameters, ARamThatBecomesHeavierKeepsItsLoad) {
  VerticalPressDefinition definition;
  Machine press(definition);
  press.set("load", 50);
  change_live(*press.plant, "mass", 700);
  EXPECT_EQ(press.read("mass"), 750);
  press.set("load", 20);
  EXPECT_EQ(press.read("mass"), 720);
}

}  // namespace
}  // namespace drycut::plants
