#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"

namespace drycut::devices::camming4 {
namespace {

TEST(Camming4Coverage, EveryNameOfTheDeviceHasATestThatShowsIt) {
  EXPECT_THAT(
      coverage::missing(all_marks(), "Cam*:*/Cam*:*/Positioner*/CAMMING4:-Camming4Coverage*:*LongRun*"),
      testing::IsEmpty());
}

TEST(Camming4Coverage, KnowsWhatThereIs) {
  const coverage::Marks marks = all_marks();
  for (const char* name : {"codeQsa", "st_sync", "STOPCAM refused", "sector 254", "error 51", "warning 12",
                           "normal input 12", "interrupt input 0", "output 9"})
    EXPECT_TRUE(marks.contains(name)) << name;
  // 68 variables, 31 states, 37 commands, 39 sectors, 9 errors, 12 warnings, 2 x 13 inputs, 10 outputs.
  EXPECT_EQ(marks.size(), 68u + 31 + 2 * 37 + 39 + 9 + 12 + 26 + 10);
}

}  // namespace
}  // namespace drycut::devices::camming4
