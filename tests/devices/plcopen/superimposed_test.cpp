// MC_MoveSuperImposed and MC_MoveAdditive.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

/// Both axes of the bench make the same movement; the slave gets some way on top of it.
struct Twins : Bench {
  McMoveAbsolute masters;
  McMoveAbsolute slaves;
  McMoveSuperImposed more;

  Twins() {
    masters.Axis = master;
    slaves.Axis = more.Axis = slave;
    masters.Velocity = slaves.Velocity = 200'000;
    masters.Position = slaves.Position = 3'000'000;
    masters.Direction = slaves.Direction = 1;
    more.Distance = 120'000;
    more.VelocityDiff = 50'000;
    more.Acceleration = 800;
    more.Deceleration = 400;
    more.Jerk = 20'000;
    execute(masters, kernel);
    execute(slaves, kernel);
  }
  void cycle() { cycles(1, masters, slaves, more); }
  double apart() { return at(s()) - at(m()); }
};

TEST(PlcopenSuperImposed, PositionsSpeedsAndAccelerationsAddExactly) {
  Twins b;
  for (int i = 0; i < 100; ++i) b.cycle();
  execute(b.more, b.kernel);
  const JerkProfile alone = *to_position({}, 120'000, {500'000, 8e6, 4e6, 2e8});
  double time = 0;
  while (!b.more.Done) {
    EXPECT_TRUE(b.more.Busy);
    b.cycle();
    time += cycle_s;
    const MotionState expected = at(alone, std::min(time, alone.duration));
    ASSERT_NEAR(b.apart(), expected.position, 1e-6) << time;
    ASSERT_NEAR(b.s().set().velocity - b.m().set().velocity, expected.velocity, 1e-5);
    ASSERT_NEAR(b.s().set().acceleration - b.m().set().acceleration, expected.acceleration, 1e-3);
    ASSERT_TRUE(b.slaves.Active) << "what is under way goes on";
    ASSERT_EQ(b.s().target().part, 3'120'000);
  }
  EXPECT_NEAR(time, alone.duration, cycle_s);
  EXPECT_FALSE(b.more.Busy);
  for (int i = 0; i < 5'000 && !b.slaves.Done; ++i) b.cycle();
  EXPECT_TRUE(b.slaves.Done && b.masters.Done);
  EXPECT_DOUBLE_EQ(b.at(b.s()), 3'120'000);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
  covers("MC_MoveSuperImposed",
         {"Distance", "VelocityDiff", "Acceleration", "Deceleration", "Jerk", "Busy", "Done"});
}

