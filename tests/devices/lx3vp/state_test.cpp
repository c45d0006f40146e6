// A PLC's state: saved at any tick and restored, it goes on as if nothing had been.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/state_archive.hpp"
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "tests/devices/lx3vp/ecamtbx_bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

using Bytes = StateArchive::Bytes;
using Members = std::vector<StateArchive::Member>;

/// Something that happens to the PLC from outside, at a tick.
struct Act {
  int tick;
  std::string name;  ///< of an input, a register, or "power"
  double value;
};

/// A program, what is in the registers before, and what happens to it.
struct Story {
  std::string name;
  std::string program;
  std::int64_t step_ns = 0;
  void (*prepare)(Registers& registers) = nullptr;
  std::vector<Act> acts;
  int ticks = 2000;
};

/// A PLC that lives through a story. C235 counts the pulses of Y1.
class Teller {
 public:
  explicit Teller(const Story& story)
      : story_(story), controller_(compiled(story.program), 1'000'000, story.step_ns) {
    for (const Act& act : story.acts)
      if (act.name.front() == 'X') controller_.terminal(act.name);
    controller_.offer({devices::Kind::counter, 0, 235});
    controller_.offer({devices::Kind::output, 0, 1});
    controller_.offer({devices::Kind::output, 0, 7});
    controller_.offer({devices::Kind::output, 0, 2});
    axes_ = controller_.cam_axes();
    for (const auto kind : {RegisterName::Kind::x, RegisterName::Kind::y})
      for (int n = 0; n < 16; ++n)
        levels_.push_back(controller_.find(to_string(RegisterName{kind, n}))->read);
    if (story.prepare != nullptr) story.prepare(controller_.registers());
  }

  /// Goes on to a tick; what is seen before, a tick each, and at the end; as bytes.
  std::vector<std::string> until(int tick) {
    std::vector<std::string> seen{look_round()};
    while (tick_ < tick) {
      const std::int64_t now = tick_ * tick_ns;
      controller_.run_devices(now);
      controller_.run_tasks(now);
      ++tick_;
      auto& cards = controller_.cards();
      cards.counters[{devices::Kind::counter, 0, 235}].count =
          4 * cards.pulse_outputs[{devices::Kind::output, 0, 1}].count;
      // Behind it, so that there are moments between an act and what the PLC makes of it.
      for (const Act& act : story_.acts)
        if (act.tick == tick_) happen(act);
      seen.push_back(look());
    }
    seen.push_back(look_round());
    return seen;
  }

  Bytes save(Members* list = nullptr) {
    Bytes bytes;
    StateArchive::save(bytes, controller_, list);
    return bytes;
  }
  void restore(const Bytes& bytes, int tick, std::optional<std::size_t> skip = {}) {
    auto archive = StateArchive::restoring(bytes.data(), bytes.size(), skip);
    controller_.visit(archive);
    if (archive.left() > 0) throw BadState("more than its state");
    tick_ = tick;
  }
  [[nodiscard]] int tick() const { return tick_; }

