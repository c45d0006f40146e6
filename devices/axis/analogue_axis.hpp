#pragma once
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "devices/axis/position.hpp"
#include "devices/axis/profile.hpp"
#include "devices/axis/regulator.hpp"

namespace drycut::devices::axis {

/// What the parameters of an analogue positioner mean in bits x4 and seconds; computed when one changes.
struct AxisSettings {
  Resolution resolution;
  double bits_per_speed = 0;  ///< bits x4/s of one unit of a speed parameter
  double max_speed = 0;       ///< maxvel [bits x4/s]
  Demand ramps;               ///< everything of a demand but its speed
  bool finish_ramp = false;   ///< stopt 0
  Gains gains;
  std::int32_t offset = 0;  ///< [DAC bits]
  int period_ms = 1;
  int reversal_pause_ms = 0;             ///< between a movement's end and one the other way (tinvt)
  std::int32_t max_following_error = 0;  ///< [bits x4]
  int frequency_window_ms = 240;
  double term_limit = dac_full_scale;  ///< of the integral and derivative actions [DAC bits]
  bool simulated = false;              ///< nothing but the profile moves the axis (000 1.5)

  /// What programs can write; the rest is the record's.
  void visit(StateArchive& archive);
};

/// Seconds for each bit x4/s of a ramp that takes `hundredths` of a second from rest to `max_speed`.
inline double seconds_per_speed(std::int32_t hundredths, double max_speed) {
  return hundredths > 0 && max_speed > 0 ? hundredths / 100.0 / max_speed : 0;
}

/// What drives the DAC.
enum class Drive : std::uint8_t {
  reaction,     ///< the loop closed: PID and feed-forward
  open_loop,    ///< feed-forward only (LOOPOFF)
  calibration,  ///< a constant voltage (CALON)
  emergency,    ///< 0 V, the theoretical position follows the axis (EMRG)
  frozen,       ///< the DAC keeps its word, the theoretical position follows the axis (REGOFF)
};

/// An analogue positioner: counting, positioning profile, regulation (spec 5). CAMMING4, EPICPOS and EANPOS
/// put their parameters, commands and states around it. A plain value.
class AnalogueAxis {
 public:
  AxisSettings settings;
  Quota quota;  ///< posit; after changing it call requota()

  // Counting.
  void rebase(std::int64_t raw) { transducer_.rebase(raw); }
  void follow(std::int64_t raw, bool locked, bool reversed);
  [[nodiscard]] const Transducer& transducer() const { return transducer_; }
  [[nodiscard]] std::int32_t posit() const {
    return static_cast<std::int32_t>(quota.um(settings.resolution));
  }
  [[nodiscard]] std::int64_t counted() const { return counted_; }

  // Motion. Speeds in units of the speed parameters.
  /// Before something starts to move the axis. With the loop open it may have been moved by hand, and starts
  /// where it stands (000 1.1.6.3, 1.1.11).
  void settle_if_open();
  /// Starts a placement at the quota `target` [Um].
  void place(std::int32_t target, std::int32_t speed);
  /// Runs in a direction until stopped, at most to the quota `limit` [Um] if there is one.
  void run(bool backward, std::optional<std::int32_t> limit, std::int32_t speed);
  void stop();
  /// Stops with this ramp from a speed that the profile did not give [bits x4/s].
  void brake(double bits_per_second, const Demand& ramp);
  /// Ends a movement here and now, and forgets what it was to reach. What was reached before stays.
  void abort();
  /// Parameters were written while moving: what differs in the demand they make, `before` and `after`, acts
  /// beside the rest of what the movement goes by. False if it cannot: then it waits for the next movement.
  bool change(const Demand& before, const Demand& after);
  /// setpos was written while moving: false if the target stays the old one.
  bool retarget(std::int32_t target);
  /// posit changed under a movement: the target quota stays; a target that cannot be reached any more ends
  /// in a stop, and false is returned.
  bool requota();
  /// Theoretical := actual, integral 0: the following error is gone (LOOPON, RESUME). A movement goes on to
  /// its quota; false if the axis has passed that: then it stops.
  bool settle();
  /// The same for a theoretical position that comes from elsewhere and keeps its fraction of a bit: moves it
  /// by the whole bits nearest to the error, and gives them [bits x4].
  std::int64_t settle_by_bits();
  /// Advances the profile by a period.
  void step_profile();
  /// A theoretical position and speed from elsewhere: the cam [bits x4], [bits x4/s].
  void set_theoretical(const Theoretical& theoretical, double speed) {
    theoretical_ = theoretical;
    speed_ = speed;
  }

