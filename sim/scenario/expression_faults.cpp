#include "sim/scenario/expression_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "base/problem.hpp"
#include "base/text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr const char* how_units_stand = "a unit stands behind its number: 9.5 N m, 60 m/min";

std::string suggest(const std::string& word, const std::vector<std::string>& candidates,
                    const std::vector<std::string>& listed) {
  const auto near = nearest(word, candidates);
  if (!near.empty()) return fmt::format("did you mean {}?", near);
  constexpr std::size_t few = 30;
  if (listed.empty()) return "no name is known here; write numbers";
  if (listed.size() <= few) return fmt::format("known: {}", fmt::join(listed, ", "));
  // Of many those that begin alike: gbStep and gbTour for gbPhase.
  auto alike = listed;
  std::ranges::stable_sort(alike, std::greater<>(), [&](const std::string& name) {
    return std::ranges::mismatch(name, word).in1 - name.begin();
  });
  constexpr std::size_t most = 5;
  alike.resize(most);
  return fmt::format("known are {} and {} more", fmt::join(alike, ", "), listed.size() - most);
}

// "'3 mm' is a length"
std::string told_unit(const std::string& text, const ExpressionUnit& unit) {
  if (is_unit(unit.text)) return fmt::format("{} is {}", in_quotes(text), dimension_name(unit.text));
  return fmt::format("{} is in {}", in_quotes(text), unit.text);
}

}  // namespace

ExpressionFault unexpected_token(const ExpressionToken& token) {
  if (token.kind == ExpressionToken::Kind::close)
    return {"expression.syntax"_code, token.offset, "this ) closes nothing", "remove it"};
  if (token.text == ",")
    return {"expression.syntax"_code, token.offset, "',' stands only between the arguments of a function",
            "write . in decimals"};
  if (token.text == ":")
    return {"expression.syntax"_code, token.offset, "':' without '?'",
            "write condition ? value : other value"};
  return {"expression.syntax"_code, token.offset,
          fmt::format("an operator is missing before '{}'", token.text),
          fmt::format("add + - * / < > == && or ||; {}", how_units_stand)};
}

ExpressionFault missing_value(const ExpressionToken& token) {
  return {"expression.syntax"_code, token.offset, fmt::format("a value is missing before '{}'", token.text),
          "add a name or a number"};
}

ExpressionFault missing_last_value(std::size_t end) {
  return {"expression.syntax"_code, end, "the expression ends where a value must follow",
          "add a name or a number"};
}

ExpressionFault wrong_arity(const ExpressionToken& function, bool too_many) {
  return {"expression.arguments"_code, function.offset,
          fmt::format("{} has too {} arguments", function.text, too_many ? "many" : "few"),
          too_many ? "remove some" : "add what is missing"};
}

ExpressionFault unknown_name(const ExpressionToken& token, const std::vector<std::string>& known) {
  auto remedy = suggest(token.text, known, known);
  if (is_unit(token.text)) remedy = how_units_stand;
  if (token.text == "and" || token.text == "AND") remedy = "write &&";
  if (token.text == "or" || token.text == "OR") remedy = "write ||";
  if (token.text == "not" || token.text == "NOT") remedy = "write !";
  return {"expression.unknown-name"_code, token.offset, fmt::format("unknown name '{}'", token.text), remedy};
}

ExpressionFault unknown_function(const ExpressionToken& token, bool statistics) {
  if (!statistics && RunningStatistic::named(token.text))
    return {"expression.not-here"_code, token.offset,
            fmt::format("{} looks at a window, and there is none", token.text),
            "statistics stand in checks and metrics"};
  std::vector<std::string> all;
  for (const auto& function : expression_functions()) all.emplace_back(function.name);
  auto near = all;
  const auto& names = RunningStatistic::names();
  if (statistics) near.insert(near.end(), names.begin(), names.end());
  return {"expression.unknown-name"_code, token.offset, fmt::format("unknown function '{}'", token.text),
          suggest(token.text, near, all)};
}

std::optional<ExpressionFault> wrong_unit(const std::string& own, const ExpressionUnit& from,
                                          const std::string& met, const ExpressionUnit& into) {
  using Kind = ExpressionUnit::Kind;
  if (from.kind != Kind::known || into.kind != Kind::known)
    return ExpressionFault{
        "expression.unit"_code, 0,
        fmt::format("{} is in no unit that could be said", in_quotes(from.kind == Kind::known ? met : own)),
        "write numbers without units there"};
  if (from.text == into.text || same_dimension(from.text, into.text)) return {};
  auto remedy = fmt::format("write it in {}", into.text);
  if (into.text.empty())
    remedy = "write the number without a unit";
  else if (!is_unit(into.text))
    remedy = fmt::format("write the number without a unit, in {}", into.text);
  return ExpressionFault{"expression.unit"_code, 0,
                         fmt::format("{}, but {}", told_unit(own, from), told_unit(met, into)), remedy};
}

}  // namespace drycut::sim::scenario
