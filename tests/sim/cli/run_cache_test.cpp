// drycut run --cache: what would come out the same is not run again; anything else is.
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/text.hpp"
#include "sim/cli/run_cache.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/loop/fingerprint.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr auto* triangle =
    "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 0\n"
    "endloop\nendfacet\nendsolid x\n";

std::string sorted(const std::string& text) {
  auto lines = split_lines(text);
  std::ranges::sort(lines);
  return fmt::format("{}", fmt::join(lines, "\n"));
}

struct KeptRuns : CommandTest {
  KeptRuns() {
    options.scenarios = {folder / "line.yaml"};
    options.out = folder / "out";
    options.cache = folder / "cache";
    options.pictures = false;
    folder.file("axis.cnf", studies::tuning::configuration);
    folder.file("axis.mod", studies::tuning::program);
    folder.file("base.yaml", studies::tuning::scenario);
    folder.file("line.yaml", "extends: base.yaml\nchecks: [{name: moves, eventually: axis.position > 1}]\n");
  }
  int run() {
    return captured([&] { return run_scenarios(options); });
  }
  bool unchanged() const { return out.find(" earlier; unchanged)") != std::string::npos; }
  /// All files of a folder of results with their bytes.
  std::map<std::string, std::string> results(const std::string& of = "out") const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder / of))
      if (entry.is_regular_file())
        files[entry.path().lexically_relative(folder / of).string()] = content(entry.path());
    // The order in which files came into being is no result.
    for (auto& [name, text] : files)
      if (name.ends_with(".drycut-run")) text = sorted(text);
    return files;
  }
  std::vector<fs::path> kept(const std::string& ending) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "cache"))
      if (entry.is_regular_file() && entry.path().filename() == ending) files.push_back(entry.path());
    return files;
  }
  void replace(const std::string& name, const std::string& what, const std::string& by) const {
    auto text = content(folder / name);
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << name << ": " << what;
    folder.file(name, text.replace(at, what.size(), by));
  }
  TestFolder folder;
  RunOptions options;
};

TEST_F(KeptRuns, TheSameIsThereAgainToTheByte) {
  options.pictures = true;
  options.gltf = true;
  options.verify_step = true;
  options.set = {"pictures.frames.every=500 ms"};
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_FALSE(unchanged());
  const auto first = results();
  const auto told = out;
  EXPECT_GT(first.size(), 6U);
  fs::remove_all(folder / "out");
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_TRUE(unchanged()) << out;
  EXPECT_EQ(results(), first);
  auto expected = told;
  expected.replace(expected.find(" s simulated)"), 13, " s simulated earlier; unchanged)");
  EXPECT_EQ(out, expected) << "checks, margins at half the step, notes and places are told as ever";
  // Over results that are there, and elsewhere.
  ASSERT_EQ(run(), all_passed);
  EXPECT_TRUE(unchanged());
  EXPECT_EQ(results(), first);
}

TEST_F(KeptRuns, AFailedCheckFailsAgain) {
  replace("line.yaml", "> 1", "> 1e9");
  EXPECT_EQ(run(), check_failed);
  const auto junit = content(folder / "out/junit.xml");
  EXPECT_EQ(run(), check_failed);
  EXPECT_TRUE(unchanged());
  EXPECT_EQ(content(folder / "out/junit.xml"), junit);
}

TEST_F(KeptRuns, WhateverIsChangedIsRun) {
  folder.file("axis.stl", triangle);
  const std::vector<std::pair<const char*, std::function<void()>>> changes = {
      {"the scenario, in a comment", [&] { replace("line.yaml", "extends", "# new\nextends"); }},
      {"what it extends", [&] { replace("base.yaml", "scene:", "# new\nscene:"); }},
      {"the configuration", [&] { replace("axis.cnf", "\n", "\n; new\n"); }},
      {"the program", [&] { replace("axis.mod", "\n", "\n; new\n"); }},
      {"an override", [&] { options.set = {"scene.title=new"}; }},
      {"the seed", [&] { options.seed = 99; }},
      {"the half step", [&] { options.verify_step = true; }},
      {"the 3-D scene", [&] { options.gltf = true; }},
      {"pictures", [&] { options.pictures = true; }},
      {"the name of the results", [&] {
         fs::copy_file(folder / "line.yaml", folder / "other.yaml");
         options.scenarios = {folder / "other.yaml"};
       }}};
  ASSERT_EQ(run(), all_passed) << err;
  for (const auto& [what, change] : changes) {
    ASSERT_EQ(run(), all_passed) << err;
    EXPECT_TRUE(unchanged()) << "before " << what;
    change();
    ASSERT_EQ(run(), all_passed) << what << ": " << err;
    EXPECT_FALSE(unchanged()) << what;
  }
  // Back to what it was: it is still known.
  options.scenarios = {folder / "line.yaml"};
  ASSERT_EQ(run(), all_passed);
  EXPECT_TRUE(unchanged());
}

TEST_F(KeptRuns, AnotherMeshIsRun) {
  folder.file("part.stl", triangle);
  folder.file(
      "line.yaml",
      content(folder / "line.yaml") +
          "plants: {web: {type: web}}\npictures: {meshes: {web.measuring wheel: {file: part.stl}}}\n");
  const int first = run();
  ASSERT_EQ(first, all_passed) << err;
  run();
  EXPECT_TRUE(unchanged());
  replace("part.stl", "vertex 10 0 0", "vertex 11 0 0");
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_FALSE(unchanged());
}

