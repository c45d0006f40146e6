// verdict.json: what a run and a study came to, for a program.
#include "sim/record/verdict.hpp"

#include <gmock/gmock.h>

#include "sim/file.hpp"
#include "sim/record/json.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::record {
namespace {

using testing::ElementsAre;

Outcome outcome_of(const std::vector<bool>& checks) {
  Outcome outcome;
  for (const bool passed : checks) {
    auto& check = outcome.checks.emplace_back();
    check.name = "check " + std::to_string(outcome.checks.size());
    check.passed = passed;
  }
  return outcome;
}

TEST(VerdictFile, OfARunGoesByItsChecks) {
  auto verdict = verdict_of(outcome_of({true, true}));
  EXPECT_EQ(verdict.verdict, Verdict::Came::passed);
  EXPECT_EQ(verdict.exit, 0);
  EXPECT_EQ(verdict.sentence, "2 checks passed");
  verdict = verdict_of(outcome_of({false, false, true, false, false}));
  EXPECT_EQ(verdict.verdict, Verdict::Came::failed);
  EXPECT_EQ(verdict.exit, 1);
  EXPECT_EQ(verdict.sentence, "4 of 5 checks failed: check 1, check 2, check 4 and 1 more");
  EXPECT_EQ(verdict.counts["failed"], 4);
}

TEST(VerdictFile, ARunWithoutChecksJudgesNothing) {
  const auto verdict = verdict_of({});
  EXPECT_EQ(verdict.verdict, Verdict::Came::none);
  EXPECT_EQ(verdict.exit, 0);
}

TEST(VerdictFile, ARunThatStoppedFailsThoughItsChecksHeld) {
  auto outcome = outcome_of({true});
  outcome.failure = "diverged";
  const auto verdict = verdict_of(outcome);
  EXPECT_EQ(verdict.verdict, Verdict::Came::failed);
  EXPECT_EQ(verdict.exit, 3);
  EXPECT_EQ(verdict.sentence, "diverged");
}

TEST(VerdictFile, HasTheNamedKeysInTheirOrderAndReadsBack) {
  Verdict verdict;
  verdict.kind = "size";
  verdict.judge(true);
  verdict.codes = {"drives.over-rating"};
  verdict.counts = {{"candidates", 12}};
  verdict.scenarios = {"scenes/a.yaml"};
  const auto json = json_of(verdict);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  keys.resize(9);
  EXPECT_THAT(keys, ElementsAre("format", "kind", "verdict", "exit", "sentence", "codes", "counts",
                                "scenarios", "files"));
  EXPECT_EQ(json["verdict"], "passed");
  EXPECT_TRUE(json["counts"]["candidates"].is_number_integer());
  EXPECT_EQ(json["counts"]["candidates"], 12);
  Verdict back;
  take_json(json, back);
  EXPECT_EQ(back, verdict);
}

TEST(VerdictFile, ListsWhatWillStandInTheFolder) {
  const TestFolder folder;
  Problems problems;
  OutputFolder out(folder / "out", "sweep", {"kept", "a.csv", "old.csv", verdict_file}, problems);
  out.begin();
  write_file(out.add("old.csv"), "old");
  write_file(out.add("kept"), "k");
  out.begin_aside({"kept"});
  write_file(out.add("a.csv"), "new");
  write_verdict({}, out);
  out.finish();
  const auto verdict = read_verdict(folder / "out");
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->kind, "sweep");
  EXPECT_THAT(verdict->files, ElementsAre("a.csv", "kept", "verdict.json"));
  for (const auto& file : verdict->files) EXPECT_TRUE(std::filesystem::exists(folder / "out" / file)) << file;
}

}  // namespace
}  // namespace drycut::sim::record
