#include "sim/scenario/constant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/scenario/expression_tree.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

bool has_comparison(const ExpressionTokens& tokens) {
  constexpr std::array<std::string_view, 9> signs = {"<", "<=", ">", ">=", "==", "!=", "&&", "||", "!"};
  const auto is = [&](std::string_view sign) {
    return std::any_of(tokens.begin(), tokens.end(), [&](const ExpressionToken& token) {
      return token.kind == ExpressionToken::Kind::sign && token.text == sign;
    });
  };
  return !is("?") && std::any_of(signs.begin(), signs.end(), is);
}

double value_of(const ExpressionTree& tree) {
  std::vector<double> values(tree.nodes.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = compute(tree.nodes[i], values);
  return values[tree.root];
}

// 15 digits: 0.1 + 0.2 is 0.3, and 800 mm / 0.1 mm a whole number. A unit that arithmetic made is put into
// SI.
std::string text_of(double number, const std::string& unit) {
  const bool made = unit.find('(') != std::string::npos;
  const auto shown = made ? si_unit(unit) : unit;
  return fmt::format("{:.15g}{}{}", made ? to_si(number, unit) : number, shown.empty() ? "" : " ", shown);
}

}  // namespace

Constant read_constant(std::string_view text) {
  using Of = ExpressionFault::Of;
  static constexpr double any = 1;
  std::vector<ExpressionFault> faults;
  const auto tokens = scan_expression(text, faults);
  if (!faults.empty()) return {};
  bool named = false;
  const Expression::Resolver resolve = [&named](const std::string&) {
    named = true;
    return Expression::Operand(&any);
  };
  const auto tree = build_tree(text, tokens, {resolve, resolve, {}, false}, faults);
  const auto is = [&](Of of) {
    return std::any_of(faults.begin(), faults.end(),
                       [of](const ExpressionFault& fault) { return fault.of == of; });
  };
  if (is(Of::syntax) || is(Of::names)) return {};
  if (named || !tree.statistics.empty()) return {Constant::Kind::formula};
  if (has_comparison(tokens)) return {Constant::Kind::condition};
  Constant made{Constant::Kind::value};
  const auto strict = build_tree(text, tokens, {resolve, {}, {}, true}, made.faults);
  if (!made.faults.empty()) return made;
  const auto& unit = strict.nodes[strict.root].unit;
  const double number = value_of(strict);
  if (unit.kind == ExpressionUnit::Kind::mixed)
    made.faults.push_back({"expression.unit"_code, 0, "what this is measured in cannot be told",
                           "divide by a unit, as in / 1 mm"});
  else if (!std::isfinite(number))
    made.faults.push_back(
        {"expression.kind"_code, 0, "this is no finite number", "look at what it is divided by"});
  else
    made.value = text_of(number, unit.text);
  return made;
}

}  // namespace drycut::sim::scenario
