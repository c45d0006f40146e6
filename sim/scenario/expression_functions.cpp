// What the functions and operators of expressions compute.
#include "sim/scenario/expression_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace drycut::sim::scenario {

namespace {

using Node = ExpressionTree::Node;
using Units = ExpressionFunction::Units;

double as_number(bool holds) { return holds ? 1 : 0; }

// From the weakest to the strongest.
constexpr std::array operators{
    ExpressionOperator{"||", 0, [](double a, double b) { return as_number(a != 0 || b != 0); }},
    ExpressionOperator{"&&", 1, [](double a, double b) { return as_number(a != 0 && b != 0); }},
    ExpressionOperator{"<", 2, [](double a, double b) { return as_number(a < b); }},
    ExpressionOperator{"<=", 2, [](double a, double b) { return as_number(a <= b); }},
    ExpressionOperator{">", 2, [](double a, double b) { return as_number(a > b); }},
    ExpressionOperator{">=", 2, [](double a, double b) { return as_number(a >= b); }},
    ExpressionOperator{"==", 2, [](double a, double b) { return as_number(a == b); }},
    ExpressionOperator{"!=", 2, [](double a, double b) { return as_number(a != b); }},
    ExpressionOperator{"+", 3, [](double a, double b) { return a + b; }},
    ExpressionOperator{"-", 3, [](double a, double b) { return a - b; }},
    ExpressionOperator{"*", 4, [](double a, double b) { return a * b; }},
    ExpressionOperator{"/", 4, [](double a, double b) { return a / b; }},
    ExpressionOperator{"^", 5, [](double a, double b) { return std::pow(a, b); }},
};

// Where several definitions are in use (rint of a half, sign of nothing), these have always been it here.
constexpr std::array functions{
    ExpressionFunction{"abs", Units::same, [](double x) { return x >= 0 ? x : -x; }},
    ExpressionFunction{"acos", Units::arc, [](double x) { return std::acos(x); }},
    ExpressionFunction{"acosh", Units::none, [](double x) { return std::log(x + std::sqrt(x * x - 1)); }},
    ExpressionFunction{"asin", Units::arc, [](double x) { return std::asin(x); }},
    ExpressionFunction{"asinh", Units::none, [](double x) { return std::log(x + std::sqrt(x * x + 1)); }},
    ExpressionFunction{"atan", Units::arc, [](double x) { return std::atan(x); }},
    ExpressionFunction{"atan2", Units::arc, nullptr, [](double y, double x) { return std::atan2(y, x); }},
    ExpressionFunction{"atanh", Units::none, [](double x) { return 0.5 * std::log((1 + x) / (1 - x)); }},
    ExpressionFunction{"avg", Units::same, nullptr, [](double a, double b) { return a + b; }, true},
    ExpressionFunction{"cos", Units::angle, [](double x) { return std::cos(x); }},
    ExpressionFunction{"cosh", Units::none, [](double x) { return std::cosh(x); }},
    ExpressionFunction{"exp", Units::none, [](double x) { return std::exp(x); }},
    ExpressionFunction{"ln", Units::none, [](double x) { return std::log(x); }},
    ExpressionFunction{"log", Units::none, [](double x) { return std::log(x); }},
    ExpressionFunction{"log10", Units::none, [](double x) { return std::log10(x); }},
    ExpressionFunction{"log2", Units::none, [](double x) { return std::log(x) / std::log(2.0); }},
    ExpressionFunction{"max", Units::same, nullptr, [](double a, double b) { return std::max(a, b); }, true},
    ExpressionFunction{"min", Units::same, nullptr, [](double a, double b) { return std::min(a, b); }, true},
    ExpressionFunction{"rint", Units::whole, [](double x) { return std::floor(x + 0.5); }},
    ExpressionFunction{"sign", Units::free, [](double x) { return x < 0 ? -1.0 : as_number(x > 0); }},
    ExpressionFunction{"sin", Units::angle, [](double x) { return std::sin(x); }},
    ExpressionFunction{"sinh", Units::none, [](double x) { return std::sinh(x); }},
    ExpressionFunction{"sqrt", Units::root, [](double x) { return std::sqrt(x); }},
    ExpressionFunction{"sum", Units::same, nullptr, [](double a, double b) { return a + b; }, true},
    ExpressionFunction{"tan", Units::angle, [](double x) { return std::tan(x); }},
    ExpressionFunction{"tanh", Units::none, [](double x) { return std::tanh(x); }},
};

Node linear(const double* slot, double factor, double number) {
  Node node;
  node.kind = Node::Kind::linear;
  node.slot = slot;
  node.factor = factor;
  node.number = number;
  return node;
}

// A name is 1 * name + 0, a number 0 * nothing + number.
double factor_of(const Node& node) { return node.kind == Node::Kind::name ? 1 : node.factor; }

std::optional<Node> folded_sum(const Node& left, const Node& right, double sign) {
  if (left.slot != nullptr && right.slot != nullptr && left.slot != right.slot) return {};
  return linear(left.slot != nullptr ? left.slot : right.slot, factor_of(left) + sign * factor_of(right),
                left.number + sign * right.number);
}

}  // namespace

