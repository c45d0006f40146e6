#include "devices/plcopen/st/values.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

// A value as one of another type: literals, what IEC 61131-3 makes by itself, conversion functions.
namespace drycut::devices::plcopen::st {

TypedExpression Values::negated_literal(TypedExpression literal) {
  constexpr Cell lowest = std::numeric_limits<Cell>::min();
  const bool wide = is_wide(literal.type->basic);
  if (wide && literal.value < 0 && literal.value != lowest)
    return refuse("st.out-of-range"_code, literal.place,
                  fmt::format("the constant -{} is out of range", whole_text(literal)),
                  fmt::format("a LINT goes down to {}", lowest));
  // The lowest LINT and the ULINT that is as large have the same bits.
  literal.type = type_of(literal.value == lowest && !wide ? Basic::ulint : Basic::lint);
  if (literal.value != lowest) literal.value = -literal.value;
  return literal;
}

TypedExpression Values::literal_as(TypedExpression literal, const Type& to) {
  const Basic basic = to.basic;
  const bool real = is_real(literal.type->basic);
  const bool wide = is_wide(literal.type->basic);
  const auto unsigned_value = static_cast<std::uint64_t>(literal.value);
  if (is_real(basic)) {
    const double value = real   ? real_of(literal.value)
                         : wide ? static_cast<double>(unsigned_value)
                                : static_cast<double>(literal.value);
    const double kept = rounded(basic, value);
    if (!std::isfinite(kept) && std::isfinite(value))
      complain("st.out-of-range"_code, literal.place,
               fmt::format("the constant {} is out of the range of REAL", value),
               "a REAL goes to 3.4e38, an LREAL to 1.8e308");
    literal.value = cell_of(kept);
  } else if (!real && wide && is_integer(basic)) {
    if (!is_wide(basic))
      complain("st.out-of-range"_code, literal.place,
               fmt::format("the constant {} is out of the range of {}", unsigned_value, to.name),
               fmt::format("{} to {}", range_of(to).low, range_of(to).high));
  } else if (!real && (is_integer(basic) || basic == Basic::boolean)) {
    const Subrange range = range_of(to);
    if (literal.value < range.low || literal.value > range.high)
      complain("st.out-of-range"_code, literal.place,
               fmt::format("the constant {} is out of the range of {}", literal.value, to.name),
               is_wide(basic) && !to.subrange ? "0 to 18446744073709551615"
                                              : fmt::format("{} to {}", range.low, range.high));
  } else if (real && is_integer(basic) && std::trunc(real_of(literal.value)) == real_of(literal.value)) {
    // 2 ** 3 and 8.0
    complain("st.type"_code, literal.place,
             fmt::format("{} is an LREAL here, which does not go into {} by itself", real_of(literal.value),
                         to.name),
             fmt::format("LREAL_TO_{}(...) converts; ** and SQRT give LREAL, a whole number has no '.'",
                         type_of(basic)->name));
  } else if (real && is_integer(basic)) {
    complain("st.type"_code, literal.place,
             fmt::format("{} is not a whole number for {}", real_of(literal.value), to.name),
             fmt::format("LREAL_TO_{} rounds, TRUNC cuts off", to.name));
  } else {
    const char* remedy = is_span(basic)                ? "a TIME is written T#500ms"
                         : basic == Basic::tod         ? "a TOD is written TOD#06:30:00"
                         : basic == Basic::date        ? "a DATE is written D#2024-02-29"
                         : basic == Basic::dt          ? "a DT is written DT#2024-02-29-06:30:00"
                         : basic == Basic::enumeration ? "name one of its values"
                         : basic == Basic::boolean     ? "TRUE or FALSE"
                         : is_character(basic)         ? "a CHAR is written CHAR#'A', a WCHAR WCHAR#\"A\""
                         : basic == Basic::string      ? "a text stands between single quotes"
                                                       : "give a variable of that type";
    const std::string number =
        real ? fmt::format("{}", real_of(literal.value)) : fmt::format("{}", literal.value);
    complain("st.type"_code, literal.place, fmt::format("the number {} is no {}", number, to.name), remedy);
  }
  literal.type = &to;
  literal.untyped = false;
  return literal;
}

TypedExpression Values::converted(TypedExpression expression, const Type& to) {
  const Type& from = *expression.type;
  if (expression.unknown() || to.basic == Basic::unknown || (same_type(from, to) && !to.subrange)) {
    expression.untyped = false;
    return expression;
  }
  if (from.basic == Basic::reference || to.basic == Basic::reference)
    return reference_converted(std::move(expression), to);
  if (expression.untyped || (expression.constant && to.subrange && from.basic == to.basic))
    return literal_as(std::move(expression), to);
  // %MW3 is what it is used as.
  if (expression.direct && is_integer(to.basic) && bits_of(to.basic) == bits_of(from.basic) && !to.subrange) {
    expression = as_value(std::move(expression));
    return cast(expression, to.basic, expression.place);
  }
  if (auto character = character_converted(expression, to)) return std::move(*character);
  const auto fits = [&] {
    return widens(from.basic, to.basic) ||
           (from.subrange && from.low >= range_of(to.basic).low && from.high <= range_of(to.basic).high);
  };
  if (is_number(from.basic) && is_number(to.basic) && is_bits(from.basic) != is_bits(to.basic) && fits() &&
      is_iec(DialectDifference::bits_as_numbers, expression.place))
    return refuse("st.type"_code, expression.place,
                  fmt::format("a value of type {} does not go into {} by itself", from.name, to.name),
                  fmt::format("{}_TO_{}(...) converts", type_of(from.basic)->name, type_of(to.basic)->name));
  // INT (0..9) goes wherever all its values do.
  if (from.subrange && !to.subrange && is_integer(to.basic) && from.low >= range_of(to).low &&
      from.high <= range_of(to).high) {
    TypedExpression whole = as_value(std::move(expression));
    whole.type = type_of(to.basic);
    return whole;
  }
  if (to.subrange) return in_subrange(converted(std::move(expression), *base_of(&to)), to);
  // A text that is too long is cut off, as on the machine; a literal is refused.
  if (from.basic == Basic::string && to.basic == Basic::string) {
    if (from.wide != to.wide)
      return refuse("st.type"_code, expression.place,
                    fmt::format("a value of type {} does not go into {}", from.name, to.name),
                    expression.string
                        ? (to.wide ? "a WSTRING is written \"text\"" : "a STRING is written 'text'")
                    : to.wide ? "STRING_TO_WSTRING(...) converts"
                              : "WSTRING_TO_STRING(...) converts");
    if (expression.string && characters(*expression.string, to.wide) > to.length)
      complain(
          "st.out-of-range"_code, expression.place,
          fmt::format("{} characters do not fit in {}", characters(*expression.string, to.wide), to.name),
          fmt::format("{} at most", to.length));
    return expression;
  }
  if (widens(from.basic, to.basic) && to.basic != Basic::enumeration)
    return cast(expression, to.basic, expression.place);
  const auto convertible = [](const Type& type) {
    return is_elementary(type.basic) || type.basic == Basic::string;
  };
  const bool casts = convertible(from) && convertible(to) && to.basic != Basic::enumeration;
  const std::string from_name =
      !casts || from.basic == Basic::enumeration ? "INT" : type_of(from.basic)->name;
  const std::string what = expression.name.empty() ? fmt::format("a value of type {} does not", from.name)
                                                   : fmt::format("{} is {}, which does not",
                                                                 in_quotes(expression.name), from.name);
  return refuse("st.type"_code, expression.place, fmt::format("{} go into {} by itself", what, to.name),
                casts ? fmt::format("{}_TO_{}(...) converts", from_name, type_of(to.basic)->name)
                      : fmt::format("a value of type {} is wanted", to.name));
}

/// A value of the base type, looked at when the program runs.
TypedExpression Values::in_subrange(const TypedExpression& value, const Type& to) {
  if (value.unknown()) return value;
  if (value.constant) return literal_as(value, to);
  const int span = add_span({to.low, to.high, 1});
  return {&to, value.place, add_node(StOp::in_range, to.basic, value.place, value_node(value), -1, span),
          value.depth + 1};
}

TypedExpression Values::cast(const TypedExpression& expression, Basic to, Place place) {
  const Basic from = expression.type->basic;
  const Type* type = type_of(to);
  if (expression.on_the_way) {
    const bool wider = is_real(to) || (is_integer(to) && bits_of(to) > bits_of(from));
    if (!wider) return cast(taken_as(expression, from), to, place);
    is_iec(DialectDifference::results_on_the_way, place);
    const Basic full = range_of(from).low < 0 ? Basic::dint : Basic::udint;
    return cast(taken_as(expression, is_integer(to) && bits_of(to) <= 32 ? to : full), to, place);
  }
  if (from == to) return expression;
  if (is_clock(from) && is_clock(to) && (long_clock(from) == from || long_clock(to) == to))
    return clock_cast(expression, to, place);
  if (from == Basic::dt && (to == Basic::tod || to == Basic::date)) {
    const TypedExpression seconds = apply_op(StOp::seconds_of_day, type, place, expression);
    return to == Basic::date
               ? apply_op(StOp::subtract, type, place, expression, seconds)
               : apply_op(StOp::multiply, type, place, seconds, constant(type_of(Basic::int_), 1000, place));
  }
  StOp op = StOp::wrap;
  if (to == Basic::boolean) {
    op = is_real(from) ? StOp::nonzero_real : StOp::nonzero;
  } else if (is_real(to)) {
    op = is_real(from) ? StOp::round_real : is_wide(from) ? StOp::unsigned_to_real : StOp::to_real;
  } else if (is_real(from)) {
    op = StOp::to_whole;
  }
  // Nothing to do where the value stays what it is.
  const bool same = (op == StOp::round_real && to == Basic::lreal) ||
                    (op == StOp::wrap && range_of(from).low >= range_of(to).low &&
                     range_of(from).high <= range_of(to).high);
  if (!same) return apply_op(op, type, place, expression);
  TypedExpression result = expression;
  if (!result.constant) result = as_value(std::move(result));
  result.type = type;
  result.untyped = false;
  return result;
}

/// To or from a long one: the part that is asked for, in its unit.
TypedExpression Values::clock_cast(const TypedExpression& value, Basic to, Place place) {
  const Basic from = value.type->basic;
  const Type* lint = type_of(Basic::lint);
  const auto number = [&](std::int64_t count) { return constant(lint, count, place); };
  const auto is = [](Basic basic, Basic kind) { return long_clock(basic) == kind; };
  TypedExpression result = value.constant ? value : as_value(value);
  result.type = lint;
  constexpr std::int64_t seconds_per_day = 86400;
  if (is(from, Basic::ldt) && !is(to, Basic::ldt)) {
    const TypedExpression day = number(seconds_per_day * per_second(from));
    const TypedExpression clock = apply_op(StOp::modulo, lint, place, result, day);
    result = is(to, Basic::ltod) ? clock : apply_op(StOp::subtract, lint, place, result, clock);
  }
  if (per_second(to) > per_second(from))
    result = apply_op(StOp::multiply, lint, place, result, number(per_second(to) / per_second(from)));
  else if (per_second(to) < per_second(from))
    result = apply_op(StOp::divide, lint, place, result, number(per_second(from) / per_second(to)));
  result = apply_op(StOp::wrap, type_of(to), place, result);
  result.untyped = false;
  return result;
}

/// 'A' as a CHAR, a CHAR as a STRING; nothing if it is neither.
std::optional<TypedExpression> Values::character_converted(const TypedExpression& value, const Type& to) {
  const Type& from = *value.type;
  if (is_character(from.basic) && to.basic == Basic::string &&
      (from.basic == Basic::wide_character) == to.wide)
    return text_value(TextOp::from_value, nullptr, {value}, to.wide, value.place);
  if (!is_character(to.basic) || !value.string || (to.basic == Basic::wide_character) != from.wide)
    return std::nullopt;
  if (characters(*value.string, from.wide) != 1)
    return refuse("st.type"_code, value.place,
                  fmt::format("{} characters for a {}", characters(*value.string, from.wide), to.name),
                  "it holds one");
  return constant(&to, value_of(to.basic, *value.string), value.place);
}

}  // namespace drycut::devices::plcopen::st
