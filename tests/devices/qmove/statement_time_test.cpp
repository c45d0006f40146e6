// Statements that take time: closed forms of a program's reaction, and that no time changes nothing.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

namespace drycut::devices::qmove {
namespace {

using testing::puppets;
using testing::text_of;
using testing::usual_cnf;

constexpr std::int64_t us = 1000;

/// A controller in steps of its own.
struct Timed {
  Problems problems;
  Configuration configuration;
  std::unique_ptr<QmoveController> controller;
  std::int64_t now = 0;
  std::int64_t step_ns;

  Timed(const std::vector<std::string>& modules, std::int64_t statement_ns, std::int64_t cycle_ns,
        std::int64_t step = 10 * us)
      : configuration(parse_configuration(usual_cnf, "test.cnf", puppets(), problems)), step_ns(step) {
    std::vector<QclProgram> programs;
    for (std::size_t i = 0; i < modules.size(); ++i)
      programs.push_back(compile_module(modules[i], "task" + std::to_string(i) + ".mod", configuration,
                                        puppets(), problems));
    EXPECT_TRUE(problems.empty()) << text_of(problems);
    controller =
        std::make_unique<QmoveController>(configuration, programs, puppets(), cycle_ns, statement_ns);
  }
  void step() {
    controller->run_devices(now);
    controller->run_tasks(now);
    now += step_ns;
  }
  void until(std::int64_t time_ns) {
    while (now <= time_ns) step();
  }
  double operator[](const std::string& name) const { return controller->find(name).value().read(); }
  bool& start() { return controller->cards().inputs.at({Kind::input, 2, 1}).level; }
  bool lamp() { return controller->cards().outputs.at({Kind::output, 2, 1}).level; }
};

// In a round: look at WAIT, JUMP, IF, SETOUT (if the input is on), WAIT; that is 5, 4 while it is off.
const std::string reacts = "MAIN:\nIF ifStart\nSETOUT ofLamp\nENDIF\nWAIT 1\nJUMP MAIN\nEND\n";

TEST(QmoveStatementTime, ReactionLiesBetweenOneStatementAndARoundMore) {
  for (const std::int64_t statement : {50 * us, 300 * us, 700 * us}) {
    const std::int64_t cycle = 2000 * us;
    const std::int64_t round = std::max(cycle, 4 * statement);
    std::int64_t best = round * 10;
    std::int64_t worst = 0;
    for (std::int64_t phase = 0; phase < round; phase += 10 * us) {
      Timed line({reacts}, statement, cycle);
      line.until(20'000 * us + phase);
      const std::int64_t on = line.now;
      line.start() = true;
      while (!line.lamp()) line.step();
      const std::int64_t reaction = line.now - line.step_ns - on;
      best = std::min(best, reaction);
      worst = std::max(worst, reaction);
    }
    // Seen at the end of IF, acts at the end of SETOUT; at worst a round less a step later.
    EXPECT_EQ(best, statement);
    EXPECT_EQ(worst, round + statement - 10 * us);
  }
}

TEST(QmoveStatementTime, EachStatementActsAtItsEnd) {
  Timed line({"glI = 1\nglI = 2\nglJ = glI\nIF glJ EQ 2\nglI = 3\nENDIF\nEND\n"}, 100 * us, 1000 * us);
  const auto at = [&](std::int64_t time_ns) {
    line.until(time_ns);
    return line["glI"];
  };
  EXPECT_EQ(at(90 * us), 0);
  EXPECT_EQ(at(100 * us), 1);
  EXPECT_EQ(at(190 * us), 1);
  EXPECT_EQ(at(200 * us), 2);
  EXPECT_EQ(at(490 * us), 2);  // the assignment to glJ, then IF
  EXPECT_EQ(at(500 * us), 3);
}

// Statements that a step holds several of, and such as end between steps: their ends are exact in the sum.
TEST(QmoveStatementTime, DoesNotDriftWithTheStep) {
  for (const std::int64_t statement : {std::int64_t{777}, 3 * us + 1, 33 * us, 45 * us}) {
    Timed line({"WHILE 1\nglI = glI + 1\nENDWHILE\nEND\n"}, statement, 1000 * us, 100 * us);
    const int loops = 1000;
    line.until(3 * loops * statement);
    // WHILE, the assignment, ENDWHILE: 3 a turn.
    EXPECT_EQ(line["glI"], std::floor(static_cast<double>((line.now - line.step_ns) / statement + 1) / 3));
  }
}

TEST(QmoveStatementTime, WhatALoopTakes) {
  struct Row {
    std::string program;
    int statements;  ///< until glJ is 1
  };
  for (const Row& row : {
           Row{"FOR (glI = 1, glI LE 5, 1)\nglI = glI\nNEXT\nglJ = 1\nEND\n", 1 + 5 * 3 + 1},
           Row{"WHILE glI LT 5\nglI = glI + 1\nENDWHILE\nglJ = 1\nEND\n", 5 * 3 + 1 + 1},
           Row{"CALL Part\nglJ = 1\nEND\nSUB Part\nglI = 7\nENDSUB\n", 1 + 1 + 1 + 1},
           Row{"IF glI\nglI = 2\nELSE\nglI = 3\nENDIF\nglJ = 1\nEND\n", 1 + 1 + 1},
           Row{"glI = 1\nIF glI\nglI = 2\nELSE\nglI = 3\nENDIF\nglJ = 1\nEND\n", 1 + 1 + 1 + 1 + 1},
           Row{"JUMP There\nglI = 1\nThere:\nglJ = 1\nEND\n", 1 + 1},
       }) {
    Timed line({row.program}, 10 * us, 100'000 * us);
    while (line["glJ"] == 0 && line.now < 90'000 * us) line.step();
    EXPECT_EQ((line.now - line.step_ns) / (10 * us), row.statements) << row.program;
  }
}

// Two tasks share the processor by turns: a round is as long as both.
TEST(QmoveStatementTime, TasksTakeTurns) {
  const std::string count = "MAIN:\nX = X + 1\nWAIT 1\nJUMP MAIN\nEND\n";
  const auto of = [&](const std::string& variable) {
    auto text = count;
    for (std::size_t at = 0; (at = text.find('X', at)) != std::string::npos;) text.replace(at, 1, variable);
    return text;
  };
  // 4 statements each: look, JUMP, assignment, WAIT. The first round has no look and no JUMP.
  Timed fits({of("glI"), of("glJ")}, 100 * us, 1000 * us);
  fits.until(100'000 * us);
  EXPECT_EQ(fits["glI"], 101 - 1);  // at 100 ms the round has begun, the assignment not ended
  Timed late({of("glI"), of("glJ")}, 200 * us, 1000 * us);
  late.until(160'790 * us);  // from 1 ms on rounds of 1.6 ms; the 100th of these begins at 159.4 ms
  EXPECT_EQ(late["glI"], 101);
  EXPECT_EQ(late["glJ"], 100);
  // A task that never waits keeps the others from their turns.
  Timed alone({"WHILE 1\nglI = glI + 1\nENDWHILE\nEND\n", of("glJ")}, 100 * us, 1000 * us);
  alone.until(50'000 * us);
  EXPECT_EQ(alone["glJ"], 0);
  EXPECT_GT(alone["glI"], 100);
}

TEST(QmoveStatementTime, ALoopWithoutWaitTripsTheWatchdogAllTheSame) {
  // 4 instructions a loop of two statements: the million after half a million of them.
  Timed line({"WHILE 1\nENDWHILE\nEND\n"}, 10, 1000 * us, 100 * us);
  line.until(3000 * us);
  EXPECT_EQ(line["QMOS.oserr"], 0);
  line.until(8000 * us);
  EXPECT_EQ(line["QMOS.oserr"], 8);
}

TEST(QmoveStatementTime, PowerOffForgetsTheTurnUnderWay) {
  Timed line({"glI = 1\nglI = 2\nglI = 3\nWAIT 0\nEND\n"}, 1000 * us, 10'000 * us);
  line.until(2500 * us);
  EXPECT_EQ(line["glI"], 2);
  line.controller->power(false);
  line.until(12'000 * us);
  line.controller->power(true);
  EXPECT_EQ(line["glI"], 0);
  line.until(20'990 * us);  // the next round begins at 20 ms
  EXPECT_EQ(line["glI"], 0);
  line.until(21'000 * us);
  EXPECT_EQ(line["glI"], 1);
}

// A read waits for the device's sample as before, and the statement is looked at once a round.
TEST(QmoveStatementTime, ReadsOfADeviceWaitForItsSample) {
  Timed line({"INIT Axis\nWAIT Axis:st_init\nAxis:posit = 5\nglI = Axis:posit\nEND\n"}, 100 * us, 1000 * us);
  while (line["glI"] == 0 && line.now < 40'000 * us) line.step();
  EXPECT_EQ(line["glI"], 5);
  // INIT taken at 4 ms, st_init seen in that round, posit written in it, taken at 8 ms, read in the next
  // round.
  EXPECT_NEAR(static_cast<double>(line.now), 8.1e6, 0.2e6);
}

// As fast as can be, the program does what it does without time.
TEST(QmoveStatementTime, OfANanosecondIsAsNone) {
  const std::vector<std::string> modules{reacts, "MAIN:\nglI = glI + 1\nWAIT glI % 3\nJUMP MAIN\nEND\n",
                                         "INIT Axis\nWAIT Axis:st_init\nGO Axis\nWAIT NOT Axis:st_still\n"
                                         "MAIN:\nAxis:posit = Axis:posit + 1\nWAIT 1\nJUMP MAIN\nEND\n"};
  Timed none(modules, 0, 1000 * us, 100 * us);
  Timed little(modules, 1, 1000 * us, 100 * us);
  for (int i = 0; i < 1000; ++i) {
    if (i % 10 == 5) none.start() = little.start() = i % 90 > 40;
    none.step();
    little.step();
    if (i % 10 < 1) continue;  // in the first step of a round there was no time yet
    for (const char* name : {"glI", "Axis.posit", "Axis.st_still"})
      ASSERT_EQ(none[name], little[name]) << name << " in step " << i;
    ASSERT_EQ(none.lamp(), little.lamp());
  }
  EXPECT_GT(none["Axis.posit"], 10);
}

}  // namespace
}  // namespace drycut::devices::qmove
