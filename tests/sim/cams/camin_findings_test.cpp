// What drycut cam finds in cams of MC_CamIn.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "tests/sim/cams/camin_bench.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cams {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const CamDuty at_600{.master_speed = 600};

TEST(CamInFindings, ASoundCamHasNone) {
  EXPECT_THAT(camin::findings(camin::knife(), at_600), IsEmpty());
  EXPECT_THAT(camin::findings(camin::knife(), {}, true),
              ElementsAre("remark: C2 at every knot and where the table closes [cam.remark]"));
}

TEST(CamInFindings, LimitsAreJudgedByTheLawsPeaksAndTheRemedyIsTheLimit) {
  // At 600 mm/s the line turns with 360 deg/s; the quintic's peak of acceleration is 10/sqrt(3) D/h2.
  const auto limits = [](const std::string& settings, double speed) {
    return camin::findings(camin::knife("# endless: positive\n" + settings), {.master_speed = speed});
  };
  EXPECT_THAT(limits("# maxvel: 360\n", 600), IsEmpty());
  EXPECT_THAT(limits("# maxvel: 359\n", 600),
              ElementsAre("row 1 (line 7): limit: velocity 360 deg/s above 359; so at 2 rows; run the "
                          "master at 598.333 mm/s at most [cam.limit]"));
  const double d = 0.6 * 680 - 288;  // deg
  const double peak = d / 680 / 680 * 10 / std::sqrt(3.0) * 600 * 600;
  EXPECT_THAT(limits(fmt::format("# maxacc: {}\n", peak * 1.00001), 600), IsEmpty());
  EXPECT_THAT(limits(fmt::format("# maxacc: {}\n", peak * 0.99999), 600),
              ElementsAre(HasSubstr("row 2 (line 8): limit: acceleration 539.393 deg/s2 above ")));
  const double jerk = d / 680 / 680 / 680 * 60 * 600 * 600 * 600;
  EXPECT_THAT(limits(fmt::format("# maxjerk: {}\n", jerk * 1.00001), 600), IsEmpty());
  EXPECT_THAT(limits(fmt::format("# maxjerk: {}\n", jerk * 0.99999), 600),
              ElementsAre(HasSubstr("row 2 (line 8): limit: jerk ")));
  EXPECT_THAT(camin::findings(camin::knife(), {.master_speed = 600, .max_velocity = 350}),
              ElementsAre(HasSubstr("velocity 360 deg/s above 350")));
}

/// The least of the speeds that the findings' remedies name.
double speed_told(const std::vector<std::string>& told) {
  const std::string words = "run the master at ";
  double least = INFINITY;
  for (const auto& one : told)
    if (const auto at = one.find(words); at != std::string::npos)
      least = std::min(least, std::stod(one.substr(at + words.size())));
  return least;
}

