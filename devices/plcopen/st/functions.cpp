#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// The standard functions of IEC 61131-3, operators as functions among them, and conversions.
namespace drycut::devices::plcopen::st {

/// Inputs by their names, second names of CODESYS behind '|'; more of them are IN`more`, IN`more + 1` ...
struct InputNames {
  std::array<std::string_view, 4> fixed{};
  int more = -1;
};

struct StandardFunction {
  enum class Kind : std::uint8_t {
    chain,    ///< `sign` between the inputs, from the left
    ordered,  ///< `sign` holds between each input and the next
    real,     ///< `op` of one or two real numbers
    number,   ///< ABS
    bits,     ///< `op` moves bits of the first by the second
    same,     ///< MOVE
    complement,
    smallest,
    largest,
    limit,
    select,
    multiplex,
    truncate,
    clock,
    text,   ///< `text` of texts, and numbers behind them
    moment  ///< CONCAT_DATE_TOD
  };
  std::string_view name;
  Kind kind = Kind::real;
  std::size_t least = 1;
  std::size_t most = 1;
  InputNames inputs{{"IN"}};
  std::string_view sign{};
  Op op = Op::nothing;
  Basic to = Basic::unknown;
  TextOp text = TextOp::left;
};

namespace {

using Kind = StandardFunction::Kind;
constexpr std::size_t many = 64;
constexpr InputNames pair_of{{"IN1", "IN2"}};
constexpr InputNames from_one{{}, 1};

constexpr StandardFunction chain(std::string_view name, std::string_view sign, std::size_t most = 2) {
  return {name, Kind::chain, 2, most, from_one, sign};
}
constexpr StandardFunction ordered(std::string_view name, std::string_view sign, std::size_t most = many) {
  return {name, Kind::ordered, 2, most, from_one, sign};
}
constexpr StandardFunction real(std::string_view name, Op op) {
  return {name, Kind::real, 1, 1, {{"IN"}}, {}, op};
}
constexpr StandardFunction shift(std::string_view name, Op op) {
  return {name, Kind::bits, 2, 2, {{"IN", "N"}}, {}, op};
}
constexpr StandardFunction texts(std::string_view name, std::size_t inputs, InputNames names, TextOp op) {
  return {name, Kind::text, inputs, inputs, names, {}, Op::nothing, Basic::unknown, op};
}

constexpr std::array functions{
    chain("ADD", "+", many),
    chain("SUB", "-"),
    chain("MUL", "*", many),
    chain("DIV", "/"),
    chain("MOD", "MOD"),
    chain("EXPT", "**"),
    chain("AND", "AND", many),
    chain("OR", "OR", many),
    chain("XOR", "XOR", many),
    chain("ADD_TIME", "+"),
    chain("ADD_TOD_TIME", "+"),
    chain("ADD_DT_TIME", "+"),
    chain("SUB_TIME", "-"),
    chain("SUB_DATE_DATE", "-"),
    chain("SUB_TOD_TIME", "-"),
    chain("SUB_TOD_TOD", "-"),
    chain("SUB_DT_TIME", "-"),
    chain("SUB_DT_DT", "-"),
    chain("MUL_TIME", "*"),
    chain("MULTIME", "*"),
    chain("DIV_TIME", "/"),
    chain("DIVTIME", "/"),
    ordered("GT", ">"),
    ordered("GE", ">="),
    ordered("EQ", "="),
    ordered("LE", "<="),
    ordered("LT", "<"),
    ordered("NE", "<>", 2),
    StandardFunction{"NOT", Kind::complement},
    StandardFunction{"MOVE", Kind::same},
    StandardFunction{"ABS", Kind::number},
    real("SQRT", Op::square_root),
    real("SIN", Op::sine),
    real("COS", Op::cosine),
    real("TAN", Op::tangent),
    real("ASIN", Op::arc_sine),
    real("ACOS", Op::arc_cosine),
    real("ATAN", Op::arc_tangent),
    StandardFunction{"ATAN2", Kind::real, 2, 2, {{"Y", "X"}}, {}, Op::arc_tangent_2},
    real("EXP", Op::exponential),
    real("LN", Op::logarithm),
    real("LOG", Op::logarithm_10),
    shift("SHL", Op::shift_left),
    shift("SHR", Op::shift_right),
    shift("ROL", Op::rotate_left),
    shift("ROR", Op::rotate_right),
    StandardFunction{"MIN", Kind::smallest, 2, many, from_one},
    StandardFunction{"MAX", Kind::largest, 2, many, from_one},
    StandardFunction{"LIMIT", Kind::limit, 3, 3, {{"MN|MIN", "IN", "MX|MAX"}}},
    StandardFunction{"SEL", Kind::select, 3, 3, {{"G", "IN0", "IN1"}}},
    StandardFunction{"MUX", Kind::multiplex, 3, many + 1, {{"K"}, 0}},
    StandardFunction{"TRUNC", Kind::truncate, 1, 1, {{"IN"}}, {}, Op::truncate, Basic::dint},
    StandardFunction{"TRUNC_INT", Kind::truncate, 1, 1, {{"IN"}}, {}, Op::truncate, Basic::int_},
    StandardFunction{"TIME", Kind::clock, 0, 0},
    texts("LEN", 1, {{"IN|STR"}}, TextOp::length),
    texts("LEFT", 2, {{"IN|STR", "L|SIZE"}}, TextOp::left),
    texts("RIGHT", 2, {{"IN|STR", "L|SIZE"}}, TextOp::right),
    texts("MID", 3, {{"IN|STR", "L|LEN", "P|POS"}}, TextOp::mid),
    StandardFunction{
        "CONCAT", Kind::text, 2, many, from_one, {}, Op::nothing, Basic::unknown, TextOp::concat},
    texts("INSERT", 3, {{"IN1|STR1", "IN2|STR2", "P|POS"}}, TextOp::insert),
    texts("DELETE", 3, {{"IN|STR", "L|LEN", "P|POS"}}, TextOp::erase),
    texts("REPLACE", 4, {{"IN1|STR1", "IN2|STR2", "L", "P"}}, TextOp::replace),
    texts("FIND", 2, {{"IN1|STR1", "IN2|STR2"}}, TextOp::find),
    StandardFunction{"CONCAT_DATE_TOD", Kind::moment, 2, 2, pair_of},
};

/// "REAL_TO_INT" or "TO_INT"; the first is unknown in the second.
std::optional<std::pair<Basic, Basic>> conversion(std::string_view name) {
  const std::string text = upper(name);
  const std::size_t at = text.starts_with("TO_") ? 0 : text.find("_TO_");
  if (at == std::string::npos) return std::nullopt;
  const auto convertible = [](const Type* type) {
    return type != nullptr && (is_elementary(type->basic) || type->basic == Basic::string);
  };
  const Type* from = at == 0 ? type_of(Basic::unknown) : elementary_type(text.substr(0, at));
  const Type* to = elementary_type(text.substr(at == 0 ? 3 : at + 4));
  if (!convertible(to) || (at != 0 && !convertible(from))) return std::nullopt;
  return std::pair{from->basic, to->basic};
}

/// Whether input `number` (from 0) may be called `name`.
bool is_called(const InputNames& inputs, std::size_t number, const Token& name) {
  std::size_t fixed = 0;
  while (fixed < inputs.fixed.size() && !inputs.fixed.at(fixed).empty()) ++fixed;
  if (number >= fixed) {
    if (inputs.more < 0) return false;
    const auto which = static_cast<std::size_t>(inputs.more) + number - fixed;
    return name.word(fmt::format("IN{}", which)) || name.word(fmt::format("STR{}", which));
  }
  const std::string_view names = inputs.fixed.at(number);
  const std::size_t bar = names.find('|');
  return name.word(names.substr(0, bar)) ||
         (bar != std::string_view::npos && name.word(names.substr(bar + 1)));
}

int deepest_of(const std::vector<Expression>& values) {
  int depth = 1;
  for (const Expression& value : values) depth = std::max(depth, value.depth + 1);
  return depth;
}

}  // namespace

Expression Compiler::function_call(const Token& name, const std::vector<Argument>& given,
                                   const Type* wanted) {
  if (Unit* unit = find_unit(name.text); unit != nullptr && unit->kind == Unit::Kind::function)
    return user_call(*unit, name, given);
  for (const StandardFunction& function : functions)
    if (name.word(function.name)) return standard_call(function, name, given, wanted);
  if (const auto types = conversion(name.text)) {
    const std::vector<const Tree*> input = in_order(name, given, StandardFunction{"", Kind::same});
    return conversion_call(types->first, types->second, name, typed(*input[0]));
  }
  for (const Argument& argument : given) typed(*argument.tree);
  const bool block = find_block_type(name.text) != nullptr || find_unit(name.text) != nullptr;
  const auto known = [&] {
    std::vector<std::string> names;
    for (const StandardFunction& function : functions) names.emplace_back(function.name);
    for (const auto& unit : units_)
      if (unit->kind == Unit::Kind::function) names.emplace_back(unit->name.text);
    for (const Variable& member : unit_->type != nullptr ? unit_->type->members : globals_->members)
      if (member.type->basic == Basic::block) names.push_back(member.name);
    return names;
  };
  if (told_.insert(lower(name.text)).second)
    complain(name.place, fmt::format("there is no function {}", in_quotes(name.text)),
             block ? "it is a kind of function block: declare an instance of it in VAR and call that"
                   : suggested(name.text, known, "declare FUNCTION " + std::string(name.text) + " : type"));
  return {type_of(Basic::unknown), name.place};
}

/// The inputs in the order of the function's.
std::vector<const Tree*> Compiler::in_order(const Token& name, const std::vector<Argument>& given,
                                            const StandardFunction& function) {
  std::vector<const Tree*> values;
  for (const Argument& argument : given) {
    std::size_t number = values.size();
    if (argument.name != nullptr)
      for (number = 0; number < function.most && !is_called(function.inputs, number, *argument.name);)
        ++number;
    if (argument.output || (argument.name != nullptr && number == function.most))
      give_up(argument.name->place,
              fmt::format("{} has no {} {}", upper(name.text), argument.output ? "output" : "input",
                          in_quotes(argument.name->text)),
              "give the values in their order, without names");
    if (number < values.size() && values[number] != nullptr)
      give_up(argument.name->place, fmt::format("{} is given twice", in_quotes(argument.name->text)),
              "once a call");
    if (number >= values.size()) values.resize(number + 1, nullptr);
    values[number] = argument.tree;
  }
  const auto count = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](const Tree* value) { return value != nullptr; }));
  if (count < function.least || count > function.most || count < values.size())
    give_up(name.place, fmt::format("{} has {} value{}", upper(name.text), count, count == 1 ? "" : "s"),
            function.least == function.most
                ? fmt::format("it takes {}", function.least)
                : fmt::format("it takes {} to {}", function.least, function.most));
  return values;
}

