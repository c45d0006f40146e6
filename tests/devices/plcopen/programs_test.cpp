// What one sees of Structured Text: the variables of each line, what the last scan executed, where it stands.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "devices/plcopen/controller/controller.hpp"

namespace drycut::devices::plcopen {
namespace {

using testing::ElementsAre;
using testing::Pair;

constexpr std::int64_t ms = 1'000'000;

struct WatchedRig {
  PlcopenController controller;
  std::int64_t now = 0;

  explicit WatchedRig(const std::string& text, std::int64_t statement_ns = 0)
      : controller(compiled_text(text), "watched.st", configured(statement_ns)) {}
  static PlcopenConfiguration configured(std::int64_t statement_ns) {
    PlcopenConfiguration made;
    made.cycle_ns = ms;
    made.task_ns = 10 * ms;
    made.statement_ns = statement_ns;
    return made;
  }
  static st::Program compiled_text(const std::string& text) {
    Problems problems;
    auto program = st::compile(text, "watched.st", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return program;
  }
  void until(std::int64_t time_ns) {
    for (; now <= time_ns; now += ms) {
      controller.run_devices(now);
      controller.run_tasks(now);
    }
  }
  void set(const std::string& name, double value) { controller.find(name).value().write(value); }
  [[nodiscard]] std::string scanned() const { return controller.positions(now - ms).scanned.at(0); }
  [[nodiscard]] ProgramPositions::Task task() const { return controller.positions(now - ms).tasks.at(0); }
};

const std::string two_counters =
    "VAR_GLOBAL limit : DINT := 3; END_VAR\n"          // 1
    "FUNCTION_BLOCK Counter\n"                         // 2
    "VAR_INPUT inc : DINT; END_VAR\n"                  // 3
    "VAR_OUTPUT count : DINT; END_VAR\n"               // 4
    "IF count < limit THEN\n"                          // 5
    "  count := count + inc;\n"                        // 6
    "END_IF\n"                                         // 7
    "END_FUNCTION_BLOCK\n"                             // 8
    "PROGRAM main\n"                                   // 9
    "VAR A : Counter; B : Counter; delay : TON;\n"     // 10
    "  p : ARRAY [1..3] OF DINT; i : DINT; END_VAR\n"  // 11
    "a(Inc := 1 (* inc := 7 *), count => p[2]);\n"     // 12
    "IF p[2] = 2 THEN\n"                               // 13
    "  B(inc := limit);\n"                             // 14
    "ELSIF P[1] = 0 THEN i := i + 1;\n"                // 15
    "ELSE i := p[i];\n"                                // 16
    "END_IF\n"                                         // 17
    "delay(IN := TRUE, PT := T#50ms);\n"               // 18
    "END_PROGRAM\n";                                   // 19

TEST(StPrograms, TellTheVariablesOfEachLine) {
  WatchedRig rig(two_counters);
  const auto told = rig.controller.programs();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].file, "watched.st");
  EXPECT_EQ(told[0].language, "st");
  EXPECT_EQ(told[0].text, two_counters);
  const auto& values = told[0].values;
  EXPECT_THAT(values.at(5), ElementsAre("A.count", "B.count", "limit"));
  EXPECT_THAT(values.at(6), ElementsAre("A.count", "B.count", "A.inc", "B.inc"));
  EXPECT_THAT(values.at(12), ElementsAre("A.inc", "A.count", "p[2]"));
  EXPECT_THAT(values.at(13), ElementsAre("p[2]"));
  EXPECT_THAT(values.at(14), ElementsAre("B.inc", "limit"));
  EXPECT_THAT(values.at(15), ElementsAre("p[1]", "i"));
  EXPECT_THAT(values.at(16), ElementsAre("i"));
  EXPECT_THAT(values.at(18), ElementsAre("delay.IN", "delay.PT"));
  for (const auto& [line, names] : values)
    for (const auto& name : names) EXPECT_TRUE(rig.controller.find(name).has_value()) << name;
}

TEST(StPrograms, SeveralProgramsHaveTheirOwn) {
  WatchedRig rig(
      "PROGRAM one\nVAR n : DINT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
      "PROGRAM two\nVAR n : DINT; END_VAR\nn := n + 2;\nEND_PROGRAM\n");
  const auto told = rig.controller.programs();
  EXPECT_THAT(told[0].values.at(3), ElementsAre("one.n"));
  EXPECT_THAT(told[0].values.at(7), ElementsAre("two.n"));
}

TEST(StPrograms, ShowWhatTheLastScanExecuted) {
  WatchedRig rig(two_counters);
  rig.until(5 * ms);
  EXPECT_EQ(rig.scanned(), "");  // nobody looked
  rig.controller.watch_programs(true);
  rig.until(10 * ms);  // the second scan: count is 2
  //                        1   5    10   15
  EXPECT_EQ(rig.scanned(), "    ++     +++   + ");
  rig.until(20 * ms);  // count is 3; the standard block's own lines are not of this text
  EXPECT_EQ(rig.scanned(), "    ++     +- +  + ");
  rig.set("p[1]", 1);
  rig.until(30 * ms);
  EXPECT_EQ(rig.scanned(), "    -      +- -+ + ");
  rig.controller.watch_programs(false);
  rig.until(40 * ms);
  EXPECT_EQ(rig.scanned(), "");
}

TEST(StPrograms, StandWhereTheirStatementHasItsTime) {
  WatchedRig rig(
      "PROGRAM main\nVAR i : DINT; n : DINT; END_VAR\n"
      "n := 0;\n"             // 3
      "FOR i := 1 TO 2 DO\n"  // 4: the start, the loop, each of its rounds
      "  n := n + i;\n"       // 5
      "END_FOR\n"
      "n := 2 * n;\n"  // 7
      "END_PROGRAM\n",
      ms);
  rig.controller.watch_programs(true);
  std::vector<int> lines;
  for (int i = 0; i < 20; ++i) {
    rig.until(i * ms);
    lines.push_back(rig.task().line);
  }
  // Start, loop, round, body, step, round, body, step.
  const std::vector<int> scan = {3, 4, 4, 4, 5, 4, 4, 5, 4, 7};
  EXPECT_THAT(std::vector<int>(lines.begin(), lines.begin() + 10), testing::ElementsAreArray(scan));
  EXPECT_THAT(std::vector<int>(lines.begin() + 10, lines.end()), testing::ElementsAreArray(scan));
  EXPECT_EQ(rig.task().doing, "runs");
}

TEST(StPrograms, StandAtTheirFault) {
  WatchedRig rig(
      "PROGRAM main\nVAR d : DINT := 1; q : DINT; END_VAR\nd := d - 1;\nq := 8 / d;\nEND_PROGRAM\n");
  rig.until(0);
  EXPECT_EQ(rig.task().line, 4);
  EXPECT_THAT(rig.task().doing, testing::HasSubstr("error: "));
  rig.controller.power(false);
  EXPECT_EQ(rig.task().line, 0);
  EXPECT_EQ(rig.task().doing, "no power");
}

}  // namespace
}  // namespace drycut::devices::plcopen
