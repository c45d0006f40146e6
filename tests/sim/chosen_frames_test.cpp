// Which frames of a film a report shows, and which one stands for it.
#include "sim/report/chosen_frames.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace drycut::sim::report {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Frames every 0.1 s from 0.1 s on.
std::vector<double> times(std::size_t count) {
  std::vector<double> all;
  for (std::size_t i = 1; i <= count; ++i) all.push_back(0.1 * static_cast<double>(i));
  return all;
}

record::RecordedEvent event(double at, const char* source, const char* name, double length = 0) {
  record::RecordedEvent made{static_cast<Time>(at * 1e9), 0, source, name, {}, ""};
  if (length > 0) made.values = {{"length", length, "mm"}};
  return made;
}

record::CheckResult check(const char* name, bool passed, double at) {
  record::CheckResult made;
  made.name = name;
  made.passed = passed;
  made.at = at;
  return made;
}

std::vector<std::string> told(const std::vector<Moment>& moments) {
  std::vector<std::string> all;
  for (const auto& one : moments) all.push_back(fmt::format("{:g} {}", one.time_s, one.what));
  return all;
}
std::vector<std::string> told(const std::vector<ChosenFrame>& frames) {
  std::vector<std::string> all;
  for (const auto& one : frames) all.push_back(fmt::format("{} {}", one.frame, one.what));
  return all;
}

record::EventLog line() {
  record::EventLog log;
  log.push_back(event(0.5, "timeline", "set"));
  log.push_back(event(1, "knife", "cut", 800));
  log.push_back(event(2, "knife", "cut", 800.5));
  log.push_back(event(2.5, "trimmer", "cut", 60));
  log.push_back(event(3, "timeline", "fault"));
  log.push_back(event(3.1, "controller", "warning"));
  log.push_back(event(3.5, "knife", "cut", 760));
  log.push_back(event(4, "web", "slack"));
  log.push_back(event(4.5, "web", "slack"));
  return log;
}

TEST(ChosenFrames, MomentsAreWhatHappenedTheMostTellingFirst) {
  const auto log = line();
  EXPECT_THAT(told(moments_of(log, {check("length", true, 2), check("torque", false, 3.2)}, 0, 5)),
              ElementsAre("1 first cut", "3 fault", "3.2 failed: torque", "2 worst cut", "5 last picture",
                          "3.5 cut to 760 mm", "4 web slack"));
}

TEST(ChosenFrames, OnlyWhatTheFilmShowsCounts) {
  const auto log = line();
  EXPECT_THAT(told(moments_of(log, {check("length", true, 1), check("torque", false, 4.9)}, 1.5, 3.8)),
              ElementsAre("2 cut", "3 fault", "3.8 last picture", "3.5 cut to 760 mm"))
      << "not the first of the run, and the worst is not in it";
}

TEST(ChosenFrames, AFailedCheckIsShownWhereItFirstFailed) {
  auto failed = check("torque", false, 3.2);
  failed.failed_at = 2.2;
  EXPECT_THAT(told(moments_of({}, {failed}, 0, 5)), ElementsAre("2.2 failed: torque", "5 last picture"));
}

TEST(ChosenFrames, StandForTheirMomentsAndFillTheWidestGaps) {
  const std::vector<Moment> moments = {{1.02, "first cut"}, {1.98, "fault"}, {2.01, "worst cut"}, {5, "end"}};
  EXPECT_THAT(told(chosen_frames(times(50), moments, 3)),
              ElementsAre("9 first cut", "19 fault, worst cut", "49 end"));
  EXPECT_THAT(told(chosen_frames(times(50), moments, 5)),
              ElementsAre("9 first cut", "19 fault, worst cut", "26 ", "34 ", "49 end"));
  EXPECT_THAT(told(chosen_frames(times(50), moments, 1)), ElementsAre("9 first cut"));
}

TEST(ChosenFrames, AFilmInWhichNothingHappensIsShownFromItsWayToItsEnd) {
  EXPECT_THAT(told(chosen_frames(times(50), {{5, "end"}}, 4)), ElementsAre("12 ", "21 ", "31 ", "49 end"));
  EXPECT_THAT(told(chosen_frames(times(2), {{5, "end"}}, 6)), ElementsAre("0 ", "1 end"));
  EXPECT_THAT(told(chosen_frames(times(1), {{5, "end"}}, 6)), ElementsAre("0 end"));
  EXPECT_THAT(told(chosen_frames({}, {{5, "end"}}, 6)), IsEmpty());
}

TEST(ChosenFrames, AFilmAboutAnEventIsShownFromItsBeginning) {
  EXPECT_THAT(told(chosen_frames(times(9), moments_around(0.52, 0.1, 0.9), 5)),
              ElementsAre("0 ", "2 ", "4 ", "6 ", "8 "));
}

TEST(ChosenFrames, ThePosterIsTheMachineAtWork) {
  EXPECT_EQ(poster_frame(times(50), {{1.02, "first cut"}, {5, "end"}}), 9U);
  EXPECT_EQ(poster_frame(times(50), {{5, "end"}, {2, "knife crash"}}), 19U) << "not the end";
  EXPECT_EQ(poster_frame(times(50), {{5, "end"}}), 25U);
}

}  // namespace
}  // namespace drycut::sim::report
