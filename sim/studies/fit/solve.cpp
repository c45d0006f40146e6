#include "sim/studies/fit/solve.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

namespace drycut::sim::studies {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What a step of a value should change, of all that was measured: little enough to be straight, enough to
/// be more than rounding.
constexpr double wanted_effect = 0.02;
/// A value whose limits change less than this is known.
constexpr double least_effect = 0.05;
/// Of what is never 0 less than this is nothing: it moved, and hardly anything was due to it.
constexpr double least_whole_effect = 0.005;
/// A value is known within half of itself.
constexpr double known_within = 0.5;
/// Steps, interpolation and rounding bend a value by what changes this share of all that was measured.
constexpr double least_half = 4e-4;
/// Above this columns are not told apart; below this share a value has no part in it.
constexpr double most_condition = 30;
constexpr double least_part = 0.25;

VectorXd joined(const Residuals& blocks) {
  Index size = 0;
  for (const auto& block : blocks) size += block.size();
  VectorXd all(size);
  Index at = 0;
  for (const auto& block : blocks) {
    all.segment(at, block.size()) = block;
    at += block.size();
  }
  return all;
}

/// The problem in values over their steps, as Eigen's Levenberg-Marquardt asks for it.
class Functor {
 public:
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  Functor(const std::vector<FitUnknown>& unknowns, const ResidualsOf& residuals, double whole)
      : unknowns_(unknowns), residuals_(residuals), whole_(whole), steps_(unknowns.size()) {
    std::vector<double> start;
    for (const auto& one : unknowns) start.push_back(one.start);
    auto found = ask({start});
    if (found.front().empty()) throw std::runtime_error("the values of the scenario give no motion");
    sizes_.reserve(found.front().size());
    for (const auto& block : found.front()) sizes_.push_back(block.size());
    at_start_ = joined(found.front());
    find_steps(start);
  }

  // NOLINTBEGIN(readability-identifier-naming): Eigen's names.
  [[nodiscard]] int inputs() const { return static_cast<int>(unknowns_.size()); }
  [[nodiscard]] int values() const { return static_cast<int>(at_start_.size()); }
  // NOLINTEND(readability-identifier-naming)

  int operator()(const VectorXd& x, VectorXd& left) {
    const auto found = ask({values_of(x)});
    if (found.front().empty())
      left = VectorXd::Constant(at_start_.size(), 1e3 * at_start_.norm());
    else
      left = joined(found.front());
    return left.allFinite() ? 0 : -1;
  }

  int df(const VectorXd& x, MatrixXd& slopes) {
    std::vector<std::vector<double>> sets = {values_of(x)};
    for (std::size_t i = 0; i < unknowns_.size(); ++i) sets.push_back(moved(sets.front(), i, steps_[i]));
    const auto found = ask(sets);
    if (found.front().empty()) return -1;
    const auto base = joined(found.front());
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const auto column = static_cast<Index>(i);
      const double step = (sets[i + 1][i] - sets.front()[i]) / steps_[i];
      if (found[i + 1].empty() || step == 0)
        slopes.col(column).setZero();
      else
        slopes.col(column) = (joined(found[i + 1]) - base) / step;
    }
    return 0;
  }

