#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/scanner.hpp"
#include "devices/plcopen/st/types.hpp"

namespace drycut::devices::plcopen::st {

/// A word, literal or sign of a Structured Text file. Signs are
/// ( ) [ ] , ; : . + - * / < > = & # := => ** <= >= <> .. and times and dates are numbers too.
struct Token : drycut::Token {
  Basic basic = Basic::unknown;  ///< of a number: LINT, above it ULINT, LREAL, TIME, TOD, DATE or DT
  Cell value = 0;
  std::string string;  ///< without quotes and escapes

  [[nodiscard]] bool whole() const { return kind == Kind::number && is_integer(basic); }
};

/// The parts of a TIME, the largest first.
struct TimeUnit {
  std::string_view name;
  Cell ms;
};
inline constexpr std::array<TimeUnit, 5> time_units{
    {{"d", 86'400'000}, {"h", 3'600'000}, {"m", 60'000}, {"s", 1000}, {"ms", 1}}};

/// The tokens of a file, comments, pragmas `{...}` and what they switch off left out, ended by one of
/// Kind::end.
std::vector<Token> tokens_of(std::string_view text, const std::string& file, Problems& problems);

}  // namespace drycut::devices::plcopen::st
