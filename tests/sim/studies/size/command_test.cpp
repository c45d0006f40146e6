// drycut size on the shipped knife under its three controllers: what fits and why not, what goes along with a
// gear, corners, wrong input.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "sim/cli/size_command.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/studies/compare/recorded_csv.hpp"
#include "sim/studies/size/study.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using SizeRow = std::map<std::string, std::string>;

double number(const SizeRow& row, const std::string& column) {
  const auto found = row.find(column);
  EXPECT_NE(found, row.end()) << column;
  return found == row.end() ? NAN : studies::number_of(found->second).value_or(NAN);
}

struct SizeCommand : CommandTest {
  SizeCommand() {
    // 8 s of the knife under an LX3VP: pulses drive the servo, its encoder is not counted.
    folder.file("pulses.yaml",
                "extends: " + shipped("rotary_knife_lx3vp.yaml") + "\nscene: {duration: 8 s}\n");
    // The same under a CAMMING4, which counts the motor's encoder: 2048 lines behind gear 5.
    folder.file("counted.yaml", "extends: " + shipped("rotary_knife.yaml") + "\nscene: {duration: 6 s}\n");
    options.scenario = folder / "pulses.yaml";
    options.out = folder / "out";
    options.motors = "HG-SR202";
    options.jobs = 2;
  }
  static std::string shipped(const std::string& name) { return (source_root / "scenes" / name).string(); }
  static std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  int run() {
    return captured([&] { return size_drive(options); });
  }
  /// size.csv, a map from the heading a row.
  std::vector<SizeRow> rows() const {
    Problems problems;
    cams::TableProblems broken("size.csv", problems);
    const auto text = text_of(options.out / "size.csv");
    studies::CsvRows lines(text, broken);
    studies::CsvRow heading;
    studies::CsvRow line;
    std::vector<SizeRow> found;
    EXPECT_TRUE(lines.next(heading));
    while (lines.next(line)) {
      EXPECT_EQ(line.cells.size(), heading.cells.size());
      auto& row = found.emplace_back();
      for (std::size_t i = 0; i < std::min(line.cells.size(), heading.cells.size()); ++i)
        row[heading.cells[i].text] = line.cells[i].text;
    }
    EXPECT_EQ(lines_of(problems), "");
    return found;
  }
  /// The row of a motor and a gear.
  SizeRow row(const std::string& motor, const std::string& gear) const {
    for (auto& found : rows())
      if (found["motor"] == motor && found["gear ratio"] == gear) return found;
    ADD_FAILURE() << motor << ", gear " << gear;
    return {};
  }

  TestFolder folder;
  SizeOptions options;
};

TEST_F(SizeCommand, RanksWhatFitsAndSaysWhyTheOthersFallOut) {
  options.motors = "HG-SR52,HG-SR202,HG-SR352";
  options.gears = "3,5,8";
  ASSERT_EQ(run(), all_passed) << err;
  const auto all = rows();
  ASSERT_EQ(all.size(), 9U);
  double power = 0;
  bool good = true;
  for (const auto& one : all) {
    const auto& verdict = one.at("verdict");
    const bool fits = verdict == "fits";
    EXPECT_TRUE(good || !fits) << "what fits with good reserve comes first";
    if (fits != good) power = 0;
    good = fits;
    if (fits) {
      EXPECT_GE(number(one, "rated power [kW]"), power);
      power = number(one, "rated power [kW]");
      EXPECT_GE(number(one, "reserve [%]"), studies::good_reserve);
      EXPECT_EQ(one.at("reason"), "");
      // The reserve is the least distance to a rating.
      EXPECT_LE(number(one, "reserve [%]"), 100 - number(one, "rms torque [% of its rating]") + 1e-6);
      EXPECT_LE(number(one, "reserve [%]"), 100 - number(one, "peak torque [% of its rating]") + 1e-6);
    }
    if (verdict == "falls out") {
      EXPECT_NE(one.at("reason"), "");
      EXPECT_EQ(one.at("where"), "as the scenario is");
    }
  }
  // The small motor has a load of 0.41 / 9 kg m2 behind gear 3, 63 times its own.
  const auto small = row("HG-SR52", "3");
  EXPECT_EQ(small.at("verdict"), "falls out");
  EXPECT_NEAR(number(small, "inertia ratio"), 0.41 / 9 / 7.26e-4, 0.01);
  EXPECT_NEAR(number(row("HG-SR202", "8"), "inertia ratio"), 0.41 / 64 / 4.68e-3, 1e-4);
  EXPECT_THAT(out, AllOf(HasSubstr("  1. "), HasSubstr("of 9 candidates fit at 1 corners"),
                         HasSubstr("9 runs simulated now")));
  EXPECT_TRUE(fs::exists(options.out / "report.html"));
  EXPECT_TRUE(fs::exists(options.out / "plots/motor_1.png"));
  EXPECT_TRUE(fs::exists(options.out / "plots/over_gears.png"));
}

