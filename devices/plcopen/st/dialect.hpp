#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace drycut::devices::plcopen::st {

/// What IEC 61131-3 (third edition) and CODESYS take differently; in the order of `differences`.
enum class DialectDifference : std::uint8_t {
  negative_time,
  reals_of_bits,
  arithmetic_on_bits,
  logic_on_numbers,
  bits_as_numbers,
  first_falling_edge,
  negated_power,
  assigned_input,
  results_on_the_way,
};

/// A row of the reference; the notes say it, too.
struct DifferenceRow {
  std::string_view of;
  std::string_view iec;
  std::string_view codesys;
};
inline constexpr std::array differences{
    DifferenceRow{"a TIME below 0: T#1s - T#2s, -t, T#-5s, t * -1",
                  "TIME is signed, from T#-24d20h31m23s648ms to T#24d20h31m23s647ms",
                  "TIME is never negative: T#1s - T#2s is T#49d17h2m46s296ms, t * -1 goes round likewise; -t "
                  "and T#-5s are "
                  "refused"},
    DifferenceRow{"DWORD_TO_REAL, REAL_TO_DWORD, LWORD_TO_LREAL, LREAL_TO_LWORD",
                  "the bits stay, their meaning changes: DWORD_TO_REAL(16#3F800000) is 1.0",
                  "the value stays: DWORD_TO_REAL(16#3F800000) is 1065353216.0"},
    DifferenceRow{"+ - * / MOD **, ABS and the like of BYTE, WORD, DWORD, LWORD",
                  "refused: bits are no numbers, BYTE_TO_USINT(...) makes one",
                  "taken as USINT, UINT, UDINT, ULINT"},
    DifferenceRow{"AND OR XOR NOT SHL SHR ROL ROR of SINT to ULINT",
                  "refused: INT_TO_WORD(...) makes bits of it", "taken bit by bit"},
    DifferenceRow{"BYTE to LWORD where a number is wanted, and the other way round: i := b",
                  "refused: BYTE_TO_INT(...) converts", "taken where all values fit"},
    DifferenceRow{"F_TRIG and F_EDGE in the first scan, CLK is FALSE",
                  "Q is TRUE in it: CLK counts as TRUE before", "Q is FALSE: CLK counts as FALSE before"},
    DifferenceRow{"-a ** b", "the sign is the stronger: -2 ** 2 is 4", "** is the stronger: -2 ** 2 is -4"},
    DifferenceRow{"a block assigns its own VAR_INPUT", "refused", "taken, with a note"},
    DifferenceRow{"SINT to UINT and BYTE, WORD on their way: d := i * j, (i * j) / k, i + 1 > j",
                  "each result has the width of its type: INT#200 * INT#200 is -25536",
                  "+ - * / and MOD have 32 bits, INT#200 * INT#200 is 40000, until something of that width "
                  "takes it: an assignment, a call, TO_INT(i * j)"},
};

}  // namespace drycut::devices::plcopen::st
