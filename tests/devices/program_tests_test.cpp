// Unit tests that programs have in their own language.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "devices/plcopen/st/tests.hpp"
#include "devices/qmove/tests.hpp"
#include "tests/devices/qmove/support.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

/// Results as lines: "TEST_Ramp 2 ms: f.st:3: expected 1, was 2: too slow".
std::vector<std::string> told(const std::vector<TestResult>& results) {
  std::vector<std::string> lines;
  for (const auto& result : results) {
    auto line = result.name + " " + std::to_string(result.took_ns / 1'000'000) + " ms";
    for (const auto& failure : result.log.failures)
      line += "; " + failure.file + ":" + std::to_string(failure.line) + ": " + to_string(failure);
    lines.push_back(line);
  }
  return lines;
}

plcopen::st::Program compiled(const std::vector<SourceFile>& files) {
  Problems problems;
  constexpr plcopen::st::CompileOptions tests{.tests = true};
  auto program = plcopen::st::compile(files, tests, problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  return program;
}

std::vector<TestResult> st_results(const std::string& text, const TestTimes& times = {}) {
  return plcopen::st::run_tests(compiled({{"t.st", text}}), times, nullptr);
}

std::vector<std::string> st_problems(const std::string& text, bool tests = true) {
  Problems problems;
  const plcopen::st::CompileOptions options{.library = !tests, .tests = tests};
  plcopen::st::compile(text, "f", problems, options);
  std::vector<std::string> lines;
  for (const auto& problem : problems) lines.push_back(to_string(problem).substr(2));
  return lines;
}

TEST(StTests, BlocksProgramsAndMethodsAreTests) {
  EXPECT_THAT(
      told(st_results("FUNCTION Twice : INT VAR_INPUT x : INT; END_VAR Twice := 2 * x; END_FUNCTION\n"
                      "FUNCTION_BLOCK TEST_Twice\n"
                      "AssertEquals(4, Twice(2), 'two');\n"
                      "AssertEquals(Expected := 5, Actual := Twice(2), Message := 'wrong');\n"
                      "AssertTrue(Twice(0) = 1);\n"
                      "END_FUNCTION_BLOCK\n"
                      "PROGRAM Test_other\n"
                      "AssertFalse(FALSE, 'holds');\n"
                      "END_PROGRAM\n"
                      "FUNCTION_BLOCK Suite\n"
                      "VAR n : INT; END_VAR\n"
                      "METHOD TEST_one n := n + 1; AssertEquals(1, n, 'own values'); END_METHOD\n"
                      "METHOD TEST_two n := n + 1; AssertEquals(1, n, 'own values'); END_METHOD\n"
                      "METHOD helper n := 7; END_METHOD\n"
                      "END_FUNCTION_BLOCK\n"
                      "PROGRAM Main VAR i : INT; END_VAR i := 1 / i; END_PROGRAM\n")),
      ElementsAre("TEST_Twice 0 ms; t.st:4: expected 5, was 4: wrong; t.st:5: expected TRUE, was FALSE",
                  "Test_other 0 ms", "Suite.TEST_one 0 ms", "Suite.TEST_two 0 ms"));
}

TEST(StTests, OneThatSaysWhenItIsOverRunsUntilThen) {
  const std::string text =
      "FUNCTION_BLOCK TEST_Time\n"
      "VAR t : TON; scans : INT; END_VAR\n"
      "TEST('the timer');\n"
      "scans := scans + 1;\n"
      "t(IN := TRUE, PT := T#50ms);\n"
      "AssertEquals(t.Q, t.ET >= T#50ms, 'as long as it takes');\n"
      "IF t.Q THEN\n"
      "  AssertEquals(11, scans, 'scans');\n"
      "  TEST_FINISHED();\n"
      "END_IF\n"
      "END_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK TEST_Never\n"
      "IF FALSE THEN TEST_FINISHED(); END_IF\n"
      "END_FUNCTION_BLOCK\n";
  const auto results = st_results(text, {5'000'000, 200'000'000});
  EXPECT_THAT(told(results),
              ElementsAre("TEST_Time 50 ms", HasSubstr("t.st:12: it has not come to its end within 0.2 s")));
  EXPECT_EQ(results[0].log.title, "the timer");
  EXPECT_EQ(results[0].log.assertions, 12);
  EXPECT_EQ(results[0].line, 1);
}

TEST(StTests, TheFirstFailuresAreTold) {
  const auto results = st_results(
      "FUNCTION_BLOCK TEST_Often VAR i : INT; END_VAR\n"
      "FOR i := 1 TO 50 DO AssertEquals(0, i); END_FOR\n"
      "END_FUNCTION_BLOCK\n");
  EXPECT_THAT(results[0].log.failures, SizeIs(20));
  EXPECT_EQ(results[0].log.failed, 50U);
  EXPECT_EQ(results[0].log.failures[19].actual, "20");
}

TEST(StTests, WhatIsComparedHasAType) {
  EXPECT_THAT(told(st_results(
                  "TYPE Mode : (idle, runs); END_TYPE\n"
                  "FUNCTION_BLOCK TEST_All\n"
                  "VAR r : REAL := 0.1; l : LREAL := 0.1; t : TIME := T#1s; s : STRING := 'ab'; m : Mode; "
                  "w : WORD := 16#FF; u : ULINT := 18446744073709551615; d : DATE := D#2024-02-29; "
                  "n : DINT := -5; END_VAR\n"
                  "AssertEquals(0.1, r);\n"
                  "AssertEquals(0.2, r, 0.05, 'far');\n"
                  "AssertEquals_LREAL(Expected := 0.2, Actual := l, Delta := 0.11);\n"
                  "AssertEquals(T#2s, t);\n"
                  "AssertEquals('ac', s, CONCAT('text ', s));\n"
                  "AssertEquals(Mode#runs, m);\n"
                  "AssertEquals(WORD#16#FE, w);\n"
                  "AssertEquals(u - 1, u);\n"
                  "AssertEquals(D#2024-03-01, d);\n"
                  "AssertEquals_INT(-5, 5);\n"
                  "AssertEquals(-5, n);\n"
                  "AssertEquals(1, 2, 'literals');\n"
                  "END_FUNCTION_BLOCK\n"))[0],
              AllOf(HasSubstr("ms; t.st:5: expected 0.2, was 0.1: far; "),
                    HasSubstr("t.st:7: expected T#2s, was T#1s; "),
                    HasSubstr("t.st:8: expected 'ac', was 'ab': text ab; "),
                    HasSubstr("t.st:9: expected 1, was 0; "), HasSubstr("t.st:10: expected 254, was 255; "),
                    HasSubstr("t.st:11: expected 18446744073709551614, was 18446744073709551615; "),
                    HasSubstr("t.st:12: expected D#2024-03-01, was D#2024-02-29; "),
                    HasSubstr("t.st:13: expected -5, was 5; t.st:15: expected 1, was 2: literals")));
}

TEST(StTests, NoNumberEqualsNothingAndEachIsComputedOnce) {
  EXPECT_THAT(told(st_results("FUNCTION_BLOCK Counter\n"
                              "VAR n : INT; END_VAR\n"
                              "METHOD Next : INT n := n + 1; Next := n; END_METHOD\n"
                              "END_FUNCTION_BLOCK\n"
                              "FUNCTION_BLOCK TEST_Once\n"
                              "VAR c : Counter; big : LREAL := 1e308; nan : LREAL; END_VAR\n"
                              "AssertEquals(1, c.Next(), 'once');\n"
                              "AssertEquals(c.Next(), c.Next(), 'in order');\n"
                              "big := big * 10.0;\n"
                              "nan := big - big;\n"
                              "AssertEquals(nan, nan, 1.0, 'no number');\n"
                              "AssertEquals(big, big, 'infinite');\n"
                              "END_FUNCTION_BLOCK\n"))[0],
              AllOf(HasSubstr("TEST_Once 0 ms; t.st:8: expected 2, was 3: in order; t.st:11: expected "),
                    HasSubstr("nan: no number"), testing::Not(HasSubstr("infinite"))));
}

TEST(StTests, ARunTimeErrorEndsItsTestOnly) {
  EXPECT_THAT(told(st_results("VAR_GLOBAL g : INT; END_VAR\n"
                              "FUNCTION_BLOCK TEST_a\n"
                              "VAR i : INT; END_VAR\n"
                              "AssertTrue(FALSE, 'before');\n"
                              "g := 1 / i;\n"
                              "AssertTrue(FALSE, 'behind');\n"
                              "END_FUNCTION_BLOCK\n"
                              "FUNCTION_BLOCK TEST_b\n"
                              "g := g + 1;\n"
                              "AssertEquals(1, g, 'anew');\n"
                              "END_FUNCTION_BLOCK\n")),
              ElementsAre(AllOf(HasSubstr("t.st:4: expected TRUE, was FALSE: before; t.st:5: "),
                                testing::Not(HasSubstr("behind"))),
                          "TEST_b 0 ms"));
}

TEST(StTests, WhatDoesNotFitIsToldWhereItStands) {
  EXPECT_THAT(
      st_problems("FUNCTION_BLOCK TEST_a\n"
                  "VAR s : STRING; n : INT; END_VAR\n"
                  "AssertEquals(1, s, 'x');\n"
                  "AssertEquals(1);\n"
                  "AssertTrue(n, 'x');\n"
                  "AssertTrue(TRUE, 'x', 1);\n"
                  "AssertEquals(1, n, 1, 'x');\n"
                  "AssertTrue(TRUE, n);\n"
                  "AssertEquals(Expcted := 1, Actual := n);\n"
                  "END_FUNCTION_BLOCK\n"
                  "FUNCTION_BLOCK TEST_b VAR_IN_OUT io : INT; END_VAR io := 1; END_FUNCTION_BLOCK\n"),
      ElementsAre(HasSubstr("3:1: AssertEquals does not compare"),
                  HasSubstr("4:1: AssertEquals lacks its Actual"), testing::StartsWith("5:"),
                  testing::StartsWith("6:"), HasSubstr("a Delta of INT; only real numbers"),
                  HasSubstr("takes a text, not INT"), testing::StartsWith("9:"), testing::StartsWith("11:")));
}

TEST(StTests, AMisspeltAssertionIsToldWithTheRightOne) {
  EXPECT_THAT(
      st_problems("FUNCTION_BLOCK TEST_a VAR n : INT; END_VAR\n"
                  "ASSERT_EQUALS_INT(1, n);\n"
                  "AssertEqualINT(1, n);\n"
                  "AssertTru(TRUE);\n"
                  "TEST_FINISH();\n"
                  "END_FUNCTION_BLOCK\n"),
      ElementsAre(HasSubstr("2:1: there is no function 'ASSERT_EQUALS_INT'; did you mean "
                            "'AssertEquals_INT'?"),
                  HasSubstr("3:1: there is no function 'AssertEqualINT'; did you mean "
                            "'AssertEquals_INT'?"),
                  HasSubstr("did you mean 'AssertTrue'?"), HasSubstr("did you mean 'TEST_FINISHED'?")));
  // Where there are none its name is known all the same.
  EXPECT_THAT(st_problems("PROGRAM Main AssertTrue(TRUE, 'x'); END_PROGRAM\n", false),
              ElementsAre(HasSubstr("there is no function 'AssertTrue'; tests have it")));
}

TEST(StTests, AFunctionIsNoTest) {
  const auto notes = [](const std::string& text) {
    std::vector<std::string> told;
    for (const auto& note : compiled({{"t.st", text}}).notes()) told.push_back(note.text);
    return told;
  };
  const std::string function =
      "FUNCTION TEST_Twice : BOOL\nAssertTrue(TRUE);\nTEST_Twice := TRUE;\nEND_FUNCTION\n";
  EXPECT_THAT(notes(function),
              ElementsAre(HasSubstr("t.st:1:10: FUNCTION TEST_Twice is no test, and nothing calls it")));
  EXPECT_THAT(notes(function + "FUNCTION_BLOCK TEST_a AssertTrue(TEST_Twice()); END_FUNCTION_BLOCK\n"),
              IsEmpty());
}

TEST(StTests, AMethodOfASuiteThatNothingCallsIsNoTest) {
  const auto notes = compiled({{"t.st",
                                "FUNCTION_BLOCK Suite\n"
                                "METHOD TEST_One\nCheck();\nEND_METHOD\n"
                                "METHOD Check\nAssertTrue(TRUE, '');\nEND_METHOD\n"
                                "METHOD TST_Typo\nAssertTrue(FALSE, '');\nEND_METHOD\n"
                                "END_FUNCTION_BLOCK\n"}})
                         .notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0].text, HasSubstr("t.st:8:8: METHOD TST_Typo asserts, and nothing calls it"));
}

