#pragma once
#include <drycut/problem.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace drycut::devices {

/// What a value takes as it is: whatever sets it by name is judged by this, presets, timelines, tuning and
/// files of registers alike.
struct ValueRange {
  double low = 0;
  double high = 0;
  bool whole = false;
  std::string fraction = {};  ///< what else takes a fraction ("D10:F for a float"), "" = nothing
  std::string wider = {};     ///< what else takes more ("D10:L"), "" = nothing
};

struct ValueFault {
  Code code;
  Prose what;
  Prose remedy;
  bool operator==(const ValueFault&) const = default;
};

/// What is wrong with giving `value` to what is called `name`, nullopt if it is taken as it is; range and
/// value in `unit`.
std::optional<ValueFault> misfit(std::string_view name, const ValueRange& range, double value,
                                 std::string_view unit = {});

}  // namespace drycut::devices
