#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

/// One axis with a block of each kind.
struct One {
  MotionKernel kernel;
  AxisRef ref;
  McPower power;
  McMoveAbsolute to;
  McMoveVelocity turn_on;
  McHalt halt;
  McStop stop;
  McHome home;

  explicit One(AxisParameters parameters = Bench::virtual_axis()) {
    ref = kernel.add_axis("A", parameters);
    power.Axis = to.Axis = turn_on.Axis = halt.Axis = stop.Axis = home.Axis = ref;
    power.Enable = true;
    power.call(kernel);
    to.Velocity = turn_on.Velocity = 100'000;
  }
  Axis& axis() { return *kernel.axis(ref); }
  double part() { return axis().set().position.part; }
  template <typename Block>
  void execute(Block& block) {
    plcopen::execute(block, kernel);
  }
  template <typename Block>
  void finish(Block& block) {
    execute(block);
    for (int i = 0; i < 10'000 && !block.Done && !block.Error; ++i) cycle(block);
  }
  /// Until `reached` is TRUE; the peaks of the way.
  template <typename Block>
  Peaks run(Block& block, const bool& reached) {
    Peaks peaks;
    execute(block);
    while (!reached) {
      cycle(block);
      peaks.take(axis().set());
    }
    return peaks;
  }
  template <typename Block>
  void cycle(Block& block) {
    drive();
    kernel.cycle();
    block.call(kernel);
  }
  /// An ideal drive: the word is speed, exactly. 3.6e6 increments are 10000 counts, 10 V are 1e7 inc/s.
  double counts = 0;
  bool connected = true;
  void drive() {
    if (connected) counts += axis().outputs().reference / 32767.0 * 1e7 * cycle_s / 360;
    axis().drive.counts = std::llround(counts);
  }
};

AxisParameters servo() {
  AxisParameters parameters = Bench::virtual_axis();
  parameters.kind = AxisKind::drive;
  parameters.homed_at_start = false;
  return parameters;
}

TEST(PlcopenAxis, MoveAbsoluteKeepsItsDynamicsAndEndsExactly) {
  One one;
  one.to.Position = 1'500'000.25;
  one.to.Acceleration = 2'000;
  one.to.Deceleration = 1'000;
  one.to.Jerk = 50'000;
  const Peaks peaks = one.run(one.to, one.to.Done);
  EXPECT_EQ(one.part(), 1'500'000.25);
  EXPECT_EQ(one.axis().state(), AxisState::standstill);
  EXPECT_NEAR(peaks.v, 1e6, 1);
  EXPECT_NEAR(peaks.a, 2e7, 1);
  EXPECT_NEAR(peaks.d, 1e7, 1);
  EXPECT_NEAR(peaks.j, 5e8, 1e3);
  covers("MC_MoveAbsolute", {"Position", "Velocity", "Acceleration", "Deceleration", "Jerk", "Done"});
}

TEST(PlcopenAxis, WithoutItsOwnDynamicsACommandTakesTheAxis) {
  AxisParameters parameters = Bench::virtual_axis();
  parameters.a_max = 3'000;
  parameters.tr_min = 100'000;
  parameters.vb_max = 150'000;
  One one(parameters);
  one.to.Position = 1'700'000;
  one.to.Velocity = 2e9;
  const Peaks peaks = one.run(one.to, one.to.Done);
  EXPECT_NEAR(peaks.v, 1.5e6, 1);
  EXPECT_NEAR(peaks.a, 1.5e7, 1);
  EXPECT_NEAR(peaks.j, 1.5e8, 1e3);
  covers({"dynamik.vb_max", "dynamik.a_max", "dynamik.tr_min"});
}

TEST(PlcopenAxis, TheDirectionChoosesTheWayRound) {
  const auto way = [](int direction, double target, double running = 0) {
    One one;
    if (running != 0) {
      one.turn_on.Direction = running > 0 ? 1 : 3;
      one.execute(one.turn_on);
      for (int i = 0; i < 100; ++i) one.cycle(one.turn_on);
    }
    one.to.Position = target;
    one.to.Direction = static_cast<std::int16_t>(direction);
    one.finish(one.to);
    EXPECT_EQ(one.part(), target);
    return one.axis().set().position.turns;
  };
  EXPECT_EQ(way(2, 3'000'000), -1);
  EXPECT_EQ(way(1, 3'000'000), 0);
  EXPECT_EQ(way(3, 600'000), -1);
  EXPECT_EQ(way(4, 600'000, -1), -1);
  EXPECT_EQ(way(4, 3'000'000, 1), 0);
  EXPECT_EQ(way(4, 3'000'000), -1);  // standing: the shortest
  EXPECT_EQ(way(1, 0), 0);           // there already
  // Too near to stop in front of it: once more round.
  EXPECT_EQ(way(1, 190'000, 1), 1);
  One one;
  one.to.Direction = 5;
  one.execute(one.to);
  EXPECT_EQ(one.to.ErrorID, id(ErrorId::direction_range));
  covers({"MC_MoveAbsolute.Direction", "65014"});
}

TEST(PlcopenAxis, MoveVelocityHaltAndStopKeepTheirDynamics) {
  One one;
  one.turn_on.Acceleration = 2'000;
  one.turn_on.Jerk = 40'000;
  const Peaks up = one.run(one.turn_on, one.turn_on.InVelocity);
  EXPECT_NEAR(up.a, 2e7, 1);
  EXPECT_NEAR(up.j, 4e8, 1e3);
  EXPECT_EQ(one.axis().set().velocity, 1e6);
  // Slower: the deceleration of its own.
  one.turn_on.Velocity = 20'000;
  one.turn_on.Deceleration = 700;
  const Peaks slower = one.run(one.turn_on, one.turn_on.InVelocity);
  EXPECT_NEAR(slower.d, 7e6, 1);
  one.turn_on.Velocity = 100'000;
  one.execute(one.turn_on);
  for (int i = 0; i < 500; ++i) one.cycle(one.turn_on);
  one.halt.Deceleration = 900;
  one.halt.Jerk = 30'000;
  const Peaks down = one.run(one.halt, one.halt.Done);
  EXPECT_NEAR(down.d, 9e6, 1);
  EXPECT_NEAR(down.j, 3e8, 1e3);
  EXPECT_EQ(one.axis().set().velocity, 0);
  EXPECT_EQ(one.axis().state(), AxisState::standstill);
  one.execute(one.turn_on);
  for (int i = 0; i < 500; ++i) one.cycle(one.turn_on);
  one.stop.Deceleration = 1'100;
  one.stop.Jerk = 60'000;
  const Peaks stopping = one.run(one.stop, one.stop.Done);
  EXPECT_NEAR(stopping.d, 1.1e7, 1);
  EXPECT_NEAR(stopping.j, 6e8, 1e3);
  covers("MC_MoveVelocity", {"Acceleration", "Deceleration", "Jerk"});
  covers("MC_Halt", {"Deceleration", "Jerk", "Done"});
  covers({"MC_Stop.Deceleration", "MC_Stop.Jerk"});
}

TEST(PlcopenAxis, InputsOutOfRangeAreRefusedByTheirNumbers) {
  One one;
  const auto error = [&](auto& block) {
    one.execute(block);
    EXPECT_EQ(one.axis().state(), AxisState::standstill);
    return static_cast<ErrorId>(block.ErrorID);
  };
  one.to.Velocity = 0.5;
  EXPECT_EQ(error(one.to), ErrorId::velocity_range);
  one.to.Velocity = 1;
  one.to.Position = 3e9;
  EXPECT_EQ(error(one.to), ErrorId::position_range);
  one.to.Position = std::nan("");
  EXPECT_EQ(error(one.to), ErrorId::position_range);
  one.to.Acceleration = -1;
  EXPECT_EQ(error(one.to), ErrorId::acceleration_range);
  one.turn_on.Deceleration = 3e9;
  EXPECT_EQ(error(one.turn_on), ErrorId::deceleration_range);
  one.turn_on.Velocity = -5;
  EXPECT_EQ(error(one.turn_on), ErrorId::velocity_range);
  one.turn_on = {};
  one.turn_on.Axis = one.ref;
  one.turn_on.Velocity = 5;
  one.turn_on.Direction = 2;
  EXPECT_EQ(error(one.turn_on), ErrorId::direction_range);
  one.halt.Jerk = -1;
  EXPECT_EQ(error(one.halt), ErrorId::jerk_range);
  one.stop.Deceleration = -1;
  EXPECT_EQ(error(one.stop), ErrorId::deceleration_range);
  one.home.Position = 1e10;
  EXPECT_EQ(error(one.home), ErrorId::position_range);
  covers({"44003", "44004", "44005", "44006", "65012", "65014"});
}

TEST(PlcopenAxis, TheDriveFollowsWithKvAndFeedForward) {
  // With the whole feed-forward no lag remains; without it the lag is v/kv.
  for (const double share : {1'000.0, 0.0}) {
    AxisParameters parameters = servo();
    parameters.feed_forward = share;
    parameters.kv = 4'000;  // 40/s
    One one(parameters);
    one.execute(one.turn_on);
    for (int i = 0; i < 1'000; ++i) one.cycle(one.turn_on);
    EXPECT_EQ(one.axis().set().velocity, 1e6);
    // The drive answers one cycle later: v T more.
    EXPECT_NEAR(one.axis().following_error(), share > 0 ? 0 : 1e6 / 40, 2 * 360);
    EXPECT_NEAR(one.axis().outputs().reference, 3276.7, 30);
    EXPECT_TRUE(one.axis().outputs().enable);
  }
  AxisParameters faster = servo();
  faster.v_at_10v = 2'000'000;
  faster.kv = 0;
  One one(faster);
  one.execute(one.turn_on);
  for (int i = 0; i < 400; ++i) one.cycle(one.turn_on);
  EXPECT_NEAR(one.axis().outputs().reference, 1638.35, 1);
  covers({"kv", "feed_forward", "antr.v_at_10v", "kind"});
}

TEST(PlcopenAxis, CountsBecomeIncrementsExactlyOverAnyNumberOfTurns) {
  AxisParameters parameters = servo();
  parameters.path_increments = 1'000'003;
  parameters.path_counts = 7'777;
  One one(parameters);
  one.axis().drive.counts = 7'777LL * 3'600'000 * 1'000 + 7'777 * 5;
  one.kernel.cycle();
  EXPECT_EQ(one.axis().actual().turns, 1'000'003'001);
  EXPECT_EQ(one.axis().actual().part, 5'000'015 - 3'600'000);
  one.axis().drive.counts = -1;
  one.kernel.cycle();
  EXPECT_EQ(one.axis().actual().turns, -1);
  EXPECT_NEAR(one.axis().actual().part, 3'600'000 - 1'000'003.0 / 7'777, 1e-6);
  covers({"path_increments", "path_counts"});
}

TEST(PlcopenAxis, HomeGivesThePresentPositionItsValueAndKeepsTheLag) {
  One one(servo());
  one.counts = 1'234;
  one.drive();
  one.kernel.cycle();
  one.power.Enable = false;
  one.power.call(one.kernel);
  one.power.Enable = true;
  one.power.call(one.kernel);
  EXPECT_FALSE(one.axis().homed());
  one.home.Position = 90'000;
  one.execute(one.home);
  EXPECT_EQ(one.axis().state(), AxisState::homing);
  one.cycle(one.home);
  EXPECT_TRUE(one.home.Done);
  EXPECT_TRUE(one.axis().homed());
  EXPECT_EQ(one.axis().actual().part, 90'000);
  EXPECT_EQ(one.axis().following_error(), 0);
  covers({"MC_Home.Position", "MC_Home.Done"});
}

TEST(PlcopenAxis, AMoveIsDoneWhenTheActualPositionIsInTheWindow) {
  AxisParameters parameters = servo();
  parameters.window = 4'000;
  parameters.feed_forward = 0;
  One one(parameters);
  one.to.Position = 800'000;
  one.finish(one.to);
  ASSERT_TRUE(one.to.Done);
  EXPECT_LE(std::abs(one.axis().following_error()), 4'000);
  EXPECT_GE(std::abs(one.axis().following_error()), 2'000);
  covers({"getriebe[0].window"});
}

TEST(PlcopenAxis, FollowingErrorAndALostDriveEndInErrorstop) {
  AxisParameters parameters = servo();
  parameters.following_error_max = 30'000;
  One one(parameters);
  one.connected = false;
  one.execute(one.turn_on);
  for (int i = 0; i < 100; ++i) one.cycle(one.turn_on);
  EXPECT_EQ(one.axis().state(), AxisState::errorstop);
  EXPECT_EQ(one.turn_on.ErrorID, id(ErrorId::following_error));
  One lost(servo());
  lost.execute(lost.turn_on);
  for (int i = 0; i < 100; ++i) lost.cycle(lost.turn_on);
  lost.axis().drive.ready = false;
  lost.cycle(lost.turn_on);
  EXPECT_EQ(lost.turn_on.ErrorID, id(ErrorId::drive_error));
  EXPECT_FALSE(lost.axis().outputs().enable);
  EXPECT_EQ(lost.axis().outputs().reference, 0);
  covers({"65007", "65008", "following_error_max"});
}

TEST(PlcopenAxis, OverrideAndFeedHoldSlowAnUncoupledAxisWithoutALeap) {
  One one;
  one.to.Position = 1'700'000;
  one.execute(one.to);
  for (int i = 0; i < 200; ++i) one.cycle(one.to);
  EXPECT_EQ(one.axis().set().velocity, 1e6);
  one.axis().control.override_percent = 50;
  double last = 1e6;
  for (int i = 0; i < 200; ++i) {
    one.cycle(one.to);
    EXPECT_LE(std::abs(one.axis().set().velocity - last), 1e8 / 2 * cycle_s);
    last = one.axis().set().velocity;
  }
  EXPECT_NEAR(last, 5e5, 1);
  one.axis().control.feed_hold = true;
  for (int i = 0; i < 200; ++i) one.cycle(one.to);
  EXPECT_EQ(one.axis().set().velocity, 0);
  EXPECT_EQ(one.axis().state(), AxisState::discrete_motion);
  one.axis().control = {};
  one.axis().control.feed_enable = false;
  for (int i = 0; i < 200; ++i) one.cycle(one.to);
  EXPECT_EQ(one.axis().set().velocity, 0);
  one.axis().control = {};
  for (int i = 0; i < 2'000 && !one.to.Done; ++i) one.cycle(one.to);
  EXPECT_TRUE(one.to.Done);
  EXPECT_EQ(one.part(), 1'700'000);
}

TEST(PlcopenAxis, SoftwareLimitsRefuseATargetAndStopARunningAxisInFrontOfThem) {
  AxisParameters linear = Bench::linear_axis(-500'000, 2'000'000);
  One one(linear);
  one.to.Position = 2'000'001;
  one.execute(one.to);
  EXPECT_EQ(one.to.ErrorID, id(ErrorId::position_range));
  one.to.Position = 2'000'000;
  one.finish(one.to);
  EXPECT_TRUE(one.to.Done);
  one.turn_on.Direction = 3;
  one.execute(one.turn_on);
  for (int i = 0; i < 3'000; ++i) {
    one.cycle(one.turn_on);
    ASSERT_GE(one.part(), -500'000.01);
  }
  EXPECT_EQ(one.axis().error(), ErrorId::software_limit);
  EXPECT_LE(one.part(), -480'000);
  covers({"65005", "kenngr.swe_neg", "kenngr.swe_pos"});
}

TEST(PlcopenAxis, ParametersKeepTheirRangesAndWhatTheAxisIsMadeOfIsFixedWhileItRuns) {
  for (const AxisParameter& parameter : axis_parameter_table()) {
    AxisParameters values;
    EXPECT_TRUE(set_parameter(values, parameter, parameter.value(values))) << parameter.name;
    EXPECT_TRUE(set_parameter(values, parameter, parameter.max)) << parameter.name;
    EXPECT_EQ(parameter.value(values), parameter.max);
    EXPECT_FALSE(set_parameter(values, parameter, parameter.min - 1)) << parameter.name;
    EXPECT_FALSE(set_parameter(values, parameter, std::nan(""))) << parameter.name;
    EXPECT_EQ(set_parameter(values, parameter, parameter.min + 0.5), !parameter.whole) << parameter.name;
    EXPECT_FALSE(parameter.meaning.empty());
    EXPECT_EQ(find_axis_parameter(parameter.name), &parameter);
  }
  One one;
  EXPECT_FALSE(one.axis().set_parameter(*find_axis_parameter("modulo"), 1'000));
  EXPECT_TRUE(one.axis().set_parameter(*find_axis_parameter("kv"), 1'000));
  EXPECT_EQ(find_axis_parameter("nothing"), nullptr);
}

TEST(PlcopenAxis, CamTableSelectFindsByFileWhichWinsOrById) {
  Bench b;
  b.table({1}, 3, Interpolation::linear, 5);
  auto select = b.make<McCamTableSelect>();
  const auto ask = [&](const char* file, std::uint16_t number) {
    select.CamTable = {file, number};
    select.Execute = false;
    select.call(b.kernel);
    EXPECT_FALSE(select.Done);
    select.Execute = true;
    select.call(b.kernel);
    EXPECT_EQ(select.Done, !select.Error);
    return select.CamTableID;
  };
  EXPECT_EQ(ask("", 5), 5);
  EXPECT_EQ(ask("cam.tab", 99), 5);
  EXPECT_EQ(ask("other.tab", 5), 0);
  EXPECT_EQ(select.ErrorID, id(ErrorId::selected_table_missing));
  EXPECT_EQ(ask("", 6), 0);
  EXPECT_TRUE(select.Error);
  select.Slave = {};
  EXPECT_EQ(ask("", 5), 0);
  EXPECT_EQ(select.ErrorID, id(ErrorId::no_such_axis));
  select.Slave = b.slave;
  select.Master = {};
  EXPECT_EQ(ask("", 5), 0);
  covers("MC_CamTableSelect",
         {"Master", "Slave", "Execute", "CamTable", "Done", "Error", "ErrorID", "CamTableID"});
  covers({"60265"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
