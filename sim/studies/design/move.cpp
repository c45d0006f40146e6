#include "sim/studies/design/move.hpp"

#include <cmath>

#include "sim/studies/design/quadratic_program.hpp"

namespace drycut::sim::studies {

namespace {

using Eigen::VectorXd;

constexpr double free_jerk = 32;  // the least without limits, in distances a way to the third

/// The problem over half the way as 0 to 1/2 with a distance of 1: its unknowns are the slopes at both ends
/// of each step, then what the goal makes smallest, then sizes of the ratio if its sign matters.
class Discretised {
 public:
  explicit Discretised(const MoveProblem& problem)
      : problem_(problem),
        steps_(problem.steps),
        width_(0.5 / problem.steps),
        per_speed_(problem.distance / problem.way),
        has_size_(problem.friction.viscous * problem.friction.coulomb > 0 &&
                  problem.goal == MoveGoal::energy && !problem.limits.no_reverse),
        count_(2 * steps_ + 1 + (has_size_ ? steps_ : 0)) {}

  std::optional<Move> solved() {
    program_.Q = Eigen::MatrixXd::Zero(count_, count_);
    program_.c = VectorXd::Zero(count_);
    add_goal();
    add_equalities();
    add_limits();
    gather();
    const auto x = solve(program_);
    if (!x) return {};
    return move_of(*x);
  }

 private:
  struct Row {
    VectorXd left;
    double right = 0;
  };

  [[nodiscard]] VectorXd none() const { return VectorXd::Zero(count_); }
  [[nodiscard]] int goal() const { return 2 * steps_; }
  [[nodiscard]] VectorXd slope(int end) const {
    VectorXd row = none();
    row[end] = 1;
    return row;
  }
  /// The speed's departure at the beginning of a step, in distances a way.
  [[nodiscard]] VectorXd speed(int step) const {
    VectorXd row = none();
    for (int i = 0; i < 2 * step; ++i) row[i] = width_ / 2;
    return row;
  }
  /// At a part of a step.
  [[nodiscard]] VectorXd speed(int step, double part) const {
    VectorXd row = speed(step);
    row[2 * step] += width_ * (part - part * part / 2);
    row[2 * step + 1] += width_ * part * part / 2;
    return row;
  }
  /// What lies under the speed up to the beginning of a step.
  [[nodiscard]] VectorXd area(int step) const {
    VectorXd row = none();
    for (int i = 0; i < step; ++i) {
      row += width_ * speed(i);
      row[2 * i] += width_ * width_ / 3;
      row[2 * i + 1] += width_ * width_ / 6;
    }
    return row;
  }

  void at_most(VectorXd left, double right) { below_.push_back({std::move(left), right}); }
  /// -most <= left <= most.
  void within(const VectorXd& left, double most) {
    at_most(left, most);
    at_most(-left, most);
  }
  /// The size of `left` is at most what the goal makes smallest, times `scale`.
  void least(const VectorXd& left, double scale) {
    for (const double sign : {1.0, -1.0}) {
      VectorXd row = sign * left;
      row[goal()] -= scale;
      at_most(std::move(row), 0);
    }
  }
  /// `left` is at most `right`, or by the goal's part of `unit` more where that is a violation.
  void limit(VectorXd left, double right, double unit) {
    if (problem_.goal == MoveGoal::violation) left[goal()] -= unit;
    at_most(std::move(left), right);
  }

  void add_goal() {
    constexpr double hint = 1e-9;  // of those that are equally good the calm one
    const bool squared = problem_.goal == MoveGoal::rms || problem_.goal == MoveGoal::energy;
    const double weight = squared ? 1 : hint;
    for (int i = 0; i < steps_; ++i) {
      const double part = weight * width_ / 3;
      program_.Q(2 * i, 2 * i) += 2 * part;
      program_.Q(2 * i + 1, 2 * i + 1) += 2 * part;
      program_.Q(2 * i, 2 * i + 1) += part;
      program_.Q(2 * i + 1, 2 * i) += part;
    }
    at_most(-slope(goal()), 0);
    program_.c[goal()] = 1;
    if (problem_.goal == MoveGoal::energy) add_friction();
    for (int i = 0; i < steps_; ++i) {
      if (problem_.goal == MoveGoal::peak || problem_.goal == MoveGoal::gradient) {
        least(slope(2 * i), 1);
        least(slope(2 * i + 1), 1);
      }
      if (problem_.goal == MoveGoal::jerk) least(slope(2 * i + 1) - slope(2 * i), free_jerk * width_);
    }
  }

