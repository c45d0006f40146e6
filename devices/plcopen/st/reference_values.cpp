#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/references.hpp"

// REF_TO T (POINTER TO T), REF(x) and ADR(x), p^, SIZEOF(x).
namespace drycut::devices::plcopen::st {

const Type* null_reference() {
  static const Type type = [] {
    Type null;
    null.basic = Basic::reference;
    null.name = "NULL";
    null.initial.assign(1, 0);
    return null;
  }();
  return &type;
}

namespace {

/// What can be seen as bytes can be seen as another type.
bool is_seen_as_bytes(const Type& reference) {
  return reference.element == nullptr || uniform(*reference.element) != Basic::unknown;
}

}  // namespace

const Type* Declarations::reference_type() {
  const StToken word = take();
  if (!word.word("REF_TO")) expect_word("TO", "POINTER TO type");
  // What is being declared may refer to its own kind.
  Unit* const unit = peek().kind == StToken::Kind::name ? find_unit(peek().text) : nullptr;
  const bool open = unit != nullptr && unit->state == Unit::State::open && unit->type != nullptr;
  if (open) take();
  const Place place = peek().place;
  const Type* element = open ? unit->type : parse_type();
  if (element->basic == Basic::axis)
    give_up("st.declaration"_code, place, "a reference to an AXIS_REF", "it is one itself: connect it");
  refuse_open(*element, place);
  Type& type = new_type(Basic::reference, "REF_TO " + element->name);
  type.element = element;
  return &type;
}

int Expressions::referent(const Type& type) {
  const auto known = std::find_if(code_->referents.begin(), code_->referents.end(),
                                  [&](const Referent& one) { return one.type == &type; });
  if (known == code_->referents.end()) {
    if (static_cast<std::int64_t>(code_->referents.size()) > most_referents)
      give_up("st.too-large"_code, peek().place, "references to too many types", "use fewer");
    code_->referents.push_back({&type, uniform(type), type.cells});
    return static_cast<int>(code_->referents.size()) - 1;
  }
  return static_cast<int>(known - code_->referents.begin());
}

TypedExpression Expressions::dereferenced(const Tree& tree) {
  const Tree& of = tree.parts[0];
  // THIS^ is THIS.
  if (of.kind == Tree::Kind::name && of.token->word("THIS") && block_unit() != nullptr)
    return this_instance(tree.token->place);
  const TypedExpression reference = typed(of);
  if (reference.unknown()) return reference;
  const Type* const type = reference.type->element;
  if (reference.type->basic != Basic::reference || type == nullptr)
    give_up("st.use"_code, tree.token->place,
            fmt::format("{} is {}, no reference", in_quotes(reference.name), reference.type->name),
            "'^' stands behind a REF_TO");
  const int value = value_node(reference);
  TypedExpression seen = variable_at(
      type, add_node(StOp::dereference, type->basic, tree.token->place, value, -1, referent(*type)),
      reference.name + "^", reference.place);
  if (is_seen_as_bytes(*reference.type) && type->basic != Basic::string) seen.reference = value;
  seen.depth = reference.depth + 1;
  return seen;
}

std::optional<TypedExpression> Expressions::reference_call(const StToken& name,
                                                           const std::vector<Argument>& given) {
  const bool size = name.word("SIZEOF");
  if (!size && !name.word("REF") && !name.word("ADR")) return std::nullopt;
  if (given.size() != 1 || given.front().name != nullptr)
    give_up("st.call"_code, name.place, fmt::format("{} has {} values", upper(name.text), given.size()),
            "it takes one variable");
  const Tree& tree = *given.front().tree;
  if (size && tree.kind == Tree::Kind::name && !variable(*tree.token))
    if (const Type* type = elementary_type(tree.token->text))
      return constant(type_of(Basic::lint), bytes_of(*type), name.place, true);
  const TypedExpression of = typed(tree);
  if (of.unknown()) return unknown_at(name.place);
  if (of.type->open > 0)
    give_up("st.call"_code, of.place, fmt::format("{} of {}", upper(name.text), of.type->name),
            "take it of an element, UPPER_BOUND(a, 1) - LOWER_BOUND(a, 1) + 1 is how many there are");
  if (size) return constant(type_of(Basic::lint), bytes_of(*of.type), name.place, true);
  if (!of.address || of.bits || of.type->basic == Basic::axis || !of.locked.empty())
    give_up("st.call"_code, of.place,
            fmt::format("{} of what is {}", upper(name.text),
                        of.address && !of.bits ? "not to be written" : "no variable"),
            "it takes a variable");
  code_->types.push_back(std::make_unique<Type>(*null_reference()));
  Type& type = *code_->types.back();
  type.name = "REF_TO " + of.type->name;
  type.element = of.type;
  if (of.reference >= 0) return TypedExpression{&type, name.place, of.reference, of.depth + 1};
  return TypedExpression{
      &type, name.place,
      add_node(StOp::make_reference, Basic::reference, name.place, of.node, -1, referent(*of.type)),
      of.depth + 1};
}

TypedExpression Values::reference_converted(TypedExpression expression, const Type& to) {
  const Type& from = *expression.type;
  const bool bytes = (from.basic != Basic::reference || is_seen_as_bytes(from)) &&
                     (to.basic != Basic::reference || is_seen_as_bytes(to));
  const auto number = [](const Type& type) {
    return type.basic == Basic::lword || type.basic == Basic::ulint;
  };
  // To be compared.
  if (&to == null_reference() && from.basic == Basic::reference) {
    TypedExpression any = expression.constant ? std::move(expression) : as_value(std::move(expression));
    any.type = &to;
    return any;
  }
  // An interface takes its instances only, and another one of its kind.
  const bool interface =
      from.basic == Basic::block ||
      (to.basic == Basic::reference && to.element == nullptr && &to != null_reference()) ||
      (from.basic == Basic::reference && from.element == nullptr && &from != null_reference());
  if (interface && &from != &to && &from != null_reference() && &to != null_reference())
    return refuse("st.type"_code, expression.place,
                  fmt::format("a value of type {} does not go into {}", from.name, to.name),
                  to.element == nullptr ? "an instance of a block that IMPLEMENTS it" : "REF(variable)");
  const bool null =
      expression.constant && expression.value == 0 && (from.basic == Basic::reference || expression.untyped);
  if (null || (bytes && (from.basic == to.basic || number(from) || number(to)))) {
    if (!expression.constant) expression = as_value(std::move(expression));
    expression.type = &to;
    expression.untyped = false;
    return expression;
  }
  return refuse("st.type"_code, expression.place,
                fmt::format("a value of type {} does not go into {}", from.name, to.name),
                to.basic == Basic::reference
                    ? fmt::format("REF(variable of type {})", to.element == nullptr ? "?" : to.element->name)
                    : "a reference goes into LWORD");
}

}  // namespace drycut::devices::plcopen::st
