#include "sim/loop/consistency.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "base/text.hpp"
#include "sim/loop/waits.hpp"

namespace drycut::sim::loop {

std::string program_words(const devices::ProgramText& program) {
  std::string words;
  const auto text = lower(program.text);
  const bool is_st = program.language == "st";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto rest = std::string_view(text).substr(i);
    if (is_st ? rest.starts_with("//") : text[i] == ';') {
      while (i < text.size() && text[i] != '\n') ++i;
      words += '\n';
    } else if (is_st && rest.starts_with("(*")) {
      const auto end = std::min(text.find("*)", i), text.size() - 1) + 1;
      words.append(
          static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                              text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
          '\n');
      i = end;
    } else {
      words += text[i];
    }
  }
  return words;
}

namespace {

bool is_word_at(const std::string& text, std::size_t at, std::size_t length) {
  const auto joins = [&](std::size_t i) { return i < text.size() && in_name(text[i]); };
  return (at == 0 || !joins(at - 1)) && !joins(at + length);
}

int times_named(const std::string& text, const std::string& word) {
  int times = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if (is_word_at(text, at, word.size())) ++times;
  return times;
}

/// The name before `at` in its line, and its colon: "  lamp AT %QX0.1".
std::string name_before(const std::string& text, std::size_t at) {
  const auto line = text.rfind('\n', at) + 1;
  const auto words = split_words(std::string_view(text).substr(line, at - line), {1, 1}, " \t,:");
  return words.empty() ? "" : words.front().text;
}

/// "IX0.0", "QX0.0", which a program declares, and not "Knife.ready", which an axis has.
bool is_declared(const std::string& terminal) {
  return terminal.size() > 2 && (terminal[0] == 'i' || terminal[0] == 'q') && terminal[1] == 'x' &&
         is_digit(terminal[2]);
}

/// The name, "" = without one or a device's, that Structured Text by AT or a configuration has for a
/// terminal; nothing where it does not have the terminal. All in small letters.
std::optional<std::string> declared_name(const std::string& language, const std::string& words,
                                         const std::string& terminal) {
  if (language == "st") {
    const auto at = words.find("%" + terminal);
    if (at == std::string::npos || !is_word_at(words, at + 1, terminal.size())) return {};
    return name_before(words, at);
  }
  const auto at = language == "cnf" ? words.find(terminal) : std::string::npos;
  if (at == std::string::npos) return {};
  const auto line = words.rfind('\n', at) + 1;
  constexpr std::size_t of_terminal = 3;  // name, type, address; a device has more
  const auto fields =
      split_words(std::string_view(words).substr(line, words.find('\n', at) - line), {1, 1}, " \t");
  return fields.size() > of_terminal ? "" : fields.front().text;
}

/// A program with its words, which are taken out of the text once.
struct ReadProgram {
  devices::ProgramText program;
  std::string words;
};
std::vector<ReadProgram> read_programs(devices::Controller& controller) {
  std::vector<ReadProgram> read;
  for (auto& program : controller.programs()) {
    auto words = program_words(program);
    read.push_back({std::move(program), std::move(words)});
  }
  return read;
}

/// How sure it is to be that a program works or reads a terminal: what cannot be told counts as named, or a
/// group of terminals does not name each of them.
enum class Named { perhaps, surely };

bool is_named(const std::string& terminal, const std::vector<ReadProgram>& programs, Named how) {
  const auto wanted = lower(terminal);
  if (wanted.find('.') != std::string::npos && is_letter(wanted.front()) && !is_declared(wanted))
    return true;  // an axis'
  for (const auto& [program, words] : programs) {
    if (program.language == "il") {
      if (how == Named::surely) return times_named(words, wanted) > 0;
      // A group of four bits and more, K2Y0, holds others; so do blocks of outputs. A cam's block has the
      // number of its synchronous output.
      for (auto k = words.find('k'); k != std::string::npos; k = words.find('k', k + 1))
        if (k + 2 < words.size() && is_digit(words[k + 1]) && words[k + 2] == 'y') return true;
      if (words.find("zrst") != std::string::npos || times_named(words, wanted) > 0) return true;
      const auto number = parsed<int>(std::string_view(wanted).substr(1), 8);
      if (number && times_named(words, fmt::format("k{}", *number)) > 0) return true;
      continue;
    }
    if (program.language == "st")
      for (const auto* whole : {"%qb", "%qw", "%qd"})
        if (how == Named::perhaps && words.find(whole) != std::string::npos) return true;
    const auto name = declared_name(program.language, words, wanted);
    if (!name) continue;
    if (name->empty()) return true;
    if (program.language == "st") return times_named(words, *name) > 1;
    int times = 0;
    for (const auto& [other, other_words] : programs)
      if (other.language == "qcl") times += times_named(other_words, *name);
    return times > 0;
  }
  return false;
}

/// A counter of an LX3VP, which its program has to name.
bool is_unread(const std::string& terminal, const std::vector<ReadProgram>& programs) {
  return !programs.empty() && std::all_of(programs.begin(), programs.end(), [&](const ReadProgram& read) {
    return read.program.language == "il" && times_named(read.words, lower(terminal)) == 0;
  });
}

std::optional<plants::PlugScale> scale_of(const std::vector<NamedPlant>& plants, const std::string& plug) {
  for (const auto& [name, plant] : plants)
    if (plug.starts_with(name + ".")) return plant->scale_of(std::string_view(plug).substr(name.size() + 1));
  return {};
}

}  // namespace

