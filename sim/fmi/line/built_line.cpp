#include "sim/fmi/line/built_line.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/state_archive.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::fmi {

using Role = FmiVariable::Role;
using Type = FmiVariable::Type;

/// An event as it happened last; without a name any that is an error or damage.
struct BuiltLine::Happening {
  loop::KnownEvent event;
  std::int64_t count = 0;
  double time = 0;
  std::vector<double> values = std::vector<double>(event.values.size());
  [[nodiscard]] bool is(const record::RecordedEvent& other) const {
    if (event.name.empty()) return other.severity >= Severity::error;
    return other.event == event.name && other.source == event.source;
  }
  void visit(StateArchive& archive) { STATE(archive, count, time, values); }
};

/// What an importer has told last, of what the line itself may change, too.
struct BuiltLine::Told {
  double value = 0;
  void visit(StateArchive& archive) { STATE(archive, value); }
};

namespace {

std::string unit_or_none(const std::string& unit) { return scenario::is_unit(unit) ? unit : ""; }

/// As the standard's structured names allow: what is no chain of identifiers stands in quotes, '2.CNT01'.
std::string structured(const std::string& name) {
  bool begins = true;
  bool legal = !name.empty() && name.back() != '.';
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool digit = c >= '0' && c <= '9';
    legal = legal && (letter || (!begins && (digit || c == '.')));
    begins = c == '.';
  }
  return legal ? name : "'" + name + "'";
}

void refuse_misfit(const std::optional<devices::ValueFault>& fault) {
  if (fault) throw Refusal(fmt::format("{}; {}", fault->what, fault->remedy));
}

std::string meaning_of_reading(const std::string& name, const loop::Reading& reading, bool of_controller) {
  if (!reading.meaning.empty()) return reading.meaning;
  if (!of_controller) return "channel of a plant";
  if (name.find_first_of("0123456789") == 0) return "terminal of the controller";
  return name.find('.') == std::string::npos ? "value of the controller's program"
                                             : "value of the controller";
}

bool is_list(const std::string& name) { return name.find('[') != std::string::npos; }

}  // namespace

BuiltLine::~BuiltLine() = default;

BuiltLine::BuiltLine(const CarriedLine& line, const std::vector<scenario::Override>& changed) {
  read(line, changed);
  FmiVariable time{"time", "time", Type::real, Role::time, "s"};
  time.get = [this] { return seconds(simulation_->time()); };
  add(std::move(time));
  add_variables_section();
  add_plants();
  add_inputs();
  add_orders();
  add_controller();
  add_events();
}

void BuiltLine::read(const CarriedLine& line, const std::vector<scenario::Override>& changed) {
  files_.files = line.files;
  files_.folders = line.folders;
  files_.seal();
  const UseFiles use(files_);
  auto set = line.set;
  for (const auto& [path, value] : changed) {
    std::erase_if(set, [&, &same = path](const auto& other) { return other.path == same; });
    set.push_back({path, value});
  }
  Problems problems;
  scenario_ = scenario::read_scenario(line.scenario, set, problems);
  if (problems.empty()) {
    const auto order = [&](const auto& list) {
      for (const auto& [name, value] : list)
        if (std::ranges::find(orders_, name.text) == orders_.end()) orders_.push_back(name.text);
    };
    for (const auto& stimulus : scenario_.timeline) {
      order(stimulus.set);
      order(stimulus.ramp);
    }
    scenario_.timeline.clear();
    scenario_.inputs.clear();
    scenario_.checks.clear();
    scenario_.record.channels.clear();
    scenario_.pictures = {};
    if (scenario_.controller) scenario_.controller->retains = false;
    simulation_ = std::make_unique<loop::Simulation>(scenario_, problems);
  }
  if (!problems.empty()) {
    std::string all;
    for (const auto& problem : problems) all += (all.empty() ? "" : "; ") + to_string(problem);
    throw Refusal(all);
  }
  simulation_->keep_nothing();
  simulation_->add(*this);
  simulation_->begin();
}

