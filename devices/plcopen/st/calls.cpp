#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/values.hpp"

// Calls of functions and function blocks.
namespace drycut::devices::plcopen::st {
namespace {

/// VAR_INPUT and VAR_IN_OUT.
bool takes(const Variable& pin) { return pin.section == VarClass::input || pin.section == VarClass::in_out; }

std::vector<const Variable*> inputs_of(const Type& type) {
  std::vector<const Variable*> inputs;
  for (const Variable& member : type.members)
    if (takes(member)) inputs.push_back(&member);
  return inputs;
}

}  // namespace

/// Takes EN and ENO out of the arguments of what does not declare them itself.
Expressions::Enable Expressions::take_enable(std::vector<Argument>& given, const Type* callee) {
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
      give_up("st.declared-twice"_code, argument.name->place,
              fmt::format("{} is given twice", in_quotes(argument.name->text)), "once a call");
    taken = argument.tree;
    return true;
  });
  return enable;
}

int Expressions::enable_condition(const Enable& enable, Place place) {
  if (enable.condition == nullptr) return value_node(constant(type_of(Basic::boolean), 1, place));
  const TypedExpression condition = converted(typed(*enable.condition), *type_of(Basic::boolean));
  return condition.unknown() ? -1 : value_node(condition);
}

int Expressions::enable_store(const Enable& enable, bool on) {
  if (enable.result == nullptr) return -1;
  const TypedExpression target = typed(*enable.result);
  return assign(target, constant(type_of(Basic::boolean), on ? 1 : 0, target.place));
}

/// A function that is not enabled gives its type's initial value (IEC 61131-3 leaves open which).
TypedExpression Expressions::enabled(const Enable& enable, TypedExpression value, const Type* wanted) {
  if (value.unknown() || (enable.condition == nullptr && enable.result == nullptr)) return value;
  if (value.untyped && wanted != nullptr) value = literal_as(std::move(value), *base_of(wanted));
  const Basic basic = value.type->basic;
  const int on = value_node(value);
  int off = on;
  if (is_elementary(basic))
    off = value_node(constant(value.type, value.type->initial.front(), value.place));
  else if (basic == Basic::string)
    off = literal_string("", value.place);
  else if (enable.condition != nullptr)
    give_up("st.call"_code, value.place, fmt::format("EN of a function that gives {}", value.type->name),
            "IF condition THEN");
  const int condition = enable_condition(enable, value.place);
  const int list = add_list({condition, on, off, enable_store(enable, true), enable_store(enable, false)});
  return {value.type, value.place, add_node(StOp::enabled, basic, value.place, list), value.depth + 1};
}

bool Expressions::names_function(const Tree& callee) {
  if (callee.kind != Tree::Kind::name) return false;
  // A FUNCTION's own name is its result, and with arguments a call of itself.
  return find_unit(callee.token->text) == unit_ || !variable(*callee.token);
}

TypedExpression Expressions::call(const Tree& tree, const Type* wanted) {
  const Tree& callee = tree.parts[0];
  const StToken& name = *callee.token;
  const bool statement = std::exchange(statement_, false);
  if (const Method method = method_of(callee, ""); method.unit != nullptr) {
    std::vector<Argument> given = arguments(tree);
    const Enable enable = take_enable(given, method.unit->type);
    if (method.unit->procedure && !statement)
      give_up("st.use"_code, method.place, fmt::format("{} gives no value", method.unit->name.text),
              "call it in a statement of its own");
    return enabled(enable, method_call(method, given), wanted);
  }
  if (!names_function(callee)) {
    TypedExpression named = typed(callee);
    if (named.unknown()) return named;
    const bool block = named.type->basic == Basic::block;
    give_up("st.use"_code, name.place,
            fmt::format("{} is {} and cannot be called here", in_quotes(named.name), named.type->name),
            block ? "call it in a statement of its own and read its outputs"
                  : "a variable hides a function of its name: choose another one");
  }
  std::vector<Argument> given = arguments(tree);
  Unit* const unit = find_unit(name.text);
  // Standard functions are read where they are called.
  if (unit != nullptr && unit->standard && unit->kind == Unit::Kind::function) declare(*unit);
  const bool function = unit != nullptr && unit->kind == Unit::Kind::function;
  const Enable enable = take_enable(given, function ? unit->type : nullptr);
  if (function && unit->procedure && !statement)
    give_up("st.use"_code, name.place, fmt::format("{} gives no value", unit->name.text),
            "call it in a statement of its own");
  return enabled(enable, function_call(name, given, wanted), wanted);
}

