// What is found in cams of LX3VP, and how they run and are sampled.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/sim/cams/bench.hpp"
#include "tests/sim/cams/ecam_bench.hpp"

namespace drycut::sim::cams {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

EcamTable ecam_rows(const std::string& text, const std::string& settings = "") {
  return ecams::table(settings + "master,slave\n" + text);
}

TEST(EcamFindings, SoundTablesHaveNone) {
  ecams::expect_findings({{ecam_rows("0,0\n100,50\n200,100\n"), {}},
                          {ecams::table(ecams::rotary()), {}},
                          {ecams::table(ecams::s_curve()), {}}});
}

TEST(EcamFindings, TablesThatTheDeviceRefuses) {
  ecams::expect_findings(
      {{ecam_rows("0,0\n"),
        {"row 0 (line 2): error 6782: a cam of one row has no length; give at least two rows [cam.device]"}},
       {ecam_rows("-5,0\n10,5\n10,6\n4,7\n"),
        {"row 0 (line 2): error 6782: the cam begins at master -5; begin at 0 [cam.device]",
         "row 2 (line 4): error 6782: master 10 does not come after 10; give the rows in ascending order of "
         "the master, each position once [cam.device]",
         "row 3 (line 5): error 6782: master 4 does not come after 10; give the rows in ascending order of "
         "the master, each position once [cam.device]"}}});
  std::string many;
  for (int i = 0; i < 513; ++i) many += std::to_string(i) + ",0\n";
  EXPECT_THAT(ecams::findings(ecam_rows(many)),
              ElementsAre("row 512 (line 514): error 6782: 513 rows; a block takes 512 rows [cam.device]"));
}

TEST(EcamFindings, EcamtbxErrorsWithTheirRemedies) {
  const auto told = [](const std::string& text) { return ecams::findings(ecams::table(text)).at(0); };
  EXPECT_EQ(told(ecams::rotary("50/3", "3")),
            "error -1: ECAMTBX makes no table: there is no P6L 3; give P6L 0, 1 or 2 [cam.device]");
  EXPECT_EQ(told(ecams::rotary("50/3", "H00040001")),
            "error -1: ECAMTBX makes no table: there is no P6H 4; give P6H 0, 1, 2, 3 or 5, with 4096 "
            "(H1000) added to return [cam.device]");
  EXPECT_EQ(told(ecams::rotary("50/3", "H10060007")),
            "error -1: ECAMTBX makes no table: there is no P6L 7, P6H 4102; give P6L 0, 1 or 2 and P6H 0, 1, "
            "2, 3 or 5, with 4096 (H1000) added to return [cam.device]");
  EXPECT_THAT(told(ecams::rotary("50/3", "1", "-1")), HasSubstr("error -2: "));
  EXPECT_THAT(told(ecams::rotary("50/3", "1", "1001")), HasSubstr("; give P3 1000 at most"));
  EXPECT_THAT(told(ecams::rotary("1.5")),
              HasSubstr("error -4: ECAMTBX makes no table: the cycle needs a ratio above the largest "
                        "allowed (P5); give P5 1.66667 at least"));
  EXPECT_THAT(told(ecams::rotary("0")), HasSubstr("error -8: "));
  EXPECT_THAT(told(ecams::s_curve("0")), HasSubstr("; give P1 other than 0 and short enough for its speed"));
  const auto saw = [](const std::string& type, const std::string& P1, const std::string& more = "P6,1\n") {
    return "# ecamtbx: " + type + "\nparameter,value\nP1," + P1 + "\nP2,2000\nP3,667\nP4,9.424778\nP5,10\n" +
           more;
  };
  EXPECT_THAT(told(saw("K101", "353")),
              HasSubstr("error -3: ECAMTBX makes no table: the synchronous zone does not fit the cycle or "
                        "the slave's length (P1, P2, P3, P4); give P1 354 at least, or a larger P4"));
  EXPECT_THAT(told(saw("K100", "70")), HasSubstr("; give P1 205 at least, or a shorter P3"));
  EXPECT_THAT(told(saw("K100", "200")),
              HasSubstr("largest allowed (P5); give P5 10.3271 at least, or a longer P1"));
  EXPECT_THAT(told(saw("K101", "1750", "P7,9\n")), HasSubstr("error -5: "));
  EXPECT_THAT(told("# ecamtbx: K1\nparameter,value\nP1,100\nP2,0\nP4,1\nP5,1\nP6,60\n"),
              HasSubstr("error -6: ECAMTBX makes no table: a speed or a time is out of range (P2, P4, P5); "
                        "give P2 from 1 to 150000 Hz"));
}

TEST(EcamFindings, TheRemedyForAStrokeThatDoesNotFitIsEnough) {
  const auto fly = [](int P1) {
    return ecams::table("# ecamtbx: K101\nparameter,value\nP1," + std::to_string(P1) +
                        "\nP2,2000\nP3,667\nP4,9.424778\nP5,10\nP6,1\n");
  };
  EXPECT_FALSE(fly(353).made.ok());
  EXPECT_TRUE(fly(354).made.ok());
}

TEST(EcamFindings, RatiosAboveTheLimit) {
  EXPECT_THAT(ecams::findings(ecam_rows("0,0\n100,310\n200,600\n300,900\n", "# max_ratio: 3\n")),
              ElementsAre("row 1 (line 4): limit: ratio 3.1 above 3; give the piece before it 104 master "
                          "pulses at least [cam.limit]"));
  // What rounding to a pulse may do is no fault.
  EXPECT_THAT(ecams::findings(ecam_rows("0,0\n10,31\n20,60\n", "# max_ratio: 3\n")), IsEmpty());
  EXPECT_THAT(ecams::findings(ecam_rows("0,0\n10,-40\n20,-75\n30,-75\n", "# max_ratio: 3\n")),
              Contains("row 1 (line 4): limit: ratio -4 above 3, the worst of 2 rows; give the piece before "
                       "it 14 master pulses at least [cam.limit]"));
}

TEST(EcamFindings, SpeedsAtTheMastersSpeed) {
  const auto table = ecam_rows("0,0\n100,100\n200,300\n", "# max_frequency: 50000\n");
  ecams::expect_findings(
      {{table, {}, {.master_speed = 25000.0}},
       {table,
        {"row 2 (line 5): limit: output at 52000 Hz above 50000 Hz (words 6 and 7): the "
         "slave lags and catches up later; run the master at 25000 pulses/s at most [cam.limit]",
         "row 2 (line 5): limit: velocity 52000 pulses/s above 51000; run the master at "
         "25500 pulses/s at most [cam.limit]"},
        {.master_speed = 26000.0, .max_velocity = 51000.0}},
       {table,
        {"row 1 (line 4): limit: acceleration 10000 pulses/s2 above 9999; run the master "
         "at 999.949 pulses/s at most [cam.limit]"},
        {.master_speed = 1000.0, .max_acceleration = 9999.0}}});
}

TEST(EcamFindings, SpeedsOfMadeTablesAreOfTheLawOrOfTheSteeperRows) {
  // The law asks for 5/3; rows rounded to a pulse go to 7/4.
  const auto made = ecams::table(ecams::rotary());
  EXPECT_THAT(
      ecams::findings(made, {.master_speed = 1000.0, .max_velocity = 1750.0, .max_acceleration = 4165.0}),
      IsEmpty());
  const auto found =
      ecams::findings(made, {.master_speed = 1000.0, .max_velocity = 1749.0, .max_acceleration = 4164.0});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(found[0], testing::StartsWith("row "));
  EXPECT_THAT(found[0], testing::EndsWith(": limit: velocity 1750 pulses/s above 1749; run the master at "
                                          "999.428 pulses/s at most [cam.limit]"));
  EXPECT_EQ(found[1],
            "piece 2: limit: acceleration 4164.58 pulses/s2 above 4164; run the master "
            "at 999.929 pulses/s at most [cam.limit]");
}

/// The number behind some words of the only finding.
double number_behind(const std::vector<std::string>& found, const std::string& words) {
  if (found.size() != 1 || found[0].find(words) == std::string::npos) {
    ADD_FAILURE() << testing::PrintToString(found);
    return 0;
  }
  return std::stod(found[0].substr(found[0].find(words) + words.size()));
}

TEST(EcamFindings, TheRemedysSpeedIsSoundAsLawAndAsRows) {
  const auto saw = [](int P1) {
    return "# ecamtbx: K101\nparameter,value\nP1," + std::to_string(P1) +
           "\nP2,2000\nP3,667\nP4,9.424778\nP5,10\nP6L,1\n";
  };
  for (const auto& text : {saw(1750), saw(1777), saw(2001), ecams::rotary(), ecams::rotary("20", "2")}) {
    const auto law = ecams::table(text);
    const auto as_rows = ecams::table(ecam_rows_csv(law));
    for (const auto& table : {law, as_rows}) {
      const double speed =
          number_behind(ecams::findings(table, {.master_speed = 180000.0}), "run the master at ");
      EXPECT_GT(speed, 10000);
      ecams::expect_findings({{law, {}, {.master_speed = speed}}, {as_rows, {}, {.master_speed = speed}}});
      // It is the largest of six digits.
      EXPECT_THAT(ecams::findings(as_rows, {.master_speed = speed * 1.00002}), testing::SizeIs(1));
    }
  }
}

TEST(EcamFindings, TheRemedysP2IsSoundAsLawAndAsRows) {
  for (const double limit : {12345.0, 33333.0, 40000.0, 47777.0, 49999.0}) {
    const auto s_curve = [](int P2) {
      return ecams::table("# ecamtbx: K1\nparameter,value\nP1,10000\nP2," + std::to_string(P2) +
                          "\nP4,93\nP5,117\nP6,211\n");
    };
    const double P2 = number_behind(ecams::findings(s_curve(50000), {.max_velocity = limit}), "give P2 ");
    EXPECT_GT(P2, 0.8 * limit);
    EXPECT_LE(P2, limit);
    const auto law = s_curve(static_cast<int>(P2));
    ecams::expect_findings({{law, {}, {.max_velocity = limit}},
                            {ecams::table(ecam_rows_csv(law)), {}, {.max_velocity = limit}}});
  }
}

TEST(EcamFindings, AccelerationsOfMadeTablesAndTheirP2) {
  EXPECT_THAT(
      ecams::findings(ecams::table(ecams::s_curve()), {.max_velocity = 40000.0, .max_acceleration = 1000.0}),
      ElementsAre(
          "piece 1: limit: velocity 50000 pulses/s above 40000; give P2 40000 Hz at most [cam.limit]",
          "piece 1: limit: acceleration 785398 pulses/s2 above 1000; give its ramps more time [cam.limit]"));
}

TEST(EcamFindings, RatiosOfALawAboveTheLimit) {
  ecams::expect_findings(
      {{ecams::table("# max_ratio: 4.99\n" + ecams::s_curve()),
        {testing::MatchesRegex(
            "row [0-9]+: limit: ratio 5 above 4.99; give P2 [0-9]+ Hz at most [[]cam.limit[]]")}},
       {ecams::table("# max_ratio: 5\n" + ecams::s_curve()), {}},
       {ecams::table("# max_ratio: 1.66\n" + ecams::rotary()),
        {HasSubstr("limit: ratio 1.66667 above 1.66; no P5 does that: this cycle and its synchronous zone "
                   "(P1 to P4) need the ratio")}}});
}

TEST(EcamFindings, ACamThatRunsOnceJumpsFromRestOrToRest) {
  const auto s_curve = [](const std::string& P4, const std::string& P5) {
    return ecams::findings(ecams::table("# ecamtbx: K0\nparameter,value\nP1,10000\nP2,50000\nP4," + P4 +
                                        "\nP5," + P5 + "\nP6,200\n"));
  };
  const std::string start =
      "piece 1: caution: the ratio jumps from 0 to 5 as the cam starts; give P4 some time [cam.jump]";
  const std::string end =
      ": caution: the ratio jumps from 5 to 0 at the end of the cam; give P5 some time [cam.jump]";
  EXPECT_THAT(s_curve("100", "100"), IsEmpty());
  EXPECT_THAT(s_curve("0", "100"), ElementsAre(start));
  EXPECT_THAT(s_curve("100", "0"), ElementsAre("piece 2" + end));
  EXPECT_THAT(s_curve("0", "0"), ElementsAre(start, "piece 1" + end));
  const auto once = [](const std::string& P6) {
    return ecams::findings(ecams::table("# cyclic: 0\n" + ecams::rotary("50/3", P6)));
  };
  EXPECT_THAT(once("H00000001"),
              ElementsAre("piece 1: caution: the ratio jumps from 0 to 1.66667 as the cam starts; use "
                          "midCAMbegin for the first cycle [cam.jump]",
                          HasSubstr("the ratio jumps from 1.66667 to 0 at the end of the cam; use midCAMend "
                                    "for the last")));
  EXPECT_THAT(once("H00020001"), IsEmpty()) << "midCAMbegin goes on in another";
  EXPECT_THAT(once("H00030001"), IsEmpty()) << "midCAMend goes on from another";
}

TEST(EcamFindings, JumpsOfTheRatio) {
  ecams::expect_findings(
      {{ecam_rows("0,0\n100,0\n200,300\n300,300\n"),
        {"row 1 (line 3): caution: the ratio jumps from 0 to 3, the worst of 2 rows; put rows between, so "
         "that the slave can follow [cam.jump]"}},
       {ecam_rows("0,0\n100,300\n200,500\n300,600\n"),
        {"row 3 (line 5): caution: the ratio jumps from 1 to 3 as the cycle begins again; put rows between, "
         "so that the slave can follow [cam.jump]"}},
       {ecam_rows("0,0\n100,300\n200,500\n300,600\n", "# cyclic: 0\n"), {}},
       {ecams::table(ecams::rotary("50/3", "0")),
        {"piece 1: caution: the ratio jumps from 1.66667 to 0.223585; give P6L 1 or 2 for ramps [cam.jump]",
         "piece 2: caution: the ratio jumps from 0.223585 to 1.66667 as the cycle begins again; give P6L 1 "
         "or 2 for ramps [cam.jump]"}},
       {ecams::table(ecams::rotary("50/3", "1", "1000")),
        {"piece 1: caution: the ratio jumps from 1.66667 to 0; give P3 less than P2, so that there is way "
         "left for ramps [cam.jump]",
         "piece 2: caution: the ratio jumps from 0 to 1.66667 as the cycle begins again; give P3 less than "
         "P2, so that there is way left for ramps [cam.jump]"}}});
}

TEST(EcamFindings, ACycleThatDoesNotClose) {
  const auto table =
      ecams::table("# ecamtbx: K100\nparameter,value\nP1,1100\nP2,1700\nP3,200\nP4,2\nP5,8\nP6L,1\nP6H,2\n");
  EXPECT_THAT(ecams::findings(table), ElementsAre("piece 4: caution: the ratio jumps from 1 to 0 as the "
                                                  "cycle begins again; use midCAMbegin for the first cycle "
                                                  "and midCAMall for those after it [cam.jump]"));
  const auto end =
      ecams::table("# ecamtbx: K100\nparameter,value\nP1,1100\nP2,1700\nP3,200\nP4,2\nP5,8\nP6L,1\nP6H,3\n");
  EXPECT_THAT(ecams::findings(end), IsEmpty());
  EXPECT_THAT(ecams::findings(end, {}, true),
              Contains("remark: midCAMend: the cam stops by itself at the end of the cycle [cam.remark]"));
}

TEST(EcamFindings, AnSCurveTooShortForItsTimes) {
  EXPECT_THAT(ecams::findings(ecams::table(ecams::s_curve("3000"))),
              ElementsAre("caution: reaches 30000 Hz, not 50000 Hz: too short for its times; give P4 and P5 "
                          "less time [cam.not-reached]"));
}

TEST(EcamFindings, AStrokeThatDoesNotFitTheTravel) {
  const std::string there_and_back = "0,0\n100,300\n200,280\n300,-40\n400,0\n";
  const auto told = [&](const std::string& settings) {
    auto all = ecams::findings(ecam_rows(there_and_back, settings));
    std::erase_if(all, [](const std::string& text) { return text.find("jumps") != std::string::npos; });
    return all;
  };
  EXPECT_THAT(told("# min_position: -40\n# max_position: 300\n"), IsEmpty());
  EXPECT_THAT(told("# max_position: 299\n"),
              ElementsAre("row 1 (line 4): limit: the stroke does not fit the travel: slave at 300 pulses, "
                          "max_position is 299; shorten the stroke, or let the cam begin 1 pulses further "
                          "back [cam.travel]"));
  EXPECT_THAT(told("# min_position: -30\n# max_position: 400\n"),
              ElementsAre("row 3 (line 7): limit: the stroke does not fit the travel: slave at -40 pulses, "
                          "min_position is -30; shorten the stroke, or let the cam begin 10 pulses further "
                          "on [cam.travel]"));
  EXPECT_THAT(told("# min_position: -30\n# max_position: 290\n"),
              ElementsAre(HasSubstr("row 1 (line 5): limit: the stroke does not fit the travel: slave at "
                                    "300 pulses, max_position is 290; shorten the stroke to 320 pulses at "
                                    "most and let the cam begin 10 pulses further on; it is 340"),
                          HasSubstr("row 3 (line 7): limit: ")));
}

TEST(EcamFindings, TheTravelIsReadAndWrittenBack) {
  const std::string text = "# min_position: -2147483648\n# max_position: 2147483647\n";
  EXPECT_THAT(ecam_rows_csv(ecam_rows("0,0\n5,5\n", text)), HasSubstr(text + "master,slave\n"));
  ecams::expect_faults({{"# max_position: 5\n# min_position: 6\nmaster,slave\n0,0\n5,5\n",
                         {"2:1: min_position is above max_position; give the lower end of the travel as "
                          "min_position [cam.out-of-range]"}},
                        {"# max_position: 5.5\nmaster,slave\n0,0\n5,5\n",
                         {HasSubstr("1:17: max_position '5.5' is not a whole number")}}});
}

TEST(EcamFindings, ASawsStrokeAndItsRemedy) {
  const auto saw = [](const std::string& settings, int P2) {
    return ecams::findings(ecams::table("# ecamtbx: K101\n" + settings + "parameter,value\nP1,6600\nP2," +
                                        std::to_string(P2) + "\nP3,9400\nP4,2.5\nP5,2.5\nP6,1\nP7,400\n"));
  };
  const std::string travel = "# min_position: -500\n# max_position: 12000\n";
  const auto found = saw(travel, 12900);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0], testing::StartsWith("row "));
  EXPECT_THAT(found[0],
              testing::EndsWith(": limit: the stroke does not fit the travel: slave at 12900 pulses, "
                                "max_position is 12000; shorten the stroke (P2) to 12500 pulses at most and "
                                "let the cam begin 500 pulses further back; it is 12900 [cam.travel]"));
  EXPECT_THAT(saw(travel, 12500), ElementsAre(HasSubstr("let the cam begin 500 pulses further back")));
  EXPECT_THAT(saw(travel, 12000), IsEmpty());
}

