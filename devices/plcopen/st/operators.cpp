#include "devices/plcopen/st/values.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

// What an operator makes of two values: the type that both have, conversions to it, a node. AND and OR take
// both sides; AND_THEN and OR_ELSE do not.
namespace drycut::devices::plcopen::st {
namespace {

using Kind = Operator::Kind;
constexpr std::array operators{
    Operator{"OR", 0, Kind::logic, StOp::bit_or},
    Operator{"OR_ELSE", 0, Kind::lazy, StOp::or_else},
    Operator{"XOR", 1, Kind::logic, StOp::bit_xor},
    Operator{"AND", 2, Kind::logic, StOp::bit_and},
    Operator{"&", 2, Kind::logic, StOp::bit_and},
    Operator{"AND_THEN", 2, Kind::lazy, StOp::and_then},
    Operator{"=", 3, Kind::comparison, StOp::equal, StOp::equal_real},
    Operator{"<>", 3, Kind::comparison, StOp::not_equal, StOp::not_equal_real},
    Operator{"<", 4, Kind::comparison, StOp::less, StOp::less_real},
    Operator{">", 4, Kind::comparison, StOp::greater, StOp::greater_real},
    Operator{"<=", 4, Kind::comparison, StOp::less_equal, StOp::less_equal_real},
    Operator{">=", 4, Kind::comparison, StOp::greater_equal, StOp::greater_equal_real},
    Operator{"+", 5, Kind::arithmetic, StOp::add, StOp::add_real},
    Operator{"-", 5, Kind::arithmetic, StOp::subtract, StOp::subtract_real},
    Operator{"*", 6, Kind::arithmetic, StOp::multiply, StOp::multiply_real},
    Operator{"/", 6, Kind::arithmetic, StOp::divide, StOp::divide_real},
    Operator{"MOD", 6, Kind::modulo, StOp::modulo},
    Operator{"**", 7, Kind::power, StOp::power, StOp::power}};

/// Its place among the operators, or behind them if it is none; any case.
std::size_t place_of(std::string_view sign) {
  const auto* const found = std::find_if(operators.begin(), operators.end(),
                                         [&](const Operator& known) { return same_word(known.sign, sign); });
  return static_cast<std::size_t>(found - operators.begin());
}

bool is_zero(const TypedExpression& value) {
  return value.constant && (is_real(value.type->basic) ? real_of(value.value) == 0 : value.value == 0);
}

const Type* common_literals(const TypedExpression& a, const TypedExpression& b, const Type* wanted) {
  const TypedExpression& literal = a.untyped ? a : b;
  const TypedExpression& other = a.untyped ? b : a;
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
    const Subrange range = range_of(candidate);
    const bool holds = literal.value >= range.low && literal.value <= range.high;
    if (holds && widens(basic, candidate) && candidate != Basic::enumeration) return type_of(candidate);
  }
  return nullptr;
}

/// No literal, and no bits.
bool is_number_with_type(const TypedExpression& value) {
  return !value.untyped && is_integer(value.type->basic) && !is_bits(value.type->basic);
}

/// One operator between two values.
struct Operation {
  Values& values;
  const Operator& sign;
  const StToken& told;
  TypedExpression a;
  TypedExpression b;
  const Type* wanted;

  TypedExpression result() {
    switch (sign.kind) {
      case Kind::power:
        return power();
      case Kind::comparison:
        return comparison();
      case Kind::arithmetic:
      case Kind::modulo:
        return arithmetic();
      default:
        return logic();
    }
  }

 private:
  TypedExpression mismatch(const std::string& remedy) {
    const auto name = [](const TypedExpression& e) {
      if (!e.untyped) return e.type->name;
      return std::string(is_real(e.type->basic) ? "a real number" : "a whole number");
    };
    return values.refuse("st.type"_code, told.place,
                         fmt::format("{} does not go with {} and {}", in_quotes(told.text), name(a), name(b)),
                         remedy);
  }

  TypedExpression division_by_zero() {
    return values.refuse("st.division-by-zero"_code, told.place, "division by the constant 0",
                         "divide by something else");
  }

  /// Both as `type`; two literals stay literals.
  void convert_both(const Type& type) {
    const bool untyped = a.untyped && b.untyped;
    a = values.converted(std::move(a), type);
    b = values.converted(std::move(b), type);
    a.untyped = b.untyped = untyped;
  }

  TypedExpression apply(StOp op, const Type* type, const TypedExpression& x, const TypedExpression& y) {
    return values.apply_op(op, type, told.place, x, y);
  }

