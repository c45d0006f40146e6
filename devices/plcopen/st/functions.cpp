#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Functions of IEC 61131-3 and conversions.
namespace drycut::devices::plcopen::st {

/// A function of one or two numbers.
struct StandardFunction {
  enum class Takes : std::uint8_t { real, number, bits };
  std::string_view name;
  std::size_t inputs = 1;
  Takes takes = Takes::real;
  Op op = Op::nothing;
};

namespace {

using Takes = StandardFunction::Takes;
constexpr std::array functions{
    StandardFunction{"ABS", 1, Takes::number, Op::absolute},
    StandardFunction{"SQRT", 1, Takes::real, Op::square_root},
    StandardFunction{"SIN", 1, Takes::real, Op::sine},
    StandardFunction{"COS", 1, Takes::real, Op::cosine},
    StandardFunction{"TAN", 1, Takes::real, Op::tangent},
    StandardFunction{"ASIN", 1, Takes::real, Op::arc_sine},
    StandardFunction{"ACOS", 1, Takes::real, Op::arc_cosine},
    StandardFunction{"ATAN", 1, Takes::real, Op::arc_tangent},
    StandardFunction{"ATAN2", 2, Takes::real, Op::arc_tangent_2},
    StandardFunction{"EXP", 1, Takes::real, Op::exponential},
    StandardFunction{"LN", 1, Takes::real, Op::logarithm},
    StandardFunction{"LOG", 1, Takes::real, Op::logarithm_10},
    StandardFunction{"EXPT", 2, Takes::real, Op::power},
    StandardFunction{"SHL", 2, Takes::bits, Op::shift_left},
    StandardFunction{"SHR", 2, Takes::bits, Op::shift_right},
    StandardFunction{"ROL", 2, Takes::bits, Op::rotate_left},
    StandardFunction{"ROR", 2, Takes::bits, Op::rotate_right},
};
constexpr std::array<std::string_view, 9> special{"MIN",   "MAX",  "LIMIT",     "SEL", "MUX",
                                                  "TRUNC", "TIME", "TRUNC_INT", "MOVE"};

/// "REAL_TO_INT" or "TO_INT"; the first is unknown in the second.
std::optional<std::pair<Basic, Basic>> conversion(std::string_view name) {
  const std::string text = upper(name);
  const std::size_t at = text.starts_with("TO_") ? 0 : text.find("_TO_");
  if (at == std::string::npos) return std::nullopt;
  const Type* from = at == 0 ? type_of(Basic::unknown) : elementary_type(text.substr(0, at));
  const Type* to = elementary_type(text.substr(at == 0 ? 3 : at + 4));
  if (from == nullptr || to == nullptr || !is_elementary(to->basic)) return std::nullopt;
  if (at != 0 && !is_elementary(from->basic)) return std::nullopt;
  return std::pair{from->basic, to->basic};
}

}  // namespace

Expression Compiler::call(const Token& name) {
  if (Unit* unit = find_unit(name.text); unit != nullptr && unit->kind == Unit::Kind::function)
    return user_call(*unit, name);
  for (const StandardFunction& function : functions)
    if (name.word(function.name)) return standard_call(function, name);
  if (name.word("TIME")) {
    plain_arguments(name, 0, 0);
    Expression now{type_of(Basic::time), name.place};
    now.node = add_node(Op::time_now, Basic::time, name.place);
    return now;
  }
  if (name.word("MIN") || name.word("MAX"))
    return minmax(name, plain_arguments(name, 2, 16), name.word("MAX"));
  if (name.word("LIMIT")) {
    std::vector<Expression> values = plain_arguments(name, 3, 3);
    std::optional<std::vector<Expression>> common = to_common(values, name);
    if (!common) return {type_of(Basic::unknown), name.place};
    Expression low = minmax(name, {(*common)[1], (*common)[0]}, true);
    return minmax(name, {std::move(low), (*common)[2]}, false);
  }
  if (name.word("SEL")) return select_call(name, plain_arguments(name, 3, 3));
  if (name.word("MUX")) return multiplex_call(name, plain_arguments(name, 3, 17));
  if (name.word("TRUNC")) return conversion_call(Basic::unknown, Basic::dint, name, true);
  if (name.word("TRUNC_INT")) return conversion_call(Basic::unknown, Basic::int_, name, true);
  if (const auto types = conversion(name.text))
    return conversion_call(types->first, types->second, name, false);

  std::vector<std::string> known;
  for (const StandardFunction& function : functions) known.emplace_back(function.name);
  for (const std::string_view other : special) known.emplace_back(other);
  for (const auto& unit : units_)
    if (unit->kind == Unit::Kind::function) known.emplace_back(unit->name.text);
  for (const Variable& member : unit_->type != nullptr ? unit_->type->members : globals_->members)
    if (member.type->basic == Basic::block) known.push_back(member.name);
  const bool block = find_block_type(name.text) != nullptr || find_unit(name.text) != nullptr;
  if (told_.insert(lower(name.text)).second)
    complain(name.place, fmt::format("there is no function {}", quoted(name.text)),
             block ? "it is a kind of function block: declare an instance of it in VAR and call that"
                   : suggestion(name.text, known, "declare FUNCTION " + std::string(name.text) + " : type"));
  arguments();
  return {type_of(Basic::unknown), name.place};
}

std::vector<Expression> Compiler::plain_arguments(const Token& name, std::size_t least, std::size_t most) {
  std::vector<Expression> values;
  for (Argument& argument : arguments()) {
    if (argument.name.kind != Token::Kind::end)
      give_up(argument.name.place,
              fmt::format("{} has no input {}", upper(name.text), quoted(argument.name.text)),
              "give the values in their order, without names");
    values.push_back(std::move(argument.value));
  }
  if (values.size() < least || values.size() > most)
    give_up(
        name.place,
        fmt::format("{} has {} value{}", upper(name.text), values.size(), values.size() == 1 ? "" : "s"),
        least == most ? fmt::format("it takes {}", least) : fmt::format("it takes {} to {}", least, most));
  return values;
}

Expression Compiler::standard_call(const StandardFunction& function, const Token& name) {
  std::vector<Expression> values = plain_arguments(name, function.inputs, function.inputs);
  for (const Expression& value : values)
    if (value.unknown()) return {type_of(Basic::unknown), name.place};
  const Basic basic = values[0].type->basic;
  const auto refuse = [&](const Expression& value, const char* wanted) {
    complain(value.place, fmt::format("{} does not take {}", function.name, value.type->name), wanted);
    return Expression{type_of(Basic::unknown), name.place};
  };
  if (function.takes == Takes::bits) {
    if (!is_integer(basic) || values[0].untyped)
      return values[0].untyped
                 ? (complain(values[0].place, fmt::format("{} of a number without a type", function.name),
                             "give it one: WORD#16#FF"),
                    Expression{type_of(Basic::unknown), name.place})
                 : refuse(values[0], "it takes whole numbers");
    if (!is_integer(values[1].type->basic))
      return refuse(values[1], "the number of places is a whole number");
    return apply_op(function.op, values[0].type, name.place, values[0], values[1]);
  }
  for (const Expression& value : values)
    if (!is_number(value.type->basic)) return refuse(value, "it takes numbers");
  if (function.takes == Takes::number)
    return apply_op(is_real(basic) ? Op::absolute_real : function.op, values[0].type, name.place, values[0]);
  // Of a REAL they are REAL; of whole numbers and LREAL they are LREAL.
  const bool single = basic == Basic::real && (function.inputs == 1 || function.op == Op::power ||
                                               values[1].type->basic == Basic::real || values[1].untyped);
  const Type* type = type_of(single ? Basic::real : Basic::lreal);
  const bool untyped = values[0].untyped && values.back().untyped;
  for (Expression& value : values) value = cast(value, type->basic, value.place);
  Expression result = function.inputs == 1 ? apply_op(function.op, type, name.place, values[0])
                                           : apply_op(function.op, type, name.place, values[0], values[1]);
  result.untyped = untyped && result.constant;
  return result;
}

std::optional<std::vector<Expression>> Compiler::to_common(const std::vector<Expression>& values,
                                                           const Token& name) {
  Expression common = values.front();
  for (const Expression& value : values) {
    if (value.unknown()) return std::nullopt;
    const Type* type = common_type(common, value);
    if (type == nullptr || !is_elementary(type->basic)) {
      complain(value.place,
               fmt::format("{} takes values of one type, not {} and {}", upper(name.text), common.type->name,
                           value.type->name),
               "convert one: X_TO_Y(...)");
      return std::nullopt;
    }
    const bool untyped = common.untyped && value.untyped;
    common.type = type;
    common.untyped = untyped;
    // A literal that decides the type of two must be one of that type itself.
    if (value.constant) common.value = value.value;
  }
  const bool untyped = common.untyped;
  std::vector<Expression> result;
  for (const Expression& value : values) {
    result.push_back(converted(value, *common.type));
    result.back().untyped = untyped;
  }
  return result;
}

std::optional<std::vector<Expression>> Compiler::to_chosen(const std::vector<Expression>& values,
                                                           const Token& name) {
  auto common = to_common(values, name);
  if (!common || !common->front().untyped || is_real(common->front().type->basic)) return common;
  // Literals among which a program chooses have the smallest type that holds them all.
  for (const Basic basic : {Basic::int_, Basic::dint, Basic::lint}) {
    const Range range = range_of(basic);
    if (std::all_of(common->begin(), common->end(),
                    [&](const Expression& e) { return e.value >= range.low && e.value <= range.high; })) {
      for (Expression& value : *common) value = literal_as(std::move(value), *type_of(basic));
      break;
    }
  }
  return common;
}

Expression Compiler::minmax(const Token& name, std::vector<Expression> values, bool largest) {
  const std::optional<std::vector<Expression>> common = to_common(values, name);
  if (!common) return {type_of(Basic::unknown), name.place};
  const Type* type = common->front().type;
  const bool real = is_real(type->basic);
  const Op op = largest ? (real ? Op::maximum_real : Op::maximum) : (real ? Op::minimum_real : Op::minimum);
  Expression result = common->front();
  for (std::size_t i = 1; i < common->size(); ++i)
    result = apply_op(op, type, name.place, result, (*common)[i]);
  return result;
}

Expression Compiler::select_call(const Token& name, const std::vector<Expression>& values) {
  const Expression which = converted(values[0], *type_of(Basic::boolean));
  const auto common = to_chosen({values[1], values[2]}, name);
  if (!common || which.unknown()) return {type_of(Basic::unknown), name.place};
  if (which.constant && (*common)[0].constant && (*common)[1].constant)
    return (*common)[which.value != 0 ? 1 : 0];
  Expression result{common->front().type, name.place};
  result.depth = std::max({which.depth, values[1].depth, values[2].depth}) + 1;
  const int condition = value_node(which);
  const int on = value_node((*common)[1]);
  result.node = add_node(Op::select, result.type->basic, name.place, condition, on, value_node((*common)[0]));
  return result;
}

Expression Compiler::multiplex_call(const Token& name, const std::vector<Expression>& values) {
  const auto common = to_chosen({values.begin() + 1, values.end()}, name);
  if (!common || values[0].unknown()) return {type_of(Basic::unknown), name.place};
  if (!is_integer(values[0].type->basic))
    give_up(values[0].place, fmt::format("MUX chooses by {}", values[0].type->name),
            "by a whole number, from 0");
  const auto count = static_cast<std::int64_t>(common->size());
  if (values[0].constant && (values[0].value < 0 || values[0].value >= count))
    give_up(values[0].place, fmt::format("MUX has no value {}", values[0].value),
            fmt::format("0 to {}", count - 1));
  Expression result{common->front().type, name.place};
  std::vector<int> nodes;
  for (const Expression& value : *common) {
    nodes.push_back(value_node(value));
    result.depth = std::max(result.depth, value.depth + 1);
  }
  const int which = value_node(values[0]);
  result.node = add_node(Op::multiplex, result.type->basic, name.place, which, add_list(nodes),
                         static_cast<int>(nodes.size()));
  return result;
}

Expression Compiler::conversion_call(Basic from, Basic to, const Token& name, bool truncates) {
  std::vector<Expression> values = plain_arguments(name, 1, 1);
  Expression& value = values[0];
  if (value.unknown()) return value;
  if (from != Basic::unknown) value = converted(value, *type_of(from));
  if (value.unknown()) return value;
  const Basic basic = value.type->basic;
  if (!is_elementary(basic) || (truncates && !is_real(basic))) {
    complain(value.place, fmt::format("{} does not take {}", upper(name.text), value.type->name),
             truncates ? "it takes REAL and LREAL" : "it takes numbers, BOOL and TIME");
    return {type_of(Basic::unknown), name.place};
  }
  value.untyped = false;
  Expression result =
      truncates ? apply_op(Op::truncate, type_of(to), name.place, value) : cast(value, to, name.place);
  // A conversion is a value, nothing to assign to.
  if (result.address) {
    result.node = value_node(result);
    result.address = false;
  }
  return result;
}

}  // namespace drycut::devices::plcopen::st