  /// The force's square is that of the accelerating part, of the friction, and a product that depends on both
  /// ends alone.
  void add_friction() {
    constexpr double points[] = {0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr double shares[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    const double viscous = problem_.friction.viscous * problem_.way;
    for (int i = 0; i < steps_; ++i)
      for (int k = 0; k < 3; ++k) {
        const VectorXd row = speed(i, points[k]);
        program_.Q += 2 * width_ * shares[k] * viscous * viscous * row * row.transpose();
      }
    if (!has_size_) return;
    const double both = 2 * problem_.friction.viscous * problem_.friction.coulomb *
                        std::pow(problem_.way * problem_.way / problem_.distance, 2);
    for (int i = 0; i < steps_; ++i) {
      const int size = goal() + 1 + i;
      program_.c[size] = 2 * width_ * both / 2;
      for (const double sign : {1.0, -1.0}) {
        VectorXd row = sign * per_speed_ * speed(i, 0.5);
        row[size] = -1;
        at_most(std::move(row), -sign * problem_.ratio);
      }
    }
  }

  void add_equalities() {
    equal_.push_back({area(steps_), 0.5});
    if (problem_.still) equal_.push_back({speed(*problem_.still), -problem_.ratio / per_speed_});
    if (problem_.goal != MoveGoal::jerk && !problem_.smooth) return;
    equal_.push_back({slope(0), 0});
    equal_.push_back({slope(2 * steps_ - 1), 0});
    for (int i = 1; i < steps_; ++i) equal_.push_back({slope(2 * i) - slope(2 * i - 1), 0});
  }

  /// The speed is a parabola in each step; it stays within its Bezier points.
  void add_limits() {
    const auto& limits = problem_.limits;
    const double gradients = std::abs(problem_.distance) / (problem_.way * problem_.way);
    for (int i = 0; i < steps_; ++i) {
      VectorXd middle = speed(i);
      middle[2 * i] += width_ / 2;
      for (const VectorXd& speeds : {middle, speed(i + 1)}) {
        const VectorXd ratio = per_speed_ * speeds;
        if (limits.ratio && problem_.goal != MoveGoal::ratio)
          for (const double sign : {1.0, -1.0})
            limit(sign * ratio, *limits.ratio - sign * problem_.ratio, *limits.ratio);
        if (problem_.goal == MoveGoal::ratio)
          for (const double sign : {1.0, -1.0}) {
            VectorXd row = sign * ratio;
            row[goal()] -= 1;
            at_most(std::move(row), -sign * problem_.ratio);
          }
        if (limits.no_reverse) limit(-ratio, problem_.ratio, 1);
      }
      for (const int end : {2 * i, 2 * i + 1})
        if (limits.gradient && problem_.goal != MoveGoal::gradient)
          for (const double sign : {1.0, -1.0})
            limit(sign * slope(end), *limits.gradient / gradients, *limits.gradient / gradients);
      add_excursion(i + 1);
    }
  }

  void add_excursion(int step) {
    const double master = step * width_ * problem_.way;
    VectorXd row = problem_.distance * area(step);
    if (problem_.goal == MoveGoal::excursion) {
      row[goal()] -= 1;
      at_most(std::move(row), -problem_.ratio * master);
    } else if (problem_.limits.excursion) {
      limit(std::move(row), *problem_.limits.excursion - problem_.ratio * master, problem_.way);
    }
  }

  void gather() {
    const auto put = [this](const std::vector<Row>& rows, Eigen::MatrixXd& left, VectorXd& right) {
      left.resize(static_cast<Eigen::Index>(rows.size()), count_);
      right.resize(static_cast<Eigen::Index>(rows.size()));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        left.row(static_cast<Eigen::Index>(i)) = rows[i].left.transpose();
        right[static_cast<Eigen::Index>(i)] = rows[i].right;
      }
    };
    put(equal_, program_.A, program_.b);
    put(below_, program_.G, program_.h);
  }

  [[nodiscard]] Move move_of(const VectorXd& x) const {
    const double gradients = problem_.distance / (problem_.way * problem_.way);
    Move move;
    move.steps.reserve(2 * static_cast<std::size_t>(steps_));
    for (int i = 0; i < steps_; ++i) move.steps.push_back({gradients * x[2 * i], gradients * x[2 * i + 1]});
    for (int i = steps_ - 1; i >= 0; --i)
      move.steps.push_back({-gradients * x[2 * i + 1], -gradients * x[2 * i]});
    const bool of_slopes = problem_.goal == MoveGoal::peak || problem_.goal == MoveGoal::gradient;
    const double scale = problem_.goal == MoveGoal::jerk ? free_jerk / problem_.way : 1;
    move.value = x[goal()] * (of_slopes || problem_.goal == MoveGoal::jerk ? std::abs(gradients) * scale : 1);
    return move;
  }

  const MoveProblem& problem_;
  int steps_;
  double width_;
  double per_speed_;
  bool has_size_;
  int count_;
  QuadraticProgram program_;
  std::vector<Row> equal_;
  std::vector<Row> below_;
};

}  // namespace

std::optional<Move> best_move(const MoveProblem& problem) { return Discretised(problem).solved(); }

}  // namespace drycut::sim::studies
