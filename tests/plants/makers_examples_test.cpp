// Sizing examples that makers worked out and printed: the machine built from the example's data, run, and
// what it takes of torque, speed and inertia beside the printed figure, to 2 %. Where the print is wrong or
// counts otherwise, beside the sum by hand, to 1 %. docs/validity.md has these rows.
#include "tests/plants/makers_examples.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace drycut::plants::makers {
namespace {

/// A loop that gives the torque of the reference ahead and knows no limits: the motion is the example's.
void follow_exactly(ServoData& servo, double speed, double load_inertia) {
  servo.speed_at_10v = std::abs(speed) * 1.25;
  servo.rated_speed = servo.max_speed = std::abs(speed) * 2;
  servo.rated_torque = servo.peak_torque = servo.torque_at_max_speed = 1000;
  servo.adc_bits = 24;
  servo.filter = servo.current_lag = servo.torque_forward_filter = 0;
  servo.torque_forward = 1;
  servo.inertia_ratio = load_inertia / servo.rotor_inertia;
}

/// A machine at its voltage, with what is read of it in every step.
struct Trial {
  Machine machine;
  std::function<double()> torque, speed, load;
  double squares = 0;  // of the torque
  int steps = 0;

  Trial(PlantDefinition& definition, const char* load_channel)
      : machine(definition),
        torque(reader("motor.torque")),
        speed(reader("motor.speed")),
        load(reader(load_channel)) {
    machine.run(0.2);
  }
  std::function<double()> reader(const std::string& name) {
    for (const Channel& channel : machine.plant->channels())
      if (channel.name == name) return channel.read;
    throw std::out_of_range(name);
  }

