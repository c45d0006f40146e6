#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "plants/random.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::studies {

/// A value of the scenario that the tuning may change, by its override path.
struct TunedParameter {
  std::string path;  ///< "controller.qmove.set.AxisX.pgain", "plants.knife.servo.speed_gain"
  double low = 0;    ///< in `unit`
  double high = 0;
  std::string unit = {};  ///< as given, "" = pure number or the parameter's own
  bool integer = false;
  std::string option = {};  ///< where it was given, for messages: "--vary"
  int low_column = 1;       ///< of the argument
  int high_column = 1;
  std::optional<double> relative =
      {};                     ///< --spread PATH=±30%: the fraction; low and high follow from the scenario
  std::string own_unit = {};  ///< of a controller's value that is written without it, for tables: "0.01/s"
};
using TunedParameters = std::vector<TunedParameter>;
/// A value for each parameter, in its unit.
using Point = std::vector<double>;

/// Reads PATH=LO..HI with an optional unit and `:integer`; with `relative`, also PATH=±30%. What is wrong
/// goes to `problems` by option and column.
std::optional<TunedParameter> parse_parameter(const std::string& text, const std::string& option,
                                              bool relative, Problems& problems);

/// True if an option names the fit.json of a fit in place of PATH=LO..HI.
bool names_fit(std::string_view text);

/// The limits that a fit found, as ranges in the units of its rows, each with `option` and where the file is
/// named in it. Those of `given` have a range of their own beside it, which counts in their place. A file
/// that is no fit, and a value that the fit does not know, go to `problems`.
TunedParameters limits_of_fit(const std::string& file, const std::string& option,
                              const std::vector<std::string>& given, Problems& problems);

/// The paths of those `texts` that are PATH=..., as `given` above.
std::vector<std::string> given_paths(const std::vector<std::string>& texts);

/// "87", "250 rad/s": as `--set` and the scenario take it.
std::string value_text(const TunedParameter& parameter, double value);
/// The unit in which tables show it, "" = none.
const std::string& shown_unit(const TunedParameter& parameter);
/// "87.3 rad/s", to six digits, and "20..250 1/s", for people.
std::string shown_value(const TunedParameter& parameter, double value);
std::string shown_range(const TunedParameter& parameter);
/// "knife.servo.speed_gain [rad/s]": a column's heading.
std::string shown_heading(const TunedParameter& parameter);
/// `point` as overrides of the scenario.
std::vector<scenario::Override> overrides_of(const TunedParameters& parameters, const Point& point);
/// A value of the controller that a path names: below the `set` of its section.
struct PresetName {
  std::string section;  ///< "qmove", "lx3vp", "plcopen"
  std::string value;    ///< "AxisX.pgain", "D100", "Knife.kv"
};
std::optional<PresetName> preset_name(const std::string& path);
/// The name below its section: "AxisX.pgain", "knife.servo.speed_gain".
std::string short_name(const TunedParameter& parameter);

/// The parameter's value in the scenario as it stands, in its unit (which is filled in from the plant's table
/// if none was given); nullopt if the scenario does not say it (a gain that the QCL sets). Also makes an
/// integer of a parameter that is one.
std::optional<double> present_value(TunedParameter& parameter, const scenario::Scenario& scenario);
/// Tells bounds that the controller's variable does not take: its range, its size, read-only.
void check_against_controller(TunedParameter& parameter, const scenario::Scenario& scenario,
                              Problems& problems);

/// Tells a value that the program overwrites before anything reads it, at one end of the range or the other:
/// `scenario_with` reads the scenario with a value of it, in its unit.
void refuse_overwritten(const TunedParameter& parameter, const std::string& low, const std::string& high,
                        const std::function<scenario::Scenario(const std::string& value)>& scenario_with,
                        Problems& problems);

/// Point of the unit cube to values, integers rounded.
Point from_unit(const TunedParameters& parameters, const std::vector<double>& unit);
std::vector<double> to_unit(const TunedParameters& parameters, const Point& point);
/// `count` points of a Latin hypercube over the ranges: every parameter's range is cut into `count` equal
/// parts, and each part is met once.
std::vector<Point> latin_hypercube(const TunedParameters& parameters, int count, plants::Random random);

}  // namespace drycut::sim::studies
