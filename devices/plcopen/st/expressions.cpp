#include "devices/plcopen/st/compiler.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/lexer.hpp"
#include "devices/plcopen/st/values.hpp"

// What the tree of an expression means: its literals, its names and their members.
namespace drycut::devices::plcopen::st {
namespace {

std::optional<TypedExpression> predefined(const StToken& name) {
  for (const StartModeRow& row : start_mode_table)
    if (name.word(row.name)) return constant(type_of(Basic::dword), row.bit, name.place, false);
  for (const NamedNumber& named : named_numbers)
    if (name.word(named.name)) return constant(type_of(Basic::lint), named.number, name.place, true);
  return std::nullopt;
}

TypedExpression variable_of(const Variable& variable, int node, const std::string& name, Place place) {
  const bool known = variable.constant && variable.value;
  TypedExpression result =
      known ? constant(variable.type, *variable.value, place) : variable_at(variable.type, node, name, place);
  result.name = name;
  if (variable.constant)
    result.locked = "is a constant";
  else if (variable.reads_terminal)
    result.locked = "is an input terminal";
  return result;
}

}  // namespace

TypedExpression Expressions::typed(const Tree& tree, const Type* wanted) {
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
    case Tree::Kind::dereference:
      return dereferenced(tree);
    case Tree::Kind::call:
      return call(tree, wanted);
    case Tree::Kind::sign:
      return signed_tree(tree, wanted);
    case Tree::Kind::chain:
      return chain(tree, std::nullopt, wanted);
    case Tree::Kind::address:
      return direct_place(*tree.token);
    case Tree::Kind::parenthesised: {
      TypedExpression inner = typed(tree.parts[0], wanted);
      // (x) is a value, nothing to assign to.
      if (inner.address && is_elementary(inner.type->basic)) inner = as_value(std::move(inner));
      return inner;
    }
  }
  return unknown_at(tree.token->place);
}

/// Signs of one precedence, from the left; `first` stands for the first part if it is given.
TypedExpression Expressions::chain(const Tree& tree, std::optional<TypedExpression> first,
                                   const Type* wanted) {
  TypedExpression result = first ? std::move(*first) : typed(tree.parts[0], wanted);
  for (std::size_t i = 0; i < tree.tokens.size(); ++i) {
    const StToken& sign = *tree.tokens[i];
    // A name of two enumerations is one of the other side's.
    const Type* const other = result.type->basic == Basic::enumeration ? result.type : wanted;
    const bool both = sign.word("AND") || sign.word("OR") || sign.is("&");
    std::optional<Nested> right_side;
    if (both) right_side.emplace(right_sides_);
    TypedExpression right = typed(tree.parts[i + 1], other);
    result = binary(*this, sign.text, sign, std::move(result), std::move(right), wanted);
  }
  return result;
}

/// -a, +a, NOT a; -a ** b is read in two ways.
TypedExpression Expressions::signed_tree(const Tree& tree, const Type* wanted) {
  const Tree& of = tree.parts[0];
  if (tree.token->is("-") && of.kind == Tree::Kind::chain && of.tokens[0]->is("**")) {
    // Odd powers are the same in both.
    const auto odd = [](const Tree& part) {
      return part.kind == Tree::Kind::literal && part.token->whole() && part.token->value % 2 != 0;
    };
    if (!std::all_of(of.parts.begin() + 1, of.parts.end(), odd) &&
        is_iec(DialectDifference::negated_power, tree.token->place))
      return chain(of, signed_value(*this, *tree.token, typed(of.parts[0], wanted), wanted), wanted);
  }
  return signed_value(*this, *tree.token, typed(of, wanted), wanted);
}

TypedExpression Expressions::literal(const StToken& token) {
  if (token.kind == StToken::Kind::number) {
    const Type* type = token.basic == Basic::time ? time_type() : type_of(token.basic);
    if (token.basic == Basic::time && wrapped(type->basic, token.value) != token.value)
      return refuse("st.out-of-range"_code, token.place,
                    fmt::format("{} is out of the range of TIME", in_quotes(token.text)),
                    type->basic == Basic::time ? "a TIME is below 0 under controller.plcopen.dialect: iec"
                                               : "it goes from T#-24d20h31m23s648ms to T#24d20h31m23s647ms");
    return constant(type, token.value, token.place, is_number(token.basic));
  }
  TypedExpression text{elementary_type(token.wide ? "WSTRING" : "STRING"), token.place,
                       literal_string(token.string, token.place)};
  text.string = token.string;
  return text;
}

