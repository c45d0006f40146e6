// Wires of an LX3VP: base-unit terminals, pulse trains, its own pulses counted.
#include <gmock/gmock.h>

#include "devices/lx3vp/lx3vp_controller.hpp"
#include "sim/loop/bus.hpp"
#include "tests/loop/fakes.hpp"

namespace drycut::sim::loop {
namespace {

using devices::parse_base_terminal;
using fakes::text;
using testing::ElementsAre;
using testing::IsEmpty;

class PulsePlant : public fakes::FakePlant {
 public:
  std::vector<plants::Port> ports() override {
    auto ports = fakes::FakePlant::ports();
    ports.push_back({"pulses", &pulses, ""});
    return ports;
  }
  plants::PulsePort pulses;
};

struct Lx3vpBus : testing::Test {
  Lx3vpBus() {
    scenario.file = "line.yaml";
    scenario.sources = {"line.yaml"};
  }
  static devices::lx3vp::il::IlProgram program() {
    Problems problems;
    auto compiled = devices::lx3vp::il::compile(
        "LD X10\nOUT C251 K0\nOUT Y7\nDPLSV K1000 Y1 Y5\nDECAM C251 D2000 X2 Y0 Y4\nEND\n", "saw.il",
        problems);
    EXPECT_TRUE(problems.empty());
    return compiled;
  }
  void connect(const std::vector<std::pair<std::string, std::string>>& wires) {
    int line = 0;
    for (const auto& [terminal, plug] : wires) {
      ++line;
      scenario.wiring.push_back({text(terminal, line, 3), text(plug, line, 12)});
    }
    bus.connect(scenario, controller, {{"axis", &plant}}, problems);
  }
  std::vector<std::string> told() const {
    std::vector<std::string> texts;
    for (const auto& problem : problems) texts.push_back(to_string(problem));
    return texts;
  }

  scenario::Scenario scenario;
  devices::lx3vp::Lx3vpController controller{program(), 1'000'000};
  PulsePlant plant;
  Bus bus;
  Problems problems;
};

TEST_F(Lx3vpBus, CarriesEveryKindOfSignal) {
  connect({{"C251", "axis.encoder"}, {"X10", "axis.index"}, {"Y7", "axis.enable"}, {"Y1", "axis.pulses"}});
  ASSERT_THAT(told(), IsEmpty());
  auto& cards = controller.cards();
  plant.encoder.count = -1234;
  plant.index.level = true;
  bus.plants_to_inputs();
  EXPECT_EQ(cards.counters.at(*parse_base_terminal("C251")).count, -1234);
  for (std::int64_t time = 0; time < 11'000'000; time += 100'000) {
    controller.run_devices(time);
    controller.run_tasks(time);
  }
  bus.outputs_to_plants();
  EXPECT_TRUE(plant.enable.level);
  EXPECT_EQ(plant.pulses.pulses, cards.pulse_outputs.at(*parse_base_terminal("Y1")).count);
  EXPECT_GT(plant.pulses.pulses, 5);
  EXPECT_THAT(bus.unwired(), ElementsAre("X2", "Y4", "Y5", "Y0"));
}

TEST_F(Lx3vpBus, ACounterMayCountThePulsesOfAnOutput) {
  connect({{"C235", "Y1"}, {"Y1", "axis.pulses"}});
  ASSERT_THAT(told(), IsEmpty());
  controller.cards().pulse_outputs.at(*parse_base_terminal("Y1")).count = 30;
  bus.outputs_to_plants();
  bus.plants_to_inputs();
  EXPECT_EQ(controller.cards().counters.at(*parse_base_terminal("C235")).count, 4 * 30);
  EXPECT_EQ(plant.pulses.pulses, 30);
}

TEST_F(Lx3vpBus, WhatDoesNotFitIsTold) {
  connect({{"2.CNT01", "axis.encoder"},
           {"X8", "axis.index"},
           {"C199", "axis.encoder"},
           {"C251", "axis.enable"},
           {"Y5", "axis.pulses"},
           {"Y2", "axis.encoder"},
           {"C235", "Y7"},
           {"INT1", "axis.index"},
           {"Y0", "axis.pulses"},
           {"Y1", "axis.pulses"},
           {"X10", "axis.pulses"}});
  constexpr const char* terminals =
      "' is not a terminal of the controller; write X0 to X377, Y0 to Y377 (octal), or C200 to C255 for a "
      "high-speed counter [wiring.no-terminal]";
  EXPECT_THAT(
      told(),
      ElementsAre(
          std::string("line.yaml:1:3: '2.CNT01") + terminals, std::string("line.yaml:2:3: 'X8") + terminals,
          std::string("line.yaml:3:3: 'C199") + terminals,
          "line.yaml:4:12: C251 is a counter, axis.enable is a command; wire it to one of: axis.encoder "
          "[wiring.kinds-differ]",
          "line.yaml:5:12: Y5 gives no pulses, axis.pulses is a pulse train; wire it to Y0, Y1, Y2 or Y3 "
          "[wiring.kinds-differ]",
          "line.yaml:6:12: Y2 is a digital output, axis.encoder is an encoder; wire it to one of: "
          "axis.enable [wiring.kinds-differ]",
          "line.yaml:7:12: Y7 gives no pulses that C235 could count; wire an encoder to it, or a pulse "
          "output of the controller [wiring.kinds-differ]",
          std::string("line.yaml:8:3: 'INT1") + terminals,
          "line.yaml:10:12: Y0 already drives axis.pulses; wire Y1 elsewhere: a plug has one driver "
          "[wiring.twice]",
          "line.yaml:11:12: X10 is a digital input, axis.pulses is a pulse train; wire it to one of: "
          "axis.index [wiring.kinds-differ]"));
}

}  // namespace
}  // namespace drycut::sim::loop
