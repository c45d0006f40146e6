#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/plcopen/st/lexer.hpp"

namespace drycut::devices::plcopen::st {

/// Thrown when a statement or a declaration is given up; its problem has been told.
struct GiveUp {};

/// Counts how deep the reader is in something, also when that is given up.
class Nested {
 public:
  explicit Nested(int& count) : count_(count) { ++count_; }
  ~Nested() { --count_; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  int& count_;
};

/// The tokens of a file, which are read unit by unit.
class Reader : public TokenReader<Token> {
 public:
  using TokenReader::TokenReader;

  [[noreturn]] void give_up(Place place, std::string what, std::string remedy);

 protected:
  void expect(std::string_view sign, std::string_view where);
  void expect_word(std::string_view keyword, std::string_view where);
  Token expect_name(const std::string& what);
  [[nodiscard]] Place behind() const;
  /// The next token is a word by which `is_one` knows it: closes_block, opens_unit, is_keyword.
  [[nodiscard]] bool at_word(bool (*is_one)(std::string_view)) const {
    return peek().kind == Token::Kind::name && is_one(peek().text);
  }
  /// Goes on to where `here` holds, or to the end of the part.
  void skip_to(const std::function<bool()>& here);
  /// Goes on to `word`, or behind the next ';'.
  void skip_past(std::string_view word);
  void skip_statement();
  /// The remedy for a word that is not known; a file full of them is not searched for each.
  std::string suggested(std::string_view word, const std::function<std::vector<std::string>()>& known,
                        const std::string& otherwise) const;
};

/// The names of what has a `name`, for messages.
std::vector<std::string> names_of(const auto& named) {
  std::vector<std::string> names;
  for (const auto& one : named) names.emplace_back(one.name);
  return names;
}

}  // namespace drycut::devices::plcopen::st