std::vector<Finding> contradictions(const scenario::Scenario& scenario,
                                    const std::vector<NamedPlant>& plants) {
  if (!scenario.controller) return {};
  return scenario.controller->contradictions(scenario,
                                             [&](const std::string& plug) { return scale_of(plants, plug); });
}

const scenario::Wire* wire_at(const scenario::Scenario& scenario, devices::Controller& controller,
                              const devices::Address& address) {
  for (const auto& wire : scenario.wiring) {
    const auto found = controller.terminal(wire.terminal.text);
    const auto* at = std::get_if<devices::Address>(&found);
    if (at != nullptr && *at == address) return &wire;
  }
  return nullptr;
}

std::vector<Finding> contradicting_speeds(const scenario::Scenario& scenario, devices::Controller& controller,
                                          const std::vector<NamedPlant>& plants) {
  constexpr double tolerance = 0.02;
  std::vector<Finding> found;
  for (const auto& loop : controller.position_loops()) {
    const double told = loop.counts_at_10v ? loop.counts_at_10v() : 0;
    if (told <= 0 || !loop.counter || !loop.reference) continue;
    const auto* counted = wire_at(scenario, controller, *loop.counter);
    const auto* driven = wire_at(scenario, controller, *loop.reference);
    if (counted == nullptr || driven == nullptr) continue;
    const auto counts = scale_of(plants, counted->plug.text);
    const auto speed = scale_of(plants, driven->plug.text);
    if (!counts || !speed || counts->turns != speed->turns) continue;
    const double given = std::abs(counts->value * speed->value);
    if (std::abs(told - given) <= tolerance * given) continue;
    found.emplace_back(
        "wiring.speed-contradicts"_code,
        fmt::format("{}: by its parameters 10 V are {:.0f} counts/s (maxvel, unitvel, decpt, counts a "
                    "unit), by {} and {} {:.0f}",
                    loop.name, told, driven->plug.text, counted->plug.text, given));
  }
  return found;
}

namespace {

/// How far a length is from a power of ten of `base`: 0.1 mm, 1 mm, 10 mm ... are 0.
bool is_round(double value, double base) {
  constexpr double tolerance = 0.001;  // 0.23 %
  const double decades = std::log10(value / base);
  return std::abs(decades - std::round(decades)) < tolerance;
}

}  // namespace

namespace {

/// A unit of an axis as the machine has it.
struct MachineUnit {
  devices::Controller::CountedUnit counted;
  std::string plug;
  double length = 0;  ///< [m], 0 = it turns and touches no material
  double angle = 0;   ///< [rad], 0 = it does not turn

  [[nodiscard]] std::string text() const {
    return fmt::format("{}: a unit is {} by {}", counted.name,
                       length > 0 ? fmt::format("{:.4g} mm", length * 1000)
                                  : fmt::format("{:.4g} deg", angle * 180 / std::numbers::pi),
                       plug);
  }
};

std::vector<MachineUnit> machine_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                       const std::vector<NamedPlant>& plants) {
  std::vector<MachineUnit> units;
  for (auto& unit : controller.counted_units()) {
    const auto* wire = wire_at(scenario, controller, unit.counter);
    const auto scale = wire != nullptr ? scale_of(plants, wire->plug.text) : std::nullopt;
    if (!scale || unit.counts <= 0) continue;
    const double way = unit.counts / scale->value;
    units.push_back(
        {std::move(unit), wire->plug.text, scale->turns ? way * scale->radius : way, scale->turns ? way : 0});
  }
  return units;
}

}  // namespace

std::vector<Finding> strange_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                   const std::vector<NamedPlant>& plants) {
  constexpr double millimetre = 1e-3;
  constexpr double inch = 25.4e-3;
  constexpr double degree = std::numbers::pi / 180;
  std::vector<Finding> found;
  for (const auto& unit : machine_units(scenario, controller, plants)) {
    const bool of_length =
        unit.length > 0 && (is_round(unit.length, millimetre) || is_round(unit.length, inch));
    const bool of_angle =
        unit.angle > 0 && (is_round(unit.angle, degree) || is_round(unit.angle, 360 * degree));
    if (!of_length && !of_angle) found.emplace_back("wiring.strange-unit"_code, unit.text());
  }
  return found;
}

std::vector<Finding> different_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                     const std::vector<NamedPlant>& plants) {
  constexpr double tolerance = 0.01;
  const auto units = machine_units(scenario, controller, plants);
  std::vector<Finding> found;
  for (std::size_t i = 1; i < units.size(); ++i) {
    const auto& own = units[i - 1];
    const auto& master = units[i];
    if (own.counted.axis != master.counted.axis || own.length == 0 || master.length == 0) continue;
    if (std::abs(own.length - master.length) > tolerance * own.length)
      found.emplace_back("wiring.units-differ"_code, fmt::format("{}, {}", own.text(), master.text()));
  }
  return found;
}

