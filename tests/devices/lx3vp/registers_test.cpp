// Registers, their names and register files.
#include <gmock/gmock.h>

#include <random>

#include "devices/lx3vp/register_file.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = RegisterName::Kind;

TEST(Lx3vpRegisters, WideValuesTakeTheLowWordFirst) {
  Registers registers;
  registers.set_i32(8140, 0x12345678);
  EXPECT_EQ(registers.d[8140], 0x5678);
  EXPECT_EQ(registers.d[8141], 0x1234);
  registers.set_i32(8140, -2);
  EXPECT_EQ(registers.d[8141], 0xFFFF);
  EXPECT_EQ(registers.i32(8140), -2);
  EXPECT_EQ(registers.u32(8140), 0xFFFFFFFEu);
  // 5/3 as the manual's fly saw has it.
  registers.set_f32(10, 5.0F / 3.0F);
  EXPECT_EQ(registers.d[10], 0x5555);
  EXPECT_EQ(registers.d[11], 0x3FD5);
  EXPECT_EQ(registers.f32(10), 5.0F / 3.0F);
  registers.set_i16(0, -1);
  EXPECT_EQ(registers.d[0], 0xFFFF);
  EXPECT_EQ(registers.i16(0), -1);
}

TEST(Lx3vpRegisters, NamesAreReadInAnyCase) {
  const auto name = [](const char* text) { return parse_register(text).value(); };
  EXPECT_EQ(name("D10"), (RegisterName{Kind::word, 10, 0}));
  EXPECT_EQ(name("dd2025"), (RegisterName{Kind::wide, 2025, 0}));
  EXPECT_EQ(name("D20:L"), (RegisterName{Kind::wide, 20, 0}));
  EXPECT_EQ(name("FD30"), (RegisterName{Kind::real, 30, 0}));
  EXPECT_EQ(name("d30:f"), (RegisterName{Kind::real, 30, 0}));
  EXPECT_EQ(name("D2001.A"), (RegisterName{Kind::bit, 2001, 10}));
  EXPECT_EQ(name("M8147"), (RegisterName{Kind::m, 8147, 0}));
  EXPECT_EQ(name("X10"), (RegisterName{Kind::x, 8, 0}));
  EXPECT_EQ(name("Y377"), (RegisterName{Kind::y, 255, 0}));
  EXPECT_EQ(name("S999"), (RegisterName{Kind::s, 999, 0}));
  EXPECT_EQ(name("T255"), (RegisterName{Kind::timer, 255, 0}));
  EXPECT_EQ(name("TS0"), (RegisterName{Kind::timer_contact, 0, 0}));
  EXPECT_EQ(name("C251"), (RegisterName{Kind::counter, 251, 0}));
  EXPECT_EQ(name("CS251"), (RegisterName{Kind::counter_contact, 251, 0}));
}

TEST(Lx3vpRegisters, WhatIsNoRegisterIsRefused) {
  for (const char* text :
       {"",      "D",    "D8256",        "DD8255",    "D8255:L", "D-1",    "D+1",    "X8",
        "X400",  "Y9",   "M3072",        "M7999",     "M8256",   "S1000",  "T256",   "C256",
        "D10.G", "D10.", "D10:",         "D10:X",     "M0.1",    "DD10:L", "DD10.1", "D10 ",
        "Z8",    "D1O",  "D99999999999", "web.speed", "FD",      "D10.10"})
    EXPECT_FALSE(parse_register(text)) << text;
}

TEST(Lx3vpRegisters, EveryNameReadsBackAsItself) {
  for (const char* text : {"D0", "D8255", "DD8254", "FD8254", "D7.F", "M0", "M3071", "M8000", "X17", "Y377",
                           "S0", "T0", "TS9", "C200", "CS0"})
    EXPECT_EQ(to_string(parse_register(text).value()), text);
}

