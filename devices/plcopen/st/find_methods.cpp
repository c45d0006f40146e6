#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// METHOD, PROPERTY and ACTION of blocks and programs, EXTENDS and IMPLEMENTS: where they stand.
namespace drycut::devices::plcopen::st {
namespace {

constexpr std::array<std::string_view, 7> modifiers{"PUBLIC",   "PRIVATE", "PROTECTED", "INTERNAL",
                                                    "ABSTRACT", "FINAL",   "OVERRIDE"};

/// METHOD, PROPERTY or ACTION, with a name behind it.
bool begins_method(const StToken& word, const StToken& next) {
  return (word.word("METHOD") || word.word("PROPERTY") || word.word("ACTION")) &&
         next.kind == StToken::Kind::name;
}

}  // namespace

void Compiler::read_modifiers(Unit& unit) {
  while (peek().kind == StToken::Kind::name && is_one_of(modifiers, peek().text) &&
         peek(1).kind == StToken::Kind::name) {
    const StToken& word = take();
    unit.abstract = unit.abstract || word.word("ABSTRACT");
    unit.final = unit.final || word.word("FINAL");
    unit.closed = unit.closed || word.word("PRIVATE") || word.word("PROTECTED");
  }
}

/// EXTENDS base IMPLEMENTS one, another
void Compiler::read_header(Unit& unit) {
  try {
    if (accept_word("EXTENDS")) unit.base_name = expect_name("the name of what it EXTENDS");
    if (!accept_word("IMPLEMENTS")) return;
    do {
      unit.interfaces.push_back(expect_name("the name of an INTERFACE"));
    } while (accept(","));
  } catch (const GiveUp&) {
  }
}

/// Where the METHOD, PROPERTY or ACTION at `first` ends: behind its END_.
std::size_t Compiler::end_of_method(std::size_t first, std::size_t unit_end) {
  const std::string closing = "END_" + upper(tokens_[first].text);
  std::size_t end = first + 1;
  while (end < unit_end && !tokens_[end].word(closing) && !begins_method(tokens_[end], tokens_[end + 1]))
    ++end;
  if (end < unit_end && tokens_[end].word(closing)) return end + 1;
  complain("st.syntax"_code, tokens_[first].place,
           fmt::format("{} has no {}", upper(tokens_[first].text), closing),
           fmt::format("write {} at its end", closing));
  return end;
}

/// Their tokens go behind the statements of the body, which may stand between them.
void Compiler::find_methods(Unit& unit) {
  std::vector<StToken> rest;
  std::vector<StToken> moved;
  std::vector<std::size_t> lengths;
  for (std::size_t i = unit.first; i < unit.end;) {
    if (!begins_method(tokens_[i], tokens_[i + 1])) {
      rest.push_back(tokens_[i++]);
      continue;
    }
    const std::size_t end = end_of_method(i, unit.end);
    lengths.push_back(end - i);
    for (; i < end; ++i) moved.push_back(tokens_[i]);
  }
  auto to = std::copy(rest.begin(), rest.end(), tokens_.begin() + static_cast<std::ptrdiff_t>(unit.first));
  std::copy(moved.begin(), moved.end(), to);
  unit.end = unit.first + rest.size();
  std::size_t first = unit.end;
  for (const std::size_t length : lengths) {
    const std::size_t end = first + length;
    const bool closed = tokens_[end - 1].word("END_" + upper(tokens_[first].text));
    if (tokens_[first].word("PROPERTY"))
      find_property(unit, first + 1, closed ? end - 1 : end);
    else
      find_method_text(unit, first, closed ? end - 1 : end);
    first = end;
  }
}

/// METHOD modifiers name : type; ACTION name:
void Compiler::find_method_text(Unit& owner, std::size_t first, std::size_t end) {
  const auto saved = std::pair(at_, stop_);
  const bool action = tokens_[first].word("ACTION");
  at_ = first + 1;
  stop_ = end;
  Unit method;
  read_modifiers(method);
  method.name = take();
  if (action) accept(":");
  method.first = at_;
  method.end = end;
  std::tie(at_, stop_) = saved;
  add_method(owner, std::move(method), "");
}

/// PROPERTY name : type GET ... END_GET SET ... END_SET: a method that gives it, one with an input of its
/// name.
void Compiler::find_property(Unit& owner, std::size_t first, std::size_t end) {
  const auto next_part = [&](std::size_t at) {
    while (at < end && !tokens_[at].word("GET") && !tokens_[at].word("SET")) ++at;
    return at;
  };
  while (first < end && is_one_of(modifiers, tokens_[first].text) &&
         tokens_[first + 1].kind == StToken::Kind::name)
    ++first;
  const std::size_t type_end = next_part(first);
  if (!tokens_[first + 1].is(":") || type_end >= end) {
    complain("st.syntax"_code, tokens_[first].place,
             fmt::format("PROPERTY {} is not whole", tokens_[first].text),
             "PROPERTY name : type GET ... END_GET SET ... END_SET END_PROPERTY");
    return;
  }
  for (std::size_t at = type_end; at < end;) {
    const bool get = tokens_[at].word("GET");
    Unit method;
    method.name = tokens_[first];
    method.first = at + 1;
    method.property_type = first + 2;
    method.property_end = type_end;
    method.procedure = !get;
    while (at < end && !tokens_[at].word(get ? "END_GET" : "END_SET")) ++at;
    method.end = at;
    add_method(owner, std::move(method), get ? get_mark : set_mark);
    at = next_part(at);
  }
}

void Compiler::add_method(Unit& owner, Unit method, std::string_view mark) {
  method.kind = Unit::Kind::method;
  method.owner = &owner;
  method.key = lower(method.name.text) + std::string(mark);
  const auto [known, fresh] = owner.methods.emplace(method.key, nullptr);
  if (!fresh) return tell_twice(method.name, known->second->name.text, known->second->name.place);
  method_names_.insert(method.key);
  units_.push_back(std::make_unique<Unit>(std::move(method)));
  known->second = units_.back().get();
}

void Compiler::find_bases() {
  for (const auto& unit : units_) {
    const StToken& name = unit->base_name;
    if (name.text.empty()) continue;
    Unit* const base = find_unit(name.text);
    if (base == nullptr || base->kind != unit->kind || base->standard) {
      complain("st.unknown-name"_code, name.place,
               fmt::format("there is no {} {}",
                           unit->kind == Unit::Kind::interface ? "INTERFACE" : "FUNCTION_BLOCK",
                           in_quotes(name.text)),
               "EXTENDS names another one of its kind");
      continue;
    }
    if (base->final)
      complain("st.declaration"_code, name.place, fmt::format("{} is FINAL", in_quotes(base->name.text)),
               "nothing EXTENDS it: hold an instance of it");
    const Unit* way = base;
    while (way != nullptr && way != unit.get()) way = way->base;
    if (way != nullptr) {
      complain("st.recursion"_code, name.place, fmt::format("{} extends itself", in_quotes(unit->name.text)),
               "EXTENDS goes one way");
      continue;
    }
    unit->base = base;
    base->extended = true;
  }
}

}  // namespace drycut::devices::plcopen::st
