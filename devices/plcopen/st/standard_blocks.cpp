#include <array>
#include <string>
#include <string_view>

#include "devices/plcopen/st/keywords.hpp"

// The standard blocks and some of the standard functions, as Structured Text.
namespace drycut::devices::plcopen::st {
namespace {

constexpr std::string_view edges_and_timers = R"(
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
)";

constexpr std::string_view counters_of_a_type = R"(
FUNCTION_BLOCK CTU_T
VAR_INPUT CU : BOOL; RESET : BOOL; PV : INPUT; END_VAR
VAR_OUTPUT Q : BOOL; CV : COUNT; END_VAR
VAR last : BOOL; END_VAR
IF RESET THEN CV := 0; ELSIF CU AND NOT last AND CV < MOST THEN CV := CV + 1; END_IF
last := CU;
Q := CV >= PV;
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD_T
VAR_INPUT CD : BOOL; LOAD : BOOL; PV : INPUT; END_VAR
VAR_OUTPUT Q : BOOL; CV : COUNT; END_VAR
VAR last : BOOL; END_VAR
IF LOAD THEN CV := LOADED; ELSIF CD AND NOT last AND CV > 0 THEN CV := CV - 1; END_IF
last := CD;
Q := CV <= 0;
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD_T
VAR_INPUT CU : BOOL; CD : BOOL; RESET : BOOL; LOAD : BOOL; PV : INPUT; END_VAR
VAR_OUTPUT QU : BOOL; QD : BOOL; CV : COUNT; END_VAR
VAR up : BOOL; down : BOOL; END_VAR
IF RESET THEN
  CV := 0;
ELSIF LOAD THEN
  CV := LOADED;
ELSE
  IF CU AND NOT up AND CV < MOST THEN CV := CV + 1; END_IF
  IF CD AND NOT down AND CV > 0 THEN CV := CV - 1; END_IF
END_IF
up := CU;
down := CD;
QU := CV >= PV;
QD := CV <= 0;
END_FUNCTION_BLOCK
)";

