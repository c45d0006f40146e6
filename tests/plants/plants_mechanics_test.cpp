#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plants/cutting.hpp"
#include "plants/motor_load.hpp"
#include "plants/servo_drive.hpp"
#include "plants/transmission.hpp"
#include "plants/world.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// Motor, transmission and load without anything else.
struct TwoMasses {
  TransmissionData data;
  World world;
  Shaft& motor;
  Shaft& load;
  Transmission gear;
  explicit TwoMasses(const TransmissionData& d, double motor_speed = 0, double load_speed = 0)
      : data(d),
        motor(world.add_shaft({.name = "motor", .inertia = 0.00468, .speed = motor_speed})),
        load(world.add_shaft({.name = "load", .inertia = 0.41, .speed = load_speed})),
        gear(d) {}
  void step(double h) {
    gear.drive(motor, load);
    world.step(h);
    gear.sense(motor, load, h);
  }
};

TEST(Transmission, OscillatesAtTheTwoMassResonance) {
  TransmissionData data;
  data.damping = 0;
  TwoMasses m(data, 10 * data.ratio, 0);
  const double h = 1e-4;
  std::vector<double> crossings;  // of the twist, upwards [s]
  double before = 0;
  for (int i = 0; i < 20000; ++i) {
    m.step(h);
    const double now = m.gear.twist();
    if (before < 0 && now >= 0) crossings.push_back((i + before / (before - now)) * h);
    before = now;
  }
  ASSERT_GT(crossings.size(), 100U);
  const double period = (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  const double closed_form = resonance(data, m.motor.inertia, m.load.inertia);
  EXPECT_NEAR(2 * pi / period / closed_form, 1, 5e-3);
  EXPECT_NEAR(closed_form, std::sqrt(52e3 * (1 / (25 * 0.00468) + 1 / 0.41)), 1e-9);
}

TEST(Transmission, TwistUnderConstantTorqueConvergesWithTheStep) {
  // Torque T on the motor at rest: twist = (a / w2) (1 - cos w t), a = T / (ratio Jm).
  TransmissionData data;
  data.damping = 0;
  const double t_end = 0.0123;
  const auto error = [&](double h) {
    TwoMasses m(data);
    const int steps = static_cast<int>(std::lround(t_end / h));
    for (int i = 0; i < steps; ++i) {
      m.motor.add_torque(20);
      m.step(h);
    }
    const double w = resonance(data, m.motor.inertia, m.load.inertia);
    const double exact = 20 / (data.ratio * m.motor.inertia) / (w * w) * (1 - std::cos(w * t_end));
    return m.gear.twist() - exact;
  };
  const double coarse = error(1e-4);
  const double fine = error(5e-5);
  const double finest = error(2.5e-5);
  EXPECT_NEAR(coarse / fine, 2, 0.2);
  EXPECT_NEAR(fine / finest, 2, 0.1);
}

TEST(Transmission, ConservesAngularMomentumThroughTheGear) {
  TwoMasses m(TransmissionData{}, 100, 3);
  const auto momentum = [&] {
    return m.motor.speed * m.data.ratio * m.motor.inertia + m.load.speed * m.load.inertia;
  };
  const double before = momentum();
  for (int i = 0; i < 20000; ++i) m.step(1e-4);
  EXPECT_NEAR(momentum() / before, 1, 1e-12);
  EXPECT_NEAR(m.motor.speed / m.data.ratio, m.load.speed, 1e-9);
}

TEST(Transmission, BacklashIsCrossedInItsTimeAndTheFlanksOnlyPush) {
  TransmissionData data;
  data.damping = 0;
  data.backlash = 0.01;
  const double rate = 2;  // of the twist, in the play [rad/s]
  TwoMasses m(data, rate * data.ratio, 0);
  const double h = 1e-5;
  std::vector<double> contacts;  // times at which the driving flank is reached
  double before = 0;
  for (int i = 0; i < 200000; ++i) {
    m.step(h);
    const double now = m.gear.twist();
    const double half = data.backlash / 2;
    if (before <= half && now > half) contacts.push_back((i + (half - before) / (now - before)) * h);
    const double torque = transmission_torque(data, now, m.gear.rate());
    if (std::abs(now) <= half)
      ASSERT_EQ(torque, 0);
    else
      ASSERT_GE(torque * now, 0);
    before = now;
  }
  ASSERT_GT(contacts.size(), 20U);
  EXPECT_NEAR(contacts[0], data.backlash / 2 / rate, 2 * h);
  const double period = (contacts.back() - contacts.front()) / static_cast<double>(contacts.size() - 1);
  const double w = resonance(data, m.motor.inertia, m.load.inertia);
  EXPECT_NEAR(period / (2 * (data.backlash / rate + pi / w)), 1, 5e-3);
}

TEST(Transmission, DampingDoesNotPullAcrossTheBacklash) {
  TransmissionData data;
  data.backlash = 0.01;
  data.stiffness = 1000;
  data.damping = 100;
  EXPECT_EQ(transmission_torque(data, 0.006, -5), 0);  // leaving fast: no pull
  EXPECT_EQ(transmission_torque(data, -0.006, 5), 0);
  EXPECT_NEAR(transmission_torque(data, 0.006, 5), 2, 1e-12);  // damper no more than the spring's 1 N m
  EXPECT_NEAR(transmission_torque(data, 0.006, 0), 1, 1e-12);
  data.backlash = 0;
  EXPECT_NEAR(transmission_torque(data, 0.006, -5), 6 - 500, 1e-12);
}

TEST(Friction, StopsABodyAfterItsClosedFormWayAndHoldsIt) {
  World world;
  Slide& body = world.add_slide({.name = "body", .mass = 5, .speed = 2});
  const Friction friction{.coulomb = 20};
  const double h = 1e-4;
  const auto step = [&](double force) {
    body.add_force(force);
    body.add_force(friction_effort(friction, body.speed, body.force, body.mass, h));
    world.step(h);
  };
  for (int i = 0; i < 10000; ++i) {
    step(0);
    ASSERT_GE(body.speed, -1e-15);  // never reversed
  }
  EXPECT_NEAR(body.position, 2 * 2 / (2 * 20.0 / 5), 2 * h);
  EXPECT_EQ(body.speed, 0);
  const double held = body.position;
  for (int i = 0; i < 1000; ++i) step(19.9);
  EXPECT_EQ(body.position, held);
  for (int i = 0; i < 1000; ++i) step(25);
  EXPECT_NEAR(body.speed, (25 - 20) / 5.0 * 0.1, 1e-9);
}

TEST(Friction, ViscousSpeedDecaysExponentially) {
  World world;
  Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 0.5, .speed = 10});
  const Friction friction{.viscous = 0.8};
  for (int i = 0; i < 10000; ++i) {
    shaft.add_torque(friction_effort(friction, shaft.speed, 0, shaft.inertia, 1e-4));
    world.step(1e-4);
  }
  const double rate = 0.8 / 0.5;
  EXPECT_NEAR(shaft.speed / (10 * std::exp(-rate)), 1, rate * rate * 1e-4);
}

