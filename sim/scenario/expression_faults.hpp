#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/expression_scan.hpp"
#include "sim/scenario/expression_units.hpp"

namespace drycut::sim::scenario {

// What is said of an expression that is wrong.

/// A token that cannot follow a value.
ExpressionFault unexpected_token(const ExpressionToken& token);
/// A token in the place of a value.
ExpressionFault missing_value(const ExpressionToken& token);
/// The end of the text in the place of a value.
ExpressionFault missing_last_value(std::size_t end);
ExpressionFault wrong_arity(const ExpressionToken& function, bool too_many);
/// `known`: the names that may be suggested.
ExpressionFault unknown_name(const ExpressionToken& token, const std::vector<std::string>& known);
/// `statistics`: whether there could have been one.
ExpressionFault unknown_function(const ExpressionToken& token, bool statistics);
/// `own`, a text in the unit `from`, cannot be put into `into`, that of the text `met`; without its place.
/// Nothing if it can.
std::optional<ExpressionFault> wrong_unit(const std::string& own, const ExpressionUnit& from,
                                          const std::string& met, const ExpressionUnit& into);

}  // namespace drycut::sim::scenario
