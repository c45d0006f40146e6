#include "sim/studies/fit/move.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "sim/studies/fit/move_axis.hpp"
#include "sim/studies/fit/words.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double rest = 0.2;  ///< between two strokes [s]

/// Puts strokes together. Ramps are of whole hundredths of a second from rest to 10 V, as EANPOS has them, so
/// that the controllers do the same.
class Planner {
 public:
  explicit Planner(FitMove& move) : move_(move), axis_(move.axis) {
    const double used = 0.8;
    const double torque =
        std::min(used * axis_.rated_torque, used * used * axis_.peak_torque - std::abs(axis_.drag));
    constexpr double least = 0.1;
    acceleration_ = ramp_for(std::max(torque, least * axis_.rated_torque) / axis_.inertia /
                             (2 * std::numbers::pi) * minute_s);
    gentle_ = ramp_for(acceleration_ / 3);
  }

  void plan(const std::set<MovePart>& parts) {
    // A carriage has its whole travel from the lower end on.
    const double half = way() / 2;
    if (axis_.linear) stroke(MovePart::approach, -approach_speed(), gentle_, half);
    if (parts.contains(MovePart::constant_speeds)) constant_speeds();
    if (parts.contains(MovePart::ramps)) ramps();
    if (parts.contains(MovePart::slow)) slow();
    if (parts.contains(MovePart::whole)) whole();
    if (parts.contains(MovePart::chirp)) chirp();
    if (axis_.linear) stroke(MovePart::approach, approach_speed(), gentle_, half);
  }

 private:
  /// The nearest acceleration that is not higher [rpm/s].
  [[nodiscard]] double ramp_for(double acceleration) const {
    constexpr double hundredths = 100;
    constexpr double longest = 999;
    const double ramp = std::ceil(hundredths * axis_.speed_at_10v / acceleration - 1e-9);
    return hundredths * axis_.speed_at_10v / std::clamp(ramp, 2.0, longest);
  }

  /// There is so much [turns of the motor].
  [[nodiscard]] double way() const { return axis_.linear ? (axis_.high - axis_.low) / axis_.per_turn : 1e9; }

  /// The highest speed that is kept for `along` seconds [rpm].
  [[nodiscard]] double fastest(double acceleration, double along) const {
    constexpr double longest_ramp = 2;
    const double a = acceleration / minute_s;
    const double v = a / 2 * (std::sqrt(along * along + 4 * way() / a) - along);
    return std::min({v * minute_s, axis_.top_speed, longest_ramp * acceleration});
  }

  [[nodiscard]] double approach_speed() const { return 0.5 * fastest(gentle_, 0.5); }

  /// A stroke over `turns` of the motor, or over less where the speed cannot be reached.
  void stroke(MovePart part, double speed, double acceleration, double turns) {
    const double ramp = std::abs(speed) / acceleration;
    const double along = std::max(0.0, turns * minute_s / std::abs(speed) - ramp);
    move_.segments.push_back({part, 0, speed, ramp});
    move_.segments.push_back({part, speed, speed, along});
    move_.segments.push_back({part, speed, 0, ramp});
    move_.segments.push_back({part, 0, 0, rest});
  }

  /// Forwards and back at a speed that is kept for `along` seconds, or as long as the travel allows.
  void both_ways(MovePart part, double speed, double acceleration, double along) {
    const double turns = std::min(way(), (speed / acceleration + along) * speed / minute_s);
    stroke(part, speed, acceleration, turns);
    stroke(part, -speed, acceleration, turns);
  }

  void constant_speeds() {
    const double top = fastest(gentle_, 0.4);
    for (const double share : {1.0, 0.5, 0.25, 0.1, 0.04})
      both_ways(MovePart::constant_speeds, share * top, gentle_, 1);
  }

  void ramps() {
    const double top = fastest(acceleration_, 0.1);
    for (const double share : {1.0, 0.6, 1.0}) both_ways(MovePart::ramps, share * top, acceleration_, 0.1);
  }

  void slow() {
    for (const double times : {4.0, 2.0, 1.0, 0.5, 1.0, 2.0})
      both_ways(MovePart::slow, times * slow_speed(), gentle_, 0.5);
  }

