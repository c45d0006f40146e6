#include "devices/lx3vp/il_program.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/text.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

using namespace form;

constexpr Mnemonic contacts_and_coils[] = {
    {"LD", Op::on, "b", n, 1, 0, "begins with a contact: ON if the device is ON"},
    {"LDI", Op::off, "b", n, 1, 0, "begins with a contact: ON if the device is OFF"},
    {"LDP", Op::rising, "b", n, 2, 0, "begins with a contact: ON for one scan as the device goes ON"},
    {"LDF", Op::falling, "b", n, 2, 0, "begins with a contact: ON for one scan as the device goes OFF"},
    {"AND", Op::on, "b", n, 1, 0, "contact in series, ON if the device is ON"},
    {"ANI", Op::off, "b", n, 1, 0, "contact in series, ON if the device is OFF"},
    {"ANDP", Op::rising, "b", n, 2, 0, "contact in series, ON for one scan as the device goes ON"},
    {"ANDF", Op::falling, "b", n, 2, 0, "contact in series, ON for one scan as the device goes OFF"},
    {"OR", Op::on, "b", n, 1, 0, "contact in parallel, ON if the device is ON"},
    {"ORI", Op::off, "b", n, 1, 0, "contact in parallel, ON if the device is OFF"},
    {"ORP", Op::rising, "b", n, 2, 0, "contact in parallel, ON for one scan as the device goes ON"},
    {"ORF", Op::falling, "b", n, 2, 0, "contact in parallel, ON for one scan as the device goes OFF"},
    {"LD=", Op::equal, "nn", nw, 5, 9, "begins with a comparison: equal"},
    {"LD>", Op::greater, "nn", nw, 5, 9, "begins with a comparison: greater"},
    {"LD<", Op::less, "nn", nw, 5, 9, "begins with a comparison: less"},
    {"LD<>", Op::unequal, "nn", nw, 5, 9, "begins with a comparison: not equal"},
    {"LD<=", Op::less_or_equal, "nn", nw, 5, 9, "begins with a comparison: less or equal"},
    {"LD>=", Op::greater_or_equal, "nn", nw, 5, 9, "begins with a comparison: greater or equal"},
    {"AND=", Op::equal, "nn", nw, 5, 9, "comparison in series: equal"},
    {"AND>", Op::greater, "nn", nw, 5, 9, "comparison in series: greater"},
    {"AND<", Op::less, "nn", nw, 5, 9, "comparison in series: less"},
    {"AND<>", Op::unequal, "nn", nw, 5, 9, "comparison in series: not equal"},
    {"AND<=", Op::less_or_equal, "nn", nw, 5, 9, "comparison in series: less or equal"},
    {"AND>=", Op::greater_or_equal, "nn", nw, 5, 9, "comparison in series: greater or equal"},
    {"OR=", Op::equal, "nn", nw, 5, 9, "comparison in parallel: equal"},
    {"OR>", Op::greater, "nn", nw, 5, 9, "comparison in parallel: greater"},
    {"OR<", Op::less, "nn", nw, 5, 9, "comparison in parallel: less"},
    {"OR<>", Op::unequal, "nn", nw, 5, 9, "comparison in parallel: not equal"},
    {"OR<=", Op::less_or_equal, "nn", nw, 5, 9, "comparison in parallel: less or equal"},
    {"OR>=", Op::greater_or_equal, "nn", nw, 5, 9, "comparison in parallel: greater or equal"},
    {"ANB", Op::anb, "", n, 1, 0, "joins the last two blocks in series"},
    {"ORB", Op::orb, "", n, 1, 0, "joins the last two blocks in parallel"},
    {"MPS", Op::mps, "", n, 1, 0, "keeps the result for a branch"},
    {"MRD", Op::mrd, "", n, 1, 0, "takes the kept result up again"},
    {"MPP", Op::mpp, "", n, 1, 0, "takes the kept result up for the last time"},
    {"INV", Op::inv, "", n, 1, 0, "inverts the result"},
    {"OUT", Op::out, "o", n, 1, 0, "coil; of a timer or counter with its set value after it"},
    {"SET", Op::set, "s", n, 1, 0, "switches ON and leaves ON"},
    {"RST", Op::rst, "r", n, 1, 0, "switches OFF; a timer, a counter or a register to 0"},
    {"PLS", Op::pls, "e", n, 2, 0, "ON for one scan as the result goes ON"},
    {"PLF", Op::plf, "e", n, 2, 0, "ON for one scan as the result goes OFF"},
};

