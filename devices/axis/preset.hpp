#pragma once
#include <cstdint>
#include <optional>

#include "devices/axis/analogue_axis.hpp"

namespace drycut::devices::axis {

/// Parameters of the preset search (spec 5.11; 000 1.9.2; 002 1.2.5).
struct PresetSettings {
  std::int32_t mode = 0;   ///< prsmode: 0 enable's release, 1 zero pulse after it, 2 without motion
  bool backward = false;   ///< prsdir 1
  std::int32_t quota = 0;  ///< prspos [Um]
  std::int32_t fast = 0;   ///< prsvel [speed]
  std::int32_t slow = 0;   ///< sprsvel [speed]
  bool locked = false;     ///< the count is locked: nothing loads it (CNTLOCK, 002 1.4.2)
};

/// The search of modes 0 and 1: fast toward the enable input, back slowly, load the quota when the enable is
/// released (mode 0) or at the zero pulse after it (mode 1), then place the axis there.
class PresetSearch {
 public:
  enum class Leg : std::uint8_t { none, approach, turn, leave, zero_pulse, halt, place };

  /// PRESET. With the enable already active the search begins with its slow leg (D15).
  void start(const PresetSettings& settings, bool enable, AnalogueAxis& axis);
  /// PRESET again while searching: the other way.
  void reverse(AnalogueAxis& axis);
  void abort() { leg_ = Leg::none; }
  /// One period before the axis' profile steps: `zero` is the total latched at a zero pulse since the last
  /// period. True when the quota was loaded in it.
  bool sample(const PresetSettings& settings, bool enable, std::optional<std::int64_t> zero,
              AnalogueAxis& axis);
  [[nodiscard]] bool searching() const { return leg_ != Leg::none; }
  /// The axis stands at the preset quota: read once, after the profile stepped.
  bool finished(const AnalogueAxis& axis);
  /// The speed of the running leg, which the procedure leaves in setvel [speed].
  [[nodiscard]] std::int32_t speed(const PresetSettings& settings) const {
    return leg_ == Leg::approach ? settings.fast : settings.slow;
  }
  [[nodiscard]] Leg leg() const { return leg_; }

 private:
  void load(const PresetSettings& settings, std::int64_t total, AnalogueAxis& axis);

  Leg leg_ = Leg::none;
  Leg after_turn_ = Leg::leave;
  bool backward_ = false;  ///< direction of the running or the coming leg
  bool last_enable_ = false;
};

}  // namespace drycut::devices::axis