 private:
  static il::IlProgram compiled(const std::string& text) {
    Problems problems;
    auto program = il::compile(text, "test.il", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return program;
  }
  void happen(const Act& act) {
    if (act.name == "power")
      controller_.power(act.value != 0);
    else if (act.name.front() == 'X')
      controller_.cards().inputs.at(*parse_base_terminal(act.name)).level = act.value != 0;
    else
      controller_.find(act.name).value().write(act.value);
  }
  std::string look() {
    const auto& cards = controller_.cards();
    std::string text;
    for (const auto& [address, output] : cards.outputs) add(text, output.level);
    for (const auto& [address, train] : cards.pulse_outputs) add(text, train.count);
    const auto& registers = controller_.registers();
    for (const std::size_t d : {0, 1, 2, 3, 4, 5, 100, 540, 2001, 2025, 3001, 8010})
      add(text, registers.d[d]);
    for (const CamAxis& axis : axes_) {
      const CamMoment moment = axis.moment();
      add(text, axis.start());
      add(text, moment.follows);
      add(text, moment.master);
      add(text, moment.set);
    }
    for (const auto& task : controller_.positions(0).tasks) {
      add(text, task.line);
      text += task.doing;
    }
    // Not at once, so that there are some that wait.
    if (tick_ % 7 == 0)
      for (const auto& event : controller_.take_events()) text += event.source + event.event + event.text;
    return text;
  }
  /// All that can be seen of it from outside.
  std::string look_round() {
    const auto& registers = controller_.registers();
    std::string text = registers.written.to_string();
    const auto add_all = [&](const auto& values) {
      text.append(reinterpret_cast<const char*>(values.data()), sizeof values);
    };
    add_all(registers.d);
    add_all(registers.m);
    add_all(registers.s);
    add_all(registers.v);
    add_all(registers.z);
    for (const Timer& timer : registers.t) {
      add(text, timer.value);
      add(text, timer.contact);
    }
    for (const PlcCounter& counter : registers.c) {
      add(text, counter.value);
      add(text, counter.contact);
    }
    for (const auto& level : levels_) add(text, level());
    for (const CamAxis& axis : axes_)
      if (const auto table = axis.table()) {
        const auto& rows = table->as<EcamTable>();
        add(text, rows.is_made());
        add(text, rows.saw.slave_length);
        add(text, rows.s_curve.length);
        for (const CamTableRow& row : rows.rows) {
          add(text, row.master);
          add(text, row.slave);
        }
      }
    for (const ProgramWait& wait : controller_.waits()) text += wait.lacks;
    return text;
  }
  template <typename Value>
  static void add(std::string& text, Value value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  const Story& story_;
  Lx3vpController controller_;
  std::vector<CamAxis> axes_;
  std::vector<std::function<double()>> levels_;  ///< of terminals
  int tick_ = 0;
};

void straight_table(Registers& registers, int block,
                    const std::vector<std::pair<std::int32_t, std::int32_t>>& rows) {
  registers.put(block + word::rows, static_cast<std::uint16_t>(rows.size()));
  int at = block + word::table;
  for (const auto& [master, slave] : rows) {
    registers.set_i32(at, master);
    registers.set_i32(at + 2, slave);
    at += row_words;
  }
}

// Two cams that run, of which one is stopped, goes on where it was and gets another table meanwhile; one that
// is refused; instructions that fail.
const Story cams{"cams",
                 R"(
LD M8002
MOV K1 D2004          ; synchronous output Y7
MOV K7 D2008
LD M1
ECAMTBX D500 D530 D2000 D540
LD M8
CJ P1
LD M8000
OUT C235 K1500
P1
LD M8000
OUT C240 K9
LD M7
ECAMTBX D600 K0 D5000 D640
LD M0
DPLSV D520 Y1 Y5
DECAM C235 D2000 X2 Y0 Y4
LD M2
DECAM K2 D3000 X2 Y2 Y6
LD M3
DECAM D100 D4000 M20 Y0 Y10
LD M4
DPLSV K1000 Y0 Y4
LD M6
DECAM D100 D5000 M20 Y3 Y11
LDP M5
DIV D100 D101 D102
LD X3
INC D100
LD C235
OUT Y12
END
)",
                 0,
                 [](Registers& registers) {
                   ecams::put(registers, 500, ecams::rotary_demo());
                   ecams::put(registers, 600, ecams::s_curve_demo());
                   registers.d[530] = 100;
                   registers.set_i32(520, 60'000);
                   registers.put(3003, function::external_start | function::delayed_start |
                                           function::start_position | function::master_zoom |
                                           function::slave_zoom);
                   registers.put(3005, 2);
                   registers.set_i32(3006, 9'000);
                   registers.put(3014, 1);
                   registers.put(3015, 50);
                   registers.put(3017, 30);
                   registers.put(3023, 2);
                   registers.put(3024, 7);
                   registers.put(3029, 2);
                   registers.put(3030, 3);
                   straight_table(registers, 3000, {{10, 5}, {150, 100}, {500, 500}});
                   registers.put(5003, function::resume);
                   registers.put(5005, 1);
                   straight_table(registers, 5000, {{0, 0}, {10, 3}});
                   straight_table(registers, 4000, {{0, 0}, {10, 3}});
                 },
                 {{20, "M1", 1},          {31, "M8", 1},        {33, "M2", 1},       {40, "D2005", 1},
                  {41, "M0", 1},          {50, "M3", 1},        {60, "M4", 1},       {70, "M6", 1},
                  {90, "X3", 1},          {95, "M5", 1},        {120, "X2", 1},      {150, "X2", 0},
                  {300, "DD502", 900},    {350, "D2001", 0},    {411, "D511", 3},    {412, "D512", 100},
                  {415, "M4", 0},         {456, "M4", 1},       {420, "D2005", 0},   {440, "D2003", 64},
                  {450, "D2005", 1},      {555, "D5005", 0},    {575, "M4", 0},      {580, "M4", 1},
                  {590, "D5003", 96},     {595, "M4", 0},       {600, "DD500", 1},   {610, "D5005", 2},
                  {630, "M20", 1},        {640, "DD500", 3000}, {650, "M3", 0},      {660, "M3", 1},
                  {700, "D2005", 0},      {702, "D2005", 1},    {706, "D2005", 0},   {710, "D2005", 1},
                  {750, "D3000", 1},      {760, "D4005", 1},    {770, "M20", 0},     {780, "D5005", 0},
                  {790, "D5005", 2},      {795, "M20", 1},      {800, "M0", 0},      {850, "M0", 1},
                  {860, "DD520", 200000}, {900, "D2003", 0},    {905, "D511", 0},    {920, "D2005", 0},
                  {930, "D2005", 1},      {1100, "X2", 1},      {1150, "X2", 0},     {1170, "M20", 0},
                  {1180, "X2", 1},        {1190, "M7", 1},      {1193, "M7", 0},     {1195, "D5005", 0},
                  {1198, "D5005", 1},     {1260, "D2001", 0},   {1300, "D530", 101}, {1400, "D2038", 1},
                  {1410, "D2005", 0},     {1420, "D2005", 1},   {1525, "M2", 0},     {1510, "D3014", 65535},
                  {1540, "M2", 1},        {1560, "X2", 0},      {1580, "X2", 1},     {1800, "power", 0},
                  {1850, "power", 1},     {1880, "DD502", 1000}}};

// All that gives pulses by itself: ramps, trains, a return to zero, and who comes second.
const Story pulses{
    "pulses",
    R"(
LD M0
DDRVI K3000 K80000 Y0 Y4
LD M1
DDRVA K-900 K30000 Y1 Y5
LD M2
PLSY D10 K50 Y2
LD M3
DZRN K20000 K900 M40 Y3
LD M4
DPLSV D50 Y3 Y7
LD M5
DDRVI K500 K10000 Y0 Y4
LD M8029
OUT Y10
LDI M8000
OUT Y4
OUT Y5
LD M8147
OUT Y11
END
)",
    0,
    nullptr,
    {{11, "M0", 1},       {23, "M1", 1},      {30, "D10", 700},   {31, "M2", 1},      {42, "M3", 1},
     {50, "M5", 1},       {55, "M4", 1},      {200, "D10", 333},  {500, "M40", 1},    {640, "M40", 0},
     {700, "M3", 0},      {720, "D50", 777},  {760, "M8153", 1},  {800, "M8153", 0},  {810, "D50", -55},
     {900, "M0", 0},      {910, "M1", 0},     {920, "M5", 0},     {950, "M1", 1},     {980, "M5", 1},
     {1000, "M8146", 1},  {1020, "M8146", 0}, {1040, "M4", 0},    {1060, "M3", 1},    {1100, "M4", 1},
     {1150, "M40", 1},    {1280, "M40", 0},   {1300, "power", 0}, {1310, "D10", 400}, {1350, "power", 1},
     {1355, "D10", 3000}, {1360, "M2", 1},    {1400, "D10", 2500}}};

// A program whose instructions take time: most ticks end within a loop, a subroutine, a block, a branch, a
// step of a sequence.
const Story logic{"logic",
                  R"(
LD M8000
DPLSV K2000 Y0 Y10
LD M50
DPLSV K1000 Y0 Y10
LD M8000
OUT T0 K5
LDI T0
OUT T200 K3
LD X0
OUT T246 D20
LD T0
RST T0
INC D3
LDP X0
OUT C0 K3
LD M8012
OUT C100 K2
LD M8011
OUT C200 K4
LD C0
RST C0
LD X0
OR X1
LD X2
ORI X1
ANB
MPS
AND X0
OUT Y0
MRD
ANI X2
OUT Y1
MPP
AND X2
PLS M30
PLF M31
LD M30
INC D4
LD X1
MC N0 M100
LD X2
OUT Y2
LDF X2
MC N1 M101
LD M8000
INC D5
MCR N1
LD M8000
OUT Y6
LD M8000
INC D23
MCR N0
FOR K3
LD M8000
OUT T201 K3000
INC D0
CALL P1
FOR D6
LD M8000
INC Z1
ADD V1 K3 V1
NEXT
NEXT
LD M8002
SET S0
STL S0
OUT Y3
LD X0
SET S20
STL S20
OUT Y4
OUT T202 K1
LD T202
SET S21
STL S21
OUT Y5
LD X1
OUT S0
RET
LD X3
CALL P3
LD X2
DIV D0 D21 D22
LD M8000
MOV K7 D300Z2
FEND
P1
LD M8000
INC D1
LD X2
CALL P2
LD X2
CJ P4
INV
INC D2
P4
SRET
P2
LDP M8011
INC D2
SRET
P3
LD M8000
CALL P3
SRET
END
)",
                  23'000,
                  [](Registers& registers) { registers.d[20] = 250; },
                  {{13, "X0", 1},      {150, "X1", 1},  {222, "X2", 1},  {300, "X0", 0},    {391, "X0", 1},
                   {402, "D6", 4},     {485, "M50", 1}, {500, "X2", 0},  {530, "X1", 0},    {600, "X1", 1},
                   {666, "X3", 1},     {700, "X0", 0},  {720, "X0", 1},  {760, "X2", 1},    {800, "D21", 3},
                   {840, "Z2", 10},    {850, "X3", 0},  {903, "X1", 0},  {950, "power", 0}, {960, "X1", 1},
                   {977, "power", 1},  {1000, "X0", 0}, {1040, "X0", 1}, {1100, "X2", 0},   {1210, "X2", 1},
                   {1333, "Z2", -400}, {1400, "X3", 1}, {1555, "X1", 0}, {1600, "X1", 1},   {1700, "X0", 0},
                   {1780, "X0", 1}}};

// The same without time, with the clocks and timers at work.
Story quick_logic() {
  Story story = logic;
  story.name = "quick logic";
  story.step_ns = 0;
  return story;
}

// A scan that does not end: the watchdog stops the PLC, until it is switched off and on.
const Story stopped{"stopped",
                    "LD M8000\nINC D300\nDPLSV K500 Y1 Y5\nP0\nLD M8000\nINC D0\nLD X0\nCJ P0\nEND\n",
                    100'000,
                    nullptr,
                    {{50, "X0", 1}, {2500, "X0", 0}, {2600, "power", 0}, {2650, "power", 1}, {2800, "X0", 1}},
                    3500};

// Interrupts, compares, measures and pulses between scans, with relays that hold, hide and stop. M30 only
// marks moments at which a level or a compare is about to change before the next scan.
const Story quick{"quick",
                  R"(
LD M0
CJ P0
EI
P0
LDI M0
CJ P1
DI
P1
LD M8000
OUT C235 K100000
LD M1
DPLSV K50000 Y1 Y5
LD M2
DHSCS D10 C235 S5
DHSCS D10 C235 I010
DHSZ D12 D14 C235 Y6
LD M3
SPD X1 K7 D2
LD M4
PWM D20 D21 Y2
LD M5
DPLSR K2000 K200 D24 Y3
LD M6
OUT M8034
LD M7
OUT M8039
LD M8000
INC D5
FEND
I001
LD M8000
INC D0
IRET
I613
LD M8000
INC D1
IRET
I010
LD M8000
INC D100
IRET
END
)",
                  0,
                  [](Registers& registers) {
                    registers.set_i32(10, 1000);
                    registers.set_i32(12, 150);
                    registers.set_i32(14, 2500);
                    registers.put(20, 1);
                    registers.put(21, 3);
                    registers.put(24, 400);
                    registers.put(8039, 3);
                  },
                  {{40, "X0", 1},     {51, "X0", 0},   {60, "M3", 1},      {63, "X1", 1},   {70, "M4", 1},
                   {81, "X1", 0},     {85, "X1", 1},   {97, "M1", 1},      {97, "M2", 1},   {131, "M30", 1},
                   {133, "M30", 0},   {135, "M30", 1}, {136, "M30", 0},    {200, "M5", 1},  {301, "M30", 1},
                   {302, "M30", 0},   {303, "M30", 1}, {304, "M30", 0},    {500, "M0", 1},  {505, "X0", 1},
                   {521, "X1", 0},    {525, "X1", 1},  {560, "X0", 0},     {600, "M0", 0},  {640, "M6", 1},
                   {700, "M6", 0},    {760, "M7", 1},  {820, "X0", 1},     {860, "X0", 0},  {900, "M7", 0},
                   {950, "M8037", 1}, {1000, "X0", 1}, {1100, "M8036", 1}, {1150, "X0", 0}, {1160, "M1", 1},
                   {1160, "M2", 1},   {1160, "M3", 1}, {1200, "M4", 1},    {1220, "M5", 1}, {1300, "M6", 1},
                   {1310, "M7", 1},   {1500, "M6", 0}},
                  1900};