// What DPLSV, DDRVI and DDRVA take of a register beyond it they limit.
constexpr NumberRange plsv_numbers[] = {{0, "the frequency S", -max_frequency_hz, max_frequency_hz}};
constexpr NumberRange drives_numbers[] = {{1, "the frequency S2", 1, max_frequency_hz}};
constexpr NumberRange plsy_numbers[] = {{0, "the frequency S1", 0, max_frequency_hz},
                                        {1, "the number of pulses S2", 0}};
constexpr NumberRange plsr_numbers[] = {{0, "the frequency S1", 1, max_frequency_hz},
                                        {1, "the number of pulses S2", 1},
                                        {2, "the ramp S3", 50, 5000}};
constexpr NumberRange pwm_numbers[] = {{0, "the time S1", 0}, {1, "the period S2", 1}};
constexpr NumberRange zrn_numbers[] = {{0, "the speed S1", 1, max_frequency_hz},
                                       {1, "the creep speed S2", 1, max_frequency_hz}};
constexpr NumberRange spd_numbers[] = {{1, "the time S2", 1}};

constexpr Mnemonic pulses_and_flow[] = {
    {"PLSV", Op::plsv, "npy", nw, 9, 17, "pulses at S Hz from D1, direction on D2 (ON: S above 0)", nullptr,
     plsv_numbers},
    {"DRVI", Op::drvi, "nnpy", nw, 9, 17, "S1 pulses at S2 Hz from D1, direction on D2", nullptr,
     drives_numbers},
    {"DRVA", Op::drva, "nnpy", nw, 9, 17, "pulses to position S1 at S2 Hz from D1, direction on D2", nullptr,
     drives_numbers},
    {"PLSY", Op::plsy, "nnp", nw, 7, 13, "S2 pulses (0: without end) at S1 Hz from D, no direction", nullptr,
     plsy_numbers},
    {"PLSR", Op::plsr, "nnnp", nw, 9, 17, "S2 pulses at S1 Hz from D with ramps of S3 ms, no direction",
     nullptr, plsr_numbers},
    {"PWM", Op::pwm, "nnp", n, 7, 0, "D is ON for S1 of every S2 ms", nullptr, pwm_numbers},
    {"ZRN", Op::zrn, "nngp", nw, 9, 17,
     "backwards at S1 Hz to the signal S3, at S2 Hz until it ends; position 0", nullptr, zrn_numbers},
    {"HSCS", Op::hscs, "nHI", w, 13, 13,
     "D goes ON, or its interrupt comes, at once as counter S2 comes to S1"},
    {"HSCR", Op::hscr, "nHR", w, 13, 13, "D goes OFF, or S2 to 0, at once as counter S2 comes to S1"},
    {"HSZ", Op::hsz, "nnHB", w, 17, 17,
     "three devices from D on at once as counter S counts: below, within, above S1..S2"},
    {"SPD", Op::spd, "Xn3", n, 7, 0,
     "D = pulses of input S1 in S2 ms; behind it those of the present time, and what is left of it [ms]",
     nullptr, spd_numbers},
    {"DECAM", Op::decam, "mdxpy", n, 21, 0, "electronic cam: master, block, start, pulses, direction"},
    {"ECAMTBX", Op::ecamtbx, "atdD", n, 17, 0, "makes a cam table: parameters, type, block, result"},
    {"MC", Op::mc, "Ne", n, 3, 0, "a master contact for all that follows, to MCR; its device shows it"},
    {"MCR", Op::mcr, "N", n, 2, 0, "ends the master contact"},
    {"STL", Op::stl, "S", n, 1, 0, "what follows works while this step of a sequence is active"},
    {"RET", Op::ret, "", n, 1, 0, "ends the steps of a sequence"},
    {"FOR", Op::for_, "n", n, 3, 0, "repeats what follows n times, to NEXT; five in each other"},
    {"NEXT", Op::next, "", n, 1, 0, "ends what FOR repeats"},
    {"CJ", Op::cj, "P", np, 3, 0, "goes on at a label; at END if it is P63 and not given"},
    {"CALL", Op::call, "P", np, 3, 0, "runs the subroutine at a label, behind FEND, to its SRET"},
    {"SRET", Op::sret, "", n, 1, 0, "ends a subroutine"},
    {"IRET", Op::iret, "", n, 1, 0,
     "ends an interrupt routine, which begins behind FEND with its label: I001"},
    {"EI", Op::ei, "", n, 1, 0, "lets interrupts come; at power-up they do not"},
    {"DI", Op::di, "", n, 1, 0, "lets interrupts wait for the next EI"},
    {"WDT", Op::wdt, "", np, 1, 0, "gives the scan the watchdog's time anew"},
    {"REF", Op::ref, "Ak", np, 5, 0, "takes n inputs, or gives n outputs, from X or Y on at once"},
    {"NOP", Op::nop, "", n, 1, 0, "does nothing"},
    {"FEND", Op::fend, "", n, 1, 0, "ends the scan before the end of the text"},
    {"END", Op::end, "", n, 1, 0, "ends the program"},
};

