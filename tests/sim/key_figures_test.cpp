// What stands on top of a report: pieces, values within their tolerances, speeds, drives, the nearest check;
// and where its scenario comes from.
#include "sim/report/key_figures.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "base/shown_units.hpp"
#include "renders/process.hpp"
#include "sim/report/origin.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::report {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double open = std::numeric_limits<double>::infinity();

/// Cuts every half second from 1 s on, with these lengths.
record::Recording cuts_of(const std::vector<double>& lengths) {
  record::Recording recording;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    recording.happened({second + static_cast<Time>(i) * 500 * millisecond,
                        0,
                        "knife",
                        "cut",
                        {{"length", lengths[i], "mm"}, {"mismatch", 5, "mm/s"}},
                        ""});
  return recording;
}
const std::vector<loop::KnownEvent> known = {{"knife", "cut", {{"length", "mm"}, {"mismatch", "mm/s"}}},
                                             {"web", "tear", {}}};

record::Outcome limited(const std::vector<record::Tolerance>& tolerances) {
  record::Outcome outcome;
  outcome.checks.push_back({"cut length", "", true, {}, "", {}, ""});
  outcome.checks.back().tolerances = tolerances;
  return outcome;
}

/// "label: value [share]; notes".
std::vector<std::string> told(const std::vector<renders::ReportKey>& keys) {
  std::vector<std::string> lines;
  for (const auto& key : keys) {
    auto line = key.label + ": " + key.value;
    if (key.used) line += " [" + std::to_string(std::lround(*key.used * 100)) + "]";
    for (const auto& note : key.notes) line += "; " + note;
    lines.push_back(line);
  }
  return lines;
}

// 799.99 four times, 800.01 three times, 800.03, 800 and 799.98: mean 800, squares of what is beside it
// 20e-4, sd = sqrt(20e-4 / 9) = 0.0149, Cpk = 0.1 / (3 sd) = 2.24.
TEST(KeyFigures, PiecesWithMeanSpreadWorstAndCpk) {
  std::vector<double> lengths = {2618};
  for (int i = 0; i < 10; ++i) lengths.push_back(i % 2 == 0 ? 799.99 : 800.01);
  lengths[4] = 800.03;
  lengths[5] = 799.98;
  lengths[2] = 800;
  const auto recording = cuts_of(lengths);
  const auto keys =
      key_figures(recording, known, {}, limited({{"cut", "length", 799.9, 800.1, 1.2, open}}), true);
  EXPECT_THAT(told(keys), ElementsAre("pieces: 11; 120 per minute at the end",
                                      "length of cut: 800.000 ± 0.015 mm [30]; worst 800.030 mm: no. 5, at "
                                      "3.000 s; Cpk 2.24, of 10 values"));
}

TEST(KeyFigures, OfFewValuesThereIsNoCpk) {
  const auto recording = cuts_of({800, 800.2, 799.9});
  EXPECT_THAT(
      told(key_figures(recording, known, {}, limited({{"knife.cut", "length", 799.9, 800.1, 0, 1.7}}), true)),
      ElementsAre("pieces: 3; 120 per minute at the end",
                  "length of knife.cut: 800.100 ± 0.141 mm [200]; worst 800.200 mm: no. 2, at 1.500 s; of 2 "
                  "values, too few for a Cpk"));
}

TEST(KeyFigures, OneSidedLimitsAndNoSpread) {
  const auto recording = cuts_of(std::vector<double>(12, 800));
  const auto keys = told(key_figures(recording, known, {},
                                     limited({{"cut", "mismatch", -open, 10, 0, open},
                                              {"cut", "length", 400, open, 0, open},
                                              {"cut", "length", 1, 2, 0, open},
                                              {"cut", "length", 1, 2, 100, open}}),
                                     true));
  EXPECT_THAT(keys, ElementsAre("pieces: 12; 120 per minute at the end",
                                "mismatch of cut: 5.0 mm/s [50]; worst 5.0 mm/s: no. 1, at 1.000 s; "
                                "no spread in 12 values, so no Cpk",
                                "length of cut: 800 mm [50]; worst 800 mm: no. 1, at 1.000 s; no spread "
                                "in 12 values, so no Cpk"))
      << "the first check of a value tells of it";
}

TEST(KeyFigures, SpeedsDrivesAndTheNearestCheck) {
  record::Recording recording;
  recording.add("web.speed", "m/min");
  recording.append(0, {0});
  recording.append(second, {60});
  record::Outcome outcome;
  record::DriveVerdict drive;
  drive.drive = "knife.servo";
  drive.cycles = "10 cycles from cut to cut";
  drive.figures = {{"rms torque", 2.041, 9.5, "N m", 0.2148},
                   {"peak torque", 30, 28.6, "N m", 1.049},
                   {"largest speed", 500, 3000, "rpm", 0.17}};
  drive.figures[1].judged = false;  // a limit that works as one: no key figure
  drive.figures[0].window = "steady cycle";
  drive.figures[1].window = "from the first cut on";
  outcome.drives = {drive};
  for (const auto& [name, passed, used] :
       {std::tuple{"a", true, 0.2}, {"b", true, 0.9}, {"failed", false, 2.0}}) {
    outcome.checks.push_back({name, "", passed, {}, "", {}, ""});
    outcome.checks.back().used = used;
  }
  EXPECT_THAT(told(key_figures(recording, {}, {"web", "other"}, outcome, true)),
              ElementsAre("highest web speed: 60 m/min; lowest 0",
                          "rms torque of knife.servo: 2.04 N m [21]; limit 9.5 N m; steady cycle",
                          "farthest beyond its limit: failed [200]; of the checks that have a margin"));
  outcome.checks.pop_back();
  EXPECT_EQ(told(key_figures(recording, {}, {"web", "other"}, outcome, true)).back(),
            "nearest to its limit: b [90]; of the checks that have a margin");
  outcome.checks.push_back(outcome.checks.front());
  outcome.checks.back().name = "done in time";
  outcome.checks.back().used = 0.99;
  outcome.checks.back().deadline = true;
  EXPECT_EQ(told(key_figures(recording, {}, {"web", "other"}, outcome, true)).back(),
            "nearest to its limit, deadlines apart: b [90]; of the checks that have a margin");
  EXPECT_THAT(told(key_figures(recording, {}, {}, outcome, false))[0],
              testing::StartsWith("rms torque of knife.servo: 2.04 N m; limit 9.5 N m; not judged"));
  EXPECT_THAT(key_figures(record::Recording(), {}, {}, {}, true), IsEmpty());
}

