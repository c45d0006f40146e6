#include "sim/loop/bus.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "sim/loop/links.hpp"
#include "sim/loop/names.hpp"

namespace drycut::sim::loop {

using devices::Address;
using devices::Kind;

namespace {

constexpr std::string_view panel_name = "panel";

/// "an encoder", ... what a plug of a plant is, in the order of plants::Port::plug.
std::string_view kind_of(const plants::Port& port) {
  constexpr std::string_view names[] = {"an encoder", "a signal", "a command", "a reference",
                                        "a pulse train"};
  return names[port.plug.index()];
}

constexpr std::size_t pulse_plug = 4;

/// The kind of plug that a terminal takes: index into plants::Port::plug.
std::size_t plug_for(Kind kind) {
  switch (kind) {
    case Kind::counter:
      return 0;
    case Kind::input:
    case Kind::interrupt:
      return 1;
    case Kind::output:
      return 2;
    case Kind::analogue:
      return 3;
  }
  return 0;
}

/// The first of them, where there are very many.
std::string list(const std::vector<std::string>& names, std::string_view none) {
  constexpr std::size_t most = 50;
  if (names.empty()) return std::string(none);
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    text += (text.empty() ? "" : ", ") + names[i];
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

}  // namespace

void OperatorPanel::set(const std::string& name, bool on) {
  auto& port = switches.at(name);
  if (port.level != on) {
    port.add_edge(on, 0.0);
    has_edges = true;
  }
  if (on) pressed.insert(name);
  port.level = on;
}

/// Connects one scenario's wires; keeps what the messages need.
class Connector {
 public:
  Connector(Bus& bus, const scenario::Scenario& scenario, devices::Controller& controller,
            const std::vector<NamedPlant>& plants, Problems& problems)
      : bus_(bus), scenario_(scenario), controller_(controller), problems_(problems) {
    for (const auto& [name, plant] : plants) {
      for (auto& port : plant->ports()) ports_.emplace(name + "." + port.name, port);
      plant_names_.push_back(name);
      known_plants_.insert(name);
    }
  }

  void connect(const scenario::Wire& wire) {
    const auto before = wires();
    make(wire);
    const auto after = wires();
    for (std::size_t list = 0; list < after.size(); ++list)
      if (after[list] > before[list]) made_[list].push_back(wire.terminal.text);
  }
  /// The terminals of the bus' wires, by its lists.
  [[nodiscard]] const std::array<std::vector<std::string>, 7>& made() const { return made_; }

  /// Keeps a filter for the wire of its terminal.
  void take(const scenario::InputFilter& filter) {
    const auto address = terminal(filter.terminal);
    if (!address) return;
    const bool fits = (filter.frequency == 0 || address->kind == Kind::counter) &&
                      (filter.pulse == 0 || address->kind == Kind::interrupt) &&
                      (filter.delay == 0 || address->kind == Kind::input);
    if (!fits) {
      problem("wiring.kinds-differ"_code, filter.terminal.place,
              fmt::format("{} is a {} and has no such filter", controller_.terminal_name(*address),
                          name_of(address->kind)),
              "a counter has a frequency, an interrupt line a pulse, a digital input a delay");
      return;
    }
    if (!filters_.emplace(*address, &filter).second)
      problem("wiring.twice"_code, filter.terminal.place,
              fmt::format("{} has filters already", controller_.terminal_name(*address)),
              "write them in one place");
  }

  /// Says which filters no wire goes through.
  void refuse_idle_filters() {
    for (const auto& [address, filter] : filters_)
      if (!used_.contains(address))
        problem("wiring.nothing-to-filter"_code, filter->terminal.place,
                fmt::format("no signal of a plant comes to {}: there is nothing to filter",
                            controller_.terminal_name(address)),
                "wire it, or leave the filter out");
  }

 private:
  [[nodiscard]] std::array<std::size_t, 7> wires() const {
    return {bus_.counters_.size(), bus_.inputs_.size(), bus_.interrupts_.size(),      bus_.outputs_.size(),
            bus_.pulses_.size(),   bus_.loops_.size(),  bus_.analogue_outputs_.size()};
  }

  void make(const scenario::Wire& wire) {
    const auto address = terminal(wire.terminal);
    if (!address) return;
    if (!bus_.wired_.insert(*address).second) {
      problem("wiring.twice"_code, wire.terminal.place,
              fmt::format("{} is wired already", controller_.terminal_name(*address)),
              "a terminal takes one wire; remove this one");
      return;
    }
    const auto looped = address->kind == Kind::counter ? own_terminal(wire.plug) : std::nullopt;
    if (looped) {
      connect_loop(*address, wire, *looped);
    } else if (wire.plug.text.starts_with("panel.")) {
      connect_panel(*address, wire);
    } else if (const auto* port = plug(wire.plug)) {
      connect_plant(*address, wire, *port);
    }
  }

