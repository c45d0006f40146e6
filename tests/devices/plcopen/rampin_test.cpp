#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

TEST(PlcopenRampIn, OnARunningMasterTheSlavePassesItsThreePhasesInTheirTimes) {
  Turning b;
  const double speed = b.m().set().velocity;  // 3.6e6 inc/s
  EXPECT_DOUBLE_EQ(speed, 3'600'000);
  b.couple(turning);
  EXPECT_EQ(b.phase(), CouplingPhase::slip);
  EXPECT_EQ(b.s().state(), AxisState::synchronized_motion);
  // From rest to dv with jerk j: T = 2 sqrt(dv/j) = 120 ms; the window of 10 % opens when half of the rest is
  // 10 %: sqrt(2*0.1 dv/j) before the end.
  const double jerk = 100'000 * increments_per_acceleration;
  const double whole = 2 * std::sqrt(speed / jerk);
  const double window = whole - std::sqrt(2 * 0.1 * speed / jerk);
  const int slip = 1 + b.until([&] { return b.phase() != CouplingPhase::slip; });
  EXPECT_NEAR(slip * cycle_s, window, 1.5 * cycle_s);
  EXPECT_EQ(b.phase(), CouplingPhase::window);
  // time_in_window, 8 ms.
  EXPECT_EQ(b.until([&] { return b.phase() != CouplingPhase::window; }), 4);
  EXPECT_EQ(b.phase(), CouplingPhase::phasing);
  EXPECT_FALSE(b.cam.InSync);
  ASSERT_GE(b.until([&] { return b.cam.InSync; }), 10);
  EXPECT_EQ(b.phase(), CouplingPhase::coupled);
  // The cam is y = x, to the last digit.
  for (int i = 0; i < 100; ++i) {
    b.step();
    EXPECT_NEAR(shortest(b.s().set().position, b.m().set().position, turn), 0, 1e-6);
    EXPECT_NEAR(b.s().set().velocity, speed, 1e-3);
  }
  covers("MC_CamIn", {"Master", "InSync", "StartMode", "CamTableID"});
  covers({"cam_gear.time_in_window", "cam_gear.j_vel_sync", "HLI_CI_ENDLESS_POSITIVE", "HLI_CI_F_PERIODIC",
          "type 3", "dynamik.a_max", "MC_MoveVelocity.Velocity", "MC_MoveVelocity.InVelocity"});
}

