#include "sim/studies/why/announced.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "sim/loop/known_events.hpp"
#include "sim/scenario/expression.hpp"

namespace drycut::sim::studies {

namespace {

/// A name of a check's expression: a channel, or a value of its event.
struct NamedSlot {
  std::string name;
  std::string unit;
  double number = 0;
  const record::Recording::Column* column = nullptr;
};

class RoomReader {
 public:
  RoomReader(const scenario::CheckRequest& check, const scenario::Scenario& scenario,
             const record::Recording& recording)
      : check_(check), recording_(recording) {
    if (!check.event.text.empty()) read_event();
    Problems unreadable;  // it was read when the run was; what was not recorded has no room
    expression_ = scenario::Expression::compile(
        check.expression, scenario, [&](const std::string& name) { return operand(name); }, {}, unreadable);
  }

  RoomOverTime over_instants() {
    RoomOverTime room;
    const auto& times = recording_.times();
    for (std::size_t i = 0; i < times.size(); ++i) add(room, seconds(times[i]), i);
    return room;
  }

  RoomOverTime over_events() {
    RoomOverTime room;
    const auto& times = recording_.times();
    std::size_t row = 0;
    for (const auto& event : recording_.events()) {
      while (row + 1 < times.size() && times[row + 1] <= event.time) ++row;
      if (!loop::names_event(check_.event.text, event.source, event.event)) continue;
      for (auto& slot : slots_)
        if (const auto* value = event.find(slot.name); value != nullptr && slot.column == nullptr)
          slot.number = value->number;
      add(room, event.at_seconds(), row);
    }
    return room;
  }

 private:
  void read_event() {
    for (const auto& event : recording_.events()) {
      if (!loop::names_event(check_.event.text, event.source, event.event)) continue;
      for (const auto& value : event.values) slots_.push_back({value.name, value.unit});
      return;
    }
  }

  scenario::Expression::Operand operand(const std::string& name) {
    for (const auto& slot : slots_)
      if (slot.name == name) return {&slot.number, slot.unit};
    const auto* column = recording_.column(name);
    if (column == nullptr) return {nullptr};
    slots_.push_back({name, column->unit, 0, column});
    return {&slots_.back().number, column->unit};
  }

  void add(RoomOverTime& room, double at, std::size_t row) {
    if (!expression_ || at < seconds(check_.from) || (check_.until && at > seconds(*check_.until))) return;
    for (auto& slot : slots_)
      if (slot.column != nullptr && row < slot.column->values.size()) slot.number = slot.column->values[row];
    if (const auto left = expression_->evaluate().margin) room.emplace_back(at, *left);
  }

  const scenario::CheckRequest& check_;
  const record::Recording& recording_;
  std::deque<NamedSlot> slots_;
  std::optional<scenario::Expression> expression_;
};

}  // namespace

RoomOverTime room_over_time(const scenario::Scenario& scenario, const std::string& name,
                            const record::Recording& recording) {
  const auto check =
      std::ranges::find_if(scenario.checks, [&](const auto& one) { return one.name.text == name; });
  if (check == scenario.checks.end()) return {};
  RoomReader reader(*check, scenario, recording);
  if (check->kind == scenario::CheckRequest::Kind::always) return reader.over_instants();
  if (check->kind == scenario::CheckRequest::Kind::each) return reader.over_events();
  return {};
}

std::optional<Slide> slide_of(const RoomOverTime& room) {
  const auto failed = std::ranges::find_if(room, [](const auto& point) { return point.second < 0; });
  if (failed == room.begin() || failed == room.end()) return {};
  double most = 0;
  for (auto point = room.begin(); point != failed; ++point) most = std::max(most, point->second);
  const double ripple = 0.01 * most;  // so little more room on the way down is none
  auto begin = failed - 1;
  while (begin != room.begin() && (begin - 1)->second >= begin->second - ripple) {
    if ((begin - 1)->second <= begin->second && most - begin->second <= ripple) break;  // it still stands
    --begin;
  }
  return Slide{begin->first, begin->second, failed->first};
}

loop::Signs signs_of(const record::Recording& recording) {
  loop::Signs signs;
  for (const auto& event : recording.events()) signs.take(event);
  return signs;
}

std::optional<Parting> first_parting(const record::Recording& good, const record::Recording& failed) {
  std::optional<Parting> first;
  double first_share = 0;
  const auto rows = std::min(good.times().size(), failed.times().size());
  for (const auto& column : good.columns()) {
    const auto* other = failed.column(column.name);
    if (other == nullptr || other->unit != column.unit || column.values.empty()) continue;
    const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
    // A channel that stands may part by anything but the noise of numbers.
    const double range = std::max(*high - *low, 1e-6 * std::max(std::abs(*high), std::abs(*low)));
    for (std::size_t i = 0; i < rows && good.times()[i] == failed.times()[i]; ++i) {
      const double at = seconds(good.times()[i]);
      if (first && at > first->at) break;
      const double apart = std::abs(column.values[i] - other->values[i]);
      if (!(apart > parted * range) || apart == 0) continue;
      const double share = range > 0 ? apart / range : 1;
      if (first && at == first->at && share <= first_share) break;
      first = Parting{column.name, column.unit, at, column.values[i], other->values[i]};
      first_share = share;
      break;
    }
  }
  return first;
}

}  // namespace drycut::sim::studies