TypedExpression Expressions::function_call(const StToken& name, const std::vector<Argument>& given,
                                           const Type* wanted) {
  if (Unit* unit = find_unit(name.text); unit != nullptr && unit->kind == Unit::Kind::function)
    return user_call(*unit, name, given);
  const auto argument_of = [this](const Tree& tree, const Type* type) { return typed(tree, type); };
  if (auto value = reference_call(name, given)) return std::move(*value);
  if (auto value = assertion_call(name, given)) return std::move(*value);
  if (auto value = bound_call(name, given, wanted)) return std::move(*value);
  if (auto value = standard_call(*this, name, given, wanted, argument_of)) return std::move(*value);
  for (const Argument& argument : given) typed(*argument.tree);
  const bool block = find_block_type(name.text) != nullptr || find_unit(name.text) != nullptr;
  const auto known = [&] {
    std::vector<std::string> names = standard_function_names();
    for (const auto& unit : units_)
      if (unit->kind == Unit::Kind::function) names.emplace_back(unit->name.text);
    for (const Variable& member : unit_->type != nullptr ? unit_->type->members : globals_->members)
      if (member.type->basic == Basic::block) names.push_back(member.name);
    if (may_assert()) add_assertion_names(names);
    return names;
  };
  if (told_.insert(lower(name.text)).second)
    complain("st.unknown-name"_code, name.place, fmt::format("there is no function {}", in_quotes(name.text)),
             block ? "it is a kind of function block: declare an instance of it in VAR and call that"
             : is_assertion(name.text)
                 ? "tests have it: a FUNCTION_BLOCK or PROGRAM TEST_..., and all units under drycut test"
                 : suggested(name.text, known, "declare FUNCTION " + std::string(name.text) + " : type"));
  return unknown_at(name.place);
}

std::vector<std::string> Expressions::pins_of(const Type& type, bool output) {
  std::vector<std::string> names;
  for (const Variable& member : type.members)
    if (output ? member.section == VarClass::output : takes(member)) names.push_back(member.name);
  return names;
}

const Variable* Expressions::pin_of(const Type& type, const StToken& name, bool output) {
  const Variable* pin = find_member(type, name.text);
  const bool is_output = pin != nullptr && pin->section == VarClass::output;
  const bool is_input = pin != nullptr && takes(*pin);
  if (output ? is_output : is_input) return pin;
  if (is_input || is_output) {
    complain(
        "st.call"_code, name.place,
        fmt::format("{} is an {} of {}", in_quotes(pin->name), is_output ? "output" : "input", type.name),
        is_output ? fmt::format("{} => variable reads it", pin->name)
                  : fmt::format("{} := value gives it", pin->name));
    return nullptr;
  }
  if (type.broken) return nullptr;
  const std::vector<std::string> names = pins_of(type, output);
  const std::string all = names.empty() ? fmt::format("it has no {}", output ? "outputs" : "inputs")
                                        : fmt::format("it has {}", listed(names));
  complain("st.unknown-name"_code, name.place,
           fmt::format("{} has no {} {}", type.name, output ? "output" : "input", in_quotes(name.text)),
           suggestion(name.text, names, all));
  return nullptr;
}

void Expressions::input_of(const TypedExpression& instance, const Argument& argument, BlockCall& call) {
  const Type& type = *instance.type;
  const std::vector<const Variable*> inputs = inputs_of(type);
  if (argument.name == nullptr && call.unnamed >= inputs.size()) {
    if (call.unnamed++ == inputs.size())
      complain("st.call"_code, argument.tree->token->place,
               fmt::format("{} has {} input{}", type.name, inputs.size(), inputs.size() == 1 ? "" : "s"),
               "leave the rest out");
    call.given.insert("?");
    return;
  }
  const Variable* pin =
      argument.name == nullptr ? inputs[call.unnamed++] : pin_of(type, *argument.name, argument.output);
  const Place told = argument.name == nullptr ? argument.tree->token->place : argument.name->place;
  if (pin == nullptr) {
    // It was meant for something: what is missing is not told as well.
    call.given.insert("?");
    typed(*argument.tree);
    return;
  }
  if (!call.given.insert(pin->name).second) {
    complain("st.declared-twice"_code, told, fmt::format("{} is given twice", in_quotes(pin->name)),
             "once a call");
    return;
  }
  const int place = address_plus(instance.node, pin->offset);
  if (argument.output) {
    call.after.push_back(output_store(type, *pin, argument, place));
  } else if (pin->section == VarClass::in_out) {
    const TypedExpression value = typed(*argument.tree);
    call.before.push_back(in_out_store(type, *pin, value, place));
    if (pin->type->open == 0 || call.before.back() < 0) return;
    const std::vector<TypedExpression> bounds = bounds_of(value, told);
    for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(pin->type->open); ++i) {
      const Variable* bound = find_member(type, bound_name(pin->name, i));
      call.before.push_back(
          assign(variable_at(bound->type, address_plus(instance.node, bound->offset), "", told), bounds[i]));
    }
  } else {
    const TypedExpression target = variable_at(pin->type, place, instance.name + "." + pin->name, told);
    call.before.push_back(assign(target, typed(*argument.tree, pin->type)));
  }
}

