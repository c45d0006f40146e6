#include "sim/loop/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "sim/loop/known_events.hpp"

namespace drycut::sim::loop {

EventNumbers event_numbers(const record::EventLog& events, const std::string& event, const std::string& value,
                           double from, double until) {
  EventNumbers found;
  double order = 0;
  for (const auto& happened : events) {
    if (!names_event(event, happened.source, happened.event)) continue;
    ++order;
    const auto* of = happened.find(value);
    if (of == nullptr) continue;
    found.unit = of->unit;
    const double at = happened.at_seconds();
    if (at < from || at > until) continue;
    found.times.push_back(at);
    found.order.push_back(order);
    found.numbers.push_back(of->number);
  }
  return found;
}

std::array<double, 6> statistics(const std::vector<double>& numbers) {
  if (numbers.empty()) return {};
  const auto count = static_cast<double>(numbers.size());
  double sum = 0;
  for (const double number : numbers) sum += number;
  const double mean = sum / count;
  const double middle = (count - 1) / 2;
  double squares = 0;
  double cross = 0;
  double index_squares = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double away = numbers[i] - mean;
    const double index = static_cast<double>(i) - middle;
    squares += away * away;
    cross += index * away;
    index_squares += index * index;
  }
  const double sd = count > 1 ? std::sqrt(squares / (count - 1)) : 0;
  const double slope = count > 1 ? cross / index_squares : 0;
  const double residual = std::max(0.0, squares - slope * cross);
  const double slope_error = count > 2 ? std::sqrt(residual / (count - 2) / index_squares) : 0;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  return {mean, *low, *high, sd, slope, slope_error};
}

std::optional<Capability> capability(const std::array<double, 6>& statistics, double low, double high) {
  const double mean = statistics[0];
  const double sd = statistics[3];
  if (sd <= 1e-12 * std::abs(mean)) return {};
  return Capability{(high - low) / (6 * sd), std::min(high - mean, mean - low) / (3 * sd)};
}

}  // namespace drycut::sim::loop