const ExpressionOperator* find_operator(const ExpressionToken& token) {
  if (token.kind != ExpressionToken::Kind::sign) return nullptr;
  const auto* const found = std::ranges::find(operators, token.text, &ExpressionOperator::sign);
  return found == operators.end() ? nullptr : found;
}

std::span<const ExpressionFunction> expression_functions() { return functions; }

const ExpressionFunction* find_function(std::string_view name) {
  const auto* const found = std::ranges::find(functions, name, &ExpressionFunction::name);
  return found == functions.end() ? nullptr : found;
}

std::optional<Node> folded(const ExpressionOperator& by, const Node& left, const Node& right) {
  const auto is_leaf = [](const Node& node) {
    return node.kind == Node::Kind::number || node.kind == Node::Kind::name ||
           node.kind == Node::Kind::linear;
  };
  if (by.level <= comparison_level || !is_leaf(left) || !is_leaf(right)) return {};
  if (left.slot == nullptr && right.slot == nullptr) {
    Node node;
    node.number = by.two(left.number, right.number);
    return node;
  }
  if (by.sign == "+") return folded_sum(left, right, 1);
  if (by.sign == "-") return folded_sum(left, right, -1);
  if (by.sign == "*" && (left.slot == nullptr || right.slot == nullptr)) {
    const double number = left.slot == nullptr ? left.number : right.number;
    const Node& name = left.slot == nullptr ? right : left;
    return linear(name.slot, factor_of(name) * number,
                  name.kind == Node::Kind::name ? 0 : name.number * number);
  }
  if (by.sign == "/" && left.kind == Node::Kind::linear && right.slot == nullptr && right.number != 0)
    return linear(left.slot, left.factor / right.number, left.number / right.number);
  return {};
}

double (*operation(const ExpressionOperator& by, const Node& left, const Node& right))(double, double) {
  const bool low_power = by.sign == "^" && left.kind == Node::Kind::name &&
                         right.kind == Node::Kind::number &&
                         (right.number == 2 || right.number == 3 || right.number == 4);
  if (!low_power) return by.two;
  return [](double x, double exponent) {
    double power = x;
    for (int i = 1; i < exponent; ++i) power *= x;
    return power;
  };
}

double compute(const Node& node, const std::vector<double>& values) {
  switch (node.kind) {
    case Node::Kind::number:
      return node.number;
    case Node::Kind::name:
      return *node.slot;
    case Node::Kind::linear:
      return node.factor * *node.slot + node.number;
    case Node::Kind::one:
      return node.one(values[node.of[0]]);
    case Node::Kind::two:
      return node.two(values[node.of[0]], values[node.of[1]]);
    case Node::Kind::choice:
      return values[node.of[0]] != 0 ? values[node.of[1]] : values[node.of[2]];
  }
  return node.number;
}

}  // namespace drycut::sim::scenario
