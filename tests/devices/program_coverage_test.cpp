// What of programs has run, in each language: counts against a count by hand.
#include "devices/coverage.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "devices/plcopen/st/coverage.hpp"
#include "devices/qmove/tests.hpp"
#include "tests/devices/lx3vp/il_bench.hpp"
#include "tests/devices/qmove/support.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using Ways = Coverage::Ways;

/// Of a program that is scanned so often.
Coverage::File scanned(const std::string& text, int scans) {
  plcopen::st::Bench bench(text);
  bench.runtime->count();
  bench.scan(scans);
  Coverage coverage;
  bench.runtime->add_coverage(coverage, std::vector<std::string>{"test.st"});
  return coverage.files["test.st"];
}

TEST(StCoverage, CountsAreThoseOfACountByHand) {
  const auto file = scanned(
      "FUNCTION Twice : INT\n"          // 1
      "VAR_INPUT x : INT; END_VAR\n"    // 2
      "Twice := 2 * x;\n"               // 3
      "END_FUNCTION\n"                  // 4
      "PROGRAM Main\n"                  // 5
      "VAR n, i, sum : INT; END_VAR\n"  // 6
      "n := n + 1;\n"                   // 7
      "IF n > 7 THEN\n"                 // 8
      "  sum := 0;\n"                   // 9
      "ELSIF n = 3 AND sum > 0 THEN\n"  // 10
      "  sum := Twice(sum);\n"          // 11
      "ELSE\n"                          // 12
      "  sum := sum + 1;\n"             // 13
      "END_IF\n"                        // 14
      "FOR i := 1 TO 3 DO\n"            // 15
      "  sum := sum + i;\n"             // 16
      "END_FOR\n"                       // 17
      "CASE n OF\n"                     // 18
      "  1, 2: sum := sum + 1;\n"       // 19
      "  3: sum := sum + 2;\n"          // 20
      "  9: sum := sum + 3;\n"          // 21
      "END_CASE\n"                      // 22
      "END_PROGRAM\n",
      5);
  // Five scans, n = 1 to 5: the loop's head is looked at four times in each.
  EXPECT_THAT(file.lines, ElementsAre(Pair(3, 1), Pair(7, 5), Pair(8, 5), Pair(9, 0), Pair(10, 5),
                                      Pair(11, 1), Pair(13, 4), Pair(15, 20), Pair(16, 15), Pair(18, 5),
                                      Pair(19, 2), Pair(20, 1), Pair(21, 0)));
  EXPECT_THAT(file.decisions,
              ElementsAre(Pair(8, ElementsAre(Ways{0, 5})), Pair(10, ElementsAre(Ways{1, 4})),
                          Pair(15, ElementsAre(Ways{15, 5})), Pair(18, ElementsAre(Ways{2, 1, 0, 2}))));
  EXPECT_THAT(file.functions, ElementsAre(Pair(Pair(1, "Twice"), 1), Pair(Pair(5, "Main"), 5)));
  const auto figures = figures_of(file);
  EXPECT_EQ(figures.lines, 13U);
  EXPECT_EQ(figures.lines_run, 11U);
  EXPECT_EQ(figures.ways, 10U);
  EXPECT_EQ(figures.ways_taken, 8U);
  EXPECT_EQ(figures.never, "9, 21");
}

