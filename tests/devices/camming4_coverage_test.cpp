#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <map>
#include <vector>

#include "camming4_covers.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::IsEmpty;
using testing::Not;

/// What each passed test of `output`, this program's own, has covered.
std::map<std::string, std::set<std::string>> marks_of(std::FILE* output) {
  const auto rest_after = [](const std::string& line, const char* tag) -> std::string {
    return line.starts_with(tag) ? line.substr(std::char_traits<char>::length(tag)) : "";
  };
  std::map<std::string, std::set<std::string>> covered;
  std::set<std::string> marks;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), output) != nullptr) {
    std::string line = buffer.data();
    while (!line.empty() && line.back() == '\n') line.pop_back();
    if (line.starts_with("[ RUN      ] ")) marks.clear();
    if (const std::string mark = rest_after(line, "[  COVERS  ] "); !mark.empty()) marks.insert(mark);
    const std::string passed = rest_after(line, "[       OK ] ");
    if (!passed.empty())
      for (const std::string& mark : marks) covered[mark].insert(passed.substr(0, passed.find(' ')));
  }
  return covered;
}

/// Runs this program's other tests of CAMMING4; the marks of those that pass.
std::map<std::string, std::set<std::string>> run_tests() {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "DRYCUT_COVERS=1 '" + program +
                              "' --gtest_color=no --gtest_filter='Cam*:*/Cam*:-Camming4Coverage*:*LongRun*'";
  std::FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) return {};
  auto marks = marks_of(output);
  pclose(output);
  return marks;
}

// A mark counts only when its line was reached in a test that passed, so this cannot hold by chance.
TEST(Camming4Coverage, EveryNameOfTheDeviceHasATestThatShowsIt) {
  const auto covered = run_tests();
  ASSERT_THAT(covered, Not(IsEmpty()));
  std::vector<std::string> missing;
  for (const std::string& mark : all_marks())
    if (!covered.contains(mark)) missing.push_back(mark);
  EXPECT_THAT(missing, IsEmpty());
}

TEST(Camming4Coverage, KnowsWhatThereIs) {
  const std::set<std::string> marks = all_marks();
  for (const char* name : {"codeQsa", "st_sync", "STOPCAM refused", "sector 254", "error 51", "warning 12",
                           "normal input 12", "interrupt input 0", "output 9"})
    EXPECT_TRUE(marks.contains(name)) << name;
  // 68 variables, 31 states, 37 commands, 39 sectors, 9 errors, 12 warnings, 2 x 13 inputs, 10 outputs.
  EXPECT_EQ(marks.size(), 68u + 31 + 2 * 37 + 39 + 9 + 12 + 26 + 10);
}

}  // namespace
}  // namespace drycut::devices::camming4
