// When a film's frames are too far apart to show how something turns.
#include "sim/loop/strobe.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "sim/loop/simulation.hpp"
#include "sim/report/film.hpp"
#include "tests/findings.hpp"

namespace drycut::sim::loop {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<Snapshot> frames(const std::vector<std::vector<double>>& turned) {
  std::vector<Snapshot> all(turned.size());
  for (std::size_t i = 0; i < turned.size(); ++i) all[i].turned = turned[i];
  return all;
}

TEST(Strobe, IsMoreThanHalfAPitchFromFrameToFrame) {
  const std::vector<PartWithPitch> parts = {{"knife.drum", 1.0}, {"saw.blade", 3.0}};
  const auto found = strobes(parts, frames({{9, 9}, {0.5, 1.5}, {0.51, 0}, {0.6, 6}}));
  ASSERT_EQ(found.size(), 4U);
  EXPECT_FALSE(found[0]) << "there is no frame before";
  EXPECT_FALSE(found[1]) << "just half";
  ASSERT_TRUE(found[2] && found[3]);
  EXPECT_EQ(found[2]->part, "knife.drum");
  EXPECT_DOUBLE_EQ(found[2]->pitches, 0.51);
  EXPECT_EQ(found[3]->part, "saw.blade") << "by its pitch it turned further";
  EXPECT_DOUBLE_EQ(found[3]->pitches, 2);
  EXPECT_DOUBLE_EQ(worst_strobe(found)->pitches, 2);
  EXPECT_FALSE(worst_strobe({std::nullopt}));
}

TEST(Strobe, NamesTheFramesThatWouldShowIt) {
  scenario::PicturesSection pictures;
  pictures.every = 40 * millisecond;
  const auto told = [&](double pitches, Time step = 100 * microsecond) {
    return text_of({"knife.drum", pitches}, pictures, step);
  };
  EXPECT_THAT(told(0.8), AllOf(HasSubstr("knife.drum turns by up to 0.8 of its pitches"),
                               HasSubstr("frames.every: 10 ms shows")));  // 12.5
  EXPECT_THAT(told(1), HasSubstr("frames.every: 10 ms shows"));
  EXPECT_THAT(told(4), HasSubstr("frames.every: 2 ms shows"));       // 2.5
  EXPECT_THAT(told(10.2), HasSubstr("frames.every: 500 us shows"));  // 0.98
  EXPECT_THAT(told(10.2, 300 * microsecond), HasSubstr("frames.every: 300 us shows"));
  EXPECT_THAT(told(200), HasSubstr("no frames.every of whole steps shows"));  // 50 us
  pictures.slow = 10;
  EXPECT_THAT(told(4), HasSubstr("frames.every: 2 ms shows")) << "a frame every 200 us";
  EXPECT_THAT(told(20), HasSubstr("no frames.every")) << "500 us / 10 is less than a step";
}

/// The shipped line with frames every so often; drum with four blades' pitch if there are four.
struct Line {
  explicit Line(const std::string& every, const std::string& from = "3 s") {
    scenario = scenario::read_scenario(
        std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/rotary_knife.yaml",
        {{"scene.duration", "3.4 s"}, {"pictures.frames.every", every}, {"pictures.frames.from", from}},
        problems);
    simulation.emplace(scenario, problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    simulation->run();
  }
  Problems problems;
  scenario::Scenario scenario;
  std::optional<Simulation> simulation;
};

TEST(Strobe, NoteAndCaptionSaySoWhereItHappensAndNowhereElse) {
  // Pieces of 800 mm at 1 m/s from a drum of one blade: 0.8 s a turn, faster around the cut.
  Line slow("200 ms");
  EXPECT_THAT(codes(slow.simulation->notes()), Not(Contains("pictures.strobe")));
  for (const auto& frame : report::film_of(slow.scenario, *slow.simulation).frames)
    for (const auto& item : frame.caption) EXPECT_NE(item.label, "strobe effect");

  Line fast("400 ms", "2.2 s");
  const auto notes = sentences(fast.simulation->notes());
  const auto film = report::film_of(fast.scenario, *fast.simulation);
  const auto worst = worst_strobe(fast.simulation->strobes());
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->part, "knife.drum");
  // What the drum really turned, from the film's own poses.
  EXPECT_THAT(notes,
              Contains(AllOf(HasSubstr("stroboscopic effect: knife.drum"), HasSubstr("frames.every: "))));
  EXPECT_EQ(film.frames.at(0).caption.back().value, "none");
  bool told = false;
  for (const auto& frame : film.frames) {
    ASSERT_EQ(frame.caption.back().label, "strobe effect");
    told = told || frame.caption.back().value.starts_with("knife.drum by ");
  }
  EXPECT_TRUE(told);
}

TEST(Strobe, WhatIsTraced) {
  // The keys of the film see every turn: between two of them no part turns further than 30 degrees, at 3000
  // rpm and more of the motor and a frame every 400 ms.
  Line line("400 ms", "2.2 s");
  const auto film = report::film_of(line.scenario, *line.simulation);
  std::size_t keys = 0;
  std::vector<renders::Placement> last = film.frames.at(0).placements;
  const auto go_on = [&](std::size_t part, const renders::Placement& now) {
    if (now.visible && last[part].visible) {
      const double along = std::abs(now.rotation.normalized().dot(last[part].rotation.normalized()));
      EXPECT_LE(2 * std::acos(std::min(1.0, along)), 30.01 * std::numbers::pi / 180) << film.parts[part].name;
    }
    last[part] = now;
  };
  EXPECT_TRUE(film.frames[0].before.empty());
  for (std::size_t f = 1; f < film.frames.size(); ++f) {
    keys += film.frames[f].before.size();
    for (const auto& way : film.frames[f].before) go_on(way.part, way.placement);
    for (std::size_t part = 0; part < film.parts.size(); ++part) go_on(part, film.frames[f].placements[part]);
  }
  EXPECT_GT(keys, 50U);
}

}  // namespace
}  // namespace drycut::sim::loop