Unit* Expressions::find_unit(std::string_view name) const {
  const auto found = unit_index_.find(lower(name));
  return found == unit_index_.end() ? nullptr : found->second;
}

std::vector<std::string> Expressions::known_names() const {
  std::vector<std::string> names;
  if (unit_ != nullptr && unit_->type != nullptr) names = names_of(unit_->type->members);
  for (const Variable& global : globals_->members) names.push_back(global.name);
  for (const auto& [name, value] : enum_values_)
    for (const EnumValue& known : value.first->values)
      if (same_word(known.name, name)) names.push_back(known.name);
  for (const StartModeRow& row : start_mode_table) names.emplace_back(row.name);
  for (const NamedNumber& named : named_numbers) names.emplace_back(named.name);
  for (const auto& unit : units_)
    if (unit->kind == Unit::Kind::function) names.emplace_back(unit->name.text);
  return names;
}

/// A constant may be needed before its section has been read.
const Variable* Expressions::find_global(std::string_view name) {
  if (const Variable* found = find_member(*globals_, name)) return found;
  const auto section = global_sections_.find(lower(name));
  if (section == global_sections_.end() || section->second->state != Unit::State::untouched) return nullptr;
  declare(*section->second);
  return find_member(*globals_, name);
}

std::optional<TypedExpression> Expressions::variable(const StToken& name) {
  const Variable* found = unit_->type == nullptr ? nullptr : find_member(*unit_->type, name.text);
  if (found != nullptr && !unit_->edges.empty())
    if (const auto* edge = find_member(*unit_->type, fmt::format("{}{}", name.text, edge_mark))) found = edge;
  // A method sees the variables of its block behind its own.
  const bool of_unit = found != nullptr;
  if (found == nullptr && unit_->owner != nullptr && unit_->owner->type != nullptr)
    found = find_member(*unit_->owner->type, name.text);
  const bool own = found != nullptr && unit_->type != globals_;
  if (found == nullptr)
    if (auto later = later_constant(name)) return later;
  if (found == nullptr) found = find_global(name.text);
  if (found == nullptr) return std::nullopt;
  const Basic basic = found->type->basic;
  const bool function = unit_->framed() && of_unit;
  const int frame = own && function ? pou(*unit_).frame : 0;
  int node = leaf_node(own && !function ? StOp::address_own : StOp::address, basic, name.place,
                       frame + found->offset);
  const bool open = found->type->open > 0;
  if (found->section == VarClass::in_out || open) node = add_node(StOp::follow, basic, name.place, node);
  TypedExpression result = variable_of(*found, node, found->name, name.place);
  if (open) {
    const Type& owner = of_unit ? *unit_->type : *unit_->owner->type;
    know_bounds(result, owner, [&](int offset) {
      return leaf_node(own && !function ? StOp::address_own : StOp::address, Basic::lint, name.place,
                       frame + offset);
    });
    if (found->section == VarClass::input) result.locked = "is an input without a copy of its own";
  }
  // A FUNCTION's inputs are its own; a block's are kept for the next call.
  result.own_input = own && found->section == VarClass::input && !function;
  return result;
}

TypedExpression Expressions::name_expression(const StToken& name, const Type* wanted) {
  if (name.word("TRUE") || name.word("FALSE"))
    return constant(type_of(Basic::boolean), name.word("TRUE") ? 1 : 0, name.place);
  if (std::optional<TypedExpression> found = variable(name)) return *found;
  if (name.word("THIS") && block_unit() != nullptr) return this_instance(name.place);
  const Tree getter{Tree::Kind::name, &name, false, {}, {}, {}};
  if (const Method method = method_of(getter, get_mark); method.unit != nullptr)
    return method_call(method, {});
  if (std::optional<TypedExpression> found = enum_value(name, wanted)) return *found;
  if (std::optional<TypedExpression> found = predefined(name)) return *found;
  if (name.word("SUPER"))
    give_up("st.use"_code, name.place, "there is no SUPER here", "it is what a block EXTENDS");
  if (name.word("NULL")) return constant(null_reference(), 0, name.place);
  // Told once a POU; what hangs on it is passed over.
  if (told_.insert(lower(name.text)).second) {
    if (unit_->procedure && same_word(unit_->name.text, name.text))
      return refuse("st.use"_code, name.place, fmt::format("{} has no result", in_quotes(name.text)),
                    fmt::format("give it one where it is declared: {} : INT", name.text));
    if (const Unit* unit = find_unit(name.text); unit != nullptr && unit->kind == Unit::Kind::function)
      return refuse("st.unknown-name"_code, name.place,
                    fmt::format("{} is no variable", in_quotes(name.text)),
                    fmt::format("it is a FUNCTION: {}(...) calls it", name.text));
    const bool type = find_unit(name.text) != nullptr || elementary_type(name.text) != nullptr ||
                      find_block_type(name.text) != nullptr;
    complain("st.unknown-name"_code, name.place,
             fmt::format("{} is {}", in_quotes(name.text), type ? "no variable" : "not declared"),
             suggested(
                 name.text, [&] { return known_names(); },
                 type ? "declare an instance of it in VAR" : "declare it in VAR ... END_VAR"));
  }
  return unknown_at(name.place);
}

