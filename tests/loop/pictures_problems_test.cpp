// pictures: what is wrong with frames, film and plots, where, and what would be right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/loop/scenario/fake_plants.hpp"

namespace drycut::sim::scenario {
namespace {

using fakes::problems_of;
using fakes::read;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Case {
  std::string text;
  std::vector<std::string> problems;
};
void expect_problems(const std::vector<Case>& cases) {
  for (const auto& one : cases) EXPECT_EQ(problems_of(one.text), one.problems) << one.text.substr(0, 300);
}

TEST(PicturesProblems, FramesAndPlots) {
  const std::string frames = "pictures: {frames: {";
  expect_problems({
      {frames + "size: 960}}\n",
       {"1:27: pictures.frames.size: '960' is no picture size; write width x height in pixels without "
        "blanks: 960x540 [scenario.out-of-range]"}},
      {frames + "size: 960x}}\n",
       {"1:27: pictures.frames.size: '960x' is no picture size; write width x height in pixels without "
        "blanks: 960x540 [scenario.out-of-range]"}},
      {frames + "size: 9x9}}\n",
       {"1:27: pictures.frames.size is 9x9, out of range; 160 to 4096 pixels each way "
        "[scenario.out-of-range]"}},
      {frames + "size: 159x160}}\n",
       {"1:27: pictures.frames.size is 159x160, out of range; 160 to 4096 pixels each way "
        "[scenario.out-of-range]"}},
      {frames + "size: 160x160}}\n", {}},
      {frames + "size: 99999999999x9}}\n",
       {"1:27: pictures.frames.size: '99999999999x9' is no picture size; write width x height in pixels "
        "without blanks: 960x540 [scenario.out-of-range]"}},
      {frames + "from: 2 s, until: 1 s}}\n",
       {"1:32: pictures.frames.until is not after from; let until be later than from [scenario.order]"}},
      {"pictures: {plots: [{panels: []}]}\n",
       {"1:20: pictures.plots.0.name is missing; it names the file: name.png [scenario.missing-key]"}},
      {"pictures: {plots: [{name: a}]}\n",
       {"1:20: pictures.plots.a.panels is missing; add panels: [{title: ..., channels: [...]}] "
        "[scenario.missing-key]"}},
      {"pictures: {plots: [{name: a/b, panels: []}]}\n",
       {"1:27: pictures.plots.a/b.name 'a/b' is no file name; leave / and \\ out and begin with a letter, "
        "not too long; it becomes name.png [scenario.bad-name]"}},
      {"pictures: {plots: [{name: .., panels: []}]}\n",
       {"1:27: pictures.plots.0.name '..' is no file name; leave / and \\ out and begin with a letter, not "
        "too long; it becomes name.png [scenario.bad-name]"}},
      {"pictures: {plots: [{name: " + std::string(101, 'a') + ", panels: []}]}\n",
       {"1:27: pictures.plots.0.name '" + std::string(101, 'a') +
        "' is no file name; leave / and \\ out and begin with a letter, not too long; it becomes name.png "
        "[scenario.bad-name]"}},
      {"pictures: {plots: [{name: a, panels: []}, {name: a, panels: []}]}\n",
       {"1:50: there are two plots named 'a'; rename one: each is a file [scenario.twice]"}},
      {"pictures: {plots: [{name: a, panels: [{title: b}]}]}\n",
       {"1:39: pictures.plots.a.panels.0.channels is missing; add channels: [knife.speed], lanes: [2.OUT01], "
        "or event: cut and values: [length] [scenario.missing-key]"}},
      {"pictures: {plots: [{name: a, panels: [{channels: [b], event: cut, values: [c]}]}]}\n",
       {"1:55: pictures.plots.a.panels.0 has both channels and an event; make two panels of it "
        "[scenario.does-not-go-together]"}},
      {"pictures: {plots: [{name: a, panels: [{event: cut}]}]}\n",
       {"1:40: pictures.plots.a.panels.0: event and values go together; write event: cut, values: [length] "
        "[scenario.needs-another]"}},
      {"pictures: {plots: [{name: a, panels: [{channels: [b], limits: [2, 1]}]}]}\n",
       {"1:63: pictures.plots.a.panels.0.limits must be a lower and an upper limit; for example [1, 2] "
        "[scenario.order]"}},
      {"pictures: {plots: [{name: a, panels: [{channels: [b], limits: [x, 1]}]}]}\n",
       {"1:64: pictures.plots.a.panels.0.limits: 'x' is not a number; write a number, with its unit if it "
        "has one: 0.5, 60 m/min [scenario.not-a-number]"}},
      {"pictures: {plots: [{name: a, against: number, panels: [{channels: [b]}]}]}\n",
       {"1:39: pictures.plots.a.against: channels have no number; against: number is for plots whose panels "
        "all show events [scenario.does-not-go-together]"}},
      {"pictures: {plots: [{name: a, against: wall, panels: []}]}\n",
       {"1:39: pictures.plots.a.against: unknown choice 'wall'; known: time, number "
        "[scenario.unknown-choice]"}},
  });
}

TEST(PicturesProblems, FramesAroundAnEvent) {
  const std::string frames = "pictures: {frames: {";
  const auto no_event = [](const std::string& text) {
    return "pictures.frames.around: '" + text +
           "' is no event; write its name and its number from 1: \"cut[3]\" [scenario.unknown-event]";
  };
  expect_problems({
      {frames + "around: \"cut[0]\"}}\n", {"1:30: " + no_event("cut[0]")}},
      {frames + "around: \"cut[x]\"}}\n", {"1:30: " + no_event("cut[x]")}},
      {frames + "around: \"cut[3\"}}\n", {"1:30: " + no_event("cut[3")}},
      {frames + "around: \"cut[3]x\"}}\n", {"1:30: " + no_event("cut[3]x")}},
      {frames + "around: \"[3]\"}}\n", {"1:30: " + no_event("[3]")}},
      {frames + "before: 80 ms}}\n",
       {"1:21: pictures.frames.before stands without around; add around: \"cut[3]\", or write from and until "
        "[scenario.needs-another]"}},
      {frames + "around: cut, from: 1 s, until: 2 s}}\n",
       {"1:34: pictures.frames.from does not go with around; write before and after "
        "[scenario.does-not-go-together]",
        "1:45: pictures.frames.until does not go with around; write before and after "
        "[scenario.does-not-go-together]"}},
      {frames + "around: cut, after: -1 ms}}\n",
       {"1:41: pictures.frames.after is -1 ms; it must not be negative; for example 0 s "
        "[scenario.out-of-range]"}},
      {frames + "slow: 0}}\n",
       {"1:27: pictures.frames.slow is 0, out of range; 1 to 10000 [scenario.out-of-range]"}},
      {"pictures: {video: on}\n",
       {"1:12: pictures.video is a film of the frames, and there are none; add frames: {every: 40 ms} "
        "[scenario.needs-another]"}},
      {"pictures: {view: on}\n",
       {"1:12: pictures.view moves the machine as in the frames, and there are none; add frames: {every: 40 "
        "ms} [scenario.needs-another]"}},
      {"pictures: {video: 3, frames: {}}\n",
       {"1:19: pictures.video: '3' is not a switch position; write on or off (or true, false) "
        "[scenario.unknown-choice]"}},
  });
}

TEST(PicturesProblems, LanesAndMarks) {
  const std::string plot = "pictures: {plots: [{name: a, ";
  expect_problems({
      {plot + "panels: [{lanes: [b], channels: [c]}]}]}\n",
       {"1:52: pictures.plots.a.panels.0 has both lanes and channels; make two panels of it "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{lanes: [b], limits: [0, 1]}]}]}\n",
       {"1:52: pictures.plots.a.panels.0 has both lanes and limits; make two panels of it "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{x: a, y: b, lanes: [b]}]}]}\n",
       {"1:52: pictures.plots.a.panels.0 has both a path and lanes; make two plots of it "
        "[scenario.does-not-go-together]"}},
      {plot + "against: number, panels: [{lanes: [b]}]}]}\n",
       {"1:39: pictures.plots.a.against: lanes have no number; against: number is for plots whose panels all "
        "show events [scenario.does-not-go-together]"}},
      {plot + "marks: cut, panels: [{lanes: [b]}]}]}\n",
       {"1:37: pictures.plots.a.marks must be a list, not a single value; write [first, second], or a line "
        "'- ...' for each [scenario.wrong-kind]"}},
      {plot + "marks: [cut], panels: [{x: a, y: b}]}]}\n",
       {"1:30: pictures.plots.a: marks stand at times, this plot is not over time; leave marks out "
        "[scenario.does-not-go-together]"}},
      {plot + "marks: [cut], against: number, panels: [{event: a, values: [b]}]}]}\n",
       {"1:30: pictures.plots.a: marks stand at times, this plot is not over time; leave marks out "
        "[scenario.does-not-go-together]"}},
  });
}

