#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// What goes into variables, by := and by the pins of calls.
namespace drycut::devices::plcopen::st {

int Expressions::assign(const TypedExpression& target, const TypedExpression& value) {
  if (target.unknown()) return -1;
  if (!target.locked.empty() || !target.address) {
    complain("st.call"_code, target.place,
             target.locked.empty() ? "this is no variable"
                                   : fmt::format("{} {}", in_quotes(target.name), target.locked),
             target.locked.empty() ? "a variable stands before ':='"
                                   : "only variables and input pins are assigned");
    return -1;
  }
  const Type& type = *target.type;
  if (type.open > 0) {
    complain("st.call"_code, target.place,
             fmt::format("{} is {} and is not assigned as a whole", in_quotes(target.name), type.name),
             "assign its elements in a loop");
    return -1;
  }
  if ((type.basic == Basic::axis && target.place.line > 0 &&
       find_member(*globals_, target.name) != nullptr) ||
      type.holds_block) {
    complain("st.call"_code, target.place,
             fmt::format("{} is {} and is not assigned", in_quotes(target.name), type.name),
             type.basic == Basic::axis    ? "connect it in a call"
             : type.basic == Basic::block ? "assign its inputs"
                                          : "it holds function blocks: assign its other members");
    return -1;
  }
  const bool interface = type.basic == Basic::reference && value.type->basic == Basic::block;
  // %QW2 takes all numbers of its width.
  const bool direct = target.direct && !value.untyped && is_integer(value.type->basic) &&
                      bits_of(value.type->basic) == bits_of(type.basic);
  const TypedExpression source = direct      ? cast(value, type.basic, value.place)
                                 : interface ? converted(interface_value(value, type), type)
                                             : converted(value, type);
  if (source.unknown() || target.node < 0) return -1;
  if (target.own_input && !may_assign_input(target)) return -1;
  return store(target, value_node(source));
}

/// As CODESYS takes it; told once an input.
bool Expressions::may_assign_input(const TypedExpression& target) {
  if (dialect_ == StDialect::iec) {
    complain("st.use"_code, target.place,
             fmt::format("{} is an input of {} and is assigned", target.name, unit_->name.text),
             "IEC 61131-3 lets only the caller give it: assign a variable of its own");
    return false;
  }
  auto text = fmt::format("{} is an input of {} and is assigned here: what the caller gave is lost",
                          target.name, unit_->name.text);
  const auto same = [&](const Compiled::Doubt& doubt) { return doubt.text == text; };
  if (std::none_of(code_->doubts.begin(), code_->doubts.end(), same))
    code_->doubts.push_back(
        {"program.input-assigned"_code, target.place.line, target.place.column, std::move(text), ""});
  return true;
}

int Expressions::store(const TypedExpression& target, int value) {
  const Type& type = *target.type;
  if (target.bits)
    return add_node(StOp::store_bits, target.bits->of->basic, target.place, target.node, value,
                    target.bits->width, target.bits->shift);
  if (is_single(type.basic)) {
    if (target.reference >= 0)
      return add_node(StOp::store_by, type.basic, target.place, target.reference, value);
    const Node address = node(target.node);
    if (address.op == StOp::address || address.op == StOp::address_own)
      return add_node(address.op == StOp::address ? StOp::store : StOp::store_own, type.basic, target.place,
                      value, -1, -1, address.imm);
    return add_node(StOp::store_at, type.basic, target.place, target.node, value);
  }
  if (type.basic == Basic::string)
    return add_node(StOp::copy_string, type.basic, target.place, target.node, value,
                    type.wide ? static_cast<int>(type.length) : -1,
                    static_cast<std::int64_t>(bytes_of_text(type)));
  return add_node(StOp::copy, type.basic, target.place, target.node, value, -1, type.cells);
}

void Expressions::cam_file(const StToken& text) {
  const auto known = std::any_of(code_->tables.begin(), code_->tables.end(),
                                 [&](const Program::Name& table) { return table.name == text.string; });
  if (text.kind == StToken::Kind::string && !text.string.empty() && !known)
    code_->tables.push_back({text.string, text.place.line, text.place.column});
}

int Expressions::in_out_store(const Type& type, const Variable& pin, const TypedExpression& value,
                              int place) {
  if (value.unknown()) return -1;
  // A motion block takes its axes by value: they do not change.
  const bool by_value = type.motion != nullptr;
  const bool open = pin.type->open > 0 && goes_into_open(*value.type, *pin.type);
  if (!value.address || value.bits ||
      !(open || same_type(*value.type, *pin.type) || extends(*value.type, *pin.type))) {
    complain("st.type"_code, value.place,
             value.address && !value.bits
                 ? fmt::format("{} is {}, not {}", in_quotes(value.name), value.type->name, pin.type->name)
                 : fmt::format("{} takes a variable", in_quotes(pin.name)),
             fmt::format("connect a variable of type {}", pin.type->name));
    return -1;
  }
  if (!value.locked.empty() && pin.section == VarClass::in_out) {
    complain("st.call"_code, value.place, fmt::format("{} {}", in_quotes(value.name), value.locked),
             fmt::format("{} may write it: connect a variable", in_quotes(pin.name)));
    return -1;
  }
  return add_node(StOp::store_at, pin.type->basic, value.place, place,
                  by_value ? value_node(value) : value.node);
}

int Expressions::output_store(const Type& owner, const Variable& pin, const Argument& argument, int place) {
  const TypedExpression target = typed(*argument.tree);
  if (target.unknown()) return -1;
  if (!target.address) {
    complain("st.call"_code, target.place,
             fmt::format("the output {} goes into a variable", in_quotes(pin.name)),
             fmt::format("{} => variable", pin.name));
    return -1;
  }
  TypedExpression value = variable_at(pin.type, place, owner.name + "." + pin.name, argument.name->place);
  if (argument.negated != nullptr) value = complement(*this, *argument.negated, std::move(value), nullptr);
  return assign(target, value);
}

}  // namespace drycut::devices::plcopen::st