std::vector<Story> stories() { return {stopped, pulses, logic, quick_logic(), cams, quick}; }

/// So many ticks behind each act, and all along.
std::set<int> moments(const Story& story, std::initializer_list<int> behind) {
  std::set<int> ticks;
  for (const Act& act : story.acts)
    for (const int later : behind) ticks.insert(act.tick + later);
  for (int tick = 0; tick < story.ticks; tick += 211) ticks.insert(tick);
  for (int tick = 450; story.step_ns > 0 && tick < 570; ++tick) ticks.insert(tick);
  ticks.erase(ticks.upper_bound(story.ticks), ticks.end());
  return ticks;
}

// At every so many ticks, of any phase to scans and movements: restored into the same PLC, into a fresh one,
// and into one that is at the end of its story.
TEST(Lx3vpState, ARestoredPlcGoesOnAsBefore) {
  for (const Story& story : stories()) {
    SCOPED_TRACE(story.name);
    Teller whole(story);
    Teller ended(story);
    ended.until(story.ticks);
    const Bytes last = ended.save();
    for (const int at : moments(story, {0, 1, 3, 7})) {
      whole.until(at);
      SCOPED_TRACE(at);
      const Bytes bytes = whole.save();
      const int end = std::min(at + 200, story.ticks);
      const auto seen = whole.until(end);
      const Bytes after = whole.save();
      Teller fresh(story);
      for (Teller* plc : {&whole, &fresh, &ended}) {
        plc->restore(bytes, at);
        ASSERT_EQ(plc->save(), bytes);
        const auto again = plc->until(end);
        ASSERT_EQ(std::mismatch(again.begin(), again.end(), seen.begin()).first - again.begin(),
                  end - at + 2);
        ASSERT_EQ(plc->save(), after);
      }
      whole.restore(bytes, at);
      ended.restore(last, story.ticks);
      ASSERT_EQ(ended.save(), last);
    }
  }
}

