#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/scanner.hpp"

namespace drycut::devices::qmove {

/// A word, number or sign of a line of a QCL module. Signs are one of ( ) [ ] , : . = + - * / %
struct QclToken : drycut::Token {
  bool is_real = false;
  std::int64_t integer = 0;  ///< 0..2147483648; the largest only after a minus sign
  float real = 0;
};

/// The tokens of one line, comment (`;`) left out; the last one is an end. Characters and numbers that
/// cannot be are appended to `problems`.
std::vector<QclToken> tokens_of(std::string_view line, int number, const std::string& file,
                                Problems& problems);

}  // namespace drycut::devices::qmove
