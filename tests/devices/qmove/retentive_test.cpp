#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

// What survives power-off, as text.
namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::powered_module;
using testing::text_of;

TEST(QmoveRetentive, SurvivesARoundTrip) {
  Bench bench({powered_module});
  bench.set("ssR", 0.1);
  bench.set("asReal[2]", -1e30);
  bench.set("ddsReal[2,3]", 1.5);
  bench.set("ddlHead[2]", -7);
  bench.set("sbKept", -128);
  bench.set("slB", -2147483648.0);
  bench.run(30);
  const std::string kept = bench.controller->retentive_state();

  Bench fresh({powered_module});
  fresh.set("asKept[3]", 99);  // not in the text: becomes 0
  Problems problems;
  ASSERT_TRUE(fresh.controller->restore(kept, problems)) << text_of(problems);
  EXPECT_EQ(fresh.controller->retentive_state(), kept);
  EXPECT_EQ(static_cast<float>(fresh["ssR"]), 0.1F);
  EXPECT_EQ(fresh["slA"], 1);
  EXPECT_EQ(fresh["asKept[3]"], 0);
  EXPECT_EQ(fresh["ddlHead[2]"], -7);
  EXPECT_EQ(fresh["Axis.kept"], 7);
  EXPECT_EQ(fresh["Axis.st_locked"], 1);
  EXPECT_EQ(fresh["glI"], 0);
}

TEST(QmoveRetentive, TextIsReadable) {
  Bench bench({"END\n"});
  bench.set("slA", 12);
  bench.set("ddbCode[2,1]", -124);
  const std::string text = bench.controller->retentive_state();
  EXPECT_THAT(text, HasSubstr("\nslA = 12\n"));
  EXPECT_THAT(text, HasSubstr("\nddbCode[2,1] = -124\n"));
  EXPECT_THAT(text, HasSubstr("\nAxis:kept = 0\n"));
  EXPECT_THAT(text, Not(HasSubstr("glI")));
  EXPECT_THAT(text, Not(HasSubstr("posit")));
}

TEST(QmoveRetentive, FaultsOfTheTextChangeNothing) {
  Bench bench({"END\n"});
  bench.set("slA", 3);
  Problems problems;
  EXPECT_FALSE(bench.controller->restore(
      "; comment\nslA = 5 ; fine\n slRR = 1\nglI = 2\nslB 4\nslB =\nsbKept = 132\nslB = 1.5\nslB = x\n"
      "slA = 6\nAxis:posit = 1\nddbCode[3,1] = 1\nAxis.st_locked = 2147483648\nssR = 1e999\n",
      problems, "kept.txt"));
  EXPECT_EQ(
      text_of(problems),
      "kept.txt:3:2: unknown name 'slRR'; did you mean 'slR'? [controller.unknown-retained]\nkept.txt:4:1: "
      "'glI' is not retentive; "
      "remove the line, it is set at each start [controller.unknown-retained]\nkept.txt:5:1: no '=' in 'slB "
      "4'; write: name = value "
      "[controller.retained-value]\nkept.txt:6:1: a name or value is missing; write: name = value "
      "[controller.retained-value]\nkept.txt:7:10: 'sbKept' cannot be '132'; write a whole number from "
      "-128 to 127 [controller.retained-value]\nkept.txt:8:7: 'slB' cannot be '1.5'; write a whole number "
      "from -2147483648 to "
      "2147483647 [controller.retained-value]\nkept.txt:9:1: 'slB' is given twice; remove one of the lines "
      "[controller.retained-twice]\nkept.txt:10:1: 'slA' is given twice; remove one of the lines "
      "[controller.retained-twice]\nkept.txt:11:1: 'Axis:posit' is not retentive; remove the line, it "
      "is set at each start [controller.unknown-retained]\nkept.txt:12:1: unknown name 'ddbCode[3,1]'; did "
      "you mean "
      "'ddbCode[1,1]'? [controller.unknown-retained]\nkept.txt:13:18: 'Axis.st_locked' cannot be "
      "'2147483648'; write a whole number "
      "from -2147483648 to 2147483647 [controller.retained-value]\nkept.txt:14:7: 'ssR' cannot be '1e999'; "
      "write a number from "
      "-3.402823466e+38 to 3.402823466e+38 [controller.retained-value]\n");
  EXPECT_EQ(bench["slA"], 3);
}

TEST(QmoveRetentive, IsRefusedOnceADeviceIsInitialised) {
  Bench bench({"INIT Axis\nEND\n"});
  bench.run(10);
  Problems problems;
  EXPECT_FALSE(bench.controller->restore("Axis:kept = 1\n", problems));
  EXPECT_THAT(text_of(problems),
              HasSubstr("retentive state:1:1: the device of 'Axis:kept' is initialised already"));
}

}  // namespace
}  // namespace drycut::devices::qmove
