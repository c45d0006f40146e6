#pragma once
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace drycut::plants {

/// The word by which a reference parameter names no plant, where its default does.
inline constexpr std::string_view no_plant = "none";

/// The word by which a group of a motor's values names no model of a catalogue.
inline constexpr std::string_view no_model = "none";

/// A choice of a word that stands for values of other parameters of the same table, "steel" for its density
/// and more. Whoever fills the table takes these values first, then those that are given beside it.
struct Preset {
  struct Value {
    std::string_view parameter;
    double value;             ///< [SI]
    std::string_view source;  ///< where it is from
  };
  std::string_view name;
  std::string_view meaning;
  std::vector<Value> values;
};

/// One parameter of a plant, bound to the member that holds it. A plain struct with defaults is the schema:
/// this table over it is what the scenario reader fills, `drycut check --expand` writes and `drycut plants`
/// prints.
struct Parameter {
  std::string name;          ///< as in the scenario; a dot is a nested map ("servo.rated_torque")
  std::string_view unit;     ///< unit in which it is printed and in which min and max are given; "" = pure
                             ///< number. The bound member always holds SI (m, kg, s, rad, N m, V).
  std::string_view meaning;  ///< one sentence
  /// What it is bound to: a quantity or number, an integer, a switch, a word.
  std::variant<double*, int*, bool*, std::string*> value;
  double min = 0;  ///< smallest and largest legal value, in `unit`
  double max = 0;
  std::vector<std::string> choices = {};  ///< of a word; empty = free
  std::string_view reference = {};        ///< of a word: it names another plant of this type
  std::string_view source = {};           ///< where the default is from ("data sheet ...", "estimate")
  bool sole = false;                      ///< of a reference: no other plant may refer to the same one so
  const std::vector<Preset>* presets = nullptr;  ///< of a word: what each choice stands for
  bool live = false;                             ///< of a quantity: the running machine takes another one
};
using Parameters = std::vector<Parameter>;

// The rows of a table: a quantity, a whole number, a switch, a word of `choices`, the name of a plant of
// `type`. `source`: where the default is from.

inline Parameter row(std::string name, std::string_view unit, std::string_view meaning, double& value,
                     double min, double max, std::string_view source) {
  return {std::move(name), unit, meaning, &value, min, max, {}, {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, int& value, double min, double max,
                     std::string_view source) {
  return {std::move(name), "", meaning, &value, min, max, {}, {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, bool& value, std::string_view source) {
  return {std::move(name), "", meaning, &value, 0, 1, {}, {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, std::string& value,
                     std::vector<std::string> choices, std::string_view source) {
  return {std::move(name), "", meaning, &value, 0, 0, std::move(choices), {}, source};
}
inline Parameter row(std::string name, std::string_view meaning, std::string& value, std::string_view type,
                     std::string_view source, bool sole) {
  return {std::move(name), "", meaning, &value, 0, 0, {}, type, source, sole};
}

/// A word whose choices are the names of `presets`, which outlive the table.
inline Parameter preset_row(std::string name, std::string_view meaning, std::string& value,
                            const std::vector<Preset>& presets, std::string_view source) {
  std::vector<std::string> names;
  names.reserve(presets.size());
  for (const Preset& preset : presets) names.emplace_back(preset.name);
  Parameter made = row(std::move(name), meaning, value, std::move(names), source);
  made.presets = &presets;
  return made;
}

/// The model of a motor, "servo.model", before its group: whoever fills the table knows a catalogue, plants
/// know none.
inline Parameter model_row(std::string name, std::string& value) {
  return row(std::move(name),
             "motor of the catalogue, whose values are the defaults of this group: drycut plants --motors",
             value, {}, "none: the defaults are those below");
}
/// The same row of a parameter that may change in mid-run: see Plant::live_parameters.
inline Parameter live(Parameter row) {
  row.live = true;
  return row;
}
/// Those rows of a table alone.
inline Parameters live_rows(Parameters rows) {
  std::erase_if(rows, [](const Parameter& row) { return !row.live; });
  return rows;
}

/// The rows of a group, "gear.": each name with the prefix.
inline Parameters group(std::string_view prefix, Parameters rows) {
  for (Parameter& row : rows) row.name.insert(0, prefix);
  return rows;
}
/// One table after the other.
template <class... Tables>
Parameters joined(Parameters first, Tables... more) {
  (first.insert(first.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end())),
   ...);
  return first;
}

}  // namespace drycut::plants
