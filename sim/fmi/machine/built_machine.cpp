#include "sim/fmi/machine/built_machine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/state_archive.hpp"

namespace drycut::sim::fmi {

using Role = FmiVariable::Role;
using Type = FmiVariable::Type;

struct BuiltMachine::NamedDefinition {
  std::string name;
  std::unique_ptr<plants::PlantDefinition> definition;
  plants::Parameters parameters;
  // Those that change while it runs: in the table of the definition and in the machine itself.
  std::vector<std::pair<double*, double*>> live = {};
};

// A signal's edges, which are over before an importer looks.
struct BuiltMachine::Signal {
  const plants::SignalPort* port;
  const plants::EncoderPort* encoder;  // whose index pulse it is, or none
  std::int64_t rises = 0;
  double rise_time = 0;
  std::int64_t latch = 0;
  void visit(StateArchive& archive) { STATE(archive, rises, rise_time, latch); }
};

// An event of a plant, as it happened last.
struct BuiltMachine::Happening {
  std::size_t plant;
  plants::EventType type;
  std::int64_t count = 0;
  double time = 0;
  std::vector<double> values = std::vector<double>(type.values.size());
  void visit(StateArchive& archive) { STATE(archive, count, time, values); }
};

namespace {

void take(const plants::Parameter& row, const FmiValue& given) {
  if (auto* const* word = std::get_if<std::string*>(&row.value)) {
    **word = std::get<std::string>(given);
    return;
  }
  const double number = std::get<double>(given);
  std::visit(
      [&](auto* value) {
        using Held = std::remove_pointer_t<decltype(value)>;
        if constexpr (std::is_same_v<Held, bool>)
          *value = number != 0;
        else if constexpr (!std::is_same_v<Held, std::string>)
          *value = static_cast<Held>(number);
      },
      row.value);
}

// Words that only say where values come from, or which plants there are, are no parameters of the machine.
bool is_parameter(const plants::Parameter& row) {
  if (!std::holds_alternative<std::string*>(row.value)) return true;
  return row.reference.empty() && row.presets == nullptr && !row.choices.empty();
}

}  // namespace

BuiltMachine::~BuiltMachine() = default;

BuiltMachine::BuiltMachine(const ResolvedMachine& resolved, const Given& given)
    : step_(resolved.step), h_(seconds(resolved.step)), world_(resolved.seed) {
  units_ = resolved.units;
  FmiVariable time{"time", "time", Type::real, Role::time, "s"};
  time.get = [this] { return seconds(time_); };
  add(std::move(time));
  define(resolved);
  for (std::size_t plant = 0; plant < definitions_.size(); ++plant) add_parameters(plant);
  for (const auto& [reference, value] : given) {
    const auto& variable = checked(reference, value);
    if (const auto* word = std::get_if<std::string>(&value))
      *variable.word = *word;
    else
      variable.set(std::get<double>(value));
  }
  refuse_objections();
  build();
  for (std::size_t plant = 0; plant < definitions_.size(); ++plant) {
    const auto& name = definitions_[plant].name;
    bind_live_parameters(plant);
    add_plugs(name, *plants_[plant]);
    for (auto& channel : plants_[plant]->channels()) {
      const auto full = name + "." + channel.name;
      add(fmi_output(has_variable(full) ? full + ".channel" : full, channel.meaning, Type::real, channel.unit,
                     channel.read));
    }
    add_events(plant);
    add_settings(name, *plants_[plant]);
  }
}

void BuiltMachine::define(const ResolvedMachine& resolved) {
  for (const auto& values : resolved.plants) {
    const auto& types = plants::plant_types();
    const auto type = std::ranges::find(types, values.type, &plants::PlantType::name);
    if (type == types.end()) throw Refusal(fmt::format("there is no plant of type '{}'", values.type));
    NamedDefinition made{values.name, type->define(), {}};
    made.parameters = made.definition->parameters();
    for (const auto& [name, value] : values.parameters) {
      const auto row = std::ranges::find(made.parameters, name, &plants::Parameter::name);
      if (row == made.parameters.end())
        throw Refusal(fmt::format("a {} has no parameter '{}'", values.type, name));
      take(*row, value);
    }
    definitions_.push_back(std::move(made));
  }
}

void BuiltMachine::refuse_objections() {
  const auto find = [&](std::string_view name) -> plants::PlantDefinition* {
    const auto found = std::ranges::find(definitions_, name, &NamedDefinition::name);
    return found == definitions_.end() ? nullptr : found->definition.get();
  };
  std::string all;
  for (const auto& [name, definition, rows, live] : definitions_) {
    auto objections = definition->objections(h_);
    for (auto& more : definition->objections_with(find, h_)) objections.push_back(std::move(more));
    for (const auto& objection : objections)
      all += fmt::format("{}{}.{}: {}; {} [{}]", all.empty() ? "" : "; ", name, objection.parameter,
                         objection.what, objection.remedy, objection.code.text());
  }
  if (!all.empty()) throw Refusal(all);
}

void BuiltMachine::build() {
  const auto find = [&](std::string_view name) -> plants::Plant* {
    const auto found = std::ranges::find(definitions_, name, &NamedDefinition::name);
    const auto place = static_cast<std::size_t>(found - definitions_.begin());
    return place < plants_.size() ? plants_[place].get() : nullptr;
  };
  for (auto& definition : definitions_) plants_.push_back(definition.definition->build(world_, find));
}

void BuiltMachine::add_parameters(std::size_t plant) {
  const auto& definition = definitions_[plant];
  for (const auto& row : definition.parameters) {
    if (!is_parameter(row)) continue;
    auto variable = fmi_parameter(definition.name + "." + row.name, row);
    variable.set = [row](double value) { take(row, value); };
    add(std::move(variable));
  }
}

void BuiltMachine::bind_live_parameters(std::size_t plant) {
  auto& definition = definitions_[plant];
  for (const auto& live : plants_[plant]->live_parameters()) {
    auto& variable = variable_called("parameters." + definition.name + "." + live.name);
    const auto row = std::ranges::find(definition.parameters, live.name, &plants::Parameter::name);
    auto* const told = std::get<double*>(row->value);
    auto* const machine = std::get<double*>(live.value);
    definition.live.emplace_back(told, machine);
    variable.get = [machine] { return *machine; };
    variable.set = [this, told, machine, built = plants_[plant].get()](double value) {
      for (auto& other : definitions_)
        for (const auto& [as_told, in_machine] : other.live) *as_told = *in_machine;
      *told = value;
      try {
        refuse_objections();
      } catch (...) {
        *told = *machine;
        throw;
      }
      *machine = value;
      built->parameters_changed();
    };
  }
}

void BuiltMachine::add_plugs(const std::string& name, plants::Plant& plant) {
  const auto ports = plant.ports();
  for (const auto& port : ports) {
    FmiVariable variable{name + "." + port.name, port.meaning};
    if (auto* const* encoder = std::get_if<plants::EncoderPort*>(&port.plug)) {
      variable.type = Type::count;
      variable.get = [from = *encoder] { return static_cast<double>(from->count); };
    } else if (std::holds_alternative<plants::SignalPort*>(port.plug)) {
      add_signal(name, port, ports);
      continue;
    } else if (auto* const* command = std::get_if<plants::CommandPort*>(&port.plug)) {
      variable.type = Type::flag;
      variable.role = Role::input;
      variable.get = [to = *command] { return to->level ? 1.0 : 0.0; };
      variable.set = [to = *command](double on) { to->level = on != 0; };
    } else if (auto* const* reference = std::get_if<plants::ReferencePort*>(&port.plug)) {
      variable.role = Role::input;
      variable.unit = "V";
      variable.get = [to = *reference] { return to->volts; };
      variable.set = [to = *reference](double volts) { to->volts = volts; };
    } else if (auto* const* pulses = std::get_if<plants::PulsePort*>(&port.plug)) {
      variable.type = Type::count;
      variable.role = Role::input;
      variable.get = [to = *pulses] { return static_cast<double>(to->pulses); };
      variable.set = [to = *pulses](double count) {
        if (count < static_cast<double>(to->pulses))
          throw Refusal(
              fmt::format("{} pulses after {}: pulses are counted up whatever their direction, which "
                          "is a signal of its own",
                          count, to->pulses));
        to->pulses = static_cast<std::int64_t>(count);
      };
    }
    add(std::move(variable));
  }
}

void BuiltMachine::add_signal(const std::string& name, const plants::Port& port,
                              const std::vector<plants::Port>& ports) {
  constexpr std::string_view index = ".index";
  const plants::EncoderPort* encoder = nullptr;
  for (const auto& other : ports)
    if (port.name.ends_with(index) && port.name == other.name + std::string(index))
      if (auto* const* found = std::get_if<plants::EncoderPort*>(&other.plug)) encoder = *found;
  const auto* const from = std::get<plants::SignalPort*>(port.plug);
  signals_.push_back(std::make_unique<Signal>(Signal{from, encoder}));
  auto* const signal = signals_.back().get();
  const auto full = name + "." + port.name;
  add(fmi_output(full, port.meaning, Type::flag, "", [from] { return from->level ? 1.0 : 0.0; }));
  add(fmi_output(full + ".rises", "rising edges since the start", Type::count, "",
                 [signal] { return static_cast<double>(signal->rises); }));
  add(fmi_output(full + ".rise_time", "when it rose last, exactly, inside its step", Type::real, "s",
                 [signal] { return signal->rise_time; }));
  if (encoder != nullptr)
    add(fmi_output(full + ".latch", "count of the encoder at that very moment", Type::count, "",
                   [signal] { return static_cast<double>(signal->latch); }));
}

void BuiltMachine::add_settings(const std::string& name, plants::Plant& plant) {
  for (auto& setting : plant.settings()) {
    auto variable = fmi_setting("set." + name + "." + setting.name, setting.meaning, setting.unit,
                                setting.range.min, setting.range.max, setting.range.whole);
    variable.get = setting.read;
    variable.set = setting.write;
    add(std::move(variable));
  }
  for (auto& fault : plant.faults()) {
    auto variable = fmi_setting("fault." + name + "." + fault.component + "." + fault.name,
                                fault.meaning + "; it acts when the value changes", fault.unit,
                                fault.range.min, fault.range.max, fault.range.whole);
    faults_.push_back(std::make_unique<double>(fault.without ? fault.without() : 0));
    variable.get = [acted = faults_.back().get()] { return *acted; };
    variable.set = [acted = faults_.back().get(), act = fault.act](double value) {
      act(value);
      *acted = value;
    };
    add(std::move(variable));
  }
}

void BuiltMachine::add_events(std::size_t plant) {
  for (auto& type : plants_[plant]->event_types()) {
    happenings_.push_back(std::make_unique<Happening>(Happening{plant, type}));
    auto* const event = happenings_.back().get();
    const auto full = fmt::format("{}.{}", definitions_[plant].name, type.name);
    add(fmi_output(full + ".count", fmt::format("{}: how often since the start", type.meaning), Type::count,
                   "", [event] { return static_cast<double>(event->count); }));
    add(fmi_output(full + ".time", "when it happened last, exactly, inside its step", Type::real, "s",
                   [event] { return event->time; }));
    for (std::size_t n = 0; n < type.values.size(); ++n)
      add(fmi_output(fmt::format("{}.{}", full, type.values[n].name),
                     fmt::format("{} of the last {}", type.values[n].name, type.name), Type::real,
                     std::string(type.values[n].unit), [event, n] { return event->values[n]; }));
  }
}

void BuiltMachine::step() {
  for (auto& plant : plants_) plant->drive(h_);
  world_.step(h_);
  for (auto& plant : plants_) plant->sense(h_);
  const double begin = seconds(time_);
  for (auto& signal : signals_) {
    for (const auto& edge : signal->port->edges) {
      if (!edge.rising) continue;
      ++signal->rises;
      signal->rise_time = begin + edge.fraction * h_;
      if (signal->encoder != nullptr) signal->latch = signal->encoder->count_at(edge.fraction);
    }
  }
  had_event_ = false;
  for (std::size_t plant = 0; plant < plants_.size(); ++plant)
    if (plants_[plant]->has_events()) take_events(plant, begin);
  time_ += step_;
}

void BuiltMachine::take_events(std::size_t plant, double begin) {
  had_event_ = true;
  for (const auto& event : plants_[plant]->take_events()) {
    const auto known = std::ranges::find_if(happenings_, [&](const auto& happening) {
      return happening->plant == plant && happening->type.name == event.name;
    });
    if (known == happenings_.end()) continue;
    auto& last = **known;
    ++last.count;
    last.time = begin + event.fraction * h_;
    for (std::size_t n = 0; n < last.values.size(); ++n) {
      const auto value =
          std::ranges::find(event.values, last.type.values[n].name, &plants::MachineEvent::Value::name);
      if (value != event.values.end()) last.values[n] = value->number;
    }
  }
}

void BuiltMachine::visit(StateArchive& archive) {
  STATE(archive, time_);
  for (auto& plant : plants_) plant->visit_all(archive);
  STATE(archive, world_, signals_, happenings_, faults_);
}

}  // namespace drycut::sim::fmi
