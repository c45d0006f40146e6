// Several machines on one web: what each finds at its place, cuts, hands on and drops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plants/rotary_knife.hpp"
#include "tests/plants/flying_saw_line.hpp"

namespace drycut::plants {
namespace {

/// A web and its stations, stepped by hand.
struct StationLine {
  World world{1};
  std::unique_ptr<Plant> supply;
  std::vector<std::unique_ptr<Plant>> stations;
  std::vector<std::vector<MachineEvent>> events;  ///< of each station

  explicit StationLine(WebData web) {
    WebDefinition definition;
    definition.data = std::move(web);
    supply = definition.build(world, nullptr);
  }
  template <class Definition>
  void add(Definition definition) {
    stations.push_back(definition.build(world, [this](std::string_view) { return supply.get(); }));
    events.emplace_back();
  }
  Web& web() { return static_cast<Web&>(*supply); }
  RotaryKnife& knife(std::size_t i) { return static_cast<RotaryKnife&>(*stations[i]); }
  FlyingSaw& saw(std::size_t i) { return static_cast<FlyingSaw&>(*stations[i]); }
  void step(double dt = h) {
    supply->drive(dt);
    for (auto& station : stations) station->drive(dt);
    world.step(dt);
    supply->sense(dt);
    for (std::size_t i = 0; i < stations.size(); ++i) {
      stations[i]->sense(dt);
      for (MachineEvent& event : stations[i]->take_events())
        if (event.name != "saturated") events[i].push_back(std::move(event));
    }
  }
  void run(double seconds, double dt = h) {
    for (long i = std::lround(seconds / dt); i > 0; --i) step(dt);
    ASSERT_EQ(world.failure(), "");
  }
  /// Both drums at web speed from the start; the servo's filter holds them back by `late` of the web.
  static constexpr double late = 0.4068;  // [mm]
  void spin(double speed = 1) {
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const double turning = speed / knife(i).radius();
      knife(i).drum().speed = turning;
      knife(i).rotor().speed = turning * 5;
      plug<ReferencePort>(*stations[i], "servo.reference").volts = 2.5 * speed;
    }
  }
  std::vector<MachineEvent> only(std::size_t station, const std::string& name) {
    std::vector<MachineEvent> found;
    for (const MachineEvent& event : events[station])
      if (event.name == name) found.push_back(event);
    return found;
  }
};

/// A knife of 600 mm whose blade touches the web without pulling at it, at a place [m].
RotaryKnifeDefinition knife_at(double place, double coupling = 0) {
  RotaryKnifeDefinition definition;
  definition.data.station.place = place;
  definition.data.coupling = coupling;
  return definition;
}

/// Pieces keep their distance: the belt is as fast as the line.
WebData line_of(double belt_end = 5) {
  WebData data;
  data.outfeed.speed_factor = 1;
  data.outfeed.length = belt_end - data.outfeed.start;
  return data;
}

TEST(Stations, APieceIsHalvedDownTheLine) {
  for (const double coupling : {0.0, 2000.0}) {
    StationLine line(line_of());
    line.add(knife_at(0, coupling));
    line.add(knife_at(3.3, coupling));  // five and a half pieces
    line.spin();
    line.run(8);
    const auto first = line.only(0, "cut");
    const auto second = line.only(1, "cut");
    // The web's first end comes to 3.3 m after 3.3 s; it was cut off at 0.3 m, each piece behind it is 600
    // mm.
    ASSERT_EQ(first.size(), 13U);
    ASSERT_GE(second.size(), 6U);
    for (std::size_t i = 1; i < second.size(); ++i) {
      EXPECT_NEAR(value(second[i], "length"), 300, coupling > 0 ? 0.5 : 1e-3) << i;
      EXPECT_NEAR(value(second[i], "length") + value(second[i], "rest"), value(first[i], "length"), 1e-6)
          << i;
      EXPECT_LT(value(second[i], "mismatch"), 15) << i;
      EXPECT_NEAR(value(second[i], "force"), 1500, 2) << i;
      EXPECT_EQ(value(second[i], "number"), static_cast<double>(i + 1)) << i;
    }
    EXPECT_EQ(channel(line.web(), "pieces"), static_cast<double>(first.size() + second.size()));
    EXPECT_EQ(value(first[0], "number"), 1);
    for (const MachineEvent::Value& v : first[0].values) EXPECT_NE(v.name, "rest");
  }
}

TEST(Stations, WhatIsNotThereIsNotCut) {
  StationLine line(line_of());
  line.add(knife_at(0));
  line.add(knife_at(3.3));
  line.spin();
  line.run(3.25);
  EXPECT_GE(line.only(0, "cut").size(), 5U);
  EXPECT_THAT(line.events[1], testing::IsEmpty());
  EXPECT_EQ(line.stations[1]->channels().empty(), false);
  EXPECT_EQ(channel(*line.stations[1], "cut.number"), 0);
  EXPECT_EQ(channel(*line.stations[1], "cut.force"), 0);
}

TEST(Stations, TheOnlyOneCutsTheWebAtItsPlace) {
  StationLine line(line_of());
  line.add(knife_at(0.5));
  line.spin();
  line.run(3);
  // The blade is down at 0.3, 0.9 ... m of travel; before 0.5 m the web is not there.
  const auto cuts = line.only(0, "cut");
  ASSERT_EQ(cuts.size(), 4U);
  EXPECT_NEAR(value(cuts[0], "length"), 400 + StationLine::late, 1e-3);
  EXPECT_NEAR(value(cuts[1], "length"), 600, 1e-3);
  EXPECT_EQ(value(cuts[1], "rest"), 0);
}

TEST(Stations, AFasterBeltOpensGapsAndTheKnifeCutsWhatHasCome) {
  WebData web = line_of();
  web.outfeed.speed_factor = 1.25;
  StationLine line(web);
  line.add(knife_at(0));
  line.add(knife_at(3.3));
  line.spin();
  double head = 0;
  std::size_t seen = 0;
  int checked = 0;
  for (int i = 0; i < 80000; ++i) {
    const Slide* under = line.web().lying_at(3.3);
    if (under != nullptr && under != &line.web().material())
      head = under->position + line.web().outfeed().piece_of(*under).length / 2;
    line.step();
    const auto cuts = line.only(1, "cut");
    if (cuts.size() == seen) continue;
    seen = cuts.size();
    // The head was where it was at the step's start, and not a step's way further.
    EXPECT_NEAR(value(cuts.back(), "length") / 1000, head - 3.3 + 1.25 * h / 2, 1.25 * h);
    ++checked;
  }
  EXPECT_GE(checked, 5);
}

TEST(Stations, ShortPiecesAndEverySecondOneDropOut) {
  {
    auto trimming = knife_at(0);
    trimming.data.station.scrap_shorter = 0.35;
    StationLine line(line_of());
    line.add(trimming);
    line.spin();
    line.run(2);
    const auto scraps = line.only(0, "scrap");
    ASSERT_EQ(scraps.size(), 1U);  // the first piece of 300 mm
    EXPECT_NEAR(value(scraps[0], "length"), 300 + StationLine::late, 1e-3);
    EXPECT_EQ(value(scraps[0], "number"), 1);
    EXPECT_EQ(line.only(0, "cut").size(), 3U);
    EXPECT_EQ(channel(line.web(), "outfeed.pieces"), 2);
    EXPECT_EQ(channel(line.web(), "scrap.pieces"), 1);
    EXPECT_NEAR(channel(line.web(), "scrap.length"), 300 + StationLine::late, 1e-3);
  }
  {
    auto second = knife_at(3.3);
    second.data.station.scrap_every = 2;
    StationLine line(line_of());
    line.add(knife_at(0));
    line.add(second);
    line.spin();
    line.run(7);
    const auto cuts = line.only(1, "cut");
    const auto scraps = line.only(1, "scrap");
    ASSERT_EQ(cuts.size(), 7U);
    ASSERT_EQ(scraps.size(), 3U);
    for (std::size_t i = 0; i < scraps.size(); ++i) {
      EXPECT_EQ(value(scraps[i], "length"), value(cuts[2 * i + 1], "length"));
      EXPECT_EQ(value(scraps[i], "number"), static_cast<double>(i + 1));
      EXPECT_EQ(scraps[i].fraction, cuts[2 * i + 1].fraction);
    }
    EXPECT_NEAR(value(scraps[2], "total"), 900, 1e-2);
    EXPECT_NEAR(channel(line.web(), "scrap.length"), 900, 1e-2);
    EXPECT_THAT(line.only(0, "scrap"), testing::IsEmpty());
  }
  {
    // A web that has run back leaves nothing that could drop out.
    auto knife = knife_at(0);
    knife.data.station = {.scrap_shorter = 1, .scrap_every = 1};
    WebData back = line_of();
    back.lead = -0.5;
    StationLine line(back);
    line.add(knife);
    line.spin();
    line.run(0.4);
    ASSERT_EQ(line.only(0, "cut").size(), 1U);
    EXPECT_LT(value(line.only(0, "cut")[0], "length"), 0);
    EXPECT_THAT(line.only(0, "scrap"), testing::IsEmpty());
  }
  const auto offers = [](int every) {
    auto knife = knife_at(0);
    knife.data.station.scrap_every = every;
    StationLine line(line_of());
    line.add(knife);
    for (const EventType& type : line.stations[0]->event_types())
      if (type.name == "scrap") return true;
    return false;
  };
  EXPECT_TRUE(offers(2));
  EXPECT_FALSE(offers(0));
}

TEST(Stations, RegisterIsThatOfTheMarksOnWebAndPiece) {
  WebData web = line_of();
  web.marks.pitch = 0.6;
  web.marks.offset = -0.3;  // marks at 300, 900 ... mm: those of the first knife's cuts
  web.marks.delay = 0;
  StationLine line(web);
  line.add(knife_at(0));
  line.add(knife_at(3.4));
  line.spin();
  line.run(8);
  const auto first = line.only(0, "cut");
  const auto second = line.only(1, "cut");
  ASSERT_GE(second.size(), 5U);
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_NEAR(value(first[i], "register"), StationLine::late, 1e-3);
  // At X = 0.3 + 0.6 n the place is over the mark X - 3.4, 0.2 m in front of the nearest.
  for (std::size_t i = 0; i < second.size(); ++i)
    EXPECT_NEAR(value(second[i], "register"), 200 + StationLine::late, 1e-3) << i;
}

/// A tube of 2 m before the cut, at 0.5 m/s, and a saw at 1 m that runs with it.
struct SawDownTheLine : StationLine {
  static WebData long_tube() {
    WebData data = tube(0.5).data;
    data.lead = 2;
    data.outfeed = {.speed_factor = 1, .start = 0.15, .length = 5};
    return data;
  }
  SawDownTheLine() : StationLine(long_tube()) {
    auto definition = free_saw();
    definition.data.station.place = 1;
    definition.data.start = 0.1;
    definition.data.clamp.force = 0;
    add(definition);
    saw(0).carriage().speed = 0.5;
    saw(0).rotor().speed = 0.5 / 0.2 * turn * 4;
  }
  double blade() { return channel(*stations[0], "blade.engaged"); }
};

TEST(Stations, ASawCutsTheWebAtItsPlace) {
  SawDownTheLine line;
  plug<CommandPort>(*line.stations[0], "head.plunge").level = true;
  line.run(0.6);
  const auto cuts = line.only(0, "cut");
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_NEAR(value(cuts[0], "length"), 900, 0.01);  // 2000 - 1000 - 100
  EXPECT_EQ(value(cuts[0], "rest"), 0);
}

TEST(Stations, ASawKeepsItsPlaceOnThePieceThatIsCutOffBehindIt) {
  SawDownTheLine line;
  plug<CommandPort>(*line.stations[0], "head.plunge").level = true;
  while (line.blade() == 0) line.step();
  line.run(0.01);
  ASSERT_EQ(line.blade(), 1);
  const double whole = line.web().separate(1);
  line.run(0.5);
  const auto cuts = line.only(0, "cut");
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_NEAR(value(cuts[0], "length"), 900, 0.02);
  EXPECT_NEAR(value(cuts[0], "rest"), whole * 1000 - 900, 0.02);
  EXPECT_NEAR(value(cuts[0], "slant"), 0, 0.02);
  EXPECT_EQ(channel(line.web(), "outfeed.pieces"), 2);
}

TEST(Stations, ASawOverNothingCutsNothing) {
  WebData data = tube(0.5).data;
  data.outfeed = {.speed_factor = 1, .start = 0.15, .length = 5};
  StationLine line(data);
  auto definition = free_saw();
  definition.data.station.place = 1;
  line.add(definition);
  plug<CommandPort>(*line.stations[0], "head.plunge").level = true;
  plug<CommandPort>(*line.stations[0], "clamp").level = true;
  line.run(0.6);
  EXPECT_EQ(channel(*line.stations[0], "head.down"), 1);
  EXPECT_THAT(line.events[0], testing::IsEmpty());
  EXPECT_NEAR(line.saw(0).carriage().speed, 0, 1e-9);
}

TEST(Stations, ABladeOnALightWebIsFollowedInAnyStep) {
  WebData web = line_of();
  web.strip.on = true;
  web.thickness = 0.2e-3;
  web.strip.wheel_mass = 0.5;
  const auto cut = [&](double dt) {
    StationLine line(web);
    line.add(knife_at(0, 2000));
    line.spin(1.02);
    line.run(2, dt);
    const auto cuts = line.only(0, "cut");
    EXPECT_EQ(cuts.size(), 3U);
    EXPECT_EQ(line.events[0].size(), 3U);  // no tear, no buckle
    return cuts.back();
  };
  const MachineEvent coarse = cut(1e-4);
  const MachineEvent fine = cut(2e-6);
  EXPECT_NEAR(value(coarse, "length"), value(fine, "length"), 0.3);
  EXPECT_NEAR(value(coarse, "mismatch"), value(fine, "mismatch"), 10);
}

TEST(Stations, TheyStandAtTheirPlaceInPicturesAndTheBeltLeavesThemRoom) {
  StationLine line(line_of());
  line.add(knife_at(0));
  line.add(knife_at(3.3));
  for (const char* part : {"drum", "blade 1", "base", "motor", "encoder disc"}) {
    const auto here = pose_of(*line.stations[0], part).pose.position;
    const auto there = pose_of(*line.stations[1], part).pose.position;
    EXPECT_NEAR(there[0] - here[0], 3.3, 1e-12) << part;
    EXPECT_NEAR(there[1], here[1], 1e-12) << part;
  }
  const double radius = 0.6 / turn;
  double belts = 0;
  for (const Part& part : line.web().parts()) {
    if (!part.name.starts_with("outfeed belt")) continue;
    const double middle = part.now().pose.position[0];
    EXPECT_TRUE(middle + part.size[0] / 2 < 3.3 - radius || middle - part.size[0] / 2 > 3.3 + radius)
        << part.name;
    belts += part.size[0];
  }
  EXPECT_NEAR(belts, 5 - 0.15 - 2 * radius - 0.12, 1e-9);
}

TEST(Stations, APlaceBehindTheBeltIsRefused) {
  const std::string refused = "place: the outfeed belt ends at 2150 mm: it brings no piece to 2150 mm";
  WebDefinition web = tube(0);
  web.data.outfeed.start = 0.15;
  FlyingSawDefinition saw;
  saw.data.station.place = 2.15;
  EXPECT_THAT(objections_of(saw, h, &web), testing::ElementsAre(refused));
  saw.data.station.place = 2.14;
  EXPECT_THAT(objections_of(saw, h, &web), testing::IsEmpty());
  WebDefinition strip;
  RotaryKnifeDefinition knife = knife_at(2.15);
  EXPECT_THAT(objections_of(knife, h, &strip), testing::ElementsAre(refused));
  knife.data.station.place = 2.14;
  EXPECT_THAT(objections_of(knife, h, &strip), testing::IsEmpty());
  EXPECT_NEAR(knife_at(3.3).stretch()->from, 3.3 - 0.6 / turn, 1e-12);
  EXPECT_NEAR(knife_at(3.3).stretch()->to, 3.3 + 0.6 / turn, 1e-12);
  saw.data.station.place = 2;
  EXPECT_NEAR(saw.stretch()->from, 1.96, 1e-12);
  EXPECT_NEAR(saw.stretch()->to, 2.76, 1e-12);
}

}  // namespace
}  // namespace drycut::plants
