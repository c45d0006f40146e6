#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plants/parameters.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::scenario {

// The motors that `servo: {model: HG-SR202}` and `induction_motor: {model: ...}` can name. A series is a file
// of YAML: vendor, series, kind (the group that takes it), sources (a word for each), common (values of them
// all) and motors, by their names. A value is {value: 9.55 N m, from: sheet}; `from` is a word of `sources`,
// or says itself "sheet: which" or "estimate: why".

struct MotorModel {
  struct Value {
    std::string
        parameter;      ///< of the group: "rated_torque"; or "rated_power", which the name plate alone has
    Text text;          ///< as the file says it, and where
    std::string shown;  ///< in the parameter's unit: "9.55 N m"
    std::string from;   ///< "sheet: ..." or "estimate: ..."
    [[nodiscard]] bool is_estimate() const { return from.starts_with("estimate"); }
  };
  Text name;
  std::string kind;  ///< "servo", "induction_motor"
  std::string vendor;
  std::string series;
  std::vector<Value> values;  ///< in the order of the group's table

  /// The value of that name; nullptr if the file gives none.
  [[nodiscard]] const Value* find(std::string_view parameter) const;
};

/// The groups that take a model.
inline constexpr std::string_view motor_kinds[] = {"servo", "induction_motor"};

/// Motors of the files `catalogue/*.yaml` in `folder`, then those that come with the program and have another
/// name. What is wrong with a file is told with the file's name and line.
std::vector<MotorModel> read_motors(const std::filesystem::path& folder, Findings& findings);
/// Those that come with the program.
std::vector<MotorModel> shipped_motors();

/// The same, read when the first one is asked for.
class MotorCatalogue {
 public:
  MotorCatalogue(std::filesystem::path folder, Findings& findings)
      : folder_(std::move(folder)), findings_(findings) {}

  /// The motor of that name for a group. If there is none that is a problem of the value `full`: nullptr.
  const MotorModel* find(std::string_view kind, const Text& name, const std::string& full);

 private:
  std::filesystem::path folder_;
  Findings& findings_;
  std::optional<std::vector<MotorModel>> motors_;
  bool is_sound_ = true;  ///< no problem in any file
};

/// "servo" for the parameter "servo.model"; "" for one that names no model.
std::string_view motor_kind(std::string_view parameter);
/// The form of such a parameter. It is written as none, for its values are written out.
Form model_form(const plants::Parameter& parameter);

}  // namespace drycut::sim::scenario
