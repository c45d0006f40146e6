#include <random>

#include "devices/oopos2/movement.hpp"
#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

// Laws that hold whatever a program does.
class Oopos2Random : public Oopos2Test, public testing::WithParamInterface<int> {
 protected:
  Oopos2Random() : Oopos2Test(1 + GetParam() % 20) {}

  std::mt19937 random{static_cast<std::uint32_t>(GetParam())};
  int pick(int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  }

  /// A write of any variable but `never`: in its range, or now and then anything.
  void any_write(std::string_view never = "") {
    const auto& rows = oopos2_type.variables;
    const DeviceVariable& row = rows[random() % rows.size()];
    if (row.name == never) return;
    const int low = static_cast<int>(std::max(row.min, -9999.0));
    const int high = static_cast<int>(std::min(row.max, 9999.0));
    const int small = std::max(low, std::min(high, 200));  // short times and ways: more happens
    write(row.name, pick(0, 30) == 0  ? static_cast<std::int32_t>(random())
                    : pick(0, 3) != 0 ? pick(std::min(low, 0), small)
                                      : pick(low, high));
  }
  void any_command() { device->command(pick(0, static_cast<int>(oopos2_type.commands.size()) - 1)); }
  void any_edge() {
    if (pick(0, 20) == 0) enable() = !enable();
    if (pick(0, 50) == 0) device->interrupt(zero_line, true);
  }
};

INSTANTIATE_TEST_SUITE_P(Oopos2, Oopos2Random, testing::Range(0, 20));

TEST_P(Oopos2Random, OutputsAgreeAndNeverBothDirections) {
  int moved = 0;
  does("INIT");
  for (int i = 0; i < 8000; ++i) {
    if (pick(0, 3) == 0) any_write();
    if (pick(0, 5) == 0) any_command();
    any_edge();
    if (pick(0, 3000) == 0) device->power_up();
    does("+1 forget");
    const bool forward = get("st_movfwd") == 1;
    const bool backward = get("st_movbwd") == 1;
    ASSERT_FALSE(forward && backward);
    ASSERT_FALSE((forward || backward) && get("st_still") == 1);
    moved += forward || backward;
    if (get("st_init") == 0 || get("st_regoff") == 1) {
      ASSERT_FALSE(output(1) || output(2) || output(4) || output(5));
      continue;
    }
    ASSERT_EQ(output(1), forward);
    ASSERT_EQ(output(2), backward);
    ASSERT_EQ(output(4), forward || backward);
    ASSERT_EQ(output(3), get("st_movdir") == 1);
    ASSERT_TRUE(!(forward || backward) || output(3) == backward);
    ASSERT_EQ(output(5), get("st_movslow") == 1);
    ASSERT_EQ(output(6), (get("breaktype") != 1) == (get("st_still") == 1));
    shows("actiner>-1 actiner<8");
  }
  EXPECT_GT(moved, 100);
}

TEST_P(Oopos2Random, TinvtLiesBetweenTheDirections) {
  const int tinvt = pick(1, 60);
  write("tinvt", tinvt);
  does("INIT");
  int turns = 0;
  int off_ms[2] = {1 << 20, 1 << 20};  // since each direction was on
  for (int i = 0; i < 8000; ++i) {
    if (pick(0, 5) == 0) any_write("tinvt");
    if (pick(0, 5) == 0) any_command();
    any_edge();
    does("+1 forget");
    for (int& ms : off_ms) ms += device->period_ms();
    for (const int direction : {0, 1}) {
      if (get(direction == 0 ? "st_movfwd" : "st_movbwd") == 0) continue;
      // The other went off a sample after it was on for the last time.
      ASSERT_GE(off_ms[1 - direction] - device->period_ms(), tinvt * 10);
      turns += off_ms[direction] > off_ms[1 - direction] && off_ms[1 - direction] < 1 << 19;
      off_ms[direction] = 0;
    }
  }
  EXPECT_GT(turns, 0);
}

TEST_P(Oopos2Random, EveryStopEndsWithinToldly) {
  Movement movement;
  for (int i = 0; i < 3000; ++i) {
    movement.times = {pick(0, 300), pick(0, 300), pick(0, 300), pick(0, 300)};
    const auto leg = [&] {
      return Leg{pick(0, 1) == 1, pick(0, 1) == 1, pick(0, 1) == 1, pick(-5000, 5000), pick(-50, 300)};
    };
    if (movement.phase() == MovementPhase::still && pick(0, 1) == 0)
      movement.place(pick(0, 1) == 0 ? std::optional(leg()) : std::nullopt, leg());
    else
      movement.run(leg());
    for (int n = pick(0, 200); n > 0; --n) {
      movement.tick(period);
      movement.step(pick(-6000, 6000), pick(0, 500));
      ASSERT_GE(movement.timer_ms(), 0);
      ASSERT_EQ(movement.outputs().braked, movement.phase() == MovementPhase::still);
    }
    if (movement.phase() == MovementPhase::still || movement.phase() == MovementPhase::tolerance) continue;
    movement.stop();
    ASSERT_FALSE(movement.running());
    int ms = 0;
    for (; movement.phase() != MovementPhase::still; ms += period) {
      ASSERT_LE(ms, movement.times.tolerance + period);
      movement.tick(period);
      movement.step(0, 0);
    }
    ASSERT_GE(ms, movement.times.tolerance);
  }
}

// Whatever the way, the axis and the recovery: once the inertia is known, placements hit to a slow step.
TEST_P(Oopos2Random, PlacementsHitOnceTheInertiaIsKnown) {
  slow = pick(1, 6);
  fast = pick(10, 40);
  coast = pick(0, 30);
  set({{"inertmode", 2},
       {"toldly", 50},
       {"slowdly", pick(0, 30)},
       {"tbrake", pick(0, 30)},
       {"tinvt", pick(50, 99)},
       {"bklashmode", pick(0, 4)},
       {"overpos", pick(60, 150)},
       {"slowpos", pick(150, 400)},
       {"tollp", slow * 20},
       {"tolln", slow * 20},
       {"enstol", 1}});
  does("INIT");
  place(1000);
  for (int i = 0; i < 20; ++i) {
    const int quota = (i % 2 == 0 ? -1 : 1) * pick(1000, 5000);
    place(quota);
    EXPECT_LE(std::abs(get("posit") - quota), 2 * slow) << i;
    EXPECT_EQ(get("st_toll"), 1) << i;
  }
}

TEST_P(Oopos2Random, TheSameProgramGivesTheSameBytes) {
  std::string traces[2];
  for (std::string& trace : traces) {
    Cards other;
    const auto twin = make_oopos2(terminals_of("10 2.CNT01 X X 2.OUT01 X X X X X"), other);
    std::mt19937 same(static_cast<std::uint32_t>(GetParam()));
    twin->command(0);
    for (int i = 0; i < 2000; ++i) {
      if (same() % 7 == 0) twin->command(static_cast<int>(same() % oopos2_type.commands.size()));
      other.counters.begin()->second.count += static_cast<int>(same() % 21) - 10;
      twin->sample();
      for (const State& state : oopos2_type.states)
        trace += static_cast<char>('0' + value_of(*twin, state.name));
      trace += std::to_string(value_of(*twin, "vel"));
    }
    for (const std::string& text : said_by(*twin)) trace += text;
  }
  EXPECT_EQ(traces[0], traces[1]);
}

}  // namespace
}  // namespace drycut::devices::oopos2
