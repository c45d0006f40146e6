#include <fmt/format.h>

#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Several axes on one group of outputs, one of them active (001 1.4.1, 1.4.9.3).
class Oopos2Sharing : public testing::Test {
 protected:
  Oopos2Sharing() {
    for (int axis = 0; axis < 2; ++axis) {
      devices.push_back(
          make_oopos2(terminals_of(fmt::format("10 2.CNT0{} X X 2.OUT01 2.OUT02 X X 2.OUT03 2.OUT0{}",
                                               1 + axis, 4 + axis)),
                      cards));
      drive(*devices[axis], "cntratio=400000 maxpos=9999 minpos=-9999");
    }
  }
  void command(int axis, const char* name) {
    drive(*devices[axis], std::string(name) + "!");
    sample();
  }
  void sample(int number = 1) {
    for (int i = 0; i < number; ++i)
      for (const auto& device : devices) device->sample();
  }
  bool output(int number) { return cards.outputs.at({Kind::output, 2, number}).level; }
  std::vector<std::string> said() {
    std::vector<std::string> all;
    for (const auto& device : devices)
      for (std::string& text : said_by(*device)) all.push_back(std::move(text));
    return all;
  }

  Cards cards;
  std::vector<std::unique_ptr<Device>> devices;
};

TEST_F(Oopos2Sharing, TheyTakeTurns) {
  for (int axis = 0; axis < 2; ++axis) {
    command(axis, "INIT");
    command(axis, "REGOFF");
  }
  for (const int axis : {0, 1, 0}) {
    command(axis, "REGON");
    command(axis, "MANSFW");
    EXPECT_TRUE(output(1));
    EXPECT_TRUE(output(3));
    EXPECT_FALSE(output(4 + axis));
    EXPECT_TRUE(output(5 - axis));  // the other's brake
    command(axis, "STOP");
    sample(3);
    command(axis, "REGOFF");
    EXPECT_FALSE(output(1));
    sample(3);
  }
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(Oopos2Sharing, ATurnMayChangeHandsInOneSample) {
  command(0, "INIT");
  command(1, "INIT");
  command(1, "REGOFF");
  said();
  drive(*devices[0], "REGOFF!");
  drive(*devices[1], "REGON!");
  sample(5);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(Oopos2Sharing, TwoThatDriveAtOnceAreReportedOnce) {
  command(0, "INIT");
  command(1, "INIT");
  sample(20);
  const std::string text =
      ": another device drives the same output; of devices that share one, all but one need REGOFF";
  EXPECT_THAT(said(), ElementsAre("OutAva" + text, "OutInd" + text, "OutRal" + text));
  command(1, "REGOFF");
  said();
  command(1, "REGON");
  sample(3);
  EXPECT_EQ(said().size(), 3u);  // and again when it begins again
}

TEST_F(Oopos2Sharing, RegulationOffEndsAMovementAndOnlyTheBrakeGoesOn) {
  for (int axis = 0; axis < 2; ++axis) command(axis, "INIT");
  command(1, "REGOFF");
  const int toldly = 30;
  drive(*devices[0], "toldly=30");
  command(0, "MANFFW");
  ASSERT_TRUE(output(1));
  command(0, "REGOFF");
  EXPECT_FALSE(output(1));
  EXPECT_FALSE(output(4));
  cards.outputs.at(*parse_address("2.OUT01")).level = true;  // someone else's from now on
  sample(toldly - 1);
  EXPECT_FALSE(output(4));
  sample(1);
  EXPECT_TRUE(output(4));
  EXPECT_TRUE(output(1));
}

TEST_F(Oopos2Sharing, PowerLossLeavesTheOutputs) {
  command(0, "INIT");
  command(0, "MANFFW");
  ASSERT_TRUE(output(1));
  devices[0]->power_up();
  EXPECT_FALSE(output(1));
  command(1, "INIT");
  sample(5);
  EXPECT_THAT(said(), IsEmpty());
}

}  // namespace
}  // namespace drycut::devices::oopos2
