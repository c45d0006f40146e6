// Instructions that take time: closed forms of the scan, of reaction and of the watchdog.
#include <gmock/gmock.h>

#include <string>

#include "devices/lx3vp/lx3vp_controller.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::HasSubstr;

constexpr std::int64_t us = 1000;

struct TimedPlc {
  Lx3vpController controller;
  std::int64_t now = 0;

  TimedPlc(const std::string& text, std::int64_t scan_ns, std::int64_t step_ns)
      : controller(compiled(text), scan_ns, step_ns) {
    controller.offer({devices::Kind::input, 0, 0});
    controller.offer({devices::Kind::output, 0, 0});
    controller.offer({devices::Kind::output, 0, 1});
  }
  static il::IlProgram compiled(const std::string& text) {
    Problems problems;
    auto program = il::compile(text, "test.il", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return program;
  }
  void step() {
    controller.run_devices(now);
    controller.run_tasks(now);
    now += tick_ns;
  }
  void until(std::int64_t time_ns) {
    while (now <= time_ns) step();
  }
  bool& input() { return controller.cards().inputs.at({devices::Kind::input, 0, 0}).level; }
  bool output(int number = 0) {
    return controller.cards().outputs.at({devices::Kind::output, 0, number}).level;
  }
  double get(const std::string& name) { return controller.find(name).value().read(); }
};

TEST(Lx3vpStepTime, OutputsComeAtTheEndOfTheScan) {
  // LD, OUT, LD, MOV, END: 5 instructions.
  TimedPlc plc("LD M8000\nOUT Y0\nLD M8000\nMOV K7 D0\nEND\n", 10'000 * us, 500 * us);
  plc.until(1900 * us);
  EXPECT_EQ(plc.get("D0"), 0);
  plc.until(2000 * us);
  EXPECT_EQ(plc.get("D0"), 7);  // each instruction acts on the registers at its end
  plc.until(2400 * us);
  EXPECT_FALSE(plc.output());
  plc.until(2500 * us);
  EXPECT_TRUE(plc.output());
}

// Inputs are taken as a scan begins: a change is answered after the scan that takes it.
TEST(Lx3vpStepTime, ReactionLiesBetweenAScanAndAScanMore) {
  struct Row {
    std::int64_t scan, step;
  };
  for (const Row& row : {Row{2000 * us, 100 * us}, Row{1000 * us, 500 * us}}) {
    const std::int64_t work = 3 * row.step;  // LD, OUT, END
    const std::int64_t scan = std::max(row.scan, work);
    std::int64_t best = 10 * scan;
    std::int64_t worst = 0;
    for (std::int64_t phase = 0; phase < scan; phase += tick_ns) {
      TimedPlc plc("LD X0\nOUT Y0\nEND\n", row.scan, row.step);
      plc.until(30'000 * us + phase);
      const std::int64_t on = plc.now;
      plc.input() = true;
      while (!plc.output()) plc.step();
      best = std::min(best, plc.now - tick_ns - on);
      worst = std::max(worst, plc.now - tick_ns - on);
    }
    EXPECT_EQ(best, work);
    EXPECT_EQ(worst, scan + work - tick_ns);
  }
}

TEST(Lx3vpStepTime, AScanThatIsLongerThanItsPeriodIsFollowedAtOnce) {
  TimedPlc plc("LD M8000\nINC D0\nEND\n", 1000 * us, 700 * us);
  plc.until(21'000 * us);
  EXPECT_EQ(plc.get("D0"), 10);     // 2.1 ms each
  EXPECT_EQ(plc.get("D8010"), 21);  // 0.1 ms
  TimedPlc fits("LD M8000\nINC D0\nEND\n", 1000 * us, 100 * us);
  fits.until(21'000 * us);
  EXPECT_EQ(fits.get("D0"), 21);  // the 22nd has begun
  EXPECT_EQ(fits.get("D8010"), 10);
}

TEST(Lx3vpStepTime, AWordThatIsMovedTakesAsLong) {
  // LD, FMOV with 100 words, LD, OUT, END.
  TimedPlc plc("LD M8000\nFMOV K1 D0 K100\nLD M8000\nOUT Y0\nEND\n", 1000 * us, 10 * us);
  plc.until(1040 * us);
  EXPECT_FALSE(plc.output());
  plc.until(1100 * us);  // 105 steps are 1.05 ms
  EXPECT_TRUE(plc.output());
}

TEST(Lx3vpStepTime, TheWatchdogActsAfter200Ms) {
  const std::string endless = "P0\nLD M8000\nINC D0\nCJ P0\nEND\n";
  TimedPlc plc(endless, 1000 * us, 100 * us);
  plc.until(199'900 * us);
  EXPECT_FALSE(plc.controller.has_events());
  plc.until(200'200 * us);
  const auto events = plc.controller.take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_THAT(events[0].text, HasSubstr("6105"));
  EXPECT_EQ(plc.get("D8061"), 6105);
  // Until it is switched on anew; then it scans again, in its own time.
  plc.controller.power(false);
  plc.until(210'050 * us);
  plc.controller.power(true);
  plc.until(300'000 * us);
  EXPECT_FALSE(plc.controller.has_events());
  plc.until(420'000 * us);
  EXPECT_TRUE(plc.controller.has_events());
}

TEST(Lx3vpStepTime, PowerOffForgetsTheScanUnderWay) {
  TimedPlc plc("LD M8000\nMOV K7 D0\nOUT Y0\nEND\n", 10'000 * us, 1000 * us);
  plc.until(2500 * us);
  EXPECT_EQ(plc.get("D0"), 7);
  plc.controller.power(false);
  plc.until(14'000 * us);
  EXPECT_FALSE(plc.output());
  plc.controller.power(true);
  plc.until(21'900 * us);
  EXPECT_EQ(plc.get("D0"), 0);
  plc.until(24'000 * us);  // a scan from 20 ms on
  EXPECT_EQ(plc.get("D0"), 7);
  EXPECT_TRUE(plc.output());
}

// As fast as can be, a scan does what it does without time, one tick later.
TEST(Lx3vpStepTime, OfANanosecondIsAsNone) {
  const std::string text =
      "LD X0\nOUT T0 K3\nLD T0\nOUT Y0\nLDP X0\nINC D0\nLD M8012\nOUT Y1\nLD M8000\nFMOV D0 D10 K4\nEND\n";
  TimedPlc none(text, 1000 * us, 0);
  TimedPlc little(text, 1000 * us, 1);
  for (int i = 0; i < 10'000; ++i) {
    none.input() = little.input() = i % 7777 > 300 && i % 5000 < 4500;
    none.step();
    little.step();
    if (i % 10 == 0) continue;
    for (const char* name : {"D0", "D13", "T0"}) ASSERT_EQ(none.get(name), little.get(name)) << name << i;
    ASSERT_EQ(none.output(), little.output()) << i;
    ASSERT_EQ(none.output(1), little.output(1)) << i;
  }
  EXPECT_GT(none.get("D0"), 1);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
