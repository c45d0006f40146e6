#include "sim/scenario/expression_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "base/text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr std::size_t longest = 2000;  // parentheses nest by calls

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}
// The degree sign and the Greek mu are several bytes from 0x80 on.
bool is_unit_character(char c) {
  return (is_name_character(c) && c != '_') || c == '%' || static_cast<unsigned char>(c) >= 0x80;
}
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class ExpressionScanner {
 public:
  ExpressionScanner(std::string_view text, std::vector<ExpressionFault>& faults)
      : text_(text), faults_(faults) {}

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
  void fault(Code code, std::size_t offset, std::string what, std::string remedy) {
    faults_.push_back({code, offset, std::move(what), std::move(remedy)});
    failed_ = true;
  }
  void put(ExpressionToken::Kind kind, std::string text, std::size_t start) {
    tokens_.push_back({kind, std::move(text), start, at_});
  }

  // A number, with its unit if it has one, a name or a function. A name may begin with a digit ("2.AN01").
  void word() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
    if (std::isdigit(static_cast<unsigned char>(text_[start])) != 0 || text_[start] == '.') {
      double number = 0;
      const auto read = std::from_chars(text_.data() + start, text_.data() + text_.size(), number);
      const auto end = static_cast<std::size_t>(read.ptr - text_.data());
      const auto unit = read.ec == std::errc() && text_[end - 1] != '.' ? unit_after(end) : end;
      // Beyond at_ with a signed exponent; "3mm" is a number too, "2.AN01" none.
      if (read.ec == std::errc() && std::max(end, unit) >= at_) {
        at_ = std::max(end, unit);
        put(ExpressionToken::Kind::number, std::string(text_.substr(start, at_ - start)), start);
        tokens_.back().value = number;
        if (unit > end) tokens_.back().unit = trimmed(text_.substr(end, unit - end));
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

  // Where the unit that begins at `from`, behind a number, ends: the longest that is known; `from` if there
  // is none. A word with ( or [ behind it is a name: in "60 m / min(a, b)" the unit is m.
  [[nodiscard]] std::size_t unit_after(std::size_t from) const {
    std::size_t begin = from;
    while (begin < text_.size() && is_blank(text_[begin])) ++begin;
    std::size_t end = from;
    std::size_t at = begin;
    if (text_.substr(at).starts_with("1/")) at += 2;
    while (at < text_.size()) {
      const auto word = at;
      while (at < text_.size() && is_unit_character(text_[at])) ++at;
      if (at == word || std::isdigit(static_cast<unsigned char>(text_[word])) != 0) break;
      const auto behind = text_.find_first_not_of(" \t\r\n", at);
      if (behind != std::string_view::npos && (text_[behind] == '(' || text_[behind] == '[')) break;
      at = exponent_after(at);
      if (is_unit(text_.substr(begin, at - begin))) end = at;
      while (at < text_.size() && is_blank(text_[at])) ++at;
      if (at < text_.size() && text_[at] == '/') ++at;
      while (at < text_.size() && is_blank(text_[at])) ++at;
    }
    return end;
  }
  // Of "^2" or "^-1".
  [[nodiscard]] std::size_t exponent_after(std::size_t at) const {
    const auto is_number = [&](std::size_t i) {
      return i < text_.size() && std::isdigit(static_cast<unsigned char>(text_[i])) != 0;
    };
    if (at >= text_.size() || text_[at] != '^') return at;
    std::size_t end = at + 1;
    if (end < text_.size() && text_[end] == '-') ++end;
    if (!is_number(end)) return at;
    while (is_number(end)) ++end;
    return end;
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
        fault("expression.syntax"_code, at_, fmt::format("'{}' in an index", c),
              "an index is a number, or two: [3], [2,5]");
        return index;
      }
    }
    fault("expression.syntax"_code, open, "this [ is not closed", "write ] after the index");
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
    if (pair == "=<" || pair == "=>")
      return fault("expression.syntax"_code, at_, fmt::format("'{}' does not compare", pair),
                   fmt::format("write {}=", pair[1]));
    if (c == '=') return fault("expression.syntax"_code, at_, "'=' does not compare", "write ==");
    if (c == '&') return fault("expression.syntax"_code, at_, "'&' is not known", "write &&");
    if (c == '|') return fault("expression.syntax"_code, at_, "'|' is not known", "write ||");
    if (std::string_view("+-*/^<>!?:,()").find(c) == std::string_view::npos) {
      std::size_t end = at_ + 1;  // the whole UTF-8 character
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
      return fault("expression.syntax"_code, at_,
                   fmt::format("'{}' has no meaning in an expression", text_.substr(at_, end - at_)),
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

}  // namespace

bool is_relation(std::string_view sign) { return sign == "<" || sign == "<=" || sign == ">" || sign == ">="; }

ExpressionTokens scan_expression(std::string_view text, std::vector<ExpressionFault>& faults) {
  if (text.size() > longest) {
    faults.push_back({"expression.syntax"_code, 0,
                      fmt::format("the expression has {} characters", text.size()),
                      fmt::format("at most {}", longest)});
    return {};
  }
  const std::size_t before = faults.size();
  auto tokens = ExpressionScanner(text, faults).run();
  if (tokens.empty() && faults.size() == before)
    faults.push_back({"expression.syntax"_code, 0, "the expression is empty",
                      "write a comparison, for example follerr < 400"});
  return tokens;
}

}  // namespace drycut::sim::scenario
