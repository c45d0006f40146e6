// Instructions on words and floating-point numbers.
#include <cmath>
#include <limits>

#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp::il {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();

/// A PLC after one scan of a line that is always executed, with D0, D2 .. as 32-bit values.
Plc& run(Plc& plc, std::initializer_list<std::int32_t> values = {}) {
  int at = 0;
  for (const auto value : values) {
    plc.registers.set_i32(at, value);
    at += 2;
  }
  return plc.scan();
}
std::string always(const std::string& line) { return "LD M8000\n" + line; }

/// 32-bit result in D10 of a line on D0 and D2.
std::int32_t wide(const std::string& line, std::int32_t a, std::int32_t b = 0) {
  Plc plc(always(line));
  run(plc, {a, b});
  EXPECT_THAT(plc.notes.calls, IsEmpty()) << line;
  return plc.registers.i32(10);
}
/// 16-bit result in D10 of a line on D0 and D2.
int narrow(const std::string& line, int a, int b = 0) {
  Plc plc(always(line));
  run(plc, {a, b});
  EXPECT_THAT(plc.notes.calls, IsEmpty()) << line;
  return plc.registers.i16(10);
}

TEST(IlWords, MovesAndPatterns) {
  EXPECT_EQ(narrow("MOV D0 D10", -5), -5);
  EXPECT_EQ(narrow("MOV HFFFE D10", 0), -2);
  EXPECT_EQ(wide("DMOV D0 D10", -100000), -100000);
  EXPECT_EQ(wide("MOV D0 D10", -1), 0xFFFF);  // the second word is left alone
  EXPECT_EQ(narrow("CML D0 D10", 0x0F0F), static_cast<std::int16_t>(0xF0F0));
  EXPECT_EQ(wide("DCML D0 D10", 0), -1);
  EXPECT_EQ(narrow("WAND D0 D2 D10", 0x0FF0, 0x3C3C), 0x0C30);
  EXPECT_EQ(narrow("WOR D0 D2 D10", 0x0FF0, 0x3C3C), 0x3FFC);
  EXPECT_EQ(narrow("WXOR D0 D2 D10", 0x0FF0, 0x3C3C), 0x33CC);
  EXPECT_EQ(wide("DOR D0 D2 D10", 0x10000, 1), 0x10001);
  EXPECT_EQ(wide("DAND D0 D2 D10", -1, 0x70000001), 0x70000001);
  EXPECT_EQ(wide("DXOR D0 D2 D10", -1, 1), -2);
}

TEST(IlWords, GroupsOfBits) {
  Plc plc(always(
      "MOV K2X0 D0\nMOV H1234 K4M100\nDMOV K8M100 D2\nMOV K1Y4 K1Y10\nMOV T5 D4\nDMOV C200 D6\nMOV K9 T7"));
  for (const auto bit : {0, 3, 7}) plc.registers.x[static_cast<std::size_t>(bit)] = true;
  plc.registers.y[5] = true;
  plc.registers.t[5].value = 321;
  plc.registers.c[200].value = -70000;
  run(plc);
  EXPECT_THAT(plc.values("D0 M102 M103 M112 DD2 Y11 D4 DD6 T7"),
              ElementsAre(0x89, 1, 0, 1, 0x1234, 1, 321, -70000, 9));
  // Fewer bits than the instruction is wide have no sign; as many have.
  Plc signs(always("MOV K4M0 D0\nMOV K3M0 D1\nDMOV K4M0 D2"));
  signs.registers.m.fill(true);
  signs.scan();
  EXPECT_THAT(signs.values("D0 D1 DD2"), ElementsAre(-1, 4095, 65535));
}

struct Flags {
  bool zero, borrow, carry;
  bool operator==(const Flags&) const = default;
};
Flags flags(const std::string& line, std::int32_t a, std::int32_t b) {
  Plc plc(always(line));
  run(plc, {a, b});
  return {plc.registers.m[8020], plc.registers.m[8021], plc.registers.m[8022]};
}

TEST(IlWords, SumsWrapAndTellIt) {
  EXPECT_EQ(narrow("ADD D0 D2 D10", 32767, 1), -32768);
  EXPECT_EQ(flags("ADD D0 D2 D10", 32767, 1), (Flags{false, false, true}));
  EXPECT_EQ(narrow("SUB D0 D2 D10", -32768, 1), 32767);
  EXPECT_EQ(flags("SUB D0 D2 D10", -32768, 1), (Flags{false, true, false}));
  EXPECT_EQ(flags("SUB D0 D2 D10", 5, 5), (Flags{true, false, false}));
  EXPECT_EQ(wide("DADD D0 D2 D10", 2147483647, 1), least);
  EXPECT_EQ(flags("DADD D0 D2 D10", 2147483647, 1), (Flags{false, false, true}));
  EXPECT_EQ(wide("DSUB D0 K-100000 D10", 1), 100001);
  EXPECT_EQ(flags("DADD D0 D2 D10", least, least), (Flags{true, true, false}));
}

