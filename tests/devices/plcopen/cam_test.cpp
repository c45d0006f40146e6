#include <gtest/gtest.h>

#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

TEST(PlcopenCam, OffsetsAndScalingsAreThoseOfTheTransform) {
  Bench b;
  b.table({0, 300'000, 800'000, 200'000}, 3, Interpolation::polynom_3);
  b.cam.MasterScaling = -2;
  b.cam.MasterOffset = 123'456;
  b.cam.SlaveScaling = 0.75;
  b.cam.SlaveOffset = -50'000;
  b.run.Velocity = 90'000;
  b.start_master();
  b.engage();
  const CamCurve& curve = b.s().coupling()->cam()->curve;
  for (int i = 0; i < 500; ++i) {
    b.step();
    double x = std::fmod(-2 * b.m().set().position.part + 123'456, turn);
    if (x < 0) x += turn;
    const CamMotion cam = at(curve, x);
    EXPECT_NEAR(shortest(b.s().set().position, {0, 0.75 * cam.position - 50'000}, turn), 0, 1e-6);
    EXPECT_NEAR(b.s().set().velocity, 0.75 * cam.velocity * -2 * b.m().set().velocity, 1e-3);
  }
  covers("MC_CamIn", {"MasterOffset", "MasterScaling", "SlaveScaling", "SlaveOffset"});
}

TEST(PlcopenCam, ThePositionIsExactHoweverManyTurnsThereWere) {
  // The law itself, at a master that has made ten million turns and comes to the same part of one.
  const McCamTable table{.file = {}, .name = {}, .id = 1, .type = 3, .values = {0, 1'000'000, 2'500'000}};
  const CamCurve curve = curve_of(table, Interpolation::linear, turn, turn, Endless::positive);
  Coupling coupling(CamFollow{.curve = curve}, turn);
  Coupling engaged(CamFollow{.curve = curve}, turn);
  const double part = 1'234'567.25;
  AxisMotion slave{{0, at(curve, part).position}, 0, 0};
  engaged.take_over(
      [&] {
        Coupling before(CamFollow{.curve = curve}, turn);
        CouplingLimits wide{1, 1e9, 0, 1, false, 1e12, 1e9, 1e9, {1e9, 1e12, 1e12, 1e15}, 1e18, 1e18};
        for (int i = 0; i < 10; ++i) before.step({{0, part}, 0, 0}, slave, 0.002, wide);
        EXPECT_TRUE(before.engaged());
        return before;
      }(),
      {{0, part}, 0, 0}, slave, 1);
  ASSERT_TRUE(engaged.engaged());
  const CouplingLimits free{1, 0, 0, 1, false, 1e9, 1e9, 1e9, {1, 1, 1, 1}, 1e30, 1e30};
  engaged.step({{10'000'000, part}, 0, 0}, slave, 0.002, free);
  EXPECT_EQ(slave.position.turns, 10'000'000);
  EXPECT_EQ(slave.position.part, at(curve, part).position);
}

TEST(PlcopenCam, WithoutThePeriodicBitThereIsOnePassFromZeroToZero) {
  Bench b;
  b.table({100'000, 700'000, 900'000}, 3, Interpolation::polynom_3);
  b.start_master();
  b.couple(0);
  // It is drawn to the start at once and waits there.
  ASSERT_GE(b.until([&] { return b.s().coupling() && b.phase() == CouplingPhase::wait_zero; }), 0);
  EXPECT_EQ(b.s().set().position.part, 100'000);
  EXPECT_FALSE(b.cam.InSync);
  const std::int64_t before = b.m().set().position.turns;
  ASSERT_GE(b.until([&] { return b.cam.InSync; }), 0);
  EXPECT_EQ(b.m().set().position.turns, before + 1);
  const CamCurve curve = b.s().coupling()->cam()->curve;
  int cycles = 0;
  while (!b.cam.EndOfProfile) {
    if (b.s().state() == AxisState::synchronized_motion) {
      EXPECT_NEAR(b.s().set().position.part, at(curve, b.m().set().position.part).position, 1e-6);
    }
    b.step();
    ASSERT_LT(++cycles, 600);
  }
  EXPECT_NEAR(cycles, 500, 2);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
  EXPECT_EQ(b.s().set().position.part, 100'000);
  EXPECT_EQ(b.s().set().velocity, 0);
  EXPECT_FALSE(b.cam.InSync);
  EXPECT_FALSE(b.cam.CommandAborted);
  b.step();
  EXPECT_FALSE(b.cam.EndOfProfile);
  b.step(1'000);
  EXPECT_EQ(b.s().set().position.part, 100'000);
  covers({"MC_CamIn.EndOfProfile", "HLI_CI_F_PERIODIC", "MC_CamIn.InSync"});
}

TEST(PlcopenCam, AnotherExecuteDuringThePassAddsOnePassAndNoMore) {
  Turning b;
  b.engage(hli_ci_endless_positive);
  const std::int64_t turns = b.s().set().position.turns;
  for (int i = 0; i < 3; ++i) {
    b.couple(hli_ci_endless_positive);
    b.step(10);
  }
  int ends = 0;
  for (int i = 0; i < 3'000; ++i) {
    b.step();
    if (b.cam.EndOfProfile) ++ends;
  }
  EXPECT_EQ(ends, 2);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
  EXPECT_EQ(b.s().set().position.turns, turns + 2);
  EXPECT_EQ(b.s().set().position.part, 0);
  // And it goes again, at once in place.
  b.couple(hli_ci_endless_positive);
  EXPECT_EQ(b.phase(), CouplingPhase::wait_zero);
  ASSERT_GE(b.until([&] { return b.cam.EndOfProfile; }), 0);
  EXPECT_EQ(b.s().set().position.turns, turns + 3);
}

TEST(PlcopenCam, BackwardsTheOnePassIsTheTableBackwards) {
  Bench b;
  b.table(one_to_one());
  b.run.Direction = 3;
  b.start_master();
  b.engage(hli_ci_endless_positive);
  const std::int64_t turns = b.s().set().position.turns;
  b.step(100);
  EXPECT_NEAR(shortest(b.s().set().position, b.m().set().position, turn), 0, 1e-6);
  ASSERT_GE(b.until([&] { return b.cam.EndOfProfile; }), 0);
  EXPECT_EQ(b.s().state(), AxisState::standstill);
  EXPECT_LE(b.s().set().position.turns, turns);
  EXPECT_EQ(b.s().set().position.part, 0);
  covers({"MC_MoveVelocity.Direction"});
}

TEST(PlcopenCam, AMasterExactlyAtZeroStartsThePassAtOnce) {
  Bench b;
  b.table({0, 500'000});
  ASSERT_EQ(b.m().set().position.part, 0);
  b.couple(0);
  EXPECT_EQ(b.phase(), CouplingPhase::coupled);
  b.start_master();
  ASSERT_GE(b.until([&] { return b.cam.EndOfProfile; }), 0);
  EXPECT_EQ(b.m().set().position.turns, 1);
}

TEST(PlcopenCam, PeriodicallyTheEndIsToldAtEveryTurn) {
  Turning b;
  b.engage(hli_ci_f_periodic | hli_ci_endless_positive);
  int ends = 0;
  for (int i = 0; i < 2'500; ++i) {
    b.step();
    if (b.cam.EndOfProfile) ++ends;
  }
  EXPECT_EQ(ends, 5);
  EXPECT_TRUE(b.cam.InSync);
}

TEST(PlcopenCam, EndlessNegativeTurnsTheSlaveBackwards) {
  Bench b;
  b.table({0, 2'700'000, 1'800'000, 900'000});
  b.start_master();
  b.engage(hli_ci_f_periodic | hli_ci_endless_negative);
  const std::int64_t slave = b.s().set().position.turns;
  const std::int64_t master = b.m().set().position.turns;
  b.step(5'000);
  EXPECT_EQ(b.s().set().position.turns - slave, -(b.m().set().position.turns - master));
  EXPECT_DOUBLE_EQ(b.s().set().velocity, -b.m().set().velocity);
  covers({"HLI_CI_ENDLESS_NEGATIVE"});
}

TEST(PlcopenCam, RampInAbsoluteAndRelativeBitsChangeNothing) {
  std::vector<double> ends;
  for (const std::uint32_t bits : {0u, 1u, 2u, 4u, 7u}) {
    Turning b;
    b.couple(turning | bits);
    b.step(700);
    EXPECT_TRUE(b.cam.InSync);
    ends.push_back(b.at(b.s()));
  }
  for (const double end : ends) EXPECT_EQ(end, ends[0]);
  covers({"HLI_CI_RAMP_IN", "HLI_CI_ABSOLUTE", "HLI_CI_RELATIVE"});
}

TEST(PlcopenCam, AWriteReachesARunningSlaveUnlessTheTableIsLocked) {
  Bench b;
  b.table({0, 100'000, 200'000, 100'000});
  b.engage();
  EXPECT_EQ(b.kernel.write_table(1, 0, 0, 70'000), ErrorId::none);
  b.step(4);  // no faster than vb_max
  EXPECT_EQ(b.s().set().position.part, 70'000);
  Bench c;
  c.table({0, 100'000, 200'000, 100'000});
  c.couple(hli_ci_f_periodic | hli_ci_lock_table);
  EXPECT_EQ(c.kernel.write_table(1, 0, 0, 70'000), ErrorId::table_locked);
  EXPECT_EQ(c.kernel.begin_table_change(1), ErrorId::table_locked);
  EXPECT_EQ(c.kernel.add_table(McCamTable{.file = {}, .name = {}, .id = 1, .type = 3, .values = {5}}),
            ErrorId::table_locked);
  auto out = c.make<McCamOut>();
  out.Execute = true;
  out.call(c.kernel);
  EXPECT_EQ(c.kernel.write_table(1, 0, 0, 70'000), ErrorId::none);
  covers({"240010", "HLI_CI_LOCK_TABLE"});
}

TEST(PlcopenCam, LinesAndQuinticsRunOnACopyUntilTheNextExecute) {
  Bench b;
  b.table(swing(), 7, Interpolation::poly5_line);
  b.cam.MasterOffset = 300'000;  // on the line of slope 0 between P0 and P1
  b.engage();
  EXPECT_EQ(b.kernel.write_table(1, 3, 1, 900'000), ErrorId::none);
  EXPECT_EQ(b.kernel.write_table(1, 2, 1, 900'000), ErrorId::none);
  b.step(5);
  EXPECT_EQ(b.s().coupling()->cam()->curve.pieces[2].begin().position, 1'800'000);
  // The new table is the same where the slave stands: it stays engaged.
  b.couple();
  EXPECT_EQ(b.phase(), CouplingPhase::coupled);
  b.step();
  EXPECT_TRUE(b.cam.InSync);
  EXPECT_EQ(b.s().coupling()->cam()->curve.pieces[2].begin().position, 900'000);
  covers({"POLY5_LINE", "type 7"});
}

TEST(PlcopenCam, AnotherTableElsewhereIsEngagedAnew) {
  Bench b;
  b.table({0, 100'000}, 3);
  b.table({900'000, 500'000}, 3, Interpolation::linear, 2);
  b.cam.CamTableID = 1;
  b.engage();
  b.cam.CamTableID = 2;
  b.couple();
  EXPECT_NE(b.phase(), CouplingPhase::coupled);
  ASSERT_GE(b.until([&] { return b.cam.InSync; }), 0);
  EXPECT_EQ(b.s().set().position.part, 900'000);
  covers({"MC_CamIn.CamTableID"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
