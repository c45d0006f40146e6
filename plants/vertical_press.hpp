#pragma once
#include <vector>

#include "plants/axis_drive.hpp"
#include "plants/motor_load.hpp"
#include "plants/plant.hpp"
#include "plants/screw_drive.hpp"

namespace drycut::plants {

/// Parameters of `type: vertical_press`: a screw press of 600 mm stroke. Position is the height of the ram's
/// tool over the table; positive motion goes up.
struct VerticalPressData : ScrewDriveData {
  VerticalPressData()
      : ScrewDriveData{.mass = 600,
                       .lead = 0.01,
                       .screw_inertia = 1e-3,
                       .start = 0.3,
                       .travel_min = -0.01,
                       .travel_max = 0.61,
                       .stop = {2e7, 1.5e5},
                       .gear = {1, 250, 0.1, 0},
                       .moved_by = "ball_screw",
                       .efficiency = {0.9, 0.8},
                       .motor_friction = {0.2, 0.001, 0, 0.01},
                       .guide_friction = {150, 300, 0, 0.01},
                       .sensors = {.scale_resolution = 5e-6,
                                   .home = {0.5, 0.04, 0.5e-3, 0.5e-3},
                                   .limit_min = 0,
                                   .limit_max = 0.6}} {}

  double load = 0;                 ///< what the ram carries besides [kg]
  double counterbalance = 2000;    ///< constant force upwards: cylinder or gas spring [N]
  double workpiece_height = 0.05;  ///< height at which the tool meets the workpiece [m]
  EndStopData workpiece = {0, 0};  ///< stiffness 0 = no workpiece
  AxisDriveData drive = {.kind = "inverter", .brake = {.torque = 25}};

  double place_x = 0;  ///< picture: the middle of the table's top [m]
  double place_y = 0;
  double place_z = 0;
};

/// A press: a ram on guide columns, hung on a screw, under its true weight. Losses of the screw are dry
/// friction on the motor's shaft in proportion to the screw's force, different for driving and for being
/// driven. How far the ram coasts follows from all that and is a number nowhere.
///
/// Events: `end_stop` and `pressed` (speed, impulse, force) when end stop or workpiece has stopped the ram,
/// `sag` (speed, position) when the ram goes down though brake and drive are to hold it, `trip` of the drive.
class VerticalPress : public Plant, public TellsMotorLoad {
 public:
  VerticalPress(const VerticalPressData& data, World& world);

  void drive(double h) override;
  void sense(double h) override;
  void visit(StateArchive& archive) override;
  std::vector<Port> ports() override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;
  std::vector<Fault> faults() override;
  std::vector<EventType> event_types() override;
  std::vector<DriveOfPlant> drives() override;
  [[nodiscard]] MotorLoad motor_load(double h) const override;
  std::vector<Part> parts() override;
  [[nodiscard]] std::optional<QuotaLine> quota_line(double quota) const override;
  Parameters live_parameters() override;
  void parameters_changed() override;

  [[nodiscard]] Slide& ram() const { return screw_.slide; }
  [[nodiscard]] Shaft& rotor() const { return screw_.rotor; }

 private:
  void report_contacts();
  void watch_for_sag(double h);
  struct Picture;

  VerticalPressData data_;
  World& world_;
  ScrewDrive screw_;
  AxisDrive drive_;
  double outer_force_ = 0;  // set by the timeline [N]
  EndStop workpiece_;
  double resting_ = 0;  // how long brake and drive have been told to hold [s]
  bool sagged_ = false;
};

Parameters vertical_press_parameters(VerticalPressData& data);

class VerticalPressDefinition : public PlantDefinition {
 public:
  VerticalPressData data;
  Parameters parameters() override { return vertical_press_parameters(data); }
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