TEST(PicturesProblems, HistogramsAndMotors) {
  const std::string plot = "pictures: {plots: [{name: a, ";
  expect_problems({
      {plot + "panels: [{event: b, values: [c, d], histogram: on}]}]}\n",
       {"1:66: pictures.plots.a.panels.0: a histogram shows one value of an event; write event: cut, values: "
        "[length] [scenario.does-not-go-together]"}},
      {plot + "panels: [{channels: [b], histogram: on}]}]}\n",
       {"1:55: pictures.plots.a.panels.0: a histogram shows one value of an event; write event: cut, values: "
        "[length] [scenario.does-not-go-together]"}},
      {plot + "panels: [{event: b, values: [c], histogram: 7}]}]}\n",
       {"1:74: pictures.plots.a.panels.0.histogram: '7' is not a switch position; write on or off (or true, "
        "false) [scenario.unknown-choice]"}},
      {plot + "panels: [{event: b, values: [c], histogram: on}, {channels: [d]}]}]}\n",
       {"1:30: pictures.plots.a: a histogram stands alone in its plot; make a plot of each "
        "[scenario.does-not-go-together]"}},
      {plot + "against: number, panels: [{event: b, values: [c], histogram: on}]}]}\n",
       {"1:30: pictures.plots.a: a histogram has its own x; leave against out "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{motor: b, lanes: [c]}]}]}\n",
       {"1:40: pictures.plots.a.panels.0 has both lanes and motor; make two panels of it "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{motor: b, limits: [0, 1]}]}]}\n",
       {"1:50: pictures.plots.a.panels.0 has both motor and limits; make two panels of it "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{motor: b}, {motor: c}], marks: []}]}\n",
       {"1:30: pictures.plots.a: a motor stands alone in its plot; make a plot of each "
        "[scenario.does-not-go-together]",
        "1:64: pictures.plots.a: marks stand at times, this plot is not over time; leave marks out "
        "[scenario.does-not-go-together]"}},
  });
}

