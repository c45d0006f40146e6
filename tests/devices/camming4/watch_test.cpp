// What a running cam watches beside its table: error 4, a sector that is over in less than a sample, and
// warnings 1 and 2 of a master that changes its speed inside a sector (000 1.3, 1.4).
#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A cam under a master that has run at `tenths` of a bit a sample for long already.
class WatchedCam : public Camming4Test {
 public:
  void TestBody() override {}
  explicit WatchedCam(std::int64_t tenths) : tenths_(tenths) {
    does("INIT LOOPON");
    run(40);
    does("forget");
  }
  using Camming4Test::get;
  using Camming4Test::order;
  using Camming4Test::row;
  void run(int number) {
    for (int i = 0; i < number; ++i) {
      const std::int64_t before = way_ / 10;
      way_ += tenths_;
      tick(way_ / 10 - before);
    }
  }
  void speed(std::int64_t tenths) { tenths_ = tenths; }
  /// The row of error 4, or 0.
  int too_short() { return get("errcode") == 4 ? get("errvalue") : 0; }

 private:
  std::int64_t tenths_;
  std::int64_t way_ = 0;
};

/// The row of error 4 of a sector of `space` behind one of `before`, or first of all.
int error_of(int space, int before, std::int64_t tenths) {
  WatchedCam cam(tenths);
  int number = 1;
  if (before > 0) cam.row(number++, {154, before, before});
  cam.row(number, {154, space, space});
  cam.row(number + 1, {154, 200, 200});
  cam.row(number + 2, {137, number + 1});
  cam.order("STARTCAM");
  cam.run(40);
  return cam.too_short();
}

TEST(Camming4Watch, ASectorShorterThanASampleIsErrorFourInAnyPhase) {
  for (const std::int64_t tenths : {100, 101, 105, 109})
    for (int before = 0; before < 130; before += before == 0 ? 100 : 1) {
      SCOPED_TRACE(std::to_string(tenths) + " tenths, " + std::to_string(before) + " before");
      const int row = before == 0 ? 1 : 2;
      const int sample = static_cast<int>((tenths + 9) / 10);  // the least whole space that lasts as long
      for (const int space : {1, 5, sample - 1}) EXPECT_EQ(error_of(space, before, tenths), row) << space;
      for (const int space : {sample, sample + 1, 15}) EXPECT_EQ(error_of(space, before, tenths), 0) << space;
    }
  covers({"error 4"});
}

TEST(Camming4Watch, ASectorInWhichTheMasterStoodHadItsTime) {
  WatchedCam cam(0);
  cam.row(1, {154, 50, 50});
  cam.row(2, {154, 900, 900});
  cam.row(3, {137, 2});
  cam.order("STARTCAM");
  cam.run(5);
  cam.speed(600);
  cam.run(2);
  EXPECT_EQ(cam.get("rowex"), 2);
  EXPECT_EQ(cam.too_short(), 0);
}

TEST(Camming4Watch, TheWayBackIsJudgedAsTheWayThere) {
  for (int phase = 0; phase < 10; ++phase)
    for (const int space : {9, 11}) {
      SCOPED_TRACE(phase);
      WatchedCam cam(30);
      cam.row(1, {154, 200, 200});
      cam.row(2, {154, space, space});
      cam.row(3, {154, 900, 900});
      cam.order("STARTCAM");
      cam.run(80 + phase);
      ASSERT_EQ(cam.get("rowex"), 3);
      cam.speed(-100);
      cam.run(30);
      EXPECT_EQ(cam.too_short(), space == 9 ? 2 : 0);
    }
}

TEST(Camming4Watch, AMasterThatTremblesOverABoundaryIsNoError) {
  WatchedCam cam(10);
  cam.row(1, {154, 20, 20});
  cam.row(2, {154, 5, 5});
  cam.row(3, {154, 900, 900});
  cam.order("STARTCAM");
  cam.run(22);
  for (int i = 0; i < 50; ++i) {
    cam.speed(i % 2 == 0 ? -40 : 40);
    cam.run(1);
  }
  cam.speed(10);
  cam.run(20);
  EXPECT_EQ(cam.get("rowex"), 3);
  EXPECT_EQ(cam.get("st_error"), 0);
}

/// AZL over 1000 Um to the master's speed, and back: at 10 bits a sample 25000 Um/s2, at 12 36000. The limit
/// is maxvel 50000 in so many 1/100 s.
class GradientCam : public WatchedCam {
 public:
  GradientCam(std::int64_t tenths, int hundredths) : WatchedCam(tenths) {
    set({{"taccmax", hundredths}, {"tdecmax", hundredths}});
    rows({{131, 1000, 500}, {135, 1000, 500}, {136}});
    run(1);
    does("forget STARTCAM!");
  }
  using Camming4Test::command;
  using Camming4Test::diagnostics;
};

TEST(Camming4Watch, AMasterThatGainsSpeedInsideASectorRaisesWarningsOneAndTwo) {
  GradientCam cam(100, 150);
  cam.run(50);
  EXPECT_THAT(cam.diagnostics(), IsEmpty());
  cam.speed(120);
  cam.run(20);
  EXPECT_THAT(cam.diagnostics(), ElementsAre("st_warning: warning 1 in row 1: acceleration above taccmax"));
  cam.command("RSWRN");
  cam.run(2);
  EXPECT_EQ(cam.get("rowex"), 1);
  EXPECT_EQ(cam.get("st_warning"), 0);  // once a sector
  cam.speed(100);
  while (cam.get("rowex") == 1) cam.run(1);
  cam.run(20);
  EXPECT_THAT(cam.diagnostics(), IsEmpty());
  cam.speed(120);
  cam.run(20);
  EXPECT_THAT(cam.diagnostics(), ElementsAre("st_warning: warning 2 in row 2: deceleration above tdecmax"));
  covers({"warning 1", "warning 2", "taccmax", "tdecmax"});
}

TEST(Camming4Watch, OneBitMoreInTheHistoryIsNoSpeed) {
  // 16 samples of 10.3 bits are 164 or 165, 5125 or 5156 Um/s; the limit is reached at 5143.
  GradientCam cam(50, 189);
  cam.run(10);
  cam.speed(103);
  cam.run(60);
  EXPECT_EQ(cam.get("rowex"), 1);
  EXPECT_EQ(cam.get("st_warning"), 0);
  cam.speed(105);
  cam.run(18);
  EXPECT_EQ(cam.get("wrncode"), 1);
}

}  // namespace
}  // namespace drycut::devices::camming4
