#include "sim/scenario/expression_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

namespace drycut::sim::scenario {

namespace {

constexpr std::size_t longest = 2000;  // muParser refuses formulas from 10 000 characters on

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class Scanner {
 public:
  Scanner(std::string_view text, std::vector<ExpressionFault>& faults) : text_(text), faults_(faults) {}

  ExpressionTokens run() {
    for (skip_blanks(); at_ < text_.size() && !failed_; skip_blanks()) {
      if (is_name_character(text_[at_])) {
        word();
      } else {
        sign();
      }
    }
    return failed_ ? ExpressionTokens{} : std::move(tokens_);
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  void fault(std::size_t offset, std::string what, std::string remedy) {
    faults_.push_back({offset, std::move(what), std::move(remedy)});
    failed_ = true;
  }
  void put(ExpressionToken::Kind kind, std::string text, std::size_t start) {
    tokens_.push_back({kind, std::move(text), start, at_});
  }

  // A number, a name or a function. A name may begin with a digit ("2.AN01").
  void word() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
    if (std::isdigit(static_cast<unsigned char>(text_[start])) != 0 || text_[start] == '.') {
      double number = 0;
      const auto read = std::from_chars(text_.data() + start, text_.data() + text_.size(), number);
      const auto end = static_cast<std::size_t>(read.ptr - text_.data());
      if (read.ec == std::errc() && end >= at_) {  // beyond at_ with a signed exponent
        at_ = end;
        put(ExpressionToken::Kind::number, std::string(text_.substr(start, end - start)), start);
        return;
      }
    }
    std::string name(text_.substr(start, at_ - start));
    if (at_ < text_.size() && text_[at_] == '[') name += index();
    const std::size_t end = at_;
    skip_blanks();
    const bool called = at_ < text_.size() && text_[at_] == '(';
    at_ = end;
    put(called ? ExpressionToken::Kind::function : ExpressionToken::Kind::name, std::move(name), start);
  }

  // "[2, 5]" as "[2,5]".
  std::string index() {
    const std::size_t open = at_;
    std::string index;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (is_blank(c)) continue;
      index += c;
      if (c == ']') {
        ++at_;
        return index;
      }
      if (c != '[' && c != ',' && std::isdigit(static_cast<unsigned char>(c)) == 0) {
        fault(at_, fmt::format("'{}' in an index", c), "an index is a number, or two: [3], [2,5]");
        return index;
      }
    }
    fault(open, "this [ is not closed", "write ] after the index");
    return index;
  }

  void sign() {
    static constexpr std::array<std::string_view, 6> pairs = {"<=", ">=", "==", "!=", "&&", "||"};
    const std::size_t start = at_;
    const auto pair = text_.substr(at_, 2);
    if (std::find(pairs.begin(), pairs.end(), pair) != pairs.end()) {
      at_ += 2;
      put(ExpressionToken::Kind::sign, std::string(pair), start);
      return;
    }
    const char c = text_[at_];
    if (c == '=') return fault(at_, "'=' does not compare", "write ==");
    if (c == '&') return fault(at_, "'&' is not known", "write &&");
    if (c == '|') return fault(at_, "'|' is not known", "write ||");
    if (std::string_view("+-*/^<>!?:,()").find(c) == std::string_view::npos) {
      std::size_t end = at_ + 1;  // the whole UTF-8 character
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
      return fault(at_, fmt::format("'{}' has no meaning in an expression", text_.substr(at_, end - at_)),
                   "use numbers, names, + - * / ^ < <= > >= == != && || ! ?: and functions");
    }
    ++at_;
    const auto kind = c == '('   ? ExpressionToken::Kind::open
                      : c == ')' ? ExpressionToken::Kind::close
                                 : ExpressionToken::Kind::sign;
    put(kind, std::string(1, c), start);
  }

  std::string_view text_;
  std::vector<ExpressionFault>& faults_;
  ExpressionTokens tokens_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

bool is_comparison(const ExpressionToken& token) {
  return is_relation(token) ||
         (token.kind == ExpressionToken::Kind::sign && (token.text == "==" || token.text == "!="));
}

// Walks the tokens once: a value, an operator, a value ... The first fault ends it.
class Grammar {
 public:
  Grammar(ExpressionTokens& tokens, std::size_t length, std::vector<ExpressionFault>& faults)
      : tokens_(tokens), length_(length), faults_(faults) {}

