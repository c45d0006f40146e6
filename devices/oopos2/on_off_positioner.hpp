#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "devices/axis/position.hpp"
#include "devices/cards.hpp"
#include "devices/oopos2/movement.hpp"
#include "devices/oopos2/table.hpp"

namespace drycut::devices::oopos2 {

/// The device OOPOS2 (001; spec qem.md 9): its parameters, commands, states and terminals around a Movement.
/// What happens in which sample stands in movement.hpp.
class OnOffPositioner final : public TableDevice<oopos2_type> {
 public:
  /// `resources` as the .CNF record gives them, in the order of DeviceType::fields; terminals that the cards
  /// lack are added.
  OnOffPositioner(const Resources& resources, Cards& cards);

  [[nodiscard]] int period_ms() const override { return period_ms_; }
  void interrupt(int line, bool rising) override;
  void power_up() override;
  void visit(StateArchive& archive) override;

 protected:
  void latch() override;
  void initialise() override;
  void execute(int command) override;
  void step() override;
  bool may_write(Symbol symbol, std::int32_t value) override;
  void written(Symbol symbol, std::int32_t value) override;
  bool may_execute(int command) override;

 private:
  /// An output that the device may have and may share; nullptr where the .CNF says X.X.
  struct Output {
    DigitalOutput* terminal = nullptr;
    OutputTurn turn;
    bool level = false;

    void visit(StateArchive& archive);
  };
  static constexpr int outputs = 6;  ///< OutAva to OutFre
  /// Where the preset search is: toward the enable, out of it, to the zero pulse, at rest, to the quota.
  enum class Search : std::uint8_t { none, approach, leave, zero_pulse, halt, place };
  struct Legs {
    std::optional<Leg> overshoot;
    Leg last;
  };

  // Parameters (on_off_parameters.cpp).
  void rescale();
  void recompute();
  void check_ratio();
  void check_dependent_range(VariableRow variable);
  void retarget();
  [[nodiscard]] Parts position() const;
  [[nodiscard]] bool slows_by_speed() const;
  [[nodiscard]] Parts slow_way() const;
  [[nodiscard]] VariableRow inertia_variable(int band, bool backward) const;
  [[nodiscard]] Legs legs_to(std::int64_t tenths, bool backward, bool overshoots) const;
  [[nodiscard]] std::int64_t within_limits(std::int64_t tenths) const;
  [[nodiscard]] bool within_tolerance(std::int64_t tenths) const;

  // Commands (on_off_commands.cpp).
  void start();
  void place(std::int64_t tenths);
  void run(bool backward, bool slow);
  void leave_quota();
  [[nodiscard]] std::int64_t clamped(std::int64_t tenths, std::string_view subject, std::int32_t quota);

  // The preset search (on_off_preset.cpp).
  void preset();
  void end_search();
  void search_leg(Search search, bool backward);
  void sample_preset();
  void sample_search(bool enable, bool released, std::optional<std::int64_t> zero);
  void load(std::int64_t total);

  // The periodic step (on_off_positioner.cpp).
  void measure();
  void movement_ended();
  void recalculate_inertia(bool in_tolerance);
  void note_held_inertia(VariableRow variable, std::int64_t coasted);
  void put_out();
  void put(FieldRow field, bool level);

  const Counter* counter_ = nullptr;
  const DigitalInput* enable_ = nullptr;
  int zero_line_ = 0;
  std::array<Output, outputs> outputs_;
  const int period_ms_;

  axis::Transducer transducer_;
  axis::Quota quota_;
  axis::Resolution resolution_;
  axis::FrequencyMeter frequency_;

  Movement movement_;
  std::int64_t target_ = 0;               ///< of the running or last placement [Um/10]
  std::int32_t tool_ = 0;                 ///< in it [Um/10]
  std::int32_t wanted_ = 0;               ///< the setpos that it goes to [Um]
  std::array<bool, 16> inertia_noted_{};  ///< iner01 to iner16: said already that it is held

  Search search_ = Search::none;
  bool search_backward_ = false;  ///< direction of the running leg
  bool search_slow_ = false;      ///< always slow, prsdir 2 and 3
  bool search_zero_ = false;      ///< prsmode 1: a zero pulse loads
  bool enable_was_ = false;
  bool enable_released_ = false;      ///< seen since INIT: a preset without search needs it
  std::optional<std::int64_t> zero_;  ///< total at a zero pulse since the last sample
};

}  // namespace drycut::devices::oopos2
