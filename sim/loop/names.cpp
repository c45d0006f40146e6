#include "sim/loop/names.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>
#include <variant>

#include "base/text.hpp"
#include "devices/plcopen/terminals.hpp"
#include "sim/loop/bus.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::string_view panel_prefix = "panel.";
constexpr std::string_view wire_prefix = "wire.";

// A live parameter as what the timeline sets.
plants::Setting setting_of(plants::Plant* plant, const plants::Parameter& row) {
  auto* value = std::get<double*>(row.value);
  return {row.name,
          row.unit,
          [plant, value](double si) {
            *value = si;
            plant->parameters_changed();
          },
          [value] { return *value; },
          std::string(row.meaning),
          {row.min, row.max, false}};
}

}  // namespace

devices::ValueRange range_of(const plants::Range& range) { return {range.min, range.max, range.whole}; }

// As it is written: controllers find their names in any case, but `knife.angle` beside `Knife.posit` are two.
void refuse_shared_names(const scenario::Scenario& scenario, devices::Controller& controller,
                         Problems& problems) {
  std::set<std::string> taken;
  for (const auto& name : controller.names()) taken.insert(name.substr(0, name.find_first_of(".:[")));
  for (const auto& plant : scenario.plants) {
    const auto& name = plant.name.text;
    const auto value = controller.find(name);
    if (!taken.contains(name) && (!value || value->name != name)) continue;
    problems.push_back(
        scenario::problem_at("controller.twice"_code, scenario, plant.name.place,
                             fmt::format("plants.{0}: the controller has {0} too", name),
                             "give the plant a name of its own, or another spelling: knife and Knife"));
  }
}

Names::Names(const std::vector<NamedPlant>& plants, devices::Controller* controller, OperatorPanel& panel)
    : controller_(controller), panel_(panel) {
  for (const auto& [name, plant] : plants) {
    for (auto& channel : plant->channels()) channels_.emplace(name + "." + channel.name, channel);
    for (auto& setting : plant->settings()) settings_.emplace(name + "." + setting.name, setting);
    for (const auto& row : plant->live_parameters())
      settings_.emplace(name + "." + row.name, setting_of(plant, row));
    for (auto& fault : plant->faults()) {
      const auto component = name + "." + fault.component;
      fault_index_.emplace(std::pair(component, fault.name), faults_.size());
      faults_.emplace_back(component, fault);
    }
    plant_names_.insert(name);
  }
}

void Names::assume_controller(const std::vector<scenario::Wire>& wiring) {
  assumed_ = true;
  for (const auto& [terminal, plug] : wiring) {
    if (!plug.text.starts_with(panel_prefix)) continue;
    const auto name = plug.text.substr(panel_prefix.size());
    auto address = devices::parse_address(terminal.text);
    if (!address) address = devices::parse_base_terminal(terminal.text);
    if (const auto other = devices::plcopen::parse_terminal(terminal.text); other && !address)
      address = other->terminal != nullptr ? other->terminal->address(0) : other->address;
    const bool lamp = address && address->kind == devices::Kind::output;
    // What is wrong with a terminal is told once there is a controller to ask.
    if (lamp)
      panel_.lamps[name];
    else
      panel_.switches[name];
  }
}

bool Names::of_controller(const std::string& name) const {
  const auto plant = name.substr(0, name.find('.'));
  return plant != "panel" && !plant_names_.contains(plant);
}

std::optional<Reading> Names::reading(const std::string& name) {
  if (const auto found = channels_.find(name); found != channels_.end()) {
    return Reading{name, found->second.unit, found->second.read, found->second.meaning};
  }
  if (assumed_ && of_controller(name)) return Reading{name, "", [] { return 0.0; }};
  if (name.starts_with(panel_prefix)) {
    const auto plug = name.substr(panel_prefix.size());
    if (const auto found = panel_.switches.find(plug); found != panel_.switches.end()) {
      return Reading{name, "", [port = &found->second] { return port->level ? 1.0 : 0.0; },
                     "switch of the panel"};
    }
    if (const auto found = panel_.lamps.find(plug); found != panel_.lamps.end()) {
      return Reading{name, "", [port = &found->second] { return port->level ? 1.0 : 0.0; },
                     "lamp of the panel"};
    }
    return {};
  }
  if (controller_ != nullptr) {
    if (auto value = controller_->find(name))
      return Reading{name, value->unit, value->read, std::string(value->meaning)};
  }
  return {};
}

std::optional<Target> Names::target(const std::string& name) {
  if (const auto found = settings_.find(name); found != settings_.end()) {
    const auto& setting = found->second;
    return Target{name, std::string(setting.unit), setting.read, setting.write, range_of(setting.range)};
  }
  if (assumed_ && of_controller(name)) return Target{name, "", [] { return 0.0; }, [](double) {}};
  if (name.starts_with(panel_prefix)) {
    const auto plug = name.substr(panel_prefix.size());
    if (!panel_.switches.contains(plug)) return {};
    return Target{name, "", [this, plug] { return panel_.switches.at(plug).level ? 1.0 : 0.0; },
                  [this, plug](double on) { panel_.set(plug, on != 0); }, range_of(plants::Range{})};
  }
  if (controller_ != nullptr) {
    if (auto value = controller_->find(name); value && value->write)
      return Target{name, "", value->read, value->write, value->range};
  }
  return {};
}

