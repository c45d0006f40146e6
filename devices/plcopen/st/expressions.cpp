#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Operators: types and nodes from an expression's tree. AND and OR take both sides; AND_THEN and OR_ELSE do
// not. What the context wants, `wanted`, decides only where the parts leave it open: for literals.
namespace drycut::devices::plcopen::st {
namespace {

constexpr std::array<std::string_view, 6> comparisons{"=", "<>", "<", "<=", ">", ">="};

bool is_zero(const Expression& value) {
  return value.constant && (is_real(value.type->basic) ? real_of(value.value) == 0 : value.value == 0);
}

}  // namespace

Expression Compiler::expression(const Type* wanted) { return typed(tree(), wanted); }

Expression Compiler::typed(const Tree& tree, const Type* wanted) {
  switch (tree.kind) {
    case Tree::Kind::literal:
      return literal(*tree.token);
    case Tree::Kind::typed:
      return typed_literal(tree);
    case Tree::Kind::name:
      return name_expression(*tree.token, wanted);
    case Tree::Kind::member:
      return member_of(tree);
    case Tree::Kind::element:
      return element_of(tree);
    case Tree::Kind::call:
      return call(tree, wanted);
    case Tree::Kind::sign:
      return signed_value(tree, wanted);
    case Tree::Kind::chain:
      break;
    case Tree::Kind::parenthesised: {
      Expression inner = typed(tree.parts[0], wanted);
      // (x) is a value, nothing to assign to.
      if (inner.address && is_elementary(inner.type->basic)) inner = as_value(std::move(inner));
      return inner;
    }
  }
  Expression result = typed(tree.parts[0], wanted);
  for (std::size_t i = 0; i < tree.tokens.size(); ++i) {
    const Token& sign = *tree.tokens[i];
    // A name of two enumerations is one of the other side's.
    const Type* const other = result.type->basic == Basic::enumeration ? result.type : wanted;
    Expression right = typed(tree.parts[i + 1], other);
    result = binary(sign.text, sign, std::move(result), std::move(right), wanted);
  }
  return result;
}

Expression Compiler::literal(const Token& token) {
  switch (token.kind) {
    case Token::Kind::integer:
      return constant(type_of(token.wide ? Basic::ulint : Basic::lint), token.number, token.place, true);
    case Token::Kind::real:
      return constant(type_of(Basic::lreal), cell_of(token.real), token.place, true);
    case Token::Kind::time:
      return constant(type_of(Basic::time), token.number, token.place);
    case Token::Kind::tod:
      return constant(type_of(Basic::tod), token.number, token.place);
    case Token::Kind::date:
      return constant(type_of(Basic::date), token.number, token.place);
    case Token::Kind::dt:
      return constant(type_of(Basic::dt), token.number, token.place);
    default:
      break;
  }
  Expression text{type_of(Basic::string), token.place};
  text.node =
      add_node(Op::address_pool, Basic::string, token.place, -1, -1, -1, literal_string(token.string));
  text.string = token.string;
  return text;
}

Expression Compiler::signed_value(const Tree& tree, const Type* wanted) {
  const Token& sign = *tree.token;
  Expression operand = typed(tree.parts[0], wanted);
  if (operand.unknown()) return operand;
  const Basic basic = operand.type->basic;
  if (sign.word("NOT")) return complement(sign, std::move(operand), wanted);
  if (is_number(basic) || (is_clock(basic) && sign.is("+"))) {
    if (sign.is("+")) return operand;
    return apply_op(is_real(basic) ? Op::negate_real : Op::negate, operand.type, sign.place, operand);
  }
  complain(sign.place, fmt::format("{} does not go with {}", in_quotes(sign.text), operand.type->name),
           "it takes numbers");
  return {type_of(Basic::unknown), sign.place};
}

Expression Compiler::complement(const Token& sign, Expression operand, const Type* wanted) {
  operand = literal_for_bits(std::move(operand), wanted, sign);
  if (operand.unknown()) return operand;
  const Basic basic = operand.type->basic;
  if (basic == Basic::boolean || is_integer(basic))
    return apply_op(Op::bit_not, operand.type, sign.place, operand);
  complain(sign.place, fmt::format("{} does not go with {}", in_quotes(sign.text), operand.type->name),
           "it takes BOOL and whole numbers");
  return {type_of(Basic::unknown), sign.place};
}

/// How wide a literal is decides what NOT and the shifts make of it.
Expression Compiler::literal_for_bits(Expression value, const Type* wanted, const Token& function) {
  if (!value.untyped) return value;
  if (wanted != nullptr && is_integer(wanted->basic)) return literal_as(std::move(value), *base_of(wanted));
  const Place place = function.word("NOT") ? function.place : value.place;
  complain(place, fmt::format("{} of a number without a type", upper(function.text)),
           "give it one: WORD#16#FF");
  return {type_of(Basic::unknown), function.place};
}

Expression Compiler::mismatch(const Token& sign, const Expression& a, const Expression& b,
                              const std::string& remedy) {
  const auto name = [](const Expression& e) {
    if (!e.untyped) return e.type->name;
    return std::string(is_real(e.type->basic) ? "a real number" : "a whole number");
  };
  complain(sign.place, fmt::format("{} does not go with {} and {}", in_quotes(sign.text), name(a), name(b)),
           remedy);
  return {type_of(Basic::unknown), sign.place};
}

Expression Compiler::binary(std::string_view sign, const Token& told, Expression a, Expression b,
                            const Type* wanted) {
  if (a.unknown() || b.unknown()) return {type_of(Basic::unknown), told.place};
  if (sign == "**") return power(told, a, b, wanted);
  if (std::find(comparisons.begin(), comparisons.end(), sign) != comparisons.end())
    return comparison(sign, told, std::move(a), std::move(b));
  if (sign == "+" || sign == "-" || sign == "*" || sign == "/" || same_word(sign, "MOD"))
    return arithmetic(sign, told, std::move(a), std::move(b), wanted);
  return logic(sign, told, std::move(a), std::move(b));
}

const Type* Compiler::common_literals(const Expression& a, const Expression& b, const Type* wanted) {
  const Expression& literal = a.untyped ? a : b;
  const Expression& other = a.untyped ? b : a;
  const Basic basic = other.type->basic;
  const bool real = is_real(literal.type->basic);
  const bool wide = is_wide(literal.type->basic);
  if (other.untyped) {
    const Basic whole = wide || is_wide(basic) ? Basic::ulint : Basic::lint;
    return type_of(real || is_real(basic) ? Basic::lreal : whole);
  }
  if (is_real(basic)) return other.type;
  if (real) {
    // A literal does not make more of a REAL than the context asks for.
    const bool single = wanted != nullptr && wanted->basic == Basic::real && widens(basic, Basic::real);
    return widens(basic, Basic::lreal) && is_integer(basic) ? type_of(single ? Basic::real : Basic::lreal)
                                                            : nullptr;
  }
  if (basic == Basic::boolean) return literal.value == 0 || literal.value == 1 ? other.type : nullptr;
  if (!is_integer(basic) && basic != Basic::enumeration) return nullptr;
  if (wide) return is_wide(basic) ? other.type : nullptr;
  for (const Basic candidate : {basic, Basic::int_, Basic::dint, Basic::lint}) {
    const Range range = range_of(candidate);
    const bool holds = literal.value >= range.low && literal.value <= range.high;
    if (holds && widens(basic, candidate) && candidate != Basic::enumeration) return type_of(candidate);
  }
  return nullptr;
}

const Type* Compiler::common_type(const Expression& a, const Expression& b, const Type* wanted) {
  if (a.untyped || b.untyped) {
    const Type* type = common_literals(a, b, wanted);
    return type == nullptr ? nullptr : base_of(type);
  }
  const Type& x = *base_of(a.type);
  const Type& y = *base_of(b.type);
  if (same_type(x, y)) return &x;
  if (x.basic == Basic::enumeration && y.basic == Basic::enumeration) return nullptr;
  if (widens(x.basic, y.basic) && y.basic != Basic::enumeration) return &y;
  if (widens(y.basic, x.basic) && x.basic != Basic::enumeration) return &x;
  for (const Basic wider : {Basic::int_, Basic::dint, Basic::lint, Basic::real, Basic::lreal})
    if (widens(x.basic, wider) && widens(y.basic, wider)) return type_of(wider);
  return nullptr;
}

Expression Compiler::power(const Token& told, const Expression& base, const Expression& exponent,
                           const Type* wanted) {
  if (!is_number(base.type->basic) || !is_number(exponent.type->basic))
    return mismatch(told, base, exponent, "it takes numbers");
  const Type* type = real_result(base, wanted);
  return apply_op(Op::power, type, told.place, cast(base, type->basic, base.place),
                  cast(exponent, Basic::lreal, exponent.place));
}

/// Of a REAL functions are REAL, of LREAL LREAL; of whole numbers LREAL unless the context wants a REAL.
const Type* Compiler::real_result(const Expression& value, const Type* wanted) {
  const Basic basic = value.type->basic;
  const bool open = value.untyped || (is_integer(basic) && widens(basic, Basic::real));
  const bool single = basic == Basic::real || (open && wanted != nullptr && wanted->basic == Basic::real);
  return type_of(single ? Basic::real : Basic::lreal);
}

Expression Compiler::arithmetic(std::string_view sign, const Token& told, Expression a, Expression b,
                                const Type* wanted) {
  if (is_clock(a.type->basic) || is_clock(b.type->basic))
    return time_arithmetic(sign, told, std::move(a), std::move(b));
  const Type* type =
      is_number(a.type->basic) && is_number(b.type->basic) ? common_type(a, b, wanted) : nullptr;
  const bool modulo = same_word(sign, "MOD");
  if (type == nullptr || (modulo && is_real(type->basic)))
    return mismatch(told, a, b, modulo ? "it takes whole numbers" : "convert one: X_TO_Y(...)");
  const bool untyped = a.untyped && b.untyped;
  a = converted(std::move(a), *type);
  b = converted(std::move(b), *type);
  a.untyped = b.untyped = untyped;
  if ((modulo || sign == "/") && is_zero(b)) return division_by_zero(told);
  const bool real = is_real(type->basic);
  const Op op = modulo        ? Op::modulo
                : sign == "+" ? (real ? Op::add_real : Op::add)
                : sign == "-" ? (real ? Op::subtract_real : Op::subtract)
                : sign == "*" ? (real ? Op::multiply_real : Op::multiply)
                              : (real ? Op::divide_real : Op::divide);
  return apply_op(op, type, told.place, a, b);
}

Expression Compiler::division_by_zero(const Token& told) {
  complain(told.place, "division by the constant 0", "divide by something else");
  return {type_of(Basic::unknown), told.place};
}

Expression Compiler::time_arithmetic(std::string_view sign, const Token& told, Expression a, Expression b) {
  const Type* time = type_of(Basic::time);
  if (is_clock(a.type->basic) && is_clock(b.type->basic)) return clock_arithmetic(sign, told, a, b);
  if (sign == "*" && b.type->basic == Basic::time) std::swap(a, b);
  if ((sign != "*" && sign != "/") || !is_number(b.type->basic) || a.type->basic != Basic::time)
    return mismatch(told, a, b, "TIME + TIME, TIME - TIME, TIME * number and TIME / number are times");
  if (sign == "/" && is_zero(b)) return division_by_zero(told);
  const bool real = is_real(b.type->basic);
  if (real) b = cast(b, Basic::lreal, b.place);
  const Op op = sign == "*" ? (real ? Op::scale_time : Op::multiply) : (real ? Op::divide_time : Op::divide);
  return apply_op(op, time, told.place, a, b);
}

Expression Compiler::clock_arithmetic(std::string_view sign, const Token& told, Expression a, Expression b) {
  const bool plus = sign == "+";
  if (plus && a.type->basic == Basic::time) std::swap(a, b);
  const Basic basic = a.type->basic;
  const bool times = basic == Basic::time && b.type->basic == Basic::time;
  const bool moved = (basic == Basic::tod || basic == Basic::dt) && b.type->basic == Basic::time;
  const bool between = !plus && basic == b.type->basic;
  if ((!plus && sign != "-") || (!times && !moved && !between))
    return mismatch(told, a, b, "a TIME goes to a TOD or DT, and lies between two of a kind");
  const Op op = plus ? Op::add : Op::subtract;
  const Type* time = type_of(Basic::time);
  const auto number = [&](std::int64_t value) { return constant(time, value, told.place); };
  if (between || times) {
    Expression way = apply_op(op, time, told.place, a, b);
    return per_second(basic) == 1 ? apply_op(Op::multiply, time, told.place, way, number(1000)) : way;
  }
  if (basic == Basic::dt)
    return apply_op(op, a.type, told.place, a, apply_op(Op::divide, time, told.place, b, number(1000)));
  // The clock begins anew at midnight.
  constexpr std::int64_t day = 86'400'000;
  const Expression way = apply_op(Op::modulo, time, told.place, b, number(day));
  const Expression later = apply_op(Op::add, time, told.place, a, number(day));
  return apply_op(Op::modulo, a.type, told.place, apply_op(op, time, told.place, later, way), number(day));
}

Expression Compiler::logic(std::string_view sign, const Token& told, Expression a, Expression b) {
  const auto takes = [](const Expression& e) {
    return e.type->basic == Basic::boolean || is_integer(e.type->basic);
  };
  const bool lazy = same_word(sign, "AND_THEN") || same_word(sign, "OR_ELSE");
  const Type* type = takes(a) && takes(b) ? common_type(a, b, nullptr) : nullptr;
  const bool booleans = type != nullptr && type->basic == Basic::boolean;
  if (type == nullptr || (lazy && !booleans))
    return mismatch(told, a, b, lazy ? "it takes BOOL" : "it takes two BOOL or two whole numbers");
  const bool untyped = a.untyped && b.untyped;
  a = converted(std::move(a), *type);
  b = converted(std::move(b), *type);
  a.untyped = b.untyped = untyped;
  const Op op = same_word(sign, "AND_THEN")  ? Op::and_then
                : same_word(sign, "OR_ELSE") ? Op::or_else
                : same_word(sign, "OR")      ? Op::bit_or
                : same_word(sign, "XOR")     ? Op::bit_xor
                                             : Op::bit_and;
  return apply_op(op, type, told.place, a, b);
}

Expression Compiler::comparison(std::string_view sign, const Token& told, Expression a, Expression b) {
  const auto number = std::find(comparisons.begin(), comparisons.end(), sign) - comparisons.begin();
  const Op op = static_cast<Op>(static_cast<int>(Op::equal) + number);
  const Op real_op = static_cast<Op>(static_cast<int>(Op::equal_real) + number);
  const Type* boolean = type_of(Basic::boolean);
  if (a.type->basic == Basic::string && b.type->basic == Basic::string)
    return string_comparison(op, told, a, b);
  const Type* type = common_type(a, b, nullptr);
  if (type == nullptr || !is_elementary(type->basic)) return mismatch(told, a, b, "compare two of one type");
  a = converted(std::move(a), *type);
  b = converted(std::move(b), *type);
  if (is_wide(type->basic)) {
    // With the first bit turned over, the order of signed numbers is that of unsigned ones.
    const Expression first = constant(type, std::numeric_limits<std::int64_t>::min(), told.place);
    a = apply_op(Op::bit_xor, type, told.place, a, first);
    b = apply_op(Op::bit_xor, type, told.place, b, first);
  }
  return apply_op(is_real(type->basic) ? real_op : op, boolean, told.place, a, b);
}

Expression Compiler::string_comparison(Op op, const Token& told, const Expression& a, const Expression& b) {
  Expression order{type_of(Basic::int_), told.place};
  order.depth = std::max(a.depth, b.depth) + 1;
  order.node = add_node(Op::compare_strings, Basic::int_, told.place, a.node, b.node);
  return apply_op(op, type_of(Basic::boolean), told.place, order,
                  constant(type_of(Basic::int_), 0, told.place));
}

}  // namespace drycut::devices::plcopen::st
