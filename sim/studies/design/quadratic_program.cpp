#include "sim/studies/design/quadratic_program.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim::studies {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_iterations = 100;
constexpr double accuracy = 1e-9;

/// How far along a direction all of `value` stay above 0, at most 1.
double room(const VectorXd& value, const VectorXd& direction) {
  double most = 1;
  for (Eigen::Index i = 0; i < value.size(); ++i)
    if (direction[i] < 0) most = std::min(most, -value[i] / direction[i]);
  return most;
}

class InteriorPoint {
 public:
  explicit InteriorPoint(const QuadraticProgram& program)
      : p_(program),
        x_(VectorXd::Zero(p_.c.size())),
        y_(VectorXd::Zero(p_.b.size())),
        z_(VectorXd::Ones(p_.h.size())),
        s_(p_.h.cwiseMax(1)),
        size_(1 + std::max({p_.c.cwiseAbs().maxCoeff(), p_.b.cwiseAbs().maxCoeff(),
                            p_.h.cwiseAbs().maxCoeff()})) {}

  std::optional<VectorXd> run() {
    for (int i = 0; i < most_iterations; ++i) {
      if (is_done()) return x_;
      if (!factorise()) return {};
      step();
    }
    return {};
  }

 private:
  struct Direction {
    VectorXd x, y, z, s;
  };

  [[nodiscard]] double gap() const { return s_.dot(z_) / static_cast<double>(s_.size()); }

  bool is_done() {
    dual_ = p_.Q * x_ + p_.c + p_.A.transpose() * y_ + p_.G.transpose() * z_;
    equal_ = p_.A * x_ - p_.b;
    below_ = p_.G * x_ + s_ - p_.h;
    // Rounding is left in the dual condition first, where the weights of limits that are just met grow.
    constexpr double of_dual = 100;
    const double largest = std::max({dual_.cwiseAbs().maxCoeff() / of_dual, equal_.cwiseAbs().maxCoeff(),
                                     below_.cwiseAbs().maxCoeff(), gap()});
    return largest <= accuracy * size_;
  }

  /// Of the condensed equations: Q + G'(z/s)G, and A times its inverse times A'.
  bool factorise() {
    const MatrixXd weighted = (z_.array() / s_.array()).sqrt().matrix().asDiagonal() * p_.G;
    MatrixXd whole = p_.Q;
    whole.selfadjointView<Eigen::Lower>().rankUpdate(weighted.transpose());
    // Near a corner the weights differ by so much that rounding takes definiteness away: give some back.
    constexpr double most_regular = 1e-6;
    double regular = 1e-15 * whole.diagonal().maxCoeff() + 1e-11;
    do {
      whole.diagonal().array() += regular;
      factors_.compute(whole);
      regular *= 100;
    } while (factors_.info() != Eigen::Success && regular < most_regular * whole.diagonal().maxCoeff());
    if (factors_.info() != Eigen::Success) return false;
    inverse_times_a_ = factors_.solve(p_.A.transpose());
    schur_.compute(p_.A * inverse_times_a_);
    return true;
  }

  [[nodiscard]] Direction direction(const VectorXd& complement) const {
    const VectorXd of_limits = ((z_.array() * below_.array() - complement.array()) / s_.array()).matrix();
    const VectorXd right = -dual_ - p_.G.transpose() * of_limits;
    const VectorXd free = factors_.solve(right);
    Direction d;
    d.y = schur_.solve(p_.A * free + equal_);
    d.x = free - inverse_times_a_ * d.y;
    d.s = -below_ - p_.G * d.x;
    d.z = ((-complement.array() - z_.array() * d.s.array()) / s_.array()).matrix();
    return d;
  }

  void step() {
    const auto predicted = direction((s_.array() * z_.array()).matrix());
    const double way = std::min(room(s_, predicted.s), room(z_, predicted.z));
    const double after =
        (s_ + way * predicted.s).dot(z_ + way * predicted.z) / static_cast<double>(s_.size());
    const double centring = std::pow(after / gap(), 3);
    const auto d = direction(
        (s_.array() * z_.array() + predicted.s.array() * predicted.z.array() - centring * gap()).matrix());
    constexpr double short_of_the_wall = 0.995;
    const double length = short_of_the_wall * std::min(room(s_, d.s), room(z_, d.z));
    x_ += length * d.x;
    y_ += length * d.y;
    z_ += length * d.z;
    s_ += length * d.s;
  }

  const QuadraticProgram& p_;
  VectorXd x_, y_, z_, s_;
  double size_;
  VectorXd dual_, equal_, below_;  ///< what is left of each of the conditions
  Eigen::LLT<MatrixXd> factors_;
  MatrixXd inverse_times_a_;
  Eigen::LDLT<MatrixXd> schur_;
};

}  // namespace

std::optional<Eigen::VectorXd> solve(const QuadraticProgram& program) { return InteriorPoint(program).run(); }

}  // namespace drycut::sim::studies