TEST(EcamFindings, ACycleThatWandersLeavesTheTravelInTheEnd) {
  const std::string steps = "0,0\n100,50\n200,100\n";
  ecams::expect_findings(
      {{ecam_rows(steps, "# max_position: 350\n"),
        {"limit: the slave goes on by 100 pulses each cycle and passes max_position 350 in cycle 4; end the "
         "cycle where it begins, or run it once: # cyclic: 0 [cam.leaves-range]"}},
       {ecam_rows(steps, "# max_position: 400\n"), {HasSubstr("in cycle 5; ")}},
       {ecam_rows("0,0\n100,-50\n200,-100\n", "# min_position: -100\n"),
        {HasSubstr("goes on by -100 pulses each cycle and passes min_position -100 in cycle 2; ")}}});
  EXPECT_THAT(ecams::findings(ecam_rows(steps, "# min_position: 0\n")), IsEmpty()) << "it goes the other way";
  EXPECT_THAT(ecams::findings(ecam_rows(steps, "# max_position: 100\n# cyclic: 0\n")), IsEmpty());
}

TEST(EcamFindings, Remarks) {
  ecams::expect_findings(
      {{ecam_rows("100,0\n200,50\n"),
        {"remark: the cycle begins at master 100; the cam runs from there [cam.remark]",
         "remark: the slave goes on by 50 pulses each cycle [cam.remark]"},
        {},
        true},
       {ecams::table(ecams::rotary()),
        {"remark: synchronous zone: master 0 to 199.8 [cam.remark]",
         "remark: the slave goes on by 1000 pulses each cycle [cam.remark]",
         "remark: samples are of the laws; the device plays 199 straight pieces, ratio 1.75 at most, never "
         "more than 0.5 pulses from them [cam.remark]"},
        {},
        true}});
}

