// Cams as the exact laws of their tables: what a run is compared with.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "sim/cams/study.hpp"
#include "tests/sim/cams/bench.hpp"
#include "tests/sim/cams/ecam_bench.hpp"

namespace drycut::sim::cams {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

IdealCam ideal(std::string_view kind, const std::string& text, MasterRange range) {
  Problems problems;
  const auto table = read_cam(kind, text, "", problems);
  return problems.empty() ? ideal_cam(table, range) : IdealCam();
}
IdealCam camming4(const std::string& rows, MasterRange range, const std::string& settings = "") {
  return ideal("camming4", settings + cams::header + rows, range);
}

std::vector<std::string> listed(const std::vector<CamZone>& zones) {
  std::vector<std::string> texts;
  for (const auto& zone : zones)
    texts.push_back(fmt::format("{} {} {}{}", zone.from, zone.to, zone.name, zone.synchronous ? " !" : ""));
  return texts;
}

constexpr const char* introduction =
    "1,132,100,50\n2,133,200,200\n3,134,160,120\n4,133,150,150\n5,135,90,45\n6,136\n";

TEST(IdealCam, OfCamming4MeetsTheSpacesAtEverySectorsEnd) {
  const auto cam = camming4(introduction, {0, 700});
  ASSERT_THAT(cam.cycles, ElementsAre(0, 700));
  EXPECT_THAT(cam.origins, ElementsAre(0, 565));
  for (const auto& [master, slave] :
       {std::pair{0.0, 0.0}, {100, 50}, {300, 250}, {460, 370}, {610, 520}, {700, 565}})
    EXPECT_NEAR(cam.slave(master), slave, 1e-9) << "at " << master;
  // Sector 1 is a parabola, sector 5 one that falls to rest.
  EXPECT_NEAR(cam.slave(40), 40.0 * 40 / 200, 1e-9);
  EXPECT_NEAR(cam.slave(655), 565 - 45.0 * 45 / 180, 1e-9);
  EXPECT_EQ(cam.silence, "");
}

TEST(IdealCam, OfCamming4IsNothingBeforeItsStartAndBehindItsEnd) {
  const auto cam = camming4(introduction, {0, 700});
  EXPECT_TRUE(std::isnan(cam.slave(-1)));
  EXPECT_TRUE(std::isnan(cam.slave(700.5)));
}

TEST(IdealCam, NamesTheSectorsAndMarksThoseAtTheMastersSpeed) {
  EXPECT_THAT(
      listed(camming4(introduction, {0, 700}).zones),
      ElementsAre("0 100 1 AZM acceleration", "100 300 2 RSC synchronism !", "300 460 3 RCC compensation",
                  "460 610 4 RSC synchronism !", "610 700 5 DZC deceleration"));
  EXPECT_THAT(
      listed(camming4("1,131,80,-40\n2,133,50,-50\n3,135,80,-40\n4,133,30,0\n5,136\n", {0, 240}).zones),
      ElementsAre("0 80 1 AZL acceleration", "80 130 2 RSC return", "130 210 3 DZC deceleration",
                  "210 240 4 RSC dwell"));
  EXPECT_THAT(
      listed(camming4("1,131,80,60\n2,133,50,75\n3,135,80,60\n4,136\n", {0, 210}).zones),
      ElementsAre("0 80 1 AZL acceleration", "80 130 2 RSC constant speed", "130 210 3 DZC deceleration"));
}

// Row 6 leads back to row 2: a turn of 500 of the master and 350 of the slave, the first one 100 and 50
// longer.
TEST(IdealCam, OfCamming4GoesRoundAsOftenAsTheRunDid) {
  const auto cam =
      camming4("1,132,100,50\n2,133,200,200\n3,134,300,150\n4,139,500,350\n5,137,2\n", {0, 100100});
  ASSERT_EQ(cam.cycles.size(), 201U);
  EXPECT_EQ(cam.cycles[0], 0);
  EXPECT_NEAR(cam.cycles[1], 600, 1e-9);
  EXPECT_NEAR(cam.cycles[200], 600 + 199 * 500, 1e-6);
  EXPECT_NEAR(cam.origins[200], 400 + 199 * 350, 1e-6);
  EXPECT_NEAR(cam.slave(600 + 198 * 500 + 200), 400 + 198 * 350 + 200, 1e-6);
}

TEST(IdealCam, OfCamming4CountsInTheSlavesBits) {
  const auto cam =
      camming4(introduction, {0, 700}, "# measure: 6000\n# pulse: 40960\n# decpt: 1\n# unitvel: 0\n");
  EXPECT_EQ(cam.error_unit, "bits x4");
  EXPECT_DOUBLE_EQ(cam.error_scale, 40960.0 / 6000);
  EXPECT_DOUBLE_EQ(cam.speed_scale, 60.0 / 10);  // 10 Um a minute
}

TEST(IdealCam, EndsWhereOnlyTheProgramKnowsTheNextStep) {
  const auto geared = camming4("1,132,100,50\n2,154,200,200,0,2\n3,133,100,50\n4,136\n", {0, 1000});
  EXPECT_EQ(geared.silence, "sector 2 is a gearing, which the program ends");
  EXPECT_NEAR(geared.slave(250), 200, 1e-9);
  EXPECT_TRUE(std::isnan(geared.slave(301)));
  const auto waits = camming4("1,160,500\n2,132,100,50\n3,136\n", {0, 1000});
  EXPECT_EQ(waits.silence, "sector 1 waits for a count of the master that the program sets");
  EXPECT_FALSE(waits.runs());
}

TEST(IdealCam, OfGivenRowsOfLx3vpIsTheLinesBetweenThem) {
  const std::string rows = "master,slave\n1000,50\n3000,1050\n4000,950\n";
  const auto cam = ideal("lx3vp", rows, {-1500, 6900});
  EXPECT_THAT(cam.cycles, ElementsAre(-2000, 1000, 4000, 7000));
  EXPECT_THAT(cam.origins, ElementsAre(-900, 0, 900, 1800));
  EXPECT_EQ(cam.slave(1000), 50);
  EXPECT_EQ(cam.slave(2000), 550);
  EXPECT_EQ(cam.slave(3000), 1050);
  EXPECT_EQ(cam.slave(3500), 1000);
  EXPECT_EQ(cam.slave(4000), 950);
  EXPECT_EQ(cam.slave(-1000), 50 - 900 + 500);
  EXPECT_THAT(listed(cam.zones), testing::Contains("1000 3000 1 constant speed"));
}

// K100: the slave is in step for P3 at the ratio P4; the rest is the law, to the last digit.
TEST(IdealCam, OfEcamtbxIsTheExactLawNotItsRows) {
  const auto cam = ideal("lx3vp", ecams::rotary(), {0, 3183 * 2 - 1});
  ASSERT_EQ(cam.cycles.size(), 3U);
  const double ratio = 5.0 / 3;
  double synchronous = 0;
  for (const auto& zone : cam.zones) {
    if (!zone.synchronous || zone.from > 3183) continue;
    synchronous += zone.to - zone.from;
    const double middle = (zone.from + zone.to) / 2;
    EXPECT_NEAR(cam.slave(middle + 0.25) - cam.slave(middle - 0.25), 0.5 * ratio, 1e-6);
  }
  EXPECT_NEAR(synchronous, 333 / ratio, 1e-3);
  EXPECT_NEAR(cam.slave(3183) - cam.slave(0), 1000, 1e-9);
  EXPECT_NEAR(cam.slave(4183) - cam.slave(1000), 1000, 1e-9);
}

constexpr const char* knife =
    "# interpolation: POLY5_LINE\n# endless: positive\n# master_modulo: 8000000\n# master_unit: mm\n"
    "master,slave\n0,0\n1200000,720000\n";

TEST(IdealCam, OfMcCaminMeetsItsPointsAndGoesOnATurnEachCycle) {
  const auto cam = ideal("mc_camin", knife, {-1, 8'000'000.0 * 3});
  ASSERT_THAT(cam.cycles, ElementsAre(-8e6, 0, 8e6, 16e6, 24e6, 32e6));
  EXPECT_THAT(cam.origins, ElementsAre(-3.6e6, 0, 3.6e6, 7.2e6, 10.8e6, 14.4e6));
  EXPECT_NEAR(cam.slave(0), 0, 1e-6);
  EXPECT_NEAR(cam.slave(600'000), 360'000, 1e-6);
  EXPECT_NEAR(cam.slave(1'200'000), 720'000, 1e-6);
  // The quintic begins and ends at the line's speed: its middle is half way between, by symmetry.
  EXPECT_NEAR(cam.slave(4'600'000), (720'000 + 3'600'000) / 2.0, 1e-6);
  EXPECT_NEAR(cam.slave(8'600'000), 3'960'000, 1e-6);
  EXPECT_NEAR(cam.slave(-400'000), -240'000 + 0, 5000);
  EXPECT_EQ(cam.error_unit, "deg");
  EXPECT_DOUBLE_EQ(cam.error_step, 1e-4);
  EXPECT_DOUBLE_EQ(cam.error_scale, 1e-4);
  EXPECT_EQ(cam.slave_unit, "deg");
  EXPECT_EQ(cam.master_unit, "mm");
}

TEST(IdealCam, OfATableWithAFaultDoesNotRun) {
  EXPECT_FALSE(ideal("camming4", "sector,codeG\n1,999\n", {0, 1}).runs());
  EXPECT_FALSE(ideal("lx3vp", "master,slave\n0,0\n", {0, 1}).runs());
  EXPECT_FALSE(ideal("mc_camin", "# interpolation: LINEAR\nslave\n", {0, 1}).runs());
}

TEST(MotionName, SaysWhatTheSlaveDoes) {
  EXPECT_EQ(motion_name(0, 0, true), "dwell");
  EXPECT_EQ(motion_name(1, 1, true), "synchronism");
  EXPECT_EQ(motion_name(1.2, 1.2, true), "constant speed");
  EXPECT_EQ(motion_name(-1, -1, true), "return");
  EXPECT_EQ(motion_name(0, -2, false), "acceleration");
  EXPECT_EQ(motion_name(-2, 0, false), "deceleration");
  EXPECT_EQ(motion_name(1, 1, false), "compensation");
}

}  // namespace
}  // namespace drycut::sim::cams
