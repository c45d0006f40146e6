// What instruction lists do: contacts, connections, coils, timers, counters, jumps.
#include "tests/devices/lx3vp/covers.hpp"
#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp::il {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Y0 after a scan with these inputs.
bool out(Plc& plc, std::initializer_list<int> on) {
  plc.registers.x.fill(false);
  for (const int x : on) plc.registers.x[static_cast<std::size_t>(x)] = true;
  plc.scan();
  return plc.registers.y[0];
}

/// A scan with every combination of so many inputs; `check` is given their bits.
template <typename Check>
void with_inputs(Plc& plc, int count, const Check& check) {
  for (int inputs = 0; inputs < 1 << count; ++inputs) {
    SCOPED_TRACE(inputs);
    const auto bit = [&](int n) { return (inputs >> n & 1) != 0; };
    for (int n = 0; n < count; ++n) plc.registers.x[static_cast<std::size_t>(n)] = bit(n);
    plc.scan();
    check(bit);
  }
}

TEST(IlScan, SeriesAndParallel) {
  Plc plc("LD X0\nANI X1\nOR X2\nORI X3\nOUT Y0");
  with_inputs(plc, 4,
              [&](auto bit) { EXPECT_EQ(plc.registers.y[0], (bit(0) && !bit(1)) || bit(2) || !bit(3)); });
}

TEST(IlScan, BlocksAreJoined) {
  Plc plc("LD X0\nOR X1\nLD X2\nAND X3\nLDI X4\nORB\nANB\nINV\nOUT Y0");
  with_inputs(plc, 5, [&](auto bit) {
    EXPECT_EQ(plc.registers.y[0], !((bit(0) || bit(1)) && ((bit(2) && bit(3)) || !bit(4))));
  });
}

TEST(IlScan, BranchesAreTakenUp) {
  Plc plc("LD X0\nMPS\nAND X1\nOUT Y0\nMRD\nLD X2\nOR X3\nANB\nOUT Y1\nMPP\nANI X1\nOUT Y2\nLD X4\nOUT Y3");
  with_inputs(plc, 5, [&](auto bit) {
    EXPECT_THAT(plc.values("Y0 Y1 Y2 Y3"),
                ElementsAre(bit(0) && bit(1), bit(0) && (bit(2) || bit(3)), bit(0) && !bit(1), bit(4)));
  });
}

TEST(IlScan, OctalNumbersAndBitsOfWords) {
  Plc plc("LD X10\nOUT Y17\nLD D5.A\nOUT D6.0");
  plc.registers.x[8] = true;
  plc.registers.d[5] = 0x0400;
  plc.registers.d[6] = 0xFFFE;
  EXPECT_TRUE(plc.scan().registers.y[15]);
  EXPECT_EQ(plc.registers.d[6], 0xFFFF);
  plc.registers.d[5] = 0xFBFF;
  EXPECT_EQ(plc.scan().registers.d[6], 0xFFFE);
}

TEST(IlScan, EdgesLastOneScan) {
  for (const std::string edge : {"P", "F"}) {
    for (const std::string way : {"LD", "LD M8000\nAND", "LD M1\nOR"}) {
      Plc plc(way + edge + " X0\nOUT Y0");
      std::string outputs;
      for (const char input : std::string("01100100")) {
        plc.registers.x[0] = input == '1';
        plc.scan();
        outputs += plc.registers.y[0] ? '1' : '0';
      }
      EXPECT_EQ(outputs, edge == "P" ? "01000100" : "00010010") << way << edge;
    }
  }
}

TEST(IlScan, AnEdgeIsSeenThoughTheRungBeforeItIsOff) {
  // The contact follows its device in every scan, not only where power comes to it.
  Plc plc("LD X1\nANDP X0\nOUT Y0");
  EXPECT_FALSE(out(plc, {}));
  EXPECT_FALSE(out(plc, {0}));
  EXPECT_FALSE(out(plc, {0, 1}));
}

TEST(IlScan, PulsesOfOneScan) {
  Plc plc("LD X0\nPLS M0\nLD X0\nPLF M1\nLD M0\nOUT Y0\nLD M1\nOUT Y1");
  EXPECT_TRUE(out(plc, {0}));
  EXPECT_FALSE(out(plc, {0}));
  EXPECT_FALSE(plc.registers.y[1]);
  EXPECT_FALSE(out(plc, {}));
  EXPECT_TRUE(plc.registers.y[1]);
  out(plc, {});
  EXPECT_FALSE(plc.registers.y[1]);
}

TEST(IlScan, AfterPowerUpWhatIsOnIsAnEdge) {
  Plc plc("LD X0\nINCP D0");
  plc.registers.x[0] = true;
  EXPECT_EQ(plc.scan(3).registers.d[0], 1);
  plc.restart();
  EXPECT_EQ(plc.scan().registers.d[0], 2);
}

