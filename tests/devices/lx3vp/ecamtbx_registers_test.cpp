// ECAMTBX as a program calls it: from a list in D registers to a cam's block.
#include "devices/lx3vp/ecamtbx_registers.hpp"

#include "tests/devices/lx3vp/bench.hpp"
#include "tests/devices/lx3vp/ecamtbx_bench.hpp"
#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::ElementsAre;

constexpr int block = 2000;
constexpr int result = 300;

/// The manual's rotary saw as its program writes it.
std::string rotary_program(const std::string& more = "") {
  return "LD M8000\nDMOV K3183 D100\nDMOV K1000 D102\nDMOV K333 D104\nDEDIV K5 K3 D106\nDEDIV K50 K3 D108\n"
         "MOV K1 D110\nMOV K0 D111\nMOV K0 D112\n" +
         more + "ECAMTBX D100 K100 D2000 D300";
}

TEST(EcamtbxRegisters, TheRotaryDemoAsAProgram) {
  il::Plc plc(rotary_program());
  plc.scan();
  EXPECT_THAT(plc.notes.calls, testing::IsEmpty());
  const auto& d = plc.registers;
  EXPECT_EQ(d.i32(result), 200);
  EXPECT_EQ(d.i16(block + 38), 200);
  EXPECT_EQ(d.i16(block + 39), 40);
  const auto rows = make_rotary_saw(ecams::rotary_demo()).rows;
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(d.i32(block + 40 + 4 * i), rows[static_cast<std::size_t>(i)].master);
    EXPECT_EQ(d.i32(block + 42 + 4 * i), rows[static_cast<std::size_t>(i)].slave);
  }
  EXPECT_EQ(d.i32(block + 40 + 800), 0);
  EXPECT_EQ(d.u32(block + 11), 0U);  // the sync output is not enabled
}

TEST(EcamtbxRegisters, WritesTheSynchronousZoneIfItsOutputIsEnabled) {
  il::Plc plc(rotary_program("MOV H1 D2004\nMOV K5 D111\n"));
  plc.scan();
  EXPECT_EQ(plc.registers.u32(block + 9), 2983U);
  EXPECT_EQ(plc.registers.u32(block + 11), 3183U);
}

TEST(EcamtbxRegisters, Word31TellsOfMidCamEndAndWord4StaysTheProgramsOwn) {
  for (const int curve : {0, 1, 2, 3, 5, 0x1003, 0x1001}) {
    Registers d;
    ecams::put(d, 100, SawParameters{2000, 1000, 400, 1, 3, 1, static_cast<std::uint16_t>(curve)});
    d.d[block + 4] = 0x8000;
    run_ecamtbx(d, 100, 100, block, result);
    ASSERT_EQ(d.i32(result), 200) << curve;
    EXPECT_EQ(d.d[block + 31], (curve & 0xFFF) == 3 ? 3 : 0) << curve;
    EXPECT_EQ(d.d[block + 4], 0x8000) << curve;
  }
}

// The cyclic cam of a table by midCAMend runs one cycle, to the pulse, and starts anew after word 5 was 0.
TEST(EcamtbxRegisters, ACyclicCamByMidCamEndRunsOneCycle) {
  CamBench bench;
  auto& d = bench.registers;
  ecams::put(d, 300, SawParameters{1000, 1500, 300, 2, 8, 1, mid_cam_end});
  run_ecamtbx(d, 300, 100, CamBench::block, 330);
  ASSERT_GT(d.i32(330), 0);
  bench.set(word::live, 0);  // whatever the program writes there after the table
  bench.start(1);
  for (int i = 0; i < 300; ++i) bench.travel(10);
  EXPECT_EQ(d.i32(8140), 1500);
  EXPECT_TRUE(bench.flag(status::completed, status::cyclic));
  bench.restart(1);
  for (int i = 0; i < 300; ++i) bench.travel(10);
  EXPECT_EQ(d.i32(8140), 3000);
}

// A table under a running cam is that of its next start, with its end.
TEST(EcamtbxRegisters, ATableUnderARunningCamIsThatOfTheNextStart) {
  CamBench bench;
  auto& d = bench.registers;
  const auto make = [&](std::uint16_t curve) {
    ecams::put(d, 300, SawParameters{1000, 1500, 300, 2, 8, 1, curve});
    run_ecamtbx(d, 300, 100, CamBench::block, 330);
    ASSERT_GT(d.i32(330), 0);
  };
  make(left_cam);
  bench.start(1);
  for (int i = 0; i < 50; ++i) bench.travel(10);
  make(mid_cam_end);
  for (int i = 0; i < 250; ++i) bench.travel(10);
  EXPECT_EQ(d.i32(8140), 4500) << "three cycles of the first";
  bench.restart(1);
  for (int i = 0; i < 300; ++i) bench.travel(10);
  EXPECT_EQ(d.i32(8140), 6000) << "one of the second";
}

