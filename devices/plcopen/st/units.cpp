#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/lexer.hpp"

// The parts of a file: where they begin and end, and the order in which they are read.
namespace drycut::devices::plcopen::st {

Compiler::Compiler(std::span<const SourceFile> files, const CompileOptions& options, Problems& problems)
    : Statements(files.front().name, problems), options_(options) {
  dialect_ = options.dialect;
  lines_ = SourceLines(files);
  tokens_ = tokens_of(standard_blocks(), file_, problems);
  tokens_.pop_back();
  user_tokens_ = tokens_.size();
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (i > 0) tokens_.pop_back();  // the end of the one before
    for (StToken& token : tokens_of(files[i].text, file_, problems, lines_.first(i)))
      tokens_.push_back(std::move(token));
  }
  // The first POU stands for what has none.
  code_->pous.emplace_back();
  code_->files.assign(files.begin(), files.end());
  code_->lines = lines_;
}

std::shared_ptr<const Compiled> Compiler::run() {
  globals_ = &new_type(Basic::block, "VAR_GLOBAL", true);
  outside_.kind = Unit::Kind::globals;
  outside_.type = globals_;
  find_units(false);
  find_units(true);
  find_bases();
  asserts_ = options_.tests || (options_.library && has_tests());
  // Types may have constants as bounds.
  for (const auto& unit : units_)
    if (unit->kind == Unit::Kind::globals && tokens_[unit->first + 1].word("CONSTANT")) declare(*unit);
  for (const Unit::Kind kind :
       {Unit::Kind::type, Unit::Kind::globals, Unit::Kind::function_block, Unit::Kind::function,
        Unit::Kind::program, Unit::Kind::interface, Unit::Kind::method})
    for (const auto& unit : units_)
      if (unit->kind == kind && !unit->standard) declare(*unit);
  declare_addresses(user_tokens_);
  check_methods();
  check_programs();
  if (options_.tests)
    find_tests();
  else
    read_configuration();
  place_memory();
  compile_bodies();
  connect_instances();
  unit_ = nullptr;
  fill_method_table();
  check_calls();
  if (told() == 0) find_doubts();
  finish();
  sort();
  place_in_files();
  return code_;
}

/// The standard blocks and functions come last; one may need another one.
void Compiler::compile_bodies() {
  std::set<int> compiled;
  for (bool more = true; std::exchange(more, false);) {
    for (const auto& unit : units_) {
      if (unit->pou < 0 || unit->state != Unit::State::done || !compiled.insert(unit->pou).second) continue;
      compile_body(*unit);
      more = true;
      if (!unit->standard) nodes_.of_text = nodes_.nodes.size();
    }
  }
}

void Compiler::find_units(bool standard) {
  at_ = standard ? 0 : user_tokens_;
  stop_ = standard ? user_tokens_ : tokens_.size() - 1;
  while (at_ < stop_) {
    const StToken& opening = peek();
    const std::size_t first = at_;
    if (opening.word("TYPE")) {
      find_types();
    } else if (opening.word("CONFIGURATION")) {
      find_configuration();
    } else if (opening.word("VAR_GLOBAL")) {
      add_globals();
    } else if (opening.word("PROGRAM") || opening.word("FUNCTION") || opening.word("FUNCTION_BLOCK") ||
               opening.word("INTERFACE")) {
      Unit unit;
      unit.standard = standard;
      unit.kind = opening.word("PROGRAM")    ? Unit::Kind::program
                  : opening.word("INTERFACE") ? Unit::Kind::interface
                  : opening.word("FUNCTION") ? Unit::Kind::function
                                             : Unit::Kind::function_block;
      take();
      read_modifiers(unit);
      try {
        unit.name = expect_name(fmt::format("the name of the {}", upper(opening.text)));
      } catch (const GiveUp&) {
        end_of_unit(first, "END_" + upper(opening.text));
        continue;
      }
      if (unit.kind != Unit::Kind::function) read_header(unit);
      unit.first = at_;
      unit.end = end_of_unit(first, "END_" + upper(opening.text));
      const bool methods = unit.kind != Unit::Kind::function;
      const std::size_t before = units_.size();
      add_unit(std::move(unit));
      if (methods && units_.size() > before) find_methods(*units_.back());
    } else {
      if (opening.kind != StToken::Kind::bad && !opening.is(";"))
        complain("st.declaration"_code, opening.place,
                 in_quotes(opening.text) + " stands outside of all units",
                 "statements stand in PROGRAM ... END_PROGRAM, variables of all in VAR_GLOBAL ... END_VAR");
      // One complaint a stretch.
      skip_to([&] { return at_word(opens_unit); });
      if (at_ == first) ++at_;
    }
  }
}

void Compiler::add_globals() {
  Unit unit;
  unit.kind = Unit::Kind::globals;
  unit.name = peek();
  unit.first = at_;
  unit.end = end_of_unit(at_, "END_VAR");
  const std::size_t first = unit.first;
  const std::size_t end = unit.end;
  add_unit(std::move(unit));
  for (std::size_t i = first; i < end; ++i)
    if (tokens_[i].kind == StToken::Kind::name &&
        (tokens_[i + 1].is(":") || tokens_[i + 1].is(",") || tokens_[i + 1].word("AT")))
      global_sections_.emplace(lower(tokens_[i].text), units_.back().get());
}

