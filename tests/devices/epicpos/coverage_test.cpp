#include <gmock/gmock.h>

#include "tests/devices/epicpos/covers.hpp"

namespace drycut::devices::epicpos {
namespace {

TEST(EpicposCoverage, EveryNameOfBothDevicesHasATestThatShowsIt) {
  EXPECT_THAT(coverage::missing(all_marks(), "Epicpos*:Eanpos*:*/Positioner*/E*:-EpicposCoverage*"),
              testing::IsEmpty());
}

TEST(EpicposCoverage, KnowsWhatThereIs) {
  const coverage::Marks marks = all_marks();
  for (const char* name : {"cntratio", "rtype", "ramptype", "st_toll", "PRESET refused", "DELCNT accepted"})
    EXPECT_TRUE(marks.contains(name)) << name;
  // 36 shared variables, 2 of EPICPOS, 1 of EANPOS, 13 states, 19 commands.
  EXPECT_EQ(marks.size(), 36u + 2 + 1 + 13 + 2 * 19);
}

}  // namespace
}  // namespace drycut::devices::epicpos
