#include <gtest/gtest.h>

#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

/// Calls the block and the kernel until the block is done or fails; the number of cycles.
template <typename Block>
int finish(Block& block, Bench& b) {
  execute(block, b.kernel);
  return b.finish(block);
}

TEST(PlcopenMoveRelative, MovesByTheDistanceWhereverTheAxisIs) {
  Bench b;
  auto by = b.make<McMoveRelative>(200'000);
  double expected = 0;
  // Over the turn's end, back below 0, and by several turns.
  for (const double distance : {3'000'000.0, 900'000.5, -4'100'000.0, 9'000'000.0, -0.25, 0.0}) {
    by.Distance = distance;
    finish(by, b);
    ASSERT_TRUE(by.Done) << distance;
    expected += distance;
    EXPECT_DOUBLE_EQ(b.at(b.s()), expected);
    EXPECT_EQ(b.s().state(), AxisState::standstill);
  }
  covers("MC_MoveRelative", {"Axis", "Execute", "Distance", "Done"});
}

TEST(PlcopenMoveRelative, KeepsItsSpeedAndSlopes) {
  Bench b;
  auto by = b.make<McMoveRelative>();
  by.Distance = 2'000'000;
  by.Velocity = 60'000;
  by.Acceleration = 400;
  by.Deceleration = 200;
  by.Jerk = 8'000;
  execute(by, b.kernel);
  Peaks peaks;
  for (int i = 0; i < 20'000 && !by.Done; ++i) {
    b.kernel.cycle();
    by.call(b.kernel);
    peaks.take(b.s().set());
  }
  ASSERT_TRUE(by.Done);
  EXPECT_NEAR(peaks.v, 60'000 * increments_per_speed, 1e-3);
  EXPECT_NEAR(peaks.a, 400 * increments_per_acceleration, 1e-3);
  EXPECT_NEAR(peaks.d, 200 * increments_per_acceleration, 1e-3);
  EXPECT_LE(peaks.j, 8'000 * increments_per_acceleration * (1 + 1e-6));
  EXPECT_GT(peaks.j, 7'900 * increments_per_acceleration);
  covers("MC_MoveRelative", {"Velocity", "Acceleration", "Deceleration", "Jerk"});
}

TEST(PlcopenMoveRelative, CountsFromTheCommandedPositionOfAMovingAxis) {
  Bench b;
  auto on = b.make<McMoveVelocity>(100'000);
  execute(on, b.kernel);
  b.cycles(500);
  const double from = b.at(b.s());
  EXPECT_GT(b.s().set().velocity, 0);
  auto by = b.make<McMoveRelative>(100'000);
  by.Distance = -500'000;
  finish(by, b);
  EXPECT_NEAR(b.at(b.s()), from - 500'000, 1e-6);
}

TEST(PlcopenMoveRelative, RefusesWhatIsOutOfRange) {
  AxisParameters linear = Bench::linear_axis(-1'000'000, 2'000'000);
  Bench b(linear);
  auto by = b.make<McMoveRelative>(100'000);
  const auto error_of = [&](double distance, double velocity) {
    by.Distance = distance;
    by.Velocity = velocity;
    execute(by, b.kernel);
    return by.ErrorID;
  };
  EXPECT_EQ(error_of(2'000'001, 1'000), id(ErrorId::position_range));
  EXPECT_EQ(error_of(-1'000'001, 1'000), id(ErrorId::position_range));
  EXPECT_EQ(error_of(std::nan(""), 1'000), id(ErrorId::position_range));
  EXPECT_EQ(error_of(1'000, 0), id(ErrorId::velocity_range));
  by.Jerk = -1;
  EXPECT_EQ(error_of(1'000, 1'000), id(ErrorId::jerk_range));
  by.Jerk = 0;
  by.Velocity = 100'000;
  by.Distance = 2'000'000;
  finish(by, b);
  EXPECT_TRUE(by.Done);
  EXPECT_DOUBLE_EQ(b.s().set().position.part, 2'000'000);
  by.Axis = {};
  EXPECT_EQ(error_of(1'000, 1'000), id(ErrorId::no_such_axis));
  covers({"MC_MoveRelative.Error", "MC_MoveRelative.ErrorID"});
}

TEST(PlcopenMoveRelative, WhatHasEndedIsNotAbortedByWhatComesLater) {
  Bench b;
  auto refused = b.make<McMoveRelative>();
  auto done = b.make<McMoveRelative>(100'000);
  done.Distance = 1'000;
  execute(refused, b.kernel);  // without a velocity
  finish(done, b);
  ASSERT_TRUE(done.Done);
  b.s().move({Command::move_velocity, 0, {.velocity = 1'000}, Direction::positive});
  b.kernel.cycle();
  refused.call(b.kernel);
  done.call(b.kernel);
  EXPECT_EQ(refused.ErrorID, id(ErrorId::velocity_range));
  EXPECT_TRUE(refused.Error);
  EXPECT_FALSE(refused.CommandAborted);
  EXPECT_TRUE(done.Done);
  EXPECT_FALSE(done.CommandAborted);
}

TEST(PlcopenSetPosition, GivesTheAxisAnotherValueWithoutMovingOrHomingIt) {
  AxisParameters parameters = axis_of(AxisKind::encoder);
  Bench b(parameters);
  b.s().drive.counts = 2'500;
  b.kernel.cycle();
  EXPECT_DOUBLE_EQ(b.s().actual().part, 900'000);
  auto set = b.make<McSetPosition>();
  set.Position = 100'000;
  execute(set, b.kernel);
  EXPECT_TRUE(set.Done);
  EXPECT_DOUBLE_EQ(b.s().actual().part, 100'000);
  EXPECT_FALSE(b.s().homed());
  b.s().drive.counts = 5'000;
  b.kernel.cycle();
  EXPECT_DOUBLE_EQ(b.s().actual().part, 1'000'000);
  set.Relative = true;
  set.Position = -1'500'000;
  execute(set, b.kernel);
  EXPECT_DOUBLE_EQ(b.s().actual().part, 3'100'000);
  b.kernel.cycle();
  EXPECT_DOUBLE_EQ(b.s().actual().part, 3'100'000);
  EXPECT_EQ(b.s().actual_velocity(), 0);
  set.Execute = false;
  set.call(b.kernel);
  EXPECT_FALSE(set.Done);
  covers("MC_SetPosition", {"Axis", "Execute", "Position", "Relative", "Done"});
}

TEST(PlcopenSetPosition, TheDriveDoesNotFeelIt) {
  AxisParameters parameters;
  parameters.homed_at_start = true;
  Bench b(parameters);
  b.kernel.cycle();
  auto set = b.make<McSetPosition>();
  set.Position = 1'234'567;
  execute(set, b.kernel);
  b.kernel.cycle();
  EXPECT_EQ(b.s().outputs().reference, 0);
  EXPECT_TRUE(b.s().outputs().enable);
  EXPECT_DOUBLE_EQ(b.s().set().position.part, 1'234'567);
}

TEST(PlcopenSetPosition, IsRefusedWhileASlaveFollowsAndOutOfRange) {
  Bench b;
  b.table(one_to_one());
  b.couple(hli_ci_f_periodic | hli_ci_endless_positive);
  McSetPosition set;
  set.Axis = b.master;
  execute(set, b.kernel);
  EXPECT_EQ(set.ErrorID, id(ErrorId::in_synchronized_motion));
  Bench free;
  set.Axis = free.slave;
  for (const double position : {3e9, std::nan("")}) {
    set.Position = position;
    execute(set, free.kernel);
    EXPECT_EQ(set.ErrorID, id(ErrorId::position_range));
  }
  set.Axis = {};
  execute(set, free.kernel);
  EXPECT_TRUE(set.Error);
  EXPECT_EQ(set.ErrorID, id(ErrorId::no_such_axis));
  covers({"MC_SetPosition.Error", "MC_SetPosition.ErrorID"});
}

TEST(PlcopenSetOverride, ScalesTheSpeedOfMovementsTogetherWithTheOperators) {
  Bench b;
  b.start_master();
  McSetOverride override;
  override.Axis = b.master;
  override.VelFactor = 0.5;
  override.Enable = true;
  const auto speed = [&] {
    for (int i = 0; i < 2'000; ++i) {
      override.call(b.kernel);
      b.kernel.cycle();
    }
    return b.m().set().velocity / increments_per_speed;
  };
  EXPECT_NEAR(speed(), 180'000, 1e-3);
  EXPECT_TRUE(override.Enabled);
  b.m().control.override_percent = 50;
  EXPECT_NEAR(speed(), 90'000, 1e-3);
  // The factor stays when the block lets go.
  override.Enable = false;
  override.VelFactor = 0.9;
  EXPECT_NEAR(speed(), 90'000, 1e-3);
  EXPECT_FALSE(override.Enabled);
  override.Enable = true;
  override.VelFactor = 0;
  EXPECT_EQ(speed(), 0);
  EXPECT_EQ(b.m().state(), AxisState::continuous_motion);
  covers("MC_SetOverride", {"Axis", "Enable", "VelFactor", "Enabled"});
}

TEST(PlcopenSetOverride, RefusesAFactorBeyondOne) {
  Bench b;
  auto override = b.make<McSetOverride>();
  override.Enable = true;
  for (const double factor : {1.001, -0.001, std::nan("")}) {
    override.VelFactor = factor;
    override.call(b.kernel);
    EXPECT_TRUE(override.Error);
    EXPECT_FALSE(override.Enabled);
    EXPECT_EQ(override.ErrorID, id(ErrorId::override_range)) << factor;
  }
  for (const double factor : {0.0, 1.0}) {
    override.VelFactor = factor;
    override.call(b.kernel);
    EXPECT_FALSE(override.Error) << factor;
    EXPECT_EQ(override.ErrorID, 0u);
  }
  override.Axis = {};
  override.call(b.kernel);
  EXPECT_EQ(override.ErrorID, id(ErrorId::no_such_axis));
  override.Enable = false;
  override.call(b.kernel);
  EXPECT_FALSE(override.Error);
  covers({"65017", "MC_SetOverride.Error", "MC_SetOverride.ErrorID"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
