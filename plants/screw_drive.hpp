#pragma once
#include <array>
#include <string>

#include "plants/end_stop.hpp"
#include "plants/motor_load.hpp"
#include "plants/transducers.hpp"
#include "plants/transmission.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// A part on a guided slide that a motor moves through gear and screw, belt, or rack and pinion. "Screw"
/// stands for what turns travel into turns: the screw, the belt's pulley or the rack's pinion.
struct ScrewDriveData {
  double mass = 20;             ///< of the part with all that it carries [kg]
  double lead = 0.02;           ///< travel for one turn of the screw [m]
  double screw_inertia = 3e-4;  ///< of the screw; turns with the motor [kg m2]
  double start = 0;             ///< position at the start; the encoders count 0 there [m]
  double travel_min = 0;        ///< where the part touches the end stops [m]
  double travel_max = 1;
  EndStopData stop = {};
  /// Gear, coupling and screw up to the part: ratio, stiffness, damping and play as seen at the screw.
  TransmissionData gear = {};
  Friction motor_friction = {};
  Friction guide_friction = {};
  AxisTransducersData sensors = {};
};

/// What turns with a motor whose rotor has `rotor_inertia`, seen there [kg m2].
[[nodiscard]] double motor_inertia(const ScrewDriveData& data, double rotor_inertia);
/// The part's mass, seen at the screw [kg m2].
[[nodiscard]] double reflected_inertia(const ScrewDriveData& data);

/// All that the motor turns but its rotor, seen there [kg m2].
[[nodiscard]] double load_inertia(const ScrewDriveData& data);

/// Rotor and part are bodies of their own; the rotor turns with the screw's inertia (reflected by the gear
/// ratio squared). Between them is one spring with damper and play.
class ScrewDrive {
 public:
  /// `name` is that of the machine's sources of noise and, with "motor", of the rotor. `part` is the guided
  /// body but for its position.
  ScrewDrive(const ScrewDriveData& data, const std::string& name, double rotor_inertia, SlideDefinition part,
             World& world, double twist = 0);

  Shaft& rotor;
  Slide& slide;
  std::array<EndStop, 2> stops;  ///< lower, upper
  AxisTransducers sensors;

  // For the coming step of `h` seconds, in this order; what else acts on the part comes before its end stops.
  void transmit();
  void push_back(double h);
  /// Dry friction last: it answers to all other efforts, and so to a `weight` along the slide [N] that the
  /// world adds. `on_rotor`: what else holds the motor.
  void rub(double h, const DryResistance& on_rotor = {}, double weight = 0);

  /// Follows the bodies over the last step of `h` seconds.
  void sense(double h);

  /// Other gear, friction and mass of the part [kg] from now on; the rest must be kept.
  void take(const ScrewDriveData& data, double mass, World& world);

  /// What the motor's `torque` went into in the last step of `h` seconds; `weight` acts along the slide [N].
  [[nodiscard]] MotorLoad motor_load(double torque, double weight, double h) const;
  [[nodiscard]] double torque() const { return torque_; }  ///< at the screw in the last step [N m]
  [[nodiscard]] double force() const { return force_; }    ///< on the part in the last step [N]
  [[nodiscard]] double twist() const { return twist_; }    ///< of the screw ahead of the part [rad]
  /// The same as travel: play and twist taken up [m].
  [[nodiscard]] double ahead() const { return twist_ / screw_per_metre_; }
  [[nodiscard]] double stop_force() const { return stops[0].force() + stops[1].force(); }  ///< [N]
  [[nodiscard]] double screw_turn() const;  ///< within a turn [rad]

  /// But the data, which whoever gives them keeps.
  void visit(StateArchive& archive);

 private:
  [[nodiscard]] double rate() const;

  ScrewDriveData data_;
  const double screw_per_metre_;  // turn of the screw per travel [rad/m]
  double twist_;
  double torque_ = 0;
  double force_ = 0;
  double rubbing_ = 0;  ///< of the guides, in the step under way [N]
};

}  // namespace drycut::plants