TEST(PlcopenRampIn, JerkAndAccelerationKeepTheirLimitsWhateverTheCamDoes) {
  for (const double jerk : {5'000.0, 40'000.0, 100'000.0}) {
    Bench b;
    std::vector<double> wavy;
    for (int i = 0; i < 36; ++i) wavy.push_back(i * 100'000 + 80'000 * std::sin(i * 0.349));
    b.table(wavy, 3, Interpolation::polynom_3);
    b.set("cam_gear.j_vel_sync", jerk);
    b.set("cam_gear.time_out_in_window", 9e6);
    b.set("cam_gear.time_in_window", 40'000);
    b.start_master();
    b.couple(turning);
    double before = 0;
    double most = 0;
    while (b.phase() == CouplingPhase::slip || b.phase() == CouplingPhase::window) {
      const double now = b.s().set().acceleration;
      most = std::max(most, std::abs(now - before) / cycle_s);
      EXPECT_LE(std::abs(now), 10'000 * increments_per_acceleration * (1 + 1e-9));
      before = now;
      b.step();
      ASSERT_EQ(b.s().state(), AxisState::synchronized_motion);
    }
    EXPECT_LE(most, jerk * increments_per_acceleration * (1 + 1e-6));
    EXPECT_GE(most, jerk * increments_per_acceleration * 0.9);
  }
  covers({"cam_gear.j_vel_sync"});
}

TEST(PlcopenRampIn, PhasingKeepsItsOwnLimitsOnTopOfTheCam) {
  Bench b;
  b.table(one_to_one());
  b.cam.SlaveOffset = 1'700'000;
  b.start_master();
  b.set("cam_gear.v_phasing", 100'000);
  b.set("cam_gear.a_phasing", 1'000);
  b.set("cam_gear.time_in_window", 200'000);
  b.set("cam_gear.d_phasing", 500);
  b.set("cam_gear.j_phasing", 40'000);
  b.couple(turning);
  ASSERT_GE(b.until([&] { return b.phase() == CouplingPhase::phasing; }), 0);
  double v = 0;
  double a = 0;
  double d = 0;
  double j = 0;
  double last = b.s().set().acceleration;
  b.step();
  while (b.phase() == CouplingPhase::phasing) {
    const AxisMotion now = b.s().set();
    const double relative = now.velocity - b.m().set().velocity;
    v = std::max(v, std::abs(relative));
    (relative * now.acceleration > 0 ? a : d) =
        std::max(relative * now.acceleration > 0 ? a : d, std::abs(now.acceleration));
    j = std::max(j, std::abs(now.acceleration - last) / cycle_s);
    last = now.acceleration;
    b.step();
  }
  EXPECT_NEAR(v, 100'000 * increments_per_speed, 1);
  EXPECT_NEAR(a, 1'000 * increments_per_acceleration, 1);
  EXPECT_NEAR(d, 500 * increments_per_acceleration, 1);
  EXPECT_NEAR(j, 40'000 * increments_per_acceleration, 1);
  EXPECT_TRUE(b.s().coupling()->engaged());
  covers({"cam_gear.v_phasing", "cam_gear.a_phasing", "cam_gear.d_phasing", "cam_gear.j_phasing",
          "MC_CamIn.SlaveOffset"});
}

TEST(PlcopenRampIn, PhasingTakesTheShortestWayRoundTheTurn) {
  Bench b;
  b.table({0});
  b.cam.SlaveOffset = 3'000'000;
  b.engage();
  EXPECT_EQ(b.s().set().position.turns, -1);
  EXPECT_EQ(b.s().set().position.part, 3'000'000);
}

TEST(PlcopenRampIn, AStandingMasterCostsTheTimeInTheWindowTooAndTheAmplitudeIsTrue) {
  Bench b;
  b.table({500'000, 900'000});
  b.couple();
  const int cycles = b.until([&] { return b.phase() == CouplingPhase::phasing; });
  EXPECT_EQ(cycles, 4);
  ASSERT_GE(b.until([&] { return b.cam.InSync; }), 0);
  EXPECT_EQ(b.s().set().position.part, 500'000);
  EXPECT_EQ(b.s().set().velocity, 0);
  EXPECT_EQ(b.s().state(), AxisState::synchronized_motion);
  covers({"MC_CamIn.Slave"});
}

TEST(PlcopenRampIn, ATimeOutInTheWindowAbortsWithItsErrorAndStops) {
  Bench b;
  b.table(one_to_one());
  b.set("cam_gear.time_in_window", 400'000);
  b.set("cam_gear.time_out_in_window", 100'000);
  b.start_master();
  b.couple(turning);
  ASSERT_GE(b.until([&] { return b.phase() == CouplingPhase::window; }), 0);
  EXPECT_EQ(b.until([&] { return b.s().state() == AxisState::errorstop; }), 50);
  b.step();
  EXPECT_TRUE(b.cam.Error);
  EXPECT_EQ(b.cam.ErrorID, static_cast<unsigned>(ErrorId::window_timeout));
  EXPECT_FALSE(b.cam.InSync);
  ASSERT_GE(b.until([&] { return b.s().set().velocity == 0; }), 0);
  // Counted from the command, the slip of 90 ms takes most of the time.
  auto reset = b.make<McReset>();
  reset.Execute = true;
  for (int i = 0; i < 3; ++i) {
    reset.call(b.kernel);
    b.step();
  }
  EXPECT_TRUE(reset.Done);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
  b.set("cam_gear.timeout_from_execute", 1);
  b.couple(turning);
  EXPECT_EQ(b.until([&] { return b.s().state() == AxisState::errorstop; }), 49);
  covers({"65004", "cam_gear.time_out_in_window", "cam_gear.timeout_from_execute", "MC_CamIn.Error",
          "MC_CamIn.ErrorID", "MC_Reset.Done"});
}

TEST(PlcopenRampIn, AWiderWindowOpensEarlier) {
  int narrow = 0;
  int wide = 0;
  for (const double percent : {100.0, 500.0}) {
    Bench b;
    b.table(one_to_one());
    b.set("cam_gear.v_diff_percent", percent);
    b.start_master();
    b.couple(turning);
    (percent == 100 ? narrow : wide) = b.until([&] { return b.phase() == CouplingPhase::window; });
  }
  EXPECT_LT(wide, narrow);
  covers({"cam_gear.v_diff_percent"});
}

TEST(PlcopenRampIn, JerkZeroIsHalfOfTheAccelerationInTheLongestRampTime) {
  Bench b;
  b.table(one_to_one());
  b.set("cam_gear.j_vel_sync", 0);
  b.set("dynamik.tr_max", 200'000);
  b.start_master();
  b.couple(turning);
  const double first = b.s().set().acceleration;
  EXPECT_NEAR(first / cycle_s, 10'000.0 / 2 / 0.2 * increments_per_acceleration, 1);
  // No jerk is larger than the shortest ramp time has it.
  Bench fast;
  fast.table(one_to_one());
  fast.set("cam_gear.j_vel_sync", 1e9);
  fast.set("dynamik.tr_min", 100'000);
  fast.start_master();
  fast.couple(turning);
  EXPECT_NEAR(fast.s().set().acceleration / cycle_s, 5'000 / 0.1 * increments_per_acceleration, 1);
  covers({"cam_gear.j_vel_sync", "dynamik.tr_max", "dynamik.tr_min", "dynamik.a_max"});
}

TEST(PlcopenRampIn, ARampTimeOfOneCycleIsAStepOfAcceleration) {
  Bench b;
  b.table(one_to_one());
  b.set("dynamik.tr_min", 1'000);
  b.set("cam_gear.j_vel_sync", 2e9);
  b.start_master();
  b.couple(turning);
  EXPECT_NEAR(b.s().set().acceleration, 10'000 * increments_per_acceleration, 1);
}

TEST(PlcopenRampIn, TheSlavesSpeedLimitHoldsInTheCouplingToo) {
  Bench b;
  b.table({0, 1'000'000}, 3, Interpolation::step_direct);
  b.set("cam_gear.v_max_slave", 200'000);
  b.start_master();
  b.engage(hli_ci_f_periodic);
  double most = 0;
  double furthest = 0;
  double last = b.at(b.s());
  for (int i = 0; i < 1'000; ++i) {
    b.step();
    most = std::max(most, std::abs(b.at(b.s()) - last) / cycle_s);
    last = b.at(b.s());
    furthest = std::max(furthest, b.s().set().position.part);
  }
  EXPECT_NEAR(most, 200'000 * increments_per_speed, 1);
  covers({"cam_gear.v_max_slave", "STEP_DIRECT"});
}

TEST(PlcopenRampIn, CoupledNeitherOverrideNorFeedHoldActOnTheSlave) {
  Turning b;
  b.engage(turning);
  b.s().control.override_percent = 10;
  b.s().control.feed_hold = true;
  b.step(100);
  EXPECT_DOUBLE_EQ(b.s().set().velocity, b.m().set().velocity);
}

TEST(PlcopenRampIn, ALinearSlaveStopsBeforeItsSoftwareLimitWhileEngaging) {
  AxisParameters linear = Bench::linear_axis(-10'000, 2'000'000);
  Bench b(linear);
  // The cam stays inside, but its speed carries the slave out before it is in phase.
  b.table({100'000, 1'900'000});
  b.cam.MasterScaling = 3;
  b.start_master();
  b.couple();
  ASSERT_GE(b.until([&] { return b.s().state() == AxisState::errorstop; }), 0);
  EXPECT_EQ(b.s().error(), ErrorId::software_limit);
  ASSERT_GE(b.until([&] { return b.s().set().velocity == 0; }), 0);
  EXPECT_LE(b.s().set().position.part, 2'000'000);
  EXPECT_GE(b.s().set().position.part, -10'000);
  // A cam that leaves the range by itself is refused.
  Bench c(linear);
  c.table({100'000, 2'100'000});
  c.couple();
  EXPECT_EQ(c.cam.ErrorID, static_cast<unsigned>(ErrorId::software_limit));
  covers({"65005", "kenngr.swe_neg", "kenngr.swe_pos", "MC_CamIn.MasterScaling", "modulo"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
