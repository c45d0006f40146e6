// A second witness: the mechanics as MuJoCo has them, from hinges, slides, tendons and actuators, told in its
// own model language. It gets the torque that the drive of the plant gave in each step; all that follows is
// its own.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "plants/backlash_axis.hpp"
#include "plants/linear_axis.hpp"
#include "plants/rotary_knife.hpp"
#include "plants/vertical_press.hpp"
#include "tests/plants/plants_lookup.hpp"
#include "tests/plants/witness/laws.hpp"

namespace drycut::plants::witness::mujoco {
namespace {

constexpr double step = 1e-5;         // [s]
constexpr double sample_time = 1e-3;  // [s]
constexpr int sample_count = 2000;
constexpr long steps_a_sample = 100;
constexpr double earth = 9.80665;  // [m/s2]

/// Motor and load of a machine with a spring between them, as a model of MuJoCo.
struct Mechanism {
  double motor_inertia = 0;  ///< [kg m2]
  double load = 0;           ///< [kg] of a slide, [kg m2] of a drum
  bool slides = true;
  double inclination = 0;  ///< of the slide [rad]
  TransmissionData gear;
  double per_load = 1;  ///< turn of the gear's output for a metre or rad of the load
  Friction motor_friction;
  Friction load_friction;
  double steady_force = 0;  ///< on the load besides its weight [N]
  double begin = 0;         ///< of the load
  double begin_twist = 0;   ///< of the gear [rad]
  EndStopData below = {};   ///< a spring that pushes the load up ...
  double below_from = 0;    ///< ... from here on downwards

  [[nodiscard]] std::string model() const {
    const auto joint = [](const Friction& friction) {
      return fmt::format(R"(damping="{}" frictionloss="{}")", friction.viscous, friction.coulomb);
    };
    // A spring with play is two that only push; both are actuators with a limit of their force.
    std::string springs;
    const auto push = [&](const std::string& at, double stiffness, const char* range) {
      springs += fmt::format(
          R"(<general {} gainprm="{}" biastype="affine" biasprm="0 {} 0" forcelimited="true" forcerange="{}"/>)",
          at, stiffness, -stiffness, range);
    };
    const bool play = gear.backlash > 0;
    if (play) {
      push(R"(tendon="gear")", gear.stiffness, "-1e12 0");
      push(R"(tendon="gear")", gear.stiffness, "0 1e12");
    }
    if (below.stiffness > 0) push(R"(joint="load")", below.stiffness, "0 1e12");
    return fmt::format(
        R"(<mujoco>
  <compiler angle="radian"/>
  <option timestep="{}" gravity="0 {} 0" integrator="Euler" solver="Newton" tolerance="1e-14"><flag contact="disable"/></option>
  <default><joint solreffriction="{} 1" solimpfriction="0.9999 0.9999 0.001 0.5 2"/></default>
  <worldbody>
    <body name="motor"><joint name="motor" type="hinge" axis="0 0 1" {}/><inertial pos="0 0 0" mass="1" diaginertia="{} {} {}"/></body>
    <body name="load"><joint name="load" type="{}" axis="{}" {}/><inertial pos="0 0 0" mass="{}" diaginertia="{} {} {}"/></body>
  </worldbody>
  <tendon><fixed name="gear" springlength="0" stiffness="{}" damping="{}"><joint joint="motor" coef="{}"/><joint joint="load" coef="{}"/></fixed></tendon>
  <actuator>{}</actuator>
</mujoco>)",
        step, -earth, 2 * step, joint(motor_friction), motor_inertia, motor_inertia, motor_inertia,
        slides ? "slide" : "hinge",
        slides ? fmt::format("{} {} 0", std::cos(inclination), std::sin(inclination)) : "0 0 1",
        joint(load_friction), slides ? load : 1.0, slides ? 1.0 : load, slides ? 1.0 : load,
        slides ? 1.0 : load, play ? 0 : gear.stiffness, play ? 0 : gear.damping, 1 / gear.ratio, -per_load,
        springs);
  }
};

/// A model that MuJoCo has read, and its state. Throws std::runtime_error where it refuses the model.
class Mujoco {
 public:
  explicit Mujoco(const std::string& text) {
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "machine.xml", static_cast<int>(text.size()) + 1);
    std::memcpy(files->filedata[0], text.c_str(), text.size() + 1);
    std::array<char, 500> error = {};
    model_ = mj_loadXML("machine.xml", files.get(), error.data(), static_cast<int>(error.size()));
    mj_deleteVFS(files.get());
    if (model_ == nullptr) throw std::runtime_error(error.data());
    data_ = mj_makeData(model_);
  }
  ~Mujoco() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  mjData& data() { return *data_; }
  void step() { mj_step(model_, data_); }

