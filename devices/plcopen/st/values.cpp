#include "devices/plcopen/st/values.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "devices/plcopen/st/code.hpp"

namespace drycut::devices::plcopen::st {
namespace {

/// Of one statement in another.
constexpr int levels_of_a_statement = 3;

}  // namespace

TypedExpression constant(const Type* type, Cell value, Place place, bool untyped) {
  TypedExpression result{type, place};
  result.constant = true;
  result.untyped = untyped;
  result.value = value;
  return result;
}

TypedExpression variable_at(const Type* type, int node, const std::string& name, Place place) {
  TypedExpression result{type, place, node};
  result.address = true;
  result.name = name;
  return result;
}

int depth_over(const std::vector<TypedExpression>& values) {
  int depth = 1;
  for (const TypedExpression& value : values) depth = std::max(depth, value.depth + 1);
  return depth;
}

TypedExpression Values::refuse(Code code, Place place, std::string what, std::string remedy, Place of) {
  complain(code, place, std::move(what), std::move(remedy));
  return unknown_at(of);
}

bool Values::is_iec(DialectDifference difference, Place place) {
  if (unit_ != nullptr && unit_->standard) return false;
  if (dialect_) return *dialect_ == StDialect::iec;
  if (!differences_.insert(difference).second) return false;
  const auto& [of, iec, codesys] = differences.at(static_cast<std::size_t>(difference));
  code_->doubts.push_back(
      {"program.dialect"_code, place.line, place.column,
       fmt::format("{}: taken as CODESYS takes it ({}); controller.plcopen.dialect says codesys, or iec ({})",
                   of, codesys, iec),
       ""});
  return false;
}

int Values::add_node(StOp op, Basic basic, Place place, int a, int b, int c, std::int64_t imm) {
  nodes_.nodes.push_back({op, basic, place.line, place.column, a, b, c, imm, right_sides_ > 0});
  return static_cast<int>(nodes_.nodes.size()) - 1;
}

int Values::add_list(const std::vector<int>& items) {
  const int first = static_cast<int>(nodes_.lists.size());
  nodes_.lists.insert(nodes_.lists.end(), items.begin(), items.end());
  return first;
}

int Values::add_span(const Span& span) {
  nodes_.spans.push_back(span);
  return static_cast<int>(nodes_.spans.size()) - 1;
}

TypedExpression Values::computed(StOp op, const Type* type, Place place, TypedExpression a,
                                 TypedExpression b) {
  const Basic basic = type->basic;
  const bool narrow = is_integer(basic) && bits_of(basic) < 32 && !(a.untyped && b.untyped);
  const bool ours = unit_ != nullptr && unit_->standard;
  if (!narrow || ours || dialect_ == StDialect::iec) return apply_op(op, type, place, a, b);
  const bool divides = op == StOp::divide || op == StOp::modulo;
  if (divides && a.on_the_way) is_iec(DialectDifference::results_on_the_way, place);
  a.on_the_way = b.on_the_way = false;
  TypedExpression result =
      apply_op(op, type_of(range_of(basic).low < 0 ? Basic::dint : Basic::udint), place, a, b);
  if (result.unknown()) return result;
  result.type = base_of(type);
  result.on_the_way = true;
  return result;
}

TypedExpression Values::taken_as(TypedExpression expression, Basic to) {
  if (expression.constant)
    expression.value = wrapped(to, expression.value);
  else
    nodes_.nodes[static_cast<std::size_t>(expression.node)].basic = to;
  expression.type = type_of(to);
  expression.on_the_way = false;
  return expression;
}

int Values::value_node(const TypedExpression& expression) {
  if (expression.on_the_way) return value_node(taken_as(expression, expression.type->basic));
  if (unit_ != nullptr)
    unit_->levels = std::max(unit_->levels, expression.depth + levels_of_a_statement * nesting_);
  if (expression.bits) return bits_node(expression);
  const Basic basic = expression.type->basic;
  if (expression.constant) return leaf_node(StOp::constant, basic, expression.place, expression.value);
  // What a node's value is itself; of other types it is the address.
  if (!expression.address || !is_single(basic)) return expression.node;
  if (expression.reference >= 0)
    return add_node(StOp::load_by, basic, expression.place, expression.reference);
  if (expression.node < 0) return -1;
  const Node address = node(expression.node);
  if (address.op == StOp::address) return leaf_node(StOp::load, basic, expression.place, address.imm);
  if (address.op == StOp::address_own) return leaf_node(StOp::load_own, basic, expression.place, address.imm);
  return add_node(StOp::load_at, basic, expression.place, expression.node);
}

int Values::bits_node(const TypedExpression& expression) {
  TypedExpression whole = expression;
  whole.type = base_of(expression.bits->of);
  whole.bits.reset();
  const TypedExpression places = constant(type_of(Basic::int_), expression.bits->shift, expression.place);
  const TypedExpression moved = apply_op(StOp::shift_right, whole.type, expression.place, whole, places);
  return value_node(apply_op(StOp::wrap, expression.type, expression.place, moved));
}

TypedExpression Values::as_value(TypedExpression expression) {
  expression.node = value_node(expression);
  expression.on_the_way = false;
  expression.type = base_of(expression.type);
  expression.bits.reset();
  expression.address = false;
  expression.reference = -1;
  return expression;
}

int Values::address_plus(int address, std::int64_t offset) {
  if (offset == 0 || address < 0) return address;
  Node moved = node(address);
  moved.imm += offset;
  nodes_.nodes.push_back(moved);
  return static_cast<int>(nodes_.nodes.size()) - 1;
}

int Values::in_pool(std::size_t cells) {
  const std::size_t first = pool_.size();
  pool_.resize(first + cells, 0);
  return static_cast<int>(first);
}

int Values::literal_string(const std::string& text, Place place) {
  auto [entry, fresh] = strings_.emplace(text, static_cast<int>(pool_.size()));
  if (fresh) {
    in_pool(static_cast<std::size_t>(string_cells(text.size())));
    std::memcpy(pool_.data() + entry->second, text.data(), text.size());
  }
  return leaf_node(StOp::address_pool, Basic::string, place, entry->second);
}

int Values::scratch(const Type& type, Place place) {
  return leaf_node(StOp::address_pool, type.basic, place, in_pool(static_cast<std::size_t>(type.cells)));
}

const Type* Values::longest_string(bool wide) {
  const std::size_t length = code_->longest_text;
  const Type*& known = wide ? longest_wide_ : longest_string_;
  if (known != nullptr && known->length == length) return known;
  Type longest = *type_of(Basic::string);
  longest.name = fmt::format("{}[{}]", wide ? "WSTRING" : "STRING", length);
  longest.length = length;
  longest.wide = wide;
  longest.cells = string_cells(bytes_of_text(longest));
  longest.initial.assign(static_cast<std::size_t>(longest.cells), 0);
  code_->longest_bytes = std::max(code_->longest_bytes, bytes_of_text(longest));
  code_->types.push_back(std::make_unique<Type>(std::move(longest)));
  return known = code_->types.back().get();
}

TypedExpression Values::text_value(TextOp op, const Type* number, const std::vector<TypedExpression>& inputs,
                                   bool wide, Place place) {
  const bool text = op < TextOp::length;
  const Type* type = text ? longest_string(wide) : number;
  std::vector<int> nodes;
  if (text) nodes.push_back(scratch(*type, place));
  for (const TypedExpression& input : inputs) nodes.push_back(value_node(input));
  const Basic of = op == TextOp::from_value ? inputs[0].type->basic : type->basic;
  const int list = add_list(nodes);
  return {type, place,
          add_node(StOp::text, of, place, list, static_cast<int>(nodes.size()), wide ? 1 : -1,
                   static_cast<std::int64_t>(op)),
          depth_over(inputs)};
}

std::string whole_text(const TypedExpression& value) {
  return is_wide(value.type->basic) ? fmt::format("{}", static_cast<std::uint64_t>(value.value))
                                    : fmt::format("{}", value.value);
}

TypedExpression Values::folded(StOp op, const Type* type, Place place, Cell a, Cell b, bool untyped) {
  if (const auto none = no_result(op, type->basic, a, b))
    return refuse(none->code, place, none->what, none->remedy);
  const Cell result = apply(op, type->basic, a, b);
  note_loss(op, type->basic, place, a, result);
  return constant(type, result, place, untyped);
}

/// What a conversion of constants cuts off: noted once, as the machine tells it of variables.
void Values::note_loss(StOp op, Basic basic, Place place, Cell before, Cell result) {
  const bool converts =
      op == StOp::wrap || op == StOp::to_whole || op == StOp::truncate || op == StOp::round_real;
  if (!converts || (unit_ != nullptr && unit_->standard)) return;
  const auto loss = loss_of(op, basic, before, result);
  const auto same = [&](const Compiled::Doubt& doubt) {
    return doubt.line == place.line && doubt.column == place.column && doubt.text == loss;
  };
  if (loss && std::none_of(code_->doubts.begin(), code_->doubts.end(), same))
    code_->doubts.push_back({"st.out-of-range"_code, place.line, place.column, *loss, ""});
}

TypedExpression Values::apply_op(StOp op, const Type* type, Place place, const TypedExpression& a,
                                 const TypedExpression& b) {
  constexpr int deepest = 400;
  if (a.unknown() || b.unknown()) return unknown_at(place);
  if (a.on_the_way) return apply_op(op, type, place, taken_as(a, a.type->basic), b);
  if (b.on_the_way) return apply_op(op, type, place, a, taken_as(b, b.type->basic));
  type = base_of(type);
  if (a.constant && b.constant && is_pure(op)) {
    TypedExpression result = folded(op, type, place, a.value, b.value, a.untyped && b.untyped);
    if (type->basic == Basic::boolean) result.untyped = false;
    return result;
  }
  const int depth = std::max(a.depth, b.depth) + 1;
  if (depth > deepest)
    give_up("st.too-large"_code, place, "the expression is too long", "split it up by a variable");
  const int first = value_node(a);
  return {type, place, add_node(op, type->basic, place, first, value_node(b)), depth};
}

TypedExpression Values::apply_op(StOp op, const Type* type, Place place, const TypedExpression& a) {
  if (a.unknown()) return unknown_at(place);
  if (a.on_the_way) return apply_op(op, type, place, taken_as(a, a.type->basic));
  type = base_of(type);
  if (a.constant) return folded(op, type, place, a.value, 0, a.untyped && op != StOp::round_real);
  return {type, place, add_node(op, type->basic, place, value_node(a)), a.depth + 1};
}

}  // namespace drycut::devices::plcopen::st