TEST(IlScan, SetAndResetStay) {
  Plc plc("LD X0\nSET M5\nSET D1.3\nLD X1\nRST M5\nRST D1.3\nRST D2\nRST T0\nRST C0");
  plc.registers.d[2] = 77;
  plc.registers.t[0] = {5, true, true};
  plc.registers.c[0] = {5, false, true};
  out(plc, {0});
  out(plc, {});
  EXPECT_THAT(plc.values("M5 D1"), ElementsAre(1, 8));
  out(plc, {1});
  EXPECT_THAT(plc.values("M5 D1 D2 T0 TS0 C0 CS0"), ElementsAre(0, 0, 0, 0, 0, 0, 0));
}

TEST(IlScan, ZrstResetsARange) {
  Plc plc("LD X0\nZRST M10 M12\nZRST D5 D7\nZRST C3 C4");
  plc.registers.m.fill(true);
  plc.registers.d.fill(9);
  plc.registers.c.fill({7, false, true});
  out(plc, {0});
  for (int i = 8; i < 15; ++i) EXPECT_EQ(plc.registers.m[static_cast<std::size_t>(i)], i < 10 || i > 12) << i;
  for (int i = 4; i < 9; ++i)
    EXPECT_EQ(plc.registers.d[static_cast<std::size_t>(i)], i < 5 || i > 7 ? 9 : 0) << i;
  EXPECT_THAT(plc.values("C2 C3 CS4"), ElementsAre(7, 0, 0));
}

TEST(IlScan, AltInverts) {
  Plc plc("LD X0\nALTP Y0");
  EXPECT_TRUE(out(plc, {0}));
  EXPECT_TRUE(out(plc, {0}));
  EXPECT_TRUE(out(plc, {}));
  EXPECT_FALSE(out(plc, {0}));
}

// Timers; a scan is 10 ms.

TEST(IlTimers, OnDelay) {
  Plc plc("LD X0\nOUT T0 K3\nLD T0\nOUT Y0");  // 300 ms
  plc.registers.x[0] = true;
  EXPECT_THAT(plc.scan(30).values("Y0 T0"), ElementsAre(0, 2));
  EXPECT_TRUE(plc.scan().registers.y[0]);
  EXPECT_EQ(plc.scan(100).registers.t[0].value, 3);
  plc.registers.x[0] = false;
  EXPECT_THAT(plc.scan().values("Y0 T0"), ElementsAre(0, 0));
}

TEST(IlTimers, UnitsAndSetValuesInRegisters) {
  Plc plc("LD X0\nOUT T200 D0\nOUT T246 K25\nLD T200\nOUT Y0\nLD T246\nOUT Y1");
  plc.registers.d[0] = 5;
  plc.registers.x[0] = true;
  plc.scan(3);  // 20 ms
  EXPECT_FALSE(plc.registers.y[1]);
  EXPECT_TRUE(plc.scan().registers.y[1]);  // 25 ms are over at 30
  EXPECT_EQ(plc.registers.t[246].value, 25);
  EXPECT_FALSE(plc.scan().registers.y[0]);
  EXPECT_TRUE(plc.scan().registers.y[0]);
}

TEST(IlTimers, RetentiveOnesGoOn) {
  Plc plc("LD X0\nOUT T250 K2\nLD X1\nRST T250\nLD T250\nOUT Y0");
  plc.registers.x[0] = true;
  plc.scan(16);  // 150 ms
  EXPECT_EQ(plc.registers.t[250].value, 1);
  plc.registers.x[0] = false;
  plc.scan(50);
  plc.registers.x[0] = true;
  EXPECT_FALSE(plc.scan(5).registers.y[0]);  // 190 ms
  EXPECT_TRUE(plc.scan().registers.y[0]);
  plc.registers.x[0] = false;
  plc.registers.x[1] = true;
  EXPECT_THAT(plc.scan().values("Y0 T250"), ElementsAre(0, 0));
}

TEST(IlTimers, NoTimeIsLostBetweenScansThatDoNotDivideTheUnit) {
  Problems problems;
  const auto program = compile("LD M8000\nOUT T200 K32767\nEND", "p.il", problems);
  Registers registers;
  registers.m[8000] = true;
  Notes notes;
  ProgramScan scanner(program);
  for (int i = 0; i <= 1000; ++i) {
    registers.time_ns = i * 3'700'000LL;
    scanner.scan(registers, notes);
    ASSERT_EQ(registers.t[200].value, registers.time_ns / 10'000'000) << i;
  }
}

// Counters.

