// What the step can follow: pairs at the bound against their closed forms and against a tenth of the step,
// and every plant's objection just outside.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "plants/backlash_axis.hpp"
#include "plants/flying_saw.hpp"
#include "plants/ideal_axis.hpp"
#include "plants/rotary_knife.hpp"
#include "plants/stiff_pair.hpp"
#include "plants/vertical_press.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// Turn a unit of time of a motion that crosses 0 upwards, and the largest of it in the last tenth of `time`.
struct Oscillation {
  double frequency = 0;  ///< [rad/s]
  double largest = 0;
};
Oscillation watch(double h, double time, const std::function<double()>& next) {
  Oscillation found;
  std::vector<double> crossings;
  double before = next();
  const auto steps = std::lround(time / h);
  for (long i = 1; i < steps; ++i) {
    const double now = next();
    if (before < 0 && now >= 0) crossings.push_back((static_cast<double>(i) + before / (before - now)) * h);
    if (i > steps - steps / 10) found.largest = std::max(found.largest, std::abs(now));
    before = now;
  }
  if (crossings.size() > 1)
    found.frequency =
        2 * pi * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
  return found;
}

/// A web that is 10 mm/s faster than its line drive.
Oscillation web_on_its_drive(double mass, double stiffness, double damping, double h, double time) {
  World world;
  Slide& web = world.add_slide({.name = "web", .mass = mass, .speed = 1.01});
  LineDrive drive({.speed = 1, .stiffness = stiffness, .damping = damping, .max_force = 1e6});
  return watch(h, time, [&] {
    drive.drive(web, h);
    world.step(h);
    return web.speed - 1;
  });
}

TEST(StiffPair, AWebAtTheBoundOscillatesAsItsClosedForm) {
  const StiffPair pair = {2e5, 0, 20};
  const double w = std::sqrt(pair.stiffness / pair.inertia);
  const double h = longest_step_of_spring(pair);
  EXPECT_NEAR(h * w, 0.6, 1e-12);
  const auto at_bound = web_on_its_drive(20, 2e5, 0, h, 10);
  const auto finer = web_on_its_drive(20, 2e5, 0, h / 10, 10);
  EXPECT_NEAR(at_bound.frequency / w, 1, 0.016);
  EXPECT_NEAR(finer.frequency / w, 1, 2e-4);
  // Hundreds of oscillations later it is neither larger nor smaller.
  EXPECT_NEAR(at_bound.largest, 0.01, 6e-4);
  EXPECT_NEAR(finer.largest, 0.01, 2e-5);
}

TEST(StiffPair, ADampedWebSettlesAsItsClosedForm) {
  // The largest of the last tenth: exp(-c t / 2 m) of the start, less what half an oscillation more takes.
  for (const auto& [mass, stiffness, damping] : {std::tuple(1.0, 2e5, 10.0), {20.0, 5e7, 200.0}}) {
    const double envelope = 0.01 * std::exp(-damping / (2 * mass) * 0.45);
    EXPECT_NEAR(web_on_its_drive(mass, stiffness, damping, 1e-4, 0.5).largest / envelope, 1, 0.05) << mass;
    EXPECT_NEAR(web_on_its_drive(mass, stiffness, damping, 1e-5, 0.5).largest / envelope, 1, 0.05) << mass;
  }
}

TEST(StiffPair, ADamperAtTheBoundIsLateByLessThanHalfAStep) {
  const StiffPair pair = {0, 2000, 1};
  const double h = longest_step_of_damper(pair);
  EXPECT_NEAR(h, 1e-4, 1e-15);
  World world;
  Slide& web = world.add_slide({.name = "web", .mass = 1, .speed = 1 + std::exp(1)});
  LineDrive drive({.speed = 1, .stiffness = 1e-3, .damping = 2000, .max_force = 1e6});
  double before = web.speed - 1;
  double time = 0;  // until the e-th part is left
  while (web.speed > 2) {
    before = web.speed - 1;
    drive.drive(web, h);
    world.step(h);
    time += h;
  }
  const double left = web.speed - 1;
  time -= h * (1 - left) / (before - left);
  EXPECT_NEAR(time, 0.5e-3, h / 2);
}

TEST(StiffPair, AGearAtTheBoundOscillatesAsItsClosedForm) {
  const double j = 0.01;
  const double load = 0.03;
  const TransmissionData data = {1, 5000, 0, 0};
  const StiffPair pair = {data.stiffness, 0, reduced(j, load)};
  const auto run = [&](double h) {
    World world;
    Shaft& motor = world.add_shaft({.name = "motor", .inertia = j, .speed = 1});
    Shaft& drum = world.add_shaft({.name = "load", .inertia = load, .speed = -j / load});
    Transmission gear(data);
    return watch(h, 2, [&] {
      gear.drive(motor, drum);
      world.step(h);
      gear.sense(motor, drum, h);
      return motor.speed;
    });
  };
  const double w = resonance(data, j, load);
  EXPECT_NEAR(run(longest_step_of_spring(pair)).frequency / w, 1, 0.016);
  EXPECT_NEAR(run(longest_step_of_spring(pair) / 10).frequency / w, 1, 2e-4);
}

TEST(StiffPair, AnEndStopAtTheBoundThrowsBackWhatCame) {
  const StiffPair pair = {2e6, 0, 20};
  const double bound = longest_step_of_spring(pair);
  const auto thrown_back = [&](double h, double phase) {
    World world;
    Slide& slide = world.add_slide({.name = "slide", .mass = 20, .position = -phase * h, .speed = 1});
    EndStop stop({pair.stiffness, 0}, 0, 1);
    do {
      stop.drive(slide, h);
      world.step(h);
    } while (slide.position > 0 || slide.speed > 0);
    return -slide.speed;
  };
  for (double phase = 0.05; phase < 1; phase += 0.1) {
    EXPECT_NEAR(thrown_back(bound, phase), 1, 0.035) << phase;
    EXPECT_NEAR(thrown_back(bound / 10, phase), 1, 0.001) << phase;
  }
}

