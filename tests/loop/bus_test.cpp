#include "sim/loop/bus.hpp"

#include <gmock/gmock.h>

#include "tests/loop/fakes.hpp"

namespace drycut::sim::loop {
namespace {

using devices::Address;
using devices::Kind;
using fakes::text;
using testing::ElementsAre;

struct BusTest : testing::Test {
  BusTest() {
    scenario.file = "line.yaml";
    scenario.sources = {"line.yaml"};
    auto& cards = controller.cards();
    cards.counters[{Kind::counter, 2, 1}];
    cards.counters[{Kind::counter, 1, 1}];
    cards.inputs[{Kind::input, 2, 1}];
    cards.outputs[{Kind::output, 2, 1}];
    cards.outputs[{Kind::output, 2, 2}];
    cards.analogue_outputs[{Kind::analogue, 2, 1}];
  }

  /// Connects the wires given as terminal, plug pairs; the i-th stands in line i + 1, terminal in column 3,
  /// plug in 12.
  void connect(const std::vector<std::pair<std::string, std::string>>& wires) {
    int line = 0;
    for (const auto& [terminal, plug] : wires) {
      ++line;
      scenario.wiring.push_back({text(terminal, line, 3), text(plug, line, 12)});
    }
    bus.connect(scenario, controller, {{"axis", &plant}}, problems);
  }
  std::string only_problem() {
    EXPECT_EQ(problems.size(), 1U);
    return problems.empty() ? "" : to_string(problems.front());
  }

