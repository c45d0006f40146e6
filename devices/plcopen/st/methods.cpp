#include <utility>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Calls of methods and what PROPERTYs give and take; THIS, SUPER, EXTENDS and interfaces as variables.
namespace drycut::devices::plcopen::st {
namespace {

bool is_super(const Tree& tree) {
  return (tree.kind == Tree::Kind::name && tree.token->word("SUPER")) ||
         (tree.kind == Tree::Kind::dereference && is_super(tree.parts[0]));
}

}  // namespace

Unit* Expressions::find_method(Unit* unit, const std::string& key) {
  for (; unit != nullptr; unit = unit->base)
    if (const auto found = unit->methods.find(key); found != unit->methods.end()) return found->second;
  return nullptr;
}

bool Expressions::extends(const Type& from, const Type& to) const {
  if (from.basic != Basic::block || to.basic != Basic::block) return false;
  for (const Unit* unit = find_unit(from.name); unit != nullptr; unit = unit->base)
    if (unit->type == &to) return true;
  return false;
}

/// Of whose instance the text is that is read: the block itself, or that of the method.
Unit* Expressions::block_unit() const {
  if (unit_ == nullptr) return nullptr;
  if (unit_->owner != nullptr) return unit_->owner;
  return unit_->kind == Unit::Kind::function_block || unit_->kind == Unit::Kind::program ? unit_ : nullptr;
}

TypedExpression Expressions::this_instance(Place place) {
  return variable_at(block_unit()->type, leaf_node(StOp::address_own, Basic::block, place, 0), "THIS", place);
}

/// `mark` is "", or that of a PROPERTY.
Expressions::Method Expressions::method_of(const Tree& callee, std::string_view mark) {
  if (callee.kind != Tree::Kind::name && callee.kind != Tree::Kind::member) return {};
  const StToken& name = *callee.token;
  const std::string key = lower(name.text) + std::string(mark);
  if (!method_names_.contains(key)) return {};
  Unit* const own = block_unit();
  const bool super = callee.kind == Tree::Kind::member && is_super(callee.parts[0]);
  if (callee.kind == Tree::Kind::name || super) {
    const bool hidden = !super && unit_->type != nullptr && find_member(*unit_->type, name.text) != nullptr;
    Unit* const method = own == nullptr || hidden ? nullptr : find_method(super ? own->base : own, key);
    if (method == nullptr) return {};
    return {method, this_instance(name.place).node, super, name.place};
  }
  const TypedExpression instance = typed(callee.parts[0]);
  Unit* const unit = instance.unknown() ? nullptr : find_unit(instance.type->name);
  if (unit == nullptr || unit->type != instance.type || !instance.address) return {};
  Unit* const method = find_method(unit, key);
  if (method == nullptr) return {};
  if (method->closed && (own == nullptr || !extends(*own->type, *instance.type)))
    give_up("st.use"_code, name.place,
            fmt::format("{} of {} is PRIVATE or PROTECTED", name.text, unit->name.text),
            "the block itself calls it");
  const int node = unit->kind == Unit::Kind::interface ? add_node(StOp::instance, Basic::block, name.place,
                                                                  value_node(instance))
                                                       : instance.node;
  return {method, node, false, name.place};
}

TypedExpression Expressions::method_call(const Method& method, const std::vector<Argument>& given) {
  StToken name = method.unit->name;
  name.place = method.place;
  return user_call(*method.unit, name, given, &method);
}

/// The statement that gives a PROPERTY the value behind the ':='; nothing if `target` names none.
std::optional<int> Expressions::set_property(const Tree& target) {
  const Method method = method_of(target, set_mark);
  if (method.unit == nullptr) {
    if (method_of(target, get_mark).unit == nullptr) return std::nullopt;
    give_up("st.call"_code, target.token->place, fmt::format("{} has no SET", in_quotes(target.token->text)),
            "it is only read");
  }
  take();  // :=
  const Tree value = tree();
  const TypedExpression set = method_call(method, {{nullptr, false, nullptr, &value}});
  expect(";", "ends a statement");
  return set.unknown() ? -1 : add_node(StOp::evaluate, Basic::unknown, method.place, value_node(set));
}

/// SUPER^() calls the body of what the block EXTENDS; nothing if it is none.
std::optional<int> Expressions::super_call(const Tree& callee) {
  if (!is_super(callee)) return std::nullopt;
  Unit* const own = block_unit();
  const Place place = callee.token->place;
  if (own == nullptr || own->base == nullptr || own->base->pou < 0)
    give_up("st.use"_code, place, "there is no SUPER here", "it is what a block EXTENDS");
  unit_->calls.insert(own->base->pou);
  return add_node(StOp::call_block, Basic::unknown, place, this_instance(place).node, own->base->pou);
}

/// An instance for an interface that it IMPLEMENTS; anything else as it is.
TypedExpression Expressions::interface_value(const TypedExpression& instance, const Type& interface) {
  const Type* lint = type_of(Basic::lint);
  for (const Unit* unit = find_unit(instance.type->name); unit != nullptr; unit = unit->base)
    for (const StToken& name : unit->interfaces)
      for (const Unit* one = find_unit(name.text); one != nullptr; one = one->base) {
        if (one->type != &interface || !instance.address) continue;
        const TypedExpression begin{lint, instance.place, instance.node, instance.depth};
        TypedExpression value =
            apply_op(StOp::add, lint, instance.place, begin, constant(lint, 1, instance.place));
        value.type = &interface;
        return value;
      }
  return instance;
}

/// A block that EXTENDS another has its variables first, at the same places.
void Declarations::declare_base(Unit& unit, Type& type) {
  if (unit.base != nullptr) declare(*unit.base);
  if (unit.base != nullptr && unit.base->state == Unit::State::done && unit.base->type != nullptr) {
    for (const Variable& member : unit.base->type->members) {
      const auto from = unit.base->type->initial.begin() + member.offset;
      append(type, member,
             std::vector<Cell>(from, from + (member.section == VarClass::in_out ? 1 : member.type->cells)));
    }
    unit.edges = unit.base->edges;
  }
  if (!unit.tells_kind()) return;
  if (type.members.empty())
    append(type, {.name = std::string(kind_name), .type = type_of(Basic::dint), .place = unit.name.place},
           std::vector<Cell>{0});
  type.initial.front() = unit.pou;
}

/// Its variables hold where an instance is, counted from 1.
void Declarations::declare_interface(Unit& unit) {
  Type& type = new_type(Basic::reference, std::string(unit.name.text));
  unit.type = &type;
  unit.body = at_ = unit.end;
}

/// A GET gives the value under the property's name, a SET takes it under that.
void Declarations::declare_property(Unit& unit, Type& type) {
  const std::size_t body = std::exchange(at_, unit.property_type);
  const std::size_t end = std::exchange(stop_, unit.property_end);
  const Type* of = type_of(Basic::unknown);
  try {
    of = base_of(parse_type());
  } catch (const GiveUp&) {
  }
  at_ = body;
  stop_ = end;
  unit.result = unit.procedure ? type_of(Basic::boolean) : of;
  if (unit.procedure)
    append(type, {.name = "'result", .type = unit.result, .place = unit.name.place}, unit.result->initial);
  append(type,
         {.name = std::string(unit.name.text),
          .type = of,
          .section = unit.procedure ? VarClass::input : VarClass::local,
          .place = unit.name.place},
         of->initial);
}

}  // namespace drycut::devices::plcopen::st