  /// Told where the program is of IEC 61131-3.
  [[nodiscard]] bool refuses_bits() const {
    return ((is_bits(a.type->basic) && !a.untyped) || (is_bits(b.type->basic) && !b.untyped)) &&
           values.is_iec(DialectDifference::arithmetic_on_bits, told.place);
  }
  TypedExpression bits_are_no_numbers() {
    return mismatch("bits are no numbers in IEC 61131-3: " +
                    as_other_kind(is_bits(a.type->basic) && !a.untyped ? a : b) + " makes one");
  }

  TypedExpression power() {
    if (!is_number(a.type->basic) || !is_number(b.type->basic)) return mismatch("it takes numbers");
    if (refuses_bits()) return bits_are_no_numbers();
    const Type* type = real_result(a, wanted);
    return apply(StOp::power, type, values.cast(a, type->basic, a.place),
                 values.cast(b, Basic::lreal, b.place));
  }

  TypedExpression arithmetic() {
    const bool modulo = sign.kind == Kind::modulo;
    if (is_clock(a.type->basic) || is_clock(b.type->basic)) return time_arithmetic();
    if (a.type->basic == Basic::reference) return reference_arithmetic();
    const Type* type =
        is_number(a.type->basic) && is_number(b.type->basic) ? common_type(a, b, wanted) : nullptr;
    if (type == nullptr || (modulo && is_real(type->basic)))
      return mismatch(modulo ? "it takes whole numbers" : "convert one: X_TO_Y(...)");
    if (refuses_bits()) return bits_are_no_numbers();
    convert_both(*type);
    if ((modulo || sign.op == StOp::divide) && is_zero(b)) return division_by_zero();
    if (is_real(type->basic)) return apply(sign.real_op, type, a, b);
    return values.computed(sign.op, type, told.place, std::move(a), std::move(b));
  }

  TypedExpression time_arithmetic() {
    if (is_clock(a.type->basic) && is_clock(b.type->basic)) return clock_arithmetic();
    const bool times = sign.op == StOp::multiply;
    if (times && is_span(b.type->basic)) std::swap(a, b);
    if ((!times && sign.op != StOp::divide) || !is_number(b.type->basic) || !is_span(a.type->basic))
      return mismatch("TIME + TIME, TIME - TIME, TIME * number and TIME / number are times");
    if (refuses_bits()) return bits_are_no_numbers();
    if (!times && is_zero(b)) return division_by_zero();
    const bool real = is_real(b.type->basic);
    if (b.constant && (real ? real_of(b.value) < 0 : b.value < 0 && !is_wide(b.type->basic)))
      note_below_zero();
    if (real) b = values.cast(b, Basic::lreal, b.place);
    const StOp scaled = times ? StOp::scale_time : StOp::divide_time;
    return apply(real ? scaled : sign.op, a.type, a, b);
  }

  /// What comes of it may be below 0, which a TIME of CODESYS is not.
  void note_below_zero() {
    if (!a.type->is_long()) values.is_iec(DialectDifference::negative_time, told.place);
  }

  TypedExpression clock_arithmetic() {
    const bool plus = sign.op == StOp::add;
    if (plus && is_span(a.type->basic)) std::swap(a, b);
    // One long one makes the result long.
    if (a.type->is_long() || b.type->is_long())
      for (TypedExpression* of : {&a, &b}) *of = values.cast(*of, long_clock(of->type->basic), of->place);
    const Basic basic = a.type->basic;
    const Basic kind = long_clock(basic);
    const bool times = is_span(basic) && is_span(b.type->basic);
    const bool moved = (kind == Basic::ltod || kind == Basic::ldt) && is_span(b.type->basic);
    const bool between = !plus && basic == b.type->basic;
    if ((!plus && sign.op != StOp::subtract) || (!times && !moved && !between))
      return mismatch("a TIME goes to a TOD or DT, and lies between two of a kind");
    const bool now = a.node >= 0 && !a.address && values.computes(a.node) == StOp::time_now;
    if (between && !now && !(a.constant && b.constant && a.value >= b.value)) note_below_zero();
    const Type* time = a.type->is_long() ? type_of(Basic::ltime) : values.time_type();
    const auto number = [&](std::int64_t value) { return constant(time, value, told.place); };
    if (between || times) {
      TypedExpression way = apply(sign.op, time, a, b);
      return per_second(basic) == 1 ? apply(StOp::multiply, time, way, number(1000)) : way;
    }
    if (kind == Basic::ldt)
      return apply(sign.op, a.type, a,
                   per_second(basic) == 1 ? apply(StOp::divide, time, b, number(1000)) : b);
    // The clock begins anew at midnight.
    const std::int64_t day = std::int64_t{86400} * per_second(basic);
    const TypedExpression way = apply(StOp::modulo, time, b, number(day));
    const TypedExpression later = apply(StOp::add, time, a, number(day));
    return apply(StOp::modulo, a.type, apply(sign.op, time, later, way), number(day));
  }