TEST(IlWords, ProductsTakeTwiceTheWords) {
  EXPECT_EQ(wide("MUL D0 D2 D10", -300, 300), -90000);
  Plc plc(always("DMUL D0 D2 D10"));
  run(plc, {-100000, 100000});
  const auto low = plc.registers.u32(10);
  const auto high = plc.registers.u32(12);
  EXPECT_EQ(static_cast<std::int64_t>(static_cast<std::uint64_t>(high) << 32 | low), -10000000000);
  run(plc, {least, least});
  EXPECT_EQ(plc.registers.u32(12), 0x40000000U);
}

TEST(IlWords, QuotientsAndRemainders) {
  Plc plc(always("DIV D0 D2 D10\nDDIV D0 D2 D20"));
  run(plc, {-17, 5});
  EXPECT_THAT(plc.values("D10 D11 DD20 DD22"), ElementsAre(-3, -2, -3, -2));
  run(plc, {least, -1});  // 2147483648 does not fit
  EXPECT_EQ(plc.registers.i32(20), least);
  EXPECT_THAT(plc.values("DD22 M8022"), ElementsAre(0, 1));
}

TEST(IlWords, CountsAndSigns) {
  Plc plc(always("INC D0\nDEC D2\nDINC D4\nDDEC D6\nNEG D8\nDNEG D10"));
  run(plc, {32767, 0x8000, -1, least, 32768, 5});
  EXPECT_THAT(plc.values("D0 D2 DD4 DD6 D8 DD10"), ElementsAre(-32768, 32767, 0, 2147483647, -32768, -5));
}

TEST(IlWords, ExchangesAndBlocks) {
  Plc plc(always("DXCH D0 D2\nBMOV D100 D102 K4\nBMOV D102 D101 K2\nFMOV K7 D110 K3\nDFMOV K-1 D120 D50"));
  for (int i = 0; i < 6; ++i) plc.registers.set_i16(100 + i, static_cast<std::int16_t>(i + 1));
  plc.registers.set_i16(50, 2);
  run(plc, {111111, 222222});
  EXPECT_THAT(plc.values("DD0 DD2"), ElementsAre(222222, 111111));
  std::vector<int> moved;
  for (int i = 100; i < 106; ++i) moved.push_back(plc.registers.i16(i));
  EXPECT_THAT(moved, ElementsAre(1, 1, 2, 2, 3, 4));  // 1 2 1 2 3 4, then two down by one
  EXPECT_THAT(plc.values("D112 D113 DD122 DD124"), ElementsAre(7, 0, -1, 0));
}

TEST(IlWords, ComparesIntoThreeDevices) {
  const auto three = [](const std::string& line, std::int32_t a, std::int32_t b, std::int32_t c = 0) {
    Plc plc(always(line));
    run(plc, {a, b, c});
    std::string text;
    for (std::size_t i = 20; i < 23; ++i) text += plc.registers.m[i] ? '1' : '0';
    return text;
  };
  EXPECT_EQ(three("CMP D0 D2 M20", 5, 4), "100");
  EXPECT_EQ(three("CMP D0 D2 M20", 5, 5), "010");
  EXPECT_EQ(three("DCMP D0 D2 M20", -100000, 1), "001");
  EXPECT_EQ(three("ZCP D0 D2 D4 M20", 10, 20, 9), "100");
  EXPECT_EQ(three("ZCP D0 D2 D4 M20", 10, 20, 20), "010");
  EXPECT_EQ(three("DZCP D0 D2 D4 M20", 10, 20, 21), "001");
}

TEST(IlWords, ContactsThatCompare) {
  struct Case {
    const char* sign;
    bool less, equal, greater;
  };
  for (const auto& c :
       {Case{"=", false, true, false}, Case{">", false, false, true}, Case{"<", true, false, false},
        Case{"<>", true, false, true}, Case{"<=", true, true, false}, Case{">=", false, true, true}}) {
    const auto holds = [&](std::int32_t a, std::int32_t b) {
      const std::string sign(c.sign);
      Plc plc("LDD" + sign + " D0 D2\nOUT Y0\nLD M8000\nANDD" + sign + " D0 D2\nOUT Y1\nLD M1\nORD" + sign +
              " D0 D2\nOUT Y2\nLD" + sign + " D0 D2\nOUT Y3\nLD M8000\nAND" + sign +
              " D0 D2\nOUT Y4\nLD M1\nOR" + sign + " D0 D2\nOUT Y5");
      run(plc, {a, b});
      for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(plc.registers.y[i], plc.registers.y[0]) << sign << i;
      return plc.registers.y[0];
    };
    EXPECT_EQ(holds(-7, 3), c.less);
    EXPECT_EQ(holds(3, 3), c.equal);
    EXPECT_EQ(holds(3, -7), c.greater);
  }
  // 16 bit see the low word only.
  Plc plc("LD= D0 K0\nOUT Y0\nLDD= D0 K0\nOUT Y1");
  run(plc, {65536});
  EXPECT_THAT(plc.values("Y0 Y1"), ElementsAre(1, 0));
}

