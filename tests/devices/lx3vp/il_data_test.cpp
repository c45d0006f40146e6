// Digits, bits, queues, rows of words and times of day: values, flags and errors.
#include "tests/devices/lx3vp/covers.hpp"
#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp::il {
namespace {

using testing::ElementsAre;

constexpr std::size_t nothing = 8020;  // M8020
constexpr std::size_t below = 8021;
constexpr std::size_t above = 8022;

/// A PLC after one scan of lines that are always executed, with words from D0 on.
struct Done {
  explicit Done(const std::string& lines, const std::vector<int>& words = {}) : plc("LD M8000\n" + lines) {
    for (std::size_t i = 0; i < words.size(); ++i)
      plc.registers.set_i16(static_cast<int>(i), static_cast<std::int16_t>(words[i]));
    plc.scan();
  }
  [[nodiscard]] int d(int index) const { return plc.registers.i16(index); }
  [[nodiscard]] std::vector<int> words(int first, int count) const {
    std::vector<int> read;
    for (int i = 0; i < count; ++i) read.push_back(d(first + i));
    return read;
  }
  [[nodiscard]] bool flag(std::size_t number) const { return plc.registers.m[number]; }
  /// The error, without its place; "" for none.
  [[nodiscard]] std::string error() const {
    const auto& calls = plc.notes.calls;
    return calls.empty() ? "" : calls[0].substr(calls[0].find("6706: ") + 6);
  }
  Plc plc;
};

TEST(Lx3vpIlData, SmovMovesDecimalDigits) {
  EXPECT_EQ(Done("SMOV D0 K4 K2 D1 K3", {1234, 9876}).d(1), 9126) << "digits 4 and 3 become 3 and 2";
  EXPECT_EQ(Done("SMOV D0 K1 K1 D1 K4", {7, 0}).d(1), 7000);
  EXPECT_EQ(Done("SMOV D0 K2 K1 K4M0 K1\nMOV K4M0 D5", {53}).d(5), 5);
  EXPECT_EQ(Done("SET M8168\nSMOV D0 K4 K2 D1 K2", {0x1A2B, 0x7777}).d(1), 0x771A);
  EXPECT_EQ(Done("SMOV D0 K4 K2 D1 K3", {10000}).error(), "SMOV: 10000 has no four decimal digits");
  EXPECT_EQ(Done("SMOV D0 K4 K2 D1 K3", {0, -1}).error(), "SMOV: -1 has no four decimal digits");
  EXPECT_EQ(Done("SMOV D0 K2 D2 D1 K4", {0, 0, 3}).error(),
            "SMOV: 3 digits from place 2 to place 4: m2 is above m1 or n");
  EXPECT_EQ(Done("SMOV D0 D2 K3 D1 K4", {0, 0, 5}).error(), "SMOV: m1 is 5; write 1 to 4");
  covers({"M8168"});
}

TEST(Lx3vpIlData, SwapExchangesBytes) {
  EXPECT_EQ(Done("SWAPP D0", {0x1234}).d(0), 0x3412);
  EXPECT_THAT(Done("DSWAP D0", {0x1234, 0x5678}).words(0, 2), ElementsAre(0x3412, 0x7856));
}

TEST(Lx3vpIlData, DecoNamesOneBit) {
  EXPECT_THAT(Done("SET M1\nSET M0\nSET M12\nDECO M0 M10 K3").plc.values("M10 M12 M13 M14"),
              ElementsAre(0, 0, 1, 0));
  EXPECT_EQ(Done("DECOP D0 D1 K3", {0xFFFB, 0}).d(1), 1 << 3) << "the low three bits of S";
  EXPECT_EQ(Done("DECO K15 D1 K4", {0, 1}).d(1), static_cast<std::int16_t>(0x8000));
  EXPECT_EQ(Done("DECO D0 D1 K0", {3, 77}).d(1), 77) << "n of 0 does nothing";
  EXPECT_EQ(Done("DECO D0 D1 D2", {0, 0, 5}).error(), "DECO: n is 5; write 0 to 4");
  EXPECT_EQ(Done("DECO D0 M0 D2", {0, 0, 9}).error(), "DECO: n is 9; write 0 to 8");
  EXPECT_EQ(Done("DECO D0 M3000 D2", {0, 0, 8}).error(),
            "DECO: 256 devices from M3000 on go beyond what there is");
}

TEST(Lx3vpIlData, EncoFindsTheHighestBit) {
  EXPECT_EQ(Done("SET M11\nSET M13\nENCO M10 D0 K3").d(0), 3);
  EXPECT_EQ(Done("ENCOP D0 D1 K4", {0x4001, 9}).d(1), 14);
  EXPECT_EQ(Done("ENCO D0 D1 K2", {0x4001, 9}).d(1), 0) << "of the low four bits";
  EXPECT_EQ(Done("ENCO D0 D1 K4", {0, 9}).error(), "ENCO: none of the bits of S is ON");
  EXPECT_EQ(Done("ENCO D0 D1 K0", {0, 9}).d(1), 9);
}

TEST(Lx3vpIlData, SumCountsAndBonTests) {
  const Done some("SUM D0 D1", {-1, 0});
  EXPECT_EQ(some.d(1), 16);
  EXPECT_FALSE(some.flag(nothing));
  EXPECT_TRUE(Done("SUMP D0 D1").flag(nothing));
  EXPECT_THAT(Done("DSUM D0 D2", {-1, 1, 9, 9}).words(2, 2), ElementsAre(17, 0));
  EXPECT_THAT(Done("BON D0 M0 K15\nBONP D0 M1 K14\nDBON D0 M2 K31", {0x4000, -1}).plc.values("M0 M1 M2"),
              ElementsAre(0, 1, 1));
  EXPECT_EQ(Done("BON D0 M0 D2", {0, 0, 16}).error(), "BON: n is 16; write 0 to 15");
  EXPECT_EQ(Done("DBON D0 M0 D2", {0, 0, 32}).error(), "DBON: n is 32; write 0 to 31");
}

TEST(Lx3vpIlData, WordsShiftBothWays) {
  const std::vector<int> words = {91, 92, 1, 2, 3, 4};
  EXPECT_THAT(Done("WSFR D0 D2 K4 K2", words).words(2, 4), ElementsAre(3, 4, 91, 92));
  EXPECT_THAT(Done("WSFLP D0 D2 K4 K2", words).words(2, 4), ElementsAre(91, 92, 1, 2));
  EXPECT_THAT(Done("WSFL D2 D2 K4 K1", words).words(2, 4), ElementsAre(1, 1, 2, 3)) << "S may lie in D";
  EXPECT_EQ(Done("MOV H21 K2M0\nWSFR K1M8 K1M0 K2 K1\nMOV K2M0 D0").d(0), 0x02) << "groups of four bits";
  EXPECT_EQ(Done("WSFR D0 D2 K2 D1", {0, 3}).error(), "WSFR: 3 words of 2 are to be shifted");
  EXPECT_EQ(Done("WSFR D0 D8150 D1 K1", {0, 200}).error(),
            "WSFR: 200 values from D8150 on go beyond what there is");
  EXPECT_THAT(faults("LD X0\nWSFL K1M0 K2M20 K2 K1\nEND"),
              ElementsAre("2:11: WSFL from K1M0 to K2M20; group as many bits in both [il.operand]"));
}

TEST(Lx3vpIlData, AQueueGivesFirstWhatCameFirst) {
  Plc plc("LDP X0\nSFWR D0 D10 K4\nLDP X1\nSFRD D10 D1 K4");
  const auto pulse = [&](std::size_t input) {
    plc.registers.x[input] = true;
    plc.scan();
    plc.registers.x[input] = false;
    const bool full = plc.registers.m[above];
    const bool empty = plc.registers.m[nothing];
    plc.scan();
    return input == 0 ? full : empty;
  };
  for (const int value : {11, 22, 33}) {
    plc.registers.set_i16(0, static_cast<std::int16_t>(value));
    EXPECT_FALSE(pulse(0)) << value;
  }
  plc.registers.set_i16(0, 44);
  EXPECT_TRUE(pulse(0)) << "three of four words hold values, the first counts";
  EXPECT_THAT(plc.values("D10 D11 D12 D13"), ElementsAre(3, 11, 22, 33));
  EXPECT_FALSE(pulse(1));
  EXPECT_THAT(plc.values("D1 D10 D11 D12 D13"), ElementsAre(11, 2, 22, 33, 33)) << "the last word stays";
  pulse(1);
  pulse(1);
  EXPECT_THAT(plc.values("D1 D10"), ElementsAre(33, 0));
  EXPECT_TRUE(pulse(1));
  EXPECT_THAT(plc.values("D1 D10"), ElementsAre(33, 0));
  EXPECT_EQ(Done("SFWR D0 D1 K4", {0, -1}).error(), "SFWR: -1 words stand in the queue");
  EXPECT_EQ(Done("SFRD D1 D0 K4", {0, 4}).error(), "SFRD: 4 words stand in a queue of 3");
  EXPECT_EQ(Done("SFRD D1 D0 D2", {0, 0, 1}).error(), "SFRD: n is 1; write 2 to 512");
}

TEST(Lx3vpIlData, BlocksOfBitsMoveInTheirGroups) {
  EXPECT_EQ(Done("MOV H1234 K4M0\nBMOV K2M0 K2M20 K2\nMOV K4M20 D0").d(0), 0x1234);
  EXPECT_THAT(Done("MOV H1234 K4M0\nBMOV K1M0 D0 K4").words(0, 4), ElementsAre(4, 3, 2, 1));
  EXPECT_EQ(Done("BMOV D0 K1M0 K2\nMOV K2M0 D5", {0x15, 0x16}).d(5), 0x65) << "the low bits of each word";
  EXPECT_THAT(Done("SET M8024\nBMOV D0 D2 K2", {1, 2, 3, 4}).words(0, 4), ElementsAre(3, 4, 3, 4));
  EXPECT_EQ(Done("SET M8024\nBMOV K1X0 D2 K2").error(),
            "BMOV: M8024 turns the move round, and inputs are not written");
  EXPECT_THAT(Done("MOV K7 T5\nBMOV T5 D0 K1\nFMOV K3 K1M0 K2\nMOV K2M0 D1").words(0, 2),
              ElementsAre(7, 0x33));
  EXPECT_THAT(faults("LD X0\nBMOV K2M0 K1M20 K2\nBMOV D0 K1X0 K1\nEND"),
              ElementsAre("2:11: BMOV from K2M0 to K1M20; group as many bits in both [il.operand]",
                          "3:9: BMOV does not take K1X0 here; it takes D, T, C or bits (K4M0) of Y, M or S "
                          "[il.operand]"));
  covers({"M8024"});
}

TEST(Lx3vpIlData, RstClearsIndexRegisters) {
  Plc plc("LD M8000\nMOV K5 V3\nMOV K6 Z3\nLD X0\nRST V3\nRST Z3");
  EXPECT_THAT(plc.scan().values("V3 Z3"), ElementsAre(5, 6));
  plc.registers.x[0] = true;
  EXPECT_THAT(plc.scan().values("V3 Z3"), ElementsAre(0, 0));
}

TEST(Lx3vpIlData, TimesOfDayAreComparedAndAdded) {
  const std::vector<int> noon = {12, 30, 15};
  EXPECT_THAT(Done("TCMP K12 K30 K15 D0 M0", noon).plc.values("M0 M1 M2"), ElementsAre(0, 1, 0));
  EXPECT_THAT(Done("TCMP K12 K30 K16 D0 M0", noon).plc.values("M0 M1 M2"), ElementsAre(1, 0, 0));
  EXPECT_THAT(Done("TCMP K11 K59 K59 D0 M0", noon).plc.values("M0 M1 M2"), ElementsAre(0, 0, 1));
  const std::vector<int> shift = {6, 0, 0, 14, 0, 0, 14, 0, 1};
  EXPECT_THAT(Done("TZCP D0 D3 D6 M0", shift).plc.values("M0 M1 M2"), ElementsAre(0, 0, 1));
  EXPECT_THAT(Done("TZCP D0 D3 D3 M0", shift).plc.values("M0 M1 M2"), ElementsAre(0, 1, 0));
  const Done late("TADD D0 D3 D6", {23, 50, 40, 0, 9, 21});
  EXPECT_THAT(late.words(6, 3), ElementsAre(0, 0, 1));
  EXPECT_TRUE(late.flag(above));
  const Done midnight("TADD D0 D3 D6", {23, 50, 40, 0, 9, 20});
  EXPECT_THAT(midnight.words(6, 3), ElementsAre(0, 0, 0));
  EXPECT_TRUE(midnight.flag(nothing));
  const Done early("TSUBP D0 D3 D6", {5, 0, 0, 5, 0, 1});
  EXPECT_THAT(early.words(6, 3), ElementsAre(23, 59, 59));
  EXPECT_TRUE(early.flag(below));
  EXPECT_EQ(Done("TCMP K12 D1 K0 D3 M0", {0, 60}).error(), "TCMP: the minute S2 is 60; write 0 to 59");
  EXPECT_EQ(Done("TADD D0 D3 D6", {24, 0, 0}).error(), "TADD: 24:0:0 is no time of day");
}

TEST(Lx3vpIlData, TheClockIsReadAndSet) {
  // Three minutes after its beginning: Saturday, 1 January 2000.
  Plc plc("LD X0\nTWR D0\nLD M8000\nTRD D10");
  plc.registers.now_ns = 183'000'000'000;
  EXPECT_THAT(plc.scan().values("D10 D11 D12 D13 D14 D15 D16"), ElementsAre(0, 1, 1, 0, 3, 3, 6));
  for (const int word : {0, 1, 2, 3, 4, 5, 6}) plc.registers.set_i16(word, std::int16_t{0});
  plc.registers.x[0] = true;
  EXPECT_THAT(plc.scan().notes.calls,
              ElementsAre("error 1 6706 p.il:2: 6706: TWR: year 0, month 0, day 0, 0:0:0 "
                          "is no time"));
  const std::vector<int> leap_day = {24, 2, 29, 23, 59, 59, 0};
  for (std::size_t i = 0; i < leap_day.size(); ++i)
    plc.registers.set_i16(static_cast<int>(i), static_cast<std::int16_t>(leap_day[i]));
  EXPECT_THAT(plc.scan().values("D10 D11 D12 D13 D14 D15 D16"), ElementsAre(24, 2, 29, 23, 59, 59, 4))
      << "the weekday is the calendar's";
  plc.registers.x[0] = false;
  plc.registers.now_ns += 1'000'000'000;
  EXPECT_THAT(plc.scan().values("D10 D11 D12 D13 D14 D15 D16"), ElementsAre(24, 3, 1, 0, 0, 0, 5));
  plc.registers.x[0] = true;
  plc.registers.set_i16(0, 99);
  plc.registers.set_i16(2, 28);
  EXPECT_EQ(plc.scan().values("D10")[0], 99) << "1999";
  EXPECT_EQ(plc.values("D16")[0], 0) << "28 February 1999 was a Sunday";
}

}  // namespace
}  // namespace drycut::devices::lx3vp::il
