#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/registers.hpp"
#include "sim/cli/commands.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim {
namespace {

using testing::HasSubstr;

TEST(Lx3vpTables, AreListedWithTheDevices) {
  const auto list = printed("", false);
  EXPECT_THAT(list, HasSubstr("\nDECAM          electronic cam of the LX3VP"));
  EXPECT_THAT(list, HasSubstr("\nLX3VP          WECON LX3VP"));
  const auto json = nlohmann::json::parse(printed("", true));
  EXPECT_EQ(json.at(json.size() - 3).at("name"), "DECAM");
  EXPECT_EQ(json.at(json.size() - 2).at("name"), "ECAMTBX");
  EXPECT_EQ(json.back().at("name"), "LX3VP");
}

TEST(Lx3vpTables, DecamIsTheWholeBlock) {
  const auto text = printed("decam", false);
  EXPECT_THAT(text, HasSubstr("\n  25-26  master position     u32"));
  EXPECT_THAT(text, HasSubstr("\n  4     1    stop after cycle  write   "));
  const auto json = nlohmann::json::parse(printed("DECAM", true));
  EXPECT_EQ(json.at("words").size(), devices::lx3vp::block_words().size());
  EXPECT_EQ(json.at("flags").size(), devices::lx3vp::block_flags().size());
}

// The initial values of the manual, where the program may write them, and what we read into it.
TEST(Lx3vpTables, DecamHasInitialValuesAndReadings) {
  const auto text = printed("DECAM", false);
  EXPECT_THAT(text, testing::ContainsRegex("\n  6-7 +max frequency +i32 +1..200000 +200000 +read/write"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  39 +table offset +u16 +40 +40 +read/write.*ECAMTBX"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  0 +version +u16 +read "));
  EXPECT_THAT(text, testing::ContainsRegex("\n  31 +stops by itself +u16 +read +.*midCAMend"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  words 9 to 12 +the table crosses low and high"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  word 14 +HFFFF turns a non-cyclic cam cyclic"));
  EXPECT_THAT(text,
              testing::ContainsRegex("\n  thresholds beyond the table +the manual does not limit them"));
  const auto json = nlohmann::json::parse(printed("DECAM", true));
  EXPECT_EQ(json.at("readings").size(), devices::lx3vp::block_readings().size());
  EXPECT_THAT(printed("ECAMTBX", false),
              testing::ContainsRegex("\n  P6 high 3 +midCAMend: word 31 of the block"));
  EXPECT_THAT(printed("LX3VP", false), testing::ContainsRegex("\n  STL +SET and OUT of a state"));
}

TEST(Lx3vpTables, EcamtbxHasItsListsAndResults) {
  const auto text = printed("ecamtbx", false);
  EXPECT_THAT(text, testing::ContainsRegex("\n  6-7 +P4 +f32 +above 0 +slave pulses per master pulse"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  12 +P7 +u16 +rows +0, 10..512"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  2-3 +P2 +i32 +Hz +1..150000"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  -3 +the synchronous zone does not fit"));
  const auto json = nlohmann::json::parse(printed("ECAMTBX", true));
  EXPECT_EQ(json.at("saw_words").size(), 8U);
  EXPECT_EQ(json.at("s_curve_words").size(), 10U);
  ASSERT_EQ(json.at("results").size(), 8U);
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(json.at("results").at(static_cast<std::size_t>(i)).at("result"), -1 - i);
}

TEST(Lx3vpTables, TheControllerHasRegistersAndInstructions) {
  const auto text = printed("LX3VP", false);
  EXPECT_THAT(text, HasSubstr("\n  D8140     i32   write   pulses of Y0, less those backwards\n"));
  EXPECT_THAT(text, HasSubstr("\n  MOV, MOVP, DMOV, DMOVP"));
  const auto json = nlohmann::json::parse(printed("LX3VP", true));
  EXPECT_EQ(json.at("registers").size(), devices::lx3vp::special_registers().size());
  EXPECT_EQ(json.at("instructions").size(), devices::lx3vp::il::mnemonics().size());
}

}  // namespace
}  // namespace drycut::sim
