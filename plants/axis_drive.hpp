#pragma once
#include <string>
#include <variant>
#include <vector>

#include "plants/changeover.hpp"
#include "plants/contactor_drive.hpp"
#include "plants/efficiency.hpp"
#include "plants/holding_brake.hpp"
#include "plants/inverter.hpp"
#include "plants/servo_drive.hpp"

namespace drycut::plants {

/// The motor of an axis with what feeds and what holds it.
struct AxisDriveData {
  std::string kind = "servo";    ///< servo, inverter, contactors, shared
  std::string fed_as = "servo";  ///< shared: kind of the drive that feeds it
  ServoData servo = {};
  InductionMotorData motor = {};  ///< of inverter and contactors
  InverterData inverter = {};
  ContactorData contactors = {};
  HoldingBrakeData brake = {};
  SharedDriveData shared = {};
  std::string servo_model = std::string(no_model);  ///< whose values `servo` has; whoever fills it sees to it
  std::string motor_model = std::string(no_model);  ///< whose `motor` has

  [[nodiscard]] double rotor_inertia() const {  ///< of the motor that is chosen [kg m2]
    return has_servo_motor() ? servo.rotor_inertia : motor.rotor_inertia;
  }
  [[nodiscard]] bool has_servo_motor() const { return (kind == "shared" ? fed_as : kind) == "servo"; }
  /// Takes the motor of the axis whose drive it shares.
  void share(const AxisDriveData& lender);
};

/// Where a machine's defaults are from.
struct AxisDriveSources {
  std::string_view kind = "positioning by voltage";
  ServoSources servo = {};
  std::string_view brake_torque = "none";
};
/// Rows for a parameter table but for those of a shared drive: `drive`, `servo.`, `induction_motor.`,
/// `inverter.`, `contactors.`, `brake.`.
Parameters axis_drive_parameters(AxisDriveData& data, const AxisDriveSources& from = {});
/// What is wrong with the data taken together; `inertia` turns with the motor [kg m2], steps of `h`
/// seconds.
std::vector<PlantDefinition::Objection> axis_drive_objections(const AxisDriveData& data, double inertia,
                                                              double h);

class AxisDrive {
 public:
  /// `name` is that of the machine's sources of noise and scatter.
  AxisDrive(const AxisDriveData& data, World& world, const std::string& name);

  /// Torque of the motor for the coming step of `h` seconds, and the brake's command. The brake itself is dry
  /// friction of brake_torque() that the plant applies with the other friction.
  void drive(Shaft& rotor, double h);

  /// Shares the drive with the motor of another axis, which is `drive: shared` and turns `rotor`.
  void lend_to(AxisDrive& other, Shaft& rotor);

  [[nodiscard]] double torque() const;  ///< of the motor [N m]
  [[nodiscard]] PowerStage& power();    ///< the electrical side
  [[nodiscard]] double brake_torque() const { return brake_.torque(); }
  [[nodiscard]] const HoldingBrake& brake() const { return brake_; }
  /// Neither the drive moves the motor nor may the brake be open.
  [[nodiscard]] bool at_rest() const { return !moves_ && brake_.commanded_to_hold(); }
  [[nodiscard]] bool has_events();
  /// What happened to it since it was asked last.
  [[nodiscard]] std::vector<MachineEvent> take_events(const Shaft& rotor);

  /// For Plant::drives(), with what it turns, seen at the motor [kg m2].
  [[nodiscard]] std::vector<DriveOfPlant> drives(double load_inertia, const Efficiency& through) {
    const bool servo = data_.kind == "servo";
    return {{.name = data_.kind == "shared" ? "motor"
                     : servo                ? "servo"
                                            : "drive",
             .stage = &power(),
             .load_inertia = load_inertia,
             .efficiency = through.driving,
             .cogging = servo ? data_.servo.cogging : 0,
             .torque_ripple = servo ? data_.servo.torque_ripple : 0}};
  }

  // What it adds to a plant's lists.
  void offer_ports(std::vector<Port>& ports);
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_settings(std::vector<Setting>& settings);
  void offer_faults(std::vector<Fault>& faults);
  static void offer_events(std::vector<EventType>& types);

  /// Between two steps, as its events have been taken.
  void visit(StateArchive& archive);

 private:
  [[nodiscard]] double rated_torque() const;
  [[nodiscard]] double drive_torque() const;
  [[nodiscard]] PowerStage::Step given() const;
  [[nodiscard]] bool live() const;
  void switch_over(double h);

  const AxisDriveData data_;
  std::variant<ServoDrive, Inverter, ContactorDrive, SharedMotor> drive_;
  HoldingBrake brake_;
  Changeover changeover_;
  int connected_ = Changeover::nothing;  // in the last step
  bool moves_ = false;
  bool tripped_ = false;
  bool just_tripped_ = false;
  double against_brake_ = 0;  // how long it has worked against its brake [s]
  bool just_against_brake_ = false;
  std::vector<MachineEvent> switched_;
};

}  // namespace drycut::plants
