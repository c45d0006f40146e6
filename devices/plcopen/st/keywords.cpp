#include "devices/plcopen/st/keywords.hpp"

#include <array>
#include <string>

#include "base/text.hpp"

namespace drycut::devices::plcopen::st {
namespace {

constexpr std::array<std::string_view, 9> closers{
    "END_IF", "END_CASE", "END_FOR", "END_WHILE", "END_REPEAT", "END_PROGRAM", "ELSE", "ELSIF", "UNTIL"};
constexpr std::array<std::string_view, 8> openers{"PROGRAM",    "FUNCTION_BLOCK", "FUNCTION", "TYPE",
                                                  "VAR_GLOBAL", "CONFIGURATION",  "RESOURCE", "INTERFACE"};
constexpr std::array<std::string_view, 42> others{"IF",         "THEN",         "CASE",
                                                  "OF",         "FOR",          "TO",
                                                  "BY",         "DO",           "WHILE",
                                                  "REPEAT",     "EXIT",         "CONTINUE",
                                                  "RETURN",     "VAR",          "VAR_INPUT",
                                                  "VAR_OUTPUT", "VAR_IN_OUT",   "VAR_TEMP",
                                                  "END_VAR",    "CONSTANT",     "RETAIN",
                                                  "PERSISTENT", "VAR_EXTERNAL", "AT",
                                                  "ARRAY",      "STRUCT",       "AND",
                                                  "OR",         "XOR",          "NOT",
                                                  "MOD",        "AND_THEN",     "OR_ELSE",
                                                  "TRUE",       "FALSE",        "END_STRUCT",
                                                  "END_TYPE",   "END_FUNCTION", "END_FUNCTION_BLOCK",
                                                  "POINTER",    "REFERENCE",    "END_CONFIGURATION"};

}  // namespace

bool is_keyword(std::string_view word) {
  return is_one_of(others, word) || is_one_of(closers, word) || is_one_of(openers, word);
}
bool closes_block(std::string_view word) { return is_one_of(closers, word); }
std::string_view meant_closer(std::string_view word) {
  auto plain = upper(word);
  std::erase(plain, '_');
  if (plain == "ELSEIF" || plain == "ELIF") return "ELSIF";
  for (const auto closer : closers) {
    auto other = std::string(closer);
    std::erase(other, '_');
    if (other == plain) return closer;
  }
  return {};
}
bool opens_unit(std::string_view word) { return is_one_of(openers, word); }

}  // namespace drycut::devices::plcopen::st