// How midCAMend ends a later curve does not inherit.
TEST(EcamtbxRegisters, ALeftCamAfterAMidCamEndRunsOn) {
  CamBench bench;
  auto& d = bench.registers;
  for (const std::uint16_t curve : {mid_cam_end, left_cam}) {
    ecams::put(d, 300, SawParameters{1000, 1500, 300, 2, 8, 1, curve});
    run_ecamtbx(d, 300, 100, CamBench::block, 330);
    ASSERT_GT(d.i32(330), 0);
  }
  bench.start(1);
  for (int i = 0; i < 300; ++i) bench.travel(10);
  EXPECT_EQ(d.i32(8140), 4500) << "three cycles";
}

TEST(EcamtbxRegisters, AnErrorLeavesTheBlockAsItIs) {
  il::Plc plc(rotary_program("DEMOV E1 D108\n"));  // P5 below P4
  plc.registers.d[block + 38] = 77;
  plc.scan();
  EXPECT_EQ(plc.registers.i32(result), -4);
  EXPECT_EQ(plc.registers.i16(result), -4);  // the low word alone tells it too
  EXPECT_EQ(plc.registers.i16(block + 38), 77);
  EXPECT_EQ(plc.registers.i16(block + 39), 0);
}

// Each error in words, with the numbers of the list at hand.
TEST(EcamtbxRegisters, ErrorsSayWhatIsWrong) {
  const auto fault = [](const std::string& change) {
    il::Plc plc(
        "LD M8000\nDMOV K3000 D100\nDMOV K12900 D102\nDMOV K9400 D104\nDEMOV E2.5 D106\n"
        "DEMOV E2.5 D108\nMOV K1 D110\nMOV K101 D50\n" +
        change + "ECAMTBX D100 D50 D2000 D300");
    plc.scan();
    return plc.notes.calls.empty() ? std::string("no error")
                                   : plc.notes.calls[0].substr(plc.notes.calls[0].find("ECAMTBX"));
  };
  EXPECT_EQ(fault("DMOV K6560 D100\n"), "no error");
  EXPECT_EQ(fault("DMOV K6559 D100\n").substr(0, 60),
            "ECAMTBX -3: P1 (D100) is 6559, but a stroke takes 6560 maste");
  EXPECT_EQ(fault("MOV K0 D110\n").substr(0, 60),
            "ECAMTBX -3: P1 (D100) is 3000, but a stroke takes 5160 maste");
  const std::pair<const char*, const char*> faults[] = {
      {"",
       "-3: P1 (D100) is 3000, but a stroke takes 6560 master pulses (P2 (D102) is 12900, P3 (D104) is 9400, "
       "P4 (D106) is 2.5)"},
      {"DMOV K13000 D104\n",
       "-3: P3 (D104) is 13000: the synchronous zone is longer than the slave, P2 (D102) is 12900"},
      {"MOV K100 D50\n",
       "-3: P1 (D100) is 3000, but the synchronous zone alone takes 3760 master pulses (P2 (D102) is 12900, "
       "P3 (D104) is 9400, P4 (D106) is 2.5)"},
      {"MOV K100 D50\nDMOV K4760 D100\n",
       "-4: P5 (D108) is 2.5, but the cycle needs more: outside the synchronous zone the mean ratio is 3.5 "
       "(P1 (D100) is 4760, P2 (D102) is 12900, P3 (D104) is 9400, P4 (D106) is 2.5)"},
      {"DEMOV E1 D108\n", "-4: P5 (D108) is 1, less than P4 (D106) is 2.5"},
      {"DEMOV E0 D106\n", "-8: P4 (D106) is 0 and P5 (D108) is 2.5; write ratios above 0"},
      {"MOV K7 D50\n", "-1: the type is 7; write K0, K1, K100 or K101"},
      {"MOV K3 D110\n", "-1: P6 low (D110) is 3; write 0, 1 or 2 for the acceleration"},
      {"MOV K100 D50\nMOV K4 D111\n",
       "-1: P6 high (D111) is 4; write 0, 1, 2, 3 or 5 for the cam curve, plus H1000 backwards"},
      {"DMOV K0 D100\n", "-2: P1 (D100) is 0; write a master length above 0"},
      {"DMOV K0 D102\n", "-2: P2 (D102) is 0; write a slave length other than 0"},
      {"DMOV K-1 D104\n", "-2: P3 (D104) is -1; write 0 or more"},
      {"DMOV K1073741824 D100\n",
       "-2: P1 (D100) is 1073741824; both strokes go beyond 32 bits, write 1073741823 at most"},
      {"MOV K9 D112\n", "-5: P7 (D112) is 9; write 0 (automatic) or 10 to 512"}};
  for (const auto& [change, told] : faults)
    EXPECT_EQ(fault(change), std::string("ECAMTBX ") + told + "; the block D2000 is left as it was");
}

