#include "devices/plcopen/st/standard_call.hpp"

#include <algorithm>

#include <fmt/format.h>

// What the standard functions make of their inputs.
namespace drycut::devices::plcopen::st {

TypedExpression StandardCall::refused(const TypedExpression& value, std::string takes) {
  return values.refuse("st.type"_code, value.place,
                       fmt::format("{} does not take {}", upper(name.text), value.type->name),
                       std::move(takes), place());
}

TypedExpression StandardCall::chain() {
  TypedExpression result = inputs[0];
  for (std::size_t i = 1; i < inputs.size(); ++i)
    result = binary(values, function.sign, name, std::move(result), inputs[i], wanted);
  return result;
}

TypedExpression StandardCall::ordered() {
  const auto holds = [&](std::size_t i) {
    return binary(values, function.sign, name, inputs[i - 1], inputs[i], nullptr);
  };
  TypedExpression all = holds(1);
  for (std::size_t i = 2; i < inputs.size(); ++i)
    all = binary(values, "AND", name, std::move(all), holds(i), nullptr);
  return all;
}

TypedExpression StandardCall::same() {
  return inputs[0].constant || inputs[0].string ? inputs[0] : values.as_value(inputs[0]);
}

TypedExpression StandardCall::shift() {
  const TypedExpression bits = literal_for_bits(values, inputs[0], wanted, name);
  if (bits.unknown()) return bits;
  if (!is_integer(bits.type->basic)) return refused(bits, "it takes whole numbers");
  if (!is_integer(basic(1))) return refused(inputs[1], "the number of places is a whole number");
  if (!is_bits(bits.type->basic) && values.is_iec(DialectDifference::logic_on_numbers, place()))
    return refused(bits, "it takes bits in IEC 61131-3: " + as_other_kind(bits) + " makes them");
  return values.apply_op(function.op, bits.type, place(), bits, inputs[1]);
}

const TypedExpression* StandardCall::no_number() const {
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [](const TypedExpression& value) { return !is_number(value.type->basic); });
  return found == inputs.end() ? nullptr : &*found;
}

const TypedExpression* StandardCall::bits_of_iec() const {
  for (const TypedExpression& value : inputs)
    if (is_bits(value.type->basic) && !value.untyped &&
        values.is_iec(DialectDifference::arithmetic_on_bits, place()))
      return &value;
  return nullptr;
}

TypedExpression StandardCall::absolute() {
  if (no_number() != nullptr) return refused(*no_number(), "it takes numbers");
  if (bits_of_iec() != nullptr)
    return refused(*bits_of_iec(), as_other_kind(*bits_of_iec()) + " makes a number");
  return values.apply_op(is_real(basic(0)) ? StOp::absolute_real : StOp::absolute, inputs[0].type, place(),
                         inputs[0]);
}

TypedExpression StandardCall::real() {
  if (no_number() != nullptr) return refused(*no_number(), "it takes numbers");
  if (bits_of_iec() != nullptr)
    return refused(*bits_of_iec(), as_other_kind(*bits_of_iec()) + " makes a number");
  const bool untyped = inputs[0].untyped && inputs.back().untyped;
  const Type* type = real_result(inputs[0], wanted);
  if (inputs.back().type->basic == Basic::lreal && !inputs.back().untyped) type = type_of(Basic::lreal);
  for (TypedExpression& value : inputs) value = values.cast(value, type->basic, value.place);
  TypedExpression result = inputs.size() == 1
                               ? values.apply_op(function.op, type, place(), inputs[0])
                               : values.apply_op(function.op, type, place(), inputs[0], inputs[1]);
  result.untyped = untyped && result.constant;
  return result;
}

std::optional<StandardCall::Inputs> StandardCall::to_common(const Inputs& given) {
  TypedExpression common = given.front();
  for (const TypedExpression& value : given) {
    if (value.unknown()) return std::nullopt;
    const Type* type = common_type(common, value, wanted);
    if (type == nullptr || !is_elementary(type->basic)) {
      if (same_type(*common.type, *value.type)) {
        refused(value, "numbers, bits, times and texts; IF chooses between others");
        return std::nullopt;
      }
      values.complain("st.type"_code, value.place,
                      fmt::format("{} takes values of one type, not {} and {}", upper(name.text),
                                  common.type->name, value.type->name),
                      "convert one: X_TO_Y(...)");
      return std::nullopt;
    }
    const bool untyped = common.untyped && value.untyped;
    common.type = type;
    common.untyped = untyped;
    // A literal that decides the type of two must be one of that type itself.
    if (value.constant) common.value = value.value;
  }
  Inputs result;
  for (const TypedExpression& value : given) {
    result.push_back(values.converted(value, *common.type));
    result.back().untyped = common.untyped;
  }
  return result;
}

