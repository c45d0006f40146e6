#include "sim/loop/wires.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.hpp"
#include "sim/loop/program_words.hpp"

namespace drycut::sim::loop {

const scenario::Wire* wire_at(const scenario::Scenario& scenario, devices::Controller& controller,
                              const devices::Address& address) {
  for (const auto& wire : scenario.wiring) {
    const auto found = controller.terminal(wire.terminal.text);
    const auto* at = std::get_if<devices::Address>(&found);
    if (at != nullptr && *at == address) return &wire;
  }
  return nullptr;
}

namespace {

/// Zero pulses of another encoder than the one that the axis counts.
std::vector<Finding> strange_zero_pulses(const scenario::Scenario& scenario,
                                         devices::Controller& controller) {
  std::vector<Finding> notes;
  for (const auto& loop : controller.position_loops()) {
    if (!loop.zero || !loop.counter) continue;
    const auto* pulse = wire_at(scenario, controller, *loop.zero);
    const auto* counted = wire_at(scenario, controller, *loop.counter);
    if (pulse == nullptr || counted == nullptr || !pulse->plug.text.ends_with(".index") ||
        pulse->plug.text == counted->plug.text + ".index")
      continue;
    notes.emplace_back(
        "wiring.other-zero-pulse"_code,
        fmt::format("{} takes its zero pulse from {} ({}), and counts {} ({})", loop.name, pulse->plug.text,
                    pulse->terminal.text, counted->plug.text, counted->terminal.text));
  }
  return notes;
}

/// Axes that switch their drive on and off, by a terminal that is not wired, where the drive has the plug.
std::vector<Finding> always_enabled(const scenario::Scenario& scenario, devices::Controller& controller) {
  constexpr std::string_view reference = ".reference";
  std::vector<Finding> found;
  for (const auto& wire : scenario.wiring) {
    const auto& [terminal, plug] = std::pair(wire.terminal.text, wire.plug.text);
    if (!terminal.ends_with(reference) || !plug.ends_with(reference)) continue;
    const auto enable = terminal.substr(0, terminal.size() - reference.size()) + ".enable";
    const auto at = controller.terminal(enable);
    const auto* address = std::get_if<devices::Address>(&at);
    if (address != nullptr && wire_at(scenario, controller, *address) == nullptr)
      found.emplace_back("wiring.always-enabled"_code,
                         fmt::format("{} is not wired: {} is on always, whatever the axis does", enable,
                                     plug.substr(0, plug.size() - reference.size()) + ".enable"));
  }
  return found;
}

/// Probes of axes that MC_TouchProbe looks at and nothing is wired to.
std::vector<Finding> open_probes(const scenario::Scenario& scenario, devices::Controller& controller,
                                 const std::vector<ReadProgram>& programs) {
  std::vector<Finding> found;
  for (const auto& loop : controller.position_loops()) {
    const auto probe = loop.name + ".probe";
    const auto at = controller.terminal(probe);
    const auto* address = std::get_if<devices::Address>(&at);
    if (address != nullptr && wire_at(scenario, controller, *address) == nullptr &&
        calls_block(programs, "mc_touchprobe", loop.name))
      found.emplace_back("wiring.open-terminal"_code,
                         fmt::format("{} is what MC_TouchProbe looks at, and nothing is wired to it", probe));
  }
  return found;
}

}  // namespace

std::vector<Finding> faults_of_nothing(const scenario::Scenario& scenario,
                                       const std::vector<NamedPlant>& plants) {
  std::vector<Finding> found;
  const auto is_encoder = [&](const std::string& component) {
    for (const auto& [name, plant] : plants)
      for (const auto& port : plant->ports())
        if (name + "." + port.name == component)
          return std::holds_alternative<plants::EncoderPort*>(port.plug);
    return false;
  };
  const auto is_wired = [&](const std::string& component) {
    return std::ranges::any_of(scenario.wiring, [&](const scenario::Wire& wire) {
      return wire.plug.text == component || wire.plug.text.starts_with(component + ".");
    });
  };
  for (const auto& entry : scenario.timeline)
    for (const auto& fault : entry.faults)
      if (const auto& component = fault.component.text; is_encoder(component) && !is_wired(component))
        found.emplace_back("wiring.fault-of-nothing"_code,
                           fmt::format("{} of {} in line {} changes nothing: nothing is wired to {}",
                                       fault.fault.text, component, entry.place.line, component));
  return found;
}

std::vector<Finding> crossed_wires(const scenario::Scenario& scenario, devices::Controller& controller) {
  struct NamedWire {
    std::string terminal;
    std::string plug;
    std::string name;
    std::vector<std::string> words;  ///< of the plug: head, plunge
    devices::Kind kind;
  };
  std::vector<NamedWire> named;
  const auto programs = read_programs(controller);
  for (const auto& wire : scenario.wiring) {
    const auto found = controller.terminal(wire.terminal.text);
    const auto* address = std::get_if<devices::Address>(&found);
    if (address == nullptr) continue;
    const auto terminal = controller.terminal_name(*address);
    auto name = name_in_program(terminal, programs);
    if (name.empty()) continue;
    std::vector<std::string> words;
    const auto plug = lower(wire.plug.text);
    for (const auto& word : split_words(std::string_view(plug).substr(plug.find('.') + 1), {1, 1}, "._"))
      words.push_back(word.text);
    named.push_back({terminal, wire.plug.text, std::move(name), std::move(words), address->kind});
  }
  // "headdown" has "down", "ifup" ends with "up": a word that both plugs have tells nothing.
  const auto has = [](const NamedWire& one, const NamedWire& of, const NamedWire& not_of) {
    constexpr std::size_t telling = 4;  // letters
    return std::any_of(of.words.begin(), of.words.end(), [&](const std::string& word) {
      const bool common = std::find(not_of.words.begin(), not_of.words.end(), word) != not_of.words.end();
      const auto name = lower(one.name);
      return !common &&
             (name.ends_with(word) || (word.size() >= telling && name.find(word) != std::string::npos));
    });
  };
  std::vector<Finding> notes;
  for (std::size_t i = 0; i < named.size(); ++i)
    for (std::size_t j = i + 1; j < named.size(); ++j)
      if (const auto& one = named[i], &other = named[j]; one.kind == other.kind && has(one, other, one) &&
                                                         has(other, one, other) && !has(one, one, other) &&
                                                         !has(other, other, one))
        notes.emplace_back(
            "wiring.crossed"_code,
            fmt::format("{}, which the program calls {}, is wired to {}, and {}, {}, to {}", one.terminal,
                        one.name, one.plug, other.terminal, other.name, other.plug));
  return notes;
}

std::vector<Finding> without_zero_pulse(const scenario::Scenario& scenario, devices::Controller& controller) {
  constexpr double by_zero_pulse = 1;  // prsmode
  std::vector<Finding> found;
  for (const auto& loop : controller.position_loops()) {
    const auto mode = controller.find(loop.name + ".prsmode");
    if (!loop.zero || !mode || mode->read() != by_zero_pulse || !presets(controller, loop.name)) continue;
    if (wire_at(scenario, controller, *loop.zero) == nullptr)
      found.emplace_back(
          "wiring.no-zero-pulse"_code,
          fmt::format("{} is the zero pulse that PRESET of {} seeks (prsmode 1), and nothing is "
                      "wired to it",
                      controller.terminal_name(*loop.zero), loop.name));
  }
  return found;
}

std::vector<Finding> doubtful_wires(const scenario::Scenario& scenario, devices::Controller& controller) {
  std::vector<Finding> notes;
  const auto programs = read_programs(controller);
  std::map<std::string, std::string> counters;
  for (const auto& wire : scenario.wiring) {
    const auto found = controller.terminal(wire.terminal.text);
    const auto* address = std::get_if<devices::Address>(&found);
    if (address == nullptr) continue;
    const auto name = controller.terminal_name(*address);
    if (address->kind == devices::Kind::output && !is_named(name, programs, Named::perhaps))
      notes.emplace_back("wiring.idle-output"_code,
                         fmt::format("{} is wired to {}, and no program works it", name, wire.plug.text));
    if (address->kind != devices::Kind::counter) continue;
    if (is_unread(name, programs))
      notes.emplace_back(
          "wiring.unread-counter"_code,
          fmt::format("{} is wired to {}, and the program does not name it", name, wire.plug.text));
    const auto [first, fresh] = counters.emplace(wire.plug.text, name);
    if (!fresh)
      notes.emplace_back("wiring.shared-counter"_code,
                         fmt::format("{} and {} are both wired to {}", first->second, name, wire.plug.text));
  }
  for (auto& strange : strange_zero_pulses(scenario, controller)) notes.push_back(std::move(strange));
  for (auto& enabled : always_enabled(scenario, controller)) notes.push_back(std::move(enabled));
  for (auto& probe : open_probes(scenario, controller, programs)) notes.push_back(std::move(probe));
  return notes;
}

OpenTerminals open_terminals(devices::Controller& controller, const std::vector<std::string>& unwired,
                             const std::vector<NamedPlant>& plants) {
  OpenTerminals open;
  const bool takes_pulses = std::any_of(plants.begin(), plants.end(), [](const NamedPlant& named) {
    const auto ports = named.plant->ports();
    return std::any_of(ports.begin(), ports.end(), [](const plants::Port& port) {
      return std::holds_alternative<plants::PulsePort*>(port.plug);
    });
  });
  const auto programs = read_programs(controller);
  for (const auto& name : unwired) {
    const auto found = controller.terminal(name);
    const auto* address = std::get_if<devices::Address>(&found);
    if (address == nullptr) continue;
    const bool pulses = controller.cards().pulse_outputs.contains(*address);
    const auto tell = [&](auto& list, std::string_view what) {
      list.emplace_back("wiring.open-terminal"_code,
                        fmt::format("{} {}, and nothing is wired to it", name, what));
    };
    if (pulses && takes_pulses)
      tell(open.moving, "gives pulses");
    else if (address->kind == devices::Kind::analogue)
      tell(open.moving, "gives a reference");
    else if (address->kind == devices::Kind::counter)
      tell(open.moving, "is counted");
    else if (pulses || !is_named(name, programs, Named::surely))
      open.unnamed.push_back(name);
    else if (address->kind == devices::Kind::output)
      tell(open.others, "is worked by the program");
    else
      tell(open.others, "is read by the program");
  }
  return open;
}

}  // namespace drycut::sim::loop
