// The PLC as a whole: program, scan, terminals, power, and the manual's examples.
#include <gmock/gmock.h>

#include <sstream>
#include <string>

#include "devices/lx3vp/lx3vp_controller.hpp"
#include "tests/devices/lx3vp/covers.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t ms = 1'000'000;

/// A PLC that runs a program in simulated time. Y1 is wired to X0, the terminal of C235, as in the manual.
class Plc {
 public:
  explicit Plc(const std::string& text, std::int64_t scan_ns = ms) : controller_(compile(text), scan_ns) {
    controller_.offer({Kind::output, 0, 0});
    controller_.offer({Kind::output, 0, 1});
    controller_.offer({Kind::counter, 0, 235});
    controller_.offer({Kind::input, 0, 2});
    controller_.offer({Kind::output, 0, 7});
  }

  static il::IlProgram compile(const std::string& text) {
    Problems problems;
    auto program = il::compile(text, "test.il", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return program;
  }

  Plc& run_ticks(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      controller_.run_devices(time_);
      controller_.run_tasks(time_);
      time_ += tick_ns;
      controller_.cards().counters[{Kind::counter, 0, 235}].count =
          4 * controller_.cards().pulse_outputs[{Kind::output, 0, 1}].count;
    }
    return *this;
  }
  Plc& run_ms(int count) { return run_ticks(10 * count); }
  double get(const std::string& name) {
    const auto value = controller_.find(name);
    EXPECT_TRUE(value) << name;
    return value ? value->read() : 0;
  }
  void set(const std::string& name, double number) {
    const auto value = controller_.find(name);
    ASSERT_TRUE(value && value->write) << name;
    value->write(number);
  }
  void set(const std::vector<std::pair<std::string, double>>& values) {
    for (const auto& [name, number] : values) set(name, number);
  }
  /// By their names, with blanks between them.
  std::vector<double> values(const std::string& names) {
    std::vector<double> read;
    std::istringstream words(names);
    for (std::string name; words >> name;) read.push_back(get(name));
    return read;
  }
  void press(int input, bool on) { controller_.cards().inputs[{Kind::input, 0, input}].level = on; }
  /// Pulses of Y0.
  Lx3vpController& controller() { return controller_; }
  std::int64_t given() { return controller_.cards().pulse_outputs[{Kind::output, 0, 0}].count; }
  bool lamp(int output) { return controller_.cards().outputs[{Kind::output, 0, output}].level; }
  std::vector<std::string> events() {
    std::vector<std::string> texts;
    for (const auto& event : controller_.take_events())
      texts.push_back(event.source + " " + event.event + ": " + event.text);
    return texts;
  }
  /// Initial values of a cam's block, and a table of straight lines.
  void block(int at, const std::vector<std::pair<std::int32_t, std::int32_t>>& rows) {
    Registers& registers = controller_.registers();
    registers.set_i32(at + word::max_frequency, 200'000);
    for (const int ratio : {23, 24, 29, 30}) registers.put(at + ratio, 1);
    registers.put(at + word::table_offset, 40);
    registers.d[static_cast<std::size_t>(at + word::rows)] = static_cast<std::uint16_t>(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      registers.set_i32(at + 40 + 4 * static_cast<int>(i), rows[i].first);
      registers.set_i32(at + 42 + 4 * static_cast<int>(i), rows[i].second);
    }
  }

  Lx3vpController controller_;
  std::int64_t time_ = 0;
};

// 003 4.1.3: master 50000 pulses a cycle, Y7 on from 20000 to 30000. The manual's example writes the upper
// threshold to D2012; it is D2011 (block.cpp).
TEST(Lx3vpController, ManualExampleOfTheCyclicCam) {
  Plc plc(R"(
LD M8002
DMOV K0 D8140
DMOV K0 D8142
MOV K7 D2008
DMOV K20000 D2009
DMOV K30000 D2011
MOV K1 D2004          ; bit 0: synchronous output
MOV K1 D2005          ; cyclic
LD M8000
OUT C235 K0
LD M0
DPLSV K10000 Y1 Y5
DECAM C235 D2000 X2 Y0 Y4
END
)");
  plc.block(2000, {{0, 0}, {20'000, 10'000}, {30'000, 30'000}, {50'000, 40'000}});
  EXPECT_FALSE(plc.run_ms(5).lamp(7));
  plc.set("M0", 1);
  int cycles = 0;
  bool was_on = false;
  // 12 s are 120000 pulses of the master: two cycles and 20000 pulses.
  for (int tick = 0; tick < 120'000; ++tick) {
    plc.run_ticks(1);
    const double phase = plc.get("DD2025");
    const bool inside = phase >= 20'000 && phase <= 30'000;
    ASSERT_EQ(plc.lamp(7), inside) << "at " << phase;
    ASSERT_EQ(plc.get("D2001.A"), inside);
    if (plc.lamp(7) && !was_on) ++cycles;
    was_on = plc.lamp(7);
  }
  EXPECT_GE(cycles, 2);
  const double counts = plc.get("DD2027");
  EXPECT_NEAR(counts, 120'000, 60);
  const double phase = counts - 100'000;
  EXPECT_NEAR(plc.get("DD8140"), 80'000 + (phase <= 20'000 ? phase / 2 : 10'000 + (phase - 20'000) * 2), 1);
  plc.set("M0", 0);
  plc.run_ms(2);
  const double stopped = plc.get("DD8140");
  EXPECT_EQ(plc.run_ms(100).get("DD8140"), stopped);
  EXPECT_EQ(plc.get("C235"), plc.get("DD8142")) << "all of Y1's pulses came in at X0";
  EXPECT_FALSE(plc.lamp(7));
  EXPECT_THAT(plc.events(), IsEmpty());
}

