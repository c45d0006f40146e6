#include <gtest/gtest.h>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

TEST(PlcopenReading, PositionAndSpeedAreThoseOfTheEncoder) {
  AxisParameters parameters = axis_of(AxisKind::encoder);
  Bench b(parameters);
  auto position = b.make<McReadActualPosition>();
  auto velocity = b.make<McReadActualVelocity>();
  position.Enable = velocity.Enable = true;
  for (const std::int64_t counts : {0, 10, 20, -30}) {
    b.s().drive.counts = counts;
    b.kernel.cycle();
    position.call(b.kernel);
    velocity.call(b.kernel);
    EXPECT_TRUE(position.Valid);
    EXPECT_TRUE(velocity.Valid);
    EXPECT_DOUBLE_EQ(position.Position, (counts < 0 ? turn : 0.0) + 360.0 * static_cast<double>(counts));
  }
  // 50 counts back in 2 ms, 0.036 deg each.
  EXPECT_NEAR(velocity.Velocity, -50 * 360 / cycle_s / increments_per_speed, 1e-6);
  covers("MC_ReadActualPosition", {"Axis", "Enable", "Valid", "Position"});
  covers("MC_ReadActualVelocity", {"Axis", "Enable", "Valid", "Velocity"});
}

TEST(PlcopenReading, StatusShowsTheOneStateThatTheAxisHas) {
  Bench b;
  b.table({0, 100'000});
  auto status = b.make<McReadStatus>();
  status.Enable = true;
  const auto shows = [&](AxisState state, bool McReadStatus::*output) {
    status.call(b.kernel);
    ASSERT_EQ(b.s().state(), state);
    EXPECT_TRUE(status.Valid);
    EXPECT_TRUE(status.*output) << name_of(state);
    int shown = 0;
    for (bool McReadStatus::*each :
         {&McReadStatus::Errorstop, &McReadStatus::Disabled, &McReadStatus::Stopping, &McReadStatus::Homing,
          &McReadStatus::Standstill, &McReadStatus::DiscreteMotion, &McReadStatus::ContinuousMotion,
          &McReadStatus::SynchronizedMotion})
      shown += status.*each ? 1 : 0;
    EXPECT_EQ(shown, 1) << name_of(state);
  };
  shows(AxisState::standstill, &McReadStatus::Standstill);
  b.s().home(0);
  shows(AxisState::homing, &McReadStatus::Homing);
  b.kernel.cycle();
  b.s().move({Command::move_absolute, 100'000, {.velocity = 1'000}});
  shows(AxisState::discrete_motion, &McReadStatus::DiscreteMotion);
  b.s().move({Command::move_velocity, 0, {.velocity = 1'000}, Direction::positive});
  shows(AxisState::continuous_motion, &McReadStatus::ContinuousMotion);
  b.couple();
  shows(AxisState::synchronized_motion, &McReadStatus::SynchronizedMotion);
  b.s().stop({});
  shows(AxisState::stopping, &McReadStatus::Stopping);
  b.s().fault(ErrorId::drive_error);
  shows(AxisState::errorstop, &McReadStatus::Errorstop);
  Bench off;
  off.s().power(false);
  status.call(off.kernel);
  EXPECT_TRUE(status.Disabled);
  EXPECT_FALSE(status.Errorstop);
  covers("MC_ReadStatus", {"Axis", "Enable", "Valid", "Errorstop", "Disabled", "Stopping", "Homing",
                           "Standstill", "DiscreteMotion", "ContinuousMotion", "SynchronizedMotion"});
}

TEST(PlcopenReading, AxisErrorIsTheAxisOwnUntilItIsReset) {
  Bench b;
  auto error = b.make<McReadAxisError>();
  error.Enable = true;
  error.call(b.kernel);
  EXPECT_TRUE(error.Valid);
  EXPECT_EQ(error.AxisErrorID, 0u);
  b.s().fault(ErrorId::following_error);
  error.call(b.kernel);
  EXPECT_EQ(error.AxisErrorID, 65008u);
  // It has read well: the error is not the block's.
  EXPECT_FALSE(error.Error);
  b.s().reset();
  b.kernel.cycle();
  error.call(b.kernel);
  EXPECT_EQ(error.AxisErrorID, 0u);
  covers("MC_ReadAxisError", {"Axis", "Enable", "Valid", "AxisErrorID"});
}

TEST(PlcopenReading, NothingIsValidWithoutAnAxisOrEnable) {
  Bench b;
  b.start_master();
  const auto check = [&](auto block, auto value) {
    block.Axis = b.master;
    block.Enable = true;
    block.call(b.kernel);
    EXPECT_TRUE(block.Valid);
    EXPECT_NE(value(block), 0);
    block.Enable = false;
    block.call(b.kernel);
    EXPECT_FALSE(block.Valid);
    EXPECT_FALSE(block.Error);
    EXPECT_EQ(value(block), 0);
    block.Enable = true;
    block.Axis = {};
    block.call(b.kernel);
    EXPECT_FALSE(block.Valid);
    EXPECT_TRUE(block.Error);
    EXPECT_EQ(block.ErrorID, 65011u);
    EXPECT_EQ(value(block), 0);
  };
  check(McReadActualPosition{}, [](auto& block) { return block.Position; });
  check(McReadActualVelocity{}, [](auto& block) { return block.Velocity; });
  check(McReadStatus{}, [](auto& block) { return block.ContinuousMotion ? 1.0 : 0.0; });
  b.m().fault(ErrorId::drive_error);
  check(McReadAxisError{}, [](auto& block) { return static_cast<double>(block.AxisErrorID); });
  for (const char* name :
       {"MC_ReadActualPosition", "MC_ReadActualVelocity", "MC_ReadStatus", "MC_ReadAxisError"})
    covers({std::string(name) + ".Error", std::string(name) + ".ErrorID"});
}

TEST(PlcopenTableWrite, WritesOneElementThatTheRunningCamTakesUp) {
  Bench b;
  b.table({0, 100'000, 200'000, 100'000});
  b.engage();
  CamTableWrite write;
  write.CamTableID = 1;
  write.Value = 300;
  execute(write, b.kernel);
  EXPECT_TRUE(write.Done);
  EXPECT_EQ(b.kernel.tables().find(1)->values.front(), 300);
  b.step();
  EXPECT_DOUBLE_EQ(b.s().set().position.part, 300);
  // One write for each edge.
  write.Value = 500;
  write.call(b.kernel);
  EXPECT_EQ(b.kernel.tables().find(1)->values.front(), 300);
  b.table({0, 1, 2, 3, 4, 5, 6, 7}, 5, Interpolation::polynom_3_koeff, 2);
  write.CamTableID = 2;
  write.Line = 2;
  write.Column = 3;
  execute(write, b.kernel);
  EXPECT_EQ(b.kernel.tables().find(2)->value(1, 2), 500);
  covers("CAM_TABLE_WRITE", {"CamTableID", "Execute", "Line", "Column", "Value", "Done"});
}

TEST(PlcopenTableWrite, AChangeKeepsTheTableFromMcCamInUntilItsEnd) {
  Bench b;
  b.table({0, 100'000});
  CamTableWrite write;
  write.CamTableID = 1;
  write.Change = true;
  write.call(b.kernel);
  EXPECT_TRUE(write.Changing);
  b.couple();
  EXPECT_EQ(b.cam.ErrorID, id(ErrorId::table_busy));
  // It ends for the table for which it began.
  write.CamTableID = 7;
  write.Change = false;
  write.call(b.kernel);
  EXPECT_FALSE(write.Changing);
  EXPECT_FALSE(write.Error);
  b.couple();
  EXPECT_FALSE(b.cam.Error);
  covers({"CAM_TABLE_WRITE.Change", "CAM_TABLE_WRITE.Changing", "60266"});
}

TEST(PlcopenTableWrite, RefusesWhatIsNotThereAndALockedTable) {
  Bench b;
  b.table({0, 100'000}, 2);
  CamTableWrite write;
  const auto error_of = [&](std::uint16_t table, unsigned line, std::uint16_t column, double value) {
    write.CamTableID = table;
    write.Line = line;
    write.Column = column;
    write.Value = value;
    execute(write, b.kernel);
    EXPECT_TRUE(write.Error);
    EXPECT_FALSE(write.Done);
    return write.ErrorID;
  };
  EXPECT_EQ(error_of(9, 1, 1, 0), id(ErrorId::no_such_table));
  EXPECT_EQ(error_of(1, 3, 1, 0), id(ErrorId::too_few_lines));
  EXPECT_EQ(error_of(1, 0, 1, 0), id(ErrorId::too_few_lines));
  EXPECT_EQ(error_of(1, 1, 2, 0), id(ErrorId::too_few_columns));
  EXPECT_EQ(error_of(1, 1, 0, 0), id(ErrorId::too_few_columns));
  EXPECT_EQ(error_of(1, 1, 1, 0.5), id(ErrorId::position_range));
  b.couple(hli_ci_f_periodic | hli_ci_lock_table);
  EXPECT_EQ(error_of(1, 1, 1, 1), id(ErrorId::table_locked));
  write.Execute = false;
  write.call(b.kernel);
  EXPECT_FALSE(write.Error);
  // A change that cannot begin is told as long as it is wanted.
  write.Change = true;
  for (int i = 0; i < 2; ++i) {
    write.call(b.kernel);
    EXPECT_EQ(write.ErrorID, id(ErrorId::table_locked));
    EXPECT_FALSE(write.Changing);
  }
  write.Change = false;
  write.call(b.kernel);
  EXPECT_FALSE(write.Error);
  covers({"CAM_TABLE_WRITE.Error", "CAM_TABLE_WRITE.ErrorID"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
