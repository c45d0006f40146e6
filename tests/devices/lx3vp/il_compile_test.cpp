// Faults of instruction lists, each by its message.
#include <random>
#include <set>

#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "tests/devices/lx3vp/il_bench.hpp"
#include "tests/findings.hpp"

namespace drycut::devices::lx3vp::il {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(IlCompile, AProgramWithRemarksAndBlankLines) {
  EXPECT_THAT(faults("; the master's pulses\n\nLD M8000 // always\n  dplsv k1000, y1 Y5\r\nEND\n"),
              IsEmpty());
}

TEST(IlCompile, NamesTheNearestInstruction) {
  expect_faults(
      {{"LD X0\nOTU Y0\nOUT Y0\nEND",
        {"2:1: there is no instruction 'OTU'; did you mean OUT? [il.unknown-instruction]"}},
       {"LD X0\n  DMVO K1 D0\nOUT Y0\nEND",
        {"2:3: there is no instruction 'DMVO'; did you mean DMOV? [il.unknown-instruction]"}},
       {"LD X0\nOUT Y0\n@%$#&\nEND",
        {"3:1: there is no instruction '@%$#&'; one instruction a line: LD X0 [il.unknown-instruction]"}}});
}

// The real unit has them: no wrong suggestion.
TEST(IlCompile, SaysWhatIsNotSimulated) {
  for (const std::string name : {"PTO", "dabsd", "RCLP", "DFROMP", "ANRP", "DTKY", "IST"})
    EXPECT_THAT(faults("LD X0\n" + name + " K1 Y0\nOUT Y0\nEND"),
                ElementsAre("2:1: " + name +
                            " is not simulated; `drycut devices LX3VP` lists what is [il.not-simulated]"));
  for (const auto& spelling : spellings()) EXPECT_FALSE(is_not_simulated(spelling.text)) << spelling.text;
  for (const char* typo : {"DMVO", "OTU", "P", "D", ""}) EXPECT_FALSE(is_not_simulated(typo)) << typo;
}

TEST(IlCompile, AllFaultsInOneRun) {
  EXPECT_THAT(
      faults("LD X8\nMOV K40000 D0\nOUT X1\nEND"),
      ElementsAre(
          "1:4: 'X8' is not octal; X count X0 to X7, X10 to X17 and on [il.out-of-range]",
          "2:5: K40000 is wider than 16 bits; use the 32-bit instruction [il.width]",
          "3:5: OUT does not take X1 here; it takes Y, M, S, T, C or a bit of D (D10.F) [il.operand]"));
}

/// Of a line behind a contact.
void expect_operand_faults(std::vector<Refused> lines) {
  for (auto& line : lines) line.text = "LD X0\n" + line.text + "\nEND";
  expect_faults(lines);
}

TEST(IlCompile, SpecialDevicesThatAreNotServedAreRefused) {
  const std::string relays =
      "there are M8000 to M8004, M8011 to M8014, M8020 to M8022, M8024, M8029, M8031 to M8034, M8036 to "
      "M8037, "
      "M8039 to M8040, M8046 to M8059, M8061, M8067, M8145 to M8150, M8152 to M8153, M8168, M8200 to M8255 "
      "[il.not-simulated]";
  const std::string words =
      "there are D8000, D8010 to D8019, D8039 to D8047, D8049, D8061, D8067, D8069, D8140 to D8143, D8145 to "
      "D8148, D8150 to D8153 "
      "[il.not-simulated]";
  expect_operand_faults({{"OUT M8035", {"2:5: M8035 is not simulated; " + relays}},
                         {"AND M8041\nOUT Y0", {"2:5: M8041 is not simulated; " + relays}},
                         {"SET M8045", {"2:5: M8045 is not simulated; " + relays}},
                         {"SET M8160", {"2:5: M8160 is not simulated; " + relays}},
                         {"MOV K4M8000 D0", {"2:5: M8005 is not simulated; " + relays}},
                         {"MOV K1M8000 D0", {}},
                         {"MOV K1M8000Z0 D0", {}},
                         {"OUT M8200", {}},
                         {"AND M8255\nOUT Y0", {}},
                         {"MOV D8001 D0", {"2:5: D8001 is not simulated; " + words}},
                         {"MOV K1 D8120", {"2:8: D8120 is not simulated; " + words}},
                         {"AND D8020.0\nOUT Y0", {"2:5: D8020 is not simulated; " + words}},
                         {"DMOV K1 D8140", {}},
                         {"MOV D8141 D0", {}},
                         {"MOV D7999 D0", {}}});
}

TEST(IlCompile, WhatThePlcWritesItselfIsReadOnly) {
  const std::string run = "which is read only: on while the program runs; ";
  const std::string own_relay = "write a relay of your own, M0 to M3071 [il.operand]";
  const std::string own_word = "write a word of your own, D0 to D7999 [il.operand]";
  const std::string clock = "set the clock with TWR [il.operand]";
  expect_operand_faults(
      {{"OUT M8000", {"2:5: OUT writes M8000, " + run + own_relay}},
       {"SET M8000", {"2:5: SET writes M8000, " + run + own_relay}},
       {"RST M8000", {"2:5: RST writes M8000, " + run + own_relay}},
       {"PLS M8013", {"2:5: PLS writes M8013, which is read only: clock of 1 s; " + own_relay}},
       {"MOV K0 K4M7", {}},
       {"MOV K0 K1M8000", {"2:8: MOV writes M8000, " + run + own_relay}},
       {"CMP K1 D0 M8012", {"2:11: CMP writes M8012, which is read only: clock of 100 ms; " + own_relay}},
       {"ZRST M8000 M8002", {"2:6: ZRST writes M8000, " + run + own_relay}},
       {"MOV K5 D8010", {"2:8: MOV writes D8010, which is read only: time of a scan [0.1 ms]; " + own_word}},
       {"RST D8013", {"2:5: RST writes D8013, which is read only: clock: second; " + clock}},
       {"SET D8019.0", {"2:5: SET writes D8019, which is read only: clock: weekday, 0 is Sunday; " + clock}},
       {"DMOV K0 D8039",
        {"2:9: DMOV writes D8040, which is read only: with M8047: number of the first active step; up to "
         "D8047 of the eighth; " +
         own_word}},
       {"FMOV K0 D7990 K25",
        {"2:9: FMOV writes D8010, which is read only: time of a scan [0.1 ms]; " + own_word}},
       {"TADD D0 D3 D8013", {"2:12: TADD writes D8013, which is read only: clock: second; " + clock}}});
  // Read they may be, and what asks something of the PLC may be written.
  expect_operand_faults(
      {{"MOV D8013 D0\nMOV K1M8000 D0\nTADD D8013 D8013 D0\nFLT D8010 D0\nINT D8012 D0", {}},
       {"OUT M8034\nSET M8037\nRST M8022\nDMOV K0 D8140\nMOV K300 D8000", {}}});
  for (const SpecialRegister& special : special_registers())
    EXPECT_EQ(faults("LD X0\nRST " + std::string(special.name) + "\nEND").empty(), special.access == "write")
        << special.name;
}

TEST(IlIndex, AnIndexThatLeadsToAReadOnlyRegisterIsAnError) {
  Plc plc("LD M8000\nMOV K13 Z0\nMOV K77 D8000Z0\nMOV K10 Z1\nSET M8024Z1");
  EXPECT_THAT(plc.scan().notes.calls,
              ElementsAre("error 6 6706 p.il:3: 6706: MOV: D8000Z0 is no device that it takes: the index "
                          "register leads to number 8013"));
  EXPECT_THAT(plc.values("D8013 M8034"), ElementsAre(0, 1));
}

TEST(IlCompile, DevicesOutOfRange) {
  expect_operand_faults(
      {{"OUT Y400", {"2:5: 'Y400' does not exist; there are Y0 to Y377 [il.out-of-range]"}},
       {"OUT M3072",
        {"2:5: 'M3072' does not exist; there are M0 to M3071 and M8000 to M8255 [il.out-of-range]"}},
       {"SET S1000", {"2:5: 'S1000' does not exist; there are S0 to S999 [il.out-of-range]"}},
       {"MOV K1 D8256", {"2:8: 'D8256' does not exist; there are D0 to D8255 [il.out-of-range]"}},
       {"DMOV K1 D8255",
        {"2:9: DMOV takes 2 devices from D8255 on; there are D0 to D8255 [il.out-of-range]"}},
       {"CMP K1 D0 M3070",
        {"2:11: CMP takes 3 devices from M3070 on; there are M0 to M3071 and M8000 to M8255 "
         "[il.out-of-range]"}},
       {"MOV K4M3069 D0",
        {"2:5: 'K4M3069' goes beyond the devices; there are M0 to M3071 and M8000 to M8255 "
         "[il.out-of-range]"}},
       {"OUT D10.G", {"2:5: 'D10.G' has no such bit; a word has the bits 0 to F: D10.F [il.out-of-range]"}}});
}

TEST(IlCompile, Numbers) {
  expect_operand_faults(
      {{"DMOV K2147483648 D0",
        {"2:6: 'K2147483648' is no 32-bit number; write K-2147483648 to K2147483647 [il.width]"}},
       {"DMOV HFFFFFFFFF D0", {"2:6: 'HFFFFFFFFF' is no 32-bit number; write H0 to HFFFFFFFF [il.width]"}},
       {"MOV H10000 D0", {"2:5: H10000 is wider than 16 bits; use the 32-bit instruction [il.width]"}},
       {"DEMOV E1.5.2 D0",
        {"2:7: 'E1.5.2' is no 32-bit floating-point number; write E1.5 or E-3.2E4 [il.width]"}},
       {"MOV 5 D0", {"2:5: '5' is no operand; write a device (X0, D100), K10, H1F or E1.5 [il.operand]"}},
       {"MOV K9M0 D0",
        {"2:5: 'K9M0' has no such groups of bits; group K1 (4 bits) to K8 (32 bits) [il.out-of-range]"}},
       {"MOV K2D0 D0",
        {"2:5: 'K2D0' groups no bits; bits are grouped of X, Y, M or S: K4M0 [il.out-of-range]"}},
       {"MOV K5M0 D0",
        {"2:5: K5M0 is wider than 16 bits; group K1 to K4, or use the 32-bit instruction [il.width]"}},
       {"MOV K-32768 D0\nMOV HFFFF D0\nDMOV K8M0 D0\nDMOV HFFFFFFFF D0", {}}});
}

TEST(IlCompile, NumberOfOperands) {
  expect_operand_faults(
      {{"MOV K1",
        {"2:5: MOV has 2 operands, not 1; give K, H, D, T, C, V, Z or bits (K4M0) of X, Y, M or S and then "
         "D, T, C, V, Z or bits (K4M0) of Y, M or S [il.syntax]"}},
       {"SET Y0 K5", {"2:8: SET has 1 operand, not 2; give Y, M, S or a bit of D (D10.F) [il.syntax]"}},
       {"OUT T0",
        {"2:5: OUT has 2 operands, not 1; give Y, M, S, T, C or a bit of D (D10.F) and then K or D "
         "[il.syntax]"}}});
}

TEST(IlCompile, SetValues) {
  expect_operand_faults(
      {{"OUT T0 K0",
        {"2:8: set value K0 is out of range; give a set value K1 to K32767 or a D [il.operand]"}},
       {"OUT C0 M5", {"2:8: M5 is no set value; give a set value K1 to K32767 or a D [il.operand]"}},
       {"OUT C200 D8255",
        {"2:10: D8255 is no pair of words; give a set value K or the first D of a pair [il.operand]"}},
       {"OUT C235 K100000\nOUT T0 D5", {}}});
}

TEST(IlCompile, WideCountersNeedWideInstructions) {
  expect_operand_faults(
      {{"MOV C200 D0", {"2:5: C200 is 32 bits wide; use the 32-bit instruction [il.width]"}},
       {"DMOV C199 D0",
        {"2:6: DMOV takes 2 words from C199 on; the 16-bit counters end at C199 [il.out-of-range]"}},
       {"DMOV C251 D0\nMOV C199 D0", {}}});
}

TEST(IlCompile, CamAndPulseInstructions) {
  expect_operand_faults(
      {{"DECAM C251 D2000 X2 Y0 Y4", {}},
       {"DECAM K0 D2000 X2 Y0 Y4",
        {"2:7: K0 is no time axis; K1 counts every 100 us, K10 every ms [il.operand]"}},
       {"DECAM K1 D7961 X2 Y0 Y4",
        {"2:10: DECAM takes 40 words from D7961 on; the block has to end at D7999 [il.out-of-range]"}},
       {"DECAM K1 D2000 Y2 Y0 Y4", {"2:16: DECAM does not take Y2 here; it takes X or M [il.operand]"}},
       {"DECAM K1 D2000 X2 Y4 Y5", {"2:19: DECAM does not take Y4 here; it takes Y0 to Y3 [il.operand]"}},
       {"DPLSV K1000 Y1 Y1",
        {"2:16: Y1 is the pulse output itself; name another Y for the direction [il.operand]"}},
       {"ECAMTBX D100 K100 D2000 D120", {}},
       {"ECAMTBX D7990 M1 D2000 D120",
        {"2:9: ECAMTBX takes 20 words from D7990 on; the block has to end at D7999 [il.out-of-range]"}}});
}

TEST(IlCompile, Rungs) {
  expect_faults(
      {{"OUT Y0\nEND", {"1:1: OUT has no contact before it; begin with LD; LD M8000 is always ON [il.rung]"}},
       {"LD X0\nLD X1\nOUT Y0\nEND",
        {"3:1: 2 blocks are not joined at OUT; join them with ANB or ORB [il.rung]"}},
       {"LD X0\nANB\nOUT Y0\nEND",
        {"2:1: ANB has no two blocks to join; begin each block with LD [il.rung]"}},
       {"LD X0\nEND",
        {"2:1: the contacts before it lead to no coil; end them with OUT or another instruction [il.rung]"}},
       {"LD X0\nMPP\nOUT Y0\nEND",
        {"2:1: MPP has no branch to take up; keep the result with MPS before [il.rung]"}},
       {"LD X0\nMPS\nAND X1\nOUT Y0\nEND",
        {"5:1: a branch is not ended; take it up for the last time with MPP [il.rung]"}},
       {"LD X0\nMPS\nAND X1\nOUT Y0\nLD X2\nANB\nMPP\nOUT Y1\nEND",
        {"5:1: a branch goes on behind a coil with LD; take it up with MRD or MPP before [il.rung]"}}});
  std::string deep = "LD X0\n";
  for (int i = 0; i < 8; ++i) deep += "LD X1\n";
  for (int i = 0; i < 8; ++i) deep += "ANB\n";
  EXPECT_THAT(faults(deep + "OUT Y0\nEND"),
              ElementsAre("9:1: more than 8 blocks wait for ANB or ORB; join blocks as you go [il.rung]"));
  std::string branches = "LD X0\n";
  for (int i = 0; i < 12; ++i) branches += "MPS\n";
  for (int i = 0; i < 12; ++i) branches += "MPP\n";
  EXPECT_THAT(faults(branches + "OUT Y0\nEND"),
              ElementsAre("13:1: more than 11 branches wait for MPP; end branches with MPP [il.rung]"));
}

TEST(IlCompile, LabelsAndTheEnd) {
  EXPECT_THAT(faults("LD X0\nCJ P1\nP0\nP0\nEND"),
              ElementsAre("4:1: label P0 is there twice; it was first given in line 3 [il.jump]",
                          "2:4: there is no label P1; give it a line of its own [il.jump]"));
  EXPECT_THAT(faults("LD X0\nCJ P1\nP1 LD X1\nOUT Y0\nEND"),
              testing::Contains("3:4: 'LD' stands behind a label; give a label a line of its own [il.jump]"));
  expect_faults({{"P128\nEND", {"1:1: 'P128' does not exist; there are P0 to P127 [il.out-of-range]"}},
                 {"LD X0\nOUT Y0\n", {"2:1: END is missing; end the program with END [il.syntax]"}},
                 {"", {"1:1: there is no program; end the program with END [il.syntax]"}},
                 {"END\nLD X0\nLD X0", {"2:1: stands behind END; END is the last instruction [il.syntax]"}},
                 {"LD X0\nZRST M10 M5\nZRST M0 D5\nEND",
                  {"2:10: ZRST from M10 to M5; name the lower one first [il.operand]",
                   "3:9: ZRST from M0 to D5; name two devices of the same letter [il.operand]"}}});
}

TEST(IlCompile, ManyProblemsAreCutShort) {
  std::string text;
  for (int i = 0; i < 3000; ++i) text += "FOO\n";
  const auto told = faults(text);
  ASSERT_EQ(told.size(), 1001U);
  EXPECT_EQ(told.back(),
            "1000:1: too many problems: the rest is not told; is this an instruction list? "
            "[text.too-many-problems]");
}

// The table of mnemonics.

/// An operand that the kind takes.
std::string example(char kind) {
  const std::pair<std::string_view, const char*> examples[] = {
      {"bx", "X0"}, {"osrelBgh", "M100"}, {"S", "S20"}, {"N", "N0"},   {"nktjm", "K1"}, {"f", "E1.5"},
      {"p", "Y1"},  {"y", "Y5"},          {"P", "P1"},  {"H", "C251"}, {"XA", "X0"},    {"IR", "M100"}};
  for (const auto& [kinds, text] : examples)
    if (kinds.find(kind) != std::string_view::npos) return text;
  return "D100";
}

TEST(IlMnemonics, EverySpellingCompilesWithTheOperandsThatTheTableNames) {
  std::set<std::string> seen;
  for (const auto& spelling : spellings()) {
    EXPECT_TRUE(seen.insert(spelling.text).second) << spelling.text << " is there twice";
    const auto& m = *spelling.mnemonic;
    std::string line = spelling.text;
    for (std::size_t i = 0; i < m.operands.size(); ++i) {
      const char kind = m.operands[i];
      auto operand = example(kind);
      if (m.op == Op::ref && kind == 'k') operand = "K8";  // rows of eight
      for (const auto& range : m.ranges)
        if (range.operand == i) operand = fmt::format("K{}", std::max(range.least, -32768));
      line += " " + operand;
      EXPECT_FALSE(operand_text(kind).empty()) << m.name;
    }
    // Something before it and behind it that makes a sound rung of any instruction.
    std::string before = is_contact(m.op) && m.join() == Join::begins ? "" : "LD X0\n";
    if (m.op == Op::anb || m.op == Op::orb) before += "LD X1\n";
    if (m.op == Op::mrd || m.op == Op::mpp) before += "MPS\n";
    if (m.op == Op::nop || m.op == Op::fend || m.op == Op::end || m.op == Op::stl) before.clear();
    if (m.op == Op::for_ || m.op == Op::ei || m.op == Op::di) before.clear();
    if (m.op == Op::iret) before = "FEND\nI001\n";
    if (m.op == Op::next) before = "FOR K2\n";
    if (m.op == Op::mcr) before += "MC N0 M100\n";
    if (m.op == Op::ret) before = "STL S20\n";
    if (m.op == Op::sret) before = "FEND\nP1\n";
    std::string after = m.op <= Op::inv ? "OUT Y0\n" : "";
    if (m.op == Op::mps || m.op == Op::mrd) after += "MPP\nOUT Y1\n";
    if (m.op == Op::cj) after += "P1\n";
    if (m.op == Op::call) after += "FEND\nP1\nSRET\n";
    if (m.op == Op::for_) after += "NEXT\n";
    if (m.op == Op::mc) after += "MCR N0\n";
    if (m.op == Op::stl) after += "RET\n";
    EXPECT_THAT(faults(before + line + "\n" + after + (m.op == Op::end ? "" : "END\n")), IsEmpty()) << line;
    EXPECT_GT(m.steps, 0) << m.name;
    EXPECT_FALSE(m.meaning.empty()) << m.name;
    // And without its last operand, or with one too many, it is refused.
    EXPECT_FALSE(faults(before + line + " K1\n" + after + "END\n").empty()) << line;
  }
}

// Each at its place; those at the ends of the range are taken.
TEST(IlMnemonics, ConstantsOutOfTheRangeOfTheTableAreRefused) {
  int ranges = 0;
  for (const auto& spelling : spellings()) {
    const auto& m = *spelling.mnemonic;
    for (const auto& range : m.ranges) {
      ++ranges;
      const auto told = [&](std::int64_t number) {
        std::string line = spelling.text;
        std::size_t column = 0;
        for (std::size_t i = 0; i < m.operands.size(); ++i) {
          if (i == range.operand) column = line.size() + 2;
          const auto other = example(m.operands[i]);
          line += " " + (i == range.operand ? fmt::format("K{}", number) : other == "K1" ? "D7" : other);
        }
        const auto all = faults("LD X0\n" + line + "\nEND\n");
        const auto place = fmt::format("2:{}: ", column);
        for (const auto& fault : all) EXPECT_TRUE(fault.starts_with(place)) << line << " " << fault;
        return all.size();
      };
      const auto most = range.powers                            ? 4  // of a word
                        : spelling.wide && range.wide_most != 0 ? range.wide_most
                                                                : range.most;
      EXPECT_EQ(told(range.least - std::int64_t{1}), 1U) << spelling.text << " " << range.name;
      EXPECT_EQ(told(range.least), spelling.wide || range.least >= -32768 ? 0U : 1U) << spelling.text;
      EXPECT_EQ(told(most + std::int64_t{1}), 1U) << spelling.text << " " << range.name;
      EXPECT_EQ(told(spelling.wide ? most : std::min(most, 32767)), 0U) << spelling.text << " " << range.name;
    }
  }
  EXPECT_GT(ranges, 40);
}

TEST(IlCompile, ConstantsThatDoNotGoTogether) {
  expect_operand_faults(
      {{"PWM K11 K10 Y0",
        {"2:5: PWM: S1 is 11, more than the period S2 of 10; write 10 or less [il.operand]"}},
       {"PWM K10 K10 Y0", {}},
       {"SFWR D0 D1 K1", {"2:12: SFWR: n is 1; write 2 to 512 [il.operand]"}},
       {"SFRD D0 D1 K513", {"2:12: SFRD: n is 513; write 2 to 512 [il.operand]"}},
       {"TCMP K24 K0 K0 D0 M0", {"2:6: TCMP: the hour S1 is 24; write 0 to 23 [il.operand]"}},
       {"PLSR K1000 K10 K5001 Y0", {"2:16: PLSR: the ramp S3 is 5001; write 50 to 5000 [il.operand]"}},
       {"DPLSV K200001 Y0 Y4",
        {"2:7: DPLSV: the frequency S is 200001; write -200000 to 200000 [il.operand]"}},
       {"DECO D0 D1 K5", {"2:12: DECO: n is 5; write 0 to 4 [il.operand]"}},
       {"DECO D0 M0 K9", {"2:12: DECO: n is 9; write 0 to 8 [il.operand]"}},
       {"DECO D0 M3000 K8",
        {"2:9: DECO takes 256 values from M3000 on; there are M0 to M3071 and M8000 to M8255 "
         "[il.out-of-range]"}},
       {"ENCO M0 D0 K8\nENCO D0 D1 K4", {}},
       {"SMOV D0 K2 K3 D1 K4", {"2:12: SMOV: 3 digits from place 2 down; write 2 or less [il.operand]"}},
       {"SMOV D0 K4 K3 D1 K2", {"2:12: SMOV: 3 digits to place 2 and down; write 2 or less [il.operand]"}},
       {"WSFR D0 D2 K2 K3", {"2:15: WSFR: 2 words are shifted by 3; write 2 or less [il.operand]"}},
       {"ZCP K20 K10 D0 M0", {"2:5: ZCP: the zone is from 20 to 10; write 10 or less [il.operand]"}},
       {"BMOV D0 C190 K20",
        {"2:9: BMOV takes 20 values from C190 on; the 16-bit counters end at C199 [il.out-of-range]"}},
       {"MEAN T254 D0 K3", {"2:6: MEAN takes 3 values from T254 on; there are T0 to T255 [il.out-of-range]"}},
       {"DIV D0 K0 D2", {"2:8: DIV: division by 0; divide by another number [il.operand]"}},
       {"DEDIV D0 E0 D2", {"2:10: DEDIV: division by 0; divide by another number [il.operand]"}},
       {"BIN H1A84 D2", {"2:5: BIN: H1A84 is no BCD; write decimal digits: H1984 [il.operand]"}},
       {"BIN H9876 D2\nDBIN H98765432 D2", {}},
       // What an index register or a register changes is judged as it runs.
       {"BON D0 M0 K20Z0\nSFWR D0 D1 D2\nDIV D0 K0Z0 D2", {}}});
}

TEST(IlMnemonics, WideAndPulseForms) {
  for (const auto* name :
       {"MOV", "MOVP", "DMOV", "DMOVP", "LDD=", "ANDD>", "ORD<=", "DAND", "WANDP", "DEMOV", "DEADDP", "dinc"})
    EXPECT_NE(find_spelling(name), nullptr) << name;
  for (const auto* name : {"EMOV", "EADD", "DOUT", "LDP=", "DBMOV", "", "DECAMP"})
    EXPECT_EQ(find_spelling(name), nullptr) << name;
  EXPECT_TRUE(find_spelling("DMOVP")->wide);
  EXPECT_TRUE(find_spelling("DMOVP")->pulse);
  EXPECT_EQ(find_spelling("DEC")->mnemonic->name, "DEC");
  EXPECT_EQ(find_spelling("DECMP")->mnemonic->name, "ECMP");
}

TEST(IlCompile, StepsAreCountedAsInProgramMemory) {
  Problems problems;
  const auto program =
      compile("LD X0\nOUT T0 K10\nLDP M0\nDMOV K1 D0\nDECAM K1 D100 X0 Y0 Y4\nEND", "p.il", problems);
  std::vector<int> numbers;
  for (const auto& step : program.steps) numbers.push_back(step.number);
  EXPECT_THAT(numbers, ElementsAre(0, 1, 4, 6, 15, 36));
  EXPECT_EQ(program.size, 37);
}

TEST(IlCompile, RandomTextNeverCrashes) {
  std::mt19937 random(7);
  std::vector<std::string> words = {"K1",    "D0", "X8",   "Y1", "M8255", "K4X0", "E1", "P1", "P2",   "HFF",
                                    "D7999", "T1", "C235", ";",  "D1.9",  "K",    "E",  "//", "\x80", ",",
                                    "S20",   "N0", "D9Z7", "V1", "K3V0",  "[",    "]",  "12", "M9Z0", "Z"};
  for (const auto& spelling : spellings()) words.push_back(spelling.text);
  int sound = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    const auto lines = random() % 12;
    for (unsigned n = 0; n < lines; ++n) {
      const auto count = random() % 5;
      for (unsigned w = 0; w < count; ++w) text += words[random() % words.size()] + " ";
      text += '\n';
    }
    if (random() % 2 == 0) text += "END";
    Problems problems;
    const auto program = compile(text, "p.il", problems);
    for (const auto& problem : problems) {
      ASSERT_GE(problem.line, 1);
      ASSERT_GE(problem.column, 1);
      ASSERT_FALSE(problem.remedy.empty());
    }
    if (!problems.empty()) continue;
    ++sound;
    Registers registers;
    Notes notes;
    ProgramScan scanner(program);
    scanner.scan(registers, notes);
  }
  EXPECT_GT(sound, 10);
}

