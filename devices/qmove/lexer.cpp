#include "devices/qmove/lexer.hpp"

#include <charconv>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace drycut::devices::qmove {

namespace {

/// Walks along one line.
class LineLexer {
 public:
  LineLexer(std::string_view line, int number, const std::string& file, Problems& problems)
      : line_(line), number_(number), file_(file), problems_(problems) {}

  std::vector<Token> run() {
    while (at_ < line_.size() && line_[at_] != ';') {
      const char c = line_[at_];
      if (c == ' ' || (c >= '\t' && c <= '\r'))
        ++at_;
      else if (is_letter(c))
        add(Token::Kind::word, length([](char x) { return is_letter(x) || is_digit(x); }));
      else if (is_digit(c))
        number();
      else if (std::string_view("()[],:.=+-*/%").find(c) != std::string_view::npos)
        add(Token::Kind::sign, 1);
      else
        stranger();
    }
    add(Token::Kind::end_of_line, 0);
    return std::move(tokens_);
  }

 private:
  template <typename Predicate>
  [[nodiscard]] std::size_t length(Predicate belongs) const {
    std::size_t end = at_;
    while (end < line_.size() && belongs(line_[end])) ++end;
    return end - at_;
  }

  Token& add(Token::Kind kind, std::size_t size) {
    tokens_.push_back({kind, line_.substr(at_, size), {number_, static_cast<int>(at_) + 1}});
    at_ += size;
    return tokens_.back();
  }

  void complain(Token& token, const std::string& what, const std::string& remedy) {
    token.kind = Token::Kind::bad;
    problems_.push_back({file_, token.place.line, token.place.column, what, remedy});
  }

  void number() {
    std::size_t size = length(is_digit);
    const bool real =
        at_ + size + 1 < line_.size() && line_[at_ + size] == '.' && is_digit(line_[at_ + size + 1]);
    if (real) {
      ++size;
      while (at_ + size < line_.size() && is_digit(line_[at_ + size])) ++size;
    }
    const bool malformed = at_ + size < line_.size() && is_letter(line_[at_ + size]);
    while (malformed && at_ + size < line_.size() &&
           (is_letter(line_[at_ + size]) || is_digit(line_[at_ + size])))
      ++size;
    Token& token = add(real ? Token::Kind::real : Token::Kind::integer, size);
    if (malformed)
      complain(token, in_quotes(token.text) + " is neither a number nor a name",
               "names begin with a letter, numbers are decimal");
    else if (real)
      read_real(token);
    else
      read_integer(token);
  }

  void read_real(Token& token) {
    const auto [end, error] =
        std::from_chars(token.text.data(), token.text.data() + token.text.size(), token.real);
    if (error != std::errc{})
      complain(token, in_quotes(token.text) + " is out of range", "a single goes to 3.4e38");
  }

  void read_integer(Token& token) {
    constexpr std::int64_t largest = 2147483648;  // allowed after a minus sign
    for (const char c : token.text) {
      token.integer = token.integer * 10 + (c - '0');
      if (token.integer > largest) {
        complain(token, in_quotes(token.text) + " is out of range",
                 "a long goes from -2147483648 to 2147483647");
        return;
      }
    }
  }

  void stranger() {
    const char c = line_[at_];
    // Bytes of one non-ASCII character are one stranger.
    const bool ascii = static_cast<unsigned char>(c) < 128;
    const std::size_t size = ascii ? 1 : length([](char x) { return static_cast<unsigned char>(x) >= 128; });
    const bool compares = c == '<' || c == '>' || c == '!';
    Token& token = add(Token::Kind::bad, size);
    complain(token, "unexpected character " + in_quotes(token.text),
             compares ? "compare with EQ, NEQ, LT, LE, GT or GE" : "a comment begins with ';'");
  }

  std::string_view line_;
  int number_;
  const std::string& file_;
  Problems& problems_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view line, int number, const std::string& file, Problems& problems) {
  return LineLexer(line, number, file, problems).run();
}

}  // namespace drycut::devices::qmove
