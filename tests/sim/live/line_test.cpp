// A line that runs live: what it is asked acts at its step, and what it tells is so.
#include <future>

#include "tests/sim/live/live_bench.hpp"

namespace drycut::sim::live {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

struct LiveLine : testing::Test {
  LiveLine() { options.scenario = folder.file("web.yaml", web_alone); }

  double value(const News& news, const LineDescription& line, const std::string& name) {
    for (std::size_t i = 0; i < line.targets.size(); ++i)
      if (line.targets[i].name == name) return news.values.at(i);
    ADD_FAILURE() << name;
    return 0;
  }

  TestFolder folder;
  Line::Options options{.scenario = {}, .set = {}, .pace = 0, .running = false, .record = {}};
};

TEST_F(LiveLine, TellsWhatThereIs) {
  RunningLine line(options);
  const auto told = line.description();
  EXPECT_EQ(told->run, 1);
  EXPECT_EQ(told->title, "A web");
  EXPECT_EQ(told->scenario, "web.yaml");
  EXPECT_EQ(told->step, millisecond);
  EXPECT_EQ(told->duration, 2 * second);
  EXPECT_THAT(told->targets, Contains(Field(&LineDescription::Target::name, "web.speed")));
  EXPECT_THAT(told->channels, Contains(Field(&LineDescription::Channel::name, "web.position")));
  EXPECT_THAT(told->faults, Contains(Field(&LineDescription::Fault::component, "web.wheel")));
  EXPECT_THAT(told->checks, Contains("slow enough"));
  EXPECT_EQ(told->machine.substr(0, 4), "glTF");
  EXPECT_GT(told->parts.size(), 0U);
  EXPECT_EQ(line.until([](const News&) { return true; })->poses.size(), told->parts.size());
}

TEST_F(LiveLine, StandsStillUntilItIsAsked) {
  RunningLine line(options);
  EXPECT_EQ(line.until([](const News&) { return true; })->time, 0);
  EXPECT_THAT(line.ask(Advance{millisecond}), testing::IsEmpty());
  const auto there = line.until([](const News& news) { return !news.running && news.time > 0; });
  EXPECT_EQ(there->time, millisecond);
  line.ask(Advance{50 * millisecond});
  EXPECT_EQ(line.until([](const News& news) { return !news.running && news.time > millisecond; })->time,
            51 * millisecond);
}

TEST_F(LiveLine, GoesOnToTheNextEvent) {
  RunningLine line(options);
  line.ask(UntilEvent{"timeline.set"});
  const auto there = line.until([](const News& news) { return !news.running && news.time > 0; });
  EXPECT_EQ(there->time, 101 * millisecond);  // behind the step that begins at 0.1 s
}

TEST_F(LiveLine, WhatIsDoneActsAtTheNextStep) {
  RunningLine line(options);
  line.ask(Advance{200 * millisecond});
  line.until([](const News& news) { return !news.running && news.time > 0; });
  EXPECT_THAT(line.ask(Act{R"({"set": {"web.speed": "45 m/min"}})"}), testing::IsEmpty());
  line.ask(Advance{millisecond});
  const auto after = line.until([](const News& news) { return news.time == 201 * millisecond; });
  EXPECT_NEAR(value(*after, *line.description(), "web.speed"), 45, 1e-9);
  ASSERT_EQ(after->events.size(), 1U);
  EXPECT_EQ(after->events[0].text, "web.speed = 45 m/min");
  EXPECT_EQ(after->events[0].time, 200 * millisecond);
}

TEST_F(LiveLine, WhatDoesNotFitIsToldAndNothingHappens) {
  struct Case {
    const char* act;
    const char* told;
  };
  const Case cases[] = {
      {R"({"set": {"web.sped": 1}})",
       "act:1:11: nothing called 'web.sped' can be set; did you mean web.speed? [timeline.nothing-to-set]"},
      {R"({"set": {"web.speed": "3 s"}})", "web.speed"},
      {R"({"set": {"web.position": 1}})", "it can only be read"},
      {R"({"ramp": {"web.speed": "3 m/min"}})", "ramp has no duration"},
      {R"({"fault": {"web.wheel": {"no_such": 1}}})", "offers no fault 'no_such'"},
      {R"({"power": false})", "there is no controller to switch"},
      {R"({"at": "5 s", "set": {"web.speed": "3 m/min"}})", "acts now, and once; leave at out"},
      {R"({"when": "1 > 0", "set": {"web.speed": "3 m/min"}})", "leave when out"},
      {R"({})", "does nothing"},
      {R"({"set": {}})", "act:1:3: act.set is empty"},
      {R"({"ramp": {}, "over": "1 s"})", "act:1:3: act.ramp is empty"},
      {R"({"fault": {}})", "act:1:3: act.fault is empty"},
      {R"({"set": {"web.speed": "3 m/min"}, "fault": {}})", "act.fault is empty"},
      {R"([1])", "act"},
      {R"({"set": )", "act:1:"},
  };
  RunningLine line(options);
  for (const auto& [act, told] : cases) EXPECT_THAT(lines_of(line.ask(Act{act})), HasSubstr(told)) << act;
  line.ask(Advance{50 * millisecond});
  const auto after = line.until([](const News& news) { return news.time == 50 * millisecond; });
  EXPECT_THAT(after->events, testing::IsEmpty());
  EXPECT_NEAR(value(*after, *line.description(), "web.speed"), 60, 1e-9);
}

TEST_F(LiveLine, SamplesEachOnesChannelsEveryCycle) {
  options.pace = 1;
  RunningLine line(options);
  EXPECT_THAT(lines_of(line.ask(Sample{{"web.sped"}})), HasSubstr("did you mean web.speed?"));
  EXPECT_THAT(lines_of(line.ask(Sample{std::vector<std::string>(257, "web.speed")})),
              HasSubstr("256 at most"));
  line.ask(Sample{{"web.position", "web.speed"}});
  std::vector<Time> times;
  line.ask(Advance{20 * millisecond});
  line.until([&](const News& news) {
    for (const auto time : news.samples.times)  // while it stands still, what is written is seen too
      if (time > (times.empty() ? 0 : times.back())) times.push_back(time);
    if (!news.samples.times.empty()) {
      EXPECT_THAT(*news.samples.names, ElementsAre("web.position", "web.speed"));
      EXPECT_EQ(news.samples.rows.size(), 2 * news.samples.times.size());
    }
    return !news.running && news.time > 0;
  });
  ASSERT_EQ(times.size(), 20U);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(times[i], static_cast<Time>(i + 1) * millisecond);
}

TEST_F(LiveLine, WhoHasGoneIsSampledForNoLonger) {
  RunningLine line(options);
  line.line->ask({1000, Sample{{"web.position"}}});
  line.ask(Sample{{"web.speed"}});
  line.line->ask({1000, Leave{}});
  line.ask(Advance{10 * millisecond});
  const auto after = line.until(
      [](const News& news) { return news.time == 10 * millisecond && !news.samples.times.empty(); });
  EXPECT_THAT(*after->samples.names, ElementsAre("web.speed"));
}

const std::string with_program = R"(scene: {title: A program, step: 1 ms, duration: 2 s}
plants: {web: {type: web, speed: 0 m/min}}
controller: {plcopen: {program: p.st, cycle: 1 ms}}
wiring: {IX0.0: panel.go, IX0.1: panel.stay}
panel: {push_buttons: [go]}
timeline: [{at: 1 s, ramp: {web.speed: 90 m/min}, over: 1 s}, {at: 1.9 s, set: {web.speed: 2 m/s}}]
)";
const std::string program_of_two = R"(PROGRAM p
VAR go AT %IX0.0 : BOOL; stay AT %IX0.1 : BOOL; n : DINT; a : ARRAY [1..3] OF DINT; END_VAR
IF go THEN
  n := n + a[2];