  [[nodiscard]] std::vector<double> values_of(const VectorXd& x) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < unknowns_.size(); ++i)
      values.push_back(std::clamp(x[static_cast<Index>(i)] * steps_[i], unknowns_[i].low, unknowns_[i].high));
    return values;
  }
  [[nodiscard]] VectorXd start() const {
    VectorXd x(static_cast<Index>(unknowns_.size()));
    for (std::size_t i = 0; i < unknowns_.size(); ++i)
      x[static_cast<Index>(i)] = unknowns_[i].start / steps_[i];
    return x;
  }
  [[nodiscard]] double step(std::size_t i) const { return steps_[i]; }
  [[nodiscard]] bool is_never_zero(std::size_t i) const { return unknowns_[i].never_zero; }
  [[nodiscard]] const std::vector<Index>& sizes() const { return sizes_; }
  [[nodiscard]] std::size_t runs() const { return runs_; }

 private:
  std::vector<Residuals> ask(const std::vector<std::vector<double>>& sets) {
    runs_ += sets.size();
    return residuals_(sets);
  }
  /// The set with one value a step further, or back where there is no room.
  [[nodiscard]] std::vector<double> moved(std::vector<double> set, std::size_t i, double step) const {
    const double value = set[i];
    const bool back = value + step > unknowns_[i].high;
    set[i] = std::clamp(back ? value - step : value + step, unknowns_[i].low, unknowns_[i].high);
    return set;
  }
  /// Steps that change about wanted_effect, found from a hundredth of each value or of its range.
  void find_steps(const std::vector<double>& start) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const double range = unknowns_[i].high - unknowns_[i].low;
      steps_[i] = start[i] != 0 ? std::abs(start[i]) / 100 : range * 1e-9;
    }
    for (int round = 0; round < 4; ++round) {
      std::vector<std::vector<double>> sets;
      for (std::size_t i = 0; i < unknowns_.size(); ++i) sets.push_back(moved(start, i, steps_[i]));
      const auto found = ask(sets);
      bool settled = true;
      for (std::size_t i = 0; i < unknowns_.size(); ++i) {
        const double effect = found[i].empty() ? 1e3 : (joined(found[i]) - at_start_).norm() / whole_;
        if (effect > wanted_effect / 5 && effect < wanted_effect * 5) continue;
        const double range = unknowns_[i].high - unknowns_[i].low;
        const double most = std::max(std::abs(start[i]) / 3, range / 10);
        const double next =
            std::min(steps_[i] * std::clamp(wanted_effect / std::max(effect, 1e-12), 1e-3, 1e3), most);
        settled = settled && std::abs(next / steps_[i] - 1) < 0.1;
        steps_[i] = next;
      }
      if (settled) return;
    }
  }

  const std::vector<FitUnknown>& unknowns_;
  const ResidualsOf& residuals_;
  double whole_;
  std::vector<double> steps_;
  std::vector<Index> sizes_;
  VectorXd at_start_;
  std::size_t runs_ = 0;
};

/// Newey and West's sum of the scores' covariances, Bartlett's weights, up to `lags`, blocks apart.
MatrixXd score_covariance(const MatrixXd& slopes, const VectorXd& left, const std::vector<Index>& sizes) {
  constexpr Index tenth = 10;
  MatrixXd sum = MatrixXd::Zero(slopes.cols(), slopes.cols());
  Index at = 0;
  for (const Index size : sizes) {
    const MatrixXd scores =
        (slopes.middleRows(at, size).array().colwise() * left.segment(at, size).array()).matrix();
    sum += scores.transpose() * scores;
    const Index lags = size / tenth;
    for (Index lag = 1; lag <= lags; ++lag) {
      const double weight = 1 - static_cast<double>(lag) / static_cast<double>(lags + 1);
      const MatrixXd with = scores.bottomRows(size - lag).transpose() * scores.topRows(size - lag);
      sum += weight * (with + with.transpose());
    }
    at += size;
  }
  return sum;
}

/// The 97.5 % quantile that goes with lags up to a tenth of the data (Kiefer and Vogelsang 2005, table 1).
constexpr double quantile = 1.9659 + 2.9694 * 0.1 + 0.4160 * 0.01 - 0.5324 * 0.001;

/// The singular values and columns of the slopes' unit columns.
struct UnitColumns {
  VectorXd norms;
  VectorXd values;
  MatrixXd of;  ///< a column a singular value

  explicit UnitColumns(const MatrixXd& slopes) : norms(slopes.colwise().norm()) {
    MatrixXd unit = slopes;
    for (Index i = 0; i < unit.cols(); ++i)
      if (norms[i] > 0) unit.col(i) /= norms[i];
    const Eigen::JacobiSVD<MatrixXd> svd(unit, Eigen::ComputeThinV | Eigen::ComputeThinU);
    values = svd.singularValues();
    of = svd.matrixV();
  }
  [[nodiscard]] bool tells(Index k) const { return values[k] * most_condition >= values[0]; }
  /// The inverse of the normal matrix, without the columns that nothing tells.
  [[nodiscard]] MatrixXd inverse() const {
    MatrixXd sum = MatrixXd::Zero(norms.size(), norms.size());
    for (Index k = 0; k < values.size(); ++k)
      if (tells(k)) sum += of.col(k) * of.col(k).transpose() / (values[k] * values[k]);
    for (Index i = 0; i < norms.size(); ++i) {
      const double scale = norms[i] > 0 ? 1 / norms[i] : 0;
      sum.row(i) *= scale;
      sum.col(i) *= scale;
    }
    return sum;
  }
};

