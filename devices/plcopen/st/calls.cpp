#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Calls of function blocks and of a user's functions.
namespace drycut::devices::plcopen::st {

std::vector<Compiler::Argument> Compiler::arguments(const Tree& call) {
  std::vector<Argument> result;
  for (std::size_t i = 1; i < call.parts.size(); ++i)
    result.push_back({call.names[i - 1].token, call.names[i - 1].output, &call.parts[i]});
  return result;
}

/// Takes EN and ENO out of the arguments of what does not declare them itself.
Compiler::Enable Compiler::take_enable(std::vector<Argument>& given, const Type* callee) {
  Enable enable;
  const auto is = [&](const Argument& argument, std::string_view name, bool output) {
    return argument.name != nullptr && argument.name->word(name) && argument.output == output &&
           (callee == nullptr || find_member(*callee, name) == nullptr);
  };
  std::erase_if(given, [&](const Argument& argument) {
    const bool condition = is(argument, "EN", false);
    if (!condition && !is(argument, "ENO", true)) return false;
    const Tree*& taken = condition ? enable.condition : enable.result;
    if (taken != nullptr)
      give_up(argument.name->place, fmt::format("{} is given twice", in_quotes(argument.name->text)),
              "once a call");
    taken = argument.tree;
    return true;
  });
  return enable;
}

int Compiler::enable_condition(const Enable& enable, Place place) {
  if (enable.condition == nullptr) return value_node(constant(type_of(Basic::boolean), 1, place));
  const Expression condition = converted(typed(*enable.condition), *type_of(Basic::boolean));
  return condition.unknown() ? -1 : value_node(condition);
}

int Compiler::enable_store(const Enable& enable, bool on) {
  if (enable.result == nullptr) return -1;
  const Expression target = typed(*enable.result);
  return assign(target, constant(type_of(Basic::boolean), on ? 1 : 0, target.place));
}

/// A function that is not enabled gives its type's initial value (IEC 61131-3 leaves open which).
Expression Compiler::enabled(const Enable& enable, Expression value, const Type* wanted) {
  if (value.unknown() || (enable.condition == nullptr && enable.result == nullptr)) return value;
  if (value.untyped && wanted != nullptr) value = literal_as(std::move(value), *base_of(wanted));
  const Basic basic = value.type->basic;
  const int on = value_node(value);
  int off = on;
  if (is_elementary(basic))
    off = value_node(constant(value.type, value.type->initial.front(), value.place));
  else if (basic == Basic::string)
    off = add_node(Op::address_pool, basic, value.place, -1, -1, -1, literal_string(""));
  else if (enable.condition != nullptr)
    give_up(value.place, fmt::format("EN of a function that gives {}", value.type->name),
            "IF condition THEN");
  const int condition = enable_condition(enable, value.place);
  const int list = add_list({condition, on, off, enable_store(enable, true), enable_store(enable, false)});
  Expression result{value.type, value.place};
  result.depth = value.depth + 1;
  result.node = add_node(Op::enabled, basic, value.place, list);
  return result;
}

Expression Compiler::call(const Tree& tree, const Type* wanted) {
  const Tree& callee = tree.parts[0];
  const Token& name = *callee.token;
  // A FUNCTION's own name is its result, and with arguments a call of itself.
  const Unit* const unit = callee.kind == Tree::Kind::name ? find_unit(name.text) : nullptr;
  const bool itself = unit != nullptr && unit == unit_;
  if (callee.kind != Tree::Kind::name || (!itself && variable(name))) {
    const Expression named = typed(callee);
    if (named.unknown()) return named;
    const bool block = named.type->basic == Basic::block;
    give_up(name.place,
            fmt::format("{} is {} and cannot be called here", in_quotes(named.name), named.type->name),
            block ? "call it in a statement of its own and read its outputs"
                  : "a variable hides a function of its name: choose another one");
  }
  std::vector<Argument> given = arguments(tree);
  const bool function = unit != nullptr && unit->kind == Unit::Kind::function;
  const Enable enable = take_enable(given, function ? unit->type : nullptr);
  return enabled(enable, function_call(name, given, wanted), wanted);
}

std::vector<std::string> Compiler::pins_of(const Type& type, bool output) {
  std::vector<std::string> names;
  for (const Variable& member : type.members) {
    const bool input = member.section == Section::input || member.section == Section::in_out;
    if (output ? member.section == Section::output : input) names.push_back(member.name);
  }
  return names;
}

const Variable* Compiler::pin_of(const Type& type, const Token& name, bool output) {
  const Variable* pin = find_member(type, name.text);
  const bool is_output = pin != nullptr && pin->section == Section::output;
  const bool is_input = pin != nullptr && (pin->section == Section::input || pin->section == Section::in_out);
  if (is_input && !output) return pin;
  if (is_output && output) return pin;
  if (is_input || is_output) {
    complain(name.place,
             fmt::format("{} is an {} of {}", in_quotes(pin->name), is_output ? "output" : "input", type.name),
             is_output ? fmt::format("{} => variable reads it", pin->name)
                       : fmt::format("{} := value gives it", pin->name));
    return nullptr;
  }
  if (type.broken) return nullptr;
  const std::vector<std::string> names = pins_of(type, output);
  const std::string all = names.empty() ? fmt::format("it has no {}", output ? "outputs" : "inputs")
                                        : fmt::format("it has {}", listed(names));
  complain(name.place,
           fmt::format("{} has no {} {}", type.name, output ? "output" : "input", in_quotes(name.text)),
           suggestion(name.text, names, all));
  return nullptr;
}

int Compiler::in_out_store(const Type& type, const Variable& pin, const Expression& value, int place) {
  if (value.unknown()) return -1;
  // A motion block takes its axes by value: they do not change.
  const bool by_value = type.motion != nullptr;
  if (!value.address || value.bits || !same_type(*value.type, *pin.type)) {
    complain(value.place,
             value.address && !value.bits
                 ? fmt::format("{} is {}, not {}", in_quotes(value.name), value.type->name, pin.type->name)
                 : fmt::format("{} takes a variable", in_quotes(pin.name)),
             fmt::format("connect a variable of type {}", pin.type->name));
    return -1;
  }
  if (!value.locked.empty()) {
    complain(value.place, fmt::format("{} {}", in_quotes(value.name), value.locked),
             fmt::format("{} may write it: connect a variable", in_quotes(pin.name)));
    return -1;
  }
  return add_node(Op::store_at, pin.type->basic, value.place, place,
                  by_value ? value_node(value) : value.node);
}

int Compiler::output_store(const Type& owner, const Variable& pin, const Argument& argument, int place) {
  const Expression target = typed(*argument.tree);
  if (target.unknown()) return -1;
  if (!target.address) {
    complain(target.place, fmt::format("the output {} goes into a variable", in_quotes(pin.name)),
             fmt::format("{} => variable", pin.name));
    return -1;
  }
  Expression value{pin.type, argument.name->place};
  value.node = place;
  value.address = true;
  value.name = owner.name + "." + pin.name;
  return assign(target, value);
}

void Compiler::input_of(const Expression& instance, const Argument& argument, BlockCall& call) {
  const Type& type = *instance.type;
  if (argument.name == nullptr) {
    const std::vector<std::string> inputs = pins_of(type, false);
    complain(argument.tree->token->place,
             fmt::format("an argument of {} without a name", in_quotes(instance.name)),
             inputs.empty() ? fmt::format("{} has no inputs", type.name)
                            : fmt::format("name its input: {} := value", inputs.front()));
    call.given.insert("?");
    return;
  }
  const Variable* pin = pin_of(type, *argument.name, argument.output);
  if (pin == nullptr) {
    // It was meant for something: what is missing is not told as well.
    call.given.insert("?");
    typed(*argument.tree);
    return;
  }
  if (!call.given.insert(pin->name).second) {
    complain(argument.name->place, fmt::format("{} is given twice", in_quotes(pin->name)), "once a call");
    return;
  }
  const int place = address_plus(instance.node, pin->offset);
  if (argument.output) {
    call.after.push_back(output_store(type, *pin, argument, place));
  } else if (pin->section == Section::in_out) {
    call.before.push_back(in_out_store(type, *pin, typed(*argument.tree), place));
  } else {
    Expression target{pin->type, argument.name->place};
    target.address = true;
    target.node = place;
    target.name = instance.name + "." + pin->name;
    call.before.push_back(assign(target, typed(*argument.tree, pin->type)));
  }
}

/// The statements that give an instance's inputs and take its outputs.
Compiler::BlockCall Compiler::block_arguments(const Expression& instance,
                                              const std::vector<Argument>& given) {
  const Type& type = *instance.type;
  BlockCall call;
  for (const Argument& argument : given) input_of(instance, argument, call);
  std::vector<std::string> missing;
  for (const Variable& member : type.members)
    if (member.section == Section::in_out && !call.given.contains(member.name))
      missing.push_back(member.name);
  if (!missing.empty() && !call.given.contains("?"))
    complain(instance.place,
             fmt::format("{} {} not connected in the call of {}", listed(missing),
                         missing.size() == 1 ? "is" : "are", in_quotes(instance.name)),
             fmt::format("each call connects them: {} := variable", missing.front()));
  return call;
}

int Compiler::block_call(const Expression& instance, const Tree& tree) {
  const Type& type = *instance.type;
  const Place place = instance.place;
  std::vector<Argument> given = arguments(tree);
  const Enable enable = take_enable(given, &type);
  const BlockCall call = block_arguments(instance, given);
  if (type.motion == nullptr && unit_ != nullptr) unit_->calls.insert(type.pou);
  std::vector<int> all = call.before;
  all.push_back(
      add_node(Op::call_block, Basic::unknown, place, instance.node, type.motion != nullptr ? -1 : type.pou));
  all.insert(all.end(), call.after.begin(), call.after.end());
  if (enable.condition == nullptr && enable.result == nullptr) return sequence_node(all, place);
  all.push_back(enable_store(enable, true));
  const int condition = enable_condition(enable, place);
  const int list = add_list({condition, sequence_node(all, place)});
  return add_node(Op::branch, Basic::unknown, place, list, 1,
                  sequence_node({enable_store(enable, false)}, place));
}

int Compiler::sequence_node(std::vector<int> statements, Place place) {
  std::erase(statements, -1);
  const int first = add_list(statements);
  return add_node(Op::sequence, Basic::unknown, place, first, static_cast<int>(statements.size()));
}

/// What an argument of a FUNCTION gives: a node, a place, and how many cells (see Op::call_function).
std::vector<int> Compiler::input_triple(const Type& function, const Variable& pin, const Argument& argument,
                                        int frame, int& depth) {
  const int at = frame + pin.offset;
  const Expression given = typed(*argument.tree, pin.type);
  depth = std::max(depth, given.depth + 1);
  if (pin.section == Section::in_out) {
    const int place = add_node(Op::address, pin.type->basic, given.place, -1, -1, -1, at);
    if (in_out_store(function, pin, given, place) < 0) return {};
    return {given.node, at, 1};
  }
  const Expression value = converted(given, *pin.type);
  if (value.unknown()) return {};
  const int cells = is_elementary(pin.type->basic)     ? 1
                    : pin.type->basic == Basic::string ? 2 + static_cast<int>(pin.type->length)
                                                       : -pin.type->cells;
  return {value_node(value), at, cells};
}

Expression Compiler::user_call(Unit& unit, const Token& name, const std::vector<Argument>& given) {
  const Expression unknown{type_of(Basic::unknown), name.place};
  const bool known = unit.state == Unit::State::done && unit.type != nullptr && unit.pou >= 0;
  if (!known || unit.type->broken) {
    for (const Argument& argument : given) typed(*argument.tree);
    return unknown;
  }
  unit_->calls.insert(unit.pou);
  const std::size_t before = problems_.size();
  const int frame = code_->pous[static_cast<std::size_t>(unit.pou)].frame;
  std::vector<const Variable*> inputs;
  for (const Variable& member : unit.type->members)
    if (member.section == Section::input || member.section == Section::in_out) inputs.push_back(&member);
  std::set<const Variable*> connected;
  std::vector<int> list{0};
  std::vector<int> after;
  std::size_t number = 0;
  Expression result{unit.result, name.place};
  bool sound = true;
  for (const Argument& argument : given) {
    const bool named = argument.name != nullptr;
    const Place place = argument.tree->token->place;
    if (!named && number >= inputs.size()) {
      complain(place,
               fmt::format("{} has {} input{}", unit.name.text, inputs.size(), inputs.size() == 1 ? "" : "s"),
               "leave the rest out");
      return unknown;
    }
    const Variable* pin = named ? pin_of(*unit.type, *argument.name, argument.output) : inputs[number++];
    if (pin == nullptr) return unknown;
    if (!connected.insert(pin).second) {
      complain(place, fmt::format("{} is given twice", in_quotes(pin->name)), "once a call");
      return unknown;
    }
    if (argument.output) {
      const int place_of_pin =
          add_node(Op::address, pin->type->basic, place, -1, -1, -1, frame + pin->offset);
      after.push_back(output_store(*unit.type, *pin, argument, place_of_pin));
      sound = sound && after.back() >= 0;
      continue;
    }
    const std::vector<int> triple = input_triple(*unit.type, *pin, argument, frame, result.depth);
    sound = sound && !triple.empty();
    list.insert(list.end(), triple.begin(), triple.end());
    list[0] += triple.empty() ? 0 : 1;
  }
  if (!sound || problems_.size() != before || !all_connected(unit, name, given, connected, number) ||
      unit.result->basic == Basic::unknown)
    return unknown;
  list.push_back(static_cast<int>(after.size()));
  list.insert(list.end(), after.begin(), after.end());
  const int first = add_list(list);
  // A text or structure outlives the next call of the function.
  const bool whole = !is_elementary(unit.result->basic);
  const int kept = whole ? add_node(Op::address_pool, unit.result->basic, name.place, -1, -1, -1,
                                    scratch(unit.result->cells))
                         : -1;
  result.node = add_node(Op::call_function, unit.result->basic, name.place, first, kept, unit.pou,
                         whole ? unit.result->cells : 0);
  return result;
}

bool Compiler::all_connected(const Unit& unit, const Token& name, const std::vector<Argument>& given,
                             const std::set<const Variable*>& connected, std::size_t number) {
  std::vector<const Variable*> inputs;
  for (const Variable& member : unit.type->members)
    if (member.section == Section::input || member.section == Section::in_out) inputs.push_back(&member);
  for (const Variable* input : inputs)
    if (input->section == Section::in_out && !connected.contains(input)) {
      complain(name.place, fmt::format("{} is not connected in the call of {}", input->name, unit.name.text),
               fmt::format("{} := variable", input->name));
      return false;
    }
  // All inputs, as IEC 61131-3 lets them be left out only where names are given.
  if (given.empty() || given.front().name != nullptr || number == inputs.size()) return true;
  complain(name.place, fmt::format("{} has {} inputs, not {}", unit.name.text, inputs.size(), number),
           fmt::format("{} is missing; by name inputs may be left out", in_quotes(inputs[number]->name)));
  return false;
}

}  // namespace drycut::devices::plcopen::st
