#include "devices/plcopen/st/lexer.hpp"

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

std::string_view standard_blocks() {
  return R"(
FUNCTION_BLOCK R_TRIG
VAR_INPUT CLK : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
VAR last : BOOL; END_VAR
Q := CLK AND NOT last;
last := CLK;
END_FUNCTION_BLOCK

FUNCTION_BLOCK F_TRIG
VAR_INPUT CLK : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
VAR last : BOOL; END_VAR
Q := NOT CLK AND last;
last := CLK;
END_FUNCTION_BLOCK

FUNCTION_BLOCK SR
VAR_INPUT SET1 : BOOL; RESET : BOOL; END_VAR
VAR_OUTPUT Q1 : BOOL; END_VAR
Q1 := SET1 OR (NOT RESET AND Q1);
END_FUNCTION_BLOCK

FUNCTION_BLOCK RS
VAR_INPUT SET : BOOL; RESET1 : BOOL; END_VAR
VAR_OUTPUT Q1 : BOOL; END_VAR
Q1 := NOT RESET1 AND (SET OR Q1);
END_FUNCTION_BLOCK

FUNCTION_BLOCK TON
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR since : TIME; runs : BOOL; END_VAR
IF NOT IN THEN
  Q := FALSE; ET := T#0s; runs := FALSE;
ELSIF NOT Q THEN
  IF NOT runs THEN since := TIME(); runs := TRUE; END_IF
  ET := TIME() - since;
  IF ET >= PT THEN ET := PT; Q := TRUE; END_IF
END_IF
END_FUNCTION_BLOCK

FUNCTION_BLOCK TOF
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR since : TIME; runs : BOOL; END_VAR
IF IN THEN
  Q := TRUE; ET := T#0s; runs := FALSE;
ELSIF Q THEN
  IF NOT runs THEN since := TIME(); runs := TRUE; END_IF
  ET := TIME() - since;
  IF ET >= PT THEN ET := PT; Q := FALSE; END_IF
END_IF
END_FUNCTION_BLOCK

FUNCTION_BLOCK TP
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR since : TIME; over : BOOL; END_VAR
IF IN AND NOT Q AND NOT over THEN Q := TRUE; since := TIME(); END_IF
IF Q THEN
  ET := TIME() - since;
  IF ET >= PT THEN ET := PT; Q := FALSE; over := TRUE; END_IF
END_IF
IF over AND NOT IN THEN over := FALSE; ET := T#0s; END_IF
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTU
VAR_INPUT CU : BOOL; RESET : BOOL; PV : WORD; END_VAR
VAR_OUTPUT Q : BOOL; CV : WORD; END_VAR
VAR last : BOOL; END_VAR
IF RESET THEN CV := 0; ELSIF CU AND NOT last AND CV < 65535 THEN CV := CV + 1; END_IF
last := CU;
Q := CV >= PV;
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD
VAR_INPUT CD : BOOL; LOAD : BOOL; PV : WORD; END_VAR
VAR_OUTPUT Q : BOOL; CV : WORD; END_VAR
VAR last : BOOL; END_VAR
IF LOAD THEN CV := PV; ELSIF CD AND NOT last AND CV > 0 THEN CV := CV - 1; END_IF
last := CD;
Q := CV = 0;
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD
VAR_INPUT CU : BOOL; CD : BOOL; RESET : BOOL; LOAD : BOOL; PV : WORD; END_VAR
VAR_OUTPUT QU : BOOL; QD : BOOL; CV : WORD; END_VAR
VAR up : BOOL; down : BOOL; END_VAR
IF RESET THEN
  CV := 0;
ELSIF LOAD THEN
  CV := PV;
ELSE
  IF CU AND NOT up AND CV < 65535 THEN CV := CV + 1; END_IF
  IF CD AND NOT down AND CV > 0 THEN CV := CV - 1; END_IF
END_IF
up := CU;
down := CD;
QU := CV >= PV;
QD := CV = 0;
END_FUNCTION_BLOCK
)";
}

}  // namespace drycut::devices::plcopen::st