void judge(FitSolution& solution, const UnitColumns& columns, const Functor& functor, double whole) {
  auto& estimates = solution.estimates;
  for (Index k = 0; k < columns.values.size(); ++k) {
    if (columns.tells(k)) continue;
    std::vector<std::size_t> of;
    for (Index i = 0; i < columns.norms.size(); ++i)
      if (std::abs(columns.of(i, k)) >= least_part) of.push_back(static_cast<std::size_t>(i));
    for (const auto one : of) {
      estimates[one].known = of.size() > 1 ? FitKnown::joined : FitKnown::no;
      for (const auto other : of)
        if (other != one && std::ranges::find(estimates[one].with, other) == estimates[one].with.end())
          estimates[one].with.push_back(other);
    }
  }
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    auto& one = estimates[i];
    if (one.known != FitKnown::yes) continue;
    const double half = (one.high - one.low) / 2;
    const double effect = half / functor.step(i) * columns.norms[static_cast<Index>(i)] / whole;
    const double norm = columns.norms[static_cast<Index>(i)];
    const double all_of_it = std::abs(one.value) / functor.step(i) * norm / whole;
    const bool moves = norm > 1e-9 * whole && !(functor.is_never_zero(i) && all_of_it < least_whole_effect);
    const bool is_wide = half > known_within * std::abs(one.value);
    if (!moves || (is_wide && (functor.is_never_zero(i) || effect > least_effect))) one.known = FitKnown::no;
  }
}

/// Of unknowns none of which is held.
FitSolution solve_free(const std::vector<FitUnknown>& unknowns, const ResidualsOf& residuals, double whole,
                       int most_trials) {
  Functor functor(unknowns, residuals, whole);
  VectorXd x = functor.start();
  Eigen::LevenbergMarquardt<Functor> search(functor);
  search.parameters.factor = 100;
  search.parameters.ftol = 1e-7;
  search.parameters.xtol = 1e-5;
  search.parameters.maxfev = most_trials;
  (void)search.minimize(x);

  VectorXd left(functor.values());
  MatrixXd slopes(functor.values(), functor.inputs());
  (void)functor(x, left);
  (void)functor.df(x, slopes);
  const UnitColumns columns(slopes);
  const MatrixXd inverse = columns.inverse();
  const MatrixXd covariance = inverse * score_covariance(slopes, left, functor.sizes()) * inverse;

  FitSolution solution;
  solution.norm = left.norm();
  const double least = columns.values[columns.values.size() - 1];
  solution.condition = least > 0 ? columns.values[0] / least : std::numeric_limits<double>::infinity();
  const auto values = functor.values_of(x);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto at = static_cast<Index>(i);
    const double bent = columns.norms[at] > 0 ? least_half * whole / columns.norms[at] : 0;
    const double half =
        std::hypot(quantile * std::sqrt(std::max(covariance(at, at), 0.0)), bent) * functor.step(i);
    solution.estimates.push_back({values[i], values[i] - half, values[i] + half});
  }
  judge(solution, columns, functor, whole);

  // What each recording alone says, by one step from where they meet.
  Index from = 0;
  for (const Index size : functor.sizes()) {
    const UnitColumns own(slopes.middleRows(from, size));
    const VectorXd step =
        -own.inverse() * slopes.middleRows(from, size).transpose() * left.segment(from, size);
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      solution.estimates[i].alone.push_back(values[i] + step[static_cast<Index>(i)] * functor.step(i));
    from += size;
  }
  solution.runs = functor.runs();
  return solution;
}

}  // namespace

FitSolution solve_fit(const std::vector<FitUnknown>& unknowns, const ResidualsOf& residuals, double whole,
                      int most_trials) {
  std::vector<std::size_t> numbers;  // of the free ones
  std::vector<FitUnknown> free;
  std::vector<double> held;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    held.push_back(unknowns[i].low);
    if (unknowns[i].is_held()) continue;
    numbers.push_back(i);
    free.push_back(unknowns[i]);
  }
  const auto residuals_of_free = [&](const std::vector<std::vector<double>>& sets) {
    std::vector<std::vector<double>> whole_sets(sets.size(), held);
    for (std::size_t k = 0; k < sets.size(); ++k)
      for (std::size_t i = 0; i < numbers.size(); ++i) whole_sets[k][numbers[i]] = sets[k][i];
    return residuals(whole_sets);
  };
  FitSolution found;
  if (free.empty()) {
    const auto blocks = residuals({held});
    if (blocks.front().empty()) throw std::runtime_error("the values of the scenario give no motion");
    found = {{}, joined(blocks.front()).norm(), 1, 1};
  } else {
    found = solve_free(free, residuals_of_free, whole, most_trials);
  }
  std::vector<FitEstimate> all;
  for (const auto& one : unknowns) all.push_back({one.start, one.start, one.start});
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (auto& with : found.estimates[i].with) with = numbers[with];
    all[numbers[i]] = std::move(found.estimates[i]);
  }
  found.estimates = std::move(all);
  return found;
}

}  // namespace drycut::sim::studies
