// The PLCopen controller as the simulation sees it: terminals, values by name, events, power.
#include "devices/plcopen/controller/controller.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace drycut::devices::plcopen {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* turning_line = R"(PROGRAM line
VAR_EXTERNAL Web : AXIS_REF; Knife : AXIS_REF; Line : AXIS_REF; END_VAR
VAR
  start AT %IX0.0 : BOOL;
  lamp AT %QX1.2 : BOOL;
  speed : LREAL := 10000.0;
  divisor : DINT := 1;
  quotient : DINT;
  late : TIME := T#1s500ms;
  Power : MC_Power;
  Move : MC_MoveVelocity;
END_VAR
VAR RETAIN pieces : DINT := 5; total : LREAL; END_VAR
Power(Axis := Knife, Enable := start);
Move(Axis := Knife, Execute := Power.Status, Velocity := speed);
lamp := Power.Status;
quotient := 10 / divisor;
END_PROGRAM
)";

// A controller with an encoder axis, a drive axis in deg and a virtual axis in mm. The knife's drive turns as
// fast as it is told, exactly.
struct Rig {
  static PlcopenConfiguration configuration() {
    PlcopenConfiguration made;
    AxisConfiguration web{"Web", {}, Measure::length};
    web.parameters.kind = AxisKind::encoder;
    web.parameters.modulo = 8'000'000;
    web.parameters.path_increments = 5'000'000;
    AxisConfiguration knife{"Knife", {}, Measure::angle};
    knife.parameters.a_max = 100'000;
    knife.parameters.tr_min = 1'000;
    AxisConfiguration line{"Line", {}, Measure::length};
    line.parameters.kind = AxisKind::virtual_axis;
    line.parameters.homed_at_start = true;
    made.axes = {web, knife, line};
    McCamTable table;
    table.file = "knife.tab";
    table.id = 1;
    table.type = 7;
    table.values = {0, 0, 1'800'000, 1'800'000, 2'700'000, 2'700'000};
    made.tables = {table};
    return made;
  }
  static st::Program program(const std::string& text) {
    Problems problems;
    auto compiled = st::compile(text, "line.st", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return compiled;
  }
  explicit Rig(const std::string& text = turning_line, const PlcopenConfiguration& made = configuration())
      : controller(program(text), "line.st", made) {}

  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i, time += 1'000'000) {
      controller.run_devices(time);
      controller.run_tasks(time);
      const double volts =
          controller.cards().analogue_outputs.at(address("Knife.reference")).word * 10.0 / 32767;
      knife_counts += volts / 10 * 1'000'000 * 10 * 0.001 * 10'000 / 3'600'000;
      count("Knife.encoder") = std::llround(knife_counts);
    }
  }
  Address address(const std::string& text) {
    const auto found = controller.terminal(text);
    if (const auto* fault = std::get_if<TerminalFault>(&found)) {
      ADD_FAILURE() << fault->what;
      return {};
    }
    return std::get<Address>(found);
  }
  std::string fault(const std::string& text) {
    const auto found = controller.terminal(text);
    const auto* fault = std::get_if<TerminalFault>(&found);
    return fault == nullptr ? "" : fault->what + "; " + fault->remedy;
  }
  bool& input(const std::string& text) { return controller.cards().inputs.at(address(text)).level; }
  bool output(const std::string& text) { return controller.cards().outputs.at(address(text)).level; }
  std::int64_t& count(const std::string& text) { return controller.cards().counters.at(address(text)).count; }
  double read(const std::string& name) {
    const auto value = controller.find(name);
    if (!value) ADD_FAILURE() << name;
    return value ? value->read() : 0;
  }
  void expect(const std::vector<std::pair<std::string, double>>& values) {
    for (const auto& [name, value] : values) EXPECT_EQ(read(name), value) << name;
  }
  void write(const std::string& name, double number) {
    const auto value = controller.find(name);
    ASSERT_TRUE(value && value->write) << name;
    value->write(number);
  }
  std::vector<std::string> told() {
    std::vector<std::string> texts;
    for (const auto& event : controller.take_events())
      texts.push_back(event.source + " " + event.event + ": " + event.text);
    return texts;
  }

  PlcopenController controller;
  double knife_counts = 0;
  std::int64_t time = 0;
};