TEST(StCoverage, LoopsMethodsAndWhatNothingCalls) {
  const auto file = scanned(
      "FUNCTION_BLOCK Ramp\n"                      // 1
      "VAR_OUTPUT q : INT; END_VAR\n"              // 2
      "METHOD Up\n"                                // 3
      "  q := q + 1;\n"                            // 4
      "END_METHOD\n"                               // 5
      "METHOD Down\n"                              // 6
      "  q := q - 1;\n"                            // 7
      "END_METHOD\n"                               // 8
      "END_FUNCTION_BLOCK\n"                       // 9
      "FUNCTION_BLOCK TEST_Ramp\n"                 // 10
      "VAR r : Ramp; END_VAR\n"                    // 11
      "r.Down();\n"                                // 12
      "END_FUNCTION_BLOCK\n"                       // 13
      "PROGRAM Main\n"                             // 14
      "VAR r : Ramp; t : TON; i : INT; END_VAR\n"  // 15
      "i := 0;\n"                                  // 16
      "WHILE i < 2 DO i := i + 1; END_WHILE\n"     // 17
      "REPEAT\n"                                   // 18
      "  i := i - 1;\n"                            // 19
      "  IF i = 0 THEN EXIT; END_IF\n"             // 20
      "UNTIL i < -5 END_REPEAT\n"                  // 21
      "t(IN := TRUE, PT := T#4ms);\n"              // 22
      "IF t.Q THEN r.Up(); END_IF\n"               // 23
      "END_PROGRAM\n",
      4);  // at 0, 2, 4 and 6 ms
  EXPECT_THAT(file.lines, ElementsAre(Pair(4, 2), Pair(7, 0), Pair(16, 4), Pair(17, 12), Pair(18, 8),
                                      Pair(19, 8), Pair(20, 8), Pair(21, 4), Pair(22, 4), Pair(23, 4)));
  EXPECT_THAT(file.decisions,
              ElementsAre(Pair(17, ElementsAre(Ways{8, 4})), Pair(20, ElementsAre(Ways{4, 4})),
                          Pair(21, ElementsAre(Ways{0, 4})), Pair(23, ElementsAre(Ways{2, 2}))));
  // Ramp has no body of its own.
  EXPECT_THAT(file.functions, ElementsAre(Pair(Pair(3, "Ramp.Up"), 2), Pair(Pair(6, "Ramp.Down"), 0),
                                          Pair(Pair(14, "Main"), 4)));
}

TEST(StCoverage, AConstantDecidesNothing) {
  const auto file = scanned(
      "PROGRAM Main\n"                                 // 1
      "VAR i : INT; END_VAR\n"                         // 2
      "VAR CONSTANT debug : BOOL := FALSE; END_VAR\n"  // 3
      "IF debug THEN i := 7; END_IF\n"                 // 4
      "WHILE TRUE DO\n"                                // 5
      "  IF i > 2 THEN EXIT; END_IF\n"                 // 6
      "  i := i + 1;\n"                                // 7
      "END_WHILE\n"                                    // 8
      "REPEAT i := 2; UNTIL TRUE END_REPEAT\n"         // 9
      "END_PROGRAM\n",
      1);
  EXPECT_THAT(file.decisions, ElementsAre(Pair(6, ElementsAre(Ways{1, 3}))));
  EXPECT_THAT(file.lines, ElementsAre(Pair(4, 1), Pair(5, 4), Pair(6, 4), Pair(7, 3), Pair(9, 1)));
}

TEST(StCoverage, WatchingAndCountingDoNotDisturbEachOther) {
  const std::string text =
      "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nIF n > 2 THEN\nn := 0;\nEND_IF\nEND_PROGRAM\n";
  plcopen::st::Bench bench(text);
  bench.scan(2);
  bench.runtime->count();
  bench.scan();
  bench.runtime->watch(true);
  bench.scan();
  EXPECT_EQ(bench.runtime->scanned(), "  +-    ");
  bench.runtime->watch(false);
  bench.runtime->cold_start();
  bench.scan();
  EXPECT_EQ(bench.runtime->scanned(), "");
  Coverage coverage;
  bench.runtime->add_coverage(coverage, std::vector<std::string>{"f"});
  EXPECT_THAT(coverage.files["f"].lines, ElementsAre(Pair(3, 3), Pair(4, 3), Pair(5, 1)));
}

TEST(StCoverage, WhatIsNotCountedIsNotThere) {
  plcopen::st::Bench bench("PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n");
  bench.scan();
  Coverage coverage;
  bench.runtime->add_coverage(coverage, std::vector<std::string>{"f"});
  EXPECT_THAT(coverage.files, IsEmpty());
}

