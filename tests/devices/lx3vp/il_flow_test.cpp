// Loops, subroutines, master contacts, steps of sequences, and the watchdog.
#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp::il {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A scan with these inputs.
Plc& scan(Plc& plc, std::initializer_list<int> on = {}) {
  plc.registers.x.fill(false);
  for (const int x : on) plc.registers.x[static_cast<std::size_t>(x)] = true;
  return plc.scan();
}
std::string outputs(const Plc& plc, std::size_t count = 4) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += plc.registers.y[i] ? '1' : '0';
  return text;
}

// FOR and NEXT.

TEST(IlLoops, RepeatWhatIsBetweenThem) {
  Plc plc("FOR K3\nLD M8000\nINC D0\nFOR D5\nLD M8000\nINC D1\nNEXT\nNEXT\nLD M8000\nINC D2");
  plc.registers.d[5] = 4;
  EXPECT_THAT(scan(plc).values("D0 D1 D2"), ElementsAre(3, 12, 1));
  plc.registers.set_i16(5, -7);
  EXPECT_EQ(scan(plc).registers.d[1], 15) << "0 and less are once";
}

TEST(IlLoops, AJumpLeavesThem) {
  // Finds the first of D10.. that is 0 and leaves both loops; the next loop counts anew.
  Plc plc(
      "FOR K2\nFOR K10\nLD= K0 D10Z0\nCJ P0\nLD M8000\nINC Z0\nNEXT\nNEXT\nP0\nFOR K2\nLD M8000\nINC "
      "D0\nNEXT");
  for (std::size_t i = 10; i < 14; ++i) plc.registers.d[i] = 1;
  EXPECT_THAT(scan(plc).values("Z0 D0"), ElementsAre(4, 2));
}

TEST(IlLoops, ATimerInALoopRunsOnce) {
  Plc plc("FOR K5\nLD M8000\nOUT T200 K1000\nNEXT");
  scan(plc);
  for (int i = 0; i < 10; ++i) scan(plc);
  EXPECT_EQ(plc.registers.t[200].value, 10) << "10 ms a scan";
}

TEST(IlLoops, WhatDoesNotPairOff) {
  expect_faults(
      {{"FOR K3\nLD X0\nINC D0\nEND",
        {"1:1: FOR has no NEXT before END in line 4; end what is repeated with NEXT [il.structure]"}},
       {"LD X0\nINC D0\nNEXT\nEND",
        {"3:1: NEXT has no FOR; begin what is repeated with FOR [il.structure]"}}});
  std::string six;
  for (int i = 0; i < 6; ++i) six += "FOR K2\n";
  for (int i = 0; i < 6; ++i) six += "NEXT\n";
  expect_faults(
      {{six + "END", {"6:1: FOR stands inside 5 others; no more than 5 FORs in each other [il.structure]"}},
       {"LD X0\nCJ P1\nFOR K2\nP1\nLD X1\nINC D0\nNEXT\nEND",
        {"2:4: CJ jumps between FOR in line 3 and its NEXT; begin the loop at its FOR [il.jump]"}},
       {"FOR K2\nLD X0\nMC N0 M100\nMCR N0\nNEXT\nEND",
        {"3:1: MC stands between FOR in line 1 and its NEXT; loops hold no master contacts and no steps of "
         "sequences [il.structure]",
         "4:1: MCR stands between FOR in line 1 and its NEXT; loops hold no master contacts and no steps of "
         "sequences [il.structure]"}},
       {"LD X0\nFOR K2\nNEXT\nEND",
        {"2:1: the contacts before it lead to no coil; end them with OUT or another instruction "
         "[il.rung]"}}});
}

// CALL and SRET.

TEST(IlCalls, RunASubroutineAndComeBack) {
  Plc plc(
      "LD X0\nCALL P1\nLD X1\nCALLP P1\nLD M8000\nOUT Y0\nFEND\nP1\nLD M8000\nINC D0\nLD X2\nCALL "
      "P2\nSRET\nP2\nLD M8000\nINC D1\nSRET");
  EXPECT_THAT(scan(plc).values("D0 Y0"), ElementsAre(0, 1));
  EXPECT_EQ(scan(plc, {0}).registers.d[0], 1);
  EXPECT_THAT(scan(plc, {0, 1, 2}).values("D0 D1"), ElementsAre(3, 2));
  EXPECT_EQ(scan(plc, {1}).registers.d[0], 3) << "CALLP on the edge only";
}