std::optional<plants::Fault> Names::fault(const std::string& component, const std::string& fault) {
  const auto found = fault_index_.find({component, fault});
  if (found != fault_index_.end()) return faults_[found->second].second;
  for (const auto& [name, of_wire] : of_wires_)
    if (name == component && of_wire.name == fault) return of_wire;
  if (assumed_ && component.starts_with(wire_prefix) && fault == "cut")
    return plants::Fault{component, fault, "", [](double) {}, ""};
  return {};
}

plants::Fault* Names::fault_called(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return nullptr;
  const auto found = fault_index_.find({name.substr(0, dot), name.substr(dot + 1)});
  return found == fault_index_.end() ? nullptr : &faults_[found->second].second;
}

std::optional<Target> Names::disturbed(const std::string& name) {
  if (settings_.contains(name)) return target(name);
  const auto* found = fault_called(name);
  if (found == nullptr) return {};
  auto without = found->without ? found->without : [] { return 0.0; };
  return Target{name, std::string(found->unit), std::move(without), found->act, range_of(found->range)};
}

void Names::stand_in(const std::string& name, StandIn in_place) {
  if (const auto found = settings_.find(name); found != settings_.end()) {
    found->second.write = std::move(in_place.write);
    found->second.read = std::move(in_place.read);
  } else if (auto* fault = fault_called(name)) {
    fault->act = std::move(in_place.write);
  }
}

std::vector<std::string> Names::reading_names() const {
  std::vector<std::string> names;
  for (const auto& [name, channel] : channels_) names.push_back(name);
  for (const auto& [name, port] : panel_.switches) names.push_back(std::string(panel_prefix) + name);
  for (const auto& [name, port] : panel_.lamps) names.push_back(std::string(panel_prefix) + name);
  if (controller_ != nullptr) {
    for (auto& name : controller_->names()) names.push_back(name);
  }
  return names;
}

std::vector<std::string> Names::setting_names() const {
  std::vector<std::string> names;
  for (const auto& [name, port] : panel_.switches) names.push_back(std::string(panel_prefix) + name);
  for (const auto& [name, setting] : settings_) names.push_back(name);
  return names;
}

std::vector<std::string> Names::lamp_names() const {
  std::vector<std::string> names;
  for (const auto& [name, port] : panel_.lamps) names.push_back(std::string(panel_prefix) + name);
  return names;
}

std::string Names::suggest_reading(const std::string& name) const {
  constexpr auto* where_names_are =
      "name a plant's channel (drycut plants), a device variable or state (drycut devices) or a "
      "variable of the program";
  if (++suggestions_ > most_suggestions) return where_names_are;
  std::vector<std::string> own;  // of the same plant, if the plant is right
  const auto plant = name.substr(0, name.find('.') + 1);
  for (const auto& [full, channel] : channels_) {
    if (!plant.empty() && full.starts_with(plant)) own.push_back(full);
  }
  if (!own.empty()) {
    std::string all;
    for (const auto& full : own) all += (all.empty() ? "" : ", ") + full;
    return did_you_mean(name, own, "it has: " + all);
  }
  return did_you_mean(name, reading_names(), where_names_are);
}

std::string Names::suggest_target(const std::string& name) const {
  constexpr auto* where_names_are =
      "name a plant's setting (drycut plants), a wired panel switch or a controller value";
  if (++suggestions_ > most_suggestions) return where_names_are;
  std::vector<std::string> names;
  for (const auto& [full, setting] : settings_) names.push_back(full);
  for (const auto& [plug, port] : panel_.switches) names.push_back(std::string(panel_prefix) + plug);
  if (name.starts_with(panel_prefix)) {
    std::string switches;
    names.clear();
    for (const auto& [plug, port] : panel_.switches) {
      names.push_back(plug);
      switches += fmt::format("{} panel.{}", switches.empty() ? "; switches:" : ",", plug);
    }
    const auto near = nearest(name.substr(panel_prefix.size()), names);
    if (!near.empty()) return fmt::format("did you mean {}{}?", panel_prefix, near);
    return fmt::format("wire an input to {} first{}", name, switches);
  }
  if (channels_.contains(name)) return "it can only be read; settings are listed by drycut plants";
  if (controller_ != nullptr) {
    for (auto& other : controller_->names()) names.push_back(other);
  }
  return did_you_mean(name, names, where_names_are);
}

std::string Names::suggest_fault(const std::string& component) const {
  if (++suggestions_ > most_suggestions) return "drycut plants lists the faults of components";
  std::vector<std::string> components;
  std::set<std::string> seen;
  std::string offered;
  if (component.starts_with(wire_prefix)) {
    for (const auto& [name, fault] : of_wires_) {
      if (name == component) return fmt::format("{} offers: {}", component, fault.name);
      components.push_back(name);
    }
    return did_you_mean(component, components, "a wire is called by its terminal: wire.2.INP01");
  }
  for (const auto& [name, candidate] : faults_) {
    if (seen.insert(name).second) components.push_back(name);
    if (name == component) offered += (offered.empty() ? "" : ", ") + candidate.name;
  }
  if (!offered.empty()) return fmt::format("{} offers: {}", component, offered);
  std::string all;
  for (const auto& name : components) all += (all.empty() ? "" : ", ") + name;
  return did_you_mean(component, components,
                      all.empty() ? "no plant here offers faults" : "components with faults: " + all);
}

std::string Names::suggest_disturbed(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& [full, setting] : settings_)
    if (!setting.range.whole) names.push_back(full);
  for (const auto& [component, fault] : faults_)
    if (!fault.range.whole) names.push_back(component + "." + fault.name);
  return did_you_mean(name, names,
                      "name a plant's setting, live parameter or component.fault: drycut plants lists them");
}

}  // namespace drycut::sim::loop