TEST(StTests, AProgramThatIsNoTestHasNoAssertions) {
  const std::string main = "PROGRAM Main AssertTrue(TRUE, 'x'); END_PROGRAM\n";
  Problems problems;
  plcopen::st::compile(main, "f", problems);
  EXPECT_THAT(problems, SizeIs(1));
  // Tests beside it are compiled and do nothing.
  plcopen::st::Bench bench(
      "FUNCTION_BLOCK TEST_a AssertTrue(FALSE, 'x'); END_FUNCTION_BLOCK\n"
      "PROGRAM Main VAR t : TEST_a; n : INT; END_VAR t(); n := n + 1; END_PROGRAM\n");
  bench.scan(2);
  EXPECT_EQ(bench["n"], 2);
  // An own function of that name is that.
  EXPECT_THAT(
      st_problems("FUNCTION AssertTrue : BOOL VAR_INPUT a : INT; END_VAR AssertTrue := a > 0; END_FUNCTION\n"
                  "FUNCTION_BLOCK TEST_a AssertTrue(5); END_FUNCTION_BLOCK\n"),
      IsEmpty());
}

TEST(StTests, CoverageLeavesTheTestsOut) {
  Coverage coverage;
  plcopen::st::run_tests(compiled({{"b_test.st",
                                    "FUNCTION_BLOCK TEST_Sign\n"
                                    "AssertEquals(1, Sign(5));\n"
                                    "END_FUNCTION_BLOCK\n"
                                    "FUNCTION_BLOCK TEST_Zero\n"
                                    "AssertEquals(0, Sign(0));\n"
                                    "END_FUNCTION_BLOCK\n"},
                                   {"a.st",
                                    "FUNCTION Sign : INT\n"
                                    "VAR_INPUT x : INT; END_VAR\n"
                                    "IF x < 0 THEN\n"
                                    "  Sign := -1;\n"
                                    "ELSIF x > 0 THEN\n"
                                    "  Sign := 1;\n"
                                    "END_IF\n"
                                    "END_FUNCTION\n"}}),
                         {}, &coverage);
  ASSERT_THAT(coverage.files, SizeIs(1));
  const auto& file = coverage.files.at("a.st");
  EXPECT_THAT(file.lines, ElementsAre(Pair(3, 2), Pair(4, 0), Pair(5, 2), Pair(6, 1)));
  EXPECT_THAT(file.functions, ElementsAre(Pair(Pair(1, "Sign"), 2)));
}

