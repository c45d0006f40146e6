#include "devices/plcopen/st/values.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "devices/plcopen/st/code.hpp"

namespace drycut::devices::plcopen::st {
namespace {

/// Of one statement in another.
constexpr int levels_of_a_statement = 3;

}  // namespace

TypedExpression constant(const Type* type, Cell value, Place place, bool untyped) {
  TypedExpression result{type, place};
  result.constant = true;
  result.untyped = untyped;
  result.value = value;
  return result;
}

TypedExpression variable_at(const Type* type, int node, const std::string& name, Place place) {
  TypedExpression result{type, place, node};
  result.address = true;
  result.name = name;
  return result;
}

int depth_over(const std::vector<TypedExpression>& values) {
  int depth = 1;
  for (const TypedExpression& value : values) depth = std::max(depth, value.depth + 1);
  return depth;
}

TypedExpression Values::refuse(Code code, Place place, std::string what, std::string remedy, Place of) {
  complain(code, place, std::move(what), std::move(remedy));
  return unknown_at(of);
}

int Values::add_node(StOp op, Basic basic, Place place, int a, int b, int c, std::int64_t imm) {
  nodes_.nodes.push_back({op, basic, place.line, place.column, a, b, c, imm});
  return static_cast<int>(nodes_.nodes.size()) - 1;
}

int Values::add_list(const std::vector<int>& items) {
  const int first = static_cast<int>(nodes_.lists.size());
  nodes_.lists.insert(nodes_.lists.end(), items.begin(), items.end());
  return first;
}

int Values::add_span(const Span& span) {
  nodes_.spans.push_back(span);
  return static_cast<int>(nodes_.spans.size()) - 1;
}

int Values::value_node(const TypedExpression& expression) {
  if (unit_ != nullptr)
    unit_->levels = std::max(unit_->levels, expression.depth + levels_of_a_statement * nesting_);
  if (expression.bits) return bits_node(expression);
  const Basic basic = expression.type->basic;
  if (expression.constant) return leaf_node(StOp::constant, basic, expression.place, expression.value);
  // What a node's value is itself; of other types it is the address.
  if (!expression.address || !is_single(basic)) return expression.node;
  if (expression.reference >= 0)
    return add_node(StOp::load_by, basic, expression.place, expression.reference);
  if (expression.node < 0) return -1;
  const Node address = node(expression.node);
  if (address.op == StOp::address) return leaf_node(StOp::load, basic, expression.place, address.imm);
  if (address.op == StOp::address_own) return leaf_node(StOp::load_own, basic, expression.place, address.imm);
  return add_node(StOp::load_at, basic, expression.place, expression.node);
}

int Values::bits_node(const TypedExpression& expression) {
  TypedExpression whole = expression;
  whole.type = base_of(expression.bits->of);
  whole.bits.reset();
  const TypedExpression places = constant(type_of(Basic::int_), expression.bits->shift, expression.place);
  const TypedExpression moved = apply_op(StOp::shift_right, whole.type, expression.place, whole, places);
  return value_node(apply_op(StOp::wrap, expression.type, expression.place, moved));
}

TypedExpression Values::as_value(TypedExpression expression) {
  expression.node = value_node(expression);
  expression.type = base_of(expression.type);
  expression.bits.reset();
  expression.address = false;
  expression.reference = -1;
  return expression;
}

int Values::address_plus(int address, std::int64_t offset) {
  if (offset == 0 || address < 0) return address;
  Node moved = node(address);
  moved.imm += offset;
  nodes_.nodes.push_back(moved);
  return static_cast<int>(nodes_.nodes.size()) - 1;
}

int Values::in_pool(std::size_t cells) {
  const std::size_t first = pool_.size();
  pool_.resize(first + cells, 0);
  return static_cast<int>(first);
}

int Values::literal_string(const std::string& text, Place place) {
  auto [entry, fresh] = strings_.emplace(text, static_cast<int>(pool_.size()));
  if (fresh) {
    in_pool(static_cast<std::size_t>(string_cells(text.size())));
    std::memcpy(pool_.data() + entry->second, text.data(), text.size());
  }
  return leaf_node(StOp::address_pool, Basic::string, place, entry->second);
}

int Values::scratch(const Type& type, Place place) {
  return leaf_node(StOp::address_pool, type.basic, place, in_pool(static_cast<std::size_t>(type.cells)));
}

const Type* Values::longest_string(bool wide) {
  const std::size_t length = code_->longest_text;
  const Type*& known = wide ? longest_wide_ : longest_string_;
  if (known != nullptr && known->length == length) return known;
  Type longest = *type_of(Basic::string);
  longest.name = fmt::format("{}[{}]", wide ? "WSTRING" : "STRING", length);
  longest.length = length;
  longest.wide = wide;
  longest.cells = string_cells(bytes_of_text(longest));
  longest.initial.assign(static_cast<std::size_t>(longest.cells), 0);
  code_->longest_bytes = std::max(code_->longest_bytes, bytes_of_text(longest));
  code_->types.push_back(std::make_unique<Type>(std::move(longest)));
  return known = code_->types.back().get();
}

std::string whole_text(const TypedExpression& value) {
  return is_wide(value.type->basic) ? fmt::format("{}", static_cast<std::uint64_t>(value.value))
                                    : fmt::format("{}", value.value);
}

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
  } else if (real && is_integer(basic)) {
    complain("st.type"_code, literal.place,
             fmt::format("{} is not a whole number for {}", real_of(literal.value), to.name),
             fmt::format("LREAL_TO_{} rounds, TRUNC cuts off", to.name));
  } else {
    const char* remedy = basic == Basic::time          ? "a TIME is written T#500ms"
                         : basic == Basic::tod         ? "a TOD is written TOD#06:30:00"
                         : basic == Basic::date        ? "a DATE is written D#2024-02-29"
                         : basic == Basic::dt          ? "a DT is written DT#2024-02-29-06:30:00"
                         : basic == Basic::enumeration ? "name one of its values"
                         : basic == Basic::boolean     ? "TRUE or FALSE"
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
  if (from == to) return expression;
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

TypedExpression Values::folded(StOp op, const Type* type, Place place, Cell a, Cell b, bool untyped) {
  if (const auto none = no_result(op, type->basic, a, b))
    return refuse(none->code, place, none->what, none->remedy);
  return constant(type, apply(op, type->basic, a, b), place, untyped);
}

TypedExpression Values::apply_op(StOp op, const Type* type, Place place, const TypedExpression& a,
                                 const TypedExpression& b) {
  constexpr int deepest = 400;
  if (a.unknown() || b.unknown()) return unknown_at(place);
  type = base_of(type);
  if (a.constant && b.constant && is_pure(op)) {
    TypedExpression result = folded(op, type, place, a.value, b.value, a.untyped && b.untyped);
    if (type->basic == Basic::boolean) result.untyped = false;
    return result;
  }
  const int depth = std::max(a.depth, b.depth) + 1;
  if (depth > deepest)
    give_up("st.too-large"_code, place, "the expression is too long", "split it up by a variable");
  const int first = value_node(a);
  return {type, place, add_node(op, type->basic, place, first, value_node(b)), depth};
}

TypedExpression Values::apply_op(StOp op, const Type* type, Place place, const TypedExpression& a) {
  if (a.unknown()) return unknown_at(place);
  type = base_of(type);
  if (a.constant) return folded(op, type, place, a.value, 0, a.untyped && op != StOp::round_real);
  return {type, place, add_node(op, type->basic, place, value_node(a)), a.depth + 1};
}

}  // namespace drycut::devices::plcopen::st
