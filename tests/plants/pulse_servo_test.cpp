#include "plants/pulse_servo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plants/rotary_knife.hpp"
#include "plants/servo_axis.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// A pulse servo on a load that is rigidly its rotor.
struct PulseAxis {
  ServoAxisData data;
  World world;
  Shaft& rotor;
  ServoAxis servo;
  std::vector<Port> ports;
  std::vector<Fault> faults;
  std::vector<MachineEvent> trips;
  double rate = 0;  // pulses a step, either sign
  double sent = 0;
  double load_torque = 0;
  explicit PulseAxis(const ServoAxisData& d)
      : data(d),
        rotor(world.add_shaft({.name = "rotor",
                               .inertia = d.servo.rotor_inertia * (1 + d.servo.inertia_ratio),
                               .revolutions = 0.3})),
        servo(d, rotor, world.random("servo")) {
    servo.offer_ports(ports);
    servo.offer_faults(faults);
  }
  template <class Plug>
  Plug& plug(const std::string& name) {
    for (const Port& port : ports)
      if (port.name == name) return *std::get<Plug*>(port.plug);
    throw std::out_of_range(name);
  }
  void step() {
    const auto before = std::llround(std::floor(sent));
    sent += std::abs(rate);
    plug<PulsePort>("servo.pulses").pulses += std::llround(std::floor(sent)) - before;
    plug<CommandPort>("servo.direction").level = rate > 0;
    servo.drive(rotor, h);
    rotor.add_torque(load_torque);
    world.step(h);
    servo.sense(rotor);
    for (const MachineEvent& event : servo.take_events(rotor))
      if (event.name == "following_error") trips.push_back(event);
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / h); ++i) step();
  }
  const PulseServo& loop() { return *servo.pulses(); }
  double turns() { return rotor.revolutions() - 0.3; }
};

ServoAxisData pulses() {
  ServoAxisData data;
  data.kind = "pulses";
  return data;
}

TEST(ElectronicGear, IsExactOverTenMillionPulsesInPiecesOfAnySizeAndDirection) {
  for (const auto& [n, d] : {std::pair{4194304, 10000}, {16777215, 16777213}, {7, 65521}, {1, 1}}) {
    ElectronicGear gear(n, d);
    std::mt19937 random(5);
    std::int64_t pulses = 0;
    while (pulses < 10'000'000) {
      const auto piece = static_cast<std::int64_t>(random() % 200) - 40;
      gear.add(piece);
      pulses += piece;
    }
    // The floor of the whole product, in one division.
    EXPECT_EQ(gear.counts(), pulses * n / d) << n << "/" << d;
    gear.add(-pulses - 1);
    EXPECT_EQ(gear.counts(), -((n + d - 1) / d));
    gear.add(1);
    EXPECT_EQ(gear.counts(), 0);
  }
}

TEST(PulseServo, EndsOnTheTurnsThatThePulsesAsk) {
  PulseAxis axis(pulses());
  axis.rate = 12.3;  // 123 kHz: 738 rpm
  axis.run(1);
  axis.rate = -4.7;
  axis.run(0.7);
  axis.rate = 0;
  axis.run(1);
  EXPECT_NEAR(axis.turns() * 10000, 123000 - 32900, 1.1);
  EXPECT_NEAR(axis.loop().reference(), 123000 - 32900, 1.1);
  EXPECT_NEAR(axis.loop().deviation(), 0, 0.01);
  EXPECT_TRUE(axis.plug<SignalPort>("servo.in_position").level);
  EXPECT_TRUE(axis.trips.empty());
}

TEST(PulseServo, FollowingErrorIsSpeedOverGain) {
  for (const double share : {0.0, 0.6, 1.0}) {
    auto data = pulses();
    data.pulses.feed_forward = share;
    data.pulses.gear_numerator = 4194304;
    data.pulses.gear_denominator = 8192;  // 512 counts a pulse: whole pulses a step, no ripple
    PulseAxis axis(data);
    axis.load_torque = -3;  // the speed loop's integral carries it
    axis.rate = 20;         // 200 kHz
    axis.run(1.5);
    // The loop acts on the deviation before the step; after it the rotor has gone the way of one step.
    EXPECT_NEAR(axis.loop().deviation(), 200000.0 / 50 * (1 - share) - 20, 1) << share;
    EXPECT_NEAR(axis.rotor.speed, 200000.0 / 8192 * turn, 1e-2);
    EXPECT_EQ(axis.plug<SignalPort>("servo.in_position").level, share == 1);
  }
}

