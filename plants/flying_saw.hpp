#pragma once
#include <array>
#include <string>
#include <vector>

#include "plants/flying_saw_blade.hpp"
#include "plants/flying_saw_clamp.hpp"
#include "plants/flying_saw_head.hpp"
#include "plants/motor_load.hpp"
#include "plants/plant.hpp"
#include "plants/screw_drive.hpp"
#include "plants/servo_axis.hpp"
#include "plants/station.hpp"
#include "plants/web.hpp"

namespace drycut::plants {

/// Parameters of `type: flying_saw`. The defaults are a light saw on a rack.
struct FlyingSawData : ScrewDriveData {
  FlyingSawData()
      : ScrewDriveData{.mass = 60,
                       .lead = 0.2,
                       .screw_inertia = 1e-3,
                       .travel_min = -0.04,
                       .travel_max = 0.76,
                       .gear = {4, 5000, 2, 0},
                       .motor_friction = {0.1, 0.0005, 0, 0.01},
                       .guide_friction = {40, 60, 0, 0.01},
                       .sensors = {.limit_min = -0.03, .limit_max = 0.75}} {}

  std::string web = "web";  ///< the web, strip or tube, that it cuts, by name
  StationData station;
  ServoAxisData drive = {.servo = {.speed_at_10v = 100 * std::numbers::pi, .inertia_ratio = 0.85}};
  ClampData clamp;
  SawHeadData head;
  SawBladeData blade;
  double mismatch_limit = 0.05;  ///< difference of speed at which clamps and blade may take hold [m/s]
  bool stroke_check = true;      ///< refuse a line speed whose cut cannot fit the travel
};

/// What the cut asks of the travel at a line speed: from rest to the speed at the drive's peak torque, clamp,
/// plunge, through, blade up, unclamp, to rest. No program can do with less.
struct LeastStroke {
  double cycle = 0;   ///< clamp closing to clamp open [s]
  double stroke = 0;  ///< [m]
};
[[nodiscard]] LeastStroke least_stroke(const FlyingSawData& saw, const Section& section, double line_speed);

/// A saw that runs with the material while it cuts: carriage on rails, driven by a servo through rack and
/// pinion or screw; clamps that take the running material along by friction; a pneumatic saw head. Positions
/// are the place of the blade on the line.
///
/// A cut separates the material where the blade stood on it at the touch; length is the distance on the
/// material between two such places (the kerf is not taken off), of the first from the lead end.
///
/// Events: `cut` (length, slant, mismatch, slip, pinch, force, time, number) when the blade is through;
/// `clamped_moving` (difference, blade) when clamps, or the blade, take hold of material that runs at another
/// speed by more than mismatch_limit; `unclamped` when the blade comes into material that nothing clamps;
/// `opened_early` (depth) when the clamps let go with the blade in the material; `pinch` (force,
/// displacement) when the sideways force exceeds its limit, once per engagement; `crash` (side, speed,
/// impulse, force) when the carriage has been in an end stop; `following_error` of a servo that takes pulses.
class FlyingSaw : public Plant, public TellsMotorLoad {
 public:
  FlyingSaw(const FlyingSawData& data, World& world, Web& web);

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

  [[nodiscard]] Slide& carriage() const { return screw_.slide; }
  [[nodiscard]] Shaft& rotor() const { return screw_.rotor; }
  [[nodiscard]] SawHead& head() { return head_; }
  [[nodiscard]] const Clamp& clamp() const { return clamp_; }
  /// Turn of the pinion or screw ahead of the carriage [rad].
  [[nodiscard]] double twist() const { return screw_.twist(); }

 private:
  /// What an end stop has taken since the carriage touched it.
  struct Crash {
    double impulse = 0;  // [N s]
    double time = 0;     // [s]
    bool touched = false;
    bool reported = false;
    void visit(StateArchive& archive);
  };
  /// What clamps and blade have done with the material since one of them took hold of it.
  struct Hold {
    bool on = false;
    double mismatch = 0;  // largest difference of speed [m/s]
    double slip = 0;      // largest of the clamps [m]
    void visit(StateArchive& archive);
  };
  void watch(const EndStop& stop, Crash& crash);
  void hold(const Slide& material, bool was_engaged);
  void took_hold(double difference, bool blade);
  Slide& material();  // under the blade now
  void report(const SawCut::Outcome& outcome);
  struct Picture;
  [[nodiscard]] double blade_axis() const;  // height over the line [m]

  FlyingSawData data_;
  World& world_;
  Web& web_;
  Station station_;
  ScrewDrive screw_;
  ServoAxis servo_;
  double outer_force_ = 0;        // set by the timeline [N]
  std::array<Crash, 2> crashes_;  // at screw_.stops
  Clamp clamp_;
  SawHead head_;
  SawCut cut_;
  Hold hold_;
  int cuts_ = 0;
  double last_slant_ = 0;  // [m]
  double last_pinch_ = 0;  // [N]
};

Parameters flying_saw_parameters(FlyingSawData& data);

class FlyingSawDefinition : public PlantDefinition {
 public:
  FlyingSawData data;
  Parameters parameters() override { return flying_saw_parameters(data); }
  std::vector<Objection> objections(double h) override;
  std::vector<Objection> objections_with(const FindDefinition& find, double h) override;
  [[nodiscard]] std::optional<Stretch> stretch() const override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