/// The statements that give an instance's inputs and take its outputs.
Expressions::BlockCall Expressions::block_arguments(const TypedExpression& instance,
                                                    const std::vector<Argument>& given) {
  const Type& type = *instance.type;
  BlockCall call;
  // All by their names, or all in their order.
  const auto named = [](const Argument& one) { return one.name != nullptr && !one.output; };
  const auto unnamed =
      std::find_if(given.begin(), given.end(), [](const Argument& one) { return one.name == nullptr; });
  if (unnamed != given.end() && std::any_of(given.begin(), given.end(), named)) {
    const std::vector<std::string> inputs = pins_of(type, false);
    complain("st.call"_code, unnamed->tree->token->place,
             fmt::format("an argument of {} without a name", in_quotes(instance.name)),
             fmt::format("name its input: {} := value", inputs.empty() ? "input" : inputs.front()));
    return call;
  }
  for (const Argument& argument : given) input_of(instance, argument, call);
  std::vector<std::string> missing;
  for (const Variable& member : type.members)
    if (member.section == VarClass::in_out && !call.given.contains(member.name))
      missing.push_back(member.name);
  if (!missing.empty() && !call.given.contains("?"))
    complain("st.call"_code, instance.place,
             fmt::format("{} {} not connected in the call of {}", listed(missing),
                         missing.size() == 1 ? "is" : "are", in_quotes(instance.name)),
             fmt::format("each call connects them: {} := variable", missing.front()));
  return call;
}

int Expressions::block_call(const TypedExpression& instance, const Tree& tree) {
  const Type& type = *instance.type;
  const Place place = instance.place;
  std::vector<Argument> given = arguments(tree);
  const Enable enable = take_enable(given, &type);
  const BlockCall call = block_arguments(instance, given);
  if (type.motion == nullptr && unit_ != nullptr) unit_->calls.insert(type.pou);
  std::vector<int> all = call.before;
  all.push_back(add_node(StOp::call_block, Basic::unknown, place, instance.node,
                         type.motion != nullptr ? -1 : type.pou));
  all.insert(all.end(), call.after.begin(), call.after.end());
  if (enable.condition == nullptr && enable.result == nullptr) return sequence_node(all, place);
  all.push_back(enable_store(enable, true));
  const int condition = enable_condition(enable, place);
  const int list = add_list({condition, sequence_node(all, place)});
  return add_node(StOp::branch, Basic::unknown, place, list, 1,
                  sequence_node({enable_store(enable, false)}, place));
}

int Expressions::sequence_node(std::vector<int> statements, Place place) {
  std::erase(statements, -1);
  const int first = add_list(statements);
  return add_node(StOp::sequence, Basic::unknown, place, first, static_cast<int>(statements.size()));
}

/// What an argument of a FUNCTION gives: a node, a place, and how many cells (see Op::call_function).
std::vector<int> Expressions::input_triple(const Type& function, const Variable& pin,
                                           const Argument& argument, int frame, int& depth) {
  const int at = frame + pin.offset;
  const TypedExpression given = typed(*argument.tree, pin.type);
  depth = std::max(depth, given.depth + 1);
  if (pin.section == VarClass::in_out || pin.type->open > 0) {
    const int place = leaf_node(StOp::address, pin.type->basic, given.place, at);
    if (in_out_store(function, pin, given, place) < 0) return {};
    std::vector<int> triples{given.node, at, 1};
    if (pin.type->open == 0) return triples;
    const std::vector<TypedExpression> bounds = bounds_of(given, given.place);
    for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(pin.type->open); ++i)
      triples.insert(triples.end(), {value_node(bounds[i]),
                                     frame + find_member(function, bound_name(pin.name, i))->offset, 1});
    return triples;
  }
  const TypedExpression value = converted(given, *pin.type);
  if (value.unknown()) return {};
  const int cells = is_single(pin.type->basic)         ? 1
                    : pin.type->basic == Basic::string ? 2 + static_cast<int>(bytes_of_text(*pin.type))
                                                       : -pin.type->cells;
  return {value_node(value), at, cells};
}

