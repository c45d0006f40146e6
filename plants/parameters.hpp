#pragma once
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace drycut::plants {

/// The word by which a reference parameter names no plant, where its default does.
inline constexpr std::string_view no_plant = "none";

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
};
using Parameters = std::vector<Parameter>;

}  // namespace drycut::plants