Expression Compiler::standard_call(const StandardFunction& function, const Token& name,
                                   const std::vector<Argument>& given, const Type* wanted) {
  std::vector<Expression> values;
  for (const Tree* tree : in_order(name, given, function)) values.push_back(typed(*tree, wanted));
  for (const Expression& value : values)
    if (value.unknown()) return {type_of(Basic::unknown), name.place};
  switch (function.kind) {
    case Kind::chain:
    case Kind::ordered:
      return operator_call(function, name, values, wanted);
    case Kind::real:
    case Kind::number:
      return number_call(function, name, std::move(values), wanted);
    case Kind::bits:
      return shift_call(function, name, std::move(values), wanted);
    case Kind::same:
      return values[0].constant || values[0].string ? values[0] : as_value(values[0]);
    case Kind::complement:
      return complement(name, values[0], wanted);
    case Kind::smallest:
    case Kind::largest:
      return minmax(name, values, function.kind == Kind::largest, wanted);
    case Kind::limit: {
      const auto common = to_common(values, name, wanted);
      if (!common) break;
      const Expression low = minmax(name, {(*common)[1], (*common)[0]}, true, wanted);
      return minmax(name, {low, (*common)[2]}, false, wanted);
    }
    case Kind::select:
      return select_call(name, values, wanted);
    case Kind::multiplex:
      return multiplex_call(name, values, wanted);
    case Kind::truncate:
      return truncated(function.to, name, values[0]);
    case Kind::clock: {
      Expression now{type_of(Basic::time), name.place};
      now.node = add_node(Op::time_now, Basic::time, name.place);
      return now;
    }
    case Kind::text:
      return text_call(function, name, values);
    case Kind::moment:
      return moment_call(name, values);
  }
  return {type_of(Basic::unknown), name.place};
}

