#pragma once
#include <limits>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/power_stage.hpp"
#include "plants/random.hpp"
#include "plants/torque_filters.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// A servo amplifier with +-10 V speed reference and its motor. Data sheet values: Mitsubishi HG-SR202 (2
/// kW).
struct ServoData {
  // Motor
  double rotor_inertia = 46.8e-4;  ///< [kg m2]
  double rated_torque = 9.5;       ///< [N m]
  double peak_torque = 28.6;       ///< up to rated speed [N m]
  double torque_at_max_speed =
      19;  ///< peak torque left at max_speed, falling linearly from rated speed [N m]
  double rated_speed = 2000 * std::numbers::pi / 30;  ///< 2000 rpm [rad/s]
  double max_speed =
      3000 * std::numbers::pi / 30;  ///< 3000 rpm [rad/s]; no driving torque is left 5 % above it
  // What the motor's magnets and windings add, over a turn
  std::string motor_class = "ideal";  ///< of motor_classes(): the amplitudes unless they are given
  double cogging = 0;                 ///< amplitude, without current too [N m]
  int cogging_periods = 60;           ///< a turn: the least common multiple of slots and poles
  double torque_ripple = 0;           ///< amplitude over the torque
  int torque_ripple_periods = 24;     ///< a turn: six times the pole pairs
  // Reference input
  double speed_at_10v = 2000 * std::numbers::pi / 30;  ///< [rad/s]
  int adc_bits = 14;                                   ///< over -10 V .. +10 V
  double offset = 0;                                   ///< of the analogue input [V]
  double filter = 1e-3;  ///< time constant of the reference filter, 0 = none [s]
  // Speed loop: Kp = (1 + inertia_ratio) * rotor_inertia * speed_gain
  double speed_gain = 250;       ///< [rad/s]
  double integral_time = 20e-3;  ///< Ti [s]
  double inertia_ratio = 3.5;    ///< load to motor inertia, as set in the amplifier
  double current_lag = 0.5e-3;   ///< time constant of the current loop, 0 = none [s]
  /// Of the torque for the reference's acceleration, (1 + inertia_ratio) rotor_inertia times it, the share
  /// that is given ahead of the speed loop.
  double torque_forward = 0;
  double torque_forward_filter = 2e-3;  ///< time constant, 0 = none [s]
  TorqueFilterData filters = {};
  // Electrical side; 0 = not known, estimated from the rest: see electrical()
  double stall_torque = 0;        ///< for ever, at standstill [N m]
  double torque_constant = 0.99;  ///< over the rms current, where no currents are given [N m/A]
  double rated_current = 0;       ///< rms at rated torque [A]
  double stall_current = 0;       ///< rms at stall torque [A]
  double peak_current = 0;        ///< rms at peak torque [A]
  double winding_resistance = 0;  ///< between two phases, cold (20 degC) [ohm]
  MotorHeatData heat = {};
  AmplifierData amplifier = {};
  SupplyData supply = {.voltage = 200, .capacitance = 2e-3, .resistor = 13};
};

/// The data with estimates for what is not known: as much torque at standstill as at rated speed, 6 % of the
/// rated power lost in cold copper, an amplifier that has the current for the motor's torques. Currents by
/// the torque constant where none is given; where one is, a quarter more at peak torque than it says, for
/// iron saturates.
[[nodiscard]] ServoData electrical(ServoData data);
/// A current is given: the sheet's currents count, and not the torque constant.
[[nodiscard]] bool has_currents(const ServoData& data);

/// Current and loss of the servo's motor.
[[nodiscard]] MotorCurrent motor_current(const ServoData& data);

/// The servo's curves of torque over speed: those of the motor, as far as the amplifier has current for them.
[[nodiscard]] DriveRatings ratings(const ServoData& data);

/// Where a machine's defaults are from.
struct ServoSources {
  std::string_view inertia_ratio = "as of the rotary knife's default drum behind gear 5: 0.41 / 25 / 0.00468";
  std::string_view speed_at_10v = "usual setting: rated speed at 10 V";
};
/// Rows of the group `servo.`.
Parameters servo_parameters(ServoData& data, const ServoSources& from = {});

/// What is wrong with the data taken together, with `inertia` on the motor's shaft [kg m2] and steps of `h`
/// seconds.
std::vector<PlantDefinition::Objection> servo_objections(const ServoData& data, double inertia, double h);