// Samples.

TEST(EcamSamples, StraightPiecesAndTheirCycles) {
  const auto run = run_ecam(ecam_rows("100,10\n200,60\n300,60\n"), {}, 2);
  const auto at = sample_cam_at(run, {500, 100, 150, 200, 250, 300, 350});
  std::vector<std::vector<double>> told;
  for (const auto& p : at) told.push_back({p.master, p.position, p.velocity, static_cast<double>(p.row)});
  using V = std::vector<double>;
  EXPECT_THAT(told, ElementsAre(V{100, 10, 0.5, 1}, V{150, 35, 0.5, 1}, V{200, 60, 0, 2}, V{250, 60, 0, 2},
                                V{300, 60, 0.5, 1}, V{350, 85, 0.5, 1}, V{500, 110, 0, 2}));
  EXPECT_DOUBLE_EQ(run.master_total(), 400);
  EXPECT_DOUBLE_EQ(run.slave_total(), 100);
}

TEST(EcamSamples, AThousandPointsAndEveryBoundary) {
  const auto run = run_ecam(ecams::table(ecams::rotary()), {}, 1);
  const auto points = sample_cam(run);
  EXPECT_GE(points.size(), 1000U);
  EXPECT_LE(points.size(), 1010U);
  EXPECT_EQ(points.front().master, 0);
  EXPECT_NEAR(points.back().master, 3183, 1e-9);
  EXPECT_NEAR(points.back().position, 1000, 1e-9);
  for (const auto& piece : run.law.pieces)
    EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                            [&](const CamPoint& p) { return p.master == piece.master; }));
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GE(points[i].master, points[i - 1].master);
}