TEST(StTests, ASuiteOfMethodsIsNoFunctionOfTheProgram) {
  Coverage coverage;
  plcopen::st::run_tests(compiled({{"t.st",
                                    "FUNCTION_BLOCK Suite\n"
                                    "METHOD TEST_one AssertTrue(TRUE); END_METHOD\n"
                                    "METHOD TEST_two AssertTrue(TRUE); END_METHOD\n"
                                    "END_FUNCTION_BLOCK\n"}}),
                         {}, &coverage);
  EXPECT_THAT(coverage.files, IsEmpty());
}

struct Qcl {
  std::vector<std::pair<std::string, std::string>> modules;
  Problems problems = {};
  Coverage coverage = {};

  std::vector<TestResult> results(const TestTimes& times = {}) {
    using namespace qmove;
    const auto configuration =
        parse_configuration(qmove::testing::usual_cnf, "test.cnf", qmove::testing::puppets(), problems);
    std::vector<QclProgram> programs;
    for (const auto& [name, text] : modules)
      programs.push_back(
          compile_module(text, name, configuration, qmove::testing::puppets(), problems, true));
    if (!problems.empty()) return {};
    return run_tests(configuration, programs, qmove::testing::puppets(), times, &coverage);
  }
};

const std::string limit =
    "glI = 77\n"
    "END\n"
    "SUB Limit\n"         // 3
    "  IF glJ GT cTen\n"  // 4
    "    glJ = cTen\n"    // 5
    "  ENDIF\n"           // 6
    "ENDSUB\n";           // 7

