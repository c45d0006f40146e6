#include "devices/qmove/lexer.hpp"

#include <utility>

namespace drycut::devices::qmove {

namespace {

/// Those that begin with another one stand before it.
constexpr std::array<ForeignSign, 11> foreign_signs{{{":=", "'=' assigns"},
                                                     {"==", "EQ compares"},
                                                     {"!=", "NEQ compares"},
                                                     {"<>", "NEQ compares"},
                                                     {"<=", "LE compares"},
                                                     {">=", "GE compares"},
                                                     {"<", "LT compares"},
                                                     {">", "GT compares"},
                                                     {"&&", "AND combines"},
                                                     {"||", "OR combines"},
                                                     {"!", "NOT inverts"}}};

class LineLexer : public Lexer<QclToken> {
 public:
  using Lexer::Lexer;

  std::vector<QclToken> run() {
    while (!at_end() && peek() != ';') {
      const char c = peek();
      if (at_blank())
        advance(1);
      else if (is_letter(c))
        add(Kind::name, length(in_name));
      else if (is_digit(c))
        number();
      else if (c == '"')
        text();
      else if (foreign_sign(foreign_signs, "qcl.syntax"_code))
        continue;
      else if (std::string_view("()[],:.=+-*/%").find(c) != std::string_view::npos)
        add(Kind::sign, 1);
      else
        stranger("a comment begins with ';'");
    }
    add(Kind::end, 0);
    return std::move(tokens_);
  }

 private:
  void text() {
    QclToken& token = add(Kind::bad, length([](char c) { return c != '"'; }, 1));
    if (peek() == '"') advance(1);
    complain("qcl.syntax"_code, token, "QCL has no texts", "a number, a name or an expression stands here");
  }

  void number() {
    constexpr std::int64_t largest = 2147483648;  // allowed after a minus sign
    const Number found = number_ahead(is_digit, false);
    QclToken& token = add(Kind::number, found.whole);
    token.is_real = found.real;
    if (found.whole != found.size)
      complain("qcl.syntax"_code, token, in_quotes(token.text) + " is neither a number nor a name",
               "names begin with a letter, numbers are decimal");
    else if (found.real)
      read(token, token.text, token.real, "a single goes to 3.4e38");
    else
      read(token, token.text, token.integer, "a long goes from -2147483648 to 2147483647", largest);
  }
};

}  // namespace

std::vector<QclToken> tokens_of(std::string_view line, int number, const std::string& file,
                                Problems& problems) {
  return LineLexer(line, file, problems, number).run();
}

}  // namespace drycut::devices::qmove