  scenario::Scenario scenario;
  fakes::FakeController controller;
  fakes::FakePlant plant;
  Bus bus;
  Problems problems;
};

TEST_F(BusTest, CarriesEveryKindOfSignal) {
  connect({{"2.CNT01", "axis.encoder"},
           {"2.INP01", "axis.index"},
           {"2.OUT01", "axis.enable"},
           {"2.AN01", "axis.reference"}});
  ASSERT_TRUE(problems.empty());
  auto& cards = controller.cards();
  plant.encoder.count = 1234;
  plant.index.level = true;
  cards.outputs.at({Kind::output, 2, 1}).level = true;
  cards.analogue_outputs.at({Kind::analogue, 2, 1}).word = -32767;
  bus.plants_to_inputs();
  bus.outputs_to_plants();
  EXPECT_EQ(cards.counters.at({Kind::counter, 2, 1}).count, 1234);
  EXPECT_TRUE(cards.inputs.at({Kind::input, 2, 1}).level);
  EXPECT_TRUE(plant.enable.level);
  EXPECT_DOUBLE_EQ(plant.reference.volts, -10.0);
}

TEST_F(BusTest, InterruptLatchesTheCountAtTheEdgeInOrderOfTime) {
  connect({{"2.CNT01", "axis.encoder"}, {"INT1", "axis.index"}, {"INT5", "panel.trigger"}});
  ASSERT_TRUE(problems.empty());
  plant.encoder = {.count = 120, .before = 100, .now = 120};
  bus.panel().set("trigger", true);  // at the start of the step
  plant.index.add_edge(true, 0.25);
  plant.index.add_edge(false, 0.75);
  bus.plants_to_inputs();
  using I = fakes::FakeController::Interrupt;
  // The simulated counter of slot 1 is first in the map and has no wire; the wired one is counters.rbegin().
  EXPECT_EQ(controller.cards().counters.at({Kind::counter, 2, 1}).latched, 115);
  ASSERT_EQ(controller.interrupts.size(), 3U);
  EXPECT_THAT(controller.interrupts, ElementsAre(I{5, true, 0}, I{1, true, 0}, I{1, false, 0}));
  EXPECT_TRUE(controller.cards().interrupt_lines.at(5).level);
  controller.interrupts.clear();
  plant.index.edges.clear();
  bus.plants_to_inputs();
  EXPECT_TRUE(controller.interrupts.empty()) << "a switch edge is told once";
}

TEST_F(BusTest, EveryEdgeOfAStepArrives) {
  connect({{"2.CNT01", "axis.encoder"}, {"INT1", "axis.index"}, {"INT5", "panel.trigger"}});
  plant.encoder = {.count = 200, .before = 0, .now = 200};
  for (int i = 0; i < 10; ++i) {
    plant.index.add_edge(true, 0.05 + 0.1 * i);
    plant.index.add_edge(false, 0.1 + 0.1 * i);
    bus.panel().set("trigger", i % 2 == 0);
  }
  bus.plants_to_inputs();
  EXPECT_EQ(controller.interrupts.size(), 30U);
}

TEST_F(BusTest, PanelHasSwitchesAndLamps) {
  connect({{"2.INP01", "panel.start"}, {"2.OUT02", "panel.ready"}});
  ASSERT_TRUE(problems.empty());
  bus.panel().set("start", true);
  controller.cards().outputs.at({Kind::output, 2, 2}).level = true;
  bus.plants_to_inputs();
  bus.outputs_to_plants();
  EXPECT_TRUE(controller.cards().inputs.at({Kind::input, 2, 1}).level);
  EXPECT_TRUE(bus.panel().lamps.at("ready").level);
}

TEST_F(BusTest, CounterToOutputIsRefused) {
  connect({{"2.CNT01", "axis.enable"}});
  EXPECT_EQ(only_problem(),
            "line.yaml:1:12: 2.CNT01 is a counter, axis.enable is a command; wire it to one of: axis.encoder "
            "[wiring.kinds-differ]");
}

TEST_F(BusTest, TwoDriversAreRefused) {
  connect({{"2.OUT01", "axis.enable"}, {"2.OUT02", "axis.enable"}});
  EXPECT_EQ(only_problem(),
            "line.yaml:2:12: 2.OUT01 already drives axis.enable; wire 2.OUT02 elsewhere: a plug has one "
            "driver [wiring.twice]");
}

TEST_F(BusTest, TerminalTwiceInOtherSpellingIsRefused) {
  connect({{"2.INP01", "axis.index"}, {"2.IN1", "panel.start"}});
  EXPECT_EQ(
      only_problem(),
      "line.yaml:2:3: 2.INP01 is wired already; a terminal takes one wire; remove this one [wiring.twice]");
}

TEST_F(BusTest, UnknownNamesAreNamedWithTheNearest) {
  connect({{"2.CNT9", "axis.encoder"},
           {"2.FOO1", "axis.encoder"},
           {"2.CNT01", "axsi.encoder"},
           {"2.INP01", "axis.idnex"}});
  ASSERT_EQ(problems.size(), 4U);
  EXPECT_EQ(to_string(problems[0]),
            "line.yaml:1:3: the configuration uses no 2.CNT09; its counter terminals are: 2.CNT01 "
            "[wiring.no-terminal]");
  EXPECT_EQ(to_string(problems[1]),
            "line.yaml:2:3: '2.FOO1' is not a terminal of the controller; write slot.CNTnn, slot.INPnn, "
            "slot.OUTnn, slot.ANnn or INTn [wiring.no-terminal]");
  EXPECT_EQ(to_string(problems[2]),
            "line.yaml:3:12: there is no plant 'axsi'; did you mean axis.encoder? [wiring.no-plug]");
  EXPECT_EQ(to_string(problems[3]),
            "line.yaml:4:12: plant 'axis' has no plug 'idnex'; did you mean axis.index? [wiring.no-plug]");
}

TEST_F(BusTest, SimulatedCounterTakesNoWire) {
  connect({{"1.CNT01", "axis.encoder"}});
  EXPECT_EQ(only_problem(),
            "line.yaml:1:3: 1.CNT01 is a simulated counter of the CPU; nothing is wired to slot 1; wire a "
            "counter of another slot [wiring.no-terminal]");
}

TEST_F(BusTest, PanelTakesNoCounterAndNoNameTwice) {
  connect({{"2.CNT01", "panel.knob"}, {"2.INP01", "panel.run"}, {"2.OUT01", "panel.run"}});
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].what, "2.CNT01 is a counter, the panel has switches and lamps");
  EXPECT_EQ(problems[1].what, "panel.run is both a switch and a lamp");
}

TEST_F(BusTest, WhatIsComputedComesLater) {
  connect({{"2.AN01", "axis.reference"}});
  auto& word = controller.cards().analogue_outputs.at({Kind::analogue, 2, 1}).word;
  bus.compute_for(3);
  const auto volts = [&](int given) {
    word = static_cast<std::int16_t>(given);
    bus.outputs_to_plants();
    return std::lround(plant.reference.volts / 10 * 32767);
  };
  // A word each four steps comes three steps later and stays.
  std::vector<long> seen;
  for (int step = 0; step < 12; ++step) seen.push_back(volts(100 + step / 4));
  EXPECT_THAT(seen, ElementsAre(0, 0, 0, 100, 100, 100, 100, 101, 101, 101, 101, 102));
}

}  // namespace
}  // namespace drycut::sim::loop
