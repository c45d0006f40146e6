// A scenario with an LX3VP: reading, writing back, putting together, running.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "sim/loop/controller_loader.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/findings.hpp"
#include "tests/loop/scenario/folder.hpp"

namespace drycut::sim::loop {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Lx3vpScenario : scenario::ScenarioFolder {
  Lx3vpScenario() {
    write("saw.il", "LD M8000\nOUT C251 K0\nDECAM C251 D2000 X2 Y0 Y4\nLD X0\nOUT Y10\nEND\n");
    write("saw.csv",
          "address,value\nD2005,1\nD2006:L,200000\nD2023,1\nD2024,1\nD2029,1\nD2030,1\nD2038,2\nD2039,40\n"
          "D2044:L,1000\nD2046:L,500\n");
  }

  static constexpr const char* line = R"(scene: {title: Saw, step: 50 us, duration: 2 s}
plants: {bench: {type: bench}}
controller:
  lx3vp: {program: saw.il, registers: saw.csv, scan: 1 ms, set: {D100: 5, DD102: -70000, FD104: 1.5}}
wiring: {C251: bench.counter1, X0: bench.input1, Y10: bench.output1}
timeline:
  - {at: 0.1 s, set: {bench.counter1.rate: 4000 1/s}}
  - {at: 1.1 s, set: {bench.counter1.rate: 0 1/s, bench.input1: 1}}
record: {every: 1 ms, channels: [DD8140, D2025, D2001.6, C251, M8147, Y10]}
checks:
  - {name: half a pulse each, eventually: "DD8140 == 500", within: 2 s}
  - {name: lamp, eventually: "bench.output1 == 1", within: 2 s}
  - {name: preset, always: "D100 == 5 && DD102 == -70000 && FD104 == 1.5"}
)";
};

TEST_F(Lx3vpScenario, AProgramThatDoesNotLoadMakesNoSwitchOfThePanelUnknown) {
  const auto scenario = read(R"(scene: {title: Saw, step: 50 us, duration: 2 s}
plants: {bench: {type: bench}}
controller:
  lx3vp: {program: gone.il, scan: 1 ms}
wiring: {X1: panel.start, Y10: panel.lamp}
timeline:
  - {at: 0.1 s, set: {panel.start: on}}
  - {at: 0.2 s, set: {panel.stop: on}}
record: {every: 1 ms, channels: [panel.start, panel.lamp]}
)");
  Simulation simulation(scenario, problems);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_THAT(told()[0], HasSubstr("gone.il"));
  EXPECT_THAT(told()[1], HasSubstr("line.yaml:8:23: nothing called 'panel.stop' can be set; wire an input to "
                                   "panel.stop first; switches: panel.start"));
}

