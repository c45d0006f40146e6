#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Whether methods fit those that they override, and blocks the interfaces that they IMPLEMENT.
namespace drycut::devices::plcopen::st {
namespace {

std::vector<const Variable*> method_pins(const Type& type) {
  std::vector<const Variable*> pins;
  for (const Variable& one : type.members)
    if (one.section != VarClass::local && one.section != VarClass::temp) pins.push_back(&one);
  return pins;
}

bool is_same_pin(const Variable* a, const Variable* b) {
  return same_word(a->name, b->name) && a->section == b->section && a->offset == b->offset &&
         same_type(*a->type, *b->type);
}

}  // namespace

/// What an instance of the block does not have of the methods of `of`.
void Compiler::check_lacks(Unit& unit, const Unit& of, Place place) {
  std::vector<std::string> lacks;
  for (const auto& [key, wanted] : of.methods) {
    Unit* const method = find_method(&unit, key);
    if (method == nullptr || (method->abstract && !unit.abstract)) lacks.emplace_back(wanted->name.text);
  }
  if (lacks.empty() || unit.abstract) return;
  std::sort(lacks.begin(), lacks.end());
  lacks.erase(std::unique(lacks.begin(), lacks.end()), lacks.end());
  complain("st.declaration"_code, place,
           fmt::format("{} lacks {} of {}", unit.name.text, listed(lacks), of.name.text),
           fmt::format("METHOD {} ... END_METHOD", lacks.front()));
}

void Compiler::check_methods() {
  for (const auto& each : units_) {
    Unit& unit = *each;
    if (unit.kind == Unit::Kind::method && unit.owner->base != nullptr)
      if (const Unit* base = find_method(unit.owner->base, unit.key)) check_override(unit, *base);
    for (const StToken& name : unit.interfaces) {
      const Unit* interface = find_unit(name.text);
      if (interface == nullptr || interface->kind != Unit::Kind::interface)
        complain("st.unknown-name"_code, name.place,
                 fmt::format("there is no INTERFACE {}", in_quotes(name.text)),
                 fmt::format("INTERFACE {} ... END_INTERFACE", name.text));
      else
        for (; interface != nullptr; interface = interface->base) {
          check_lacks(unit, *interface, name.place);
          for (const auto& [key, wanted] : interface->methods)
            if (Unit* const method = find_method(&unit, key)) check_override(*method, *wanted);
        }
    }
    if (unit.kind == Unit::Kind::function_block)
      for (const Unit* base = unit.base; base != nullptr; base = base->base)
        check_lacks(unit, *base, unit.name.place);
  }
}

void Compiler::check_override(const Unit& method, const Unit& base) {
  if (base.final)
    complain("st.declaration"_code, method.name.place,
             fmt::format("{} of {} is FINAL", base.name.text, base.owner->name.text), "give it another name");
  if (method.type == nullptr || base.type == nullptr || method.type->broken || base.type->broken) return;
  const auto wanted = method_pins(*base.type);
  const auto there = method_pins(*method.type);
  if (same_type(*base.result, *method.result) && base.procedure == method.procedure &&
      std::equal(wanted.begin(), wanted.end(), there.begin(), there.end(), is_same_pin))
    return;
  complain("st.declaration"_code, method.name.place,
           fmt::format("{} of {} has not the pins of that of {}", method.name.text, method.owner->name.text,
                       base.owner->name.text),
           "the same result and pins, in the same order, before other variables");
}

/// Which POU a method is, for each kind of instance.
void Compiler::fill_method_table() {
  for (const auto& unit : units_) {
    if (unit->pou < 0 || unit->framed()) continue;
    for (const auto& [key, number] : method_numbers_)
      if (const Unit* method = find_method(unit.get(), key); method != nullptr && method->pou >= 0)
        code_->methods[{unit->pou, number}] = method->pou;
  }
}

}  // namespace drycut::devices::plcopen::st