std::string replaced(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

/// Of all types. CTU, CTD and CTUD count to 32767, so that INT, UINT and WORD take their CV, and compare with
/// any of them.
std::string counters() {
  struct Of {
    std::string_view suffix;
    std::string_view input;
    std::string_view count;
    std::string_view most;
    std::string_view loaded;
  };
  constexpr std::array<Of, 6> all{{
      {"", "DINT", "INT (0..32767)", "32767", "DINT_TO_INT(LIMIT(0, PV, 32767))"},
      {"_INT", "INT", "INT", "32767", "PV"},
      {"_DINT", "DINT", "DINT", "2147483647", "PV"},
      {"_UDINT", "UDINT", "UDINT", "4294967295", "PV"},
      {"_LINT", "LINT", "LINT", "9223372036854775807", "PV"},
      {"_ULINT", "ULINT", "ULINT", "18446744073709551615", "PV"},
  }};
  std::string text;
  for (const auto& [suffix, input, count, most, loaded] : all) {
    std::string of = replaced(std::string(counters_of_a_type), "_T\n", std::string(suffix) + "\n");
    of = replaced(std::move(of), ": INPUT;", ": " + std::string(input) + ";");
    of = replaced(std::move(of), ": COUNT;", ": " + std::string(count) + ";");
    of = replaced(std::move(of), "MOST", most);
    text += replaced(std::move(of), "LOADED", loaded);
  }
  return text;
}

// Where a FUNCTION's UNFIT is TRUE at its end, what it was given did not fit: told at the call.
// A DATE and a DT count seconds since 1970-01-01, a Thursday; the calendar is that of the civil days.
constexpr std::string_view date_functions = R"(
FUNCTION DAY_OF_WEEK : INT
VAR_INPUT IN : DATE; END_VAR
DAY_OF_WEEK := UDINT_TO_INT((DATE_TO_UDINT(IN) / 86400 + 4) MOD 7);
END_FUNCTION

FUNCTION _CONCAT_DAYS : DINT
VAR_INPUT YEAR : INT; MONTH : INT; DAY : INT; END_VAR
VAR y, m : DINT; END_VAR
y := YEAR;
IF MONTH <= 2 THEN y := y - 1; m := MONTH + 9; ELSE m := MONTH - 3; END_IF
_CONCAT_DAYS := y * 365 + y / 4 - y / 100 + y / 400 + (153 * m + 2) / 5 + DAY - 1 - 719468;
END_FUNCTION

FUNCTION _CONCAT_DATE : DATE
VAR_INPUT YEAR : INT; MONTH : INT; DAY : INT; END_VAR
_CONCAT_DATE := DINT_TO_DATE(_CONCAT_DAYS(YEAR, MONTH, DAY) * 86400);
END_FUNCTION

FUNCTION _NO_DATE : BOOL
VAR_INPUT MADE : DATE; YEAR : INT; MONTH : INT; DAY : INT; END_VAR
VAR y, m, d : INT; END_VAR
_SPLIT_DATE(MADE, YEAR => y, MONTH => m, DAY => d);
_NO_DATE := y <> YEAR OR m <> MONTH OR d <> DAY;
END_FUNCTION

FUNCTION CONCAT_DATE : DATE
VAR_INPUT YEAR : INT; MONTH : INT; DAY : INT; END_VAR
VAR UNFIT : BOOL; END_VAR
CONCAT_DATE := _CONCAT_DATE(YEAR, MONTH, DAY);
UNFIT := _NO_DATE(CONCAT_DATE, YEAR, MONTH, DAY);
END_FUNCTION

FUNCTION _CONCAT_TOD : TOD
VAR_INPUT HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
_CONCAT_TOD := DINT_TO_TOD(((DINT#60 * HOUR + MINUTE) * 60 + SECOND) * 1000 + MILLISECOND);
END_FUNCTION

FUNCTION _NO_TOD : BOOL
VAR_INPUT HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
_NO_TOD := HOUR < 0 OR HOUR > 23 OR MINUTE < 0 OR MINUTE > 59 OR SECOND < 0 OR SECOND > 59 OR
  MILLISECOND < 0 OR MILLISECOND > 999;
END_FUNCTION

FUNCTION CONCAT_TOD : TOD
VAR_INPUT HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
VAR UNFIT : BOOL; END_VAR
CONCAT_TOD := _CONCAT_TOD(HOUR, MINUTE, SECOND, MILLISECOND);
UNFIT := _NO_TOD(HOUR, MINUTE, SECOND, MILLISECOND);
END_FUNCTION

FUNCTION CONCAT_DT : DT
VAR_INPUT YEAR : INT; MONTH : INT; DAY : INT; HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
VAR made : DATE; UNFIT : BOOL; END_VAR
made := _CONCAT_DATE(YEAR, MONTH, DAY);
CONCAT_DT := CONCAT_DATE_TOD(made, _CONCAT_TOD(HOUR, MINUTE, SECOND, MILLISECOND));
UNFIT := _NO_DATE(made, YEAR, MONTH, DAY) OR _NO_TOD(HOUR, MINUTE, SECOND, MILLISECOND) OR
  DT_TO_DATE(CONCAT_DT) <> made;
END_FUNCTION

FUNCTION _SPLIT_DAYS
VAR_INPUT IN : DINT; END_VAR
VAR_OUTPUT YEAR : INT; MONTH : INT; DAY : INT; END_VAR
VAR days, era, of_era, y, of_year, m : DINT; END_VAR
days := IN + 719468;
era := days / 146097;
of_era := days - era * 146097;
y := (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
of_year := of_era - (365 * y + y / 4 - y / 100);
m := (5 * of_year + 2) / 153;
DAY := DINT_TO_INT(of_year - (153 * m + 2) / 5 + 1);
IF m < 10 THEN MONTH := DINT_TO_INT(m + 3); ELSE MONTH := DINT_TO_INT(m - 9); END_IF
YEAR := DINT_TO_INT(y + era * 400);
IF MONTH <= 2 THEN YEAR := YEAR + 1; END_IF
END_FUNCTION

FUNCTION _SPLIT_DATE
VAR_INPUT IN : DATE; END_VAR
VAR_OUTPUT YEAR : INT; MONTH : INT; DAY : INT; END_VAR
_SPLIT_DAYS(UDINT_TO_DINT(DATE_TO_UDINT(IN) / 86400), YEAR => YEAR, MONTH => MONTH, DAY => DAY);
END_FUNCTION

FUNCTION _SPLIT_TOD
VAR_INPUT IN : TOD; END_VAR
VAR_OUTPUT HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
VAR ms : DINT; END_VAR
ms := TOD_TO_DINT(IN);
HOUR := DINT_TO_INT(ms / 3600000);
MINUTE := DINT_TO_INT(ms / 60000 MOD 60);
SECOND := DINT_TO_INT(ms / 1000 MOD 60);
MILLISECOND := DINT_TO_INT(ms MOD 1000);
END_FUNCTION

FUNCTION CONCAT_LTOD : LTOD
VAR_INPUT HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
VAR UNFIT : BOOL; END_VAR
CONCAT_LTOD := _CONCAT_TOD(HOUR, MINUTE, SECOND, MILLISECOND);
UNFIT := _NO_TOD(HOUR, MINUTE, SECOND, MILLISECOND);
END_FUNCTION

FUNCTION CONCAT_LDT : LDT
VAR_INPUT YEAR : INT; MONTH : INT; DAY : INT; HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
VAR days : DINT; y, m, d : INT; UNFIT : BOOL; END_VAR
days := _CONCAT_DAYS(YEAR, MONTH, DAY);
CONCAT_LDT := LINT_TO_LDT(LINT#86400_000_000_000 * days +
  LINT#1_000_000 * TOD_TO_DINT(_CONCAT_TOD(HOUR, MINUTE, SECOND, MILLISECOND)));
_SPLIT_DAYS(days, YEAR => y, MONTH => m, DAY => d);
UNFIT := y <> YEAR OR m <> MONTH OR d <> DAY OR _NO_TOD(HOUR, MINUTE, SECOND, MILLISECOND) OR
  days < 0 OR LDT_TO_LINT(CONCAT_LDT) / LINT#86400_000_000_000 <> days;
END_FUNCTION

FUNCTION SPLIT_LTOD
VAR_INPUT IN : LTOD; END_VAR
VAR_OUTPUT HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
_SPLIT_TOD(LTOD_TO_TOD(IN), HOUR => HOUR, MINUTE => MINUTE, SECOND => SECOND, MILLISECOND => MILLISECOND);
END_FUNCTION

FUNCTION SPLIT_LDT
VAR_INPUT IN : LDT; END_VAR
VAR_OUTPUT
  YEAR : INT; MONTH : INT; DAY : INT; HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT;
END_VAR
VAR days, rest : LINT; END_VAR
days := LDT_TO_LINT(IN) / LINT#86400_000_000_000;
rest := LDT_TO_LINT(IN) MOD LINT#86400_000_000_000;
IF rest < 0 THEN days := days - 1; rest := rest + LINT#86400_000_000_000; END_IF
_SPLIT_DAYS(LINT_TO_DINT(days), YEAR => YEAR, MONTH => MONTH, DAY => DAY);
_SPLIT_TOD(LINT_TO_TOD(rest / 1_000_000), HOUR => HOUR, MINUTE => MINUTE, SECOND => SECOND, MILLISECOND => MILLISECOND);
END_FUNCTION

FUNCTION SPLIT_DATE
VAR_INPUT IN : DATE; END_VAR
VAR_OUTPUT YEAR : INT; MONTH : INT; DAY : INT; END_VAR
_SPLIT_DATE(IN, YEAR => YEAR, MONTH => MONTH, DAY => DAY);
END_FUNCTION

FUNCTION SPLIT_TOD
VAR_INPUT IN : TOD; END_VAR
VAR_OUTPUT HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT; END_VAR
_SPLIT_TOD(IN, HOUR => HOUR, MINUTE => MINUTE, SECOND => SECOND, MILLISECOND => MILLISECOND);
END_FUNCTION

FUNCTION SPLIT_DT
VAR_INPUT IN : DT; END_VAR
VAR_OUTPUT
  YEAR : INT; MONTH : INT; DAY : INT; HOUR : INT; MINUTE : INT; SECOND : INT; MILLISECOND : INT;
END_VAR
_SPLIT_DATE(DT_TO_DATE(IN), YEAR => YEAR, MONTH => MONTH, DAY => DAY);
_SPLIT_TOD(DT_TO_TOD(IN), HOUR => HOUR, MINUTE => MINUTE, SECOND => SECOND, MILLISECOND => MILLISECOND);
END_FUNCTION
)";

/// The conversions between BCD and numbers, of all widths.
constexpr std::string_view bcd_of_a_width = R"(
FUNCTION BITS_BCD_TO_NUMBER : NUMBER
VAR_INPUT IN : BITS; END_VAR
VAR rest : ULINT; place : ULINT := 1; UNFIT : BOOL; END_VAR
UNFIT := NOT IS_VALID_BCD(IN);
rest := BITS_TO_ULINT(IN);
BITS_BCD_TO_NUMBER := 0;
WHILE rest > 0 DO
  BITS_BCD_TO_NUMBER := BITS_BCD_TO_NUMBER + ULINT_TO_NUMBER(rest MOD 16 * place);
  rest := rest / 16;
  IF rest > 0 THEN place := place * 10; END_IF
END_WHILE
END_FUNCTION

FUNCTION NUMBER_TO_BCD_BITS : BITS
VAR_INPUT IN : NUMBER; END_VAR
VAR rest, all : ULINT; place : ULINT := 1; digits : INT; UNFIT : BOOL; END_VAR
rest := NUMBER_TO_ULINT(IN);
WHILE rest > 0 AND digits < DIGITS DO
  all := all + rest MOD 10 * place;
  rest := rest / 10;
  digits := digits + 1;
  IF digits < DIGITS THEN place := place * 16; END_IF
END_WHILE
NUMBER_TO_BCD_BITS := ULINT_TO_BITS(all);
UNFIT := rest > 0;
END_FUNCTION

FUNCTION BCD_TO_NUMBER : NUMBER
VAR_INPUT IN : LWORD; END_VAR
VAR all : ULINT; UNFIT : BOOL; END_VAR
all := LWORD_BCD_TO_ULINT(IN);
BCD_TO_NUMBER := ULINT_TO_NUMBER(all);
UNFIT := NOT IS_VALID_BCD(IN) OR BCD_TO_NUMBER <> all;
END_FUNCTION

FUNCTION TO_BCD_BITS : BITS
VAR_INPUT IN : ULINT; END_VAR
VAR UNFIT : BOOL; END_VAR
TO_BCD_BITS := LWORD_TO_BITS(ULINT_TO_BCD_LWORD(IN));
UNFIT := LWORD_BCD_TO_ULINT(BITS_TO_LWORD(TO_BCD_BITS)) <> IN;
END_FUNCTION
)";

std::string bcd_functions() {
  struct Of {
    std::string_view bits;
    std::string_view number;
    std::string_view digits;
  };
  constexpr std::array<Of, 4> all{
      {{"BYTE", "USINT", "2"}, {"WORD", "UINT", "4"}, {"DWORD", "UDINT", "8"}, {"LWORD", "ULINT", "16"}}};
  std::string text;
  for (const auto& [bits, number, digits] : all) {
    std::string of = replaced(std::string(bcd_of_a_width), "DIGITS", digits);
    of = replaced(std::move(of), "BITS", bits);
    of = replaced(std::move(of), "NUMBER", number);
    text += of;
  }
  return text;
}

}  // namespace

std::string_view standard_blocks() {
  static const std::string blocks =
      std::string(edges_and_timers) + counters() + std::string(date_functions) + bcd_functions();
  return blocks;
}

}  // namespace drycut::devices::plcopen::st
