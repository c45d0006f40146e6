// What a scenario gives a value is what the value takes: presets, --set, the timeline, of every controller.
#include <gmock/gmock.h>

#include "plants/web.hpp"
#include "sim/loop/simulation.hpp"
#include "tests/loop/scenario/folder.hpp"

namespace drycut::sim::scenario {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct ValueRanges : ScenarioFolder {
  ValueRanges() {
    write("axis.cnf", R"(CONST
SYSTEM
GLOBAL
slLength L
swCount W
sbByte B
sfFlag F
ssReal S
ARRGBL
arr L 3
TIMER
tmWait
BUS
1 1CPUB 02
2 1MIXA 00
INTDEVICE
AxisX EPICPOS 2 2.CNT01 X X.X 2.AN01
END
)");
    write("axis.mod", "MAIN:\nWAIT 1\nJUMP MAIN\nEND\n");
    write("saw.il", "LD M0\nOUT M1\nEND\n");
  }
  std::vector<std::string> built(const std::string& text, const std::vector<Override>& overrides = {}) {
    const auto scenario = read(text, overrides);
    if (scenario.buildable) loop::Simulation(scenario, problems);
    return told();
  }

  const std::string qmove = R"(scene: {duration: 1 s}
plants:
  axis: {type: ideal_axis}
  web: {type: web}
  bench: {type: bench}
controller:
  qmove:
    configuration: axis.cnf
    tasks: [axis.mod]
)";
};

TEST_F(ValueRanges, APresetOfQmoveIsTakenAsItIsOrRefused) {
  EXPECT_THAT(
      built(qmove + R"(    set:
      AxisX.pgain: 2.7
      AxisX.maxvel: 4294967297
      slLength: 3000000000
      swCount: 40000
      sbByte: -129
      sfFlag: 2
      arr[2]: 0.5
      tmWait: -1
      ssReal: 1e300
)"),
      ElementsAre(
          "line.yaml:11:7: AxisX.pgain holds whole numbers, not 2.7; write a whole number "
          "[controller.value-range]",
          "line.yaml:12:7: AxisX.maxvel does not hold 4294967297; write 0 to 999999 speed "
          "[controller.value-range]",
          "line.yaml:13:7: slLength does not hold 3000000000; write -2147483648 to 2147483647 "
          "[controller.value-range]",
          "line.yaml:14:7: swCount does not hold 40000; write -32768 to 32767 [controller.value-range]",
          "line.yaml:15:7: sbByte does not hold -129; write -128 to 127 [controller.value-range]",
          "line.yaml:16:7: sfFlag does not hold 2; write 0 to 1 [controller.value-range]",
          "line.yaml:17:7: arr[2] holds whole numbers, not 0.5; write a whole number "
          "[controller.value-range]",
          "line.yaml:18:7: tmWait does not hold -1; write 0 to 2147483647 [controller.value-range]",
          testing::StartsWith("line.yaml:19:7: ssReal does not hold 1e+300; write -3.4028")));
}

TEST_F(ValueRanges, APresetInsideItsRangeIsTaken) {
  EXPECT_THAT(built(qmove + "    set: {AxisX.pgain: 32767, slLength: -2147483648, sfFlag: 1, ssReal: 2.5}\n"),
              IsEmpty());
}

TEST_F(ValueRanges, AnOverrideIsJudgedAsThePresetIs) {
  EXPECT_THAT(
      built(qmove, {{"controller.qmove.set.AxisX.pgain", "2.7"}, {"plants.web.speed", "1e308 m/min"}}),
      ElementsAre("--set plants.web.speed:1:1: plants.web.speed is 1e+308 m/min, out of range; 0 m/min to "
                  "1000 m/min [scenario.out-of-range]"));
  problems.clear();
  EXPECT_THAT(
      built(qmove, {{"controller.qmove.set.AxisX.pgain", "2.7"}}),
      ElementsAre("--set controller.qmove.set.AxisX.pgain:1:1: AxisX.pgain holds whole numbers, not 2.7; "
                  "write a whole number [controller.value-range]"));
}

