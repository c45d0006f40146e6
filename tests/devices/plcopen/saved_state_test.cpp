// The state as data: at any moment it becomes bytes, and from these the run goes on as if nothing had been,
// in the same controller and in one freshly made.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/state_archive.hpp"
#include "devices/plcopen/controller/controller.hpp"

namespace drycut::devices::plcopen {
namespace {

using testing::Contains;
using testing::IsSupersetOf;

// What runs, and what an operator and a machine do to it at the times of their steps.
struct StateScene {
  std::string program;
  std::int64_t statement_ns = 0;
  std::int64_t task_ns = MotionKernel::default_cycle_ns;
  std::map<int, std::vector<std::pair<std::string, double>>> inputs = {};  ///< terminals
  std::map<int, std::vector<std::pair<std::string, double>>> writes = {};  ///< values
  std::map<int, bool> power = {};
  std::set<int> probes = {};  ///< steps at which the knife's probe sees an edge
};

// A controller whose drive turns as fast as it is told, at 1 ms a step.
struct StateRig {
  explicit StateRig(const StateScene& in)
      : scene(in), controller(program(in.program), "line.st", configuration(in)) {
    for (const auto& name : controller.names()) values.push_back(*controller.find(name));
    for (const char* name : {"table1[2,1]", "table1[5,1]", "table2[3,1]"})
      values.push_back(*controller.find(name));
    input("Knife.ready") = true;
  }
  static PlcopenConfiguration configuration(const StateScene& in) {
    PlcopenConfiguration made;
    made.statement_ns = in.statement_ns;
    made.task_ns = in.task_ns;
    AxisConfiguration web{"Web", {}, Measure::length};
    web.parameters.kind = AxisKind::encoder;
    web.parameters.is_master = true;
    web.parameters.average_filter = true;
    AxisConfiguration knife{"Knife", {}, Measure::angle};
    knife.parameters.tr_min = 10'000;
    knife.parameters.a_max = 50'000;
    knife.parameters.v_phasing = 200'000;
    knife.parameters.a_phasing = knife.parameters.d_phasing = 10'000;
    knife.parameters.j_phasing = 500'000;
    AxisConfiguration line{"Line", {}, Measure::angle};
    line.parameters.kind = AxisKind::virtual_axis;
    line.parameters.homed_at_start = true;
    line.parameters.is_master = true;
    AxisConfiguration cut = line;
    cut.name = "Cut";
    cut.parameters.tr_min = 10'000;
    cut.parameters.j_vel_sync = 500'000;
    cut.parameters.v_phasing = 500'000;
    cut.parameters.a_phasing = cut.parameters.d_phasing = 5'000;
    cut.parameters.j_phasing = 500'000;
    AxisConfiguration saw = cut;
    saw.name = "Saw";
    saw.parameters.modulo = 0;
    saw.parameters.swe_neg = -3'000'000;
    saw.parameters.swe_pos = 3'000'000;
    made.axes = {web, knife, line, cut, saw};
    McCamTable pairs{.file = "knife.tab",
                     .name = "knife",
                     .id = 1,
                     .type = 7,
                     .interpolation = Interpolation::polynom_3,
                     .values = {}};
    pairs.type = 3;
    pairs.values = {0, 500'000, 900'000, 1'400'000, 1'800'000, 2'300'000, 2'700'000, 3'200'000};
    McCamTable swing{.file = "saw.tab",
                     .name = "saw",
                     .id = 2,
                     .type = 3,
                     .interpolation = Interpolation::polynom_3,
                     .values = {0, 300'000, 600'000, 200'000}};
    made.tables = {pairs, swing};
    return made;
  }
  static st::Program program(const std::string& text) {
    Problems problems;
    auto compiled = st::compile(text, "line.st", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return compiled;
  }
  Address address(const std::string& name) { return std::get<Address>(controller.terminal(name)); }
  bool& input(const std::string& name) { return controller.cards().inputs.at(address(name)).level; }
  Counter& counter(const std::string& name) { return controller.cards().counters.at(address(name)); }

  // What the timeline does at a step.
  void stimulate() {
    if (const auto at = scene.power.find(steps); at != scene.power.end()) controller.power(at->second);
    if (const auto at = scene.inputs.find(steps); at != scene.inputs.end())
      for (const auto& [name, level] : at->second) input(name) = level != 0;
    if (const auto at = scene.writes.find(steps); at != scene.writes.end())
      for (const auto& [name, value] : at->second) controller.find(name).value().write(value);
    web.count = steps * 7 + steps * steps / 100;
    if (!scene.probes.contains(steps)) return;
    knife.latched = knife.count - 3;
    controller.interrupt(2, true);
  }
  // Adds what is seen of a step.
  void step(std::vector<double>& told) {
    const auto text = [&](const std::string& seen) {
      told.push_back(static_cast<double>(std::hash<std::string>{}(seen) % 1'000'000));
    };
    stimulate();
    controller.run_devices(steps * ms);
    controller.run_tasks(steps * ms);
    ++steps;
    for (const auto& [key, output] : controller.cards().outputs) told.push_back(output.level ? 1 : 0);
    constexpr double counts_per_bit = 1'000'000 * 10 * 0.001 * 10'000 / 3'600'000 / 32767;
    knife_counts += reference.word * counts_per_bit;
    knife.count = std::llround(knife_counts);
    for (const auto& value : values) told.push_back(value.read());
    for (const auto& cam : cams) {
      const CamMoment moment = cam.moment();
      for (const double number : {static_cast<double>(cam.start()), moment.master, moment.set})
        told.push_back(number);
    }
    for (const auto& task : controller.positions(steps * ms - ms / 2).tasks) text(task.name + task.doing);
    if (steps % 40 != 0) return;
    told.push_back(static_cast<double>(controller.waits().size()));
    // Events stay a while, so that some are there to be saved.
    for (const auto& event : controller.take_events()) text(event.source + event.event + event.text);
  }
  std::vector<double> run(int times) {
    std::vector<double> told;
    for (int i = 0; i < times; ++i) step(told);
    return told;
  }

  void visit(StateArchive& archive) { STATE(archive, controller, knife_counts, steps); }
  StateArchive::Bytes saved(std::vector<StateArchive::Member>* list = nullptr) {
    StateArchive::Bytes bytes;
    StateArchive::save(bytes, *this, list);
    return bytes;
  }
  void restore(const StateArchive::Bytes& bytes) {
    auto archive = StateArchive::restoring(bytes.data(), bytes.size());
    visit(archive);
    EXPECT_EQ(archive.left(), 0U);
  }

  static constexpr std::int64_t ms = 1'000'000;
  const StateScene& scene;
  PlcopenController controller;
  Counter& web = counter("Web.encoder");
  Counter& knife = counter("Knife.encoder");
  AnalogueOutput& reference = controller.cards().analogue_outputs.at(address("Knife.reference"));
  double knife_counts = 0;
  int steps = 0;
  std::vector<ControllerValue> values;
  std::vector<CamAxis> cams = controller.cam_axes();
};

bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// At each of the moments, a run and the three that begin from its bytes. What was in the midst of something,
// by the names of its members; "Cut in phase 3".
std::set<std::string> goes_on_as_before(const StateScene& scene, int every, int until) {
  std::set<std::string> met;
  StateRig whole(scene);
  StateRig other(scene);  // has run on to other moments, earlier and later ones in turn
  for (int moment = 0; moment < until && !testing::Test::HasFailure(); moment += every) {
    SCOPED_TRACE(testing::Message() << "at step " << moment);
    constexpr int rest = 80;
    std::vector<StateArchive::Member> list;
    const auto bytes = whole.saved(&list);
    for (const auto& member : list) met.insert(member.name.substr(member.name.find('.') + 1));
    for (const std::string axis : {"Knife", "Cut", "Saw", "Line"})
      for (const std::string value : {"coupling_phase", "state"})
        met.insert(fmt::format("{} {} {}", axis, value,
                               whole.controller.find(fmt::format("{}.{}", axis, value))->read()));
    const auto told = whole.run(rest);
    const auto end = whole.saved();

    StateRig fresh(scene);
    for (StateRig* rig : {&whole, &other, &fresh}) {
      rig->restore(bytes);
      EXPECT_EQ(rig->steps, moment);
      EXPECT_TRUE(rig->saved() == bytes);
      EXPECT_TRUE(same_numbers(rig->run(rest), told));
      EXPECT_TRUE(rig->saved() == end);
    }
    if (moment % (2 * every) == 0) other.run(200);
    whole.restore(bytes);
    whole.run(every);
  }
  return met;
}

constexpr const char* movements = R"(
TYPE Pair : STRUCT low : DINT; high : LREAL; name : STRING[12]; END_STRUCT; END_TYPE
FUNCTION_BLOCK Counter
VAR_INPUT on : BOOL; END_VAR
VAR_OUTPUT n : DINT; END_VAR
VAR Edge : R_TRIG; seen : ARRAY[0..3] OF DINT; END_VAR
Edge(CLK := on);
IF Edge.Q THEN n := n + 1; seen[n MOD 4] := n; END_IF;
END_FUNCTION_BLOCK
PROGRAM line
VAR_EXTERNAL Saw : AXIS_REF; Line : AXIS_REF; Knife : AXIS_REF; END_VAR
VAR
  start AT %IX0.0 : BOOL; lamp AT %QX0.0 : BOOL; blink AT %QX0.1 : BOOL;
  n : DINT; m : DINT; text : STRING; pairs : ARRAY[1..3] OF Pair; word AT %MW3 : INT;
  PowerSaw : MC_Power; PowerLine : MC_Power; PowerKnife : MC_Power;
  Away : MC_MoveAbsolute; More : MC_MoveRelative; Further : MC_MoveAdditive; On : MC_MoveVelocity;
  Extra : MC_MoveSuperImposed; Halt : MC_Halt; Stop : MC_Stop; Slow : MC_SetOverride; Home : MC_Home;
  Status : MC_ReadStatus; Motion : MC_ReadMotionState; Probe : MC_TouchProbe; Turn : MC_MoveVelocity;
  Reset : MC_Reset; Fault : MC_ReadAxisError; Param : MC_WriteParameter; Zero : MC_SetPosition;
  Late : TON; Early : TOF; Pulse : TP; Ups : CTU; Starts : Counter;
END_VAR
VAR RETAIN total : LREAL; END_VAR
n := n + 1;
m := n MOD 700;
total := total + 0.25;
text := CONCAT('n', DINT_TO_STRING(n));
pairs[1 + n MOD 3].low := n; pairs[1 + n MOD 3].high := total; pairs[2].name := text;
word := DINT_TO_INT(n);
Late(IN := m MOD 100 > 40, PT := T#90ms); Early(IN := m MOD 100 > 80, PT := T#70ms);
Pulse(IN := m MOD 50 = 7, PT := T#35ms); Ups(CU := Pulse.Q, PV := 5, R := Late.Q);
Starts(on := start);
PowerSaw(Axis := Saw, Enable := TRUE); PowerLine(Axis := Line, Enable := TRUE);
PowerKnife(Axis := Knife, Enable := m > 5);
Away(Axis := Saw, Execute := m > 10 AND m < 600, Position := 800000.0, Velocity := 500000.0);
More(Axis := Saw, Execute := m > 30 AND m < 500, Distance := -300000.0, Velocity := 200000.0,
     BufferMode := mcBuffered);
Further(Axis := Saw, Execute := m > 35 AND m < 45, Distance := -200000.0, Velocity := 300000.0,
     BufferMode := mcBlendingHigh);
Extra(Axis := Saw, Execute := m > 20 AND m < 90, Distance := 50000.0, VelocityDiff := 100000.0);
On(Axis := Line, Execute := m > 20 AND m < 300, Velocity := 360000.0);
Halt(Axis := Line, Execute := m > 250 AND m < 280);
Stop(Axis := Line, Execute := m > 262 AND m < 450);
Slow(Axis := Line, Enable := m > 150 AND m < 200, VelFactor := 0.5);
Home(Axis := Knife, Execute := m > 20, Position := 123456.0);
Turn(Axis := Knife, Execute := m > 40 AND m < 400, Velocity := 300000.0);
Probe(Axis := Knife, Execute := m > 60 AND m < 130);
Reset(Axis := Knife, Execute := m > 460 AND m < 480);
Zero(Axis := Knife, Execute := m > 30 AND m < 36, Position := 999.0);
Param(Axis := Saw, Execute := m > 550 AND m < 560, ParameterNumber := 13, Value := 9000.0);
Status(Axis := Saw, Enable := TRUE); Motion(Axis := Saw, Enable := TRUE);
Fault(Axis := Knife, Enable := TRUE);
lamp := Late.Q; blink := Pulse.Q;
END_PROGRAM
)";

TEST(PlcopenSavedState, OfMovementsTimersAndErrorsGoesOn) {
  StateScene scene{movements};
  scene.inputs = {{100, {{"IX0.0", 1}}},
                  {160, {{"IX0.0", 0}}},
                  {690, {{"Knife.ready", 0}}},
                  {730, {{"Knife.ready", 1}}},
                  {1200, {{"IX0.0", 1}}}};
  scene.writes = {{300, {{"Line.override", 60}}},
                  {420, {{"Line.override", 100}}},
                  {310, {{"Saw.kv", 1500}}},
                  {500, {{"total", 7}}}};
  scene.probes = {150, 190};
  EXPECT_THAT(goes_on_as_before(scene, 41, 1600),
              IsSupersetOf({"kernel_.Saw.waiting_.1.request.way", "kernel_.Saw.overlay_.ticket",
                            "kernel_.Saw.target_.part", "kernel_.Knife.profile_.phases.3.jerk",
                            "events_.0.text", "Saw state 4", "Line state 5", "Line state 3", "Knife state 7",
                            "Knife state 5", "Knife state 2"}));
}

constexpr const char* couplings = R"(PROGRAM line
VAR_EXTERNAL Web : AXIS_REF; Knife : AXIS_REF; Line : AXIS_REF; Cut : AXIS_REF; Saw : AXIS_REF; END_VAR
VAR
  n : DINT;
  P1 : MC_Power; P2 : MC_Power; P3 : MC_Power; P4 : MC_Power;
  Run : MC_MoveVelocity; Select : MC_CamTableSelect; Cam : MC_CamIn; Again : MC_CamIn; Once : MC_CamIn;
  Out : MC_CamOut; Gear : MC_GearIn; GearOff : MC_GearOut; Phase : MC_Phasing; Extra : MC_MoveSuperImposed;
  Home : MC_Home; Write : CAM_TABLE_WRITE; Longer : CAM_TABLE_WRITE; Info : MC_ReadAxisInfo; Away : MC_MoveAbsolute;
  ends : DINT; table : MC_CAM_REF := (File := 'knife.tab');
END_VAR
n := n + 1;
P1(Axis := Line, Enable := TRUE); P2(Axis := Cut, Enable := TRUE); P3(Axis := Saw, Enable := TRUE);
P4(Axis := Knife, Enable := TRUE);
Run(Axis := Line, Execute := n > 5, Velocity := 720000.0);
Select(Master := Line, Slave := Cut, Execute := n > 8, CamTable := table);
Cam(Master := Line, Slave := Cut, Execute := n > 30 AND n < 500, CamTableID := Select.CamTableID,
    StartMode := HLI_CI_F_PERIODIC OR HLI_CI_ENDLESS_POSITIVE);
IF Cam.EndOfProfile THEN ends := ends + 1; END_IF;
Write(Execute := n > 330 AND n < 335, CamTableID := 1, Line := 2, Column := 1, Value := 520000.0);
Longer(Change := n > 300 AND n < 420, CamTableID := 2);
Phase(Master := Line, Slave := Cut, Execute := n > 360 AND n < 500, PhaseShift := 400000.0,
      Velocity := 200000.0);
Extra(Axis := Cut, Execute := n > 420 AND n < 430, Distance := 100000.0, VelocityDiff := 50000.0);
Again(Master := Line, Slave := Cut, Execute := n > 470 AND n < 600, CamTableID := 1, StartMode := 16#30,
      MasterOffset := 1000.0);
Out(Slave := Cut, Execute := n > 620);
Away(Axis := Saw, Execute := n > 10 AND n < 200, Position := 400000.0, Velocity := 400000.0);
Once(Master := Line, Slave := Saw, Execute := n > 30 AND (n MOD 230 > 40), CamTableID := 2,
     BufferMode := mcBuffered);
Home(Axis := Knife, Execute := n > 10);
Gear(Master := Web, Slave := Knife, Execute := n > 60 AND n < 600, RatioNumerator := 2,
     RatioDenominator := 3, Mode := 16#80, Acceleration := 20000.0, Jerk := 2000000.0);
GearOff(Slave := Knife, Execute := n > 640);
Info(Axis := Knife, Enable := TRUE);
END_PROGRAM
)";

TEST(PlcopenSavedState, OfCamsAndGearsGoesOn) {
  StateScene scene{couplings};
  scene.writes = {{500, {{"table1[5,1]", 1'850'000}}}, {900, {{"Line.override", 80}}}};
  EXPECT_THAT(
      goes_on_as_before(scene, 29, 1500),
      IsSupersetOf({"kernel_.Cut.coupling_.law_.curve.pieces.7.law.c",
                    "kernel_.Cut.coupling_.shift_profile_.count", "kernel_.Cut.overlay_.ticket",
                    "kernel_.Knife.coupling_.law_.numerator", "kernel_.Saw.waiting_.0.request.start_mode",
                    "Cut coupling_phase 1", "Cut coupling_phase 3", "Cut coupling_phase 5",
                    "Knife coupling_phase 2", "Knife coupling_phase 5", "Saw coupling_phase 4",
                    "Saw coupling_phase 5", "Cut state 5"}));
}

constexpr const char* tasks = R"(VAR_GLOBAL edge : BOOL; divisor : DINT := 1; quotient : DINT; END_VAR
PROGRAM fast
VAR n : DINT; i : INT; END_VAR
VAR_EXTERNAL Saw : AXIS_REF; END_VAR
VAR Power : MC_Power; END_VAR
Power(Axis := Saw, Enable := TRUE);
n := n + 1;
edge := n MOD 30 > 10;
IF n MOD 40 > 30 THEN FOR i := 1 TO 30 DO quotient := quotient + i; END_FOR; END_IF;
quotient := n / divisor;
END_PROGRAM
PROGRAM slow
VAR n : DINT; END_VAR
n := n + 1;
END_PROGRAM
PROGRAM edges
VAR n : DINT; END_VAR
n := n + 1;
END_PROGRAM
CONFIGURATION c
TASK T1(INTERVAL := T#2ms, PRIORITY := 1);
TASK T2(INTERVAL := T#10ms, PRIORITY := 5);
TASK T3(SINGLE := edge, PRIORITY := 3);
PROGRAM F WITH T1 : fast;
PROGRAM S WITH T2 : slow;
PROGRAM E WITH T3 : edges;
END_CONFIGURATION
)";

TEST(PlcopenSavedState, OfTasksWhoseStatementsTakeTimeGoesOn) {
  StateScene scene{tasks, 150'000};
  scene.writes = {{400, {{"divisor", 0}}}};
  scene.power = {{450, false}, {500, true}};
  EXPECT_THAT(goes_on_as_before(scene, 11, 600),
              IsSupersetOf({"computing_.task", "late_.0", "runtime_.fault.text"}));
}

constexpr const char* rare_scans = R"(PROGRAM line
VAR_EXTERNAL Saw : AXIS_REF; END_VAR
VAR n : DINT; Power : MC_Power; A : MC_MoveRelative; B : MC_MoveRelative; C : MC_MoveRelative; END_VAR
n := n + 1;
Power(Axis := Saw, Enable := TRUE);
A(Axis := Saw, Execute := n MOD 8 > 3, Distance := 1000.0, Velocity := 500000.0);
B(Axis := Saw, Execute := n MOD 8 > 3, Distance := 3000.0, Velocity := 500000.0, BufferMode := mcBuffered);
C(Axis := Saw, Execute := n MOD 8 > 3, Distance := -4000.0, Velocity := 500000.0, BufferMode := mcBuffered);
END_PROGRAM
)";

TEST(PlcopenSavedState, OfCommandsThatEndBetweenScansGoesOn) {
  const StateScene scene{.program = rare_scans, .task_ns = 20'000'000};
  EXPECT_THAT(goes_on_as_before(scene, 7, 300), Contains("kernel_.Saw.ended_.3.state.progress"));
}

TEST(PlcopenSavedState, OfAPowerCycleGoesOn) {
  StateScene scene{movements};
  scene.writes = {{100, {{"Saw.kv", 1500}, {"Cut.cam_gear.v_phasing", 1000}}}};
  scene.power = {{400, false}, {500, true}};
  EXPECT_THAT(goes_on_as_before(scene, 31, 800), Contains("Saw state 0"));
}

TEST(PlcopenSavedState, OfAnotherProgramIsRefused) {
  const StateScene one{movements};
  const StateScene two{couplings};
  const auto bytes = StateRig(one).saved();
  EXPECT_THROW(StateRig(two).restore(bytes), BadState);
}

// The lines are those of the moment that was left.
TEST(PlcopenSavedState, ForgetsWhatWasWatched) {
  const StateScene scene{movements};
  StateRig rig(scene);
  const auto bytes = rig.saved();
  rig.controller.watch_programs(true);
  rig.run(20);
  EXPECT_NE(rig.controller.positions(0).scanned.at(0), "");
  rig.restore(bytes);
  EXPECT_EQ(rig.controller.positions(0).scanned.at(0), "");
  rig.run(20);
  EXPECT_NE(rig.controller.positions(0).scanned.at(0), "") << "still watched";
}

}  // namespace
}  // namespace drycut::devices::plcopen