TEST(EcamSamples, BeforeAndAfterAStepOfTheRatio) {
  const auto points = sample_cam(run_ecam(ecam_rows("0,0\n100,100\n200,300\n"), {}, 1));
  std::vector<double> ratios;
  for (const auto& p : points)
    if (p.master == 100) ratios.push_back(p.velocity);
  EXPECT_THAT(ratios, ElementsAre(1, 2));
}

TEST(EcamSamples, TheLawIsTheLimitOfItsRows) {
  const auto table = ecams::table(ecams::rotary());
  const auto run = run_ecam(table, {}, 1);
  for (const auto& row : table.rows) {
    const auto point = sample_cam_at(run, {static_cast<double>(row.master)}).at(0);
    EXPECT_NEAR(point.position, row.slave, 0.5 + 1e-6);
  }
}

TEST(EcamReport, TellsThePiecesAndTheTotals) {
  const auto table = ecams::table(ecams::s_curve());
  const auto text = cams::study(table).text;
  EXPECT_EQ(text.heading,
            "cam.csv: LX3VP, 200 rows made by ECAMTBX K0 (S-curve, cosine), not cyclic\n"
            "master is the time axis K1: 10000 counts/s, output at 200000 Hz at most\n");
  EXPECT_THAT(text.tables.at(0).second.text(),
              HasSubstr("1    1000    2500      0     5  0.00785398   0.1   50000  ramp, cosine\n"));
  EXPECT_EQ(text.totals, "master total 3000 counts, slave total 10000 pulses, 0.3 s\n");
}

TEST(EcamPlot, DrawsTheLawAndWhatIsPlayed) {
  const auto table = ecams::table(ecams::rotary());
  const auto plot = cams::study(table, {.duty = {}, .loops = 2}).plot;
  ASSERT_EQ(plot.panels.size(), 4U);
  EXPECT_EQ(plot.panels[1].curves.size(), 2U);
  EXPECT_EQ(plot.marks.size(), 8U);
  const auto given = ecam_rows("0,0\n100,50\n");
  EXPECT_EQ(cams::study(given).plot.panels.size(), 2U);
  const auto failed = ecams::table(ecams::rotary("1"));
  EXPECT_THAT(cams::study(failed).plot.panels, IsEmpty());
}

}  // namespace
}  // namespace drycut::sim::cams
