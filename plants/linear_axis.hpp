#pragma once
#include <array>
#include <string>
#include <vector>

#include "plants/axis_drive.hpp"
#include "plants/axis_transducers.hpp"
#include "plants/end_stop.hpp"
#include "plants/friction.hpp"
#include "plants/plant.hpp"
#include "plants/transmission.hpp"

namespace drycut::plants {

/// Parameters of `type: linear_axis`. The defaults are a ball screw unit of 1 m.
struct LinearAxisData {
  double mass = 20;             ///< of the carriage with all that it carries [kg]
  double lead = 0.02;           ///< travel for one turn of the screw or the belt's pulley [m]
  double screw_inertia = 3e-4;  ///< of the screw or the pulleys; turns with the motor [kg m2]
  double inclination = 0;       ///< positive motion goes up by this angle [rad]
  double start = 0.1;           ///< carriage at the start; the encoders count 0 there [m]
  double travel_min = -0.05;    ///< where the carriage touches the end stops [m]
  double travel_max = 1.05;
  EndStopData stop;
  AxisDriveData drive = {.servo = {.inertia_ratio = 0.1}};
  /// Gear, coupling and screw or belt up to the carriage: ratio, stiffness, damping and play as seen at the
  /// screw or pulley.
  TransmissionData gear = {1, 1000, 0.05, 0};
  Friction motor_friction = {0.1, 0.0005, 0, 0.01};
  Friction carriage_friction = {30, 50, 0, 0.01};
  AxisTransducersData sensors;

  // Pictures only.
  double heading = 0;  ///< direction of the axis in plan, 0 = with the line [rad]
  double place_x = 0;  ///< position 0 of the axis, lower side of its beam [m]
  double place_y = 0;
  double place_z = 0;
  std::string carrier = "none";  ///< the linear axis whose carriage carries this one, none = the floor
  std::string motor = "lower";   ///< the end where the motor is: lower, upper
  std::string tool = "none";     ///< what the carriage carries: none, guide, blade, pen
};

/// A carriage on a guided slide, driven by a motor through gear and ball screw or belt. Position 0 is
/// where the motor has its zero pulse too. The rotor turns with the screw's or pulleys' inertia (reflected by
/// the gear ratio squared); between them and the carriage is one spring with damper and play.
///
/// Events: `end_stop` (side, speed, impulse, force) when an end stop has taken the motion out of the
/// carriage; `trip` (speed) of inverter or contactors.
class LinearAxis : public Plant {
 public:
  /// `carrier`: see LinearAxisData, may be null.
  LinearAxis(const LinearAxisData& data, World& world, const LinearAxis* carrier);

  void drive(double h) override;
  void sense(double h) override;
  std::vector<Port> ports() override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;
  std::vector<Fault> faults() override;
  std::vector<EventType> event_types() override;
  std::vector<Part> parts() override;
  void poses(std::vector<PartPose>& out) override;

  [[nodiscard]] Slide& carriage() { return carriage_; }
  [[nodiscard]] Shaft& rotor() { return rotor_; }
  /// Turn of the screw or pulley ahead of the carriage [rad].
  [[nodiscard]] double twist() const { return twist_; }

 private:
  void report(const EndStop& stop, double side);
  void draw_ink();

  // Pictures: where the axis' position 0 is, the top of the carriage at `position`, the tool's tip [m].
  [[nodiscard]] std::array<double, 3> origin(double carrier_position) const;
  [[nodiscard]] std::array<double, 3> mount(double position) const;
  [[nodiscard]] std::array<double, 3> pen_tip(double carrier_position, double position) const;
  struct Item;
  [[nodiscard]] std::vector<Item> items() const;
  void add_beam(std::vector<Item>& all) const;
  void add_drive(std::vector<Item>& all) const;
  void add_carriage(std::vector<Item>& all) const;
  void add_blade(std::vector<Item>& all) const;
  void add_guide(std::vector<Item>& all) const;
  void add_pen(std::vector<Item>& all) const;
  [[nodiscard]] std::array<double, 3> point(const std::array<double, 3>& origin, double along, double up,
                                            double side) const;

  LinearAxisData data_;
  const LinearAxis* carrier_;
  double screw_per_metre_;  // turn of the screw per travel [rad/m]
  Shaft& rotor_;
  Slide& carriage_;
  AxisDrive drive_;
  double twist_ = 0;        // [rad], at the screw
  double drive_force_ = 0;  // of screw or belt on the carriage in the last step [N]
  double outer_force_ = 0;  // set by the timeline [N]
  EndStop stop_min_;
  EndStop stop_max_;
  AxisTransducers sensors_;
  CommandPort tool_;
  std::vector<std::array<double, 3>> ink_;  // drawn by the pen, a dot every so often [m]
};

class LinearAxisDefinition : public PlantDefinition {
 public:
  LinearAxisData data;
  Parameters parameters() override;
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