  /// Where friction falls, if it is looked for, and what a reference of +-10 V can still tell.
  [[nodiscard]] double slow_speed() const {
    constexpr double share = 0.004;
    return std::clamp(axis_.stribeck_speed, share * axis_.speed_at_10v, fastest(gentle_, 0.5) / 8);
  }

  void whole() {
    constexpr double longest = 8;
    constexpr double degrees = 360;
    const double turns = axis_.linear ? way() : 2 * degrees / axis_.per_turn;
    const double speed =
        std::min(std::max(0.1 * axis_.top_speed, turns * minute_s / longest), fastest(gentle_, 0.5));
    stroke(MovePart::whole, speed, gentle_, turns);
    stroke(MovePart::whole, -speed, gentle_, turns);
  }

  void chirp() {
    constexpr double along = 8;
    const double speed = std::min(0.1 * axis_.top_speed, 0.9 * way() * minute_s / along);
    both_ways(MovePart::chirp, speed, gentle_, along);
    constexpr double unknown = 200;
    constexpr double lowest = 2;
    const double to = axis_.resonance > 0 ? 2 * axis_.resonance : unknown;
    move_.chirp = {std::max(lowest, axis_.antiresonance / 3), to, 0.2 * axis_.rated_torque};
  }

  FitMove& move_;
  const MoveAxis& axis_;
  double acceleration_ = 0;  ///< [rpm/s]
  double gentle_ = 0;        ///< [rpm/s]
};

bool is_play(const FitPath& path) { return path.row == "gear.backlash" || path.row == "gap"; }

/// At least so often [Hz], by a whole part of a millisecond.
double sampling_for(const FitMove& move) {
  constexpr double samples = 5;  // a period of the fastest
  const double wanted = move.chirp ? samples * move.chirp->to : 0;
  constexpr std::array usual = {1000.0, 2000.0, 5000.0};
  const auto found = std::ranges::find_if(usual, [&](double one) { return one >= wanted; });
  return found == usual.end() ? 10000 : *found;
}

}  // namespace

double MoveSegment::turns() const { return (from + to) / 2 * seconds / minute_s; }

double FitMove::seconds() const {
  return std::accumulate(segments.begin(), segments.end(), 0.0,
                         [](double sum, const auto& one) { return sum + one.seconds; });
}

std::vector<MoveStroke> strokes_of(const FitMove& move) {
  std::vector<MoveStroke> strokes;
  double time = 0;
  double turns = 0;
  for (const auto& one : move.segments) {
    if (one.from == 0 && one.to != 0) {
      turns = 0;
      strokes.push_back({one.part, time, one.to, one.seconds, 0, 0});
    }
    if (one.from == one.to && one.to != 0) strokes.back().along = one.seconds;
    turns += one.turns();
    if (one.from != 0 && one.to == 0) strokes.back().turns = turns;
    time += one.seconds;
  }
  return strokes;
}

MovePart part_for(const FitPath& path) {
  if (is_play(path)) return MovePart::slow;
  switch (shows(path)) {
    case Shows::in_acceleration:
      return MovePart::ramps;
    case Shows::at_low_speed:
      return MovePart::slow;
    case Shows::in_bending:
      return MovePart::chirp;
    case Shows::in_place:
      return MovePart::whole;
    case Shows::in_direction:
    case Shows::in_speed:
    case Shows::in_all:
      break;
  }
  return MovePart::constant_speeds;
}

std::optional<FitMove> plan_move(FitPlan& plan, Problems& problems) {
  auto machine = read_question(plan, problems);
  if (!machine || !problems.empty()) return {};
  auto axis = move_axis(*machine, plan.question, problems);
  if (!axis) return {};
  FitMove move;
  move.axis = *axis;
  move.vary = plan.question.vary;
  std::set<MovePart> parts;
  for (const auto& path : move.vary) {
    parts.insert(part_for(path));
    // Play shows where the motion turns, and in what it does to a shake.
    if (is_play(path)) parts.insert(MovePart::chirp);
  }
  Planner(move).plan(parts);
  move.sampling = sampling_for(move);
  return move;
}

}  // namespace drycut::sim::studies
