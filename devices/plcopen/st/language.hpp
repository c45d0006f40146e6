#pragma once
#include <array>
#include <string_view>

namespace drycut::devices::plcopen::st {

/// A form of the Structured Text that the controller takes, for `drycut devices ST`.
struct LanguageRow {
  std::string_view form;
  std::string_view meaning;
};

inline constexpr std::array types{
    LanguageRow{"BOOL", "FALSE, TRUE"},
    LanguageRow{"SINT INT DINT LINT", "whole numbers of 8, 16, 32, 64 bits"},
    LanguageRow{"USINT UINT UDINT ULINT", "whole numbers that are never negative, of 8, 16, 32, 64 bits"},
    LanguageRow{"BYTE WORD DWORD LWORD", "bits: 8, 16, 32, 64; 16#FF, 2#1010_0001"},
    LanguageRow{"REAL LREAL", "numbers with decimals, of 32 and 64 bits"},
    LanguageRow{"TIME", "T#1d2h3m4s5ms; whole ms in 32 bits: 49 days"},
    LanguageRow{"TOD DATE DT", "TOD#12:30:00 in ms, D#2024-01-31, DT#2024-01-31-12:30:00 in s"},
    LanguageRow{"STRING  STRING(20)", "80 characters, or as many as are said, to 255; 'it$'s'"},
    LanguageRow{"ARRAY [1..8, 0..3] OF T", "bounds are constants"},
    LanguageRow{"TYPE p : STRUCT ... END_STRUCT END_TYPE",
                "a structure; initial values where it is declared"},
    LanguageRow{"TYPE m : (Idle, Run := 5) END_TYPE", "an enumeration"},
    LanguageRow{"INT (0..9)", "a range: what leaves it stops the program"},
    LanguageRow{"AXIS_REF  MC_CAM_REF", "an axis of the scenario; a cam table, by its file or its id"},
};

inline constexpr std::array declarations{
    LanguageRow{"PROGRAM n ... END_PROGRAM", "several run in tasks"},
    LanguageRow{"FUNCTION_BLOCK n ... END_FUNCTION_BLOCK", "keeps its variables from call to call"},
    LanguageRow{"FUNCTION n : T ... END_FUNCTION", "has a result of any type; RETURN ends it"},
    LanguageRow{"VAR  VAR_INPUT  VAR_OUTPUT  VAR_IN_OUT  VAR_TEMP", "with initial values; END_VAR"},
    LanguageRow{"VAR_GLOBAL  VAR_EXTERNAL", "of all units; the scenario's axes are external"},
    LanguageRow{"CONSTANT  RETAIN  PERSISTENT",
                "behind VAR; what is kept without power is RETAIN or PERSISTENT"},
    LanguageRow{"x AT %IX0.0 : BOOL", "an input, %QX an output, both wired in the scenario"},
    LanguageRow{"x AT %MW10 : INT", "a place in memory, for Modbus: %MX, %MW, %MD, %ML"},
    LanguageRow{"CONFIGURATION  RESOURCE",
                "TASK t (INTERVAL := T#20ms, PRIORITY := 1); PROGRAM p WITH t : n"},
    LanguageRow{"{define X}  {IF defined(X)} ... {END_IF}", "what is compiled; hasvalue(X, 'text') too"},
};

inline constexpr std::array statements{
    LanguageRow{"x := e;", "a literal takes the type that its context wants"},
    LanguageRow{"IF  ELSIF  ELSE  END_IF", ""},
    LanguageRow{"CASE e OF 1, 3..5: ... ELSE ... END_CASE", "whole numbers and enumerations"},
    LanguageRow{"FOR i := a TO b BY s DO ... END_FOR", ""},
    LanguageRow{"WHILE e DO ... END_WHILE", ""},
    LanguageRow{"REPEAT ... UNTIL e END_REPEAT", ""},
    LanguageRow{"EXIT  CONTINUE  RETURN", "out of a loop, to its next round, out of a unit"},
    LanguageRow{"block(In := e, Out => x);", "EN and ENO of functions and blocks too"},
    LanguageRow{"( )  **  - NOT  * / MOD  + -  < > <= >=  = <>  AND &  XOR  OR",
                "operators, the strongest first"},
    LanguageRow{"AND_THEN  OR_ELSE", "the right side only where it counts"},
    LanguageRow{"w.3  w.%X3  w.%B1  w.%W0  w.%D0", "a bit, a byte, a word, a double word of a number"},
};

inline constexpr std::array standard_functions{
    LanguageRow{"ADD MUL AND OR XOR", "of 2 to 64 inputs"},
    LanguageRow{"SUB DIV MOD EXPT NOT MOVE", "as the operators; MOVE is :="},
    LanguageRow{"GT GE EQ LE LT NE", "comparisons; of 2 to 64 inputs in a row, NE of 2"},
    LanguageRow{
        "ADD_TIME ADD_TOD_TIME ADD_DT_TIME SUB_TIME SUB_DATE_DATE SUB_TOD_TIME SUB_TOD_TOD SUB_DT_TIME "
        "SUB_DT_DT MUL_TIME MULTIME DIV_TIME DIVTIME CONCAT_DATE_TOD",
        "times and dates"},
    LanguageRow{"TIME()", "time since power-up"},
    LanguageRow{"ABS SQRT SIN COS TAN ASIN ACOS ATAN ATAN2 EXP LN LOG", "angles in rad; LOG is of base 10"},
    LanguageRow{"SHL SHR ROL ROR", "IN, N: bits to the left and right, out of the word or round it"},
    LanguageRow{"MIN MAX LIMIT SEL MUX", "LIMIT(MN, IN, MX), SEL(G, IN0, IN1), MUX(K, IN0, IN1, ...)"},
    LanguageRow{"TRUNC TRUNC_INT", "a REAL without its decimals, as DINT, as INT"},
    LanguageRow{"LEN LEFT RIGHT MID CONCAT INSERT DELETE REPLACE FIND",
                "of STRING; the first character is 1"},
    LanguageRow{"X_TO_Y  TO_Y", "every elementary type into every other: REAL_TO_INT, TO_STRING"},
};

inline constexpr std::array standard_function_blocks{
    LanguageRow{"TON TOF TP", "IN, PT; Q, ET: on delay, off delay, pulse"},
    LanguageRow{"R_TRIG F_TRIG", "CLK; Q: a rising, a falling edge, for one scan"},
    LanguageRow{"SR RS", "SET1, RESET and SET, RESET1; Q1: flip-flops, the one with 1 is the stronger"},
    LanguageRow{"CTU CTD CTUD", "CU, CD, RESET, LOAD, PV; Q, QU, QD, CV: counters"},
};

}  // namespace drycut::devices::plcopen::st
