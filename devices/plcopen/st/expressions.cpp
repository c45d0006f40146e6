#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Operators by their precedence (IEC 61131-3, as CODESYS reads it): parentheses and calls, **, - and NOT,
// * / MOD, + -, < > <= >=, = <>, AND, XOR, OR. AND and OR take both sides; AND_THEN and OR_ELSE do not.
namespace drycut::devices::plcopen::st {
namespace {

struct Level {
  std::array<std::string_view, 4> signs;
};
// From the weakest on; "" fills up.
constexpr std::array<Level, 7> levels{{{{"OR", "OR_ELSE", "", ""}},
                                       {{"XOR", "", "", ""}},
                                       {{"AND", "&", "AND_THEN", ""}},
                                       {{"=", "<>", "", ""}},
                                       {{"<", ">", "<=", ">="}},
                                       {{"+", "-", "", ""}},
                                       {{"*", "/", "MOD", ""}}}};

bool belongs(const Token& token, const Level& level) {
  if (token.kind != Token::Kind::name && token.kind != Token::Kind::sign) return false;
  return std::any_of(level.signs.begin(), level.signs.end(),
                     [&](std::string_view sign) { return !sign.empty() && same_word(sign, token.text); });
}

/// Counts how deep the reader is in parentheses.
class Depth {
 public:
  explicit Depth(int& count) : count_(count) { ++count_; }
  ~Depth() { --count_; }
  Depth(const Depth&) = delete;
  Depth& operator=(const Depth&) = delete;

