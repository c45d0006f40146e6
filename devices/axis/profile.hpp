#pragma once
#include <cstdint>
#include <optional>

namespace drycut {
class StateArchive;
}

namespace drycut::devices::axis {

enum class RampShape : std::uint8_t { trapezoidal, epicycloidal };

/// A change of speed in a given time. Both shapes cover the same space in the same time; the epicycloidal one
/// begins and ends without acceleration and has twice the peak (spec 5.3, 5.4; 000 1.1.7).
struct Ramp {
  double from = 0;      ///< [bits x4/s]
  double to = 0;        ///< [bits x4/s]
  double duration = 0;  ///< [s]; 0 = a step of speed

  void visit(StateArchive& archive);
};

/// Speed at `t` seconds from the ramp's start, 0 <= t <= duration [bits x4/s].
double ramp_speed(RampShape shape, const Ramp& ramp, double t);
/// Space covered at `t` seconds [bits x4].
double ramp_space(RampShape shape, const Ramp& ramp, double t);
/// Space of the whole ramp [bits x4].
inline double ramp_space(const Ramp& ramp) { return ramp.duration * (ramp.from + ramp.to) / 2; }

/// How an axis is to move. Ramp times hold between rest and full speed, so gradients are constant (spec 1.6).
struct Demand {
  double speed = 0;                 ///< [bits x4/s]; 0 or less: waits without moving
  double seconds_per_speed_up = 0;  ///< acceleration: seconds for each bit x4/s; 0 = a step of speed
  double seconds_per_speed_down = 0;
  RampShape shape = RampShape::trapezoidal;
  bool keep_gradient =
      true;  ///< a short move: true lowers ramp times too (rtype 1), false keeps them (rtype 0)
  friend bool operator==(const Demand&, const Demand&) = default;
  void visit(StateArchive& archive);
};

/// A movement: a ramp to its speed, a stretch of constant speed, a last ramp to rest.
struct Plan {
  RampShape shape = RampShape::trapezoidal;
  Ramp lead;  ///< of a movement changed in a ramp that is never bent: that ramp
  Ramp first;
  double constant = 0;  ///< [s]
  Ramp last;
  [[nodiscard]] double duration() const { return lead.duration + first.duration + constant + last.duration; }
  [[nodiscard]] double space() const;
  [[nodiscard]] double space_at(double t) const;
  [[nodiscard]] double speed_at(double t) const;
  void visit(StateArchive& archive);
};

/// The movement over `distance` >= 0 [bits x4] that begins at `speed` >= 0; nullopt if the axis cannot stop
/// in that distance (spec 5.3, 5.5; 000 1.1.8).
std::optional<Plan> plan_move(double speed, double distance, const Demand& demand);
/// The ramp from `speed` to rest; steeper than the demand's if that would pass a point `distance` > 0 ahead.
Plan plan_stop(double speed, double distance, const Demand& demand);

enum class Phase : std::uint8_t { still, accelerating, constant, decelerating };

/// Follows a plan period by period and replans when the demand, the target or a STOP changes it.
class Profile {
 public:
  /// Starts from rest over a signed distance [bits x4].
  void move(double distance, const Demand& demand);
  /// Starts a stop from a signed speed [bits x4/s] that something else gave the axis (STOPCAM).
  void brake(double speed, const Demand& demand);
  /// New speed or ramp times in mid-move. Trapezoidal: at once. Epicycloidal: when the running ramp has
  /// ended. False, and nothing changes, in the last ramp or if the target could no longer be reached.
  bool change(const Demand& demand);
  /// New signed distance from here to the target. False, and nothing changes, in the last ramp or if the
  /// target cannot be reached in this direction.
  bool retarget(double remaining);
  /// The axis is elsewhere than its profile was: the movement goes on from here to its target, a signed
  /// distance away, and bends a ramp or brakes harder than demanded if it must. False if it has passed the
  /// target: then it stops.
  bool resume(double remaining);
  /// Stops with the deceleration in use, never beyond the target; an epicycloidal ramp is finished before if
  /// `finish_ramp` (stopt 0, 000 1.1.9).
  void stop(bool finish_ramp);
  /// Ends the movement here and now.
  void abort() { moving_ = false; }
  /// Advances by one period of `period_s`; returns the signed way of the period [bits x4].
  double step(double period_s);

  /// What the movement goes by: of what was written in mid-move only what it has taken.
  [[nodiscard]] const Demand& demand() const { return demand_; }
  [[nodiscard]] bool moving() const { return moving_; }
  [[nodiscard]] bool backward() const { return direction_ < 0; }
  /// A STOP, not a target, ends this movement.
  [[nodiscard]] bool stopping() const { return stopping_; }
  [[nodiscard]] Phase phase() const;
  /// In the ramp that ends the movement: no change is taken any more.
  [[nodiscard]] bool in_last_ramp() const;
  /// Signed speed [bits x4/s].
  [[nodiscard]] double speed() const { return moving_ ? direction_ * plan_.speed_at(time_) : 0; }

  void visit(StateArchive& archive);

 private:
  /// A ramp and how far it is.
  struct Progress {
    Ramp ramp;
    double time;     ///< [s]
    double covered;  ///< [bits x4]
    [[nodiscard]] double left() const { return ramp_space(ramp) - covered; }
  };
  /// The ramp to the movement's speed while it runs; else here().
  [[nodiscard]] Progress under_way() const;
  /// A ramp of no length at the speed of now.
  [[nodiscard]] Progress here() const;
  /// What a change leaves as it is: of an epicycloidal movement the ramp under way.
  [[nodiscard]] Progress unbent() const {
    return plan_.shape == RampShape::epicycloidal ? under_way() : here();
  }
  /// A new plan for the distance from here to the target, the rest of `kept` before it.
  bool replan(const Progress& kept, double distance, const Demand& demand);
  /// Goes on with a plan over `distance` that begins with the ramp that is under way.
  void adopt(const Plan& plan, double distance, const Progress& lead = {});
  [[nodiscard]] double remaining() const { return distance_ - covered_; }

  Plan plan_;
  Demand demand_;
  double direction_ = 1;
  double distance_ = 0;  ///< of the plan [bits x4]
  double covered_ = 0;   ///< of that
  double time_ = 0;      ///< in the plan: where it began, and the periods since [s]
  double begun_ = 0;
  std::int64_t periods_ = 0;
  bool moving_ = false;
  bool stopping_ = false;
};

}  // namespace drycut::devices::axis
