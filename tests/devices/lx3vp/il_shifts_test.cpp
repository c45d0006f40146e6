// Shifts, rotations, conversions, and operands with index registers: values, flags and errors.
#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp::il {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t zero = 8020;
constexpr std::size_t borrow = 8021;
constexpr std::size_t carry = 8022;

/// A PLC after one scan of a line that is always executed, D0 as 16 or 32 bit.
struct Once {
  explicit Once(const std::string& line, std::int32_t value = 0, bool wide = false)
      : plc("LD M8000\n" + line) {
    if (wide)
      plc.registers.set_i32(0, value);
    else
      plc.registers.set_i16(0, static_cast<std::int16_t>(value));
    plc.scan();
  }
  [[nodiscard]] bool flag(std::size_t number) const { return plc.registers.m[number]; }
  [[nodiscard]] int d(int index) const { return plc.registers.i16(index); }
  Plc plc;
};
/// Its error, without "error 1 ".
std::string error(const std::string& line, std::int32_t value = 0, bool wide = false) {
  const Once run(line, value, wide);
  return run.plc.notes.calls.size() == 1 ? run.plc.notes.calls[0].substr(8) : "no error";
}

TEST(IlShifts, RotationsTurnAllBitsRound) {
  const Once left("ROLP D0 K4", 0x1234);
  EXPECT_EQ(left.d(0), 0x2341);
  EXPECT_TRUE(left.flag(carry)) << "bit 0 came round last";
  const Once right("RORP D0 K4", 0x1234);
  EXPECT_EQ(right.d(0), 0x4123);
  EXPECT_FALSE(right.flag(carry));
  EXPECT_EQ(Once("DROL D0 K8", 0x12345678, true).plc.registers.i32(0), 0x34567812);
  EXPECT_EQ(Once("DRORP D0 K32", 0x12345678, true).plc.registers.i32(0), 0x12345678);
  Once bits("MOV H8001 K4M0\nROL K4M0 K1");
  EXPECT_THAT(bits.plc.values("M0 M1 M15"), ElementsAre(1, 1, 0));
}

TEST(IlShifts, RotationsRefuseWhatIsNotOneWord) {
  EXPECT_THAT(faults("LD X0\nROL K2M0 K1\nDROR K4M0 K1\nROR D0 K17\nDROL D0 K0\nEND"),
              ElementsAre("2:5: ROL turns 16 bits, not those of K2M0; group K4 [il.operand]",
                          "3:6: DROR turns 32 bits, not those of K4M0; group K8 [il.operand]",
                          "4:8: ROR: n is 17; write 1 to 16 [il.operand]",
                          "5:9: DROL: n is 0; write 1 to 32 [il.operand]"));
  EXPECT_EQ(error("ROL D0 D5"), "6706 p.il:2: 6706: ROL: n is 0; write 1 to 16");
}

TEST(IlShifts, BitsMoveUpAndDownInGroups) {
  // M0..M7 = 1011 0001 (M0 first), X0..X1 = 0, 1.
  const auto shifted = [](const std::string& line) {
    Plc plc("LD M8000\n" + line);
    plc.registers.x[1] = true;
    for (const std::size_t bit : {0, 2, 3, 7}) plc.registers.m[bit] = true;
    plc.scan();
    std::string bits;
    for (std::size_t i = 0; i < 8; ++i) bits += plc.registers.m[i] ? '1' : '0';
    return bits;
  };
  EXPECT_EQ(shifted("SFTL X0 M0 K8 K2"), "01101100");
  EXPECT_EQ(shifted("SFTRP X0 M0 K8 K2"), "11000101");
  EXPECT_EQ(shifted("SFTL M0 M0 K8 K8"), "10110001") << "S and D may be the same";
  EXPECT_EQ(shifted("SFTL M0 M1 K3 K1"), "11010001") << "S may lie beside D";
}

TEST(IlShifts, ShiftsRefuseCountsThatDoNotFit) {
  EXPECT_THAT(faults("LD X0\nSFTL X0 M0 K4 K5\nSFTR X0 M0 K1025 K1\nSFTL X0 X0 K4 K1\nEND"),
              ElementsAre("2:15: SFTL: 4 bits are shifted by 5; write 4 or less [il.operand]",
                          "3:12: SFTR: n1 is 1025; write 1 to 1024 [il.operand]",
                          "4:9: SFTL does not take X0 here; it takes Y, M or S [il.operand]"));
  EXPECT_EQ(error("SFTL X0 M3070 D0 K1", 4),
            "6706 p.il:2: 6706: SFTL: 4 devices from M3070 on go beyond what there is");
  EXPECT_EQ(error("SFTL X0 M0 D0 K3", 2), "6706 p.il:2: 6706: SFTL: 3 bits of 2 are to be shifted");
}

