#include "devices/plcopen/st/standard_call.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace drycut::devices::plcopen::st {
namespace {

using Call = StandardCall;
constexpr std::size_t many = 64;
constexpr InputNames pair_of{{"IN1", "IN2"}};
constexpr InputNames from_one{{}, 1};

constexpr StandardFunction chain(std::string_view name, std::string_view sign, std::size_t most = 2) {
  return {name, &Call::chain, 2, most, from_one, sign};
}
constexpr StandardFunction ordered(std::string_view name, std::string_view sign, std::size_t most = many) {
  return {name, &Call::ordered, 2, most, from_one, sign};
}
constexpr StandardFunction real(std::string_view name, StOp op) {
  return {name, &Call::real, 1, 1, {{"IN"}}, {}, op};
}
constexpr StandardFunction shift(std::string_view name, StOp op) {
  return {name, &Call::shift, 2, 2, {{"IN", "N"}}, {}, op};
}
constexpr StandardFunction texts(std::string_view name, std::size_t least, std::size_t most, InputNames names,
                                 TextOp op) {
  return {name, &Call::text, least, most, names, {}, StOp::nothing, Basic::unknown, op};
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
    chain("ADD_LTIME", "+"),
    chain("ADD_LTOD_LTIME", "+"),
    chain("ADD_LDT_LTIME", "+"),
    chain("SUB_LTIME", "-"),
    chain("SUB_LDATE_LDATE", "-"),
    chain("SUB_LTOD_LTIME", "-"),
    chain("SUB_LTOD_LTOD", "-"),
    chain("SUB_LDT_LTIME", "-"),
    chain("SUB_LDT_LDT", "-"),
    chain("MUL_LTIME", "*"),
    chain("DIV_LTIME", "/"),
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
    StandardFunction{"NOT", &Call::complemented},
    StandardFunction{"MOVE", &Call::same},
    StandardFunction{"ABS", &Call::absolute},
    real("SQRT", StOp::square_root),
    real("SIN", StOp::sine),
    real("COS", StOp::cosine),
    real("TAN", StOp::tangent),
    real("ASIN", StOp::arc_sine),
    real("ACOS", StOp::arc_cosine),
    real("ATAN", StOp::arc_tangent),
    StandardFunction{"ATAN2", &Call::real, 2, 2, {{"Y", "X"}}, {}, StOp::arc_tangent_2},
    real("EXP", StOp::exponential),
    real("LN", StOp::logarithm),
    real("LOG", StOp::logarithm_10),
    shift("SHL", StOp::shift_left),
    shift("SHR", StOp::shift_right),
    shift("ROL", StOp::rotate_left),
    shift("ROR", StOp::rotate_right),
    StandardFunction{"MIN", &Call::smallest, 2, many, from_one},
    StandardFunction{"MAX", &Call::largest, 2, many, from_one},
    StandardFunction{"LIMIT", &Call::limit, 3, 3, {{"MN|MIN", "IN", "MX|MAX"}}},
    StandardFunction{"SEL", &Call::select, 3, 3, {{"G", "IN0", "IN1"}}},
    StandardFunction{"MUX", &Call::multiplex, 3, many + 1, {{"K"}, 0}},
    StandardFunction{"TRUNC", &Call::truncated, 1, 1, {{"IN"}}, {}, StOp::truncate, Basic::dint},
    StandardFunction{"TRUNC_INT", &Call::truncated, 1, 1, {{"IN"}}, {}, StOp::truncate, Basic::int_},
    StandardFunction{"FLOOR", &Call::truncated, 1, 1, {{"IN"}}, {}, StOp::floor, Basic::dint},
    StandardFunction{"CEIL", &Call::truncated, 1, 1, {{"IN"}}, {}, StOp::ceiling, Basic::dint},
    StandardFunction{"IS_VALID", &Call::valid, 1, 1, {{"IN"}}, {}, StOp::valid_real},
    StandardFunction{"IS_VALID_BCD", &Call::valid, 1, 1, {{"IN"}}, {}, StOp::valid_bcd},
    StandardFunction{"TO_BIG_ENDIAN", &Call::in_byte_order, 1, 1, {{"IN"}}, {}, StOp::swap_bytes},
    StandardFunction{"FROM_BIG_ENDIAN", &Call::in_byte_order, 1, 1, {{"IN"}}, {}, StOp::swap_bytes},
    StandardFunction{"TO_LITTLE_ENDIAN", &Call::in_byte_order},
    StandardFunction{"FROM_LITTLE_ENDIAN", &Call::in_byte_order},
    StandardFunction{"TIME", &Call::clock, 0, 0, {}, {}, StOp::nothing, Basic::time},
    StandardFunction{"LTIME", &Call::clock, 0, 0, {}, {}, StOp::nothing, Basic::ltime},
    texts("LEN", 1, 1, {{"IN|STR"}}, TextOp::length),
    texts("LEFT", 2, 2, {{"IN|STR", "L|SIZE"}}, TextOp::left),
    texts("RIGHT", 2, 2, {{"IN|STR", "L|SIZE"}}, TextOp::right),
    texts("MID", 3, 3, {{"IN|STR", "L|LEN", "P|POS"}}, TextOp::mid),
    texts("CONCAT", 2, many, from_one, TextOp::concat),
    texts("INSERT", 3, 3, {{"IN1|STR1", "IN2|STR2", "P|POS"}}, TextOp::insert),
    texts("DELETE", 3, 3, {{"IN|STR", "L|LEN", "P|POS"}}, TextOp::erase),
    texts("REPLACE", 4, 4, {{"IN1|STR1", "IN2|STR2", "L", "P"}}, TextOp::replace),
    texts("FIND", 2, 2, {{"IN1|STR1", "IN2|STR2"}}, TextOp::find),
    StandardFunction{"CONCAT_DATE_TOD", &Call::moment, 2, 2, pair_of, {}, StOp::nothing, Basic::dt},
    StandardFunction{"CONCAT_DATE_LTOD", &Call::moment, 2, 2, pair_of, {}, StOp::nothing, Basic::ldt},
};

/// Whether input `number` (from 0) may be called `name`.
bool is_called(const InputNames& inputs, std::size_t number, const StToken& name) {
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

/// The inputs in the order of the function's; gives up what does not fit.
std::vector<const Tree*> in_order(Values& values, const StToken& name, const std::vector<Argument>& given,
                                  const StandardFunction& function) {
  std::vector<const Tree*> trees;
  for (const Argument& argument : given) {
    std::size_t number = trees.size();
    if (argument.name != nullptr)
      for (number = 0; number < function.most && !is_called(function.inputs, number, *argument.name);)
        ++number;
    if (argument.output || (argument.name != nullptr && number == function.most))
      values.give_up("st.unknown-name"_code, argument.name->place,
                     fmt::format("{} has no {} {}", upper(name.text), argument.output ? "output" : "input",
                                 in_quotes(argument.name->text)),
                     "give the values in their order, without names");
    if (number < trees.size() && trees[number] != nullptr)
      values.give_up("st.declared-twice"_code, argument.name->place,
                     fmt::format("{} is given twice", in_quotes(argument.name->text)), "once a call");
    if (number >= trees.size()) trees.resize(number + 1, nullptr);
    trees[number] = argument.tree;
  }
  const auto count = static_cast<std::size_t>(
      std::count_if(trees.begin(), trees.end(), [](const Tree* tree) { return tree != nullptr; }));
  if (count < function.least || count > function.most || count < trees.size())
    values.give_up("st.call"_code, name.place,
                   fmt::format("{} has {} value{}", upper(name.text), count, count == 1 ? "" : "s"),
                   function.least == function.most
                       ? fmt::format("it takes {}", function.least)
                       : fmt::format("it takes {} to {}", function.least, function.most));
  return trees;
}

/// "REAL_TO_INT" or "TO_INT"; the first is unknown in the second.
std::optional<std::pair<const Type*, const Type*>> conversion(const Values& values, std::string_view name) {
  const std::string text = upper(name);
  const std::size_t at = text.starts_with("TO_") ? 0 : text.find("_TO_");
  if (at == std::string::npos) return std::nullopt;
  const auto convertible = [](const Type* type) {
    return type != nullptr && (is_elementary(type->basic) || type->basic == Basic::string);
  };
  const Type* from = at == 0 ? type_of(Basic::unknown) : values.type_named(text.substr(0, at));
  const Type* to = values.type_named(text.substr(at == 0 ? 3 : at + 4));
  if (!convertible(to) || (at != 0 && !convertible(from))) return std::nullopt;
  return std::pair{from, to};
}

}  // namespace

std::vector<std::string> standard_function_names() { return names_of(functions); }

std::optional<TypedExpression> standard_call(Values& values, const StToken& name,
                                             const std::vector<Argument>& given, const Type* wanted,
                                             const Typed& typed) {
  for (const StandardFunction& function : functions) {
    if (!name.word(function.name)) continue;
    Call call{values, function, name, {}, wanted};
    for (const Tree* tree : in_order(values, name, given, function))
      call.inputs.push_back(typed(*tree, wanted));
    for (const TypedExpression& input : call.inputs)
      if (input.unknown()) return unknown_at(name.place);
    return (call.*function.meaning)();
  }
  const auto types = conversion(values, name.text);
  if (!types) return std::nullopt;
  const auto [from, to] = *types;
  constexpr StandardFunction one_input{"", &Call::same};
  const Type* const inner = is_integer(from->basic) ? from : nullptr;  // BYTE of BYTE_TO_INT(TRUNC(x))
  TypedExpression value = typed(*in_order(values, name, given, one_input).front(), inner);
  if (!value.unknown() && from->basic != Basic::unknown) value = values.converted(std::move(value), *from);
  if (value.unknown()) return value;
  return Call{values, one_input, name, {std::move(value)}, nullptr}.converted(*to);
}

}  // namespace drycut::devices::plcopen::st
