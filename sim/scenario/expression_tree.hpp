#pragma once
#include <array>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/expression.hpp"
#include "sim/scenario/statistic.hpp"

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

/// The tree of an expression. Its nodes stand in the order in which they are computed, operands first.
struct ExpressionTree {
  struct Node {
    enum class Kind {
      number,  ///< `number`
      name,    ///< what `slot` holds
      linear,  ///< factor * name + number, a sum or a product with numbers
      one,     ///< a function of of[0]
      two,     ///< a function or an operator of of[0] and of[1]
      choice   ///< of[0] != 0 ? of[1] : of[2]
    };
    Kind kind = Kind::number;
    double number = 0;
    double factor = 0;
    const double* slot = nullptr;
    double (*one)(double) = nullptr;
    double (*two)(double, double) = nullptr;
    std::array<std::size_t, 3> of = {};

    std::string_view sign = {};  ///< of an operator: "&&", "<="
    bool windowed = false;       ///< inside a statistic
    ExpressionUnit unit = {};
    std::size_t begin = 0;  ///< the first node of its own
    std::size_t first = 0;  ///< its tokens, without parentheses around the whole
    std::size_t last = 0;   ///< one past them
  };
  /// How a statistic comes to its value: nodes begin..root are what it looks at.
  struct Window {
    RunningStatistic running;
    std::size_t begin = 0;
    std::size_t root = 0;
  };
  std::vector<Node> nodes;
  std::size_t root = 0;
  std::deque<ExpressionStatistic> statistics;
  std::vector<Window> windows;  ///< one a statistic
};

/// What a node is of its operands, which `values` holds.
double compute(const ExpressionTree::Node& node, const std::vector<double>& values);

/// Where an expression's names are, and which there are.
struct ExpressionNames {
  const Expression::Resolver& resolve;
  const Expression::Resolver& inside;  ///< statistics; may be empty: there are none
  const std::vector<std::string>& known;
  /// A number without a unit is a pure number; else it is in the unit of what it meets.
  bool bare_is_pure = false;
};

/// The tree of the tokens of `text`. Faults of syntax come first and alone, then those of names, then those
/// of numbers of arguments and of units; the tree is usable only without any.
ExpressionTree build_tree(std::string_view text, const ExpressionTokens& tokens, const ExpressionNames& names,
                          std::vector<ExpressionFault>& faults);

/// The text between the first and the last token of a node.
std::string node_text(std::string_view text, const ExpressionTokens& tokens,
                      const ExpressionTree::Node& node);

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
