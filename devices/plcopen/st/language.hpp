#pragma once
#include <array>
#include <string_view>

namespace drycut::devices::plcopen::st {

/// A form of the Structured Text that the controller takes, for `drycut devices ST`.
struct StRow {
  std::string_view form;
  std::string_view meaning;
};

inline constexpr std::array types{
    StRow{"BOOL", "FALSE, TRUE"},
    StRow{"SINT INT DINT LINT", "whole numbers of 8, 16, 32, 64 bits"},
    StRow{"USINT UINT UDINT ULINT", "whole numbers that are never negative, of 8, 16, 32, 64 bits"},
    StRow{"BYTE WORD DWORD LWORD", "bits: 8, 16, 32, 64; 16#FF, 2#1010_0001"},
    StRow{"REAL LREAL", "numbers with decimals, of 32 and 64 bits"},
    StRow{"TIME", "T#1d2h3m4s5ms; whole ms in 32 bits: 49 days; with a sign, T#-5s, under dialect: iec"},
    StRow{"TOD DATE DT", "TOD#12:30:00 in ms, D#2024-01-31, DT#2024-01-31-12:30:00 in s"},
    StRow{"LTIME",
          "LTIME#1s500ms20us7ns, LT#-5s; whole ns in 64 bits with a sign: 292 years; a TIME goes into it"},
    StRow{"LTOD LDATE LDT",
          "LTOD#12:30:00.000000001, LDATE#2024-01-31, LDT#2024-01-31-12:30:00.5 in ns, to 2262; TOD, DATE, "
          "DT go "
          "into them"},
    StRow{"CHAR  WCHAR",
          "one character: CHAR#'A', WCHAR#\"ö\", to U+FFFF; 'A' where the context wants one; goes "
          "into STRING and WSTRING"},
    StRow{"STRING  STRING(20)", "80 characters, or as many as are said, to 32767; 'it$'s', 'it''s'"},
    StRow{"WSTRING  WSTRING(20)", "the same of characters of all languages: \"größer\""},
    StRow{"ARRAY [1..8, 0..3] OF T",
          "bounds are constants; [1, 2, 3(0)] fills all dimensions, the last the fastest"},
    StRow{"ARRAY [*, *] OF T",
          "in VAR_IN_OUT, and VAR_INPUT of a FUNCTION or METHOD: the caller's array, of any length"},
    StRow{"TYPE p : STRUCT ... END_STRUCT END_TYPE", "a structure; initial values where it is declared"},
    StRow{"TYPE m : (Idle, Run := 5) END_TYPE",
          "an enumeration; (Idle, Run) INT and INT (Idle, Run) too, kept as an INT"},
    StRow{"TYPE t : INT := 5; END_TYPE", "what variables of a type begin with, of structures and arrays too"},
    StRow{"REF_TO T  POINTER TO T",
          "p := REF(x), ADR(x), NULL, in VAR too; p^ is what it is of; p + 1 is a byte further"},
    StRow{"INT (0..9)", "a range: what leaves it stops the program"},
    StRow{"AXIS_REF  MC_CAM_REF", "an axis of the scenario; a cam table, by its file or its id"},
};

inline constexpr std::array declarations{
    StRow{"PROGRAM n ... END_PROGRAM", "several run in tasks"},
    StRow{"FUNCTION_BLOCK n ... END_FUNCTION_BLOCK", "keeps its variables from call to call"},
    StRow{"FUNCTION n : T ... END_FUNCTION",
          "has a result of any type; without ': T' it has none; RETURN ends it"},
    StRow{"METHOD n : T ... END_METHOD",
          "of a block or program; PUBLIC PRIVATE PROTECTED INTERNAL ABSTRACT FINAL OVERRIDE"},
    StRow{"PROPERTY n : T GET ... END_GET SET ... END_SET END_PROPERTY", "read and written as a variable"},
    StRow{"ACTION n: ... END_ACTION", "called as n() inside, as instance.n() outside"},
    StRow{"FUNCTION_BLOCK n EXTENDS b IMPLEMENTS i", "THIS, SUPER; SUPER^() runs the body of b"},
    StRow{"INTERFACE n ... END_INTERFACE", "a variable of it stands for an instance: i := block;"},
    StRow{"VAR  VAR_INPUT  VAR_OUTPUT  VAR_IN_OUT  VAR_TEMP", "with initial values; END_VAR"},
    StRow{"x : BOOL R_EDGE;  F_EDGE", "an input whose edge the body sees"},
    StRow{"VAR_GLOBAL  VAR_EXTERNAL", "of all units; the scenario's axes are external"},
    StRow{"CONSTANT  RETAIN  PERSISTENT", "behind VAR; what is kept without power is RETAIN or PERSISTENT"},
    StRow{"x AT %IX0.0 : BOOL", "an input, %QX an output, both wired in the scenario"},
    StRow{"x AT %IW0 : WORD",
          "%IX0.0 to %IX1.7, the lowest bit first; %IB 8, %ID 32, %IL 64 of them, %QW as well"},
    StRow{"x AT %MW10 : INT", "a place in memory, for Modbus: %MX, %MW, %MD, %ML"},
    StRow{"CONFIGURATION  RESOURCE", "TASK t (INTERVAL := T#20ms, PRIORITY := 1); PROGRAM p WITH t : n"},
    StRow{"{define X}  {IF defined(X)} ... {END_IF}", "what is compiled; hasvalue(X, 'text') too"},
};

inline constexpr std::array statements{
    StRow{"x := e;", "a literal takes the type that its context wants"},
    StRow{"IF  ELSIF  ELSE  END_IF", ""},
    StRow{"CASE e OF 1, 3..5: ... ELSE ... END_CASE", "whole numbers, CHAR and enumerations"},
    StRow{"FOR i := a TO b BY s DO ... END_FOR", ""},
    StRow{"WHILE e DO ... END_WHILE", ""},
    StRow{"REPEAT ... UNTIL e END_REPEAT", ""},
    StRow{"EXIT  CONTINUE  RETURN", "out of a loop, to its next round, out of a unit"},
    StRow{"block(In := e, Out => x);",
          "or block(e) in the order of the inputs; NOT Out => x; EN and ENO too"},
    StRow{"( )  **  - NOT  * / MOD  + -  < > <= >=  = <>  AND &  XOR  OR", "operators, the strongest first"},
    StRow{"AND_THEN  OR_ELSE", "the right side only where it counts"},
    StRow{"%IX0.0  %IW0  %QW2  %MD4",
          "a place without a variable; %MD4 is a DWORD and goes into all whole numbers of its width"},
    StRow{"w.3  w.%X3  w.%B1  w.%W0  w.%D0", "a bit, a byte, a word, a double word of a number"},
    StRow{"AssertTrue(c, 'text');  AssertFalse  AssertEquals(expected, actual, 'text');",
          "in tests, as TcUnit has them: drycut test runs them; TEST('title'), TEST_FINISHED()"},
};

inline constexpr std::array standard_functions{
    StRow{"ADD MUL AND OR XOR", "of 2 to 64 inputs"},
    StRow{"SUB DIV MOD EXPT NOT MOVE", "as the operators; MOVE is :="},
    StRow{"GT GE EQ LE LT NE", "comparisons; of 2 to 64 inputs in a row, NE of 2"},
    StRow{"ADD_TIME ADD_TOD_TIME ADD_DT_TIME SUB_TIME SUB_DATE_DATE SUB_TOD_TIME SUB_TOD_TOD SUB_DT_TIME "
          "SUB_DT_DT MUL_TIME MULTIME DIV_TIME DIVTIME CONCAT_DATE_TOD",
          "times and dates"},
    StRow{"ADD_LTIME ADD_LTOD_LTIME ADD_LDT_LTIME SUB_LTIME SUB_LDATE_LDATE SUB_LTOD_LTIME SUB_LTOD_LTOD "
          "SUB_LDT_LTIME SUB_LDT_LDT MUL_LTIME DIV_LTIME CONCAT_DATE_LTOD",
          "the same of the long ones; + - * / take them, too"},
    StRow{"TIME()", "time since power-up"},
    StRow{"LTIME()", "the same in nanoseconds"},
    StRow{"ABS SQRT SIN COS TAN ASIN ACOS ATAN ATAN2 EXP LN LOG", "angles in rad; LOG is of base 10"},
    StRow{"SHL SHR ROL ROR",
          "IN, N: bits to the left and right, out of the word or round it; the bits shift, no sign is kept"},
    StRow{"MIN MAX LIMIT SEL MUX", "LIMIT(MN, IN, MX), SEL(G, IN0, IN1), MUX(K, IN0, IN1, ...)"},
    StRow{"TRUNC TRUNC_INT", "a REAL without its decimals, as what the context wants, else DINT; as INT"},
    StRow{"FLOOR CEIL", "the next whole number below, above, as what the context wants, else DINT"},
    StRow{"IS_VALID IS_VALID_BCD",
          "a REAL is a number and no infinity; BYTE to LWORD have digits 0 to 9 only"},
    StRow{"TO_BIG_ENDIAN TO_LITTLE_ENDIAN FROM_BIG_ENDIAN FROM_LITTLE_ENDIAN",
          "the order of a number's bytes; in the program the lowest is the first"},
    StRow{"LOWER_BOUND UPPER_BOUND", "of an array, ARRAY [*] too: UPPER_BOUND(a, 1), the dimension from 1"},
    StRow{"SIZEOF", "bytes of a variable or elementary type, without gaps"},
    StRow{"CONCAT_DATE CONCAT_TOD CONCAT_DT SPLIT_DATE SPLIT_TOD SPLIT_DT CONCAT_LTOD CONCAT_LDT SPLIT_LTOD "
          "SPLIT_LDT DAY_OF_WEEK",
          "parts of dates; Sunday is 0"},
    StRow{"WORD_BCD_TO_UINT UINT_TO_BCD_WORD ...",
          "of BYTE and USINT, WORD and UINT, DWORD and UDINT, LWORD and ULINT; BCD_TO_UINT, TO_BCD_WORD ... "
          "of any of them"},
    StRow{"LEN LEFT RIGHT MID CONCAT INSERT DELETE REPLACE FIND", "of STRING; the first character is 1"},
    StRow{"X_TO_Y  TO_Y", "every elementary type into every other: REAL_TO_INT, TO_STRING"},
};

inline constexpr std::array standard_function_blocks{
    StRow{"TON TOF TP", "IN, PT; Q, ET: on delay, off delay, pulse"},
    StRow{"R_TRIG F_TRIG", "CLK; Q: a rising, a falling edge, for one scan"},
    StRow{"SR RS", "SET1, RESET and SET, RESET1; Q1: flip-flops, the one with 1 is the stronger"},
    StRow{"CTU CTD CTUD", "CU, CD, RESET, LOAD, PV; Q, QU, QD, CV: counters of INT, 0 to 32767"},
    StRow{"CTU_INT CTD_INT CTUD_INT", "the same of INT"},
    StRow{"CTU_DINT CTD_DINT CTUD_DINT", "the same of DINT"},
    StRow{"CTU_UDINT CTD_UDINT CTUD_UDINT", "the same of UDINT"},
    StRow{"CTU_LINT CTD_LINT CTUD_LINT", "the same of LINT"},
    StRow{"CTU_ULINT CTD_ULINT CTUD_ULINT", "the same of ULINT"},
};

}  // namespace drycut::devices::plcopen::st