END_IF
END_PROGRAM
)";

TEST_F(LiveLine, TellsItsProgramsAndWhereTheyStandToWhoAsks) {
  folder.file("p.st", program_of_two);
  options.scenario = folder.file("program.yaml", with_program);
  RunningLine line(options);
  const auto told = line.description();
  ASSERT_EQ(told->programs.size(), 1U);
  EXPECT_EQ(told->programs[0].text, program_of_two);
  EXPECT_THAT(told->programs[0].values.at(4), ElementsAre("n", "a[2]"));
  EXPECT_THAT(told->channels, Contains(testing::AllOf(Field(&LineDescription::Channel::name, "a[2]"),
                                                      Field(&LineDescription::Channel::writable, true))));
  line.ask(Advance{10 * millisecond});
  EXPECT_FALSE(line.until([](const News& news) { return news.time == 10 * millisecond; })->programs);
  line.line->ask({1000, Sample{{"n", "a[2]"}, 2, true}});
  line.ask(Advance{10 * millisecond});
  const auto idle = line.until([](const News& news) { return news.time == 20 * millisecond; });
  ASSERT_TRUE(idle->programs);
  EXPECT_THAT(idle->programs->scanned, ElementsAre("  -   "));
  line.ask(Act{R"({"set": {"panel.go": 1}})"});
  line.ask(Advance{10 * millisecond});
  const auto busy = line.until([](const News& news) { return news.time == 30 * millisecond; });
  EXPECT_THAT(busy->programs->scanned, ElementsAre("  ++  "));
  // A new run is watched as the old one was.
  line.ask(Restart{});
  line.ask(Advance{10 * millisecond});
  const auto again =
      line.until([](const News& news) { return news.run == 2 && news.time == 10 * millisecond; });
  EXPECT_THAT(again->programs->scanned, ElementsAre("  -   "));
  line.line->ask({1000, Sample{{"n"}, 1, false}});
  line.ask(Advance{10 * millisecond});
  EXPECT_FALSE(line.until([](const News& news) { return news.time == 20 * millisecond; })->programs);
}

