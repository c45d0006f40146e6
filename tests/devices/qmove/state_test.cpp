// A moment of a run, saved and put back: the run goes on as if nothing had been.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/state_archive.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/qmove_controller.hpp"

namespace drycut::devices::qmove::state {
namespace {

// All types of devices; two that share an analogue output, two that share contactors.
constexpr std::string_view cnf =
    "CONST\ncStep 700\n"
    "SYSTEM\nslRounds L\nsbSmall B\n"
    "GLOBAL\ngbPhase B\ngbGauge B\ngbPress B\nglSeen L\nglI L\nglJ L\nglBad L\ngsMean S\n"
    "ARRSYS\nasQuota L 4\n"
    "ARRGBL\nagSeen W 5\n"
    "TIMER\ntmGauge\ntmPress\ntmWatch\ntmCam\n"
    "DATAGROUP\ndgCut\nDATAPROGRAM 2\nddlHead L\nSTEP 3\nddlRow L\n"
    "BUS\n1 1CPUB 02\n2 1MIXA 00\n"
    "INPUT\nifGo F 2.INP09\n"
    "OUTPUT\nofLamp F 2.OUT09\n"
    "INTDEVICE\n"
    "Master EANPOS 2 1.CNT01 X X.X X.X\n"
    "AxisX CAMMING4 2 2.CNT01 1.CNT01 X.X 1 2.INP01 2 2.INP02 2.INP03 5 2.AN01 2.OUT01\n"
    "Gauge EPICPOS 2 2.CNT02 3 2.INP04 2.AN02\n"
    "Lift EANPOS 3 2.CNT03 X 2.INP05 2.AN02\n"
    "Press OOPOS2 2 2.CNT04 4 2.INP06 2.OUT02 2.OUT03 X.X X.X 2.OUT04 2.OUT05\n"
    "Ram OOPOS2 4 2.CNT05 X 2.INP07 2.OUT06 2.OUT07 X.X X.X X.X X.X\n"
    "Hmi MODBUS 0002 1\n"
    "END\n";

// A search, then a cam with all kinds of sectors on a master that also turns back.
constexpr std::string_view cam_module = R"(
Master:cntratio = 100000
Master:decpt = 0
Master:unitvel = 1
Master:maxvel = 60000
Master:setvel = 9000
Master:maxpos = 999999
Master:minpos = -999999
Master:rampmode = 0
Master:taccdec = 30
Master:feedfw = 1000
Master:tinvt = 7
INIT Master
WAIT Master:st_init
CNTUNLOCK Master
CNTDIR Master
REGON Master
LOOPOFF Master
WAIT NOT Master:st_regoff
AxisX:decpt = 0
AxisX:measure = 1000
AxisX:pulse = 4001
AxisX:measurem = 1000
AxisX:pulsem = 4000
AxisX:unitvel = 1
AxisX:maxvel = 64000
AxisX:setvel = 9000
AxisX:prsvel = 6000
AxisX:sprsvel = 1500
AxisX:tacc = 40
AxisX:tdec = 30
AxisX:taccmax = 20
AxisX:tdecmax = 20
AxisX:minpos = -999999
AxisX:maxpos = 999999
AxisX:toll = 20
AxisX:syncrange = 30
AxisX:maxfollerr = 300
AxisX:ramptype = 1
AxisX:rtype = 1
AxisX:prsmode = 1
AxisX:prsdir = 0
AxisX:prspos = 500
AxisX:prsmodem = 1
AxisX:funOut = 7
AxisX:pgain = 300
AxisX:feedfw = 900
AxisX:integt = 200
AxisX:derivt = 2
INIT AxisX
WAIT AxisX:st_init
LOOPON AxisX
WAIT AxisX:st_loopon
CNTUNLOCK AxisX
CNTDIR AxisX
CNTUNLOCKM AxisX
CNTDIRM AxisX
REGON AxisX
WAIT NOT AxisX:st_regoff
gbPhase = 1
PRESETM AxisX
PRESET AxisX
MANFW Master
WAIT AxisX:st_prsok
AxisX:setvel = 9000
AxisX:setpos = 0
START AxisX
WAIT AxisX:st_still
CALL Table
MAIN:
gbPhase = 2
AxisX:positm = 0
STARTCAM AxisX
WAIT AxisX:st_camex
gbPhase = 3
tmCam = 900
WAIT tmCam
LOOPOFF AxisX
tmCam = 60
WAIT tmCam
LOOPON AxisX
AxisX:inpcapt = 2
AxisX:funInp = 5
AxisX:intcapt = 2
AxisX:funInt = 6
ENBL AxisX
INTENBL AxisX
AxisX:toll = 21
tmCam = 300
WAIT tmCam
STOP Master
WAIT Master:st_still
MANBW Master
tmCam = 250
WAIT tmCam
STOP Master
WAIT Master:st_still
MANFW Master
tmCam = 700
WAIT tmCam
AxisX:codeQs11 = 500
tmCam = 200
WAIT tmCam
AxisX:codeQsa11 = 1
tmCam = 500
WAIT tmCam OR NOT AxisX:st_camex
IF AxisX:st_camex
    STOPCAM AxisX
    WAIT AxisX:st_still AND NOT AxisX:st_camex
ENDIF
IF AxisX:st_error
    glBad = glBad + 1
    RSERR AxisX
    RESUME AxisX
    WAIT NOT AxisX:st_error
ENDIF
slRounds = slRounds + 1
JUMP MAIN

SUB Table
    AxisX:codeG1 = 160
    AxisX:codeQm1 = 800
    AxisX:codeG2 = 232
    AxisX:codeQm2 = 1600
    AxisX:codeQs2 = 800
    AxisX:codeM2 = 1000
    AxisX:codeG3 = 133
    AxisX:codeQm3 = 900
    AxisX:codeQs3 = 900
    AxisX:codeG4 = 180
    AxisX:codeQs4 = 200
    AxisX:codeG5 = 154
    AxisX:codeQm5 = 700
    AxisX:codeQs5 = 900
    AxisX:codeQma5 = 2
    AxisX:codeG6 = 254
    AxisX:codeQm6 = 600
    AxisX:codeQs6 = 300
    AxisX:codeQma6 = 3
    AxisX:codeG7 = 154
    AxisX:codeQm7 = 500
    AxisX:codeQs7 = 500
    AxisX:codeG8 = 170
    AxisX:codeQm8 = 900
    AxisX:codeQs8 = 600
    AxisX:codeQsa8 = 200
    AxisX:codeG9 = 190
    AxisX:codeQm9 = 5
    AxisX:codeQs9 = 1
    AxisX:codeG10 = 139
    AxisX:codeQm10 = 300
    AxisX:codeQs10 = 200
    AxisX:codeG11 = 154
    AxisX:codeQm11 = 700
    AxisX:codeQs11 = 400
    AxisX:codeQsa11 = 2
    AxisX:codeG12 = 235
    AxisX:codeQm12 = 1000
    AxisX:codeQs12 = 500
    AxisX:codeG13 = 136
ENDSUB
END
)";

// A search in calls of calls, placements there and back, a new quota under way, an emergency.
constexpr std::string_view gauge_module = R"(
Gauge:cntratio = 100000
Gauge:decpt = 0
Gauge:unitvel = 1
Gauge:maxvel = 64000
Gauge:minpos = -50000
Gauge:maxpos = 50000
Gauge:maxfollerr = 400
Gauge:rampmode = 1
Gauge:tacc = 30
Gauge:tdec = 20
Gauge:rtype = 1
Gauge:toll = 5
Gauge:toldly = 9
Gauge:tinvt = 6
Gauge:feedfw = 1000
Gauge:pgain = 200
Gauge:integt = 150
Gauge:derivt = 1
Gauge:prsmode = 1
Gauge:prsdir = 0
Gauge:prspos = 200
Gauge:prsvel = 7000
Gauge:sprsvel = 1400
Gauge:stopt = 0
INIT Gauge
WAIT Gauge:st_init
CNTUNLOCK Gauge
CNTDIR Gauge
REGON Gauge
LOOPON Gauge
WAIT Gauge:st_loopon
CALL Home
asQuota[1] = 3000
asQuota[2] = 900
asQuota[3] = 60000
asQuota[4] = - 800
MAIN:
FOR (glI = 1, glI LE 4, 1)
    CALL Place
NEXT
EMRG Gauge
WAIT Gauge:st_emrg
tmGauge = 40
WAIT tmGauge
RESUME Gauge
WAIT NOT Gauge:st_emrg
JUMP MAIN

SUB Home
    gbGauge = 1
    CALL Search
    gbGauge = 2
ENDSUB
SUB Search
    PRESET Gauge
    CALL Found
ENDSUB
SUB Found
    WAIT Gauge:st_prson
    WAIT Gauge:st_prsok
    WAIT Gauge:st_still
ENDSUB
SUB Place
    Gauge:setvel = 20000
    Gauge:setpos = asQuota[glI]
    START Gauge
    WAIT NOT Gauge:st_still
    tmGauge = 80
    WAIT tmGauge
    IF glI EQ 2
        Gauge:setpos = asQuota[glI] - 300
    ENDIF
    Gauge:setvel = 15000
    IF glI EQ 3
        STOP Gauge
    ENDIF
    WAIT Gauge:st_still
    tmGauge = 100
    WAIT tmGauge
    agSeen[glI] = Gauge:posit
    sbSmall = Gauge:posit
    ddlRow[1, 2] = ddlRow[1, 2] + 1
    gsMean = gsMean / 2.0 + 0.25
ENDSUB
END
)";

