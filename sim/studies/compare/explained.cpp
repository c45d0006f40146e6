#include "sim/studies/compare/explained.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {

namespace {

using Values = std::vector<double>;

constexpr std::size_t least_samples = 20;
constexpr double least_share = 0.1;  ///< less is nothing to follow

/// A channel at equal intervals through the filter that its measured values ask for.
class Evenly {
 public:
  explicit Evenly(const MeasuredChannel& channel) : channel_(channel) {
    const recordings::Series measured{channel.name, "", channel.times, channel.measured};
    step_ = sampling_of(measured);
    count_ = static_cast<std::size_t>((channel.times.back() - channel.times.front()) / step_) + 1;
    cutoff_ = bandwidth_of(measured);
  }
  [[nodiscard]] Values operator()(const Values& values) const {
    return smoothed(
        straight({channel_.name, "", channel_.times, values}, channel_.times.front(), step_, count_), step_,
        cutoff_);
  }
  /// By time [1/s].
  [[nodiscard]] Values slope(const Values& even) const {
    Values slopes(even.size());
    for (std::size_t i = 1; i + 1 < even.size(); ++i) slopes[i] = (even[i + 1] - even[i - 1]) / (2 * step_);
    return slopes;
  }
  /// The filter sees no further: values at the ends are not of it alone.
  [[nodiscard]] std::size_t reach() const {
    return std::min(static_cast<std::size_t>(std::ceil(reach_of(cutoff_) / step_)) + 1, count_ / 4);
  }

 private:
  const MeasuredChannel& channel_;
  double step_ = 0;
  double cutoff_ = 0;
  std::size_t count_ = 0;
};

/// What a value would change, a column a part of it: the size of all parts is its amount.
struct Regressor {
  std::string value;
  std::string rows;
  std::string unit;
  std::vector<Values> parts;
};

Values mapped(const Values& values, double (*of)(double)) {
  Values made(values.size());
  std::ranges::transform(values, made.begin(), of);
  return made;
}

std::vector<Regressor> of_torque(const MeasuredChannel& channel, const Evenly& evenly) {
  std::vector<Regressor> terms;
  if (channel.speed && scenario::is_unit(channel.speed->unit)) {
    auto speed = channel.speed->values;
    for (double& value : speed) value = scenario::to_si(value, channel.speed->unit);
    const bool turns = scenario::same_dimension(channel.speed->unit, "rad/s");
    const auto even = evenly(speed);
    terms.push_back(
        {"inertia or mass", "inertia, mass", turns ? "kg m2" : "N m per m/s2", {evenly.slope(even)}});
    terms.push_back({"viscous friction", "*.viscous", turns ? "N m s/rad" : "N m per m/s", {even}});
    const auto ways = directions_of({channel.speed->name, channel.speed->unit, speed});
    terms.push_back({"dry friction", "*.coulomb", "N m", {evenly(Values(ways.begin(), ways.end()))}});
  }
  if (channel.position && scenario::is_unit(channel.position->unit) &&
      scenario::same_dimension(channel.position->unit, "rad")) {
    auto place = channel.position->values;
    for (double& value : place) value = scenario::to_si(value, channel.position->unit);
    terms.push_back({"unbalance",
                     "unbalance, unbalance_angle",
                     "N m",
                     {evenly(mapped(place, [](double x) { return std::sin(x); })),
                      evenly(mapped(place, [](double x) { return std::cos(x); }))}});
  }
  return terms;
}

std::vector<Regressor> terms_of(const MeasuredChannel& channel, const Evenly& evenly) {
  constexpr std::string_view torque = ".motor.torque";
  std::vector<Regressor> terms;
  if (channel.name.ends_with(torque)) terms = of_torque(channel, evenly);
  const auto even = evenly(channel.measured);
  terms.push_back({"zero of the channel", "", channel.unit, {Values(even.size(), 1)}});
  terms.push_back({"scale of the channel", "", "of it", {even}});
  terms.push_back({"delay of the channel", "", "s", {evenly.slope(even)}});
  return terms;
}

}  // namespace

std::vector<Explanation> explain(const MeasuredChannel& channel) {
  std::vector<Explanation> found;
  if (channel.times.size() < least_samples || channel.rms == 0) return found;
  const Evenly evenly(channel);
  const auto residual = evenly(channel.residual);
  const auto skip = static_cast<Eigen::Index>(evenly.reach());
  const auto inner = [&](const Values& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values))
        .segment(skip, std::ssize(values) - 2 * skip);
  };
  const Eigen::VectorXd left = inner(residual);
  if (left.norm() == 0) return found;
  for (const auto& term : terms_of(channel, evenly)) {
    Eigen::MatrixXd parts(left.size(), std::ssize(term.parts));
    for (Eigen::Index i = 0; i < parts.cols(); ++i)
      parts.col(i) = inner(term.parts[static_cast<std::size_t>(i)]);
    if (parts.norm() == 0) continue;
    const Eigen::VectorXd amounts = parts.colPivHouseholderQr().solve(left);
    const double share = 1 - (left - parts * amounts).norm() / left.norm();
    const double amount = amounts.size() == 1 ? amounts[0] : amounts.norm();
    found.push_back({channel.name, term.value, term.rows, amount, term.unit, share});
  }
  std::ranges::stable_sort(found, std::greater(), &Explanation::share);
  return found;
}

Table explained_table(const MeasuredRun& measured) {
  Table table({{"channel", "channel"},
               {"value", "what one value alone would explain"},
               {"share", "of the residual (rms)", "%", 4},
               {"amount", "the run has more of it", "", 4},
               {"unit", "unit"},
               {"vary", "fit --vary"}});
  constexpr double percent = 100;
  for (const auto& channel : measured.channels)
    for (const auto& one : explain(channel)) {
      if (one.share < least_share) break;
      table.add({one.channel, one.value, one.share * percent, one.amount, one.unit.empty() ? "-" : one.unit,
                 one.rows});
    }
  return table;
}

}  // namespace drycut::sim::studies
