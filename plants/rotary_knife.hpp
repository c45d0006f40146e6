#pragma once
#include <string>

#include "plants/counter_drum.hpp"
#include "plants/cutting.hpp"
#include "plants/motor_load.hpp"
#include "plants/plant.hpp"
#include "plants/servo_axis.hpp"
#include "plants/station.hpp"
#include "plants/transmission.hpp"
#include "plants/turning_transducers.hpp"
#include "plants/web.hpp"

namespace drycut::plants {

/// Parameters of `type: rotary_knife`.
struct RotaryKnifeData {
  std::string web = "web";  ///< the web that it cuts, by name
  StationData station;
  double circumference = 0.6;               ///< of the circle of the blade tips [m]
  int blade_count = 1;                      ///< evenly on the drum
  double blade_width = 0.4;                 ///< of the drum and its blades, across the line [m]
  double helix = 0;                         ///< of the blades against the drum's axis [rad], 0 = straight
  double drum_inertia = 0.41;               ///< with blades [kg m2]
  double drum_eccentricity = 0;             ///< of the blades' circle from the drum's axis [m]
  double initial_angle = std::numbers::pi;  ///< of blade 1 from bottom dead centre [rad]
  double coupling = 2000;       ///< horizontal force between blade and web per speed mismatch [N s/m]
  double grip = 500;            ///< largest horizontal force [N]
  double mismatch_limit = 0.1;  ///< speed mismatch at which the web tears or buckles [m/s]
  CounterDrumData counter;
  int motors = 1;  ///< alike, each on a gear of its own, which share the torque
  ServoAxisData drive;
  TransmissionData gear;
  Friction motor_friction = {0.1, 0.0005, 0, 1};
  Friction drum_friction = {2, 0.1, 0, 1};
  TurningTransducersData sensors = {
      .home = {std::numbers::pi, std::numbers::pi / 18, std::numbers::pi / 360, 0.5e-3}};

  /// All that turns with the drum, on its shaft [kg m2].
  [[nodiscard]] double geared() const { return geared_inertia(drum_inertia, counter); }
};

/// A drum with blades that cuts the web against an anvil or a counter drum while it runs: servo motor, gear,
/// drum. Drum angle 0 has blade 1, a helical one with its middle, at bottom dead centre; positive turns move
/// the blade with the web. The drum of helical blades stands at their angle to the web: plants/cutting.hpp.
///
/// Of two motors only one is a body: the other does the same. Its channels, events and verdict are those of
/// each.
///
/// Events: `cut` (length, mismatch, force, number) when a blade reaches bottom dead centre, a helical one
/// with its last point (and then `skew`; the length is that in the middle of the web); `tear` and `buckle`
/// (mismatch) when blade and web differ by more than mismatch_limit while the blade is in the web, once per
/// engagement; `following_error` of a servo that takes pulses. The first cut, number 1, is as long as the web
/// beyond the cut at the start plus its travel.
class RotaryKnife : public Plant, public TellsMotorLoad {
 public:
  RotaryKnife(const RotaryKnifeData& data, World& world, Web& web);

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
  std::vector<Recurrence> recurrences() override;
  std::vector<Part> parts() override;
  void callouts(std::vector<Callout>& out) override;
  Parameters live_parameters() override;
  void parameters_changed() override;

  [[nodiscard]] Shaft& rotor() { return rotor_; }
  [[nodiscard]] Shaft& drum() { return drum_; }
  [[nodiscard]] const Transmission& gear() const { return gear_; }
  [[nodiscard]] double radius() const { return radius_; }  ///< of the blade tips [m]

 private:
  [[nodiscard]] double implicit_coupling(const Slide& material, double h) const;
  void report(const Cutter::Outcome& outcome);

  struct Picture;

  RotaryKnifeData data_;
  World& world_;
  const double radius_;
  const double along_web_;  // radius in speeds along the web [m]
  Friction friction_;       // of the drum and what is geared to it
  Station station_;
  Shaft& rotor_;
  Shaft& drum_;
  ServoAxis servo_;
  Transmission gear_;
  TurningTransducers sensors_;
  Cutter cutter_;
  int cuts_ = 0;
  double last_mismatch_ = 0;  // [m/s]
  double last_skew_ = 0;      // [m]
};

Parameters rotary_knife_parameters(RotaryKnifeData& data);

class RotaryKnifeDefinition : public PlantDefinition {
 public:
  RotaryKnifeData data;
  Parameters parameters() override { return rotary_knife_parameters(data); }
  std::vector<Objection> objections(double h) override;
  std::vector<Objection> objections_with(const FindDefinition& find, double h) override;
  [[nodiscard]] std::optional<Stretch> stretch() const override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