TypedExpression Expressions::user_call(Unit& unit, const StToken& name, const std::vector<Argument>& given,
                                       const Method* method) {
  TypedExpression unknown = unknown_at(name.place);
  const bool known = unit.state == Unit::State::done && unit.type != nullptr && unit.pou >= 0;
  if (!known || unit.type->broken) {
    for (const Argument& argument : given) typed(*argument.tree);
    return unknown;
  }
  unit_->calls.insert(unit.pou);
  const std::size_t before = problems_.size();
  const int frame = pou(unit).frame;
  const std::vector<const Variable*> inputs = inputs_of(*unit.type);
  std::set<const Variable*> connected;
  std::vector<int> list{0};
  std::vector<int> after;
  std::size_t number = 0;
  TypedExpression result{unit.result, name.place};
  bool sound = true;
  for (const Argument& argument : given) {
    const bool named = argument.name != nullptr;
    const Place place = argument.tree->token->place;
    if (!named && number >= inputs.size()) {
      complain("st.call"_code, place,
               fmt::format("{} has {} input{}", unit.name.text, inputs.size(), inputs.size() == 1 ? "" : "s"),
               "leave the rest out");
      return unknown;
    }
    const Variable* pin = named ? pin_of(*unit.type, *argument.name, argument.output) : inputs[number++];
    if (pin == nullptr) return unknown;
    if (!connected.insert(pin).second) {
      complain("st.declared-twice"_code, place, fmt::format("{} is given twice", in_quotes(pin->name)),
               "once a call");
      return unknown;
    }
    if (argument.output) {
      const int place_of_pin = leaf_node(StOp::address, pin->type->basic, place, frame + pin->offset);
      after.push_back(output_store(*unit.type, *pin, argument, place_of_pin));
      sound = sound && after.back() >= 0;
      continue;
    }
    const std::vector<int> triple = input_triple(*unit.type, *pin, argument, frame, result.depth);
    sound = sound && !triple.empty();
    list.insert(list.end(), triple.begin(), triple.end());
    list[0] += static_cast<int>(triple.size() / 3);
  }
  if (!sound || problems_.size() != before || !all_connected(unit, name, given, connected, number) ||
      unit.result->basic == Basic::unknown)
    return unknown;
  list.push_back(static_cast<int>(after.size()));
  list.insert(list.end(), after.begin(), after.end());
  if (method != nullptr) {
    const int next = static_cast<int>(method_numbers_.size());
    const int of_method = method->fixed ? -1 : method_numbers_.emplace(unit.key, next).first->second;
    list.insert(list.begin(), {method->instance, of_method});
  }
  const int first = add_list(list);
  // A text or structure outlives the next call of the function.
  const bool whole = !is_single(unit.result->basic);
  const int kept = whole ? scratch(*unit.result, name.place) : -1;
  result.node = add_node(method != nullptr ? StOp::call_method : StOp::call_function, unit.result->basic,
                         name.place, first, kept, unit.pou, whole ? unit.result->cells : 0);
  return result;
}

bool Expressions::all_connected(const Unit& unit, const StToken& name, const std::vector<Argument>& given,
                                const std::set<const Variable*>& connected, std::size_t number) {
  const std::vector<const Variable*> inputs = inputs_of(*unit.type);
  for (const Variable* input : inputs)
    if ((input->section == VarClass::in_out || input->type->open > 0) && !connected.contains(input)) {
      complain("st.call"_code, name.place,
               fmt::format("{} is not connected in the call of {}", input->name, unit.name.text),
               fmt::format("{} := variable", input->name));
      return false;
    }
  // All inputs, as IEC 61131-3 lets them be left out only where names are given.
  if (given.empty() || given.front().name != nullptr || number == inputs.size()) return true;
  complain("st.call"_code, name.place,
           fmt::format("{} has {} inputs, not {}", unit.name.text, inputs.size(), number),
           fmt::format("{} is missing; by name inputs may be left out", in_quotes(inputs[number]->name)));
  return false;
}

}  // namespace drycut::devices::plcopen::st