  // Regulation.
  /// One period: actions and DAC word. `tenths` [0.1 V] is for calibration.
  void regulate(Drive drive, std::int32_t tenths);
  /// 0 V ahead of the next period.
  void cut_output() { output_ = {}; }

  /// The demand for a speed in units of the speed parameters.
  [[nodiscard]] Demand demand(std::int32_t speed) const;
  [[nodiscard]] const Profile& profile() const { return profile_; }
  [[nodiscard]] const Theoretical& theoretical() const { return theoretical_; }
  [[nodiscard]] double speed() const { return speed_; }  ///< theoretical [bits x4/s]
  [[nodiscard]] double error() const { return theoretical_.minus(transducer_.total()); }  ///< [bits x4]
  /// Its magnitude in whole bits, as programs see it; the loop works on error() itself.
  [[nodiscard]] std::int32_t follerr() const { return std::abs(to_long(error())); }
  [[nodiscard]] const Actions& actions() const { return actions_; }
  [[nodiscard]] DacOutput output() const { return output_; }
  [[nodiscard]] bool following_error() const { return following_error_; }
  [[nodiscard]] const FrequencyMeter& frequency() const { return frequency_; }
  /// True in the period in which the frequency meter's window ended.
  [[nodiscard]] bool frequency_new() const { return frequency_new_; }
  /// True while the axis is on its way to the quota of a placement.
  [[nodiscard]] bool placing() const { return placing_ && profile_.moving() && !profile_.stopping(); }
  /// Quota of the last placement [Um], or nothing if it did not end there or a run came after it.
  [[nodiscard]] std::optional<std::int32_t> placed() const { return placed_; }
  /// Something else has taken the axis off that quota.
  void forget_placement() { placed_.reset(); }

  void visit(StateArchive& archive);

 private:
  static constexpr int long_rest_ms = 1 << 20;  ///< longer than any pause before a reversal

  [[nodiscard]] double theoretical_way_to(std::int32_t target) const;
  void depart(double way, std::int32_t speed);
  void rest();

  Transducer transducer_;
  Profile profile_;
  Regulator regulator_;
  FrequencyMeter frequency_;
  FollowingErrorHold hold_;
  Theoretical theoretical_;
  double speed_ = 0;
  Actions actions_;
  DacOutput output_;
  Drive drive_ = Drive::open_loop;  ///< of the last period
  std::int64_t counted_ = 0;
  std::optional<std::int32_t> target_;
  std::optional<std::int32_t> placed_;
  bool placing_ = false;
  bool last_backward_ = false;  ///< direction of the last movement
  int rest_ms_ = long_rest_ms;  ///< since the last movement, at most long_rest_ms
  int pause_ms_ = 0;            ///< left before the movement begins
  bool following_error_ = false;
  bool frequency_new_ = false;
};

/// Parameters of the preset search (spec 5.11; 000 1.9.2; 002 1.2.5).
struct PresetSettings {
  std::int32_t mode = 0;   ///< prsmode: 0 enable's release, 1 zero pulse after it, 2 without motion
  bool backward = false;   ///< prsdir 1
  std::int32_t quota = 0;  ///< prspos [Um]
  std::int32_t fast = 0;   ///< prsvel [speed]
  std::int32_t slow = 0;   ///< sprsvel [speed]
  bool locked = false;     ///< the count is locked: nothing loads it (CNTLOCK, 002 1.4.2)

  void visit(StateArchive& archive);
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

  void visit(StateArchive& archive);

 private:
  void load(const PresetSettings& settings, std::int64_t total, AnalogueAxis& axis);

  Leg leg_ = Leg::none;
  Leg after_turn_ = Leg::leave;
  bool backward_ = false;  ///< direction of the running or the coming leg
  bool last_enable_ = false;
};

}  // namespace drycut::devices::axis
