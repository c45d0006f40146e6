// drycut run of several scenarios: what their results are called, and one whose input is wrong among them.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/run_command.hpp"
#include "sim/cli/run_work.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct RunMany : CommandTest {
  RunMany() {
    for (const auto* name : {"a", "b", "c"}) {
      fs::create_directories(folder / name);
      folder.file(fs::path(name) / "axis.cnf", studies::tuning::configuration);
      folder.file(fs::path(name) / "axis.mod", studies::tuning::program);
      line(name, "checks:\n  - {name: moves, eventually: axis.position > 1}\n");
    }
    options.out = folder / "out";
    options.pictures = false;
  }
  void line(const fs::path& where, const std::string& more) const {
    folder.file(where / "line.yaml", studies::tuning::scenario + more);
  }
  int run(const std::vector<fs::path>& scenarios) {
    options.scenarios.clear();
    for (const auto& scenario : scenarios) options.scenarios.push_back(folder / scenario);
    return captured([&] { return run_scenarios(options); });
  }
  static std::size_t times(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
  }

  TestFolder folder;
  RunOptions options;
};

TEST(ResultNames, HaveAsManyFoldersAsTellThemApart) {
  EXPECT_THAT(result_names({"x/a/line.yaml", "x/b/line.yaml", "x/b/other.yaml"}),
              ElementsAre("a/line", "b/line", "other"));
  EXPECT_THAT(result_names({"/x/a/line.yaml", "/y/a/line.yaml", "/y/b/line.yaml"}),
              ElementsAre("x/a/line", "y/a/line", "b/line"));
  EXPECT_THAT(result_names({"/x/line.yaml", "/x/../x/./line.yaml"}), ElementsAre("line", "line"));
}

TEST_F(RunMany, ScenariosOfOneNameHaveTheirResultsByFolder) {
  EXPECT_EQ(run({"a/line.yaml", "b/line.yaml"}), all_passed) << err;
  EXPECT_TRUE(fs::exists(options.out / "a/line/checks.json"));
  EXPECT_TRUE(fs::exists(options.out / "b/line/checks.json"));
  EXPECT_THAT(content(options.out / "junit.xml"), AllOf(HasSubstr("<testsuite name=\"a/line\" "),
                                                        HasSubstr("classname=\"b/line\" name=\"moves\"")));
  EXPECT_THAT(content(options.out / "index.html"), AllOf(HasSubstr("a/line"), HasSubstr("b/line")));
  EXPECT_THAT(out, AllOf(HasSubstr("a/line: passed"), HasSubstr("b/line: passed")));
}

TEST_F(RunMany, OneNamedTwiceRunsNothing) {
  EXPECT_EQ(run({"a/line.yaml", "a/../a/line.yaml"}), bad_input);
  EXPECT_THAT(err, HasSubstr("its results would overwrite those of"));
  EXPECT_FALSE(fs::exists(options.out));
}

TEST_F(RunMany, ASlipInOneKeepsNoOtherFromRunning) {
  line("b", "checks:\n  - {name: moves, eventualy: axis.position > 1}\n");
  options.summary = folder / "summary.md";
  options.annotate = "github";
  EXPECT_EQ(run({"a/line.yaml", "b/line.yaml", "c/line.yaml"}), bad_input);
  EXPECT_TRUE(fs::exists(options.out / "a/line/checks.json"));
  EXPECT_FALSE(fs::exists(options.out / "b/line"));
  EXPECT_TRUE(fs::exists(options.out / "c/line/checks.json"));
  EXPECT_EQ(times(err, "did you mean eventually?"), 1U) << err;
  EXPECT_THAT(out, AllOf(HasSubstr("a/line: passed"), HasSubstr("c/line: passed"),
                         HasSubstr("b/line: NOT RUN, its input is wrong: ")));
  EXPECT_EQ(times(out, "::error file="), times(err, "line.yaml:")) << out << err;
  EXPECT_THAT(content(options.out / "junit.xml"),
              AllOf(HasSubstr("<testsuite name=\"a/line\" tests=\"2\" failures=\"0\" errors=\"0\""),
                    HasSubstr("<testsuite name=\"b/line\" tests=\"1\" failures=\"0\" errors=\"1\""),
                    HasSubstr("<error message=\"not run: "), HasSubstr("did you mean eventually?")));
  EXPECT_THAT(content(options.summary), AllOf(HasSubstr("1 of 3 scenes failed"),
                                              HasSubstr("| b/line | not run |"), HasSubstr("\nnot run: ")));
}

TEST_F(RunMany, AWrongSetIsToldOnce) {
  options.set = {"plants.axis.sped_at_10v=1 m/s"};
  EXPECT_EQ(run({"a/line.yaml", "b/line.yaml", "c/line.yaml"}), bad_input);
  EXPECT_EQ(times(err, "did you mean speed_at_10v?"), 1U) << err;
  EXPECT_FALSE(fs::exists(options.out));
}

}  // namespace
}  // namespace drycut::sim::cli
