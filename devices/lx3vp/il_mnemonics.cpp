#include "devices/lx3vp/il_mnemonics.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "base/text.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr std::uint8_t n = Mnemonic::narrow;
constexpr std::uint8_t w = Mnemonic::wide;
constexpr std::uint8_t nw = n | w;
constexpr std::uint8_t nwp = n | w | Mnemonic::pulse;
constexpr std::uint8_t np = n | Mnemonic::pulse;
constexpr std::uint8_t wp = w | Mnemonic::pulse;

constexpr std::array table = {
    Mnemonic{"LD", Op::ld, "b", n, 1, 0, "begins with a contact: ON if the device is ON"},
    Mnemonic{"LDI", Op::ldi, "b", n, 1, 0, "begins with a contact: ON if the device is OFF"},
    Mnemonic{"LDP", Op::ldp, "b", n, 2, 0, "begins with a contact: ON for one scan as the device goes ON"},
    Mnemonic{"LDF", Op::ldf, "b", n, 2, 0, "begins with a contact: ON for one scan as the device goes OFF"},
    Mnemonic{"AND", Op::and_, "b", n, 1, 0, "contact in series, ON if the device is ON"},
    Mnemonic{"ANI", Op::ani, "b", n, 1, 0, "contact in series, ON if the device is OFF"},
    Mnemonic{"ANDP", Op::andp, "b", n, 2, 0, "contact in series, ON for one scan as the device goes ON"},
    Mnemonic{"ANDF", Op::andf, "b", n, 2, 0, "contact in series, ON for one scan as the device goes OFF"},
    Mnemonic{"OR", Op::or_, "b", n, 1, 0, "contact in parallel, ON if the device is ON"},
    Mnemonic{"ORI", Op::ori, "b", n, 1, 0, "contact in parallel, ON if the device is OFF"},
    Mnemonic{"ORP", Op::orp, "b", n, 2, 0, "contact in parallel, ON for one scan as the device goes ON"},
    Mnemonic{"ORF", Op::orf, "b", n, 2, 0, "contact in parallel, ON for one scan as the device goes OFF"},
    Mnemonic{"LD=", Op::ld_equal, "nn", nw, 5, 9, "begins with a comparison: equal"},
    Mnemonic{"LD>", Op::ld_gt, "nn", nw, 5, 9, "begins with a comparison: greater"},
    Mnemonic{"LD<", Op::ld_lt, "nn", nw, 5, 9, "begins with a comparison: less"},
    Mnemonic{"LD<>", Op::ld_unequal, "nn", nw, 5, 9, "begins with a comparison: not equal"},
    Mnemonic{"LD<=", Op::ld_le, "nn", nw, 5, 9, "begins with a comparison: less or equal"},
    Mnemonic{"LD>=", Op::ld_ge, "nn", nw, 5, 9, "begins with a comparison: greater or equal"},
    Mnemonic{"AND=", Op::and_equal, "nn", nw, 5, 9, "comparison in series: equal"},
    Mnemonic{"AND>", Op::and_gt, "nn", nw, 5, 9, "comparison in series: greater"},
    Mnemonic{"AND<", Op::and_lt, "nn", nw, 5, 9, "comparison in series: less"},
    Mnemonic{"AND<>", Op::and_unequal, "nn", nw, 5, 9, "comparison in series: not equal"},
    Mnemonic{"AND<=", Op::and_le, "nn", nw, 5, 9, "comparison in series: less or equal"},
    Mnemonic{"AND>=", Op::and_ge, "nn", nw, 5, 9, "comparison in series: greater or equal"},
    Mnemonic{"OR=", Op::or_equal, "nn", nw, 5, 9, "comparison in parallel: equal"},
    Mnemonic{"OR>", Op::or_gt, "nn", nw, 5, 9, "comparison in parallel: greater"},
    Mnemonic{"OR<", Op::or_lt, "nn", nw, 5, 9, "comparison in parallel: less"},
    Mnemonic{"OR<>", Op::or_unequal, "nn", nw, 5, 9, "comparison in parallel: not equal"},
    Mnemonic{"OR<=", Op::or_le, "nn", nw, 5, 9, "comparison in parallel: less or equal"},
    Mnemonic{"OR>=", Op::or_ge, "nn", nw, 5, 9, "comparison in parallel: greater or equal"},
    Mnemonic{"ANB", Op::anb, "", n, 1, 0, "joins the last two blocks in series"},
    Mnemonic{"ORB", Op::orb, "", n, 1, 0, "joins the last two blocks in parallel"},
    Mnemonic{"MPS", Op::mps, "", n, 1, 0, "keeps the result for a branch"},
    Mnemonic{"MRD", Op::mrd, "", n, 1, 0, "takes the kept result up again"},
    Mnemonic{"MPP", Op::mpp, "", n, 1, 0, "takes the kept result up for the last time"},
    Mnemonic{"INV", Op::inv, "", n, 1, 0, "inverts the result"},
    Mnemonic{"OUT", Op::out, "o", n, 1, 0, "coil; of a timer or counter with its set value after it"},
    Mnemonic{"SET", Op::set, "s", n, 1, 0, "switches ON and leaves ON"},
    Mnemonic{"RST", Op::rst, "r", n, 1, 0, "switches OFF; a timer, a counter or a register to 0"},
    Mnemonic{"PLS", Op::pls, "e", n, 2, 0, "ON for one scan as the result goes ON"},
    Mnemonic{"PLF", Op::plf, "e", n, 2, 0, "ON for one scan as the result goes OFF"},
    Mnemonic{"ZRST", Op::zrst, "ll", np, 5, 0, "resets all devices from the one to the other"},
    Mnemonic{"ALT", Op::alt, "s", np, 3, 0, "inverts a device"},
    Mnemonic{"MOV", Op::mov, "nw", nwp, 5, 9, "D = S"},
    Mnemonic{"CML", Op::cml, "nw", nwp, 5, 9, "D = S with every bit inverted"},
    Mnemonic{"BMOV", Op::bmov, "iik", np, 7, 0, "moves n words from S on to D on"},
    Mnemonic{"FMOV", Op::fmov, "nik", nwp, 7, 13, "writes S into n words (values) from D on"},
    Mnemonic{"XCH", Op::xch, "ww", nwp, 5, 9, "exchanges two values"},
    Mnemonic{"ADD", Op::add, "nnw", nwp, 7, 13, "D = S1 + S2"},
    Mnemonic{"SUB", Op::sub, "nnw", nwp, 7, 13, "D = S1 - S2"},
    Mnemonic{"MUL", Op::mul, "nnq", nwp, 7, 13, "D = S1 * S2, in twice as many words"},
    Mnemonic{"DIV", Op::div, "nnq", nwp, 7, 13, "D = S1 / S2, the remainder behind it"},
    Mnemonic{"INC", Op::inc, "w", nwp, 3, 5, "adds 1, from the largest to the smallest"},
    Mnemonic{"DEC", Op::dec, "w", nwp, 3, 5, "takes off 1, from the smallest to the largest"},
    Mnemonic{"NEG", Op::neg, "w", nwp, 3, 5, "changes the sign"},
    Mnemonic{"WAND", Op::wand, "nnw", nwp, 7, 13, "D = S1 and S2, bit by bit (32 bit: DAND)"},
    Mnemonic{"WOR", Op::wor, "nnw", nwp, 7, 13, "D = S1 or S2, bit by bit (32 bit: DOR)"},
    Mnemonic{"WXOR", Op::wxor, "nnw", nwp, 7, 13, "D = S1 exclusive or S2, bit by bit (32 bit: DXOR)"},
    Mnemonic{"CMP", Op::cmp, "nnB", nwp, 7, 13, "three devices from D on: S1 > S2, S1 = S2, S1 < S2"},
    Mnemonic{"ZCP", Op::zcp, "nnnB", nwp, 9, 17, "three devices from D on: S below, within, above S1..S2"},
    Mnemonic{"SFTL", Op::sftl, "ghkk", np, 9, 0, "shifts n1 bits from D on up by n2, from S on fill in"},
    Mnemonic{"SFTR", Op::sftr, "ghkk", np, 9, 0, "shifts n1 bits from D on down by n2, from S on fill in"},
    Mnemonic{"ROL", Op::rol, "wk", nwp, 5, 7,
             "turns D round to the left by n bits, the last of them in M8022"},
    Mnemonic{"ROR", Op::ror, "wk", nwp, 5, 7, "turns D round to the right by n bits, the last in M8022"},
    Mnemonic{"BCD", Op::bcd, "nw", nwp, 5, 9, "D = S with a decimal digit in each four bits"},
    Mnemonic{"BIN", Op::bin, "nw", nwp, 5, 9, "D = S, which has a decimal digit in each four bits"},
    Mnemonic{"MEAN", Op::mean, "uwk", nwp, 7, 13, "D = mean of n values (1 to 64) from S on, no decimals"},
    Mnemonic{"SQR", Op::sqr, "ji", nwp, 5, 9, "D = square root of S, no decimals"},
    Mnemonic{"FLT", Op::flt, "iF", nwp, 5, 9, "D = S as a floating-point number"},
    Mnemonic{"INT", Op::int_, "Fi", nwp, 5, 9, "D = S without its decimals"},
    Mnemonic{"EMOV", Op::emov, "fF", wp, 9, 9, "D = S, floating point"},
    Mnemonic{"EADD", Op::eadd, "ffF", wp, 13, 13, "D = S1 + S2, floating point"},
    Mnemonic{"ESUB", Op::esub, "ffF", wp, 13, 13, "D = S1 - S2, floating point"},
    Mnemonic{"EMUL", Op::emul, "ffF", wp, 13, 13, "D = S1 * S2, floating point"},
    Mnemonic{"EDIV", Op::ediv, "ffF", wp, 13, 13, "D = S1 / S2, floating point"},
    Mnemonic{"ECMP", Op::ecmp, "ffB", wp, 13, 13, "CMP of floating-point numbers"},
    Mnemonic{"EZCP", Op::ezcp, "fffB", wp, 17, 17, "ZCP of floating-point numbers"},
    Mnemonic{"PLSV", Op::plsv, "npy", nw, 9, 17, "pulses at S Hz from D1, direction on D2 (ON: S above 0)"},
    Mnemonic{"DRVI", Op::drvi, "nnpy", nw, 9, 17, "S1 pulses at S2 Hz from D1, direction on D2"},
    Mnemonic{"DRVA", Op::drva, "nnpy", nw, 9, 17, "pulses to position S1 at S2 Hz from D1, direction on D2"},
    Mnemonic{"PLSY", Op::plsy, "nnp", nw, 7, 13, "S2 pulses (0: without end) at S1 Hz from D, no direction"},
    Mnemonic{"ZRN", Op::zrn, "nngp", nw, 9, 17,
             "backwards at S1 Hz to the signal S3, at S2 Hz until it ends; position 0"},
    Mnemonic{"DECAM", Op::decam, "mdxpy", n, 21, 0,
             "electronic cam: master, block, start, pulses, direction"},
    Mnemonic{"ECAMTBX", Op::ecamtbx, "atdD", n, 17, 0, "makes a cam table: parameters, type, block, result"},
    Mnemonic{"MC", Op::mc, "Ne", n, 3, 0,
             "a master contact for all that follows, to MCR; its device shows it"},
    Mnemonic{"MCR", Op::mcr, "N", n, 2, 0, "ends the master contact"},
    Mnemonic{"STL", Op::stl, "S", n, 1, 0, "what follows works while this step of a sequence is active"},
    Mnemonic{"RET", Op::ret, "", n, 1, 0, "ends the steps of a sequence"},
    Mnemonic{"FOR", Op::for_, "n", n, 3, 0, "repeats what follows n times, to NEXT; five in each other"},
    Mnemonic{"NEXT", Op::next, "", n, 1, 0, "ends what FOR repeats"},
    Mnemonic{"CJ", Op::cj, "P", np, 3, 0, "goes on at a label; at END if it is P63 and not given"},
    Mnemonic{"CALL", Op::call, "P", np, 3, 0, "runs the subroutine at a label, behind FEND, to its SRET"},
    Mnemonic{"SRET", Op::sret, "", n, 1, 0, "ends a subroutine"},
    Mnemonic{"NOP", Op::nop, "", n, 1, 0, "does nothing"},
    Mnemonic{"FEND", Op::fend, "", n, 1, 0, "ends the scan before the end of the text"},
    Mnemonic{"END", Op::end, "", n, 1, 0, "ends the program"},
};