// The contactors' axes: searches, placements with an overshoot, inertias that are learnt.
constexpr std::string_view press_module = R"(
Press:cntratio = 100000
Press:decpt = 0
Press:unitvel = 1
Press:minpos = -30000
Press:maxpos = 30000
Press:slowpos = 300
Press:slowdly = 3
Press:tbrake = 4
Press:tinvt = 9
Press:toldly = 6
Press:tollp = 30
Press:tolln = 30
Press:slowtype = 1
Press:maxvel = 4000
Press:maxslow = 400
Press:minslow = 100
Press:bklashmode = 2
Press:overpos = 150
Press:inertmode = 2
Press:maxiner = 10
Press:dobiner = 1
Press:ninert = 3
Press:prsmode = 1
Press:prsdir = 0
Press:prspos = 100
Press:enstol = 1
Ram:cntratio = 100000
Ram:minpos = -30000
Ram:maxpos = 30000
Ram:tbrake = 2
INIT Press
WAIT Press:st_init
INIT Ram
WAIT Ram:st_init
REGOFF Ram
CNTUNLOCK Press
CNTDIR Press
REGON Press
WAIT NOT Press:st_regoff
PRESET Press
WAIT Press:st_prsok
WAIT Press:st_still
gbPress = 1
MAIN:
FOR (glJ = 1, glJ LE 3, 1)
    Press:setpos = glJ * cStep
    START Press
    WAIT NOT Press:st_still
    tmPress = 70
    WAIT tmPress
    IF glJ EQ 3
        Press:setpos = 3 * cStep + 120
    ENDIF
    WAIT Press:st_still
    Press:delta = 3
    DELCNT Press
    tmPress = 90
    WAIT tmPress