TEST(Lx3vpRegisters, WhatIsWrittenIsRead) {
  Registers registers;
  for (const char* text : {"D1", "DD2", "FD4", "D6.0", "D6.F", "M0", "M8000", "X7", "Y10", "S3", "T4", "TS4",
                           "C5", "CS5", "C200"}) {
    const RegisterName name = parse_register(text).value();
    EXPECT_EQ(read(registers, name), 0) << text;
    write(registers, name, 1);
    EXPECT_EQ(read(registers, name), 1) << text;
  }
  EXPECT_EQ(registers.d[6], 0x8001);
  const RegisterName word = parse_register("D1").value();
  write(registers, word, 40000);
  EXPECT_EQ(registers.d[1], 40000);
  EXPECT_EQ(read(registers, word), 40000 - 65536);
  write(registers, word, 1e9);
  EXPECT_EQ(registers.d[1], 65535);
  write(registers, word, std::nan(""));
  EXPECT_EQ(registers.d[1], 0);
  write(registers, parse_register("DD2").value(), 2.6);
  EXPECT_EQ(registers.i32(2), 3);
  write(registers, parse_register("FD4").value(), 2.6);
  EXPECT_EQ(registers.f32(4), 2.6F);
}

TEST(Lx3vpRegisters, TimersHaveTheirUnits) {
  EXPECT_EQ(timer_unit_ns(0), 100'000'000);
  EXPECT_EQ(timer_unit_ns(199), 100'000'000);
  EXPECT_EQ(timer_unit_ns(200), 10'000'000);
  EXPECT_EQ(timer_unit_ns(245), 10'000'000);
  EXPECT_EQ(timer_unit_ns(246), 1'000'000);
  EXPECT_EQ(timer_unit_ns(249), 1'000'000);
  EXPECT_EQ(timer_unit_ns(250), 100'000'000);
  EXPECT_FALSE(keeps_time(245));
  EXPECT_TRUE(keeps_time(246));
}

TEST(Lx3vpRegisterFile, RowsGiveValues) {
  Problems problems;
  const auto values = read_register_values(
      "# the saw\naddress,value\nD10,5\n D20:L , 100000 ; "
      "metres\n\nD30:F,1.5\r\nM0,1\nD40,H1F\nD41,K-7\nC200,70000",
      "saw.csv", ',', problems);
  EXPECT_THAT(problems, IsEmpty());
  Registers registers;
  ASSERT_EQ(values.size(), 7u);
  for (const auto& entry : values) write(registers, entry.name, entry.value);
  EXPECT_EQ(registers.d[10], 5);
  EXPECT_EQ(registers.i32(20), 100000);
  EXPECT_EQ(registers.f32(30), 1.5F);
  EXPECT_TRUE(registers.m[0]);
  EXPECT_EQ(registers.d[40], 31);
  EXPECT_EQ(registers.i16(41), -7);
  EXPECT_EQ(registers.c[200].value, 70000);
}

TEST(Lx3vpRegisterFile, EveryFaultIsToldInOneRun) {
  Problems problems;
  read_register_values(
      "D10,70000\nQ3,1\nD11;5\nD12,abc\nD13,1.5\nM0,2\n  "
      "X4,1\nD20:L,1\nD21,3\nD20.3,0\nD10,1\nD12,4\nD14.1,1\n"
      "D14.2,1\nD14,7\n",
      "saw.csv", ',', problems);
  std::vector<std::string> texts;
  for (const auto& problem : problems) texts.push_back(to_string(problem));
  EXPECT_THAT(
      texts,
      ElementsAre(
          "saw.csv:1:5: D10 does not hold 70000; write -32768 to 65535, or D10:L [controller.value-range]",
          "saw.csv:2:1: 'Q3' is no register; write D10, D10:L (32 bit), D10:F (float), D10.A (bit 10), "
          "M0, S0, T0 or C0 [registers.unknown-register]",
          "saw.csv:3:1: no ',' in 'D11'; write register,value: D10,5 [registers.value]",
          "saw.csv:4:5: 'abc' is no number; write 5, -5, K5, H1F or 1.5 [registers.value]",
          "saw.csv:5:5: D13 holds whole numbers, not 1.5; write D13:F for a float [controller.value-range]",
          "saw.csv:6:4: M0 does not hold 2; write 0 to 1 [controller.value-range]",
          "saw.csv:7:3: X4 is an input; wire it to a plug of a plant [registers.value]",
          "saw.csv:9:1: D21 is given in line 8 already; keep one of them [registers.twice]",
          "saw.csv:10:1: D20.3 is given in line 8 already; keep one of them [registers.twice]",
          "saw.csv:15:1: D14 is given in line 13 already; keep one of them [registers.twice]"));
}