// The motor and gear that the scenario has run as the scenario does.
TEST_F(SizeCommand, ThePresentMotorIsThePresentMachine) {
  options.gears = "5";
  ASSERT_EQ(run(), all_passed) << err;
  Problems problems;
  const auto scene =
      scenario::read_scenario(options.scenario, {{"plants.knife.servo.model", "HG-SR202"}}, problems);
  loop::Simulation simulation(scene, problems);
  ASSERT_EQ(lines_of(problems), "");
  const auto verdict = simulation.run().drives.front();
  const auto present = row("HG-SR202", "5");
  for (const auto& figure : verdict.figures)
    if (figure.judged && figure.name == "rms torque")
      EXPECT_NEAR(number(present, "rms torque [% of its rating]"), 100 * figure.share, 1e-3);
  EXPECT_NEAR(number(present, "energy a cycle [J]"), verdict.energy, 1e-4 * verdict.energy);
  EXPECT_THAT(present.at("set"), HasSubstr("servo.inertia_ratio=3.5"));
  EXPECT_THAT(present.at("set"), Not(HasSubstr("gear_numerator")));
}

// A pulse is the same travel of the blade behind every gear: the pieces keep their length.
TEST_F(SizeCommand, TheElectronicGearGoesAlong) {
  options.gears = "4,7.5";
  ASSERT_EQ(run(), all_passed) << err;
  for (const auto& [gear, set] : std::map<std::string, std::string>{
           {"4", "gear_numerator=524288; plants.knife.servo.pulses.gear_denominator=625"},
           {"7.5", "gear_numerator=196608; plants.knife.servo.pulses.gear_denominator=125"}}) {
    const auto one = row("HG-SR202", gear);
    EXPECT_EQ(one.at("verdict"), "fits") << one.at("reason");
    EXPECT_THAT(one.at("set"), HasSubstr("plants.knife.servo.pulses." + set));
    EXPECT_THAT(one.at("set"), Not(HasSubstr("encoder.lines")));
  }
  options.gears = "7.000001";
  options.set = {"plants.knife.servo.pulses.gear_denominator=4001"};
  EXPECT_EQ(run(), check_failed) << err;
  EXPECT_EQ(rows().front().at("verdict"), "cannot be run");
  EXPECT_THAT(rows().front().at("reason"), HasSubstr("no electronic gear of whole numbers"));
}

