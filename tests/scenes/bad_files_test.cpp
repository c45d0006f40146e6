// Every file in tests/scenes/bad is refused by `drycut check`, each fault at its line and column and nothing
// else. The faults stand in the file itself, "# expect: LINE:COLUMN: code" (";" in CNF and QCL), or, where a
// file can carry no comment, in FILE.expect.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace drycut {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(DRYCUT_SOURCE_DIR) / "tests/scenes/bad";

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// "LINE:COLUMN: code" of a file.
std::vector<std::string> expectations(const fs::path& file) {
  const auto sidecar = file.string() + ".expect";
  if (fs::exists(sidecar)) return lines_of(sidecar);
  std::vector<std::string> expected;
  for (const auto& line : lines_of(file)) {
    for (const std::string_view mark : {"# expect: ", "; expect: "}) {
      if (line.starts_with(mark)) expected.push_back(line.substr(mark.size()));
    }
  }
  return expected;
}

struct Run {
  int status = -1;
  std::vector<std::string> lines;  ///< standard output and error
};
Run run(const std::string& arguments) {
  const auto command = std::string("'") + DRYCUT_PROGRAM + "' " + arguments + " 2>&1";
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  Run result;
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    text.append(buffer.data(), n);
  }
  result.status = WEXITSTATUS(pclose(pipe));
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    result.lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return result;
}

class BadFile : public testing::TestWithParam<std::string> {};

TEST_P(BadFile, NamesEveryFaultAtItsPlace) {
  const auto file = folder / GetParam();
  const auto expected = expectations(file);
  ASSERT_FALSE(expected.empty()) << "no expectation in " << file;
  const bool module = file.extension() == ".mod";
  const auto checked =
      run("check " + (module ? "'" + (folder / "good.cnf").string() + "' " : "") + "'" + file.string() + "'");
  EXPECT_EQ(checked.status, 2);
  std::vector<std::string> problems;
  for (const auto& line : checked.lines) {
    if (line.starts_with(file.string() + ":")) problems.push_back(line.substr(file.string().size() + 1));
  }
  // "LINE:COLUMN: " must be the very place, and the code the line's end.
  const auto matches = [](const std::string& problem, const std::string& expectation) {
    const auto place = expectation.find(": ") + 2;
    return problem.starts_with(expectation.substr(0, place)) &&
           problem.ends_with(" [" + expectation.substr(place) + "]");
  };
  for (const auto& expectation : expected) {
    EXPECT_TRUE(std::any_of(problems.begin(), problems.end(),
                            [&](const auto& problem) { return matches(problem, expectation); }))
        << "not found: " << expectation;
  }
  for (const auto& problem : problems) {
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(),
                            [&](const auto& expectation) { return matches(problem, expectation); }))
        << "not expected: " << problem;
  }
}

std::vector<std::string> bad_files() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    if (!name.ends_with(".expect") && name != "good.cnf") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, BadFile, testing::ValuesIn(bad_files()), [](const auto& instance) {
  auto name = instance.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
  return name;
});

TEST(BadFiles, AreManyAndOfEveryKind) {
  const auto names = bad_files();
  EXPECT_GE(names.size(), 25U);
  for (const auto* kind : {".yaml", ".cnf", ".mod"}) {
    EXPECT_GE(
        std::count_if(names.begin(), names.end(), [&](const auto& name) { return name.ends_with(kind); }), 5);
  }
}

TEST(BadFiles, TheConfigurationOfTheModulesIsSound) {
  EXPECT_EQ(run("check '" + (folder / "good.cnf").string() + "'").status, 0);
}

TEST(BadFiles, AFileThatIsNotThereIsAProblemToo) {
  const auto checked = run("check /nowhere/line.yaml");
  EXPECT_EQ(checked.status, 2);
  ASSERT_FALSE(checked.lines.empty());
  EXPECT_TRUE(checked.lines[0].starts_with("/nowhere/line.yaml:1:1: ")) << checked.lines[0];
}

}  // namespace
}  // namespace drycut
