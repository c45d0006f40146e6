// Every remedy of `drycut cam` that names a number or a direction is followed; its finding is gone.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "tests/sim/cams/bench.hpp"
#include "tests/sim/cams/camin_bench.hpp"
#include "tests/sim/cams/ecam_bench.hpp"

namespace drycut::sim::cams {
namespace {

using Findings = std::vector<CamFinding>;
using Study = std::function<Findings(const std::string& text, const CamDuty& duty)>;

Findings of_camming4(const std::string& text, const CamDuty& duty) {
  const auto table = cams::table(text);
  return judge(table, duty, run_cam(table, duty, 1));
}
Findings of_ecam(const std::string& text, const CamDuty& duty) {
  const auto table = ecams::table(text);
  return judge_ecam(table, duty, run_ecam(table, duty, 1));
}
Findings of_camin(const std::string& text, const CamDuty& duty) {
  return judge_cam_in(run_cam_in(camin::table(text), duty, 1), duty);
}

const CamFinding* find(const Findings& findings, const std::string& words) {
  for (const auto& finding : findings)
    if (to_string(finding).find(words) != std::string::npos) return &finding;
  return nullptr;
}

std::string told(const Findings& findings) { return findings_text(findings); }

/// A table that raises a finding, and where its cure goes.
struct CureCase {
  std::string name;
  Study study;
  std::string words;      ///< of the finding
  std::string text;       ///< the table, with {} for the parameter to cure
  std::string parameter;  ///< of the cure
  double before = 0;      ///< its value that raises the finding
  CamDuty duty = {};
  double grain = 1;  ///< the cure is the tightest: this much before it the finding is there; 0 = not so
  /// Of a stroke and its begin, instead of the text.
  std::function<std::string(double stroke, double begin)> write = {};
  CureCase at(const CamDuty& given) const {
    auto one = *this;
    one.duty = given;
    return one;
  }
  CureCase within(double given) const {
    auto one = *this;
    one.grain = given;
    return one;
  }
  CureCase written(std::function<std::string(double, double)> given) const {
    auto one = *this;
    one.write = std::move(given);
    return one;
  }
  std::string put(double value, double begin) const {
    if (write) return write(value, begin);
    auto full = text;
    const auto place = full.find("{}");
    // Enough digits for a limit that is just met.
    if (place != std::string::npos) full.replace(place, 2, fmt::format("{:.12g}", value));
    return full;
  }
};
void PrintTo(const CureCase& one, std::ostream* out) { *out << one.name; }
CureCase cure(std::string name, Study study, std::string words, std::string text, std::string parameter,
              double before) {
  return {std::move(name), std::move(study), std::move(words), std::move(text), std::move(parameter), before};
}

std::string camming4_rows(const std::string& text, const std::string& settings = "") {
  return settings + cams::header + text;
}
std::string saw(const std::string& type, const std::string& list) {
  return "# ecamtbx: " + type + "\nparameter,value\n" + list;
}
const std::string poly5_line = "# interpolation: POLY5_LINE\n# endless: positive\n";

/// A rise of POLYNOM_3, which goes beyond its rows by 2/27 of their rise on both sides.
std::string rounded_rows(double stroke, double begin) {
  const double rise = stroke * 27 / 31;
  std::string text = "# interpolation: POLYNOM_3\n# slave_modulo: 0\n# minpos: 0\n# maxpos: 1000000\nslave\n";
  for (const double row : {0.0, 0.0, 0.0, rise, rise, rise}) text += fmt::format("{:.12g}\n", begin + row);
  return text;
}

std::vector<CureCase> cases() {
  const std::string master = "master speed";
  const std::string out = "1,131,100,50\n";
  const std::string stop = "3,135,100,50\n4,136\n";
  return {
      cure("Error4NoSpace", of_camming4, "error 4: ", camming4_rows("1,133,{},10\n2,136\n"), "codeQm", 0),
      cure("Error4NoSpaceAndACoarseCount", of_camming4,
           "error 4: ", camming4_rows("1,133,105,0\n2,133,{},5\n3,136\n", "# measurem: 10\n"), "codeQm", 0)
          .within(0),
      cure("Error4NoRamp", of_camming4, "error 4: ", camming4_rows("1,153,10,10,{},5\n2,136\n"), "codeQma",
           0),
      cure("Error4ACount", of_camming4,
           "error 4: ", camming4_rows("1,133,105,0\n2,133,{},0\n3,136\n", "# measurem: 10\n"), "codeQm", 4)
          .within(0),
      cure("Error4ACountOfAGearing", of_camming4, "error 4: ", camming4_rows("1,154,{},5,0,2\n"), "codeQm",
           1),
      cure("Error4ASampling", of_camming4, "error 4: ", camming4_rows("1,133,{},0\n2,136\n", "# TCamp: 5\n"),
           "codeQm", 9)
          .at({.master_speed = 2100.0}),
      cure("Error4ASamplingOfARamp", of_camming4,
           "error 4: ", camming4_rows("1,152,1,1,{},2\n2,135,100,50\n3,136\n"), "codeQma", 4)
          .at({.master_speed = 5678.0}),
      cure("Error4ASamplingOfTwoSpaces", of_camming4,
           "error 4: ", camming4_rows("1,150,{},5,4,2\n2,135,100,50\n3,136\n"), "codeQm", 5)
          .at({.master_speed = 5678.0}),
      cure("Error4TheMastersSpeed", of_camming4,
           "error 4: ", camming4_rows("1,133,7,0\n2,136\n", "# TCamp: 3\n"), master, 5678)
          .within(0.01),
      cure("Error4TheMastersSpeedInAnArc", of_camming4, "error 4: ", camming4_rows("1,171,25,3,0,4\n2,136\n"),
           master, 56780)
          .within(0.1),
      cure("Error50", of_camming4, "error 50: ", camming4_rows("1,171,{},30,0,41\n2,136\n"), "codeQm", 24),
      cure("Warning1", of_camming4, "warning 1: ",
           camming4_rows("1,132,100,50\n2,135,100,50\n3,136\n", "# maxvel: 1000\n# taccmax: 50\n"), master,
           700)
          .within(0.01),
      cure("Warning2", of_camming4, "warning 2: ",
           camming4_rows("1,132,100,50\n2,135,100,50\n3,136\n", "# maxvel: 1000\n# tdecmax: 70\n"), master,
           700)
          .within(0.01),
      cure("Warning5", of_camming4, "warning 5: ", camming4_rows("1,131,100,50\n2,133,99,{}\n" + stop),
           "codeQs", 20),
      cure("Warning5Backwards", of_camming4,
           "warning 5: ", camming4_rows("1,131,100,-50\n2,133,99,{}\n3,135,100,-50\n4,136\n"), "codeQs", -20),
      cure("Warning5BeforeAStop", of_camming4,
           "warning 5: ", camming4_rows(out + "2,151,75,{},80,20\n3,136\n"), "codeQs", 20),
      cure("Warning7", of_camming4, "warning 7: ", camming4_rows(out + "2,135,99,{}\n3,136\n"), "codeQs", 20),
      cure("Warning7OfManyDigits", of_camming4,
           "warning 7: ", camming4_rows("1,131,100,50\n2,135,999997,{}\n3,136\n"), "codeQs", 20),
      cure("Warning7Backwards", of_camming4,
           "warning 7: ", camming4_rows("1,131,100,-50\n2,234,99,{}\n3,235,100,-50\n4,136\n"), "codeQs", -40),
      cure("Warning7InBits", of_camming4, "warning 7: ",
           camming4_rows("1,152,1,1,85,{}\n2,135,100,50\n3,136\n", "# measure: 2\n"), "codeQsa", 8),
      cure("Warning7TurningFaster", of_camming4, "warning 7: ",
           camming4_rows(out + "2,153,10,-30,100,{}\n3,135,100,-200\n4,136\n"), "codeQsa", -70),
      cure("Warning10", of_camming4, "warning 10: ",
           camming4_rows("1,154,100,50,{}\n2,130\n3,154,100,100\n4,135,100,50\n5,136\n"), "codeQma", 1)
          .within(0),
      cure("Velocity", of_camming4, "limit: velocity", camming4_rows("1,231,100,60\n2,235,100,60\n3,136\n"),
           master, 111.1)
          .at({.max_velocity = 110.0})
          .within(0.1),
      cure("Maxvel", of_camming4, "above maxvel",
           camming4_rows("1,231,100,60\n2,235,100,60\n3,136\n", "# maxvel: 77\n"), master, 111.1)
          .within(0.01),
      cure("Acceleration", of_camming4, "limit: acceleration",
           camming4_rows("1,231,100,60\n2,235,100,60\n3,136\n"), master, 111.1)
          .at({.max_acceleration = 200.0})
          .within(0.1),
      cure("AccelerationOfAnArc", of_camming4, "limit: acceleration",
           camming4_rows("1,171,25,30,0,40\n2,136\n"), master, 111.1)
          .at({.max_acceleration = 200.0})
          .within(0.1),
      cure("P3OfTheSlave", of_ecam, "makes no table",
           saw("K100", "P1,3183\nP2,1000\nP3,{}\nP4,5/3\nP5,50/3\nP6,1\n"), "P3", 1001),
      cure("P3OfTheCycle", of_ecam, "makes no table",
           saw("K100", "P1,301\nP2,1000\nP3,{}\nP4,5/3\nP5,50/3\nP6,1\n"), "P3", 1001),
      cure("P3OfAFlyingSaw", of_ecam, "makes no table",
           saw("K101", "P1,1750\nP2,2000\nP3,{}\nP4,9.424778\nP5,10\nP6,1\n"), "P3", 2001),
      cure("P1OfARotarySaw", of_ecam, "makes no table",
           saw("K100", "P1,{}\nP2,2000\nP3,667\nP4,9.424778\nP5,10\nP6,1\n"), "P1", 70),
      cure("P1OfAFlyingSaw", of_ecam, "makes no table",
           saw("K101", "P1,{}\nP2,2000\nP3,667\nP4,9.424778\nP5,10\nP6,1\n"), "P1", 300),
      cure("P1OfAFlyingSawWithoutRamps", of_ecam, "makes no table",
           saw("K101", "P1,{}\nP2,2000\nP3,667\nP4,9.424778\nP5,10\nP6,0\n"), "P1", 200),
      cure("P5BelowP4", of_ecam, "makes no table",
           saw("K100", "P1,3183\nP2,1000\nP3,333\nP4,4/3\nP5,{}\nP6,1\n"), "P5", 1.2)
          .within(1e-4),
      cure("P5BelowTheCycle", of_ecam, "makes no table",
           saw("K100", "P1,200\nP2,2000\nP3,667\nP4,9.424778\nP5,{}\nP6,1\n"), "P5", 10)
          .within(1e-3),
      cure("P5BelowTheFirstCycle", of_ecam, "makes no table",
           saw("K100", "P1,1100\nP2,1700\nP3,200\nP4,1.5\nP5,{}\nP6L,1\nP6H,2\n"), "P5", 1.6)
          .within(1e-3),
      cure("RatioOfASaw", of_ecam, "limit: ratio",
           "# max_ratio: 3\n" + saw("K100", "P1,1000\nP2,2500\nP3,300\nP4,1.5\nP5,{}\nP6,1\n"), "P5", 8)
          .within(0),
      cure("RatioOfAnSCurve", of_ecam, "limit: ratio",
           "# max_ratio: 4.5\n" + saw("K0", "P1,10000\nP2,{}\nP4,100\nP5,100\nP6,200\n"), "P2", 50000)
          .within(0),
      cure("VelocityOfAnSCurve", of_ecam, "limit: velocity",
           saw("K0", "P1,10000\nP2,{}\nP4,100\nP5,100\nP6,200\n"), "P2", 50000)
          .at({.max_velocity = 40000.0})
          .within(0),
      cure("RatioOfRows", of_ecam, "limit: ratio",
           "# max_ratio: 3\nmaster,slave\n0,0\n{},6172839\n9000000,9000000\n", "length", 1000000),
      cure("MaxFrequency", of_ecam, "Hz above",
           "# max_frequency: 50000\nmaster,slave\n0,0\n100,100\n200,270\n", master, 77777)
          .within(0.1),
      cure("VelocityOfRows", of_ecam, "limit: velocity", "master,slave\n0,0\n100,100\n200,270\n", master,
           77777)
          .at({.max_velocity = 12345.0})
          .within(0.1),
      cure("AccelerationOfRows", of_ecam, "limit: acceleration", "master,slave\n0,0\n100,100\n200,270\n",
           master, 77777)
          .at({.max_acceleration = 12345.0})
          .within(0.1),
      cure("AccelerationOfASaw", of_ecam, "limit: acceleration", ecams::rotary(), master, 77777)
          .at({.max_acceleration = 12345.0})
          .within(0.1),
      cure("VelocityOfPieces", of_camin, "limit: velocity", camin::knife(), master, 600)
          .at({.max_velocity = 351.0})
          .within(0.1),
      cure("AccelerationOfPieces", of_camin, "limit: acceleration", camin::knife(), master, 600)
          .at({.max_acceleration = 511.0})
          .within(0.1),
      cure("JerkOfPieces", of_camin, "limit: jerk", camin::knife("# endless: positive\n# maxjerk: 777\n"),
           master, 900)
          .within(0.01),
      cure("OvershootOfTheFirstPiece", of_camin, "row 1 (line 4): caution: overshoots",
           "# interpolation: LINE_POLY5\n# endless: "
           "positive\nmaster,slave\n{},0\n1700000,300000\n2600000,1200000\n3000000,2400000\n",
           "master", 0),
      cure("OvershootOfAMiddlePiece", of_camin, "row 2 (line 5): caution: overshoots",
           poly5_line + "master,slave\n0,0\n{},900000\n2000000,1200000\n2600000,1500000\n", "master", 300000),
      cure("OvershootOfTheLastPiece", of_camin, "row 4 (line 7): caution: overshoots",
           poly5_line + "master,slave\n0,0\n900000,1800000\n1000000,2800000\n{},3400000\n", "master",
           1400000),
      cure("StrokeOfRoundedRows", of_camin, "does not fit the travel", "", "stroke", 1000000.0 * 31 / 27)
          .written(rounded_rows)};
}

class CamRemedies : public testing::TestWithParam<CureCase> {};

/// The table or the duty with the number put in.
Findings with(const CureCase& one, double value, double begin = 0) {
  auto duty = one.duty;
  if (one.parameter == "master speed") duty.master_speed = value;
  return one.study(one.put(value, begin), duty);
}

TEST_P(CamRemedies, ItsNumberCures) {
  const CureCase& one = GetParam();
  const auto found = with(one, one.before);
  const CamFinding* finding = find(found, one.words);
  ASSERT_NE(finding, nullptr) << told(found);
  int applied = 0;
  double begin = 0;  // that a stroke needs
  for (const auto& cure : finding->remedy.cures)
    if (one.parameter == "stroke" && cure.parameter == "begin") begin = cure.value;
  for (const auto& cure : finding->remedy.cures) {
    if (cure.parameter != one.parameter) continue;
    ++applied;
    // The words name the number; of two spaces they name the sum.
    const double other = one.name == "Error4ASamplingOfTwoSpaces" ? 4 : 0;
    EXPECT_THAT(finding->remedy.text, testing::HasSubstr(number_text(cure.value + other, 15)));
    const auto way = begin == 0 ? "" : fmt::format("begin {:.6f} ", std::abs(begin));
    EXPECT_THAT(finding->remedy.text, testing::HasSubstr(way));
    const auto cured = with(one, cure.value, begin);
    EXPECT_EQ(find(cured, one.words), nullptr) << to_string(*finding) << '\n' << told(cured);
    if (one.grain == 0) continue;
    const double towards = one.before < cure.value ? -one.grain : one.grain;
    EXPECT_NE(find(with(one, cure.value + towards, begin), one.words), nullptr) << to_string(*finding);
  }
  EXPECT_GT(applied, 0) << to_string(*finding);
}

/// A remedy without a number, followed in a table.
struct Followed {
  std::string name;
  Study study;
  std::string words;   ///< of the finding
  std::string remedy;  ///< words of it
  std::string before;
  std::vector<std::string> after;  ///< without the finding
  CamDuty duty = {};
};
void PrintTo(const Followed& one, std::ostream* out) { *out << one.name; }
Followed follow(std::string name, Study study, std::string words, std::string remedy, std::string before,
                std::vector<std::string> after, const CamDuty& duty = {}) {
  return {std::move(name),
          std::move(study),
          std::move(words),
          std::move(remedy),
          std::move(before),
          std::move(after),
          duty};
}

std::string zero_rows(int count) {
  std::string text = "1,133,100,0\n";
  for (int row = 2; row < 2 + count; ++row) text += fmt::format("{},130\n", row);
  return camming4_rows(text + fmt::format("{},136\n", 2 + count));
}

std::vector<Followed> followed() {
  const auto s_curve = [](const char* P4, const char* P5) {
    return saw("K0", fmt::format("P1,3000\nP2,50000\nP4,{}\nP5,{}\nP6,200\n", P4, P5));
  };
  const auto ratio = [](int codeQma, int codeQsa) {
    return camming4_rows(fmt::format("1,154,100,0,{},{}\n2,136\n", codeQma, codeQsa));
  };
  const auto jump = [](int row) { return camming4_rows(fmt::format("1,133,100,0\n2,137,{}\n", row)); };
  const auto grows = [](const char* update) {
    return camming4_rows(std::string("1,131,100,50\n2,135,100,50\n3,139,") + update + "\n4,137,1\n");
  };
  return {follow("NineRows", of_camming4, "error 1: ", "at most 9 such rows", zero_rows(9), {zero_rows(8)}),
          follow("SevenRows", of_camming4, "without master space in sequence", "allow 7", zero_rows(7),
                 {zero_rows(6)}),
          follow("JumpRows", of_camming4, "error 6: ", "from 1 to 128", jump(129), {jump(1)}),
          follow("Softening", of_camming4, "softens nothing", "0 for none or 1 to 4", ratio(5, 0),
                 {ratio(0, 0), ratio(1, 0), ratio(2, 0), ratio(3, 0), ratio(4, 0)}),
          follow("KindOfChange", of_camming4, "acts as 0", "0 movement follows, 1", ratio(0, 3),
                 {ratio(0, 0), ratio(0, 1), ratio(0, 2)}),
          follow("CountsGrow", of_camming4, "positm grows by 50", "take it off before the jump (139)",
                 grows("150,100"), {grows("200,100")}),
          follow("StartQuota", of_camming4, "warning 9: ", "above the master's count",
                 camming4_rows("1,140,500\n2,160,250\n3,133,10,0\n4,136\n"),
                 {camming4_rows("1,140,500\n2,160,501\n3,133,10,0\n4,136\n")}),
          follow("FinerMaster", of_camming4, "1.5 is the most",
                 "a finer transducer on the master or a coarser one on the slave",
                 camming4_rows("1,131,100,50\n2,135,100,50\n3,136\n", "# pulse: 2\n"),
                 {camming4_rows("1,131,100,50\n2,135,100,50\n3,136\n", "# pulse: 2\n# pulsem: 2\n"),
                  camming4_rows("1,131,100,50\n2,135,100,50\n3,136\n")}),
          follow("Begin", of_camming4, "does not fit the travel", "begin 1 Um further back",
                 camming4_rows("1,132,100,50\n2,135,200,100\n3,136\n", "# minpos: -9\n# maxpos: 149\n"),
                 {camming4_rows("1,132,100,50\n2,135,200,100\n3,136\n", "# minpos: -8\n# maxpos: 150\n")}),
          follow("LessTime", of_ecam, "reaches 30000 Hz", "give P4 and P5 less time", s_curve("100", "100"),
                 {s_curve("60", "60")}),
          follow("SomeTimeToStart", of_ecam, "as the cam starts", "give P4 some time", s_curve("0", "50"),
                 {s_curve("10", "50")}),
          follow("SomeTimeToEnd", of_ecam, "at the end of the cam", "give P5 some time", s_curve("50", "0"),
                 {s_curve("50", "10")}),
          follow("MoreTimeForRamps", of_ecam, "limit: acceleration", "give its ramps more time",
                 s_curve("20", "20"), {s_curve("40", "40")}, {.max_acceleration = 2.5e6}),
          follow("Ramps", of_ecam, "the ratio jumps", "give P6L 1 or 2", ecams::rotary("50/3", "0"),
                 {ecams::rotary("50/3", "1"), ecams::rotary("50/3", "2")}),
          follow("WayForRamps", of_ecam, "the ratio jumps", "give P3 less than P2",
                 ecams::rotary("50/3", "1", "1000"), {ecams::rotary("50/3", "1", "900")}),
          follow("LessSteepRows", of_camin, "overshoots", "rise and fall less, or take LINEAR",
                 "# interpolation: POLYNOM_3\nslave\n0\n0\n160000\n320000\n",
                 {"# interpolation: POLYNOM_3\nslave\n0\n0\n0\n0\n",
                  "# interpolation: LINEAR\nslave\n0\n0\n160000\n320000\n"})};
}

class CamRemediesInWords : public testing::TestWithParam<Followed> {};

TEST_P(CamRemediesInWords, Cure) {
  const Followed& one = GetParam();
  const auto found = one.study(one.before, one.duty);
  const CamFinding* finding = find(found, one.words);
  ASSERT_NE(finding, nullptr) << told(found);
  EXPECT_THAT(finding->remedy.text, testing::HasSubstr(one.remedy));
  for (const auto& text : one.after) {
    const auto cured = one.study(text, one.duty);
    EXPECT_EQ(find(cured, one.words), nullptr) << text << told(cured);
  }
}

/// The number behind some words of a finding.
double number_behind(const Findings& findings, const std::string& words) {
  const CamFinding* finding = find(findings, words);
  if (finding == nullptr) return 0;
  const auto text = to_string(*finding);
  return std::stod(text.substr(text.find(words) + words.size()));
}

TEST(CamRemediesOfOneKind, LessOfTheMasterOrLessSteepLinesLowerAnOvershoot) {
  const auto overshoot = [](double begin, double rise, std::string* remedy = nullptr) {
    // A dwell at the top between two lines: it overshoots at any length, so that no number cures it.
    const auto found = of_camin(fmt::format("# interpolation: POLY5_LINE\nmaster,slave\n0,{}\n{},1000000\n"
                                            "1800000,1000000\n3500000,500000\n",
                                            1000000 - rise, begin),
                                {});
    if (remedy != nullptr) *remedy = find(found, "row 2 (line 4): caution: overshoots")->remedy.text;
    return number_behind(found, "row 2 (line 4): caution: overshoots its two rows by ");
  };
  std::string remedy;
  double last = overshoot(900000, 500000, &remedy);
  EXPECT_EQ(remedy, "make the lines before and after it less steep");
  for (const double begin : {1000000.0, 1200000.0, 1500000.0}) {
    const double now = overshoot(begin, 500000);
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_LT(overshoot(900000, 300000), overshoot(900000, 500000));
}

TEST(CamRemediesOfOneKind, MoreMasterAndSlaveSpaceAlikeLowerTheAcceleration) {
  const CamDuty duty{.master_speed = 100.0, .max_acceleration = 1.0};
  const auto peak = [&](const std::string& movement, int times, const char* rest) {
    auto full = movement;
    if (const auto place = full.find("S"); place != std::string::npos)
      full.replace(place, 1, std::to_string(50 * times));
    if (const auto place = full.find("M"); place != std::string::npos)
      full.replace(place, 1, std::to_string(40 * times));
    const auto found = of_camming4(
        camming4_rows("1,131,100,50\n2,135,100,50\n3,131,100,50\n4," + full + "\n5,135,100,50\n6,136\n"),
        duty);
    const CamFinding* finding = find(found, "sector 4 ");
    EXPECT_NE(finding, nullptr) << rest;
    if (finding == nullptr) return 0.0;
    EXPECT_THAT(finding->remedy.text, testing::HasSubstr("more master and slave space alike"));
    return number_behind(found, "sector 4 (" + std::string(rest) + "): limit: acceleration ");
  };
  const std::vector<std::pair<std::string, const char*>> movements = {
      {"133,M,S", "133 RSC"}, {"134,M,S", "134 RCC"}, {"135,M,S", "135 DZC"}, {"153,1,2,M,S", "153 NVSR"}};
  for (const auto& [movement, name] : movements) {
    const double once = peak(movement, 1, name);
    EXPECT_GT(once, 0) << name;
    EXPECT_NEAR(peak(movement, 2, name), once / 2, 1e-3 * once) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CamRemediesInWords, testing::ValuesIn(followed()),
                         [](const auto& given) { return given.param.name; });
INSTANTIATE_TEST_SUITE_P(All, CamRemedies, testing::ValuesIn(cases()),
                         [](const auto& given) { return given.param.name; });

}  // namespace
}  // namespace drycut::sim::cams
