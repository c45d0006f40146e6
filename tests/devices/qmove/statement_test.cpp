#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "tests/devices/qmove/support.hpp"
#include "tests/findings.hpp"

// What each statement of QCL does when it runs.
namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using testing::text_of;

Bench started(const std::string& module, int milliseconds = 1) {
  Bench bench({module});
  EXPECT_TRUE(bench.controller) << module << text_of(bench.problems);
  bench.run(milliseconds);
  EXPECT_EQ(bench["QMOS.oserr"], 0) << module;
  return bench;
}

TEST(QmoveStatement, ANumberBeyondTheSizeOfItsVariableWrapsAndIsNoted) {
  const std::string module =
      "gbSmall = 200\ngwMid = -cBig\ngfDone = 2\nagTemp[2] = 70000\nslR = cBig\n"
      "gbSmall = 127\ngwMid = slR\ngbSmall = 200\nEND\n";
  Problems problems;
  const Configuration configuration =
      parse_configuration("CONST\ncBig 40000\n" + std::string(testing::usual_cnf.substr(6)), "test.cnf",
                          testing::puppets(), problems);
  const QclProgram program = compile_module(module, "task.mod", configuration, testing::puppets(), problems);
  EXPECT_EQ(text_of(problems), "");
  EXPECT_THAT(sentences(program.notes),
              ::testing::ElementsAre("task.mod:1:1: gbSmall: 200 does not fit size B, taken as -56",
                                     "task.mod:2:1: gwMid: -40000 does not fit size W, taken as 25536",
                                     "task.mod:3:1: gfDone: 2 does not fit size F, taken as 1",
                                     "task.mod:4:1: agTemp: 70000 does not fit size W, taken as 4464",
                                     "task.mod:8:1: gbSmall: 200 does not fit size B, taken as -56"));
  EXPECT_EQ(started("gbSmall = 200\nEND\n")["gbSmall"], -56);
}

TEST(QmoveStatement, WhatNumbersMakeIsJudgedAsANumberIs) {
  const std::string module =
      "slR = 60000 * cBig\ngwMid = 300 * 200\ngbSmall = (cBig - 39999) * 100 + 50\nslR = -2147483648 / -1\n"
      "slR = slA * 60000 + 2000000000\nslR = 2000000000 + slA + 2000000000\ngwMid = 70000 % 7\n"
      "gwMid = NOTB 40000\nslR = 1\nIF slA GT 60000 * 60000\nENDIF\nEND\n";
  Problems problems;
  const Configuration configuration =
      parse_configuration("CONST\ncBig 40000\n" + std::string(testing::usual_cnf.substr(6)), "test.cnf",
                          testing::puppets(), problems);
  const QclProgram program = compile_module(module, "task.mod", configuration, testing::puppets(), problems);
  EXPECT_EQ(text_of(problems), "");
  EXPECT_THAT(sentences(program.notes),
              ::testing::ElementsAre(
                  "task.mod:1:13: 60000 * 40000 is 2400000000, beyond a long, taken as -1894967296",
                  "task.mod:2:1: gwMid: 60000 does not fit size W, taken as -5536",
                  "task.mod:3:1: gbSmall: 150 does not fit size B, taken as -106",
                  "task.mod:4:19: -2147483648 / -1 is 2147483648, beyond a long, taken as -2147483648",
                  "task.mod:8:1: gwMid: -40001 does not fit size W, taken as 25535",
                  "task.mod:10:17: 60000 * 60000 is 3600000000, beyond a long, taken as -694967296"));
  EXPECT_EQ(started("slR = 60000 * 40000\nEND\n")["slR"], -1894967296) << "as noted";
}

TEST(QmoveStatement, AnUnknownNameIsToldOnceALine) {
  const auto told = [](const std::string& text) { return Bench({text + "END\n"}).problems.size(); };
  EXPECT_EQ(told("glX = glX + GLX * glX\n"), 1U);
  EXPECT_EQ(told("glX = glX + glY\n"), 2U);
  EXPECT_EQ(told("glX = 1\nglX = 2\n"), 2U);
  EXPECT_EQ(told("FOR (glX = 1, glX LT 3, 1)\nNEXT\n"), 1U);
  EXPECT_EQ(told("Axs:gain = Axs:posit\n"), 1U);
}