TEST(PlcopenTerminals, AreNamedByAxisAndByTheProgramsAddresses) {
  Rig rig;
  for (const std::string name : {"Web.encoder", "Web.probe", "Knife.encoder", "Knife.reference",
                                 "Knife.enable", "Knife.ready", "Knife.emergency_stop", "Knife.feed_enable",
                                 "Knife.feed_hold", "Knife.probe", "Line.feed_hold", "IX0.0", "QX1.2"})
    EXPECT_EQ(rig.controller.terminal_name(rig.address(name)), name);
  EXPECT_EQ(rig.address("knife.ENCODER"), rig.address("Knife.encoder")) << "any case";
  EXPECT_EQ(rig.address("%ix0.0"), rig.address("IX0.0"));
  EXPECT_NE(rig.address("Knife.ready"), rig.address("Knife.feed_enable"));
}

TEST(PlcopenTerminals, WhatIsNoneIsRefusedWithWhatThereIs) {
  Rig rig;
  EXPECT_EQ(rig.fault("2.CNT01"), "'2.CNT01' is no terminal: there is no axis '2'; axes: Web, Knife, Line");
  EXPECT_EQ(rig.fault("Knif.encoder"),
            "'Knif.encoder' is no terminal: there is no axis 'Knif'; did you mean Knife?");
  EXPECT_EQ(rig.fault("Web.reference"),
            "Web is an encoder axis and has no terminal 'reference'; it has: Web.encoder, Web.probe");
  EXPECT_THAT(rig.fault("Knife.encodr"),
              HasSubstr("Knife is a drive axis and has no terminal 'encodr'; it has: "
                        "Knife.encoder, Knife.reference, Knife.enable"));
  EXPECT_THAT(rig.fault("Line.encoder"), HasSubstr("Line is a virtual axis and has no terminal 'encoder'"));
  EXPECT_EQ(rig.fault("IX0.1"), "the program has no variable AT %IX0.1; its inputs are: IX0.0");
  EXPECT_EQ(rig.fault("QX0.0"), "the program has no variable AT %QX0.0; its outputs are: QX1.2");
  for (const std::string text : {"X0", "IX0.8", "IX.1", "IW0", "Knife", "Knife.", ".encoder", ""})
    EXPECT_THAT(rig.fault(text), HasSubstr("is not a terminal of the controller; write axis.encoder"))
        << text;
}

TEST(PlcopenTerminals, OnlyWhatAnAxisCannotDoWithoutIsThereBeforeItIsWired) {
  Rig rig;
  auto& cards = rig.controller.cards();
  EXPECT_EQ(cards.counters.size(), 2U);
  EXPECT_EQ(cards.analogue_outputs.size(), 1U);
  EXPECT_EQ(cards.inputs.size(), 1U);
  EXPECT_EQ(cards.outputs.size(), 1U);
  rig.address("Knife.ready");
  EXPECT_EQ(cards.inputs.size(), 2U);
}

TEST(PlcopenController, ACommandOfTheProgramMovesTheAxisFromTheNextCycleOn) {
  Rig rig;
  rig.address("Knife.enable");
  rig.input("IX0.0") = true;
  rig.run(2);  // one cycle: the program has switched the axis on
  rig.expect({{"Knife.state", 5}, {"Knife.set_velocity", 0}});
  EXPECT_FALSE(rig.output("Knife.enable")) << "the axis' own cycle was before";
  EXPECT_TRUE(rig.output("QX1.2"));
  rig.run(2);
  EXPECT_TRUE(rig.output("Knife.enable"));
  rig.run(2000);
  EXPECT_EQ(rig.read("Knife.state"), 5);
  EXPECT_NEAR(rig.read("Knife.set_velocity"), 10, 1e-9) << "10000 of 0.001 deg/s";
  EXPECT_NEAR(rig.read("Knife.reference"), 0.1, 1e-3) << "1000 deg/s at 10 V";
  EXPECT_NEAR(rig.read("Knife.actual_velocity"), 10, 20) << "of an encoder with 10000 counts a turn";
  EXPECT_NEAR(rig.read("Knife.actual_position"), rig.read("Knife.set_position"), 0.2);
}