Expression Compiler::operator_call(const StandardFunction& function, const Token& name,
                                   const std::vector<Expression>& values, const Type* wanted) {
  if (function.kind == Kind::chain) {
    Expression result = values[0];
    for (std::size_t i = 1; i < values.size(); ++i)
      result = binary(function.sign, name, std::move(result), values[i], wanted);
    return result;
  }
  Expression all = binary(function.sign, name, values[0], values[1], nullptr);
  for (std::size_t i = 2; i < values.size(); ++i)
    all = binary("AND", name, std::move(all), binary(function.sign, name, values[i - 1], values[i], nullptr),
                 nullptr);
  return all;
}

Expression Compiler::refused(const Token& name, const Expression& value, std::string wanted) {
  complain(value.place, fmt::format("{} does not take {}", upper(name.text), value.type->name),
           std::move(wanted));
  return {type_of(Basic::unknown), name.place};
}

Expression Compiler::shift_call(const StandardFunction& function, const Token& name,
                                std::vector<Expression> values, const Type* wanted) {
  values[0] = literal_for_bits(std::move(values[0]), wanted, name);
  if (values[0].unknown()) return values[0];
  if (!is_integer(values[0].type->basic)) return refused(name, values[0], "it takes whole numbers");
  if (!is_integer(values[1].type->basic))
    return refused(name, values[1], "the number of places is a whole number");
  return apply_op(function.op, values[0].type, name.place, values[0], values[1]);
}