/// Kinds of servo motors with the usual unevenness of their torque over a turn; values of the parameters
/// servo.cogging, as a share of servo.rated_torque, and servo.torque_ripple.
const std::vector<Preset>& motor_classes();

class ServoDrive {
 public:
  ServoDrive(const ServoData& data, Random noise);

  ReferencePort reference;
  CommandPort enable;  ///< high unless something is wired to it (strapped in the cabinet); its rising edge
                       ///< resets a trip of the power stage

  /// One step of the amplifier: torque on the rotor for the coming step of `h` seconds. Behind contactors it
  /// is the rotor that they connect.
  void drive(Shaft& rotor, double h, const Feed& feed = {});
  /// The same with the speed reference of a position loop [rad/s]: neither analogue input nor its filter.
  /// `commanded`: speed of what the loop follows, whose acceleration counts for the torque ahead [rad/s].
  void follow(double speed_reference, double commanded, Shaft& rotor, double h);
  /// The same without a torque command: the motor coasts, and the loop starts from its speed afterwards.
  void coast(Shaft& rotor, double h);

  /// The amplifier drives the motor: enabled and not tripped.
  [[nodiscard]] bool enabled() const { return enable.level && !faults_.disabled && !power_.tripped(); }
  [[nodiscard]] double torque() const { return torque_; }  ///< on the rotor [N m]
  /// What the speed loop asks for, through its filters, before test signal and limit [N m].
  [[nodiscard]] double asked() const { return wanted_; }
  [[nodiscard]] double speed_reference() const { return filtered_; }  ///< after the filter [rad/s]
  [[nodiscard]] double volts() const { return converted_; }           ///< as converted [V]
  [[nodiscard]] bool saturated() const { return saturated_; }         ///< the torque limit acts
  [[nodiscard]] const ServoData& data() const { return data_; }
  [[nodiscard]] double utilisation() const { return std::abs(torque_) / data_.rated_torque; }
  [[nodiscard]] PowerStage& power() { return power_; }  ///< the electrical side
  [[nodiscard]] const PowerStage& power() const { return power_; }

  /// Its test signal, `servo.test_torque`.
  void offer_settings(std::vector<Setting>& settings);
  /// Faults for a plant's list, under the component name `component`. A value of 0 clears each of them.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);
  /// Those of them that do not need the analogue input.
  void offer_power_faults(std::vector<Fault>& faults, const std::string& component);

  void visit(StateArchive& archive);

 private:
  void begin(const Shaft& turned, double h, const PowerStage* other = nullptr);
  void release(Shaft& rotor);
  void end_loops(double speed);
  void prepare(double h);
  [[nodiscard]] double convert(double volts) const;
  [[nodiscard]] double speed_loop(double speed, double h);
  [[nodiscard]] double torque_ahead(double commanded, double h);
  void give(double command, Shaft& rotor);
  [[nodiscard]] double ripple(const Shaft& rotor) const;

  const ServoData data_;
  PowerStage power_;
  Random random_;
  const bool ripples_;
  double h_ = 0;  // the step for which the coefficients below hold; 0: they are to be made anew
  double input_ = std::numeric_limits<double>::quiet_NaN();  // what converted_ is of [V]
  double filter_share_ = 1;
  double lag_share_ = 1;
  double speed_per_volt_ = 0;
  double lsb_ = 0;
  double forward_share_ = 1;

  double converted_ = 0;
  double filtered_ = 0;
  double integral_ = 0;
  double commanded_ = 0;     // speed in the last step [rad/s]
  double acceleration_ = 0;  // of it, filtered [rad/s2]
  double ahead_ = 0;         // torque for it [N m]
  TorqueFilters filters_;
  double wanted_ = 0;       // [N m]
  double test_torque_ = 0;  // [N m]
  double torque_ = 0;
  bool saturated_ = false;
  double asked_ = 0;  // torque over what the limit let through
  bool energised_ = false;
  bool enabled_before_ = true;

  struct Faults {
    double offset = 0;   // [V]
    double drift = 0;    // [V/s]
    double drifted = 0;  // [V]
    double noise = 0;    // rms [V]
    bool stuck = false;
    double stuck_at = 0;  // [V]
    bool disabled = false;
    double torque_limit = 0;  // [N m], 0 = none

    void visit(StateArchive& archive);
  } faults_;
};

}  // namespace drycut::plants
