#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/operations.hpp"

// Nodes, constants and conversions.
namespace drycut::devices::plcopen::st {

int Compiler::add_node(Op op, Basic basic, Place place, int a, int b, int c, std::int64_t imm) {
  code_->nodes.push_back({op, basic, place.line, place.column, a, b, c, imm});
  return static_cast<int>(code_->nodes.size()) - 1;
}

int Compiler::add_list(const std::vector<int>& items) {
  const int first = static_cast<int>(code_->lists.size());
  code_->lists.insert(code_->lists.end(), items.begin(), items.end());
  return first;
}

Expression Compiler::constant(const Type* type, Cell value, Place place, bool untyped) const {
  Expression result;
  result.type = type;
  result.place = place;
  result.constant = true;
  result.untyped = untyped;
  result.value = value;
  return result;
}

int Compiler::value_node(const Expression& expression) {
  const Basic basic = expression.type->basic;
  if (expression.constant)
    return add_node(Op::constant, basic, expression.place, -1, -1, -1, expression.value);
  if (!expression.address || basic == Basic::string) return expression.node;
  if (expression.node < 0) return -1;
  const Node address = code_->nodes[static_cast<std::size_t>(expression.node)];
  if (address.op == Op::address) return add_node(Op::load, basic, expression.place, -1, -1, -1, address.imm);
  if (address.op == Op::address_own)
    return add_node(Op::load_own, basic, expression.place, -1, -1, -1, address.imm);
  return add_node(Op::load_at, basic, expression.place, expression.node);
}

int Compiler::address_plus(int node, std::int64_t offset) {
  if (offset == 0 || node < 0) return node;
  Node address = code_->nodes[static_cast<std::size_t>(node)];
  address.imm += offset;
  code_->nodes.push_back(address);
  return static_cast<int>(code_->nodes.size()) - 1;
}

int Compiler::literal_string(const std::string& text) {
  auto [entry, fresh] = strings_.emplace(text, static_cast<int>(pool_.size()));
  if (fresh) {
    pool_.resize(pool_.size() + static_cast<std::size_t>(string_cells(text.size())), 0);
    std::memcpy(pool_.data() + entry->second, text.data(), text.size());
  }
  return entry->second;
}

int Compiler::scratch() {
  pool_.push_back(0);
  return static_cast<int>(pool_.size()) - 1;
}

Expression Compiler::literal_as(Expression literal, const Type& to) {
  const Basic basic = to.basic;
  const bool real = is_real(literal.type->basic);
  if (is_real(basic)) {
    const double value = real ? real_of(literal.value) : static_cast<double>(literal.value);
    const double kept = rounded(basic, value);
    if (!std::isfinite(kept) && std::isfinite(value))
      complain(literal.place, fmt::format("the constant {} is out of the range of REAL", value),
               "a REAL goes to 3.4e38, an LREAL to 1.8e308");
    literal.value = cell_of(kept);
  } else if (!real && (is_integer(basic) || basic == Basic::boolean)) {
    const Range range = range_of(basic);
    if (literal.value < range.low || literal.value > range.high)
      complain(literal.place,
               fmt::format("the constant {} is out of the range of {}", literal.value, to.name),
               fmt::format("{} to {}", range.low, range.high));
  } else if (real && is_integer(basic)) {
    complain(literal.place, fmt::format("{} is not a whole number for {}", real_of(literal.value), to.name),
             fmt::format("LREAL_TO_{} rounds, TRUNC cuts off", to.name));
  } else {
    const char* remedy = basic == Basic::time          ? "a TIME is written T#500ms"
                         : basic == Basic::enumeration ? "name one of its values"
                         : basic == Basic::boolean     ? "TRUE or FALSE"
                         : basic == Basic::string      ? "a text stands between single quotes"
                                                       : "give a variable of that type";
    const std::string number =
        real ? fmt::format("{}", real_of(literal.value)) : fmt::format("{}", literal.value);
    complain(literal.place, fmt::format("the number {} is no {}", number, to.name), remedy);
  }
  literal.type = &to;
  literal.untyped = false;
  return literal;
}

Expression Compiler::converted(Expression expression, const Type& to) {
  const Type& from = *expression.type;
  if (expression.unknown() || to.basic == Basic::unknown || same_type(from, to)) {
    expression.untyped = false;
    return expression;
  }
  if (expression.untyped) return literal_as(std::move(expression), to);
  // A text that is too long is cut off, as on the machine; a literal is refused.
  if (from.basic == Basic::string && to.basic == Basic::string) {
    if (expression.string && expression.string->size() > to.length)
      complain(expression.place,
               fmt::format("{} characters do not fit in {}", expression.string->size(), to.name),
               fmt::format("{} at most", to.length));
    return expression;
  }
  if (widens(from.basic, to.basic) && to.basic != Basic::enumeration)
    return cast(expression, to.basic, expression.place);
  const bool casts = is_elementary(from.basic) && is_elementary(to.basic) && to.basic != Basic::enumeration;
  const std::string from_name = from.basic == Basic::enumeration ? "INT" : from.name;
  const std::string what = expression.name.empty()
                               ? fmt::format("a value of type {} does not", from.name)
                               : fmt::format("{} is {}, which does not", quoted(expression.name), from.name);
  complain(expression.place, fmt::format("{} go into {} by itself", what, to.name),
           casts ? fmt::format("{}_TO_{}(...) converts", from_name, to.name)
                 : fmt::format("a value of type {} is wanted", to.name));
  Expression unknown = constant(type_of(Basic::unknown), 0, expression.place);
  unknown.constant = false;
  return unknown;
}

Expression Compiler::cast(const Expression& expression, Basic to, Place place) {
  const Basic from = expression.type->basic;
  const Type* type = type_of(to);
  if (from == to) return expression;
  Op op = Op::wrap;
  if (to == Basic::boolean) {
    op = is_real(from) ? Op::nonzero_real : Op::nonzero;
  } else if (is_real(to)) {
    op = is_real(from) ? Op::round_real : Op::to_real;
  } else if (is_real(from)) {
    op = Op::to_whole;
  }
  // Nothing to do where the value stays what it is.
  const bool same =
      (op == Op::round_real && to == Basic::lreal) ||
      (op == Op::wrap && range_of(from).low >= range_of(to).low && range_of(from).high <= range_of(to).high);
  if (!same) return apply_op(op, type, place, expression);
  Expression result = expression;
  result.type = type;
  result.untyped = false;
  if (!result.constant) {
    result.node = value_node(expression);
    result.address = false;
  }
  return result;
}

Expression Compiler::folded(Op op, const Type* type, Place place, Cell a, Cell b, bool untyped) {
  if (const auto none = no_result(op, type->basic, a, b)) {
    complain(place, none->what, none->remedy);
    return {type_of(Basic::unknown), place};
  }
  return constant(type, apply(op, type->basic, a, b), place, untyped);
}

Expression Compiler::apply_op(Op op, const Type* type, Place place, const Expression& a,
                              const Expression& b) {
  constexpr int deepest = 400;
  if (a.unknown() || b.unknown()) return {type_of(Basic::unknown), place};
  if (a.constant && b.constant && is_pure(op)) {
    Expression result = folded(op, type, place, a.value, b.value, a.untyped && b.untyped);
    if (type->basic == Basic::boolean) result.untyped = false;
    return result;
  }
  Expression result{type, place};
  result.depth = std::max(a.depth, b.depth) + 1;
  if (result.depth > deepest) give_up(place, "the expression is too long", "split it up by a variable");
  const int first = value_node(a);
  result.node = add_node(op, type->basic, place, first, value_node(b));
  return result;
}

Expression Compiler::apply_op(Op op, const Type* type, Place place, const Expression& a) {
  if (a.unknown()) return {type_of(Basic::unknown), place};
  if (a.constant) return folded(op, type, place, a.value, 0, a.untyped && op != Op::round_real);
  Expression result{type, place};
  result.depth = a.depth + 1;
  result.node = add_node(op, type->basic, place, value_node(a));
  return result;
}

}  // namespace drycut::devices::plcopen::st
