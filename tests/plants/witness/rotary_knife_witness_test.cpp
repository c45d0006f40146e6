#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <vector>

#include "plants/rotary_knife.hpp"
#include "tests/plants/witness/compare.hpp"
#include "tests/plants/witness/knife_law.hpp"

namespace drycut::plants::witness {
namespace {

/// The knife on a web that nothing drives.
struct Knife : Machine {
  Knife(RotaryKnifeDefinition knife, WebDefinition web) : Machine(knife, &web) {}
  void process(double /*force*/) {}
  void record(Track& track) const {
    auto& knife = static_cast<RotaryKnife&>(*plant);
    track.motor.push_back(knife.rotor().angle() / ratio * knife.radius());
    track.load.push_back(knife.drum().angle() * knife.radius());
  }
  double ratio = 1;
};

// The speed loop is set soft, so that the motion is the mechanics' more than the reference's; the gear has
// play.
RotaryKnifeDefinition soft_knife() {
  RotaryKnifeDefinition knife;
  ServoData& servo = knife.data.drive.servo;
  servo.speed_gain = 30;
  servo.integral_time = 0.1;
  servo.adc_bits = 24;
  knife.data.gear.backlash = 2e-3;
  knife.data.gear.efficiency = {0.94, 0.9};
  return knife;
}

WebDefinition coasting_web() {
  WebDefinition web;
  web.data.mass = 100;
  web.data.drive.speed = 0.93;
  web.data.drive.stiffness = 1;
  web.data.drive.damping = 0;
  web.data.drive.max_force = 1e-12;
  return web;
}

// Runs up, cuts twice, reverses while the blade is up.
const Motion two_cuts = {
    {{0.2, 0, 2.5}, {1.2, 2.5, 2.5}, {1.4, 2.5, -0.8}, {1.8, -0.8, -0.8}, {1.9, -0.8, 0}, {2, 0, 0}}};

TEST(Witness, RotaryKnife) {
  const auto unit = [] {
    auto knife = std::make_unique<Knife>(soft_knife(), coasting_web());
    knife->ratio = soft_knife().data.gear.ratio;
    return knife;
  };
  const auto law = [] {
    return std::make_unique<KnifeLaw>(soft_knife().data, coasting_web().data, two_cuts);
  };
  expect_witness<KnifeLaw>(
      unit, law, 2.5e-6, 2e-7,
      {{"no damping of the gear", [](KnifeLaw& l) { l.data.gear.damping = 0; }},
       {"no play", [](KnifeLaw& l) { l.data.gear.backlash = 0; }},
       {"no losses when driving", [](KnifeLaw& l) { l.data.gear.efficiency.driving = 1; }},
       {"no losses when driven", [](KnifeLaw& l) { l.data.gear.efficiency.driven = 1; }},
       {"drum as if before the gear", [](KnifeLaw& l) { l.inertia /= l.data.gear.ratio; }},
       {"half the dry friction of the motor", [](KnifeLaw& l) { l.motor_friction.data.coulomb /= 2; }},
       {"motor without viscous friction", [](KnifeLaw& l) { l.motor_friction.data.viscous = 0; }},
       {"half the dry friction of the drum", [](KnifeLaw& l) { l.drum_friction.data.coulomb /= 2; }},
       {"drum without viscous friction", [](KnifeLaw& l) { l.drum_friction.data.viscous = 0; }},
       {"no cutting force", [](KnifeLaw& l) { l.peak = 0; }},
       {"no pull of the web", [](KnifeLaw& l) { l.data.coupling = 0; }},
       {"a web that nothing moves", [](KnifeLaw& l) { l.web.mass *= 1e6; }},
       {"half the reference filter", [](KnifeLaw& l) { l.servo.data.filter /= 2; }},
       {"half the current lag", [](KnifeLaw& l) { l.servo.data.current_lag /= 2; }}});
}

// Two drums with helical blades and a motor on each.
TEST(Witness, HelicalTwinKnife) {
  const auto knife = [] {
    auto one = soft_knife();
    one.data.helix = 3.0 / 180 * std::numbers::pi;
    one.data.counter = {.kind = "blades", .inertia = 0.3, .ratio = 1, .friction = {1.5, 0.2, 0, 0}};
    one.data.motors = 2;
    return one;
  };
  const auto wide_web = [] {
    auto web = coasting_web();
    web.data.width = 1;
    web.data.shear_strength = 10e6;
    return web;
  };
  const auto unit = [&] {
    auto one = std::make_unique<Knife>(knife(), wide_web());
    one->ratio = knife().data.gear.ratio;
    return one;
  };
  const auto law = [&] { return std::make_unique<KnifeLaw>(knife().data, wide_web().data, two_cuts); };
  expect_witness<KnifeLaw>(
      unit, law, 2.5e-6, 5e-7,
      {{"straight blades", [](KnifeLaw& l) { l.helix = 0; }},
       {"a helix of half the angle", [](KnifeLaw& l) { l.helix /= 2; }},
       {"blades that close in as on an anvil", [](KnifeLaw& l) { l.closing /= 2; }},
       {"no counter drum", [](KnifeLaw& l) { l.inertia = l.data.drum_inertia; }},
       {"without its friction", [](KnifeLaw& l) { l.drum_friction.data = l.data.drum_friction; }},
       {"one motor", [](KnifeLaw& l) { l.data.motors = 1; }},
       {"no cutting force", [](KnifeLaw& l) { l.peak = 0; }},
       {"no pull of the web", [](KnifeLaw& l) { l.data.coupling = 0; }}});
}

}  // namespace
}  // namespace drycut::plants::witness
