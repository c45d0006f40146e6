#include "sim/loop/watch.hpp"

#include <cmath>

namespace drycut::sim::loop {

const double* Watch::slot(const std::string& name) {
  if (const auto found = index_.find(name); found != index_.end()) return &slots_[found->second];
  auto reading = names_.reading(name);
  if (!reading) return nullptr;
  index_.emplace(name, readings_.size());
  readings_.push_back(std::move(*reading));
  slots_.push_back(readings_.back().read());
  return &slots_.back();
}

scenario::Expression::Operand Watch::operand(const std::string& name) {
  const auto* found = slot(name);
  if (found == nullptr) return nullptr;
  return {found, unit(name)};
}

std::string Watch::not_finite() const {
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    if (!std::isfinite(slots_[i])) return readings_[i].name;
  }
  return "";
}

bool Watch::record(const std::string& name, record::Recording& recording) {
  if (recording.column(name) != nullptr) return true;
  const auto* from = slot(name);
  if (from == nullptr) return false;
  recording.add(name, unit(name)).slot = from;
  return true;
}

}  // namespace drycut::sim::loop