TEST(PlcopenController, TheProgramMayRunSlowerThanTheAxes) {
  auto made = Rig::configuration();
  made.cycle_ns = 1'000'000;
  made.task_ns = 4'000'000;
  Rig rig("PROGRAM p VAR scans : DINT; END_VAR scans := scans + 1; END_PROGRAM\n", made);
  rig.run(16);
  EXPECT_EQ(rig.read("scans"), 4);
  const auto periods = rig.controller.periods();
  EXPECT_EQ(periods.at(0).ns, 1'000'000);
  EXPECT_EQ(periods.at(1).ns, 4'000'000);
  EXPECT_EQ(rig.controller.output_period(rig.address("Knife.reference")), 1'000'000);
}

TEST(PlcopenController, ProgramsRunInTheirTasksAndPassThemWithoutPower) {
  const std::string text =
      "VAR_GLOBAL order : LINT; END_VAR PROGRAM Fast VAR n : INT; lamp AT %QX0.0 : BOOL; END_VAR n := n + 1; "
      "lamp := n > 2; "
      "order := order * 10 + 1; END_PROGRAM PROGRAM Slow VAR n : INT; END_VAR n := n + 1; order := order * "
      "10 + 2; "
      "END_PROGRAM PROGRAM Rest VAR n : INT; END_VAR n := n + 1; order := order * 10 + 3; END_PROGRAM";
  PlcopenConfiguration made = Rig::configuration();
  made.cycle_ns = 1'000'000;
  made.task_ns = 5'000'000;
  made.tasks = {{"slow", 0, 0, 4'000'000, 0, {"slow"}}, {"fast", 0, 0, 2'000'000, 1, {"FAST"}}};
  Rig rig(text, made);
  EXPECT_THAT(rig.controller.periods(), testing::SizeIs(4));
  const auto value = [&](const char* name) { return rig.controller.find(name)->read(); };
  rig.run(1);
  EXPECT_EQ(value("order"), 213);
  rig.run(9);  // up to 9 ms
  EXPECT_EQ(value("Fast.n"), 5);
  EXPECT_EQ(value("Slow.n"), 3);
  EXPECT_EQ(value("Rest.n"), 2);
  rig.controller.power(false);
  rig.run(7);
  rig.controller.power(true);
  rig.run(3);  // 17 to 19 ms: only Fast is due
  EXPECT_EQ(value("Fast.n"), 1);
  EXPECT_EQ(value("Slow.n"), 0);
}

TEST(PlcopenController, PositionsAreInMmOrDegByWhatTheAxisMeasures) {
  Rig rig;
  rig.count("Web.encoder") = 2500;  // 125 mm
  rig.run(2);
  rig.count("Web.encoder") = 2600;  // 5 mm further
  rig.run(2);
  EXPECT_DOUBLE_EQ(rig.read("Web.actual_position"), 5) << "an incremental encoder begins at 0";
  EXPECT_DOUBLE_EQ(rig.read("web.ACTUAL_velocity"), 2500);
  EXPECT_EQ(rig.controller.find("Web.actual_position")->unit, "mm");
  EXPECT_EQ(rig.controller.find("Knife.actual_position")->unit, "deg");
  EXPECT_EQ(rig.controller.find("Web.set_acceleration")->unit, "mm/s2");
  EXPECT_EQ(rig.controller.find("Web.set_jerk")->unit, "mm/s3");
  EXPECT_EQ(rig.controller.find("Knife.set_jerk")->unit, "deg/s3");
  EXPECT_EQ(rig.controller.find("Web.dynamik.vb_max")->unit, "um/s");
  EXPECT_EQ(rig.controller.find("Knife.dynamik.vb_max")->unit, "0.001 deg/s");
  EXPECT_EQ(rig.controller.find("late")->unit, "s");
  EXPECT_DOUBLE_EQ(rig.read("late"), 1.5);
}

