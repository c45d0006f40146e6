// What is kept of the parts between two frames: enough that straight lines from one to the next are true.
#include "sim/loop/pose_keys.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "plants/pose_math.hpp"

namespace drycut::sim::loop {
namespace {

using plants::Part;
using plants::PartPose;

constexpr double degree = std::numbers::pi / 180;
constexpr Time step = 100 * microsecond;

double angle_between(const PartPose& a, const PartPose& b) {
  double dot = 0;
  for (std::size_t i = 0; i < 4; ++i) dot += a.pose.rotation[i] * b.pose.rotation[i];
  return 2 * std::acos(std::min(1.0, std::abs(dot)));
}

/// A part that is where `motion` says at a time [s], seen by frames every `period` for `duration`.
struct Course {
  std::vector<PoseKey> keys;  ///< with those of the frames
  std::vector<double> turned;
  int looks = 0;
  Time longest_gap = 0;  ///< between looks

  Course(std::function<PartPose(double)> motion, Time period, Time duration, double pitch = 0) {
    double now_s = 0;
    Part part;
    part.frame = [&] { return motion(now_s); };
    part.pitch = pitch;
    const std::vector<Part> parts = {part};
    PoseKeys seen;
    Time last = period;
    for (Time now = period; now <= duration; now += step) {
      const bool frame = now % period == 0;
      if (!frame && now < seen.next()) continue;
      now_s = seconds(now);
      seen.look(now, parts);
      ++looks;
      longest_gap = std::max(longest_gap, now - last);
      last = now;
      if (!frame) continue;
      std::vector<PoseKey> kept;
      seen.begin_frame(kept, turned);
      keys.insert(keys.end(), kept.begin(), kept.end());
      keys.push_back({0, now, seen.poses()[0]});
    }
  }

