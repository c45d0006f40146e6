#pragma once
#include <optional>
#include <string>

#include "sim/studies/tune/parameter.hpp"
#include "sim/studies/tune/study.hpp"

namespace drycut::sim::studies {

/// What a parameter is before the tuning.
struct PresentValue {
  std::optional<double> value;  ///< in the parameter's unit; absent: the program sets it when it runs
  std::string set_by;           ///< "--set", "scenario", "default", "program"

  /// False if it is known to lie outside of the parameter's range.
  [[nodiscard]] bool in_range(const TunedParameter& parameter) const {
    return !value || (*value >= parameter.low && *value <= parameter.high);
  }
};

/// The value in `scenario`, which is `entry` read with what `study` sets, and who has set it. Fills in the
/// parameter's unit and whether it is an integer.
PresentValue present_of(TunedParameter& parameter, const Study& study, const Study::Case& entry,
                        const scenario::Scenario& scenario);

/// The present values with those that only the program sets, as the first scenario has them when its run
/// ends, which is one simulated run; nothing where one of them cannot be read.
std::optional<Point> set_by_program(const Study& study, const TunedParameters& parameters,
                                    const std::vector<PresentValue>& present);

}  // namespace drycut::sim::studies
