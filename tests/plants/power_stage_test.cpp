// The electrical side of a drive against closed forms: heat, I2t, DC link, brake resistor, mains, energy.
#include "plants/power_stage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "plants/inverter.hpp"
#include "plants/servo_drive.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// A servo's stage whose rotor is turned by hand.
struct Stage {
  ServoData data;
  Shaft rotor;
  PowerStage stage;
  explicit Stage(const ServoData& d = {})
      : data(electrical(d)),
        stage({.per_torque_squared = 1 / (d.torque_constant * d.torque_constant),
               .resistance = 1.5 * data.winding_resistance},
              d.heat, ratings(d), data.amplifier, d.supply) {}
  /// So long at such a torque and speed [rad/s].
  void run(double seconds, double torque, double speed = 0) {
    rotor.speed = rotor.speed_before = speed;
    for (long i = std::lround(seconds / h); i > 0; --i) stage.account({torque, 0, 0, true}, rotor, h);
  }
  double i2t_after(double seconds, double torque) {
    run(seconds, torque);
    return stage.i2t();
  }
};

double volts(const DcLink& link, double share) { return std::sqrt(2.0) * link.data().voltage * share; }

TEST(MotorHeat, StallTorqueForEverIsTheRatedRise) {
  const MotorHeatData data;
  MotorHeat heat(data, 100, 20);
  EXPECT_NEAR(heat.steady(100, 20), MotorHeat::ambient + data.temperature_rise, 1e-9);
  for (int i = 0; i < 20 * 2400; ++i) heat.warm(100 * heat.resistance() + 20, 1);
  EXPECT_NEAR(heat.winding(), MotorHeat::ambient + data.temperature_rise, 0.01);
  // 35 % of it lie between winding and housing.
  EXPECT_NEAR(heat.housing(), MotorHeat::ambient + 0.65 * data.temperature_rise, 0.01);
}

TEST(MotorHeat, AWindingWarmsAgainstItsHousingWithItsTimeConstant) {
  MotorHeatData data;
  data.housing_time_constant = 1e6;  // it stays cold
  MotorHeat heat(data, 100, 0);
  constexpr double loss = 200;
  const double hot = 1 + MotorHeat::copper * (MotorHeat::ambient + data.temperature_rise - 293.15);
  const double resistance = MotorHeat::share_of_winding * data.temperature_rise / (100 * hot);
  for (int i = 0; i < 60000; ++i) heat.warm(loss, 1e-3);
  EXPECT_NEAR(heat.winding() - MotorHeat::ambient, loss * resistance * (1 - std::exp(-1)), 0.01);
}

TEST(MotorHeat, TheLossForATemperatureIsTheInverse) {
  const MotorHeat heat({}, 100, 20);
  for (const double loss : {10.0, 60.0, 120.0})
    EXPECT_NEAR(heat.cold_loss_for(heat.steady(loss, 20), 20), loss, 1e-9);
  EXPECT_EQ(heat.cold_loss_for(MotorHeat::ambient + 1, 1000), 0);
}

TEST(MotorHeat, CopperThatHeatsItselfFasterThanItCoolsHasNoEnd) {
  const MotorHeat heat({}, 100, 0);
  EXPECT_TRUE(std::isinf(heat.steady(1000, 0)));
}

TEST(DcLink, BrakingLiftsItAsTheCapacitorSays) {
  DcLink link({});
  const double v0 = link.voltage();
  EXPECT_NEAR(v0, volts(link, 1), 1e-9);
  link.carry(-30, 0.01);
  EXPECT_NEAR(link.voltage(), std::sqrt(v0 * v0 + 2 * 30 / link.data().capacitance), 1e-9);
  EXPECT_EQ(link.from_mains(), 0);
  link.carry(50, 0.01);  // 30 J of it were in the link
  EXPECT_NEAR(link.voltage(), v0, 1e-9);
  EXPECT_NEAR(link.from_mains(), 20, 1e-9);
  EXPECT_NEAR(link.mains_power(), 2000, 1e-6);
  EXPECT_EQ(link.speed_share(), 1);
}