/// The 32-bit form's name: DMOV, but LDD= and DAND.
std::string wide_name(const Mnemonic& m) {
  const std::string name(m.name);
  if (is_comparison(m.op)) {
    const auto sign = name.find_first_of("<=>");
    return name.substr(0, sign) + "D" + name.substr(sign);
  }
  if (name.front() == 'W') return "D" + name.substr(1);
  return "D" + name;
}

std::vector<Spelling> all_spellings() {
  std::vector<Spelling> all;
  for (const auto& m : mnemonics()) {
    for (const bool wide : {false, true}) {
      if (!m.has(wide ? w : n)) continue;
      const auto name = wide ? wide_name(m) : std::string(m.name);
      all.push_back({name, &m, wide, false});
      if (m.has(p)) all.push_back({name + "P", &m, wide, true});
    }
  }
  return all;
}

}  // namespace

std::span<const Mnemonic> mnemonics() {
  static const auto all = [] {
    std::vector<Mnemonic> rows;
    for (const std::span<const Mnemonic> part :
         {std::span<const Mnemonic>(contacts_and_coils), word_mnemonics(), shift_mnemonics(),
          data_mnemonics(), real_mnemonics(), std::span<const Mnemonic>(pulses_and_flow)})
      rows.insert(rows.end(), part.begin(), part.end());
    return rows;
  }();
  return all;
}