TEST(PicturesProblems, Spectra) {
  const std::string plot = "pictures: {plots: [{name: a, ";
  expect_problems({
      {plot + "panels: [{event: b, values: [c, d], spectrum: on}]}]}\n",
       {"1:66: pictures.plots.a.panels.0: a spectrum is of one value of an event; write event: cut, values: "
        "[length] [scenario.does-not-go-together]"}},
      {plot + "panels: [{channels: [b], spectrum: on}]}]}\n",
       {"1:55: pictures.plots.a.panels.0: a spectrum is of one value of an event; write event: cut, values: "
        "[length] [scenario.does-not-go-together]"}},
      {plot + "panels: [{event: b, values: [c], spectrum: on, limits: [1, 2]}]}]}\n",
       {"1:77: pictures.plots.a.panels.0 has both a spectrum and limits; make two plots of it "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{event: b, values: [c], spectrum: on, histogram: on}]}]}\n",
       {"1:77: pictures.plots.a.panels.0 has both a spectrum and histogram; make two plots of it "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{event: b, values: [c], spectrum: on}, {channels: [d]}]}]}\n",
       {"1:30: pictures.plots.a: a spectrum stands alone in its plot; make a plot of each "
        "[scenario.does-not-go-together]"}},
      {plot + "against: number, panels: [{event: b, values: [c], spectrum: on}]}]}\n",
       {"1:30: pictures.plots.a: a spectrum has its own x; leave against out "
        "[scenario.does-not-go-together]"}},
      {plot + "panels: [{motor: b, spectrum: on}]}]}\n",
       {"1:50: pictures.plots.a.panels.0: a spectrum is of one value of an event; write event: cut, values: "
        "[length] [scenario.does-not-go-together]",
        "1:50: pictures.plots.a.panels.0 has both motor and spectrum; make two panels of it "
        "[scenario.does-not-go-together]"}},
  });
}