std::optional<StandardCall::Inputs> StandardCall::to_chosen(const Inputs& given) {
  const auto is_text = [](const TypedExpression& value) { return value.type->basic == Basic::string; };
  if (std::all_of(given.begin(), given.end(), is_text)) {
    const auto other = std::find_if(given.begin(), given.end(), [&](const TypedExpression& value) {
      return value.type->wide != given.front().type->wide;
    });
    if (other == given.end()) return given;
    refused(*other, "texts are all STRING or all WSTRING: STRING_TO_WSTRING(...) converts");
    return std::nullopt;
  }
  auto common = to_common(given);
  if (!common || !common->front().untyped) return common;
  const bool real = is_real(common->front().type->basic);
  if (real && (wanted == nullptr || wanted->basic != Basic::real)) return common;
  if (wanted != nullptr && (real || is_integer(wanted->basic))) {
    for (TypedExpression& value : *common) value = values.literal_as(std::move(value), *base_of(wanted));
    return common;
  }
  // Literals have the smallest type that holds them all.
  for (const Basic basic : {Basic::int_, Basic::dint, Basic::lint}) {
    const Subrange range = range_of(basic);
    if (std::all_of(common->begin(), common->end(), [&](const TypedExpression& e) {
          return e.value >= range.low && e.value <= range.high;
        })) {
      for (TypedExpression& value : *common) value = values.literal_as(std::move(value), *type_of(basic));
      break;
    }
  }
  return common;
}

TypedExpression StandardCall::extreme(const Inputs& given, StOp whole, StOp real) {
  const auto common = to_common(given);
  if (!common) return unknown_at(place());
  const Type* type = common->front().type;
  TypedExpression result = common->front();
  for (std::size_t i = 1; i < common->size(); ++i)
    result = values.apply_op(is_real(type->basic) ? real : whole, type, place(), result, (*common)[i]);
  return result;
}

TypedExpression StandardCall::smallest_of(const Inputs& given) {
  return extreme(given, StOp::minimum, StOp::minimum_real);
}

TypedExpression StandardCall::largest_of(const Inputs& given) {
  return extreme(given, StOp::maximum, StOp::maximum_real);
}

TypedExpression StandardCall::limit() {
  const auto common = to_common(inputs);
  if (!common) return unknown_at(place());
  return smallest_of({largest_of({(*common)[1], (*common)[0]}), (*common)[2]});
}

const Type* StandardCall::chosen_type(const Inputs& given) const {
  const Type* type = base_of(given.front().type);
  return type->basic == Basic::string ? values.longest_string(type->wide) : type;
}

TypedExpression StandardCall::select() {
  const TypedExpression which = values.converted(inputs[0], *type_of(Basic::boolean));
  const auto common = to_chosen({inputs[1], inputs[2]});
  if (!common || which.unknown()) return unknown_at(place());
  if (which.constant && (*common)[0].constant && (*common)[1].constant)
    return (*common)[which.value != 0 ? 1 : 0];
  const Type* type = chosen_type(*common);
  const int condition = values.value_node(which);
  const int on = values.value_node((*common)[1]);
  const int off = values.value_node((*common)[0]);
  return {type, place(), values.add_node(StOp::select, type->basic, place(), condition, on, off),
          depth_over(inputs)};
}

TypedExpression StandardCall::multiplex() {
  const auto common = to_chosen({inputs.begin() + 1, inputs.end()});
  if (!common) return unknown_at(place());
  const TypedExpression& which = inputs[0];
  if (!is_integer(basic(0)))
    values.give_up("st.type"_code, which.place, fmt::format("MUX chooses by {}", which.type->name),
                   "by a whole number, from 0");
  const auto count = static_cast<std::int64_t>(common->size());
  if (which.constant && (which.value < 0 || which.value >= count))
    values.give_up("st.out-of-range"_code, which.place, fmt::format("MUX has no value {}", which.value),
                   fmt::format("0 to {}", count - 1));
  const Type* type = chosen_type(*common);
  const std::vector<int> nodes = nodes_of(*common);
  const int number = values.value_node(which);
  const int list = values.add_list(nodes);
  return {type, place(),
          values.add_node(StOp::multiplex, type->basic, place(), number, list, static_cast<int>(count)),
          depth_over(inputs)};
}

std::vector<int> StandardCall::nodes_of(const Inputs& given) {
  std::vector<int> nodes;
  for (const TypedExpression& value : given) nodes.push_back(values.value_node(value));
  return nodes;
}

TypedExpression StandardCall::text() {
  const std::size_t texts = texts_of(function.text, inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (i < texts && basic(i) != Basic::string)
      return refused(inputs[i], "it takes a STRING: X_TO_STRING(...) makes one");
    if (i >= texts && !is_integer(basic(i)))
      return refused(inputs[i], "lengths and places are whole numbers, from 1");
    if (i < texts && inputs[i].type->wide != inputs[0].type->wide)
      return refused(inputs[i], "texts are all STRING or all WSTRING: STRING_TO_WSTRING(...) converts");
  }
  return text_value(function.text, type_of(Basic::int_));
}