TEST(IlCalls, ALoopGoesOnBehindACall) {
  Plc plc(
      "FOR K3\nLD M8000\nCALL P1\nNEXT\nFEND\nP1\nFOR K10\nLD M8000\nINC D0\nLD= D0 K2\nCJ "
      "P2\nNEXT\nP2\nSRET");
  EXPECT_EQ(scan(plc).registers.d[0], 22) << "2, 10 and 10: the jump leaves the inner loop only";
}

TEST(IlCalls, FiveDeepAtMost) {
  Plc plc("LD M8000\nCALL P1\nFEND\nP1\nLD M8000\nINC D0\nCALL P1\nSRET");
  EXPECT_EQ(scan(plc).registers.d[0], 5);
  EXPECT_THAT(plc.notes.calls,
              ElementsAre("error 10 6702 p.il:7: 6702: CALL: five subroutines call each other already"));
}

TEST(IlCalls, SubroutinesStandBehindFendAndEndWithSret) {
  expect_faults(
      {{"LD X0\nCALL P1\nP1\nLD X1\nOUT Y0\nEND",
        {"2:6: P1 in line 3 is no subroutine: it has no SRET; put it behind FEND and end it with SRET "
         "[il.jump]"}},
       {"LD X0\nCALL P7\nFEND\nEND", {"2:6: there is no label P7; give it a line of its own [il.jump]"}},
       {"LD X0\nOUT Y0\nSRET\nEND",
        {"3:1: SRET stands in the main program; put subroutines behind FEND [il.structure]"}}});
  const std::string subroutine = "FEND\nP1\nLD X1\nOUT Y0\n";
  expect_faults(
      {{"LD X0\nCJ P1\n" + subroutine + "SRET\nEND", {"2:4: CJ jumps into a subroutine; use CALL [il.jump]"}},
       {"P0\nLD X0\nCALL P1\n" + subroutine + "CJ P0\nSRET\nEND",
        {"8:4: CJ jumps out of a subroutine; leave it by SRET [il.jump]"}},
       {"LD X0\nCALL P1\nFEND\nFOR K2\nP1\nNEXT\nSRET\nEND",
        {"2:6: P1 stands between FOR in line 4 and its NEXT; call a subroutine at its beginning "
         "[il.jump]"}}});
}

TEST(IlJumps, P63IsTheEnd) {
  Plc plc("LD X0\nCJ P63\nLD M8000\nINC D0");
  EXPECT_EQ(scan(plc, {0}).registers.d[0], 0);
  EXPECT_EQ(scan(plc).registers.d[0], 1);
}

// MC and MCR.

TEST(IlMasters, SwitchWhatFollows) {
  Plc plc(
      "LD X0\nMC N0 M100\nLDI X1\nOUT Y0\nLD X2\nSET Y1\nLD M8000\nOUT T0 K50\nLD X3\nMC N1 M101\nLD "
      "M8000\nOUT "
      "Y2\nMCR N1\nLD M8000\nOUT Y3\nMCR N0\nLD M8000\nOUT Y4");
  EXPECT_EQ(outputs(scan(plc, {2}), 5), "00001") << "LDI too has no power";
  EXPECT_EQ(outputs(scan(plc, {0, 2}), 5), "11011");
  EXPECT_THAT(plc.values("M100 M101"), ElementsAre(1, 0));
  EXPECT_EQ(outputs(scan(plc, {0, 3}), 5), "11111");
  EXPECT_TRUE(plc.registers.t[0].coil);
  EXPECT_EQ(outputs(scan(plc, {3}), 5), "01001") << "what was set stays";
  EXPECT_FALSE(plc.registers.m[101]) << "an inner master needs the outer one";
  EXPECT_FALSE(plc.registers.t[0].coil);
}

TEST(IlMasters, AnOuterMcrEndsTheInnerOnes) {
  Plc plc("LD X0\nMC N0 M100\nLD X1\nMC N1 M101\nMCR N0\nLD M8000\nOUT Y0");
  EXPECT_TRUE(scan(plc).registers.y[0]);
}

TEST(IlMasters, WhatDoesNotPairOff) {
  expect_faults(
      {{"LD X0\nMC N0 M100\nLD X1\nOUT Y0\nEND",
        {"2:1: MC N0 has no MCR N0 before END in line 5; end it with MCR N0 [il.structure]"}},
       {"MCR N2\nEND", {"1:1: MCR N2 has no MC N2; begin it with MC [il.structure]"}},
       {"LD X0\nMC N1 M100\nLD X1\nMC N1 M101\nMCR N1\nMCR N1\nEND",
        {"4:1: MC N1 stands inside N1 of line 2; inner master contacts have the higher number [il.structure]",
         "6:1: MCR N1 has no MC N1; begin it with MC [il.structure]"}},
       {"MC N0 M100\nMCR N0\nEND",
        {"1:1: MC has no contact before it; begin with LD; LD M8000 is always ON [il.rung]"}}});
  EXPECT_THAT(faults("LD X0\nMC N8 M100\nEND"),
              testing::Contains("2:4: 'N8' does not exist; there are N0 to N7 [il.out-of-range]"));
}