TEST(IlDoubts, ACoilThatTwoInstructionsDrive) {
  const auto told = [](const std::string& text) {
    Problems problems;
    const auto program = compile(text + "END\n", "p.il", problems);
    EXPECT_TRUE(problems.empty()) << text;
    return sentences(doubts(program));
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(told("LD X0\nOUT Y10\nLD X1\nOUT Y10\nLD X2\nOUT Y10\n"),
              ElementsAre("p.il:4:5: Y10 has OUT here and OUT in line 2: the last in a scan decides alone"));
  EXPECT_THAT(
      told("LD X0\nSET M5\nLD X1\nOUT M5\n"),
      ElementsAre("p.il:4:5: M5 has OUT here and SET in line 2: OUT writes it in every scan, whatever "
                  "SET has left"));
  EXPECT_THAT(told("LD X0\nSET Y10\nLD X1\nSET Y10\nLD X2\nRST Y10\n"), ElementsAre());
  EXPECT_THAT(told("LD X0\nOUT D5.1\nLD X1\nOUT D5.2\n"), ElementsAre());
  EXPECT_THAT(told("LD X0\nOUT T5 K10\nLD X1\nOUT T5 K20\n"), ElementsAre());
  // Steps of a sequence and the parts that jumps choose from take turns.
  EXPECT_THAT(told("LD X5\nSET S20\nSTL S20\nOUT Y1\nLD X0\nSET S21\nSTL S21\nOUT Y1\nRET\n"), ElementsAre());
  EXPECT_THAT(told("LD X5\nCJ P1\nLD X0\nOUT Y1\nP1\nLD X1\nOUT Y1\n"), ElementsAre());
}

TEST(IlDoubts, ATypeOfCamThatThereIsNot) {
  Problems problems;
  const auto program = compile("LD M8002\nECAMTBX D0 K102 D100 D50\nLD M8002\nECAMTBX D0 K1 D100 D50\nEND\n",
                               "p.il", problems);
  EXPECT_THAT(sentences(doubts(program)),
              ::testing::ElementsAre("p.il:2:12: ECAMTBX has no type K102; write K0, K1, K100 or K101"));
}

TEST(IlDoubts, ABlockThatNothingMakes) {
  const auto told = [](const std::string& made, const std::string& run) {
    Problems problems;
    const auto program = compile(
        "LD M8002\nECAMTBX D0 K101 " + made + " D50\nLD M8000\nDECAM C251 " + run + " M15 Y0 Y4\nEND\n",
        "p.il", problems);
    EXPECT_TRUE(problems.empty());
    return strange_block(program);
  };
  EXPECT_EQ(told("D1000", "D1000"), "");
  EXPECT_EQ(told("D1000", "D1100"),
            "p.il:4:12: DECAM runs the cam block at D1100, and ECAMTBX makes the one at D1000");
}

}  // namespace
}  // namespace drycut::devices::lx3vp::il