TEST(Friction, BackwardsItIsAnother) {
  const Friction friction{.coulomb = 2, .viscous = 3, .backward = 0.5, .viscous_backward = 1.5};
  EXPECT_DOUBLE_EQ(friction_effort(friction, 10, 0, 1, 1e-4), -3 * 10 - 2);
  EXPECT_DOUBLE_EQ(friction_effort(friction, -10, 0, 1, 1e-4), 3 * 1.5 * 10 + 2 * 0.5);
  EXPECT_DOUBLE_EQ(friction_in(friction, 10, 0, 1, 1e-4), 3 * 10 + 2);
  EXPECT_DOUBLE_EQ(friction_in(friction, -10, 0, 1, 1e-4), -3 * 1.5 * 10 - 2 * 0.5);
}

TEST(Friction, BreakawayIsAboveCoulombAtStandstillOnly) {
  const Friction friction{.coulomb = 2, .breakaway = 1, .stribeck_speed = 0.1};
  EXPECT_DOUBLE_EQ(friction_effort(friction, 0, 2.9, 1, 1e-4), -2.9);
  EXPECT_DOUBLE_EQ(friction_effort(friction, 0, 5, 1, 1e-4), -3);
  EXPECT_DOUBLE_EQ(friction_effort(friction, 0.1, 0, 1, 1e-4), -2 - std::exp(-1));
  EXPECT_NEAR(friction_effort(friction, -10, 0, 1, 1e-4), 2, 1e-12);
}

