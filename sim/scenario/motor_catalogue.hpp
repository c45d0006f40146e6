#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plants/plant.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::scenario {

// The motors that `servo: {model: HG-SR202}` and `induction_motor: {model: ...}` can name. A series is a file
// of YAML: vendor, series, kind (the group that takes it), sources (a word for each), common (values of them
// all) and motors, by their names. A value is {value: 9.55 N m, from: sheet}; `from` is a word of `sources`,
// or says itself "checked 2026-11-24: which sheet and page", "sheet: which" or "estimate: why". Five values
// of a sheet are enough: the others are estimated (sim/scenario/motor_estimates.hpp). `formerly` is the name
// that a motor had in the release before.

struct MotorModel {
  struct Value {
    std::string parameter;  ///< of the group: "rated_torque"; or "rated_power", which the sheet alone has
    Text text;              ///< as the file says it, and where
    std::string shown;      ///< in the parameter's unit: "9.55 N m"
    /// "checked 2026-11-24: ...", compared with that page on that day; "unchecked: ...", of a sheet, but not
    /// compared; "estimate: ..."
    std::string from;
    [[nodiscard]] bool is_estimate() const { return from.starts_with("estimate"); }
    [[nodiscard]] bool is_checked() const { return from.starts_with("checked"); }
    /// The file does not give it: it follows from the others.
    [[nodiscard]] bool is_completed() const;
  };
  Text name;
  std::string formerly;  ///< accepted with a note; "" = no other name
  std::string kind;      ///< "servo", "induction_motor"
  std::string vendor;
  std::string series;
  std::vector<Value> values;  ///< in the order of the group's table

  /// The value of that name; nullptr if there is none.
  [[nodiscard]] const Value* find(std::string_view parameter) const;
  /// How far its values can be trusted: "checked" if all that are from a sheet were compared with it,
  /// "unchecked" if one was not, "estimated" if none is from a sheet; "unchecked, 11 estimated" where the
  /// file does not give all.
  [[nodiscard]] std::string standing() const;
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

  /// The motor of that name for a group, or of that former name. If there is none that is a problem of the
  /// value `full`: nullptr.
  const MotorModel* find(std::string_view kind, const Text& name, const std::string& full);

 private:
  std::filesystem::path folder_;
  Findings& findings_;
  std::optional<std::vector<MotorModel>> motors_;
  bool is_sound_ = true;  ///< no problem in any file
};

/// What a reader should know of the motors that a plant names: a former name, values that nobody has compared
/// with their sheet, estimates.
std::vector<Finding> notes_of_models(const PlantEntry& plant);

/// A file with one motor of that kind, to fill in from its sheet: what it must give, and in remarks what else
/// it may, with the estimate for each.
std::string motor_template(std::string_view kind);

/// "servo" for the parameter "servo.model"; "" for one that names no model.
std::string_view motor_kind(std::string_view parameter);
/// The form of such a parameter. It is written as none, for its values are written out.
Form model_form(const plants::Parameter& parameter);

}  // namespace drycut::sim::scenario