TEST(DcLink, TheResistorTakesTheVoltageDownExponentially) {
  SupplyData data;
  data.brake_hysteresis = 0.2;
  DcLink link(data);
  const double over = volts(link, 1.35);
  link.carry(-0.5 * data.capacitance * (over * over - 2 * data.voltage * data.voltage), 1e-3);
  const double tau = data.resistor * data.capacitance;
  for (int i = 0; i < 8; ++i) link.carry(0, 1e-3);
  EXPECT_NEAR(link.voltage(), over * std::exp(-8e-3 / tau), 1e-9);
  EXPECT_NEAR(link.resistor_power() / (link.voltage() * link.voltage() / data.resistor),
              std::expm1(2e-3 / tau) * tau / 2e-3, 1e-9);
  for (int i = 0; i < 100; ++i) link.carry(0, 1e-3);
  EXPECT_EQ(link.resistor_power(), 0) << "off below brake_voltage less its hysteresis";
  EXPECT_GT(link.voltage(), volts(link, 1.07));
}

TEST(DcLink, WithoutMainsALoadEmptiesItInItsTime) {
  DcLink link({});
  std::vector<Fault> faults;
  link.offer_faults(faults);
  fault(faults, "mains", "outage", 1);
  EXPECT_FALSE(link.mains_well());
  const auto& data = link.data();
  const double v0 = volts(link, 1);
  const double v1 = volts(link, data.undervoltage);
  constexpr double power = 500;
  double time = 0;
  while (!link.under()) {
    link.carry(power * 1e-4, 1e-4);
    time += 1e-4;
  }
  EXPECT_NEAR(time, data.capacitance * (v0 * v0 - v1 * v1) / (2 * power), 1e-4);
  EXPECT_NEAR(link.speed_share(), data.undervoltage, 1e-3);
  fault(faults, "mains", "outage", 0);
  link.carry(0, 1e-4);
  EXPECT_NEAR(link.voltage(), v0, 1e-9);
}

TEST(DcLink, ADipAndALostPhaseLeaveWhatTheRectifierCanGive) {
  DcLink link({});
  std::vector<Fault> faults;
  link.offer_faults(faults);
  fault(faults, "mains", "dip", 0.1);
  EXPECT_TRUE(link.mains_well());
  link.carry(1000, 1e-3);  // more than it holds
  EXPECT_NEAR(link.voltage(), volts(link, 0.9), 1e-9);
  fault(faults, "mains", "dip", 0.2);
  EXPECT_FALSE(link.mains_well());
  fault(faults, "mains", "dip", 0);

  // Two phases: the link sinks between the half waves, until the next one meets it.
  fault(faults, "mains", "phase_lost", 1);
  constexpr double power = 2000;
  double lowest = 1e9;
  double highest = 0;
  for (int i = 0; i < 4000; ++i) {
    link.carry(power * 1e-4, 1e-4);
    if (i < 2000) continue;
    lowest = std::min(lowest, link.voltage());
    highest = std::max(highest, link.voltage());
  }
  EXPECT_NEAR(highest, volts(link, 1), 0.2);
  // By hand: from the peak at 0 the load draws v^2 = V^2 - 2 P t / C until V |sin| is there again.
  const double v = volts(link, 1);
  double t = 5e-3;
  while (v * v - 2 * power * t / link.data().capacitance >
         std::pow(v * std::cos(2 * std::numbers::pi * 50 * t), 2))
    t += 1e-6;
  EXPECT_NEAR(lowest, std::sqrt(v * v - 2 * power * t / link.data().capacitance), 0.02 * v);
}

TEST(DcLink, AnOverloadedResistorIsSwitchedOff) {
  SupplyData data;
  data.resistor_time_constant = 1;
  data.resistor = 2000;  // 270 W while it is on
  DcLink link(data);
  link.carry(-(1.28 * 1.28 - 1) * data.capacitance * data.voltage * data.voltage, 1e-3);  // up to the brake
  double time = 0;
  while (link.resistor_load() < 1) {
    link.carry(-200e-3, 1e-3);  // twice its power for ever: 1 = 2 (1 - exp(-t))
    time += 1e-3;
  }
  EXPECT_NEAR(time, std::log(2), 0.05);
  EXPECT_NEAR(link.resistor_temperature(), MotorHeat::ambient + data.resistor_rise, 1);
  for (int i = 0; i < 2000 && !link.over(); ++i) link.carry(-200e-3, 1e-3);
  EXPECT_TRUE(link.over());
}

