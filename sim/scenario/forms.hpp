#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plants/parameters.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim::scenario {

// The forms that values have in a scenario. Each is bound to what it reads and writes, which outlives it.

Form form(std::string& value);
Form form(Text& value);
/// A file, relative to the scenario's folder; in the file that names it, to that one's.
Form path_form(Text& value);
Form path_form(std::vector<Text>& values);
/// on, off, true, false.
Form form(bool& value);
Form form(std::optional<bool>& value);
Form form(std::vector<Text>& values);
Form form(std::optional<std::vector<Text>>& values);
/// A duration of whole nanoseconds. A wrong one still counts as given where it is optional, so that nothing
/// else complains that it is missing.
Form form(Time& value, Sign sign);
Form form(std::optional<Time>& value, Sign sign);
Form form(int& value, int min, int max);
Form form(std::uint64_t& value);
Form form(std::optional<std::uint64_t>& value);
/// A number with its unit; what it must measure is seen later.
Form form(Quantity& value);
/// A quantity of the dimension of `unit`, `value` in SI. Outside min..max (SI), `range` is told.
Form form(double& value, std::string_view unit, double min, double max, std::string_view range);
/// Three quantities along x, y and z, in SI: [0 mm, 20 mm, 0 mm]
Form form(std::array<double, 3>& values, std::string_view unit);
/// A lower and an upper limit: [499.8, 500.2]
Form form(std::optional<std::pair<double, double>>& values);
/// Names with pure numbers: {slLength: 800}
Form form(std::vector<std::pair<Text, double>>& values);
/// A parameter of a plant, bound to its member.
Form form(const plants::Parameter& parameter);
/// An expression's syntax; names are looked up later.
Form expression_form(Text& value);
Form expression_form(std::optional<Text>& value);
/// A formula that is looked at later.
Form quoted_form(Text& value);
/// One word of `words`: `get` and `set` take its number.
Form choice_form(std::vector<std::string> words, std::function<std::size_t()> get,
                 std::function<void(std::size_t)> set);
template <typename Choice>
Form choice_form(std::vector<std::string> words, Choice& choice) {
  return choice_form(
      std::move(words), [&choice] { return static_cast<std::size_t>(choice); },
      [&choice](std::size_t number) { choice = static_cast<Choice>(number); });
}

/// A form of a single value: another kind of node is refused before `read`.
Form single(std::function<void(const Text&, const std::string&, Findings&)> read,
            std::function<std::string()> write, std::string schema);
/// A form that is a map or a list: another kind is refused before `read`.
Form whole(YamlNode::Kind kind, std::function<void(const YamlNode&, const Form::Name&, Findings&)> read,
           std::function<std::string()> write, std::string schema);
/// The pure numbers of a list; nothing if one of them is none, which is told.
std::optional<std::vector<double>> read_numbers(const YamlNode& list, const std::string& name,
                                                Findings& findings);

// JSON Schemas of single values.
inline constexpr std::string_view any_text_schema = R"({"type": ["string", "number", "boolean"]})";
inline constexpr std::string_view switch_schema = R"({"enum": [true, false, "on", "off", "true", "false"]})";
inline constexpr std::string_view texts_schema =
    R"({"type": "array", "items": {"type": ["string", "number", "boolean"]}})";
/// Of a number, with or without a unit.
inline constexpr std::string_view number_schema =
    R"({"type": ["number", "string"], "pattern": "^[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?"})";
/// Of a number that must have a unit.
inline constexpr std::string_view quantity_schema =
    R"({"type": "string", "pattern": "^[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)? *(1/)?[^ 0-9.+-]"})";

/// Of a lower and an upper limit, of a place in a plane.
inline constexpr std::string_view pair_schema =
    R"({"type": "array", "items": {"type": ["number", "string"]}, "minItems": 2, "maxItems": 2})";
/// Of a map of the user's names, each with an `item`.
std::string map_schema(std::string_view item);

}  // namespace drycut::sim::scenario