  /// In bytes: further on or back, and how far it is from one to the other.
  TypedExpression reference_arithmetic() {
    const Type* lint = type_of(Basic::lint);
    const bool plain = sign.op == StOp::add || sign.op == StOp::subtract;
    if (plain && is_integer(b.type->basic))
      return apply(sign.op, a.type, a, values.cast(b, Basic::lint, b.place));
    if (sign.op == StOp::subtract && b.type->basic == Basic::reference) return apply(sign.op, lint, a, b);
    return mismatch("bytes are added to a reference and taken from it");
  }

  TypedExpression logic() {
    const auto takes = [](const TypedExpression& e) {
      return e.type->basic == Basic::boolean || is_integer(e.type->basic);
    };
    const bool lazy = sign.kind == Kind::lazy;
    const Type* type = takes(a) && takes(b) ? common_type(a, b, nullptr) : nullptr;
    const bool booleans = type != nullptr && type->basic == Basic::boolean;
    if (type == nullptr || (lazy && !booleans))
      return mismatch(lazy ? "it takes BOOL" : "it takes two BOOL or two whole numbers");
    if ((is_number_with_type(a) || is_number_with_type(b)) &&
        values.is_iec(DialectDifference::logic_on_numbers, told.place))
      return mismatch("numbers are no bits in IEC 61131-3: " + as_other_kind(is_number_with_type(a) ? a : b) +
                      " makes bits of one");
    convert_both(*type);
    return apply(sign.op, type, a, b);
  }

  TypedExpression comparison() {
    const Type* boolean = type_of(Basic::boolean);
    take_characters(values, a, b);
    if (a.unknown() || b.unknown()) return unknown_at(told.place);
    if (a.type->basic == Basic::string && b.type->basic == Basic::string && a.type->wide == b.type->wide) {
      const Type* whole = type_of(Basic::int_);
      const TypedExpression order{
          whole, told.place, values.add_node(StOp::compare_strings, Basic::int_, told.place, a.node, b.node),
          std::max(a.depth, b.depth) + 1};
      return apply(sign.op, boolean, order, constant(whole, 0, told.place));
    }
    const bool references = a.type->basic == Basic::reference || b.type->basic == Basic::reference;
    const auto is_address = [](const TypedExpression& value) {
      const Basic basic = value.type->basic;
      return basic == Basic::reference || basic == Basic::lword || basic == Basic::ulint ||
             (value.constant && value.untyped && value.value == 0);
    };
    if (references && (!is_address(a) || !is_address(b)))
      return mismatch("a reference is compared with another one, NULL or an LWORD");
    const Type* type = references ? null_reference() : common_type(a, b, nullptr);
    if (type == nullptr || !is_single(type->basic)) return mismatch("compare two of one type");
    a = values.converted(std::move(a), *type);
    b = values.converted(std::move(b), *type);
    a.on_the_way = b.on_the_way = false;
    if (is_wide(type->basic)) {
      // With the first bit turned over, the order of signed numbers is that of unsigned ones.
      const TypedExpression first = constant(type, std::numeric_limits<std::int64_t>::min(), told.place);
      a = apply(StOp::bit_xor, type, a, first);
      b = apply(StOp::bit_xor, type, b, first);
    }
    return apply(is_real(type->basic) ? sign.real_op : sign.op, boolean, a, b);
  }
};

TypedExpression no_operand(Values& values, const StToken& sign, const TypedExpression& operand,
                           std::string remedy) {
  return values.refuse("st.type"_code, sign.place,
                       fmt::format("{} does not go with {}", in_quotes(sign.text), operand.type->name),
                       std::move(remedy));
}

}  // namespace

std::string as_other_kind(const TypedExpression& value) {
  const Basic basic = value.type->basic;
  constexpr std::array kinds{std::pair{Basic::byte, Basic::usint}, std::pair{Basic::word, Basic::uint},
                             std::pair{Basic::dword, Basic::udint}, std::pair{Basic::lword, Basic::ulint}};
  for (const auto& [bits, number] : kinds)
    if (bits_of(bits) == bits_of(basic))
      return fmt::format("{}_TO_{}(...)", type_of(basic)->name,
                         type_of(is_bits(basic) ? number : bits)->name);
  return "X_TO_Y(...)";
}

