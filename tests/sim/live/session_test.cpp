// A live session run again is the same bytes; a file that is none is told where.
#include "sim/live/session.hpp"
#include "sim/cli/live_command.hpp"
#include "sim/cli/run_command.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/live/live_bench.hpp"

namespace drycut::sim::live {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct LiveSession : CommandTest {
  /// A session of the knife line with its program: start, a ramp, a fault, power off and on.
  void record_knife() {
    Line::Options options{.scenario = source_root / "scenes/rotary_knife.yaml",
                          .set = {{"variables.length", "700 mm"}},
                          .pace = 0,
                          .running = false,
                          .record = folder / "record"};
    RunningLine line(options);
    const auto go = [&](Time by) {
      const auto from = line.until([](const News&) { return true; })->time;
      line.ask(Advance{by});
      line.until([&](const News& news) { return !news.running && news.time == from + by; });
      line.ask(Go{false});  // news to look at
    };
    go(2500 * millisecond);
    for (const auto* act : {R"({"ramp": {"web.speed": "80 m/min"}, "over": "300 ms"})",
                            R"({"fault": {"knife.encoder": {"lose_counts": 20}}})"}) {
      EXPECT_EQ(lines_of(line.ask(Act{act})), "");
      go(700 * millisecond + 100 * microsecond);
    }
    EXPECT_EQ(lines_of(line.ask(Act{R"({"power": false})"})), "");
    go(33 * millisecond);
    EXPECT_EQ(lines_of(line.ask(Act{R"({"power": true, "set": {"slLength": 900}})"})), "");
    go(500 * millisecond);
    line.ask(Restart{});
    line.ask(Advance{100 * millisecond});
    line.until([](const News& news) { return news.run == 2 && news.time == 100 * millisecond; });
  }
  int replay(const fs::path& session) {
    cli::ReplayOptions options;
    options.session = session;
    options.out = folder / "again";
    options.pictures = false;
    return captured([&] { return cli::replay_session(options); });
  }
  void expect_same(const fs::path& one, const fs::path& other) {
    for (const auto* file : {"trace.csv", "events.csv"}) {
      EXPECT_THAT(bytes_of(one / file), testing::StartsWith("time [s],"));
      EXPECT_EQ(bytes_of(one / file), bytes_of(other / file)) << file;
    }
  }

  TestFolder folder;
};

TEST_F(LiveSession, RunAgainIsTheSameBytes) {
  record_knife();
  replay(folder / "record/1");
  EXPECT_EQ(err, "");
  EXPECT_THAT(out, testing::Not(HasSubstr("may differ")));
  EXPECT_THAT(bytes_of(folder / "record/1/events.csv"), HasSubstr("knife.encoder.lose_counts = 20"));
  expect_same(folder / "record/1", folder / "again/session");
  replay(folder / "record/2");
  expect_same(folder / "record/2", folder / "again/session");
}

TEST_F(LiveSession, EveryRunTakesTheNextFolder) {
  const auto scenario = folder.file("web.yaml", web_alone);
  const auto run = [&] {
    RunningLine line(
        {.scenario = scenario, .set = {}, .pace = 0, .running = false, .record = folder / "record"});
    line.ask(Advance{10 * millisecond});
  };
  run();
  const auto first = bytes_of(folder / "record/1/session.yaml");
  fs::create_directory(folder / "record/2");  // somebody else's
  run();
  EXPECT_EQ(bytes_of(folder / "record/1/session.yaml"), first);
  EXPECT_TRUE(fs::is_empty(folder / "record/2"));
  EXPECT_THAT(bytes_of(folder / "record/3/session.yaml"), testing::StartsWith("- {scenario: "));
}

TEST_F(LiveSession, BecomesAScenario) {
  const auto scenario = folder.file("web.yaml", web_alone);
  {
    RunningLine line(
        {.scenario = scenario, .set = {}, .pace = 0, .running = false, .record = folder / "record"});
    line.ask(Advance{200 * millisecond});
    line.until([](const News& news) { return news.time == 200 * millisecond; });
    line.ask(Act{R"({"set": {"web.speed": "0.1 m/s"}})"});
    line.ask(Advance{200 * millisecond});
    line.until([](const News& news) { return news.time == 400 * millisecond; });
  }
  cli::ReplayOptions options;
  options.session = folder / "record/1";
  options.to_scenario = folder / "own.yaml";
  ASSERT_EQ(captured([&] { return cli::replay_session(options); }), cli::all_passed) << err;
  cli::RunOptions run;
  run.scenarios = {folder / "own.yaml"};
  run.out = folder / "out";
  run.pictures = false;
  EXPECT_EQ(captured([&] { return cli::run_scenarios(run); }), cli::all_passed) << err;
  expect_same(folder / "record/1", folder / "out/own");
}

TEST_F(LiveSession, WhatWasCutShortEndsThere) {
  folder.file("web.yaml", web_alone);
  const auto session = folder.file("session.yaml",
                                   "- {scenario: web.yaml, set: [], fingerprint: 0}\n"
                                   "- {at: 300 ms, set: {web.speed: 10 m/min}}\n"
                                   "- {reached: 1 s}\n"
                                   "- {at: 1.2 s, set: {web.sp");
  std::vector<std::string> notes;
  Problems problems;
  const auto scenario = read_session(session, notes, problems);
  ASSERT_TRUE(scenario) << lines_of(problems);
  EXPECT_EQ(scenario->scene.duration, second);
  EXPECT_EQ(scenario->timeline.size(), 2U);
  ASSERT_EQ(notes.size(), 1U);  // another fingerprint
  EXPECT_THAT(notes[0], HasSubstr("is not what it was"));
}

TEST_F(LiveSession, EveryFaultIsToldWithItsPlace) {
  folder.file("web.yaml", web_alone);
  const auto session = folder.file("session.yaml",
                                   "- {scenario: web.yaml, set: [speed], fingerprint: 0}\n"
                                   "- {at: 300 ms, set: {web.speed: 10 m/min}, every: 1 s}\n"
                                   "nothing\n"
                                   "- [1, 2]\n"
                                   "- {at: 3 bananas, set: {web.speed: 10 m/min}}\n"
                                   "- {set: {web.speed: 10 m/min}}\n"
                                   "- {reached: soon}\n");
  std::vector<std::string> notes;
  Problems problems;
  EXPECT_FALSE(read_session(session, notes, problems));
  std::vector<int> lines;
  lines.reserve(problems.size());
  for (const auto& problem : problems) lines.push_back(problem.line);
  EXPECT_THAT(lines, testing::ElementsAre(1, 2, 3, 4, 5, 6, 7)) << lines_of(problems);
  for (const auto& problem : problems) EXPECT_EQ(problem.file, session.string());
}

TEST_F(LiveSession, AnActThatDoesNotFitIsToldInTheSession) {
  folder.file("web.yaml", web_alone);
  const auto session = folder.file("session.yaml",
                                   "- {scenario: web.yaml, set: [], fingerprint: 0}\n"
                                   "- {at: 300 ms, set: {web.sped: 10 m/min}}\n"
                                   "- {reached: 1 s}\n");
  EXPECT_EQ(replay(session), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("session.yaml:2:22: nothing called 'web.sped' can be set"));
}

TEST_F(LiveSession, WhatIsNoneIsTold) {
  EXPECT_EQ(replay(folder / "nowhere"), cli::bad_input);
  EXPECT_EQ(replay(folder.file("web.yaml", web_alone)), cli::all_passed);  // a scenario: it has no session
  EXPECT_EQ(replay(folder.file("session.yaml", "")), cli::bad_input);
}

}  // namespace
}  // namespace drycut::sim::live
