#pragma once
#include <string>

namespace drycut::sim::scenario {

/// In which unit the number of a part of an expression is.
struct ExpressionUnit {
  enum class Kind {
    any,     ///< numbers without a unit: in that of what they meet
    known,   ///< `text`, which the unit library need not know ("Um")
    untold,  ///< that of a name whose unit nobody has said yet
    mixed    ///< none that could be said, as of a length plus a speed
  };
  Kind kind = Kind::any;
  std::string text = {};
  /// A number with a unit of its own is in it: it can be put into another unit of the same dimension.
  bool carries = false;
};

/// Of a sum, a comparison, the greater of two.
ExpressionUnit unit_of_sum(const ExpressionUnit& a, const ExpressionUnit& b);
/// Of a product; of a quotient if `divided`.
ExpressionUnit unit_of_product(const ExpressionUnit& a, const ExpressionUnit& b, bool divided);
ExpressionUnit unit_of_power(const ExpressionUnit& unit, double exponent);
ExpressionUnit unit_of_root(const ExpressionUnit& unit);

}  // namespace drycut::sim::scenario