TEST(IlConversions, DecimalDigitsInFourBitsEach) {
  EXPECT_EQ(Once("BCD D0 D10", 1984).d(10), 0x1984);
  EXPECT_EQ(Once("DBCDP D0 D10", 12345678, true).plc.registers.i32(10), 0x12345678);
  EXPECT_EQ(Once("BIN D0 D10", 0x1984).d(10), 1984);
  EXPECT_EQ(Once("DBIN D0 D10", 0x12345678, true).plc.registers.i32(10), 12345678);
  EXPECT_EQ(Once("MOV H42 K2Y0\nBIN K2Y0 D10").d(10), 42);
  EXPECT_EQ(error("BCD D0 D10", -1), "6706 p.il:2: 6706: BCD: S is -1; write 0 to 9999");
  EXPECT_EQ(error("BCD D0 D10", 10000), "6706 p.il:2: 6706: BCD: S is 10000; write 0 to 9999");
  EXPECT_EQ(error("DBCD D0 D10", 100000000, true),
            "6706 p.il:2: 6706: DBCD: S is 100000000; write 0 to 99999999");
  EXPECT_EQ(error("BIN D0 D10", 0x1A84), "6706 p.il:2: 6706: BIN: H1A84 is no BCD: it has a digit A");
}

TEST(IlConversions, MeansLeaveTheRemainder) {
  EXPECT_EQ(Once("MOV K5 D1\nMOV K-2 D2\nMEAN D0 D10 K3", 1).d(10), 1);
  EXPECT_EQ(Once("MOV K-5 D1\nMEAN D0 D10 K2", 0).d(10), -2) << "towards 0";
  EXPECT_EQ(Once("DMOV K1000000 D2\nDMEANP D0 D10 K2", 2000001, true).plc.registers.i32(10), 1500000);
  EXPECT_EQ(Once("MOV H31 K2M0\nMEAN K1M0 D10 K2").d(10), 2) << "of groups, one behind the other";
  EXPECT_EQ(error("MEAN D0 D10 D0", 65), "6706 p.il:2: 6706: MEAN: n is 65; write 1 to 64");
  EXPECT_EQ(error("MEAN T254 D10 D0", 3),
            "6706 p.il:2: 6706: MEAN: 3 values from T254 on go beyond what there is");
  EXPECT_EQ(error("DMEAN D8152 D10 K1"), "no error");
}

TEST(IlConversions, SquareRootsTellWhetherTheyAreWhole) {
  const Once whole("SQR D0 D10", 144);
  EXPECT_EQ(whole.d(10), 12);
  EXPECT_FALSE(whole.flag(borrow));
  const Once not_whole("SQR D0 D10", 143);
  EXPECT_EQ(not_whole.d(10), 11);
  EXPECT_TRUE(not_whole.flag(borrow));
  EXPECT_TRUE(Once("SQR D0 D10", 0).flag(zero));
  EXPECT_EQ(Once("DSQRP D0 D10", 2147395600, true).plc.registers.i32(10), 46340);
  EXPECT_EQ(error("SQR D0 D10", -4), "6706 p.il:2: 6706: SQR: S is -4; write 0 or more");
}

// Index registers.

TEST(IlIndex, IsAddedToDevicesBitsAndNumbers) {
  Plc plc(
      "LD M8000\nMOV K3 Z0\nMOV K-2 V1\nMOV K9 D10Z0\nMOV D12V1 D0\nMOV K100Z0 D1\nMOV K1X0Z0 D2\n"
      "MOV K7 Z\nLD X5Z0\nOUT Y1V1");
  plc.registers.x[4] = true;
  plc.registers.d[10] = 55;
  EXPECT_THAT(plc.scan().values("D13 D0 D1"), ElementsAre(9, 55, 103));
  EXPECT_EQ(plc.registers.d[2], 2) << "K1X3: X3 to X6";
  EXPECT_EQ(plc.registers.z[0], 7);
  EXPECT_THAT(
      plc.notes.calls,
      ElementsAre("error 37 6706 p.il:10: 6706: OUT: Y1V1 is no device that it takes: the index register "
                  "leads to number -1"));
}

TEST(IlIndex, OctalDevicesCountOn) {
  Plc plc("LD M8000\nMOV K2 Z0\nLD X7Z0\nOUT Y0");  // X7, X10, X11
  plc.registers.x[9] = true;
  EXPECT_TRUE(plc.scan().registers.y[0]);
}

