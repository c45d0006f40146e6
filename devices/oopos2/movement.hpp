#pragma once
#include <cstdint>
#include <optional>

#include "devices/oopos2/laws.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::devices::oopos2 {

// What happens in which sample. A sample latches the count and the inputs, lets the timers run by TCamp,
// takes writes and commands, and then compares the position and sets the outputs, which hold until the next
// one. So
//   - a command, a timer that has run out and a quota that is reached act in the sample that sees them;
//   - a timer of t ms that begins in sample k has run out in sample k + ceil(t / TCamp), one of 0 ms at once:
//     phases without time between them are passed in one sample;
//   - of a START in sample k: brake released and st_still 0 in k; direction output on after tbrake; off in
//     the sample that finds the slow range; slowdown output on after slowdly/2, direction on after slowdly;
//     both off in the sample that finds the inertia range; brake, inertia, st_toll and st_still after toldly.

/// One way of a movement: in one direction, with outputs on from its beginning to its goal.
struct Leg {
  bool backward = false;
  bool slow = false;          ///< with the slowdown output from the beginning
  bool slows = false;         ///< goes slow in the slow range before the goal
  std::optional<Parts> goal;  ///< where it ends; nothing: it runs until it is stopped
  Parts inertia = 0;          ///< the outputs go off so far before the goal

  void visit(StateArchive& archive);
};

/// The timers' lengths [ms], 0 or more.
struct Times {
  int brake = 0;      ///< tbrake
  int inversion = 0;  ///< tinvt
  int slowdown = 0;   ///< slowdly
  int tolerance = 0;  ///< toldly

  void visit(StateArchive& archive);
};

struct Outputs {
  bool forward = false;
  bool backward = false;
  bool slow = false;
  bool braked = true;
  bool operator==(const Outputs&) const = default;
};

enum class MovementPhase : std::uint8_t {
  still,      ///< braked
  release,    ///< the brake is released, tbrake runs
  inversion,  ///< tinvt runs since the other direction's output went off
  fast,       ///< direction output on
  slowdown,   ///< in the slow range: slowdly runs, in its second half with the slowdown output
  slow,       ///< direction and slowdown output on
  tolerance,  ///< outputs off, the axis coasts, toldly runs
};

/// The phases of an on/off movement (001 1.2.2, 1.2.3; spec 9.3 and 9.6). A plain value.
class Movement {
 public:
  Times times;

  /// Lets `ms` of the timers pass.
  void tick(int ms);
  /// Runs a leg of a manual movement or a search; one that runs already is replaced, its outputs kept where
  /// the direction is the same.
  void run(const Leg& leg);
  /// Starts a placement, over the goal of `overshoot` if there is one (backlash recovery).
  void place(const std::optional<Leg>& overshoot, const Leg& last);
  /// Outputs off; the movement ends after toldly and is no placement any more.
  void stop();
  /// Ends everything here and now, as after power-up.
  void abort();
  /// One sample at `position` with this slow range; true if the movement ended in it.
  bool step(Parts position, Parts slow_range);

  /// New legs of a running placement, as many as are left: false, and nothing changes, once it is in a slow
  /// range or if the way to the new goal is the other one (D36).
  bool retarget(Parts position, const std::optional<Leg>& overshoot, const Leg& last);
  /// The placement can take the position as the new one: not in a slow range, the goal ahead (D36).
  [[nodiscard]] bool goes_on_from(Parts position) const { return changeable() && ahead(leg_, position); }

  [[nodiscard]] MovementPhase phase() const { return phase_; }
  [[nodiscard]] Outputs outputs() const;
  /// A placement runs, or has ended in this sample.
  [[nodiscard]] bool placing() const { return placing_; }
  /// It is in its first leg, over the quota.
  [[nodiscard]] bool overshooting() const { return last_.has_value(); }
  /// The running or ended leg and whether its output has been on.
  [[nodiscard]] const Leg& leg() const { return leg_; }
  [[nodiscard]] bool driven() const { return driven_; }
  /// The direction output is on.
  [[nodiscard]] bool running() const {
    return phase_ == MovementPhase::fast || phase_ == MovementPhase::slow;
  }
  /// Direction of the output that was on last.
  [[nodiscard]] bool last_backward() const { return last_backward_; }
  /// Left of the running timer [ms], 0 or more.
  [[nodiscard]] int timer_ms() const { return timer_ms_; }

  void visit(StateArchive& archive);

 private:
  static constexpr int long_ago_ms = 1 << 20;  ///< longer than any tinvt

  bool advance(Parts position, Parts slow_range);
  void enter(MovementPhase phase, int ms = 0);
  void begin(const Leg& leg);
  void switch_off();
  void invert();
  bool arrive();
  [[nodiscard]] bool reached(Parts position, Parts before) const;
  [[nodiscard]] static bool ahead(const Leg& leg, Parts position);
  [[nodiscard]] bool changeable() const;

  MovementPhase phase_ = MovementPhase::still;
  Leg leg_;
  std::optional<Leg> last_;  ///< after the overshoot
  bool placing_ = false;
  bool driven_ = false;         ///< the leg's direction output has been on
  bool last_backward_ = false;  ///< direction that was on last
  int off_ms_ = long_ago_ms;    ///< since it went off, at most long_ago_ms
  int timer_ms_ = 0;            ///< left
  int slowdown_ms_ = 0;         ///< length of the running slowdly
};

}  // namespace drycut::devices::oopos2
