#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/plants/drive_stand.hpp"

namespace drycut::plants {
namespace {

TEST(DelayedContact, FollowsToTheStepAndSwallowsShortCommands) {
  DelayedContact contact(20e-3, 15e-3);
  const auto steps_until = [&](bool command, bool wanted) {
    int n = 0;
    while (contact.update(command, h) != wanted) ++n;
    return n;
  };
  EXPECT_EQ(steps_until(true, true), 200);
  EXPECT_EQ(steps_until(false, false), 150);
  for (int i = 0; i < 199; ++i) EXPECT_FALSE(contact.update(true, h));
  for (int i = 0; i < 500; ++i) EXPECT_FALSE(contact.update(false, h));
  EXPECT_EQ(steps_until(true, true), 200);  // the swallowed command has left nothing behind
  DelayedContact immediate(0, 0);
  EXPECT_TRUE(immediate.update(true, h));
  EXPECT_FALSE(immediate.update(false, h));
}

TEST(DelayedContact, ItsDelaysScatterAboutTheirMeansAndAreNeverNegative) {
  const auto delays = [](double scatter, std::uint64_t seed) {
    DelayedContact contact(20e-3, 15e-3, scatter);
    Random random(seed);
    std::vector<int> closing;
    std::vector<int> opening;
    for (int i = 0; i < 1000; ++i)
      for (const bool close : {true, false}) {
        int steps = 0;
        while (contact.update(close, h, &random) != close) ++steps;
        (close ? closing : opening).push_back(steps);
      }
    return std::pair(closing, opening);
  };
  const auto [closing, opening] = delays(1e-3, 1);
  EXPECT_NEAR(mean_of(closing), 200, 1);  // three standard errors
  EXPECT_NEAR(mean_of(opening), 150, 1);
  EXPECT_NEAR(deviation_of(closing), 10, 0.7);
  EXPECT_NEAR(deviation_of(opening), 10, 0.7);
  EXPECT_EQ(delays(1e-3, 1), std::pair(closing, opening));
  EXPECT_NE(delays(1e-3, 2), std::pair(closing, opening));
  EXPECT_EQ(delays(0, 1).first, std::vector<int>(1000, 200));
  // 15 ms with a scatter of 30: three of ten would follow before their command.
  const auto wide = delays(30e-3, 1).second;
  EXPECT_NEAR(static_cast<double>(std::ranges::count(wide, 0)) / 1000, 0.31, 0.05);
}

TEST(DelayedContact, StuckContacts) {
  DelayedContact contact(0, 0);
  std::vector<Fault> faults;
  contact.offer_faults(faults, "k");
  fault(faults, "k", "stuck_on", 1);
  EXPECT_TRUE(contact.update(false, h));
  fault(faults, "k", "stuck_on", 0);
  EXPECT_FALSE(contact.update(false, h));
  fault(faults, "k", "stuck_off", 1);
  EXPECT_FALSE(contact.update(true, h));
  fault(faults, "k", "stuck_off", 0);
  EXPECT_TRUE(contact.update(true, h));
}

TEST(Winding, PassesThroughItsDataSheet) {
  const WindingData data;
  const Winding winding(data);
  EXPECT_NEAR(winding.torque(sync - data.rated_speed), data.rated_torque, 1e-9);
  EXPECT_NEAR(winding.torque(winding.pullout_slip()), data.pullout_torque, 1e-9);
  EXPECT_NEAR(winding.torque(sync), kloss(data, sync), 1e-9);  // at standstill
  for (const double torque : {-39.0, -5.0, 0.0, 1.0, 14.8, 40.0})
    EXPECT_NEAR(winding.torque(winding.slip(torque)), torque, 1e-9);
  EXPECT_EQ(winding.slip(100), winding.pullout_slip());
  EXPECT_EQ(winding.single_phase_torque(sync, 0), 0);
  const double slip = sync - data.rated_speed;
  EXPECT_NEAR(winding.single_phase_torque(sync, data.rated_speed),
              (kloss(data, slip) - kloss(data, sync + data.rated_speed)) / 2, 1e-9);
}

TEST(ContactorDrive, ClosesAndOpensAfterItsDelays) {
  ContactorStand stand;
  stand.drive.forward.level = true;
  stand.run(20e-3);
  EXPECT_EQ(stand.rotor.speed, 0);
  stand.step();
  EXPECT_NEAR(stand.drive.torque(), kloss(WindingData{}, sync), 1e-9);  // locked rotor
  stand.run(2);
  EXPECT_NEAR(stand.rotor.speed, sync, 1e-6);
  EXPECT_EQ(stand.drive.frequency(), 50);
  stand.load = 14.8;
  stand.run(1);
  EXPECT_NEAR(stand.rotor.speed * rpm, 1420, 1e-6);
  stand.drive.forward.level = false;
  stand.run(15e-3);
  EXPECT_NEAR(stand.rotor.speed * rpm, 1420, 1e-6);
  stand.step();
  EXPECT_NEAR(stand.rotor.speed * rpm, 1420 - 14.8 / 0.05 * h * rpm, 1e-6);
  EXPECT_EQ(stand.drive.state(), ContactorDrive::State::off);
}

TEST(ContactorDrive, TheSlowWindingBrakesAFastMotor) {
  ContactorStand stand;
  stand.drive.backward.level = true;
  stand.run(3);
  stand.drive.slow.level = true;
  stand.run(20.1e-3);
  const ContactorData data;
  EXPECT_NEAR(stand.drive.torque(), -kloss(data.slow, 375 / rpm - sync), 1e-6);
  EXPECT_GT(stand.drive.torque(), 0);
  stand.run(3);
  EXPECT_NEAR(stand.rotor.speed * rpm, -375, 1e-6);
  fault(stand.faults(), "drive.slow", "stuck_off", 1);
  stand.run(3);
  EXPECT_NEAR(stand.rotor.speed * rpm, -1500, 1e-6);
  fault(stand.faults(), "drive.slow", "stuck_off", 0);
  fault(stand.faults(), "drive.slow", "stuck_on", 1);
  stand.drive.slow.level = false;
  stand.run(3);
  EXPECT_NEAR(stand.rotor.speed * rpm, -375, 1e-6);
}

TEST(ContactorDrive, BetweenSlowAndFastItHasNoTorque) {
  ContactorStand stand;
  stand.drive.forward.level = stand.drive.slow.level = true;
  stand.run(2);
  stand.drive.slow.level = false;
  stand.run(15e-3);
  EXPECT_NEAR(stand.drive.field_speed() * rpm, 375, 1e-9);
  for (int i = 0; i < 200; ++i) {
    stand.step();
    EXPECT_EQ(stand.drive.torque(), 0);
  }
  stand.step();
  EXPECT_NEAR(stand.drive.torque(), kloss(WindingData{}, sync - 375 / rpm), 0.1);
}

TEST(ContactorDrive, BothDirectionsTripTheBreakerUntilItIsReset) {
  ContactorStand stand;
  stand.drive.forward.level = true;
  stand.run(1);
  fault(stand.faults(), "drive.backward", "stuck_on", 1);
  stand.step();
  EXPECT_EQ(stand.drive.state(), ContactorDrive::State::tripped);
  fault(stand.faults(), "drive.backward", "stuck_on", 0);
  const double speed = stand.rotor.speed;
  stand.run(1);
  EXPECT_EQ(stand.rotor.speed, speed);
  fault(stand.faults(), "drive", "trip", 0);
  stand.run(1);
  EXPECT_NEAR(stand.rotor.speed, sync, 1e-3);
}

TEST(ContactorDrive, WithAPhaseLostItRunsButDoesNotStart) {
  ContactorStand stand;
  fault(stand.faults(), "drive", "phase_lost", 1);
  stand.drive.forward.level = true;
  stand.run(2);
  EXPECT_EQ(stand.rotor.speed, 0);
  fault(stand.faults(), "drive", "phase_lost", 0);
  stand.load = 5;
  stand.run(2);
  fault(stand.faults(), "drive", "phase_lost", 1);
  const double sound = stand.rotor.speed;
  stand.run(2);
  EXPECT_LT(stand.rotor.speed, sound - 1);  // about twice the slip
  EXPECT_GT(stand.rotor.speed, 0.9 * sync);
  const WindingData w;
  EXPECT_NEAR((kloss(w, sync - stand.rotor.speed) - kloss(w, sync + stand.rotor.speed)) / 2, 5, 1e-6);
}

/// The events of a drive that tell that its motor was pulled out.
template <class AnyStand>
std::vector<MachineEvent> pulled_out(AnyStand& stand) {
  auto events = stand.drive.power().take_events();
  std::erase_if(events, [](const MachineEvent& event) { return event.name != "pulled_out"; });
  return events;
}

TEST(ContactorDrive, ToPassThePullOutTorqueIsPartOfEachStart) {
  ContactorStand stand;
  stand.load = 10;
  stand.drive.forward.level = true;
  stand.run(3);  // it begins beyond the pull-out slip
  stand.drive.slow.level = true;
  stand.run(3);  // and so does braking by the slow winding
  stand.drive.slow.level = stand.drive.forward.level = false;
  stand.drive.backward.level = true;
  stand.load = -10;
  stand.run(5);
  EXPECT_NEAR(stand.rotor.speed, -sync, 10);
  EXPECT_TRUE(pulled_out(stand).empty());
}

TEST(ContactorDrive, AMotorThatLosesItsLoadIsPulledOutOnce) {
  ContactorStand stand;
  stand.load = 10;
  stand.drive.forward.level = true;
  stand.run(2);
  stand.load = 45;  // 40 N m is all that it has
  stand.run(3);
  const auto stalled = pulled_out(stand);
  ASSERT_EQ(stalled.size(), 1U);
  EXPECT_EQ(stalled[0].values[0].name, "speed");
  EXPECT_LT(stalled[0].values[0].number, 1500 - pullout_slip(WindingData{}) * rpm);
  EXPECT_EQ(stalled[0].values[1].name, "slip");
  EXPECT_NEAR(stalled[0].values[0].number + stalled[0].values[1].number, 1500, 1);

  // The slow winding shall brake a load that drives the motor, and cannot.
  ContactorStand driven;
  driven.drive.forward.level = true;
  driven.run(2);
  driven.drive.slow.level = true;
  driven.load = -38;
  driven.run(0.2);
  EXPECT_GT(driven.rotor.speed, sync);
  EXPECT_EQ(pulled_out(driven).size(), 1U);

  // It stands, as where a brake does not open; who is slow only is none.
  ContactorStand held({}, 1e9);
  held.drive.forward.level = true;
  held.run(1);
  EXPECT_TRUE(pulled_out(held).empty());
  const auto hold = [&](double time) {
    for (long i = std::lround(time / h); i > 0; --i) {
      held.load = held.drive.torque();
      held.step();
    }
  };
  hold(1);
  EXPECT_EQ(pulled_out(held).size(), 1U);
}

}  // namespace
}  // namespace drycut::plants