std::span<const BlockReading> instruction_readings() {
  static constexpr BlockReading readings[] = {
      {"all",
       "the cam manual has no instruction list: mnemonics, steps, ranges, flags and codes are the FX "
       "family's, which the unit follows"},
      {"index",
       "added to numbers of devices and to constants; a 32-bit instruction takes V with Z; what then "
       "does not exist is 6706; none at labels, pulse terminals, DECAM, ECAMTBX, timers and counters of "
       "OUT"},
      {"time",
       "a scan takes none unless the scenario gives controller.lx3vp.step_time: then an instruction takes "
       "it, "
       "and each word that a block moves; inputs are taken at the beginning of a scan, outputs given at its "
       "end, the next begins `scan` after the last or at its end; 6105 after 200 ms"},
      {"FOR", "five in each other; 0 and less are once; CJ may leave a loop, not enter one"},
      {"CALL", "five deep, else 6702; subroutines stand behind FEND and hold no STL and no MC"},
      {"MC", "without power coils go off and what was set stays; LDI, INV and the like have no power either"},
      {"STL",
       "SET and OUT of a state with an STL switch the present one off at once; its instructions run once "
       "more, without power, in the next scan and are then left alone; CJ stays inside a state"},
      {"PLSY", "no ramp, no direction output; D8140.. count forwards; S2 = 0 without end"},
      {"ZRN",
       "backwards with the ramp of D8148, no direction output and no clear signal; zero where the dog "
       "ends; a start on the dog creeps"},
      {"6105",
       "an instruction, and each word or bit that one moves, is 0.2 us of the watchdog's time (D8000); "
       "WDT gives it anew up to ten times it, and 32767 ms; the PLC then stops until power-up"},
      {"interrupts",
       "a routine runs in the tick of 100 us that brings its interrupt, between two instructions; one at a "
       "time, as they came, of one tick the lower number first; X is the scan's image and Y is given at its "
       "end, but for REF; I610 and its kind come at multiples of their time since power-up; what DI holds "
       "back waits once, what M8050 to M8059 refuse is lost"},
      {"DHSCS",
       "also DHSCR and DHSZ: compared as the counter counts, not as a program writes it; a count that passes "
       "S1 within a tick has come to it; any number of them; a counter that resets itself counts on from 0"},
      {"SPD", "takes the input every 100 us: pulses shorter than that are lost"},
      {"PWM", "in steps of 100 us; begins ON; counts no pulses; a change of the times acts at once"},
      {"PLSR", "straight ramps of S3, 50 to 5000 ms, from standstill; D8140.. count forwards"},
      {"numbers",
       "a constant out of its range is refused when the program is read; a register's value is 6706, and the "
       "instruction does nothing; of DPLSV, DDRVI and DDRVA the frequency is limited instead, to 200 kHz"},
      {"read only",
       "special registers that the PLC writes itself: a program that names them to be written is refused, an "
       "index register that leads there is 6706; M8022 is written by programs too"},
      {"BMOV",
       "a word takes a group of fewer bits as a number, and a group the low bits of a word; two groups are "
       "of as many bits"},
      {"SFWR", "also SFRD: M8022 and M8020 go off again when the queue has room, or a value"},
      {"clock",
       "begins with each run at 2000-01-01, a Saturday, 0:00:00, goes on without power, and has the "
       "calendar's weekday; TWR alone sets it: M8015 is none of the relays here, and D8013 to D8019 are read "
       "only"},
      {"M8034", "pulse outputs too give nothing, while D8140.. and the cams count on"},
      {"RUN",
       "while the program is stopped, by M8037 or 6105, M8000 and M8002 are off, M8001 and M8003 on, and the "
       "clocks M8011 to M8014 and D8013 to D8019 go on; without power all special relays but M8001 and M8003 "
       "are off"},
      {"M8037",
       "stops with or without M8035, which is none of the relays here; pulses stop at once and high-speed "
       "counters too; timers, counters and registers that are not retentive are cleared unless M8033 is on; "
       "M8036, written from outside, lets the program begin anew with M8002"},
  };
  return readings;
}

const std::vector<Spelling>& spellings() {
  static const std::vector<Spelling> all = all_spellings();
  return all;
}

const Spelling* find_spelling(std::string_view text) {
  static const auto by_name = [] {
    std::map<std::string, const Spelling*, std::less<>> names;
    for (const auto& spelling : spellings()) names.emplace(spelling.text, &spelling);
    return names;
  }();
  const auto found = by_name.find(upper(text));
  return found == by_name.end() ? nullptr : found->second;
}

bool is_not_simulated(std::string_view text) {
  if (find_spelling(text) != nullptr) return false;
  // FX, and the pulse and CAN instructions of the LX3V series.
  static constexpr std::string_view names[] = {
      "DSZR", "DVIT", "TBL",  "ABS",  "PTO",  "RCL",  "RCR",  "TO",   "FROM", "RS",  "CCD", "PRUN", "ASCI",
      "HEX",  "PID",  "ANS",  "ANR",  "SQRT", "ESQR", "EBCD", "EBIN", "SIN",  "COS", "TAN", "REFF", "MTR",
      "IST",  "SER",  "ABSD", "INCD", "TTMR", "STMR", "RAMP", "ROTC", "SORT", "TKY", "HKY", "DSW",  "SEGD",
      "SEGL", "ARWS", "ASC",  "PR",   "VRRD", "VRSC", "HOUR", "GRY",  "GBIN", "CRC", "MEP", "MEF"};
  const auto told = upper(text);
  const auto is_name = [](std::string_view name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
  };
  const std::string_view whole = told;
  const auto without_p = whole.ends_with('P') ? whole.substr(0, whole.size() - 1) : whole;
  const auto without_d = [](std::string_view name) { return name.starts_with('D') ? name.substr(1) : name; };
  return is_name(whole) || is_name(without_p) || is_name(without_d(whole)) || is_name(without_d(without_p));
}

}  // namespace drycut::devices::lx3vp::il