void BuiltLine::add_parameter(FmiVariable variable, const std::string& path) {
  const auto place = static_cast<std::uint32_t>(variables().size());
  const LineParameter parameter{path, variable.in_si ? variable.unit : "", variable.type};
  add(std::move(variable));
  if (variables().size() > place) parameters_.emplace(place, parameter);
}

void BuiltLine::add_variables_section() {
  for (const auto& entry : scenario_.variables) {
    FmiVariable variable{"parameters." + entry.name.text, "variable of the scenario", Type::real,
                         Role::parameter};
    if (const auto quantity = scenario::parse_quantity(entry.value.text)) {
      variable.unit = quantity->unit;
      variable.in_si = true;
      const double si =
          quantity->unit.empty() ? quantity->number : scenario::to_si(quantity->number, quantity->unit);
      variable.get = [si] { return si; };
    } else {
      variable.type = Type::word;
      words_.push_back(std::make_unique<std::string>(entry.value.text));
      variable.word = words_.back().get();
      variable.get = [] { return 0.0; };
    }
    variable.set = [](double) {};  // another line is built
    add_parameter(std::move(variable), "variables." + entry.name.text);
  }
}

void BuiltLine::add_plants() {
  auto& names = simulation_->names();
  for (const auto& plant : scenario_.plants) {
    for (const auto& row : plant.definition->parameters()) {
      const bool is_word = std::holds_alternative<std::string*>(row.value);
      if (is_word && (!row.reference.empty() || row.presets != nullptr || row.choices.empty())) continue;
      const auto full = plant.name.text + "." + row.name;
      auto variable = fmi_parameter(full, row);
      variable.set = [](double) {};  // another line is built
      if (const auto live = row.live ? names.target(full) : std::nullopt) {
        live_.insert(full);
        variable.get = live->read;
        variable.set = live->write;
      }
      if (!row.unit.empty()) {
        const double zero = scenario::to_si(0, row.unit);
        units_[std::string(row.unit)] = {scenario::to_si(1, row.unit) - zero, zero};
      }
      add_parameter(std::move(variable), "plants." + full);
    }
  }
}

void BuiltLine::add_inputs() {
  auto& names = simulation_->names();
  const auto add_setting = [&](const std::string& full, const std::string& meaning, const std::string& unit,
                               const devices::ValueRange& range) {
    if (!unit.empty()) {
      const double zero = scenario::to_si(0, unit);
      units_[unit] = {scenario::to_si(1, unit) - zero, zero};
    }
    return fmi_setting(full, meaning, unit, range.low, range.high, range.whole);
  };
  for (const auto& name : names.setting_names()) {
    if (live_.contains(name) || names.is_driven(name)) continue;
    const auto target = names.target(name);
    if (!target) continue;
    const bool panel = name.starts_with("panel.");
    auto variable =
        add_setting(panel ? name : "set." + name, panel ? "switch of the panel" : "what a timeline sets",
                    target->unit, target->range.value_or(devices::ValueRange{}));
    variable.get = target->read;
    variable.set = target->write;
    add(std::move(variable));
  }
  for (const auto& [component, fault] : names.faults()) {
    auto variable = add_setting(fmt::format("fault.{}.{}", component, fault.name),
                                fault.meaning + "; it acts when the value changes", std::string(fault.unit),
                                loop::range_of(fault.range));
    told_.push_back(std::make_unique<Told>(Told{fault.without ? fault.without() : 0}));
    variable.get = [told = told_.back().get()] { return told->value; };
    variable.set = [told = told_.back().get(), act = fault.act](double value) {
      act(value);
      told->value = value;
    };
    add(std::move(variable));
  }
}

