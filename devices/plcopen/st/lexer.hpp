#pragma once
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/scanner.hpp"
#include "devices/plcopen/st/keywords.hpp"
#include "devices/plcopen/st/types.hpp"

namespace drycut::devices::plcopen::st {

/// A word, literal or sign of a Structured Text file. Signs are
/// ( ) [ ] , ; : . + - * / < > = & # := => ** <= >= <> .. and times and dates are numbers too.
struct StToken : drycut::Token {
  Basic basic = Basic::unknown;  ///< of a number: LINT, above it ULINT, LREAL, TIME, TOD, DATE, DT, or long
  Cell value = 0;
  std::string string;  ///< without quotes and escapes
  bool wide = false;   ///< "text": of WSTRING

  [[nodiscard]] bool whole() const { return kind == Kind::number && is_integer(basic); }
};

/// The parts of a TIME, the largest first.
struct TimeUnit {
  std::string_view name;
  Cell ms;
};
inline constexpr std::array<TimeUnit, 5> time_units{
    {{"d", 86'400'000}, {"h", 3'600'000}, {"m", 60'000}, {"s", 1000}, {"ms", 1}}};
/// The same of an LTIME.
struct LongTimeUnit {
  std::string_view name;
  Cell ns;
};
inline constexpr std::array<LongTimeUnit, 7> long_time_units{{{"d", 86'400'000'000'000},
                                                              {"h", 3'600'000'000'000},
                                                              {"m", 60'000'000'000},
                                                              {"s", 1'000'000'000},
                                                              {"ms", 1'000'000},
                                                              {"us", 1000},
                                                              {"ns", 1}}};

/// The tokens of a file, comments, pragmas `{...}` and what they switch off left out, ended by one of
/// Kind::end; the first line has the number `first_line`.
std::vector<StToken> tokens_of(std::string_view text, const std::string& file, Problems& problems,
                               int first_line = 1);

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
class Reader : public TokenReader<StToken> {
 public:
  using TokenReader::TokenReader;

  [[noreturn]] void give_up(Code code, Place place, std::string what, std::string remedy);

 protected:
  void expect(std::string_view sign, std::string_view where);
  void expect_word(std::string_view keyword, std::string_view where);
  StToken expect_name(const std::string& what);
  [[nodiscard]] Place behind() const;
  /// The next token is a word by which `is_one` knows it: closes_block, opens_unit, is_keyword.
  [[nodiscard]] bool at_word(bool (*is_one)(std::string_view)) const {
    return peek().kind == StToken::Kind::name && is_one(peek().text);
  }
  /// Goes on to where `here` holds, or to the end of the part.
  void skip_to(const std::function<bool()>& here);
  /// Goes on to `word`, or behind the next ';'.
  void skip_past(std::string_view word);
  void skip_statement();
  /// The remedy for a word that is not known; a file full of them is not searched for each.
  std::string suggested(std::string_view word, const std::function<std::vector<std::string>()>& known,
                        const std::string& otherwise) const;
  /// "line 5", of another file than that of `seen_from` "line 5 of knife.st".
  [[nodiscard]] std::string line_of(Place place, Place seen_from) const {
    return lines_.told(place.line, seen_from.line);
  }
  [[nodiscard]] std::string line_of(Place place) const { return line_of(place, place); }

  /// A name that is declared in two files is told in both.
  void tell_twice(const StToken& name, std::string_view first, Place other);

  SourceLines lines_;
};

/// The names of what has a `name`, for messages.
std::vector<std::string> names_of(const auto& named) {
  std::vector<std::string> names;
  names.reserve(std::size(named));
  for (const auto& one : named) names.emplace_back(one.name);
  return names;
}

}  // namespace drycut::devices::plcopen::st
