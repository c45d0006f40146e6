#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/references.hpp"

// Elements and bounds of arrays. ARRAY [*] is a pin that takes arrays of any length: it is where the caller's
// array is; the bounds stand behind it in cells of their own, the lower and the upper one of each dimension.
namespace drycut::devices::plcopen::st {

TypedExpression Expressions::element_of(const Tree& tree) {
  TypedExpression result = typed(tree.parts[0]);
  if (result.type->open > 0) return open_element(std::move(result), tree);
  for (std::size_t i = 1; i < tree.parts.size(); ++i) {
    const TypedExpression index = typed(tree.parts[i]);
    if (result.unknown() || index.unknown())
      result.type = type_of(Basic::unknown);
    else
      result = element_at(std::move(result), index);
  }
  return result;
}

TypedExpression Expressions::element_at(TypedExpression owner, const TypedExpression& index) {
  const Type& type = *owner.type;
  const Place place = index.place;
  if (type.basic != Basic::array)
    give_up("st.use"_code, place,
            fmt::format("{} is {} and has no elements", in_quotes(owner.name), type.name),
            "only an ARRAY has an index");
  if (!owner.address)
    give_up("st.use"_code, place, fmt::format("an element of an {} that is no variable", type.name),
            "assign it to a variable before");
  const bool huge = index.constant && index.value < 0 && is_wide(index.type->basic);  // a ULINT
  const bool outside = index.constant && (huge || index.value < type.low || index.value > type.high);
  if (!is_integer(index.type->basic))
    complain("st.type"_code, place, fmt::format("the index is {}", index.type->name),
             "an index is a whole number");
  else if (outside)
    complain("st.out-of-range"_code, place,
             fmt::format("the index {} is out of the bounds of {}", whole_text(index), in_quotes(owner.name)),
             fmt::format("{} to {}", type.low, type.high));
  if (!is_integer(index.type->basic) || outside) {
    owner.type = type_of(Basic::unknown);
    return owner;
  }
  if (owner.reference >= 0) {
    const Type* lint = type_of(Basic::lint);
    const auto number = [&](std::int64_t value) { return constant(lint, value, place); };
    const TypedExpression from_first = apply_op(StOp::subtract, lint, place, index, number(type.low));
    const TypedExpression bytes =
        apply_op(StOp::multiply, lint, place, from_first, number(bytes_of(*type.element)));
    const TypedExpression begin{owner.type, place, owner.reference, owner.depth};
    owner.reference = value_node(apply_op(StOp::add, null_reference(), place, begin, bytes));
  }
  if (index.constant) {
    owner.node = address_plus(owner.node, (index.value - type.low) * type.element->cells);
    owner.name += fmt::format("[{}]", index.value);
  } else {
    const int span = add_span({type.low, type.high, type.element->cells});
    owner.node = add_node(StOp::element, type.element->basic, place, owner.node, value_node(index), span);
    owner.depth = std::max(owner.depth, index.depth) + 1;
  }
  owner.type = type.element;
  return owner;
}

std::string Expressions::bound_name(std::string_view member, std::size_t number) {
  return fmt::format("{}'bound{}", member, number);
}

void Expressions::know_bounds(TypedExpression& array, const Type& owner,
                              const std::function<int(int)>& node_at) {
  const Type* const lint = type_of(Basic::lint);
  for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(array.type->open); ++i)
    if (const Variable* bound = find_member(owner, bound_name(array.name, i)))
      array.bounds.push_back(variable_at(lint, node_at(bound->offset), "", array.place));
}

bool Expressions::goes_into_open(const Type& array, const Type& open) {
  if (array.open > 0) return array.open == open.open && same_type(*array.element, *open.element);
  const Type* element = &array;
  for (int i = 0; i < open.open; ++i) {
    if (element->basic != Basic::array) return false;
    element = element->element;
  }
  return same_type(*element, *open.element);
}

std::vector<TypedExpression> Expressions::bounds_of(const TypedExpression& array, Place place) {
  if (array.type->open > 0) return array.bounds;
  std::vector<TypedExpression> bounds;
  for (const Type* type = array.type; type->basic == Basic::array; type = type->element)
    for (const std::int64_t bound : {type->low, type->high})
      bounds.push_back(constant(type_of(Basic::lint), bound, place));
  return bounds;
}