TEST(PowerStage, I2tTripsAfterTheOverloadTimeAtThePeakCurrent) {
  const ServoData data = electrical(ServoData{});
  const double peak = data.torque_constant * data.amplifier.peak_current;
  Stage stage;
  stage.run(data.amplifier.overload_time - 0.01, peak);
  EXPECT_FALSE(stage.stage.tripped());
  EXPECT_LT(stage.stage.i2t(), 1);
  stage.run(0.02, peak);
  EXPECT_TRUE(stage.stage.tripped());
  const auto events = stage.stage.take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].name, "overload");
  EXPECT_NEAR(events[0].values[0].number, 100, 0.1);
  EXPECT_FALSE(stage.stage.ready.level);
  stage.stage.reset();
  stage.run(0.001, 0);
  EXPECT_TRUE(stage.stage.ready.level || stage.stage.tripped());
}

TEST(PowerStage, RatedCurrentForEverDoesNotTrip) {
  const ServoData data = electrical(ServoData{});
  Stage stage;
  EXPECT_NEAR(stage.i2t_after(300, data.torque_constant * data.amplifier.current * 0.999), 0.998, 1e-3);
  EXPECT_FALSE(stage.stage.tripped());
}

TEST(PowerStage, CopperLossIsThatOfThreePhases) {
  ServoData data;
  data.winding_resistance = 0.7;
  Stage stage(data);
  stage.run(1, 10 * data.torque_constant);  // 10 A
  const double cold = 1.5 * 0.7 * 100;
  EXPECT_NEAR(stage.stage.loss(), cold * stage.stage.heat().resistance(), 0.05);
  const auto& totals = stage.stage.totals();
  EXPECT_NEAR(totals.current_squared, 100 * totals.time, 1e-9);
}

TEST(PowerStage, AWindingAtItsLimitTrips) {
  ServoData data;
  data.heat.temperature_limit = MotorHeat::ambient + 30;
  Stage stage(data);
  stage.run(600, 9.4);
  ASSERT_TRUE(stage.stage.tripped());
  const auto events = stage.stage.take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].values[1].number, 40 + 30, 0.1) << events[0].values[1].name;
}

TEST(PowerStage, EnergyClosesOverAnyCycle) {
  Stage stage;
  const double before = stage.stage.link()->stored();
  for (int i = 0; i < 100; ++i) stage.run(0.2, 20 * std::sin(i * 0.7), 150 * std::sin(i * 0.7 + 1.2));
  const auto& totals = stage.stage.totals();
  const auto& link = *stage.stage.link();
  EXPECT_GT(totals.in_resistor, 1);
  EXPECT_GT(totals.from_mains, 100);
  EXPECT_NEAR(totals.from_mains, totals.work + totals.copper + totals.in_resistor + link.stored() - before,
              1e-6 * totals.from_mains);
}

TEST(PowerStage, TheServosWorkIsTheRotorsKineticEnergy) {
  World world;
  const ServoData data;
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 0.02});
  ServoDrive servo(data, world.random("servo"));
  servo.reference.volts = 8;
  for (int i = 0; i < 5000; ++i) {
    servo.drive(rotor, h);
    world.step(h);
  }
  servo.drive(rotor, h);  // accounts for the last step
  const double kinetic = 0.5 * 0.02 * rotor.speed * rotor.speed;
  EXPECT_NEAR(servo.power().totals().work, kinetic, 1e-9 * kinetic);
}

TEST(PowerStage, AnInductionMotorLosesItsSlipInTheRotor) {
  const InductionMotorData motor = electrical(InductionMotorData{});
  World world;
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 0.05});
  Inverter inverter({}, motor);
  inverter.forward.level = true;
  for (int i = 0; i < 30000; ++i) {
    inverter.drive(rotor, h);
    rotor.add_torque(-motor.winding.rated_torque);
    world.step(h);
  }
  // At rated torque: rated current, slip and so both losses.
  const double slip = motor.winding.synchronous_speed - motor.winding.rated_speed;
  const double rotor_loss = motor.winding.rated_torque * slip;
  const auto& stage = inverter.power();
  const double stator = 3 * motor.stator_resistance * motor.rated_current * motor.rated_current;
  EXPECT_NEAR(stage.loss(), stator * stage.heat().resistance() + rotor_loss, 0.5);
  EXPECT_NEAR(stage.link()->mains_power(), motor.winding.rated_torque * rotor.speed + stage.loss(), 5);
}

