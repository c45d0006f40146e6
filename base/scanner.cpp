#include "base/scanner.hpp"

#include <utility>

namespace drycut {

void Complaints::complain(Code code, Place place, std::string what, std::string remedy) {
  problems_.push_back({code, file_, place.line, place.column, std::move(what), std::move(remedy)});
}

void Scanner::complain(Code code, Token& token, std::string what, std::string remedy) {
  token.kind = Token::Kind::bad;
  complain(code, token.place, std::move(what), std::move(remedy));
}

void Scanner::advance(std::size_t count) {
  for (; count > 0 && !at_end(); --count) {
    if (text_[at_++] != '\n') continue;
    ++line_;
    line_start_ = at_;
  }
}

Scanner::Number Scanner::number_ahead(bool (*digit)(char), bool exponents) const {
  Number number{length(digit)};
  if (peek(number.size) == '.' && is_digit(peek(number.size + 1)))
    number = {length(digit, number.size + 1), true};
  if (exponents && (peek(number.size) == 'e' || peek(number.size) == 'E')) {
    const bool sign = peek(number.size + 1) == '+' || peek(number.size + 1) == '-';
    const std::size_t first = number.size + (sign ? 2 : 1);
    if (is_digit(peek(first))) number = {length(is_digit, first), true};
  }
  number.whole = length(in_name, number.size);
  return number;
}

}  // namespace drycut
