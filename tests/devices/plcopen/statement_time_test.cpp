// Statements that take time: when outputs come, tasks that are late, and that no time changes nothing.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "devices/plcopen/controller/controller.hpp"

namespace drycut::devices::plcopen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t us = 1000;
constexpr std::int64_t step_ns = 100 * us;

struct TimedRig {
  PlcopenController controller;
  std::int64_t now = 0;
  std::vector<ControllerEvent> events;

  TimedRig(const std::string& text, std::int64_t task_ns, std::int64_t statement_ns)
      : controller(compiled(text), "line.st", configuration(task_ns, statement_ns)) {}
  static PlcopenConfiguration configuration(std::int64_t task_ns, std::int64_t statement_ns) {
    PlcopenConfiguration made;
    made.cycle_ns = 1000 * us;
    made.task_ns = task_ns;
    made.statement_ns = statement_ns;
    return made;
  }
  static st::Program compiled(const std::string& text) {
    Problems problems;
    auto program = st::compile(text, "line.st", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return program;
  }
  void step() {
    controller.run_devices(now);
    controller.run_tasks(now);
    for (auto& event : controller.take_events()) events.push_back(std::move(event));
    now += step_ns;
  }
  void until(std::int64_t time_ns) {
    while (now <= time_ns) step();
  }
  bool& input() { return controller.cards().inputs.at({Kind::input, 0, 0}).level; }
  bool output(int bit = 0) { return controller.cards().outputs.at({Kind::output, 0, bit}).level; }
  double get(const std::string& name) { return controller.find(name).value().read(); }
  std::vector<std::string> overruns() {
    std::vector<std::string> tasks;
    for (const auto& event : events)
      if (event.event == "overrun") tasks.push_back(event.source);
    return tasks;
  }
};

const std::string follows =
    "PROGRAM m VAR start AT %IX0.0 : BOOL; lamp AT %QX0.0 : BOOL; n : DINT; END_VAR\n"
    "n := n + 1;\nlamp := start;\nEND_PROGRAM\n";

TEST(StStatementTime, ReactionLiesBetweenAScanAndAnIntervalMore) {
  for (const std::int64_t statement : {100 * us, 300 * us}) {
    const std::int64_t interval = 2000 * us;
    std::int64_t best = 10 * interval;
    std::int64_t worst = 0;
    for (std::int64_t phase = 0; phase < interval; phase += step_ns) {
      TimedRig rig(follows, interval, statement);
      rig.until(20'000 * us + phase);
      const std::int64_t on = rig.now;
      rig.input() = true;
      while (!rig.output()) rig.step();
      best = std::min(best, rig.now - step_ns - on);
      worst = std::max(worst, rig.now - step_ns - on);
    }
    EXPECT_EQ(best, 2 * statement);
    EXPECT_EQ(worst, interval + 2 * statement - step_ns);
  }
}

TEST(StStatementTime, StatementsAreCountedAsTheyAreExecuted) {
  struct Row {
    std::string body;
    int statements;
  };
  for (const Row& row : {
           Row{"lamp := TRUE;", 1},
           Row{"IF n = 0 THEN n := 1; n := 2; END_IF; lamp := TRUE;", 4},
           Row{"IF n = 1 THEN n := 1; n := 2; END_IF; lamp := TRUE;", 2},
           // FOR itself with its beginning, a round and its statement five times, the step each time.
           Row{"WHILE n < 5 DO n := n + 1; END_WHILE; lamp := TRUE;", 1 + 5 * 2 + 1},
           Row{"REPEAT n := n + 1; UNTIL n >= 3 END_REPEAT; lamp := TRUE;", 1 + 3 * 2 + 1},
           Row{"CASE n OF 0: n := 4; 1: n := 3; n := 2; END_CASE; lamp := TRUE;", 3},
       }) {
    TimedRig rig("PROGRAM m VAR lamp AT %QX0.0 : BOOL; n : DINT; END_VAR\n" + row.body + "\nEND_PROGRAM\n",
                 100'000 * us, step_ns);
    while (!rig.output() && rig.now < 90'000 * us) rig.step();
    EXPECT_EQ((rig.now - step_ns) / step_ns, row.statements) << row.body;
  }
}

TEST(StStatementTime, ATaskThatOverrunsItsIntervalIsToldAndStartsLate) {
  // 30 rounds of 2 and 1 more: 61 statements.
  const std::string text =
      "PROGRAM m VAR lamp AT %QX0.0 : BOOL; n, i : DINT; long : BOOL := TRUE; END_VAR\n"
      "n := n + 1;\nIF long THEN i := 0; WHILE i < 30 DO i := i + 1; END_WHILE; END_IF;\nEND_PROGRAM\n";
  TimedRig rig(text, 1000 * us, 25 * us);
  const std::int64_t took = (1 + 1 + 1 + 1 + 60) * 25 * us;  // 1.6 ms
  rig.until(took);
  EXPECT_THAT(rig.overruns(), ElementsAre("program"));
  EXPECT_THAT(rig.events[0].text, HasSubstr("due every 1 ms, it waited 0 ms for others and took 1.6 ms"));
  rig.until(20 * took);
  EXPECT_EQ(rig.overruns().size(), 1U);  // once, while it goes on
  EXPECT_EQ(rig.get("n"), 21);           // each at the end of the one before
  rig.controller.find("long").value().write(0);
  rig.until(40'000 * us);
  rig.controller.find("long").value().write(1);
  rig.until(45'000 * us);
  EXPECT_EQ(rig.overruns().size(), 2U);  // and when it begins anew
  TimedRig fits(text, 2000 * us, 25 * us);
  fits.until(50'000 * us);
  EXPECT_THAT(fits.overruns(), IsEmpty());
  EXPECT_EQ(fits.get("n"), 26);
}

const std::string two_tasks = R"(CONFIGURATION c RESOURCE r ON cpu
TASK fast (INTERVAL := T#1ms, PRIORITY := 0);
TASK slow (INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM f WITH fast : quick;
PROGRAM s WITH slow : heavy;
END_RESOURCE END_CONFIGURATION
PROGRAM quick VAR n : DINT; lamp AT %QX0.0 : BOOL; END_VAR n := n + 1; lamp := NOT lamp; END_PROGRAM
PROGRAM heavy VAR n, i : DINT; lamp AT %QX0.1 : BOOL; END_VAR
n := n + 1; i := 0; WHILE i < ROUNDS DO i := i + 1; END_WHILE; lamp := NOT lamp; END_PROGRAM
)";
std::string heavy(int rounds) {
  auto text = two_tasks;
  return text.replace(text.find("ROUNDS"), 6, std::to_string(rounds));
}

TEST(StStatementTime, TasksDoNotInterruptEachOther) {
  // fast: 2 statements, 0.1 ms; slow: 4 + 2 * 30 = 64, 3.2 ms.
  TimedRig rig(heavy(30), 1000 * us, 50 * us);
  rig.until(0);
  EXPECT_EQ(rig.get("f.n"), 1);
  EXPECT_EQ(rig.get("s.n"), 0);  // behind the one of the higher priority
  rig.until(100 * us);
  EXPECT_EQ(rig.get("s.n"), 1);
  rig.until(3200 * us);
  EXPECT_EQ(rig.get("f.n"), 1);
  EXPECT_FALSE(rig.output(1));
  rig.until(3300 * us);
  EXPECT_TRUE(rig.output(1));
  EXPECT_EQ(rig.get("f.n"), 2);  // due at 1 ms, and the starts of 2 and 3 ms are lost
  rig.until(4000 * us);
  EXPECT_EQ(rig.get("f.n"), 3);
  EXPECT_THAT(rig.overruns(), ElementsAre("fast"));
  EXPECT_THAT(rig.events[0].text, HasSubstr("it waited 2.3 ms for others and took 0.1 ms"));
}

TEST(StStatementTime, TasksThatFitRunAsWithoutTime) {
  TimedRig none(heavy(3), 1000 * us, 0);
  TimedRig little(heavy(3), 1000 * us, 10 * us);
  none.until(99'900 * us);
  little.until(99'900 * us);
  for (const char* name : {"f.n", "s.n"}) EXPECT_EQ(none.get(name), little.get(name)) << name;
  EXPECT_EQ(none.get("f.n"), 100);
  EXPECT_THAT(little.overruns(), IsEmpty());
}

TEST(StStatementTime, PowerOffForgetsTheScanUnderWay) {
  TimedRig rig("PROGRAM m VAR lamp AT %QX0.0 : BOOL; END_VAR\nlamp := TRUE;\nEND_PROGRAM\n", 10'000 * us,
               5000 * us);
  rig.until(2000 * us);
  rig.controller.power(false);
  rig.until(7000 * us);
  EXPECT_FALSE(rig.output());
  rig.controller.power(true);
  rig.until(14'900 * us);
  EXPECT_FALSE(rig.output());
  rig.until(15'000 * us);
  EXPECT_TRUE(rig.output());
}

TEST(StStatementTime, AFaultIsToldAndTheProgramStands) {
  TimedRig rig("PROGRAM m VAR n, z : DINT; END_VAR\nn := n + 1;\nn := n / z;\nEND_PROGRAM\n", 1000 * us,
               100 * us);
  rig.until(10'000 * us);
  ASSERT_EQ(rig.events.size(), 1U);
  EXPECT_EQ(rig.events[0].event, "error");
  EXPECT_EQ(rig.get("n"), 1);
}

}  // namespace
}  // namespace drycut::devices::plcopen
