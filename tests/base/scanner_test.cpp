#include "base/scanner.hpp"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

namespace drycut {
namespace {

using testing::ElementsAre;

/// Names, numbers and '+'.
class SumLexer : public Lexer<Token> {
 public:
  using Lexer::Lexer;

  std::vector<Token> run() {
    while (!at_end()) {
      if (at_blank())
        advance(1);
      else if (is_letter(peek()))
        add(Kind::name, length(in_name));
      else if (is_digit(peek()))
        number();
      else if (starts("+"))
        add(Kind::sign, 1);
      else
        stranger("write +");
    }
    add(Kind::end, 0);
    return std::move(tokens_);
  }

  double sum = 0;

 private:
  void number() {
    const Number found = number_ahead(is_digit, true);
    Token& token = add(Kind::number, found.whole);
    double value = 0;
    read(token, token.text.substr(0, found.size), value, "100 at most", 100.0);
    sum += value;
  }
};

std::vector<std::string> problems_in(std::string_view text) {
  Problems problems;
  SumLexer(text, "f", problems).run();
  std::vector<std::string> lines;
  for (const Problem& problem : problems) lines.push_back(to_string(problem));
  return lines;
}

TEST(Scanner, TokensHaveTheirPlaces) {
  Problems problems;
  SumLexer lexer("a1 +\n\t2.5e1+ 3", "f", problems);
  const std::vector<Token> tokens = lexer.run();
  std::vector<std::string> shown;
  for (const Token& token : tokens)
    shown.push_back(std::to_string(token.place.line) + ":" + std::to_string(token.place.column) + " " +
                    std::string(token.text));
  EXPECT_THAT(shown, ElementsAre("1:1 a1", "1:4 +", "2:2 2.5e1", "2:7 +", "2:9 3", "2:10 "));
  EXPECT_EQ(lexer.sum, 28);
  EXPECT_TRUE(tokens[0].word("A1"));
  EXPECT_TRUE(tokens[1].is("+"));
  EXPECT_EQ(tokens.back().kind, Token::Kind::end);
  EXPECT_TRUE(problems.empty());
}

// Bytes of one non-ASCII character are one stranger.
TEST(Scanner, FaultsAreToldWhereTheyAre) {
  EXPECT_THAT(problems_in("1 \xC3\xA9\n * 101"),
              ElementsAre("f:1:3: unexpected character '\\xC3\\xA9'; write + [text.unexpected-character]",
                          "f:2:2: unexpected character '*'; write + [text.unexpected-character]",
                          "f:2:4: '101' is out of range; 100 at most [text.number-out-of-range]"));
}

}  // namespace
}  // namespace drycut
