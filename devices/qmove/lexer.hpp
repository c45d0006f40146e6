#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "devices/qmove/text.hpp"

namespace drycut::devices::qmove {

/// A word, number or sign of a QCL module.
struct Token {
  enum class Kind : std::uint8_t {
    word,
    integer,
    real,
    sign,         ///< one of ( ) [ ] , : . = + - * / %
    bad,          ///< already reported; its line is given up
    end_of_line,  ///< stands after the last token of each line
  };
  Kind kind = Kind::end_of_line;
  std::string_view text;
  Place place;
  std::int64_t integer = 0;  ///< 0..2147483648; the largest only after a minus sign
  float real = 0;
};

/// The tokens of one line, comment (`;`) left out; the last one is end_of_line. Characters and numbers that
/// cannot be are appended to `problems`.
std::vector<Token> tokens_of(std::string_view line, int number, const std::string& file, Problems& problems);

}  // namespace drycut::devices::qmove