const Type* Expressions::enumeration(std::string_view name) {
  // A constant may be needed before its type has been read.
  Unit* const unit = find_unit(name);
  constexpr int deepest = 100;
  if (unit != nullptr && unit->kind == Unit::Kind::type && open_units_ <= deepest) declare(*unit);
  const auto found = enumerations_.find(lower(name));
  return found == enumerations_.end() ? nullptr : found->second;
}

TypedExpression Expressions::qualified_enum(const Type& type, const StToken& name) {
  for (const EnumValue& value : type.values)
    if (name.word(value.name)) return constant(&type, value.value, name.place);
  const std::vector<std::string> names = names_of(type.values);
  return refuse("st.unknown-name"_code, name.place,
                fmt::format("{} has no value {}", type.name, in_quotes(name.text)),
                suggestion(name.text, names, "it has " + listed(names)));
}

std::optional<TypedExpression> Expressions::enum_value(const StToken& name, const Type* wanted) {
  const auto [first, last] = enum_values_.equal_range(lower(name.text));
  if (first == last) return std::nullopt;
  for (auto value = first; value != last; ++value)
    if (value->second.first == wanted || std::next(first) == last)
      return constant(value->second.first, value->second.second, name.place);
  const Type& one = *first->second.first;
  give_up("st.type"_code, name.place,
          fmt::format("{} is a value of {} and of {}", in_quotes(name.text), one.name,
                      std::next(first)->second.first->name),
          fmt::format("write {}#{}", std::next(first)->second.first->name, name.text));
}

TypedExpression Expressions::typed_literal(const Tree& tree) {
  const StToken& name = *tree.token;
  const StToken& value = *tree.tokens[0];
  if (const Type* type = enumeration(name.text)) return qualified_enum(*type, value);
  const Type* type = elementary_type(name.text);
  if (value.kind == StToken::Kind::string && type != nullptr &&
      (is_character(type->basic) || type->basic == Basic::string))
    return converted(literal(value), *type);
  if (type == nullptr || !is_elementary(type->basic) || is_clock(type->basic) || is_character(type->basic))
    give_up("st.use"_code, name.place, fmt::format("{} is no type of a literal", in_quotes(name.text)),
            "INT#5, WORD#16#FF, LREAL#1.5, T#1s");
  if (type->basic == Basic::boolean && (value.word("TRUE") || value.word("FALSE")))
    return constant(type, value.word("TRUE") ? 1 : 0, name.place);
  if (value.kind == StToken::Kind::bad) throw GiveUp{};
  if (value.kind != StToken::Kind::number || !is_number(value.basic))
    give_up("st.syntax"_code, value.place, fmt::format("{}# has no number", upper(name.text)),
            "INT#5, WORD#16#FF, LREAL#1.5");
  TypedExpression number = literal(value);
  if (tree.negative && is_real(number.type->basic))
    number.value = cell_of(-real_of(number.value));
  else if (tree.negative)
    number = negated_literal(std::move(number));
  if (number.unknown()) return number;
  number.place = name.place;
  return literal_as(std::move(number), *type);
}

