// A live session run again is the same bytes; a file that is none is told where.
#include "sim/live/session.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>

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
      EXPECT_THAT(bytes_of(one / file), testing::StartsWith("time [s]"));
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

// What pictures draw is recorded too.
TEST_F(LiveSession, RecordsWhatPlotsShow) {
  {
    RunningLine line(
        {.scenario = folder.file(
             "web.yaml",
             web_alone +
                 "pictures: {plots: [{name: lead, panels: [{title: Lead, channels: [web.lead]}]}]}\n"),
         .pace = 0,
         .running = false,
         .record = folder / "record"});
    line.ask(Advance{100 * millisecond});
    line.until([](const News& news) { return news.time == 100 * millisecond; });
  }
  replay(folder / "record/1");
  EXPECT_THAT(bytes_of(folder / "record/1/trace.csv"), HasSubstr("web.lead"));
  expect_same(folder / "record/1", folder / "again/session");
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

TEST_F(LiveSession, IsNotWrittenOverTheScenarioThatItExtends) {
  folder.file("web.yaml", web_alone);
  folder.file("own.yaml", "extends: web.yaml\n");
  const auto session =
      folder.file("session.yaml", "- {scenario: own.yaml, set: [], fingerprint: 0}\n- {reached: 1 s}\n");
  for (const auto* name : {"own.yaml", "web.yaml"}) {
    cli::ReplayOptions options;
    options.session = session;
    options.to_scenario = folder / name;
    options.force = true;
    EXPECT_EQ(captured([&] { return cli::replay_session(options); }), cli::bad_input);
    EXPECT_THAT(err, HasSubstr(std::string(name) + ":1:1: the session's scenario stands there"));
  }
  EXPECT_EQ(bytes_of(folder / "web.yaml"), web_alone);
}

TEST_F(LiveSession, OfAScenarioThatKeepsValuesItBecomesNone) {
  folder.file("kept.il", "END\n");
  folder.file("line.yaml",
              "scene: {step: 1 ms, duration: 1 s}\nplants: {bench: {type: bench}}\n"
              "controller: {lx3vp: {program: kept.il, retentive: kept.txt}}\n");
  const auto session =
      folder.file("session.yaml", "- {scenario: line.yaml, set: [], fingerprint: 0}\n- {reached: 1 s}\n");
  std::vector<Finding> notes;
  Problems problems;
  scenario_of_session(session, folder / "own.yaml", notes, problems);
  ASSERT_EQ(problems.size(), 1U) << lines_of(problems);
  EXPECT_THAT(problems.front().what, HasSubstr("line.yaml keeps retentive values"));
  EXPECT_EQ(notes.size(), 1U) << "another fingerprint";
}

TEST_F(LiveSession, WhatWasCutShortEndsThere) {
  folder.file("web.yaml", web_alone);
  const auto session = folder.file("session.yaml",
                                   "- {scenario: web.yaml, set: [], fingerprint: 0}\n"
                                   "- {at: 300 ms, set: {web.speed: 10 m/min}}\n"
                                   "- {reached: 1 s}\n"
                                   "- {at: 1.2 s, set: {web.sp");
  std::vector<Finding> notes;
  Problems problems;
  const auto replay = read_session(session, {}, notes, problems);
  ASSERT_TRUE(replay) << lines_of(problems);
  EXPECT_EQ(replay->reached, second);
  EXPECT_EQ(replay->scenario.timeline.size(), 2U);
  EXPECT_EQ(replay->acts, 1U);
  ASSERT_EQ(notes.size(), 1U);  // another fingerprint
  EXPECT_THAT(notes[0].text, HasSubstr("is not what it was"));
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
  std::vector<Finding> notes;
  Problems problems;
  EXPECT_FALSE(read_session(session, {}, notes, problems));
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

// A counter that survives: each power-up finds what the last one left.
TEST_F(LiveSession, KeepsRetentiveValuesAndBeginsAgainAsItDid) {
  folder.file("saw.il", "LD M8002\nINC D300\nEND\n");
  folder.file("kept.txt", "");
  const auto scenario = folder.file("line.yaml",
                                    "scene: {duration: 1 s}\nplants: {bench: {type: bench}}\n"
                                    "controller: {lx3vp: {program: saw.il, retentive: kept.txt}}\n"
                                    "record: {every: 10 ms, channels: [D300]}\n");
  const auto live = [&](Line::Options options) {
    options.pace = 0;
    options.running = false;
    options.record = folder / "record";
    RunningLine line(options);
    const auto begun = line.until([](const News&) { return true; })->time;
    line.ask(Advance{50 * millisecond});
    line.until([&](const News& news) { return news.time == begun + 50 * millisecond; });
    line.ask(Restart{});  // it is off and on again
    line.until([](const News& news) { return news.run == 2; });
  };
  const auto d300 = [&](const fs::path& run) {
    const auto text = bytes_of(run / "trace.csv");
    const auto last = text.find_last_of(',');
    return text.substr(last + 1, text.size() - last - 2);
  };
  live({.scenario = scenario});
  live({.scenario = scenario});
  EXPECT_EQ(d300(folder / "record/1"), "1");
  EXPECT_EQ(d300(folder / "record/3"), "2");  // the second run was off before its first scan
  const auto kept = bytes_of(folder / "kept.txt");
  EXPECT_THAT(kept, HasSubstr("D300 = 2"));
  // Again it is what it was, and leaves what there is now.
  replay(folder / "record/3");
  EXPECT_THAT(out, testing::Not(HasSubstr("may differ")));
  EXPECT_EQ(bytes_of(folder / "kept.txt"), kept);
  expect_same(folder / "record/3", folder / "again/session");
  live({.scenario = {}, .from = Line::Options::From{folder / "record/3/session.yaml", {}}});
  EXPECT_EQ(d300(folder / "record/5"), "2");
  EXPECT_EQ(bytes_of(folder / "kept.txt"), kept);
}

struct LiveFrom : LiveSession {
  void SetUp() override {
    scenario = folder.file("web.yaml", web_alone);
    RunningLine line({.scenario = scenario, .pace = 0, .running = false, .record = folder / "record"});
    go(line, 200 * millisecond);
    line.ask(Act{faster});
    go(line, 200 * millisecond);
  }
  void go(RunningLine& line, Time by) const {
    const auto from = line.until([](const News&) { return true; })->time;
    line.ask(Advance{by});
    line.until([&](const News& news) { return news.time == from + by; });
    line.ask(Go{false});
  }
  [[nodiscard]] Line::Options from(std::optional<Time> at) const {
    return {.scenario = {},
            .from = Line::Options::From{folder / "record/1/session.yaml", at},
            .pace = 0,
            .running = false,
            .record = folder / "record"};
  }
  const char* faster = R"({"set": {"web.speed": "0.1 m/s"}})";
  fs::path scenario;
};

TEST_F(LiveFrom, GoesOnFromATime) {
  // What was done at that time or later is to be done again.
  for (const auto at : {150, 200}) {
    RunningLine line(from(at * millisecond));
    if (at == 150) go(line, 50 * millisecond);
    line.ask(Act{faster});
    go(line, 200 * millisecond);
  }
  expect_same(folder / "record/1", folder / "record/2");
  expect_same(folder / "record/1", folder / "record/3");
}

TEST_F(LiveFrom, GoesOnFromTheEndAndOfItself) {
  {
    RunningLine line(from({}));
    EXPECT_EQ(line.until([](const News&) { return true; })->time, 400 * millisecond);
    line.ask(Act{R"({"set": {"web.speed": "0.2 m/s"}})"});
    go(line, 100 * millisecond);
    line.ask(Restart{});  // from there again
    EXPECT_EQ(line.until([](const News& news) { return news.run == 2; })->time, 400 * millisecond);
  }
  replay(folder / "record/2");
  EXPECT_THAT(out, testing::Not(HasSubstr("may differ")));
  expect_same(folder / "record/2", folder / "again/session");
  EXPECT_THAT(bytes_of(folder / "record/2/events.csv"), HasSubstr("web.speed = 0.1 m/s"));
  EXPECT_THAT(bytes_of(folder / "record/2/events.csv"), HasSubstr("web.speed = 0.2 m/s"));
}

TEST_F(LiveFrom, SlipsAreTold) {
  const auto told = [&](const std::string& session, const fs::path& file = {},
                        const std::vector<std::string>& set = {}) {
    cli::LiveOptions options;
    options.from = session;
    options.scenario = file;
    options.set = set;
    EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input);
    return err;
  };
  const auto session = (folder / "record/1").string();
  EXPECT_THAT(told(session + "@0.5s"), HasSubstr("the session ends at 400 ms, before 500 ms"));
  EXPECT_THAT(told(session + "@soon"), HasSubstr("--from:1:"));
  EXPECT_THAT(told(session + "@"), HasSubstr("--from:1:"));
  EXPECT_THAT(told(session + "x@0.1s"), HasSubstr("1x"));
  EXPECT_THAT(told(session, scenario), HasSubstr("both a scenario and a session"));
  EXPECT_THAT(told("", {}), HasSubstr("neither a scenario nor a session"));
  EXPECT_THAT(told(session, {}, {"scene.step=2 ms"}), HasSubstr("--set"));
}

TEST_F(LiveSession, WhatDidNothingIsPassedOver) {
  folder.file("web.yaml", web_alone);
  const auto session = folder.file("session.yaml",
                                   "- {scenario: web.yaml, set: [], fingerprint: 0}\n"
                                   "- {at: 300 ms}\n"
                                   "- {at: 400 ms, set: {web.speed: 10 m/min}}\n"
                                   "- {reached: 1 s}\n");
  std::vector<Finding> notes;
  Problems problems;
  const auto replay = read_session(session, {}, notes, problems);
  ASSERT_TRUE(replay) << lines_of(problems);
  EXPECT_EQ(replay->acts, 1U);
}

// A run tells the same wherever it is started: programs are called what the scenario calls them.
TEST_F(LiveSession, ErrorsNameProgramsAsTheScenarioDoes) {
  struct Case {
    std::string controller;
    std::string file;
    std::string program;
    std::string told;
  };
  const Case cases[] = {
      {"lx3vp", "p.il", "LD M8000\nDIV D0 D1 D2\nEND\n", "sub/p.il:2: 6706"},
      {"plcopen", "p.st", "PROGRAM p\nVAR x, y : INT; END_VAR\nx := 1 / y;\nEND_PROGRAM\n", "sub/p.st:3:"},
  };
  fs::create_directory(folder / "sub");
  int number = 0;
  for (const auto& [controller, file, program, told] : cases) {
    folder.file("sub/" + file, program);
    const auto scenario =
        folder.file("line.yaml", fmt::format("scene: {{duration: 1 s}}\nplants: {{bench: {{type: "
                                             "bench}}}}\ncontroller: {{{}: {{program: sub/{}}}}}\n",
                                             controller, file));
    {
      RunningLine line({.scenario = fs::proximate(scenario),
                        .set = {},
                        .pace = 0,
                        .running = false,
                        .record = folder / "record"});
      line.ask(Advance{50 * millisecond});
      line.until([](const News& news) { return news.time == 50 * millisecond; });
    }
    const auto session = folder / fmt::format("record/{}", ++number);
    EXPECT_THAT(bytes_of(session / "events.csv"), HasSubstr("," + told)) << controller;
    replay(session);
    expect_same(session, folder / "again/session");
  }
}

/// No file of this process grows beyond so many bytes, as on a disk that is full.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t most) : ignored_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{most, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, ignored_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
  void (*ignored_)(int);
};

