#pragma once
#include <array>
#include <string>
#include <vector>

#include "plants/axis_drive.hpp"
#include "plants/motor_load.hpp"
#include "plants/plant.hpp"
#include "plants/screw_drive.hpp"

namespace drycut::plants {

/// Parameters of `type: linear_axis`. The defaults are a ball screw unit of 1 m.
struct LinearAxisData : ScrewDriveData {
  LinearAxisData()
      : ScrewDriveData{.mass = 20,
                       .lead = 0.02,
                       .screw_inertia = 3e-4,
                       .start = 0.1,
                       .travel_min = -0.05,
                       .travel_max = 1.05,
                       .gear = {1, 1000, 0.05, 0},
                       .motor_friction = {0.1, 0.0005, 0, 0.01},
                       .guide_friction = {30, 50, 0, 0.01}} {}

  double inclination = 0;  ///< positive motion goes up by this angle [rad]
  AxisDriveData drive = {.servo = {.inertia_ratio = 0.1}};

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
/// where the motor has its zero pulse too.
///
/// Events: `end_stop` (side, speed, impulse, force) when an end stop has taken the motion out of the
/// carriage; `trip` (speed) of inverter or contactors.
class LinearAxis : public Plant, public TellsMotorLoad {
 public:
  /// `carrier`: see LinearAxisData, may be null; `lender`: whose drive it shares, null for its own.
  LinearAxis(const LinearAxisData& data, World& world, const LinearAxis* carrier,
             LinearAxis* lender = nullptr);

  void drive(double h) override;
  void sense(double h) override;
  void visit(StateArchive& archive) override;
  std::vector<Port> ports() override;
  [[nodiscard]] std::optional<PlugScale> scale_of(std::string_view port) const override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;
  std::vector<Fault> faults() override;
  std::vector<EventType> event_types() override;
  std::vector<DriveOfPlant> drives() override;
  [[nodiscard]] MotorLoad motor_load(double h) const override;
  std::vector<Part> parts() override;
  void callouts(std::vector<Callout>& out) override;
  Parameters live_parameters() override;
  void parameters_changed() override;

  [[nodiscard]] const AxisDriveData& drive_data() const { return data_.drive; }
  [[nodiscard]] Slide& carriage() const { return screw_.slide; }
  [[nodiscard]] Shaft& rotor() const { return screw_.rotor; }
  /// Turn of the screw or pulley ahead of the carriage [rad].
  [[nodiscard]] double twist() const { return screw_.twist(); }

 protected:
  LinearAxisData data_;

 private:
  struct Picture;
  void draw_ink();
  // Where the carrier's carriage is, the axis' position 0 and the tip of the pen for such positions [m].
  [[nodiscard]] double carrier_position() const { return carrier_ ? carrier_->carriage().position : 0; }
  [[nodiscard]] Pose base(double carrier_position) const;
  [[nodiscard]] Pose pen_tip(double carrier_position, double position) const;

  World& world_;
  const LinearAxis* carrier_;
  ScrewDrive screw_;
  AxisDrive drive_;
  double outer_force_ = 0;  // set by the timeline [N]
  CommandPort tool_;
  std::vector<std::array<double, 3>> ink_;  // on the sheet, a dot every so often [m]
};

/// Where the defaults of a machine that is a linear axis are from.
struct LinearAxisSources {
  std::string_view mass = "a medium carriage";
  std::string_view stop_damping = "estimate: 16 % of critical for 20 kg";
  std::string_view coulomb = "estimate: four sealed guide carriages";  ///< of the guides
  std::string_view breakaway = "none: set it to study stick-slip";
  std::string_view inertia_ratio = "the default screw and carriage on the motor";
};
Parameters linear_axis_parameters(LinearAxisData& data, const LinearAxisSources& from = {});

class LinearAxisDefinition : public PlantDefinition {
 public:
  LinearAxisData data;
  Parameters parameters() override;
  std::vector<Objection> objections(double h) override;
  std::vector<Objection> objections_with(const FindDefinition& find, double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;

 private:
  [[nodiscard]] std::vector<Objection> of_all(double h) const;
};

}  // namespace drycut::plants
