#include "devices/lx3vp/registers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/text.hpp"

namespace drycut::devices::lx3vp {

namespace {

using Access = BlockWord::Access;

// Words 9 to 12: the manual's table names "high" and "low" crosswise and its example writes words 10 and 12;
// 9/10 low and 11/12 high is the only reading in which each threshold has both of its words.
constexpr BlockWord words[] = {
    {word::version, 1, "version", "u16", "", 1, Access::read, "", "version of the block's layout"},
    {word::status, 1, "status", "flags", "", 0, Access::write, "always",
     "state of the cam; bits 0, 1 and 9 may be reset"},
    {word::error, 1, "error", "u16", "", 0, Access::read, "",
     "the error code; of a table error the number of the row"},
    {word::function, 1, "function", "flags", "", 0, Access::write, "start", "how the cam starts and scales"},
    {word::live, 1, "live", "flags", "", 0, Access::write, "always", "what may be changed while it runs"},
    {word::start, 1, "start", "u16", "0..2", 0, Access::write, "always",
     "1 cyclic, 2 non-cyclic, else stop at once; a new start needs 0 for more than 100 us before"},
    {word::max_frequency, 2, "max frequency", "i32", "1..200000", 200000, Access::write, "always",
     "of the output [Hz]; beyond the range 200000, with 0 nothing comes out"},
    {word::sync_output, 1, "sync output", "u16", "0..255", 0, Access::write, "always",
     "plain number of the synchronous output Y: 8 is Y10"},
    {word::sync_low, 2, "sync low", "u32", "", 0, Access::write, "always",
     "first master position at which the synchronous output is on"},
    {word::sync_high, 2, "sync high", "u32", "", 0, Access::write, "always",
     "last master position at which the synchronous output is on"},
    {13, 1, "reserved", "u16", "", 0, Access::reserved, "", "remaining master pulses"},
    {word::repeats, 1, "repeats", "u16", "", 0, Access::write, "start",
     "non-cyclic: n makes n + 1 cycles a start signal, 65535 (HFFFF) turns it cyclic from the start on"},
    {word::delay, 2, "delay", "u32", "", 0, Access::write, "start",
     "non-cyclic, with function bit 0: master counts from the start signal to the start of the cam"},
    {word::start_position, 2, "start position", "u32", "", 0, Access::write, "start",
     "non-cyclic, with function bit 1: master position of the table at which the cam starts"},
    {word::slave_pulses, 2, "slave pulses", "i32", "", 0, Access::write, "start",
     "output pulses of the present cycle; function bit 6 starts from here"},
    {word::slave_position, 2, "slave position", "i32", "", 0, Access::read, "",
     "slave position in the table, before the zoom"},
    {word::slave_denominator, 1, "slave denominator", "u16", "1..65535", 1, Access::write, "start",
     "of the slave's zoom"},
    {word::slave_numerator, 1, "slave numerator", "u16", "1..65535", 1, Access::write, "start",
     "of the slave's zoom"},
    {word::master_position, 2, "master position", "u32", "", 0, Access::read, "",
     "master position in the table, after the zoom"},
    {word::master_counts, 2, "master counts", "i32", "", 0, Access::write, "start",
     "master counts since the start, before the zoom; function bit 6 starts from here"},
    {word::master_denominator, 1, "master denominator", "u16", "1..65535", 1, Access::write, "start",
     "of the master's zoom"},
    {word::master_numerator, 1, "master numerator", "u16", "1..65535", 1, Access::write, "start",
     "of the master's zoom"},
    {word::own_stop, 1, "stops by itself", "u16", "", 0, Access::read, "start",
     "ECAMTBX writes 3 with a table of midCAMend, at whose end the cam stops, 0 with another"},
    {32, 6, "reserved", "u16", "", 0, Access::reserved, "", ""},
    {word::rows, 1, "rows", "u16", "2..512", 0, Access::write, "start",
     "number of rows of the table; ECAMTBX writes it too"},
    {word::table_offset, 1, "table offset", "u16", "40", 40, Access::write, "start",
     "where the table begins; ECAMTBX writes it too"},
    {word::table, 2, "row master", "i32", "0..", 0, Access::write, "start",
     "master position of row 0; row i at 40 + 4 i, ascending"},
    {42, 2, "row slave", "i32", "", 0, Access::write, "start", "slave position of row 0; row i at 42 + 4 i"},
};

// Word 4: the manual's table says bits 1 and 2, its text and its example bits 0 and 1.
constexpr BlockFlag flags[] = {
    {1, 0, "initialised", "reset", "ready to run; off again when a non-cyclic cam has run, and when stopped"},
    {1, 1, "completed", "reset", "a cycle, or a non-cyclic cam with all its repeats, has ended"},
    {1, 2, "delayed", "read", "the frequency limit held pulses back since the start; they come later"},
    {1, 3, "stopped", "read", "an error has stopped the cam"},
    {1, 4, "parameter error", "read", "6781, the code is in word 2"},
    {1, 5, "table error", "read", "6782, the row is in word 2"},
    {1, 6, "cyclic", "read", "a cyclic cam is active; with `repeats` HFFFF from the start signal on"},
    {1, 7, "non-cyclic", "read", "a non-cyclic cam is active; with `repeats` HFFFF until the start signal"},
    {1, 9, "cycle completed", "reset", "a cycle has ended, each repeat too"},
    {1, 10, "in window", "read", "the synchronous output is on"},
    {1, 11, "time axis", "read", "the master is the time"},
    {3, 0, "delayed start", "write", "non-cyclic: the cam starts `delay` counts after the start signal"},
    {3, 1, "start position", "write", "non-cyclic: the master begins at `start position`"},
    {3, 2, "master zoom", "write", "master positions are counts x numerator / denominator"},
    {3, 3, "slave zoom", "write", "output pulses are table positions x numerator / denominator"},
    {3, 5, "external start", "write", "the rising edge of S3 starts the cam"},
    {3, 6, "resume", "write", "the cam goes on at `master counts` and `slave pulses`"},
    {4, 0, "sync output", "write", "the synchronous output works"},
    {4, 1, "stop after cycle", "write", "the cam stops exactly at the end of the present cycle"},
};

constexpr BlockReading readings_of_blocks[] = {
    {"initial values",
     "the manual gives words 6, 23, 24, 29, 30 and 39 initial values and does not say who writes them: words "
     "that no program, file or scenario has written have them when the cam starts; a 0 that was written "
     "stays"},
    {"word 4", "the register table names bits 1 and 2, the text and the examples bits 0 and 1: bits 0 and 1"},
    {"words 9 to 12",
     "the table crosses low and high, the text and the example do not: 9 and 10 are the low threshold, 11 "
     "and "
     "12 the high one; both ends are inside"},
    {"thresholds beyond the table",
     "the manual does not limit them: the master's position in the cycle never reaches what lies beyond the "
     "last row, which is told"},
    {"word 14",
     "HFFFF turns a non-cyclic cam cyclic: from its start signal on it is one, flags included, and also runs "
     "backwards past its first row"},
    {"word 17", "the cam begins at this position; it does not wait for the master to come there"},
    {"words 19 and 21", "printed as unsigned; a slave that runs backwards needs them signed"},
    {"word 31",
     "reserved in print; midCAMend stops by itself, and the print does not say how DECAM knows: by this "
     "word, as if word 4 bit 1 were on, whatever the program writes there. A program that makes rows of its "
     "own where ECAMTBX had made such a table writes 0"},
    {"words 19 and 27",
     "pulses and counts since the start, words 21 and 25 positions of the table: with a table that begins at "
     "(0, 0) and without zoom they are the same; function bit 6 goes on from the former"},
    {"a running cam",
     "ECAMTBX into its block acts at the next start; the thresholds (words 9 to 12), which it writes too, at "
     "once"},
    {"S1 a high-speed counter",
     "the pulses of its terminals move the cam; the print has one sentence for all counters, that a changed "
     "value acts on it, which fits those that are no hardware: DMOV K0 C235 moves no cam"},
    {"word 3 bit 5", "off: a non-cyclic cam runs once each time that word 5 starts it"},
    {"word 6", "0 is in the printed range: nothing comes out, which is told"},
};

constexpr SpecialRegister specials[] = {
    {"M8000", "bit", "read", "on while the program runs"},
    {"M8001", "bit", "read", "off while the program runs"},
    {"M8002", "bit", "read", "on in the first scan"},
    {"M8003", "bit", "read", "off in the first scan"},
    {"M8004", "bit", "read", "an error has happened"},
    {"M8011", "bit", "read", "clock of 10 ms"},
    {"M8012", "bit", "read", "clock of 100 ms"},
    {"M8013", "bit", "read", "clock of 1 s"},
    {"M8014", "bit", "read", "clock of 1 min"},
    {"M8020", "bit", "read", "the result of the last calculation is 0"},
    {"M8021", "bit", "read", "it is below the smallest number; of SQR: it had decimals"},
    {"M8022", "bit", "write", "it is above the largest number; of ROL and ROR: the bit that went round last"},
    {"M8024", "bit", "write", "BMOV moves from D to S"},
    {"M8029", "bit", "read", "DDRVI, DDRVA, PLSY, PLSR or ZRN is done"},
    {"M8031", "bit", "write", "clears all that is not retentive at the end of the scan; goes off by itself"},
    {"M8032", "bit", "write", "clears all that is retentive at the end of the scan; goes off by itself"},
    {"M8033", "bit", "write", "a stop leaves outputs and registers as they are"},
    {"M8034", "bit", "write", "all outputs are off, pulses too, from the end of the scan on"},
    {"M8036", "bit", "write", "lets a program that M8037 has stopped run again; goes off by itself"},
    {"M8037", "bit", "write", "stops the program at the end of the scan; goes off by itself"},
    {"M8039", "bit", "write", "a scan takes at least the time of D8039"},
    {"M8040", "bit", "write", "the steps of sequences do not go on to others"},
    {"M8046", "bit", "read", "with M8047: a step of a sequence, S0 to S899, is active"},
    {"M8047", "bit", "write", "D8040 to D8047 and M8046 tell which steps are active"},
    {"M8048", "bit", "read", "with M8049: one of S900 to S999 is on"},
    {"M8049", "bit", "write", "D8049 and M8048 tell which of S900 to S999 is on"},
    {"M8050", "bit", "write", "interrupts of X0 are not taken; so on to M8055 of X5", 6},
    {"M8056", "bit", "write", "interrupts I6.. are not taken; so on to M8058 of I8..", 3},
    {"M8059", "bit", "write", "interrupts I010 to I060 of counters are not taken"},
    {"M8061", "bit", "read", "the PLC has stopped by itself; the code is in D8061"},
    {"M8067", "bit", "read", "an instruction failed; the code is in D8067"},
    {"M8145", "bit", "write", "stops the pulses of Y0 at once"},
    {"M8146", "bit", "write", "stops the pulses of Y1 at once"},
    {"M8147", "bit", "read", "Y0 is in use"},
    {"M8148", "bit", "read", "Y1 is in use"},
    {"M8149", "bit", "read", "Y2 is in use"},
    {"M8150", "bit", "read", "Y3 is in use"},
    {"M8152", "bit", "write", "stops the pulses of Y2 at once"},
    {"M8153", "bit", "write", "stops the pulses of Y3 at once"},
    {"M8168", "bit", "write", "SMOV moves hexadecimal digits"},
    {"M8200", "bit", "write", "C200 counts down; so on to M8234", 35},
    {"M8235", "bit", "write", "C235 counts down; so on to M8245", 11},
    {"M8246", "bit", "read", "C246 is counting down; so on to M8255", 10},
    {"D8000", "u16", "write", "watchdog time [ms], from the next scan or WDT on; 200 at power-up and for 0"},
    {"D8010", "u16", "read", "time of a scan [0.1 ms]"},
    {"D8011", "u16", "read", "shortest since the program runs"},
    {"D8012", "u16", "read", "longest since the program runs"},
    {"D8013", "u16", "read", "clock: second"},
    {"D8014", "u16", "read", "clock: minute"},
    {"D8015", "u16", "read", "clock: hour"},
    {"D8016", "u16", "read", "clock: day"},
    {"D8017", "u16", "read", "clock: month"},
    {"D8018", "u16", "read", "clock: year, two digits"},
    {"D8019", "u16", "read", "clock: weekday, 0 is Sunday"},
    {"D8039", "u16", "write", "with M8039: least time of a scan [ms]"},
    {"D8040", "u16", "read", "with M8047: number of the first active step; up to D8047 of the eighth", 8},
    {"D8049", "u16", "read", "with M8049: number of the first of S900 to S999 that is on"},
    {"D8061", "u16", "read", "6105: a scan worked longer than the watchdog time (D8000)"},
    {"D8067", "u16", "read", "code of the last instruction error"},
    {"D8069", "u16", "read", "step of the last instruction error"},
    {"D8140", "i32", "write", "pulses of Y0, less those backwards"},
    {"D8142", "i32", "write", "pulses of Y1, less those backwards"},
    {"D8145", "u16", "write", "bias speed of DDRVI, DDRVA and ZRN [Hz]"},
    {"D8146", "i32", "write", "top speed of DDRVI, DDRVA and ZRN [Hz]"},
    {"D8148", "u16", "write", "ramp of DDRVI, DDRVA and ZRN from bias to top speed [ms]"},
    {"D8150", "i32", "write", "pulses of Y2, less those backwards"},
    {"D8152", "i32", "write", "pulses of Y3, less those backwards"},
};

}  // namespace

std::span<const BlockWord> block_words() { return words; }
std::span<const BlockFlag> block_flags() { return flags; }
std::span<const SpecialRegister> special_registers() { return specials; }

const SpecialRegister* special_register(char letter, int number) {
  if (number < first_special) return nullptr;
  const auto* const row =
      std::find_if(std::begin(specials), std::end(specials), [&](const SpecialRegister& special) {
        const int first = parsed<int>(special.name.substr(1)).value_or(0);
        const int count = special.type == "i32" ? 2 : special.count;
        return special.name.front() == letter && number >= first && number < first + count;
      });
  return row == std::end(specials) ? nullptr : row;
}

bool is_served(char letter, int number) {
  return number < first_special || special_register(letter, number) != nullptr;
}

std::string served_specials(char letter) {
  const int end = letter == 'D' ? data_words : relays;
  std::string text;
  for (int first = first_special; first < end; ++first) {
    if (!is_served(letter, first)) continue;
    int last = first;
    while (last + 1 < end && is_served(letter, last + 1)) ++last;
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", letter, first);
    if (last > first) text += fmt::format(" to {}{}", letter, last);
    first = last;
  }
  return text;
}

std::span<const BlockReading> block_readings() { return readings_of_blocks; }

std::string take_initial_values(Registers& registers, int block) {
  std::string given;
  for (const BlockWord& entry : words) {
    if (entry.access != Access::write || entry.set_up == 0) continue;
    const auto at = static_cast<std::size_t>(block + entry.offset);
    if (registers.written[at] || (entry.words == 2 && registers.written[at + 1])) continue;
    // Not marked as written: what the program writes later is its own.
    registers.d[at] = static_cast<std::uint16_t>(entry.set_up);
    if (entry.words == 2) registers.d[at + 1] = static_cast<std::uint16_t>(entry.set_up >> 16);
    given += fmt::format("{}D{} {}", given.empty() ? "" : ", ", at, entry.set_up);
  }
  return given;
}

}  // namespace drycut::devices::lx3vp