TEST_F(ValueRanges, TheTimelineKeepsToTheTables) {
  EXPECT_THAT(
      built(qmove + R"(timeline:
  - {at: 0.1 s, set: {web.speed: -1e5 m/min, AxisX.pgain: 2.7, slLength: 1e308}}
  - {at: 0.2 s, ramp: {web.speed: 1e308 m/min, bench.counter1.rate: 2e9 1/s}, over: 1 s}
  - {at: 0.3 s, fault: {axis.encoder: {lose_counts: 1e308, stuck: 2, jitter: -1}, web.wheel: {slip: 101 %}}}
  - {at: 0.4 s, set: {web.speed: -1000 m/min, bench.input1: on}}
)"),
      ElementsAre(
          "line.yaml:11:34: web.speed does not hold -100000; write -1000 to 1000 m/min "
          "[controller.value-range]",
          "line.yaml:11:59: AxisX.pgain holds whole numbers, not 2.7; write a whole number "
          "[controller.value-range]",
          "line.yaml:11:74: slLength does not hold 1e+308; write -2147483648 to 2147483647 "
          "[controller.value-range]",
          "line.yaml:12:35: web.speed does not hold 1e+308; write -1000 to 1000 m/min "
          "[controller.value-range]",
          "line.yaml:12:69: bench.counter1.rate does not hold 2000000000; write -1000000000 to 1000000000 "
          "1/s [controller.value-range]",
          "line.yaml:13:53: axis.encoder.lose_counts does not hold 1e+308; write -2147483648 to 2147483647 "
          "[controller.value-range]",
          "line.yaml:13:67: axis.encoder.stuck does not hold 2; write 0 to 1 [controller.value-range]",
          "line.yaml:13:78: axis.encoder.jitter does not hold -1; write 0 to 1000000 "
          "[controller.value-range]",
          "line.yaml:13:101: web.wheel.slip does not hold 101; write -100 to 100 % "
          "[controller.value-range]"));
}

TEST_F(ValueRanges, RegistersAreNotWrapped) {
  EXPECT_THAT(
      built("scene: {duration: 1 s}\ncontroller: {lx3vp: {program: saw.il}}\ntimeline:\n"
            "  - {at: 0.1 s, set: {D10: 70000, D11: 65535, M3: 2}}\n"
            "  - {at: 0.2 s, ramp: {DD20: 5e9, FD30: 1e39}, over: 1 s}\n"),
      ElementsAre(
          "line.yaml:4:28: D10 does not hold 70000; write -32768 to 65535, or D10:L [controller.value-range]",
          "line.yaml:4:51: M3 does not hold 2; write 0 to 1 [controller.value-range]",
          "line.yaml:5:30: DD20 does not hold 5000000000; write -2147483648 to 2147483647 "
          "[controller.value-range]",
          testing::StartsWith("line.yaml:5:41: FD30 does not hold 1e+39; write -3.4028")));
}