// IEC's way to write a hexadecimal number is not the unit's: refused, and never the digits before its #.
TEST(Lx3vpRegisterFile, SixteenHashIsNoNumber) {
  Problems problems;
  const auto values = read_register_values("D10,16#1000\nD11,5 # five\n#D12,5\n  # D13,5\nD14,H1000;H20\n",
                                           "saw.csv", ',', problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(to_string(problems[0]),
            "saw.csv:1:5: '16#1000' is no number; write 5, -5, K5, H1F or 1.5 [registers.value]");
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0].value, 5);
  EXPECT_EQ(values[1].value, 4096);
}

TEST(Lx3vpRegisterFile, IsRecognisedByItsLines) {
  EXPECT_TRUE(is_register_file("D10,5\n", ','));
  EXPECT_TRUE(is_register_file("; presets\n# of the saw\n\n  D20:L , 100000\n", ','));
  EXPECT_TRUE(is_register_file("address,value\n", ','));
  EXPECT_TRUE(is_register_file("Q10,5\nM0,1\n", ',')) << "a slip in the first line";
  EXPECT_TRUE(
      is_register_file("\xEF\xBB\xBF"
                       "D10,5\r\n",
                       ','));
  EXPECT_FALSE(is_register_file("", ','));
  EXPECT_FALSE(is_register_file("master,slave\n0,0\n100,50\n", ','));
  EXPECT_FALSE(is_register_file("# ecamtbx: K100\nparameter,value\nP1,3183\n", ','));
  EXPECT_FALSE(is_register_file("sector,codeG\n1,132\n", ','));
  EXPECT_FALSE(is_register_file("D10=5\n", ','));
  EXPECT_FALSE(is_register_file("; D10,5\n", ',')) << "a comment";
}

TEST(Lx3vpRegisterFile, AMarkOfTheEncodingIsNoPartOfTheName) {
  Problems problems;
  const auto values = read_register_values(
      "\xEF\xBB\xBF"
      "D10,5\n",
      "saw.csv", ',', problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].value, 5);
}

TEST(Lx3vpRegisterFile, NoTextBreaksTheReader) {
  std::mt19937 random(5);
  const std::string alphabet = "DMXYSTCFLKH0123456789:.,=;#\n\r -+eE\t\xff";
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (auto length = random() % 40; length > 0; --length) text += alphabet[random() % alphabet.size()];
    Problems problems;
    const auto values = read_register_values(text, "fuzz.csv", ',', problems);
    EXPECT_TRUE(values.empty() || is_register_file(text, ',')) << text;
    Registers registers;
    for (const auto& entry : values) {
      write(registers, entry.name, entry.value);
      EXPECT_EQ(misfit(entry.name, entry.value), std::nullopt);
    }
    for (const auto& problem : problems) {
      EXPECT_GE(problem.line, 1);
      EXPECT_GE(problem.column, 1);
      EXPECT_FALSE(problem.what.empty());
      EXPECT_FALSE(problem.remedy.empty());
    }
  }
}

}  // namespace
}  // namespace drycut::devices::lx3vp
