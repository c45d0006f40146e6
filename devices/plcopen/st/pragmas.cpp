#include "devices/plcopen/st/pragmas.hpp"

#include <fmt/format.h>

namespace drycut::devices::plcopen::st {
namespace {

/// Names, texts with their first quote, and signs.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t end = at + 1;
    if (is_letter(text[at])) {
      while (end < text.size() && in_name(text[end])) ++end;
      words.emplace_back(text.substr(at, end - at));
    } else if (text[at] == '\'') {
      end = std::min(text.find('\'', end), text.size());
      words.emplace_back(text.substr(at, end - at));
      ++end;
    } else if (static_cast<unsigned char>(text[at]) > ' ') {
      words.emplace_back(1, text[at]);
    }
    at = end;
  }
  return words;
}

}  // namespace

/// A condition by recursive descent; `sound` is false if it asks for what is not known here.
struct Pragmas::Condition {
  const std::vector<std::string>& words;
  const std::map<std::string, std::string>& defined;
  std::size_t at = 1;
  int nesting = 0;
  bool sound = true;

  bool accept(std::string_view word) {
    if (at >= words.size() || !same_word(words[at], word)) return false;
    ++at;
    return true;
  }
  bool either() {
    bool result = both();
    while (accept("OR")) result = both() || result;
    return result;
  }
  bool both() {
    bool result = single();
    while (accept("AND")) result = single() && result;
    return result;
  }
  bool single() {
    bool result = true;
    while (accept("NOT")) result = !result;
    return factor() == result;
  }
  bool factor() {
    constexpr int deepest = 60;
    if (++nesting > deepest) sound = false;
    bool result = false;
    if (!sound) return result;
    if (accept("(")) {
      result = either();
      sound = accept(")") && sound;
    } else if (accept("defined")) {
      result = defined.contains(name());
      sound = accept(")") && sound;
    } else if (accept("hasvalue")) {
      const auto known = defined.find(name());
      sound = accept(",") && at < words.size() && words[at].starts_with('\'') && sound;
      if (sound) result = known != defined.end() && known->second == words[at++];
      sound = sound && accept(")");
    } else {
      sound = false;
    }
    --nesting;
    return result;
  }
  std::string name() {
    sound = accept("(") && at < words.size() && is_identifier(words[at]) && sound;
    return sound ? lower(words[at++]) : "";
  }
};

bool Pragmas::condition(const std::vector<std::string>& words, std::string_view text, Place place) {
  Condition reader{words, defined_};
  const bool holds = reader.either();
  if (reader.sound && reader.at == words.size()) return holds;
  complain("st.pragma"_code, place,
           fmt::format("the condition {} is not known here", in_quotes("{" + std::string(text) + "}")),
           "defined(NAME) and hasvalue(NAME, 'text') of {define NAME 'text'}, NOT, AND, OR, parentheses");
  return false;
}

void Pragmas::define(const std::vector<std::string>& words, Place place) {
  const bool adds = same_word(words[0], "define");
  const bool named = words.size() > 1 && is_identifier(words[1]);
  if (!named || words.size() > (adds ? 3U : 2U)) {
    complain("st.pragma"_code, place, fmt::format("{{{}}} names nothing that can be tested", words[0]),
             adds ? "{define NAME} or {define NAME 'text'}" : "{undefine NAME}");
  } else if (adds) {
    defined_[lower(words[1])] = words.size() > 2 ? words[2] : "";
  } else {
    defined_.erase(lower(words[1]));
  }
}

void Pragmas::next_part(std::string_view word, bool holds, Place place) {
  if (branches_.empty()) {
    complain("st.pragma"_code, place, fmt::format("{{{}}} without an {{IF}}", upper(word)),
             "{IF condition} opens it");
    return;
  }
  Branch& branch = branches_.back();
  if (branch.otherwise)
    complain("st.pragma"_code, place, fmt::format("{{{}}} behind the {{ELSE}}", upper(word)),
             "{ELSE} is the last part");
  branch.otherwise = same_word(word, "ELSE");
  branch.active = branch.outer && !branch.taken && holds;
  branch.taken = branch.taken || branch.active;
}

void Pragmas::read(std::string_view text, Place place) {
  const std::vector<std::string> words = words_of(text);
  if (words.empty()) return;
  const std::string word = lower(words[0]);
  if (word == "if") {
    const bool outer = active();
    const bool holds = outer && condition(words, text, place);
    branches_.push_back({place, outer, holds, holds});
  } else if (word == "elsif") {
    const bool open = !branches_.empty() && branches_.back().outer && !branches_.back().taken;
    next_part(word, open && condition(words, text, place), place);
  } else if (word == "else") {
    next_part(word, true, place);
  } else if (word == "end_if") {
    if (branches_.empty())
      complain("st.pragma"_code, place, "{END_IF} without an {IF}", "{IF condition} opens it");
    else
      branches_.pop_back();
  } else if (active() && (word == "define" || word == "undefine")) {
    define(words, place);
  } else if (active() && word == "error") {
    complain("st.pragma"_code, place,
             "the program says: " + in_quotes(words.size() > 1 ? words[1].substr(1) : ""),
             "compile it under the {define} that it asks for");
  }
}

void Pragmas::finish() {
  for (const Branch& branch : branches_)
    complain("st.pragma"_code, branch.opened, "{IF} has no {END_IF}", "{END_IF} ends what it decides on");
}

}  // namespace drycut::devices::plcopen::st