// The program's counts of a turn of the drum stay: 4 x 2048 x 5. 10 V stay 240 m/min of the blade.
TEST_F(SizeCommand, ACountedEncoderGoesAlong) {
  options.scenario = folder / "counted.yaml";
  options.gears = "5,7,8";
  run();
  EXPECT_THAT(row("HG-SR202", "8").at("set"),
              AllOf(HasSubstr("servo.speed_at_10v=3200 rpm"), HasSubstr("encoder.lines=1280")));
  EXPECT_THAT(row("HG-SR202", "5").at("set"), AllOf(Not(HasSubstr("speed_at_10v")), Not(HasSubstr("lines"))));
  EXPECT_EQ(row("HG-SR202", "5").at("verdict"), "fits");
  const auto seven = row("HG-SR202", "7");
  EXPECT_EQ(seven.at("verdict"), "cannot be run");
  EXPECT_THAT(seven.at("reason"), AllOf(HasSubstr("(1462.86)"), HasSubstr("gear 6.9993")));
  EXPECT_THAT(out, HasSubstr("2 runs simulated now"));
  // On the drum it counts the same behind every gear.
  options.set = {"plants.knife.encoder.on_drum=true", "plants.knife.encoder.lines=10240"};
  run();
  EXPECT_THAT(row("HG-SR202", "7").at("set"), Not(HasSubstr("lines")));
}

// Under PLCopen the counts of a turn are the scenario's: tied to a variable, any gear is the same machine.
TEST_F(SizeCommand, AGearMayBeTiedToAVariable) {
  folder.file("tied.yaml", "extends: " + shipped("rotary_knife_mc_camin.yaml") + R"(
variables: {gear: 5, other: 1}
scene: {duration: 9 s}
plants: {knife: {gear: {ratio: "${gear}"}, servo: {speed_at_10v: "${gear} * 400 rpm"}}}
controller: {plcopen: {axes: {Knife: {path: [360 deg, "8192 * ${gear}"]}}}}
checks:
  - {name: cut length, each: cut, from: 4 s, at_least: 4, expect: abs(length - 800) <= 0.2}
)");
  options.scenario = folder / "tied.yaml";
  options.gears = "variables.gear=4.5,7";
  ASSERT_EQ(run(), all_passed) << err;
  for (const auto* gear : {"4.5", "7"}) {
    const auto one = row("HG-SR202", gear);
    EXPECT_EQ(one.at("verdict"), "fits") << one.at("reason");
    EXPECT_THAT(one.at("set"), AllOf(HasSubstr("variables.gear=" + std::string(gear)),
                                     Not(HasSubstr("speed_at_10v")), Not(HasSubstr("lines"))));
    EXPECT_NEAR(number(one, "inertia ratio"), 0.41 / std::pow(std::stod(gear), 2) / 4.68e-3, 1e-3);
  }
  options.gears = "variables.other=1,2";
  EXPECT_EQ(run(), bad_input);
  EXPECT_THAT(err, HasSubstr("--gears:1:1: variables.other does not change plants.knife.gear.ratio"));
}

TEST_F(SizeCommand, CornersAreThoseOfAnEnvelope) {
  folder.file(
      "envelope.csv",
      "variables.length [mm],plants.web.wheel.distance [mm],verdict,limit,holds from [mm],holds again at "
      "[mm],knife.cut number\n800,600,found,x,600,,4\n1000,650,throughout,,600,,4\n500,,nowhere,x,,,\n");
  options.corners = folder / "envelope.csv";
  options.motors = "HG-SR52,HG-SR202";
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("at 2 corners"));
  const auto by_file = text_of(options.out / "size.csv");
  options.corners.clear();
  options.at = {"variables.length=800 mm, plants.web.wheel.distance=600 mm",
                "variables.length=1000 mm,plants.web.wheel.distance=650 mm"};
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_EQ(text_of(options.out / "size.csv"), by_file);
  EXPECT_THAT(out, HasSubstr("\n0 runs simulated now"));
  EXPECT_THAT(by_file, HasSubstr("\"length=1000 mm, web.wheel.distance=650 mm\""));
  // A corner twice is one.
  options.corners = folder / "envelope.csv";
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("at 2 corners"));
}