// 003 4.1.3 takes C231, which with an FX is no high-speed counter: where it is wired it is one here.
TEST(Lx3vpController, ACounterBelowC235CountsPulsesWhereItIsWired) {
  const std::string program = "LD M8000\nOUT C231 K0\nOUT C232 K0\nEND\n";
  Plc plc(program);
  ASSERT_TRUE(std::holds_alternative<Address>(plc.controller().terminal("C231")));
  EXPECT_TRUE(std::holds_alternative<TerminalFault>(plc.controller().terminal("C199")));
  plc.run_ms(2);
  plc.controller().cards().counters[{Kind::counter, 0, 231}].count += 4 * 30;
  plc.run_ms(2);
  EXPECT_EQ(plc.get("C231"), 30);
  EXPECT_EQ(plc.get("C232"), 1) << "not wired: it counts the rung's edge";
  plc.set("M8231", 1);
  plc.controller().cards().counters[{Kind::counter, 0, 231}].count += 4 * 10;
  EXPECT_EQ(plc.run_ms(2).get("C231"), 20) << "M8231: downwards";
}

// The pulses move a cam, whatever is written to their counter.
TEST(Lx3vpController, WhatIsWrittenToAHighSpeedCounterMovesNoCam) {
  Plc plc("LD M8000\nOUT C235 K0\nLD M0\nDPLSV K10000 Y1 Y5\nDECAM C235 D2000 X2 Y0 Y4\nEND\n");
  plc.block(2000, {{0, 0}, {50'000, 40'000}});
  plc.set({{"D2005", 1}, {"M0", 1}});
  plc.run_ms(100);
  const double counts = plc.get("DD2027");
  EXPECT_NEAR(counts, 1000, 60);
  plc.set("C235", 7000);
  plc.run_ms(100);
  EXPECT_NEAR(plc.get("C235"), 8000, 20);
  EXPECT_NEAR(plc.get("DD2027") - counts, 1000, 20);
}