bool is_comparison(Op op) { return op >= Op::ld_equal && op <= Op::or_ge; }

/// The 32-bit form's name: DMOV, but LDD= and DAND.
std::string wide_name(const Mnemonic& m) {
  const std::string name(m.name);
  if (is_comparison(m.op)) {
    const auto sign = name.find_first_of("<=>");
    return name.substr(0, sign) + "D" + name.substr(sign);
  }
  if (m.op == Op::wand || m.op == Op::wor || m.op == Op::wxor) return "D" + name.substr(1);
  return "D" + name;
}

std::vector<Spelling> all_spellings() {
  std::vector<Spelling> all;
  for (const auto& m : table) {
    for (const bool wide : {false, true}) {
      if (!m.has(wide ? Mnemonic::wide : Mnemonic::narrow)) continue;
      const auto name = wide ? wide_name(m) : std::string(m.name);
      all.push_back({name, &m, wide, false});
      if (m.has(Mnemonic::pulse)) all.push_back({name + "P", &m, wide, true});
    }
  }
  return all;
}

}  // namespace

std::span<const Mnemonic> mnemonics() { return table; }

std::span<const Reading> instruction_readings() {
  static constexpr Reading readings[] = {
      {"all",
       "the cam manual has no instruction list: mnemonics, steps, ranges, flags and codes are the FX "
       "family's, which the unit follows"},
      {"index",
       "added to numbers of devices and to constants; a 32-bit instruction takes V with Z; what then "
       "does not exist is 6706; none at labels, pulse terminals, DECAM, ECAMTBX, timers and counters of "
       "OUT"},
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
       "an instruction, and each word or bit that one moves, is 0.2 us of the watchdog's 200 ms; the PLC "
       "then stops until power-up"},
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
  // FX, and the pulse and CAN instructions of the LX3V series.
  static constexpr std::string_view names[] = {
      "IRET", "WDT",  "EI",   "DI",   "DSZR", "DVIT", "TBL",  "ABS",  "PLSR", "PWM",  "PTO",  "SPD",  "HSCS",
      "HSCR", "HSZ",  "WSFL", "WSFR", "SFWR", "SFRD", "RCL",  "RCR",  "TO",   "FROM", "RS",   "CCD",  "PRUN",
      "ASCI", "HEX",  "PID",  "SMOV", "DECO", "ENCO", "SUM",  "BON",  "ANS",  "ANR",  "SQRT", "ESQR", "EBCD",
      "EBIN", "SIN",  "COS",  "TAN",  "SWAP", "REF",  "REFF", "MTR",  "IST",  "SER",  "ABSD", "INCD", "TTMR",
      "STMR", "RAMP", "ROTC", "SORT", "TKY",  "HKY",  "DSW",  "SEGD", "SEGL", "ARWS", "ASC",  "PR",   "VRRD",
      "VRSC", "TCMP", "TZCP", "TADD", "TSUB", "TRD",  "TWR",  "HOUR", "GRY",  "GBIN", "CRC"};
  const auto told = upper(text);
  const auto is_name = [](std::string_view name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
  };
  const std::string_view whole = told;
  const auto without_p = whole.ends_with('P') ? whole.substr(0, whole.size() - 1) : whole;
  const auto without_d = [](std::string_view name) { return name.starts_with('D') ? name.substr(1) : name; };
  return is_name(whole) || is_name(without_p) || is_name(without_d(whole)) || is_name(without_d(without_p));
}

