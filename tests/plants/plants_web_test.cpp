#include <gtest/gtest.h>

#include <cmath>

#include "tests/plants/web_line.hpp"

namespace drycut::plants {
namespace {

using Line = WebLine;

TEST(Web, RunsAtItsSpeedFromTheStart) {
  Line line;
  line.run(2);
  EXPECT_EQ(line.read("speed"), 60);
  EXPECT_NEAR(line.read("position"), 2000, 1e-8);
  EXPECT_EQ(line.read("drive.force"), 0);
  EXPECT_EQ(line.read("wheel.count"), 40000);
  EXPECT_EQ(line.plug<EncoderPort>("wheel").count, 40000);
}

TEST(Web, FollowsTheSetSpeedWithItsAcceleration) {
  Line line;
  line.set("speed", 2);
  line.run(0.25);  // 2 m/s2
  EXPECT_NEAR(line.read("set_speed"), 90, 1e-6);
  line.run(1);
  EXPECT_NEAR(line.read("speed"), 120, 1e-3);
  // Travel: 0.5 s from 1 to 2 m/s, the rest at 2 m/s; the elastic draw has died away.
  EXPECT_NEAR(line.read("position"), 750 + 1500, 0.2);
  line.set("speed", 0);
  line.run(2);
  EXPECT_NEAR(line.read("speed"), 0, 1e-6);
}

TEST(Web, LineDriveForceIsLimitedAndDoesNotWindUp) {
  Line line;
  double largest = 0;
  for (int i = 0; i < 10000; ++i) {
    line.web.material().add_force(-3000);  // the web is held
    line.step();
    largest = std::max(largest, line.read("drive.force"));
  }
  EXPECT_EQ(largest, 1500);
  double fastest = 0;
  while (line.web.material().speed < 0) line.step();
  for (int i = 0; i < 10000; ++i) {
    line.step();
    fastest = std::max(fastest, line.web.material().speed);
  }
  EXPECT_LT(fastest, 1.6);
  EXPECT_NEAR(line.web.material().speed, 1, 1e-6);
}

TEST(Web, PieceLengthIsTheTravelBetweenTwoCuts) {
  WebData data;
  data.lead = 0.025;
  Line line(data);
  line.run(0.5);
  EXPECT_NEAR(line.web.separate(0.25), 0.025 + 0.5 - 0.75 * h, 1e-12);
  line.run(0.3);
  EXPECT_NEAR(line.web.separate(1), 0.3 + 0.75 * h, 1e-12);
  EXPECT_EQ(line.read("pieces"), 2);
  EXPECT_NEAR(line.read("lead"), 0, 1e-9);
}

TEST(Web, PieceIsABodyThatTheBeltTakesToItsSpeedAndAway) {
  Line line;
  line.run(0.5);
  line.web.separate(0.5);
  const Slide& piece = *line.web.outfeed().pieces()[0].body;
  EXPECT_TRUE(piece.awake);
  line.run(0.03);
  // Its tail was at the cut: the middle is half a length ahead.
  EXPECT_NEAR(piece.position, (0.5 - 0.5 * h) / 2 + piece.speed * (0.03 + 0.5 * h), 3e-3);
  // Belt 1.2 m/s, Coulomb friction 0.4 g from the web's 1 m/s: 50 ms, plus the part that lies on the belt.
  line.run(0.1);
  EXPECT_NEAR(piece.speed, 1.2, 1e-9);
  EXPECT_EQ(line.read("outfeed.pieces"), 1);
  line.run(3);
  EXPECT_FALSE(piece.awake);
  EXPECT_EQ(line.read("outfeed.pieces"), 0);
}

TEST(Web, PieceEndsWhereTheSlowStepExpectsItWhateverTheStepOfTheCut) {
  for (int offset = 0; offset < 10; ++offset) {
    WebData data;
    data.outfeed.speed_factor = 1;  // no acceleration: the path is a straight line
    Line line(data);
    for (int i = 0; i < 1000 + offset; ++i) line.step();
    line.web.separate(0.25);
    const double cut_time = (1000 + offset - 0.75) * h;
    for (int i = 1000 + offset; i < 1100; ++i) line.step();
    const Outfeed::Piece& piece = line.web.outfeed().pieces()[0];
    EXPECT_NEAR(piece.body->position, piece.length / 2 + 1100 * h - cut_time, 1e-12) << offset;
  }
}

TEST(Web, PoolOfPiecesIsReusedAndShown) {
  Line line;
  for (int i = 0; i < 2 * Outfeed::pool_size + 3; ++i) {
    line.run(0.05);
    line.web.separate(1);
  }
  int shown = 0;
  for (const Part& part : line.web.parts()) {
    const PartPose pose = part.now();
    if (!part.name.starts_with("piece ") || !pose.visible) continue;
    ++shown;
    EXPECT_NEAR(pose.scale[0], 0.05, 1e-9);
  }
  EXPECT_EQ(shown, Outfeed::pool_size);
}

TEST(Web, WheelFaultsReachThePort) {
  Line line;
  line.run(0.5);
  line.fault("wheel", "slip", 0.1);
  line.run(0.5);
  EXPECT_NEAR(line.plug<EncoderPort>("wheel").now, 10000 + 9000, 1e-6);
}

}  // namespace
}  // namespace drycut::plants
