#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <vector>

#include "epicpos_covers.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::IsEmpty;
using testing::Not;

/// What the passed tests of `output`, this program's own, have covered.
std::set<std::string> marks_of(std::FILE* output) {
  std::set<std::string> covered;
  std::set<std::string> marks;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), output) != nullptr) {
    const std::string line(buffer.data(), std::string_view(buffer.data()).find_last_not_of('\n') + 1);
    constexpr std::string_view tag = "[  COVERS  ] ";
    if (line.starts_with("[ RUN      ] ")) marks.clear();
    if (line.starts_with(tag)) marks.insert(line.substr(tag.size()));
    if (line.starts_with("[       OK ] ")) covered.merge(marks);
  }
  return covered;
}

/// Runs this program's other tests of EPICPOS and EANPOS; the marks of those that pass.
std::set<std::string> run_tests() {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "DRYCUT_COVERS=1 '" + program +
                              "' --gtest_color=no --gtest_filter='Epicpos*:Eanpos*:-EpicposCoverage*'";
  std::FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) return {};
  auto marks = marks_of(output);
  pclose(output);
  return marks;
}

// A mark counts only when its line was reached in a test that passed, so this cannot hold by chance.
TEST(EpicposCoverage, EveryNameOfBothDevicesHasATestThatShowsIt) {
  const auto covered = run_tests();
  ASSERT_THAT(covered, Not(IsEmpty()));
  std::vector<std::string> missing;
  for (const std::string& mark : all_marks())
    if (!covered.contains(mark)) missing.push_back(mark);
  EXPECT_THAT(missing, IsEmpty());
}

TEST(EpicposCoverage, KnowsWhatThereIs) {
  const std::set<std::string> marks = all_marks();
  for (const char* name : {"cntratio", "rtype", "ramptype", "st_toll", "PRESET refused", "DELCNT accepted"})
    EXPECT_TRUE(marks.contains(name)) << name;
  // 36 shared variables, 2 of EPICPOS, 1 of EANPOS, 13 states, 19 commands.
  EXPECT_EQ(marks.size(), 36u + 2 + 1 + 13 + 2 * 19);
}

}  // namespace
}  // namespace drycut::devices::epicpos
