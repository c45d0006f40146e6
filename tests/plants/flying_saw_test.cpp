#include "plants/flying_saw.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/plants/flying_saw_line.hpp"
#include "tests/plants/screw_prediction.hpp"

namespace drycut::plants {
namespace {

TEST(FlyingSaw, TheTrainOfPulsesOrTheVoltageDrivesTheSameCarriage) {
  SawLine volts(frictionless_saw());
  volts.run(0.1);
  volts.reference(3);
  volts.run(0.5);
  EXPECT_NEAR(volts.read("speed"), 0.3 * 3000 * 0.2 / 4, 0.05);
  auto definition = frictionless_saw();
  definition.data.drive.kind = "pulses";
  SawLine pulses(definition);
  pulses.command("servo.direction", true);
  auto& train = pulses.plug<PulsePort>("servo.pulses");
  for (int i = 0; i < 10000; ++i) {
    train.pulses += i < 5000 ? 10 : 0;
    pulses.step();
  }
  EXPECT_NEAR(pulses.read("position"), 50000.0 / 10000 / 4 * 200, 0.01);
}

TEST(FlyingSaw, CrashTakesMassTimesSpeedAndItsRebound) {
  for (const double side : {-1.0, 1.0}) {
    auto definition = free_saw();
    definition.data.stop = {2e6, 4e3};
    definition.data.start = side > 0 ? 0.7 : 0.0;
    SawLine line(definition);
    line.carriage().speed = side * 0.8;
    line.run(0.3);
    const MachineEvent& crash = line.only("crash");
    EXPECT_EQ(value(crash, "side"), side);
    EXPECT_NEAR(value(crash, "speed"), 800, 1e-6);
    // Spring and damper that only push part when their force is 0 (Schwager and Poeschel 2007).
    const double zeta = 4e3 / (2 * std::sqrt(2e6 * 60));
    const double root = std::sqrt(1 - zeta * zeta);
    const double e =
        std::exp(-zeta / root * (std::numbers::pi - std::atan2(2 * zeta * root, 1 - 2 * zeta * zeta)));
    EXPECT_NEAR(value(crash, "impulse") / (60 * 0.8 * (1 + e)), 1, 5e-3);
    EXPECT_NEAR(-side * line.carriage().speed / (0.8 * e), 1, 2e-2);
    EXPECT_NEAR(value(crash, "impulse"), 60 * (0.8 - side * line.carriage().speed), 1e-9);
    EXPECT_NEAR(value(crash, "force") / (0.8 * std::sqrt(2e6 * 60)), 0.8, 0.2);
  }
}

TEST(FlyingSaw, ACarriageThatLeansOnItsStopIsReportedOnce) {
  SawLine line(frictionless_saw());
  line.reference(-1);
  line.run(2);
  ASSERT_GE(line.events.size(), 1U);
  const auto crashes = line.events.size();
  line.run(1);
  EXPECT_EQ(line.events.size(), crashes);
  EXPECT_LT(line.read("position"), -40);
}

TEST(FlyingSaw, ClampsHoldUpToTheirFriction) {
  // 2 mu N = 2400 N; the material is held by its own mass and a weak line drive.
  for (const double pull : {2000.0, 3000.0}) {
    auto definition = free_saw();
    definition.data.clamp = {.force = 6000, .friction = 0.2, .close_time = 0, .open_time = 0};
    SawLine line(definition, free_web(0));
    line.command("clamp", true);
    // On the carriage of 60 kg; to take 20 kg along the clamps need a quarter of the pull.
    line.set("force", pull * 4);
    line.run(0.05);
    const double slipping = pull > 2400 ? (pull * 4 - 2400) / 60 - 2400.0 / 20 : 0;  // relative acceleration
    EXPECT_NEAR(line.carriage().speed - line.material().speed, slipping * 0.05, 1e-9);
    EXPECT_NEAR(line.read("clamp.force"), pull > 2400 ? -2400 : -pull, 1e-6);
    EXPECT_NEAR(line.read("clamp.slip"), 1000 * slipping * (0.05 * 0.05 + 0.05 * h) / 2, 1e-3);
    EXPECT_NEAR(line.carriage().speed * 60 + line.material().speed * 20, pull * 4 * 0.05, 1e-9);
  }
}

TEST(FlyingSaw, ClampsTakeTheirTimeAndAFaultTakesTheirForce) {
  auto definition = frictionless_saw();
  SawLine line(definition, free_web(0));
  auto& closed = line.plug<SignalPort>("clamp.closed");
  line.command("clamp", true);
  line.run(0.0299);
  EXPECT_FALSE(closed.level);
  line.run(0.0002);
  EXPECT_TRUE(closed.level);
  EXPECT_EQ(line.saw().clamp().limit(), 2400);
  line.fault("clamp", "force_loss", 0.75);
  EXPECT_EQ(line.saw().clamp().limit(), 600);
  line.command("clamp", false);
  line.run(0.0199);
  EXPECT_TRUE(closed.level);
  line.run(0.0002);
  EXPECT_FALSE(closed.level);
  EXPECT_EQ(line.saw().clamp().limit(), 0);
}

TEST(FlyingSaw, ABladeThatComesIntoMaterialThatNothingClampsIsTold) {
  for (const double lost : {0.0, 0.7, 1.0})
    for (const bool clamped : {true, false}) {
      auto definition = frictionless_saw();
      SawLine line(definition, tube(0));
      line.fault("clamp", "force_loss", lost);
      line.command("clamp", clamped);
      line.run(0.1);
      line.command("head.plunge", true);
      line.run(0.5);
      EXPECT_EQ(line.unclamped, clamped && lost < 1 ? 0 : 1) << lost << clamped;
    }
}

TEST(FlyingSaw, SawHeadMovesAtTheSpeedOfItsThrottles) {
  auto definition = frictionless_saw();
  auto& head = definition.data.head;
  head.stroke = 1;
  head.clearance = 0.9;
  head.fill_time = 0;
  SawLine line(definition);
  line.command("head.plunge", true);
  line.run(head.valve_delay);
  EXPECT_NEAR(line.depth(), 0, 1e-3);
  line.run(0.5);
  EXPECT_NEAR(line.head_speed(), plunge_speed(head), 1e-3);
  EXPECT_NEAR(plunge_speed(head), (350 + 12 * 9.80665) / 600, 1e-12);
  // Way of a first-order run-up: v (t - m/b).
  EXPECT_NEAR(line.depth(), plunge_speed(head) * (0.5 - 12.0 / 600), 2e-3);
  line.command("head.plunge", false);
  line.run(head.valve_delay + 0.2);
  EXPECT_NEAR(line.head_speed(), -return_speed(head), 1e-2);
  line.run(1);
  EXPECT_TRUE(line.plug<SignalPort>("head.up").level);
  EXPECT_FALSE(line.plug<SignalPort>("head.down").level);
  line.fault("head", "pressure_loss", 0.5);
  line.command("head.plunge", true);
  line.run(0.5);
  EXPECT_NEAR(line.head_speed(), (175 + 12 * 9.80665) / 600, 2e-3);
}

TEST(FlyingSaw, CutsTheTubeInTheTimeOfItsLaw) {
  auto definition = frictionless_saw();
  definition.data.head.mass = 0.1;  // no inertia: the balance of forces at every moment
  definition.data.blade.resistance = 4e5;
  SawLine line(definition, tube(0.0));
  line.command("head.plunge", true);
  line.run(1);
  const MachineEvent& cut = line.only("cut");
  const double area = std::numbers::pi * 2e-3 * (0.04 - 2e-3);
  const double force = 350 + 0.1 * 9.80665;
  const double time = (600 * 0.04 + 4e5 * area) / force;
  EXPECT_NEAR(cutting_time(definition.data.blade, {0.04, 2e-3, true}, force, 600), time, 1e-12);
  EXPECT_NEAR(value(cut, "time") / (1000 * time), 1, 1e-3);
  EXPECT_LT(value(cut, "force"), force * 1.03);  // and a little of the head's momentum at the touch
  EXPECT_EQ(value(cut, "pinch"), 0);
  EXPECT_EQ(value(cut, "length"), 0);
  EXPECT_TRUE(line.plug<SignalPort>("head.down").level);
}

TEST(FlyingSaw, TheCutTakesTheEnergyOfItsForce) {
  // A strip has the same width all through: resistance * width * speed over its thickness, with the
  // cylinder's force balanced the plunge is as fast as (F + m g)/(b + c w).
  auto definition = frictionless_saw();
  definition.data.blade.resistance = 1e4;
  definition.data.head.fill_time = 0;
  definition.data.head.mass = 0.5;
  WebDefinition web = free_web(0);
  web.data.thickness = 0.05;
  SawLine line(definition, web);
  line.command("head.plunge", true);
  double work = 0;
  while (line.events.empty() && line.steps < 20000) {
    line.step();
    work += line.read("cut.force") * line.head_speed() * h;
  }
  ASSERT_EQ(line.events.size(), 1U);
  const double resistance = 1e4 * 0.3;
  const double speed = (350 + 0.5 * 9.80665) / (600 + resistance);
  EXPECT_NEAR(value(line.events[0], "time") / (1000 * 0.05 / speed), 1, 0.01);
  EXPECT_NEAR(work / (resistance * speed * 0.05), 1, 0.02);
}

TEST(FlyingSaw, PinchIsStiffnessTimesDisplacement) {
  // Carriage and material too heavy to be disturbed, the carriage 5 mm/s faster.
  auto definition = free_saw();
  definition.data.mass = 1e5;
  definition.data.blade.damping = 0;
  definition.data.blade.yield = 1000;
  definition.data.blade.resistance = 1e6;  // a slow cut
  WebDefinition web = tube(0.5);
  web.data.mass = 1e5;
  SawLine line(definition, web);
  line.carriage().speed = 0.505;
  line.command("head.plunge", true);
  double slid = 0;
  double largest = 0;
  while (line.steps < 20000 && line.read("cut.number") == 0) {
    line.step();
    const double displacement = line.read("blade.displacement");
    if (line.read("blade.engaged") == 0) continue;
    if (slid == 0)
      slid = displacement / 1000;  // of the step in which it touched
    else
      slid += (line.carriage().speed - line.material().speed) * h;
    // The force of a step is that of the displacement before it.
    const double expected = -std::min(1000.0, 2e5 * std::max(0.0, displacement / 1000 - 5e-3 * h));
    EXPECT_NEAR(line.read("blade.pinch"), expected, 0.2);
    EXPECT_NEAR(displacement, 1000 * slid, 1e-9);
    largest = std::max(largest, -line.read("blade.pinch"));
  }
  ASSERT_EQ(line.events.size(), 2U);
  EXPECT_EQ(line.events[0].name, "pinch");
  EXPECT_NEAR(value(line.events[0], "force"), 150, 2);
  EXPECT_NEAR(value(line.events[0], "displacement"), 150 / 2e5 * 1000, 0.01);
  const MachineEvent& cut = line.events[1];
  EXPECT_NEAR(value(cut, "slant"), 1000 * slid, 5 * h);  // it ends within the step
  EXPECT_NEAR(value(cut, "mismatch"), 5, 0.1);
  EXPECT_NEAR(value(cut, "pinch"), largest, 1e-9);
  EXPECT_NEAR(largest, std::min(1000.0, 200 * value(cut, "slant")), 2);
}

TEST(FlyingSaw, LengthIsTheDistanceOfTheCutsOnTheMaterial) {
  auto definition = free_saw();
  definition.data.blade.stiffness = definition.data.blade.damping = 0;
  definition.data.guide_friction = {};
  definition.data.mismatch_limit = 1;  // nobody clamps
  WebDefinition web = tube(0.4);
  web.data.lead = 0.1;
  SawLine line(definition, web);
  std::vector<double> marks;
  for (int cut = 0; cut < 3; ++cut) {
    line.carriage().speed = cut == 1 ? 0.39 : 0.1 * cut;
    line.command("head.plunge", true);
    double touch = -1;
    for (int i = 0; i < 3000; ++i) {
      const double before = line.depth();
      const double travel = line.material().position - line.carriage().position;
      line.step();
      const double edge = definition.data.head.clearance;
      if (touch >= 0 || line.depth() < edge) continue;
      const double share = (edge - before) / (line.depth() - before);
      touch = travel + share * (line.material().position - line.carriage().position - travel);
    }
    marks.push_back(touch);
    line.command("head.plunge", false);
    line.run(0.3);
  }
  ASSERT_EQ(line.events.size(), 3U);
  EXPECT_NEAR(value(line.events[0], "length"), 1000 * (marks[0] + 0.1), 1e-6);
  EXPECT_NEAR(value(line.events[1], "length"), 1000 * (marks[1] - marks[0]), 1e-6);
  EXPECT_NEAR(value(line.events[2], "length"), 1000 * (marks[2] - marks[1]), 1e-6);
  EXPECT_NEAR(value(line.events[1], "slant"), -10 * value(line.events[1], "time") / 1000, 1e-6);
  EXPECT_EQ(channel(*line.supply, "pieces"), 3);
}

TEST(FlyingSaw, ABladeDrawnBackBeforeItIsThroughHasCutNothing) {
  SawLine line(frictionless_saw(), tube(0));
  line.command("head.plunge", true);
  while (line.depth() < 0.03) line.step();
  line.command("head.plunge", false);
  line.run(0.5);
  EXPECT_TRUE(line.events.empty());
  EXPECT_EQ(line.read("blade.engaged"), 0);
  line.command("head.plunge", true);
  line.run(0.5);
  EXPECT_EQ(line.events.size(), 1U);
}

TEST(FlyingSaw, MaterialThatRunsUpAgainstTheBladePushesItAfterTheCut) {
  auto definition = free_saw();
  SawLine line(definition, tube(0));
  line.command("head.plunge", true);
  line.run(0.5);
  ASSERT_EQ(line.read("cut.number"), 1);
  line.material().speed = 0.2;  // the piece is off, the blade is still down
  line.step();
  line.step();
  EXPECT_GT(line.read("blade.pinch"), 0);
  line.material().speed = -0.2;
  line.run(0.01);
  EXPECT_EQ(line.read("blade.pinch"), 0);
}

TEST(FlyingSaw, ConservesMomentumOfCarriageMotorAndMaterial) {
  // Clamped, with the blade in; only inner forces act.
  auto definition = frictionless_saw();
  const auto& data = definition.data;
  SawLine line(definition, free_web(0));
  line.command("servo.enable", false);
  line.carriage().speed = 0.4;  // the motor stands: the pinion is wound up
  const ScrewPrediction screw(data, data.drive.servo.rotor_inertia);
  const auto momentum = [&] {
    return screw.momentum(line.carriage(), line.rotor()) + line.material().speed * 20;
  };
  const double before = momentum();
  line.run(0.1);
  line.command("clamp", true);
  line.run(0.2);
  EXPECT_NEAR(momentum() / before, 1, 1e-10);
  EXPECT_NEAR(line.carriage().speed, before / (screw.total() + 20), 1e-3);
}

}  // namespace
}  // namespace drycut::plants