TEST_F(ValueRanges, EveryValueThatCanBeSetHasARange) {
  const auto scenario = read(qmove);
  loop::Simulation simulation(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  for (const auto& reading : simulation.controller_values()) {
    const auto target = simulation.names().target(reading.name);
    if (!target) continue;
    ASSERT_TRUE(target->range.has_value()) << reading.name;
    EXPECT_LT(target->range->low, target->range->high) << reading.name;
  }
}

TEST_F(ValueRanges, APlantIsNotCalledLikeSomethingOfTheController) {
  const std::string remedy =
      "; give the plant a name of its own, or another spelling: knife and Knife [controller.twice]";
  auto text = qmove;
  text.replace(text.find("  web: "), 6, "  slLength: ");
  text.replace(text.find("  bench: "), 8, "  AxisX: ");
  EXPECT_THAT(built(text),
              ElementsAre("line.yaml:4:3: plants.slLength: the controller has slLength too" + remedy,
                          "line.yaml:5:3: plants.AxisX: the controller has AxisX too" + remedy));
  problems.clear();
  text.replace(text.find("  slLength: "), 11, "  sllength: ");
  text.replace(text.find("  AxisX: "), 8, "  axisX: ");
  EXPECT_THAT(built(text), IsEmpty());
  EXPECT_THAT(built("scene: {duration: 1 s}\nplants: {D10: {type: bench}, saw: {type: bench}}\n"
                    "controller: {lx3vp: {program: saw.il}}\n"),
              ElementsAre("line.yaml:2:10: plants.D10: the controller has D10 too" + remedy));
}

TEST_F(ValueRanges, TwoStationsOnAWebDoNotStandInOnePlace) {
  const std::string remedy = " mm or more further down the line, or a web of its own [plant.no-room]";
  EXPECT_THAT(
      built("scene: {duration: 1 s}\nplants:\n  web: {type: web}\n  other: {type: web}\n"
            "  knife: {type: rotary_knife, web: web}\n  third: {type: rotary_knife, web: other}\n"
            "  saw: {type: flying_saw, web: web}\n"
            "  fourth: {type: rotary_knife, web: other, place: 190 mm}\n"
            "  fifth: {type: rotary_knife, web: other, place: 191 mm}\n"),
      ElementsAre("line.yaml:7:32: plants.saw.web: it takes -40 to 760 mm of web, where the rotary_knife "
                  "knife stands, -95 to 95 mm; 'place' 136" +
                      remedy,
                  "line.yaml:8:51: plants.fourth.place: it takes 95 to 285 mm of other, where the "
                  "rotary_knife third stands, -95 to 95 mm; 'place' 1" +
                      remedy));
}

TEST_F(ValueRanges, AMaterialGivesItsValuesAndOthersBesideIt) {
  const std::string line = "scene: {duration: 1 s}\nplants: {web: {type: web, ";
  EXPECT_THAT(built(line + "density: 8 g/cm3, material: steel, section: tube, elasticity: 200 GPa}}\n"),
              IsEmpty());
  const auto scenario = read(line + "density: 8 g/cm3, material: steel, elasticity: 200 GPa}}\n");
  const auto& web = dynamic_cast<plants::WebDefinition&>(*scenario.plants.at(0).definition).data;
  EXPECT_DOUBLE_EQ(web.density, 8000);
  EXPECT_DOUBLE_EQ(web.strip.elasticity, 200e9);
  EXPECT_EQ(web.shear_strength, 290e6);
  EXPECT_EQ(web.strip.retardation, 2e-6);
  EXPECT_FALSE(web.strip.on);
  EXPECT_THAT(built(line + "material: steal}}\n"),
              ElementsAre("line.yaml:2:37: plants.web.material: unknown choice 'steal'; did you mean steel? "
                          "[scenario.unknown-choice]"));
}

TEST_F(ValueRanges, StiffPairsAreJudgedAtTheScenariosStep) {
  const std::string web = "plants:\n  web: {type: web, drive: {stiffness: 1e9 N/m}}\nrecord: {every: 2 ms}\n";
  EXPECT_THAT(
      built("scene: {duration: 1 s}\n" + web),
      ElementsAre("line.yaml:3:39: web.drive.stiffness: web and line drive oscillate at 1125 Hz, steps of "
                  "100 us cannot follow; scene.step of at most 50 us, or softer, less damped, heavier "
                  "parts [plant.step-too-long]"));
  problems.clear();
  EXPECT_THAT(built("scene: {duration: 1 s, step: 50 us}\n" + web), IsEmpty());
  EXPECT_THAT(
      built("scene: {duration: 1 s, step: 1 ms}\nplants: {knife: {type: rotary_knife}, web: {type: web}}\n"),
      ElementsAre(testing::StartsWith("line.yaml:2:10: knife.gear.stiffness: motor and drum oscillate at "
                                      "120.3 Hz, steps of 1000 us cannot follow"),
                  testing::StartsWith("line.yaml:2:10: knife.servo.speed_gain: the speed loop of 250 "
                                      "rad/s")));
}

}  // namespace
}  // namespace drycut::sim::scenario
