#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/keywords.hpp"

// What a name in an expression means, and what may follow it: .member and [index].
namespace drycut::devices::plcopen::st {
namespace {

struct DirectionName {
  std::string_view name;
  Direction value;
};
constexpr std::array directions{DirectionName{"mcPositiveDirection", Direction::positive},
                                DirectionName{"mcShortestWay", Direction::shortest_way},
                                DirectionName{"mcNegativeDirection", Direction::negative},
                                DirectionName{"mcCurrentDirection", Direction::current}};

}  // namespace

std::vector<std::string> Compiler::known_names() const {
  std::vector<std::string> names;
  if (unit_ != nullptr && unit_->type != nullptr)
    for (const Variable& member : unit_->type->members) names.push_back(member.name);
  for (const Variable& global : globals_->members) names.push_back(global.name);
  for (const auto& [name, type] : enumerations_)
    for (const EnumValue& value : type->values) names.push_back(value.name);
  for (const StartModeRow& row : start_mode_table) names.emplace_back(row.name);
  for (const DirectionName& direction : directions) names.emplace_back(direction.name);
  for (const auto& unit : units_)
    if (unit->kind == Unit::Kind::function) names.emplace_back(unit->name.text);
  return names;
}

std::optional<Expression> Compiler::predefined(const Token& name) {
  const auto number = [&](std::int64_t value) {
    return constant(type_of(Basic::lint), value, name.place, true);
  };
  for (const StartModeRow& row : start_mode_table)
    if (name.word(row.name)) return constant(type_of(Basic::dword), row.bit, name.place, false);
  for (const DirectionName& direction : directions)
    if (name.word(direction.name)) return number(static_cast<std::int64_t>(direction.value));
  for (int i = 0; i <= static_cast<int>(Interpolation::table_defined); ++i)
    if (name.word(plcopen::name_of(static_cast<Interpolation>(i)))) return number(i);
  return std::nullopt;
}

Expression Compiler::variable_of(const Variable& variable, int node, const std::string& name) {
  Expression result{variable.type, peek().place};
  result.name = name;
  if (variable.constant && variable.value) {
    result.constant = true;
    result.value = *variable.value;
    result.locked = "is a constant";
    return result;
  }
  result.address = true;
  result.node = node;
  if (variable.constant) result.locked = "is a constant";
  if (variable.reads_terminal) result.locked = "is an input terminal";
  return result;
}

std::optional<Expression> Compiler::variable(const Token& name) {
  const Variable* found = unit_->type == nullptr ? nullptr : find_member(*unit_->type, name.text);
  const bool own = found != nullptr && unit_->type != globals_;
  if (found == nullptr) found = find_member(*globals_, name.text);
  if (found == nullptr) return std::nullopt;
  const Basic basic = found->type->basic;
  int node = -1;
  if (own && unit_->kind == Unit::Kind::function_block) {
    node = add_node(Op::address_own, basic, name.place, -1, -1, -1, found->offset);
  } else {
    const int base = own ? code_->pous[static_cast<std::size_t>(unit_->pou)].frame : 0;
    node = add_node(Op::address, basic, name.place, -1, -1, -1, base + found->offset);
  }
  if (found->section == Section::in_out) node = add_node(Op::follow, basic, name.place, node);
  Expression result = variable_of(*found, node, found->name);
  result.place = name.place;
  if (own && found->section == Section::input)
    result.locked = fmt::format("is an input of {}", quoted(unit_->name.text));
  return result;
}

Expression Compiler::name_expression() {
  const Token name = peek();
  if (name.word("TRUE") || name.word("FALSE")) {
    take();
    return constant(type_of(Basic::boolean), name.word("TRUE") ? 1 : 0, name.place);
  }
  const Token& next = peek(1);
  if (is_keyword(name.text))
    give_up(name.place, fmt::format("an expression is missing before {}", quoted(name.text)),
            "a value stands here");
  take();
  if (next.is("#")) return typed_literal(name);
  // A FUNCTION's own name is its result, and with arguments a call of itself.
  const Unit* const unit = next.is("(") ? find_unit(name.text) : nullptr;
  if (unit != nullptr && unit == unit_) return call(name);
  if (std::optional<Expression> found = variable(name)) return selected(std::move(*found));
  if (next.is("(")) return call(name);
  if (next.is("."))
    for (const auto& [type_name, type] : enumerations_)
      if (name.word(type_name)) {
        take();
        return qualified_enum(*type);
      }
  if (std::optional<Expression> found = enum_value(name)) return *found;
  if (std::optional<Expression> found = predefined(name)) return *found;
  // Told once a POU; what hangs on it is passed over.
  if (told_.insert(lower(name.text)).second) {
    const bool type = find_unit(name.text) != nullptr || elementary_type(name.text) != nullptr ||
                      find_block_type(name.text) != nullptr;
    complain(name.place, fmt::format("{} is {}", quoted(name.text), type ? "no variable" : "not declared"),
             suggestion(name.text, known_names(),
                        type ? "declare an instance of it in VAR" : "declare it in VAR ... END_VAR"));
  }
  return selected({type_of(Basic::unknown), name.place});
}

Expression Compiler::qualified_enum(const Type& type) {
  const Token name = expect_name("a value of " + type.name);
  for (const EnumValue& value : type.values)
    if (name.word(value.name)) return constant(&type, value.value, name.place);
  std::vector<std::string> names;
  for (const EnumValue& value : type.values) names.push_back(value.name);
  complain(name.place, fmt::format("{} has no value {}", type.name, quoted(name.text)),
           suggestion(name.text, names, "it has " + listed(names)));
  return {type_of(Basic::unknown), name.place};
}

std::optional<Expression> Compiler::enum_value(const Token& name) {
  std::optional<Expression> found;
  for (const auto& [type_name, type] : enumerations_)
    for (const EnumValue& value : type->values) {
      if (!name.word(value.name)) continue;
      if (found)
        give_up(name.place,
                fmt::format("{} is a value of {} and of {}", quoted(name.text), found->type->name, type_name),
                fmt::format("write {}#{}", type_name, value.name));
      found = constant(type, value.value, name.place);
    }
  return found;
}

Expression Compiler::typed_literal(const Token& name) {
  take();  // '#'
  for (const auto& [type_name, type] : enumerations_)
    if (name.word(type_name)) return qualified_enum(*type);
  const Type* type = elementary_type(name.text);
  if (type == nullptr || !is_elementary(type->basic) || type->basic == Basic::time)
    give_up(name.place, fmt::format("{} is no type of a literal", quoted(name.text)),
            "INT#5, WORD#16#FF, LREAL#1.5, T#1s");
  Token value = peek();
  if (type->basic == Basic::boolean && (value.word("TRUE") || value.word("FALSE"))) {
    take();
    return constant(type, value.word("TRUE") ? 1 : 0, name.place);
  }
  const bool negative = accept("-");
  value = take();
  if (value.kind != Token::Kind::integer && value.kind != Token::Kind::real)
    give_up(value.place, fmt::format("{}# has no number", upper(name.text)), "INT#5, WORD#16#FF, LREAL#1.5");
  const bool real = value.kind == Token::Kind::real;
  const Cell cell =
      real ? cell_of(negative ? -value.real : value.real) : (negative ? -value.number : value.number);
  return literal_as(constant(type_of(real ? Basic::lreal : Basic::lint), cell, name.place, true), *type);
}

Expression Compiler::selected(Expression result) {
  constexpr int deepest = 50;
  for (int depth = 0; at_ < stop_; ++depth) {
    if (depth > deepest) give_up(peek().place, "the name is too long", "split it up");
    if (accept("."))
      result = member_of(result);
    else if (accept("["))
      result = element_of(result);
    else
      break;
  }
  return result;
}

Expression Compiler::member_of(const Expression& owner) {
  const bool bit = peek().kind == Token::Kind::integer;
  if (bit && !owner.unknown())
    give_up(peek().place, "single bits are not known here", "SHR and AND, or a BOOL of its own");
  const Token name = bit ? take() : expect_name("the name of a member");
  if (owner.unknown()) return owner;
  const Type& type = *owner.type;
  const Variable* member = find_member(type, name.text);
  const bool inside = member != nullptr && type.basic == Basic::block &&
                      (member->section == Section::local || member->section == Section::temp);
  const bool connected =
      member != nullptr && type.basic == Basic::block && member->section == Section::in_out;
  if (connected || inside) {
    complain(name.place,
             fmt::format("{} of {} is {}", quoted(member->name), type.name,
                         inside ? "a variable of its own" : "connected in a call"),
             inside ? "only its pins are seen from outside" : "use the variable that is connected to it");
    return {type_of(Basic::unknown), name.place};
  }
  if (member == nullptr && type.broken) return {type_of(Basic::unknown), name.place};
  if (member == nullptr) {
    std::vector<std::string> names;
    for (const Variable& known : type.members)
      if (type.basic == Basic::structure || known.section == Section::input ||
          known.section == Section::output)
        names.push_back(known.name);
    if (names.empty())
      complain(name.place, fmt::format("{} is {} and has no members", quoted(owner.name), type.name),
               "use it without '.'");
    else
      complain(name.place,
               fmt::format("{} has no {} {}", type.name, type.basic == Basic::block ? "pin" : "member",
                           quoted(name.text)),
               suggestion(name.text, names, "it has " + listed(names)));
    return {type_of(Basic::unknown), name.place};
  }
  Expression result =
      variable_of(*member, address_plus(owner.node, member->offset), owner.name + "." + member->name);
  result.place = owner.place;
  if (result.locked.empty()) result.locked = owner.locked;
  if (type.basic == Basic::block && member->section == Section::output)
    result.locked = fmt::format("is an output of {}", type.name);
  result.cam_file = &type == cam_ref_ && member == type.members.data();
  return result;
}

Expression Compiler::element_of(const Expression& owner) {
  Expression result = owner;
  do {
    const Expression index = expression();
    if (result.unknown() || index.unknown()) {
      result.type = type_of(Basic::unknown);
      continue;
    }
    const Type& type = *result.type;
    if (type.basic != Basic::array)
      give_up(index.place, fmt::format("{} is {} and has no elements", quoted(result.name), type.name),
              "only an ARRAY has an index");
    if (!is_integer(index.type->basic)) {
      complain(index.place, fmt::format("the index is {}", index.type->name), "an index is a whole number");
      result.type = type_of(Basic::unknown);
      continue;
    }
    const Place place = index.place;
    if (index.constant && (index.value < type.low || index.value > type.high)) {
      complain(place,
               fmt::format("the index {} is out of the bounds of {}", index.value, quoted(result.name)),
               fmt::format("{} to {}", type.low, type.high));
      result.type = type_of(Basic::unknown);
      continue;
    }
    if (index.constant) {
      result.node = address_plus(result.node, (index.value - type.low) * type.element->cells);
      result.name += fmt::format("[{}]", index.value);
    } else {
      code_->spans.push_back({type.low, type.high, type.element->cells});
      result.node = add_node(Op::element, type.element->basic, place, result.node, value_node(index),
                             static_cast<int>(code_->spans.size()) - 1);
      result.depth = std::max(result.depth, index.depth) + 1;
    }
    result.type = type.element;
  } while (accept(","));
  expect("]", "closes the index");
  return result;
}

}  // namespace drycut::devices::plcopen::st
