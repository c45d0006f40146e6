#pragma once
#include <cstdint>
#include <optional>

#include "devices/axis/analogue_axis.hpp"
#include "devices/axis/preset.hpp"
#include "devices/epicpos/table.hpp"

namespace drycut::devices::epicpos {

/// The devices EPICPOS and EANPOS: an analogue axis with their parameters, commands and states (002;
/// spec qem.md 6 and 7). They differ in the ramps alone.
///
/// With its counter on slot 1 the device is a simulated axis: it moves that counter itself, by its
/// theoretical profile, and what is below one bit is kept for the next sample (000 1.5).
class Positioner final : public TableDevice<epicpos_type> {
 public:
  /// `type` is epicpos_type or eanpos_type; `resources` as the .CNF record gives them, in the order of
  /// DeviceType::fields; terminals that the cards lack are added.
  Positioner(const DeviceType& type, const Resources& resources, Cards& cards);

  [[nodiscard]] int period_ms() const override { return period_ms_; }
  void interrupt(int line, bool rising) override;
  void power_up() override;

 protected:
  void latch() override;
  void initialise() override;
  void execute(int command) override;
  void step() override;
  bool may_write(Symbol symbol, std::int32_t value) override;
  void written(Symbol symbol, std::int32_t value) override;
  bool may_execute(int command) override;

 private:
  /// The terminals of the record; nullptr or line 0 where the .CNF says X.X or X.
  struct Terminals {
    const Counter* counter = nullptr;
    Counter* simulated = nullptr;  ///< the same counter, if it is on slot 1
    const DigitalInput* enable = nullptr;
    AnalogueOutput* dac = nullptr;
    int zero_line = 0;
  };

  // Parameters (positioner_parameters.cpp).
  void rescale();
  void check_ratio();
  void recompute();
  void write_motion(VariableRow variable, bool ramps_changed);
  void check_dependent_range(VariableRow variable);

  // Commands (positioner_commands.cpp).
  void depart();
  void start_placement();
  void start_manual(bool backward);
  void preset();
  void rest();
  [[nodiscard]] std::int32_t clamped(std::int32_t quota) const;

  // The periodic step (positioner.cpp).
  void sample_preset();
  void step_motion();
  void move_counter(double bits);
  void regulate();
  void publish_values();
  void publish_states();

  Terminals terminals_;
  int period_ms_;

  axis::AnalogueAxis axis_;
  axis::DacTurn dac_turn_;
  double counter_part_ = 0;  ///< of the simulated counter, not yet a whole bit
  std::int64_t in_tolerance_ms_ = 0;

  axis::PresetSearch search_;
  axis::PresetSettings search_settings_;  ///< of the running search
  bool enable_released_ = false;          ///< seen since INIT: a preset without search needs it
  std::optional<std::int64_t> zero_;      ///< total at a zero pulse since the last sample
};

}  // namespace drycut::devices::epicpos
