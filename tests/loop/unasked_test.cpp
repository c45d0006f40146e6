// Events that are failures fail a run that does not ask about them.
#include "sim/loop/unasked.hpp"

#include <gmock/gmock.h>

namespace drycut::sim::loop {
namespace {

const std::vector<KnownEvent> events = {{"tube", "held_back", {}, Severity::error}, {"saw", "cut", {}}};

record::RecordedEvent held(double at) {
  return {static_cast<Time>(at * 1e9), 0, "tube", "held_back", {{"force", 1500, "N"}}, ""};
}

scenario::Scenario asking(const std::string& event) {
  scenario::Scenario scenario;
  scenario::CheckRequest check;
  check.kind = scenario::CheckRequest::Kind::never;
  check.event.text = event;
  if (!event.empty()) scenario.checks.push_back(check);
  return scenario;
}

TEST(Unasked, AFailureThatNoCheckAsksAboutIsAFailedCheck) {
  const auto scenario = asking("");
  Unasked unasked(scenario, events);
  EXPECT_TRUE(unasked.results().empty()) << "it did not happen";
  unasked.happened({0, 0, "saw", "cut", {}, ""});
  EXPECT_TRUE(unasked.results().empty());
  unasked.happened(held(2));
  unasked.happened(held(3));
  const auto results = unasked.results();
  ASSERT_EQ(results.size(), 1U);
  EXPECT_FALSE(results[0].passed);
  EXPECT_EQ(results[0].name, "no tube.held_back");
  EXPECT_EQ(results[0].detail, "2 times, first at 2 s: force=1500 N");
  EXPECT_EQ(results[0].failed_at, 2);
}

TEST(Unasked, ACheckThatNamesTheEventDecidesAlone) {
  for (const auto* name : {"held_back", "tube.held_back"}) {
    const auto scenario = asking(name);
    Unasked unasked(scenario, events);
    unasked.happened(held(2));
    EXPECT_TRUE(unasked.results().empty()) << name;
  }
  const auto other = asking("web.held_back");
  Unasked unasked(other, events);
  unasked.happened(held(2));
  EXPECT_EQ(unasked.results().size(), 1U);
}

}  // namespace
}  // namespace drycut::sim::loop
