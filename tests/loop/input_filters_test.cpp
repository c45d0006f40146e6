#include "sim/loop/bus.hpp"

#include <gmock/gmock.h>

#include "tests/findings.hpp"
#include "tests/loop/fakes.hpp"

namespace drycut::sim {
namespace {

using devices::Address;
using devices::Kind;
using fakes::text;
using testing::ElementsAre;
using testing::IsEmpty;

/// With a switch that is no index.
struct AxisWithSwitch : fakes::FakePlant {
  std::vector<plants::Port> ports() override {
    auto all = FakePlant::ports();
    all.push_back({"switch", &home, ""});
    return all;
  }
  plants::SignalPort home;
};

struct FiltersTest : testing::Test {
  FiltersTest() {
    scenario.file = "line.yaml";
    scenario.sources = {"line.yaml"};
    scenario.scene.step = 100 * microsecond;
    auto& cards = controller.cards();
    cards.counters[counter];
    cards.inputs[input];
    cards.outputs[{Kind::output, 2, 1}];
    scenario.wiring = {{text("2.CNT01"), text("axis.encoder")},
                       {text("2.INP01"), text("panel.start")},
                       {text("INT1"), text("axis.index")}};
  }
  scenario::InputFilter& filter(const std::string& terminal) {
    auto& one = scenario.filters.emplace_back();
    one.terminal = text(terminal, 5, 3);
    return one;
  }
  void connect() { bus.connect(scenario, controller, {{"axis", &plant}}, problems); }
  /// Moves the encoder within a step; the count that the card has then.
  std::int64_t move(double counts) {
    auto& port = plant.encoder;
    port.before = port.now;
    port.now += counts;
    port.count = port.count_at(1);
    bus.plants_to_inputs();
    return controller.cards().counters.at(counter).count;
  }
  /// A zero pulse that lasts so long.
  void pulse(double seconds) {
    plant.index.edges.clear();
    plant.index.add_edge(true, 0.5, seconds / 1e-4);
    plant.index.add_edge(false, 0.5);
    bus.plants_to_inputs();
    plant.index.edges.clear();
  }
  std::vector<std::string> losses() {
    std::vector<std::string> all;
    for (const auto& loss : bus.take_losses()) all.push_back(loss.event + ": " + loss.text);
    return all;
  }

