#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "devices/plcopen/cam_table.hpp"

namespace drycut::devices::plcopen {

/// Where an axis is, in whole turns and a part of one: the part of a modulo axis lies in 0..modulo, of a
/// linear axis (modulo 0) it is all there is [0.1 um or 0.0001 deg]. However many turns there were, the part
/// is as fine as in the first one.
struct Position {
  std::int64_t turns = 0;
  double part = 0;

  void visit(StateArchive& archive);
};

/// `position` with `part` brought into 0..modulo.
inline Position normalised(Position position, double modulo) {
  if (modulo <= 0) return position;
  const double turns = std::floor(position.part / modulo);
  position.turns += static_cast<std::int64_t>(turns);
  position.part -= turns * modulo;
  // A part just below 0 rounds up to a whole turn.
  if (position.part >= modulo) {
    position.part -= modulo;
    ++position.turns;
  }
  return position;
}

inline Position advanced(Position position, double by, double modulo) {
  position.part += by;
  return normalised(position, modulo);
}

/// From `b` to `a`.
inline double difference(const Position& a, const Position& b, double modulo) {
  return static_cast<double>(a.turns - b.turns) * modulo + (a.part - b.part);
}

/// The same place modulo, by the shortest way: -modulo/2..modulo/2.
inline double shortest(const Position& a, const Position& b, double modulo) {
  if (modulo <= 0) return a.part - b.part;
  const double way = a.part - b.part;
  return way - modulo * std::round(way / modulo);
}

// Jerk-limited motion as plain values, in any unit of length (the kernel's is 0.1 um or 0.0001 deg): every
// profile is a few phases of constant jerk, so that acceleration is continuous and nothing is integrated
// numerically.

/// Where a point is and how it moves [inc, inc/s, inc/s2].
struct MotionState {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;

  void visit(StateArchive& archive);
};

/// Bounds of a motion, each above 0 [inc/s, inc/s2, inc/s2, inc/s3].
struct JerkLimits {
  double velocity = 0;
  double acceleration = 0;  ///< while the speed grows
  double deceleration = 0;  ///< while it falls
  double jerk = 0;

  void visit(StateArchive& archive);
};

/// Phases of constant jerk from `start`; after them the motion goes on as `end` moves, without acceleration.
struct JerkProfile {
  struct Phase {
    double duration = 0;  ///< [s]
    double jerk = 0;

    void visit(StateArchive& archive);
  };
  std::array<Phase, 7> phases{};
  int count = 0;
  double duration = 0;  ///< of all phases [s]
  MotionState start;
  MotionState end;  ///< exact, not the rounded sum of the phases

  void visit(StateArchive& archive);
};

/// `state` after `time` [s] of constant jerk.
MotionState moved(const MotionState& state, double jerk, double time);
/// The motion `time` [s] after the profile's start, 0 or more.
MotionState at(const JerkProfile& profile, double time);

/// The fastest way from any state to a steady `velocity`. Acceleration stays in -down..up, where the state's
/// own lies outside it is brought in first. Nullopt if a limit is not above 0.
std::optional<JerkProfile> to_velocity(const MotionState& state, double velocity, double up, double down,
                                       double jerk);
/// The same with a deceleration of its own for a speed that falls; a reversal takes the smaller of the two.
std::optional<JerkProfile> to_velocity(const MotionState& state, double velocity, const JerkLimits& limits);

/// The way from any state to rest at `position`: the fastest one, except where the state is above the
/// velocity limit or a reversal has to do with two different accelerations; such a way keeps the limits
/// as soon as it can. Nullopt if a limit is not above 0.
///
/// With `velocity` it passes `position` at that speed, in the direction in which it comes there, and may be
/// above the velocity limit; where the way is too short, at the speed nearest to it that can be had.
std::optional<JerkProfile> to_position(const MotionState& state, double position, const JerkLimits& limits,
                                       double velocity = 0);

// A slave behind a master, in increments and seconds. Engaging is amplitude-true (004 "Behavior of
// MC_CamIn"): the slave slips until it has the cam's speed, then a superimposed move brings it to the cam's
// position; the cam itself is never scaled.

/// How the axis moves at an instant [inc, inc/s, inc/s2].
struct AxisMotion {
  Position position;
  double velocity = 0;
  double acceleration = 0;

  void visit(StateArchive& archive);
};

/// What bounds the ramp-in [inc, s]; from the slave's cam_gear parameters.
struct CouplingLimits {
  double window = 0.1;      ///< velocity window, as a share of the cam's speed
  double window_floor = 0;  ///< and of this speed at least, so that a dwell of the cam has a window
  double time_in_window = 0;
  double timeout = 0;
  bool timeout_from_start = false;
  double sync_jerk = 0;
  double up = 0;    ///< acceleration of the velocity synchronisation while the speed grows
  double down = 0;  ///< and while it falls
  JerkLimits phasing;
  double velocity = 0;      ///< largest speed of the slave while engaging and engaged
  double acceleration = 0;  ///< largest acceleration of a geared slave
};

/// y = slave_scaling * cam(master_scaling * master + master_offset) + slave_offset
struct CamFollow {
  CamCurve curve;
  std::int64_t master_scaling = 1;
  double slave_scaling = 1;
  double master_offset = 0;
  double slave_offset = 0;
  bool periodic = true;

  void visit(StateArchive& archive);
};

/// The slave moves numerator/denominator times as far as the master, from wherever both are at engagement.
struct GearFollow {
  std::int64_t numerator = 1;
  std::int64_t denominator = 1;
  double master_modulo = 0;

