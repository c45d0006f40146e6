#include "tests/devices/lx3vp/covers.hpp"

#include <gmock/gmock.h>

namespace drycut::devices::lx3vp {
namespace {

TEST(Lx3vpCoverage, EveryWordAndFlagOfTheManualHasATestThatShowsIt) {
  EXPECT_THAT(coverage::missing(all_marks(), "Lx3vp*:-Lx3vpCoverage*:Lx3vpState.*"), testing::IsEmpty());
}

// The manual's map (003 5): words 0 to 47, of which 13 and 31 to 37 are reserved (31 is
// where a reading of ours stands); its flags; its special
// registers (003 3).
TEST(Lx3vpCoverage, TheTableIsTheManuals) {
  std::array<int, block_length + row_words> named{};
  for (const BlockWord& word : block_words()) {
    for (int i = 0; i < word.words; ++i) ++named[static_cast<std::size_t>(word.offset + i)];
    const bool reserved = word.offset == 13 || word.offset == 32;
    EXPECT_EQ(word.access == BlockWord::Access::reserved, reserved) << word.offset;
  }
  EXPECT_THAT(named, testing::Each(1));
  const coverage::Marks marks = all_marks();
  for (const int bit : {0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11})
    EXPECT_TRUE(marks.contains(fmt::format("word 1 bit {}", bit))) << bit;
  for (const int bit : {0, 1, 2, 3, 5, 6})
    EXPECT_TRUE(marks.contains(fmt::format("word 3 bit {}", bit))) << bit;
  for (const int bit : {0, 1}) EXPECT_TRUE(marks.contains(fmt::format("word 4 bit {}", bit))) << bit;
  EXPECT_EQ(block_flags().size(), 11u + 6 + 2);
  for (const char* name : {"D8140", "D8142", "D8150", "D8152", "M8145", "M8146", "M8152", "M8153", "M8147",
                           "M8148", "M8149", "M8150"})
    EXPECT_TRUE(marks.contains(name)) << name;
}

}  // namespace
}  // namespace drycut::devices::lx3vp
