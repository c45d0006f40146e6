// Clamps and blade take hold of material that should run as fast as the carriage, and the line drive that
// keeps its speed.
#include "tests/plants/flying_saw_line.hpp"
#include "tests/plants/web_line.hpp"

namespace drycut::plants {
namespace {

/// A web at 30 m/min against which something pushes.
struct PushedWeb : WebLine {
  PushedWeb() : WebLine(data()) {}
  static WebData data() {
    WebData data;
    data.drive.speed = 0.5;
    return data;
  }
  void push(double newton, double seconds) {
    for (long i = std::lround(seconds / h); i > 0; --i) {
      web.material().add_force(-newton);
      step();
    }
  }
};

TEST(HeldBack, TellsThatTheLineDriveStandsAtItsLimitAndTheWebIsSlow) {
  PushedWeb line;
  line.push(2000, 0.2);
  const auto& held = line.only("held_back");
  EXPECT_EQ(value(held, "force"), 1500);
  EXPECT_LT(value(held, "speed"), 0.95 * 30);
  EXPECT_NEAR(value(held, "set_speed"), 30, 1e-9);
  // 200 000 N/m and 2800 N s/m: the limit is reached within some milliseconds.
  EXPECT_GT(line.times[0], 20e-3);
  EXPECT_LT(line.times[0], 40e-3);
  line.push(0, 1);
  EXPECT_EQ(line.events.size(), 1U) << "once";
  line.push(2000, 0.2);
  EXPECT_EQ(line.events.size(), 2U) << "and again";
}

TEST(HeldBack, IsNotToldWhereTheDriveHoldsOrTheWebHardlySlowsDown) {
  PushedWeb holds;
  holds.push(700, 0.5);
  EXPECT_TRUE(holds.events.empty());
  PushedWeb shortly;
  shortly.push(3000, 3e-3);
  shortly.push(0, 0.5);
  EXPECT_TRUE(shortly.events.empty());
  PushedWeb faster;
  faster.push(-2000, 0.2);
  EXPECT_TRUE(faster.events.empty()) << "it is pulled along, not held back";
}

TEST(HeldBack, IsAFailureThatNobodyHasToAskAbout) {
  PushedWeb line;
  SawLine saw(free_saw());
  std::vector<std::string> failures;
  for (auto* plant : {line.plant.get(), saw.plant.get()})
    for (const auto& type : plant->event_types())
      if (type.severity >= Severity::error) failures.emplace_back(type.name);
  EXPECT_THAT(failures, testing::IsSupersetOf({"held_back", "clamped_moving", "opened_early", "crash"}));
  EXPECT_THAT(failures, testing::Not(testing::Contains("cut")));
}

/// A tube at 30 m/min and a carriage at another speed [m/s].
struct MovingSaw : SawLine {
  explicit MovingSaw(double speed, double limit = 0.05) : SawLine(with(limit), tube(0.5)) {
    carriage().speed = speed;
  }
  static FlyingSawDefinition with(double limit) {
    auto saw = free_saw();
    saw.data.mismatch_limit = limit;
    return saw;
  }
};

TEST(ClampedMoving, TellsTheDifferenceAtWhichTheClampsGrip) {
  MovingSaw line(0);
  line.command("clamp", true);
  line.run(0.2);
  const auto& told = line.only("clamped_moving");
  EXPECT_NEAR(value(told, "difference"), -500, 0.1);
  EXPECT_EQ(value(told, "blade"), 0);
  EXPECT_NEAR(line.times[0], FlyingSawData().clamp.close_time, 2 * h);
}

TEST(ClampedMoving, IsNotToldWithinTheLimit) {
  MovingSaw line(0.49);
  line.command("clamp", true);
  line.run(0.2);
  EXPECT_TRUE(line.events.empty());
  MovingSaw strict(0.49, 5e-3);
  strict.command("clamp", true);
  strict.run(0.2);
  EXPECT_NEAR(value(strict.only("clamped_moving"), "difference"), -10, 0.1);
}

TEST(ClampedMoving, IsToldOfABladeThatComesInUnclamped) {
  MovingSaw line(0.4);
  line.command("head.plunge", true);
  while (line.events.empty() && line.steps < 5000) line.step();
  const auto& told = line.only("clamped_moving");
  EXPECT_NEAR(value(told, "difference"), -100, 0.1);
  EXPECT_EQ(value(told, "blade"), 1);
}

TEST(SawCut, MismatchAndSlipCountFromWhenTheClampsTakeHold) {
  // The clamps bring both to one speed before the blade touches.
  MovingSaw line(0);
  line.command("clamp", true);
  line.run(0.3);
  EXPECT_NEAR(line.read("mismatch"), 0, 1e-6);
  const double slip = std::abs(line.read("clamp.slip"));
  EXPECT_GT(slip, 0.1);
  line.command("head.plunge", true);
  line.run(0.5);
  ASSERT_EQ(line.events.size(), 2U);
  const MachineEvent& cut = line.events[1];
  ASSERT_EQ(cut.name, "cut");
  EXPECT_NEAR(value(cut, "mismatch"), 500, 0.1);
  EXPECT_NEAR(value(cut, "slip"), slip, 1e-6);
  // The next stroke begins anew.
  line.command("head.plunge", false);
  line.run(0.3);
  line.command("clamp", false);
  line.run(0.1);
  line.command("clamp", true);
  line.run(0.1);
  line.command("head.plunge", true);
  line.run(0.5);
  ASSERT_EQ(line.events.size(), 3U);
  EXPECT_LT(value(line.events[2], "mismatch"), 5);
  EXPECT_LT(value(line.events[2], "slip"), 0.01);
}

TEST(OpenedEarly, IsToldWhereTheClampsLetGoWithTheBladeInTheMaterial) {
  MovingSaw line(0.5);
  line.command("clamp", true);
  line.run(0.1);
  line.command("head.plunge", true);
  while (line.depth() < 0.03) line.step();
  line.command("clamp", false);
  line.run(0.03);
  const double depth = value(line.only("opened_early"), "depth");
  EXPECT_GT(depth, 10);
  EXPECT_LT(depth, 40);
}

}  // namespace
}  // namespace drycut::plants
