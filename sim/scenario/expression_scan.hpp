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
  std::size_t end = 0;      ///< one past its last byte
  std::size_t partner = 0;  ///< open, close: index of the other parenthesis
};
using ExpressionTokens = std::vector<ExpressionToken>;

/// Splits an expression into tokens and checks that values and operators alternate, parentheses match and
/// comparisons are not chained. Faults are added at their byte; the tokens are usable only without.
ExpressionTokens scan_expression(std::string_view text, std::vector<ExpressionFault>& faults);

/// < <= > >=
bool is_relation(const ExpressionToken& token);

}  // namespace drycut::sim::scenario
