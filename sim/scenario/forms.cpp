// The forms of values: how each is read, written and described.
#include "sim/scenario/archive.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "sim/scenario/format.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

std::string schema_of_unit(std::string_view unit) {
  return std::string(needs_unit(unit) ? quantity_schema : number_schema);
}

std::string schema_of_whole(long long min, long long max) {
  return fmt::format(
      R"({{"type": ["integer", "string"], "minimum": {}, "maximum": {}, "pattern": "^-?[0-9]+$"}})", min,
      max);
}

std::string schema_of_words(const std::vector<std::string>& words) {
  return fmt::format(R"({{"enum": ["{}"]}})", fmt::join(words, R"(", ")"));
}

// A number in the parameter's unit as a message shows it.
std::string shown(double number, std::string_view unit) {
  return unit.empty() ? fmt::format("{:.12g}", number) : fmt::format("{:.12g} {}", number, unit);
}

void refuse_range(const plants::Parameter& parameter, const Text& text, const std::string& what,
                  Findings& findings) {
  findings.add(
      "scenario.out-of-range"_code, text.place, what,
      fmt::format("{} to {}", shown(parameter.min, parameter.unit), shown(parameter.max, parameter.unit)));
}

void assign(const plants::Parameter& parameter, double& bound, const Text& text, const std::string& name,
            Findings& findings) {
  const auto si = read_si(text, name, parameter.unit, findings);
  if (!si) return;
  const auto quantity = parse_quantity(text.text);
  const bool same_unit = quantity->unit.empty() || quantity->unit == parameter.unit;
  const double number = same_unit ? quantity->number : from_si(*si, parameter.unit);
  // Another unit's conversion may miss a limit by its last digit.
  const double slack = same_unit ? 0 : 1e-12 * std::max(std::abs(parameter.min), std::abs(parameter.max));
  if (number >= parameter.min - slack && number <= parameter.max + slack)
    bound = *si;
  else
    refuse_range(parameter, text, fmt::format("{} is {}, out of range", name, shown(number, parameter.unit)),
                 findings);
}

void assign(const plants::Parameter& parameter, int& bound, const Text& text, const std::string& name,
            Findings& findings) {
  const auto si = read_si(text, name, parameter.unit, findings);
  if (!si) return;
  const double number = from_si(*si, parameter.unit);
  if (number != std::round(number))
    refuse_range(parameter, text, fmt::format("{} is {}, not a whole number", name, text.text), findings);
  else if (!(number >= parameter.min && number <= parameter.max))
    refuse_range(parameter, text, fmt::format("{} is {}, out of range", name, shown(number, parameter.unit)),
                 findings);
  else
    bound = static_cast<int>(number);
}

void assign(const plants::Parameter&, bool& bound, const Text& text, const std::string& name,
            Findings& findings) {
  bound = read_switch(text, name, findings).value_or(bound);
}

void assign(const plants::Parameter& parameter, std::string& bound, const Text& text, const std::string& name,
            Findings& findings) {
  if (parameter.choices.empty() || read_choice(text, name, parameter.choices, findings)) bound = text.text;
}

std::vector<Text> read_texts(const YamlNode& list, const std::string& name, Findings& findings) {
  std::vector<Text> texts;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const auto& item = list.items[i];
    if (item.kind == YamlNode::Kind::scalar)
      texts.push_back(item.text);
    else
      refuse_kind(item, fmt::format("{}.{}", name, i), YamlNode::Kind::scalar, findings);
  }
  return texts;
}

std::string texts_text(const std::vector<Text>& texts) {
  std::vector<std::string> items;
  for (const auto& text : texts) items.push_back(yaml_text(text.text));
  return yaml_list(items);
}

const auto take_text = [](const Text& text, auto&&...) { return std::optional(text); };
const auto take_expression = [](const Text& text, const std::string&, Findings& findings) {
  check_expression(text, findings);
  return std::optional(text);
};
const auto write_text = [](const Text& text) { return yaml_text(text.text); };
const auto write_quoted = [](const Text& text) { return yaml_quoted(text.text); };
const auto write_switch = [](bool on) { return std::string(on ? "on" : "off"); };
const auto write_number = [](auto number) { return fmt::format("{}", number); };
const auto write_quantity = [](const Quantity& quantity) {
  const auto number = fmt::format("{}", quantity.number);
  return quantity.unit.empty() ? number : yaml_text(fmt::format("{} {}", number, quantity.unit));
};

constexpr std::string_view seed_schema = R"({"type": ["integer", "string"], "minimum": 0})";

std::optional<std::uint64_t> read_seed(const Text& text, const std::string& name, Findings& findings) {
  std::uint64_t number = 0;
  const char* const end = text.text.data() + text.text.size();
  const auto parsed = std::from_chars(text.text.data(), end, number);
  if (parsed.ec == std::errc() && parsed.ptr == end) return number;
  findings.add("scenario.not-a-number"_code, text.place,
               fmt::format("{}: '{}' is not a whole number", name, text.text), "0 to 18446744073709551615");
  return {};
}

// Of an optional: nothing to write where it is absent.
template <typename Write>
auto if_given(Write write) {
  return [write](const auto& value) { return value ? write(*value) : std::string(); };
}