/// `parameter` is objected to for steps longer than `longest` and for no shorter ones.
void expect_bound(PlantDefinition& definition, const std::string& parameter, double longest,
                  WebDefinition* web = nullptr) {
  const auto objected = testing::Contains(testing::StartsWith(parameter + ": "));
  EXPECT_THAT(objections_of(definition, 0.999 * longest, web), testing::Not(objected));
  EXPECT_THAT(objections_of(definition, 1.001 * longest, web), objected);
}

TEST(StiffPair, EveryPlantObjectsJustOutsideItsBound) {
  WebDefinition web;
  web.data.drive.stiffness = 5e7;
  expect_bound(web, "drive.stiffness", 0.6 * std::sqrt(20 / 5e7));
  web.data = {};
  web.data.mass = 1;
  expect_bound(web, "drive.damping", 0.2 / 2800);

  RotaryKnifeDefinition knife;
  const double blades = 0.41 / std::pow(0.6 / (2 * pi), 2);  // the drum at the blades' circle [kg]
  expect_bound(knife, "coupling", 0.2 * reduced(blades, 1) / 2000, &web);

  RotaryKnifeDefinition geared;
  geared.data.gear.damping = 0;
  expect_bound(geared, "gear.stiffness",
               0.6 / resonance(geared.data.gear, geared.data.drive.servo.rotor_inertia, 0.41));

  FlyingSawDefinition saw;
  saw.data.blade.stiffness = 1e8;
  expect_bound(saw, "blade.stiffness", 0.6 * std::sqrt(reduced(60, 1) / 1e8), &web);
  FlyingSawDefinition head;
  head.data.head.mass = 1;
  expect_bound(head, "head.mass", 0.2 * 1 / 4e3);

  LinearAxisDefinition axis;
  axis.data.stop.stiffness = 1e9;
  expect_bound(axis, "stop.stiffness", 0.6 * std::sqrt(20 / 1e9));
  LinearAxisDefinition rubbed;
  rubbed.data.guide_friction.viscous = 1e5;
  expect_bound(rubbed, "carriage_friction.viscous", 0.2 * 20 / 1e5);

  VerticalPressDefinition press;
  press.data.workpiece = {1e10, 0};
  press.data.mass = 100;
  expect_bound(press, "workpiece.stiffness", 0.6 * std::sqrt(100 / 1e10));

  BacklashAxisDefinition backlash;
  backlash.flanks = {1e-3, 1e9, 1};
  const auto& of = backlash.axis.data;
  const double motor =
      (of.drive.servo.rotor_inertia + of.screw_inertia) / std::pow(of.lead / (2 * pi), 2);  // [kg]
  const double flank = 0.6 * std::sqrt(reduced(motor, 100) / 1e9);
  EXPECT_THAT(objections_of(backlash, 0.999 * flank), testing::IsEmpty());
  EXPECT_THAT(objections_of(backlash, 1.001 * flank),
              testing::ElementsAre(testing::StartsWith("contact.stiffness: ")));
}

TEST(StiffPair, DrivesObjectToStepsThatTheirLoopsCannotTake) {
  // s g = 0.5 at the bound: share of the current's lag times gain on the rotor in a step.
  RotaryKnifeDefinition knife;
  knife.data.drive.kind = "pulses";
  knife.data.drive.pulses.position_gain = 1000;
  EXPECT_THAT(objections_of(knife, 1e-4), testing::IsEmpty());
  EXPECT_THAT(objections_of(knife, 201e-6),
              testing::ElementsAre(testing::StartsWith("servo.pulses.position_gain: ")));
  knife.data.drive.servo.current_lag = 0;
  knife.data.drive.servo.speed_gain = 1000;  // 4.5 rotors: 4500 /s on the rotor alone
  EXPECT_THAT(objections_of(knife, 0.5 / 4500 * 0.999), testing::IsEmpty());
  EXPECT_THAT(objections_of(knife, 0.5 / 4500 * 1.001),
              testing::ElementsAre(testing::StartsWith("servo.speed_gain: ")));
}

TEST(StiffPair, AnObjectionTellsTheMotionAndTheStepThatWouldDo) {
  WebDefinition web;
  web.data.drive.stiffness = 1e9;
  const auto objections = web.objections(1e-4);
  ASSERT_EQ(objections.size(), 1U);
  EXPECT_EQ(objections[0].what, "web and line drive oscillate at 1125 Hz, steps of 100 us cannot follow");
  EXPECT_EQ(objections[0].remedy, "scene.step of at most 50 us, or softer, less damped, heavier parts");
}

TEST(IdealAxis, MoreIndexPulsesAStepThanAreUsefulAreTold) {
  IdealAxisDefinition axis;
  axis.data.index_pitch = 1e-5;
  EXPECT_THAT(axis.objections(9.9e-3), testing::IsEmpty());
  const auto objections = axis.objections(20e-3);
  ASSERT_EQ(objections.size(), 1U);
  EXPECT_EQ(objections[0].parameter, "index_pitch");
  EXPECT_EQ(objections[0].what, "at 1000 mm/s the axis passes 2000 index pulses in a step of 20000 us");
  EXPECT_EQ(objections[0].remedy, "at least 0.02 mm");
}

}  // namespace
}  // namespace drycut::plants