TEST(Friction, ResistanceInOneDirectionDoesNotDriveBack) {
  const DryResistance blade{.forward = 50};
  EXPECT_DOUBLE_EQ(friction_effort({}, 0, 30, 1, 1e-4, blade), -30);
  EXPECT_DOUBLE_EQ(friction_effort({}, 0, 80, 1, 1e-4, blade), -50);
  EXPECT_DOUBLE_EQ(friction_effort({}, 0, -30, 1, 1e-4, blade), 0);
  EXPECT_DOUBLE_EQ(friction_effort({}, -1, 0, 1, 1e-4, blade), 0);
}

/// Energy that is missing after two seconds of a servo-driven drum that cuts at each turn [J].
double missing_energy(double h, double* turned_over) {
  const ServoData servo_data;
  const TransmissionData gear;
  const Friction friction{.coulomb = 2, .viscous = 0.1};
  const double peak = 1500;
  const double thickness = 1e-3;
  TwoMasses m(gear);
  Slide& web = m.world.add_slide({.name = "web", .mass = 1});
  m.load.part = 0.5;
  Cutter cutter(
      {.radius = 0.0955, .blades = 1, .thickness = thickness, .peak_force = peak, .mismatch_limit = 1e9},
      m.load);
  ServoDrive servo(servo_data, Random());
  servo.reference.volts = 2.5;
  double drive = 0;
  double damper = 0;
  double viscous = 0;
  int cuts = 0;
  const double start = m.load.angle();
  for (int i = 0; i < std::lround(2 / h); ++i) {
    servo.drive(m.motor, h);
    m.gear.drive(m.motor, m.load);
    const double dry_and_viscous = friction_effort(friction, m.load.speed, m.load.torque, m.load.inertia, h,
                                                   cutter.load(m.load, web).dry);
    m.load.add_torque(dry_and_viscous);
    const double viscous_torque = friction.viscous * m.load.speed;
    const double damper_torque = gear.damping * m.gear.rate();
    const double rate_before = m.gear.rate();
    m.world.step(h);
    m.gear.sense(m.motor, m.load, h);
    const double motor_mid = (m.motor.speed_before + m.motor.speed) / 2;
    const double load_mid = (m.load.speed_before + m.load.speed) / 2;
    drive += servo.torque() * motor_mid * h;
    viscous += viscous_torque * load_mid * h;
    damper += damper_torque * (rate_before + m.motor.speed / gear.ratio - m.load.speed) / 2 * h;
    cuts += cutter.sense(m.load, web, h).separated ? 1 : 0;
  }
  const double kinetic = 0.5 * m.motor.inertia * m.motor.speed * m.motor.speed +
                         0.5 * m.load.inertia * m.load.speed * m.load.speed;
  const double spring = 0.5 * gear.stiffness * m.gear.twist() * m.gear.twist();
  const double coulomb = friction.coulomb * (m.load.angle() - start);
  const double cutting = cuts * shear_work(peak, thickness, thickness);
  EXPECT_EQ(cuts, 3);
  *turned_over = drive;
  return drive - (kinetic + spring + damper + viscous + coulomb + cutting);
}

TEST(Mechanics, DriveWorkIsKineticAndFrictionAndCutting) {
  double drive = 0;
  const double coarse = std::abs(missing_energy(2e-4, &drive));
  const double fine = std::abs(missing_energy(5e-5, &drive));
  const double finest = std::abs(missing_energy(1.25e-5, &drive));
  EXPECT_GT(drive, 50);
  EXPECT_LT(fine / drive, 5e-3);
  EXPECT_LT(fine, coarse);
  EXPECT_LT(finest, fine / 2);
  EXPECT_LT(finest / drive, 1e-3);
}

}  // namespace
}  // namespace drycut::plants
