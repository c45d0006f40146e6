// How a round's runs are given to an engine: one that plays what clusters do, chunk after chunk.
#include "sim/studies/cluster/dispatch.hpp"

#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace drycut::sim::cluster {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// Runs a chunk at each wait(); a run is answered by its number, 0.1 s a run.
class PlayedEngine final : public Engine {
 public:
  /// How often a run still kills its process; whether the process ends before its first run, and how often;
  /// whether an engine's restart of a lost chunk is seen.
  std::map<std::size_t, int> kills;
  int blank = 0;
  std::string refused;
  bool restarts = false;
  bool mute = false;  ///< nothing is heard of a chunk that dies but its end

  std::vector<std::vector<std::size_t>> chunks_seen;
  std::map<std::size_t, int> begun;

  void submit(const std::string& /*name*/, const std::string& bundle,
              const std::vector<Chunk>& chunks) override {
    EXPECT_FALSE(bundle.empty());
    waiting_.insert(waiting_.end(), chunks.begin(), chunks.end());
    most_ = std::max(most_, waiting_.size());
  }
  std::vector<WorkNews> wait() override {
    EXPECT_FALSE(waiting_.empty());
    const auto chunk = waiting_.front();
    waiting_.erase(waiting_.begin());
    news_.clear();
    if (!refused.empty()) return {{chunk.number, json{{"refused", refused}}.dump(), false, ""}};
    chunks_seen.emplace_back();
    for (const auto& item : items_of(chunk)) chunks_seen.back().push_back(item);
    if (blank > 0 && blank-- > 0) return {{chunk.number, "", true, "no such program"}};
    while (!run(chunk)) {
      if (restarts) continue;
      if (mute) news_.clear();
      news_.push_back({chunk.number, R"({"item": 4, "ans)", false, ""});  // cut short
      news_.push_back({chunk.number, "", true, "signal 9"});
      return news_;
    }
    news_.push_back({chunk.number, "", true, ""});
    return news_;
  }
  [[nodiscard]] int workers() const override { return 2; }
  [[nodiscard]] std::size_t room() const override { return 8; }
  [[nodiscard]] double chunk_seconds() const override { return 1; }
  [[nodiscard]] std::size_t most() const { return most_; }

 private:
  static std::vector<std::size_t> items_of(const Chunk& chunk) {
    std::vector<std::size_t> items;
    std::istringstream lines(chunk.items);
    for (std::string line; std::getline(lines, line);) {
      const auto item = json::parse(line);
      EXPECT_EQ(item.at("ask"), "ask " + item.at("item").dump());
      items.push_back(item.at("item"));
    }
    return items;
  }
  bool run(const Chunk& chunk) {
    for (const auto item : items_of(chunk)) {
      ++begun[item];
      news_.push_back({chunk.number, json{{"item", item}}.dump(), false, ""});
      if (kills[item] > 0) {
        --kills[item];
        return false;
      }
      news_.push_back({chunk.number,
                       json{{"item", item}, {"answer", std::to_string(item)}, {"seconds", 0.1}}.dump(), false,
                       ""});
    }
    return true;
  }

  std::vector<Chunk> waiting_;
  std::vector<WorkNews> news_;
  std::size_t most_ = 0;
};

struct ClusterDispatch : testing::Test {
  void run(std::size_t count) {
    Round round{"point", "{}", count, {}, {}};
    round.ask = [&](std::size_t i) -> std::optional<Ask> {
      if (known.contains(i)) return {};
      return Ask{"ask " + std::to_string(i), {}};
    };
    round.take = [&](std::size_t i, const WorkerAnswer& answer) {
      EXPECT_TRUE(answers.emplace(i, answer.text).second) << i << " is answered twice";
      if (!answer.lost.empty()) lost[i] = answer.lost;
    };
    dispatch(round, engine, 2);
  }
  void expect_all(std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (known.contains(i)) continue;
      ASSERT_TRUE(answers.contains(i)) << i;
      EXPECT_EQ(answers.at(i), lost.contains(i) ? "" : std::to_string(i));
    }
  }

