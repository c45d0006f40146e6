#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Calls of function blocks and of a user's functions.
namespace drycut::devices::plcopen::st {

std::vector<Compiler::Argument> Compiler::arguments() {
  std::vector<Argument> result;
  expect("(", "opens the arguments");
  const Place opening = tokens_[at_ - 1].place;
  if (accept(")")) return result;
  do {
    Argument argument;
    const bool named = peek().kind == Token::Kind::name && (peek(1).is(":=") || peek(1).is("=>"));
    if (named) {
      argument.name = take();
      argument.output = take().is("=>");
    }
    // q => ; connects nothing.
    if (argument.output && (peek().is(",") || peek().is(")"))) continue;
    argument.value = expression();
    result.push_back(std::move(argument));
  } while (accept(","));
  expect(")", fmt::format("closes the arguments opened in line {}", opening.line));
  return result;
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
             fmt::format("{} is an {} of {}", quoted(pin->name), is_output ? "output" : "input", type.name),
             is_output ? fmt::format("{} => variable reads it", pin->name)
                       : fmt::format("{} := value gives it", pin->name));
    return nullptr;
  }
  if (type.broken) return nullptr;
  const std::vector<std::string> names = pins_of(type, output);
  const std::string all = names.empty() ? fmt::format("it has no {}", output ? "outputs" : "inputs")
                                        : fmt::format("it has {}", listed(names));
  complain(name.place,
           fmt::format("{} has no {} {}", type.name, output ? "output" : "input", quoted(name.text)),
           suggestion(name.text, names, all));
  return nullptr;
}

int Compiler::in_out_store(const Type& type, const Variable& pin, const Argument& argument, int place) {
  const Expression& value = argument.value;
  if (value.unknown()) return -1;
  // A motion block takes its axes by value: they do not change.
  const bool by_value = type.motion != nullptr;
  if (!value.address || !same_type(*value.type, *pin.type)) {
    complain(value.place,
             value.address
                 ? fmt::format("{} is {}, not {}", quoted(value.name), value.type->name, pin.type->name)
                 : fmt::format("{} takes a variable", quoted(pin.name)),
             fmt::format("connect a variable of type {}", pin.type->name));
    return -1;
  }
  if (!value.locked.empty()) {
    complain(value.place, fmt::format("{} {}", quoted(value.name), value.locked),
             fmt::format("{} may write it: connect a variable", quoted(pin.name)));
    return -1;
  }
  if (by_value) return add_node(Op::store_at, pin.type->basic, value.place, place, value_node(value));
  return add_node(Op::store_at, pin.type->basic, value.place, place, value.node);
}

int Compiler::output_store(const Type& owner, const Variable& pin, const Argument& argument, int place) {
  const Expression& target = argument.value;
  if (target.unknown()) return -1;
  if (!target.address) {
    complain(target.place, fmt::format("the output {} goes into a variable", quoted(pin.name)),
             fmt::format("{} => variable", pin.name));
    return -1;
  }
  Expression value{pin.type, argument.name.place};
  value.node = place;
  value.address = true;
  value.name = owner.name + "." + pin.name;
  return assign(target, value);
}

void Compiler::input_of(const Expression& instance, const Type& type, const Argument& argument,
                        std::set<std::string>& given, std::vector<int>& before, std::vector<int>& after) {
  if (argument.name.kind == Token::Kind::end) {
    const std::vector<std::string> inputs = pins_of(type, false);
    complain(argument.value.place, fmt::format("an argument of {} without a name", quoted(instance.name)),
             inputs.empty() ? fmt::format("{} has no inputs", type.name)
                            : fmt::format("name its input: {} := value", inputs.front()));
    given.insert("?");
    return;
  }
  const Variable* pin = pin_of(type, argument.name, argument.output);
  if (pin == nullptr) {
    // It was meant for something: what is missing is not told as well.
    given.insert("?");
    return;
  }
  if (!given.insert(pin->name).second) {
    complain(argument.name.place, fmt::format("{} is given twice", quoted(pin->name)), "once a call");
    return;
  }
  const int place = address_plus(instance.node, pin->offset);
  if (argument.output) {
    after.push_back(output_store(type, *pin, argument, place));
  } else if (pin->section == Section::in_out) {
    before.push_back(in_out_store(type, *pin, argument, place));
  } else {
    Expression target{pin->type, argument.name.place};
    target.address = true;
    target.node = place;
    target.name = instance.name + "." + pin->name;
    target.cam_file = false;
    before.push_back(assign(target, argument.value));
  }
}

