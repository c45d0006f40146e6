#pragma once
#include <memory>

#include "plants/linear_axis.hpp"

namespace drycut::plants {

/// Where a nut with play meets its carriage: two flanks that only push. All seen along the axis.
struct FlankData {
  double gap = 1e-3;         ///< whole free travel between the flanks [m], > 0
  double stiffness = 1e8;    ///< of nut, screw and bearings behind a flank [N/m]
  double restitution = 0.5;  ///< speed of parting over speed of meeting of both bodies left alone, 0.3 .. 1
};

/// Coefficient of restitution of transmission_torque() with play for a damping ratio 0 <= `zeta` < 1 (damper
/// over twice the root of stiffness times reduced inertia). It does not depend on the speed of the impact.
[[nodiscard]] double restitution_of(double zeta);
/// The damping ratio for a coefficient of restitution 0.3 .. 1: the inverse of restitution_of().
[[nodiscard]] double damping_ratio_for(double restitution);

/// Gives the axis the gear that its flanks make.
void apply_flanks(const FlankData& flanks, LinearAxisData& axis);
Parameters backlash_axis_parameters(FlankData& flanks, LinearAxisData& axis);

/// A linear axis whose flanks may wear while it runs.
class BacklashAxis : public LinearAxis {
 public:
  BacklashAxis(const FlankData& flanks, const LinearAxisData& data, World& world)
      : LinearAxis(data, world, nullptr), flanks_(flanks) {}
  Parameters live_parameters() override { return live_rows(backlash_axis_parameters(flanks_, data_)); }
  void parameters_changed() override;

 private:
  FlankData flanks_;
};

/// The parameters of `type: backlash_axis`: a linear axis whose play is stated in millimetres at the carriage
/// and whose impact is stated by its restitution. It builds a BacklashAxis: the motor body with the reflected
/// screw, the load body on its slide, the gap between them. The encoder is on the motor, the scale on the
/// load: the wiring says which one the controller counts.
class BacklashAxisDefinition : public PlantDefinition {
 public:
  BacklashAxisDefinition();

  FlankData flanks;
  LinearAxisDefinition axis;  ///< its gear stiffness, damping and backlash follow from `flanks` in build()
  Parameters parameters() override { return backlash_axis_parameters(flanks, axis.data); }
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
