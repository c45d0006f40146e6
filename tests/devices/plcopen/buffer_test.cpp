// BufferMode: commands that wait for their turn (PLCopen part 1, "Aborting versus Buffered modes").
#include <gmock/gmock.h>

#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

std::int16_t number(BufferMode mode) { return static_cast<std::int16_t>(mode); }

/// A slave with a movement to 1 000 000 under way and one behind it.
struct Queue : Bench {
  McMoveAbsolute first;
  McMoveAbsolute second;
  Peaks peaks;

  explicit Queue(BufferMode mode, double v1 = 100'000, double v2 = 150'000, double target = 3'000'000) {
    AxisParameters linear = Bench::linear_axis();
    slave = kernel.add_axis("Linear", linear);
    power_slave = {};
    power_slave.Axis = slave;
    power_slave.Enable = true;
    power_slave.call(kernel);
    first.Axis = second.Axis = slave;
    first.Position = 1'000'000;
    first.Velocity = v1;
    second.Position = target;
    second.Velocity = v2;
    second.BufferMode = number(mode);
  }
  void cycle() {
    cycles(1, first, second);
    peaks.take(s().set());
  }
  /// Both given at once, then cycles until the second one has control.
  void to_changeover() {
    execute(first, kernel);
    execute(second, kernel);
    for (int i = 0; i < 20'000 && !second.Active; ++i) cycle();
    ASSERT_TRUE(second.Active);
  }
  void to_end() {
    for (int i = 0; i < 20'000 && !second.Done; ++i) cycle();
    ASSERT_TRUE(second.Done);
    EXPECT_DOUBLE_EQ(s().set().position.part, second.Position);
    EXPECT_EQ(s().state(), AxisState::standstill);
    // Both movements have the axis' own slopes, half of a_max, and no more jerk than goes with them.
    const double half = s().parameters().a_max / 2 * increments_per_acceleration;
    EXPECT_LE(std::max(peaks.a, peaks.d), half * (1 + 1e-9));
    EXPECT_LE(peaks.j, half / (s().parameters().tr_min * 1e-6) * (1 + 1e-6));
  }
};

TEST(PlcopenBuffer, TheSecondStartsInTheCycleInWhichTheFirstIsDone) {
  Queue b(BufferMode::buffered, 200'000, 200'000, 600'000);
  execute(b.first, b.kernel);
  execute(b.second, b.kernel);
  while (!b.first.Done) {
    EXPECT_TRUE(b.first.Busy && b.first.Active);
    EXPECT_TRUE(b.second.Busy);
    EXPECT_FALSE(b.second.Active || b.second.Done || b.second.CommandAborted || b.second.Error);
    b.cycle();
  }
  EXPECT_FALSE(b.first.Busy || b.first.Active || b.first.CommandAborted);
  EXPECT_TRUE(b.second.Active && b.second.Busy);
  EXPECT_EQ(b.s().state(), AxisState::discrete_motion);
  EXPECT_EQ(b.s().set().position.part, 1'000'000);
  EXPECT_EQ(b.s().set().velocity, 0);
  b.cycle();
  EXPECT_LT(b.s().set().position.part, 1'000'000) << "it moves from the next cycle on";
  EXPECT_TRUE(b.first.Done);
  b.to_end();
  covers("MC_MoveAbsolute", {"BufferMode", "Busy", "Active"});
}

TEST(PlcopenBuffer, WithNothingUnderWayEveryModeStartsAtOnce) {
  for (int mode = 0; mode <= 5; ++mode) {
    Queue b(static_cast<BufferMode>(mode));
    execute(b.second, b.kernel);
    EXPECT_TRUE(b.second.Active) << mode;
  }
}

TEST(PlcopenBuffer, BlendingPassesTheFirstTargetAtTheSpeedOfItsMode) {
  struct Row {
    BufferMode mode;
    double v1;
    double v2;
    double at_target;
  };
  for (const Row& row : {Row{BufferMode::blending_low, 100'000, 150'000, 100'000},
                         Row{BufferMode::blending_previous, 100'000, 150'000, 100'000},
                         Row{BufferMode::blending_next, 100'000, 150'000, 150'000},
                         Row{BufferMode::blending_high, 100'000, 150'000, 150'000},
                         Row{BufferMode::blending_low, 150'000, 100'000, 100'000},
                         Row{BufferMode::blending_previous, 150'000, 100'000, 150'000},
                         Row{BufferMode::blending_next, 150'000, 100'000, 100'000},
                         Row{BufferMode::blending_high, 150'000, 100'000, 150'000}}) {
    SCOPED_TRACE(static_cast<int>(row.mode) * 1'000'000 + row.v1);
    Queue b(row.mode, row.v1, row.v2);
    b.to_changeover();
    EXPECT_TRUE(b.first.Done);
    EXPECT_FALSE(b.first.CommandAborted);
    // A part of a cycle is past already, at no more than the jerk of the axis.
    const double speed = row.at_target * increments_per_speed;
    const double jerk = 5'000 / 0.05 * increments_per_acceleration;
    EXPECT_NEAR(b.s().set().velocity, speed, jerk * cycle_s * cycle_s / 2 + 1e-3);
    EXPECT_GE(b.s().set().position.part, 1'000'000);
    EXPECT_LT(b.s().set().position.part, 1'000'000 + 1.01 * speed * cycle_s);
    b.to_end();
  }
}

TEST(PlcopenBuffer, AtOneSpeedBlendedWaysAreOneWay) {
  const auto cycles = [](const std::vector<double>& ways) {
    Bench b;
    std::vector<McMoveRelative> moves(ways.size());
    for (std::size_t i = 0; i < ways.size(); ++i) {
      moves[i].Axis = b.slave;
      moves[i].Velocity = 100'000;
      moves[i].Distance = ways[i];
      moves[i].BufferMode = number(BufferMode::blending_previous);
      execute(moves[i], b.kernel);
    }
    int count = 0;
    for (; count < 20'000 && !moves.back().Done; ++count) {
      b.kernel.cycle();
      for (McMoveRelative& move : moves) move.call(b.kernel);
    }
    EXPECT_DOUBLE_EQ(b.at(b.s()), 5'000'000);
    for (const McMoveRelative& move : moves) EXPECT_TRUE(move.Done);
    return count;
  };
  const int whole = cycles({5'000'000});
  EXPECT_EQ(cycles({2'000'000, 3'000'000}), whole);
  EXPECT_EQ(cycles({1'500'000, 1'500'000, 2'000'000}), whole);
  covers("MC_MoveRelative", {"BufferMode", "Busy", "Active", "CommandAborted"});
}

TEST(PlcopenBuffer, WhereTheSecondTurnsBackTheFirstStops) {
  Queue b(BufferMode::blending_high, 100'000, 150'000, 200'000);
  b.to_changeover();
  EXPECT_EQ(b.s().set().velocity, 0);
  EXPECT_EQ(b.s().set().position.part, 1'000'000);
  b.to_end();
}

TEST(PlcopenBuffer, AShortSecondWayIsEnteredNoFasterThanItCanStop) {
  Queue b(BufferMode::blending_previous, 100'000, 100'000, 1'020'000);
  b.to_changeover();
  EXPECT_GT(b.s().set().velocity, 0);
  EXPECT_LT(b.s().set().velocity, 1'000'000);
  double farthest = 0;
  while (!b.second.Done) {
    b.cycle();
    farthest = std::max(farthest, b.s().set().position.part);
  }
  EXPECT_LE(farthest, 1'020'000 + 1e-6) << "it does not pass its target and come back";
}

TEST(PlcopenBuffer, BlendingThatComesLateTakesTheSpeedThatIsStillThere) {
  Queue b(BufferMode::blending_previous);
  execute(b.first, b.kernel);
  while (b.s().set().position.part < 900'000 || b.s().set().velocity > 900'000) b.cycle();
  execute(b.second, b.kernel);
  while (!b.second.Active) b.cycle();
  // At 0.9e6 it brakes so that it comes to 0.8e6 before it can gain speed again.
  EXPECT_GT(b.s().set().velocity, 0.75e6);
  EXPECT_LT(b.s().set().velocity, 1'000'000);
  b.to_end();
}

TEST(PlcopenBuffer, BlendingUnderAnOverrideKeepsItsShare) {
  Queue b(BufferMode::blending_next);
  b.s().control.override_percent = 50;
  b.cycles(200);
  b.to_changeover();
  EXPECT_NEAR(b.s().set().velocity, 0.5 * 150'000 * increments_per_speed, 3'000);
  for (int i = 0; i < 20'000 && !b.second.Done; ++i) b.cycle();
  EXPECT_DOUBLE_EQ(b.s().set().position.part, b.second.Position);
}

TEST(PlcopenBuffer, ASpeedIsDoneWhenItIsReachedAndThenAborted) {
  Bench b;
  auto on = b.make<McMoveVelocity>(100'000);
  auto then = b.make<McMoveAdditive>(100'000);
  then.Distance = 4'000'000;
  then.BufferMode = number(BufferMode::buffered);
  execute(on, b.kernel);
  execute(then, b.kernel);
  int cycles = 0;
  while (!then.Active) {
    EXPECT_TRUE(on.Busy && on.Active);
    EXPECT_LT(b.s().set().velocity, 1'000'000);
    b.cycles(1, on, then);
    ASSERT_LT(++cycles, 1'000);
  }
  EXPECT_DOUBLE_EQ(b.s().set().velocity, 1'000'000);
  EXPECT_TRUE(on.CommandAborted);
  EXPECT_FALSE(on.InVelocity || on.Busy || on.Active);
  const double from = b.at(b.s());
  ASSERT_LT(b.finish(then), 20'000);
  EXPECT_NEAR(b.at(b.s()), from + 4'000'000, 1e-6) << "from where it was, for it led nowhere";
  covers("MC_MoveVelocity", {"BufferMode", "Busy", "Active", "CommandAborted"});
  covers("MC_MoveAdditive", {"BufferMode", "Busy", "Active", "Done"});
}

TEST(PlcopenBuffer, ACamBehindAMoveEngagesAtItsEndAndAMoveBehindACamAtItsProfilesEnd) {
  Turning b;
  auto before = b.make<McMoveAbsolute>(300'000);
  auto after = b.make<McMoveRelative>(300'000);
  before.Position = 900'000;
  after.Distance = 500'000;
  after.BufferMode = b.cam.BufferMode = number(BufferMode::buffered);
  execute(before, b.kernel);
  b.cam.StartMode = hli_ci_f_periodic | hli_ci_endless_positive;
  execute(b.cam, b.kernel);
  EXPECT_TRUE(b.cam.Busy);
  EXPECT_FALSE(b.cam.Active);
  const auto step = [&] { b.cycles(1, b.run, before, b.cam, after); };
  int cycles = 0;
  while (!before.Done && ++cycles < 5'000) step();
  EXPECT_TRUE(b.cam.Active);
  EXPECT_EQ(b.s().state(), AxisState::synchronized_motion);
  while (!b.cam.InSync && ++cycles < 20'000) step();
  execute(after, b.kernel);
  EXPECT_FALSE(after.Active);
  while (!after.Active && ++cycles < 20'000) {
    EXPECT_TRUE(b.cam.Active && b.cam.Busy && b.cam.InSync);
    step();
  }
  // The cam ends where the master passes its turn.
  EXPECT_LT(b.m().set().position.part, b.m().set().velocity * cycle_s);
  EXPECT_TRUE(b.cam.CommandAborted);
  EXPECT_FALSE(b.cam.InSync || b.cam.Busy || b.cam.Active);
  EXPECT_EQ(b.s().state(), AxisState::discrete_motion);
  while (!after.Done && ++cycles < 20'000) step();
  EXPECT_TRUE(after.Done);
  covers("MC_CamIn", {"BufferMode", "Busy", "Active", "CommandAborted"});
}

TEST(PlcopenBuffer, AGearBehindAMoveAndAMoveBehindAGear) {
  Bench b;
  b.start_master();
  auto before = b.make<McMoveAbsolute>(300'000);
  auto gear = b.make<McGearIn>();
  auto after = b.make<McMoveRelative>(300'000);
  before.Position = 900'000;
  after.Distance = 500'000;
  gear.RatioNumerator = 1;
  gear.RatioDenominator = 2;
  gear.BufferMode = after.BufferMode = number(BufferMode::buffered);
  execute(before, b.kernel);
  execute(gear, b.kernel);
  execute(after, b.kernel);
  const auto step = [&] { b.cycles(1, b.run, before, gear, after); };
  int cycles = 0;
  while (!before.Done && ++cycles < 5'000) {
    EXPECT_TRUE(gear.Busy && after.Busy);
    EXPECT_FALSE(gear.Active || after.Active);
    step();
  }
  EXPECT_TRUE(gear.Active);
  while (!after.Active && ++cycles < 20'000) step();
  EXPECT_TRUE(gear.CommandAborted);
  EXPECT_NEAR(b.s().set().velocity, b.m().set().velocity / 2, 1) << "InGear";
  covers("MC_GearIn", {"BufferMode", "Busy", "Active", "CommandAborted"});
}

TEST(PlcopenBuffer, AnAbortingCommandEmptiesTheQueueAndAnErrorEndsIt) {
  for (const bool fault : {false, true}) {
    Queue b(BufferMode::buffered);
    execute(b.first, b.kernel);
    execute(b.second, b.kernel);
    b.cycle();
    auto halt = b.make<McHalt>();
    if (fault)
      b.s().fault(ErrorId::drive_error);
    else
      execute(halt, b.kernel);
    b.cycle();
    EXPECT_EQ(b.first.CommandAborted, !fault);
    EXPECT_EQ(b.second.CommandAborted, !fault);
    EXPECT_EQ(b.first.ErrorID, fault ? id(ErrorId::drive_error) : 0);
    EXPECT_EQ(b.second.ErrorID, fault ? id(ErrorId::drive_error) : 0);
    EXPECT_FALSE(b.second.Busy || b.second.Active);
    for (int i = 0; i < 2'000; ++i) b.cycle();
    EXPECT_LT(b.s().set().position.part, 1'000'000) << "nothing starts behind it";
  }
}

TEST(PlcopenBuffer, AWaitingCommandThatCannotStartFailsAndThoseBehindItAreAborted) {
  Queue b(BufferMode::buffered);
  auto cam = b.make<McCamIn>();
  cam.CamTableID = 77;
  cam.BufferMode = number(BufferMode::buffered);
  execute(b.first, b.kernel);
  execute(cam, b.kernel);
  execute(b.second, b.kernel);
  EXPECT_FALSE(cam.Error) << "the table may come before its turn";
  b.cycles(2'000, b.first, b.second, cam);
  EXPECT_TRUE(b.first.Done);
  EXPECT_EQ(cam.ErrorID, id(ErrorId::no_such_table));
  EXPECT_TRUE(b.second.CommandAborted);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
}

TEST(PlcopenBuffer, WhatIsWrongIsToldWhenItIsCommanded) {
  Queue b(BufferMode::buffered);
  execute(b.first, b.kernel);
  b.second.Velocity = 0;
  execute(b.second, b.kernel);
  EXPECT_EQ(b.second.ErrorID, id(ErrorId::velocity_range));
  b.second.Velocity = 1'000;
  for (const std::int16_t mode : {std::int16_t{-1}, std::int16_t{6}, std::int16_t{32767}}) {
    b.second.BufferMode = mode;
    execute(b.second, b.kernel);
    EXPECT_EQ(b.second.ErrorID, id(ErrorId::buffer_mode));
  }
  std::vector<McMoveRelative> more(most_waiting + 1);
  for (std::size_t i = 0; i < more.size(); ++i) {
    more[i].Axis = b.slave;
    more[i].Velocity = 1'000;
    more[i].BufferMode = number(BufferMode::buffered);
    execute(more[i], b.kernel);
    EXPECT_EQ(more[i].ErrorID, i < most_waiting ? 0 : id(ErrorId::too_many_waiting)) << i;
  }
  b.cycle();
  EXPECT_TRUE(b.first.Active) << "what is under way is not disturbed";
  covers({"44000", "65019"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
