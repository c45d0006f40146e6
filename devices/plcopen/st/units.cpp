#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/keywords.hpp"

// The parts of a file: where they begin and end, and the order in which they are read.
namespace drycut::devices::plcopen::st {

Compiler::Compiler(std::string_view text, const std::string& file, Problems& problems)
    : file_(file), problems_(problems), first_problem_(problems.size()) {
  tokens_ = tokens_of(standard_blocks(), file, problems);
  tokens_.pop_back();
  user_tokens_ = tokens_.size();
  for (Token& token : tokens_of(text, file, problems)) tokens_.push_back(std::move(token));
  // The first POU stands for what has none.
  code_->pous.emplace_back();
}

std::shared_ptr<const Compiled> Compiler::run() {
  globals_ = &new_type(Basic::block, "VAR_GLOBAL");
  globals_->cells = 0;
  globals_->initial.clear();
  find_units(false);
  find_units(true);
  for (const Unit::Kind kind : {Unit::Kind::type, Unit::Kind::globals, Unit::Kind::function_block,
                                Unit::Kind::function, Unit::Kind::program})
    for (const auto& unit : units_)
      if (unit->kind == kind && !unit->standard) declare(*unit);
  check_programs();
  place_memory();
  for (const auto& unit : units_)
    if (unit->pou >= 0 && unit->state == Unit::State::done) compile_body(*unit);
  check_calls();
  finish();
  sort_from(problems_, first_problem_);
  return code_;
}

void Compiler::find_units(bool standard) {
  at_ = standard ? 0 : user_tokens_;
  stop_ = standard ? user_tokens_ : tokens_.size() - 1;
  while (at_ < stop_) {
    const Token& opening = peek();
    Unit unit;
    unit.standard = standard;
    if (opening.word("TYPE")) {
      find_types();
      continue;
    }
    const std::size_t first = at_;
    if (opening.word("VAR_GLOBAL")) {
      unit.kind = Unit::Kind::globals;
      unit.name = opening;
      unit.first = at_;
      unit.end = end_of_unit(first, "END_VAR");
      add_unit(std::move(unit));
    } else if (opening.word("PROGRAM") || opening.word("FUNCTION") || opening.word("FUNCTION_BLOCK")) {
      unit.kind = opening.word("PROGRAM")    ? Unit::Kind::program
                  : opening.word("FUNCTION") ? Unit::Kind::function
                                             : Unit::Kind::function_block;
      take();
      try {
        unit.name = expect_name(fmt::format("the name of the {}", upper(opening.text)));
      } catch (const GiveUp&) {
        end_of_unit(first, "END_" + upper(opening.text));
        continue;
      }
      unit.first = at_;
      unit.end = end_of_unit(first, "END_" + upper(opening.text));
      add_unit(std::move(unit));
    } else {
      if (opening.kind != Token::Kind::bad && !opening.is(";"))
        complain(opening.place, quoted(opening.text) + " stands outside of all units",
                 "statements stand in PROGRAM ... END_PROGRAM, variables of all in VAR_GLOBAL ... END_VAR");
      while (at_ < stop_ && !peek().is(";") && !(peek().kind == Token::Kind::name && opens_unit(peek().text)))
        ++at_;
      // One complaint a stretch.
      while (at_ < stop_ && !(peek().kind == Token::Kind::name && opens_unit(peek().text))) ++at_;
      if (at_ == first) ++at_;
    }
  }
}

std::size_t Compiler::end_of_unit(std::size_t opening, std::string_view closing) {
  at_ = opening + 1;
  while (at_ < stop_) {
    if (peek().word(closing)) return at_++;
    // Only a section of variables is looked through for the words that open one: VAR_GLOBAL is one itself.
    if (peek().kind == Token::Kind::name && opens_unit(peek().text)) break;
    ++at_;
  }
  const Token& begin = tokens_[opening];
  complain(begin.place, fmt::format("{} has no {}", upper(begin.text), closing),
           at_ < stop_ ? fmt::format("write {} before the {} of line {}", closing, upper(peek().text),
                                     peek().place.line)
                       : fmt::format("write {} at the end", closing));
  return at_;
}

void Compiler::find_types() {
  const std::size_t opening = at_;
  const std::size_t file_end = stop_;
  const std::size_t end = end_of_unit(opening, "END_TYPE");
  const std::size_t next = at_;
  at_ = opening + 1;
  stop_ = end;
  while (at_ < stop_) {
    Unit unit;
    unit.kind = Unit::Kind::type;
    try {
      unit.name = expect_name("the name of a type");
      expect(":", "stands between a type's name and what it is");
    } catch (const GiveUp&) {
      at_ = find_type(at_) + 1;
      continue;
    }
    unit.first = at_;
    unit.end = find_type(at_);
    at_ = unit.end;
    // STRUCT ... END_STRUCT needs no ';' in some dialects; one that stands there is of no account.
    while (accept(";")) {
    }
    add_unit(std::move(unit));
  }
  at_ = next;
  stop_ = file_end;
}

std::size_t Compiler::find_type(std::size_t first) {
  bool structure = false;
  std::size_t i = first;
  for (; i < stop_; ++i) {
    if (tokens_[i].word("STRUCT")) structure = true;
    if (structure && tokens_[i].word("END_STRUCT")) return i + 1;
    if (tokens_[i].is(";") && !structure) return i;
  }
  return i;
}

void Compiler::add_unit(Unit unit) {
  if (unit.kind != Unit::Kind::globals) {
    if (const Unit* other = find_unit(unit.name.text)) {
      // A user's own TON stands instead of the standard one.
      if (!unit.standard)
        complain(unit.name.place, quoted(unit.name.text) + " is declared twice",
                 fmt::format("the first one is in line {}", other->name.place.line));
      return;
    }
    if (!unit.standard && (elementary_type(unit.name.text) != nullptr || find_block_type(unit.name.text) ||
                           same_word(unit.name.text, "MC_CAM_REF"))) {
      complain(unit.name.place, quoted(unit.name.text) + " is a type of the controller",
               "choose another name");
      return;
    }
  }
  units_.push_back(std::make_unique<Unit>(std::move(unit)));
}

Unit* Compiler::find_unit(std::string_view name) {
  const auto found = std::find_if(units_.begin(), units_.end(), [&](const auto& unit) {
    return unit->kind != Unit::Kind::globals && same_word(unit->name.text, name);
  });
  return found == units_.end() ? nullptr : found->get();
}

void Compiler::declare(Unit& unit) {
  if (unit.state != Unit::State::untouched) return;
  const auto saved = std::tuple(at_, stop_, unit_);
  unit.state = Unit::State::open;
  at_ = unit.first;
  stop_ = unit.end;
  unit_ = &unit;
  if (unit.kind == Unit::Kind::type)
    declare_type(unit);
  else
    declare_pou(unit);
  unit.state = Unit::State::done;
  std::tie(at_, stop_, unit_) = saved;
}

void Compiler::check_programs() {
  const Unit* program = nullptr;
  for (const auto& unit : units_) {
    if (unit->kind != Unit::Kind::program) continue;
    if (program != nullptr)
      complain(unit->name.place, "a second PROGRAM, " + quoted(unit->name.text),
               fmt::format("one PROGRAM a file: the other is {}; make this one a FUNCTION_BLOCK",
                           quoted(program->name.text)));
    else
      program = unit.get();
  }
  if (program != nullptr) {
    code_->program = program->pou;
    return;
  }
  // A PROGRAM that is there but could not be read has been told.
  if (problems_.size() == first_problem_)
    complain({1, 1}, "the file has no PROGRAM", "PROGRAM name ... END_PROGRAM is what the controller runs");
}

void Compiler::check_calls() {
  for (const auto& unit : units_) {
    std::set<int> seen;
    if (unit->pou < 0 || !calls_itself(unit->pou, seen, unit->pou)) continue;
    complain(unit->name.place, quoted(unit->name.text) + " calls itself",
             "IEC 61131-3 has no recursion: use a loop");
  }
}

bool Compiler::calls_itself(int pou, std::set<int>& seen, int wanted) const {
  const auto unit = std::find_if(units_.begin(), units_.end(), [&](const auto& u) { return u->pou == pou; });
  if (unit == units_.end()) return false;
  return std::any_of((*unit)->calls.begin(), (*unit)->calls.end(), [&](int called) {
    return called == wanted || (seen.insert(called).second && calls_itself(called, seen, wanted));
  });
}

}  // namespace drycut::devices::plcopen::st
