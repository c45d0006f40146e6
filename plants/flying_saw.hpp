#pragma once
#include <string>
#include <vector>

#include "plants/axis_transducers.hpp"
#include "plants/end_stop.hpp"
#include "plants/flying_saw_blade.hpp"
#include "plants/flying_saw_clamp.hpp"
#include "plants/flying_saw_head.hpp"
#include "plants/friction.hpp"
#include "plants/plant.hpp"
#include "plants/servo_axis.hpp"
#include "plants/transmission.hpp"
#include "plants/web.hpp"

namespace drycut::plants {

/// Parameters of `type: flying_saw`. The defaults are a light saw on a rack.
struct FlyingSawData {
  std::string web = "web";       ///< the web, strip or tube, that it cuts, by name
  double mass = 60;              ///< of the carriage with clamps and saw head [kg]
  double lead = 0.2;             ///< travel for one turn of the pinion or the screw [m]
  double pinion_inertia = 1e-3;  ///< of the pinion or the screw [kg m2]; turns with the motor
  double start = 0;              ///< place of the blade on the line at the start [m]
  double travel_min = -0.04;     ///< where the carriage touches the end stops [m]
  double travel_max = 0.76;
  EndStopData stop;
  ServoAxisData drive = {.servo = {.speed_at_10v = 100 * std::numbers::pi, .inertia_ratio = 0.85}};
  /// Gear and pinion, or screw, up to the carriage: seen at the pinion or screw.
  TransmissionData gear = {4, 5000, 2, 0};
  Friction motor_friction = {0.1, 0.0005, 0, 0.01};
  Friction carriage_friction = {40, 60, 0, 0.01};
  AxisTransducersData sensors = {.limit_min = -0.03, .limit_max = 0.75};
  ClampData clamp;
  SawHeadData head;
  SawBladeData blade;
  bool stroke_check = true;  ///< refuse a line speed whose cut cannot fit the travel
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
/// Events: `cut` (length, slant, mismatch, pinch, force, time, number) when the blade is through; `pinch`
/// (force, displacement) when the sideways force exceeds its limit, once per engagement; `crash` (side,
/// speed, impulse, force) when the carriage has been in an end stop; `following_error` of a servo that takes
/// pulses.
class FlyingSaw : public Plant {
 public:
  FlyingSaw(const FlyingSawData& data, World& world, Web& web);

  void drive(double h) override;
  void sense(double h) override;
  std::vector<Port> ports() override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;
  std::vector<Fault> faults() override;
  std::vector<EventType> event_types() override;
  std::vector<Part> parts() override;
  void poses(std::vector<PartPose>& out) override;
  void callouts(std::vector<Callout>& out) override;

  [[nodiscard]] Slide& carriage() { return carriage_; }
  [[nodiscard]] Shaft& rotor() { return rotor_; }
  [[nodiscard]] SawHead& head() { return head_; }
  [[nodiscard]] const Clamp& clamp() const { return clamp_; }
  /// Turn of the pinion or screw ahead of the carriage [rad].
  [[nodiscard]] double twist() const { return twist_; }

 private:
  /// An end stop with what it has taken since the carriage touched it.
  struct Buffer {
    EndStop stop;
    double position;
    double side;
    double impulse = 0;  // [N s]
    double time = 0;     // [s]
    bool touched = false;
    bool reported = false;
  };
  void push_back(Buffer& buffer, double h);
  void watch(Buffer& buffer);
  void report(const SawCut::Outcome& outcome);

  // Pictures.
  struct Item;
  [[nodiscard]] std::vector<Item> items() const;
  void add_bed(std::vector<Item>& all) const;
  void add_drive(std::vector<Item>& all) const;
  void add_carriage(std::vector<Item>& all) const;
  void add_head(std::vector<Item>& all) const;

  FlyingSawData data_;
  Web& web_;
  double pinion_per_metre_;  // turn of pinion or screw per travel [rad/m]
  Shaft& rotor_;
  Slide& carriage_;
  ServoAxis servo_;
  double twist_ = 0;        // [rad], at the pinion
  double drive_force_ = 0;  // of rack or screw on the carriage in the last step [N]
  double outer_force_ = 0;  // set by the timeline [N]
  Buffer lower_;
  Buffer upper_;
  AxisTransducers sensors_;
  Clamp clamp_;
  SawHead head_;
  SawCut cut_;
  int cuts_ = 0;
  double last_length_ = 0;  // [m]
  double last_slant_ = 0;   // [m]
  double last_pinch_ = 0;   // [N]
  double blade_turn_ = 0;   // pictures: of the spinning blade [rad]
};

class FlyingSawDefinition : public PlantDefinition {
 public:
  FlyingSawData data;
  Parameters parameters() override;
  std::vector<Objection> objections(double h) override;
  std::vector<Objection> objections_with(const FindDefinition& find, double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