TEST_F(Lx3vpScenario, RunsAgainstTheBench) {
  const auto scenario = read(line);
  Simulation simulation(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  const auto outcome = simulation.run();
  for (const auto& check : outcome.checks) EXPECT_TRUE(check.passed) << check.name;
  const auto value = [&](const char* name) { return simulation.names().reading(name)->read(); };
  EXPECT_EQ(value("C251"), 1000);
  EXPECT_EQ(value("DD8140"), 500);
  EXPECT_THAT(sentences(simulation.warnings()),
              ElementsAre("X2 is read by the program, and nothing is wired to it",
                          "Y4 is worked by the program, and nothing is wired to it"));
  EXPECT_EQ(codes(outcome.warnings()), codes(simulation.warnings()));
  std::vector<std::string> names;
  for (const auto& reading : simulation.controller_values()) names.push_back(reading.name);
  EXPECT_THAT(names, Contains("DD2025"));
  EXPECT_LT(names.size(), 100u) << "the report lists what the program is about";
}

TEST_F(Lx3vpScenario, ValuesThatTheFirstScanReplacesAreNoted) {
  write("saw.il", "LD M8002\nMOV K400 D100\nDMOV K7 D2006\nMOV K1 D2005\nLD X0\nMOV K3 D2023\nEND\n");
  const auto scenario = read(R"(scene: {step: 50 us, duration: 2 s}
controller:
  lx3vp: {program: saw.il, registers: saw.csv, scan: 1 ms, set: {D100: 5, DD102: 6}}
)");
  const Simulation simulation(scenario, problems);
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(sentences(simulation.notes_of_setup()),
              ElementsAre(HasSubstr("saw.csv:3:1: DD2006 = 200000, and the program's first scan makes it 7"),
                          HasSubstr("line.yaml:3:66: D100 = 5, and the program's first scan makes it 400")));
}

TEST_F(Lx3vpScenario, IsWrittenBackWhole) {
  const auto scenario = read(line);
  const auto text = scenario::expand(scenario);
  EXPECT_THAT(
      text,
      HasSubstr("  lx3vp:\n    program: saw.il\n    registers: saw.csv\n    scan: 1 ms\n    "
                "step_time: 0 s\n    retentive: \"\"\n    set: {D100: 5, DD102: -70000, FD104: 1.5}\n"));
  EXPECT_EQ(scenario::expand(read(text)), text);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(Lx3vpScenario, OverridesReachTheRegisters) {
  const auto scenario = read(line, {{"controller.lx3vp.set.D100", "7"}, {"controller.lx3vp.set.D200", "8"}});
  const auto controller = load_controller(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  EXPECT_EQ(controller->find("D100")->read(), 7);
  EXPECT_EQ(controller->find("D200")->read(), 8);
  EXPECT_EQ(controller->find("DD2044")->read(), 1000);
}

TEST_F(Lx3vpScenario, EveryFaultOfAllFilesIsTold) {
  write("saw.il", "LD M0\nDECAM C251 D2000 X2 Y0\nFOO D1\nEND\n");
  write("saw.csv", "D1,5\nD2,x\n");
  const auto scenario = read(line);
  EXPECT_FALSE(load_controller(scenario, problems));
  const auto texts = told();
  EXPECT_THAT(texts, Contains(HasSubstr("saw.il:2:")));
  EXPECT_THAT(texts, Contains(HasSubstr("saw.il:3:1: ")));
  EXPECT_THAT(texts,
              Contains("saw.csv:2:4: 'x' is no number; write 5, -5, K5, H1F or 1.5 [registers.value]"));
}

TEST_F(Lx3vpScenario, PresetsAreChecked) {
  const auto scenario = read(
      "scene: {duration: 1 s}\ncontroller:\n  lx3vp:\n    program: saw.il\n    set:\n      D1: 70000\n      "
      "D2: 1.5\n"
      "      Q7: 1\n      X2: 1\n      M0: 3\n      DD4: 1.5\n");
  load_controller(scenario, problems);
  EXPECT_THAT(
      told(),
      ElementsAre(
          "line.yaml:6:7: D1 does not hold 70000; write -32768 to 65535, or D1:L [controller.value-range]",
          "line.yaml:7:7: D2 holds whole numbers, not 1.5; write D2:F for a float [controller.value-range]",
          "line.yaml:8:7: the controller has nothing called 'Q7'; name a register: D10, DD10 (32 bit), FD10 "
          "(float), D10.A, M0, S0, T0 or C0 [controller.unknown-name]",
          "line.yaml:9:7: 'X2' can only be read; name a register: D10, DD10 (32 bit), FD10 (float), D10.A, "
          "M0, S0, T0 or C0 [controller.unknown-name]",
          "line.yaml:10:7: M0 does not hold 3; write 0 to 1 [controller.value-range]",
          "line.yaml:11:7: DD4 holds whole numbers, not 1.5; write D4:F for a float "
          "[controller.value-range]"));
}

TEST_F(Lx3vpScenario, MissingFilesAreToldAtTheirPlace) {
  const auto scenario =
      read("controller: {lx3vp: {program: none.il, registers: none.csv}}\nscene: {duration: 1 s}\n");
  load_controller(scenario, problems);
  const auto texts = told();
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_THAT(texts[0], HasSubstr("none.il"));
  EXPECT_THAT(texts[1], HasSubstr("none.csv"));
}

TEST_F(Lx3vpScenario, TheStepDividesTheTick) {
  const auto scenario = read(
      "scene: {step: 200 us, duration: 1 s}\nplants: {bench: {type: bench}}\ncontroller: {lx3vp: {program: "
      "saw.il}}\n"
      "record: {every: 2 ms}\n");
  Simulation simulation(scenario, problems);
  EXPECT_THAT(told(),
              Contains("line.yaml:1:15: E-CAM tick of 100000 ns is not a whole multiple of the step of "
                       "200000 ns; choose a step that divides it [scenario.time-grid]"));
}

TEST_F(Lx3vpScenario, ErrorsOfTheCamFailTheRun) {
  write("saw.csv", "D2005,1\nD2023,0\n");
  const auto scenario = read(line);
  Simulation simulation(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  const auto outcome = simulation.run();
  EXPECT_FALSE(outcome.passed());
  EXPECT_THAT(outcome.checks.back().name, HasSubstr("program"));
  EXPECT_FALSE(outcome.checks.back().passed);
  EXPECT_THAT(sentences(simulation.notes()),
              Contains(HasSubstr("saw.il:3: 6781: word 23 (D2023), a term of a ratio, is 0")));
}

TEST_F(Lx3vpScenario, NoPlantIsCalledAsARegisterIs) {
  write("saw.il", "LD M8002\nINC D300\nEND\n");
  const auto scenario = read(
      "scene: {duration: 0.1 s}\nplants: {D300: {type: bench}}\ncontroller: {lx3vp: {program: saw.il}}\n");
  const Simulation simulation(scenario, problems);
  EXPECT_THAT(told(),
              ElementsAre("line.yaml:2:10: plants.D300: the controller has D300 too; give the plant a name "
                          "of its own, or another spelling: knife and Knife [controller.twice]"));
}

TEST_F(Lx3vpScenario, TheRetentiveFileMustBeWritableAtTheEnd) {
  write("saw.il", "LD M8002\nINC D300\nEND\n");
  const std::string text =
      "scene: {duration: 0.1 s}\nplants: {bench: {type: bench}}\n"
      "controller: {lx3vp: {program: saw.il, retentive: ";
  const auto refused = [&](const std::string& kept) {
    problems.clear();
    const auto scenario = read(text + kept + "}}\n");
    const Simulation simulation(scenario, problems);
    return told();
  };
  EXPECT_THAT(refused("none/kept.txt"),
              ElementsAre(testing::MatchesRegex("line.yaml:3:50: there is no directory .*/none; make it "
                                                "first, or name another file [[]file.not-writable[]]")));
  std::filesystem::create_directories(folder / "deep");
  EXPECT_THAT(refused("deep"), ElementsAre(testing::MatchesRegex(
                                   "line.yaml:3:50: .*/deep cannot be written at the end of the run: it "
                                   "is a directory; name another file [[]file.not-writable[]]")));
}

// A block with no more than its table runs: the manual's initial values are a note, no error.
TEST_F(Lx3vpScenario, InitialValuesOfABlockAreANote) {
  write("saw.csv", "D2005,1\nD2038,2\nD2044:L,1000\nD2046:L,500\n");
  const auto scenario = read(line);
  Simulation simulation(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  EXPECT_TRUE(simulation.run().passed());
  EXPECT_THAT(
      sentences(simulation.notes()),
      Contains(HasSubstr("saw.il:3: the block D2000 has the initial values of its words that nothing has "
                         "written: D2006 200000, D2023 1, D2024 1, D2029 1, D2030 1, D2039 40")));
}

TEST_F(Lx3vpScenario, RetentiveRegistersOutliveTheRun) {
  write("saw.il", "LD M8002\nINC D300\nEND\n");
  const std::string text =
      "scene: {duration: 0.1 s}\nplants: {bench: {type: bench}}\n"
      "controller: {lx3vp: {program: saw.il, retentive: kept.txt}}\n";
  for (int run = 1; run <= 3; ++run) {
    const auto scenario = read(text);
    Simulation simulation(scenario, problems);
    ASSERT_THAT(told(), IsEmpty());
    simulation.run();
    EXPECT_EQ(simulation.names().reading("D300")->read(), run);
    write("kept.txt", simulation.retentive_state());
  }
}

}  // namespace
}  // namespace drycut::sim::loop