/// A member's name without places in lists: one stands for all.
std::string family_of(const std::string& name) {
  std::string text;
  for (std::size_t n = 0; n < name.size(); ++n) {
    const bool begins = n == 0 || name[n - 1] == '.';
    if (begins && name[n] >= '0' && name[n] <= '9') {
      text += '#';
      while (n + 1 < name.size() && name[n + 1] != '.') ++n;
    } else {
      text += name[n];
    }
  }
  return text;
}

/// A state with its members.
struct Snapshot {
  explicit Snapshot(Teller& plc) : tick(plc.tick()), bytes(plc.save(&members)) {}
  [[nodiscard]] Bytes value(const StateArchive::Member& member) const {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(member.offset);
    return {begin, begin + static_cast<std::ptrdiff_t>(member.size)};
  }
  int tick;
  Members members;
  Bytes bytes;
};

/// Another moment, whose members stay where one is left out. Those of a map have one name: by its turn.
struct Other {
  explicit Other(Teller& plc) : state(plc) {
    std::map<std::string, int> turns;
    for (const auto& member : state.members)
      if (is_tried(member.name)) values[{member.name, turns[member.name]++}] = state.value(member);
  }
  /// Terminals and registers have tests of their own; places in the program fit each other, or nothing goes
  /// on.
  static bool is_tried(const std::string& name) {
    for (const char* no : {"cards_.", "registers_.", "scanner.rung_", "scanning_"})
      if (name.starts_with(no)) return false;
    return true;
  }
  [[nodiscard]] bool has(const std::string& name, int turn, const Bytes& value) const {
    const auto found = values.find({name, turn});
    return found != values.end() && found->second == value;
  }
  Snapshot state;
  std::map<std::pair<std::string, int>, Bytes> values;
};