 private:
  int& count_;
};
constexpr int deepest = 60;

}  // namespace

Expression Compiler::expression() {
  const Depth depth(nesting_);
  if (nesting_ > deepest)
    give_up(peek().place, "the expression is nested too deeply", "split it up by a variable");
  return expression(0);
}

Expression Compiler::expression(int level) {
  if (level == static_cast<int>(levels.size())) return unary();
  Expression result = expression(level + 1);
  while (at_ < stop_ && belongs(peek(), levels.at(static_cast<std::size_t>(level)))) {
    const Token sign = take();
    Expression right = expression(level + 1);
    result = binary(sign, std::move(result), std::move(right));
  }
  return result;
}

Expression Compiler::unary() {
  const Token sign = peek();
  if (!sign.is("-") && !sign.is("+") && !sign.word("NOT")) return powers();
  const Depth depth(nesting_);
  if (nesting_ > deepest)
    give_up(sign.place, "the expression is nested too deeply", "split it up by a variable");
  take();
  Expression operand = unary();
  if (operand.unknown()) return operand;
  const Basic basic = operand.type->basic;
  if (sign.word("NOT")) {
    if (operand.untyped) give_up(sign.place, "NOT of a number without a type", "give it one: WORD#16#FF");
    if (basic == Basic::boolean || is_integer(basic))
      return apply_op(Op::bit_not, operand.type, sign.place, operand);
  } else if (is_number(basic) || (basic == Basic::time && sign.is("+"))) {
    if (sign.is("+")) return operand;
    return apply_op(is_real(basic) ? Op::negate_real : Op::negate, operand.type, sign.place, operand);
  }
  complain(sign.place, fmt::format("{} does not go with {}", quoted(sign.text), operand.type->name),
           sign.word("NOT") ? "it takes BOOL and whole numbers" : "it takes numbers");
  return {type_of(Basic::unknown), sign.place};
}

Expression Compiler::powers() {
  Expression base = primary();
  while (peek().is("**")) {
    const Token sign = take();
    Expression exponent = peek().is("-") ? unary() : primary();
    if (base.unknown() || exponent.unknown()) {
      base = {type_of(Basic::unknown), sign.place};
      continue;
    }
    if (!is_number(base.type->basic) || !is_number(exponent.type->basic)) {
      base = mismatch(sign, base, exponent, "it takes numbers");
      continue;
    }
    const Type* type = type_of(base.type->basic == Basic::real ? Basic::real : Basic::lreal);
    base = apply_op(Op::power, type, sign.place, cast(base, type->basic, base.place),
                    cast(exponent, Basic::lreal, exponent.place));
  }
  return base;
}

Expression Compiler::primary() {
  const Token& token = peek();
  if (at_ >= stop_) give_up(behind(), "an expression is missing at the end", "a value stands here");
  switch (token.kind) {
    case Token::Kind::integer:
      take();
      return constant(type_of(Basic::lint), token.number, token.place, true);
    case Token::Kind::real:
      take();
      return constant(type_of(Basic::lreal), cell_of(token.real), token.place, true);
    case Token::Kind::time:
      take();
      return constant(type_of(Basic::time), token.number, token.place);
    case Token::Kind::string: {
      take();
      Expression text{type_of(Basic::string), token.place};
      text.node =
          add_node(Op::address_pool, Basic::string, token.place, -1, -1, -1, literal_string(token.string));
      text.string = token.string;
      return text;
    }
    case Token::Kind::name: {
      const Place place = token.place;
      Expression named = name_expression();
      if (!peek().is("(") || named.unknown()) return named;
      const bool block = named.type->basic == Basic::block;
      give_up(place, fmt::format("{} is {} and cannot be called here", quoted(named.name), named.type->name),
              block ? "call it in a statement of its own and read its outputs"
                    : "a variable hides a function of its name: choose another one");
    }
    case Token::Kind::address:
      give_up(token.place, quoted(token.text) + " stands in an expression",
              "declare a variable at it: start AT %IX0.0 : BOOL;");
    default:
      break;
  }
  if (!accept("("))
    give_up(token.place, fmt::format("an expression is missing before {}", quoted(token.text)),
            "a value stands here");
  const Token opening = tokens_[at_ - 1];
  Expression inner = expression();
  expect(")", fmt::format("closes the parenthesis of line {}", opening.place.line));
  // (x) is a value, nothing to assign to.
  if (inner.address && is_elementary(inner.type->basic)) {
    inner.node = value_node(inner);
    inner.address = false;
  }
  return inner;
}

Expression Compiler::mismatch(const Token& sign, const Expression& a, const Expression& b,
                              const std::string& remedy) {
  const auto name = [](const Expression& e) {
    if (!e.untyped) return e.type->name;
    return std::string(is_real(e.type->basic) ? "a real number" : "a whole number");
  };
  complain(sign.place, fmt::format("{} does not go with {} and {}", quoted(sign.text), name(a), name(b)),
           remedy);
  return {type_of(Basic::unknown), sign.place};
}

Expression Compiler::binary(const Token& sign, Expression a, Expression b) {
  if (a.unknown() || b.unknown()) return {type_of(Basic::unknown), sign.place};
  if (belongs(sign, levels[5]) || belongs(sign, levels[6]))
    return arithmetic(sign, std::move(a), std::move(b));
  if (belongs(sign, levels[3]) || belongs(sign, levels[4]))
    return comparison(sign, std::move(a), std::move(b));
  return logic(sign, std::move(a), std::move(b));
}

const Type* Compiler::common_literals(const Expression& a, const Expression& b) const {
  const Expression& literal = a.untyped ? a : b;
  const Expression& other = a.untyped ? b : a;
  const Basic basic = other.type->basic;
  const bool real = is_real(literal.type->basic);
  if (other.untyped) return type_of(real || is_real(basic) ? Basic::lreal : Basic::lint);
  if (is_real(basic)) return other.type;
  if (real) return widens(basic, Basic::lreal) && is_integer(basic) ? type_of(Basic::lreal) : nullptr;
  if (basic == Basic::boolean) return literal.value == 0 || literal.value == 1 ? other.type : nullptr;
  if (!is_integer(basic) && basic != Basic::enumeration) return nullptr;
  for (const Basic candidate : {basic, Basic::int_, Basic::dint, Basic::lint}) {
    const Range range = range_of(candidate);
    const bool holds = literal.value >= range.low && literal.value <= range.high;
    if (holds && widens(basic, candidate) && candidate != Basic::enumeration) return type_of(candidate);
  }
  return nullptr;
}

const Type* Compiler::common_type(const Expression& a, const Expression& b) const {
  if (a.untyped || b.untyped) return common_literals(a, b);
  const Type& x = *a.type;
  const Type& y = *b.type;
  if (same_type(x, y)) return &x;
  if (x.basic == Basic::enumeration && y.basic == Basic::enumeration) return nullptr;
  if (widens(x.basic, y.basic) && y.basic != Basic::enumeration) return &y;
  if (widens(y.basic, x.basic) && x.basic != Basic::enumeration) return &x;
  for (const Basic wider : {Basic::int_, Basic::dint, Basic::lint, Basic::real, Basic::lreal})
    if (widens(x.basic, wider) && widens(y.basic, wider)) return type_of(wider);
  return nullptr;
}

Expression Compiler::arithmetic(const Token& sign, Expression a, Expression b) {
  if (a.type->basic == Basic::time || b.type->basic == Basic::time)
    return time_arithmetic(sign, std::move(a), std::move(b));
  const Type* type = is_number(a.type->basic) && is_number(b.type->basic) ? common_type(a, b) : nullptr;
  const bool modulo = sign.word("MOD");
  if (type == nullptr || (modulo && is_real(type->basic)))
    return mismatch(sign, a, b, modulo ? "it takes whole numbers" : "convert one: X_TO_Y(...)");
  const bool untyped = a.untyped && b.untyped;
  a = converted(std::move(a), *type);
  b = converted(std::move(b), *type);
  a.untyped = b.untyped = untyped;
  const bool real = is_real(type->basic);
  if ((modulo || sign.is("/")) && b.constant && (real ? real_of(b.value) == 0 : b.value == 0)) {
    complain(sign.place, "division by the constant 0", "divide by something else");
    return {type_of(Basic::unknown), sign.place};
  }
  const Op op = modulo         ? Op::modulo
                : sign.is("+") ? (real ? Op::add_real : Op::add)
                : sign.is("-") ? (real ? Op::subtract_real : Op::subtract)
                : sign.is("*") ? (real ? Op::multiply_real : Op::multiply)
                               : (real ? Op::divide_real : Op::divide);
  return apply_op(op, type, sign.place, a, b);
}

Expression Compiler::time_arithmetic(const Token& sign, Expression a, Expression b) {
  const Type* time = type_of(Basic::time);
  if (a.type->basic == b.type->basic && (sign.is("+") || sign.is("-")))
    return apply_op(sign.is("+") ? Op::add : Op::subtract, time, sign.place, a, b);
  if (sign.is("*") && b.type->basic == Basic::time) std::swap(a, b);
  if ((!sign.is("*") && !sign.is("/")) || !is_number(b.type->basic))
    return mismatch(sign, a, b, "TIME + TIME, TIME - TIME, TIME * number and TIME / number are times");
  const bool real = is_real(b.type->basic);
  if (sign.is("/") && b.constant && (real ? real_of(b.value) == 0 : b.value == 0)) {
    complain(sign.place, "division by the constant 0", "divide by something else");
    return {type_of(Basic::unknown), sign.place};
  }
  if (real) b = cast(b, Basic::lreal, b.place);
  const Op op = sign.is("*") ? (real ? Op::scale_time : Op::multiply) : (real ? Op::divide_time : Op::divide);
  return apply_op(op, time, sign.place, a, b);
}

Expression Compiler::logic(const Token& sign, Expression a, Expression b) {
  const auto takes = [](const Expression& e) {
    return e.type->basic == Basic::boolean || is_integer(e.type->basic);
  };
  const bool lazy = sign.word("AND_THEN") || sign.word("OR_ELSE");
  const Type* type = takes(a) && takes(b) ? common_type(a, b) : nullptr;
  const bool booleans = type != nullptr && type->basic == Basic::boolean;
  if (type == nullptr || (lazy && !booleans))
    return mismatch(sign, a, b, lazy ? "it takes BOOL" : "it takes two BOOL or two whole numbers");
  const bool untyped = a.untyped && b.untyped;
  a = converted(std::move(a), *type);
  b = converted(std::move(b), *type);
  a.untyped = b.untyped = untyped;
  const Op op = sign.word("AND_THEN")  ? Op::and_then
                : sign.word("OR_ELSE") ? Op::or_else
                : sign.word("OR")      ? Op::bit_or
                : sign.word("XOR")     ? Op::bit_xor
                                       : Op::bit_and;
  return apply_op(op, type, sign.place, a, b);
}

Expression Compiler::comparison(const Token& sign, Expression a, Expression b) {
  constexpr std::array<std::string_view, 6> signs{"=", "<>", "<", "<=", ">", ">="};
  const auto number = std::find(signs.begin(), signs.end(), sign.text) - signs.begin();
  const Op op = static_cast<Op>(static_cast<int>(Op::equal) + number);
  const Op real_op = static_cast<Op>(static_cast<int>(Op::equal_real) + number);
  const Type* boolean = type_of(Basic::boolean);
  if (a.type->basic == Basic::string && b.type->basic == Basic::string)
    return string_comparison(op, sign, a, b);
  const Type* type = common_type(a, b);
  if (type == nullptr || !is_elementary(type->basic)) return mismatch(sign, a, b, "compare two of one type");
  a = converted(std::move(a), *type);
  b = converted(std::move(b), *type);
  return apply_op(is_real(type->basic) ? real_op : op, boolean, sign.place, a, b);
}

Expression Compiler::string_comparison(Op op, const Token& sign, const Expression& a, const Expression& b) {
  Expression order{type_of(Basic::int_), sign.place};
  order.depth = std::max(a.depth, b.depth) + 1;
  order.node = add_node(Op::compare_strings, Basic::int_, sign.place, a.node, b.node);
  return apply_op(op, type_of(Basic::boolean), sign.place, order,
                  constant(type_of(Basic::int_), 0, sign.place));
}

}  // namespace drycut::devices::plcopen::st
