#pragma once
#include <array>
#include <deque>
#include <string_view>
#include <vector>

#include "sim/scenario/expression.hpp"
#include "sim/scenario/expression_scan.hpp"
#include "sim/scenario/expression_units.hpp"
#include "sim/scenario/statistic.hpp"

namespace drycut::sim::scenario {

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

}  // namespace drycut::sim::scenario