/// How a story goes on from a moment, as far as somebody has asked.
class GoingOn {
 public:
  GoingOn(Teller& plc, const Story& story, const Snapshot& here) : plc_(plc), story_(story), here_(here) {}

  /// Whether it goes on otherwise if a member is left as it is at another moment.
  bool needs(std::size_t member, const Snapshot& there) {
    plc_.restore(there.bytes, there.tick);
    try {
      plc_.restore(here_.bytes, here_.tick, member);
      for (std::size_t n = 0; n < parts && plc_.tick() < story_.ticks; ++n)
        if (plc_.until(next()) != part(n)) return true;
    } catch (const std::exception&) {
      return true;  // the size of a list, and nothing fits any more
    }
    return false;
  }

 private:
  static constexpr std::size_t parts = 6;
  [[nodiscard]] int next() const { return std::min(plc_.tick() + 50, story_.ticks); }
  const std::vector<std::string>& part(std::size_t n) {
    if (seen_.empty()) {
      Teller whole(story_);
      whole.restore(here_.bytes, here_.tick);
      while (seen_.size() < parts) seen_.push_back(whole.until(std::min(whole.tick() + 50, story_.ticks)));
    }
    return seen_[n];
  }

  Teller& plc_;
  const Story& story_;
  const Snapshot& here_;
  std::vector<std::vector<std::string>> seen_;
};

