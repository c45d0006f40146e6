#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

TEST(PlcopenCamOrders, EmergencyStopReleasesTheCouplingUnlessItIsKept) {
  for (const double keep : {0.0, 1.0}) {
    Bench b;
    b.table(one_to_one());
    b.set("cam_gear.keep_coupling_on_lr_error", keep);
    b.set("getriebe[0].lslope_profil.a_grenz_stufe_1", 4'000);
    b.start_master();
    b.engage(turning);
    b.s().drive.emergency_stop = true;
    const double speed = b.s().set().velocity;
    b.step();
    if (keep != 0) {
      EXPECT_EQ(b.s().state(), AxisState::synchronized_motion);
      EXPECT_DOUBLE_EQ(b.s().set().velocity, speed);
      continue;
    }
    EXPECT_EQ(b.s().state(), AxisState::errorstop);
    // A constant deceleration, without jerk limit.
    EXPECT_NEAR(b.s().set().velocity, speed - 4'000 * increments_per_acceleration * cycle_s, 1e-3);
    b.step();
    EXPECT_EQ(b.cam.ErrorID, id(ErrorId::emergency_stop));
  }
  covers({"65015", "cam_gear.keep_coupling_on_lr_error", "getriebe[0].lslope_profil.a_grenz_stufe_1"});
}

TEST(PlcopenCamOrders, AFeedEnableDropStopsACoupledSlaveUnlessTheCouplingIsKept) {
  for (const double keep : {0.0, 1.0}) {
    Bench b;
    b.table(one_to_one());
    b.set("cam_gear.keep_coupling_on_fe_drop", keep);
    b.start_master();
    b.engage(turning);
    b.s().control.feed_enable = false;
    b.step(3);
    EXPECT_EQ(b.s().state(), keep != 0 ? AxisState::synchronized_motion : AxisState::errorstop);
    EXPECT_EQ(b.cam.ErrorID, keep != 0 ? 0 : id(ErrorId::feed_enable_dropped));
    EXPECT_EQ(b.cam.InSync, keep != 0);
  }
  covers({"65006", "cam_gear.keep_coupling_on_fe_drop"});
}

TEST(PlcopenCamOrders, CamOutKeepsTheSpeed) {
  Turning b;
  b.engage(turning);
  auto out = b.make<McCamOut>();
  out.Execute = true;
  const double speed = b.s().set().velocity;
  for (int i = 0; i < 5; ++i) {
    out.call(b.kernel);
    b.step();
  }
  EXPECT_TRUE(out.Done);
  EXPECT_TRUE(b.cam.CommandAborted);
  EXPECT_FALSE(b.cam.InSync);
  EXPECT_EQ(b.s().state(), AxisState::continuous_motion);
  EXPECT_DOUBLE_EQ(b.s().set().velocity, speed);
  covers({"MC_CamOut.Slave", "MC_CamOut.Done", "MC_CamIn.CommandAborted"});
}

TEST(PlcopenCamOrders, PhasingShiftsTheApparentMasterJerkLimited) {
  Turning b;
  b.couple(turning);
  auto phasing = b.make<McPhasing>();
  phasing.PhaseShift = 250'000;
  phasing.Velocity = 50'000;
  phasing.Acceleration = 1'000;
  phasing.Deceleration = 500;
  phasing.Jerk = 20'000;
  phasing.Execute = true;
  phasing.call(b.kernel);
  EXPECT_EQ(phasing.ErrorID, id(ErrorId::phasing_slave_not_reached));
  ASSERT_GE(b.until([&] { return b.cam.InSync; }), 0);
  phasing.Execute = false;
  phasing.call(b.kernel);
  phasing.Execute = true;
  Peaks peaks;
  int cycles = 0;
  while (!phasing.Done) {
    phasing.call(b.kernel);
    b.step();
    peaks.take({{}, b.s().set().velocity - b.m().set().velocity, b.s().set().acceleration});
    ASSERT_LT(++cycles, 2'000);
  }
  EXPECT_NEAR(shortest(b.s().set().position, b.m().set().position, turn), 250'000, 1e-5);
  EXPECT_NEAR(peaks.v, 50'000 * increments_per_speed, 1);
  EXPECT_NEAR(peaks.a, 1'000 * increments_per_acceleration, 100);
  EXPECT_NEAR(peaks.d, 500 * increments_per_acceleration, 100);
  EXPECT_NEAR(peaks.j, 20'000 * increments_per_acceleration, 1e5);
  EXPECT_TRUE(b.cam.InSync);
  // A newer shift takes over from an older one; shifts add up.
  execute(phasing, b.kernel);
  b.step();
  McPhasing second = phasing;
  second.PhaseShift = -250'000;
  execute(second, b.kernel);
  phasing.call(b.kernel);
  EXPECT_TRUE(phasing.CommandAborted);
  while (!second.Done) {
    second.call(b.kernel);
    b.step();
    ASSERT_LT(++cycles, 4'000);
  }
  covers("MC_Phasing", {"Master", "Slave", "PhaseShift", "Velocity", "Acceleration", "Deceleration", "Jerk",
                        "Done", "CommandAborted"});
  covers({"60175"});
}

TEST(PlcopenCamOrders, WhatIsWrongWithAnOrderIsToldByItsNumber) {
  const AxisParameters usual = Bench::virtual_axis();
  AxisParameters linear = usual;
  linear.modulo = 0;
  AxisParameters homed = usual;
  homed.kind = AxisKind::drive;
  AxisParameters unhomed = homed;
  unhomed.homed_at_start = false;
  // What is changed on the bench before each order, and what the order says then.
  struct Step {
    std::function<void(Bench&)> change;
    ErrorId error = ErrorId::none;
    std::uint32_t mode = hli_ci_f_periodic;
  };
  struct Row {
    AxisParameters slave;
    std::vector<Step> steps;
  };
  const auto nothing = [](Bench&) {};
  const auto pairs = [](const std::vector<double>& values) {
    return [values](Bench& b) { b.table(values, 7, Interpolation::poly5_line); };
  };
  const std::vector<Row> rows{
      {usual, {{nothing}, {[](Bench& b) { b.cam.CamTableID = 78; }, ErrorId::no_such_table}}},
      {usual, {{[](Bench& b) { b.cam.TableFctType = 7; }, ErrorId::unknown_interpolation}}},
      {usual,
       {{[](Bench& b) { b.table({1}, 3, Interpolation::table_defined); }, ErrorId::unknown_interpolation},
        {[](Bench& b) { b.cam.TableFctType = 1; }}}},
      {usual, {{[](Bench& b) { b.cam.TableFctType = 3; }, ErrorId::table_type_mismatch}}},
      {usual, {{[](Bench& b) { b.table({}, 3); }, ErrorId::too_few_lines}}},
      {usual, {{pairs({0, 0, 999, 0}), ErrorId::table_master_order}}},
      {usual, {{pairs({0, 0, 9999, 0, 99'999, 0}), ErrorId::table_line_count}}},
      {usual,
       {{[](Bench& b) { EXPECT_EQ(b.kernel.begin_table_change(1), ErrorId::none); }, ErrorId::table_busy},
        {[](Bench& b) { b.kernel.end_table_change(1); }}}},
      {unhomed, {{nothing, ErrorId::not_homed}}},
      {homed, {{nothing}}},
      {usual, {{[](Bench& b) { b.s().control.feed_enable = false; }, ErrorId::feed_enable_missing}}},
      {linear, {{nothing, ErrorId::not_modulo, turning}, {nothing}}},
      {linear, {{pairs(swing()), ErrorId::not_modulo}}},
      {usual, {{nothing, ErrorId::start_mode, 0x80}, {nothing, ErrorId::start_mode, 0x60}}},
      {usual,
       {{[](Bench& b) { b.cam.MasterScaling = 0; }, ErrorId::master_scaling},
        {[](Bench& b) { b.cam.MasterScaling = 1.5; }, ErrorId::master_scaling}}},
      {usual, {{[](Bench& b) { b.cam.SlaveScaling = 0.5; }}, {nothing, ErrorId::slave_scaling, turning}}},
      {usual, {{[](Bench& b) { b.cam.MasterOffset = 3e9; }, ErrorId::offset_range}}},
      {usual, {{[](Bench& b) { b.cam.SlaveOffset = std::nan(""); }, ErrorId::offset_range}}},
      {usual,
       {{[](Bench& b) { EXPECT_TRUE(b.m().set_parameter(*find_axis_parameter("cam_gear.is_master"), 0)); },
         ErrorId::not_a_master}}},
      {usual,
       {{[](Bench& b) { b.cam.Master = {}; }, ErrorId::no_such_axis},
        {[](Bench& b) { b.cam.Master = {9}; }, ErrorId::no_such_axis}}},
      {usual,
       {{[](Bench& b) { b.cam.Master = b.slave; }, ErrorId::own_master},
        {[](Bench& b) { b.cam.Master = b.master; }},
        {[](Bench& b) { std::swap(b.cam.Master, b.cam.Slave); }, ErrorId::own_master}}}};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Bench b(rows[row].slave);
    b.table(one_to_one());
    for (const Step& step : rows[row].steps) {
      SCOPED_TRACE(row);
      step.change(b);
      b.couple(step.mode);
      EXPECT_EQ(static_cast<ErrorId>(b.cam.ErrorID), step.error);
      EXPECT_EQ(b.cam.Error, b.cam.ErrorID != 0);
      EXPECT_FALSE(b.cam.InSync);
    }
  }
  covers({"42003",         "42006",          "42007",
          "60172",         "60260",          "60261",
          "60266",         "60251",          "60252",
          "60181",         "65001",          "65002",
          "65003",         "65010",          "65011",
          "65013",         "65016",          "MC_CamIn.TableFctType",
          "TABLE_DEFINED", "homed_at_start", "cam_gear.is_master"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
