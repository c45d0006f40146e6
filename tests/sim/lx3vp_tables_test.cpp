#include "sim/commands/lx3vp_tables.hpp"

#include <gmock/gmock.h>

#include "devices/lx3vp/block.hpp"
#include "devices/lx3vp/il_mnemonics.hpp"
#include "sim/commands/commands.hpp"

namespace drycut::sim {
namespace {

using testing::HasSubstr;

std::string printed(const std::string& name, bool json) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(list_devices(name, json), all_passed);
  return testing::internal::GetCapturedStdout();
}

TEST(Lx3vpTables, AreListedWithTheDevices) {
  const auto list = printed("", false);
  EXPECT_THAT(list, HasSubstr("\nDECAM          electronic cam of the LX3VP"));
  EXPECT_THAT(list, HasSubstr("\nLX3VP          WECON LX3VP"));
  const auto json = nlohmann::json::parse(printed("", true));
  EXPECT_EQ(json.at(json.size() - 2).at("name"), "DECAM");
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