// Each member is needed: where one is left as it is, a run goes on otherwise.
TEST(Lx3vpState, NoMemberIsForNothing) {
  constexpr int tries = 12;
  // What nobody sees, as things are: it is told and forgotten within a tick, made anew before it is read,
  // told but once anyway, or not read any more.
  const std::set<std::string> unseen{
      "pulses_.cams_.#.second.fault_",        "pulses_.cams_.#.second.notes_",
      "pulses_.cams_.#.second.slave_.pulses", "pulses_.cams_.#.second.place_.cycle",
      "pulses_.cams_.#.second.told_late_",    "pulses_.cams_.#.second.refusal_.code",
      "pulses_.cams_.#.second.refusal_.row",  "pulses_.notes_.#.code",
      "pulses_.lines_.#.motion.order.output"};
  std::set<std::string> all;
  std::set<std::string> needed = unseen;
  for (const Story& story : {pulses, logic, cams, stopped, quick}) {
    Teller plc(story);
    const Other begin(plc);
    plc.until(story.ticks);
    const Other end(plc);
    Teller whole(story);
    for (const int at : moments(story, {0})) {
      whole.until(at);
      const Snapshot here(whole);
      GoingOn going_on(plc, story, here);
      std::map<std::string, int> turns;
      std::map<std::string, int> tried;
      for (std::size_t n = 0; n < here.members.size(); ++n) {
        const auto& name = here.members[n].name;
        if (!Other::is_tried(name)) continue;
        const auto family = family_of(name);
        const int turn = turns[name]++;
        all.insert(family);
        if (needed.contains(family) || tried[family] >= tries) continue;
        for (const Other* other : {&begin, &end}) {
          if (other->has(name, turn, here.value(here.members[n]))) continue;
          ++tried[family];
          if (going_on.needs(n, other->state)) needed.insert(family);
        }
      }
    }
  }
  std::vector<std::string> useless;
  std::set_difference(all.begin(), all.end(), needed.begin(), needed.end(), std::back_inserter(useless));
  EXPECT_THAT(useless, testing::IsEmpty());
}

}  // namespace
}  // namespace drycut::devices::lx3vp
