#include "devices/qmove/text.hpp"

#include <algorithm>
#include <cstddef>

namespace drycut::devices::qmove {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

}  // namespace

Words split_words(std::string_view line, int number) {
  Words words;
  std::size_t at = 0;
  while (at < line.size() && line[at] != ';') {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    const std::size_t begin = at;
    while (at < line.size() && line[at] != ';' && !is_blank(line[at])) ++at;
    words.push_back({line.substr(begin, at - begin), {number, static_cast<int>(begin) + 1}});
  }
  return words;
}

const std::vector<std::string>& reserved_words() {
  static const std::vector<std::string> words = {
      "IF",     "ELSE", "ENDIF", "WHILE",  "ENDWHILE", "FOR", "NEXT", "WAIT", "JUMP", "SUB",
      "ENDSUB", "CALL", "END",   "SETOUT", "RESOUT",   "AND", "OR",   "NOT",  "ANDB", "ORB",
      "NOTB",   "XORB", "EQ",    "NE",     "NEQ",      "LT",  "LE",   "GT",   "GE"};
  return words;
}

bool is_reserved(std::string_view word) {
  const std::vector<std::string>& words = reserved_words();
  return std::any_of(words.begin(), words.end(),
                     [word](const std::string& reserved) { return same_word(reserved, word); });
}

}  // namespace drycut::devices::qmove
