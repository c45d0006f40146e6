#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace drycut {
class StateArchive;
}

namespace drycut::plants {

/// Coulomb, static and viscous friction of a guided body; in N m and N m s/rad for a shaft, N and N s/m for a
/// slide.
struct Friction {
  double coulomb = 0;    ///< dry friction while it moves
  double viscous = 0;    ///< per unit of speed
  double breakaway = 0;  ///< what dry friction at standstill is above `coulomb` (Stribeck)
  double stribeck_speed =
      0;                ///< speed at which 1/e of `breakaway` is left [rad/s or m/s], > 0 with breakaway
  double backward = 1;  ///< dry friction of a motion backwards over that forwards
  double viscous_backward = 1;  ///< the same of viscous friction

  /// Viscous friction per unit of a speed.
  [[nodiscard]] double damping(double speed) const {
    return speed < 0 ? viscous * viscous_backward : viscous;
  }
  /// Dry friction forwards at a speed.
  [[nodiscard]] double dry(double speed) const {
    if (breakaway <= 0) return coulomb;
    const double ratio = speed / stribeck_speed;
    return coulomb + breakaway * std::exp(-ratio * ratio);
  }
};

/// What else resists the motion like dry friction, in one direction only: a blade in the material.
struct DryResistance {
  double forward = 0;   ///< against positive motion, >= 0
  double backward = 0;  ///< against negative motion, >= 0
};

/// The effort that friction and dry resistance exert on a body of `inertia` in the coming step of `h`
/// seconds, when all other efforts on it sum up to `effort`: call it last. Dry friction is as large as stops
/// the body within the step, up to its limit: it holds at standstill and never reverses a motion.
[[nodiscard]] inline double friction_effort(const Friction& friction, double speed, double effort,
                                            double inertia, double h, DryResistance extra = {}) {
  const double viscous = -friction.damping(speed) * speed;
  const double dry = friction.dry(speed);
  const double stopping = -(speed * inertia / h + effort + viscous);
  return viscous + std::clamp(stopping, -(dry + extra.forward), dry * friction.backward + extra.backward);
}

/// What the torque of a motor went into in a step, each part seen at the motor and positive where the motor
/// must give it [N m]. Together they are the torque, to rounding.
struct MotorLoad {
  double torque = 0;        ///< of the motor
  double acceleration = 0;  ///< of rotor and load, each body's own
  double friction = 0;      ///< with brakes, and what a screw loses
  double load = 0;          ///< of the process: cut, workpiece, clamps, end stops
  double gravity = 0;       ///< weight, less a counterbalance
  double speed = 0;         ///< of the motor [rad/s]
};

/// The part of `effort`, all that resisted a body in a step of `h` seconds, that was its friction, with
/// `speed` at the start of the step: as the model has it while it slides; of a body that stands what holds it
/// is friction as far as friction goes.
[[nodiscard]] inline double friction_in(const Friction& friction, double speed, double effort, double inertia,
                                        double h) {
  const double forward = friction.dry(speed);
  const double backward = forward * friction.backward;
  const double viscous = friction.damping(speed) * speed;
  const bool slides = std::abs(speed) * inertia > (speed > 0 ? forward : backward) * h;
  if (slides) return viscous + (speed > 0 ? forward : -backward);
  return viscous + std::clamp(effort - viscous, -backward, forward);
}

/// A plant with a drive that can say what its motor's torque goes into. It does so where it is asked to
/// before the run, every step; of a long run the last steps are kept.
class TellsMotorLoad {
 public:
  /// In single precision: a minute of steps of 100 us are 14 MB.
  struct Sample {
    float torque;  ///< each as in MotorLoad
    float acceleration;
    float friction;
    float load;
    float gravity;
    float speed;
  };
  struct Kept {
    std::size_t fewest = 0;  ///< that are always there, if the run had them; twice as many at most
    std::vector<Sample> samples = {};
    std::size_t left_out = 0;  ///< earlier ones
    void take(const Sample& sample);
    // A log of them.
    [[nodiscard]] std::size_t grown() const { return left_out + samples.size(); }
    void shorten(std::size_t size);
    void entries(StateArchive& archive, std::size_t from, std::size_t to);
  };

  virtual ~TellsMotorLoad() = default;

  /// What it went into in the last step of `h` seconds.
  [[nodiscard]] virtual MotorLoad motor_load(double h) const = 0;

  TellsMotorLoad(const TellsMotorLoad&) = delete;
  TellsMotorLoad& operator=(const TellsMotorLoad&) = delete;

  void keep_motor_loads(std::size_t fewest) { kept_ = std::make_unique<Kept>(Kept{.fewest = fewest}); }
  /// A sample a step since the start; nullptr where nobody asked.
  [[nodiscard]] const Kept* motor_loads() const { return kept_.get(); }
  /// The same: no part of the machine's state, megabytes for whoever writes a report after it.
  [[nodiscard]] Kept* motor_loads() { return kept_.get(); }

 protected:
  TellsMotorLoad() = default;

  /// At the end of each step.
  void tell_motor_load(double h) {
    if (kept_ != nullptr) keep(motor_load(h));
  }

 private:
  void keep(const MotorLoad& load);

  std::unique_ptr<Kept> kept_;
};

}  // namespace drycut::plants
