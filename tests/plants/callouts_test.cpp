// What a picture points out on a machine and what it shows of print: against where things are and what acts.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "plants/rotary_knife.hpp"
#include "tests/plants/flying_saw_line.hpp"
#include "tests/plants/web_line.hpp"

namespace drycut::plants {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

std::vector<Callout> callouts_of(Plant& plant, Callout::Kind kind) {
  std::vector<Callout> all;
  plant.callouts(all);
  std::erase_if(all, [&](const Callout& one) { return one.kind != kind; });
  return all;
}
std::vector<Callout> named(Plant& plant, const std::string& text) {
  auto all = callouts_of(plant, Callout::Kind::force);
  std::erase_if(all, [&](const Callout& one) { return one.text != text; });
  return all;
}

TEST(Callouts, AWebWithoutPiecesPointsOutNothing) {
  WebLine line;
  line.run(0.2);
  EXPECT_THAT(callouts_of(line.web, Callout::Kind::length), IsEmpty());
}

TEST(Callouts, EveryPieceOnTheBeltTellsItsLengthFromEndToEnd) {
  WebLine line;
  line.run(0.8);
  line.web.separate(1, line.web.travel(1));
  line.run(0.5012);
  line.web.separate(1, line.web.travel(1));
  line.run(0.2);
  const auto lengths = callouts_of(line.web, Callout::Kind::length);
  ASSERT_THAT(lengths, SizeIs(2));
  EXPECT_EQ(lengths[0].text, "800.0 mm");
  EXPECT_EQ(lengths[1].text, "501.2 mm");
  for (const auto& one : lengths) {
    EXPECT_NEAR((one.to[0] - one.at[0]) * 1e3, std::stod(one.text), 0.05 + 1e-9)
        << "the text is the distance";
    EXPECT_EQ(one.at[1], one.to[1]);
    EXPECT_EQ(one.at[2], one.to[2]);
    EXPECT_GT(one.at[2], 0) << "on the operator's side";
  }
  // The piece is where its part is drawn.
  int drawn = 0;
  for (const Part& part : line.web.parts()) {
    const PartPose pose = part.now();
    if (!part.name.starts_with("piece ") || !pose.visible) continue;
    const auto& one = lengths.at(static_cast<std::size_t>(drawn++));
    EXPECT_NEAR(pose.pose.position[0], (one.at[0] + one.to[0]) / 2, 1e-9);
    EXPECT_NEAR(pose.scale[0], one.to[0] - one.at[0], 1e-9);
  }
  EXPECT_EQ(drawn, 2);
}

TEST(Callouts, APieceThatHasLeftTheBeltIsPointedOutNoMore) {
  WebLine line;
  line.run(0.5);
  line.web.separate(1, line.web.travel(1));
  line.run(0.5);
  EXPECT_THAT(callouts_of(line.web, Callout::Kind::length), SizeIs(1));
  line.run(3);
  EXPECT_THAT(callouts_of(line.web, Callout::Kind::length), IsEmpty());
}

TEST(Callouts, TheKnifesForceIsThatOfItsCutUpwardsAndThereOnlyDuringIt) {
  RotaryKnifeDefinition definition;
  WebDefinition web;
  Machine line(definition, &web);
  line.reference(2.5);
  double largest = 0;
  int with = 0, without = 0;
  for (int i = 0; i < 20'000; ++i) {
    line.step();
    const auto forces = named(*line.plant, "cut");
    ASSERT_LE(forces.size(), 1U);
    ++(forces.empty() ? without : with);
    if (forces.empty()) continue;
    EXPECT_EQ(forces[0].at[0], 0) << "at the cut";
    EXPECT_EQ(forces[0].to[0], 0);
    EXPECT_EQ(forces[0].to[2], 0);
    EXPECT_GT(forces[0].to[1], 0);
    largest = std::max(largest, forces[0].to[1]);
  }
  double cut = 0;
  for (const MachineEvent& event : line.events)
    if (event.name == "cut") cut = std::max(cut, value(event, "force"));
  EXPECT_NEAR(largest, cut, 1e-9 * cut);
  EXPECT_GT(with, 0);
  EXPECT_GT(without, 10 * with) << "a cut is short";
}

TEST(Callouts, TheSawsClampsPressDownOnBothSidesOfTheBladeWhileTheyAreClosed) {
  SawLine line(frictionless_saw(), tube(0));
  line.run(0.1);
  EXPECT_THAT(named(*line.plant, "clamp"), IsEmpty());
  line.command("clamp", true);
  line.run(0.5);
  const auto clamps = named(*line.plant, "clamp");
  ASSERT_THAT(clamps, SizeIs(2));
  const double x = line.carriage().position;
  EXPECT_NEAR(clamps[0].at[0] + clamps[1].at[0], 2 * x, 1e-12);
  EXPECT_LT(clamps[0].at[0], x);
  for (const auto& one : clamps) {
    EXPECT_LT(one.to[1], 0) << "down";
    EXPECT_EQ(one.to, clamps[0].to) << "the same on both sides";
  }
  line.command("clamp", false);
  line.run(0.5);
  EXPECT_THAT(named(*line.plant, "clamp"), IsEmpty());
}

TEST(Callouts, TheSawTellsTheSpeedsOfTubeAndCarriageEachAsItIs) {
  SawLine line(free_saw(), tube(0.5));
  const auto speeds = [&] { return callouts_of(*line.plant, Callout::Kind::speed); };
  ASSERT_THAT(speeds(), SizeIs(2));
  EXPECT_EQ(speeds()[0].text, "tube");
  EXPECT_EQ(speeds()[1].text, "carriage");
  using Along = std::array<double, 3>;
  EXPECT_EQ(speeds()[0].to, (Along{line.material().speed, 0, 0}));
  EXPECT_NEAR(line.material().speed, 0.5, 1e-6);
  EXPECT_EQ(speeds()[1].to, (Along{0, 0, 0})) << "it stands";
  line.carriage().speed = -0.25;
  line.carriage().position += 0.1;
  const auto before = speeds()[1].at[0];
  EXPECT_EQ(speeds()[1].to, (Along{-0.25, 0, 0})) << "against the line";
  line.carriage().position += 0.1;
  EXPECT_NEAR(speeds()[1].at[0] - before, 0.1, 1e-12) << "it goes along";
  WebDefinition strip = free_web(0.5);
  SawLine other(free_saw(), strip);
  EXPECT_EQ(callouts_of(*other.plant, Callout::Kind::speed).at(0).text, "web");
}

TEST(Callouts, TheSawsCutIsPointedOutAtTheBladeWhileItCuts) {
  SawLine line(frictionless_saw(), tube(0));
  line.command("clamp", true);
  line.run(0.3);
  EXPECT_THAT(named(*line.plant, "cut"), IsEmpty());
  line.command("head.plunge", true);
  double largest = 0;
  for (int i = 0; i < 20'000 && line.events.empty(); ++i) {
    line.step();
    for (const auto& one : named(*line.plant, "cut")) {
      EXPECT_EQ(one.at[0], line.carriage().position);
      EXPECT_EQ(one.to[0], 0);
      largest = std::max(largest, std::abs(one.to[1]));
    }
  }
  ASSERT_FALSE(line.events.empty());
  EXPECT_EQ(line.events[0].name, "cut");
  EXPECT_NEAR(largest, value(line.events[0], "force"), 1e-6 * largest);
}

// ---- printed marks, as they are drawn ----

struct Print {
  double x;
  double y;
};
std::vector<Print> prints_on(Web& web) {
  std::vector<Print> shown;
  for (const Part& part : web.parts()) {
    const PartPose pose = part.now();
    if (part.name.starts_with("print mark ") && pose.visible)
      shown.push_back({pose.pose.position[0], pose.pose.position[1]});
  }
  std::sort(shown.begin(), shown.end(), [](const Print& a, const Print& b) { return a.x < b.x; });
  return shown;
}
WebData printed(double pitch) {
  WebData data;
  data.marks.pitch = pitch;
  data.marks.delay = 0;
  return data;
}

TEST(PrintMarksShown, APlainWebShowsNone) {
  WebLine line;
  EXPECT_THAT(prints_on(line.web), IsEmpty());
}

TEST(PrintMarksShown, AreAPitchApartOnTheWebAndMoveWithIt) {
  WebLine line(printed(0.3));
  line.run(0.1);
  const auto before = prints_on(line.web);
  ASSERT_GE(before.size(), 5U) << "1.7 m of web in sight";
  for (std::size_t i = 1; i < before.size(); ++i) EXPECT_NEAR(before[i].x - before[i - 1].x, 0.3, 1e-9);
  for (const auto& one : before) EXPECT_GT(one.y, 0) << "on top";
  line.run(0.05);
  const auto after = prints_on(line.web);
  EXPECT_NEAR(std::fmod(after.back().x - before.back().x + 0.6, 0.3), 0.05, 1e-6) << "by 0.05 s at 1 m/s";
}

TEST(PrintMarksShown, AMarkPassesUnderThePhotocellWhenThePhotocellSaysSo) {
  WebLine line(printed(0.3));
  const auto& cell = line.plug<SignalPort>("photocell");
  int edges = 0;
  for (int i = 0; i < 10'000; ++i) {
    line.run(h);
    for (const SignalPort::Edge& edge : cell.edges) {
      if (!edge.rising) continue;
      ++edges;
      // The cell stands 900 mm before the cut; the front edge is half a mark of 5 mm before its middle.
      double nearest = 1;
      for (const auto& one : prints_on(line.web)) nearest = std::min(nearest, std::abs(one.x + 0.9 + 0.0025));
      EXPECT_LT(nearest, 2e-4) << "within two steps of 0.1 mm";
    }
  }
  EXPECT_EQ(edges, 3);
}

TEST(PrintMarksShown, NoneIsShownBeyondTheEndOfTheUncutWeb) {
  WebLine line(printed(0.1));
  line.run(1.03);
  EXPECT_LE(prints_on(line.web).back().x, 1.03 + 1e-9) << "the web's end";
  line.web.separate(1, line.web.travel(1));
  EXPECT_LE(prints_on(line.web).back().x, 1e-9) << "the cut";
  EXPECT_GT(prints_on(line.web).back().x, -0.1 - 1e-9);
}

TEST(PrintMarksShown, MoreThanThereArePartsForAreLeftOut) {
  WebLine line(printed(0.02));
  line.run(0.5);
  EXPECT_THAT(prints_on(line.web), SizeIs(40));
}

}  // namespace
}  // namespace drycut::plants