  PlayedEngine engine;
  std::set<std::size_t> known;
  std::map<std::size_t, std::string> answers;
  std::map<std::size_t, std::string> lost;
};

TEST_F(ClusterDispatch, SingleRunsFirstThenChunksOfTheirCost) {
  known = {3, 50};
  run(100);
  expect_all(100);
  EXPECT_EQ(answers.size(), 98U);
  EXPECT_EQ(engine.chunks_seen[0].size(), 1U);
  EXPECT_EQ(engine.chunks_seen[1].size(), 1U);
  // 1 s of runs of 0.1 s; less to the end, so that both have something.
  EXPECT_EQ(engine.chunks_seen[2].size(), 10U);
  EXPECT_LT(engine.chunks_seen.back().size(), 4U);
  EXPECT_LE(engine.most(), engine.room());
  // The next round knows.
  answers.clear();
  engine.chunks_seen.clear();
  run(100);
  EXPECT_EQ(engine.chunks_seen[0].size(), 10U);
}

TEST_F(ClusterDispatch, AKilledChunkGoesAgainWithoutWhatItHadAnswered) {
  engine.kills[25] = 1;
  run(60);
  expect_all(60);
  EXPECT_TRUE(lost.empty());
  for (const auto& [item, times] : engine.begun) EXPECT_EQ(times, item == 25 ? 2 : 1) << item;
}

TEST_F(ClusterDispatch, APoisonedRunIsTriedThreeTimesAndAloneAfterTheFirst) {
  engine.kills[25] = 99;
  run(60);
  expect_all(60);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.at(25), "whoever ran it died, 3 times: signal 9");
  for (const auto& [item, times] : engine.begun) EXPECT_EQ(times, item == 25 ? 3 : 1) << item;
  int alone = 0;
  for (const auto& chunk : engine.chunks_seen) alone += chunk == std::vector<std::size_t>{25} ? 1 : 0;
  EXPECT_EQ(alone, 2);
}

TEST_F(ClusterDispatch, WhatTheEngineStartsAgainItselfCountsToo) {
  engine.restarts = true;
  engine.kills[25] = 3;  // the fourth time it would run
  run(60);
  expect_all(60);
  EXPECT_THAT(lost.at(25), HasSubstr("its machine was lost"));
  EXPECT_EQ(lost.size(), 1U);
}

TEST_F(ClusterDispatch, AChunkThatDiesWithoutAWordIsHalvedUntilItIsKnownWho) {
  engine.mute = true;
  engine.kills[25] = 99;
  run(60);
  expect_all(60);
  EXPECT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.count(25), 1U);
}

TEST_F(ClusterDispatch, NothingRunsAnywhere) {
  engine.blank = 3;
  run(10);
  expect_all(10);
  engine.blank = 99;
  answers.clear();
  try {
    run(100);
    FAIL() << "it went on";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("4 chunks in a row ended before their first run: no such program"));
  }
}

TEST_F(ClusterDispatch, AnotherProgramEndsIt) {
  engine.refused = "node7 has drycut 0.0.9";
  EXPECT_THROW(run(10), std::runtime_error);
}

TEST(ClusterEngines, AreNamed) {
  for (const auto* good : {"slurm", "slurm:short", "dask://head:8786", "dask://[::1]:1"})
    EXPECT_FALSE(engine_fault(good)) << good;
  for (const auto* bad : {"", "slurm:", "slurmy", "dask://", "dask://head", "dask://:8786", "dask://head:0",
                          "dask://head:65536", "dask://head:x", "tcp://head:8786"})
    EXPECT_TRUE(engine_fault(bad)) << bad;
}

}  // namespace
}  // namespace drycut::sim::cluster
