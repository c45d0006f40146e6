#include "sim/scenario/expression_tree.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

using Kind = ExpressionUnit::Kind;

ExpressionUnit known_unit(std::string text, bool carries) {
  if (!text.empty() && !is_unit(text)) return {Kind::mixed, "", carries};
  return {Kind::known, std::move(text), carries};
}

// What neither a sum nor a product can say; nothing if it can.
bool is_open(const ExpressionUnit& unit) { return unit.kind == Kind::untold || unit.kind == Kind::mixed; }

ExpressionUnit open_unit(const ExpressionUnit& a, const ExpressionUnit& b) {
  const bool untold = a.kind == Kind::untold || b.kind == Kind::untold;
  return {untold ? Kind::untold : Kind::mixed, "", a.carries || b.carries};
}

}  // namespace

ExpressionUnit unit_of_sum(const ExpressionUnit& a, const ExpressionUnit& b) {
  if (is_open(a) || is_open(b)) return open_unit(a, b);
  const bool carries = a.carries || b.carries;
  if (a.kind == Kind::any) return {b.kind, b.text, carries};
  if (b.kind == Kind::any || a.text == b.text) return {a.kind, a.text, carries};
  return {Kind::mixed, "", carries};
}

ExpressionUnit unit_of_product(const ExpressionUnit& a, const ExpressionUnit& b, bool divided) {
  if (is_open(a) || is_open(b)) return open_unit(a, b);
  const bool carries = a.carries || b.carries;
  const bool plain = b.kind == Kind::any || b.text.empty();
  if (plain) return {a.kind == Kind::any ? b.kind : a.kind, a.text, carries};
  const bool pure = a.kind == Kind::any || a.text.empty();
  if (pure && !divided) return {b.kind, b.text, carries};
  if (a.text == b.text) return divided ? ExpressionUnit{Kind::known, "", carries} : unit_of_power(a, 2);
  if (pure) return known_unit(fmt::format("1/({})", b.text), carries);
  return known_unit(fmt::format("({}){}({})", a.text, divided ? '/' : '.', b.text), carries);
}

ExpressionUnit unit_of_power(const ExpressionUnit& unit, double exponent) {
  if (unit.kind != Kind::known || unit.text.empty() || exponent == 1) return unit;
  if (exponent == 0) return {};
  constexpr double most = 9;
  if (!(exponent > 0 && exponent <= most && exponent == std::round(exponent)))
    return {Kind::mixed, "", unit.carries};
  return known_unit(fmt::format("({})^{}", unit.text, exponent), unit.carries);
}

// Of a square only: sqrt(x^2 + y^2) is a length.
ExpressionUnit unit_of_root(const ExpressionUnit& unit) {
  if (unit.kind != Kind::known || unit.text.empty()) return unit;
  if (unit.text.starts_with('(') && unit.text.ends_with(")^2"))
    return {Kind::known, unit.text.substr(1, unit.text.size() - 4), unit.carries};
  return {Kind::mixed, "", unit.carries};
}

}  // namespace drycut::sim::scenario