/// Bits of a whole number: w.3, w.%X3, w.%B1.
TypedExpression Expressions::bits_of_number(const Tree& tree, const TypedExpression& owner) {
  const StToken& token = *tree.token;
  const Basic basic = owner.type->basic;
  std::int64_t number = token.value;
  Basic part = Basic::boolean;
  if (token.kind == StToken::Kind::address) {
    constexpr std::array parts{Basic::boolean, Basic::byte, Basic::word, Basic::dword};
    const std::string text = upper(token.text);
    const std::size_t kind = text.size() > 2 ? std::string_view("XBWD").find(text[1]) : parts.size();
    const auto digits =
        parsed<std::int64_t>(std::string_view(text).substr(std::min<std::size_t>(2, text.size())));
    if (kind >= parts.size() || !digits)
      give_up("st.syntax"_code, token.place, in_quotes(token.text) + " is no part of a number",
              "%X3 is a bit, %B1 a byte");
    number = *digits;
    part = parts.at(kind);
  }
  const int width = bits_of(part);
  if (!is_integer(basic) || width > bits_of(basic))
    give_up("st.type"_code, token.place,
            fmt::format("{} is {} and has no part {}", in_quotes(owner.name), owner.type->name,
                        in_quotes(token.text)),
            "whole numbers have bits, from 0");
  const int count = bits_of(basic) / width;
  if (number < 0 || number >= count)
    give_up("st.out-of-range"_code, token.place,
            fmt::format("{} has no part {}", owner.type->name, in_quotes(token.text)),
            fmt::format("0 to {}", count - 1));
  TypedExpression result = owner;
  result.bits = Bits{owner.type, static_cast<int>(number) * width, width};
  result.type = type_of(part);
  result.name += "." + std::string(token.text);
  result.untyped = false;
  if (!result.constant) return result;
  result.value =
      wrapped(part, static_cast<Cell>(static_cast<std::uint64_t>(owner.value) >> result.bits->shift));
  result.bits.reset();
  return result;
}

TypedExpression Expressions::member_of(const Tree& tree) {
  const Tree& before = tree.parts[0];
  const StToken& name = *tree.token;
  if (before.kind == Tree::Kind::name && !variable(*before.token))
    if (const Type* type = enumeration(before.token->text)) return qualified_enum(*type, name);
  if (const Method method = method_of(tree, get_mark); method.unit != nullptr) return method_call(method, {});
  const TypedExpression owner = typed(before);
  if (owner.unknown()) return owner;
  if (name.kind != StToken::Kind::name) return bits_of_number(tree, owner);
  const Type& type = *owner.type;
  const Variable* member = find_member(type, name.text);
  const bool inside = member != nullptr && type.basic == Basic::block && owner.name != "THIS" &&
                      (member->section == VarClass::local || member->section == VarClass::temp);
  const bool connected =
      member != nullptr && type.basic == Basic::block && member->section == VarClass::in_out;
  if (connected || inside)
    return refuse(
        "st.use"_code, name.place,
        fmt::format("{} of {} is {}", in_quotes(member->name), type.name,
                    inside ? "a variable of its own" : "connected in a call"),
        inside ? "only its pins are seen from outside" : "use the variable that is connected to it");
  if (member == nullptr) return no_member(owner, name);
  if (!owner.address)
    give_up("st.use"_code, name.place, fmt::format("a member of a {} that is no variable", type.name),
            "assign it to a variable before");
  TypedExpression result = variable_of(*member, address_plus(owner.node, member->offset),
                                       owner.name + "." + member->name, owner.place);
  result.depth = owner.depth;
  if (result.locked.empty()) result.locked = owner.locked;
  result.own_input = owner.own_input;
  if (type.basic == Basic::block && member->section == VarClass::output)
    result.locked = fmt::format("is an output of {}", type.name);
  result.cam_file = &type == cam_ref_ && member == type.members.data();
  return result;
}

TypedExpression Expressions::no_member(const TypedExpression& owner, const StToken& name) {
  const Type& type = *owner.type;
  if (type.broken) return unknown_at(name.place);
  std::vector<std::string> names;
  for (const Variable& known : type.members)
    if (type.basic == Basic::structure || known.section == VarClass::input ||
        known.section == VarClass::output)
      names.push_back(known.name);
  if (names.empty())
    return refuse("st.unknown-name"_code, name.place,
                  fmt::format("{} is {} and has no members", in_quotes(owner.name), type.name),
                  "use it without '.'");
  return refuse("st.unknown-name"_code, name.place,
                fmt::format("{} has no {} {}", type.name, type.basic == Basic::block ? "pin" : "member",
                            in_quotes(name.text)),
                suggestion(name.text, names, "it has " + listed(names)));
}

}  // namespace drycut::devices::plcopen::st