TEST(CamInFindings, TheRemedysSpeedIsSoundItself) {
  std::vector<std::string> cams;
  for (const char* limits : {"# maxvel: 359\n", "# maxvel: 20\n", "# maxacc: 500\n", "# maxacc: 70\n",
                             "# maxjerk: 777\n", "# maxvel: 77\n# maxacc: 11\n# maxjerk: 13\n"})
    cams.push_back(camin::knife(std::string("# endless: positive\n") + limits));
  for (const char* name : {"mc_eject.csv", "mc_flying_saw.csv"})
    cams.push_back(content(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/cams" / name));
  for (const auto& text : cams) {
    const auto unsound = [&](double speed) {
      auto told = camin::findings(text, {.master_speed = speed});
      std::erase_if(told, [](const auto& one) { return one.find("limit: ") == std::string::npos; });
      return told;
    };
    const auto told = unsound(50'000);
    const double speed = speed_told(told);
    ASSERT_TRUE(std::isfinite(speed)) << text;
    EXPECT_THAT(unsound(speed), IsEmpty()) << told[0];
    EXPECT_THAT(unsound(speed * 1.00002), Not(IsEmpty())) << told[0];
  }
}

TEST(CamInFindings, WhatTheTravelsRemedyAsksForIsEnough) {
  const auto told = [](const std::string& travel, double low, double high) {
    return camin::findings(fmt::format(
        "# slave_modulo: 0\n# interpolation: POLYNOM_3_KOEFF\n{}a0,a1,a2,a3\n"
        "{},0,{},{}\n{},0,{},{}\n",
        travel, low, 3 * (high - low), -2 * (high - low), high, 3 * (low - high), -2 * (low - high)));
  };
  const std::string travel = "# minpos: -100.5\n# maxpos: 1000\n";
  EXPECT_THAT(told(travel, 0, 2000),
              ElementsAre("limit: the stroke does not fit the travel: slave at 2000 0.1 um, maxpos is 1000; "
                          "shorten the stroke to 1100.5 0.1 um at most and let the cam begin 100.5 0.1 um "
                          "further back; it is 2000 [cam.travel]"));
  EXPECT_THAT(told(travel, -100.5, 1000), IsEmpty());
  // From above: the end that the cam begins at is the upper one.
  EXPECT_THAT(
      told("# minpos: -1000\n# maxpos: -200\n", -2000, 0),
      ElementsAre(HasSubstr("shorten the stroke to 800 0.1 um at most and let the cam begin 200 0.1 um "
                            "further back; it is 2000"),
                  HasSubstr("further back; it is 2000")));
  // Where the begin is right a shorter stroke is enough.
  EXPECT_THAT(told("# minpos: 0\n# maxpos: 1000\n", 0, 2000),
              ElementsAre(HasSubstr("shorten the stroke to 1000 0.1 um at most; it is 2000")));
  // Ten digits and more are needed to meet the limit.
  EXPECT_THAT(told("# minpos: -100000000.125\n# maxpos: 1000000000\n", 0, 1000000000.0625),
              ElementsAre(HasSubstr("let the cam begin 0.0625 0.1 um further back")));
  EXPECT_THAT(
      told("# minpos: -100000000.125\n# maxpos: 1000000000\n", 0, 1123456789.0625),
      ElementsAre(HasSubstr("shorten the stroke to 1100000000.125 0.1 um at most and let the cam begin "
                            "100000000.125 0.1 um further back; it is ")));
}

TEST(CamInFindings, WhereTheVelocityJumpsNoAccelerationIsEnough) {
  EXPECT_THAT(
      camin::findings("# maxacc: 1e9\nslave\n0\n900000\n", at_600),
      ElementsAre("row 1 (line 3): limit: acceleration without end: what it is the derivative of jumps "
                  "there; so at 2 rows; see the table of knots [cam.limit]",
                  "row 1 (line 3): caution: the velocity jumps by 600 deg/s; so at 2 rows; POLYNOM_3, or "
                  "POLY5 between lines, has no such jumps [cam.jump]"));
  EXPECT_THAT(camin::findings("# maxjerk: 1e12\n# interpolation: POLYNOM_3\nslave\n0\n0\n900000\n", at_600),
              Contains(HasSubstr("limit: jerk without end")));
  EXPECT_THAT(camin::findings("# maxvel: 1e9\n# interpolation: STEP_DIRECT\nslave\n0\n9\n", at_600),
              Contains(HasSubstr("limit: velocity without end")));
}

TEST(CamInFindings, WithoutTheMastersSpeedLimitsAreOnlyRemembered) {
  EXPECT_THAT(
      camin::findings(camin::knife("# endless: positive\n# maxvel: 1\n"), {}, true),
      Contains("remark: maxvel, maxacc and maxjerk are judged with --master-speed only [cam.remark]"));
}

TEST(CamInFindings, StepsAreTold) {
  EXPECT_THAT(
      camin::findings("# interpolation: STEP_DIRECT\nslave\n0\n500\n200\n"),
      ElementsAre("row 2 (line 4): caution: the position jumps by 0.05 deg; so at 3 rows; "
                  "STEP_DIRECT is for switching; LINEAR and POLYNOM_3 have no such jumps [cam.jump]"));
  EXPECT_THAT(camin::findings("a0,a1,a2,a3\n0,0,0,0\n7,0,0,0\n"),
              ElementsAre(HasSubstr("let each row end where the next one begins")));
  // A turn of the slave is no fault of the numbers.
  const std::string turn = "a0,a1,a2,a3\n0,3600000,0,0\n";
  EXPECT_THAT(camin::findings(turn),
              ElementsAre(HasSubstr("it is a turn of the slave: write # endless: positive or negative")));
  EXPECT_THAT(camin::findings("# endless: positive\n" + turn), IsEmpty());
}

TEST(CamInFindings, ASinglePassThatDoesNotRestIsTold) {
  const std::string lines = "# periodic: no\n# slave_modulo: 0\nslave\n0\n900000\n";
  EXPECT_THAT(
      camin::findings(lines),
      ElementsAre(HasSubstr("the velocity jumps"),
                  "caution: not periodic, and begins at velocity 0.5 (slave/master): the slave starts "
                  "without a ramp; let the cam begin and end at rest, at master 0 [cam.no-ramp]",
                  HasSubstr("ends at velocity -0.5 (slave/master): the slave is stopped without a ramp")));
  EXPECT_THAT(camin::findings("# periodic: no\na0,a1,a2,a3\n0,0,300,-200\n100,0,-300,200\n"), IsEmpty());
  EXPECT_THAT(camin::findings("# slave_modulo: 0\nslave\n0\n900000\n"), ElementsAre(HasSubstr("jumps")));
  // Where the turn ends inside a piece the pass ends there too.
  EXPECT_THAT(camin::findings("# periodic: no\n# interpolation: LINE_POLY5\n# endless: "
                              "positive\nmaster,slave\n600000,0\n3000000,2400000\n"),
              ElementsAre(HasSubstr("begins at velocity 1 "), HasSubstr("ends at velocity 1 ")));
}

TEST(CamInFindings, ACamThatWantsToTurnOnIsAsked) {
  const std::string turning = "slave\n0\n900000\n1800000\n2700000\n";
  EXPECT_THAT(
      camin::findings(turning),
      ElementsAre(HasSubstr("the velocity jumps"),
                  "row 4 (line 5): caution: goes back by 270 deg, more than half a turn; if the "
                  "slave is to turn on instead, write # endless: positive or negative [cam.half-turn]"));
  EXPECT_THAT(camin::findings("# endless: positive\n" + turning), IsEmpty());
  EXPECT_THAT(camin::findings("# slave_modulo: 0\n" + turning), ElementsAre(HasSubstr("the velocity jumps")));
}

TEST(CamInFindings, OvershootIsTold) {
  // A quintic between two steep lines that come from the same side: -5 (v1 - v0) h/32 beyond its middle.
  const std::string text =
      "# interpolation: LINE_POLY5\n# slave_modulo: "
      "0\nmaster,slave\n0,1000000\n900000,1000000\n1800000,500000\n"
      "2700000,500000\n";
  const auto told = camin::findings(
      "# interpolation: LINE_POLY5\nmaster,slave\n0,1000000\n900000,1000000\n"
      "1800000,500000\n2700000,500000\n");
  EXPECT_THAT(told, ElementsAre("row 1 (line 3): caution: overshoots its two rows by 15.625 deg; so at 2 "
                                "rows; make the lines before and after it less steep [cam.overshoot]"));
  EXPECT_FALSE(camin::findings(text).empty());
  EXPECT_THAT(
      camin::findings("# interpolation: POLYNOM_3\nslave\n0\n0\n160000\n"),
      ElementsAre(HasSubstr("overshoots its two rows by 2 deg"), HasSubstr("leaves its turn: -20000 to")));
}

TEST(CamInFindings, AnEndlessCamThatTurnsBackIsTold) {
  const std::string text =
      "# interpolation: POLY5_LINE\nmaster,slave\n0,0\n1800000,3000000\n";  // back to be a line of ratio 5/3
  EXPECT_THAT(camin::findings("# endless: positive\n" + text),
              ElementsAre(HasSubstr("row 2 (line 5): caution: runs against its direction, at ")));
  EXPECT_THAT(camin::findings(camin::knife()), IsEmpty());
  EXPECT_THAT(camin::findings("# endless: negative\nslave\n0\n900000\n"),
              Contains(HasSubstr("runs against its direction")));
}

TEST(CamInFindings, PositionsOutsideTheTurnAndTheTravelAreTold) {
  EXPECT_THAT(camin::findings("# interpolation: POLYNOM_3\nslave\n3600000\n3599999\n3600002\n"),
              ElementsAre(HasSubstr("caution: the slave leaves its turn: 35999")));
  const std::string linear = "# slave_modulo: 0\n# interpolation: POLYNOM_3\n";
  EXPECT_THAT(camin::findings(linear + "# minpos: 0\n# maxpos: 100\nslave\n0\n101\n0\n"),
              ElementsAre(HasSubstr("slave at 101 0.1 um, maxpos is 100"),
                          HasSubstr("slave at -12.625 0.1 um, minpos is 0"), HasSubstr("overshoots")));
  EXPECT_THAT(camin::findings(linear + "# minpos: -1\n# maxpos: 101\nslave\n0\n100\n"), IsEmpty());
}

TEST(CamInFindings, ARemarkSaysWhereTheTableBegins) {
  EXPECT_THAT(
      camin::findings("# interpolation: LINE_POLY5\n# endless: "
                      "positive\nmaster,slave\n600000,0\n3000000,2400000\n",
                      {}, true),
      Contains("remark: the first point is at master 600000: before it the last piece goes on [cam.remark]"));
}

}  // namespace
}  // namespace drycut::sim::cams