TEST(IlCoverage, ContactsAreDecisionsAndWhatNeedsPowerRunsWithIt) {
  using namespace lx3vp;
  Problems problems;
  const auto program = il::compile(
      "LD M8000\n"   // 1: always on, no decision
      "INC D0\n"     // 2
      "LD X0\n"      // 3
      "OR M1\n"      // 4
      "ANI X1\n"     // 5
      "OUT Y0\n"     // 6
      "LD= D0 K3\n"  // 7
      "CALL P1\n"    // 8
      "LD X7\n"      // 9
      "MOV K5 D1\n"  // 10
      "FEND\n"       // 11
      "P1\n"         // 12
      "LD M8000\n"   // 13
      "INC D2\n"     // 14
      "SRET\n"       // 15
      "END\n",       // 16
      "p.il", problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  il::ProgramScan scan(program);
  Registers registers;
  il::Notes notes;
  scan.count();
  for (int i = 0; i < 4; ++i) {
    registers.m[8000] = true;
    registers.x[0] = i % 2 == 0;
    registers.time_ns += 10'000'000;
    scan.scan(registers, notes);
  }
  Coverage coverage;
  scan.add_coverage(coverage);
  const auto& file = coverage.files["p.il"];
  EXPECT_THAT(file.lines, ElementsAre(Pair(1, 4), Pair(2, 4), Pair(3, 4), Pair(4, 4), Pair(5, 4), Pair(6, 2),
                                      Pair(7, 4), Pair(8, 1), Pair(9, 4), Pair(10, 0), Pair(11, 4),
                                      Pair(13, 1), Pair(14, 1), Pair(15, 1)))
      << "nothing leads to the END";
  EXPECT_THAT(file.decisions, ElementsAre(Pair(3, ElementsAre(Ways{2, 2})), Pair(4, ElementsAre(Ways{0, 4})),
                                          Pair(5, ElementsAre(Ways{4, 0})), Pair(7, ElementsAre(Ways{1, 3})),
                                          Pair(9, ElementsAre(Ways{0, 4}))));
  EXPECT_THAT(file.functions, ElementsAre(Pair(Pair(12, "P1"), 1)));
}

TEST(IlCoverage, AnEndThatAScanComesToIsALine) {
  using namespace lx3vp;
  for (const auto& [text, end] : {std::pair<std::string, int>{"LD X0\nOUT Y0\nEND\n", 3},
                                  {"LD X0\nCJ P63\nLD X1\nOUT Y1\nFEND\nEND\n", 6}}) {
    Problems problems;
    const auto program = il::compile(text, "p.il", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    il::ProgramScan scan(program);
    Registers registers;
    registers.x[0] = true;
    il::Notes notes;
    scan.count();
    scan.scan(registers, notes);
    Coverage coverage;
    scan.add_coverage(coverage);
    const auto& lines = coverage.files["p.il"].lines;
    ASSERT_TRUE(lines.contains(end)) << text;
    EXPECT_EQ(lines.at(end), 1U) << text;
  }
}

TEST(QclCoverage, CountsAreThoseOfACountByHand) {
  using namespace qmove;
  Problems problems;
  const auto configuration =
      parse_configuration(qmove::testing::usual_cnf, "test.cnf", qmove::testing::puppets(), problems);
  const auto program = compile_module(
      "MAIN:\n"                       // 1
      "glI = glI + 1\n"               // 2
      "IF glI EQ 2\n"                 // 3
      "  CALL Twice\n"                // 4
      "ELSE\n"                        // 5
      "  glJ = glJ + 1\n"             // 6
      "ENDIF\n"                       // 7
      "FOR (glJ = 1, glJ LE 3, 1)\n"  // 8
      "  Axis:gain = glJ\n"           // 9
      "NEXT\n"                        // 10
      "WAIT Axis:gain EQ 3\n"         // 11
      "WAIT 1\n"                      // 12
      "IF glI LT 3\n"                 // 13
      "  JUMP MAIN\n"                 // 14
      "ENDIF\n"                       // 15
      "END\n"                         // 16
      "SUB Twice\n"                   // 17
      "  glJ = 2 * glJ\n"             // 18
      "ENDSUB\n"                      // 19
      "SUB TEST_Twice\n"              // 20
      "  CALL Twice\n"                // 21
      "ENDSUB\n",
      "t.mod", configuration, qmove::testing::puppets(), problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  QmoveController controller(configuration, {program}, qmove::testing::puppets(), 2'000'000);
  controller.count_programs();
  for (std::int64_t time = 0; time < 100'000'000; time += 1'000'000) {
    controller.run_devices(time);
    controller.run_tasks(time);
  }
  Coverage coverage;
  controller.add_coverage(coverage);
  const auto& file = coverage.files["t.mod"];
  EXPECT_EQ(file.lines.at(2), 3U);
  EXPECT_EQ(file.lines.at(3), 3U);
  EXPECT_EQ(file.lines.at(4), 1U);
  EXPECT_EQ(file.lines.at(6), 2U);
  EXPECT_EQ(file.lines.at(8), 12U);
  EXPECT_EQ(file.lines.at(9), 9U);
  EXPECT_EQ(file.lines.at(13), 3U);
  EXPECT_EQ(file.lines.at(14), 2U);
  EXPECT_EQ(file.lines.at(16), 1U);
  EXPECT_EQ(file.lines.at(18), 1U);
  for (const int none : {1, 5, 7, 10, 15, 17, 19, 20, 21, 22})
    EXPECT_FALSE(file.lines.contains(none)) << none;
  EXPECT_THAT(file.decisions.at(3), ElementsAre(Ways{1, 2}));
  EXPECT_THAT(file.decisions.at(8), ElementsAre(Ways{9, 3}));
  EXPECT_EQ(file.decisions.at(11)[0][0], 3U);
  EXPECT_FALSE(file.decisions.contains(12)) << "a constant decides nothing";
  EXPECT_THAT(file.decisions.at(13), ElementsAre(Ways{2, 1}));
  EXPECT_THAT(file.functions, ElementsAre(Pair(Pair(17, "Twice"), 1)));
}

TEST(QclCoverage, WhatDecidesNothingIsNoBranchAndAnEndWithoutAWayToItNoLine) {
  using namespace qmove;
  Problems problems;
  const auto configuration =
      parse_configuration(qmove::testing::usual_cnf, "test.cnf", qmove::testing::puppets(), problems);
  const auto program = compile_module(
      "MAIN:\n"                   // 1
      "IF cTen GT 2 AND NOT 0\n"  // 2
      "  glI = glI + 1\n"         // 3
      "ENDIF\n"                   // 4
      "WHILE 1.5 - 2\n"           // 5
      "  IF glI GT cTen - 8\n"    // 6
      "    END\n"                 // 7
      "  ENDIF\n"                 // 8
      "  glI = glI + 1\n"         // 9
      "  WAIT cTen\n"             // 10
      "ENDWHILE\n"                // 11
      "JUMP MAIN\n"               // 12
      "SUB Idle\n"                // 13
      "  glJ = 0\n"               // 14
      "ENDSUB\n"                  // 15
      "END\n",                    // 16
      "t.mod", configuration, qmove::testing::puppets(), problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  QmoveController controller(configuration, {program}, qmove::testing::puppets(), 2'000'000);
  controller.count_programs();
  for (std::int64_t time = 0; time < 20'000'000; time += 1'000'000) {
    controller.run_devices(time);
    controller.run_tasks(time);
  }
  Coverage coverage;
  controller.add_coverage(coverage);
  const auto& file = coverage.files["t.mod"];
  EXPECT_THAT(file.decisions, ElementsAre(Pair(6, ElementsAre(Ways{1, 2}))));
  EXPECT_GT(file.lines.at(7), 0U) << "an END that something leads to";
  EXPECT_FALSE(file.lines.contains(16));
  EXPECT_EQ(file.lines.at(14), 0U);
}

TEST(Lcov, ATableOfAllThatItKnows) {
  Coverage coverage;
  auto& file = coverage.files["a.st"];
  file.line(3, 2);
  file.line(3, 5);
  file.line(4, 0);
  file.line(6, 0);
  file.line(8, 1);
  file.decisions[3] = {{5, 0}, {0, 0}};
  file.functions[{1, "Ramp.Up"}] = 0;
  const auto once = lcov_text(coverage);
  EXPECT_EQ(once,
            "TN:drycut\nSF:a.st\nFN:1,Ramp.Up\nFNDA:0,Ramp.Up\nFNF:1\nFNH:0\n"
            "BRDA:3,0,0,5\nBRDA:3,0,1,0\nBRDA:3,1,0,-\nBRDA:3,1,1,-\nBRF:4\nBRH:1\n"
            "DA:3,5\nDA:4,0\nDA:6,0\nDA:8,1\nLF:4\nLH:2\nend_of_record\n");
  EXPECT_EQ(figures_of(file).never, "4-6");
  Coverage all;
  EXPECT_EQ(lcov_text(all), "");
  all.add(coverage);
  EXPECT_EQ(lcov_text(all), once);
  auto& other = coverage.files["b.st"];
  other.line(1, 7);
  file.decisions[3][1] = {0, 4};
  all.add(coverage);
  EXPECT_THAT(all.files["a.st"].lines, ElementsAre(Pair(3, 10), Pair(4, 0), Pair(6, 0), Pair(8, 2)));
  EXPECT_THAT(all.files["a.st"].decisions[3], ElementsAre(Ways{10, 0}, Ways{0, 4}));
  EXPECT_THAT(all.files["b.st"].lines, ElementsAre(Pair(1, 7)));
}

}  // namespace
}  // namespace drycut::devices