TEST(Pictures, HistogramsAndMotorsAreReadAndWritten) {
  std::vector<std::string> problems;
  const auto scenario = read(
      "pictures: {plots: [{name: a, panels: [{event: cut, values: [length], histogram: on, limits: [1, "
      "2]}]}, "
      "{name: b, panels: [{motor: knife}]}, {name: c, panels: [{event: cut, values: [length], spectrum: "
      "on}]}]}\n",
      problems);
  const auto check = [](const PicturesSection& pictures) {
    ASSERT_EQ(pictures.plots.size(), 3U);
    EXPECT_TRUE(pictures.plots[0].panels.at(0).histogram);
    EXPECT_FALSE(pictures.plots[0].panels[0].spectrum);
    EXPECT_TRUE(pictures.plots[2].panels.at(0).spectrum);
    EXPECT_TRUE(pictures.plots[0].panels.at(0).limits);
    EXPECT_EQ(pictures.plots[1].panels.at(0).motor.text, "knife");
  };
  check(scenario.pictures);
  const auto again = read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  check(again.pictures);
}

TEST(Pictures, AroundLanesMarksAndVideoAreReadAndWritten) {
  std::vector<std::string> problems;
  const auto scenario = read(
      "pictures:\n"
      "  video: on\n"
      "  frames: {around: \"knife.cut[3]\", before: 80 ms, after: 60 ms, slow: 20}\n"
      "  plots:\n"
      "    - {name: a, marks: [cut, timeline.fault], panels: [{title: t, lanes: [2.OUT01, panel.ready]}]}\n"
      "    - {name: b, marks: [], panels: [{channels: [c]}]}\n"
      "    - {name: c, panels: [{channels: [c]}]}\n",
      problems);
  EXPECT_THAT(problems, IsEmpty());
  const auto check = [](const PicturesSection& pictures) {
    EXPECT_TRUE(pictures.video);
    ASSERT_TRUE(pictures.around);
    EXPECT_EQ(pictures.around->event.text, "knife.cut");
    EXPECT_EQ(pictures.around->number, 3);
    EXPECT_EQ(pictures.around->before, 80 * millisecond);
    EXPECT_EQ(pictures.around->after, 60 * millisecond);
    EXPECT_EQ(pictures.slow, 20);
    ASSERT_EQ(pictures.plots.size(), 3U);
    const auto& lanes = pictures.plots[0].panels.at(0).lanes;
    ASSERT_EQ(lanes.size(), 2U);
    EXPECT_EQ(lanes[0].text, "2.OUT01");
    EXPECT_EQ(lanes[1].text, "panel.ready");
    ASSERT_TRUE(pictures.plots[0].marks);
    EXPECT_EQ(pictures.plots[0].marks->at(1).text, "timeline.fault");
    ASSERT_TRUE(pictures.plots[1].marks) << "no marks at all";
    EXPECT_TRUE(pictures.plots[1].marks->empty());
    EXPECT_FALSE(pictures.plots[2].marks) << "the usual ones";
  };
  check(scenario.pictures);
  const auto again = read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  check(again.pictures);
}

TEST(Pictures, AnEventWithoutNumberIsTheFirst) {
  std::vector<std::string> problems;
  const auto scenario = read("pictures: {frames: {around: fault}}\n", problems);
  EXPECT_THAT(problems, IsEmpty());
  ASSERT_TRUE(scenario.pictures.around);
  EXPECT_EQ(scenario.pictures.around->event.text, "fault");
  EXPECT_EQ(scenario.pictures.around->number, 1);
  EXPECT_EQ(scenario.pictures.slow, 1);
}

}  // namespace
}  // namespace drycut::sim::scenario
