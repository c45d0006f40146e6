// The controller's values by name, and what it keeps without power.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>

#include "base/text.hpp"
#include "devices/plcopen/controller/controller.hpp"

namespace drycut::devices::plcopen {
namespace {

// An element of a cam table, lines and columns from 1.
struct TableElement {
  std::uint16_t id = 0;
  std::size_t line = 0;
  int column = 0;
};

// Reads "table1[3,2]".
std::optional<TableElement> parse_element(std::string_view text) {
  constexpr std::string_view word = "table";
  if (!lower(text).starts_with(word)) return std::nullopt;
  const char* const end = text.data() + text.size();
  TableElement element;
  const auto id = std::from_chars(text.data() + word.size(), end, element.id);
  if (id.ec != std::errc() || id.ptr == end || *id.ptr != '[') return std::nullopt;
  const auto line = std::from_chars(id.ptr + 1, end, element.line);
  if (line.ec != std::errc() || line.ptr == end || *line.ptr != ',') return std::nullopt;
  const auto column = std::from_chars(line.ptr + 1, end, element.column);
  if (column.ec != std::errc() || column.ptr + 1 != end || *column.ptr != ']') return std::nullopt;
  return element;
}

}  // namespace

std::optional<ControllerValue> PlcopenController::find(const std::string& name) {
  if (const auto dot = name.find('.'); dot != std::string::npos) {
    if (const AxisRef ref = kernel_.find_axis(std::string_view(name).substr(0, dot)); ref.number >= 0)
      return axis_value(ref.number, std::string_view(name).substr(dot + 1));
  }
  if (const auto symbol = symbols_.find(lower(name)); symbol != symbols_.end())
    return symbol_value(symbol->second);
  return table_value(name);
}

std::optional<ControllerValue> PlcopenController::axis_value(int number, std::string_view name) {
  const std::string wanted = lower(name);
  const AxisConfiguration& configured = configuration_.axes[static_cast<std::size_t>(number)];
  for (const AxisParameter& parameter : axis_parameter_table())
    if (lower(parameter.name) == wanted) return parameter_value(number, parameter);
  for (const AxisValue& row : axis_value_table()) {
    if (row.name != wanted) continue;
    ControllerValue value{fmt::format("{}.{}", configured.name, row.name),
                          std::string(unit_of(row.quantity, configured.measure)),
                          [this, number, &row] {
                            const bool off = !powered_ && row.write == nullptr;
                            return off ? 0 : row.read(axis(number));
                          },
                          {},
                          {}};
    value.meaning = row.meaning;
    const auto wired = [&](const AxisTerminal& terminal) {
      return terminal.kind == Kind::input && terminal.name == row.name &&
             cards_.inputs.contains(terminal.address(number));
    };
    const auto terminals = axis_terminal_table();
    if (row.write == nullptr || std::any_of(terminals.begin(), terminals.end(), wired)) return value;
    value.range = ValueRange{row.min, row.max};
    value.write = [this, number, &row](double wish) {
      if (wish >= row.min && wish <= row.max) return row.write(axis(number), wish);
      events_.push_back({axis(number).name(), "out_of_range",
                         fmt::format("{} is from {} to {}, not {}", row.name, row.min, row.max, wish)});
    };
    return value;
  }
  return std::nullopt;
}

std::optional<ControllerValue> PlcopenController::parameter_value(int number,
                                                                  const AxisParameter& parameter) {
  const AxisConfiguration& configured = configuration_.axes[static_cast<std::size_t>(number)];
  ControllerValue value{fmt::format("{}.{}", configured.name, parameter.name),
                        std::string(unit_of(parameter, configured.measure)),
                        [this, number, &parameter] { return parameter.value(axis(number).parameters()); },
                        {},
                        {}};
  value.meaning = parameter.meaning;
  // What an axis is made of has been wired.
  if (parameter.is(&AxisParameters::kind)) return value;
  value.range = ValueRange{parameter.min, parameter.max, parameter.whole};
  value.write = [this, number, &parameter](double wish) { set_parameter(number, parameter, wish); };
  return value;
}

void PlcopenController::set_parameter(int number, const AxisParameter& parameter, double value) {
  Axis& written = axis(number);
  if (written.set_parameter(parameter, value)) return;
  const bool fits = value >= parameter.min && value <= parameter.max;
  const bool whole = !parameter.whole || value == std::round(value);
  if (fits && whole)
    events_.push_back({written.name(), "refused",
                       fmt::format("{} can be changed only while the axis is Disabled", parameter.name)});
  else
    events_.push_back({written.name(), "out_of_range",
                       fmt::format("{} is {}from {} to {}, not {}", parameter.name,
                                   parameter.whole ? "whole, " : "", parameter.min, parameter.max, value)});
}

std::optional<ControllerValue> PlcopenController::table_value(std::string_view name) {
  const auto element = parse_element(name);
  if (!element) return std::nullopt;
  const McCamTable* table = kernel_.tables().find(element->id);
  const bool exists = table != nullptr && element->line >= 1 && element->line <= table->lines() &&
                      element->column >= 1 && element->column <= table->columns();
  if (!exists) return std::nullopt;
  const std::size_t line = element->line - 1;
  const int column = element->column - 1;
  const auto id = element->id;
  return ControllerValue{
      fmt::format("table{}[{},{}]", id, element->line, element->column),
      "",
      [this, id, line, column] { return kernel_.tables().find(id)->value(line, column); },
      [this, id, line, column](double value) {
        const ErrorId error = kernel_.write_table(id, line, column, value);
        if (error == ErrorId::none) return;
        events_.push_back({fmt::format("table{}", id), "refused",
                           fmt::format("[{},{}] = {}: {} {}", line + 1, column + 1, value,
                                       static_cast<std::uint32_t>(error), meaning_of(error))});
      },
      {}};
}

ControllerValue PlcopenController::symbol_value(std::size_t symbol) {
  const st::StSymbol& of = runtime_.symbols()[symbol];
  ControllerValue value{
      of.name,
      of.unit,
      [this, symbol, retain = of.retain] { return powered_ || retain ? runtime_.read(symbol) : 0; },
      {},
      {}};
  if (!of.writable) return value;
  const bool whole = of.type != "REAL" && of.type != "LREAL" && of.type != "TIME";
  value.range = ValueRange{of.min, of.max, whole};
  value.write = [this, symbol](double number) { runtime_.write(symbol, number); };
  return value;
}

std::vector<std::string> PlcopenController::names() const {
  std::vector<std::string> names;
  for (const st::StSymbol& symbol : runtime_.symbols()) names.push_back(symbol.name);
  for (const AxisConfiguration& axis : configuration_.axes) {
    for (const AxisValue& value : axis_value_table())
      names.push_back(fmt::format("{}.{}", axis.name, value.name));
    for (const AxisParameter& parameter : axis_parameter_table())
      names.push_back(fmt::format("{}.{}", axis.name, parameter.name));
  }
  return names;
}

std::string PlcopenController::retentive_state() const {
  std::string text = fmt::format("; RETAIN variables of {}\n", fmt::join(files_, ", "));
  const auto symbols = runtime_.symbols();
  for (std::size_t i = 0; i < symbols.size(); ++i)
    if (symbols[i].retain) text += fmt::format("{} = {}\n", symbols[i].name, runtime_.read(i));
  return text;
}

bool PlcopenController::restore(const std::string& text, Problems& problems, const std::string& file_name) {
  const std::size_t before = problems.size();
  std::vector<std::pair<std::size_t, double>> kept;
  int number = 0;
  for (const std::string_view line : split_lines(without_byte_order_mark(text)))
    read_kept(line, ++number, file_name, kept, problems);
  if (problems.size() > before) return false;
  for (const auto& [symbol, value] : kept) runtime_.write(symbol, value);
  return true;
}

// One line, `name = value`; a comment begins with ';'.
void PlcopenController::read_kept(std::string_view line, int number, const std::string& file,
                                  std::vector<std::pair<std::size_t, double>>& kept,
                                  Problems& problems) const {
  const std::string_view content = trimmed(line.substr(0, line.find(';')));
  if (content.empty()) return;
  const auto complain = [&](Code code, std::string_view at, std::string what, std::string remedy) {
    problems.push_back({code, file, number, static_cast<int>(at.data() - line.data()) + 1, std::move(what),
                        std::move(remedy)});
  };
  const std::size_t equals = content.find('=');
  const std::string_view name = trimmed(content.substr(0, equals));
  const std::string_view value_text =
      equals == std::string_view::npos ? std::string_view() : trimmed(content.substr(equals + 1));
  if (name.empty() || value_text.empty())
    return complain("controller.retained-value"_code, content, fmt::format("'{}' is no value", content),
                    "write: name = value");
  const auto found = symbols_.find(lower(name));
  const st::StSymbol* symbol = found == symbols_.end() ? nullptr : &runtime_.symbols()[found->second];
  if (symbol == nullptr || !symbol->retain)
    return complain("controller.unknown-retained"_code, name,
                    fmt::format("the program has no RETAIN variable '{}'", name), "remove the line");
  for (const auto& [other, value] : kept)
    if (other == found->second)
      return complain("controller.retained-twice"_code, name, fmt::format("'{}' is given twice", name),
                      "remove one of the lines");
  const std::optional<double> given = parsed<double>(value_text);
  if (!given || !(*given >= symbol->min && *given <= symbol->max))
    return complain("controller.retained-value"_code, value_text,
                    fmt::format("{} cannot be '{}'", symbol->name, value_text),
                    fmt::format("write a number from {} to {}", symbol->min, symbol->max));
  kept.emplace_back(found->second, *given);
}

}  // namespace drycut::devices::plcopen