 private:
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

/// What the drive gave and the process did, a step each.
struct Course {
  std::vector<double> torque;  ///< [N m]
  std::vector<double> force;   ///< [N]
  Track track;
};

/// Both as travel of the load, which is `arm` [m] for a unit of it.
Track told_by_mujoco(const Mechanism& of, const Course& course, double arm) {
  Mujoco mujoco(of.model());
  auto& data = mujoco.data();
  data.qpos[1] = of.begin;
  data.qpos[0] = (of.begin * of.per_load + of.begin_twist) * of.gear.ratio;
  int spring = 0;
  if (of.gear.backlash > 0) {
    data.ctrl[spring++] = of.gear.backlash / 2;
    data.ctrl[spring++] = -of.gear.backlash / 2;
  }
  if (of.below.stiffness > 0) data.ctrl[spring] = of.below_from;
  Track track;
  for (std::size_t i = 0; i < course.torque.size(); ++i) {
    data.qfrc_applied[0] = course.torque[i];
    data.qfrc_applied[1] = of.steady_force + course.force[i];
    mujoco.step();
    if ((i + 1) % steps_a_sample != 0) continue;
    track.motor.push_back(data.qpos[0] / of.gear.ratio / of.per_load * arm);
    track.load.push_back(data.qpos[1] * arm);
  }
  return track;
}

template <class Place>
Course course_of(Machine& machine, Motion motion, bool has_process, Place place) {
  Course course;
  double& volts = machine.plug<ReferencePort>("servo.reference").volts;
  const Channel* torque = nullptr;
  auto channels = machine.plant->channels();
  for (const auto& channel : channels)
    if (channel.name == "motor.torque") torque = &channel;
  for (int i = 0; i < sample_count; ++i) {
    if ((motion.follow(i * sample_time) || i == 0) && has_process) machine.set("force", motion.force());
    for (long k = 0; k < steps_a_sample; ++k) {
      volts = motion.volts(i * sample_time + (static_cast<double>(k) + 0.5) * step);
      machine.step(step);
      course.torque.push_back(torque->read());
      course.force.push_back(has_process ? motion.force() : 0);
    }
    const auto [motor, load] = place();
    course.track.motor.push_back(motor);
    course.track.load.push_back(load);
  }
  EXPECT_EQ(machine.world.failure(), "");
  return course;
}

double most_apart(const Track& one, const Track& other) {
  double most = 0;
  for (std::size_t i = 0; i < one.load.size(); ++i)
    most = std::max({most, std::abs(one.load[i] - other.load[i]), std::abs(one.motor[i] - other.motor[i])});
  return most / one.travel();
}

struct Wrong {
  const char* what;
  void (*make)(Mechanism& mechanism);
};

/// Plant and MuJoCo agree to `tolerance` of the travel; with a mistake in the mechanism they do not.
void expect_agreement(const Course& course, const Mechanism& mechanism, double arm, double tolerance,
                      const std::vector<Wrong>& mistakes) {
  ASSERT_GT(course.track.travel(), 0);
  const auto apart = [&](const Mechanism& of) {
    return most_apart(course.track, told_by_mujoco(of, course, arm));
  };
  const double found = apart(mechanism);
  testing::Test::RecordProperty("apart", fmt::format("{:.3g}", found));
  EXPECT_LT(found, tolerance);
  for (const auto& [what, make] : mistakes) {
    Mechanism wrong = mechanism;
    make(wrong);
    EXPECT_GT(apart(wrong), 10 * tolerance) << what;
  }
}

void soften(ServoData& servo) {
  servo.speed_gain = 30;
  servo.integral_time = 0.1;
  servo.adc_bits = 24;
}

/// A part on a screw.
Mechanism screw_mechanism(const ScrewDriveData& data, const ServoData& servo) {
  Mechanism of;
  of.motor_inertia = servo.rotor_inertia + data.screw_inertia / (data.gear.ratio * data.gear.ratio);
  of.load = data.mass;
  of.gear = data.gear;
  of.per_load = 2 * std::numbers::pi / data.lead;
  of.motor_friction = data.motor_friction;
  of.load_friction = data.guide_friction;
  of.begin = data.start;
  return of;
}

template <class Type>
auto place_of(Machine& machine, const Mechanism& of) {
  return [&machine, per_metre = of.per_load * of.gear.ratio] {
    auto& axis = static_cast<Type&>(*machine.plant);
    if constexpr (requires { axis.ram(); })
      return std::pair(axis.rotor().angle() / per_metre, axis.ram().position);
    else
      return std::pair(axis.rotor().angle() / per_metre, axis.carriage().position);
  };
}

TEST(MujocoWitness, LinearAxisUpAnInclineAndDown) {
  LinearAxisDefinition axis;
  axis.data.inclination = 0.35;
  axis.data.gear = {2, 1000, 0.05, 0};
  soften(axis.data.drive.servo);
  Machine machine(axis);
  auto of = screw_mechanism(axis.data, axis.data.drive.servo);
  of.inclination = axis.data.inclination;
  const Motion motion = {
      {{0.1, 0, 0}, {0.5, 7, 7}, {0.8, 7, 7, -200}, {1.1, 7, -6}, {1.5, -6, -6}, {1.6, -6, 0}, {2, 0, 0}}};
  const auto course = course_of(machine, motion, true, place_of<LinearAxis>(machine, of));
  expect_agreement(course, of, 1, 1e-5,
                   {{"level", [](Mechanism& m) { m.inclination = 0; }},
                    {"half the motor", [](Mechanism& m) { m.motor_inertia /= 2; }},
                    {"half the dry friction of the load", [](Mechanism& m) { m.load_friction.coulomb /= 2; }},
                    {"motor without viscous friction", [](Mechanism& m) { m.motor_friction.viscous = 0; }},
                    {"a soft gear", [](Mechanism& m) { m.gear.stiffness /= 20; }}});
}

TEST(MujocoWitness, PressOnAWorkpiece) {
  VerticalPressDefinition press;
  auto& data = press.data;
  data.drive.kind = "servo";
  data.drive.brake.torque = 0;
  data.gear.ratio = 2;
  data.efficiency = {};
  data.workpiece_height = 0.26;
  data.workpiece = {5e5, 0};
  soften(data.drive.servo);
  data.drive.servo.peak_torque = data.drive.servo.torque_at_max_speed = 15;
  Machine machine(press);
  auto of = screw_mechanism(data, data.drive.servo);
  of.inclination = std::numbers::pi / 2;
  of.steady_force = data.counterbalance;
  of.begin_twist = (data.mass * earth - data.counterbalance) / of.per_load / data.gear.stiffness;
  of.below = data.workpiece;
  of.below_from = data.workpiece_height;
  const Motion motion = {{{0.3, 0, -5}, {1.1, -5, -5}, {1.4, -5, 5}, {1.7, 5, 5}, {1.9, 5, 0}, {2, 0, 0}}};
  const auto course = course_of(machine, motion, false, place_of<VerticalPress>(machine, of));
  // On the workpiece dry friction holds it anywhere within 0.3 mm.
  expect_agreement(course, of, 1, 1e-3,
                   {{"no workpiece", [](Mechanism& m) { m.below.stiffness = 0; }},
                    {"no counterbalance", [](Mechanism& m) { m.steady_force = 0; }}});
}

TEST(MujocoWitness, BacklashAxisMeetsBothFlanks) {
  BacklashAxisDefinition axis;
  auto& data = axis.axis.data;
  data.gear.ratio = 2;
  data.guide_friction.breakaway = 0;
  axis.flanks.restitution = 1;
  axis.flanks.stiffness = 2e6;
  soften(data.drive.servo);
  Machine machine(axis);
  auto of = screw_mechanism(data, data.drive.servo);
  of.gear.stiffness = axis.flanks.stiffness / (of.per_load * of.per_load);
  of.gear.damping = 0;
  of.gear.backlash = axis.flanks.gap * of.per_load;
  const Motion motion = {{{0.2, 0, 4},
                          {0.6, 4, 4},
                          {0.9, 4, -5},
                          {1.3, -5, -5},
                          {1.5, -5, 3},
                          {1.7, 3, 3},
                          {1.8, 3, 0},
                          {2, 0, 0}}};
  const auto course = course_of(machine, motion, false, place_of<LinearAxis>(machine, of));
  expect_agreement(course, of, 1, 1e-4, {{"no play", [](Mechanism& m) { m.gear.backlash = 1e-9; }}});
}

TEST(MujocoWitness, KnifeWithPlayInItsGearAndNothingToCut) {
  RotaryKnifeDefinition knife;
  auto& data = knife.data;
  soften(data.drive.servo);
  data.gear.backlash = 2e-3;
  data.gear.damping = 0;
  data.coupling = 0;
  WebDefinition web;
  web.data.shear_strength = 0;
  Machine machine(knife, &web);
  Mechanism of;
  of.slides = false;
  of.motor_inertia = data.drive.servo.rotor_inertia;
  of.load = data.drum_inertia;
  of.gear = data.gear;
  of.motor_friction = data.motor_friction;
  of.load_friction = data.drum_friction;
  of.begin = data.initial_angle;
  const double radius = data.circumference / (2 * std::numbers::pi);
  const auto place = [&] {
    auto& own = static_cast<RotaryKnife&>(*machine.plant);
    return std::pair(own.rotor().angle() / data.gear.ratio * radius, own.drum().angle() * radius);
  };
  const Motion motion = {
      {{0.2, 0, 2.5}, {1.2, 2.5, 2.5}, {1.4, 2.5, -0.8}, {1.8, -0.8, -0.8}, {1.9, -0.8, 0}, {2, 0, 0}}};
  const auto course = course_of(machine, motion, false, place);
  expect_agreement(course, of, radius, 2e-5, {{"no play", [](Mechanism& m) { m.gear.backlash = 1e-9; }}});
}

}  // namespace
}  // namespace drycut::plants::witness::mujoco