TEST(QclTests, AnAssertionIsACommentOfATest) {
  Qcl qcl{{{"t.mod", limit + "SUB TEST_Limit\n"                  // 8
                             "  glJ = 12\n"                      // 9
                             "  CALL Limit\n"                    // 10
                             "  ; ASSERT glJ EQ 10\n"            // 11
                             "  ; ASSERT glI EQ 0\n"             // 12: the task itself does not run
                             "ENDSUB\n"                          // 13
                             "SUB TEST_Wrong\n"                  // 14
                             "  glJ = 3\n"                       // 15
                             "  CALL Limit\n"                    // 16
                             "  ;assert glJ EQ glI + 5 ; why\n"  // 17
                             "  glJ = 0\n"                       // 18
                             "ENDSUB\n"}}};
  const auto results = qcl.results();
  EXPECT_TRUE(qcl.problems.empty()) << qmove::testing::text_of(qcl.problems);
  EXPECT_THAT(told(results),
              ElementsAre("TEST_Limit 0 ms",
                          "TEST_Wrong 0 ms; t.mod:17: expected glJ EQ glI + 5, was glJ = 3, glI = 0"));
  EXPECT_EQ(results[0].log.assertions, 2);
  EXPECT_EQ(results[1].log.assertions, 1);
  const auto& file = qcl.coverage.files.at("t.mod");
  EXPECT_THAT(file.lines, ElementsAre(Pair(1, 0), Pair(2, 0), Pair(4, 2), Pair(5, 1)));
  EXPECT_THAT(file.decisions, ElementsAre(Pair(4, ElementsAre(Coverage::Ways{1, 1}))));
  EXPECT_THAT(file.functions, ElementsAre(Pair(Pair(3, "Limit"), 2)));
}