  /// Where the straight way from key to key is at a time [s].
  [[nodiscard]] double x_at(double at) const {
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (seconds(keys[i].time) < at) continue;
      const double from = seconds(keys[i - 1].time);
      const double t = (at - from) / (seconds(keys[i].time) - from);
      return (1 - t) * keys[i - 1].pose.pose.position[0] + t * keys[i].pose.pose.position[0];
    }
    return std::nan("");
  }
};

PartPose turned_by(double angle) { return plants::about_z(angle); }

TEST(PoseKeys, TurnByThirtyDegreesAtMostWhateverTheFramesAndTheSpeed) {
  for (const Time period : {10 * millisecond, 40 * millisecond, 500 * millisecond}) {
    for (const double turns_per_second : {0.2, 3.0, 25.0, 100.0, 200.0}) {
      const Course drum([&](double t) { return turned_by(2 * std::numbers::pi * turns_per_second * t); },
                        period, 2 * second);
      double most = 0;
      double sum = 0;
      for (std::size_t i = 1; i < drum.keys.size(); ++i) {
        ASSERT_GT(drum.keys[i].time, drum.keys[i - 1].time);
        const double turn = angle_between(drum.keys[i - 1].pose, drum.keys[i].pose);
        most = std::max(most, turn);
        sum += turn;
      }
      EXPECT_LE(most, 30.001 * degree) << turns_per_second;
      const double all = 2 * std::numbers::pi * turns_per_second * seconds(2 * second - period);
      EXPECT_NEAR(sum, all, 1e-6 * all) << "no turn is lost";
      // No more than needed: twice as many keys as thirty degrees ask for, and the frames.
      EXPECT_LE(static_cast<double>(drum.keys.size()),
                2 * all / (30 * degree) + 2.0 * seconds(second) / seconds(period) + 2);
    }
  }
}

TEST(PoseKeys, AccelerationFromRestAndReversalAreFollowed) {
  // 0 to 6000 rpm and back within 40 ms: 157 rad/s after a ms.
  const Course drum(
      [](double t) {
        const double top = 2 * std::numbers::pi * 100;
        return turned_by(-top / 50 / std::numbers::pi * std::cos(50 * std::numbers::pi * t));
      },
      100 * millisecond, 1 * second);
  for (std::size_t i = 1; i < drum.keys.size(); ++i)
    EXPECT_LE(angle_between(drum.keys[i - 1].pose, drum.keys[i].pose), 30.001 * degree);
}

TEST(PoseKeys, WhatMovesEvenlyOrStandsNeedsNone) {
  const Course still([](double) { return PartPose(); }, 100 * millisecond, 1 * second);
  EXPECT_EQ(still.keys.size(), 10U);
  EXPECT_EQ(still.longest_gap, millisecond);
  const Course even([](double t) { return PartPose(plants::at(2 * t, 0, 0)); }, 100 * millisecond,
                    1 * second);
  EXPECT_EQ(even.keys.size(), 10U);
}

TEST(PoseKeys, AWayWithBendsIsFollowedToTwoMillimetres) {
  // A carriage that goes out and back within one frame, with up to 20 m/s2.
  const auto x = [](double t) { return 0.05 * (1 - std::cos(20 * t)); };
  const Course carriage([&](double t) { return PartPose(plants::at(x(t), 0, 0)); }, 500 * millisecond,
                        2 * second);
  double worst = 0;
  for (double t = 0.5; t < 2; t += 1e-3) worst = std::max(worst, std::abs(carriage.x_at(t) - x(t)));
  EXPECT_LT(worst, 2e-3);
  EXPECT_GT(carriage.keys.size(), 10U);
  EXPECT_LT(carriage.keys.size(), 120U);
}

TEST(PoseKeys, AJumpTakesNoLongerThanALook) {
  const auto x = [](double t) { return std::fmod(t, 0.21); };  // a mark on an endless belt
  const Course mark([&](double t) { return PartPose(plants::at(x(t), 0, 0)); }, 100 * millisecond,
                    1 * second);
  for (double t = 0.1; t < 1; t += 1e-4) {
    const bool near_jump = std::fmod(t + 0.002, 0.21) < 0.004;
    if (near_jump) continue;
    EXPECT_NEAR(mark.x_at(t), x(t), 1e-6) << t;
  }
}

TEST(PoseKeys, WhatComesAndGoesDoesSoBetweenTwoLooks) {
  const Course piece(
      [](double t) { return PartPose(plants::at(t < 0.25 ? 9 : t, 0, 0), t >= 0.25 && t < 0.371); },
      100 * millisecond, 500 * millisecond);
  std::vector<std::pair<double, bool>> changes;
  for (std::size_t i = 1; i < piece.keys.size(); ++i) {
    const auto& before = piece.keys[i - 1];
    const auto& now = piece.keys[i];
    if (before.pose.visible == now.pose.visible) continue;
    EXPECT_LE(now.time - before.time, millisecond);
    changes.emplace_back(seconds(now.time), now.pose.visible);
  }
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_NEAR(changes[0].first, 0.25, 1e-3);
  EXPECT_TRUE(changes[0].second);
  EXPECT_NEAR(changes[1].first, 0.371, 1e-3);
  EXPECT_EQ(piece.keys.size(), 5U + 4U) << "while it is not there nothing is kept";
}

TEST(PoseKeys, TellsHowFarWhatHasAPitchTurnedSinceTheFrameBefore) {
  // To and fro counts both ways: what turned a whole pitch forward and back was not seen.
  const Course drum([](double t) { return turned_by(40 * degree * std::sin(2 * std::numbers::pi * 25 * t)); },
                    40 * millisecond, 400 * millisecond, 90 * degree);
  ASSERT_EQ(drum.turned.size(), 1U);
  EXPECT_NEAR(drum.turned[0], 4 * 40 * degree, 2 * degree);
  EXPECT_TRUE(Course([](double) { return PartPose(); }, 40 * millisecond, 400 * millisecond).turned.empty());
}

}  // namespace
}  // namespace drycut::sim::loop
