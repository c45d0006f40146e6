#include "devices/plcopen/st/values.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace drycut::devices::plcopen::st {
namespace {

/// Inputs by their names, second names of CODESYS behind '|'; more of them are IN`more`, IN`more + 1` ...
struct InputNames {
  std::array<std::string_view, 4> fixed{};
  int more = -1;
};

struct StandardCall;
struct StandardFunction {
  std::string_view name;
  TypedExpression (StandardCall::*meaning)() = nullptr;
  std::size_t least = 1;  ///< number of inputs
  std::size_t most = 1;
  InputNames inputs{{"IN"}};
  std::string_view sign{};  ///< of an operator
  StOp op = StOp::nothing;
  Basic to = Basic::unknown;
  TextOp text = TextOp::left;
};

/// A call of a standard function: its inputs in their order, none of them unknown.
struct StandardCall {
  Values& values;
  const StandardFunction& function;
  const StToken& name;
  std::vector<TypedExpression> inputs;
  const Type* wanted;

  [[nodiscard]] Place place() const { return name.place; }
  [[nodiscard]] Basic basic(std::size_t input) const { return inputs[input].type->basic; }

  TypedExpression refused(const TypedExpression& value, std::string takes) {
    return values.refuse("st.type"_code, value.place,
                         fmt::format("{} does not take {}", upper(name.text), value.type->name),
                         std::move(takes), place());
  }

  /// The sign between the inputs, from the left.
  TypedExpression chain() {
    TypedExpression result = inputs[0];
    for (std::size_t i = 1; i < inputs.size(); ++i)
      result = binary(values, function.sign, name, std::move(result), inputs[i], wanted);
    return result;
  }

  /// The sign holds between each input and the next.
  TypedExpression ordered() {
    const auto holds = [&](std::size_t i) {
      return binary(values, function.sign, name, inputs[i - 1], inputs[i], nullptr);
    };
    TypedExpression all = holds(1);
    for (std::size_t i = 2; i < inputs.size(); ++i)
      all = binary(values, "AND", name, std::move(all), holds(i), nullptr);
    return all;
  }

  /// MOVE.
  TypedExpression same() {
    return inputs[0].constant || inputs[0].string ? inputs[0] : values.as_value(inputs[0]);
  }

  TypedExpression complemented() { return complement(values, name, inputs[0], wanted); }

  /// Bits of the first moved by the second.
  TypedExpression shift() {
    const TypedExpression bits = literal_for_bits(values, inputs[0], wanted, name);
    if (bits.unknown()) return bits;
    if (!is_integer(bits.type->basic)) return refused(bits, "it takes whole numbers");
    if (!is_integer(basic(1))) return refused(inputs[1], "the number of places is a whole number");
    return values.apply_op(function.op, bits.type, place(), bits, inputs[1]);
  }

  [[nodiscard]] const TypedExpression* no_number() const {
    const auto found = std::find_if(inputs.begin(), inputs.end(), [](const TypedExpression& value) {
      return !is_number(value.type->basic);
    });
    return found == inputs.end() ? nullptr : &*found;
  }

  TypedExpression absolute() {
    if (no_number() != nullptr) return refused(*no_number(), "it takes numbers");
    return values.apply_op(is_real(basic(0)) ? StOp::absolute_real : StOp::absolute, inputs[0].type, place(),
                           inputs[0]);
  }

