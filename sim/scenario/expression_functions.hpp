#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "sim/scenario/expression_tree.hpp"

namespace drycut::sim::scenario {

/// An operator between two values.
struct ExpressionOperator {
  std::string_view sign;
  int level;  ///< how strongly it binds, from 0 on
  double (*two)(double, double);
};
/// Nullptr if the token is none.
const ExpressionOperator* find_operator(const ExpressionToken& token);
inline constexpr int comparison_level = 2;

/// A function of one, of two, or of any number of arguments.
struct ExpressionFunction {
  enum class Units {
    same,   ///< the result is in the unit of the arguments
    whole,  ///< so it is, but a ratio of two units of one quantity is the number that it comes to
    angle,  ///< takes an angle
    arc,    ///< gives an angle [rad]
    root,
    none,  ///< takes and gives pure numbers
    free   ///< takes anything and gives a pure number
  };
  std::string_view name;
  Units units;
  double (*one)(double);
  double (*two)(double, double) = nullptr;  ///< with any number of arguments: of the first two, then of that
                                            ///< and the third ...
  bool any_number = false;
};
/// By name.
std::span<const ExpressionFunction> expression_functions();
const ExpressionFunction* find_function(std::string_view name);

/// `left sign right` as one node without operands, where numbers and one name, times a number, are all that
/// is in it; nothing otherwise.
std::optional<ExpressionTree::Node> folded(const ExpressionOperator& by, const ExpressionTree::Node& left,
                                           const ExpressionTree::Node& right);
/// How `left sign right` is computed: low powers of a name are products.
double (*operation(const ExpressionOperator& by, const ExpressionTree::Node& left,
                   const ExpressionTree::Node& right))(double, double);

}  // namespace drycut::sim::scenario