TEST(ServoDrive, ABusVoltageThatSinksTakesTheTorqueOfHighSpeedsAway) {
  World world;
  const ServoData data;
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 1, .speed = data.rated_speed});
  ServoDrive servo(data, world.random("servo"));
  std::vector<Fault> faults;
  servo.offer_faults(faults, "servo");
  fault(faults, "mains", "dip", 0.25);
  servo.reference.volts = 9.99;
  rotor.speed = rotor.speed_before = data.rated_speed * 0.9;
  for (int i = 0; i < 400; ++i) {
    servo.drive(rotor, h);
    world.step(h);
  }
  // As at a speed a third higher: 0.9 / 0.75 of rated speed and a little more.
  const double as_rated = rotor.speed / 0.75;
  EXPECT_LT(servo.torque(), data.peak_torque - 1);
  EXPECT_NEAR(servo.torque(), ratings(data).peak(as_rated), 0.2);
}

TEST(ServoDrive, ATripIsTakenBackByTheEnable) {
  World world;
  ServoData data;
  data.amplifier.overload_time = 0.05;
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 100});
  ServoDrive servo(data, world.random("servo"));
  const auto run = [&](double seconds) {
    for (long i = std::lround(seconds / h); i > 0; --i) {
      servo.drive(rotor, h);
      world.step(h);
    }
  };
  servo.reference.volts = 10;
  run(0.2);
  EXPECT_FALSE(servo.enabled());
  EXPECT_FALSE(servo.power().ready.level);
  EXPECT_NEAR(servo.torque(), 0, 1e-6);
  run(0.2);
  EXPECT_FALSE(servo.enabled()) << "it stays off";
  servo.enable.level = false;
  run(0.2);
  servo.reference.volts = 0;
  servo.enable.level = true;
  run(0.01);
  EXPECT_TRUE(servo.enabled());
  EXPECT_TRUE(servo.power().ready.level);
}

TEST(ServoDrive, WhatIsNotKnownIsEstimatedFromTheRest) {
  ServoData data;
  data.rated_torque = 2;
  const ServoData estimated = electrical(data);
  EXPECT_EQ(estimated.stall_torque, 2);
  EXPECT_NEAR(estimated.amplifier.current, 2 / data.torque_constant, 1e-12);
  EXPECT_NEAR(estimated.amplifier.peak_current, data.peak_torque / data.torque_constant, 1e-12);
  const double current = 2 / data.torque_constant;
  EXPECT_NEAR(1.5 * estimated.winding_resistance * current * current, 0.06 * 2 * data.rated_speed, 1e-9);
  data.stall_torque = 3;
  data.amplifier.peak_current = 20;
  EXPECT_EQ(electrical(data).stall_torque, 3);
  EXPECT_NEAR(ratings(data).peak_torque, 20 * data.torque_constant, 1e-12)
      << "the amplifier has no more current";
  EXPECT_NEAR(ratings(data).continuous(data.rated_speed / 2), 2.5, 1e-12);
}

TEST(PowerStage, AContradictionOfItsDataIsToldWithItsParameter) {
  const auto told = [](const ServoData& data) {
    const auto found = servo_objections(data, data.rotor_inertia, h);
    return found.size() == 1 ? found[0].parameter : std::to_string(found.size());
  };
  ServoData data;
  EXPECT_EQ(told(data), "0");
  data.amplifier.current = data.amplifier.peak_current = 11;
  EXPECT_EQ(told(data), "servo.amplifier_peak_current");
  data = {};
  data.supply.overvoltage = data.supply.brake_voltage;
  EXPECT_EQ(told(data), "servo.supply.overvoltage");
  data = {};
  data.supply.brake_hysteresis = data.supply.brake_voltage - 1;
  EXPECT_EQ(told(data), "servo.supply.brake_hysteresis");
}

}  // namespace
}  // namespace drycut::plants