TEST_F(LiveLine, TellsWhatIsPushedAndHowFarSettingsGo) {
  folder.file("p.st", program_of_two);
  options.scenario = folder.file("program.yaml", with_program);
  RunningLine line(options);
  const auto told = line.description();
  const auto target = [&](const std::string& name) {
    for (const auto& one : told->targets)
      if (one.name == name) return one;
    ADD_FAILURE() << name;
    return LineDescription::Target{};
  };
  EXPECT_EQ(target("panel.go").push, true);
  EXPECT_EQ(target("panel.stay").push, false);
  EXPECT_NEAR(target("web.speed").used, 120, 1e-9);           // 2 m/s
  EXPECT_NEAR(target("web.drive.damping").used, 2800, 1e-6);  // its own value
}

TEST_F(LiveLine, ASettingThatNobodyUsesGoesAsFarAsItsUsualValue) {
  auto still = web_alone;
  still.replace(still.find("60 m/min"), 8, "0 m/min");
  still.replace(still.find("timeline"), still.find("checks") - still.find("timeline"), "timeline: []\n");
  options.scenario = folder.file("still.yaml", still);
  RunningLine line(options);
  const auto told = line.description();
  for (const auto& target : told->targets) {
    if (target.name == "web.speed") {
      EXPECT_NEAR(target.used, 60, 1e-9);
    }
    EXPECT_FALSE(target.push);
  }
}

TEST_F(LiveLine, APushButtonIsASwitchOfThePanel) {
  folder.file("p.st", program_of_two);
  auto wrong = with_program;
  wrong.replace(wrong.find("[go]"), 4, "[goo, web]");
  options.scenario = folder.file("program.yaml", wrong);
  Problems problems;
  const Line line(options, problems);
  EXPECT_THAT(lines_of(problems),
              HasSubstr("program.yaml:5:24: the panel has no switch 'goo'; did you mean go?"));
  EXPECT_EQ(problems.size(), 2U);
}

TEST_F(LiveLine, RestartsFromTimeZeroWithTheFilesReadAgain) {
  RunningLine line(options);
  line.ask(Advance{20 * millisecond});
  line.until([](const News& news) { return news.time == 20 * millisecond; });
  folder.file("web.yaml", "scene: {step: 1 ms\n");
  EXPECT_THAT(line.ask(Restart{}), testing::Not(testing::IsEmpty()));
  EXPECT_EQ(line.until([](const News&) { return true; })->run, 1);  // the one that runs stays
  auto other = web_alone;
  other.replace(other.find("A web"), 5, "Other");
  folder.file("web.yaml", other);
  EXPECT_THAT(line.ask(Restart{}), testing::IsEmpty());
  const auto fresh = line.until([](const News& news) { return news.run == 2; });
  EXPECT_EQ(fresh->time, 0);
  EXPECT_EQ(line.description()->title, "Other");
}

// It is made only where something has changed, but then always.
TEST_F(LiveLine, TheMachineOfARestartIsWhatTheFilesSayNow) {
  const auto triangle = [](int length) {
    return fmt::format(
        "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex {} 0 0\nvertex 0 10 0\n"
        "endloop\nendfacet\nendsolid x\n",
        length);
  };
  RunningLine line(options);
  int run = 1;
  const auto restarted = [&] {
    EXPECT_THAT(line.ask(Restart{}), testing::IsEmpty());
    ++run;
    line.until([&](const News& news) { return news.run == run; });
    return *line.description();
  };
  const auto first = line.description()->machine;
  const auto same = restarted();
  EXPECT_EQ(same.machine, first);
  EXPECT_EQ(same.parts, line.description()->parts);
  auto text = web_alone;
  text.replace(text.find("type: web"), 9, "type: web, wheel: {circumference: 300 mm}");
  folder.file("web.yaml", text);
  const auto wider = restarted().machine;
  EXPECT_NE(wider, first);
  folder.file("part.stl", triangle(10));
  folder.file("web.yaml", text + "pictures: {meshes: {web.measuring wheel: {file: part.stl}}}\n");
  const auto own = restarted().machine;
  EXPECT_NE(own, wider);
  EXPECT_EQ(restarted().machine, own);
  folder.file("part.stl", triangle(20));
  EXPECT_NE(restarted().machine, own);
}