Expression Compiler::number_call(const StandardFunction& function, const Token& name,
                                 std::vector<Expression> values, const Type* wanted) {
  for (const Expression& value : values)
    if (!is_number(value.type->basic)) return refused(name, value, "it takes numbers");
  if (function.kind == Kind::number)
    return apply_op(is_real(values[0].type->basic) ? Op::absolute_real : Op::absolute, values[0].type,
                    name.place, values[0]);
  const bool untyped = values[0].untyped && values.back().untyped;
  const Type* type = real_result(values[0], wanted);
  if (values.back().type->basic == Basic::lreal && !values.back().untyped) type = type_of(Basic::lreal);
  for (Expression& value : values) value = cast(value, type->basic, value.place);
  Expression result = values.size() == 1 ? apply_op(function.op, type, name.place, values[0])
                                         : apply_op(function.op, type, name.place, values[0], values[1]);
  result.untyped = untyped && result.constant;
  return result;
}

std::optional<std::vector<Expression>> Compiler::to_common(const std::vector<Expression>& values,
                                                           const Token& name, const Type* wanted) {
  Expression common = values.front();
  for (const Expression& value : values) {
    if (value.unknown()) return std::nullopt;
    const Type* type = common_type(common, value, wanted);
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
                                                           const Token& name, const Type* wanted) {
  const auto is_text = [](const Expression& value) { return value.type->basic == Basic::string; };
  if (std::all_of(values.begin(), values.end(), is_text)) return values;
  auto common = to_common(values, name, wanted);
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

Expression Compiler::minmax(const Token& name, const std::vector<Expression>& values, bool largest,
                            const Type* wanted) {
  const std::optional<std::vector<Expression>> common = to_common(values, name, wanted);
  if (!common) return {type_of(Basic::unknown), name.place};
  const Type* type = common->front().type;
  const bool real = is_real(type->basic);
  const Op op = largest ? (real ? Op::maximum_real : Op::maximum) : (real ? Op::minimum_real : Op::minimum);
  Expression result = common->front();
  for (std::size_t i = 1; i < common->size(); ++i)
    result = apply_op(op, type, name.place, result, (*common)[i]);
  return result;
}

Expression Compiler::select_call(const Token& name, const std::vector<Expression>& values,
                                 const Type* wanted) {
  const Expression which = converted(values[0], *type_of(Basic::boolean));
  const auto common = to_chosen({values[1], values[2]}, name, wanted);
  if (!common || which.unknown()) return {type_of(Basic::unknown), name.place};
  if (which.constant && (*common)[0].constant && (*common)[1].constant)
    return (*common)[which.value != 0 ? 1 : 0];
  Expression result{chosen_type(*common), name.place};
  result.depth = deepest_of(values);
  const int condition = value_node(which);
  const int on = value_node((*common)[1]);
  result.node = add_node(Op::select, result.type->basic, name.place, condition, on, value_node((*common)[0]));
  return result;
}

/// Of values that have one type, texts apart: they are of different lengths.
const Type* Compiler::chosen_type(const std::vector<Expression>& values) {
  const Type* type = base_of(values.front().type);
  return type->basic == Basic::string ? longest_string() : type;
}

Expression Compiler::multiplex_call(const Token& name, const std::vector<Expression>& values,
                                    const Type* wanted) {
  const auto common = to_chosen({values.begin() + 1, values.end()}, name, wanted);
  if (!common) return {type_of(Basic::unknown), name.place};
  if (!is_integer(values[0].type->basic))
    give_up(values[0].place, fmt::format("MUX chooses by {}", values[0].type->name),
            "by a whole number, from 0");
  const auto count = static_cast<std::int64_t>(common->size());
  if (values[0].constant && (values[0].value < 0 || values[0].value >= count))
    give_up(values[0].place, fmt::format("MUX has no value {}", values[0].value),
            fmt::format("0 to {}", count - 1));
  Expression result{chosen_type(*common), name.place};
  std::vector<int> nodes;
  for (const Expression& value : *common) nodes.push_back(value_node(value));
  result.depth = deepest_of(values);
  const int which = value_node(values[0]);
  result.node = add_node(Op::multiplex, result.type->basic, name.place, which, add_list(nodes),
                         static_cast<int>(nodes.size()));
  return result;
}

Expression Compiler::text_call(const StandardFunction& function, const Token& name,
                               const std::vector<Expression>& values) {
  // How many texts stand before the numbers.
  const std::size_t texts =
      function.text == TextOp::concat ? values.size()
      : function.text == TextOp::insert || function.text == TextOp::replace || function.text == TextOp::find
          ? 2
          : 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool text = values[i].type->basic == Basic::string;
    if (i < texts && !text) return refused(name, values[i], "it takes a STRING: X_TO_STRING(...) makes one");
    if (i >= texts && !is_integer(values[i].type->basic))
      return refused(name, values[i], "lengths and places are whole numbers, from 1");
  }
  return text_value(function.text, type_of(Basic::int_), name, values);
}

/// A node of TextOp `op`; texts get a place of their own for each call in the text.
Expression Compiler::text_value(TextOp op, const Type* number, const Token& name,
                                const std::vector<Expression>& values) {
  const bool text = op < TextOp::length;
  Expression result{text ? longest_string() : number, name.place};
  result.depth = deepest_of(values);
  std::vector<int> nodes;
  if (text)
    nodes.push_back(
        add_node(Op::address_pool, Basic::string, name.place, -1, -1, -1, scratch(longest_string()->cells)));
  for (const Expression& value : values) nodes.push_back(value_node(value));
  const Basic basic = op == TextOp::from_value ? values[0].type->basic : result.type->basic;
  const int first = add_list(nodes);
  result.node = add_node(Op::text, basic, name.place, first, static_cast<int>(nodes.size()), -1,
                         static_cast<std::int64_t>(op));
  return result;
}

Expression Compiler::moment_call(const Token& name, const std::vector<Expression>& values) {
  if (values[0].type->basic != Basic::date) return refused(name, values[0], "a DATE and a TOD make a DT");
  if (values[1].type->basic != Basic::tod) return refused(name, values[1], "a DATE and a TOD make a DT");
  const Type* dt = type_of(Basic::dt);
  const Expression seconds =
      apply_op(Op::divide, dt, name.place, values[1], constant(type_of(Basic::dint), 1000, name.place));
  return apply_op(Op::add, dt, name.place, values[0], seconds);
}

Expression Compiler::truncated(Basic to, const Token& name, const Expression& value) {
  if (!is_real(value.type->basic)) return refused(name, value, "it takes REAL and LREAL");
  Expression result = apply_op(Op::truncate, type_of(to), name.place, value);
  result.untyped = false;
  return result;
}

Expression Compiler::conversion_call(Basic from, Basic to, const Token& name, Expression value) {
  if (value.unknown()) return value;
  if (from != Basic::unknown) value = converted(std::move(value), *type_of(from));
  if (value.unknown()) return value;
  const Basic basic = value.type->basic;
  const bool text = basic == Basic::string;
  const auto clock = [](Basic one) { return is_clock(one) && one != Basic::time; };
  // Between dates only what a part of the other is.
  const bool apart = clock(basic) && clock(to) && basic != to && basic != Basic::dt &&
                     !(basic == Basic::date && to == Basic::dt);
  const bool mixed = (basic == Basic::time && per_second(to) == 1 && clock(to)) ||
                     (to == Basic::time && clock(basic) && per_second(basic) == 1);
  if ((!text && !is_elementary(basic)) || apart || mixed)
    return refused(name, value, "it takes numbers, BOOL, TIME and STRING");
  if (value.untyped && (basic == Basic::lint || basic == Basic::ulint || basic == Basic::lreal))
    value.untyped = false;
  if (to == Basic::string) return text ? value : text_value(TextOp::from_value, nullptr, name, {value});
  if (text) return text_value(TextOp::to_value, type_of(to), name, {value});
  Expression result = cast(value, to, name.place);
  // A conversion is a value, nothing to assign to.
  return result.address ? as_value(std::move(result)) : result;
}

}  // namespace drycut::devices::plcopen::st
