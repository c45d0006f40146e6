#include <gmock/gmock.h>

#include "tests/devices/oopos2/covers.hpp"

namespace drycut::devices::oopos2 {
namespace {

TEST(Oopos2Coverage, EveryNameOfTheDeviceHasATestThatShowsIt) {
  EXPECT_THAT(coverage::missing(all_marks(), "Oopos2*:-Oopos2Coverage*"), testing::IsEmpty());
}

TEST(Oopos2Coverage, KnowsWhatThereIs) {
  const coverage::Marks marks = all_marks();
  for (const char* name : {"iner16", "st_erin", "MANSFW refused", "bklashmode 4", "prsdir 3", "OutFre"})
    EXPECT_TRUE(marks.contains(name)) << name;
  // 51 variables, 15 states, 15 commands, 5 + 3 + 3 + 2 + 2 + 3 + 4 + 2 modes, 6 outputs.
  EXPECT_EQ(marks.size(), 51u + 15 + 2 * 15 + 24 + 6);
}

}  // namespace
}  // namespace drycut::devices::oopos2