TEST(PulseServo, TripsCoastsAndIsReset) {
  auto data = pulses();
  data.pulses.following_limit = 0.5;
  PulseAxis axis(data);
  axis.rate = 10;
  axis.run(0.5);
  ASSERT_TRUE(axis.trips.empty());  // 100 kHz / 50: 0.2 turns
  axis.load_torque = -40;           // more than the peak torque
  int steps = 0;
  while (axis.trips.empty() && steps++ < 5000) axis.step();
  ASSERT_EQ(axis.trips.size(), 1U);
  EXPECT_EQ(axis.trips[0].name, "following_error");
  EXPECT_NEAR(value(axis.trips[0], "turns"), 0.5, 0.01);
  EXPECT_NEAR(value(axis.trips[0], "speed"), axis.rotor.speed * 60 / turn, 1e-9);
  EXPECT_TRUE(axis.plug<SignalPort>("servo.alarm").level);
  EXPECT_EQ(axis.plug<SignalPort>("servo.alarm").edges.size(), 1U);
  EXPECT_FALSE(axis.plug<SignalPort>("servo.in_position").level);

  axis.load_torque = 0;
  axis.run(0.2);
  const double speed = axis.rotor.speed;
  axis.run(0.2);
  EXPECT_NEAR(axis.servo.amplifier().torque(), 0, 1e-9);
  EXPECT_NEAR(axis.rotor.speed, speed, 1e-9);  // nothing drives it
  EXPECT_EQ(axis.loop().deviation(), 0);
  EXPECT_EQ(axis.trips.size(), 1U);

  axis.rate = 0;
  axis.plug<CommandPort>("servo.reset").level = true;
  axis.run(1);
  EXPECT_FALSE(axis.plug<SignalPort>("servo.alarm").level);
  EXPECT_NEAR(axis.rotor.speed, 0, 1e-3);  // holds where it was reset
  // Held high, reset clears no second trip.
  axis.load_torque = 60;
  axis.run(1);
  EXPECT_EQ(axis.trips.size(), 2U);
  EXPECT_TRUE(axis.plug<SignalPort>("servo.alarm").level);
}

TEST(PulseServo, PulsesWithoutEnableAreLost) {
  PulseAxis axis(pulses());
  axis.plug<CommandPort>("servo.enable").level = false;
  axis.rate = 5;
  axis.run(0.5);
  EXPECT_EQ(axis.turns(), 0);
  EXPECT_FALSE(axis.plug<SignalPort>("servo.in_position").level);
  axis.plug<CommandPort>("servo.enable").level = true;
  axis.rate = 0;
  axis.run(0.5);
  EXPECT_NEAR(axis.turns(), 0, 1e-9);
  axis.rate = 5;
  axis.run(0.5);
  axis.rate = 0;
  axis.run(0.5);
  EXPECT_NEAR(axis.turns(), 2.5, 1e-6);
}

TEST(PulseServo, FaultsOfTheCable) {
  PulseAxis axis(pulses());
  axis.rate = 5;
  axis.run(0.2);
  fault(axis.faults, "servo", "lose_pulses", 100);
  fault(axis.faults, "servo", "broken_cable", 1);
  axis.run(0.2);
  fault(axis.faults, "servo", "broken_cable", 0);
  axis.run(0.2);
  axis.rate = 0;
  axis.run(0.5);
  EXPECT_NEAR(axis.turns() * 10000, 20000 - 100, 0.5);
  fault(axis.faults, "servo", "disabled", 1);
  axis.rate = 5;
  axis.run(0.5);
  EXPECT_NEAR(axis.turns() * 10000, 20000 - 100, 0.5);
}

TEST(PulseServo, DrivesTheKnifeInsteadOfTheVoltage) {
  RotaryKnifeDefinition definition;
  definition.data.drive.kind = "pulses";
  definition.data.drive.pulses.feed_forward = 1;
  WebDefinition web;
  Machine line(definition, &web);
  auto& train = line.plug<PulsePort>("servo.pulses");
  line.command("servo.direction", true);
  for (int i = 0; i < 30000; ++i) {  // 5 turns of the motor a turn of the drum, 50000 pulses
    if (i < 25000) train.pulses += 8;
    line.step();
  }
  EXPECT_NEAR(line.read("angle.total"), 180 + 4 * 360, 0.01);
  EXPECT_NEAR(line.read("servo.deviation"), 0, 2);
  EXPECT_EQ(line.read("servo.alarm"), 0);
  EXPECT_EQ(line.read("cut.number"), 4);
  for (const Port& port : line.plant->ports()) EXPECT_NE(port.name, "servo.reference");
}

// Whole pulses at 0.4 a step: what a feed forward makes of them is torque that no cam asks for. Smoothed it
// is the less, the command comes later by its time, and it ends on the very count.
TEST(PulseServo, SmoothingTakesTheStepsOutOfTheTorque) {
  double torque[2] = {};
  for (const bool smooth : {false, true}) {
    ServoAxisData data;
    data.kind = "pulses";
    data.pulses.feed_forward = 1;
    data.pulses.feed_forward_filter = 0;
    data.pulses.smoothing = smooth ? 10e-3 : 0;
    PulseAxis axis(data);
    axis.rate = 0.4;
    axis.run(1);
    double squares = 0;
    for (int i = 0; i < 10'000; ++i) {
      axis.step();
      squares += std::pow(axis.servo.amplifier().torque(), 2);
    }
    torque[smooth ? 1 : 0] = std::sqrt(squares / 10'000);
    EXPECT_NEAR(0.8 - axis.turns(), smooth ? 10e-3 * 0.4 / h / 10'000 : 0, 3e-4) << smooth;
    axis.rate = 0;
    axis.run(1);
    EXPECT_NEAR(axis.turns(), std::floor(axis.sent) / 10'000, 1e-5);
  }
  EXPECT_LT(torque[1], torque[0] / 20);
}

}  // namespace
}  // namespace drycut::plants
