#include "sim/studies/design/ramps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drycut::sim::studies {

namespace {

constexpr double nearly_best = 1.001;

/// Of a ramp between two speeds.
RampCost cost_of(double length, double from, double to, const RampAims& aims) {
  RampCost cost;
  const double change = std::abs(to - from);
  const double slope = change / length;
  cost.peak = (aims.cycloidal ? 2 : 1) * slope;
  cost.jerk = aims.cycloidal ? 2 * std::numbers::pi * slope / length : 0;
  cost.sum = (aims.cycloidal ? 1.5 : 1) * slope * slope * length;
  const auto friction = [&](double ratio) {
    const double force = aims.friction.viscous * std::abs(ratio) + (ratio != 0 ? aims.friction.coulomb : 0);
    return force * force;
  };
  cost.sum += length / 6 * (friction(from) + 4 * friction((from + to) / 2) + friction(to));
  constexpr double rounding = 1 + 1e-9;
  const double ratio = std::max(std::abs(from), std::abs(to));
  cost.allowed = (aims.most_ratio == 0 || ratio <= aims.most_ratio * rounding) &&
                 (aims.most_gradient == 0 || cost.peak <= aims.most_gradient * rounding);
  return cost;
}

/// Keeps the best of what it is shown; of those nearly as good that with the fewest sectors.
template <typename Made>
class Best {
 public:
  explicit Best(MoveGoal goal) : goal_(goal) {}
  void take(Made made, std::size_t sectors) {
    const double cost = made.cost.of(goal_);
    if (!made.cost.allowed) return;
    auto& best = by_sectors_[std::min(sectors, by_sectors_.size() - 1)];
    if (!best || cost < best->cost.of(goal_)) best = std::move(made);
  }
  std::optional<Made> found() const {
    double least = 0;
    bool any = false;
    for (const auto& made : by_sectors_) {
      if (!made) continue;
      least = any ? std::min(least, made->cost.of(goal_)) : made->cost.of(goal_);
      any = true;
    }
    for (const auto& made : by_sectors_)
      if (made && made->cost.of(goal_) <= nearly_best * least) return made;
    return {};
  }

 private:
  MoveGoal goal_;
  std::vector<std::optional<Made>> by_sectors_ = std::vector<std::optional<Made>>(256);
};

/// Whole multiples of 2/q nearest to speeds; all of them a little more or less by `bias`.
int multiple(double speed, int q, double bias) { return static_cast<int>(std::lround(speed * q / 2 + bias)); }

/// Biases of rounding, the least first: what is rounded off in sum is different for each.
constexpr double biases[] = {0, 0.15, -0.15, 0.3, -0.3, 0.45, -0.45};

class OutAndBack {
 public:
  OutAndBack(int master, int slave, int rest, const WantedSpeed& wanted, const RampAims& aims)
      : master_(master), slave_(slave), rest_(rest), wanted_(wanted), aims_(aims), best_(aims.goal) {}

  std::optional<Ramps> run() {
    if (aims_.no_reverse && slave_ < 0) return {};
    if (slave_ == rest_ * master_) return Ramps{{{master_, slave_}}, {}};
    take(0, 0, 0);
    const int most = aims_.cycloidal ? 1 : std::min(aims_.most_ramps, (aims_.most_sectors - 1) / 2);
    for (int count = std::min(most, aims_.least_ramps); count <= most; ++count)
      for (const int q : lengths(count))
        for (const double bias : biases) take(count, q, bias);
    return best_.found();
  }

 private:
  /// Even lengths: so many ramps to the middle, or to where the wanted speed stays for a while.
  [[nodiscard]] std::vector<int> lengths(int count) const {
    std::vector<int> found;
    const double to_middle = static_cast<double>(master_) / (2 * count + 2);
    for (const double wanted : {to_middle, flat_ * master_ / count})
      for (int away = -4; away <= 4; ++away) {
        const int q = 2 * (static_cast<int>(wanted / 2) + away);
        const int left = master_ - 2 * count * q;
        if (q < aims_.shortest || q < 2 || left < 2 * aims_.shortest) continue;
        if (std::find(found.begin(), found.end(), q) == found.end()) found.push_back(q);
      }
    return found;
  }

  /// The part of the way after which the wanted speed hardly changes up to the middle.
  [[nodiscard]] double first_flat() const {
    constexpr int places = 400;
    const double middle = wanted_(0.5);
    const double change = std::abs(middle - rest_);
    for (int i = 1; i < places; ++i) {
      const double part = 0.5 * i / places;
      if (std::abs(wanted_(part) - middle) < 2e-3 * change) return part;
    }
    return 0.5;
  }

