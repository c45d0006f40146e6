// What tasks ask that no task gives.
#include <gmock/gmock.h>

#include "tests/devices/qmove/support.hpp"

namespace drycut::devices::qmove::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> told(const std::vector<std::string>& modules) {
  const Bench bench(modules);
  EXPECT_TRUE(bench.problems.empty()) << text_of(bench.problems);
  std::vector<std::string> texts;
  for (const auto& doubt : bench.controller->doubts()) texts.push_back(doubt.value + " " + doubt.text);
  return texts;
}

TEST(QmoveDoubts, AValueThatNoTaskSets) {
  EXPECT_THAT(told({"glI = glJ\nglI = glI + 1\nEND\n"}),
              ElementsAre("glJ task0.mod:1: glJ is read, and no task sets it: it stays 0"));
  EXPECT_THAT(told({"glI = glJ\nEND\n", "glJ = 2\nEND\n"}), IsEmpty());
}

TEST(QmoveDoubts, OfAnArrayEachElementStandsForItself) {
  EXPECT_THAT(told({"agTemp[1] = 3\nglI = agTemp[1] + agTemp[2]\nEND\n"}),
              ElementsAre("agTemp[2] task0.mod:2: agTemp[2] is read, and no task sets it: it stays 0"));
  // By a variable any of them may be set, or read.
  EXPECT_THAT(told({"glI = 1\nagTemp[glI] = 3\nglI = agTemp[2]\nEND\n"}), IsEmpty());
  EXPECT_THAT(told({"glI = 1\nglI = agTemp[glI]\nEND\n"}), IsEmpty());
}

TEST(QmoveDoubts, ATimerThatNoTaskStarts) {
  EXPECT_THAT(told({"WAIT tmWait\nEND\n"}),
              ElementsAre("tmWait task0.mod:1: the timer tmWait is asked, and no task starts it"));
  EXPECT_THAT(told({"tmWait = 100\nWAIT tmWait\nEND\n"}), IsEmpty());
}

TEST(QmoveDoubts, WhatIsSetTwiceInARow) {
  EXPECT_THAT(told({"agTemp[1] = 3\n\nagTemp[1] = 4 ; the second\nEND\n"}),
              ElementsAre(" task0.mod:3: agTemp[1] was set just before: the first of the two does nothing"));
  EXPECT_THAT(told({"glI = 3\nglI = glI + 1\nglI = 2 * glI\nWAIT 1\nEND\n"}), IsEmpty());
}

TEST(QmoveDoubts, AGapInARetentiveArrayThatIsSetByNumber) {
  const std::string reads = "glI = asKept[glI]\nEND\n";
  const auto doubts = told({"asKept[1] = 3\n" + reads});
  EXPECT_FALSE(doubts.empty());
  EXPECT_EQ(doubts.front(), "asKept[2] task0.mod:2: asKept[2] is never set, other elements of asKept are");
  EXPECT_THAT(told({"asKept[1] = 3\nasKept[glI + 1] = 4\n" + reads}), IsEmpty());
  EXPECT_THAT(told({reads}), IsEmpty());
}

TEST(QmoveDoubts, RetentiveValuesAndRecipesComeFromThePanel) {
  EXPECT_THAT(told({"glI = slR + asKept[2] + ddlHead[1]\nEND\n"}), IsEmpty());
}

}  // namespace
}  // namespace drycut::devices::qmove::testing