TEST(IlIndex, A32BitInstructionTakesVWithZ) {
  Plc plc("LD M8000\nDMOV K-4 Z2\nDMOV D10Z2 D20\nDMOV Z2 D30\nDMOV K100000Z2 D40");
  plc.registers.set_i32(6, 123456);
  EXPECT_EQ(plc.scan().registers.v[2], 0xFFFF);
  EXPECT_THAT(plc.values("DD20 DD30 DD40"), ElementsAre(123456, -4, 99996));
  // What stood in V counts: a program has to write both.
  Plc stale("LD M8000\nMOV K1 V0\nMOV K0 Z0\nDMOV D10Z0 D20");
  stale.scan();
  EXPECT_THAT(
      stale.notes.calls,
      ElementsAre("error 11 6706 p.il:4: 6706: DMOV: D10Z0 is no device that it takes: the index register "
                  "leads to number 65546"));
}

TEST(IlIndex, WhatItLeadsToFitsAllThatTheInstructionTakes) {
  const auto told = [](const std::string& line, int z) {
    Plc plc("LD M8000\n" + line);
    plc.registers.z[0] = static_cast<std::uint16_t>(z);
    plc.scan();
    return plc.notes.calls.size();
  };
  EXPECT_EQ(told("DMOV K1 D0Z0", 8254), 0U);
  EXPECT_EQ(told("DMOV K1 D0Z0", 8255), 1U);
  EXPECT_EQ(told("CMP K1 K2 M0Z0", 3069), 0U);
  EXPECT_EQ(told("CMP K1 K2 M0Z0", 3070), 1U);
  EXPECT_EQ(told("MOV K4M0Z0 D0", 3056), 0U);
  EXPECT_EQ(told("MOV K4M0Z0 D0", 3057), 1U);
  EXPECT_EQ(told("MOV K1 D0Z0", -1), 1U);
  EXPECT_EQ(told("RST D0Z0", 8256), 1U);
}

TEST(IlIndex, IsRefusedWhereItHasNoPlace) {
  EXPECT_THAT(
      faults("LD X0\nMOV D0Z8 D1\nMOV D0.5Z0 D1\nDMOV D0V0 D2\nDMOV K1 V0\nOUT T0Z0 K5\nDPLSV K1 Y0Z0 Y5\n"
             "DECAM K1 D2000Z0 X0 Y0 Y4\nMOV K1 V8\nEND"),
      ElementsAre("2:5: 'D0Z8' has no such index register; there are V0 to V7 and Z0 to Z7: D10Z0 "
                  "[il.index-register]",
                  "3:5: 'D0.5Z0' takes no index register; index a device, bits or a number: D10Z0, K4M0Z0, "
                  "K5V1 [il.index-register]",
                  "4:6: D0V0 is indexed by V in a 32-bit instruction; use Z: a 32-bit instruction takes V "
                  "with it [il.index-register]",
                  "5:9: V0 is the upper half of a 32-bit index; use Z0: a 32-bit instruction takes V0 with "
                  "it [il.index-register]",
                  "6:10: OUT T0Z0 K5 has an index register; timers, counters and their set values take none "
                  "[il.index-register]",
                  "7:10: DPLSV does not take an index register here; write the number itself, not Y0Z0 "
                  "[il.index-register]",
                  "8:10: DECAM does not take an index register here; write the number itself, not D2000Z0 "
                  "[il.index-register]",
                  "9:8: 'V8' does not exist; there are V0 to V7 [il.out-of-range]"));
}

// The largest number that an operand can have is refused, not added to.
TEST(IlOperands, NumbersBeyondEveryRangeAreRefused) {
  EXPECT_THAT(
      faults("LD X0\nMOV K1 D2147483647\nSET M2147483647\nMOV K8M2147483647 D0\nEND"),
      ElementsAre(
          "2:8: 'D2147483647' does not exist; there are D0 to D8255 [il.out-of-range]",
          "3:5: 'M2147483647' does not exist; there are M0 to M3071 and M8000 to M8255 [il.out-of-range]",
          "4:5: 'K8M2147483647' does not exist; there are M0 to M3071 and M8000 to M8255 [il.out-of-range]"));
}

TEST(IlRegisters, IndexRegistersHaveNames) {
  Registers registers;
  write(registers, *parse_register("Z3"), -7);
  write(registers, *parse_register("v7"), 40000);
  EXPECT_EQ(registers.z[3], 0xFFF9);
  EXPECT_EQ(read(registers, *parse_register("Z3")), -7);
  EXPECT_EQ(read(registers, *parse_register("V7")), -25536);
  EXPECT_FALSE(parse_register("Z8"));
  EXPECT_EQ(to_string(*parse_register("z0")), "Z0");
}

}  // namespace
}  // namespace drycut::devices::lx3vp::il
