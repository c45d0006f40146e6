#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "plants/backlash_axis.hpp"
#include "plants/flying_saw.hpp"
#include "plants/linear_axis.hpp"
#include "plants/vertical_press.hpp"
#include "tests/plants/witness/compare.hpp"
#include "tests/plants/witness/screw_law.hpp"

namespace drycut::plants::witness {
namespace {

/// A machine with a slide on a screw; the saw on a web that it does not touch.
template <class Type>
struct ScrewUnit : Machine {
  template <class Definition>
  ScrewUnit(Definition definition, const ScrewDriveData& screw, PlantDefinition* web = nullptr)
      : Machine(definition, web), per_metre(turn / screw.lead * screw.gear.ratio) {}
  Type& type() const { return static_cast<Type&>(*plant); }
  void process(double force) { set("force", force); }
  void record(Track& track) const {
    track.motor.push_back(type().rotor().angle() / per_metre);
    if constexpr (requires { type().ram(); })
      track.load.push_back(type().ram().position);
    else
      track.load.push_back(type().carriage().position);
  }
  double per_metre;  // of the motor [rad/m]
};

// A soft speed loop, so that the motion is the mechanics' more than the reference's.
void soften(ServoData& servo) {
  servo.speed_gain = 30;
  servo.integral_time = 0.1;
  servo.adc_bits = 24;
}

using Mistakes = std::vector<Mistake<ScrewLaw>>;

// Whatever the machine.
const Mistakes usual = {
    {"gear not squared",
     [](ScrewLaw& l) {
       l.motor_inertia += (l.motor_inertia - l.servo.data.rotor_inertia) * (l.gear.ratio - 1);
     }},
    {"no damping of the gear", [](ScrewLaw& l) { l.gear.damping = 0; }},
    {"a light part", [](ScrewLaw& l) { l.mass /= 2; }},
    {"half the dry friction of the motor", [](ScrewLaw& l) { l.motor_friction.data.coulomb /= 2; }},
    {"motor without viscous friction", [](ScrewLaw& l) { l.motor_friction.data.viscous = 0; }},
    {"half the dry friction of the guides", [](ScrewLaw& l) { l.guide_friction.data.coulomb /= 2; }},
    {"guides without viscous friction", [](ScrewLaw& l) { l.guide_friction.data.viscous = 0; }},
    {"half the reference filter", [](ScrewLaw& l) { l.servo.data.filter /= 2; }},
    {"half the current lag", [](ScrewLaw& l) { l.servo.data.current_lag /= 2; }},
};
Mistakes with(Mistakes more) {
  more.insert(more.begin(), usual.begin(), usual.end());
  return more;
}

// Up an incline behind a gear, with a jump of the reference into the torque limit, a push of the process, a
// reversal and a stand at the end. Along its torque limit a plant in steps hops about it, which is not smooth
// in the step: less of it is left out by extrapolation than with the other machines.
LinearAxisDefinition inclined_axis() {
  LinearAxisDefinition axis;
  axis.data.inclination = 0.35;
  axis.data.gear = {2, 1000, 0.05, 0};
  axis.data.gear.efficiency = {0.94, 0.9};
  axis.data.efficiency = {0.9, 0.8};
  soften(axis.data.drive.servo);
  axis.data.drive.servo.peak_torque = axis.data.drive.servo.torque_at_max_speed = 6;
  return axis;
}
const Motion up_and_down = {
    {{0.1, 0, 0}, {0.5, 7, 7}, {0.8, 7, 7, -200}, {1.1, 7, -6}, {1.5, -6, -6}, {1.6, -6, 0}, {2, 0, 0}}};

TEST(Witness, LinearAxis) {
  const auto unit = [] {
    return std::make_unique<ScrewUnit<LinearAxis>>(inclined_axis(), inclined_axis().data);
  };
  const auto law = [] {
    const LinearAxisData data = inclined_axis().data;
    auto own = std::make_unique<ScrewLaw>(data, data.drive.servo, up_and_down);
    own->steady_force = -data.mass * gravity * std::sin(data.inclination);
    return own;
  };
  expect_witness<ScrewLaw>(unit, law, 2.5e-6, 3e-6,
                           with({{"no weight", [](ScrewLaw& l) { l.steady_force = 0; }},
                                 {"no losses of the gear",
                                  [](ScrewLaw& l) {
                                    l.efficiency = {0.9, 0.8};
                                  }},
                                 {"no losses of the screw",
                                  [](ScrewLaw& l) {
                                    l.efficiency = {0.94, 0.9};
                                  }},
                                 {"no torque limit", [](ScrewLaw& l) { l.servo.data.peak_torque *= 5; }},
                                 {"no force of the process", [](ScrewLaw& l) {
                                    for (Leg& leg : l.motion.legs) leg.force = 0;
                                  }}}));
}

// The same with its screw between coupling and nut, and friction that differs by direction and grows with the
// weight on the guides; within its torque limit.
LinearAxisDefinition axis_with_a_nut() {
  LinearAxisDefinition axis = inclined_axis();
  axis.data.drive.servo.peak_torque = axis.data.drive.servo.torque_at_max_speed = 60;
  axis.data.screw_inertia = 2e-3;
  axis.data.nut_stiffness = 4e6;
  axis.data.nut_damping = 2e3;
  axis.data.guide_friction.backward = 0.6;
  axis.data.guide_friction.viscous_backward = 1.4;
  axis.data.guide_coefficient = 0.1;
  return axis;
}

TEST(Witness, LinearAxisWithANut) {
  const auto unit = [] {
    return std::make_unique<ScrewUnit<LinearAxis>>(axis_with_a_nut(), axis_with_a_nut().data);
  };
  const auto law = [] {
    const LinearAxisData data = axis_with_a_nut().data;
    auto own = std::make_unique<ScrewLaw>(data, data.drive.servo, up_and_down);
    own->steady_force = -data.mass * gravity * std::sin(data.inclination);
    own->guide_friction.data.coulomb += 0.1 * data.mass * gravity * std::cos(data.inclination);
    return own;
  };
  expect_witness<ScrewLaw>(
      unit, law, 2.5e-6, 5e-6,
      {{"a softer nut", [](ScrewLaw& l) { l.nut_stiffness /= 2; }},
       {"half the damping of the nut", [](ScrewLaw& l) { l.nut_damping /= 2; }},
       {"half the screw", [](ScrewLaw& l) { l.screw_inertia /= 2; }},
       {"no losses of the screw", [](ScrewLaw& l) { l.of_screw = {}; }},
       {"no losses of the gear", [](ScrewLaw& l) { l.efficiency = {}; }},
       {"the same friction both ways", [](ScrewLaw& l) { l.guide_friction.data.backward = 1; }},
       {"the same viscous friction", [](ScrewLaw& l) { l.guide_friction.data.viscous_backward = 1; }},
       {"no friction by weight", [](ScrewLaw& l) { l.guide_friction.data.coulomb = 30; }}});
}

// Behind the filters of its drive, with a torque ahead of the loop, and with what magnets and windings add;
// within its torque limit. The low-pass holds its torque for a step and the torque ahead is a difference over
// one, which are wrong in proportion to the step; the notches, by the bilinear transform that is right at
// their frequencies, by its square.
LinearAxisDefinition filtered_axis() {
  LinearAxisDefinition axis;
  ServoData& servo = axis.data.drive.servo;
  soften(servo);
  servo.filters = {4e-3, {{{.frequency = 40, .depth = 0.1, .width = 0.8}, {.frequency = 150}}}};
  servo.torque_forward = 0.6;
  servo.torque_forward_filter = 5e-3;
  servo.cogging = 0.3;
  servo.cogging_periods = 6;
  servo.torque_ripple = 0.1;
  servo.torque_ripple_periods = 4;
  return axis;
}

const Motion even_ramps = {{{0.2, 0, 7}, {0.5, 7, 7}, {0.9, 7, -6}, {1.4, -6, -6}, {1.6, -6, 0}, {2, 0, 0}}};

TEST(Witness, LinearAxisBehindFilters) {
  const auto unit = [] {
    return std::make_unique<ScrewUnit<LinearAxis>>(filtered_axis(), filtered_axis().data);
  };
  const auto law = [] {
    const LinearAxisData data = filtered_axis().data;
    return std::make_unique<ScrewLaw>(data, data.drive.servo, even_ramps);
  };
  expect_witness<ScrewLaw>(
      unit, law, 2.5e-6, 1e-7,
      {{"no low-pass", [](ScrewLaw& l) { l.servo.data.filters.low_pass = 0; }},
       {"half the low-pass", [](ScrewLaw& l) { l.servo.data.filters.low_pass /= 2; }},
       {"no first notch", [](ScrewLaw& l) { l.servo.data.filters.notches[0].frequency = 0; }},
       {"no second notch", [](ScrewLaw& l) { l.servo.data.filters.notches[1].frequency = 0; }},
       {"a first notch 1 % beside", [](ScrewLaw& l) { l.servo.data.filters.notches[0].frequency *= 1.01; }},
       {"a deeper first notch", [](ScrewLaw& l) { l.servo.data.filters.notches[0].depth = 0; }},
       {"a wider second notch", [](ScrewLaw& l) { l.servo.data.filters.notches[1].width *= 1.1; }},
       {"no torque ahead", [](ScrewLaw& l) { l.servo.data.torque_forward = 0; }},
       {"half its filter", [](ScrewLaw& l) { l.servo.data.torque_forward_filter /= 2; }},
       {"no cogging", [](ScrewLaw& l) { l.servo.data.cogging = 0; }},
       {"no ripple", [](ScrewLaw& l) { l.servo.data.torque_ripple = 0; }}});
}

// The carriage of the saw with play in its gear, and with a motor that has less torque above 600 rpm, runs up
// to the line's speed, back, and into its end stop. In steps the torque limit and a touch count from the next
// step on: what that leaves is not smooth in the step. A stop of 2000 N s/m would leave up to 1e-5 of the
// travel.
FlyingSawDefinition soft_saw() {
  FlyingSawDefinition saw;
  saw.data.gear.backlash = 2e-3;
  saw.data.stop.damping = 500;
  ServoData& servo = saw.data.drive.servo;
  soften(servo);
  servo.rated_speed = 600 / rpm;
  servo.max_speed = 1500 / rpm;
  servo.peak_torque = 5;
  servo.torque_at_max_speed = 3;
  return saw;
}
const Motion out_and_back = {
    {{0.3, 0, 4}, {0.6, 4, 4}, {0.9, 4, -4}, {1.5, -4, -4}, {1.8, -4, 0}, {2, 0, 0}}};

TEST(Witness, FlyingSaw) {
  const auto unit = [] {
    WebDefinition web;
    return std::make_unique<ScrewUnit<FlyingSaw>>(soft_saw(), soft_saw().data, &web);
  };
  const auto law = [] {
    const FlyingSawData data = soft_saw().data;
    return std::make_unique<ScrewLaw>(data, data.drive.servo, out_and_back);
  };
  expect_witness<ScrewLaw>(
      unit, law, 2.5e-6, 3e-6,
      with({{"no play", [](ScrewLaw& l) { l.gear.backlash = 0; }},
            {"all torque at any speed", [](ScrewLaw& l) { l.servo.data.torque_at_max_speed = 5; }},
            {"no damping of the stop", [](ScrewLaw& l) { l.buffers[0].data.damping = 0; }}}));
}

// A press that its servo drives down on a workpiece, into the torque limit, and up again.
VerticalPressDefinition servo_press() {
  VerticalPressDefinition press;
  press.data.drive.kind = "servo";
  press.data.drive.brake.torque = 0;
  press.data.gear.ratio = 2;
  press.data.workpiece_height = 0.26;
  press.data.workpiece = {2e6, 2e4};
  soften(press.data.drive.servo);
  press.data.drive.servo.peak_torque = press.data.drive.servo.torque_at_max_speed = 15;
  return press;
}
const Motion down_and_up = {{{0.3, 0, -5}, {1.1, -5, -5}, {1.4, -5, 5}, {1.7, 5, 5}, {1.9, 5, 0}, {2, 0, 0}}};

TEST(Witness, VerticalPress) {
  const auto unit = [] {
    return std::make_unique<ScrewUnit<VerticalPress>>(servo_press(), servo_press().data);
  };
  const auto law = [] {
    const VerticalPressData data = servo_press().data;
    auto own = std::make_unique<ScrewLaw>(data, data.drive.servo, down_and_up);
    own->steady_force = data.counterbalance - data.mass * gravity;
    // It hangs on its screw at rest.
    own->begin_twist = -own->steady_force / own->per_metre / data.gear.stiffness;
    own->buffers.push_back({data.workpiece, data.workpiece_height, -1});
    return own;
  };
  expect_witness<ScrewLaw>(
      unit, law, 2.5e-6, 1e-6,
      with({{"no counterbalance", [](ScrewLaw& l) { l.steady_force = -l.mass * gravity; }},
            {"no losses when driving", [](ScrewLaw& l) { l.efficiency.driving = 1; }},
            {"no losses when driven", [](ScrewLaw& l) { l.efficiency.driven = 1; }},
            {"no damping of the workpiece", [](ScrewLaw& l) { l.buffers.back().data.damping = 0; }}}));
}

/// Two bodies that meet at 1 m/s, left alone: their distance [m] with a flank of 1000 rad/s between them.
struct Impact : Equations {
  double damping_ratio = 0;
  [[nodiscard]] std::vector<double> start() const override { return {0, 1}; }
  void slope(double /*t*/, std::span<const double> y, std::span<double> dy) const override {
    const double spring = 1e6 * y[0];
    dy[0] = y[1];
    dy[1] = y[0] > 0 ? -spring - std::clamp(2e3 * damping_ratio * y[1], -spring, spring) : 0;
  }
  [[nodiscard]] int switches() const override { return 0; }
  void watch(double /*t*/, std::span<const double> /*y*/, std::span<double> /*g*/) const override {}
  void act(double /*t*/, std::span<double> /*y*/, int /*which*/) override {}
};

/// The damping ratio of a flank that lets two bodies part with `restitution` of the speed at which they met.
double damping_ratio_by_impact(double restitution) {
  double low = 0;
  double high = 0.95;
  while (high - low > 1e-9) {
    Impact impact;
    impact.damping_ratio = (low + high) / 2;
    Cvode solver(impact, 1e-10);
    solver.run_to(5e-3);
    (-solver.state()[1] > restitution ? low : high) = impact.damping_ratio;
  }
  return low;
}

// A worn nut, reversed harder than the guides' friction brakes the load: it meets both flanks.
BacklashAxisDefinition worn_axis() {
  BacklashAxisDefinition axis;
  axis.axis.data.gear.ratio = 2;
  soften(axis.axis.data.drive.servo);
  return axis;
}
const Motion to_and_fro = {{{0.2, 0, 4},
                            {0.6, 4, 4},
                            {0.9, 4, -5},
                            {1.3, -5, -5},
                            {1.5, -5, 3},
                            {1.7, 3, 3},
                            {1.8, 3, 0},
                            {2, 0, 0}}};

TEST(Witness, BacklashAxis) {
  const double damping_ratio = damping_ratio_by_impact(worn_axis().flanks.restitution);
  const auto unit = [] {
    return std::make_unique<ScrewUnit<LinearAxis>>(worn_axis(), worn_axis().axis.data);
  };
  const auto law = [damping_ratio] {
    const LinearAxisData data = worn_axis().axis.data;
    const FlankData flanks = worn_axis().flanks;
    auto own = std::make_unique<ScrewLaw>(data, data.drive.servo, to_and_fro);
    const double q = own->per_metre;
    const double motor_mass = own->motor_inertia * std::pow(data.gear.ratio * q, 2);
    const double mass = data.mass * motor_mass / (data.mass + motor_mass);
    own->gear.stiffness = flanks.stiffness / q / q;
    own->gear.damping = 2 * damping_ratio * std::sqrt(flanks.stiffness * mass) / q / q;
    own->gear.backlash = flanks.gap * q;
    return own;
  };
  expect_witness<ScrewLaw>(
      unit, law, 2.5e-6, 3e-7,
      with({{"no play", [](ScrewLaw& l) { l.gear.backlash = 0; }},
            {"no breakaway", [](ScrewLaw& l) { l.guide_friction.data.breakaway = 0; }}}));
}

}  // namespace
}  // namespace drycut::plants::witness