NEXT
REGON Ram
WAIT NOT Ram:st_regoff
MANFFW Ram
tmPress = 60
WAIT tmPress
STOP Ram
REGOFF Ram
WAIT Ram:st_regoff
MANFBW Press
tmPress = 200
WAIT tmPress
STOP Press
WAIT Press:st_still
JUMP MAIN
END
)";

// Looks at what others drive, gives what is refused and what contradicts, sends what nobody answers.
constexpr std::string_view watch_module = R"(
Lift:cntratio = 100000
Lift:decpt = 0
Lift:unitvel = 1
Lift:maxvel = 64000
Lift:minpos = -50000
Lift:maxpos = 50000
Lift:taccdec = 30
Lift:toll = 5
Lift:feedfw = 1000
INIT Lift
WAIT Lift:st_init
REGOFF Lift
Hmi:mode = 0
Hmi:num = 4
OPENCOM Hmi
MAIN:
glSeen = glSeen + Gauge:posit + Press:posit
tmWatch = 33
WAIT tmWatch
IF gbGauge EQ 2 AND glSeen % 5 EQ 0
    START Gauge
    STOP Gauge
ENDIF
SEND Hmi
Hmi:oword5 = glSeen
REGON Lift
Lift:setvel = 5000
MANFW Lift
tmWatch = 21
WAIT tmWatch
STOP Lift
REGOFF Lift
ofLamp = NOT ofLamp
CNTREV Lift
CNTDIR Lift
IF gbPress EQ 0
    START Press
ENDIF
WAIT 1
JUMP MAIN
END
)";

// Stops all tasks with an error in a call, when the scenario says so.
constexpr std::string_view failing_module = R"(
WAIT ifGo
CALL Deep
END
SUB Deep
    CALL Deeper
