#include "sim/live/line_view.hpp"

#include <fmt/format.h>

#include "sim/scenario/units.hpp"

namespace drycut::sim::live {

LineView::LineView(const scenario::Scenario& scenario, Problems& problems)
    : simulation_(std::make_unique<loop::Simulation>(scenario, problems)) {
  if (!problems.empty()) return;
  simulation_->keep_nothing();
  simulation_->add(*this);
  for (const auto& [name, plant] : simulation_->plants())
    for (auto& part : plant->parts()) shown_.push_back(std::move(part));
  auto& names = simulation_->names();
  for (const auto& name : names.setting_names())
    if (auto target = names.target(name)) targets_.push_back(std::move(*target));
  for (const auto& name : names.lamp_names())
    if (auto lamp = names.reading(name)) lamps_.push_back(std::move(*lamp));
}

void LineView::sample(Time time) {
  for (auto* observer : to_) observer->sample(time);
}

void LineView::happened(const record::RecordedEvent& event) {
  for (auto* observer : to_) observer->happened(event);
}

const std::function<double()>* LineView::known(const std::string& name) {
  auto found = known_.find(name);
  if (found == known_.end()) {
    const auto reading = simulation_->names().reading(name);
    if (!reading) return nullptr;
    found = known_.emplace(name, reading->read).first;
  }
  return &found->second;
}

Problems LineView::values_of(const std::vector<std::string>& names, std::vector<double>& values) {
  constexpr std::size_t most_slips = 16;  // are told
  Problems problems;
  for (const auto& name : names) {
    if (const auto* read = known(name)) {
      values.push_back((*read)());
      continue;
    }
    problems.push_back({"scenario.unknown-name"_code, "read", 1, 1,
                        fmt::format("there is no channel '{}'", name),
                        simulation_->names().suggest_reading(name)});
    if (problems.size() >= most_slips) break;
  }
  if (!problems.empty()) values.clear();
  return problems;
}

void LineView::look(Sight& sight) const {
  sight.poses.reserve(shown_.size());
  for (const auto& part : shown_) sight.poses.push_back(part.now());
  for (const auto& target : targets_) sight.values.push_back(scenario::from_si(target.read(), target.unit));
  for (const auto& lamp : lamps_) sight.lamps.push_back(lamp.read());
}

void LineView::watch_programs(bool on) {
  if (on == watches_ || simulation_->controller() == nullptr) return;
  simulation_->controller()->watch_programs(on);
  watches_ = on;
}

}  // namespace drycut::sim::live
