#include "sim/loop/watch.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

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
  const auto odd = std::ranges::find_if(slots_, [](double number) { return !std::isfinite(number); });
  return odd == slots_.end() ? "" : readings_[static_cast<std::size_t>(odd - slots_.begin())].name;
}

bool Watch::record(const std::string& name, record::Recording& recording) {
  if (recording.column(name) != nullptr) return true;
  const auto* from = slot(name);
  if (from == nullptr) return false;
  recording.add(name, unit(name)).slot = from;
  return true;
}

void Watch::show(const double* slot, double number) {
  for (auto& own : slots_)
    if (&own == slot) own = number;
}

// Whose pictures are not drawn looks at less.
void Watch::visit(StateArchive& archive) {
  std::vector<double> numbers(slots_.begin(), slots_.end());
  STATE(archive, numbers);
  if (!archive.restores()) return;
  if (numbers.size() == slots_.size())
    std::ranges::copy(numbers, slots_.begin());
  else
    update();
}

}  // namespace drycut::sim::loop
