#include "plants/transducers.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::plants {

PositionSwitch::PositionSwitch(const PositionSwitchData& data, double period, double start)
    : data_(data),
      period_(period),
      distance_(std::abs(offset(start))),
      raw_(distance_ <= data.width / 2),
      filtered_(raw_) {
  port.level = raw_;
}

// The shorter way round, where it goes round.
double PositionSwitch::shorter(double way) const {
  return period_ > 0 && std::abs(way) > period_ / 2 ? way - period_ * std::nearbyint(way / period_) : way;
}

double PositionSwitch::offset(double position) const { return shorter(position - data_.centre); }

void PositionSwitch::sense(double before, double now, double h) {
  port.edges.clear();
  if (before == now && !pending_) return;
  const double way = shorter(now - before);
  const double from = offset(before);
  double rest = 0;
  if (from * (from + way) < 0) {  // over the centre: towards it first, then away
    rest = -from / way;
    move(0, 0, rest, h);
  }
  move(std::abs(offset(now)), rest, 1, h);
  filter(h);
}

void PositionSwitch::follow(double distance, double h) {
  port.edges.clear();
  move(distance, 0, 1, h);
  filter(h);
}

void PositionSwitch::pass(double edge, double was, double begin, double end, double h) {
  const double share = was != distance_ ? std::clamp((edge - was) / (distance_ - was), 0.0, 1.0) : 1.0;
  const double fraction = begin + share * (end - begin);
  if (pending_ && remaining_ <= fraction * h) let_through(h);
  raw_ = !raw_;
  // A change back within the delay leaves the output as it is.
  pending_ = raw_ != filtered_;
  remaining_ = data_.delay + fraction * h;
}

void PositionSwitch::filter(double h) {
  if (!pending_) return;
  if (remaining_ <= h) return let_through(h);
  remaining_ -= h;
}

void PositionSwitch::let_through(double h) {
  pending_ = false;
  filtered_ = raw_;
  show(filtered_, remaining_ / h);
}

void PositionSwitch::show(bool level, double fraction) {
  if (!stuck_) port.show(level && !dead_, fraction);
}

void PositionSwitch::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  faults.push_back({component, "stuck", "",
                    [this](double v) {
                      stuck_ = v != 0;
                      if (!stuck_) port.level = filtered_ && !dead_;
                    },
                    "1: the signal stays as it is now"});
  faults.push_back({component, "dead", "",
                    [this](double v) {
                      dead_ = v != 0;
                      if (!stuck_) port.level = filtered_ && !dead_;
                    },
                    "1: wire broken, the signal is low"});
}

void PositionSwitch::visit(StateArchive& archive) {
  STATE(archive, port, distance_, raw_, filtered_, pending_, remaining_, stuck_, dead_);
}

}  // namespace drycut::plants
