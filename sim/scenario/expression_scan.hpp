#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/expression.hpp"

namespace drycut::sim::scenario {

/// One word or sign of an expression.
struct ExpressionToken {
  enum class Kind { number, name, function, sign, open, close };
  Kind kind = Kind::sign;
  std::string text;  ///< a name without blanks in its index
  std::size_t offset = 0;
  std::size_t end = 0;    ///< one past its last byte
  double value = 0;       ///< of a number
  std::string unit = {};  ///< behind a number: "N m", "" without
};
using ExpressionTokens = std::vector<ExpressionToken>;

/// Splits an expression into tokens, one at least. Faults are added at their byte; then there are no tokens.
ExpressionTokens scan_expression(std::string_view text, std::vector<ExpressionFault>& faults);

/// < <= > >=
bool is_relation(std::string_view sign);

}  // namespace drycut::sim::scenario