std::size_t Compiler::end_of_unit(std::size_t opening, std::string_view closing) {
  at_ = opening + 1;
  skip_to([&] { return peek().word(closing) || at_word(opens_unit); });
  if (at_ < stop_ && peek().word(closing)) return at_++;
  const StToken& begin = tokens_[opening];
  // What swallows the rest of a file has been told.
  if (at_ == stop_ && tokens_[at_ - 1].kind == StToken::Kind::bad) return at_;
  complain("st.syntax"_code, begin.place, fmt::format("{} has no {}", upper(begin.text), closing),
           at_ < stop_ ? fmt::format("write {} before the {} of {}", closing, upper(peek().text),
                                     line_of(peek().place, begin.place))
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
    if (structure && tokens_[i].word("END_STRUCT")) {
      if (i + 1 >= stop_ || !tokens_[i + 1].is(":=")) return i + 1;
      structure = false;
    }
    if (tokens_[i].is(";") && !structure) return i;
  }
  return i;
}

void Compiler::add_unit(Unit unit) {
  if (unit.kind != Unit::Kind::globals) {
    if (const Unit* other = find_unit(unit.name.text)) {
      // A user's own TON stands instead of the standard one.
      if (!unit.standard) tell_twice(unit.name, other->name.text, other->name.place);
      return;
    }
    // CHAR, LTIME and their like came later than many programs.
    const Type* type = elementary_type(unit.name.text);
    const bool elementary = type != nullptr && !is_character(type->basic) && !type->is_long();
    if (!unit.standard &&
        (elementary || find_block_type(unit.name.text) || same_word(unit.name.text, "MC_CAM_REF"))) {
      complain("st.declaration"_code, unit.name.place,
               in_quotes(unit.name.text) + " is a type of the controller", "choose another name");
      return;
    }
  }
  units_.push_back(std::make_unique<Unit>(std::move(unit)));
  if (units_.back()->kind != Unit::Kind::globals)
    unit_index_.emplace(lower(units_.back()->name.text), units_.back().get());
}

/// Until here a line's number said its file too.
void Compiler::place_in_files() {
  for (std::size_t i = problems_.size() - told(); i < problems_.size(); ++i) {
    const auto [file, line] = lines_.at(problems_[i].line);
    problems_[i].file = code_->files.at(file).name;
    problems_[i].line = line;
  }
}

void Compiler::check_programs() {
  if (options_.library || options_.tests) return;
  const auto is_program = [](const auto& unit) { return unit->kind == Unit::Kind::program; };
  // A PROGRAM that is there but could not be read has been told.
  if (std::none_of(units_.begin(), units_.end(), is_program) && told() == 0)
    complain("st.syntax"_code, {1, 1}, "the file has no PROGRAM",
             "PROGRAM name ... END_PROGRAM is what the controller runs");
}

/// No call leads back to where it came from, and none goes deeper than can be done.
void Compiler::check_calls() {
  std::vector<Unit*> of_pou(code_->pous.size(), nullptr);
  for (const auto& unit : units_)
    if (unit->pou >= 0) of_pou[static_cast<std::size_t>(unit->pou)] = unit.get();
  struct Step {
    Unit* unit;
    std::set<int>::const_iterator next;
  };
  enum class Seen : std::uint8_t { no, open, done };
  std::vector<Seen> seen(of_pou.size(), Seen::no);
  for (Unit* const first : of_pou) {
    if (first == nullptr || seen[static_cast<std::size_t>(first->pou)] != Seen::no) continue;
    std::vector<Step> way{{first, first->calls.begin()}};
    seen[static_cast<std::size_t>(first->pou)] = Seen::open;
    while (!way.empty()) {
      Step& step = way.back();
      if (step.next == step.unit->calls.end()) {
        seen[static_cast<std::size_t>(step.unit->pou)] = Seen::done;
        Unit* const called = step.unit;
        way.pop_back();
        called->levels += called->levels_below;
        if (!way.empty())
          way.back().unit->levels_below = std::max(way.back().unit->levels_below, called->levels);
        continue;
      }
      Unit* const called = of_pou[static_cast<std::size_t>(*step.next++)];
      if (called == nullptr) continue;
      Seen& state = seen[static_cast<std::size_t>(called->pou)];
      if (state == Seen::done) {
        step.unit->levels_below = std::max(step.unit->levels_below, called->levels);
      } else if (state == Seen::no) {
        state = Seen::open;
        way.push_back({called, called->calls.begin()});
      } else {
        tell_recursion(*called, *step.unit);
      }
    }
  }
  check_depth();
}

void Compiler::tell_recursion(const Unit& called, const Unit& caller) {
  complain("st.recursion"_code, called.name.place, in_quotes(called.name.text) + " calls itself",
           &called == &caller ? "IEC 61131-3 has no recursion: use a loop"
                              : fmt::format("IEC 61131-3 has no recursion, here by {}: use a loop",
                                            in_quotes(caller.name.text)));
}

/// What makes the instructions calls itself for each statement and operation within another, the machine for
/// each call.
void Compiler::check_depth() {
  constexpr int most_levels = 4000;
  for (const auto& unit : units_) {
    // The first that is too deep is told, not all that call it.
    if (unit->levels <= most_levels || unit->levels_below > most_levels) continue;
    complain("st.too-large"_code, unit->name.place,
             fmt::format("the calls, statements and operations of {} go {} levels deep",
                         in_quotes(unit->name.text), unit->levels),
             fmt::format("{} at most: let it call less that calls more", most_levels));
  }
}

}  // namespace drycut::devices::plcopen::st