/// An index less the lower bound, looked at when the program runs; nothing if it is none.
std::optional<TypedExpression> Expressions::open_index(const Tree& tree, const TypedExpression& low,
                                                       const TypedExpression& high) {
  const TypedExpression index = typed(tree);
  if (index.unknown()) return std::nullopt;
  if (!is_integer(index.type->basic)) {
    complain("st.type"_code, index.place, fmt::format("the index is {}", index.type->name),
             "an index is a whole number");
    return std::nullopt;
  }
  return TypedExpression{
      type_of(Basic::lint), index.place,
      add_node(StOp::index, Basic::lint, index.place, value_node(index), value_node(low), value_node(high)),
      index.depth + 1};
}

TypedExpression Expressions::open_element(TypedExpression array, const Tree& tree) {
  const auto dimensions = static_cast<std::size_t>(array.type->open);
  if (tree.parts.size() - 1 != dimensions || array.bounds.size() != 2 * dimensions)
    give_up("st.use"_code, tree.token->place,
            fmt::format("{} has {} ind{}, not {}", in_quotes(array.name), dimensions,
                        dimensions == 1 ? "ex" : "ices", tree.parts.size() - 1),
            "an element of an ARRAY [*, *] is a[i, j]");
  const Type* const lint = type_of(Basic::lint);
  std::optional<TypedExpression> behind;
  for (std::size_t i = 0; i < dimensions; ++i) {
    const TypedExpression& low = array.bounds[2 * i];
    const TypedExpression& high = array.bounds[2 * i + 1];
    const auto from_low = open_index(tree.parts[i + 1], low, high);
    if (!from_low) return unknown_at(tree.token->place);
    if (!behind) {
      behind = from_low;
      continue;
    }
    const auto apply = [&](StOp op, const TypedExpression& a, const TypedExpression& b) {
      return apply_op(op, lint, from_low->place, a, b);
    };
    const TypedExpression length =
        apply(StOp::add, apply(StOp::subtract, high, low), constant(lint, 1, from_low->place));
    behind = apply(StOp::add, apply(StOp::multiply, *behind, length), *from_low);
  }
  const Type* const element = array.type->element;
  const int span = add_span({0, most_cells, element->cells});
  TypedExpression result = array;
  result.bounds.clear();
  result.node =
      add_node(StOp::element, element->basic, tree.token->place, array.node, value_node(*behind), span);
  result.depth = std::max(array.depth, behind->depth) + 1;
  result.type = element;
  return result;
}

/// LOWER_BOUND(a, 1), UPPER_BOUND(a, 1) of any array; the type is what the context wants.
std::optional<TypedExpression> Expressions::bound_call(const StToken& name,
                                                       const std::vector<Argument>& given,
                                                       const Type* wanted) {
  const bool upper_one = name.word("UPPER_BOUND");
  if (!upper_one && !name.word("LOWER_BOUND")) return std::nullopt;
  const auto named = [&](std::string_view input) {
    return std::find_if(given.begin(), given.end(),
                        [&](const Argument& one) { return one.name != nullptr && one.name->word(input); });
  };
  const auto array_given = named("ARR");
  const auto dimension_given = named("DIM");
  const bool by_name = array_given != given.end() && dimension_given != given.end();
  if (given.size() != 2 || (!by_name && (given[0].name != nullptr || given[1].name != nullptr)))
    give_up("st.call"_code, name.place, fmt::format("{} has {} values", upper(name.text), given.size()),
            fmt::format("{}(array, 1): the array and the dimension, from 1", upper(name.text)));
  const TypedExpression array = typed(*(by_name ? array_given : given.begin())->tree);
  const TypedExpression dimension = typed(*(by_name ? dimension_given : given.begin() + 1)->tree);
  if (array.unknown() || dimension.unknown()) return unknown_at(name.place);
  if (array.type->basic != Basic::array)
    return refuse("st.type"_code, array.place, fmt::format("{} of {}", upper(name.text), array.type->name),
                  "only an ARRAY has bounds");
  const std::vector<TypedExpression> bounds = bounds_of(array, name.place);
  const auto dimensions = static_cast<std::int64_t>(bounds.size() / 2);
  if (!dimension.constant || !is_integer(dimension.type->basic) || dimension.value < 1 ||
      dimension.value > dimensions)
    return refuse("st.out-of-range"_code, dimension.place,
                  fmt::format("{} has no such dimension", in_quotes(array.name)),
                  fmt::format("a constant, 1 to {}", dimensions));
  const TypedExpression& bound =
      bounds[2 * (static_cast<std::size_t>(dimension.value) - 1) + (upper_one ? 1 : 0)];
  const bool open = wanted != nullptr && is_integer(wanted->basic);
  TypedExpression result = cast(bound, open ? base_of(wanted)->basic : Basic::dint, name.place);
  if (result.address) result = as_value(std::move(result));
  result.place = name.place;
  return result;
}

}  // namespace drycut::devices::plcopen::st