std::string_view operand_text(char kind) {
  switch (kind) {
    case 'b':
      return "X, Y, M, S, T, C or a bit of D (D10.F)";
    case 'o':
      return "Y, M, S, T, C or a bit of D (D10.F)";
    case 's':
      return "Y, M, S or a bit of D (D10.F)";
    case 'r':
      return "Y, M, S, T, C, D or a bit of D (D10.F)";
    case 'e':
      return "Y or M";
    case 'l':
      return "Y, M, S, T, C or D";
    case 'n':
      return "K, H, D, T, C, V, Z or bits (K4M0) of X, Y, M or S";
    case 'w':
      return "D, T, C, V, Z or bits (K4M0) of Y, M or S";
    case 'u':
      return "D, T, C or bits (K4M0) of X, Y, M or S";
    case 'g':
      return "X, Y, M or S";
    case 'S':
      return "S";
    case 'N':
      return "N0 to N7";
    case 'q':
    case 'i':
    case 'a':
    case 'd':
    case 'D':
    case 'F':
      return "D";
    case 'f':
      return "E (E1.5), K, H or D";
    case 'k':
    case 't':
    case 'j':
      return "K, H or D";
    case 'v':
      return "K or D";
    case 'B':
    case 'h':
      return "Y, M or S";
    case 'm':
      return "C, D or K";
    case 'x':
      return "X or M";
    case 'p':
      return "Y0 to Y3";
    case 'y':
      return "Y";
    case 'P':
      return "a label, P0 to P127";
    default:
      return "";
  }
}

}  // namespace drycut::devices::lx3vp::il
