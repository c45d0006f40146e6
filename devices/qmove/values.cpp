#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/qmove/qmove_controller.hpp"

// The controller's values by name, for scenarios, the recorder and the retentive state.
namespace drycut::devices::qmove {

namespace {

// The numbers of "2, 1", or nothing if they are none.
std::vector<int> index_numbers(std::string_view text) {
  std::vector<int> numbers;
  for (;;) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view part = trimmed(text.substr(0, comma));
    const std::optional<int> number = parsed<int>(part);
    if (!number) return {};
    numbers.push_back(*number);
    if (comma == text.size()) return numbers;
    text.remove_prefix(comma + 1);
  }
}

// A double as a program's long arithmetic would meet it: truncated, never out of 64 bits.
std::int64_t whole(double value) {
  constexpr double most = 9.0e18;
  return std::isnan(value) ? 0 : static_cast<std::int64_t>(std::clamp(value, -most, most));
}

}  // namespace

ValueRange range_of(Size size) {
  switch (size) {
    case Size::F:
      return {0, 1, true};
    case Size::B:
      return {-128, 127, true};
    case Size::W:
      return {-32768, 32767, true};
    case Size::L:
      return {-2147483648.0, 2147483647.0, true};
    case Size::S:
      break;
  }
  return {-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
}

std::optional<QmoveController::Location> QmoveController::locate(std::string_view text) const {
  using LocationKind = Location::Kind;
  const std::string_view name = trimmed(text);
  if (const std::optional<Address> address = parse_address(name)) {
    if (!has_terminal(*address)) return std::nullopt;
    return Location{.kind = LocationKind::terminal, .address = *address, .name = to_string(*address)};
  }
  if (name.find('[') != std::string_view::npos) return locate_indexed(name);
  if (const std::size_t dot = name.find_first_of(".:"); dot != std::string_view::npos)
    return locate_symbol(name.substr(0, dot), name.substr(dot + 1));
  const NamedThing* thing = names_.find(name);
  if (!thing) return std::nullopt;
  Location location{.index = thing->index, .size = thing->size, .name = thing->name};
  using Thing = NamedThing::Kind;
  for (const auto& [kind, place] : {std::pair{Thing::scalar, LocationKind::cell},
                                    {Thing::timer, LocationKind::timer},
                                    {Thing::input, LocationKind::input},
                                    {Thing::output, LocationKind::output}}) {
    if (thing->kind != kind) continue;
    location.kind = place;
    return location;
  }
  return std::nullopt;
}

// arr[3], ddlCode[2], ddbCodeG[2,1].
std::optional<QmoveController::Location> QmoveController::locate_indexed(std::string_view name) const {
  const std::size_t open = name.find('[');
  if (name.back() != ']') return std::nullopt;
  const NamedThing* thing = names_.find(trimmed(name.substr(0, open)));
  const std::vector<int> indexes = index_numbers(name.substr(open + 1, name.size() - open - 2));
  if (!thing || indexes.empty() || indexes[0] < 1 || indexes[0] > thing->length) return std::nullopt;
  Location location{.index = thing->index + indexes[0] - 1, .size = thing->size};
  if (thing->kind == NamedThing::Kind::group_step) {
    if (indexes.size() != 2 || indexes[1] < 1 || indexes[1] > thing->steps) return std::nullopt;
    location.index = thing->index + (indexes[0] - 1) * thing->steps + indexes[1] - 1;
    location.name = fmt::format("{}[{},{}]", thing->name, indexes[0], indexes[1]);
    return location;
  }
  if (indexes.size() != 1) return std::nullopt;
  location.name = fmt::format("{}[{}]", thing->name, indexes[0]);
  return location;
}

std::optional<QmoveController::Location> QmoveController::locate_symbol(std::string_view device,
                                                                        std::string_view symbol) const {
  if (same_word(device, "QMOS")) {
    if (same_word(symbol, "oserr")) return Location{.kind = Location::Kind::oserr, .name = "QMOS.oserr"};
    if (same_word(symbol, "osmode")) return Location{.kind = Location::Kind::osmode, .name = "QMOS.osmode"};
    return std::nullopt;
  }
  const NamedThing* thing = names_.find(device);
  if (!thing || thing->kind != NamedThing::Kind::device) return std::nullopt;
  const DeviceType& type = machine_.devices[static_cast<std::size_t>(thing->index)]->type();
  const std::optional<Symbol> found = find_symbol(type, symbol);
  if (!found) return std::nullopt;
  return Location{.kind = Location::Kind::device,
                  .index = thing->index,
                  .symbol = *found,
                  .name = fmt::format("{}.{}", thing->name, devices::name_of(type, *found))};
}

bool QmoveController::has_terminal(const Address& address) const {
  return with_terminals(cards_, address,
                        [](const auto& terminals, const auto& key) { return terminals.contains(key); });
}

std::optional<ControllerValue> QmoveController::find(const std::string& name) {
  const std::optional<Location> found = locate(name);
  if (!found) return std::nullopt;
  const int index = found->index;
  const Size size = found->size;
  ControllerValue value{found->name, {}, {}, {}};
  switch (found->kind) {
    case Location::Kind::cell:
      value.read = [this, index, size] { return cell_value(index, size); };
      value.write = [this, index, size](double x) { set_cell(index, size, x); };
      value.range = range_of(size);
      break;
    case Location::Kind::timer:
      value.read = [this, index] { return machine_.now >= machine_.timers[index] ? 1.0 : 0.0; };
      value.write = [this, index](double ms) {
        constexpr std::int64_t ns_per_ms = 1'000'000;
        machine_.timers[index] = machine_.now + std::max(wrap(Size::L, whole(ms)), 0) * ns_per_ms;
      };
      value.range = ValueRange{0, std::numeric_limits<std::int32_t>::max(), true};
      break;
    case Location::Kind::input:
      value.read = [this, index] { return machine_.inputs[index]->level ? 1.0 : 0.0; };
      break;
    case Location::Kind::output:
      value.read = [this, index] { return machine_.outputs[index]->level ? 1.0 : 0.0; };
      break;
    case Location::Kind::device: {
      const Symbol symbol = found->symbol;
      const DeviceType& type = machine_.devices[static_cast<std::size_t>(index)]->type();
      value.read = [this, index, symbol] {
        return static_cast<double>(machine_.devices[index]->read(symbol));
      };
      if (symbol.kind == Symbol::Kind::state) {
        value.meaning = type.states[static_cast<std::size_t>(symbol.index)].meaning;
        break;
      }
      const DeviceVariable& variable = type.variables[static_cast<std::size_t>(symbol.index)];
      value.unit = variable.unit;
      value.meaning = variable.meaning;
      value.of_table = variable.rows > 1;
      value.range = ValueRange{variable.min, variable.max, true};
      if (variable.access == Access::read_write)
        value.write = [this, index, symbol](double x) { write_device(index, symbol, x); };
      break;
    }
    case Location::Kind::terminal:
      return terminal_value(*found);
    case Location::Kind::oserr:
      value.read = [this] { return static_cast<double>(error_); };
      break;
    case Location::Kind::osmode:
      value.read = [this] { return static_cast<double>(mode_); };
      break;
  }
  return value;
}

// The references into Cards stay valid as long as the controller.
ControllerValue QmoveController::terminal_value(const Location& location) {
  const Address& address = location.address;
  const auto level = [](const auto& terminal) { return [&terminal] { return terminal.level ? 1.0 : 0.0; }; };
  ControllerValue value{location.name, {}, {}, {}};
  switch (address.kind) {
    case Kind::counter: {
      const Counter& counter = cards_.counters.at(address);
      value.unit = "counts";
      value.read = [&counter] { return static_cast<double>(counter.count); };
      break;
    }
    case Kind::analogue: {
      const AnalogueOutput& output = cards_.analogue_outputs.at(address);
      value.unit = "V";
      value.read = [&output] { return output.word * dac_full_scale_volts / dac_full_scale; };
      break;
    }
    case Kind::input:
      value.read = level(cards_.inputs.at(address));
      break;
    case Kind::output:
      value.read = level(cards_.outputs.at(address));
      break;
    case Kind::interrupt:
      value.read = level(cards_.interrupt_lines.at(address.number));
      break;
  }
  return value;
}

double QmoveController::cell_value(int cell, Size size) const {
  const std::int32_t content = machine_.cells[static_cast<std::size_t>(cell)];
  return size == Size::S ? static_cast<double>(std::bit_cast<float>(content)) : content;
}

void QmoveController::set_cell(int cell, Size size, double value) {
  std::int32_t& content = machine_.cells[static_cast<std::size_t>(cell)];
  if (size == Size::S) {
    constexpr double most = std::numeric_limits<float>::max();
    const bool holds = std::isnan(value) || std::isinf(value);
    content = std::bit_cast<std::int32_t>(static_cast<float>(holds ? value : std::clamp(value, -most, most)));
  } else {
    content = size == Size::F ? (value != 0 ? 1 : 0) : wrap(size, whole(value));
  }
}

// Without power nobody reads the mailbox.
void QmoveController::write_device(int device, Symbol symbol, double value) {
  const auto number = static_cast<std::size_t>(device);
  if (powered_) {
    machine_.post(number);
    machine_.devices[number]->write(symbol, wrap(Size::L, whole(value)));
  } else {
    events_.push_back(
        {configuration_.devices[number].name, "refused",
         devices::name_of(machine_.devices[number]->type(), symbol) + ": the controller is off"});
  }
}

std::vector<std::string> QmoveController::names() const {
  std::vector<std::string> names;
  for (const NamedThing& thing : names_.things()) {
    switch (thing.kind) {
      case NamedThing::Kind::constant:
      case NamedThing::Kind::group:
        break;
      case NamedThing::Kind::array:
      case NamedThing::Kind::group_static:
        names.push_back(thing.name + "[1]");
        break;
      case NamedThing::Kind::group_step:
        names.push_back(thing.name + "[1,1]");
        break;
      case NamedThing::Kind::device:
        for (const std::string& symbol :
             symbol_names(machine_.devices[static_cast<std::size_t>(thing.index)]->type()))
          names.push_back(fmt::format("{}.{}", thing.name, symbol));
        break;
      default:
        names.push_back(thing.name);
        break;
    }
  }
  for (const auto& [address, terminal] : cards_.counters) names.push_back(to_string(address));
  for (const auto& [address, terminal] : cards_.inputs) names.push_back(to_string(address));
  for (const auto& [address, terminal] : cards_.outputs) names.push_back(to_string(address));
  for (const auto& [address, terminal] : cards_.analogue_outputs) names.push_back(to_string(address));
  for (const auto& [line, terminal] : cards_.interrupt_lines)
    names.push_back(to_string(Address{Kind::interrupt, 0, line}));
  names.emplace_back("QMOS.oserr");
  names.emplace_back("QMOS.osmode");
  return names;
}

}  // namespace drycut::devices::qmove
