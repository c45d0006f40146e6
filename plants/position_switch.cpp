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

double PositionSwitch::wrapped(double way) const { return way - period_ * std::nearbyint(way / period_); }

// The part of the step until it is at the centre, where it passes that; else nothing.
double PositionSwitch::to_centre(double before, double way, double h) {
  const double from = offset(before);
  if (from * (from + way) >= 0) return 0;
  const double rest = -from / way;
  move(0, 0, rest, h);
  return rest;
}

void PositionSwitch::follow(double distance, double h) {
  port.edges.clear();
  move(distance, 0, 1, h);
  if (pending_) filter(h);
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
