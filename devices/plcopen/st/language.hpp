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
    StRow{"TIME", "T#1d2h3m4s5ms; whole ms in 32 bits: 49 days"},
    StRow{"TOD DATE DT", "TOD#12:30:00 in ms, D#2024-01-31, DT#2024-01-31-12:30:00 in s"},
    StRow{"STRING  STRING(20)", "80 characters, or as many as are said, to 255; 'it$'s'"},
    StRow{"ARRAY [1..8, 0..3] OF T", "bounds are constants"},
    StRow{"TYPE p : STRUCT ... END_STRUCT END_TYPE", "a structure; initial values where it is declared"},
    StRow{"TYPE m : (Idle, Run := 5) END_TYPE", "an enumeration"},
    StRow{"INT (0..9)", "a range: what leaves it stops the program"},
    StRow{"AXIS_REF  MC_CAM_REF", "an axis of the scenario; a cam table, by its file or its id"},
};

inline constexpr std::array declarations{
    StRow{"PROGRAM n ... END_PROGRAM", "several run in tasks"},
    StRow{"FUNCTION_BLOCK n ... END_FUNCTION_BLOCK", "keeps its variables from call to call"},
    StRow{"FUNCTION n : T ... END_FUNCTION", "has a result of any type; RETURN ends it"},
    StRow{"VAR  VAR_INPUT  VAR_OUTPUT  VAR_IN_OUT  VAR_TEMP", "with initial values; END_VAR"},
    StRow{"VAR_GLOBAL  VAR_EXTERNAL", "of all units; the scenario's axes are external"},
    StRow{"CONSTANT  RETAIN  PERSISTENT", "behind VAR; what is kept without power is RETAIN or PERSISTENT"},
    StRow{"x AT %IX0.0 : BOOL", "an input, %QX an output, both wired in the scenario"},
    StRow{"x AT %MW10 : INT", "a place in memory, for Modbus: %MX, %MW, %MD, %ML"},
    StRow{"CONFIGURATION  RESOURCE", "TASK t (INTERVAL := T#20ms, PRIORITY := 1); PROGRAM p WITH t : n"},
    StRow{"{define X}  {IF defined(X)} ... {END_IF}", "what is compiled; hasvalue(X, 'text') too"},
};

inline constexpr std::array statements{
    StRow{"x := e;", "a literal takes the type that its context wants"},
    StRow{"IF  ELSIF  ELSE  END_IF", ""},
    StRow{"CASE e OF 1, 3..5: ... ELSE ... END_CASE", "whole numbers and enumerations"},
    StRow{"FOR i := a TO b BY s DO ... END_FOR", ""},
    StRow{"WHILE e DO ... END_WHILE", ""},
    StRow{"REPEAT ... UNTIL e END_REPEAT", ""},
    StRow{"EXIT  CONTINUE  RETURN", "out of a loop, to its next round, out of a unit"},
    StRow{"block(In := e, Out => x);", "EN and ENO of functions and blocks too"},
    StRow{"( )  **  - NOT  * / MOD  + -  < > <= >=  = <>  AND &  XOR  OR", "operators, the strongest first"},
    StRow{"AND_THEN  OR_ELSE", "the right side only where it counts"},
    StRow{"w.3  w.%X3  w.%B1  w.%W0  w.%D0", "a bit, a byte, a word, a double word of a number"},
};

inline constexpr std::array standard_functions{
    StRow{"ADD MUL AND OR XOR", "of 2 to 64 inputs"},
    StRow{"SUB DIV MOD EXPT NOT MOVE", "as the operators; MOVE is :="},
    StRow{"GT GE EQ LE LT NE", "comparisons; of 2 to 64 inputs in a row, NE of 2"},
    StRow{"ADD_TIME ADD_TOD_TIME ADD_DT_TIME SUB_TIME SUB_DATE_DATE SUB_TOD_TIME SUB_TOD_TOD SUB_DT_TIME "
          "SUB_DT_DT MUL_TIME MULTIME DIV_TIME DIVTIME CONCAT_DATE_TOD",
          "times and dates"},
    StRow{"TIME()", "time since power-up"},
    StRow{"ABS SQRT SIN COS TAN ASIN ACOS ATAN ATAN2 EXP LN LOG", "angles in rad; LOG is of base 10"},
    StRow{"SHL SHR ROL ROR", "IN, N: bits to the left and right, out of the word or round it"},
    StRow{"MIN MAX LIMIT SEL MUX", "LIMIT(MN, IN, MX), SEL(G, IN0, IN1), MUX(K, IN0, IN1, ...)"},
    StRow{"TRUNC TRUNC_INT", "a REAL without its decimals, as DINT, as INT"},
    StRow{"LEN LEFT RIGHT MID CONCAT INSERT DELETE REPLACE FIND", "of STRING; the first character is 1"},
    StRow{"X_TO_Y  TO_Y", "every elementary type into every other: REAL_TO_INT, TO_STRING"},
};

inline constexpr std::array standard_function_blocks{
    StRow{"TON TOF TP", "IN, PT; Q, ET: on delay, off delay, pulse"},
    StRow{"R_TRIG F_TRIG", "CLK; Q: a rising, a falling edge, for one scan"},
    StRow{"SR RS", "SET1, RESET and SET, RESET1; Q1: flip-flops, the one with 1 is the stronger"},
    StRow{"CTU CTD CTUD", "CU, CD, RESET, LOAD, PV; Q, QU, QD, CV: counters"},
};

}  // namespace drycut::devices::plcopen::st