TEST(PlcopenController, SetJerkIsTheChangeOfTheCommandedAccelerationInACycle) {
  Rig rig;
  EXPECT_EQ(rig.read("Knife.set_jerk"), 0) << "before the first cycle";
  rig.input("IX0.0") = true;
  rig.write("Knife.dynamik.tr_min", 100'000);
  double most = 0;
  for (int i = 0; i < 60; ++i) {
    const double before = rig.read("Knife.set_acceleration");
    rig.run(2);
    const double jerk = rig.read("Knife.set_jerk");
    EXPECT_NEAR(jerk, (rig.read("Knife.set_acceleration") - before) / 0.002, 1e-3);
    most = std::max(most, jerk);
  }
  EXPECT_NEAR(most, 500'000, 0.1) << "half of a_max in tr_min";
  EXPECT_EQ(rig.read("Knife.set_jerk"), 0) << "at a steady speed";
}

TEST(PlcopenController, EveryNameIsFoundAndHasAValue) {
  Rig rig;
  rig.run(4);
  const auto names = rig.controller.names();
  EXPECT_THAT(names, Contains("Knife.cam_gear.v_phasing"));
  EXPECT_THAT(names, Contains("Move.InVelocity"));
  for (const auto& name : names) {
    const auto value = rig.controller.find(name);
    ASSERT_TRUE(value) << name;
    EXPECT_EQ(value->name, name);
    EXPECT_TRUE(std::isfinite(value->read())) << name;
  }
  for (const std::string name : {"Knife", "Knife.", "Knife.speed", "nothing", "table2[1,1]", "table1[0,1]",
                                 "table1[4,1]", "table1[1,3]", "table1[1]", "table1[1,1]x"})
    EXPECT_FALSE(rig.controller.find(name)) << name;
}

TEST(PlcopenController, AnInputThatIsWiredIsReadAndOneThatIsNotIsHealthyAndCanBeSet) {
  Rig rig;
  rig.input("IX0.0") = true;
  rig.run(1000);
  rig.write("Knife.feed_enable", 0);
  rig.run(1000);
  EXPECT_NEAR(rig.read("Knife.set_velocity"), 0, 1e-6);
  rig.write("Knife.feed_enable", 1);
  rig.run(1000);
  EXPECT_NEAR(rig.read("Knife.set_velocity"), 10, 1e-6);
  rig.input("Knife.feed_hold") = true;
  rig.run(1000);
  EXPECT_NEAR(rig.read("Knife.set_velocity"), 0, 1e-6);
  EXPECT_EQ(rig.read("Knife.feed_hold"), 1);
  EXPECT_FALSE(rig.controller.find("Knife.feed_hold")->write) << "wired";
  EXPECT_THAT(rig.told(), IsEmpty());
}

TEST(PlcopenController, AnAxisInErrorstopSaysWhy) {
  Rig rig;
  rig.input("IX0.0") = true;
  rig.input("Knife.ready") = true;
  rig.run(100);
  rig.input("Knife.ready") = false;
  rig.run(10);
  EXPECT_THAT(rig.told(), Contains(HasSubstr("Knife errorstop: 65")));
  EXPECT_EQ(rig.read("Knife.state"), 7);
  EXPECT_GT(rig.read("Knife.error"), 0);
  rig.run(100);
  EXPECT_THAT(rig.told(), Not(Contains(HasSubstr("errorstop")))) << "told once";
}

TEST(PlcopenController, ABlockThatRefusesSaysWhyOnceForEachError) {
  Rig rig(R"(PROGRAM line
VAR_EXTERNAL Knife : AXIS_REF; END_VAR
VAR go : BOOL; Move : MC_MoveVelocity; END_VAR
Move(Axis := Knife, Execute := go, Velocity := 1000.0);
END_PROGRAM
)");
  rig.run(10);
  EXPECT_THAT(rig.told(), IsEmpty());
  rig.write("go", 1);
  rig.run(10);
  EXPECT_THAT(rig.told(), ElementsAre("Move block_error: 44028 not allowed in Disabled: Knife"));
  rig.write("go", 0);
  rig.run(10);
  rig.write("go", 1);
  rig.run(10);
  EXPECT_THAT(rig.told(), ElementsAre("Move block_error: 44028 not allowed in Disabled: Knife"));
}

TEST(PlcopenController, ARefusalNamesTheAxisThatItIsAbout) {
  PlcopenConfiguration made = Rig::configuration();
  for (AxisConfiguration& axis : made.axes) axis.parameters.is_master = axis.name != "Line";
  made.axes[0].parameters.modulo = 0;
  made.axes[1].parameters.homed_at_start = true;
  Rig rig(R"(PROGRAM line
VAR_EXTERNAL Web : AXIS_REF; Knife : AXIS_REF; Line : AXIS_REF; END_VAR
VAR go : BOOL; Power : MC_Power; Off, Lawless, NoMaster : MC_CamIn; END_VAR
Off(Master := Web, Slave := Line, Execute := go, CamTableID := 1);
Power(Axis := Knife, Enable := TRUE);
Lawless(Master := Web, Slave := Knife, Execute := go, CamTableID := 1);
NoMaster(Master := Line, Slave := Knife, Execute := go, CamTableID := 1);
END_PROGRAM
)",
          made);
  rig.run(10);
  rig.write("go", 1);
  rig.run(10);
  EXPECT_THAT(
      rig.told(),
      testing::UnorderedElementsAre(
          "Off block_error: 44028 not allowed in Disabled: Line",
          "Lawless block_error: 42006 the interpolation is not one of 0..6, or the table names none: Knife",
          "NoMaster block_error: 65010 the master's parameter cam_gear.is_master is 0: Line"));
}

TEST(PlcopenController, ACamBehindALinearMasterNamesTheMaster) {
  PlcopenConfiguration made = Rig::configuration();
  made.axes[0].parameters.is_master = true;
  made.axes[0].parameters.modulo = 0;
  made.axes[1].parameters.homed_at_start = true;
  made.tables[0].interpolation = Interpolation::poly5_line;
  constexpr const char* text = R"(PROGRAM line
VAR_EXTERNAL Web : AXIS_REF; Knife : AXIS_REF; END_VAR
VAR Power : MC_Power; CamIn : MC_CamIn; END_VAR
Power(Axis := Knife, Enable := TRUE);
CamIn(Master := Web, Slave := Knife, Execute := Power.Status, CamTableID := 1);
END_PROGRAM
)";
  Rig rig(text, made);
  rig.run(10);
  EXPECT_THAT(rig.told(), ElementsAre("CamIn block_error: 60181 this cam needs modulo axes: Web"));
  made.axes[0].parameters.modulo = 8'000'000;
  made.axes[1].parameters.modulo = 0;
  Rig other(text, made);
  other.run(10);
  EXPECT_THAT(other.told(), ElementsAre("CamIn block_error: 60181 this cam needs modulo axes: Knife"));
}