// 003 4.2.3: X2 starts three cycles of 100000 master pulses; the manual's "two times" are two repeats.
TEST(Lx3vpController, ManualExampleOfTheNonCyclicCam) {
  Plc plc(R"(
LD M8002
DMOV K0 D8140
DMOV K0 D8142
MOV K2 D1014
MOV H20 D1003         ; bit 5: started from outside
MOV K2 D1005
LD M8000
OUT C235 K0
LD M0
DPLSV K100000 Y1 Y5
DECAM C235 D1000 X2 Y0 Y4
END
)");
  plc.block(1000, {{0, 0}, {40'000, 9'000}, {100'000, 15'000}});
  plc.set("M0", 1);
  EXPECT_EQ(plc.run_ms(500).get("D1001.0"), 1) << "initialised";
  EXPECT_EQ(plc.get("D1001.7"), 1);
  EXPECT_EQ(plc.get("DD8140"), 0) << "not yet started";
  for (int run = 1; run <= 2; ++run) {
    plc.press(2, true);
    plc.run_ms(50);
    plc.press(2, false);
    EXPECT_GT(plc.get("DD8140"), 45'000 * (run - 1));
    EXPECT_EQ(plc.run_ms(2'900).get("D1001.0"), 1) << "still running";
    EXPECT_EQ(plc.get("D1001.9"), 1) << "cycles have ended";
    EXPECT_EQ(plc.run_ms(60).get("DD8140"), 45'000 * run) << "three cycles to the pulse";
    EXPECT_EQ(plc.get("D1001.1"), 1);
    plc.set("D1001", static_cast<int>(plc.get("D1001")) & ~0x202);
    EXPECT_EQ(plc.run_ms(500).get("DD8140"), 45'000 * run);
  }
  plc.press(2, true);
  plc.run_ms(100);
  plc.set("M0", 0);
  plc.run_ms(2);
  const double stopped = plc.get("DD8140");
  EXPECT_GT(stopped, 90'000);
  EXPECT_EQ(plc.run_ms(100).get("DD8140"), stopped) << "stopped at once";
}

TEST(Lx3vpController, TheSystemRelaysTellTheState) {
  Plc plc("LD M8002\nINC D0\nLDI M8003\nINC D1\nLD M8000\nINC D2\nLDI M8001\nINC D3\nEND\n");
  EXPECT_THAT(plc.run_ms(10).values("D0 D1 D2 D3"), ElementsAre(1, 1, 10, 10));
  EXPECT_EQ(plc.get("D8010"), 10) << "0.1 ms";
  covers({"M8000", "M8001", "M8002", "M8003", "D8010"});
}

TEST(Lx3vpController, TheClocksRun) {
  Plc plc("LDP M8011\nINC D0\nLDP M8012\nINC D1\nLDP M8013\nINC D2\nLDP M8014\nINC D3\nEND\n");
  EXPECT_THAT(plc.run_ms(120'000).values("D0 D1 D2 D3"), ElementsAre(12'000, 1'200, 120, 2));
  covers({"M8011", "M8012", "M8013", "M8014"});
}

TEST(Lx3vpController, InputsAreTakenAtTheScanAndOutputsGivenAtItsEnd) {
  Plc plc("LD X2\nOUT Y7\nEND\n", 10 * ms);
  plc.run_ticks(1);
  plc.press(2, true);
  EXPECT_FALSE(plc.run_ticks(99).lamp(7));
  EXPECT_EQ(plc.get("X2"), 1) << "the level of the terminal";
  EXPECT_TRUE(plc.run_ticks(1).lamp(7));
  plc.press(2, false);
  EXPECT_TRUE(plc.run_ticks(99).lamp(7));
  EXPECT_FALSE(plc.run_ticks(1).lamp(7));
}

TEST(Lx3vpController, AProgramMayUseASynchronousOutputOnlyWhileTheCamDoesNot) {
  Plc plc("LD M1\nOUT Y7\nLD M0\nDECAM K1 D2000 X2 Y0 Y4\nEND\n");
  plc.block(2000, {{0, 0}, {100'000, 10}});
  plc.set({{"D2004", 1}, {"D2008", 7}, {"DD2009", 50'000}, {"DD2011", 60'000}, {"D2005", 1}, {"M1", 1}});
  EXPECT_TRUE(plc.run_ms(5).lamp(7));
  plc.set("M0", 1);
  EXPECT_FALSE(plc.run_ms(5).lamp(7)) << "the cam's, outside its window";
  plc.set("M0", 0);
  EXPECT_TRUE(plc.run_ms(5).lamp(7));
}

TEST(Lx3vpController, ErrorsAreToldOnceWithTheirLine) {
  Plc plc("LD M8013\nDECAM K1 D2000 X2 Y0 Y4\nLD M8000\nDIV K1 D0 D10\nEND\n");
  plc.block(2000, {{0, 0}, {0, 10}});
  plc.set("D2005", 1);
  plc.run_ms(5'000);
  const auto events = plc.events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_THAT(events[0], HasSubstr("LX3VP error: test.il:4: 6706"));
  EXPECT_EQ(events[1],
            "LX3VP error: test.il:2: 6782: the master of row 1 (D2044) is 0, not above 0 of the row before");
  EXPECT_THAT(plc.values("M8004 M8067"), ElementsAre(1, 1));
  EXPECT_GT(plc.get("D8069"), 0);
  covers({"M8004", "M8067", "D8067", "D8069"});

  Plc second("LD M8000\nDECAM K1 D2000 X2 Y0 Y4\nEND\n");
  second.set("D2023", 0);
  second.set("D2005", 1);
  second.run_ms(5);
  EXPECT_THAT(second.values("D8067 D8069 D2002"), ElementsAre(6781, 1, 6781));
}

TEST(Lx3vpController, HeldBackPulsesAreAWarning) {
  Plc plc("LD M8000\nDECAM D100 D2000 X2 Y0 Y4\nEND\n");
  plc.block(2000, {{0, 0}, {100'000, 100'000}});
  plc.set("D2005", 1);
  plc.run_ms(5);
  plc.set("DD100", 5'000);
  EXPECT_THAT(plc.run_ms(100).events(),
              ElementsAre("LX3VP warning: test.il:2: the frequency limit of D2006 holds back pulses "
                          "of Y0; they come later"));
}

TEST(Lx3vpController, ALimitOfZeroIsAWarningOfItsOwn) {
  Plc plc("LD M8000\nDECAM D100 D2000 X2 Y0 Y4\nEND\n");
  plc.block(2000, {{0, 0}, {100'000, 100'000}});
  plc.set("DD2006", 0);
  plc.set("D2005", 1);
  plc.run_ms(5);
  plc.set("DD100", 5'000);
  EXPECT_EQ(plc.run_ms(100).get("DD8140"), 0);
  EXPECT_THAT(plc.events(), ElementsAre("LX3VP warning: test.il:2: D2006 is 0: nothing comes out of Y0; "
                                        "write 1 to 200000"));
}

// A failing ECAMTBX stops no program, and the machine only stands still: it is told, once a change.
TEST(Lx3vpController, AFailingEcamtbxIsAWarningOnceAChange) {
  Plc plc("LD M8000\nECAMTBX D500 K101 D1000 D540\nEND\n");
  plc.set({{"DD500", 6560}, {"DD502", 12900}, {"DD504", 9400}, {"FD506", 2.5}, {"FD508", 2.5}, {"D510", 1}});
  EXPECT_EQ(plc.run_ms(100).get("DD540"), 200);
  EXPECT_THAT(plc.events(), testing::IsEmpty());
  plc.set("DD500", 3000);
  plc.run_ms(100);
  plc.set("DD500", 2999);  // the same result
  EXPECT_THAT(plc.run_ms(100).values("DD540 M8067"), ElementsAre(-3, 0));
  EXPECT_THAT(plc.events(),
              ElementsAre("LX3VP warning: test.il:2: ECAMTBX -3: P1 (D500) is 3000, but a stroke takes 6560 "
                          "master pulses (P2 (D502) is 12900, P3 (D504) is 9400, P4 (D506) is 2.5); "
                          "the block D1000 is left as it was"));
  plc.set("FD506", 0);
  plc.run_ms(100);
  plc.set("FD506", 2.5);
  plc.run_ms(100);
  const auto events = plc.events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_THAT(events[0], HasSubstr("ECAMTBX -8: "));
  EXPECT_THAT(events[1], HasSubstr("ECAMTBX -3: P1 (D500) is 2999"));
  plc.set("DD500", 6560);
  EXPECT_THAT(plc.run_ms(100).events(), testing::IsEmpty());
  plc.controller_.power(false);
  plc.controller_.power(true);
  plc.set("DD500", 3000);
  plc.run_ms(100);
  EXPECT_EQ(plc.events().size(), 1u);
}

TEST(Lx3vpController, PowerOffKeepsWhatIsRetentive) {
  Plc plc("LD M8002\nINC D300\nINC D0\nLD M8000\nOUT Y7\nDPLSV K1000 Y0 Y4\nEND\n");
  plc.set({{"D199", 1},
           {"D200", 2},
           {"D7999", 3},
           {"M499", 1},
           {"M500", 1},
           {"S499", 1},
           {"S500", 1},
           {"T245", 5},
           {"T246", 6},
           {"C99", 7},
           {"C100", 8},
           {"C219", 9},
           {"C220", 10}});
  EXPECT_TRUE(plc.run_ms(1'000).lamp(7));
  const auto pulses = plc.given();
  EXPECT_GT(pulses, 900);
  plc.controller_.power(false);
  EXPECT_FALSE(plc.lamp(7));
  EXPECT_FALSE(plc.run_ms(1'000).lamp(7));
  EXPECT_EQ(plc.given(), pulses);
  plc.controller_.power(true);
  EXPECT_EQ(plc.run_ms(1).get("D300"), 2) << "the first scan again";
  EXPECT_EQ(plc.get("D0"), 1);
  for (const char* name : {"D199", "M499", "S499", "T245", "C99", "C219"})
    EXPECT_EQ(plc.get(name), 0) << name;
  EXPECT_THAT(plc.values("D200 D7999 M500 S500 T246 C100 C220 DD8146"),
              ElementsAre(2, 3, 1, 1, 6, 8, 10, 100'000));
  plc.run_ms(1'000);
  EXPECT_GT(plc.given(), pulses + 900) << "a pulse train never goes back";
}

TEST(Lx3vpController, TimersBeginAnewWithThePower) {
  Plc plc("LD M8000\nOUT T0 K10\nLD T0\nOUT Y7\nEND\n");
  plc.run_ms(900);
  plc.controller_.power(false);
  plc.run_ms(50'000);
  plc.controller_.power(true);
  EXPECT_FALSE(plc.run_ms(990).lamp(7));
  EXPECT_TRUE(plc.run_ms(20).lamp(7));
}

TEST(Lx3vpController, TheRetentiveStateComesBackWhole) {
  Plc plc("LD M8000\nINC D300\nEND\n");
  plc.set({{"M700", 1}, {"D201", -5}, {"C225", -70'000}, {"CS225", 1}, {"D5", 9}});
  plc.run_ms(7);
  const std::string text = plc.controller_.retentive_state();
  EXPECT_EQ(text,
            "; retentive registers of test.il\nD201 = -5\nD300 = 7\nM700 = 1\nC225 = -70000\nCS225 = 1\n");
  Plc other("LD M8000\nINC D300\nEND\n");
  other.set("D400", 1);
  Problems problems;
  EXPECT_TRUE(other.controller_.restore(text, problems));
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_THAT(other.values("D300 CS225 D400"), ElementsAre(7, 1, 0));
  EXPECT_EQ(other.controller_.retentive_state(), text);
  EXPECT_FALSE(other.controller_.restore("D300 = x\n", problems, "kept.txt"));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(to_string(problems[0]),
            "kept.txt:1:8: 'x' is no number; write 5, -5, K5, H1F or 1.5 [registers.value]");
  EXPECT_EQ(other.get("D300"), 7);
}

TEST(Lx3vpController, TerminalsAreThoseOfTheProgramAndOfTheWires) {
  Lx3vpController controller(
      Plc::compile("LD X12\nOUT Y10\nMOV K1X20 D0\nOUT C251 K0\nLD M0\nDECAM C251 D2000 X2 Y0 Y4\nEND\n"),
      ms);
  std::vector<std::string> names;
  for (const auto& [address, terminal] : controller.cards().inputs) names.push_back(to_string(address));
  for (const auto& [address, terminal] : controller.cards().outputs) names.push_back(to_string(address));
  for (const auto& [address, terminal] : controller.cards().pulse_outputs)
    names.push_back(to_string(address));
  for (const auto& [address, terminal] : controller.cards().counters) names.push_back(to_string(address));
  EXPECT_THAT(names, ElementsAre("X2", "X12", "X20", "X21", "X22", "X23", "Y4", "Y10", "Y0", "C251"));
  EXPECT_TRUE(controller.offer(*parse_base_terminal("Y377")));
  EXPECT_TRUE(controller.cards().outputs.contains(*parse_base_terminal("Y377")));
  EXPECT_FALSE(controller.cards().pulse_outputs.contains(*parse_base_terminal("Y377")));
  EXPECT_TRUE(controller.offer(*parse_base_terminal("Y3")));
  EXPECT_TRUE(controller.cards().pulse_outputs.contains(*parse_base_terminal("Y3")));
  EXPECT_FALSE(controller.offer(*parse_base_terminal("C199")));
  EXPECT_FALSE(controller.offer(*parse_address("2.CNT01")));
}

TEST(Lx3vpController, NamesAreTheProgramsAndItsBlocks) {
  Lx3vpController controller(Plc::compile("LD X12\nDMOV K5 D10\nDECAM C251 D2000 X2 Y0 Y4\nEND\n"), ms);
  const auto names = controller.names();
  for (const char* name : {"X12", "DD10", "C251", "D2005", "DD2025", "DD8140"})
    EXPECT_THAT(names, Contains(name));
  for (const auto& name : names) EXPECT_TRUE(controller.find(name)) << name;
  EXPECT_FALSE(controller.find("AxisX.posit"));
  EXPECT_FALSE(controller.find("X2")->write);
  EXPECT_TRUE(controller.find("dd2025")->write);
  EXPECT_EQ(controller.find("dd2025")->name, "DD2025");
}

TEST(Lx3vpController, AnOutputThatIsWrittenIsGivenUntilTheProgramDrivesIt) {
  Lx3vpController controller(Plc::compile("LD M0\nOUT Y1\nEND\n"), ms);
  ASSERT_TRUE(controller.offer(*parse_base_terminal("Y2")));
  for (const char* name : {"Y1", "Y2"}) controller.find(name)->write(1);
  EXPECT_EQ(controller.find("Y2")->read(), 0) << "the scan gives it out";
  controller.run_tasks(0);
  EXPECT_EQ(controller.find("Y1")->read(), 0);
  EXPECT_EQ(controller.find("Y2")->read(), 1);
  EXPECT_TRUE(controller.cards().outputs.at(*parse_base_terminal("Y2")).level);
}

TEST(Lx3vpController, PeriodsAreTheTickAndTheScan) {
  Lx3vpController controller(Plc::compile("END\n"), 3 * ms);
  const auto periods = controller.periods();
  ASSERT_EQ(periods.size(), 2u);
  EXPECT_EQ(periods[0].ns, 100'000);
  EXPECT_EQ(periods[1].ns, 3 * ms);
}

TEST(Lx3vpController, TheSameRunGivesTheSameRegisters) {
  const auto run = [] {
    Plc plc("LD M8000\nOUT C235 K0\nDPLSV K12345 Y1 Y5\nDECAM C235 D2000 X2 Y0 Y4\nEND\n");
    plc.block(2000, {{0, 0}, {1'000, 700}, {3'000, 100}});
    plc.set("D2005", 1);
    plc.run_ms(3'000);
    return std::make_pair(plc.controller_.registers().d, plc.get("DD8140"));
  };
  EXPECT_EQ(run(), run());
}

// The manual's first demo (003 appendix 1.3), with nothing but what it says: the list of the rotary saw, its
// table, the cam of 4.1.1. The words of frequency and ratios keep their initial values.
TEST(Lx3vpController, TheManualsDemoOfTheRotarySawRuns) {
  Plc plc(R"(
LD M8002
DMOV K3183 D500       ; 1000 mm of material
DMOV K1000 D502       ; a turn of the cutter
DMOV K333 D504        ; synchronous over a third of it
DEMOV E1.6666666 D506 ; 5/3
DEMOV E16.666666 D508 ; ten times as much at most
MOV H1 D510           ; uniform acceleration
MOV H0 D511           ; leftCAM
MOV K0 D512
ECAMTBX D500 K100 D2000 D540
MOV K1 D2005
LD M8000
OUT C235 K0
LD M0
DPLSV K1000 Y1 Y5
DECAM C235 D2000 X2 Y0 Y4
END
)");
  EXPECT_EQ(plc.run_ms(2).get("D540"), 200);
  plc.set("M0", 1);
  plc.run_ms(10'000);
  EXPECT_THAT(
      plc.events(),
      ElementsAre("LX3VP note: test.il:17: the block D2000 has the initial values of its words that nothing "
                  "has written: D2006 200000, D2023 1, D2024 1, D2029 1, D2030 1"));
  // 10 s at 1 kHz are 3.14 cycles of 3183: three turns, and 620 of the fourth: 333 in the
  // synchronous zone of 200, 287 on the way to rest.
  EXPECT_NEAR(plc.get("DD2027"), 9'999, 5);
  EXPECT_NEAR(plc.get("DD8140"), 3620, 4);
}

TEST(Lx3vpController, AZeroThatWasWrittenOutlivesTheProcess) {
  Plc plc("LD M8000\nMOV K0 D2023\nEND\n");
  plc.run_ms(1);
  const auto text = plc.controller_.retentive_state();
  EXPECT_EQ(text, "; retentive registers of test.il\nD2023 = 0\n");
  Plc other("END\n");
  Problems problems;
  ASSERT_TRUE(other.controller_.restore(text, problems));
  EXPECT_TRUE(other.controller_.registers().written[2023]);
  EXPECT_FALSE(other.controller_.registers().written[2024]);
}

// 6105 stops the PLC: no scan tries again, no pulse and no output is left, until it is switched on again.
TEST(Lx3vpController, TheWatchdogStopsItUntilPowerUp) {
  covers({"M8061", "D8061", "M8020", "M8021", "M8022"});
  Plc plc(
      "LD M8000\nINC D0\nOUT Y7\nDPLSV K1000 Y0 Y5\nLD M1\nOUT M2\nFOR K32767\nFOR D300\nNEXT\nNEXT\nEND\n");
  plc.set("D300", 1);
  EXPECT_TRUE(plc.run_ms(20).lamp(7));
  plc.set("D300", 32767);
  plc.run_ms(100);
  EXPECT_THAT(
      plc.events(),
      ElementsAre(HasSubstr("LX3VP error: test.il:9: 6105: the scan works longer than the watchdog's 200 ms; "
                            "repeat less in a scan (CJ back, FOR, blocks); the PLC stops until")));
  EXPECT_EQ(plc.get("D0"), 21);
  EXPECT_FALSE(plc.lamp(7));
  EXPECT_THAT(plc.values("M8061 D8061"), ElementsAre(1, 6105));
  const auto given = plc.given();
  plc.run_ms(100);
  EXPECT_EQ(plc.given(), given);
  plc.set("D300", 1);
  plc.controller_.power(false);
  plc.run_ms(1);
  plc.controller_.power(true);
  EXPECT_EQ(plc.run_ms(10).get("D0"), 10);
  EXPECT_TRUE(plc.lamp(7));
  EXPECT_EQ(plc.get("M8061"), 0);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
