// What a text says that is no fault and hardly meant: blocks that nothing calls, variables that are read and
// that nothing sets, a cam selected for the master as its slave.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

namespace drycut::devices::plcopen::st {

namespace {

/// The '(' of the call in which token `at` stands; 0 = it stands in none.
std::size_t call_of(const std::vector<StToken>& tokens, std::size_t at, std::size_t first) {
  int depth = 0;
  for (std::size_t i = at; i-- > first;) {
    if (tokens[i].is(";")) return 0;
    if (tokens[i].is(")")) ++depth;
    if (tokens[i].is("(") && depth-- == 0) return i;
  }
  return 0;
}

}  // namespace

/// How the bodies that see it use a name.
struct Compiler::NameUse {
  bool called = false;
  bool written = false;
  Place read = {};  ///< the first time
};

Compiler::NameUse Compiler::use_of(const Variable& variable, const Unit& unit) const {
  NameUse use;
  for (std::size_t i = unit.body; i < unit.end; ++i) {
    const StToken& token = tokens_[i];
    if (token.kind != StToken::Kind::name || !same_word(token.text, variable.name) || tokens_[i - 1].is("."))
      continue;
    const StToken& next = tokens_[i + 1];
    const StToken& before = tokens_[i - 1];
    bool written = next.is("[") || next.is(".") || before.is("=>") || before.word("ADR");
    if (next.is(":=")) {
      // In a call it is the pin of that name.
      const auto call = call_of(tokens_, i, unit.body);
      if (call > 0 && (before.is("(") || before.is(","))) continue;
      written = true;
    } else if (before.is(":=") && i > unit.body + 2) {
      written = written || goes_out(i, unit);
    } else if ((before.is("(") || before.is(",")) && (next.is(",") || next.is(")"))) {
      written = true;  // an argument without a name: it may come back
    }
    use.called = use.called || next.is("(");
    use.written = use.written || written;
    if (!written && use.read.line == 0) use.read = token.place;
    if (variable.type->basic == Basic::block && use.read.line == 0) use.read = token.place;
  }
  return use;
}

/// An argument of a call that gives it to a VAR_IN_OUT, or to a pin that is not known here.
bool Compiler::goes_out(std::size_t at, const Unit& unit) const {
  const auto call = call_of(tokens_, at, unit.body);
  if (call == 0) return false;
  const Type* owner = unit.type;
  const Variable* instance = find_member(*owner, tokens_[call - 1].text);
  if (instance == nullptr) instance = find_member(*globals_, tokens_[call - 1].text);
  const Variable* pin = instance != nullptr ? find_member(*instance->type, tokens_[at - 2].text) : nullptr;
  return pin == nullptr || pin->section == VarClass::in_out;
}

/// Whether its declaration gives an initial value, 0 too: it is meant to stay.
bool Compiler::is_initialised(const Variable& variable) const {
  auto at = std::find_if(
      tokens_.begin() + static_cast<std::ptrdiff_t>(user_tokens_), tokens_.end(), [&](const StToken& token) {
        return token.place.line == variable.place.line && token.place.column == variable.place.column;
      });
  while (at != tokens_.end() && !at->is(";") && !at->is(":=")) ++at;
  return at != tokens_.end() && at->is(":=");
}

void Compiler::doubt_variable(const Variable& variable, const Type& owner, const NameUse& use) {
  const auto tell = [&](Code code, Place place, std::string text) {
    code_->doubts.push_back({code, place.line, place.column, std::move(text), variable.name});
  };
  if (use.read.line == 0) return;
  if (variable.type->basic == Basic::block) {
    // One with methods may be all of them.
    const Unit* block = find_unit(variable.type->name);
    const bool by_methods = block != nullptr && !block->methods.empty();
    if (!use.called && !by_methods && variable.section == VarClass::local)
      tell("program.never-called"_code, use.read,
           fmt::format("nothing calls {} ({}): its outputs stay as they are at power-up", variable.name,
                       variable.type->name));
    return;
  }
  const bool begins_at_0 =
      owner.initial.at(static_cast<std::size_t>(variable.offset)) == 0 && !is_initialised(variable);
  const bool own = variable.section == VarClass::local || variable.section == VarClass::temp;
  const bool located =
      std::any_of(code_->in_memory.begin(), code_->in_memory.end(),
                  [&](const Program::InMemory& one) { return one.line == variable.place.line; });
  if (own && !use.written && !variable.constant && !variable.reads_terminal && !located && begins_at_0 &&
      (is_whole(variable.type->basic) || is_real(variable.type->basic)))
    tell("program.never-set"_code, use.read,
         fmt::format("{} is read, and nothing sets it: it stays as it is at power-up", variable.name));
}

void Compiler::find_doubts() {
  std::vector<const Unit*> bodies;
  for (const auto& unit : units_)
    if (!unit->standard && unit->pou >= 0 && unit->type != nullptr && !unit->type->broken && unit->body > 0)
      bodies.push_back(unit.get());
  for (const Unit* unit : bodies) {
    // Methods set them, too.
    if (unit->framed() || unit->tells_kind()) continue;
    for (const Variable& variable : unit->type->members)
      doubt_variable(variable, *unit->type, use_of(variable, *unit));
  }
  for (const Variable& variable : globals_->members) {
    NameUse all;
    for (const Unit* unit : bodies) {
      const NameUse use = use_of(variable, *unit);
      all.called = all.called || use.called;
      all.written = all.written || use.written;
      if (all.read.line == 0) all.read = use.read;
    }
    doubt_variable(variable, *globals_, all);
  }
  for (const Unit* unit : bodies) doubt_selections(*unit);
  if (options_.tests || options_.library) doubt_tests();
}

/// Master and Slave of each call of a block of this type, where they are plain names.
std::vector<Compiler::AxisPair> Compiler::axis_pairs(const Unit& unit, std::string_view block) const {
  std::vector<AxisPair> pairs;
  for (std::size_t i = unit.body; i + 1 < unit.end; ++i) {
    const Variable* instance = tokens_[i].kind == StToken::Kind::name && tokens_[i + 1].is("(")
                                   ? find_member(*unit.type, tokens_[i].text)
                                   : nullptr;
    if (instance == nullptr || instance->type->motion == nullptr || instance->type->name != block) continue;
    AxisPair pair{tokens_[i].place, "", ""};
    for (std::size_t t = i + 2; t + 2 < unit.end && !tokens_[t].is(";"); ++t) {
      if (!tokens_[t + 1].is(":=")) continue;
      if (tokens_[t].word("MASTER")) pair.master = lower(tokens_[t + 2].text);
      if (tokens_[t].word("SLAVE")) pair.slave = lower(tokens_[t + 2].text);
    }
    if (!pair.master.empty() && !pair.slave.empty()) pairs.push_back(std::move(pair));
  }
  return pairs;
}

void Compiler::doubt_selections(const Unit& unit) {
  const auto coupled = axis_pairs(unit, "MC_CamIn");
  const auto has = [&](const std::string& master, const std::string& slave) {
    return std::any_of(coupled.begin(), coupled.end(),
                       [&](const AxisPair& pair) { return pair.master == master && pair.slave == slave; });
  };
  for (const AxisPair& pair : axis_pairs(unit, "MC_CamTableSelect"))
    if (pair.master != pair.slave && !has(pair.master, pair.slave) && has(pair.slave, pair.master))
      code_->doubts.push_back(
          {"cam.swapped-axes"_code, pair.place.line, pair.place.column,
           "MC_CamTableSelect has the Master and the Slave of MC_CamIn the other way round", ""});
}

}  // namespace drycut::devices::plcopen::st