TEST(PlcopenSuperImposed, ItMayLastLongerThanTheMovementBelow) {
  Twins b;
  for (int i = 0; i < 100; ++i) b.cycle();
  b.more.VelocityDiff = 1'000;
  execute(b.more, b.kernel);
  while (!b.slaves.Done) b.cycle();
  EXPECT_EQ(b.s().state(), AxisState::discrete_motion);
  EXPECT_GT(b.s().set().velocity, 0);
  for (int i = 0; i < 20'000 && !b.more.Done; ++i) b.cycle();
  EXPECT_DOUBLE_EQ(b.at(b.s()), 3'120'000);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
}

TEST(PlcopenSuperImposed, InStandstillItIsARelativeMovement) {
  Bench b;
  auto more = b.make<McMoveSuperImposed>();
  more.Distance = -400'000;
  more.VelocityDiff = 100'000;
  execute(more, b.kernel);
  EXPECT_EQ(b.s().state(), AxisState::discrete_motion);
  b.finish(more, 5'000);
  EXPECT_TRUE(more.Done);
  EXPECT_DOUBLE_EQ(b.at(b.s()), -400'000);
}

TEST(PlcopenSuperImposed, OnACamAndAGearItShiftsTheSlaveAndNothingElse) {
  for (const bool cam : {true, false}) {
    Turning b;
    auto gear = b.make<McGearIn>();
    if (cam)
      b.couple(hli_ci_f_periodic | hli_ci_endless_positive);
    else
      execute(gear, b.kernel);
    ASSERT_GE(b.until([&] {
      gear.call(b.kernel);
      return cam ? b.cam.InSync : gear.InGear;
    }),
              0);
    const double before = b.at(b.s()) - b.at(b.m());
    auto more = b.make<McMoveSuperImposed>();
    more.Distance = -70'000;
    more.VelocityDiff = 30'000;
    execute(more, b.kernel);
    for (int i = 0; i < 3'000 && !more.Done; ++i) {
      b.step();
      more.call(b.kernel);
      gear.call(b.kernel);
      EXPECT_TRUE(cam ? b.cam.InSync : gear.InGear);
      EXPECT_EQ(b.s().state(), AxisState::synchronized_motion);
    }
    ASSERT_TRUE(more.Done);
    for (int turns = 0; turns < 3; ++turns) {
      EXPECT_NEAR(b.at(b.s()) - b.at(b.m()), before - 70'000, 1e-5);
      b.step(500);
    }
    // Uncoupled it stays where it is.
    const double at_end = b.at(b.s());
    const double speed = b.s().set().velocity;
    EXPECT_EQ(b.s().uncouple(cam ? Command::cam_out : Command::gear_out).error, ErrorId::none);
    b.kernel.cycle();
    EXPECT_NEAR(b.at(b.s()), at_end + speed * cycle_s, 1e-5);
  }
}

TEST(PlcopenSuperImposed, AnotherOneTakesOverFromItAndAnAbortingCommandFromBoth) {
  Twins b;
  for (int i = 0; i < 100; ++i) b.cycle();
  execute(b.more, b.kernel);
  for (int i = 0; i < 50; ++i) b.cycle();
  auto other = b.make<McMoveSuperImposed>();
  other.Distance = 10'000;
  other.VelocityDiff = 50'000;
  const double gone = b.apart();
  const double speed = b.s().set().velocity;
  execute(other, b.kernel);
  b.cycle();
  EXPECT_TRUE(b.more.CommandAborted);
  EXPECT_TRUE(b.slaves.Active);
  EXPECT_NEAR(b.s().set().velocity, speed, 2'000) << "no leap in speed";
  for (int i = 0; i < 2'000 && !other.Done; ++i) {
    b.cycle();
    other.call(b.kernel);
  }
  EXPECT_NEAR(b.apart(), gone + 10'000, 1e-6);
  execute(b.more, b.kernel);
  for (int i = 0; i < 20; ++i) b.cycle();
  const double before = b.s().set().velocity;
  auto halt = b.make<McHalt>();
  execute(halt, b.kernel);
  b.cycle();
  EXPECT_TRUE(b.more.CommandAborted && b.slaves.CommandAborted);
  EXPECT_NEAR(b.s().set().velocity, before, 20'000) << "it brakes from the speed of both";
  covers({"MC_MoveSuperImposed.CommandAborted"});
}

TEST(PlcopenSuperImposed, ItGoesOnOverABufferedChange) {
  Twins b;
  McMoveRelative masters_next;
  McMoveRelative slaves_next;
  masters_next.Axis = b.master;
  slaves_next.Axis = b.slave;
  masters_next.Velocity = slaves_next.Velocity = 100'000;
  masters_next.Distance = slaves_next.Distance = 1'000'000;
  masters_next.BufferMode = slaves_next.BufferMode = static_cast<std::int16_t>(BufferMode::blending_low);
  execute(masters_next, b.kernel);
  execute(slaves_next, b.kernel);
  while (b.m().set().position.part < 2'800'000) b.cycle();
  b.more.VelocityDiff = 20'000;
  execute(b.more, b.kernel);
  const JerkProfile alone = *to_position({}, 120'000, {200'000, 8e6, 4e6, 2e8});
  double time = 0;
  while (!b.more.Done) {
    b.cycle();
    time += cycle_s;
    ASSERT_NEAR(b.apart(), at(alone, std::min(time, alone.duration)).position, 1e-5) << time;
  }
  EXPECT_TRUE(b.slaves.Done);
  for (int i = 0; i < 5'000; ++i) b.cycle();
  EXPECT_NEAR(b.at(b.s()), 4'120'000, 1e-6);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
}

TEST(PlcopenSuperImposed, ItKeepsTheSoftwareLimits) {
  AxisParameters linear = Bench::linear_axis(-100'000, 1'000'000);
  Bench b(linear);
  auto to = b.make<McMoveAbsolute>();
  auto more = b.make<McMoveSuperImposed>();
  to.Position = 950'000;
  to.Velocity = 100'000;
  more.Distance = 80'000;
  more.VelocityDiff = 5'000;
  execute(to, b.kernel);
  b.kernel.cycle();
  execute(more, b.kernel);
  for (int i = 0; i < 2'000; ++i) {
    b.kernel.cycle();
    EXPECT_LE(b.s().set().position.part, 1'000'000 + 1e-3);
  }
  more.call(b.kernel);
  EXPECT_EQ(b.s().error(), ErrorId::software_limit);
  EXPECT_EQ(more.ErrorID, id(ErrorId::software_limit));
}

TEST(PlcopenAdditive, AddsToTheTargetOfTheMovementUnderWay) {
  Bench b;
  auto to = b.make<McMoveAbsolute>();
  auto by = b.make<McMoveAdditive>();
  to.Position = 600'000;
  to.Velocity = by.Velocity = 100'000;
  by.Distance = 400'000;
  execute(to, b.kernel);
  b.cycles(100);
  execute(by, b.kernel);
  to.call(b.kernel);
  EXPECT_TRUE(to.CommandAborted);
  // Once more while that one is on its way: its own target counts, though it was never reached.
  McMoveAdditive again = by;
  again.Distance = 50'000.25;
  execute(again, b.kernel);
  b.finish(again, 5'000);
  EXPECT_DOUBLE_EQ(b.at(b.s()), 1'050'000.25);
  // In Standstill it is a relative movement; an axis with a speed adds to where it is.
  execute(by, b.kernel);
  b.finish(by, 5'000);
  EXPECT_DOUBLE_EQ(b.at(b.s()), 1'450'000.25);
  covers("MC_MoveAdditive",
         {"Distance", "Velocity", "Acceleration", "Deceleration", "Jerk", "CommandAborted"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