TEST(IlCounters, CountsEdgesUpToItsSetValue) {
  Plc plc("LD X0\nOUT C0 K3\nLD C0\nOUT Y0\nLD X1\nRST C0");
  for (int i = 1; i <= 5; ++i) {
    EXPECT_EQ(out(plc, {0}), i >= 3) << i;
    EXPECT_EQ(plc.registers.c[0].value, std::min(i, 3));
    out(plc, {});
  }
  out(plc, {1});
  EXPECT_EQ(plc.registers.c[0].value, 0);
  EXPECT_FALSE(out(plc, {}));
}

TEST(Lx3vpCounters, WideOnesCountBothWays) {
  covers({"M8200"});
  Plc plc("LD X1\nOUT M8200\nLD X0\nOUT C200 K-2\nLD C200\nOUT Y0");
  const auto count = [&](bool down) {
    const bool contact = down ? out(plc, {0, 1}) : out(plc, {0});
    plc.registers.x[0] = false;
    plc.scan();
    return contact;
  };
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(count(true));
  EXPECT_EQ(plc.registers.c[200].value, -4);
  EXPECT_FALSE(count(false));  // -3
  EXPECT_TRUE(count(false));   // -2, from below
  EXPECT_TRUE(count(false));   // -1
  EXPECT_TRUE(count(true));    // -2 from above
  EXPECT_FALSE(count(true));   // leaves it downwards
}

TEST(IlCounters, WideOnesGoRound) {
  Plc plc("LD X0\nOUT C200 K0");
  plc.registers.c[200].value = 2147483647;
  out(plc, {0});
  EXPECT_EQ(plc.registers.c[200].value, -2147483647 - 1);
}

TEST(IlCounters, HighSpeedOnesAreTheControllers) {
  Plc plc("LD X0\nOUT C251 D10");
  plc.registers.set_i32(10, 100000);
  plc.scan();
  EXPECT_THAT(plc.notes.calls, ElementsAre("counter C251 100000 off"));
  out(plc, {0});
  EXPECT_THAT(plc.notes.calls, ElementsAre("counter C251 100000 on"));
}

// Outputs of the controller.

TEST(IlOutputs, CamsAndPulsesWithTheirPower) {
  Plc plc(
      "LD X0\nDECAM C251 D2000 X10 Y0 Y4\nDECAM D5 D3000 M7 Y1 Y5\nDECAM K10 D4000 X0 Y2 Y6\n"
      "LD X1\nDPLSV D20 Y3 Y7\nPLSV K-5 Y0 Y10\nDDRVI K-1000 K5000 Y1 Y5\nDDRVA D20 K5000 Y2 Y6");
  plc.registers.set_i32(20, -123456);
  out(plc, {0});
  EXPECT_THAT(plc.notes.calls, ElementsAre("decam 1 C251 D2000 X8 Y0 Y4 on", "decam 22 D5 D3000 M7 Y1 Y5 on",
                                           "decam 43 K10 D4000 X0 Y2 Y6 on", "plsv 65 -123456 Y3 Y7 off",
                                           "plsv 82 -5 Y0 Y8 off", "drvi 91 -1000 5000 Y1 Y5 off",
                                           "drva 108 -123456 5000 Y2 Y6 off"));
  out(plc, {1});
  EXPECT_EQ(plc.notes.calls[0], "decam 1 C251 D2000 X8 Y0 Y4 off");
  EXPECT_EQ(plc.notes.calls[6], "drva 108 -123456 5000 Y2 Y6 on");
}

// Jumps.

TEST(IlJumps, PassOverWhatIsBetween) {
  Plc plc("LD X0\nCJ P1\nLD M8000\nOUT Y0\nINC D0\nP1\nLD M8000\nOUT Y1");
  EXPECT_TRUE(out(plc, {}));
  EXPECT_EQ(plc.registers.d[0], 1);
  plc.registers.m[8000] = false;
  EXPECT_TRUE(out(plc, {0}));  // the coil stays as it was
  EXPECT_THAT(plc.values("D0 Y1"), ElementsAre(1, 0));
}

TEST(IlJumps, FendEndsTheScan) {
  Plc plc("LD X0\nCJ P5\nLD M8000\nOUT Y0\nFEND\nP5\nLD M8000\nOUT Y1");
  out(plc, {});
  EXPECT_FALSE(plc.registers.y[1]);
  out(plc, {0});
  EXPECT_TRUE(plc.registers.y[1]);
}

TEST(IlJumps, OutOfABranch) {
  Plc plc("LD X0\nMPS\nAND X1\nCJ P1\nMPP\nOUT Y0\nP1\nLD X2\nMPS\nOUT Y1\nMPP\nOUT Y2");
  out(plc, {0, 1});
  EXPECT_FALSE(plc.registers.y[0]);
  out(plc, {0, 2});
  EXPECT_THAT(plc.values("Y0 Y1 Y2"), ElementsAre(1, 1, 1));
}

}  // namespace
}  // namespace drycut::devices::lx3vp::il