TEST(QclTests, TasksWithoutTestsRunBesideItAndTimeGoesOn) {
  Qcl qcl{{{"task.mod", "MAIN:\nIF gfDone\nofLamp = 1\nENDIF\nWAIT 1\nJUMP MAIN\nEND\n"},
           {"t.mod",
            "END\n"
            "SUB TEST_Lamp\n"
            "  ; ASSERT NOT ofLamp\n"
            "  gfDone = 1\n"
            "  tmWait = 20\n"
            "  WAIT tmWait\n"
            "  ; ASSERT ofLamp\n"
            "ENDSUB\n"
            "SUB TEST_Hangs\n"
            "  WAIT gfDone\n"
            "ENDSUB\n"
            "SUB TEST_Error\n"
            "  glI = 5 / glJ\n"
            "ENDSUB\n"}}};
  EXPECT_THAT(told(qcl.results({1'000'000, 100'000'000})),
              ElementsAre("TEST_Lamp 20 ms", HasSubstr("t.mod:10: it has not come to its end within 0.1 s"),
                          "TEST_Error 0 ms; t.mod:13: error 6: division by zero"));
}

TEST(QclTests, AnAssertionThatIsNotReachedAssertsNothing) {
  Qcl qcl{{{"t.mod",
            "END\n"
            "SUB TEST_If\n"
            "  IF glI EQ 1\n"
            "    ; ASSERT glI EQ 7\n"
            "  ENDIF\n"
            "ENDSUB\n"
            "SUB TEST_Jump\n"
            "  JUMP OVER\n"
            "  ; ASSERT 0\n"
            "OVER:\n"
            "ENDSUB\n"}}};
  const auto results = qcl.results();
  EXPECT_THAT(told(results), ElementsAre("TEST_If 0 ms", "TEST_Jump 0 ms"));
  for (const auto& result : results) EXPECT_EQ(result.log.assertions, 0) << result.name;
}

TEST(QclTests, AMisspeltAssertionIsNoted) {
  Problems problems;
  const auto configuration =
      qmove::parse_configuration(qmove::testing::usual_cnf, "test.cnf", qmove::testing::puppets(), problems);
  const std::string text =
      "END\nSUB TEST_a\n  ; ASERT glI\n  ;assertt glI\n  ; insert, asks, ASSERTION\n  ; ASSERT 1\nENDSUB\n"
      "SUB Other\n  ; ASERT glI\nENDSUB\n";
  const auto notes = [&](bool tests) {
    std::vector<std::string> told;
    for (const auto& note :
         qmove::compile_module(text, "t.mod", configuration, qmove::testing::puppets(), problems, tests)
             .notes)
      told.push_back(note.text);
    return told;
  };
  EXPECT_THAT(notes(true), ElementsAre(HasSubstr("t.mod:3:5: ASERT is a comment and tests nothing"),
                                       HasSubstr("t.mod:4:4: assertt is a comment and tests nothing")));
  EXPECT_THAT(notes(false), IsEmpty());
  EXPECT_TRUE(problems.empty());
}

TEST(QclTests, ElsewhereItStaysAComment) {
  const std::string text =
      "; ASSERT nonsense here\nEND\nSUB Other\n; ASSERT glI EQ 1\nENDSUB\nSUB TEST_a\n; ASSERT glI\nENDSUB\n";
  EXPECT_EQ(qmove::with_assertions(text),
            "; ASSERT nonsense here\nEND\nSUB Other\n; ASSERT glI EQ 1\nENDSUB\nSUB TEST_a\n  ASSERT "
            "glI\nENDSUB\n");
  Qcl wrong{{{"t.mod", "END\nSUB TEST_a\n  ; ASSERT glI EQ\n  ; ASSERT glQ\nENDSUB\n"}}};
  wrong.results();
  ASSERT_THAT(wrong.problems, SizeIs(2));
  EXPECT_EQ(wrong.problems[0].line, 3);
  EXPECT_EQ(wrong.problems[1].line, 4);
  EXPECT_EQ(wrong.problems[1].column, 12);
}

}  // namespace
}  // namespace drycut::devices