TEST(QmoveStatement, ADivisionByAConstant0IsRefused) {
  const auto told = [](const std::string& line) { return text_of(Bench({line + "\nEND\n"}).problems); };
  using ::testing::HasSubstr;
  EXPECT_THAT(told("slR = slA / 0"), HasSubstr("1:11: a division by 0; it stops all tasks"));
  EXPECT_THAT(told("slR = 1 % (cTen - 10)"), HasSubstr("1:9: a division by 0"));
  EXPECT_THAT(told("slR = slA / 0.0"), HasSubstr("1:11: a division by 0"));
  for (const char* line : {"slR = slA / 1", "slR = 0 / 5", "slR = slA / (slA - slA)", "slR = slA / 0.5"})
    EXPECT_EQ(told(line), "") << line;
}

TEST(QmoveStatement, WordsOfOtherLanguagesAreToldWithWhatQclHas) {
  const auto told = [](const std::string& line) {
    const Bench bench({line + "\nEND\n"});
    return text_of(bench.problems);
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(told("INC slR"), HasSubstr("1:1: QCL has no INC; write name = name + 1 [qcl.unknown-name]"));
  EXPECT_THAT(told("dec(slR)"), HasSubstr("1:1: QCL has no dec; write name = name - 1"));
  EXPECT_THAT(told("slR = slA MOD 7"), HasSubstr("1:11: QCL has no MOD; write a % b"));
  EXPECT_THAT(told("slR = ABS(slA - 2) + 1"), HasSubstr("1:7: QCL has no ABS; write IF a LT 0"));
  EXPECT_THAT(told("IF slA EQ 1 THEN"), HasSubstr("1:13: QCL has no THEN; an IF ends with its line"));
  EXPECT_THAT(told("GOTO MAIN"), HasSubstr("1:1: QCL has no GOTO; write JUMP label"));
  for (const char* line : {"INC slR", "slR = ABS(slA - 2) + 1", "slR = MAX(slA, 2)", "slR = slA MOD 7"}) {
    const auto text = told(line);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text << ": once";
  }
  // A name that is declared is no such word.
  Problems problems;
  const Configuration configuration = parse_configuration(
      "CONST\nmin 4\n" + std::string(testing::usual_cnf.substr(6)), "test.cnf", testing::puppets(), problems);
  compile_module("slR = min\nEND\n", "task.mod", configuration, testing::puppets(), problems);
  EXPECT_EQ(text_of(problems), "");
}

TEST(QmoveStatement, AFractionThatIsCutOffIsNoted) {
  const std::string module = "slR = 0.03\nslR = cDeep\nslR = 2.0\nslR = 7\nEND\n";
  Problems problems;
  const Configuration configuration =
      parse_configuration("CONST\ncDeep -2.5\n" + std::string(testing::usual_cnf.substr(6)), "test.cnf",
                          testing::puppets(), problems);
  const QclProgram program = compile_module(module, "task.mod", configuration, testing::puppets(), problems);
  EXPECT_EQ(text_of(problems), "");
  EXPECT_THAT(sentences(program.notes),
              ::testing::ElementsAre("task.mod:1:1: slR takes whole numbers: 0.03 is taken as 0",
                                     "task.mod:2:1: slR takes whole numbers: -2.5 is taken as -2"));
}

TEST(QmoveStatement, IfElseNest) {
  const std::string module =
      "IF slA GT 0\n  IF (slA GT 10)\n    slR = 2\n  ELSE\n    slR = 1\n  ENDIF\nELSE\n  slR = "
      "-1\nENDIF\nslB = 1\nEND\n";
  for (const auto& [a, result] : {std::pair{20, 2}, {5, 1}, {0, -1}}) {
    Bench bench({module});
    bench.set("slA", a);
    bench.step();
    EXPECT_EQ(bench["slR"], result) << a;
    EXPECT_EQ(bench["slB"], 1) << a;
  }
}

TEST(QmoveStatement, While) {
  EXPECT_EQ(started("WHILE (glI LT 5)\nslR = slR + glI\nglI = glI + 1\nENDWHILE\nEND\n")["slR"], 10);
  EXPECT_EQ(started("WHILE 0\nslR = 1\nENDWHILE\nEND\n")["slR"], 0);
}

TEST(QmoveStatement, ForWithStepOrAssignment) {
  EXPECT_EQ(started("FOR (glI = 1, glI LE 4, 1)\nslR = slR * 10 + glI\nNEXT\nEND\n")["slR"], 1234);
  EXPECT_EQ(started("FOR (glI = 8, glI GT 0, glI = glI / 2)\nslR = slR * 10 + glI\nNEXT\nEND\n")["slR"],
            8421);
  EXPECT_EQ(started("FOR (glI = 3, glI GE 1, -1)\nslR = slR * 10 + glI\nNEXT\nEND\n")["slR"], 321);
  EXPECT_EQ(started("FOR (gsReal = 0, gsReal LT 1, 0.25)\nslR = slR + 1\nNEXT\nEND\n")["slR"], 4);
  EXPECT_EQ(
      started("FOR (agTemp[2] = 1, agTemp[2] LE 3, agTemp[2] = agTemp[2] + 1)\nslR = slR + 1\nNEXT\nEND\n")
          ["slR"],
      3);
  // The condition is looked at before the first turn, the variable ends beyond the limit.
  const Bench bench = started("FOR (glI = 5, glI LT 5, 1)\nslR = 1\nNEXT\nslB = glI\nEND\n");
  EXPECT_EQ(bench["slR"], 0);
  EXPECT_EQ(bench["slB"], 5);
}

TEST(QmoveStatement, LoopsNest) {
  EXPECT_EQ(started("FOR (glI = 1, glI LE 3, 1)\nglJ = 0\nWHILE glJ LT glI\nglJ = glJ + 1\nIF glJ EQ 2\nslR "
                    "= slR + 100\n"
                    "ENDIF\nslR = slR + 1\nENDWHILE\nNEXT\nEND\n")["slR"],
            206);
}

TEST(QmoveStatement, JumpForwardAndBack) {
  EXPECT_EQ(started("JUMP b\na:\nslR = slR + 10\nJUMP c\nB:\nslR = 1\njump A\nC:\nEND\n")["slR"], 11);
}

TEST(QmoveStatement, LabelsBelongToTheirTask) {
  Bench bench(
      {"MAIN:\nslA = slA + 1\nWAIT 1\nJUMP MAIN\nEND\n", "MAIN:\nslB = slB + 1\nWAIT 1\nJUMP MAIN\nEND\n"});
  ASSERT_TRUE(bench.controller) << text_of(bench.problems);
  bench.run(5);
  EXPECT_EQ(bench["slA"], 5);
  EXPECT_EQ(bench["slB"], 5);
}

TEST(QmoveStatement, SubroutinesAreCalledAndPassedBy) {
  EXPECT_EQ(started("slR = 1\nSUB twice\nslR = slR * 2\nENDSUB\nCALL twice\nCALL TWICE\nCALL last\nEND\n"
                    "SUB last\nslR = slR + 3\nCALL twice\nENDSUB\n")["slR"],
            14);
}

TEST(QmoveStatement, SubroutinesMayWait) {
  Bench bench({"CALL pause\nslR = 2\nEND\nSUB pause\nslR = 1\nWAIT slA\nENDSUB\n"});
  bench.run(3);
  EXPECT_EQ(bench["slR"], 1);
  bench.set("slA", 1);
  bench.run(1);
  EXPECT_EQ(bench["slR"], 2);
}

TEST(QmoveStatement, EndEndsTheTask) {
  EXPECT_EQ(started("slR = 1\nIF 1\nEND\nENDIF\nslR = 2\nEND\n", 3)["slR"], 1);
}

TEST(QmoveStatement, OutputsAreSetResetAndAssigned) {
  Bench bench({"SETOUT ofLamp\nofHorn = 7\nWAIT ifStart\nRESOUT oflamp\nofHorn = 0.0\nEND\n"});
  ASSERT_TRUE(bench.controller) << text_of(bench.problems);
  bench.run(2);
  EXPECT_EQ(bench["2.OUT01"], 1);
  EXPECT_EQ(bench["ofHorn"], 1);
  bench.controller->cards().inputs.at({Kind::input, 2, 1}).level = true;
  bench.run(1);
  EXPECT_EQ(bench["2.OUT01"], 0);
  EXPECT_EQ(bench["ofHorn"], 0);
}

TEST(QmoveStatement, TimersReadOneWhenElapsed) {
  Bench bench({"slA = tmWait\ntmWait = 5\nslB = tmWait\nWAIT tmWait\nslR = 1\nEND\n"});
  bench.run(1);
  EXPECT_EQ(bench["slA"], 1);  // never started
  EXPECT_EQ(bench["slB"], 0);
  bench.run(4);  // rounds at 1, 2, 3, 4 ms
  EXPECT_EQ(bench["slR"], 0);
  EXPECT_EQ(bench["tmWait"], 0);
  bench.run(1);  // the round at 5 ms
  EXPECT_EQ(bench["slR"], 1);
  EXPECT_EQ(bench["tmWait"], 1);
}

TEST(QmoveStatement, TimersTakeNoTimeBelowZero) {
  EXPECT_EQ(started("tmWait = -5\nslR = tmWait\nEND\n")["slR"], 1);
}

TEST(QmoveStatement, DevicesAreAssignedAndCommanded) {
  Bench bench(
      {"Axis:gain = 2.9\nAxis.code2 = 17\naxis:QUOTA = 40\nINIT Axis\nWAIT Axis:st_init\ngo Axis\n"
       "WAIT NOT Axis:st_still\nslR = Axis:gain * 100 + Axis:code2\nEND\n"});
  ASSERT_TRUE(bench.controller) << text_of(bench.problems);
  bench.run(20);
  EXPECT_EQ(bench["slR"], 217);
  EXPECT_EQ(bench["Axis.st_still"], 0);
}

// WAIT NOT a AND b reads (NOT a) AND b.
TEST(QmoveStatement, WaitNotAnd) {
  Bench bench({"WAIT NOT ifStop AND ifStart\nslR = 1\nEND\n"});
  bench.run(3);
  EXPECT_EQ(bench["slR"], 0);
  bench.controller->cards().inputs.at({Kind::input, 2, 1}).level = true;
  bench.run(1);
  EXPECT_EQ(bench["slR"], 1);
}

TEST(QmoveStatement, CommentsAndBlankLinesAreNothing) {
  EXPECT_EQ(
      started(
          "; title\n\n   \t \r\nslR=1;set\n;END\nslA = slR ; again = ( [\nEND ; that's it\n; more\n")["slA"],
      1);
}

TEST(QmoveStatement, MinusMayStandApart) { EXPECT_EQ(started("slR = - 100\nEND\n")["slR"], -100); }

// --- indexes that are plain numbers are judged without a run ---

struct IndexFault {
  std::string statement;
  int column;
  std::string what;
};

TEST(QmoveStatement, PlainIndexesOutOfRangeAreProblems) {
  const std::vector<IndexFault> cases = {
      {"slR = agTemp[0]", 14, "index 0 is outside 1..5 of 'agTemp'"},
      {"agTemp[6] = 1", 8, "index 6 is outside 1..5 of 'agTemp'"},
      {"slR = agTemp[-1]", 14, "index -1 is outside 1..5 of 'agTemp'"},
      {"slR = agTemp[cTen]", 14, "index 10 is outside 1..5 of 'agTemp'"},
      {"slR = ddlHead[3]", 15, "recipe 3 is outside 1..2 of 'ddlHead'"},
      {"ddbCode[3, 1] = 1", 9, "recipe 3 is outside 1..2 of 'ddbCode'"},
      {"slR = ddbCode[1, 4]", 18, "step 4 is outside 1..3 of 'ddbCode'"},
  };
  for (const IndexFault& c : cases) {
    const Bench bench({c.statement + "\nEND\n"});
    ASSERT_EQ(bench.problems.size(), 1U) << c.statement << text_of(bench.problems);
    EXPECT_EQ(bench.problems[0].column, c.column) << c.statement;
    EXPECT_EQ(bench.problems[0].what, c.what) << c.statement;
    EXPECT_NE(bench.problems[0].remedy.find("test.cnf"), std::string::npos) << bench.problems[0].remedy;
  }
  for (const char* good : {"slR = agTemp[1]", "agTemp[5] = 1", "slR = ddbCode[2, 3]", "slR = agTemp[glI]"})
    EXPECT_EQ(text_of(Bench({std::string(good) + "\nEND\n"}).problems), "") << good;
}

}  // namespace
}  // namespace drycut::devices::qmove
