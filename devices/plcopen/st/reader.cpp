#include "devices/plcopen/st/lexer.hpp"

#include <fmt/format.h>

namespace drycut::devices::plcopen::st {
namespace {

std::string found(const StToken& token) {
  return token.kind == StToken::Kind::end ? "the end of the file" : in_quotes(token.text);
}

/// "1.5" of the tokens 1 , 5 that stand together, `at` being the comma; "" of others.
std::string decimal_comma(const std::vector<StToken>& tokens, std::size_t at) {
  if (at == 0 || at + 1 >= tokens.size() || !tokens[at].is(",")) return "";
  const auto joins = [&](std::size_t i) {
    return tokens[i].kind == StToken::Kind::number && tokens[i].place.line == tokens[at].place.line;
  };
  const auto& before = tokens[at - 1];
  const auto& after = tokens[at + 1];
  const int column = tokens[at].place.column;
  const bool together = joins(at - 1) && joins(at + 1) &&
                        before.place.column + static_cast<int>(before.text.size()) == column &&
                        after.place.column == column + 1;
  return together ? fmt::format("{}.{}", before.text, after.text) : "";
}

}  // namespace

Place Reader::behind() const {
  if (at_ == 0) return peek().place;
  const StToken& last = tokens_[at_ - 1];
  return {last.place.line, last.place.column + static_cast<int>(last.text.size())};
}

std::string Reader::suggested(std::string_view word, const std::function<std::vector<std::string>()>& known,
                              const std::string& otherwise) const {
  constexpr std::size_t enough = 50;
  return told() < enough ? suggestion(word, known(), otherwise) : otherwise;
}

void Reader::give_up(Code code, Place place, std::string what, std::string remedy) {
  // What the lexer could not read has been told.
  if (peek().kind != StToken::Kind::bad) complain(code, place, std::move(what), std::move(remedy));
  throw GiveUp{};
}

void Reader::expect(std::string_view sign, std::string_view where) {
  if (accept(sign)) return;
  if (peek().kind == StToken::Kind::bad) throw GiveUp{};
  if (sign == ":=" && peek().is("=")) give_up("st.syntax"_code, peek().place, "'=' compares", "':=' assigns");
  if (const auto number = decimal_comma(tokens_, at_); !number.empty())
    give_up("st.syntax"_code, peek().place, "a decimal comma", fmt::format("write {}", number));
  // A sign that is missing at a line's end is missing there, not where the next line begins.
  const bool next_line = at_ > 0 && tokens_[at_ - 1].place.line != peek().place.line;
  const std::string what = fmt::format("'{}' is missing before {}", sign, found(peek()));
  const std::string remedy = fmt::format("'{}' {}", sign, where);
  if (!next_line)
    give_up("st.syntax"_code, peek().kind == StToken::Kind::end ? behind() : peek().place, what, remedy);
  complain("st.syntax"_code, behind(), what, remedy);
  // The next line is a statement of its own.
  if (sign != ";") throw GiveUp{};
}

void Reader::expect_word(std::string_view keyword, std::string_view where) {
  if (accept_word(keyword)) return;
  give_up("st.syntax"_code, peek().place, fmt::format("{} is missing before {}", keyword, found(peek())),
          std::string(where));
}

StToken Reader::expect_name(const std::string& what) {
  const bool keyword = at_word(is_keyword);
  if (at_ < stop_ && peek().kind == StToken::Kind::name && !keyword) return take();
  give_up("st.syntax"_code, peek().place, fmt::format("{} is missing before {}", what, found(peek())),
          keyword ? fmt::format("{} is a word of the language, no name", upper(peek().text))
                  : "a name begins with a letter");
}

void Reader::skip_to(const std::function<bool()>& here) {
  while (at_ < stop_ && !here()) ++at_;
}

void Reader::skip_past(std::string_view word) {
  while (at_ < stop_ && !peek().word(word) && !take().is(";")) {
  }
}

void Reader::tell_twice(const StToken& name, std::string_view first, Place other) {
  complain("st.declared-twice"_code, name.place, in_quotes(name.text) + " is declared twice",
           "the first one is in " + line_of(other, name.place));
  if (lines_.at(other.line).file != lines_.at(name.place.line).file)
    complain("st.declared-twice"_code, other, in_quotes(first) + " is declared twice",
             "the other one is in " + line_of(name.place, other));
}

void Reader::skip_statement() {
  while (at_ < stop_) {
    if (at_word(closes_block)) return;
    if (take().is(";")) return;
  }
}

}  // namespace drycut::devices::plcopen::st