  void check() {
    open_.push_back({});
    for (std::size_t i = 0; i < tokens_.size() && !failed_; ++i) {
      if (value_expected_) {
        at_value(i);
      } else {
        at_operator(i);
      }
    }
    if (failed_) return;
    if (value_expected_) {
      return fault(length_, "the expression ends where a value must follow", "add a name or a number");
    }
    if (open_.size() > 1) {
      return fault(tokens_[open_.back().token].offset, "this ( is not closed", "add )");
    }
    if (open_.back().choices != 0) fault(length_, "? without :", "write condition ? value : other value");
  }

 private:
  struct Level {
    std::size_t token = 0;
    bool call = false;
    bool compared = false;
    int choices = 0;  // ? that wait for their :
  };

  void fault(std::size_t offset, std::string what, std::string remedy) {
    faults_.push_back({offset, std::move(what), std::move(remedy)});
    failed_ = true;
  }

  void at_value(std::size_t i) {
    const auto& token = tokens_[i];
    switch (token.kind) {
      case ExpressionToken::Kind::number:
      case ExpressionToken::Kind::name:
        value_expected_ = false;
        return;
      case ExpressionToken::Kind::function:
        return;
      case ExpressionToken::Kind::open:
        open_.push_back({i, i > 0 && tokens_[i - 1].kind == ExpressionToken::Kind::function});
        return;
      case ExpressionToken::Kind::close:
      case ExpressionToken::Kind::sign:
        if (token.text == "-" || token.text == "+" || token.text == "!") return;
        fault(token.offset, fmt::format("a value is missing before '{}'", token.text),
              "add a name or a number");
    }
  }

  void at_operator(std::size_t i) {
    const auto& token = tokens_[i];
    if (token.kind == ExpressionToken::Kind::close) return close(i);
    if (token.kind != ExpressionToken::Kind::sign || token.text == "!") {
      return fault(token.offset, fmt::format("an operator is missing before '{}'", token.text),
                   "add + - * / < > == && or ||; numbers carry no unit here");
    }
    value_expected_ = true;
    auto& level = open_.back();
    if (is_comparison(token)) {
      if (level.compared) {
        return fault(token.offset, "comparisons cannot be chained", "write a < b && b < c");
      }
      level.compared = true;
    } else if (token.text == "&&" || token.text == "||") {
      level.compared = false;
    } else if (token.text == "," && !level.call) {
      fault(token.offset, "',' stands only between the arguments of a function", "write . in decimals");
    } else if (token.text == "," || token.text == "?" || token.text == ":") {
      level.compared = false;
      if (token.text == "?") ++level.choices;
      if (token.text == ":" && --level.choices < 0) {
        fault(token.offset, "':' without '?'", "write condition ? value : other value");
      }
    }
  }

  void close(std::size_t i) {
    if (open_.size() == 1) return fault(tokens_[i].offset, "this ) closes nothing", "remove it");
    const auto level = open_.back();
    open_.pop_back();
    if (level.choices != 0) {
      return fault(tokens_[i].offset, "? without :", "write condition ? value : other value");
    }
    tokens_[i].partner = level.token;
    tokens_[level.token].partner = i;
  }

  ExpressionTokens& tokens_;
  std::size_t length_;
  std::vector<ExpressionFault>& faults_;
  std::vector<Level> open_;
  bool value_expected_ = true;
  bool failed_ = false;
};

}  // namespace

bool is_relation(const ExpressionToken& token) {
  return token.kind == ExpressionToken::Kind::sign &&
         (token.text == "<" || token.text == "<=" || token.text == ">" || token.text == ">=");
}

ExpressionTokens scan_expression(std::string_view text, std::vector<ExpressionFault>& faults) {
  if (text.size() > longest) {
    faults.push_back({0, fmt::format("the expression has {} characters", text.size()),
                      fmt::format("at most {}", longest)});
    return {};
  }
  const std::size_t before = faults.size();
  auto tokens = Scanner(text, faults).run();
  if (faults.size() != before) return {};
  if (tokens.empty()) {
    faults.push_back({0, "the expression is empty", "write a comparison, for example follerr < 400"});
    return {};
  }
  Grammar(tokens, text.size(), faults).check();
  return tokens;
}

}  // namespace drycut::sim::scenario