// A single value that `read` makes, if it can, and `write` writes.
template <typename Value, typename Read, typename Write>
Form bound(Value& value, Read read, Write write, std::string_view schema) {
  return single(
      [&value, read](const Text& text, const std::string& name, Findings& findings) {
        if (auto made = read(text, name, findings))
          value = static_cast<std::remove_reference_t<decltype(value)>>(*made);
      },
      [&value, write] { return write(value); }, std::string(schema));
}

template <typename Texts, typename Write>
Form bound_list(Texts& texts, Write write) {
  return whole(
      YamlNode::Kind::sequence,
      [&texts](const YamlNode& list, const Form::Name& name, Findings& findings) {
        texts = read_texts(list, name.full, findings);
      },
      [&texts, write] { return write(texts); }, std::string(texts_schema));
}

}  // namespace

Form whole(YamlNode::Kind kind, std::function<void(const YamlNode&, const Form::Name&, Findings&)> read,
           std::function<std::string()> write, std::string schema) {
  return {[kind, read = std::move(read)](const YamlNode& node, const Form::Name& name, Findings& findings) {
            if (node.kind == kind)
              read(node, name, findings);
            else
              refuse_kind(node, name.full, kind, findings);
          },
          std::move(write), [schema = std::move(schema)] { return schema; }};
}

Form single(std::function<void(const Text&, const std::string&, Findings&)> read,
            std::function<std::string()> write, std::string schema) {
  return whole(
      YamlNode::Kind::scalar,
      [read = std::move(read)](const YamlNode& node, const Form::Name& name, Findings& findings) {
        read(node.text, name.full, findings);
      },
      std::move(write), std::move(schema));
}

Form form(std::string& value) {
  return bound(
      value, [](const Text& text, auto&&...) { return std::optional(text.text); }, yaml_text,
      any_text_schema);
}

Form form(Text& value) { return bound(value, take_text, write_text, any_text_schema); }

Form path_form(Text& value) {
  const auto read = [](const Text& text, const std::string&, Findings& findings) {
    auto made = text;
    made.text = findings.path_from(text);
    return std::optional(made);
  };
  return bound(value, read, write_text, any_text_schema);
}

Form path_form(std::vector<Text>& values) {
  auto made = form(values);
  made.read = [&values, read = made.read](const YamlNode& node, const Form::Name& name, Findings& findings) {
    read(node, name, findings);
    for (auto& value : values) value.text = findings.path_from(value);
  };
  return made;
}

Form paths_form(std::vector<Text>& values) {
  auto made = path_form(values);
  made.read = [&values, read = made.read](const YamlNode& node, const Form::Name& name, Findings& findings) {
    if (node.kind != YamlNode::Kind::scalar) return read(node, name, findings);
    values = {node.text};
    values.front().text = findings.path_from(node.text);
  };
  made.write = [&values, write = made.write] {
    return values.size() == 1 ? yaml_text(values.front().text) : write();
  };
  made.schema = [] { return fmt::format(R"({{"anyOf": [{}, {}]}})", any_text_schema, texts_schema); };
  return made;
}

Form quoted_form(Text& value) { return bound(value, take_text, write_quoted, any_text_schema); }

Form expression_form(Text& value) { return bound(value, take_expression, write_quoted, any_text_schema); }

Form expression_form(std::optional<Text>& value) {
  return bound(value, take_expression, if_given(write_quoted), any_text_schema);
}

Form form(bool& value) { return bound(value, read_switch, write_switch, switch_schema); }

Form form(std::optional<bool>& value) {
  return bound(value, read_switch, if_given(write_switch), switch_schema);
}

Form form(std::vector<Text>& values) { return bound_list(values, texts_text); }

Form form(std::optional<std::vector<Text>>& values) { return bound_list(values, if_given(texts_text)); }

Form form(Time& value, Sign sign) {
  const auto read = [sign](const Text& text, const std::string& name, Findings& findings) {
    return read_time(text, name, sign, findings);
  };
  return bound(value, read, format_time, quantity_schema);
}

Form form(std::optional<Time>& value, Sign sign) {
  const auto read = [sign](const Text& text, const std::string& name, Findings& findings) {
    return std::optional(read_time(text, name, sign, findings).value_or(0));
  };
  return bound(value, read, if_given(format_time), quantity_schema);
}

Form form(int& value, int min, int max) {
  const auto read = [min, max](const Text& text, const std::string& name, Findings& findings) {
    return read_integer(text, name, min, max, findings);
  };
  return bound(value, read, write_number, schema_of_whole(min, max));
}

Form form(std::uint64_t& value) { return bound(value, read_seed, write_number, seed_schema); }

Form form(std::optional<std::uint64_t>& value) {
  return bound(value, read_seed, if_given(write_number), seed_schema);
}

Form form(Quantity& value) { return bound(value, read_quantity, write_quantity, number_schema); }