void take_characters(Values& values, TypedExpression& a, TypedExpression& b) {
  if (is_character(a.type->basic) && b.string) b = values.converted(std::move(b), *a.type);
  if (is_character(b.type->basic) && a.string) a = values.converted(std::move(a), *b.type);
}

const Operator* find_operator(const StToken& token) {
  if (token.kind != StToken::Kind::name && token.kind != StToken::Kind::sign) return nullptr;
  const std::size_t place = place_of(token.text);
  return place < operators.size() ? &operators.at(place) : nullptr;
}

TypedExpression binary(Values& values, std::string_view sign, const StToken& told, TypedExpression a,
                       TypedExpression b, const Type* wanted) {
  if (a.unknown() || b.unknown()) return unknown_at(told.place);
  return Operation{values, operators.at(place_of(sign)), told, std::move(a), std::move(b), wanted}.result();
}

TypedExpression signed_value(Values& values, const StToken& sign, TypedExpression operand,
                             const Type* wanted) {
  if (operand.unknown()) return operand;
  const Basic basic = operand.type->basic;
  if (sign.word("NOT")) return complement(values, sign, std::move(operand), wanted);
  const bool below_zero = basic == Basic::ltime || basic == Basic::signed_time;
  if (!is_number(basic) && !(is_clock(basic) && sign.is("+")) && !below_zero)
    return no_operand(
        values, sign, operand,
        basic == Basic::time ? "it takes numbers; a TIME is below 0 under dialect: iec" : "it takes numbers");
  if (sign.is("+")) return operand;
  if (is_bits(basic) && !operand.untyped && values.is_iec(DialectDifference::arithmetic_on_bits, sign.place))
    return no_operand(values, sign, operand, "it takes numbers: " + as_other_kind(operand) + " makes one");
  if (operand.constant && operand.untyped && is_integer(basic)) {
    operand.place = sign.place;
    return values.negated_literal(std::move(operand));
  }
  if (!is_integer(basic))
    return values.apply_op(is_real(basic) ? StOp::negate_real : StOp::negate, operand.type, sign.place,
                           operand);
  const Type* type = base_of(operand.type);
  return values.computed(StOp::subtract, type, sign.place, constant(type, 0, sign.place), std::move(operand));
}

TypedExpression complement(Values& values, const StToken& sign, TypedExpression operand, const Type* wanted) {
  operand = literal_for_bits(values, std::move(operand), wanted, sign);
  if (operand.unknown()) return operand;
  const Basic basic = operand.type->basic;
  if (is_number_with_type(operand) && values.is_iec(DialectDifference::logic_on_numbers, sign.place))
    return no_operand(values, sign, operand,
                      "it takes BOOL and bits: " + as_other_kind(operand) + " makes them");
  if (basic == Basic::boolean || is_integer(basic))
    return values.apply_op(StOp::bit_not, operand.type, sign.place, operand);
  return no_operand(values, sign, operand, "it takes BOOL and whole numbers");
}

TypedExpression literal_for_bits(Values& values, TypedExpression value, const Type* wanted,
                                 const StToken& function) {
  if (!value.untyped) return value;
  if (wanted != nullptr && is_integer(wanted->basic))
    return values.literal_as(std::move(value), *base_of(wanted));
  return values.refuse("st.type"_code, function.word("NOT") ? function.place : value.place,
                       fmt::format("{} of a number without a type", upper(function.text)),
                       "give it one: WORD#16#FF", function.place);
}

const Type* common_type(const TypedExpression& a, const TypedExpression& b, const Type* wanted) {
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
  if (is_clock(x.basic) || is_clock(y.basic)) return nullptr;
  for (const Basic wider : {Basic::int_, Basic::dint, Basic::lint, Basic::real, Basic::lreal})
    if (widens(x.basic, wider) && widens(y.basic, wider)) return type_of(wider);
  return nullptr;
}

const Type* real_result(const TypedExpression& value, const Type* wanted) {
  const Basic basic = value.type->basic;
  const bool open = value.untyped || (is_integer(basic) && widens(basic, Basic::real));
  const bool single = basic == Basic::real || (open && wanted != nullptr && wanted->basic == Basic::real);
  return type_of(single ? Basic::real : Basic::lreal);
}

}  // namespace drycut::devices::plcopen::st
