// Interrupt routines, what high-speed counters, PWM, PLSR and SPD do between scans, and the relays that an
// operator's program asks with.
#include <gmock/gmock.h>

#include <sstream>

#include "devices/lx3vp/lx3vp_controller.hpp"
#include "tests/devices/lx3vp/covers.hpp"
#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t a_ms = 1'000'000;

/// A PLC that scans every 10 ms, with X0..X7, Y0..Y17 and C251 on its terminals.
class SlowPlc {
 public:
  explicit SlowPlc(const std::string& text, std::int64_t scan_ns = 10 * a_ms, std::int64_t step_ns = 0)
      : controller_(compiled(text + "\nEND\n"), scan_ns, step_ns) {
    for (int i = 0; i < 8; ++i) controller_.offer({Kind::input, 0, i});
    for (int i = 0; i < 16; ++i) controller_.offer({Kind::output, 0, i});
    controller_.offer({Kind::counter, 0, 251});
  }
  static il::IlProgram compiled(const std::string& text) {
    Problems problems;
    auto program = il::compile(text, "test.il", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return program;
  }
  SlowPlc& ticks(int count) {
    for (int i = 0; i < count; ++i) {
      controller_.run_devices(time_);
      controller_.run_tasks(time_);
      time_ += tick_ns;
    }
    return *this;
  }
  SlowPlc& run(int time_ms) { return ticks(10 * time_ms); }
  /// A level that lies on for `count` ticks, then off as long.
  SlowPlc& pulse(int input, int count = 1) {
    press(input, true).ticks(count);
    return press(input, false).ticks(count);
  }
  SlowPlc& press(int input, bool on) {
    controller_.cards().inputs[{Kind::input, 0, input}].level = on;
    return *this;
  }
  SlowPlc& count(std::int64_t pulses) {
    controller_.cards().counters[{Kind::counter, 0, 251}].count += 4 * pulses;
    return *this;
  }
  bool lamp(int output) { return controller_.cards().outputs[{Kind::output, 0, output}].level; }
  std::int64_t pulses(int output = 0) {
    return controller_.cards().pulse_outputs[{Kind::output, 0, output}].count;
  }
  double get(const std::string& name) { return controller_.find(name).value().read(); }
  SlowPlc& set(const std::string& name, double value) {
    controller_.find(name).value().write(value);
    return *this;
  }
  std::vector<double> values(const std::string& names) {
    std::vector<double> read;
    std::istringstream words(names);
    for (std::string name; words >> name;) read.push_back(get(name));
    return read;
  }
  std::vector<std::string> events() {
    std::vector<std::string> texts;
    for (const auto& event : controller_.take_events()) texts.push_back(event.text);
    return texts;
  }

  Lx3vpController controller_;
  std::int64_t time_ = 0;
};

TEST(Lx3vpInterrupts, EdgesOfInputsComeInTheirTick) {
  SlowPlc plc("EI\nFEND\nI001\nLD M8000\nINC D0\nIRET\nI100\nLD M8000\nINC D1\nIRET");
  plc.run(1);  // the first scan enables them
  plc.pulse(0).pulse(0).pulse(1);
  EXPECT_THAT(plc.values("D0 D1"), ElementsAre(2, 1)) << "six ticks, no further scan";
  plc.press(0, true).press(1, true).ticks(1);
  EXPECT_THAT(plc.values("D0 D1"), ElementsAre(3, 1)) << "X1 asks as it goes off";
}

TEST(Lx3vpInterrupts, WhatDiHoldsBackComesWithEiAndOnce) {
  SlowPlc plc("LD M0\nCJ P0\nEI\nP0\nLDI M0\nCJ P1\nDI\nP1\nFEND\nI001\nLD M8000\nINC D0\nIRET");
  plc.set("M0", 1).run(1);
  plc.pulse(0).pulse(0);
  EXPECT_EQ(plc.get("D0"), 0);
  plc.set("M0", 0).run(10);
  EXPECT_EQ(plc.get("D0"), 1);
  plc.set("M0", 1).run(10).pulse(0).run(20);
  EXPECT_EQ(plc.get("D0"), 1) << "DI holds them back again";
}

TEST(Lx3vpInterrupts, RelaysRefuseThem) {
  SlowPlc plc(
      "EI\nFEND\nI201\nLD M8000\nINC D2\nIRET\nI710\nLD M8000\nINC D7\nIRET\nI010\nLD M8000\nINC "
      "D10\nIRET\nI020\n"
      "LD M8000\nINC D11\nIRET\nI301\nLD M8000\nINC D3\nIRET");
  plc.set("M8052", 1).run(1).pulse(2).pulse(3);
  EXPECT_THAT(plc.values("D2 D3"), ElementsAre(0, 1));
  plc.set("M8052", 0).run(20);
  EXPECT_EQ(plc.get("D2"), 0) << "what was refused is lost";
  plc.pulse(2);
  EXPECT_EQ(plc.get("D2"), 1);
  const double before = plc.get("D7");
  plc.set("M8057", 1).run(100);
  EXPECT_EQ(plc.get("D7"), before);
  covers({"M8050", "M8056"});
}

TEST(Lx3vpInterrupts, TimersComeByTheClock) {
  SlowPlc plc("EI\nFEND\nI620\nLD M8000\nINC D0\nIRET\nI715\nLD M8000\nINC D1\nIRET");
  EXPECT_THAT(plc.ticks(3001).values("D0 D1"), ElementsAre(15, 20)) << "300 ms";
}

TEST(Lx3vpInterrupts, ARoutineMayRefreshAndCall) {
  SlowPlc plc(
      "EI\nFEND\nP0\nLD M8000\nINC D1\nSRET\nI001\nLD X2\nOUT Y7\nLD M8000\nREF X0 K8\nCALL P0\nLD X2\nOUT "
      "Y5\n"
      "REF Y0 K8\nIRET");
  plc.run(1).press(2, true).pulse(0);
  EXPECT_TRUE(plc.lamp(5)) << "given at once";
  EXPECT_FALSE(plc.lamp(7)) << "X2 was the image of the last scan";
  EXPECT_EQ(plc.get("D1"), 1);
}

// LD, INC and IRET behind the label: the scan's end comes four instructions later.
TEST(Lx3vpInterrupts, TheirInstructionsDelayAScanThatTakesTime) {
  const auto given_at = [](bool interrupt) {
    SlowPlc plc("EI\nLD M8000\nOUT Y7\nFEND\nI001\nLD M8000\nINC D0\nIRET", 10 * a_ms, 500'000);
    int ticks = 0;
    for (; ticks < 100 && !plc.lamp(7); ++ticks) {
      if (interrupt && ticks == 8) plc.press(0, true);
      plc.ticks(1);
    }
    return ticks;
  };
  EXPECT_EQ(given_at(true) - given_at(false), 4 * 5);
}

TEST(Lx3vpInterrupts, LabelsAreLookedAt) {
  using il::faults;
  EXPECT_THAT(
      faults("EI\nFEND\nI002\nIRET\nI600\nIRET\nI1\nIRET\nI070\nIRET\nEND"),
      ElementsAre(
          HasSubstr("3:1: there is no interrupt 'I002'; X0 to X5 have I000 and I001 to I500 and I501"),
          HasSubstr("5:1: there is no interrupt 'I600'"), HasSubstr("7:1: there is no interrupt 'I1'"),
          HasSubstr("9:1: there is no interrupt 'I070'")));
  EXPECT_THAT(faults("FEND\nI001\nIRET\nI000\nIRET\nI610\nIRET\nI699\nIRET\nI001\nIRET\nEND"),
              ElementsAre("4:1: I000 and I001 are of the same input; it has one interrupt: keep one of them "
                          "[il.jump]",
                          "8:1: I699 and I610 are of the same timer; it has one interrupt: keep one of them "
                          "[il.jump]",
                          "10:1: label I001 is there twice; it was first given in line 2 [il.jump]"));
  EXPECT_THAT(
      faults("I001\nLD X0\nOUT Y0\nEND"),
      ElementsAre("1:1: I001 has no IRET behind it; put interrupt routines behind FEND and end each with "
                  "IRET [il.structure]"));
  EXPECT_THAT(faults("LD X0\nOUT Y0\nIRET\nEND"),
              ElementsAre("3:1: IRET stands in the main program; put interrupt routines behind FEND "
                          "[il.structure]"));
  EXPECT_THAT(
      faults("LD X0\nCJ P1\nCALL P1\nFEND\nI001\nP1\nLD X0\nMC N0 M0\nMCR N0\nIRET\nEND"),
      ElementsAre("8:1: MC stands in an interrupt routine; put master contacts and sequences into the "
                  "main program [il.structure]",
                  "2:4: CJ jumps into an interrupt routine; it begins when its interrupt comes [il.jump]",
                  "3:6: P1 in line 6 is no subroutine: it has no SRET; put it behind FEND and end it with "
                  "SRET [il.jump]"));
  EXPECT_THAT(
      faults("LD X0\nDHSCS K5 C251 I010\nDHSCS K5 C251 I001\nEND"),
      ElementsAre("3:15: DHSCS does not take I001 here; it takes Y, M, S or I010 to I060 [il.operand]",
                  "2:15: there is no label I010; begin an interrupt routine with it, behind FEND [il.jump]"));
  EXPECT_THAT(
      faults("LD X0\nREF X1 K8\nREF Y0 K12\nREF M0 K8\nEND"),
      ElementsAre("2:5: REF begins at X1; begin where a row of eight does: X0, X10, X20 [il.operand]",
                  "3:8: REF refreshes 12 of Y0; write K8, K16 and on, as many as there are [il.operand]",
                  "4:5: REF does not take M0 here; it takes X or Y [il.operand]"));
}

TEST(Lx3vpCounters, CompareBetweenScans) {
  SlowPlc plc(
      "EI\nLD M8000\nOUT C251 K1000000\nDHSCS K100 C251 Y5\nDHSCR D20 C251 Y5\nDHSCS K120 C251 I030\n"
      "DHSZ K50 K80 C251 M10\nFEND\nI030\nLD M8000\nDMOV C251 D0\nIRET");
  plc.set("DD20", 110).run(1);
  EXPECT_THAT(plc.count(60).ticks(1).values("M10 M11 M12"), ElementsAre(0, 1, 0));
  EXPECT_FALSE(plc.lamp(5));
  plc.count(45).ticks(1);
  EXPECT_TRUE(plc.lamp(5)) << "past 100, in the same tick";
  EXPECT_THAT(plc.values("M10 M11 M12"), ElementsAre(0, 0, 1));
  plc.count(10).ticks(1);
  EXPECT_FALSE(plc.lamp(5)) << "past 110";
  EXPECT_EQ(plc.count(7).ticks(1).get("DD0"), 122) << "the interrupt's routine sees the count";
  plc.count(-30).ticks(1);
  EXPECT_EQ(plc.get("DD0"), 92) << "it comes downwards too";
  EXPECT_TRUE(plc.lamp(5));
  plc.set("M8059", 1).count(40).ticks(1);
  EXPECT_EQ(plc.get("DD0"), 92);
  covers({"M8059"});
}

TEST(Lx3vpCounters, ACounterThatResetsItselfLosesNothing) {
  SlowPlc plc("LD M8000\nOUT C251 K100\nDHSCR K100 C251 C251");
  plc.run(1).count(97).ticks(1).count(8).ticks(1);
  EXPECT_EQ(plc.get("C251"), 5);
  EXPECT_FALSE(plc.get("CS251"));
}

TEST(Lx3vpCounters, WhatCountsNoPulsesIsTold) {
  SlowPlc plc("LD M8000\nDHSCS K5 C200 M0");
  EXPECT_THAT(plc.run(1).events(),
              ElementsAre("test.il:2: 6706: DHSCS: C200 counts no pulses: wire it, or take C235 to C255"));
  EXPECT_THAT(il::faults("LD X0\nDHSCS K5 C100 M0\nHSCS K5 C251 M0\nDHSCR K5 C251 C252\nEND"),
              ElementsAre("2:10: DHSCS does not take C100 here; it takes C200 to C255 [il.operand]",
                          HasSubstr("3:1: there is no instruction 'HSCS'; did you mean DHSCS?"),
                          "4:15: DHSCR compares C251 and resets C252; a counter resets itself, or Y, M or S "
                          "[il.operand]"));
}

TEST(Lx3vpSpeed, SpdCountsPulsesOfATime) {
  SlowPlc plc("LD M0\nSPD X3 K50 D0");
  plc.set("M0", 1).run(1);
  // A pulse of 1 ms a period of 2 ms: 25 in 50 ms, whenever they begin.
  for (int i = 0; i < 60; ++i) plc.pulse(3, 10);
  EXPECT_EQ(plc.get("D0"), 25);
  EXPECT_GT(plc.get("D1"), 0);
  EXPECT_THAT(plc.get("D2"), testing::AllOf(testing::Gt(0), testing::Le(50)));
  plc.set("M0", 0).run(20);
  plc.set("D0", -1).run(100);
  EXPECT_EQ(plc.get("D0"), -1) << "without power it measures nothing";
  EXPECT_THAT(il::faults("LD X0\nSPD X6 K50 D0\nEND"),
              ElementsAre("2:5: SPD does not take X6 here; it takes X0 to X5 [il.operand]"));
}

TEST(Lx3vpPwm, GivesItsShareOfThePeriod) {
  SlowPlc plc("LD M0\nPWM D0 K10 Y1");
  plc.set("D0", 3).set("M0", 1).run(1);
  int on = 0;
  for (int i = 0; i < 1000; ++i) on += plc.ticks(1).lamp(1) ? 1 : 0;
  EXPECT_EQ(on, 300);
  EXPECT_EQ(plc.get("M8148"), 1);
  plc.set("D0", 10).run(20);
  on = 0;
  for (int i = 0; i < 200; ++i) on += plc.ticks(1).lamp(1) ? 1 : 0;
  EXPECT_EQ(on, 200) << "all of it";
  plc.set("M0", 0).run(10);
  EXPECT_FALSE(plc.lamp(1));
  EXPECT_FALSE(plc.run(50).lamp(1));
  plc.set("D0", 11).set("M0", 1);
  EXPECT_THAT(plc.run(10).events(),
              ElementsAre("test.il:2: 6706: PWM: S1 is 11, more than the period S2 of 10"));
}

// From 0 to 1000 Hz in 500 ms and back make 500 pulses, the other 1000 take 1 s.
TEST(Lx3vpPwm, PlsrHasRampsOfItsOwn) {
  SlowPlc plc("LD M0\nPLSR K1000 K1500 K500 Y0\nAND M8029\nSET M1", a_ms);
  plc.set("M0", 1).run(250);
  EXPECT_NEAR(static_cast<double>(plc.pulses()), 62.5, 12)
      << "a quarter of the ramp's distance at half its time";
  plc.run(250 + 500);
  EXPECT_NEAR(static_cast<double>(plc.pulses()), 250 + 500, 20);
  EXPECT_EQ(plc.get("M1"), 0);
  plc.run(1'100);
  EXPECT_EQ(plc.pulses(), 1500);
  EXPECT_EQ(plc.get("M1"), 1);
  EXPECT_EQ(plc.get("DD8140"), 1500);
}

TEST(Lx3vpRelays, M8034SwitchesAllOutputsOffAndThePulsesToo) {
  SlowPlc plc("LD M8000\nOUT Y7\nDPLSV K1000 Y0 Y5\nLD M0\nOUT M8034", a_ms);
  plc.run(100);
  EXPECT_TRUE(plc.lamp(7));
  const auto given = plc.pulses();
  EXPECT_GT(given, 90);
  plc.set("M0", 1).run(100);
  EXPECT_FALSE(plc.lamp(7));
  EXPECT_FALSE(plc.lamp(5));
  EXPECT_LE(plc.pulses() - given, 2) << "those of the scan that switches";
  EXPECT_GT(plc.get("DD8140"), 190) << "the PLC counts on";
  plc.set("M0", 0).run(10);
  EXPECT_TRUE(plc.lamp(7));
  plc.run(90);
  EXPECT_NEAR(static_cast<double>(plc.pulses() - given), 100, 3);
  covers({"M8034"});
}

TEST(Lx3vpRelays, M8037StopsAndM8036RunsAgain) {
  for (const bool holds : {false, true}) {
    SlowPlc plc("LD M8002\nINC D300\nLD M8000\nINC D0\nSET Y7\nSET S5\nDPLSV K1000 Y0 Y5", a_ms);
    plc.set("M8033", holds ? 1 : 0).run(10).set("M8037", 1).run(1);
    const auto at = plc.pulses();
    plc.run(50);
    EXPECT_EQ(plc.pulses(), at);
    EXPECT_EQ(plc.get("D0"), holds ? 11 : 0);
    EXPECT_EQ(plc.get("S5"), holds ? 1 : 0);
    EXPECT_EQ(plc.lamp(7), holds);
    EXPECT_THAT(plc.values("M8036 M8037 D300"), ElementsAre(0, 0, 1));
    EXPECT_EQ(plc.controller_.positions(0).tasks[0].doing, "stopped by M8037");
    plc.set("M8036", 1).run(10);
    EXPECT_EQ(plc.get("D0"), holds ? 21 : 10);
    EXPECT_THAT(plc.values("M8036 D300"), ElementsAre(0, 2)) << "M8002 comes again";
    EXPECT_GT(plc.pulses(), at);
  }
  covers({"M8033", "M8036", "M8037"});
}

// M8000 to M8003 tell that it does not run, the clocks go on, those of the calendar too.
TEST(Lx3vpRelays, AStopIsToldAndTheClocksGoOn) {
  for (const std::int64_t step_ns : {0, 1'000}) {
    SlowPlc plc("LD M8000\nINC D0\nLDI M0\nCJ P0\nFOR K32767\nFOR K32767\nNEXT\nNEXT\nP0", a_ms, step_ns);
    const std::string relays = "M8000 M8001 M8002 M8003";
    EXPECT_THAT(plc.ticks(1).values(relays), ElementsAre(1, 0, 1, 0)) << "the first scan";
    plc.run(100).set("M8037", 1).run(2);
    EXPECT_THAT(plc.values(relays), ElementsAre(0, 1, 0, 1));
    int seconds = 0;
    int hundredths = 0;
    bool second = plc.get("M8013") != 0;
    bool hundredth = plc.get("M8011") != 0;
    const double clock = plc.get("D8013");
    for (int i = 0; i < 50'000; ++i) {
      plc.ticks(1);
      seconds += std::exchange(second, plc.get("M8013") != 0) != second ? 1 : 0;
      hundredths += std::exchange(hundredth, plc.get("M8011") != 0) != hundredth ? 1 : 0;
    }
    EXPECT_EQ(seconds, 10);
    EXPECT_EQ(hundredths, 1'000);
    EXPECT_EQ(plc.get("D8013"), clock + 5);
    plc.set("M8036", 1).run(5);
    EXPECT_THAT(plc.values(relays), ElementsAre(1, 0, 0, 1));
    // So it is where the watchdog has stopped it.
    plc.set("D8000", 1).run(1).set("M0", 1).run(10);
    EXPECT_THAT(plc.values(relays + " M8061"), ElementsAre(0, 1, 0, 1, 1)) << step_ns;
    const double before = plc.get("M8014");
    EXPECT_NE(plc.run(30'000).get("M8014"), before);
  }
}

TEST(Lx3vpRelays, WithoutPowerTheProgramDoesNotRun) {
  SlowPlc plc("LD M8000\nDPLSV K1000 Y0 Y5", a_ms);
  const std::string relays = "M8000 M8001 M8002 M8003 M8013 M8147";
  EXPECT_THAT(plc.run(700).values(relays), ElementsAre(1, 0, 0, 1, 1, 1));
  plc.controller_.power(false);
  EXPECT_THAT(plc.values(relays), ElementsAre(0, 1, 0, 1, 0, 0));
  EXPECT_THAT(plc.run(700).values(relays), ElementsAre(0, 1, 0, 1, 0, 0));
  plc.controller_.power(true);
  EXPECT_THAT(plc.ticks(1).values("M8000 M8001 M8002 M8003"), ElementsAre(1, 0, 1, 0));
}

TEST(Lx3vpRelays, AStoppedProgramTakesNoInterruptAndComparesNothing) {
  SlowPlc plc("EI\nLD M8000\nOUT C251 K9\nDHSCS K5 C251 Y5\nFEND\nI001\nLD M8000\nINC D300\nIRET", a_ms);
  plc.run(5).set("M8037", 1).run(5);
  plc.pulse(0).count(7).run(5);
  EXPECT_EQ(plc.get("D300"), 0);
  EXPECT_FALSE(plc.lamp(5));
}

TEST(Lx3vpRelays, M8031AndM8032Clear) {
  SlowPlc plc("LD M0\nOUT M8031\nLD M1\nOUT M8032", a_ms);
  for (const char* name : {"D100", "D300", "M100", "M600", "C10", "C110"}) plc.set(name, 1);
  plc.set("M0", 1).run(5);
  EXPECT_THAT(plc.values("D100 D300 M100 M600 C10 C110 M0"), ElementsAre(0, 1, 0, 1, 0, 1, 0));
  plc.set("D100", 1).set("M1", 1).run(5);
  EXPECT_THAT(plc.values("D100 D300 M600 C110 M8032"), ElementsAre(1, 0, 0, 0, 0))
      << "M1 is none of the retentive ones and asks in each scan; M8032 goes off each time";
  covers({"M8031", "M8032"});
}

TEST(Lx3vpRelays, M8039HoldsTheScanConstant) {
  SlowPlc plc("LD M8000\nINC D0\nLD M0\nOUT M8039", a_ms);
  plc.set("D8039", 8).run(80);
  EXPECT_EQ(plc.get("D0"), 80);
  EXPECT_EQ(plc.get("D8010"), 10) << "0.1 ms";
  plc.set("M0", 1).run(10).set("D0", 0).run(80);
  EXPECT_EQ(plc.get("D0"), 10);
  EXPECT_THAT(plc.values("D8010 D8011 D8012"), ElementsAre(80, 10, 80));
  // Where instructions take time, too.
  SlowPlc timed("LD M8000\nINC D0\nOUT M8039", a_ms, 10'000);
  timed.set("D8039", 8).run(81);
  EXPECT_EQ(timed.get("D0"), 11);
  covers({"M8039", "D8039", "D8011", "D8012"});
}

TEST(Lx3vpRelays, M8040HoldsSequencesAndM8047TellsThem) {
  SlowPlc plc(
      "LD M8002\nSET S10\nSET S950\nLD M1\nOUT M8040\nLD M8000\nOUT M8047\nOUT M8049\nSTL S10\nOUT Y5\nLD "
      "X0\n"
      "SET S20\nSTL S20\nOUT Y7\nRET");
  plc.set("M1", 1).set("S7", 1).run(11).press(0, true).run(20);
  EXPECT_TRUE(plc.lamp(5)) << "its coils go on";
  EXPECT_THAT(plc.values("S10 S20 D8040 D8041 D8042 M8046 M8048 D8049"),
              ElementsAre(1, 0, 7, 10, 0, 1, 1, 950));
  plc.set("M1", 0).run(20);
  EXPECT_THAT(plc.values("S10 S20 D8041"), ElementsAre(0, 1, 20));
  EXPECT_TRUE(plc.lamp(7));
  SlowPlc none("LD M8000\nOUT M8049\nOUT M8047");
  EXPECT_THAT(none.run(11).values("M8046 M8048 D8049 D8040"), ElementsAre(0, 0, 0, 0));
  covers({"M8040", "M8046", "M8047", "M8048", "M8049", "D8040", "D8049"});
}

TEST(Lx3vpRelays, TheWatchdogTimeIsThePrograms) {
  // 32767 times three instructions are 20 ms.
  const std::string loop = "FOR K32767\nLD M8000\nINC D1\nNEXT\n";
  SlowPlc plc("LD M0\nMOV K15 D8000\n" + loop, a_ms);
  EXPECT_EQ(plc.run(5).get("D8000"), 200);
  EXPECT_THAT(plc.set("M0", 1).run(1).events(), IsEmpty()) << "from the next scan on";
  EXPECT_THAT(plc.run(1).events(),
              ElementsAre(HasSubstr("6105: the scan works longer than the watchdog's 15 ms")));
  // WDT half way gives the time anew.
  SlowPlc fed("LD M8000\nMOV K25 D8000\n" + loop + "LD M8000\nWDT\n" + loop, a_ms);
  EXPECT_THAT(fed.run(5).events(), IsEmpty());
  SlowPlc hungry("LD M8000\nMOV K25 D8000\n" + loop + loop, a_ms);
  EXPECT_EQ(hungry.run(5).events().size(), 1u);
  SlowPlc endless("P0\nLD M8000\nWDT\nCJ P0", a_ms);
  EXPECT_EQ(endless.run(5).events().size(), 1u) << "ten times at most";
  covers({"D8000"});
}

TEST(Lx3vpRelays, AnInterruptThatNeverEndsIsStoppedOnce) {
  SlowPlc plc("EI\nLD M8000\nOUT Y7\nFEND\nI001\nP0\nLD M8000\nCJ P0\nIRET", a_ms);
  plc.run(2).pulse(0).run(5);
  EXPECT_THAT(plc.events(), ElementsAre(HasSubstr("6105")));
  EXPECT_FALSE(plc.lamp(7));
}

TEST(Lx3vpRelays, TheClockStandsInItsRegisters) {
  SlowPlc plc("LD X0\nTWR D0");
  EXPECT_THAT(plc.run(61'001).values("D8018 D8017 D8016 D8015 D8014 D8013 D8019"),
              ElementsAre(0, 1, 1, 0, 1, 1, 6));
  for (const auto& [name, value] : std::vector<std::pair<std::string, double>>{
           {"D0", 26}, {"D1", 12}, {"D2", 31}, {"D3", 23}, {"D4", 59}, {"D5", 58}, {"D6", 0}})
    plc.set(name, value);
  plc.press(0, true).run(10).press(0, false).run(3'000);
  EXPECT_THAT(plc.values("D8018 D8017 D8016 D8015 D8014 D8013 D8019"), ElementsAre(27, 1, 1, 0, 0, 1, 5));
  covers({"D8013", "D8014", "D8015", "D8016", "D8017", "D8018", "D8019"});
}

}  // namespace
}  // namespace drycut::devices::lx3vp
