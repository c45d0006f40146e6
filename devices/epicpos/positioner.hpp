#pragma once
#include <cstdint>

#include "devices/axis/analogue_positioner.hpp"
#include "devices/epicpos/table.hpp"

namespace drycut::devices::epicpos {

/// The devices EPICPOS and EANPOS (002; spec qem.md 6 and 7). They differ in the ramps alone.
///
/// With its counter on slot 1 the device is a simulated axis: it moves that counter itself, by its
/// theoretical profile, and what is below one bit is kept for the next sample (000 1.5).
class Positioner final : public axis::AnaloguePositioner<epicpos_type> {
 public:
  /// `type` is epicpos_type or eanpos_type; `resources` as the .CNF record gives them, in the order of
  /// DeviceType::fields; terminals that the cards lack are added.
  Positioner(const DeviceType& type, const Resources& resources, Cards& cards);

  void power_up() override;
  void visit(StateArchive& archive) override;

 protected:
  void initialise() override;
  void execute(int command) override;
  void step() override;
  bool may_write(Symbol symbol, std::int32_t value) override;
  void written(Symbol symbol, std::int32_t value) override;

 private:
  void recompute();
  void check_ratio();
  void move_counter(double bits);
  void publish();

  double counter_part_ = 0;  ///< of the simulated counter, not yet a whole bit
  std::int64_t in_tolerance_ms_ = 0;
};

}  // namespace drycut::devices::epicpos