  void take(int count, int q, double bias) {
    const int left = master_ - 2 * count * q;
    const double middle = wanted_(0.5);
    std::vector<double> speeds = {static_cast<double>(rest_)};
    for (int i = 1; i <= count; ++i) speeds.push_back(wanted_(static_cast<double>(i) * q / master_));
    // As chords take less way than what they are chords of, all speeds are raised to make it.
    const bool flat = std::abs(speeds.back() - middle) < 5e-3 * std::abs(middle - rest_);
    double way = left * (flat ? speeds.back() - rest_ : (speeds.back() + middle) / 2 - rest_);
    for (std::size_t i = 1; i < speeds.size(); ++i) way += q * (speeds[i - 1] + speeds[i] - 2.0 * rest_);
    if (count > 0 && way == 0) return;
    const double raised = count == 0 ? 1 : (slave_ - static_cast<double>(rest_) * master_) / way;
    Ramps made;
    std::vector<int> steps = {rest_ * q / 2};
    int slave = slave_;
    for (int i = 1; i <= count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      steps.push_back(multiple(rest_ + raised * (speeds[k] - rest_), q, bias));
      if (!same_direction(steps[k])) return;
      made.sectors.push_back({q, steps[k - 1] + steps[k]});
      made.cost += cost_of(q, 2.0 * steps[k - 1] / q, 2.0 * steps[k] / q, aims_);
      slave -= 2 * made.sectors.back().slave;
    }
    made.cost += made.cost;
    const double entry = count == 0 ? rest_ : 2.0 * steps.back() / q;
    const double inside = 2.0 * slave / left - entry;
    if (!same_direction(inside)) return;
    const bool constant = count > 0 && static_cast<std::int64_t>(slave) * q ==
                                           2 * static_cast<std::int64_t>(steps.back()) * left;
    made.cost += cost_of(left / 2.0, entry, constant ? entry : inside, aims_);
    made.cost += cost_of(left / 2.0, constant ? entry : inside, entry, aims_);
    const auto back = made.sectors;
    made.sectors.push_back(
        {left, slave, constant ? RampSector::Law::one_ramp : RampSector::Law::there_and_back});
    made.sectors.insert(made.sectors.end(), back.rbegin(), back.rend());
    const auto sectors = made.sectors.size();
    best_.take(std::move(made), sectors);
  }

  /// A speed that turns round inside a sector is a warning of the device.
  [[nodiscard]] bool same_direction(double speed) const {
    return slave_ == 0 ? speed == 0 : slave_ > 0 ? speed >= 0 : speed <= 0;
  }

  int master_;
  int slave_;
  int rest_;
  const WantedSpeed& wanted_;
  const RampAims& aims_;
  Best<Ramps> best_;
  double flat_ = first_flat();
};

}  // namespace

double RampCost::of(MoveGoal goal) const {
  switch (goal) {
    case MoveGoal::peak:
      return peak;
    case MoveGoal::jerk:
      return jerk;
    default:
      return sum;
  }
}

RampCost& RampCost::operator+=(const RampCost& other) {
  sum += other.sum;
  peak = std::max(peak, other.peak);
  jerk = std::max(jerk, other.jerk);
  allowed = allowed && other.allowed;
  return *this;
}

std::optional<Ramps> out_and_back(int master, int slave, int rest, const WantedSpeed& wanted,
                                  const RampAims& aims) {
  return OutAndBack(master, slave, rest, wanted, aims).run();
}

std::optional<TurnRound> turn_round(int master, int slave, double still, const WantedSpeed& wanted,
                                    const RampAims& aims) {
  Best<TurnRound> best(aims.goal);
  const int most = aims.cycloidal ? 1 : std::min(aims.most_ramps / 2, (aims.most_sectors - 3) / 4);
  const auto inner = [&](double part) { return wanted(still + (1 - 2 * still) * part); };
  for (int count = 1; count <= most; ++count) {
    const double length = still * master / count;
    const int spread = aims.cycloidal || count == 1 ? 40 : 4;
    for (int away = -spread; away <= spread; ++away) {
      const double grain = spread > 4 ? std::max(2.0, length / 100) : 2;
      const int q = 2 * static_cast<int>((length + away * grain) / 2);
      const int left = master - 2 * count * q;
      if (q < aims.shortest || q < 2 || left < 2 * aims.shortest) continue;
      for (const double bias : biases) {
        if (count == 1 && bias != 0) break;
        TurnRound turn;
        int before = q / 2;
        int way = 0;
        bool forward = true;
        for (int i = 1; i <= count; ++i) {
          const int step = i == count ? 0 : multiple(wanted(still * i / count), q, bias);
          forward = forward && step >= 0;
          turn.down.push_back({q, before + step});
          turn.cost += cost_of(q, 2.0 * before / q, 2.0 * step / q, aims);
          way += before + step;
          before = step;
        }
        const int rest = slave - 2 * way;
        if (!forward || !turn.cost.allowed || (aims.most_down > 0 && way > aims.most_down)) continue;
        auto narrower = aims;
        narrower.most_sectors = aims.most_sectors - 2 * count;
        const int alike = static_cast<int>(std::lround(count * (0.5 - still) / still));
        narrower.least_ramps = std::max(1, alike - 1);
        narrower.most_ramps = alike + 1;
        turn.cost += turn.cost;
        const auto out = out_and_back(left, rest, 0, inner, narrower);
        if (!out) continue;
        turn.cost += out->cost;
        turn.out = out->sectors;
        const auto sectors = 2 * turn.down.size() + turn.out.size();
        best.take(std::move(turn), sectors);
      }
    }
  }
  return best.found();
}

}  // namespace drycut::sim::studies