TEST_F(LiveSession, AFullDiskEndsTheRecordAndNotTheLine) {
  const auto scenario = folder.file("web.yaml", web_alone);
  {
    RunningLine line(
        {.scenario = scenario, .set = {}, .pace = 0, .running = false, .record = folder / "record"});
    line.until([](const News&) { return true; });
    const SmallDisk disk(8192);
    EXPECT_EQ(lines_of(line.ask(Act{R"({"set": {"web.speed": "0.1 m/s"}})"})), "");
    line.ask(Advance{20 * second});
    const auto there = line.until([](const News& news) { return !news.running && news.time == 20 * second; });
    EXPECT_THAT(there->record_lost, testing::MatchesRegex("cannot write .*record/1/trace.csv: .*"));
    EXPECT_EQ(there->failure, "");
    EXPECT_EQ(lines_of(line.ask(Act{R"({"set": {"web.speed": "0.2 m/s"}})"})), "");
    line.ask(Advance{millisecond});
    EXPECT_EQ(line.until([](const News& news) { return !news.running && news.time > 20 * second; })->failure,
              "");
    line.stop();
    EXPECT_THAT(line.line->record_lost(), HasSubstr("trace.csv"));
  }
  // What there is, is what happened.
  const auto kept = bytes_of(folder / "record/1/trace.csv");
  EXPECT_GT(kept.size(), 4096U);
  EXPECT_EQ(kept.back(), '\n');
  replay(folder / "record/1");
  EXPECT_EQ(err, "");
  const auto again = bytes_of(folder / "again/session/trace.csv");
  const auto both = std::min(kept.size(), again.size());
  EXPECT_GT(both, 4096U);
  EXPECT_EQ(kept.substr(0, both), again.substr(0, both));
}