TEST(EcamtbxRegisters, ErrorsOfTheSCurveSayWhatIsWrong) {
  const auto fault = [](int offset, std::int32_t value, int at = block) {
    Registers d;
    ecams::put(d, 100, ecams::s_curve_demo());
    if (offset < 6)
      d.set_i32(100 + offset, value);
    else
      d.set_i16(100 + offset, static_cast<std::int16_t>(value));
    return run_ecamtbx(d, 100, 0, at, result).fault;
  };
  EXPECT_EQ(fault(4, 0), "");
  EXPECT_EQ(fault(0, 0), "P1 (D100) is 0; write a way other than 0");
  EXPECT_EQ(fault(2, 150'001), "P2 (D102) is 150001; write 1 to 150000 Hz");
  EXPECT_EQ(fault(6, -1), "P4 (D106) is -1; write 0 to 32767 ms");
  EXPECT_EQ(fault(7, -2), "P5 (D107) is -2; write 0 to 32767 ms");
  EXPECT_EQ(fault(8, 50), "P6 (D108) is 50; write 51 to 512");
  EXPECT_EQ(fault(4, 0, 7161), "the table of 200 rows from D7201 on ends at D8000, beyond D7999");
}

// The table of the words is what the registers are read by: each parameter at its place and in its type.
TEST(EcamtbxRegisters, TheListsDoNotOverlap) {
  for (const auto words : {saw_words(), s_curve_words()}) {
    int next = 0;
    for (const auto& word : words) {
      EXPECT_GE(word.offset, next) << word.number;
      EXPECT_EQ(word.words, word.type.ends_with("32") ? 2 : 1) << word.number;
      next = word.offset + word.words;
    }
    EXPECT_LE(next, ecamtbx_parameters);
  }
}

TEST(EcamtbxRegisters, ATableThatDoesNotFitTheRegisters) {
  Registers d;
  ecams::put(d, 100, ecams::s_curve_demo());
  run_ecamtbx(d, 100, 0, 7160, result);  // 7160 + 40 + 800 = D8000, just behind the last
  EXPECT_EQ(d.i32(result), 200);
  run_ecamtbx(d, 100, 0, 7161, result);
  EXPECT_EQ(d.i32(result), -7);
  EXPECT_EQ(d.i16(119), -7);
}

TEST(EcamtbxRegisters, TheSCurveReportsInItsList) {
  for (const int type : {0, 1}) {
    Registers d;
    ecams::put(d, 100, ecams::s_curve_demo());
    run_ecamtbx(d, 100, type, block, result);
    EXPECT_EQ(d.i32(result), 200);
    EXPECT_EQ(d.i32(110), 3000);   // P8
    EXPECT_EQ(d.i32(112), 10000);  // P9
    EXPECT_EQ(d.i32(114), 1000);   // P10
    EXPECT_EQ(d.i32(116), 50000);  // P11
    EXPECT_EQ(d.i16(119), 200);    // P13
    EXPECT_EQ(d.i32(block + 40 + 4 * 199), 3000);
  }
}

TEST(EcamtbxRegisters, TheTypeFromARegisterCountsByItsLowWord) {
  Registers d;
  run_ecamtbx(d, 100, 7, block, result);
  EXPECT_EQ(d.i32(result), -1);
  il::Plc plc(
      "LD M8000\nMOV K101 D50\nMOV K9 D51\nDMOV K1750 D100\nDMOV K2000 D102\nDMOV K667 D104\n"
      "DEMOV E9.424778 D106\nDEMOV E10 D108\nMOV K1 D110\nECAMTBX D100 D50 D2000 D300");
  plc.scan();
  EXPECT_EQ(plc.registers.i32(result), 200);
  EXPECT_EQ(plc.registers.i32(block + 40 + 4 * 199), 3500);
  EXPECT_EQ(plc.registers.i32(block + 42 + 4 * 199), 0);
}

TEST(EcamtbxRegisters, ReadsWhatTheListHolds) {
  Registers d;
  const SawParameters saw{-1, 123456, 7, 1.5F, 2.5F, 2, 0x1005, 100};
  ecams::put(d, 100, saw);
  EXPECT_EQ(read_saw_parameters(d, 100), saw);
  const SCurveParameters curve{-1, 123456, -7, 32767, 65535};
  ecams::put(d, 100, curve);
  EXPECT_EQ(read_s_curve_parameters(d, 100), curve);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
