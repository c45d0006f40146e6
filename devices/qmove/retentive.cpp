#include <bit>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/qmove/qmove_controller.hpp"

// What the controller remembers without power, as a text that a user can read and edit.
namespace drycut::devices::qmove {

namespace {

// Cell `i` of an array or datagroup variable as a program would name it.
std::string element(const NamedThing& thing, int i) {
  if (thing.kind == NamedThing::Kind::scalar) return thing.name;
  if (thing.kind != NamedThing::Kind::group_step) return fmt::format("{}[{}]", thing.name, i + 1);
  return fmt::format("{}[{},{}]", thing.name, i / thing.steps + 1, i % thing.steps + 1);
}

}  // namespace

std::string QmoveController::retentive_state() const {
  std::string text = fmt::format("; retentive values of {}\n", configuration_.file);
  for (const NamedThing& thing : names_.things()) {
    if (thing.kind == NamedThing::Kind::device) {
      const Device& device = *machine_.devices[static_cast<std::size_t>(thing.index)];
      const auto add = [&](Symbol symbol) {
        text += fmt::format("{}:{} = {}\n", thing.name, devices::name_of(device.type(), symbol),
                            device.read(symbol));
      };
      for (std::size_t i = 0; i < device.type().variables.size(); ++i)
        for (int row = 0; row < device.type().variables[i].rows; ++row)
          if (device.type().variables[i].retention == Retention::retentive)
            add({Symbol::Kind::variable, static_cast<int>(i), row});
      for (std::size_t i = 0; i < device.type().states.size(); ++i)
        if (device.type().states[i].retention == Retention::retentive)
          add({Symbol::Kind::state, static_cast<int>(i), 0});
      continue;
    }
    if (cell_count(thing) == 0 || thing.index < names_.volatile_cells()) continue;
    for (int i = 0; i < cell_count(thing); ++i) {
      const std::int32_t content = machine_.cells[thing.index + i];
      if (thing.kind != NamedThing::Kind::scalar && content == 0) continue;
      if (thing.size == Size::S)
        text += fmt::format("{} = {}\n", element(thing, i), std::bit_cast<float>(content));
      else
        text += fmt::format("{} = {}\n", element(thing, i), content);
    }
  }
  return text;
}

bool QmoveController::restore(const std::string& text, Problems& problems, const std::string& file_name) {
  const std::size_t first = problems.size();
  std::vector<Kept> kept;
  std::set<std::string> seen;
  const std::vector<std::string_view> lines = split_lines(text);
  for (std::size_t i = 0; i < lines.size(); ++i)
    read_kept(lines[i], static_cast<int>(i) + 1, file_name, seen, kept, problems);
  if (problems.size() > first) return false;

  std::fill(machine_.cells.begin() + names_.volatile_cells(), machine_.cells.end(), 0);
  for (const Kept& item : kept) {
    if (item.location.kind == Location::Kind::cell)
      set_cell(item.location.index, item.location.size, item.value);
    else
      machine_.devices[static_cast<std::size_t>(item.location.index)]->restore(
          item.location.symbol, static_cast<std::int32_t>(item.value));
  }
  return true;
}

// One line, `name = value`; a comment begins with ';'.
void QmoveController::read_kept(std::string_view line, int number, const std::string& file,
                                std::set<std::string>& seen, std::vector<Kept>& kept,
                                Problems& problems) const {
  const std::string_view statement = line.substr(0, line.find(';'));
  const std::string_view content = trimmed(statement);
  if (content.empty()) return;
  const auto complain = [&](Code code, std::string_view at, std::string what, std::string remedy) {
    problems.push_back({code, file, number, static_cast<int>(at.data() - line.data()) + 1, std::move(what),
                        std::move(remedy)});
  };
  const std::size_t equals = content.find('=');
  if (equals == std::string_view::npos)
    return complain("controller.retained-value"_code, content, "no '=' in " + in_quotes(content),
                    "write: name = value");
  const std::string_view name = trimmed(content.substr(0, equals));
  const std::string_view value_text = trimmed(content.substr(equals + 1));
  if (name.empty() || value_text.empty())
    return complain("controller.retained-value"_code, content, "a name or value is missing",
                    "write: name = value");

  std::optional<Location> location = locate(name);
  if (!location)
    return complain("controller.unknown-retained"_code, name, "unknown name " + in_quotes(name),
                    suggestion(name, names(), "remove the line"));
  if (!is_retentive(*location))
    return complain("controller.unknown-retained"_code, name, in_quotes(name) + " is not retentive",
                    "remove the line, it is set at each start");
  if (!seen.insert(location->name).second)
    return complain("controller.retained-twice"_code, name, in_quotes(name) + " is given twice",
                    "remove one of the lines");
  if (location->kind == Location::Kind::device &&
      machine_.devices[static_cast<std::size_t>(location->index)]->read({Symbol::Kind::state, 0, 0}) != 0)
    return complain("controller.retained-twice"_code, name,
                    "the device of " + in_quotes(name) + " is initialised already",
                    "restore before the first run");

  const std::optional<double> value = parsed<double>(value_text);
  const ValueRange range = range_of(location->size);
  // A single may have become infinite or not-a-number, and stays so.
  const bool odd = value && location->size == Size::S && !std::isfinite(*value);
  const bool fits = odd || (value && *value >= range.low && *value <= range.high &&
                            (!range.whole || std::trunc(*value) == *value));
  if (!fits)
    return complain("controller.retained-value"_code, value_text,
                    fmt::format("{} cannot be {}", in_quotes(name), in_quotes(value_text)),
                    fmt::format("write a{} number from {:.10g} to {:.10g}", range.whole ? " whole" : "",
                                range.low, range.high));
  kept.push_back({*std::move(location), *value});
}

bool QmoveController::is_retentive(const Location& location) const {
  if (location.kind == Location::Kind::cell) return location.index >= names_.volatile_cells();
  if (location.kind != Location::Kind::device) return false;
  const DeviceType& type = machine_.devices[static_cast<std::size_t>(location.index)]->type();
  const auto row = static_cast<std::size_t>(location.symbol.index);
  const Retention retention = location.symbol.kind == Symbol::Kind::state ? type.states[row].retention
                                                                          : type.variables[row].retention;
  return retention == Retention::retentive;
}

}  // namespace drycut::devices::qmove
