// Which instants become frames: a period, a window, the stretch around an event.
#include "sim/loop/shutter.hpp"

#include <gmock/gmock.h>

#include "plants/pose_math.hpp"

namespace drycut::sim::loop {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Happening {
  Time at;
  std::string source = "knife";
  std::string event = "cut";
};

/// Times [ms] of the frames of a run of that length with steps of 1 ms.
std::vector<Time> frames(const scenario::PicturesSection& pictures, Time duration,
                         const std::vector<Happening>& happenings = {}) {
  Shutter shutter(pictures);
  Time time = 0;
  plants::Part part;  // that turns by 25 degrees a ms
  part.frame = [&] { return plants::PartPose(plants::about_z(436.3 * seconds(time))); };
  const std::vector<plants::Part> turning = {part};
  for (Time now = millisecond; now <= duration; now += millisecond) {
    // The order of a step: its events first, then the shot at its end.
    for (const auto& one : happenings) {
      if (one.at >= now - millisecond && one.at < now)
        shutter.happened({one.at / millisecond * millisecond,
                          seconds(one.at % millisecond),
                          one.source,
                          one.event,
                          {},
                          ""});
    }
    if (now < shutter.next()) continue;
    time = now;
    if (auto* shot = shutter.look(now, turning)) {
      EXPECT_TRUE(shot->caption.empty()) << "an object that was used before comes empty";
      EXPECT_EQ(shot->time, now);
      shot->caption.push_back(1);
    }
  }
  std::vector<Time> times;
  for (const auto& shot : shutter.kept()) {
    EXPECT_EQ(shot.poses.size(), 1U);
    if (!times.empty()) {  // what is between belongs to the frame behind it
      EXPECT_EQ(shot.between.size() + 1, static_cast<std::size_t>(shot.time / millisecond - times.back()));
      for (const auto& key : shot.between) {
        EXPECT_GT(key.time, times.back() * millisecond);
        EXPECT_LT(key.time, shot.time);
      }
    }
    times.push_back(shot.time / millisecond);
  }
  return times;
}

scenario::PicturesSection every(Time ms) {
  scenario::PicturesSection pictures;
  pictures.frames = true;
  pictures.every = ms * millisecond;
  return pictures;
}

scenario::PicturesSection around(std::string event, int number, Time before, Time after) {
  auto pictures = every(10);
  pictures.around = {{std::move(event), {}, {}}, number, before * millisecond, after * millisecond};
  return pictures;
}

TEST(Shutter, TakesAFrameAPeriodWithinItsWindow) {
  auto pictures = every(10);
  EXPECT_THAT(frames(pictures, 35 * millisecond), ElementsAre(10, 20, 30));
  pictures.from = 15 * millisecond;
  pictures.until = 40 * millisecond;
  EXPECT_THAT(frames(pictures, 100 * millisecond), ElementsAre(15, 25, 35));
  pictures.frames = false;
  EXPECT_THAT(frames(pictures, 100 * millisecond), IsEmpty());
}

TEST(Shutter, SlowMotionTakesFramesThatMuchCloser) {
  auto pictures = every(10);
  pictures.slow = 5;
  EXPECT_THAT(frames(pictures, 7 * millisecond), ElementsAre(2, 4, 6));
}

TEST(Shutter, KeepsTheStretchAroundTheEventAskedFor) {
  const std::vector<Happening> cuts = {{55 * millisecond}, {155 * millisecond}, {255 * millisecond}};
  EXPECT_THAT(frames(around("cut", 2, 30, 20), 300 * millisecond, cuts),
              ElementsAre(130, 140, 150, 160, 170));
  EXPECT_THAT(frames(around("knife.cut", 3, 10, 10), 300 * millisecond, cuts), ElementsAre(250, 260));
  EXPECT_THAT(frames(around("cut", 1, 0, 0), 300 * millisecond, cuts), IsEmpty())
      << "no frame at that instant";
  EXPECT_THAT(frames(around("cut", 1, 500, 20), 300 * millisecond, cuts),
              ElementsAre(10, 20, 30, 40, 50, 60, 70));
}

TEST(Shutter, FramesAtTheWindowsVeryEndsBelongToIt) {
  EXPECT_THAT(frames(around("cut", 1, 20, 20), 300 * millisecond, {{150 * millisecond}}),
              ElementsAre(130, 140, 150, 160, 170));
}

TEST(Shutter, AnEventThatNeverHappensLeavesNoFrames) {
  Shutter shutter(around("cut", 3, 10, 10));
  shutter.happened({millisecond, 0, "knife", "cut", {}, ""});
  shutter.happened({millisecond, 0, "knife", "tear", {}, ""});
  shutter.happened({millisecond, 0, "saw", "knife.cut", {}, ""});
  EXPECT_EQ(shutter.seen(), 1);
  EXPECT_FALSE(shutter.event_at());
  EXPECT_THAT(shutter.kept(), IsEmpty());
}

TEST(Shutter, AFaultIsAnEventLikeAnyOther) {
  EXPECT_THAT(frames(around("fault", 1, 10, 0), 100 * millisecond, {{50 * millisecond, "timeline", "fault"}}),
              ElementsAre(40, 50));
}

}  // namespace
}  // namespace drycut::sim::loop
