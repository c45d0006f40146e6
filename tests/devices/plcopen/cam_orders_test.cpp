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
    b.couple(turning);
    ASSERT_GE(b.until([&] { return b.cam.InSync; }), 0);
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
    b.couple(turning);
    ASSERT_GE(b.until([&] { return b.cam.InSync; }), 0);
    b.s().control.feed_enable = false;
    b.step(3);
    EXPECT_EQ(b.s().state(), keep != 0 ? AxisState::synchronized_motion : AxisState::errorstop);
    EXPECT_EQ(b.cam.ErrorID, keep != 0 ? 0 : id(ErrorId::feed_enable_dropped));
    EXPECT_EQ(b.cam.InSync, keep != 0);
  }
  covers({"65006", "cam_gear.keep_coupling_on_fe_drop"});
}

TEST(PlcopenCamOrders, CamOutKeepsTheSpeed) {
  Bench b;
  b.table(one_to_one());
  b.start_master();
  b.couple(turning);
  ASSERT_GE(b.until([&] { return b.cam.InSync; }), 0);
  McCamOut out;
  out.Slave = b.slave;
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
  Bench b;
  b.table(one_to_one());
  b.start_master();
  b.couple(turning);
  McPhasing phasing;
  phasing.Master = b.master;
  phasing.Slave = b.slave;
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
  double v = 0;
  double a = 0;
  double d = 0;
  double j = 0;
  double last = 0;
  int cycles = 0;
  while (!phasing.Done) {
    phasing.call(b.kernel);
    b.step();
    const double now = b.s().set().acceleration;
    v = std::max(v, b.s().set().velocity - b.m().set().velocity);
    a = std::max(a, now);
    d = std::max(d, -now);
    j = std::max(j, std::abs(now - last) / cycle_s);
    last = now;
    ASSERT_LT(++cycles, 2'000);
  }
  EXPECT_NEAR(shortest(b.s().set().position, b.m().set().position, turn), 250'000, 1e-5);
  EXPECT_NEAR(v, 50'000 * increments_per_speed, 1);
  EXPECT_NEAR(a, 1'000 * increments_per_acceleration, 100);
  EXPECT_NEAR(d, 500 * increments_per_acceleration, 100);
  EXPECT_NEAR(j, 20'000 * increments_per_acceleration, 1e5);
  EXPECT_TRUE(b.cam.InSync);
  // A newer shift takes over from an older one; shifts add up.
  phasing.Execute = false;
  phasing.call(b.kernel);
  phasing.Execute = true;
  phasing.call(b.kernel);
  b.step();
  McPhasing second = phasing;
  second.PhaseShift = -250'000;
  second.Execute = false;
  second.call(b.kernel);
  second.Execute = true;
  second.call(b.kernel);
  phasing.call(b.kernel);
  EXPECT_TRUE(phasing.CommandAborted);
  while (!second.Done) {
    second.call(b.kernel);
    b.step();
    ASSERT_LT(++cycles, 4'000);
  }
  covers({"60175", "MC_Phasing.Master", "MC_Phasing.Slave", "MC_Phasing.PhaseShift", "MC_Phasing.Velocity",
          "MC_Phasing.Acceleration", "MC_Phasing.Deceleration", "MC_Phasing.Jerk", "MC_Phasing.Done",
          "MC_Phasing.CommandAborted"});
}

TEST(PlcopenCamOrders, WhatIsWrongWithAnOrderIsToldByItsNumber) {
  AxisParameters linear = Bench::virtual_axis();
  linear.modulo = 0;
  const auto error = [](Bench& b, std::uint32_t mode = hli_ci_f_periodic) {
    b.couple(mode);
    EXPECT_EQ(b.cam.Error, b.cam.ErrorID != 0);
    EXPECT_FALSE(b.cam.InSync);
    return static_cast<ErrorId>(b.cam.ErrorID);
  };
  const auto bench = [](Bench& b) -> Bench& {
    b.table(one_to_one());
    return b;
  };
  {
    Bench b;
    EXPECT_EQ(error(bench(b)), ErrorId::none);
    b.cam.CamTableID = 78;
    EXPECT_EQ(error(b), ErrorId::no_such_table);
  }
  {
    Bench b;
    bench(b);
    b.cam.TableFctType = 7;
    EXPECT_EQ(error(b), ErrorId::unknown_interpolation);
  }
  {
    Bench b;
    b.table({1}, 3, Interpolation::table_defined);
    EXPECT_EQ(error(b), ErrorId::unknown_interpolation);
    b.cam.TableFctType = 1;
    EXPECT_EQ(error(b), ErrorId::none);
  }
  {
    Bench b;
    bench(b);
    b.cam.TableFctType = 3;
    EXPECT_EQ(error(b), ErrorId::table_type_mismatch);
  }
  {
    Bench b;
    b.table({}, 3);
    EXPECT_EQ(error(b), ErrorId::too_few_lines);
  }
  {
    Bench b;
    b.table({0, 0, 999, 0}, 7, Interpolation::poly5_line);
    EXPECT_EQ(error(b), ErrorId::table_master_order);
  }
  {
    Bench b;
    b.table({0, 0, 9999, 0, 99'999, 0}, 7, Interpolation::poly5_line);
    EXPECT_EQ(error(b), ErrorId::table_line_count);
  }
  {
    Bench b;
    bench(b);
    EXPECT_EQ(b.kernel.begin_table_change(1), ErrorId::none);
    EXPECT_EQ(error(b), ErrorId::table_busy);
    b.kernel.end_table_change(1);
    EXPECT_EQ(error(b), ErrorId::none);
  }
  {
    AxisParameters p = Bench::virtual_axis();
    p.kind = 0;
    p.homed_at_start = 0;
    Bench b(p);
    EXPECT_EQ(error(bench(b)), ErrorId::not_homed);
    p.homed_at_start = 1;
    Bench c(p);
    EXPECT_EQ(error(bench(c)), ErrorId::none);
  }
  {
    Bench b;
    b.s().control.feed_enable = false;
    EXPECT_EQ(error(bench(b)), ErrorId::feed_enable_missing);
  }
  {
    Bench b(linear);
    EXPECT_EQ(error(bench(b), hli_ci_f_periodic | hli_ci_endless_positive), ErrorId::not_modulo);
    EXPECT_EQ(error(b), ErrorId::none);
  }
  {
    Bench b(linear);
    b.table(swing(), 7, Interpolation::poly5_line);
    EXPECT_EQ(error(b), ErrorId::not_modulo);
  }
  {
    Bench b;
    EXPECT_EQ(error(bench(b), 0x80), ErrorId::start_mode);
    EXPECT_EQ(error(b, 0x60), ErrorId::start_mode);
  }
  {
    Bench b;
    b.cam.MasterScaling = 0;
    EXPECT_EQ(error(bench(b)), ErrorId::master_scaling);
    b.cam.MasterScaling = 1.5;
    EXPECT_EQ(error(b), ErrorId::master_scaling);
  }
  {
    Bench b;
    b.cam.SlaveScaling = 0.5;
    EXPECT_EQ(error(bench(b)), ErrorId::none);
    EXPECT_EQ(error(b, hli_ci_f_periodic | hli_ci_endless_positive), ErrorId::slave_scaling);
  }
  {
    Bench b;
    b.cam.MasterOffset = 3e9;
    EXPECT_EQ(error(bench(b)), ErrorId::offset_range);
    b.cam.MasterOffset = 0;
    b.cam.SlaveOffset = std::nan("");
    EXPECT_EQ(error(b), ErrorId::offset_range);
  }
  {
    Bench b;
    EXPECT_TRUE(b.m().set_parameter(*find_axis_parameter("cam_gear.is_master"), 0));
    EXPECT_EQ(error(bench(b)), ErrorId::not_a_master);
  }
  {
    Bench b;
    b.cam.Master = {};
    EXPECT_EQ(error(bench(b)), ErrorId::no_such_axis);
    b.cam.Master = {9};
    EXPECT_EQ(error(b), ErrorId::no_such_axis);
  }
  {
    Bench b;
    b.cam.Master = b.slave;
    EXPECT_EQ(error(bench(b)), ErrorId::own_master);
    b.cam.Master = b.master;
    EXPECT_EQ(error(b), ErrorId::none);
    std::swap(b.cam.Master, b.cam.Slave);
    EXPECT_EQ(error(b), ErrorId::own_master);
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