// ---- where the scenario comes from ----

struct Origin : ::testing::Test {
  void SetUp() override {
    unsetenv("SOURCE_DATE_EPOCH");
    // 2001-09-09 01:46:40 UTC is second 1000000000.
    const auto written = std::chrono::sys_seconds(std::chrono::seconds(1'000'000'000));
    std::filesystem::last_write_time(file, std::chrono::file_clock::from_sys(written));
  }
  void TearDown() override { unsetenv("SOURCE_DATE_EPOCH"); }

  std::vector<std::string> facts(const std::filesystem::path& of) const {
    std::vector<std::string> lines;
    for (const auto& row : origin_of(of)) lines.push_back(row.cells.at(0) + ": " + row.cells.at(1));
    return lines;
  }
  bool git(std::vector<std::string> words) const {
    words.insert(words.begin(), {"-C", folder.path.string(), "-c", "user.name=n", "-c", "user.email=e@e"});
    try {
      return renders::run_process({"git", "git", words}).good;
    } catch (const std::runtime_error&) {
      return false;
    }
  }
  /// False where there is no git.
  bool commit() const {
    setenv("GIT_COMMITTER_DATE", "1234567890 +0000", 1);  // 2009-02-13 23:31:30 UTC
    const bool good = git({"init", "-q"}) && git({"add", "line.yaml"}) && git({"commit", "-qm", "first"});
    unsetenv("GIT_COMMITTER_DATE");
    return good;
  }

  TestFolder folder;
  std::filesystem::path file = folder.file("line.yaml", "scene: {}\n");
};

TEST_F(Origin, WithoutARepositoryItIsTheFilesDate) {
  EXPECT_THAT(facts(file), ElementsAre("scenario written: 2001-09-09 01:46 UTC"));
  EXPECT_THAT(facts(folder / "none.yaml"), IsEmpty());
}

TEST_F(Origin, TheEnvironmentsDateComesFirst) {
  setenv("SOURCE_DATE_EPOCH", "86400", 1);
  EXPECT_THAT(facts(file), ElementsAre("date: 1970-01-02 00:00 UTC"));
  for (const char* bad : {"today", "-5", "12 ", "99999999999999999999"}) {
    setenv("SOURCE_DATE_EPOCH", bad, 1);
    EXPECT_THAT(facts(file),
                ElementsAre("date: SOURCE_DATE_EPOCH is " + std::string(bad) + ": not a number of seconds"));
  }
  setenv("SOURCE_DATE_EPOCH", "", 1);
  EXPECT_THAT(facts(file), ElementsAre("scenario written: 2001-09-09 01:46 UTC"));
}

TEST_F(Origin, OfACommitIsItsDateAndName) {
  if (!commit()) GTEST_SKIP() << "needs git";
  EXPECT_THAT(facts(file), ElementsAre("date of the commit: 2009-02-13 23:31 UTC",
                                       ::testing::MatchesRegex("commit: [0-9a-f]{7,40}")));
  const auto other = folder.file("new.yaml", "scene: {}\n");
  EXPECT_THAT(facts(other), ElementsAre(::testing::StartsWith("scenario written: 20"),
                                        ::testing::MatchesRegex("commit: [0-9a-f]{7,40}, changed since")))
      << "a scenario that the repository does not keep";
}

TEST_F(Origin, SaysThatSomethingWasChangedSince) {
  if (!commit()) GTEST_SKIP() << "needs git";
  folder.file("line.yaml", "scene: {seed: 2}\n");
  EXPECT_THAT(facts(file), ElementsAre(::testing::StartsWith("scenario written: 20"),
                                       ::testing::EndsWith(", changed since")));
}

TEST(ShownUnits, OfKernelsAreThoseThatPeopleRead) {
  const auto shown = [](const char* unit, double number) {
    const auto [name, factor] = shown_unit(unit);
    return std::pair(name, factor * number);
  };
  EXPECT_EQ(shown("0.0001 deg", 2500).first, "deg");
  EXPECT_DOUBLE_EQ(shown("0.0001 deg", 2500).second, 0.25);
  EXPECT_EQ(shown("0.1 um", 8'000'000).first, "mm");
  EXPECT_DOUBLE_EQ(shown("0.1 um", 8'000'000).second, 800);
  EXPECT_EQ(shown("um/s", 1000), (std::pair<std::string, double>("mm/s", 1)));
  EXPECT_EQ(shown("Um", 7), (std::pair<std::string, double>("Um", 7))) << "the machine builder's own";
  EXPECT_EQ(shown("bits x4", 7), (std::pair<std::string, double>("bits x4", 7)));
}

}  // namespace
}  // namespace drycut::sim::report
