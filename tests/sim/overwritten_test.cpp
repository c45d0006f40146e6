// Values that a scenario sets and its program writes before it reads them: they are set in vain.
#include "sim/loop/overwritten.hpp"

#include <gmock/gmock.h>

#include "sim/loop/simulation.hpp"
#include "tests/findings.hpp"
#include "tests/sim/studies/tune/bench.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::loop {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string with_set(const std::string& values) {
  std::string text = studies::tuning::scenario;
  const std::string set = "{AxisX.pgain: 0, AxisX.feedfw: 900}";
  return text.replace(text.find(set), set.size(), "{" + values + "}");
}

std::vector<std::string> warnings_of(const std::string& set, const std::string& program) {
  TestFolder folder;
  folder.file("axis.cnf", studies::tuning::configuration);
  folder.file("axis.mod", program);
  Problems problems;
  const auto scenario = scenario::read_scenario(folder.file("line.yaml", with_set(set)), {}, problems);
  Simulation simulation(scenario, problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  return problems.empty() ? sentences(simulation.run().warnings()) : std::vector<std::string>();
}

TEST(Overwritten, AValueThatTheProgramWritesFirstIsTold) {
  EXPECT_THAT(warnings_of("AxisX.toll: 50", studies::tuning::program),
              ElementsAre("controller.qmove.set.AxisX.toll = 50 has no effect: the program writes 100 at "
                          "axis.mod:6"));
  EXPECT_THAT(warnings_of("AxisX.toll: 100", studies::tuning::program), IsEmpty()) << "the same";
}

TEST(Overwritten, AValueThatItReadsFirstIsTaken) {
  const auto with = [](const std::string& lines) { return lines + studies::tuning::program; };
  EXPECT_THAT(warnings_of("AxisX.pgain: 7", with("IF AxisX:pgain EQ 0\nAxisX:pgain = 5\nENDIF\n")),
              IsEmpty());
  EXPECT_THAT(warnings_of("gbPhase: 3", with("gbPhase = gbPhase + 1\n")), IsEmpty());
  EXPECT_THAT(
      warnings_of("AxisX.setvel: 7", with("; AxisX:setvel is the operator's\nIF AxisX:setvel\nENDIF\n")),
      IsEmpty());
}

TEST(Overwritten, AStudyOverSuchAValueIsRefused) {
  const auto found = [](const std::string& set) {
    TestFolder folder;
    folder.file("axis.cnf", studies::tuning::configuration);
    folder.file("axis.mod", studies::tuning::program);
    Problems problems;
    const auto scenario = scenario::read_scenario(folder.file("line.yaml", with_set(set)), {}, problems);
    const auto told = overwritten(scenario, "AxisX.toll");
    return told ? told->code : "";
  };
  EXPECT_EQ(found("AxisX.toll: 50"), "controller.value-overwritten");
  EXPECT_EQ(found("AxisX.pgain: 5"), "");
}

}  // namespace
}  // namespace drycut::sim::loop
