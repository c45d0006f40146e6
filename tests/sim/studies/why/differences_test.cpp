#include "sim/studies/why/differences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drycut::sim::studies {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

scenario::YamlNode tree(const std::string& text) {
  scenario::Findings findings({"test"});
  auto root = scenario::parse_yaml(text, 0, findings);
  EXPECT_TRUE(findings.empty());
  return root;
}

/// All differences; `side` decides of each.
std::vector<std::string> differences(const std::string& good, const std::string& failed) {
  std::vector<std::string> all;
  mixed_tree(tree(good), tree(failed), [&](const Difference& one) {
    all.push_back(one.text());
    return TakenSide::good;
  });
  return all;
}
std::string mixed(const std::string& good, const std::string& failed, const Take& take) {
  return text_of(mixed_tree(tree(good), tree(failed), take));
}

constexpr auto* good =
    "scene: {step: 100 us}\nplants: {web: {speed: 60 m/min, wheel: {slip: 0 %}}}\n"
    "tasks: [a.mod, b.mod]\ntimeline: [{at: 1 s, set: {panel.start: 1}}]\n";
constexpr auto* failed =
    "scene: {step: 50 us}\nplants: {web: {speed: 60 m/min, wheel: {slip: 1 %}, name: new}}\n"
    "tasks: [b.mod, a.mod]\n"
    "timeline: [{at: 1 s, set: {panel.start: 1}}, {at: 2 s, fault: {knife.encoder: {lose_counts: 5}}}]\n";

TEST(Differences, AreValuesEntriesAndListsByTheirPaths) {
  EXPECT_THAT(differences(good, failed),
              ElementsAre("scene.step: 100 us -> 50 us", "plants.web.wheel.slip: 0 % -> 1 %",
                          "plants.web.name: with new", "tasks: [a.mod, b.mod] -> [b.mod, a.mod]",
                          "timeline[1]: with {at: 2 s, fault: {knife.encoder: {lose_counts: 5}}}"));
  EXPECT_THAT(differences(good, good), IsEmpty());
}

TEST(Differences, OfAMixtureAreThoseThatWereNotTaken) {
  const auto all = [](TakenSide side) { return [side](const Difference&) { return side; }; };
  EXPECT_EQ(mixed(good, failed, all(TakenSide::good)), text_of(tree(good)));
  EXPECT_EQ(mixed(good, failed, all(TakenSide::failed)), text_of(tree(failed)));
  for (int only = 0; only < 5; ++only) {
    int number = 0;
    const auto one = mixed(good, failed, [&](const Difference&) {
      return number++ == only ? TakenSide::failed : TakenSide::good;
    });
    EXPECT_EQ(number, 5);
    EXPECT_EQ(differences(good, one).size(), 1U);
    EXPECT_EQ(differences(one, failed).size(), 4U);
  }
}

TEST(Differences, ALateEntryStaysButIsNeverDue) {
  const auto late =
      mixed("timeline: [{at: 1 s, power: on}]", "timeline: [{at: 1 s, power: on}, {at: 2 s, power: off}]",
            [](const Difference&) { return TakenSide::late; });
  EXPECT_THAT(differences(late, "timeline: [{at: 1 s, power: on}, {at: 1e6 s, power: off}]"), IsEmpty());
}

TEST(Differences, ChecksAndPlantsGoByTheirNames) {
  EXPECT_THAT(differences("checks: [{name: a, always: x < 1}, {name: b, always: y < 1}]",
                          "checks: [{name: b, always: y < 2}]"),
              ElementsAre("checks[a]: without {name: a, always: x < 1}", "checks[b].always: y < 1 -> y < 2"));
}

TEST(Differences, OfTextsAreLinesWhereAsManyStandForAsMany) {
  std::vector<std::string> all;
  const auto take = [&](TakenSide side) {
    return [&all, side](const Difference& one) {
      all.push_back(one.text());
      return side;
    };
  };
  const std::string before = "a\nb\nc\nd\ne\n";
  const std::string after = "a\nB\nC\nd\nx\ny\ne\n";
  EXPECT_EQ(mixed_lines("knife.mod", before, after, take(TakenSide::good)), before);
  EXPECT_THAT(
      all, ElementsAre("knife.mod:2: 'b' -> 'B'", "knife.mod:3: 'c' -> 'C'", "knife.mod:5-6: with 'x\ny'"));
  EXPECT_EQ(mixed_lines("knife.mod", before, after, take(TakenSide::failed)), after);
  EXPECT_EQ(mixed_lines("a", "no end", "", take(TakenSide::failed)), "");
  EXPECT_EQ(mixed_lines("a", "", "no end", take(TakenSide::failed)), "no end");
}

TEST(Differences, ProgramsWithOtherNumbersAloneHaveTheSameStatements) {
  EXPECT_TRUE(same_but_numbers("AxisX.pgain = 50", "AxisX.pgain = 5.5"));
  EXPECT_FALSE(same_but_numbers("AxisX.pgain = 50", "AxisX.igain = 50"));
  EXPECT_FALSE(same_but_numbers("x = 5", "x = y"));
}

TEST(Differences, APresetIsToldByItsName) {
  Difference one{Difference::Kind::value, "controller.qmove.set.AxisX.pgain", "1", "2"};
  EXPECT_EQ(one.preset(), "AxisX.pgain");
  one.where = "plants.web.speed";
  EXPECT_EQ(one.preset(), "");
}

}  // namespace
}  // namespace drycut::sim::studies
