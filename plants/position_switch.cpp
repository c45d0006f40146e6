#include "plants/position_switch.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::plants {

PositionSwitch::PositionSwitch(const PositionSwitchData& data, double period, double start)
    : data_(data),
      period_(period),
      distance_(distance(start)),
      raw_(distance_ <= data.width / 2),
      filtered_(raw_) {
  port.level = raw_;
}

double PositionSwitch::distance(double position) const {
  const double d = position - data_.centre;
  return std::abs(period_ > 0 ? d - period_ * std::nearbyint(d / period_) : d);
}

void PositionSwitch::sense(double before, double now, double h) {
  if (before == now && !pending_) {
    port.edge_count = 0;
    return;
  }
  follow(distance(now), h);
}

void PositionSwitch::follow(double distance, double h) {
  port.edge_count = 0;
  const double was = distance_;
  distance_ = distance;
  const double edge = data_.width / 2 + (raw_ ? data_.hysteresis : 0);
  if ((distance_ <= edge) != raw_) {
    const double fraction = was != distance_ ? std::clamp((edge - was) / (distance_ - was), 0.0, 1.0) : 1.0;
    raw_ = !raw_;
    // A change back within the delay leaves the output as it is.
    pending_ = raw_ != filtered_;
    remaining_ = data_.delay + fraction * h;
  }
  if (!pending_) return;
  if (remaining_ > h) {
    remaining_ -= h;
    return;
  }
  pending_ = false;
  filtered_ = raw_;
  show(filtered_, remaining_ / h);
}

void PositionSwitch::show(bool level, double fraction) {
  if (dead_) level = false;
  if (stuck_ || level == port.level) return;
  port.level = level;
  port.add_edge(level, fraction);
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

}  // namespace drycut::plants
