// The way back: any moment of a run is seen as it was, and a run that goes on from one is the same bytes
// again.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <future>
#include <sstream>

#include "sim/cli/live_command.hpp"
#include "sim/live/moments.hpp"
#include "sim/live/protocol.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/live/live_bench.hpp"

namespace drycut::sim::live {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string text_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct LivePast : CommandTest {
  Line::Options knife() const {
    return {.scenario = source_root / "scenes/rotary_knife.yaml",
            .set = {{"variables.length", "700 mm"}},
            .pace = 0,
            .running = false,
            .record = folder / "record"};
  }
  static void go(RunningLine& line, Time until) {
    const auto now = line.until([](const News&) { return true; })->time;
    line.ask(Advance{until - now});
    line.until([&](const News& news) { return !news.running && news.time == until; });
    line.ask(Go{false});  // news to look at
  }
  /// What was to be seen then, or why it is not.
  static std::pair<Problems, Seen> look(RunningLine& line, Time time, std::vector<std::string> names,
                                        bool programs = false) {
    const auto told = std::make_shared<std::promise<std::pair<Problems, Seen>>>();
    auto seen = told->get_future();
    line.line->ask(
        {77, Look{time, std::move(names), programs, [told](const auto& problems, const auto& what) {
                    told->set_value({problems, what});
                  }}});
    if (seen.wait_for(std::chrono::seconds(60)) != std::future_status::ready)
      return {{{"live.busy"_code, "look", 1, 1, "nothing was told for a minute", ""}}, {}};
    return seen.get();
  }
  /// A trace's header, without units, and its row at that time.
  static std::pair<std::vector<std::string>, std::vector<double>> row(const fs::path& run, Time time) {
    std::ifstream trace(run / "trace.csv");
    std::string line;
    std::getline(trace, line);
    const auto cells = [&] {
      std::vector<std::string> all;
      std::stringstream text(line);
      for (std::string cell; std::getline(text, cell, ',');) all.push_back(cell);
      return all;
    };
    auto names = cells();
    for (auto& name : names) name = name.substr(0, name.find(" ["));
    names.erase(names.begin());
    std::vector<double> values;
    while (std::getline(trace, line)) {
      if (std::abs(std::strtod(line.c_str(), nullptr) - seconds(time)) > 1e-9) continue;
      for (const auto& cell : cells()) values.push_back(std::strtod(cell.c_str(), nullptr));
      values.erase(values.begin());
    }
    return {names, values};
  }
  void expect_replays(const std::string& run) {
    cli::ReplayOptions options;
    options.session = folder / run;
    options.out = folder / "again";
    options.pictures = false;
    captured([&] { return cli::replay_session(options); });
    EXPECT_EQ(err, "");
    EXPECT_THAT(out, Not(HasSubstr("may differ")));
    for (const auto* file : {"trace.csv", "events.csv"}) {
      const auto recorded = text_of_file(folder / run / file);
      EXPECT_THAT(recorded, testing::StartsWith("time [s]"));
      EXPECT_EQ(recorded, text_of_file(folder / "again/session" / file)) << run << " " << file;
    }
  }
  /// Seconds with a ramp, a fault and other values; what was told at those times.
  std::map<Time, std::shared_ptr<const News>> work(RunningLine& line) {
    std::map<Time, std::shared_ptr<const News>> told;
    const auto then = [&](Time time, const char* act) {
      go(line, time);
      told[time] = line.until([&](const News& news) { return news.time == time; });
      if (act != nullptr) {
        EXPECT_EQ(lines_of(line.ask(Act{act})), "");
      }
    };
    then(600 * millisecond, nullptr);
    then(1200 * millisecond, R"({"ramp": {"web.speed": "80 m/min"}, "over": "300 ms"})");
    then(2100 * millisecond, R"({"fault": {"knife.encoder": {"lose_counts": 20}}})");
    then(2600 * millisecond, R"({"set": {"slLength": 900}})");
    then(3300 * millisecond, nullptr);
    go(line, 3500 * millisecond);
    return told;
  }