// STL and RET.

const char* const sequence =
    "LD M0\nSET S0\n"
    "STL S0\nOUT Y0\nLD X0\nSET S20\n"
    "STL S20\nOUT Y1\nOUT T0 K5\nLD X3\nSET Y5\nLD T0\nSET S21\n"
    "STL S21\nOUT Y2\nLD X1\nOUT S0\n"
    "RET\nLD M8000\nOUT Y3";

TEST(IlStates, GoOnFromStepToStep) {
  Plc plc(sequence);
  EXPECT_EQ(outputs(scan(plc, {0})), "0001") << "no step is active";
  plc.registers.m[0] = true;
  scan(plc);
  plc.registers.m[0] = false;
  EXPECT_EQ(outputs(plc), "1001");
  EXPECT_EQ(outputs(scan(plc, {0})), "1101") << "both steps work in the scan of the change";
  EXPECT_THAT(plc.values("S0 S20"), ElementsAre(0, 1));
  EXPECT_EQ(outputs(scan(plc, {3})), "0101") << "the coils of the step that was left go OFF";
  plc.scan(60);
  EXPECT_EQ(outputs(plc), "0011");
  EXPECT_EQ(plc.registers.t[0].value, 0);
  EXPECT_TRUE(plc.registers.y[5]) << "what was set stays";
  EXPECT_TRUE(scan(plc, {1}).registers.s[0]) << "OUT goes on to a step too";
  EXPECT_FALSE(plc.registers.s[21]);
  EXPECT_EQ(outputs(scan(plc)), "1001");
}

// A coil of a step that is not active is not touched: another step may have the same.
TEST(IlStates, StepsMayShareACoil) {
  Plc plc("STL S20\nOUT Y0\nSTL S21\nOUT Y0\nSTL S22\nOUT Y1\nRET");
  plc.registers.s[20] = true;
  EXPECT_EQ(outputs(scan(plc), 2), "10");
  plc.registers.s[20] = false;
  plc.registers.s[21] = true;
  EXPECT_EQ(outputs(scan(plc), 2), "10");
  plc.registers.y[1] = true;
  EXPECT_EQ(outputs(scan(plc), 2), "11") << "S22 was never active";
}

// Parallel branches come together: the STL in a row are one condition, and the way on leaves all of them.
TEST(IlStates, BranchesComeTogether) {
  Plc plc("STL S20\nOUT Y0\nSTL S30\nOUT Y1\nSTL S21\nSTL S31\nLD X0\nSET S40\nSTL S40\nOUT Y2\nRET");
  plc.registers.s[21] = true;
  EXPECT_FALSE(scan(plc, {0}).registers.s[40]) << "S31 is not active yet";
  plc.registers.s[31] = true;
  EXPECT_EQ(outputs(scan(plc, {0}), 3), "001");
  EXPECT_THAT(plc.values("S21 S31"), ElementsAre(0, 0));
}

TEST(IlStates, WhatDoesNotPairOff) {
  expect_faults(
      {{"STL S20\nOUT Y0\nEND",
        {"1:1: the sequence with S20 has no RET before END in line 3; end the last step of a sequence with "
         "RET [il.structure]"}},
       {"RET\nEND", {"1:1: RET has no STL before it; begin a step of a sequence with STL [il.structure]"}},
       {"STL S20\nLD X0\nMC N0 M100\nMCR N0\nRET\nEND",
        {"3:1: MC stands inside the step S20; end the sequence with RET before [il.structure]",
         "4:1: MCR stands inside the step S20; end the sequence with RET before [il.structure]"}},
       {"LD X0\nMC N0 M100\nSTL S20\nOUT Y0\nRET\nMCR N0\nEND",
        {"3:1: STL stands inside MC of line 2; end the master contact with MCR before [il.structure]"}},
       {"LD X0\nCALL P1\nFEND\nP1\nSTL S20\nOUT Y0\nRET\nSRET\nEND",
        {"5:1: STL stands in a subroutine; put master contacts and sequences into the main program "
         "[il.structure]"}},
       {"LD X0\nCALL P1\nFEND\nP1\nLD X1\nMC N0 M100\nMCR N0\nSRET\nEND",
        {"6:1: MC stands in a subroutine; put master contacts and sequences into the main program "
         "[il.structure]"}},
       {"STL S20\nLD X0\nCJ P1\nRET\nP1\nEND",
        {"3:4: CJ jumps out of a step of a sequence; go on to another step with SET [il.jump]"}},
       {"STL M20\nRET\nEND", {"1:5: STL does not take M20 here; it takes S [il.operand]"}}});
}

