#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "plants/plant.hpp"

namespace drycut::plants {

class Random;

/// A body that turns about an axis parallel to z: rotor, drum. The angle is whole turns plus a part of a
/// turn, so that it neither wraps nor loses digits over millions of turns. A plant adds torques before the
/// step and reads the motion after it; writing `speed` imposes it.
struct Shaft {
  double inertia = 0;             ///< [kg m2]
  double torque = 0;              ///< sum for the coming step [N m]; the step takes and clears it
  double speed = 0;               ///< at the end of the last step [rad/s]
  double speed_before = 0;        ///< at its start
  std::int64_t turns = 0;         ///< whole turns, counted down when negative
  double part = 0;                ///< part of a turn, 0 <= part < 1
  std::int64_t turns_before = 0;  ///< at the start of the last step
  double part_before = 0;

  void add_torque(double newton_metre) { torque += newton_metre; }
  [[nodiscard]] double revolutions() const { return static_cast<double>(turns) + part; }
  [[nodiscard]] double revolutions_before() const { return static_cast<double>(turns_before) + part_before; }
  /// Unwrapped angle [rad].
  [[nodiscard]] double angle() const { return 2 * std::numbers::pi * revolutions(); }
  void visit(StateArchive& archive);
};

/// A body that moves along a straight axis: web, carriage, piece.
struct Slide {
  double mass = 0;             ///< [kg]
  double force = 0;            ///< sum for the coming step, along the axis [N]; the step takes and clears it
  double speed = 0;            ///< at the end of the last step [m/s]
  double speed_before = 0;     ///< at its start
  double position = 0;         ///< at the end of the last step [m]
  double position_before = 0;  ///< at its start
  double remainder = 0;  ///< what rounding took away from `position` [m]: a day of travel must not drift
  bool awake = true;     ///< an asleep slide keeps its place

  void add_force(double newton) { force += newton; }
  void visit(StateArchive& archive);
};

/// Where a motion was at `fraction` 0..1 of a step of `h` seconds: the parabola of constant acceleration
/// through both ends, so that an event inside a step keeps its place to the second order.
[[nodiscard]] inline double within_step(double before, double now, double speed_before, double speed,
                                        double h, double fraction) {
  return before + (now - before) * fraction + 0.5 * (speed - speed_before) * h * fraction * (fraction - 1);
}

struct ShaftDefinition {
  std::string name;        ///< for messages
  double inertia = 1;      ///< [kg m2], > 0
  double revolutions = 0;  ///< angle at the start [turns]
  double speed = 0;        ///< at the start [rad/s]
};

struct SlideDefinition {
  std::string name;                        ///< for messages
  double mass = 1;                         ///< [kg], > 0
  std::array<double, 3> axis = {1, 0, 0};  ///< direction of motion, unit vector
  double position = 0;                     ///< at the start [m]
  double speed = 0;                        ///< at the start [m/s]
  bool gravity = false;                    ///< its weight acts along the axis
  bool slow = false;                       ///< moves once every World::slow_steps steps
};

/// The rigid bodies of a scenario: a double-precision Bullet world, stepped by a fixed step without collision
/// detection. Parts with one degree of freedom are guided by linear and angular factors (design §4). Bullet
/// integrates by symplectic Euler: speed first, then position with the new speed.
/// Built afresh for each run; bodies are stepped in the order in which they were added.
class World {
 public:
  /// Every random draw of the run follows from `seed`.
  explicit World(std::uint64_t seed = 1);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Adds a body; the reference stays valid as long as the world.
  Shaft& add_shaft(const ShaftDefinition& definition);
  Slide& add_slide(const SlideDefinition& definition);

  /// Gives a body of this world another mass [kg], > 0: a load is put on or taken off. It keeps its speed.
  void set_mass(Slide& slide, double mass);
  /// The same with an inertia [kg m2], > 0.
  void set_inertia(Shaft& shaft, double inertia);

  /// Moves all bodies by `h` seconds, the same in every call. Does not allocate. After a failure nothing
  /// moves.
  void step(double h);
  /// Why the simulation cannot go on ("knife.rotor: 9000 rad/s is more than an eighth of a turn in a step of
  /// 100 us; ..."), "" while all is well.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// What is no body cannot go on; the first reason stays.
  void fail(std::string why) {
    if (failure_.empty()) failure_ = std::move(why);
  }

  /// Slow bodies (cut pieces) move in every slow_steps-th step, by slow_steps times h at once.
  static constexpr int slow_steps = 10;
  /// True if the coming step moves the slow bodies: the time to apply their forces.
  [[nodiscard]] bool slow_due() const { return since_slow_ == slow_steps - 1; }
  /// Steps since the slow bodies moved last.
  [[nodiscard]] int since_slow() const { return since_slow_; }

  /// A generator of its own for each source of noise. The same name may be asked for again (two knives): the
  /// second source is another one.
  Random random(std::string_view source);

  /// The pose that Bullet keeps of a body of this world.
  [[nodiscard]] Pose pose(const Shaft& shaft) const;
  [[nodiscard]] Pose pose(const Slide& slide) const;

  /// All bodies, after the plants: their live parameters are masses.
  void visit(StateArchive& archive);

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
  std::string failure_;
  int since_slow_ = 0;
};

}  // namespace drycut::plants