TEST_F(SizeCommand, ACornerThatFailsIsNamed) {
  options.at = {"variables.length=800 mm", "variables.length=801 mm,checks.1.expect=abs(length - 800) <= 0.2",
                "variables.length=802 mm,checks.1.expect=abs(length - 800) <= 0.2"};
  EXPECT_EQ(run(), check_failed) << err;
  const auto one = rows().front();
  EXPECT_EQ(one.at("verdict"), "falls out");
  EXPECT_EQ(one.at("reason"), "cut length");
  EXPECT_THAT(one.at("where"), AllOf(HasSubstr("length=801 mm"), HasSubstr(" and 1 more")));
}

TEST_F(SizeCommand, BrakeResistors) {
  // So small a capacitor that braking lifts the bus.
  options.set = {"plants.knife.servo.supply.capacitance=100 uF", "plants.knife.drum_inertia=1 kg m2"};
  options.resistors = "20 W, none, 6.5 ohm 1 kW";
  run();
  ASSERT_EQ(rows().size(), 3U);
  std::map<std::string, SizeRow> by;
  for (auto& one : rows()) by[one["brake resistor"]] = one;
  ASSERT_THAT(by, testing::SizeIs(3));
  EXPECT_THAT(by.at("none").at("set"), HasSubstr("servo.supply.resistor=0 ohm"));
  EXPECT_THAT(by.at("20 W").at("set"), AllOf(HasSubstr("resistor_power=20 W"), Not(HasSubstr(" ohm"))));
  EXPECT_THAT(by.at("6.5 ohm 1 kW").at("set"),
              AllOf(HasSubstr("resistor=6.5 ohm"), HasSubstr("resistor_power=1000 W")));
  EXPECT_EQ(by.at("none").at("verdict"), "falls out");
  EXPECT_THAT(by.at("none").at("reason"), AllOf(HasSubstr("the drive trips"), HasSubstr("bus voltage")));
  // The braking power is the machine's, not the resistor's.
  const auto watts = [&](const char* name, double bears) {
    return number(by.at(name), "brake resistor [% of its rating]") / 100 * bears;
  };
  EXPECT_NEAR(watts("20 W", 20), watts("6.5 ohm 1 kW", 1000), 0.05 * watts("20 W", 20));
}

TEST_F(SizeCommand, SameBytesForAnyJobsAndNothingTwice) {
  options.motors = "HG-SR1*,HG-SR202";
  options.gears = "5,6";
  options.jobs = 1;
  ASSERT_EQ(run(), all_passed) << err;
  const auto alone = text_of(options.out / "size.csv");
  EXPECT_EQ(rows().size(), 6U);
  ASSERT_EQ(run(), all_passed);
  EXPECT_THAT(out, HasSubstr("\n0 runs simulated now"));
  options.jobs = 2;
  options.out = folder / "parallel";
  ASSERT_EQ(run(), all_passed);
  EXPECT_EQ(text_of(options.out / "size.csv"), alone);
  EXPECT_EQ(text_of(options.out / "report.html"), text_of(folder / "out/report.html"));
}

// What was kept of a run that was killed is not run again.
TEST_F(SizeCommand, GoesOnWhereItWasCutShort) {
  options.gears = "4,5,6";
  ASSERT_EQ(run(), all_passed) << err;
  const auto whole = text_of(options.out / "size.csv");
  const auto cache = text_of(options.out / "points.cache");
  fs::remove(options.out / "size.csv");
  std::ofstream(options.out / "points.cache", std::ios::binary) << cache.substr(0, cache.find('\n') + 30);
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("\n2 runs simulated now"));
  EXPECT_EQ(text_of(options.out / "size.csv"), whole);
}