  void visit(StateArchive& archive);
};

enum class CouplingPhase : std::uint8_t {
  slip,       ///< to the cam's speed, jerk-limited
  window,     ///< in the velocity window or back into it
  phasing,    ///< to the cam's position, by a superimposed move
  wait_zero,  ///< non-periodic: at the cam's start until the master passes zero
  coupled,
};

enum class CouplingOutcome : std::uint8_t { follows, timed_out, pass_complete };

class Coupling {
 public:
  /// For a state to be put into it.
  Coupling() = default;
  Coupling(std::variant<CamFollow, GearFollow> law, double slave_modulo)
      : law_(std::move(law)), slave_modulo_(slave_modulo) {}

  /// Takes over from another coupling to the same master: its phase shift stays, and where the slave already
  /// moves as the new law wants, to within `tolerance` [inc, and inc/s of speed], it is engaged at once.
  void take_over(const Coupling& before, const AxisMotion& master, const AxisMotion& slave, double tolerance);
  /// Starts a non-periodic cam whose slave stands at its start: it waits for zero, or is there already.
  void start_in_place(const AxisMotion& master, const AxisMotion& slave, double tolerance);

  /// One cycle of `dt` [s]: the master as it is at its end; `slave` goes from the cycle's start to its end.
  CouplingOutcome step(const AxisMotion& master, AxisMotion& slave, double dt, const CouplingLimits& limits);

  /// MC_Phasing: moves the apparent master by `shift`, jerk-limited. False if a limit is not above 0.
  bool shift_phase(double shift, const JerkLimits& limits);
  /// True once the shift that was asked for last is done.
  [[nodiscard]] bool phase_shifted() const { return !shift_profile_; }
  /// Shifts asked for so far: a newer one takes over from an older.
  [[nodiscard]] std::uint64_t shifts() const { return shifts_; }

  /// Non-periodic: one pass more after this one; more than one is not stored.
  void add_pass() { extra_pass_ = true; }
  /// A live change of the table.
  void replace_curve(CamCurve curve) { std::get<CamFollow>(law_).curve = std::move(curve); }

  /// Where the master is for the cam: scaled, with its offset and the phase shift, in turns of the cam.
  [[nodiscard]] Position place(const CamFollow& cam, const AxisMotion& master) const;

  [[nodiscard]] CouplingPhase phase() const { return phase_; }
  [[nodiscard]] bool engaged() const { return phase_ == CouplingPhase::coupled; }
  /// In the last cycle the law asked for more than the slave's limits allow: it lags behind.
  [[nodiscard]] bool clamped() const { return clamped_; }
  /// By its acceleration, not its speed: only a gear looks at it.
  [[nodiscard]] bool clamped_by_acceleration() const { return by_acceleration_; }
  /// The slave is where the law wants it.
  [[nodiscard]] bool in_place() const { return engaged() && !clamped_; }
  /// Cam ends passed while engaged, since the start.
  [[nodiscard]] std::int64_t profile_ends() const { return profile_ends_; }
  [[nodiscard]] const CamFollow* cam() const { return std::get_if<CamFollow>(&law_); }
  [[nodiscard]] bool running_pass() const { return engaged() && cam() != nullptr && !cam()->periodic; }

  void visit(StateArchive& archive);

 private:
  struct Target {
    AxisMotion motion;
    std::int64_t cycle = 0;  ///< of the cam, by the master
    double x = 0;            ///< in the cycle
  };
  [[nodiscard]] Target target(const AxisMotion& master) const;
  [[nodiscard]] Target cam_target(const CamFollow& cam, const AxisMotion& master) const;
  [[nodiscard]] AxisMotion gear_target(const GearFollow& gear, const AxisMotion& master) const;
  /// The cam's start, where a non-periodic slave waits.
  [[nodiscard]] AxisMotion start_of_cam() const;
  [[nodiscard]] MotionState shift() const;

  CouplingOutcome synchronise(const AxisMotion& wanted, const AxisMotion& master, AxisMotion& slave,
                              double dt, const CouplingLimits& limits);
  void begin_phasing(const AxisMotion& wanted, const AxisMotion& master, const AxisMotion& slave,
                     const CouplingLimits& limits);
  void follow(const AxisMotion& wanted, AxisMotion& slave, double dt, const CouplingLimits& limits);
  CouplingOutcome run_pass(const Target& place, AxisMotion& slave);
  void wait_for_zero(const Target& place);
  void rebase_gear(const AxisMotion& master);

  std::variant<CamFollow, GearFollow> law_;
  double slave_modulo_ = 0;
  CouplingPhase phase_ = CouplingPhase::slip;
  bool clamped_ = false;
  bool by_acceleration_ = false;
  double time_ = 0;  ///< for the timeout
  double time_in_window_ = 0;

  JerkProfile offset_profile_;  ///< slave less law while phasing
  double offset_time_ = 0;

  std::uint64_t shifts_ = 0;
  double shift_sum_ = 0;  ///< completed phase shifts [master inc]
  std::optional<JerkProfile> shift_profile_;
  double shift_time_ = 0;

  std::int64_t first_cycle_ = 0;  ///< cam cycle at which the slave's turns are slave_turns_
  std::int64_t slave_turns_ = 0;
  std::int64_t last_cycle_ = 0;  ///< of the last step
  bool last_cycle_known_ = false;
  std::int64_t pass_origin_ = 0;  ///< cycle at whose zero the pass began
  bool extra_pass_ = false;
  std::int64_t profile_ends_ = 0;

  Position gear_master_;
  Position gear_slave_;
};

}  // namespace drycut::devices::plcopen
