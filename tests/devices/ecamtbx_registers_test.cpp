// ECAMTBX as a program calls it: from a list in D registers to a cam's block.
#include "devices/lx3vp/ecamtbx_registers.hpp"

#include "tests/devices/ecamtbx_bench.hpp"
#include "tests/devices/il_bench.hpp"
#include "tests/devices/lx3vp_bench.hpp"

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
  plc.registers.m[8000] = true;
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
  plc.registers.m[8000] = true;
  plc.scan();
  EXPECT_EQ(plc.registers.u32(block + 9), 2983U);
  EXPECT_EQ(plc.registers.u32(block + 11), 3183U);
}

TEST(EcamtbxRegisters, MidCamEndStopsAtTheEndOfTheCycle) {
  for (const int curve : {0, 1, 2, 3, 5, 0x1003, 0x1001}) {
    Registers d;
    d.set_i32(100, 2000);
    d.set_i32(102, 1000);
    d.set_i32(104, 400);
    d.set_f32(106, 1);
    d.set_f32(108, 3);
    d.set_i16(110, 1);
    d.set_i16(111, static_cast<std::int16_t>(curve));
    d.d[block + 4] = 0x8000;
    run_ecamtbx(d, 100, 100, block, result);
    ASSERT_EQ(d.i32(result), 200) << curve;
    EXPECT_EQ(d.d[block + 4], (curve & 0xFFF) == 3 ? 0x8002 : 0x8000) << curve;
    // What the program has switched on stays on.
    d.d[block + 4] = 2;
    run_ecamtbx(d, 100, 100, block, result);
    EXPECT_EQ(d.d[block + 4], 2) << curve;
  }
}

// The cyclic cam of a table by midCAMend runs one cycle, to the pulse, and starts anew after word 5 was 0.
TEST(EcamtbxRegisters, ACyclicCamByMidCamEndRunsOneCycle) {
  CamBench bench;
  auto& d = bench.registers;
  d.set_i32(300, 1000);
  d.set_i32(302, 1500);
  d.set_i32(304, 300);
  d.set_f32(306, 2);
  d.set_f32(308, 8);
  d.set_i16(310, 1);
  d.set_i16(311, mid_cam_end);
  run_ecamtbx(d, 300, 100, CamBench::block, 330);
  ASSERT_GT(d.i32(330), 0);
  bench.start(1);
  for (int i = 0; i < 300; ++i) bench.travel(10);
  EXPECT_EQ(d.i32(8140), 1500);
  EXPECT_TRUE(bench.flag(status::completed));
  EXPECT_FALSE(bench.flag(status::cyclic));
  bench.set(word::start, 0);
  bench.tick(3);
  bench.set(word::start, 1);
  bench.tick(3);
  for (int i = 0; i < 300; ++i) bench.travel(10);
  EXPECT_EQ(d.i32(8140), 3000);
}

TEST(EcamtbxRegisters, AnErrorLeavesTheBlockAsItIs) {
  il::Plc plc(rotary_program("DEMOV E1 D108\n"));  // P5 below P4
  plc.registers.m[8000] = true;
  plc.registers.d[block + 38] = 77;
  plc.scan();
  EXPECT_EQ(plc.registers.i32(result), -4);
  EXPECT_EQ(plc.registers.i16(result), -4);  // the low word alone tells it too
  EXPECT_EQ(plc.registers.i16(block + 38), 77);
  EXPECT_EQ(plc.registers.i16(block + 39), 0);
}

TEST(EcamtbxRegisters, ATableThatDoesNotFitTheRegisters) {
  Registers d;
  const auto p = ecams::s_curve_demo();
  d.set_i32(100, p.length);
  d.set_i32(102, p.top_speed);
  d.set_i16(106, p.acceleration);
  d.set_i16(107, p.deceleration);
  d.set_i16(108, 200);
  run_ecamtbx(d, 100, 0, 7160, result);  // 7160 + 40 + 800 = D8000, just behind the last
  EXPECT_EQ(d.i32(result), 200);
  run_ecamtbx(d, 100, 0, 7161, result);
  EXPECT_EQ(d.i32(result), -7);
  EXPECT_EQ(d.i16(119), -7);
}

TEST(EcamtbxRegisters, TheSCurveReportsInItsList) {
  for (const int type : {0, 1}) {
    Registers d;
    d.set_i32(100, 10000);
    d.set_i32(102, 50000);
    d.set_i16(106, 100);
    d.set_i16(107, 100);
    d.set_i16(108, 200);
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
  plc.registers.m[8000] = true;
  plc.scan();
  EXPECT_EQ(plc.registers.i32(result), 200);
  EXPECT_EQ(plc.registers.i32(block + 40 + 4 * 199), 3500);
  EXPECT_EQ(plc.registers.i32(block + 42 + 4 * 199), 0);
}

TEST(EcamtbxRegisters, ReadsWhatTheListHolds) {
  Registers d;
  d.set_i32(100, -1);
  d.set_i32(102, 123456);
  d.set_i32(104, 7);
  d.set_f32(106, 1.5F);
  d.set_f32(108, 2.5F);
  d.set_i16(110, 2);
  d.set_i16(111, 0x1005);
  d.set_i16(112, 100);
  const auto p = read_saw_parameters(d, 100);
  EXPECT_EQ(p.master_length, -1);
  EXPECT_EQ(p.slave_length, 123456);
  EXPECT_EQ(p.sync_length, 7);
  EXPECT_EQ(p.sync_ratio, 1.5F);
  EXPECT_EQ(p.max_ratio, 2.5F);
  EXPECT_EQ(p.acceleration, 2);
  EXPECT_EQ(p.curve, 0x1005);
  EXPECT_EQ(p.resolution, 100);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