  /// Means of the second half, when what the phase's begin shook up has died out.
  struct Phase {
    double torque = 0;
    double acceleration = 0;  ///< of the motor [rad/s2]
    double load = 0;
  };
  Phase phase(double seconds, double from, double to) {
    const auto count = static_cast<int>(std::lround(seconds / h));
    const int settled = count / 2;
    Phase mean;
    double before = 0;
    for (int i = 1; i <= count; ++i) {
      machine.reference(from + (to - from) * i / count);
      machine.step();
      squares += torque() * torque();
      if (i == settled) before = speed();
      if (i <= settled) continue;
      mean.torque += torque() / (count - settled);
      mean.load += load() / (count - settled);
    }
    steps += count;
    mean.acceleration = (speed() - before) / rpm / ((count - settled) * h);
    return mean;
  }
};

Measured run(PlantDefinition& definition, const ServoData& servo, const Motion& motion, const char* load) {
  Trial trial(definition, load);
  const double volts = motion.speed / rpm / servo.speed_at_10v * 10;
  Measured found;
  const auto up = trial.phase(motion.ramp, 0, volts);
  found.steady = trial.phase(motion.steady, volts, volts).torque;
  found.speed = trial.speed();
  found.braking = trial.phase(motion.ramp, volts, 0).torque;
  if (motion.stop > 0) trial.phase(motion.stop, 0, 0);
  EXPECT_TRUE(trial.machine.events.empty());
  EXPECT_EQ(trial.machine.world.failure(), "");
  found.accelerating = up.torque;
  found.at_load = up.load;
  found.rms = std::sqrt(trial.squares / trial.steps);
  found.power = found.steady * found.speed / rpm;
  found.felt_inertia = (found.accelerating - found.steady) / up.acceleration - servo.rotor_inertia;
  return found;
}

/// As the example has it, and once more without losses, for the inertia.
template <class Definition>
Measured run_both(Definition definition, const Example& example, double load_inertia, const char* load) {
  auto& data = definition.data;
  follow_exactly(data.drive.servo, example.motion.speed / rpm, load_inertia);
  Measured found = run(definition, data.drive.servo, example.motion, load);
  data.gear.efficiency = {};
  if constexpr (requires { data.efficiency; }) data.efficiency = {};
  found.inertia = run(definition, data.drive.servo, example.motion, load).felt_inertia;
  return found;
}

Measured measured(const Example& example) {
  if (example.rotary != nullptr) {
    RotaryAxisDefinition definition;
    auto& data = definition.data;
    data.motor_friction = data.friction = {};
    data.gear = {1, 0, 0, 0};
    example.rotary(data);
    return run_both(definition, example, data.inertia / data.gear.ratio / data.gear.ratio, "gear.torque");
  }
  LinearAxisDefinition definition;
  auto& data = definition.data;
  data.motor_friction = data.guide_friction = {};
  data.gear = {1, 0, 0, 0};
  data.screw_inertia = 0;
  data.start = 0;
  data.travel_min = -10;
  data.travel_max = 10;
  example.linear(data);
  return run_both(definition, example, load_inertia(data), "gear.force");
}

std::string validity() {
  std::ifstream file(std::filesystem::path(DRYCUT_SOURCE_DIR) / "docs/validity.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Its row of docs/validity.md, in the unit that is printed.
std::string row_of(const std::string& name, const Figure& figure, double found) {
  const double is = found / figure.unit.is;
  const std::string begin =
      fmt::format("| {} | {} | {:g} {} |", name, figure.what, figure.value, figure.unit.name);
  if (figure.by_hand != 0)
    return fmt::format("{} {:.4g} | {:.4g} |", begin, figure.by_hand / figure.unit.is, is);
  const double off = std::round(1000 * (is / figure.value - 1)) / 10 + 0.0;  // no -0.0
  return fmt::format("{} {:.4g} | {:+.1f} % |", begin, is, off);
}

void expect_figure(const std::string& told, const std::string& name, const Figure& figure, double found) {
  const std::string row = row_of(name, figure, found);
  EXPECT_TRUE(told.find(row) != std::string::npos) << "docs/validity.md lacks\n" << row;
  const double off = found / figure.unit.is / figure.value - 1;
  if (figure.by_hand == 0) {
    EXPECT_NEAR(off, 0, 0.02) << row;
    return;
  }
  EXPECT_NEAR(found / figure.by_hand, 1, 0.01) << row;
  EXPECT_GT(std::abs(off), 0.02) << row << " agrees: it counts";
}

TEST(MakersExamples, EachTakesWhatItsMakerSays) {
  const std::string told = validity();
  for (const Example& example : makers_examples()) {
    const Measured found = measured(example);
    for (const Figure& figure : example.figures) expect_figure(told, example.name, figure, found.*figure.is);
  }
}

// FHA Series User Manual, 2-4-4, example 1: FHA-25C-50 with 1.5 kg m2, at its torque limit to 60 rpm and
// back. What its friction takes on the way up helps on the way down.
// https://www.easymanua.ls/harmonic-drive/fha-series/manual?p=28
TEST(MakersExamples, AnActuatorOfHarmonicDriveTakesItsTimes) {
  RotaryAxisDefinition definition;
  auto& data = definition.data;
  data.inertia = 1.5;
  data.gear = {50, 0, 0, 0};
  data.motor_friction = {};
  data.friction = {10.6, 0, 0, 1};
  auto& servo = data.drive.servo;
  servo.rotor_inertia = 0.81 / 2500;
  servo.rated_torque = servo.peak_torque = servo.torque_at_max_speed = (150 + 10.6) / 50;
  servo.rated_speed = servo.speed_at_10v = 90 * 50 / rpm;
  servo.max_speed = 2 * servo.rated_speed;
  servo.inertia_ratio = 1.5 / 0.81;
  servo.filter = servo.current_lag = 0;
  Machine machine(definition);
  machine.run(0.1);
  const auto time = [&](double aim, double there) {  // to 95 % of the change, as if it went on [s]
    machine.reference(aim / 9);
    int steps = 0;
    const bool up = aim > 0;
    while ((machine.read("speed") < there) == up && ++steps < 10'000) machine.step();
    return steps * h / 0.95;
  };
  constexpr Unit second = {"s", 1};
  const std::string name = "Harmonic Drive, actuator at its limit";
  const std::string told = validity();
  expect_figure(told, name, {"time to 60 rpm", 0.097, second, nullptr}, time(60, 57));
  machine.run(0.5);
  expect_figure(told, name, {"time to standstill", 0.085, second, nullptr}, time(0, 3));
}

}  // namespace
}  // namespace drycut::plants::makers