ENDSUB
SUB Deeper
    glBad = 1 / ddlHead[1]
ENDSUB
END
)";

constexpr std::int64_t ms = 1'000'000;

/// What a run shows in a millisecond.
struct Shown {
  std::vector<double> values;
  std::string texts;
  bool operator==(const Shown&) const = default;
};

/// The controller and what it moves.
class Line {
 public:
  explicit Line(std::int64_t statement_ns) {
    Problems problems;
    const Configuration configuration = parse_configuration(cnf, "test.cnf", catalogue(), problems);
    std::vector<QclProgram> programs;
    for (const auto& [name, text] : {std::pair{"cam.mod", cam_module},
                                     {"gauge.mod", gauge_module},
                                     {"press.mod", press_module},
                                     {"watch.mod", watch_module},
                                     {"failing.mod", failing_module}})
      programs.push_back(compile_module(text, name, configuration, catalogue(), problems));
    for (const Problem& problem : problems) ADD_FAILURE() << to_string(problem);
    controller_ = std::make_unique<QmoveController>(configuration, std::move(programs), catalogue(), 3 * ms,
                                                    statement_ns);
    for (const std::string& name : controller_->names()) {
      auto value = controller_->find(name);
      if (value && !value->of_table) values_.push_back(*value);
    }
    cam_ = controller_->cam_axes().front();
  }

  Shown step() {
    happen();
    analogue("2.CNT01", "2.AN01", "2.INP01", 1);
    analogue("2.CNT02", "2.AN02", "2.INP04", 3);
    analogue("2.CNT03", "2.AN02", "2.INP05", 0);
    contactors(press_, "2.CNT04", "2.OUT02", "2.OUT03", "2.INP06", 4);
    contactors(ram_, "2.CNT05", "2.OUT06", "2.OUT07", "2.INP07", 0);
    controller_->run_devices(step_ * ms);
    controller_->run_tasks(step_ * ms);
    ++step_;
    return shown();
  }
  [[nodiscard]] std::int64_t steps() const { return step_; }

  void visit(StateArchive& archive) { STATE(archive, step_, press_, ram_, *controller_); }
  StateArchive::Bytes save(std::vector<StateArchive::Member>* list = nullptr) {
    StateArchive::Bytes bytes;
    StateArchive::save(bytes, *this, list);
    return bytes;
  }
  /// The bytes that are left.
  std::size_t restore(const StateArchive::Bytes& bytes, std::optional<std::size_t> skip = {}) {
    auto archive = StateArchive::restoring(bytes.data(), bytes.size(), skip);
    visit(archive);
    return archive.left();
  }
  [[nodiscard]] const std::string& name(std::size_t value) const { return values_[value].name; }

 private:
  bool& input(const char* address) { return controller_->cards().inputs.at(*parse_address(address)).level; }
  void set(const char* name, double value) { controller_->find(name).value().write(value); }

  // What comes from outside, by the time.
  void happen() {
    input("2.INP02") = step_ % 500 < 100;
    input("2.INP03") = step_ % 150 < 70;
    if (step_ % 97 == 0) edge(5, true);
    if (step_ % 97 == 9) edge(5, false);
    if (step_ % 331 == 0) edge(2, true);
    if (step_ == 700) set("AxisX.pgain", 250);
    if (step_ == 1100) set("Hmi.iword3", 77);
    if (step_ == 1500) set("Gauge.tdec", 33);
    if (step_ == 3300) set("tmWatch", 400);
    input("2.INP09") = step_ >= 4400 && step_ < 4700;  // an error stops all
    if (step_ == 4650) controller_->power(false);
    if (step_ == 4700) controller_->power(true);
  }
  void edge(int line, bool rising) {
    for (auto& [address, counter] : controller_->cards().counters) counter.latched = counter.count;
    controller_->interrupt(line, rising);
  }
  void move(const char* counter, std::int64_t bits, const char* enable, int line) {
    Counter& moved = controller_->cards().counters.at(*parse_address(counter));
    const auto turn = [](std::int64_t count) { return (count + 4'000'000) / 4000; };
    const std::int64_t before = turn(moved.count);
    moved.count += bits;
    input(enable) = moved.count >= 2000 && moved.count < 9000;
    if (line == 0 || turn(moved.count) == before) return;
    edge(line, true);
    edge(line, false);
  }
  void analogue(const char* counter, const char* output, const char* enable, int line) {
    const std::int64_t word = controller_->cards().analogue_outputs.at(*parse_address(output)).word;
    const auto way = [&](std::int64_t time) { return (word * time) >> 7; };
    move(counter, way(step_ + 1) - way(step_), enable, line);
  }
  // It takes its time to its speed, and coasts.
  void contactors(int& speed, const char* counter, const char* forward, const char* backward,
                  const char* enable, int line) {
    const auto on = [&](const char* output) {
      return controller_->cards().outputs.at(*parse_address(output)).level ? 1 : 0;
    };
    const int wanted = (on(forward) - on(backward)) * (on("2.OUT04") != 0 ? 4 : 16);
    speed += std::clamp(wanted - speed, -1, 1);
    move(counter, speed, enable, line);
  }