TEST_F(SizeCommand, BadInputIsToldBeforeAnythingRuns) {
  folder.file("two.yaml", "plants:\n  a: {type: linear_axis}\n  b: {type: linear_axis, place: {x: 2 m}}\n");
  folder.file("one.yaml", "plants:\n  a: {type: linear_axis}\n");
  folder.file("web.yaml", "plants:\n  web: {type: web}\n");
  folder.file(
      "own.yaml",
      "plants:\n  web: {type: web}\n  knife:\n    type: rotary_knife\n    servo: {rated_torque: 9 N m}\n");
  folder.file("inverter.yaml", "plants:\n  a: {type: linear_axis, drive: inverter}\ndrives: {cycle: 1 s}\n");
  folder.file("contactors.yaml",
              "plants:\n  a: {type: linear_axis, drive: contactors}\ndrives: {cycle: 1 s}\n");
  folder.file("no.csv", "a,b\n1,2\n");
  folder.file("nowhere.csv", "variables.length [mm],verdict,limit,holds from [mm]\n500,nowhere,x,\n");
  folder.file("torn.csv",
              "variables.length [mm],verdict,limit,holds from [mm]\n500,found,x,1,2\n,found,x,1\n");
  folder.file("unknown.csv", "variables.lengt [mm],verdict,limit,holds from [mm]\n500,found,x,1\n");
  struct Case {
    const char* told;
    std::function<void(SizeOptions&)> change;
  };
  const auto file = [&](const char* name) { return folder / name; };
  const auto shared = shipped("shared_drive.yaml");
  const std::vector<Case> cases = {
      {"--motors:1:1: there is no motor 'HG-SR203' for knife.servo; did you mean HG-SR",
       [](auto& o) { o.motors = "HG-SR203"; }},
      {"--motors:1:10: there is no motor 'Z*' for knife.servo; all, NAME or a pattern",
       [](auto& o) { o.motors = "HG-SR202,Z*"; }},
      {"--motors:1:10: a motor without a name", [](auto& o) { o.motors = "HG-SR202,"; }},
      {"--motors:1:1: there is no motor 'Sg180L-4'", [](auto& o) { o.motors = "Sg180L-4"; }},
      {"--gears:1:1: plants.knife.gear.ratio", [](auto& o) { o.gears = "0..0.001:3"; }},
      {"--gears:1:1: 'abc' is no gear ratio", [](auto& o) { o.gears = "5,abc"; }},
      {"--gears:1:1: plants.knife.gear.ratio", [](auto& o) { o.gears = "5,7 mm"; }},
      {"does not say how many values", [](auto& o) { o.gears = "5..7"; }},
      {"--gears:1:6: 1 values from end to end", [](auto& o) { o.gears = "5..7:1"; }},
      {"variables.ger: there is no 'ger' in variables", [](auto& o) { o.gears = "variables.ger=5,7"; }},
      {"--resistors:1:7: 'warm' is no brake resistor", [](auto& o) { o.resistors = "100 W,warm"; }},
      {"--resistors:1:1: '5 ohm' is no brake resistor", [](auto& o) { o.resistors = "5 ohm"; }},
      {"--resistors:1:1: '5 m' is no brake resistor", [](auto& o) { o.resistors = "5 m"; }},
      {"--resistors:1:1: '-5 W' is no brake resistor", [](auto& o) { o.resistors = "-5 W"; }},
      {"--resistors:1:1: '100' is no brake resistor", [](auto& o) { o.resistors = "100"; }},
      {"resistor_power", [](auto& o) { o.resistors = "1e9 W"; }},
      {"--at:1:1: 'length' is no PATH=VALUE", [](auto& o) { o.at = {"length"}; }},
      {"--at:1:25: variables.length is given twice",
       [](auto& o) { o.at = {"variables.length=800 mm,variables.length=1 m"}; }},
      {"--at:1:1: lengt=800 mm: there is no 'lengt' in variables",
       [](auto& o) { o.at = {"variables.lengt=800 mm"}; }},
      {"--at:1:1: plants.knife.servo.model is what is sized",
       [](auto& o) { o.at = {"plants.knife.servo.model=HG-SR52"}; }},
      {"--at:1:1: plants.knife.gear.ratio is what is sized",
       [](auto& o) {
         o.gears = "5,7";
         o.at = {"plants.knife.gear.ratio=5"};
       }},
      {"no.csv:1:1: this is no envelope.csv", [&](auto& o) { o.corners = file("no.csv"); }},
      {"nowhere.csv:1:1: at none of its points everything holds",
       [&](auto& o) { o.corners = file("nowhere.csv"); }},
      {"torn.csv:2:1: 5 cells, where the heading has 4", [&](auto& o) { o.corners = file("torn.csv"); }},
      {"torn.csv:3:1: variables.length has no value", [&](auto& o) { o.corners = file("torn.csv"); }},
      {"unknown.csv:1:1: lengt=500 mm: there is no 'lengt'",
       [&](auto& o) { o.corners = file("unknown.csv"); }},
      {"gone.csv", [&](auto& o) { o.corners = file("gone.csv"); }},
      {"--drive:1:1: there is no drive 'knif.servo'; did you mean knife.servo?",
       [](auto& o) { o.drive = "knif.servo"; }},
      {"--drive:1:1: the scenario has 2 drives; name one: a.servo, b.servo",
       [&](auto& o) { o.scenario = file("two.yaml"); }},
      {"--drive:1:1: nothing says what a.servo must bear for ever",
       [&](auto& o) { o.scenario = file("one.yaml"); }},
      {"--drive:1:1: no drive of the scenario has a motor of the catalogue; plants of type",
       [&](auto& o) { o.scenario = file("web.yaml"); }},
      {"own.yaml:5:27: plants.knife.servo.rated_torque is given: every motor that is tried would keep it",
       [&](auto& o) { o.scenario = file("own.yaml"); }},
      {"--drive:1:1: gauge.servo drives the motor of lift by turns", [&](auto& o) { o.scenario = shared; }},
      {"--gears:1:1: the speeds of a.drive are its frequencies",
       [&](auto& o) {
         o.scenario = file("inverter.yaml");
         o.motors = "all";
         o.gears = "5,7";
       }},
      {"--resistors:1:1: a.drive has no DC link",
       [&](auto& o) {
         o.scenario = file("contactors.yaml");
         o.motors = "all";
         o.resistors = "100 W";
       }},
      {"gone.yaml", [&](auto& o) { o.scenario = file("gone.yaml"); }},
      {"--set", [](auto& o) { o.set = {"nonsense"}; }},
  };
  const auto plain = options;
  for (const auto& [told, change] : cases) {
    options = plain;
    change(options);
    EXPECT_EQ(run(), bad_input) << told;
    EXPECT_THAT(err, HasSubstr(told));
    EXPECT_FALSE(fs::exists(options.out)) << told;
  }
  // All of them at once.
  options = plain;
  options.motors = "HG-SR203";
  options.resistors = "warm";
  options.at = {"length"};
  EXPECT_EQ(run(), bad_input);
  EXPECT_THAT(err, AllOf(HasSubstr("--motors"), HasSubstr("--resistors"), HasSubstr("--at")));
}