TEST(PlcopenController, WhatIsWrittenByTheProgramStaysInTheMachineData) {
  Rig rig(R"(PROGRAM line
VAR_EXTERNAL Knife : AXIS_REF; END_VAR
VAR go : BOOL; Power : MC_Power; Write : MC_WriteParameter; Run : MC_MoveVelocity; END_VAR
Power(Axis := Knife, Enable := TRUE);
Write(Axis := Knife, Execute := go, ParameterNumber := 9, Value := 123000.0);
Run(Axis := Knife, Execute := Write.Done, Velocity := 200000.0);
END_PROGRAM
)");
  rig.run(10);
  rig.write("go", 1);
  rig.run(10);
  EXPECT_EQ(rig.read("Knife.dynamik.vb_max"), 123'000);
  EXPECT_THAT(rig.told(),
              ElementsAre("Knife warning: Velocity 200000 is above dynamik.vb_max: it goes at 123000"));
  rig.controller.power(false);
  rig.controller.power(true);
  EXPECT_EQ(rig.read("Knife.dynamik.vb_max"), 123'000);
}

TEST(PlcopenController, AFaultOfTheProgramNamesItsPlaceOnce) {
  Rig rig;
  rig.write("divisor", 0);
  rig.run(20);
  const auto told = rig.told();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told.front(), HasSubstr("program error: line.st:17:16: division by 0"));
  rig.controller.power(false);
  rig.controller.power(true);
  rig.run(20);
  EXPECT_THAT(rig.told(), IsEmpty()) << "the divisor has its initial value again";
  EXPECT_EQ(rig.read("quotient"), 10);
}

TEST(PlcopenController, AParameterTakesWhatItsTableAllows) {
  Rig rig;
  rig.write("Knife.kv", 3000);
  EXPECT_EQ(rig.read("Knife.kv"), 3000);
  EXPECT_THAT(rig.told(), IsEmpty());
  rig.write("Knife.kv", -1);
  rig.write("Knife.cam_gear.filter_cycles", 1.5);
  EXPECT_THAT(rig.told(),
              ElementsAre("Knife out_of_range: kv is from 0 to 100000, not -1",
                          "Knife out_of_range: cam_gear.filter_cycles is whole, from 1 to 1000, not 1.5"));
  EXPECT_EQ(rig.read("Knife.kv"), 3000);
  rig.write("Knife.override", 101);
  EXPECT_THAT(rig.told(), ElementsAre("Knife out_of_range: override is from 0 to 100, not 101"));
  rig.input("IX0.0") = true;
  rig.run(10);
  rig.write("Knife.modulo", 1'000'000);
  EXPECT_THAT(rig.told(),
              ElementsAre("Knife refused: modulo can be changed only while the axis is Disabled"));
  EXPECT_FALSE(rig.controller.find("Knife.kind")->write);
  EXPECT_FALSE(rig.controller.find("Knife.set_position")->write);
}

TEST(PlcopenController, AnElementOfATableIsWrittenLive) {
  Rig rig;
  EXPECT_EQ(rig.read("table1[2,1]"), 1'800'000);
  rig.write("TABLE1[2,2]", 1'700'000);
  EXPECT_EQ(rig.read("table1[2,2]"), 1'700'000);
  rig.write("table1[2,2]", 1e300);
  EXPECT_THAT(rig.told(), ElementsAre("table1 refused: [2,2] = 1e+300: 44003 Position outside its range"));
  EXPECT_EQ(rig.read("table1[2,2]"), 1'700'000);
  rig.controller.power(false);
  rig.controller.power(true);
  EXPECT_EQ(rig.read("table1[2,2]"), 1'800'000) << "from its file";
}

TEST(PlcopenController, WithoutPowerItsOutputsAreOffAndOnlyRetainVariablesAndMachineDataStay) {
  Rig rig;
  rig.address("Knife.enable");
  rig.input("IX0.0") = true;
  rig.write("pieces", 77);
  rig.write("Knife.kv", 1500);
  rig.write("Knife.override", 50);
  rig.write("speed", 20'000);
  rig.run(1000);
  EXPECT_NE(rig.controller.cards().analogue_outputs.at(rig.address("Knife.reference")).word, 0);
  rig.controller.power(false);
  EXPECT_EQ(rig.controller.cards().analogue_outputs.at(rig.address("Knife.reference")).word, 0);
  EXPECT_FALSE(rig.output("Knife.enable"));
  EXPECT_FALSE(rig.output("QX1.2"));
  rig.run(10);
  EXPECT_FALSE(rig.output("QX1.2"));
  rig.input("IX0.0") = false;
  rig.controller.power(true);
  rig.run(2);
  rig.expect(
      {{"pieces", 77}, {"speed", 10'000}, {"Knife.kv", 1500}, {"Knife.override", 50}, {"Knife.state", 0}});
  EXPECT_EQ(rig.read("Knife.actual_position"), 0) << "counted from power-up";
}

TEST(PlcopenController, WithoutPowerItsVariablesAndAxesReadZero) {
  auto made = Rig::configuration();
  made.axes[1].parameters.homed_at_start = true;
  Rig rig(turning_line, made);
  rig.input("IX0.0") = true;
  rig.run(1000);
  rig.write("Knife.override", 50);
  rig.expect({{"Power.Status", 1}, {"Move.InVelocity", 1}, {"Knife.state", 5}, {"Knife.homed", 1}});
  rig.controller.power(false);
  for (int once = 0; once < 2; ++once, rig.run(10))
    for (const std::string name :
         {"Power.Status", "Move.InVelocity", "start", "lamp", "speed", "late", "quotient", "Knife.state",
          "Knife.powered", "Knife.homed", "Knife.set_velocity", "Knife.actual_velocity", "Knife.set_position",
          "Knife.reference"})
      EXPECT_EQ(rig.read(name), 0) << name;
  EXPECT_EQ(rig.read("pieces"), 5) << "RETAIN";
  EXPECT_EQ(rig.read("Knife.override"), 50) << "the operator's";
  rig.write("Knife.modulo", 1'000'000);
  EXPECT_THAT(rig.told(), IsEmpty()) << "an axis without power takes its machine data";
  rig.write("speed", 20'000);
  rig.controller.power(true);
  EXPECT_EQ(rig.read("speed"), 10'000) << "what was written without power is lost";
  rig.run(1000);
  EXPECT_EQ(rig.read("Move.InVelocity"), 1);
}

TEST(PlcopenController, AnAbsoluteEncoderKnowsWhereItIsAtPowerUp) {
  auto made = Rig::configuration();
  made.axes[0].parameters.homed_at_start = true;
  Rig rig(turning_line, made);
  rig.count("Web.encoder") = 2500;
  rig.run(2);
  EXPECT_DOUBLE_EQ(rig.read("Web.actual_position"), 125);
  EXPECT_EQ(rig.read("Web.homed"), 1);
}

TEST(PlcopenController, RetainVariablesComeBackFromTheirText) {
  Rig rig;
  rig.write("pieces", -3);
  rig.write("total", 0.1);
  const auto text = rig.controller.retentive_state();
  EXPECT_EQ(text, "; RETAIN variables of line.st\npieces = -3\ntotal = 0.1\n");
  Rig other;
  Problems problems;
  EXPECT_TRUE(other.controller.restore(text, problems));
  EXPECT_EQ(other.read("pieces"), -3);
  EXPECT_EQ(other.read("total"), 0.1);
  EXPECT_EQ(other.controller.retentive_state(), text);
}

TEST(PlcopenController, AWrongRetentiveTextIsRefusedWhole) {
  Rig rig;
  Problems problems;
  EXPECT_FALSE(rig.controller.restore(
      "pieces = 9\nPIECES = 8\nspeed = 1\nnothing = 1\ntotal\ntotal = x\n  pieces = 1e99 ; far\n", problems,
      "kept"));
  std::vector<std::string> told;
  for (const auto& problem : problems) told.push_back(to_string(problem));
  EXPECT_THAT(
      told,
      ElementsAre("kept:2:1: 'PIECES' is given twice; remove one of the lines [controller.retained-twice]",
                  "kept:3:1: the program has no RETAIN variable 'speed'; remove the line "
                  "[controller.unknown-retained]",
                  "kept:4:1: the program has no RETAIN variable 'nothing'; remove the line "
                  "[controller.unknown-retained]",
                  "kept:5:1: 'total' is no value; write: name = value [controller.retained-value]",
                  HasSubstr("kept:6:9: total cannot be 'x'; write a number from "),
                  "kept:7:3: 'pieces' is given twice; remove one of the lines [controller.retained-twice]"));
  EXPECT_EQ(rig.read("pieces"), 5);
}

TEST(PlcopenController, ARisingEdgeOfTheProbeLatchesTheCountOfItsOwnAxis) {
  auto made = Rig::configuration();
  Rig rig(R"(PROGRAM line
VAR_EXTERNAL Web : AXIS_REF; END_VAR
VAR Probe : MC_TouchProbe; END_VAR
Probe(Axis := Web, Execute := TRUE);
END_PROGRAM
)",
          made);
  const int line = rig.address("Web.probe").number;
  rig.count("Web.encoder") = 40;  // at power-up: 0 of the axis
  rig.run(10);
  rig.count("Web.encoder") = 340;
  rig.controller.cards().counters.at(rig.address("Web.encoder")).latched = 290;
  rig.controller.interrupt(line, false);
  rig.run(10);
  EXPECT_EQ(rig.read("Probe.Done"), 0) << "a falling edge";
  rig.controller.interrupt(rig.address("Knife.probe").number, true);
  rig.run(10);
  EXPECT_EQ(rig.read("Probe.Done"), 0) << "another axis";
  rig.controller.interrupt(line, true);
  rig.run(10);
  EXPECT_EQ(rig.read("Probe.Done"), 1);
  EXPECT_DOUBLE_EQ(rig.read("Probe.RecordedPosition"), 125'000) << "250 counts of 0.05 mm";
}

}  // namespace
}  // namespace drycut::devices::plcopen