  const scenario::InputFilter* filter_of(const Address& address) {
    const auto found = filters_.find(address);
    if (found == filters_.end()) return nullptr;
    used_.insert(address);
    return found->second;
  }

  const plants::EncoderPort* filtered(const Address& address, const plants::EncoderPort* from) {
    const auto* filter = filter_of(address);
    if (filter == nullptr) return from;
    return bus_.filters_->counter(from, controller_.terminal_name(address), filter->frequency);
  }

  const plants::SignalPort* filtered(const Address& address, const plants::SignalPort* from) {
    const auto* filter = filter_of(address);
    if (filter == nullptr) return from;
    return bus_.filters_->input(from, seconds(filter->delay));
  }

  /// What an interrupt line sees of zero pulses.
  const plants::SignalPort* seen(const Address& address, const scenario::Wire& wire,
                                 const plants::SignalPort* from) {
    const auto* filter = filter_of(address);
    if (filter == nullptr) return from;
    if (!wire.plug.text.ends_with(".index")) {
      problem("wiring.kinds-differ"_code, filter->terminal.place,
              fmt::format("{} gives no zero pulses", wire.plug.text),
              "a least width is for an index: knife.encoder.index");
      return from;
    }
    return bus_.filters_->zero_pulse(from, controller_.terminal_name(address), seconds(filter->pulse));
  }

  void problem(Code code, const scenario::ScenePlace& place, std::string what, std::string remedy) {
    problems_.push_back(scenario::problem_at(code, scenario_, place, std::move(what), std::move(remedy)));
  }

  /// The terminal, if it is one of the controller.
  std::optional<Address> terminal(const scenario::Text& text) {
    const auto found = controller_.terminal(text.text);
    if (const auto* address = std::get_if<Address>(&found)) return *address;
    const auto& fault = std::get<devices::TerminalFault>(found);
    problem(fault.code, text.place, fault.what, fault.remedy);
    return {};
  }

  /// A plug that is no plug of a plant but a terminal of the controller itself.
  std::optional<Address> own_terminal(const scenario::Text& plug) {
    if (ports_.contains(plug.text)) return {};
    const auto found = controller_.terminal(plug.text);
    const auto* address = std::get_if<Address>(&found);
    return address == nullptr ? std::nullopt : std::optional(*address);
  }

  const plants::Port* plug(const scenario::Text& text) {
    if (const auto found = ports_.find(text.text); found != ports_.end()) return &found->second;
    const auto plant = text.text.substr(0, text.text.find('.'));
    // The plugs of one plant stand together.
    const auto first = ports_.lower_bound(plant + ".");
    const bool known_plant = known_plants_.contains(plant);
    std::vector<std::string> candidates;
    for (auto port = known_plant ? first : ports_.begin(); port != ports_.end(); ++port) {
      if (known_plant ? !port->first.starts_with(plant + ".") : problems_.size() > most_suggestions) break;
      candidates.push_back(port->first);
    }
    if (!known_plant) {
      problem("wiring.no-plug"_code, text.place, fmt::format("there is no plant '{}'", plant),
              did_you_mean(text.text, candidates, fmt::format("plants: {}", list(plant_names_, "none"))));
    } else {
      problem("wiring.no-plug"_code, text.place,
              fmt::format("plant '{}' has no plug '{}'", plant,
                          text.text.substr(std::min(text.text.size(), plant.size() + 1))),
              did_you_mean(text.text, candidates, fmt::format("it has: {}", list(candidates, "no plugs"))));
    }
    return nullptr;
  }

  const std::string& plugs_of_kind(std::size_t kind) {
    auto& text = plugs_of_kind_[kind];
    if (!text.empty()) return text;
    std::vector<std::string> names;
    for (const auto& [name, port] : ports_) {
      if (port.plug.index() == kind) names.push_back(name);
    }
    return text = list(names, "no plug of that kind here");
  }

  /// A pulse output of the controller, counted by one of its own counters: the manual's way to have a master.
  void connect_loop(const Address& address, const scenario::Wire& wire, const Address& from) {
    auto& cards = controller_.cards();
    if (!cards.pulse_outputs.contains(from)) {
      problem("wiring.kinds-differ"_code, wire.plug.place,
              fmt::format("{} gives no pulses that {} could count", wire.plug.text,
                          controller_.terminal_name(address)),
              "wire an encoder to it, or a pulse output of the controller");
      return;
    }
    bus_.loops_.push_back({&cards.pulse_outputs.at(from), &cards.counters.at(address)});
    bus_.looped_.insert(from);
  }

