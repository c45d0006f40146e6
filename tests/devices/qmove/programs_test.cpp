// What one sees of QCL programs: the values of each line, where the tasks stand and why.
#include <gmock/gmock.h>

#include "tests/devices/qmove/support.hpp"

namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

const std::string watched_module =
    "; waits for the button, then twice\n"      // 1
    "gli = Axis:delta + axis:quota\n"           // 2
    "WAIT ifStart\n"                            // 3
    "CALL Rest\n"                               // 4
    "CALL Rest\n"                               // 5
    "agTemp[glI] = agTemp[2] + asKept[cTwo]\n"  // 6
    "ddbCode[1, cTwo] = 1 + cTwo\n"             // 7
    "END\n"                                     // 8
    "SUB Rest\n"                                // 9
    "    tmWait = 20\n"                         // 10
    "    WAIT tmWait\n"                         // 11
    "ENDSUB\n";                                 // 12

std::string with_two(std::string cnf) { return cnf.insert(cnf.find("cTen"), "cTwo 2\n"); }

struct QclTask {
  int line;
  std::string doing;
  std::vector<int> calls;
  bool operator==(const QclTask&) const = default;
};
std::vector<QclTask> tasks_of(const Bench& bench) {
  std::vector<QclTask> tasks;
  for (const auto& task : bench.controller->positions(bench.now).tasks)
    tasks.push_back({task.line, task.doing, task.calls});
  return tasks;
}

TEST(QmovePrograms, TellTheirTextsAndTheValuesOfEachLine) {
  const std::string cnf = with_two(std::string(testing::usual_cnf));
  const Bench bench({watched_module, "END\n"}, 1, cnf);
  ASSERT_EQ(testing::text_of(bench.problems), "");
  const auto texts = bench.controller->programs();
  ASSERT_EQ(texts.size(), 3U);
  EXPECT_EQ(texts[0].name, "task0.mod");
  EXPECT_EQ(texts[0].file, "task0.mod");
  EXPECT_EQ(texts[0].language, "qcl");
  EXPECT_EQ(texts[0].text, watched_module);
  // As they are declared; elements only where the index is fixed.
  EXPECT_THAT(
      texts[0].values,
      ElementsAre(Pair(2, ElementsAre("glI", "Axis.delta", "Axis.posit")), Pair(3, ElementsAre("ifStart")),
                  Pair(6, ElementsAre("glI", "agTemp[2]", "asKept[2]")), Pair(7, ElementsAre("ddbCode[1,2]")),
                  Pair(10, ElementsAre("tmWait")), Pair(11, ElementsAre("tmWait"))));
  for (const auto& [line, names] : texts[0].values)
    for (const auto& name : names) EXPECT_TRUE(bench.controller->find(name).has_value()) << line << name;
  EXPECT_EQ(texts[1].text, "END\n");
  EXPECT_EQ(texts[2].language, "cnf");
  EXPECT_EQ(texts[2].text, cnf);
  EXPECT_THAT(texts[2].values.at(7), ElementsAre("slR"));
}

TEST(QmovePrograms, StandWhereTheyWait) {
  Bench bench({watched_module, "END\n"}, 1, with_two(std::string(testing::usual_cnf)));
  EXPECT_EQ(tasks_of(bench), (std::vector<QclTask>{{2, "begins", {}}, {1, "begins", {}}}));
  bench.run(5);
  EXPECT_EQ(tasks_of(bench), (std::vector<QclTask>{{3, "waits", {}}, {1, "ended", {}}}));
  bench.controller->cards().inputs.at({Kind::input, 2, 1}).level = true;
  bench.run(10);
  EXPECT_EQ(tasks_of(bench)[0], (QclTask{11, "waits", {4}}));
  bench.run(20);
  EXPECT_EQ(tasks_of(bench)[0], (QclTask{11, "waits", {5}}));
  bench.controller->power(false);
  EXPECT_EQ(tasks_of(bench)[0], (QclTask{0, "no power", {}}));
}

TEST(QmovePrograms, StandAtTheirErrorAndWhereOthersAreStopped) {
  Bench bench({"WAIT ifStart\nEND\n", "glI = 0\nWAIT 1\nglJ = 5 / glI\nEND\n"});
  bench.run(3);
  EXPECT_EQ(tasks_of(bench),
            (std::vector<QclTask>{{1, "stopped", {}}, {3, "error 6: division by zero", {}}}));
  EXPECT_THAT(testing::events(bench), ElementsAre(::testing::HasSubstr("task1.mod:3: error 6")));
}

TEST(QmovePrograms, StandAtAReadThatWaitsForADevice) {
  // The device samples every 4 ms: initialised at 4 ms, what is written then is read after 8 ms.
  Bench bench({"INIT Axis\nWAIT Axis:st_init\nAxis:delta = 3\nglI = Axis:delta\nEND\n"});
  bench.run(2);
  EXPECT_EQ(tasks_of(bench)[0], (QclTask{2, "waits", {}}));
  bench.run(4);
  EXPECT_EQ(tasks_of(bench)[0], (QclTask{4, "waits for Axis", {}}));
  bench.run(4);
  EXPECT_EQ(tasks_of(bench)[0], (QclTask{5, "ended", {}}));
}

TEST(QmovePrograms, StandInTheirTurnWhereStatementsTakeTime) {
  Problems problems;
  const auto configuration = parse_configuration(testing::usual_cnf, "t.cnf", testing::puppets(), problems);
  auto program = compile_module("glI = 1\nglI = 2\nglI = 3\nEND\n", "t.mod", configuration,
                                testing::puppets(), problems);
  ASSERT_TRUE(problems.empty());
  QmoveController controller(configuration, {program}, testing::puppets(), 1'000'000, 1'000'000);
  // A statement a millisecond, each at its end.
  for (int ms = 0; ms < 3; ++ms) {
    controller.run_tasks(ms * 1'000'000);
    const auto task = controller.positions(ms * 1'000'000).tasks.at(0);
    EXPECT_EQ(task.line, ms + 1);
    EXPECT_EQ(task.doing, "runs");
  }
}

}  // namespace
}  // namespace drycut::devices::qmove
