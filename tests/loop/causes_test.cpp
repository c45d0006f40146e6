// Why a run failed: what is told of what happened before.
#include "sim/loop/causes.hpp"

#include <gmock/gmock.h>

#include "sim/loop/known_events.hpp"

namespace drycut::sim::loop {
namespace {

record::RecordedEvent told(double at, const std::string& source, const std::string& event,
                           const std::string& text, std::vector<record::RecordedEvent::Value> values = {}) {
  return {static_cast<Time>(at * 1e9), 0, source, event, std::move(values), text, severity_of(event)};
}

record::CheckResult failed(std::optional<double> at) {
  record::CheckResult result{"cut length", "each cut: length > 0", false, {}, "", {}, ""};
  result.failed_at = at;
  return result;
}

Finding said(std::string text) { return {"loop.warning"_code, std::move(text)}; }

/// The sentence; "" = none.
std::string cause(const Causes& causes, const std::vector<record::CheckResult>& checks,
                  const Causes::Known& known) {
  const auto found = causes.of(checks, known);
  return found ? found->text : "";
}

TEST(Causes, AreNoneWhereAllPassed) {
  Causes causes;
  causes.happened(told(1, "Knife", "errorstop", "following error"));
  auto passed = failed({});
  passed.passed = true;
  EXPECT_EQ(cause(causes, {passed}, {{said("a")}, {said("b")}}), "");
  EXPECT_EQ(cause(Causes(), {failed(2)}, {}), "");
}

TEST(Causes, WhatComesBeforeAFailureMayBeItsCauseAndWhatComesBehindIsNot) {
  Causes causes;
  causes.happened(told(2.282, "Knife", "warning", "the cam asks for more than dynamik.vb_max"));
  causes.happened(told(2.488, "Knife", "errorstop", "following error above its limit"));
  causes.happened(told(3, "timeline", "fault", "knife.encoder stuck = 1"));
  EXPECT_EQ(cause(causes, {failed(2.34), failed(9)}, {}),
            "because Knife at 2.282 s: the cam asks for more than dynamik.vb_max");
  EXPECT_EQ(
      cause(causes, {failed(2.49)}, {}),
      "because Knife at 2.282 s: the cam asks for more than dynamik.vb_max; then at 2.488 s: following error "
      "above its limit");
  EXPECT_EQ(cause(causes, {failed(3.1)}, {}),
            "because the timeline had at 3 s: fault knife.encoder stuck = 1");
  EXPECT_EQ(cause(causes, {failed(1)}, {}), "");
}

TEST(Causes, AWarningOfLongAgoIsOnlyWhatCameBefore) {
  Causes causes;
  causes.happened(told(1, "AxisX", "warning", "a value is out of range"));
  EXPECT_EQ(cause(causes, {failed(9)}, {}), "after AxisX at 1 s: a value is out of range");
}

// A machine does what it is told: what its controller warned of comes before what broke.
TEST(Causes, WhatAControllerWarnedOfExplainsWhatAMachineBreaks) {
  Causes causes;
  causes.happened(told(2.36, "AxisX", "warning", "slave out of syncrange"));
  causes.happened(told(2.5147, "knife", "tear", "", {{"mismatch", 102.165, "mm/s"}}));
  EXPECT_EQ(cause(causes, {failed(2.5147)}, {}), "because AxisX at 2.36 s: slave out of syncrange");
  Causes alone;
  alone.happened(told(2.5147, "knife", "tear", "", {{"mismatch", 102.165, "mm/s"}}));
  EXPECT_EQ(cause(alone, {failed(2.5147)}, {}), "after knife at 2.5147 s: it tore the web");
}

TEST(Causes, ADriveAtItsLimitIsTold) {
  Causes causes;
  causes.happened(told(2.6, "knife", "saturated", "", {{"begin", 2.4, "s"}, {"end", 2.6, "s"}}));
  EXPECT_EQ(cause(causes, {failed(2.5)}, {}),
            "after the drive of knife was at its torque limit from 2.4 s on");
  EXPECT_EQ(cause(causes, {failed(5)}, {}), "");
  EXPECT_EQ(cause(causes, {failed(2)}, {}), "");
}

TEST(Causes, WhatContradictsTheMachineGoesBeforeAllAndWhyNothingBeganBeforeWarnings) {
  Causes causes;
  causes.happened(told(1, "AxisX", "warning", "a value is out of range"));
  const Causes::Known known = {{}, {said("nothing pressed start (panel.start was never on)")}};
  EXPECT_EQ(cause(causes, {failed({})}, known), "because nothing pressed start (panel.start was never on)");
  EXPECT_EQ(cause(causes, {failed({})}, {{said("a differs from b")}, known.hindrances}),
            "because a differs from b");
  causes.happened(told(2, "AxisX", "error", "division by zero"));
  EXPECT_THAT(cause(causes, {failed({})}, known), testing::HasSubstr("division by zero"));
}

TEST(Causes, AMachineTellsItInNumbers) {
  Causes causes;
  causes.happened(told(2, "saw", "clamped_moving", "", {{"difference", -567.2, "mm/s"}, {"blade", 0, ""}}));
  causes.happened(told(2.05, "tube", "held_back", "",
                       {{"force", 1500, "N"}, {"speed", 3, "m/min"}, {"set_speed", 34.4, "m/min"}}));
  EXPECT_EQ(
      cause(causes, {failed(2)}, {}),
      "because saw at 2 s: the clamps took hold of material that ran 567.2 mm/s faster than the carriage");
  EXPECT_EQ(
      cause(causes, {failed(2)}, {{said("Y1 gives pulses, and nothing is wired to it")}, {}}),
      "because Y1 gives pulses, and nothing is wired to it; saw at 2 s: the clamps took hold of material "
      "that ran 567.2 mm/s faster than the carriage");
  Causes held;
  held.happened(told(2.05, "tube", "held_back", "",
                     {{"force", 1500, "N"}, {"speed", 3, "m/min"}, {"set_speed", 34.4, "m/min"}}));
  EXPECT_EQ(
      cause(held, {failed(3)}, {}),
      "because tube at 2.05 s: its line drive stood at its largest force, 1500 N, and it ran at 3 of 34.4 "
      "m/min");
  Causes early;
  early.happened(told(2.1, "saw", "opened_early", "", {{"depth", 20, "mm"}}));
  EXPECT_EQ(cause(early, {failed(3)}, {}),
            "because saw at 2.1 s: the clamps let go with the blade in the material");
}

TEST(Causes, AnErrorIsToldOnceItHasLasted) {
  Causes causes;
  causes.happened(told(2.4, "saw", "errorstop", "following error"));
  EXPECT_EQ(cause(causes, {failed(2.35)}, {}), "because saw at 2.4 s: following error");
  EXPECT_EQ(cause(causes, {failed(2.2)}, {}), "");
}

TEST(Causes, WhereNothingWasFoundToJudgeWhatStandsComesBeforeOldWarnings) {
  Causes causes;
  causes.happened(told(0.1, "AxisX", "warning", "a value is out of range"));
  Causes::Known known;
  known.hindrances = {said("gbPhase stands at 2 since 3.4 s")};
  auto idle = failed({});
  idle.idle = true;
  EXPECT_EQ(cause(causes, {failed(3), idle}, known), "while gbPhase stands at 2 since 3.4 s");
  EXPECT_EQ(cause(causes, {failed(3)}, known), "after AxisX at 0.1 s: a value is out of range");
  EXPECT_EQ(cause(causes, {failed(0.3), idle}, known),
            "because gbPhase stands at 2 since 3.4 s; AxisX at 0.1 s: a value is out of range");
}

// What a controller stops at comes before what then stands, also if a check failed just before.
TEST(Causes, AnErrorOfTheControllerComesBeforeWhatStands) {
  Causes::Known known;
  known.hindrances = {said("saw.clamp off since 3.854 s")};
  auto idle = failed({});
  idle.idle = true;
  Causes causes;
  causes.happened(told(4.168, "AxisX", "error", "error 4 in row 7"));
  EXPECT_EQ(cause(causes, {failed(4.1), idle}, known),
            "because AxisX at 4.168 s: error 4 in row 7; saw.clamp off since 3.854 s");
  Causes machine;
  machine.happened({4'168'000'000, 0, "tube", "held_back", {{"force", 1500, "N"}}, "", Severity::error});
  EXPECT_THAT(cause(machine, {failed(4.1), idle}, known), testing::StartsWith("because saw.clamp off"));
}

TEST(Causes, AValueOutOfRangeLeads) {
  Causes causes;
  causes.happened(told(0.002, "Axis", "out_of_range", "taccdec: 1000 is outside 0..999, taken anyway"));
  Causes::Known known;
  known.hindrances = {said("line 65, WAIT Axis:st_still")};
  EXPECT_EQ(cause(causes, {failed(5)}, known),
            "because Axis at 0.002 s: taccdec: 1000 is outside 0..999, taken anyway");
}

TEST(Causes, WhatStandsIsToldWithWhatLooksOdd) {
  Causes::Known known;
  known.hindrances = {said("line 57, WAIT AxisX:st_toll")};
  known.doubts = {said("AxisX.pgain is 5")};
  auto idle = failed({});
  idle.idle = true;
  EXPECT_EQ(cause(Causes(), {failed(2), idle}, known), "while line 57, WAIT AxisX:st_toll; AxisX.pgain is 5");
}

TEST(Causes, ABlowIsToldWhereNothingElseIs) {
  Causes causes;
  causes.happened(told(0.5, "press", "sag", "", {{"speed", -214.47, "mm/s"}, {"position", 245, "mm"}}));
  EXPECT_EQ(cause(causes, {failed(0.3)}, {}),
            "shortly before press at 0.5 s: it sank at 214.5 mm/s when it should stand");
  EXPECT_EQ(cause(causes, {failed(0.6)}, {}),
            "after press at 0.5 s: it sank at 214.5 mm/s when it should stand");
  EXPECT_EQ(cause(causes, {failed(4)}, {}), "");
  Causes::Known known;
  known.doubts = {said("Axis counted 50 where press.position went 200 mm")};
  causes.happened(told(0.2, "Axis", "warning", "out of range"));
  EXPECT_EQ(cause(causes, {failed(9)}, known),
            "after Axis at 0.2 s: out of range; Axis counted 50 where press.position went 200 mm");
  causes.happened(told(0.55, "AxisX", "warning", "out of range"));
  EXPECT_EQ(cause(causes, {failed(0.6)}, {}), "because AxisX at 0.55 s: out of range");
}

TEST(Causes, WhatTheTimelineDidToTheMachineIsTheLastToBeNamed) {
  Causes causes;
  causes.happened(told(1, "timeline", "set", "web.speed = 60 m/min"));
  causes.happened(told(9, "timeline", "set", "tube.speed = 40 mm/min"));
  causes.happened(told(9, "timeline", "set", "panel.start = 1"));
  auto few = failed({});
  few.too_few = 8;
  EXPECT_EQ(cause(causes, {few}, {}), "after the timeline had at 9 s: tube.speed = 40 mm/min");
  EXPECT_EQ(cause(causes, {failed(9.5)}, {}), "after the timeline had at 9 s: tube.speed = 40 mm/min");
  EXPECT_EQ(cause(causes, {failed(20)}, {}), "");
  Causes::Known known;
  known.doubts = {said("Y16 is wired to panel.in_sync, and no program works it")};
  EXPECT_EQ(cause(causes, {failed(9.5)}, known),
            "while Y16 is wired to panel.in_sync, and no program works it");
}

TEST(Causes, AnAxisThatGoesAstrayComesBeforeWhatTheControllerMakesOfIt) {
  Causes causes;
  causes.happened(told(0.3, "AxisX", "errorstop", "following error"));
  Causes::Known known;
  known.astray = {{0.2, said("AxisX went 1204 counts against its drive")}};
  EXPECT_EQ(cause(causes, {failed(0.5)}, known), "because AxisX went 1204 counts against its drive");
  EXPECT_EQ(cause(causes, {failed({})}, known), "because AxisX went 1204 counts against its drive");
  EXPECT_EQ(cause(causes, {failed(0.1)}, known), "");
}

TEST(Causes, AProgramThatStandsAsAWholeIsToldWhereNothingElseIs) {
  Causes causes;
  Causes::Known known;
  known.standing = {1.5, said("a.mod stands at line 3, WAIT x, since 1.5 s")};
  EXPECT_EQ(cause(causes, {failed(2)}, known), "while a.mod stands at line 3, WAIT x, since 1.5 s");
  EXPECT_EQ(cause(causes, {failed(1)}, known), "");
  causes.happened(told(1.9, "AxisX", "warning", "a value is out of range"));
  EXPECT_EQ(cause(causes, {failed(2)}, known), "because AxisX at 1.9 s: a value is out of range");
}

TEST(Causes, TheStateThatChangedLastIsToldOnceItStandsForASecond) {
  double phase = 0;
  double step = 4;
  Causes causes;
  causes.follow("gbPhase", &phase);
  causes.follow("gbStep", &step);
  causes.sample(1 * second);
  EXPECT_FALSE(causes.state_that_stands(9)) << "nothing has changed";
  phase = 1;
  causes.sample(2 * second);
  step = 5;
  causes.sample(2500 * millisecond);
  EXPECT_FALSE(causes.state_that_stands(3));
  EXPECT_EQ(causes.state_that_stands(3.5).value().text, "gbStep stands at 5 since 2.5 s");
  EXPECT_TRUE(causes.state_that_stands(3.5, 2.5));
  EXPECT_FALSE(causes.state_that_stands(3.5, 2.4)) << "what failed then failed while it worked";
}

TEST(Causes, AStateThatHasStoodAsLongBeforeIsAtWork) {
  double step = 0;
  Causes causes;
  causes.follow("gbStep", &step);
  for (const int at : {2, 6, 10}) {
    ++step;
    causes.sample(at * second);
  }
  EXPECT_FALSE(causes.state_that_stands(15.9));
  EXPECT_EQ(causes.state_that_stands(16.1).value().text, "gbStep stands at 3 since 10 s");
}

TEST(Causes, AnAxisThatHuntsIsToldBeforeWhatCameOfIt) {
  Causes causes;
  causes.happened(told(1.5, "AxisX", "warning", "slave out of syncrange"));
  Causes::Known known;
  known.hunting = {1.2, said("AxisX hunts")};
  EXPECT_EQ(cause(causes, {failed(1.6)}, known), "because AxisX hunts");
  EXPECT_EQ(cause(causes, {failed(1.1)}, known), "");
  known.hunting->first = 1.55;
  EXPECT_EQ(cause(causes, {failed(1.6)}, known), "because AxisX at 1.5 s: slave out of syncrange");
}

TEST(Causes, AFaultThatShowedNothingForLongOnlyCameBefore) {
  Causes causes;
  causes.happened(told(3, "timeline", "fault", "saw.encoder stuck = 1"));
  EXPECT_EQ(cause(causes, {failed(3.9)}, {}), "because the timeline had at 3 s: fault saw.encoder stuck = 1");
  EXPECT_EQ(cause(causes, {failed(9)}, {}), "after the timeline had at 3 s: fault saw.encoder stuck = 1");
  Causes::Known known;
  known.hindrances = {said("saw.clamp off since 2 s")};
  EXPECT_EQ(cause(causes, {failed({})}, known),
            "after the timeline had at 3 s: fault saw.encoder stuck = 1; saw.clamp off since 2 s");
  causes.happened(told(4, "AxisX", "warning", "slave out of syncrange"));
  EXPECT_EQ(cause(causes, {failed(9)}, {}), "because the timeline had at 3 s: fault saw.encoder stuck = 1");
}

TEST(Causes, AnAxisThatLostItsLoadIsNotHeldToCountTheWrongWay) {
  Causes causes;
  causes.happened(told(0.3, "press", "pulled_out", "", {{"speed", -400, "rpm"}, {"slip", 550, "rpm"}}));
  Causes::Known known;
  known.astray = {{0.4, said("Axis went 1204 counts against its drive")}};
  EXPECT_THAT(cause(causes, {failed(0.5)}, known), testing::StartsWith("because press at 0.3 s: pulled_out"));
}

TEST(Causes, WhatTheControllerWarnedOfJustBeforeAMachinesErrorIsToldFirst) {
  Causes causes;
  causes.happened(told(1.9, "LX3VP", "warning", "the frequency limit holds back pulses"));
  causes.happened(told(2.1, "saw", "errorstop", "following error"));
  EXPECT_EQ(cause(causes, {failed(2.2)}, {}),
            "because LX3VP at 1.9 s: the frequency limit holds back pulses; then saw at 2.1 s: following "
            "error");
  Causes late;
  late.happened(told(0.9, "LX3VP", "warning", "the frequency limit holds back pulses"));
  late.happened(told(2.1, "saw", "errorstop", "following error"));
  EXPECT_EQ(cause(late, {failed(2.2)}, {}), "because saw at 2.1 s: following error");
}

TEST(Causes, ACheckThatNeverHeldIsToldWhereNoErrorIs) {
  auto never = failed(0);
  never.name = "no error";
  never.throughout = "AxisX.st_error 0";
  Causes causes;
  Causes::Known known;
  known.doubts = {said("AxisX.offset is 9000")};
  EXPECT_EQ(cause(causes, {never}, known), "because check 'no error' held at no instant: AxisX.st_error 0");
  causes.happened(told(1.9, "AxisX", "errorstop", "following error"));
  EXPECT_EQ(cause(causes, {never}, known), "while AxisX.offset is 9000");
}

TEST(Causes, WhatOnlyCameTooLateIsNoStandstill) {
  auto late = failed({});
  late.name = "all tours done";
  late.deadline = true;
  late.margin = -28.9;
  Causes::Known known;
  known.hindrances = {said("gbPlace stands at 0 since 39.856 s")};
  EXPECT_EQ(cause(Causes(), {late}, known),
            "while nothing but check 'all tours done' is amiss: it came true 28.9 s too late");
  EXPECT_EQ(cause(Causes(), {late, failed({})}, known), "because gbPlace stands at 0 since 39.856 s");
}

TEST(Causes, AnAxisThatWentAstrayLaterIsToldWhereNothingElseIs) {
  Causes::Known known;
  known.astray = {{0.5, said("Axis counts against its drive")}};
  EXPECT_EQ(cause(Causes(), {failed(0.1)}, known), "because Axis counts against its drive");
  known.doubts = {said("Axis.feedfw is 90")};
  EXPECT_EQ(cause(Causes(), {failed(0.1)}, known), "because Axis counts against its drive");
}

TEST(Causes, AlarmsComeInTheOrderOfTheirTimes) {
  Causes causes;
  causes.happened(told(2, "Knife", "warning", "late"));
  causes.happened(told(3, "Knife", "errorstop", "following error"));
  causes.happened(told(1, "AxisX", "refused", "START"));
  causes.happened(told(4, "Knife", "warning", "late"));
  std::vector<std::string> texts;
  for (const auto& alarm : causes.alarms()) texts.push_back(text_of(alarm));
  EXPECT_THAT(texts, testing::ElementsAre("AxisX at 1 s: START", "Knife at 2 s: late",
                                          "Knife at 3 s: following error"));
}

}  // namespace
}  // namespace drycut::sim::loop