int Compiler::block_call(const Expression& instance) {
  const Type& type = *instance.type;
  const Place place = instance.place;
  std::set<std::string> given;
  std::vector<int> before;
  std::vector<int> after;
  for (const Argument& argument : arguments()) input_of(instance, type, argument, given, before, after);
  std::vector<std::string> missing;
  for (const Variable& member : type.members)
    if (member.section == Section::in_out && !given.contains(member.name)) missing.push_back(member.name);
  if (!missing.empty() && !given.contains("?"))
    complain(place,
             fmt::format("{} {} not connected in the call of {}", listed(missing),
                         missing.size() == 1 ? "is" : "are", quoted(instance.name)),
             fmt::format("each call connects them: {} := variable", missing.front()));
  if (type.motion == nullptr && unit_ != nullptr) unit_->calls.insert(type.pou);
  std::vector<int> all = before;
  all.push_back(
      add_node(Op::call_block, Basic::unknown, place, instance.node, type.motion != nullptr ? -1 : type.pou));
  all.insert(all.end(), after.begin(), after.end());
  const int first = add_list(all);
  return add_node(Op::sequence, Basic::unknown, place, first, static_cast<int>(all.size()));
}

Expression Compiler::user_call(Unit& unit, const Token& name) {
  const Expression unknown{type_of(Basic::unknown), name.place};
  const std::vector<Argument> given = arguments();
  if (unit.state == Unit::State::open || unit.type == nullptr || unit.pou < 0 || unit.type->broken)
    return unknown;
  unit_->calls.insert(unit.pou);
  const int frame = code_->pous[static_cast<std::size_t>(unit.pou)].frame;
  std::vector<const Variable*> inputs;
  for (const Variable& member : unit.type->members)
    if (member.section == Section::input || member.section == Section::in_out) inputs.push_back(&member);
  std::set<const Variable*> connected;
  std::vector<int> pairs;
  std::vector<int> after;
  bool sound = true;
  std::size_t number = 0;
  int depth = 1;
  for (const Argument& argument : given) {
    const bool named = argument.name.kind != Token::Kind::end;
    if (!named && number >= inputs.size()) {
      complain(argument.value.place,
               fmt::format("{} has {} input{}", unit.name.text, inputs.size(), inputs.size() == 1 ? "" : "s"),
               "leave the rest out");
      return unknown;
    }
    const Variable* pin = named ? pin_of(*unit.type, argument.name, argument.output) : inputs[number++];
    if (pin == nullptr || argument.value.unknown()) return unknown;
    if (!connected.insert(pin).second) {
      complain(argument.value.place, fmt::format("{} is given twice", quoted(pin->name)), "once a call");
      return unknown;
    }
    depth = std::max(depth, argument.value.depth + 1);
    const int place =
        add_node(Op::address, pin->type->basic, argument.value.place, -1, -1, -1, frame + pin->offset);
    const std::size_t before = problems_.size();
    if (argument.output) {
      after.push_back(output_store(*unit.type, *pin, argument, place));
      continue;
    }
    if (pin->section == Section::in_out) {
      if (in_out_store(*unit.type, *pin, argument, place) >= 0)
        pairs.insert(pairs.end(), {argument.value.node, frame + pin->offset, 1});
    } else {
      const Expression value = converted(argument.value, *pin->type);
      const bool whole = is_elementary(pin->type->basic);
      const int text = 2 + static_cast<int>(pin->type->length);
      const int cells = whole ? 1 : pin->type->basic == Basic::string ? text : -pin->type->cells;
      if (!value.unknown())
        pairs.insert(pairs.end(), {whole ? value_node(value) : value.node, frame + pin->offset, cells});
    }
    sound = sound && problems_.size() == before;
  }
  for (const Variable* input : inputs)
    if (sound && input->section == Section::in_out && !connected.contains(input)) {
      complain(name.place, fmt::format("{} is not connected in the call of {}", input->name, unit.name.text),
               fmt::format("{} := variable", input->name));
      sound = false;
    }
  // All inputs, as IEC 61131-3 lets them be left out only where names are given.
  if (sound && !given.empty() && given.front().name.kind == Token::Kind::end && number < inputs.size()) {
    complain(name.place, fmt::format("{} has {} inputs, not {}", unit.name.text, inputs.size(), number),
             fmt::format("{} is missing; by name inputs may be left out", quoted(inputs[number]->name)));
    sound = false;
  }
  if (!sound || unit.result->basic == Basic::unknown) return unknown;
  pairs.insert(pairs.begin(), {static_cast<int>(pairs.size() / 3)});
  pairs.push_back(static_cast<int>(after.size()));
  pairs.insert(pairs.end(), after.begin(), after.end());
  Expression result{unit.result, name.place};
  result.depth = depth;
  const int first = add_list(pairs);
  result.node = add_node(Op::call_function, unit.result->basic, name.place, first, -1, unit.pou);
  return result;
}

}  // namespace drycut::devices::plcopen::st
