#pragma once
#include <numbers>
#include <string>
#include <vector>

#include "plants/axis_drive.hpp"
#include "plants/motor_load.hpp"
#include "plants/plant.hpp"
#include "plants/transmission.hpp"
#include "plants/turning_transducers.hpp"

namespace drycut::plants {

/// Parameters of `type: rotary_axis`. The defaults are an indexing table of 600 mm.
struct RotaryAxisData {
  double inertia = 0.9;        ///< of all that turns behind the gear, with what it carries [kg m2]
  double unbalance = 0;        ///< torque of its weight where that is largest [N m]
  double unbalance_angle = 0;  ///< at which its weight hangs down [rad]
  double start = 0;            ///< angle at the start; the encoder counts 0 there [rad]
  AxisDriveData drive = {.servo = {.inertia_ratio = 1.9}};
  TransmissionData gear = {10, 52e3, 13, 0};
  Friction motor_friction = {0.1, 0.0005, 0, 1};
  Friction friction = {4, 0.5, 0, 1};
  TurningTransducersData sensors = {.encoder = {.lines = 2500},
                                    .home = {0, std::numbers::pi / 18, std::numbers::pi / 360, 0.5e-3}};

  // Pictures only.
  std::string looks = "table";  ///< table: about an upright axis; roller: about one across the line
  double diameter = 0.6;        ///< [m]
  double width = 0.08;          ///< of the table's plate; of the roller across the line [m]
  double place_x = 0;           ///< its middle [m]
  double place_y = 0;
  double place_z = 0;
};

/// What a motor turns without end through a gear: a table, a roller, an indexer. Angle 0 is where the motor
/// has its zero pulse too. Events are those of its drive.
class RotaryAxis : public Plant, public TellsMotorLoad {
 public:
  RotaryAxis(const RotaryAxisData& data, World& world);

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
  Parameters live_parameters() override;
  void parameters_changed() override;

  [[nodiscard]] Shaft& rotor() { return rotor_; }
  [[nodiscard]] Shaft& table() { return table_; }

 private:
  [[nodiscard]] double weight() const;

  RotaryAxisData data_;
  World& world_;
  Shaft& rotor_;
  Shaft& table_;
  AxisDrive drive_;
  Transmission gear_;
  TurningTransducers sensors_;
  double outer_torque_ = 0;  // of the process [N m]
  double weight_ = 0;        // of the unbalance, and friction, in the step under way [N m]
  double rubbing_ = 0;
};

Parameters rotary_axis_parameters(RotaryAxisData& data);

class RotaryAxisDefinition : public PlantDefinition {
 public:
  RotaryAxisData data;
  Parameters parameters() override { return rotary_axis_parameters(data); }
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
