#include "devices/value_range.hpp"

#include "base/problem.hpp"

#include <fmt/format.h>

#include <cmath>

namespace drycut::devices {

std::optional<ValueFault> misfit(std::string_view name, const ValueRange& range, double value,
                                 std::string_view unit) {
  if (range.whole && std::isfinite(value) && value != std::round(value))
    return ValueFault{"controller.value-range"_code,
                      fmt::format("{} holds whole numbers, not {}", name, value),
                      fmt::format("write {}", range.fraction.empty() ? "a whole number" : range.fraction)};
  if (value >= range.low && value <= range.high) return std::nullopt;
  return ValueFault{"controller.value-range"_code, fmt::format("{} does not hold {}", name, value),
                    fmt::format("write {} to {}{}{}{}", range.low, range.high, unit.empty() ? "" : " ", unit,
                                range.wider.empty() ? "" : ", or " + range.wider)};
}

}  // namespace drycut::devices