  TestFolder folder;
};

TEST_F(LivePast, EveryMomentIsSeenAsItWas) {
  RunningLine line(knife());
  const auto told = work(line);
  go(line, 4600 * millisecond);  // so that the rows that are looked at are in the file
  const auto now = line.until([](const News&) { return true; });
  for (const int at : {2600, 600, 3300, 1200, 2100}) {
    SCOPED_TRACE(at);
    const auto time = at * millisecond;
    const auto [names, values] = row(folder / "record/1", time);
    ASSERT_GT(names.size(), 3U);
    ASSERT_EQ(values.size(), names.size());
    const auto [problems, seen] = look(line, time, names, at == 2100);
    ASSERT_EQ(lines_of(problems), "");
    EXPECT_EQ(seen.run, 1);
    EXPECT_EQ(seen.time, time);
    EXPECT_EQ(seen.read, values);
    const auto& then = *told.at(time);
    EXPECT_EQ(seen.values, then.values);
    EXPECT_EQ(seen.lamps, then.lamps);
    ASSERT_EQ(seen.poses.size(), then.poses.size());
    for (std::size_t part = 0; part < seen.poses.size(); ++part) {
      EXPECT_EQ(seen.poses[part].pose.position, then.poses[part].pose.position);
      EXPECT_EQ(seen.poses[part].pose.rotation, then.poses[part].pose.rotation);
    }
    EXPECT_EQ(seen.programs.has_value(), at == 2100);
    EXPECT_EQ(seen.outcome.end, time);
  }
  // The line has not gone on, nor back.
  line.ask(Go{false});
  EXPECT_EQ(line.until([](const News&) { return true; })->time, now->time);
}

TEST_F(LivePast, ARunThatGoesOnFromAMomentHasItsWholePast) {
  {
    RunningLine line(knife());
    const auto told = work(line);
    ASSERT_EQ(lines_of(line.ask(GoOn{2400 * millisecond})), "");
    const auto there = line.until([](const News& news) { return news.run == 2; });
    EXPECT_EQ(there->time, 2400 * millisecond);
    EXPECT_EQ(line.description()->run, 2);
    EXPECT_EQ(lines_of(line.ask(Act{R"({"set": {"slLength": 800}})"})), "");
    go(line, 3700 * millisecond);
    // Its past is that of both, as far as they have it in common.
    const auto [names, values] = row(folder / "record/1", 1200 * millisecond);
    const auto [problems, seen] = look(line, 1200 * millisecond, names);
    EXPECT_EQ(lines_of(problems), "");
    EXPECT_EQ(seen.run, 2);
    EXPECT_EQ(seen.read, values);
    EXPECT_EQ(seen.values, told.at(1200 * millisecond)->values);
    // And once more, to before most of it.
    ASSERT_EQ(lines_of(line.ask(GoOn{1250 * millisecond})), "");
    EXPECT_EQ(line.until([](const News& news) { return news.run == 3; })->time, 1250 * millisecond);
    EXPECT_EQ(lines_of(line.ask(Act{R"({"power": false})"})), "");
    go(line, 2 * second);
    const auto [late, after] = row(folder / "record/2", 1250 * millisecond);
    EXPECT_EQ(look(line, 1250 * millisecond, late).second.read, after);
  }
  const auto second_run = text_of_file(folder / "record/2/events.csv");
  EXPECT_THAT(second_run, HasSubstr("knife.encoder.lose_counts = 20"));
  EXPECT_THAT(second_run, HasSubstr("slLength = 800"));
  EXPECT_THAT(second_run, Not(HasSubstr("slLength = 900")));
  EXPECT_THAT(text_of_file(folder / "record/1/events.csv"), HasSubstr("slLength = 900"));
  EXPECT_THAT(text_of_file(folder / "record/3/events.csv"), Not(HasSubstr("lose_counts")));
  for (const auto* run : {"record/1", "record/2", "record/3"}) expect_replays(run);
}

TEST_F(LivePast, WithoutARecordItGoesBackToo) {
  auto options = knife();
  options.record.clear();
  RunningLine line(options);
  work(line);
  EXPECT_EQ(lines_of(line.ask(GoOn{})), "");
  EXPECT_EQ(line.until([](const News& news) { return news.run == 2; })->time, 0);
  go(line, second);
  EXPECT_EQ(lines_of(look(line, 500 * millisecond, {"knife.speed"}).first), "");
  EXPECT_EQ(lines_of(line.ask(Restart{})), "");
  EXPECT_EQ(line.until([](const News& news) { return news.run == 3; })->time, 0);
}

// Programs that are edited while the line runs are those of the next restart, not of the past.
TEST_F(LivePast, IsOfTheProgramThatRan) {
  folder.file("p.il", "LD M8000\nINC D300\nEND\n");
  RunningLine line({.scenario = folder.file("line.yaml",
                                            "scene: {duration: 1 s}\nplants: {bench: {type: bench}}\n"
                                            "controller: {lx3vp: {program: p.il}}\n"),
                    .pace = 0,
                    .running = false});
  folder.file("p.il", "LD M8000\nDEC D300\nEND\n");
  go(line, 1500 * millisecond);
  const auto [problems, seen] = look(line, 1200 * millisecond, {"D300"}, true);
  ASSERT_EQ(lines_of(problems), "");
  EXPECT_GT(seen.read.at(0), 0);
  ASSERT_TRUE(seen.programs);
  EXPECT_THAT(seen.programs->scanned.at(0), Not(testing::IsEmpty()));
}

TEST_F(LivePast, WhatDoesNotFitIsTold) {
  RunningLine line({.scenario = folder.file("web.yaml", web_alone), .pace = 0, .running = false});
  go(line, 100 * millisecond);
  EXPECT_EQ(lines_of(look(line, 101 * millisecond, {}).first),
            "look:1:1: the line has not come to 101 ms yet; it is at 100 ms [live.message]\n");
  EXPECT_THAT(lines_of(look(line, 50 * millisecond, {"web.sped"}).first),
              HasSubstr("did you mean web.speed"));
  EXPECT_THAT(lines_of(line.ask(GoOn{second})), HasSubstr("has not come to 1 s yet"));
  EXPECT_EQ(lines_of(look(line, 100 * millisecond, {"web.speed"}).first), "");
  // Between two steps it is the one before.
  EXPECT_EQ(look(line, 50 * millisecond + 7, {}).second.time, 50 * millisecond);

  for (const auto* message :
       {R"({"look": 3})", R"({"look": "3"})", R"({"look": "-1 s"})", R"({"look": "1e12 s"})",
        R"({"look": "3 mm"})", R"({"look": "1 s", "read": "web.speed"})", R"({"look": "1 s", "programs": 1})",
        R"({"go_on": true})", R"({"go_on": "soon"})", R"({"go_on": null})"}) {
    double id = 0;
    Problems problems;
    EXPECT_FALSE(parse_request(message, 1, id, problems)) << message;
    ASSERT_EQ(problems.size(), 1U) << message;
    EXPECT_EQ(problems[0].code.text(), "live.message");
  }
  double id = 0;
  Problems problems;
  const auto request =
      parse_request(R"({"look": "12.5 s", "read": ["a"], "programs": true})", 1, id, problems);
  ASSERT_TRUE(request);
  EXPECT_EQ(std::get<Look>(request->what).time, 12500 * millisecond);
}

TEST_F(LivePast, GoesOnFromAMomentThatTheSessionKept) {
  {
    RunningLine line(knife());
    work(line);
  }
  const auto session = folder / "record/1";
  EXPECT_EQ(read_moments(session, never).size(), 4U);  // 0 to 3 s
  EXPECT_EQ(read_moments(session, 2900 * millisecond).size(), 3U);
  const auto from = [&](const fs::path& record) {
    auto options = knife();
    options.scenario.clear();
    options.set.clear();
    options.from = Line::Options::From{session / "session.yaml", 2500 * millisecond};
    options.record = record;
    RunningLine line(options);
    EXPECT_EQ(line.until([](const News&) { return true; })->time, 2500 * millisecond);
    go(line, 3200 * millisecond);
    const auto [names, values] = row(session, 1200 * millisecond);
    EXPECT_EQ(look(line, 1200 * millisecond, names).second.read, values);
  };
  from(folder / "kept");
  const auto kept = text_of_file(session / moments_file);
  fs::remove(session / moments_file);
  from(folder / "zero");
  for (const auto* file : {"trace.csv", "events.csv"})
    EXPECT_EQ(text_of_file(folder / "kept/1" / file), text_of_file(folder / "zero/1" / file)) << file;
  expect_replays("kept/1");
  // Whoever edits the session has another one.
  std::ofstream(session / moments_file, std::ios::binary) << kept;
  auto edited = text_of_file(session / "session.yaml");
  edited.replace(edited.find("80 m/min"), 2, "70");
  std::ofstream(session / "session.yaml", std::ios::binary) << edited;
  EXPECT_EQ(read_moments(session, never).size(), 2U);  // 0 and 1 s, before the ramp
  std::ofstream(session / moments_file, std::ios::binary) << kept.substr(0, kept.size() / 8);
  EXPECT_EQ(read_moments(session, never).size(), 0U);
}

TEST(LiveMoments, LieEvenlyInTheirRoom) {
  constexpr std::size_t most = 100'000;
  constexpr std::size_t size = 1000;
  Moments moments(most);
  for (Time time = 0; time <= 3600 * second; time += second / 2)
    if (time >= moments.next())
      moments.keep({time,
                    static_cast<std::size_t>(time / second),
                    {},
                    std::make_shared<const StateArchive::Bytes>(size)});
  EXPECT_LE(moments.bytes(), most);
  EXPECT_GT(moments.bytes(), most / 2);
  EXPECT_EQ(moments.bytes(), size * moments.all().size());
  EXPECT_EQ(moments.apart(), 64 * second);
  EXPECT_EQ(moments.all().front().time, 0);
  for (std::size_t i = 1; i < moments.all().size(); ++i)
    EXPECT_LE(moments.all()[i].time - moments.all()[i - 1].time, moments.apart());
  EXPECT_LE(3600 * second - moments.all().back().time, moments.apart());
  for (const Time time : {Time{0}, second / 3, 1000 * second, 3600 * second, 9999 * second}) {
    EXPECT_LE(moments.before(time).time, time);
    EXPECT_GT(moments.before(time).time + moments.apart() + 1, std::min(time, 3600 * second));
  }
  EXPECT_LE(moments.with_acts(1000).acts, 1000U);
  moments.cut(1000 * second);
  EXPECT_LE(moments.all().back().time, 1000 * second);
  EXPECT_EQ(moments.bytes(), size * moments.all().size());
}

}  // namespace
}  // namespace drycut::sim::live