  void connect_pulses(const Address& address, const scenario::Wire& wire, plants::PulsePort* port) {
    auto& trains = controller_.cards().pulse_outputs;
    if (const auto found = trains.find(address); found == trains.end()) {
      problem("wiring.kinds-differ"_code, wire.plug.place,
              fmt::format("{} gives no pulses, {} is a pulse train", controller_.terminal_name(address),
                          wire.plug.text),
              controller_.pulse_terminals().empty()
                  ? "this controller has no pulse outputs"
                  : fmt::format("wire it to {}", controller_.pulse_terminals()));
    } else if (sole_driver(address, wire)) {
      bus_.pulses_.push_back({&found->second, port});
    }
  }

  void connect_plant(const Address& address, const scenario::Wire& wire, const plants::Port& port) {
    if (address.kind == Kind::output && port.plug.index() == pulse_plug)
      return connect_pulses(address, wire, std::get<plants::PulsePort*>(port.plug));
    if (port.plug.index() != plug_for(address.kind)) {
      problem("wiring.kinds-differ"_code, wire.plug.place,
              fmt::format("{} is {} {}, {} is {}", controller_.terminal_name(address),
                          address.kind == Kind::analogue ? "an" : "a", name_of(address.kind), wire.plug.text,
                          kind_of(port)),
              fmt::format("wire it to one of: {}", plugs_of_kind(plug_for(address.kind))));
      return;
    }
    auto& cards = controller_.cards();
    switch (address.kind) {
      case Kind::counter:
        bus_.counters_.push_back(
            {filtered(address, std::get<plants::EncoderPort*>(port.plug)), &cards.counters.at(address)});
        break;
      case Kind::input:
        bus_.inputs_.push_back(
            {filtered(address, std::get<plants::SignalPort*>(port.plug)), &cards.inputs.at(address)});
        break;
      case Kind::interrupt:
        connect_interrupt(seen(address, wire, std::get<plants::SignalPort*>(port.plug)), address.number);
        break;
      case Kind::output:
        if (sole_driver(address, wire)) {
          bus_.outputs_.push_back({&cards.outputs.at(address), std::get<plants::CommandPort*>(port.plug)});
        }
        break;
      case Kind::analogue:
        if (sole_driver(address, wire)) {
          bus_.analogue_outputs_.push_back({address, controller_.terminal_name(address), wire.plug.text,
                                            &cards.analogue_outputs.at(address),
                                            std::get<plants::ReferencePort*>(port.plug)});
        }
        break;
    }
  }

  void connect_interrupt(const plants::SignalPort* from, int line) {
    bus_.interrupts_.push_back({from, line, &controller_.cards().interrupt_lines[line]});
  }

  void connect_panel(const Address& address, const scenario::Wire& wire) {
    const auto name = wire.plug.text.substr(panel_name.size() + 1);
    auto& cards = controller_.cards();
    auto& panel = bus_.panel_;
    switch (address.kind) {
      case Kind::input:
        bus_.inputs_.push_back({filtered(address, &panel.switches[name]), &cards.inputs.at(address)});
        break;
      case Kind::interrupt:
        connect_interrupt(&panel.switches[name], address.number);
        break;
      case Kind::output:
        if (sole_driver(address, wire))
          bus_.outputs_.push_back({&cards.outputs.at(address), &panel.lamps[name]});
        break;
      case Kind::counter:
      case Kind::analogue:
        problem("wiring.kinds-differ"_code, wire.plug.place,
                fmt::format("{} is a {}, the panel has switches and lamps",
                            controller_.terminal_name(address), name_of(address.kind)),
                fmt::format("wire it to one of: {}", plugs_of_kind(plug_for(address.kind))));
        return;
    }
    if (panel.switches.contains(name) && panel.lamps.contains(name)) {
      problem("wiring.twice"_code, wire.plug.place,
              fmt::format("{} is both a switch and a lamp", wire.plug.text),
              "give the lamp a name of its own");
    }
  }

  /// Notes who drives the plug; false if another terminal does already.
  bool sole_driver(const Address& address, const scenario::Wire& wire) {
    const auto [at, fresh] = drivers_.emplace(wire.plug.text, address);
    if (!fresh) {
      problem("wiring.twice"_code, wire.plug.place,
              fmt::format("{} already drives {}", controller_.terminal_name(at->second), wire.plug.text),
              fmt::format("wire {} elsewhere: a plug has one driver", controller_.terminal_name(address)));
    }
    return fresh;
  }