  Shown shown() {
    Shown shown;
    shown.values.reserve(values_.size() + 4);
    for (const ControllerValue& value : values_) shown.values.push_back(value.read());
    const CamMoment moment = cam_.moment();
    shown.values.insert(shown.values.end(), {static_cast<double>(cam_.start()), moment.master, moment.set,
                                             moment.behind.value_or(0)});
    if (step_ % 4 != 0) return shown;  // events wait in between
    for (const ControllerEvent& event : controller_->take_events())
      shown.texts += event.source + " " + event.event + " " + event.text + "\n";
    for (const auto& task : controller_->positions(step_ * ms).tasks) {
      shown.texts += task.name + " " + std::to_string(task.line) + " " + task.doing;
      for (const int call : task.calls) shown.texts += " " + std::to_string(call);
      shown.texts += "\n";
    }
    for (const ProgramWait& wait : controller_->waits())
      shown.texts += std::to_string(wait.line) + " " + std::to_string(wait.since_ns) + " " +
                     std::to_string(wait.until_ns) + "\n";
    return shown;
  }

  std::int64_t step_ = 0;
  int press_ = 0;  ///< [bits x4/ms]
  int ram_ = 0;
  std::unique_ptr<QmoveController> controller_;
  std::vector<ControllerValue> values_;
  CamAxis cam_;
};

/// A run in one piece, and its state every so many milliseconds.
struct WholeRun {
  static constexpr int steps = 6000;
  static constexpr int apart = 43;

  explicit WholeRun(Line& line) {
    for (int i = 0; i < steps; ++i) {
      if (i % apart == 0) saved.push_back(line.save());
      shown.push_back(line.step());
    }
  }
  std::vector<StateArchive::Bytes> saved;
  std::vector<Shown> shown;
};

// False where the run does not go on as it did; says then what differs first.
bool goes_on(const WholeRun& run, std::size_t moment, Line& line) {
  if (line.restore(run.saved[moment]) != 0 || line.save() != run.saved[moment]) {
    ADD_FAILURE() << "moment " << moment << ": what was restored is not what was saved";
    return false;
  }
  for (std::size_t next = moment + 1; next < std::min(moment + 4, run.saved.size()); ++next) {
    for (int i = 0; i < WholeRun::apart; ++i) {
      const auto at = static_cast<std::size_t>(line.steps());
      const Shown shown = line.step();
      if (shown == run.shown[at]) continue;
      for (std::size_t v = 0; v + 4 < shown.values.size(); ++v)
        if (shown.values[v] != run.shown[at].values[v]) ADD_FAILURE() << line.name(v);
      ADD_FAILURE() << "moment " << moment << ", " << at << " ms: " << shown.texts << run.shown[at].texts;
      return false;
    }
    if (line.save() != run.saved[next]) {
      ADD_FAILURE() << "moment " << moment << ": another state at " << next;
      return false;
    }
  }
  return true;
}

class QmoveState : public ::testing::TestWithParam<std::int64_t> {};

TEST_P(QmoveState, ARunGoesOnFromAnyMoment) {
  Line wanders(GetParam());
  const WholeRun run(wanders);
  std::vector<std::size_t> moments(run.saved.size());
  for (std::size_t i = 0; i < moments.size(); ++i) moments[i] = i;
  std::mt19937 random(7);
  std::shuffle(moments.begin(), moments.end(), random);
  for (const std::size_t moment : moments) {
    ASSERT_TRUE(goes_on(run, moment, wanders)) << "in one that has been elsewhere";
    Line fresh(GetParam());
    ASSERT_TRUE(goes_on(run, moment, fresh)) << "in a new one";
  }
}