std::vector<Finding> strange_cycles(const std::vector<CamCycle>& cycles,
                                    const std::vector<std::pair<std::string, record::Tolerance>>& limits) {
  constexpr double tolerance = 0.02;
  const auto is_whole = [&](double ratio) {
    return std::round(ratio) >= 1 && std::abs(ratio - std::round(ratio)) <= tolerance * ratio;
  };
  std::vector<Finding> found;
  for (const auto& cycle : cycles)
    for (const auto& [check, limit] : limits) {
      const double wanted = (limit.low + limit.high) / 2;
      if (cycle.unit != "mm" || cycle.length <= 0 || limit.value != "length" || !std::isfinite(wanted) ||
          wanted <= 0 || is_whole(cycle.length / wanted) || is_whole(wanted / cycle.length))
        continue;
      found.emplace_back(
          "loop.cycle-no-piece"_code,
          fmt::format("a cycle of the cam of {} is {:.4g} mm of material, and check '{}' wants "
                      "{:.4g} mm",
                      cycle.axis, cycle.length, check, wanted));
    }
  return found;
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

/// As the program spells it.
std::string spelt(const std::string& name, const devices::ProgramText& program) {
  const auto at = lower(program.text).find(name);
  return at == std::string::npos ? name : program.text.substr(at, name.size());
}

/// The name that a program has for a terminal, of the configuration, of AT; "" = none.
std::string name_in_program(const std::string& terminal, const std::vector<ReadProgram>& programs) {
  for (const auto& [program, words] : programs)
    if (const auto name = declared_name(program.language, words, lower(terminal)); name && !name->empty())
      return spelt(*name, program);
  return "";
}

/// Whether a line of a program, without comment and in small letters, may switch `name` on.
bool switches_on(const std::string& language, std::string_view line, const std::string& name) {
  const auto words = split_words(line, {1, 1}, " \t");
  if (words.empty()) return false;
  const auto is = [&](std::size_t i, std::string_view word) {
    return i < words.size() && words[i].text == word;
  };
  if (language == "il") return (is(0, "out") || is(0, "set")) && is(1, name);
  if (language == "qcl") return is(0, "setout") ? is(1, name) : is(0, name) && is(1, "=") && !is(2, "0");
  const auto assigned = line.find(":=");
  return assigned != std::string_view::npos && trimmed(line.substr(0, assigned)) == name &&
         !trimmed(line.substr(assigned + 2)).starts_with("false");
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

std::vector<Finding> backward_masters(const scenario::Scenario& scenario, devices::Controller& controller,
                                      const std::vector<NamedPlant>& plants) {
  std::vector<Finding> found;
  const auto units = controller.counted_units();
  // A device's first counter is its own, the second one its master's.
  for (std::size_t i = 1; i < units.size(); ++i) {
    const auto reversed = controller.find(units[i].axis + ".st_cntrevm");
    const auto* wire = wire_at(scenario, controller, units[i].counter);
    if (units[i - 1].axis != units[i].axis || !reversed || wire == nullptr) continue;
    const auto scale = scale_of(plants, wire->plug.text);
    if (scale && (reversed->read() != 0) == (scale->value > 0))
      found.emplace_back("wiring.master-backwards"_code,
                         fmt::format("{} counts its master backwards (st_cntrevm {:g}, {})", units[i].axis,
                                     reversed->read(), wire->plug.text));
  }
  return found;
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
  return notes;
}

bool presets(devices::Controller& controller, const std::string& axis) {
  const auto programs = controller.programs();
  return std::any_of(programs.begin(), programs.end(), [&](const devices::ProgramText& program) {
    return program.language == "qcl" &&
           program_words(program).find("preset " + lower(axis)) != std::string::npos;
  });
}

std::string switched_on_by(devices::Controller& controller, const std::string& terminal) {
  const auto programs = read_programs(controller);
  const auto given = name_in_program(terminal, programs);
  std::vector<std::string> places;
  for (const auto& [program, words] : programs) {
    const auto name = lower(program.language == "il" ? terminal : given);
    if (name.empty() || program.language == "cnf") continue;
    int number = 0;
    for (const auto line : split_lines(words)) {
      ++number;
      if (!switches_on(program.language, line, name)) continue;
      // What it depends on stands before it, or on the line itself.
      constexpr int near = 3;
      auto code = code_of(program, number);
      for (int above = number - 1; program.language == "qcl" && above >= number - near; --above)
        if (const auto asked = code_of(program, above); lower(asked).starts_with("if ")) {
          code = asked + ": " + code;
          break;
        } else if (lower(asked) == "endif") {
          break;
        }
      places.push_back(fmt::format("{}:{}, {}", program.name, number, code));
    }
  }
  constexpr std::size_t few = 3;
  return places.empty() || places.size() > few ? "" : fmt::format(", by {}", fmt::join(places, " or "));
}

bool names_terminal(devices::Controller& controller, const std::string& terminal) {
  return is_named(terminal, read_programs(controller), Named::surely);
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
