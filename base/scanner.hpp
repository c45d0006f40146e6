#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "base/text.hpp"

// What the readers of programs have in common, whatever the language: problems at their places, from a text
// to tokens, from tokens to what they say.
namespace drycut {

/// The problems of one text, behind those that are there already.
class Complaints {
 public:
  Complaints(const std::string& file, Problems& problems)
      : file_(file), problems_(problems), first_(problems.size()) {}

  void complain(Code code, Place place, std::string what, std::string remedy);

 protected:
  [[nodiscard]] std::size_t told() const { return problems_.size() - first_; }
  void sort() { sort_from(problems_, first_); }

  const std::string& file_;
  Problems& problems_;

 private:
  std::size_t first_;
};

/// A word, number or sign of a text. Each language adds its values.
struct Token {
  enum class Kind : std::uint8_t {
    name,  ///< identifier or keyword
    number,
    string,
    address,  ///< %IX0.0
    sign,
    bad,  ///< already reported; what it belongs to is given up
    end,  ///< stands behind the last one
  };
  Kind kind = Kind::end;
  std::string_view text;
  Place place;

  [[nodiscard]] bool is(std::string_view sign) const { return kind == Kind::sign && text == sign; }
  /// The keyword or name, any case.
  [[nodiscard]] bool word(std::string_view keyword) const {
    return kind == Kind::name && same_word(text, keyword);
  }
};

/// Walks through a text.
class Scanner : public Complaints {
 public:
  /// The text begins in `line`.
  Scanner(std::string_view text, const std::string& file, Problems& problems, int line = 1)
      : Complaints(file, problems), text_(text), line_(line) {}

 protected:
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  /// '\0' behind the end.
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  [[nodiscard]] bool starts(std::string_view sign) const { return text_.substr(at_).starts_with(sign); }
  /// A space, tab or line end is next.
  [[nodiscard]] bool at_blank() const { return peek() == ' ' || (peek() >= '\t' && peek() <= '\r'); }
  [[nodiscard]] Place place() const { return {line_, static_cast<int>(at_ - line_start_) + 1}; }
  void advance(std::size_t count);

  /// From here to where one does not belong any more; the first `from` of them are not looked at.
  template <typename Predicate>
  [[nodiscard]] std::size_t length(Predicate belongs, std::size_t from = 0) const {
    std::size_t end = at_ + from;
    while (end < text_.size() && belongs(text_[end])) ++end;
    return end - at_;
  }

  /// How long the decimal number is that is next.
  struct Number {
    std::size_t size = 0;
    bool real = false;      ///< it has a fraction or an exponent
    std::size_t whole = 0;  ///< with the letters and digits that follow: a number has none
  };
  /// `digit`: what its whole part and its fraction are made of; `exponents`: 1e-5 is a number.
  [[nodiscard]] Number number_ahead(bool (*digit)(char), bool exponents) const;

  using Complaints::complain;
  void complain(Code code, Token& token, std::string what, std::string remedy);
  /// The number that `digits` of the token write; told if it is above `most`, with `range` as the remedy.
  template <typename Value>
  void read(Token& token, std::string_view digits, Value& value, const char* range,
            Value most = std::numeric_limits<Value>::max()) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || value > most)
      complain("text.number-out-of-range"_code, token, in_quotes(token.text) + " is out of range", range);
  }

  std::string_view text_;
  std::size_t at_ = 0;

 private:
  std::size_t line_start_ = 0;
  int line_;
};

/// What another language writes, and what is written for it here.
using ForeignSign = std::pair<std::string_view, std::string_view>;

/// Takes a text apart into the tokens of a language.
template <typename LanguageToken>
class Lexer : public Scanner {
 public:
  using Scanner::Scanner;

 protected:
  using Kind = Token::Kind;

  LanguageToken& add(Kind kind, std::size_t size) {
    LanguageToken& token = tokens_.emplace_back();
    token.kind = kind;
    token.text = text_.substr(at_, size);
    token.place = place();
    advance(size);
    return token;
  }

  /// A sign of other languages, told with what is written for it here; false if none of them is next.
  template <std::size_t count>
  bool foreign_sign(const std::array<ForeignSign, count>& signs, Code code) {
    for (const auto& [sign, remedy] : signs) {
      if (!starts(sign)) continue;
      complain(code, add(Kind::bad, sign.size()), "there is no " + in_quotes(sign), std::string(remedy));
      return true;
    }
    return false;
  }

  /// A character that the language does not have.
  void stranger(const char* remedy) {
    // Bytes of one non-ASCII character are one stranger.
    const auto foreign = [](char c) { return static_cast<unsigned char>(c) >= 128; };
    LanguageToken& token = add(Kind::bad, std::max<std::size_t>(length(foreign), 1));
    complain("text.unexpected-character"_code, token, "unexpected character " + in_quotes(token.text),
             remedy);
  }

  std::vector<LanguageToken> tokens_;
};

/// The tokens of a text, or of a part of it, one after the other.
template <typename LanguageToken>
class TokenReader : public Complaints {
 public:
  using Complaints::Complaints;

 protected:
  /// Behind the part stands what ends it, however far one looks.
  [[nodiscard]] const LanguageToken& peek(std::size_t ahead = 0) const {
    static const LanguageToken none{};
    const std::size_t at = std::min(at_ + ahead, stop_);
    return at < tokens_.size() ? tokens_[at] : none;
  }
  const LanguageToken& take() {
    const LanguageToken& token = peek();
    if (at_ < stop_) ++at_;
    return token;
  }
  bool accept(std::string_view sign) { return pass(peek().is(sign)); }
  bool accept_word(std::string_view keyword) { return pass(peek().word(keyword)); }

  std::vector<LanguageToken> tokens_;
  std::size_t at_ = 0;
  std::size_t stop_ = 0;  ///< end of the part that is being read

 private:
  bool pass(bool wanted) {
    if (at_ >= stop_ || !wanted) return false;
    ++at_;
    return true;
  }
};

}  // namespace drycut
