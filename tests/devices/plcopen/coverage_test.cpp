#include <gmock/gmock.h>

#include <set>

#include "tests/devices/plcopen/covers.hpp"

namespace drycut::devices::plcopen {
namespace {

TEST(PlcopenCoverage, EveryNameHasATestThatShowsIt) {
  EXPECT_THAT(coverage::missing(all_marks(), "Plcopen*:-PlcopenCoverage*"), testing::IsEmpty());
}

TEST(PlcopenCoverage, KnowsWhatThereIs) {
  const coverage::Marks marks = all_marks();
  for (const char* name : {"MC_CamIn.EndOfProfile", "MC_Power.Enable", "cam_gear.j_vel_sync", "60172",
                           "240010", "HLI_CI_LOCK_TABLE", "POLY5_LINE", "type 6"})
    EXPECT_TRUE(marks.contains(name)) << name;
  EXPECT_EQ(block_types().size(), 29u);
  EXPECT_EQ(start_mode_table.size(), 7u);
  EXPECT_GT(marks.size(), 200u);
}

TEST(PlcopenCoverage, EveryErrorHasItsMeaningOnce) {
  std::set<ErrorId> ids;
  for (const ErrorRow& row : error_table) {
    EXPECT_TRUE(ids.insert(row.id).second) << static_cast<unsigned>(row.id);
    EXPECT_FALSE(meaning_of(row.id).empty());
  }
  EXPECT_EQ(meaning_of(ErrorId::none), "");
}

}  // namespace
}  // namespace drycut::devices::plcopen