// An induction motor behind an inverter is sized as well.
TEST_F(SizeCommand, TheMotorOfAnInverter) {
  folder.file(
      "axis.yaml",
      "scene: {duration: 1 s}\nplants:\n  a: {type: linear_axis, drive: inverter}\ndrives: {cycle: 0.2 s}\n");
  options.scenario = folder / "axis.yaml";
  options.motors = "IEC-4P-1*";
  options.set = {"plants.a.inverter.torque_limit=20 N m"};
  options.resistors = "100,200 W";
  EXPECT_EQ(run(), all_passed) << err;
  EXPECT_EQ(rows().size(), 4U);
  EXPECT_EQ(rows().front().at("motor"), "IEC-4P-1.1kW");
  EXPECT_EQ(rows().front().at("brake resistor"), "100 W");
  EXPECT_THAT(rows().front().at("set"), HasSubstr("plants.a.inverter.supply.resistor_power=100 W"));
}

}  // namespace
}  // namespace drycut::sim::cli

namespace drycut::sim::studies {
namespace {

Candidate motor(const std::string& name, double power, double resistor = 0) {
  Candidate made;
  made.motor = name;
  made.rated_power = power;
  made.resistor_power = resistor;
  return made;
}
Sized result(Sized::Kind kind, double reserve, double energy = 1) {
  Sized made;
  made.kind = kind;
  made.reserve = reserve;
  made.energy = energy;
  return made;
}

TEST(SizeRanking, IsTheOrderThatIsStated) {
  using Kind = Sized::Kind;
  const std::vector<Candidate> candidates = {
      motor("cannot", 1),    motor("far", 1),         motor("near", 9),
      motor("close", 1),     motor("large", 3),       motor("small", 2, 100),
      motor("less", 2, 100), motor("hungry", 2, 100), motor("warm", 2, 200)};
  const std::vector<Sized> sized = {
      result(Kind::cannot, NAN, NAN), result(Kind::falls_out, -50), result(Kind::falls_out, -5),
      result(Kind::close, 9),         result(Kind::fits, 80),       result(Kind::fits, 30),
      result(Kind::fits, 20),         result(Kind::fits, 30, 2),    result(Kind::fits, 90)};
  std::vector<std::string> names;
  for (const auto i : ranked(candidates, sized)) names.push_back(candidates[i].motor);
  EXPECT_THAT(names, testing::ElementsAre("small", "hungry", "less", "warm", "large", "close", "near", "far",
                                          "cannot"));
}

// A row has every figure that the judge judges, and gives it back.
TEST(RatedDrive, GoesThereAndBack) {
  loop::DriveVerdict verdict;
  for (const auto& [name, unit] : ratings)
    verdict.figures.push_back({std::string(name), 2, 4, std::string(unit), 0.5});
  verdict.figures[0].judged = false;
  verdict.figures[1].value = 3;
  verdict.inertia_ratio = 3.5;
  verdict.energy = 7;
  verdict.trips = {"overload at 1 s"};
  verdict.cycle_points = {{10, 1}, {11, 5}, {12, 2}};
  verdict.points = {{0, 1}, {0, -2}, {24, 5}, {12, 3}, {12, 4}};
  const auto numbers = rated_numbers(verdict);
  EXPECT_EQ(numbers.size(), rated_columns("knife.servo").size());
  auto row = std::vector<double>{1, 2, 3};
  row.insert(row.end(), numbers.begin(), numbers.end());
  const auto drive = rated_drive(row);
  EXPECT_TRUE(std::isnan(drive.figures[0].share));
  EXPECT_EQ(drive.figures[1].value, 3);
  EXPECT_EQ(drive.figures[1].share, 0.5);
  EXPECT_EQ(drive.inertia_ratio, 3.5);
  EXPECT_EQ(drive.energy, 7);
  EXPECT_EQ(drive.trips, 1);
  EXPECT_EQ(drive.cycles, 3);
  EXPECT_EQ(drive.rms, (std::pair<double, double>(11, 5)));
  EXPECT_EQ(drive.outline[0], (std::pair<double, double>(0, 1)));
  EXPECT_EQ(drive.outline[1], (std::pair<double, double>(0, -2)));
  EXPECT_EQ(drive.outline[24], (std::pair<double, double>(12, 4)));
  EXPECT_EQ(drive.outline[25], (std::pair<double, double>(12, 3)));
  EXPECT_EQ(drive.outline[46], (std::pair<double, double>(24, 5)));
  EXPECT_TRUE(std::isnan(drive.outline[2].first));
  verdict.figures.push_back({"colour", 1, 1, "", 1});
  EXPECT_THROW(rated_numbers(verdict), std::logic_error);
}

}  // namespace
}  // namespace drycut::sim::studies
