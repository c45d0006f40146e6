#pragma once
#include <array>

#include "plants/exact_sum.hpp"
#include "plants/plant.hpp"
#include "plants/transducers.hpp"

namespace drycut::plants {

/// Parameters of `type: ideal_axis`.
struct IdealAxisData {
  double speed_at_10v = 1;    ///< [m/s]
  double resolution = 1e-5;   ///< travel per count x4 [m]
  double index_pitch = 0.04;  ///< travel between two index pulses [m]
  double start = 0;           ///< position at the start; the count is 0 there [m]
  bool reverse = false;       ///< counts down in positive direction
  std::array<PositionSwitchData, 2> switches = {{{0, 0.01, 0, 0}, {1, 0.01, 0, 0}}};  ///< [m]
};

/// An axis without mass: speed is voltage, exactly, and its encoder never drifts. For controller work.
class IdealAxis : public Plant {
 public:
  IdealAxis(const IdealAxisData& data, World& world);

  void drive(double h) override { (void)h; }
  void sense(double h) override;
  void visit(StateArchive& archive) override;
  std::vector<Port> ports() override;
  [[nodiscard]] std::optional<PlugScale> scale_of(std::string_view port) const override;
  std::vector<Channel> channels() override;
  std::vector<Fault> faults() override;

 private:
  const IdealAxisData data_;
  ReferencePort reference_;
  double speed_ = 0;  // [m/s]
  ExactSum travel_;   // since the start [bits x4]
  PulseLine pulses_;
  SignalPort index_;
  std::array<PositionSwitch, 2> switches_;
};

class IdealAxisDefinition : public PlantDefinition {
 public:
  IdealAxisData data;
  Parameters parameters() override;
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
