#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "base/text.hpp"
#include "devices/plcopen/st/types.hpp"

namespace drycut::devices::plcopen::st {

/// A word, literal or sign of a Structured Text file.
struct Token {
  enum class Kind : std::uint8_t {
    name,     ///< identifier or keyword
    literal,  ///< a number, time or date: `value` of type `basic`
    string,   ///< `string`, without quotes and escapes
    address,  ///< %IX0.0
    sign,     ///< ( ) [ ] , ; : . + - * / < > = & # := => ** <= >= <> ..
    bad,      ///< already reported; its statement is given up
    end,
  };
  Kind kind = Kind::end;
  std::string_view text;
  Place place;
  Basic basic = Basic::unknown;  ///< LINT, above it ULINT, LREAL, TIME, TOD, DATE or DT
  Cell value = 0;
  std::string string;

  [[nodiscard]] bool is(std::string_view sign) const { return kind == Kind::sign && text == sign; }
  [[nodiscard]] bool whole() const { return kind == Kind::literal && is_integer(basic); }
  /// The keyword or name, any case.
  [[nodiscard]] bool word(std::string_view keyword) const {
    return kind == Kind::name && same_word(text, keyword);
  }
};

/// The tokens of a file, comments, pragmas `{...}` and what they switch off left out, ended by one of
/// Kind::end.
std::vector<Token> tokens_of(std::string_view text, const std::string& file, Problems& problems);

}  // namespace drycut::devices::plcopen::st