// Events that a flood of acts makes do not grow without end, and those of the machine come through.
TEST_F(LiveLine, TellsTheLatestOfTooManyEvents) {
  RunningLine line(options);
  constexpr std::size_t acts = 400;
  for (std::size_t i = 0; i < acts; ++i) line.ask(Act{R"({"set": {"web.speed": "45 m/min"}})"});
  line.ask(Advance{millisecond});
  const auto after = line.until([](const News& news) { return !news.running && news.time == millisecond; });
  EXPECT_EQ(after->events.size(), 100U);
  EXPECT_EQ(after->events.size() + after->events_left_out, acts);
}

TEST_F(LiveLine, SamplesNoMoreThanItHasTimeFor) {
  options.scenario = folder.file("plc.yaml",
                                 "scene: {duration: 1 s}\nplants: {bench: {type: bench}}\n"
                                 "controller: {lx3vp: {program: p.il}}\n");
  folder.file("p.il", "END\n");
  RunningLine line(options);
  const auto registers = [](int from) {
    std::vector<std::string> names;
    for (int i = 0; i < 256; ++i) names.push_back("D" + std::to_string(from + i));
    return names;
  };
  for (int client = 0; client < 4; ++client) {
    EXPECT_THAT(line.ask(Sample{registers(1000 * client)}), testing::IsEmpty());
    EXPECT_THAT(line.ask(Sample{registers(1000 * client)}), testing::IsEmpty()) << "the same once more";
  }
  EXPECT_THAT(lines_of(line.ask(Sample{registers(5000)})), HasSubstr("1024 at most for all pages together"));
  EXPECT_EQ(line.ask(Sample{std::vector<std::string>(100, "no")}).size(), 16U) << "of a hundred slips";
}

TEST_F(LiveLine, StopsBeforeItDoesWhatWaits) {
  RunningLine line(options);
  std::promise<void> go;
  line.line->ask({0, Visit{[&](LineRun&) { go.get_future().wait(); }}});
  bool visited = false;
  line.line->ask({0, Visit{[&](LineRun&) { visited = true; }}});
  line.line->stop();
  go.set_value();
  line.stop();
  EXPECT_FALSE(visited);
}

TEST_F(LiveLine, KeepsItsPace) {
  options.pace = 10;
  options.running = true;
  RunningLine line(options);
  const auto first = line.until([](const News& news) { return news.time > 0; });
  const auto begin = std::chrono::steady_clock::now();
  const auto later = line.until([&](const News& news) { return news.time >= first->time + 2 * second; });
  // Not faster than its pace; how much slower is the machine's business.
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(took.count() + 0.1, seconds(later->time - first->time) / 10 - later->punctuality.worst);
  EXPECT_GT(later->punctuality.cycles, 0U);
}

// Others come and go; the curves have every cycle all the same.
TEST_F(LiveLine, WhoChoosesChannelsTakesNothingFromTheOthers) {
  RunningLine line(options);
  line.ask(Sample{{"web.position"}});
  line.ask(Go{true});
  for (int i = 0; i < 50; ++i) line.ask(Sample{{i % 2 == 0 ? "web.speed" : "web.lead"}});
  line.ask(Go{false});
  std::vector<Time> times;
  line.until([&](const News& news) {
    times.insert(times.end(), news.samples.times.begin(), news.samples.times.end());
    return !news.running && times.size() > 1;
  });
  ASSERT_GT(times.size(), 2U);
  for (std::size_t i = 2; i + 1 < times.size(); ++i)
    ASSERT_EQ(times[i] - times[i - 1], times[2] - times[1]) << i;
}

TEST_F(LiveLine, DoesNotWaitForAnEventThatNothingReports) {
  RunningLine line(options);
  const auto problems = line.ask(UntilEvent{"timeline.sett"});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(to_string(problems.front()),
            "event:1:1: nothing here reports an event 'timeline.sett'; did you mean timeline.set? "
            "[scenario.unknown-event]");
  EXPECT_FALSE(line.until([](const News&) { return true; })->running);
}

TEST_F(LiveLine, ChecksAreToldAsTheyStand) {
  RunningLine line(options);
  line.ask(Advance{500 * millisecond});
  line.until([](const News& news) { return news.time == 500 * millisecond; });
  line.ask(Act{R"({"set": {"web.speed": "120 m/min"}})"});
  line.ask(Advance{2500 * millisecond});
  const auto after = line.until([](const News& news) { return news.time == 3 * second && news.outcome; });
  ASSERT_FALSE(after->outcome->checks.empty());
  EXPECT_EQ(after->outcome->checks[0].name, "slow enough");
  EXPECT_FALSE(after->outcome->checks[0].passed);
}

TEST_F(LiveLine, TellsAllThatIsWrongWithTheScenario) {
  Problems problems;
  options.set = {{"plants.web.speed", "3 s"}, {"record.every", "7 us"}};
  const Line line(options, problems);
  EXPECT_EQ(problems.size(), 2U) << lines_of(problems);
}

}  // namespace
}  // namespace drycut::sim::live