TEST_F(LiveSession, StatusSaysHowTheLineEnded) {
  cli::LiveOptions options;
  options.scenario = folder.file("web.yaml", web_alone);
  options.port = 0;
  options.record = folder / "record";
  options.ready = [](const auto&) { kill(getpid(), SIGINT); };
  EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::interrupted_status);
  EXPECT_EQ(err, "");
  options.record = folder / "lost";
  options.ready = [&](const auto&) {
    folder.file("lost", "a file where the folder was to be\n");
    kill(getpid(), SIGTERM);
  };
  EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::simulation_failed);
  EXPECT_THAT(err, testing::ContainsRegex("cannot make .*/lost"));
}

TEST_F(LiveSession, WhereNothingCanBeWrittenIsTold) {
  cli::LiveOptions options;
  options.scenario = folder.file("web.yaml", web_alone);
  options.ready = [](const auto&) { ADD_FAILURE(); };
  for (const auto* record : {"/dev/null", "/dev/null/record/today"}) {
    options.record = record;
    EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input) << record;
    EXPECT_THAT(err, testing::StartsWith("--record:1:1: ")) << record;
  }
}

// As many acts as a busy day has: each is touched when it is due, and then no more.
TEST_F(LiveSession, HasRoomForADay) {
  folder.file("web.yaml", web_alone);
  constexpr int acts = 100'000;
  std::string text = "- {scenario: web.yaml, set: [], fingerprint: 0}\n";
  for (int i = 1; i <= acts; ++i)
    text += fmt::format("- {{at: {} ms, set: {{web.speed: {} m/min}}}}\n", i, i % 60);
  text += "- {reached: 101 s}\n";
  EXPECT_EQ(replay(folder.file("session.yaml", text)), cli::all_passed) << err;
  const auto events = bytes_of(folder / "again/session/events.csv");
  EXPECT_EQ(std::count(events.begin(), events.end(), '\n'),
            acts + 2);  // and the heading, and the scenario's own
}

}  // namespace
}  // namespace drycut::sim::live
