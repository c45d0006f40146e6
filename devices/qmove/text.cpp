#include "devices/qmove/cnf.hpp"

namespace drycut::devices::qmove {

const std::vector<std::string>& reserved_words() {
  static const std::vector<std::string> words = {
      "IF",     "ELSE", "ENDIF", "WHILE",  "ENDWHILE", "FOR", "NEXT", "WAIT", "JUMP", "SUB",
      "ENDSUB", "CALL", "END",   "SETOUT", "RESOUT",   "AND", "OR",   "NOT",  "ANDB", "ORB",
      "NOTB",   "XORB", "EQ",    "NE",     "NEQ",      "LT",  "LE",   "GT",   "GE"};
  return words;
}

bool is_reserved(std::string_view word) { return is_one_of(reserved_words(), word); }

}  // namespace drycut::devices::qmove