// The watchdog counts work, not instructions.

TEST(IlWatchdog, StopsWhatDoesNotEnd) {
  const std::string text =
      "the scan works longer than the watchdog's 200 ms; repeat less in a scan (CJ back, FOR, blocks)";
  Plc back("P0\nLD M8000\nCJ P0\nLD M8000\nOUT Y0");
  scan(back);
  ASSERT_EQ(back.notes.calls.size(), 1U);
  EXPECT_EQ(back.notes.calls[0].substr(back.notes.calls[0].find("6105")), "6105: " + text);
  EXPECT_FALSE(back.registers.y[0]);
  Plc loops("FOR K32767\nFOR K32767\nFOR K32767\nLD M8000\nINC D0\nNEXT\nNEXT\nNEXT\nLD M8000\nOUT Y0");
  scan(loops);
  ASSERT_EQ(loops.notes.calls.size(), 1U);
  EXPECT_EQ(loops.notes.calls[0], "watchdog 13 p.il:6: 6105: " + text);
  // 30000 turns of three instructions are 90000; that each moves 512 words makes it 15 million.
  Plc small("FOR K30000\nLD M8000\nMOV D0 D512\nNEXT\nLD M8000\nOUT Y0");
  scan(small);
  EXPECT_THAT(small.notes.calls, IsEmpty());
  EXPECT_TRUE(small.registers.y[0]);
  for (const std::string line :
       {"BMOV D0 D512 K512", "FMOV K1 D0 K512", "ZRST D0 D511", "SFTL X0 M0 K512 K1"}) {
    Plc large("FOR K30000\nLD M8000\n" + line + "\nNEXT\nLD M8000\nOUT Y0");
    scan(large);
    ASSERT_EQ(large.notes.calls.size(), 1U) << line;
    EXPECT_EQ(large.notes.calls[0], "watchdog 4 p.il:3: 6105: " + text) << line;
    EXPECT_FALSE(large.registers.y[0]);
  }
}

TEST(IlPulses, TrainsAndZeroReturnsReachTheController) {
  Plc plc("LD X0\nDPLSY K150000 D0 Y1\nLD X1\nZRN K4000 K200 M5 Y2");
  plc.registers.set_i32(0, 70000);
  scan(plc, {0});
  EXPECT_THAT(plc.notes.calls, ElementsAre("plsy 1 150000 70000 Y1 on", "zrn 15 4000 200 M5 Y2 off"));
  scan(plc, {1});
  EXPECT_THAT(plc.notes.calls, ElementsAre("plsy 1 150000 70000 Y1 off", "zrn 15 4000 200 M5 Y2 on"));
}

TEST(IlPulses, SpeedsAndCountsOutOfRange) {
  Plc plc("LD X0\nPLSY D0 D1 Y0\nLD X1\nZRN D0 D1 X5 Y0");
  const auto told = [&](int d0, int d1, int input) {
    plc.registers.set_i16(0, static_cast<std::int16_t>(d0));
    plc.registers.set_i16(1, static_cast<std::int16_t>(d1));
    scan(plc, {input});
    return plc.notes.calls.empty() ? "" : plc.notes.calls[input == 0 ? 0 : 1];
  };
  EXPECT_EQ(told(-1, 5, 0), "error 1 6706 p.il:2: 6706: PLSY: the frequency S1 is -1; write 0 to 200000");
  EXPECT_EQ(told(100, -5, 0),
            "error 1 6706 p.il:2: 6706: PLSY: the number of pulses S2 is -5; write 0 or more");
  EXPECT_EQ(told(0, 5, 1), "error 9 6706 p.il:4: 6706: ZRN: the speed S1 is 0; write 1 to 200000");
  EXPECT_EQ(told(100, 0, 1), "error 9 6706 p.il:4: 6706: ZRN: the creep speed S2 is 0; write 1 to 200000");
  EXPECT_THAT(faults("LD X0\nPLSY K100 K5 Y4\nZRN K100 K5 D0 Y0\nEND"),
              ElementsAre("2:14: PLSY does not take Y4 here; it takes Y0 to Y3 [il.operand]",
                          "3:13: ZRN does not take D0 here; it takes X, Y, M or S [il.operand]"));
}

}  // namespace
}  // namespace drycut::devices::lx3vp::il
