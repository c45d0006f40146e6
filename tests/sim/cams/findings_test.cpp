#include "sim/cams/camming4/judge.hpp"

#include <gmock/gmock.h>

#include "tests/sim/cams/bench.hpp"

namespace drycut::sim::cams {
namespace {

using cams::findings;
using cams::rows;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string stopped =
    "remark: the error stops the cam; what would come after it was not run [cam.remark]";

TEST(CamFindings, TheIntroductionIsSound) {
  cams::expect_findings({{cams::introduction(), {}}, {cams::introduction(), {}, {.master_speed = 100.0}}});
}

TEST(CamFindings, AStrokeThatDoesNotFitTheTravel) {
  // Out to 300 Um, and back: the slave turns round in sector 3, 25 Um behind its beginning.
  const std::string text = cams::header + "1,132,100,50\n2,133,225,225\n3,133,100,0\n4,135,200,-100\n5,136\n";
  const auto told = [&](const std::string& settings) {
    auto all = findings(cams::table(settings + text));
    std::erase_if(all, [](const std::string& one) { return one.find("warning 5") != std::string::npos; });
    return all;
  };
  const double top = reach_of(run_cam(cams::table(text), {}, 1).visits.at(2)).high;
  EXPECT_NEAR(top, 300, 1e-6);
  EXPECT_THAT(told("# minpos: 0\n# maxpos: 300\n"), IsEmpty());
  EXPECT_THAT(
      told("# maxpos: 299\n"),
      ElementsAre("sector 3 (133 RSC): limit: the stroke does not fit the travel: slave at 300 Um, "
                  "maxpos is 299; shorten the stroke, or let the cam begin 1 Um further back [cam.travel]"));
  EXPECT_THAT(told("# minpos: 10\n# maxpos: 200\n"),
              ElementsAre(HasSubstr("sector 1 (132 AZM): limit: the stroke does not fit the travel: slave at "
                                    "0 Um, minpos is 10; shorten the stroke to 190 Um at most and "
                                    "let the cam begin 10 Um further on; it is 300"),
                          HasSubstr("maxpos is 200; shorten the stroke to 190 Um at most and let the cam")));
  EXPECT_THAT(
      cams::faults("# maxpos: 5\n# minpos: 6\n" + text),
      ElementsAre(
          "2:1: minpos is above maxpos; give the lower end of the travel as minpos [cam.out-of-range]"));
}

TEST(CamFindings, Error1TooManyRowsWithoutMasterSpace) {
  std::string text = "1,133,100,0\n";
  for (int row = 2; row <= 10; ++row) text += std::to_string(row) + ",130\n";
  EXPECT_THAT(
      findings(rows(text + "11,136\n")),
      Contains(
          "sector 11 (136 END): error 1: too many sectors in sequence that take no master space; at most "
          "9 such rows and 4 count updates may follow each other: put a movement between [cam.device]"));
  EXPECT_THAT(findings(rows("1,133,100,0\n2,139,1\n3,139,1\n4,139,1\n5,139,1\n6,139,1\n7,138\n")),
              Contains(HasSubstr("sector 6 (139 SMS): error 1: ")));
}

TEST(CamFindings, CautionsAboveSevenRowsAndThreeUpdates) {
  std::string text = "1,133,100,0\n";
  for (int row = 2; row <= 8; ++row) text += std::to_string(row) + ",130\n";
  cams::expect_findings(
      {{rows(text + "9,136\n"),
        {"sector 2 (130 NOP): caution: 8 rows without master space in sequence; the manual's limits (1.10) "
         "allow 7 [cam.manual-limits]"}},
       {rows("1,133,100,0\n2,139,25\n3,139,25\n4,139,25\n5,139,25\n6,137,1\n"),
        {"sector 2 (139 SMS): caution: 4 count updates in sequence; the manual's limits (1.10) allow 3 "
         "[cam.manual-limits]"}}});
}

TEST(CamFindings, Error2JumpOntoAStartFromZero) {
  EXPECT_THAT(
      findings(rows("1,131,100,50\n2,133,100,75\n3,138\n")),
      ElementsAre(
          "sector 1 (131 AZL) in pass 2: error 2: jump with the slave moving onto a sector that starts "
          "from speed 0 (ratio 0.5); end the sector before the jump at standstill (135), or begin here "
          "with 133, 134 or 154 [cam.device]",
          stopped));
}

TEST(CamFindings, Error3ARowThatIsNotThere) {
  EXPECT_THAT(
      findings(rows("1,133,100,0\n3,136\n")),
      ElementsAre("sector 2: error 3: the table has no such sector; give sector 2, or end the cam before it "
                  "with 136 END or 138 LOOP [cam.device]",
                  "remark: the cam did not reach sector 3 [cam.not-judged]", stopped));
}

TEST(CamFindings, Error4MasterSpaceTooSmall) {
  EXPECT_THAT(findings(rows("1,133,0,10\n2,136\n")),
              Contains("sector 1 (133 RSC): error 4: codeQm is 0: a movement needs master space; give codeQm "
                       "at least 1 [cam.device]"));
  EXPECT_THAT(findings(rows("1,153,10,10,0,5\n2,136\n")),
              Contains("sector 1 (153 NVSR): error 4: codeQma is 0: the ramp needs master space; give "
                       "codeQma at least 1 [cam.device]"));
  EXPECT_THAT(
      findings(cams::table("# measurem: 10\n" + cams::header + "1,133,105,0\n2,133,4,0\n3,136\n")),
      Contains("sector 2 (133 RSC): error 4: it is over within one count of the master (10 Um); give it at "
               "least 10 Um of master space [cam.device]"));
}

TEST(CamFindings, Error4ASectorShorterThanASampling) {
  const auto table = cams::table("# TCamp: 5\n# unitvel: 0\n# decpt: 1\n" + cams::header +
                                 "1,133,100,0\n2,133,9,0\n3,133,10,0\n4,136\n");
  EXPECT_THAT(findings(table), IsEmpty());
  // 12000 unit/min are 2000 Um/s, 10 Um in 5 ms.
  cams::expect_findings(
      {{table,
        {"sector 2 (133 RSC): error 4: master space too small: 9 Um are over in 4.5 ms, less than a sampling "
         "time of 5 ms; give it at least 10 Um, or run the master at 10800 unit/min at most [cam.device]"},
        {.master_speed = 12000.0}},
       {table, {}, {.master_speed = 10800.0}}});
}

TEST(CamFindings, Error4AGearingNeedsLongLaps) {
  EXPECT_THAT(findings(rows("1,154,10,5,0,2\n"), {.master_speed = 5001.0}),
              Contains(HasSubstr("NVS): error 4: ")));
  EXPECT_THAT(findings(rows("1,154,10,5,0,2\n"), {.master_speed = 5000.0}),
              Not(Contains(HasSubstr("error"))));
  EXPECT_THAT(findings(rows("1,154,1,5,0,2\n")), Contains(HasSubstr("sector 1 (154 NVS): error 4: ")));
}

TEST(CamFindings, Error6JumpsOutsideTheTable) {
  EXPECT_THAT(
      findings(rows("1,133,100,0\n2,137,129\n")),
      Contains(
          "sector 2 (137 ABJ): error 6: jump to row 129; give a row from 1 to 128 in codeQm [cam.device]"));
  EXPECT_THAT(findings(rows("1,133,100,0\n2,190,0,5\n")),
              Contains(HasSubstr("sector 2 (190 CNJ): error 6: jump to row 0")));
  EXPECT_THAT(findings(rows("1,137,128\n128,133,100,0\n")),
              Contains("sector 128 (133 RSC): error 6: the table runs on over row 128; end it with 136 END "
                       "or 138 LOOP [cam.device]"));
}

TEST(CamFindings, Error7ALateStart) {
  EXPECT_THAT(
      findings(rows("1,133,100,0\n2,160,500\n3,136\n")),
      Contains(
          "sector 2 (160 STS): error 7: sector 160 not at the beginning of the cam; put 160 before every "
          "movement, and let jumps go to the row after it [cam.device]"));
}

TEST(CamFindings, Errors50And51OfArcs) {
  EXPECT_THAT(
      findings(rows("1,171,24,30,0,40\n2,136\n")),
      Contains(
          "sector 1 (171 US): error 50: radius too small to join the two points: 24 for a chord of 50; give "
          "codeQm at least 25, or at most -25 for the long way [cam.device]"));
  EXPECT_THAT(
      findings(rows("1,172,24\n2,136\n")),
      Contains("sector 1 (172 HC): error 51: displacements of an arc are 0 but its radius is not; give a "
               "displacement in codeQs or codeQsa, or 0 in codeQm for no movement [cam.device]"));
}

TEST(CamFindings, Warnings1And2NeedTheMastersSpeed) {
  // Limits 1000 * 100 / 50 = 2000 and 1000 * 100 / 100 = 1000 Um/s2; the ramps need 300^2 / 100 = 900.
  const auto table = cams::table("# maxvel: 1000\n# taccmax: 50\n# tdecmax: 100\n" + cams::header +
                                 "1,132,100,50\n2,135,100,50\n3,136\n");
  cams::expect_findings(
      {{table, {}},
       {table, {}, {.master_speed = 300.0}},
       {table,
        {"sector 2 (135 DZC): warning 2: deceleration above tdecmax: 1600 Um/s2 at its peak, 1000 allowed; "
         "give it more master and slave space alike, or run the master at 316.227 Um/s at most [cam.device]"},
        {.master_speed = 400.0}}});
  EXPECT_THAT(
      findings(table, {.master_speed = 500.0}),
      Contains(
          "sector 1 (132 AZM): warning 1: acceleration above taccmax: 2500 Um/s2 at its peak, 2000 allowed; "
          "give it more master and slave space alike, or run the master at 447.213 Um/s at most "
          "[cam.device]"));
}

TEST(CamFindings, Warning5TurningBack) {
  cams::expect_findings(
      {{rows("1,131,100,50\n2,133,100,20\n3,135,100,-15\n4,136\n"),
        {"sector 2 (133 RSC): warning 5: final speed of the opposite sign to the initial one: enters at "
         "ratio 1, leaves at -0.6; give codeQs at least 50, or stop the slave before (135) [cam.device]"}},
       {rows("1,131,100,50\n2,133,100,50\n3,136\n"), {}}});
}

TEST(CamFindings, Warning6AnAccelerationMetMoving) {
  EXPECT_THAT(
      findings(rows("1,131,100,50\n2,131,100,50\n3,135,100,50\n4,136\n")),
      ElementsAre(
          "sector 2 (131 AZL): warning 6: acceleration sector met with the slave moving; it starts from "
          "speed 0 (ratio 1); end the sector before it at standstill (135), or use 133, which takes the "
          "speed over [cam.device]"));
}

TEST(CamFindings, Warning7TellsTheLeastSpace) {
  cams::expect_findings(
      {{rows("1,131,100,50\n2,135,100,20\n3,136\n"),
        {"sector 2 (135 DZC): warning 7: medium speed of the opposite sign to the initial one: ratio -0.1 "
         "between 1 and 0; give codeQs at least 25 [cam.device]"}},
       {rows("1,131,100,50\n2,135,100,25\n3,136\n"), {}},
       {rows("1,131,100,-50\n2,234,100,-40\n3,235,100,-50\n4,136\n"),
        {HasSubstr("sector 2 (234 RCCE): warning 7: medium speed of the opposite sign to the initial one: "
                   "ratio 0.2 between -1 and -1; give codeQs at most -50")}}});
}

TEST(CamFindings, Warning7OfAuxiliarySpacesIsInBits) {
  const std::string axes = "# measure: 2\n";  // 0.5 bit a Um
  cams::expect_findings(
      {{cams::table(axes + cams::header + "1,152,1,1,80,8\n2,135,100,50\n3,136\n"),
        {HasSubstr("sector 1 (152 AZMS): warning 7: medium speed of the opposite sign to the initial one: "
                   "ratio -0.1 between 0 and 1; give codeQsa at least 10 bits")}},
       {cams::table(axes + cams::header + "1,152,1,1,80,10\n2,135,100,50\n3,136\n"), {}},
       {cams::table(axes + cams::header + "1,131,100,50\n2,151,100,100,80,8\n3,136\n"),
        {HasSubstr("sector 2 (151 DZMC): warning 7: medium speed of the opposite sign to the initial one: "
                   "ratio -0.1 between 1 and 0; give codeQsa at least 10 bits")}}});
}

TEST(CamFindings, Warning9AQuotaAlreadyPassed) {
  EXPECT_THAT(
      findings(rows("1,140,500\n2,160,250\n3,133,10,0\n4,136\n")),
      ElementsAre(
          "sector 2 (160 STS): warning 9: start quota of sector 160 already passed: it waits until the "
          "master has come back below it; give codeQm above the master's count at the start [cam.device]",
          "remark: the cam did not reach sector 3, 4 [cam.not-judged]",
          "remark: the cam stays in sector 160 without end; what follows it was not run [cam.remark]"));
}

TEST(CamFindings, Warning10SofteningIsNotDone) {
  cams::expect_findings(
      {{rows("1,154,100,50,1\n2,130\n3,154,100,100\n4,135,100,50\n5,136\n"),
        {"sector 3 (154 NVS): warning 10: softening between sectors 154 not executed; put "
         "the two 154 or 254 rows next to each other, or give codeQma 0 in sector 1 [cam.device]"}},
       {rows("1,154,100,50,1\n2,154,100,100\n3,135,100,50\n4,136\n"), {}}});
}

TEST(CamFindings, LimitsNameTheSectorAndItsPeak) {
  const auto table = rows("1,231,100,60\n2,133,50,60\n3,135,100,60\n4,136\n");
  cams::expect_findings(
      {{table, {}, {.master_speed = 100.0, .max_velocity = 120.0, .max_acceleration = 240.0}},
       {table,
        {"sector 1 (231 AZLE): limit: velocity 120 Um/s above 110; lower its ratio 1.2 to 1.1, or run the "
         "master at 91.6666 Um/s at most [cam.limit]",
         "sector 1 (231 AZLE): limit: acceleration 240 Um/s2 above 200; give it more master and slave space "
         "alike, or run the master at 91.287 Um/s at most [cam.limit]",
         HasSubstr("sector 2 (133 RSC): limit: velocity 120 Um/s above 110"),
         HasSubstr("sector 3 (135 DZC): limit: velocity 120 Um/s above 110")},
        {.master_speed = 100.0, .max_velocity = 110.0, .max_acceleration = 200.0}},
       {table, {}, {.master_speed = 91.6666, .max_velocity = 110.0}},
       {table, {}, {.master_speed = 91.287, .max_acceleration = 200.0}}});
}

TEST(CamFindings, MaxvelSaturatesTheOutput) {
  const auto table = cams::table("# maxvel: 150\n" + cams::header + "1,131,100,50\n2,135,100,50\n3,136\n");
  EXPECT_THAT(findings(table, {.master_speed = 150.0}), IsEmpty());
  EXPECT_THAT(
      findings(table, {.master_speed = 151.0}),
      Contains(
          "sector 1 (131 AZL): limit: velocity 151 Um/s above maxvel 150: the output saturates (warning 3 or "
          "4); run the master at 150 Um/s at most [cam.limit]"));
}

TEST(CamFindings, CautionsAboutTheTransducers) {
  const auto table = cams::table("# pulsem: 4\n# pulse: 8\n" + cams::header +
                                 "1,131,100,37\n2,134,100,76\n3,135,100,37\n4,136\n");
  EXPECT_THAT(
      findings(table),
      ElementsAre(
          "sector 2 (134 RCC): caution: the slave's transducer gives 1.56 times as many bits as the "
          "master's; 1.5 is the most; use a finer transducer on the master or a coarser one on the slave "
          "(manual 1.6) [cam.resolution]"));
}

TEST(CamFindings, CautionsAboutTheEndAndTheCounts) {
  cams::expect_findings({{rows("1,131,100,50\n2,136\n"),
                          {"sector 2 (136 END): caution: releases the slave at ratio 1: it stops without a "
                           "ramp; end the sector before it at standstill (135) [cam.no-ramp]"}},
                         {rows("1,131,100,50\n2,135,100,50\n3,139,150,100\n4,137,1\n"),
                          {"caution: positm grows by 50 Um each time round and leaves its range in the end; "
                           "take it off before the jump (139), or end the loop with 138 [cam.leaves-range]"}},
                         {rows("1,131,100,50\n2,135,100,50\n3,137,1\n"),
                          {HasSubstr("positm grows by 200 Um"), HasSubstr("posit grows by 100 Um")}},
                         {rows("1,131,100,50\n2,135,100,50\n3,142,0,0\n4,137,1\n"), {}},
                         {rows("1,131,100,50\n2,135,100,50\n3,138\n"), {}}});
}

TEST(CamFindings, CautionsAboutChangesOfRatio) {
  EXPECT_THAT(
      findings(rows("1,154,100,0,5,3\n2,136\n")),
      ElementsAre(
          "sector 1 (154 NVS): caution: codeQma 5 softens nothing; give 0 for none or 1 to 4 for 1/2 to "
          "1/5 of the smaller sector [cam.value]",
          "sector 1 (154 NVS): caution: codeQsa 3 has no meaning and acts as 0; give 0 movement follows, "
          "1 axis stationary next, 2 gearing [cam.value]"));
}

TEST(CamFindings, WhatIsNotReachedIsCheckedAlone) {
  EXPECT_THAT(
      findings(rows("1,133,100,0\n2,136\n3,171,5,30,0,40\n4,137,200\n5,133,0,5\n6,133,10,5\n")),
      ElementsAre(
          HasSubstr("sector 3 (171 US): caution: not reached; it would raise error 50: "),
          "sector 4 (137 ABJ): caution: not reached; it would raise error 6: jump to row 200; give a row "
          "from 1 to 128 in codeQm [cam.device]",
          HasSubstr("sector 5 (133 RSC): caution: not reached; it would raise error 4: codeQm is 0"),
          "remark: the cam did not reach sector 3, 4, 5, 6 [cam.not-judged]"));
}

TEST(CamFindings, AGearingIsRemarked) {
  EXPECT_THAT(
      findings(rows("1,154,100,40,0,2\n")),
      ElementsAre(
          "sector 1 (154 NVS): remark: a gearing runs until the program writes codeQsa 0 or 1; shown for "
          "one lap of codeQm [cam.remark]"));
}

TEST(CamFindings, AllViolationsOfAChainInTheOrderOfRunning) {
  const auto told =
      findings(rows("1,131,100,50\n2,133,100,20\n3,135,100,20\n4,131,100,50\n5,132,100,50\n6,137,130\n"));
  EXPECT_THAT(told, ElementsAre(HasSubstr("sector 2 (133 RSC): warning 5: "),
                                HasSubstr("sector 3 (135 DZC): warning 7: "),
                                HasSubstr("sector 5 (132 AZM): warning 6: "),
                                HasSubstr("sector 6 (137 ABJ): error 6: "), stopped));
}

TEST(CamFindings, AViolationThatOnlyTheSecondPassMeetsIsFound) {
  // 133 leaves 1 the first time and 2*75/100 - 1 = 0.5 the next time.
  const auto told = findings(rows("1,133,100,50\n2,133,100,100\n3,135,100,20\n4,133,100,90\n5,138\n"));
  EXPECT_THAT(told, Contains(HasSubstr(" in pass 2: warning ")));
}

TEST(CamFindings, SoundnessAndStrictness) {
  const auto judged = [](const CammingTable& table) { return judge(table, {}, run_cam(table, {}, 1)); };
  const auto warned = judged(rows("1,131,100,50\n2,135,100,20\n3,136\n"));
  EXPECT_FALSE(is_unsound(warned, false));
  EXPECT_TRUE(is_unsound(warned, true));
  const auto failed = judged(rows("1,133,100,0\n"));
  EXPECT_TRUE(is_unsound(failed, false));
  const auto remarked = judged(rows("1,154,100,40,0,2\n"));
  ASSERT_FALSE(remarked.empty());
  EXPECT_FALSE(is_unsound(remarked, true));
}

}  // namespace
}  // namespace drycut::sim::cams
