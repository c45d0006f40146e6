#include "sim/studies/compare/pieces.hpp"

#include <algorithm>
#include <cmath>

#include "sim/loop/known_events.hpp"

namespace drycut::sim::studies {

namespace {

/// `wanted` is "cut" or "knife.cut", `event` always the latter.
bool names(const std::string& wanted, const std::string& event) {
  const auto dot = std::min(event.rfind('.'), event.size() - 1);
  return loop::names_event(wanted, event.substr(0, dot), event.substr(dot + 1));
}

}  // namespace

Window window_of(const ComparedRun& run, const std::string& event, const std::string& value,
                 std::optional<double> from) {
  Window window;
  if (from) {
    window.from = *from;
    return window;
  }
  const Tolerance* stated = nullptr;
  for (const auto& tolerance : run.tolerances) {
    if (!names(tolerance.event, event)) continue;
    if (stated == nullptr || (tolerance.value == value && stated->value != value)) stated = &tolerance;
  }
  if (stated != nullptr) {
    window.from = stated->from;
    window.until = stated->until.value_or(window.until);
  }
  for (const auto& [wanted, begin] : run.starts) {
    if (begin <= 0 || !names(wanted, event)) continue;
    window.from = std::max(window.from, begin);
    break;
  }
  return window;
}

double settled(const ComparedRun& run) {
  double from = 0;
  for (const auto& tolerance : run.tolerances) from = std::max(from, tolerance.from);
  for (const auto& [event, begin] : run.starts) from = std::max(from, begin);
  return from;
}

std::vector<Lot> lots_of(const std::vector<double>& lengths) {
  std::vector<Lot> lots;
  double sum = 0;
  const auto far = [](double length, double from) {
    return std::abs(length - from) > lot_change * std::abs(from);
  };
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const bool other = !lots.empty() && i + 1 < lengths.size() &&
                       far(lengths[i], sum / static_cast<double>(lots.back().count)) &&
                       !far(lengths[i + 1], lengths[i]);
    if (lots.empty() || other) {
      lots.push_back({i, 0});
      sum = 0;
    }
    sum += lengths[i];
    ++lots.back().count;
  }
  return lots;
}

}  // namespace drycut::sim::studies