  /// Of one or two real numbers.
  TypedExpression real() {
    if (no_number() != nullptr) return refused(*no_number(), "it takes numbers");
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

  using Inputs = std::vector<TypedExpression>;

  /// As values of one type; nothing, and told, if there is none.
  std::optional<Inputs> to_common(const Inputs& given) {
    TypedExpression common = given.front();
    for (const TypedExpression& value : given) {
      if (value.unknown()) return std::nullopt;
      const Type* type = common_type(common, value, wanted);
      if (type == nullptr || !is_elementary(type->basic)) {
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

  /// Likewise of what a program chooses among: texts too.
  std::optional<Inputs> to_chosen(const Inputs& given) {
    const auto is_text = [](const TypedExpression& value) { return value.type->basic == Basic::string; };
    if (std::all_of(given.begin(), given.end(), is_text)) return given;
    auto common = to_common(given);
    if (!common || !common->front().untyped || is_real(common->front().type->basic)) return common;
    if (wanted != nullptr && is_integer(wanted->basic)) {
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

  TypedExpression extreme(const Inputs& given, StOp whole, StOp real) {
    const auto common = to_common(given);
    if (!common) return unknown_at(place());
    const Type* type = common->front().type;
    TypedExpression result = common->front();
    for (std::size_t i = 1; i < common->size(); ++i)
      result = values.apply_op(is_real(type->basic) ? real : whole, type, place(), result, (*common)[i]);
    return result;
  }
  TypedExpression smallest_of(const Inputs& given) {
    return extreme(given, StOp::minimum, StOp::minimum_real);
  }
  TypedExpression largest_of(const Inputs& given) {
    return extreme(given, StOp::maximum, StOp::maximum_real);
  }
  TypedExpression smallest() { return smallest_of(inputs); }
  TypedExpression largest() { return largest_of(inputs); }

  TypedExpression limit() {
    const auto common = to_common(inputs);
    if (!common) return unknown_at(place());
    return smallest_of({largest_of({(*common)[1], (*common)[0]}), (*common)[2]});
  }

  /// The type of values of one type; of texts, which are of different lengths, the longest.
  [[nodiscard]] const Type* chosen_type(const Inputs& given) const {
    const Type* type = base_of(given.front().type);
    return type->basic == Basic::string ? values.longest_string(type->wide) : type;
  }

  TypedExpression select() {
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

  TypedExpression multiplex() {
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

  std::vector<int> nodes_of(const Inputs& given) {
    std::vector<int> nodes;
    for (const TypedExpression& value : given) nodes.push_back(values.value_node(value));
    return nodes;
  }

  /// Texts, and numbers behind them.
  TypedExpression text() {
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

  /// A node of TextOp `op`; texts get a place of their own for each call in the text.
  TypedExpression text_value(TextOp op, const Type* number, bool wide_result = false) {
    const bool text = op < TextOp::length;
    const bool wide = wide_result || inputs[0].type->wide;
    const Type* type = text ? values.longest_string(wide) : number;
    std::vector<int> nodes;
    if (text) nodes.push_back(values.scratch(*type, place()));
    for (const int node : nodes_of(inputs)) nodes.push_back(node);
    const Basic of = op == TextOp::from_value ? basic(0) : type->basic;
    const int list = values.add_list(nodes);
    return {type, place(),
            values.add_node(StOp::text, of, place(), list, static_cast<int>(nodes.size()), wide ? 1 : -1,
                            static_cast<std::int64_t>(op)),
            depth_over(inputs)};
  }

  /// CONCAT_DATE_TOD.
  TypedExpression moment() {
    if (basic(0) != Basic::date) return refused(inputs[0], "a DATE and a TOD make a DT");
    if (basic(1) != Basic::tod) return refused(inputs[1], "a DATE and a TOD make a DT");
    const Type* dt = type_of(Basic::dt);
    const TypedExpression ms_per_second = constant(type_of(Basic::dint), 1000, place());
    return values.apply_op(StOp::add, dt, place(), inputs[0],
                           values.apply_op(StOp::divide, dt, place(), inputs[1], ms_per_second));
  }

  TypedExpression truncated() {
    if (!is_real(basic(0))) return refused(inputs[0], "it takes REAL and LREAL");
    // TRUNC gives what the context wants.
    const bool open = function.to == Basic::dint && wanted != nullptr && is_integer(wanted->basic);
    TypedExpression result =
        values.apply_op(function.op, open ? base_of(wanted) : type_of(function.to), place(), inputs[0]);
    result.untyped = false;
    return result;
  }

  /// TIME().
  TypedExpression clock() {
    return {type_of(Basic::time), place(), values.add_node(StOp::time_now, Basic::time, place())};
  }

  /// X_TO_Y.
  TypedExpression converted(const Type& target) {
    const Basic to = target.basic;
    TypedExpression& value = inputs[0];
    const Basic from = basic(0);
    const bool text = from == Basic::string;
    const auto clock = [](Basic one) { return is_clock(one) && one != Basic::time; };
    // Between dates only what a part of the other is.
    const bool apart = clock(from) && clock(to) && from != to && from != Basic::dt &&
                       !(from == Basic::date && to == Basic::dt);
    const bool mixed = (from == Basic::time && per_second(to) == 1 && clock(to)) ||
                       (to == Basic::time && clock(from) && per_second(from) == 1);
    if ((!text && !is_elementary(from)) || apart || mixed)
      return refused(value, "it takes numbers, BOOL, TIME and STRING");
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
};

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
    StandardFunction{"TIME", &Call::clock, 0, 0},
    texts("LEN", 1, 1, {{"IN|STR"}}, TextOp::length),
    texts("LEFT", 2, 2, {{"IN|STR", "L|SIZE"}}, TextOp::left),
    texts("RIGHT", 2, 2, {{"IN|STR", "L|SIZE"}}, TextOp::right),
    texts("MID", 3, 3, {{"IN|STR", "L|LEN", "P|POS"}}, TextOp::mid),
    texts("CONCAT", 2, many, from_one, TextOp::concat),
    texts("INSERT", 3, 3, {{"IN1|STR1", "IN2|STR2", "P|POS"}}, TextOp::insert),
    texts("DELETE", 3, 3, {{"IN|STR", "L|LEN", "P|POS"}}, TextOp::erase),
    texts("REPLACE", 4, 4, {{"IN1|STR1", "IN2|STR2", "L", "P"}}, TextOp::replace),
    texts("FIND", 2, 2, {{"IN1|STR1", "IN2|STR2"}}, TextOp::find),
    StandardFunction{"CONCAT_DATE_TOD", &Call::moment, 2, 2, pair_of},
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
std::optional<std::pair<const Type*, const Type*>> conversion(std::string_view name) {
  const std::string text = upper(name);
  const std::size_t at = text.starts_with("TO_") ? 0 : text.find("_TO_");
  if (at == std::string::npos) return std::nullopt;
  const auto convertible = [](const Type* type) {
    return type != nullptr && (is_elementary(type->basic) || type->basic == Basic::string);
  };
  const Type* from = at == 0 ? type_of(Basic::unknown) : elementary_type(text.substr(0, at));
  const Type* to = elementary_type(text.substr(at == 0 ? 3 : at + 4));
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
  const auto types = conversion(name.text);
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
