#pragma once
#include <array>
#include <string>
#include <string_view>

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
  double screw_inertia = 3e-4;  ///< of the screw [kg m2]
  /// What the screw turns with. Neither: with the motor, for `gear` has the stiffness of nut and bearings.
  bool nut_rigid = false;    ///< with the part: `gear` is coupling and gear alone
  double nut_stiffness = 0;  ///< of nut and bearings along the screw, over 0: it is a body of its own [N/m]
  double nut_damping = 0;    ///< [N s/m]
  double start = 0;          ///< position at the start; the encoders count 0 there [m]
  double travel_min = 0;     ///< where the part touches the end stops [m]
  double travel_max = 1;
  EndStopData stop = {};
  /// Gear, coupling and screw up to the part: ratio, stiffness, damping and play as seen at the screw.
  TransmissionData gear = {};
  std::string moved_by = "loss_free";  ///< of slide_types(): its efficiency unless that is given
  Efficiency efficiency = {};          ///< of screw, belt or rack
  Friction motor_friction = {};
  Friction guide_friction = {};
  double guide_coefficient = 0;  ///< dry friction besides, over the weight that lies on the guides
  double guide_weight = 1;       ///< share of the weight that does: cos of the inclination
  AxisTransducersData sensors = {};
};

/// What turns with a motor whose rotor has `rotor_inertia`, seen there [kg m2].
[[nodiscard]] double motor_inertia(const ScrewDriveData& data, double rotor_inertia);
/// The part's mass, seen at the screw [kg m2].
[[nodiscard]] double reflected_inertia(const ScrewDriveData& data);

/// All that moves behind the gear's spring, seen at the screw: the part, and the screw unless it turns with
/// the motor [kg m2].
[[nodiscard]] double behind_gear(const ScrewDriveData& data);
/// What of it the spring turns itself: a screw that is a body of its own has the nut's spring behind it.
[[nodiscard]] double on_gear(const ScrewDriveData& data);

/// All that the motor turns but its rotor, seen there [kg m2].
[[nodiscard]] double load_inertia(const ScrewDriveData& data);
/// Of gear and screw together.
[[nodiscard]] Efficiency efficiency(const ScrewDriveData& data);

/// Rows `nut.`, `moved_by`, `efficiency` and `back_efficiency`; `moved_by_from`: where its default is from.
Parameters screw_parameters(ScrewDriveData& data, std::string_view moved_by_from);
/// The row `coefficient` of the group of the guides' friction.
Parameters guide_coefficient_parameters(ScrewDriveData& data);

/// Rotor and part are bodies of their own. Between them is one spring with damper and play; the screw's
/// inertia is the rotor's (reflected by the gear ratio squared) or the part's. With the nut's own stiffness
/// the screw is a body, too, between the gear's spring and that of the nut.
class ScrewDrive {
 public:
  /// `name` is that of the machine's sources of noise and, with "motor", of the rotor. `part` is the guided
  /// body but for its position. `held`: force with which the screw holds it at the start [N].
  ScrewDrive(const ScrewDriveData& data, const std::string& name, double rotor_inertia, SlideDefinition part,
             World& world, double held = 0);

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
  /// Of the motor, seen at the screw, ahead of the part [rad].
  [[nodiscard]] double twist() const { return twist_ + stretch_ * screw_per_metre_; }
  /// The same as travel: play, twist and what the nut gives way [m].
  [[nodiscard]] double ahead() const { return twist() / screw_per_metre_; }
  /// The part without the screw that may turn with it [kg].
  [[nodiscard]] double mass() const { return slide.mass - with_part_; }
  [[nodiscard]] double stop_force() const { return stops[0].force() + stops[1].force(); }  ///< [N]
  [[nodiscard]] double screw_turn() const;  ///< within a turn [rad]

  /// But the data, which whoever gives them keeps.
  void visit(StateArchive& archive);

 private:
  [[nodiscard]] double rate() const;
  [[nodiscard]] double nut_rate() const;
  void take_data(const ScrewDriveData& data, double mass);

  ScrewDriveData data_;
  Efficiency before_screw_;  // losses on the motor's shaft
  Friction guide_friction_;
  const double rotor_inertia_;
  const double screw_per_metre_;  // turn of the screw per travel [rad/m]
  const double with_part_;        // the screw's inertia, where it moves with the part [kg]
  const double lift_;             // what the world makes it weigh [N]
  Shaft* screw_ = nullptr;        // a body of its own
  double twist_ = 0;              // of the gear
  double stretch_ = 0;            // of the nut [m]
  double torque_ = 0;
  double force_ = 0;
  double rubbing_ = 0;  ///< of the guides, in the step under way [N]
};

}  // namespace drycut::plants