// What an operator types in. The program may change it: it acts when what is told changes.
void BuiltLine::add_orders() {
  for (const auto& name : orders_) {
    const auto target = simulation_->names().target(name);
    if (!target || has_variable(name) || has_variable("set." + name) || live_.contains(name)) continue;
    FmiVariable variable{structured("set." + name), "value of the program; it acts when it changes",
                         Type::real, Role::input};
    told_.push_back(std::make_unique<Told>(Told{target->read()}));
    variable.get = [told = told_.back().get()] { return told->value; };
    variable.set = [told = told_.back().get(), name, target = *target](double value) {
      if (value == told->value) return;
      if (target.range) refuse_misfit(devices::misfit(name, *target.range, value, target.unit));
      target.write(value);
      told->value = value;
    };
    add(std::move(variable));
  }
}

void BuiltLine::add_controller() {
  auto& names = simulation_->names();
  auto* const controller = simulation_->controller();
  for (const auto& name : names.reading_names()) {
    if (is_list(name) || has_variable(structured(name))) continue;
    const auto reading = names.reading(name);
    if (!reading) continue;
    const auto value = controller != nullptr ? controller->find(name) : std::nullopt;
    if (value && value->of_table) continue;
    const auto unit = unit_or_none(reading->unit);
    auto meaning = meaning_of_reading(name, *reading, value.has_value());
    if (unit != reading->unit) meaning += fmt::format(" [{}]", reading->unit);
    add(fmi_output(structured(name), meaning, Type::real, unit, reading->read));
    if (!value || !value->write || name.find('.') == std::string::npos || has_variable("set." + name))
      continue;
    FmiVariable variable{
        structured("parameters." + name),
        fmt::format("{}: as it is before the controller's program has run, which may set it, too", meaning),
        Type::real, Role::live_parameter};
    told_.push_back(std::make_unique<Told>(Told{value->read()}));
    variable.get = [told = told_.back().get()] { return told->value; };
    // What it starts with may lie outside of its range, and an importer may give it all starts back.
    variable.set = [told = told_.back().get(), value = *value](double number) {
      if (number == told->value) return;
      refuse_misfit(value.misfit(number));
      value.write(number);
      told->value = number;
    };
    add(std::move(variable));
  }
}

void BuiltLine::add_events() {
  auto known = simulation_->known_events();
  known.push_back({"alarms", "", {}, Severity::error});
  for (const auto& event : known) {
    happenings_.push_back(std::make_unique<Happening>(Happening{event}));
    auto* const last = happenings_.back().get();
    const auto full = event.name.empty() ? event.source : event.source + "." + event.name;
    add(fmi_output(full + ".count", "how often since the start", Type::count, "",
                   [last] { return static_cast<double>(last->count); }));
    add(fmi_output(full + ".time", "when it happened last, exactly, inside its step", Type::real, "s",
                   [last] { return last->time; }));
    for (std::size_t n = 0; n < event.values.size(); ++n)
      add(fmi_output(full + "." + event.values[n].first, fmt::format("of the last {}", event.name),
                     Type::real, unit_or_none(event.values[n].second),
                     [last, n] { return last->values[n]; }));
  }
}

void BuiltLine::happened(const record::RecordedEvent& event) {
  had_event_ = true;
  for (auto& happening : happenings_) {
    if (!happening->is(event)) continue;
    ++happening->count;
    happening->time = event.at_seconds();
    for (std::size_t n = 0; n < happening->values.size(); ++n)
      if (const auto* value = event.find(happening->event.values[n].first))
        happening->values[n] = value->number;
  }
}

void BuiltLine::take(const Given& given) {
  for (const auto& [reference, value] : given) {
    const auto& variable = checked(reference, value);
    if (variable.set) variable.set(std::get<double>(value));
  }
}

void BuiltLine::step() {
  had_event_ = false;
  simulation_->advance();
}

void BuiltLine::visit(StateArchive& archive) { STATE(archive, *simulation_, happenings_, told_); }

}  // namespace drycut::sim::fmi