// Floating point.

TEST(IlReals, Arithmetic) {
  Plc plc(
      always("DEMOV E5.5 D0\nDEADD D0 E-0.25 D2\nDESUB D0 K2 D4\nDEMUL D0 D2 D6\nDEDIV D0 E0.5 D8\nDFLT D20 "
             "D10\nFLT D22 D12\nDINT D8 D14\nINT D4 D16"));
  plc.registers.set_i32(20, -100000);
  plc.registers.set_i16(22, -3);
  run(plc);
  EXPECT_FLOAT_EQ(plc.registers.f32(2), 5.25F);
  EXPECT_FLOAT_EQ(plc.registers.f32(4), 3.5F);
  EXPECT_FLOAT_EQ(plc.registers.f32(6), 28.875F);
  EXPECT_FLOAT_EQ(plc.registers.f32(8), 11.0F);
  EXPECT_FLOAT_EQ(plc.registers.f32(10), -100000.0F);
  EXPECT_FLOAT_EQ(plc.registers.f32(12), -3.0F);
  EXPECT_THAT(plc.values("DD14 D16"), ElementsAre(11, 3));
}

TEST(IlReals, TheRatioOfTheRotaryDemoHasItsWords) {
  Plc plc(always("DEDIV K5 K3 D6"));
  run(plc);
  EXPECT_THAT(plc.values("D6 D7"), ElementsAre(0x5555, 0x3FD5));
}

TEST(IlReals, Compares) {
  Plc plc(always("DECMP E1.5 E1.25 M0\nDEZCP E1 E2 E2.5 M3"));
  run(plc);
  EXPECT_THAT(plc.values("M0 M1 M5"), ElementsAre(1, 0, 1));
}

// Errors while running.

std::vector<std::string> errors(const std::string& line, std::initializer_list<std::int32_t> values) {
  Plc plc(always(line));
  run(plc, values);
  return plc.notes.calls;
}

TEST(IlErrors, AreToldAndTheScanGoesOn) {
  Plc plc(always("DIV D0 D2 D10\nINC D20"));
  run(plc, {5, 0});
  EXPECT_THAT(plc.notes.calls, ElementsAre("error 1 6706 p.il:2: 6706: DIV: division by 0"));
  EXPECT_THAT(plc.values("D20 DD10"), ElementsAre(1, 0));
}

TEST(IlErrors, ByTheirMessage) {
  EXPECT_THAT(errors("DEDIV D0 D2 D10", {0, 0}),
              ElementsAre("error 1 6706 p.il:2: 6706: DEDIV: division by 0"));
  EXPECT_THAT(
      errors("BMOV D0 D7999 D2", {0, 300}),
      ElementsAre("error 1 6706 p.il:2: 6706: BMOV: 300 values from D7999 on go beyond what there is"));
  EXPECT_THAT(errors("BMOV D0 D100 D2", {0, 0}),
              ElementsAre("error 1 6706 p.il:2: 6706: BMOV: n is 0; write 1 to 512"));
  EXPECT_THAT(
      errors("DFMOV K1 D8152 D0", {100}),
      ElementsAre("error 1 6706 p.il:2: 6706: DFMOV: 100 values from D8152 on go beyond what there is"));
  EXPECT_THAT(errors("DEMUL E1E30 E1E30 D10", {}),
              ElementsAre("error 1 6706 p.il:2: 6706: DEMUL: the result is no floating-point number"));
  EXPECT_THAT(errors("DEADD D0 E1 D10", {0x7FC00000}),
              ElementsAre("error 1 6706 p.il:2: 6706: DEADD: an operand is no floating-point number"));
  EXPECT_THAT(errors("INT D0 D10", {0x7FC00000}),
              ElementsAre("error 1 6706 p.il:2: 6706: INT: S is no floating-point number"));
  EXPECT_THAT(errors("INT D0 D10", {0x47800000}),
              ElementsAre("error 1 6706 p.il:2: 6706: INT: 65536 does not fit the whole number"));
}

}  // namespace
}  // namespace drycut::devices::lx3vp::il