Form form(double& value, std::string_view unit, double min, double max, std::string_view range) {
  return single(
      [=, &value](const Text& text, const std::string& name, Findings& findings) {
        const auto si = read_si(text, name, unit, findings);
        if (!si) return;
        value = *si;
        if (value < min || value > max)
          findings.add("scenario.out-of-range"_code, text.place,
                       fmt::format("{} is {}, out of range", name, text.text), std::string(range));
      },
      [&value, unit] {
        return unit.empty() ? fmt::format("{}", value) : yaml_text(format_quantity(value, unit));
      },
      schema_of_unit(unit));
}

Form form(std::array<double, 3>& values, std::string_view unit) {
  return whole(
      YamlNode::Kind::sequence,
      [&values, unit](const YamlNode& list, const Form::Name& name, Findings& findings) {
        const auto before = findings.count();
        const auto texts = read_texts(list, name.full, findings);
        if (findings.count() != before) return;
        if (texts.size() != values.size()) {
          findings.add("scenario.not-a-number"_code, name.key,
                       fmt::format("{} has {} numbers", name.full, texts.size()),
                       fmt::format("write three, along x, y and z: [0 {0}, 20 {0}, 0 {0}]", unit));
          return;
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
          const auto value = read_si(texts[i], fmt::format("{}.{}", name.full, i), unit, findings);
          values[i] = value.value_or(values[i]);
        }
      },
      [&values, unit] {
        std::vector<std::string> items;
        for (const double value : values) items.push_back(yaml_text(format_quantity(value, unit)));
        return yaml_list(items);
      },
      fmt::format(R"({{"type": "array", "minItems": 3, "maxItems": 3, "items": {}}})", schema_of_unit(unit)));
}

namespace {

/// Two limits as they may have been meant.
std::string example_of(const std::vector<double>& numbers) {
  if (numbers.size() < 2) return "for example [499.8, 500.2]";
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  return fmt::format("for example [{}, {}]", *least, *most);
}

}  // namespace

Form form(std::optional<std::pair<double, double>>& values) {
  return whole(
      YamlNode::Kind::sequence,
      [&values](const YamlNode& list, const Form::Name& name, Findings& findings) {
        const auto numbers = read_numbers(list, name.full, findings);
        if (!numbers) return;
        if (numbers->size() == 2 && numbers->front() <= numbers->back()) {
          values = {numbers->front(), numbers->back()};
          return;
        }
        findings.add("scenario.order"_code, list.text.place,
                     fmt::format("{} must be a lower and an upper limit", name.full), example_of(*numbers));
      },
      [&values] { return values ? fmt::format("[{}, {}]", values->first, values->second) : ""; },
      std::string(pair_schema));
}

Form form(std::vector<std::pair<Text, double>>& values) {
  return whole(
      YamlNode::Kind::map,
      [&values](const YamlNode& map, const Form::Name& of, Findings& findings) {
        refuse_duplicates(map, of.full, findings);
        for (const auto& entry : map.entries) {
          const auto name = fmt::format("{}.{}", of.full, entry.key.text);
          if (entry.value.kind != YamlNode::Kind::scalar)
            refuse_kind(entry.value, name, YamlNode::Kind::scalar, findings);
          else if (const auto number = read_si(entry.value.text, name, "", findings))
            values.emplace_back(entry.key, *number);
        }
      },
      [&values] {
        std::vector<std::string> items;
        for (const auto& [name, value] : values)
          items.push_back(fmt::format("{}: {}", yaml_text(name.text), value));
        return yaml_map(items);
      },
      map_schema(number_schema));
}

std::string map_schema(std::string_view item) {
  return fmt::format(R"({{"type": "object", "additionalProperties": {}}})", item);
}

std::optional<std::vector<double>> read_numbers(const YamlNode& list, const std::string& name,
                                                Findings& findings) {
  std::vector<double> numbers;
  for (const auto& text : read_texts(list, name, findings))
    if (const auto number = read_si(text, name, "", findings)) numbers.push_back(*number);
  if (numbers.size() != list.items.size()) return {};
  return numbers;
}

Form form(const plants::Parameter& parameter) {
  auto made = single(
      [&parameter](const Text& text, const std::string& name, Findings& findings) {
        std::visit([&](auto* bound) { assign(parameter, *bound, text, name, findings); }, parameter.value);
      },
      [&parameter] { return yaml_text(value_text(parameter)); }, "");
  made.schema = [&parameter] {
    if (std::holds_alternative<bool*>(parameter.value)) return std::string(switch_schema);
    if (!std::holds_alternative<std::string*>(parameter.value)) return schema_of_unit(parameter.unit);
    return parameter.choices.empty() ? std::string(any_text_schema) : schema_of_words(parameter.choices);
  };
  return made;
}

Form choice_form(std::vector<std::string> words, std::function<std::size_t()> get,
                 std::function<void(std::size_t)> set) {
  auto schema = schema_of_words(words);
  return single(
      [words, set = std::move(set)](const Text& text, const std::string& name, Findings& findings) {
        if (!read_choice(text, name, words, findings)) return;
        set(static_cast<std::size_t>(std::find(words.begin(), words.end(), text.text) - words.begin()));
      },
      [words, get = std::move(get)] { return words.at(get()); }, std::move(schema));
}

}  // namespace drycut::sim::scenario
