#pragma once
#include <vector>

#include "plants/axis_drive.hpp"
#include "plants/axis_transducers.hpp"
#include "plants/end_stop.hpp"
#include "plants/friction.hpp"
#include "plants/plant.hpp"
#include "plants/transmission.hpp"

namespace drycut::plants {

/// Parameters of `type: vertical_press`: a screw press of 600 mm stroke. Position is the height of the ram's
/// tool over the table; positive motion goes up.
struct VerticalPressData {
  VerticalPressData();

  double mass = 600;             ///< of the ram with its tool [kg]
  double load = 0;               ///< what the ram carries besides, at the start [kg]
  double counterbalance = 2000;  ///< constant force upwards: cylinder or gas spring [N]
  double lead = 0.01;            ///< travel for one turn of the screw, or of a rack's pinion [m]
  double screw_inertia = 1e-3;   ///< of screw or pinion; turns with the motor [kg m2]
  double efficiency = 0.9;       ///< of screw or rack while the motor drives the ram
  double back_efficiency = 0.8;  ///< while the ram drives the motor, 0 or less: self-locking
  double start = 0.3;            ///< height at the start; the encoders count 0 there [m]
  double travel_min = -0.01;     ///< where the ram touches the end stops [m]
  double travel_max = 0.61;
  EndStopData stop = {2e7, 1.5e5};
  double workpiece_height = 0.05;  ///< height at which the tool meets the workpiece [m]
  EndStopData workpiece = {0, 0};  ///< stiffness 0 = no workpiece
  TransmissionData gear;           ///< between motor and screw, with the screw's own stiffness; at the screw
  AxisDriveData drive;
  Friction motor_friction = {0.2, 0.001, 0, 0.01};
  Friction ram_friction = {150, 300, 0, 0.01};
  AxisTransducersData sensors;

  double place_x = 0;  ///< picture: the middle of the table's top [m]
  double place_y = 0;
  double place_z = 0;
};

/// A press: a ram on guide columns, hung on a screw, under its true weight. The rotor turns with the screw's
/// inertia (reflected by the gear ratio squared); between them and the ram is one spring with damper and
/// play. Losses of the screw are dry friction on the motor's shaft in proportion to the screw's force,
/// different for driving and for being driven. How far the ram coasts follows from all that and is a number
/// nowhere.
///
/// Events: `end_stop` and `pressed` (speed, impulse, force) when end stop or workpiece has stopped the ram,
/// `sag` (speed, position) when the ram goes down though brake and drive are to hold it, `trip` of the drive.
class VerticalPress : public Plant {
 public:
  VerticalPress(const VerticalPressData& data, World& world);

  void drive(double h) override;
  void sense(double h) override;
  std::vector<Port> ports() override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;
  std::vector<Fault> faults() override;
  std::vector<EventType> event_types() override;
  std::vector<Part> parts() override;
  void poses(std::vector<PartPose>& out) override;

  [[nodiscard]] Slide& ram() { return ram_; }
  [[nodiscard]] Shaft& rotor() { return rotor_; }

 private:
  [[nodiscard]] DryResistance losses(double torque) const;
  void report_contacts();
  void watch_for_sag(double h);
  struct Item;
  [[nodiscard]] std::vector<Item> items() const;
  void add_frame(std::vector<Item>& all) const;
  void add_drive(std::vector<Item>& all) const;
  void add_counterbalance(std::vector<Item>& all) const;
  void add_stops_and_switches(std::vector<Item>& all) const;
  void add_load(std::vector<Item>& all) const;

  VerticalPressData data_;
  World& world_;
  double screw_per_metre_;  // turn of the screw per travel [rad/m]
  Shaft& rotor_;
  Slide& ram_;
  AxisDrive drive_;
  double twist_;            // of the screw ahead of the ram [rad]
  double screw_force_ = 0;  // on the ram in the last step, positive upwards [N]
  double outer_force_ = 0;  // set by the timeline [N]
  EndStop stop_min_;
  EndStop stop_max_;
  EndStop workpiece_;
  AxisTransducers sensors_;
  double resting_ = 0;  // how long brake and drive have been told to hold [s]
  bool sagged_ = false;
};

class VerticalPressDefinition : public PlantDefinition {
 public:
  VerticalPressData data;
  Parameters parameters() override;
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