  Bus& bus_;
  const scenario::Scenario& scenario_;
  devices::Controller& controller_;
  Problems& problems_;
  std::map<std::string, plants::Port> ports_;
  std::vector<std::string> plant_names_;
  std::set<std::string> known_plants_;
  std::map<std::size_t, std::string> plugs_of_kind_;  // as messages list them
  std::map<std::string, Address> drivers_;
  std::map<Address, const scenario::InputFilter*> filters_;
  std::set<Address> used_;  // of them
  std::array<std::vector<std::string>, 7> made_;
};

void Bus::connect(const scenario::Scenario& scenario, devices::Controller& controller,
                  const std::vector<NamedPlant>& plants, Problems& problems) {
  controller_ = &controller;
  h_ = seconds(scenario.scene.step);
  if (!scenario.filters.empty()) filters_ = std::make_unique<InputFilters>();
  Connector connector(*this, scenario, controller, plants, problems);
  for (const auto& filter : scenario.filters) connector.take(filter);
  for (const auto& wire : scenario.wiring)
    if (!joins_plants(wire, scenario)) connector.connect(wire);
  connector.refuse_idle_filters();
  offer_cuts(connector.made());
}

// From here on the wires stay where they are.
void Bus::offer_cuts(const std::array<std::vector<std::string>, 7>& made) {
  const auto offer = [&](std::size_t list, auto& wires, auto end) {
    for (std::size_t i = 0; i < wires.size(); ++i) cuts_.add(made[list][i], wires[i].*end);
  };
  offer(0, counters_, &CounterWire::from);
  offer(1, inputs_, &InputWire::from);
  offer(2, interrupts_, &InterruptWire::from);
  offer(3, outputs_, &OutputWire::to);
  offer(4, pulses_, &PulseWire::to);
  offer(5, loops_, &LoopWire::from);
  offer(6, analogue_outputs_, &AnalogueWire::to);
}

std::vector<std::string> Bus::unwired() const {
  std::vector<std::string> names;
  const auto collect = [&](const auto& terminals) {
    for (const auto& [address, terminal] : terminals) {
      if (!controller_->takes_wire(address)) continue;
      if (wired_.contains(address) || looped_.contains(address)) continue;
      auto name = controller_->terminal_name(address);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
    }
  };
  if (controller_ == nullptr) return names;
  const auto& cards = controller_->cards();
  collect(cards.counters);
  collect(cards.inputs);
  collect(cards.outputs);
  collect(cards.pulse_outputs);
  collect(cards.analogue_outputs);
  return names;
}

namespace {

// What was computed comes `steps` steps after the controller gave it.
void put_out_late(Bus::AnalogueWire& wire, std::int64_t steps) {
  if (wire.until > 0 && --wire.until == 0) wire.to->volts = wire.computed;
  const double output = wire.total();
  if (output == wire.computed) return;
  if (wire.until > 0) wire.to->volts = wire.computed;
  wire.computed = output;
  wire.until = steps;
}

}  // namespace

void Bus::outputs_to_plants() {
  for (const auto& wire : outputs_) wire.to->level = wire.from->level;
  for (auto& wire : analogue_outputs_) {
    if (compute_steps_ > 0)
      put_out_late(wire, compute_steps_);
    else
      wire.to->volts = wire.total();
  }
  for (const auto& wire : pulses_) wire.to->pulses = wire.from->count;
  if (cuts_.any()) cuts_.count();
}

void Bus::plants_to_inputs() {
  if (filters_) filters_->pass(h_);
  if (cuts_.any()) cuts_.count();
  for (const auto& wire : counters_) wire.to->count = wire.from->count;
  // A pulse is one period, four edges.
  for (const auto& wire : loops_) wire.to->count = 4 * wire.from->count;
  for (const auto& wire : inputs_) wire.to->level = wire.from->level;
  for (const auto& wire : interrupts_) {
    if (!wire.from->edges.empty()) {
      deliver_interrupts();
      break;
    }
  }
  for (const auto& wire : interrupts_) wire.level->level = wire.from->level;
  if (std::exchange(panel_.has_edges, false))
    for (auto& [name, port] : panel_.switches) port.edges.clear();
  if (cuts_.any()) cuts_.clear_edges();
}

void Bus::deliver_interrupts() {
  struct Arrival {
    double fraction;
    int line;
    bool rising;
  };
  std::vector<Arrival> arrivals;
  for (const auto& wire : interrupts_) {
    for (const auto& edge : wire.from->edges) arrivals.push_back({edge.fraction, wire.line, edge.rising});
  }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.fraction < b.fraction; });
  for (const auto& arrival : arrivals) {
    for (const auto& wire : counters_) wire.to->latched = wire.from->count_at(arrival.fraction);
    controller_->interrupt(arrival.line, arrival.rising);
  }
}

void Bus::visit(StateArchive& archive) {
  STATE(archive, panel_.pressed);
  for (auto& [name, port] : panel_.switches) archive.named(name, port);
  if (archive.restores()) panel_.has_edges = true;  // there may be some
  for (auto& [name, port] : panel_.lamps) archive.named(name, port);
  archive.each("analogue_outputs_", analogue_outputs_,
               [&](AnalogueWire& wire) { STATE(archive, wire.added, wire.computed, wire.until); });
  if (filters_) STATE(archive, *filters_);
  STATE(archive, cuts_);
}

}  // namespace drycut::sim::loop
