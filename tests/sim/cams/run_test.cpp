#include "sim/cams/camming4/run.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/sim/cams/bench.hpp"

namespace drycut::sim::cams {
namespace {

using cams::rows;

constexpr double tolerance = 1e-9;
constexpr double pi = std::numbers::pi;

CamPoint at(const CammingTable& table, double master, int passes = 1) {
  return sample_cam_at(run_cam(table, {}, passes), {master}).front();
}

void expect_point(const CamPoint& point, double slave, double velocity, double acceleration,
                  double jerk = 0) {
  EXPECT_NEAR(point.position, slave, tolerance) << "at " << point.master;
  EXPECT_NEAR(point.velocity, velocity, tolerance) << "at " << point.master;
  EXPECT_NEAR(point.acceleration, acceleration, tolerance) << "at " << point.master;
  EXPECT_NEAR(point.jerk, jerk, tolerance) << "at " << point.master;
}

TEST(CamRun, TheIntroductionTakes700OfTheMasterAnd565OfTheSlave) {
  const auto run = run_cam(cams::introduction(), {}, 1);
  EXPECT_EQ(run.end, CamRun::End::ended);
  EXPECT_EQ(run.master_total(), 700);
  EXPECT_EQ(run.slave_total(), 565);
  ASSERT_EQ(run.shown, 5U);
  EXPECT_EQ(run.visits[2].master_start, 300);
  EXPECT_EQ(run.visits[2].slave_start, 250);
  EXPECT_EQ(run.visits[2].row, 3);
  EXPECT_EQ(run.end_speed, 0);
}

TEST(CamRun, TheTotalsDoNotDependOnTheResolution) {
  for (const auto* settings : {"# measurem: 934\n# pulsem: 4099\n# measure: 777\n# pulse: 8191\n",
                               "# measurem: 7\n# pulsem: 999999\n# measure: 999999\n# pulse: 999998\n"}) {
    const auto run = run_cam(
        cams::table(settings + cams::header +
                    "1,132,100,50\n2,133,200,200\n3,134,160,120\n4,133,150,150\n5,135,90,45\n6,136\n"),
        {}, 1);
    EXPECT_NEAR(run.master_total(), 700, tolerance);
    EXPECT_NEAR(run.slave_total(), 565, tolerance);
  }
}

// One ramp from standstill: v = 2S/M u, s = S u2.
TEST(CamRun, Law131IsOneRampFromStandstill) {
  const auto table = rows("1,131,80,-30\n2,135,80,-30\n3,136\n");
  const double v1 = -2.0 * 30 / 80;
  for (const double m : {0.0, 13.0, 40.0, 79.5})
    expect_point(at(table, m), -30 * (m / 80) * (m / 80), v1 * m / 80, v1 / 80);
}

// v1 = 1 with a space that is not M/2: two ramps that meet at half the master.
TEST(CamRun, Law132MeetsTheMastersSpeed) {
  const auto table = rows("1,132,100,70\n2,135,100,50\n3,136\n");
  const double middle = 2 * 0.7 - 0.5;
  expect_point(at(table, 25), 100 * middle / 16, middle / 2, middle / 50);
  expect_point(at(table, 75), 100 * (middle / 4 + middle / 4 + (1 - middle) / 16), middle + (1 - middle) / 2,
               (1 - middle) / 50);
}

TEST(CamRun, Laws133134And135TakeTheSpeedOver) {
  const auto table = rows("1,132,100,50\n2,133,200,150\n3,134,100,80\n4,135,120,25\n5,136\n");
  // 133: 1 -> 2*150/200 - 1 = 0.5
  expect_point(at(table, 150), 50 + 200 * (0.25 - 0.5 * 0.25 * 0.25 / 2), 1 - 0.5 * 0.25, -0.5 / 200);
  // 134: middle 2*80/100 - 0.5 = 1.1
  expect_point(at(table, 325), 200 + 100 * (0.5 * 0.25 + 0.6 * 0.0625), 0.8, 0.6 / 50);
  expect_point(at(table, 375), 200 + 100 * (1.6 / 4 + 1.1 * 0.25 - 0.6 * 0.0625), 0.8, -0.6 / 50);
  // 135: middle 2*25/120 - 0.25
  const double middle = 50.0 / 120 - 0.25;
  expect_point(at(table, 430), 280 + 120 * (0.5 * 0.25 + (middle - 0.5) * 0.0625), (0.5 + middle) / 2,
               (middle - 0.5) / 60);
  expect_point(at(table, 520), 305, 0, -middle / 60);
}

TEST(CamRun, Laws150To154) {
  // Acceleration to 0.5 over 40 (10 bits are 20 Um), 60 with 0.5; 2 steps to 0.25; on a ramp to 0.75; stop.
  const auto table = cams::table("# measure: 2\n" + cams::header +
                                 "1,150,60,30,40,5\n2,154,80,20\n3,153,4,3,20,5\n4,151,40,30,20,2\n5,136\n");
  const auto run = run_cam(table, {}, 1);
  EXPECT_EQ(run.master_total(), 100 + 80 + 20 + 60);
  EXPECT_EQ(run.slave_total(), 40 + 20 + 10 + 34);
  expect_point(at(table, 20), 40 * 0.5 / 8, 0.25, 0.5 / 40);
  expect_point(at(table, 70), 10 + 15, 0.5, 0);
  expect_point(at(table, 140), 40 + 10, 0.25, 0);
  expect_point(at(table, 190), 60 + 20 * (0.25 / 2 + 0.5 / 8), 0.5, 0.5 / 20);
  expect_point(at(table, 220), 70 + 15, 0.75, 0);
}

// s = M (v0 p + dv (p2/2 - (1 - cos 2 pi p) / 4 pi2)); v = v0 + dv (p - sin(2 pi p) / 2 pi)
TEST(CamRun, Law231IsACycloid) {
  const auto table = rows("1,231,100,50\n2,233,100,50\n3,136\n");
  for (const double p : {0.1, 0.25, 0.5, 0.9}) {
    const double w = 2 * pi * p;
    expect_point(at(table, 100 * p), 100 * (p * p / 2 - (1 - std::cos(w)) / (4 * pi * pi)),
                 p - std::sin(w) / (2 * pi), (1 - std::cos(w)) / 100, 2 * pi * std::sin(w) / 1e4);
    // and down again
    expect_point(at(table, 100 + 100 * p), 50 + 100 * (p - p * p / 2 + (1 - std::cos(w)) / (4 * pi * pi)),
                 1 - p + std::sin(w) / (2 * pi), -(1 - std::cos(w)) / 100, -2 * pi * std::sin(w) / 1e4);
  }
}

// 000 1.2.4: a quarter circle counterclockwise about (-100, 0): x = 100 (cos a - 1).
TEST(CamRun, Law171And173FollowTheCircle) {
  const auto x = rows("1,171,100,-100,0,100\n2,136\n");
  const auto y = rows("1,173,100,-100,0,100\n2,136\n");
  const double length = 50 * pi;
  EXPECT_NEAR(run_cam(x, {}, 1).master_total(), length, tolerance);
  for (const double share : {0.0, 0.3, 0.8}) {
    const double a = share * pi / 2;
    expect_point(at(x, share * length), 100 * (std::cos(a) - 1), -std::sin(a), -std::cos(a) / 100,
                 std::sin(a) / 1e4);
    expect_point(at(y, share * length), 100 * std::sin(a), std::cos(a), -std::sin(a) / 100,
                 -std::cos(a) / 1e4);
  }
  const auto tangent = run_cam(rows("1,175,100,-100,0,100\n2,136\n"), {}, 1);
  EXPECT_NEAR(tangent.slave_total(), 90, tolerance);
}

TEST(CamRun, PeaksAreThoseOfTheLaw) {
  const auto run =
      run_cam(rows("1,231,100,50\n2,134,100,130\n3,235,100,20\n4,171,100,-100,0,100\n5,136\n"), {}, 1);
  ASSERT_EQ(run.shown, 4U);
  EXPECT_NEAR(peak_speed(run.visits[0]), 1, tolerance);
  EXPECT_NEAR(peak_gradient(run.visits[0]), 2.0 / 100, tolerance);
  EXPECT_NEAR(peak_speed(run.visits[1]), 1.6, tolerance);
  EXPECT_NEAR(peak_gradient(run.visits[1]), 0.6 / 50, tolerance);
  EXPECT_NEAR(peak_gradient(run.visits[2]), 2 * 1.1 / 50, tolerance);
  EXPECT_NEAR(peak_speed(run.visits[3]), 1, tolerance);
}

TEST(CamRun, NoSampleIsAboveThePeakAndOneComesNear) {
  const auto table =
      cams::table("# measure: 3\n" + cams::header +
                  "1,252,10,7,60,7\n2,253,10,-3,70,5\n3,254,90,40,2\n4,254,60,90,1\n5,234,80,20\n"
                  "6,172,-50,30,0,40\n7,136\n");
  const auto run = run_cam(table, {}, 1);
  ASSERT_EQ(run.shown, 6U);
  for (const auto& visit : run.visits) {
    double most = 0;
    for (int i = 0; i <= 20'000; ++i)
      most = std::max(most, std::abs(cams::at(visit, visit.master_length * i / 20'000).velocity));
    EXPECT_LE(most, peak_speed(visit) + tolerance) << visit.row;
    EXPECT_NEAR(most, peak_speed(visit), 1e-6) << visit.row;
  }
}

TEST(CamRun, LoopsCountOnAcrossJumpsAndCounterUpdates) {
  const auto table = rows("1,131,100,50\n2,133,50,50\n3,135,50,25\n4,139,200,125\n5,137,1\n");
  const auto once = run_cam(table, {}, 1);
  EXPECT_EQ(once.end, CamRun::End::came_round);
  EXPECT_EQ(once.master_total(), 200);
  const auto thrice = run_cam(table, {}, 3);
  EXPECT_EQ(thrice.passes, 3);
  EXPECT_EQ(thrice.shown, 9U);
  EXPECT_EQ(thrice.master_total(), 600);
  EXPECT_EQ(thrice.slave_total(), 375);
  const auto points = sample_cam_at(thrice, {20, 220, 420, 600});
  EXPECT_NEAR(points[1].position, points[0].position + 125, tolerance);
  EXPECT_NEAR(points[2].position, points[0].position + 250, tolerance);
  EXPECT_EQ(points[3].position, 375);
}

TEST(CamRun, ALoopMayBeginBehindALeadIn) {
  const auto table = rows("1,131,10,5\n2,133,90,90\n3,133,60,60\n4,138\n");
  const auto to_row_one = run_cam(table, {}, 1);
  EXPECT_EQ(to_row_one.end, CamRun::End::failed);  // 131 with the slave moving
  const auto lead_in = run_cam(rows("1,131,10,5\n2,133,90,90\n3,133,60,60\n4,137,3\n"), {}, 2);
  EXPECT_EQ(lead_in.end, CamRun::End::came_round);
  EXPECT_EQ(lead_in.master_total(), 100 + 60 + 60);
}

TEST(CamRun, AConditionalJumpRunsItsTimes) {
  const auto run = run_cam(rows("1,133,100,10\n2,133,100,-10\n3,190,1,3\n4,136\n"), {}, 1);
  EXPECT_EQ(run.end, CamRun::End::ended);
  EXPECT_EQ(run.shown, 8U);
  EXPECT_EQ(run.master_total(), 800);
}

TEST(CamRun, ConditionalJumpsWithoutMeasureAreCutShort) {
  const auto run = run_cam(rows("1,133,100,0\n2,190,1,999999\n3,190,1,999999\n4,136\n"), {}, 1);
  EXPECT_EQ(run.end, CamRun::End::cut_short);
  EXPECT_EQ(run.shown, CamRun::most_visits);
}

TEST(CamRun, Sector160WaitsForTheQuota) {
  const auto table = rows("1,160,250\n2,132,100,50\n3,135,100,50\n4,136\n");
  const auto run = run_cam(table, {}, 1);
  EXPECT_EQ(run.master_total(), 450);
  EXPECT_TRUE(run.visits[0].waiting);
  EXPECT_EQ(run.visits[0].master_length, 250);
  expect_point(at(table, 200), 0, 0, 0);
  EXPECT_EQ(at(table, 200).row, 1);
  expect_point(at(table, 300), 12.5, 0.5, 0.01);
}

TEST(CamRun, Sector160AboveItsQuotaWaitsForEver) {
  const auto run = run_cam(rows("1,140,500\n2,160,250\n3,133,10,0\n4,136\n"), {}, 1);
  EXPECT_EQ(run.end, CamRun::End::held);
  EXPECT_EQ(run.master_total(), 0);
  EXPECT_TRUE(sample_cam(run).empty());
}

TEST(CamRun, AGearingIsShownForOneLap) {
  const auto last = run_cam(rows("1,154,100,40,0,2\n"), {}, 1);
  EXPECT_EQ(last.end, CamRun::End::geared);
  EXPECT_EQ(last.master_total(), 100);
  EXPECT_EQ(last.slave_total(), 40);
  EXPECT_THAT(last.released, testing::ElementsAre(1));
  const auto between = run_cam(rows("1,154,100,40,0,2\n2,135,100,20\n3,136\n"), {}, 1);
  EXPECT_EQ(between.end, CamRun::End::ended);
  EXPECT_EQ(between.master_total(), 200);
  EXPECT_EQ(between.slave_total(), 60);
  const auto looped = run_cam(rows("1,154,100,40,0,2\n2,138\n"), {}, 3);
  EXPECT_EQ(looped.end, CamRun::End::came_round);
  EXPECT_EQ(looped.master_total(), 300);
}

TEST(CamRun, TheSameTableRunsTheSameWay) {
  const auto table = cams::table("# measurem: 7\n# pulsem: 30\n" + cams::header +
                                 "1,231,100,50\n2,171,100,-100,0,100\n3,235,60,-10\n4,138\n");
  const auto first = cam_csv(sample_cam(run_cam(table, {}, 5)), 12.5);
  EXPECT_EQ(first, cam_csv(sample_cam(run_cam(table, {}, 5)), 12.5));
}

}  // namespace
}  // namespace drycut::sim::cams