TEST_F(KeptRuns, WhatIsDamagedIsNotUsedAndMadeAnew) {
  ASSERT_EQ(run(), all_passed) << err;
  const auto first = results();
  const std::vector<std::pair<const char*, std::function<void()>>> damages = {
      {"a byte of a file",
       [&] {
         const auto file = kept("trace.csv").at(0);
         auto text = content(file);
         text.back() = 'x';
         std::ofstream(file, std::ios::binary) << text;
       }},
      {"a file is missing", [&] { fs::remove(kept("events.csv").at(0)); }},
      {"a file was cut short", [&] { fs::resize_file(kept("checks.json").at(0), 10); }},
      {"the entry was cut short", [&] { fs::resize_file(kept("entry.json").at(0), 100); }},
      {"the entry is empty", [&] { fs::resize_file(kept("entry.json").at(0), 0); }},
      {"the entry says something else",
       [&] {
         const auto file = kept("entry.json").at(0);
         auto text = content(file);
         const auto at = text.find("\"passed\": true");
         text.replace(at, 14, "\"passed\": fals");
         std::ofstream(file, std::ios::binary) << text;
       }},
      {"the entry is no JSON", [&] { std::ofstream(kept("entry.json").at(0)) << "x\ny"; }}};
  for (const auto& [what, damage] : damages) {
    damage();
    ASSERT_EQ(run(), all_passed) << what << ": " << err;
    EXPECT_FALSE(unchanged()) << what;
    EXPECT_EQ(results(), first) << what;
    ASSERT_EQ(run(), all_passed);
    EXPECT_TRUE(unchanged()) << "after " << what;
  }
}

TEST_F(KeptRuns, ALineThatKeepsValuesIsAlwaysRun) {
  replace("base.yaml", "tasks: [axis.mod]", "tasks: [axis.mod], retentive: kept.txt");
  ASSERT_EQ(run(), all_passed) << err;
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_FALSE(unchanged());
  EXPECT_TRUE(kept("entry.json").empty());
}

TEST_F(KeptRuns, AFolderThatCannotBeMadeIsToldBeforeTheRun) {
  folder.file("file", "mine");
  options.cache = folder / "file/cache";
  EXPECT_EQ(run(), bad_input);
  EXPECT_THAT(err, HasSubstr("--cache:1:1: the directory "));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(KeptRuns, WhereNothingCanBeKeptTheVerdictStands) {
  options.cache = "/proc/self/fdinfo";
  EXPECT_EQ(run(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("\n  note not kept in the cache: "));
  EXPECT_TRUE(fs::exists(folder / "out/junit.xml"));
}

TEST_F(KeptRuns, AnEntryThatLeadsOutOfTheFolderIsNotUsed) {
  ASSERT_EQ(run(), all_passed) << err;
  const auto file = kept("entry.json").at(0);
  auto json = nlohmann::ordered_json::parse(content(file).substr(17));
  fs::copy_file(file.parent_path() / "files/trace.csv", file.parent_path() / "other");
  json["files"]["../other"] = json["files"]["trace.csv"];
  const auto text = json.dump(2) + "\n";
  loop::Fingerprint hash;
  hash.add(text);
  std::ofstream(file, std::ios::binary) << fmt::format("{:016x}\n", hash.value()) << text;
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_FALSE(unchanged());
  EXPECT_FALSE(fs::exists(folder / "out/other"));
}

/// A cache with room for two results of 10 000 bytes.
struct RunCacheRoom : testing::Test {
  RunCacheRoom() { std::ofstream(results.add("trace.csv")) << std::string(10'000, '1'); }
  TestFolder folder;
  Problems problems;
  OutputFolder results{folder / "out", "run", {}, problems};
  const RunCache cache{folder / "cache", problems, 25'000};
};

TEST_F(RunCacheRoom, IsForThoseThatWereUsedLast) {
  ASSERT_TRUE(problems.empty());
  OutputFolder again(folder / "again", "run", {}, problems);
  const auto is_kept = [&](const std::string& inputs) { return cache.take(inputs, again).has_value(); };
  const auto an_hour_passes = [&] {
    for (const auto& entry : fs::directory_iterator(folder / "cache")) {
      const auto file = entry.path() / "entry.json";
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(1));
    }
  };
  for (const auto* inputs : {"first", "second"}) {
    cache.keep(inputs, results, {});
    an_hour_passes();
  }
  EXPECT_TRUE(is_kept("first")) << "used again, so that the second is the oldest";
  cache.keep("third", results, {});
  EXPECT_TRUE(is_kept("first"));
  EXPECT_FALSE(is_kept("second"));
  EXPECT_TRUE(is_kept("third"));
}

// What a killed process began counts and goes like the rest; what is not ours stays.
TEST_F(RunCacheRoom, IsTakenBackFromWhatWasBegunOnly) {
  for (const auto* name : {"0123456789abcdef.4711", "0123456789abcdef", "notes.4711"}) {
    fs::create_directories(folder / "cache" / name);
    std::ofstream(folder / "cache" / name / "trace.csv") << std::string(20'000, '1');
    fs::last_write_time(folder / "cache" / name, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  cache.keep("first", results, {});
  EXPECT_FALSE(fs::exists(folder / "cache/0123456789abcdef.4711"));
  EXPECT_TRUE(fs::exists(folder / "cache/0123456789abcdef"));
  EXPECT_TRUE(fs::exists(folder / "cache/notes.4711"));
}

TEST_F(KeptRuns, WithoutTheOptionNothingIsKept) {
  options.cache.clear();
  ASSERT_EQ(run(), all_passed);
  ASSERT_EQ(run(), all_passed);
  EXPECT_FALSE(unchanged());
  EXPECT_FALSE(fs::exists(folder / "cache"));
}

}  // namespace
}  // namespace drycut::sim::cli