TypedExpression StandardCall::text_value(TextOp op, const Type* number, bool wide_result) {
  return values.text_value(op, number, inputs, wide_result || inputs[0].type->wide, place());
}

TypedExpression StandardCall::moment() {
  const bool whole = function.to == Basic::dt;
  const std::string takes = whole ? "a DATE and a TOD make a DT" : "a date and a time of day make an LDT";
  if (long_clock(basic(0)) != Basic::ldate || (whole && basic(0) != Basic::date))
    return refused(inputs[0], takes);
  if (long_clock(basic(1)) != Basic::ltod || (whole && basic(1) != Basic::tod))
    return refused(inputs[1], takes);
  const Type* type = type_of(function.to);
  if (!whole)
    return values.apply_op(StOp::add, type, place(), values.cast(inputs[0], Basic::ldate, place()),
                           values.cast(inputs[1], Basic::ltod, place()));
  const TypedExpression ms_per_second = constant(type_of(Basic::dint), 1000, place());
  return values.apply_op(StOp::add, type, place(), inputs[0],
                         values.apply_op(StOp::divide, type, place(), inputs[1], ms_per_second));
}

TypedExpression StandardCall::truncated() {
  if (!is_real(basic(0))) return refused(inputs[0], "it takes REAL and LREAL");
  TypedExpression value = inputs[0];
  const bool rounds = function.op != StOp::truncate;
  if (rounds) value = values.apply_op(function.op, value.type, place(), value);
  if (rounds && wanted != nullptr && is_real(wanted->basic)) return value;
  const bool open = function.to == Basic::dint && wanted != nullptr && is_integer(wanted->basic);
  TypedExpression result =
      values.apply_op(StOp::truncate, open ? base_of(wanted) : type_of(function.to), place(), value);
  result.untyped = false;
  return result;
}

TypedExpression StandardCall::clock() {
  const Type* type = function.to == Basic::time ? values.time_type() : type_of(function.to);
  return {type, place(), values.add_node(StOp::time_now, type->basic, place())};
}

TypedExpression StandardCall::valid() {
  const bool real = function.op == StOp::valid_real;
  if (real ? !is_real(basic(0)) : !is_bits(basic(0)))
    return refused(inputs[0], real ? "it takes REAL and LREAL" : "it takes BYTE, WORD, DWORD and LWORD");
  TypedExpression result = values.apply_op(function.op, type_of(Basic::boolean), place(), inputs[0]);
  result.untyped = false;
  return result;
}

TypedExpression StandardCall::in_byte_order() {
  const TypedExpression value = literal_for_bits(values, inputs[0], wanted, name);
  if (value.unknown()) return value;
  if (!is_whole(value.type->basic)) return refused(value, "it takes whole numbers, bits, times and dates");
  if (function.op == StOp::nothing || bits_of(value.type->basic) <= 8)
    return value.constant ? value : values.as_value(value);
  return values.apply_op(function.op, value.type, place(), value);
}

TypedExpression StandardCall::converted(const Type& target) {
  const Basic to = target.basic;
  TypedExpression& value = inputs[0];
  const Basic from = basic(0);
  const bool text = from == Basic::string;
  // Between times and dates only what a part of the other is, or counts the same.
  const Basic kind = long_clock(from);
  const Basic other = long_clock(to);
  const auto either = [&](Basic one, Basic two) {
    return (kind == one && other == two) || (kind == two && other == one);
  };
  const bool apart = is_clock(from) && is_clock(to) && kind != other && !either(Basic::ltime, Basic::ltod) &&
                     !either(Basic::ldate, Basic::ldt) && !(kind == Basic::ldt && other == Basic::ltod);
  if ((!text && !is_elementary(from)) || apart)
    return refused(value, "it takes numbers, BOOL, TIME and STRING");
  const bool bits = (is_bits(from) && is_real(to)) || (is_real(from) && is_bits(to));
  if (bits && bits_of(from) == bits_of(to) && !value.untyped &&
      values.is_iec(DialectDifference::reals_of_bits, place()))
    return values.apply_op(is_real(to) ? StOp::bits_to_real : StOp::real_to_bits, type_of(to), place(),
                           value);
  if (value.untyped && (from == Basic::lint || from == Basic::ulint || from == Basic::lreal))
    value.untyped = false;
  if (to == Basic::string && text && value.type->wide != target.wide) {
    // The same bytes, counted otherwise.
    TypedExpression other = value;
    other.type = values.longest_string(target.wide);
    other.string.reset();
    other.address = false;
    return other;
  }
  if (to == Basic::string) return text ? value : text_value(TextOp::from_value, nullptr, target.wide);
  if (text) return text_value(TextOp::to_value, type_of(to));
  TypedExpression result = values.cast(value, to, place());
  // A conversion is a value, nothing to assign to.
  return result.address ? values.as_value(std::move(result)) : result;
}

}  // namespace drycut::devices::plcopen::st
