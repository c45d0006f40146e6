// What one sees of an instruction list: the registers of each line, the power of each in the last scan.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "devices/lx3vp/lx3vp_controller.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::ElementsAre;
using testing::Pair;

constexpr std::int64_t scan_time = 1'000'000;

struct WatchedPlc {
  Lx3vpController controller;
  std::int64_t now = 0;

  explicit WatchedPlc(const std::string& text, std::int64_t step_ns = 0)
      : controller(compiled_program(text), scan_time, step_ns) {
    controller.offer({Kind::input, 0, 0});
  }
  static il::IlProgram compiled_program(const std::string& text) {
    Problems problems;
    auto program = il::compile(text, "watched.il", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return program;
  }
  void until(std::int64_t time_ns) {
    for (; now <= time_ns; now += tick_ns) {
      controller.run_devices(now);
      controller.run_tasks(now);
    }
  }
  bool& input() { return controller.cards().inputs.at({Kind::input, 0, 0}).level; }
  [[nodiscard]] std::string scanned() const { return controller.positions(now).scanned.at(0); }
  [[nodiscard]] ProgramPositions::Task task() const { return controller.positions(now).tasks.at(0); }
};

TEST(Lx3vpPrograms, TellTheRegistersOfEachLineAsItTakesThem) {
  const std::string text =
      "; a comment\n"
      "LD X0\n"               // 2
      "AND T0\n"              // 3
      "OUT T0 K10\n"          // 4
      "LD C5\n"               // 5
      "RST C5\n"              // 6
      "LD D10.F\n"            // 7
      "DMOV D20 D30\n"        // 8
      "DEADD D40 E1.5 D42\n"  // 9
      "MOV D50 D50\n"         // 10
      "MOV D60Z1 K2M0\n"      // 11
      "END\n";
  WatchedPlc plc(text);
  const auto told = plc.controller.programs();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].file, "watched.il");
  EXPECT_EQ(told[0].language, "il");
  EXPECT_EQ(told[0].text, text);
  EXPECT_THAT(told[0].values,
              ElementsAre(Pair(2, ElementsAre("X0")), Pair(3, ElementsAre("TS0")), Pair(4, ElementsAre("T0")),
                          Pair(5, ElementsAre("CS5")), Pair(6, ElementsAre("C5")),
                          Pair(7, ElementsAre("D10.F")), Pair(8, ElementsAre("DD20", "DD30")),
                          Pair(9, ElementsAre("FD40", "FD42")), Pair(10, ElementsAre("D50"))));
  for (const auto& [line, names] : told[0].values)
    for (const auto& name : names) EXPECT_TRUE(plc.controller.find(name).has_value()) << name;
}

TEST(Lx3vpPrograms, ShowThePowerOfEachLineInTheLastScan) {
  WatchedPlc plc(
      "LD X0\n"      // 1
      "MPS\n"        // 2
      "AND M0\n"     // 3
      "OUT M1\n"     // 4
      "MPP\n"        // 5
      "CJ P1\n"      // 6
      "LDI X0\n"     // 7
      "SET M2\n"     // 8
      "P1:\n"        // 9
      "LD M8000\n"   // 10
      "MOV K1 D0\n"  // 11
      "END\n");      // 12
  plc.until(2 * scan_time);
  EXPECT_EQ(plc.scanned(), "");  // nobody looked
  plc.controller.watch_programs(true);
  plc.until(3 * scan_time);
  EXPECT_EQ(plc.scanned(), "------++++++");
  plc.input() = true;
  plc.until(4 * scan_time);
  EXPECT_EQ(plc.scanned(), "++--++  ++++");  // jumped over 7 and 8
  plc.controller.watch_programs(false);
  plc.until(5 * scan_time);
  EXPECT_EQ(plc.scanned(), "");
}

TEST(Lx3vpPrograms, ALoopShowsTheBestOfItsRounds) {
  WatchedPlc plc("FOR K3\nLD= K2 D0\nOUT M5\nLD M8000\nINC D0\nNEXT\nLD M8000\nMOV K0 D0\nEND\n");
  plc.controller.watch_programs(true);
  plc.until(scan_time);
  EXPECT_EQ(plc.scanned(), "+++++++++");
}

TEST(Lx3vpPrograms, StandWhereAScanIsWithInstructionsThatTakeTime) {
  WatchedPlc plc("LD M8000\nMOV K1 D0\nMOV K2 D0\nEND\n", 300'000);
  plc.until(100'000);
  EXPECT_EQ(plc.task().line, 1);
  EXPECT_EQ(plc.task().doing, "runs");
  plc.until(700'000);  // two have ended
  EXPECT_EQ(plc.task().line, 3);
  plc.until(1'200'000);  // four, the next scan has begun with the fifth tenth
  EXPECT_EQ(plc.task().line, 1);
  plc.controller.power(false);
  EXPECT_EQ(plc.task().line, 0);
  EXPECT_EQ(plc.task().doing, "no power");
}

TEST(Lx3vpPrograms, StandWhereTheWatchdogStoppedThem) {
  WatchedPlc plc("P0:\nLD M8000\nCJ P0\nEND\n");
  plc.until(scan_time);
  EXPECT_THAT(plc.task().doing, "stopped by the watchdog");
  EXPECT_GE(plc.task().line, 1);
  EXPECT_LE(plc.task().line, 3);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