INSTANTIATE_TEST_SUITE_P(StatementTimes, QmoveState, ::testing::Values(0, 90'000),
                         [](const auto& time) { return "Ns" + std::to_string(time.param); });

// The run above is worth nothing unless these things happen in it.
TEST(QmoveStateRun, ComesByWhatMayBeInTheMiddleOfSomething) {
  Line line(0);
  const WholeRun run(line);
  std::map<std::string, int> seen;
  std::string texts;
  std::vector<std::size_t> watched;
  for (std::size_t v = 0; v + 4 < run.shown[0].values.size(); ++v) watched.push_back(v);
  for (const Shown& shown : run.shown) {
    texts += shown.texts;
    for (const std::size_t v : watched)
      if (shown.values[v] != 0) ++seen[line.name(v)];
  }
  for (const char* name :
       {"AxisX.st_prson", "AxisX.st_prsonm", "AxisX.st_camex",   "AxisX.st_sync",    "AxisX.st_dec",
        "AxisX.st_acc",   "AxisX.st_capt",   "AxisX.st_intcapt", "AxisX.st_warning", "Gauge.st_prson",
        "Gauge.st_toll",  "Gauge.st_emrg",   "Press.st_prson",   "Press.st_movslow", "Press.st_erin",
        "Press.iner04",   "Ram.st_movfwd",   "Hmi.err",          "QMOS.oserr",       "slRounds"})
    EXPECT_GT(seen[name], 0) << name;
  for (const char* text : {"value_cut", "contradiction", "refused", "warning", "share", "error 6", "no power",
                           "waits for", "stopped"})
    EXPECT_NE(texts.find(text), std::string::npos) << text;
}

TEST(QmoveStateList, NamesAllBytes) {
  Line line(0);
  for (int i = 0; i < 2500; ++i) line.step();
  std::vector<StateArchive::Member> list;
  const auto bytes = line.save(&list);
  std::size_t offset = 0;
  for (const StateArchive::Member& member : list) {
    EXPECT_EQ(member.offset, offset) << member.name;
    offset += member.size;
  }
  EXPECT_EQ(offset, bytes.size());
  const auto listed = [&](std::string_view name) {
    return std::any_of(list.begin(), list.end(), [&](const auto& member) { return member.name == name; });
  };
  for (const char* name :
       {"*controller_.cards_.outputs.2.OUT02.held", "*controller_.AxisX.posit", "*controller_.AxisX.codeG",
        "*controller_.AxisX.st_camex", "*controller_.AxisX.cam_.master_origin_.part",
        "*controller_.Gauge.axis_.regulator_.integral_", "*controller_.Press.movement_.timer_ms_",
        "*controller_.asQuota", "*controller_.tmCam", "*controller_.cam.calls",
        "*controller_.Gauge.TCamp.next_ns"})
    EXPECT_TRUE(listed(name)) << name;
}

// Each member is restored by itself: left out, it stays as it was at the other moment.
TEST(QmoveStateList, EachMemberCountsForItself) {
  Line line(0);
  for (int i = 0; i < 1000; ++i) line.step();
  std::vector<StateArchive::Member> list;
  const auto early = line.save(&list);
  for (int i = 0; i < 1700; ++i) line.step();
  const auto late = line.save();
  int judged = 0;
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (list[n].name.find(".said") != std::string::npos) continue;  // a set: it puts itself in order
    line.restore(late);
    try {
      if (line.restore(early, n) != 0) continue;  // the length of a list
    } catch (const BadState&) {
      continue;
    }
    const auto mixed = line.save();
    if (mixed.size() != early.size() || mixed == early) continue;
    const auto differs = std::mismatch(mixed.begin(), mixed.end(), early.begin()).first - mixed.begin();
    const auto& member = list[n];
    EXPECT_GE(static_cast<std::size_t>(differs), member.offset) << member.name;
    EXPECT_LT(static_cast<std::size_t>(differs), member.offset + member.size) << member.name;
    ++judged;
  }
  EXPECT_GT(judged, 150);
}

TEST(QmoveStateList, ItIsOfTheSameTerminalsAndWhole) {
  Line line(0);
  const auto bytes = line.save();
  for (const std::size_t size : {std::size_t{0}, std::size_t{9}, bytes.size() / 2, bytes.size() - 1}) {
    const StateArchive::Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(line.restore(part), BadState) << size;
  }
}

}  // namespace
}  // namespace drycut::devices::qmove::state