  const Address counter{Kind::counter, 2, 1};
  const Address input{Kind::input, 2, 1};
  scenario::Scenario scenario;
  fakes::FakeController controller;
  AxisWithSwitch plant;
  loop::Bus bus;
  Problems problems;
};

TEST_F(FiltersTest, WithoutOneEverythingComesThrough) {
  connect();
  EXPECT_EQ(move(1e6), 1000000);
  EXPECT_THAT(losses(), IsEmpty());
  EXPECT_THAT(bus.lost(), IsEmpty());
}

// 100 kHz of one phase are 400 000 counts a second, 40 a step.
TEST_F(FiltersTest, ACounterLosesWhatIsBeyondItsFrequency) {
  filter("2.CNT01").frequency = 100e3;
  connect();
  ASSERT_TRUE(problems.empty());
  EXPECT_EQ(move(40), 40);
  EXPECT_EQ(move(-40), 0);
  EXPECT_THAT(losses(), IsEmpty());
  EXPECT_EQ(move(55), 40);
  EXPECT_EQ(move(60), 80);
  EXPECT_THAT(losses(),
              ElementsAre("counts_lost: 2.CNT01: 1.375e+05 Hz of one phase, the card follows 100000 Hz"));
  EXPECT_EQ(move(-50), 40);
  EXPECT_EQ(move(10), 50);
  EXPECT_THAT(losses(), IsEmpty());  // it is told once
  for (int i = 0; i < 1000; ++i) move(0);
  EXPECT_EQ(move(41), 90);
  EXPECT_EQ(losses().size(), 1U);
  EXPECT_THAT(sentences(bus.lost()), ElementsAre("2.CNT01 lost 46 counts beyond 100000 Hz of one phase"));
}

TEST_F(FiltersTest, AnInterruptLatchesWhatTheCardHasCounted) {
  filter("2.CNT01").frequency = 100e3;
  connect();
  move(100);
  plant.encoder.before = plant.encoder.now;
  plant.encoder.now += 20;
  plant.index.add_edge(true, 0.5);
  bus.plants_to_inputs();
  EXPECT_EQ(controller.cards().counters.at(counter).latched, 50);
}

TEST_F(FiltersTest, AShortZeroPulseIsNotSeen) {
  filter("INT1").pulse = 20 * microsecond;
  connect();
  ASSERT_TRUE(problems.empty());
  pulse(21e-6);
  EXPECT_EQ(controller.interrupts.size(), 2U);
  pulse(19e-6);
  pulse(5e-6);
  EXPECT_EQ(controller.interrupts.size(), 2U);
  EXPECT_THAT(losses(), ElementsAre("pulse_lost: INT1: a zero pulse of 19 us, the card needs 20 us"));
  pulse(30e-6);
  EXPECT_EQ(controller.interrupts.size(), 4U);
  pulse(1e-6);
  EXPECT_EQ(losses().size(), 1U);
  EXPECT_THAT(sentences(bus.lost()), ElementsAre("INT1 lost 3 zero pulses shorter than 20 us"));
  plant.index.add_edge(true, 0.1);  // of unknown width, from a bench that stands
  plant.index.add_edge(false, 0.1);
  bus.plants_to_inputs();
  EXPECT_EQ(controller.interrupts.size(), 6U);
}

// 001 §1.4.8.1: "has a hardware filter which delays the acquisition".
TEST_F(FiltersTest, AnInputTakesALevelThatLasts) {
  filter("2.INP01").delay = 3 * millisecond;
  connect();
  const auto level_after = [&](int steps) {
    for (int i = 0; i < steps; ++i) bus.plants_to_inputs();
    return controller.cards().inputs.at(input).level;
  };
  bus.panel().set("start", true);
  EXPECT_FALSE(level_after(29));
  EXPECT_TRUE(level_after(1));
  bus.panel().set("start", false);
  level_after(20);
  bus.panel().set("start", true);  // a gap of 2 ms
  EXPECT_TRUE(level_after(100));
  bus.panel().set("start", false);
  EXPECT_TRUE(level_after(29));
  EXPECT_FALSE(level_after(1));
}

struct WrongFilter {
  const char* name;
  void (*make)(FiltersTest&);
  const char* told;
};

class WrongFilters : public FiltersTest, public testing::WithParamInterface<WrongFilter> {};

TEST_P(WrongFilters, AreToldWithTheirPlace) {
  GetParam().make(*this);
  connect();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(to_string(problems.front()), GetParam().told);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongFilters,
    testing::Values(
        WrongFilter{
            "frequency_of_an_input", [](FiltersTest& t) { t.filter("2.INP01").frequency = 1e5; },
            "line.yaml:5:3: 2.INP01 is a digital input and has no such filter; a counter has a frequency, "
            "an interrupt line a pulse, a digital input a delay [wiring.kinds-differ]"},
        WrongFilter{
            "delay_of_a_counter", [](FiltersTest& t) { t.filter("2.CNT01").delay = millisecond; },
            "line.yaml:5:3: 2.CNT01 is a counter and has no such filter; a counter has a frequency, an "
            "interrupt line a pulse, a digital input a delay [wiring.kinds-differ]"},
        WrongFilter{
            "pulse_of_an_output", [](FiltersTest& t) { t.filter("2.OUT01").pulse = millisecond; },
            "line.yaml:5:3: 2.OUT01 is a digital output and has no such filter; a counter has a frequency, "
            "an interrupt line a pulse, a digital input a delay [wiring.kinds-differ]"},
        WrongFilter{"no_terminal", [](FiltersTest& t) { t.filter("9.CNT01").frequency = 1e5; },
                    "line.yaml:5:3: the configuration uses no 9.CNT01; its counter terminals are: 2.CNT01 "
                    "[wiring.no-terminal]"},
        WrongFilter{
            "no_wire",
            [](FiltersTest& t) {
              t.filter("INT1").pulse = millisecond;
              t.scenario.wiring.pop_back();
            },
            "line.yaml:5:3: no signal of a plant comes to INT1: there is nothing to filter; wire it, or "
            "leave "
            "the filter out [wiring.nothing-to-filter]"},
        WrongFilter{"no_zero_pulses",
                    [](FiltersTest& t) {
                      t.filter("INT1").pulse = millisecond;
                      t.scenario.wiring.back().plug.text = "axis.switch";
                    },
                    "line.yaml:5:3: axis.switch gives no zero pulses; a least width is for an index: "
                    "knife.encoder.index [wiring.kinds-differ]"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace drycut::sim
