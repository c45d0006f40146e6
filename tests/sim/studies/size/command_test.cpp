// drycut size on the shipped knife under its three controllers: what fits and why not, what goes along with a
// gear, corners.
#include <cmath>
#include <fstream>
#include <map>

#include "sim/loop/simulation.hpp"
#include "sim/studies/size/study.hpp"
#include "tests/sim/studies/size/size_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(SizeCommand, RanksWhatFitsAndSaysWhyTheOthersDoNot) {
  options.motors = "HG-SR52,HG-SR202,HG-SR352";
  options.gears = "3,5,8";
  options.inertia_ratio = "off";
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
    if (verdict == "does not fit") {
      EXPECT_NE(one.at("reason"), "");
      EXPECT_EQ(one.at("where"), "as the scenario is");
    }
  }
  // The small motor has a load of 0.41 / 9 kg m2 behind gear 3, 63 times its own.
  const auto small = row("HG-SR52", "3");
  EXPECT_EQ(small.at("verdict"), "does not fit");
  EXPECT_NEAR(number(small, "inertia ratio"), 0.41 / 9 / 7.26e-4, 0.01);
  EXPECT_NEAR(number(row("HG-SR202", "8"), "inertia ratio"), 0.41 / 64 / 4.68e-3, 1e-4);
  EXPECT_THAT(out, AllOf(HasSubstr("  1. "), HasSubstr(" of 9 candidates fit at 1 corner; first: HG-SR"),
                         HasSubstr("runs simulated now")));
  EXPECT_TRUE(fs::exists(options.out / "report.html"));
  EXPECT_TRUE(fs::exists(options.out / "plots/motor_1.png"));
  EXPECT_TRUE(fs::exists(options.out / "plots/over_gears.png"));
}

TEST_F(SizeCommand, AnInertiaRatioRulesOut) {
  options.motors = "HG-SR52,HG-SR202";
  options.inertia_ratio = "15";
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("\n1 run simulated now"));
  EXPECT_THAT(out, Not(HasSubstr("note: load over rotor")));
  EXPECT_EQ(rows()[0].at("motor"), "HG-SR202");
  EXPECT_EQ(rows()[1].at("verdict"), "ruled out");
  EXPECT_EQ(rows()[1].at("reason"), "load over rotor inertia 22.6, at most 15 is asked for");
}

// Unasked it is what the maker says, else 10: a small motor that a stiff machine would be content with is not
// the first choice.
TEST_F(SizeCommand, WithoutAnInertiaRatioTheMakersIsTakenElseTheUsual) {
  options.motors = "HG-SR52,HG-SR202,HC503R";
  options.gears = "5";
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_EQ(rows()[0].at("motor"), "HG-SR202");
  const auto small = row("HG-SR52", "5");
  EXPECT_EQ(small.at("verdict"), "ruled out");
  EXPECT_EQ(small.at("reason"),
            "load over rotor inertia 22.6, at most 10 is usual, and the catalogue has no value of its maker");
  EXPECT_EQ(number(small, "inertia ratio at most"), 10);
  const auto meldas = row("HC503R", "5");
  EXPECT_EQ(meldas.at("reason"), "load over rotor inertia 13.7, at most 5 is what its maker allows");
  EXPECT_THAT(out,
              HasSubstr("\nnote: load over rotor inertia: at most what the maker allows; 10, as usual, for 2 "
                        "of 3 motors, of which the catalogue has no such value; 2 candidates beyond it; "
                        "--inertia-ratio 15 sets another limit, off none [size.inertia-limit]\n"));
  options.inertia_ratio = "off";
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_EQ(rows()[0].at("motor"), "HG-SR52");
  for (const auto& one : rows()) {
    EXPECT_NE(one.at("verdict"), "ruled out");
    EXPECT_EQ(one.at("inertia ratio at most"), "");
  }
}

// A motor that is so weak that the line stops: nothing of the corner at which it ran is shown as if it were
// of all, and what the other one needs is found with a motor without limits.
TEST_F(SizeCommand, FiguresAreEmptyWhereARunEndedEarly) {
  options.motors = "HG-SR52";
  options.inertia_ratio = "off";
  options.at = {"variables.length=1200 mm", "variables.length=500 mm,plants.knife.drum_inertia=3 kg m2"};
  EXPECT_EQ(run(), check_failed) << err;
  const auto one = rows().front();
  EXPECT_EQ(one.at("verdict"), "does not fit");
  for (const auto* column : {"reserve [%]", "nearest limit", "at", "rms torque [% of its rating]",
                             "peak torque [% of its rating]", "energy a cycle [J]"})
    EXPECT_EQ(one.at(column), "") << column;
  EXPECT_THAT(one.at("reason"),
              AllOf(HasSubstr("so its continuous load is unknown"), HasSubstr("it would need ")));
  EXPECT_THAT(one.at("where"), HasSubstr("length=500 mm"));
  EXPECT_GT(number(one, "short by [%]"), 100);
  EXPECT_THAT(one.at("short at"), HasSubstr("length=500 mm"));
  EXPECT_EQ(out.find("no motor that was tried fits; nearest: HG-SR52, "), 0U) << out;
  EXPECT_THAT(out, HasSubstr(" % short of "));
  // Nor does the page offer anything as if it fitted.
  const auto page = text_of(options.out / "report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("<p class=\"verdict fail\"><strong>FAIL</strong> <span>no motor that was "
                                    "tried fits; nearest: HG-SR52, "),
                          HasSubstr("how HG-SR52, the nearest, fails"), HasSubstr("What comes nearest"),
                          Not(HasSubstr("0 FIT")), Not(HasSubstr("runs the first of them"))));
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
  for (const auto& figure : verdict.figures) {
    if (figure.name != "rms torque") continue;
    EXPECT_TRUE(figure.judged);
    EXPECT_NEAR(number(present, "rms torque [% of its rating]"), 100 * figure.share, 1e-3);
  }
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
  EXPECT_EQ(rows().front().at("verdict"), "ruled out");
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
  EXPECT_EQ(seven.at("verdict"), "ruled out");
  EXPECT_THAT(seven.at("reason"), HasSubstr("(1462.86)"));
  EXPECT_THAT(out, HasSubstr("2 runs simulated now"));
  // What to do about it is told where everybody sees it.
  EXPECT_THAT(
      out,
      HasSubstr("\nnote: gear 7 (1462.86 lines): left out, for no whole number of encoder lines gives the "
                "controller its 40960 counts a turn of the load; count an encoder on the drum, "
                "plants.knife.encoder: {on_drum: true, lines: 10240}, whose one zero pulse a turn may need "
                "another preset of homing; "
                "or take plants.knife.encoder: "
                "{lines: 2072} and 41440 counts a turn of the load in the program; or tie "));
  // On the drum it counts the same behind every gear.
  options.set = {"plants.knife.encoder.on_drum=true", "plants.knife.encoder.lines=10240"};
  run();
  EXPECT_THAT(row("HG-SR202", "7").at("set"), Not(HasSubstr("lines")));
  EXPECT_THAT(out, Not(HasSubstr("left out")));
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
  EXPECT_THAT(out, HasSubstr("at 2 corners; first: HG-SR202, "));
  const auto by_file = text_of(options.out / "size.csv");
  options.corners.clear();
  options.at = {"variables.length=800 mm, plants.web.wheel.distance=600 mm",
                "variables.length=1000 mm,plants.web.wheel.distance=650 mm"};
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_EQ(text_of(options.out / "size.csv"), by_file);
  EXPECT_THAT(out, HasSubstr("\n0 runs simulated now"));
  EXPECT_THAT(by_file, HasSubstr("\"length=1000 mm, web.wheel.distance=650 mm\""));
  // Of an envelope of several scenes the points of this one.
  const auto stem = options.scenario.stem().string();
  folder.file(
      "several.csv",
      "scene,variables.length [mm],plants.web.wheel.distance [mm],verdict,limit,holds from [mm],holds "
      "again at [mm]\n" +
          stem + ",800,600,found,x,600,\n" + stem + ",1000,650,throughout,,600,\nsaw,10,20,found,x,5,\n");
  options.at.clear();
  options.corners = folder / "several.csv";
  ASSERT_EQ(run(), all_passed) << err;
  EXPECT_THAT(out, AllOf(HasSubstr("at 2 corners"), HasSubstr("\n0 runs simulated now")));
  options.at = {"variables.length=800 mm, plants.web.wheel.distance=600 mm",
                "variables.length=1000 mm,plants.web.wheel.distance=650 mm"};
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
  EXPECT_EQ(one.at("verdict"), "does not fit");
  EXPECT_EQ(one.at("reason"), "check 'cut length' failed (with a motor without limits, too)");
  EXPECT_THAT(one.at("where"), HasSubstr(" and 1 more corner"));
  // It ran all the same.
  EXPECT_GT(number(one, "reserve [%]"), 0);
  EXPECT_EQ(number(one, "short by [%]"), 0);
  EXPECT_THAT(out,
              HasSubstr("no motor that was tried fits; nearest: HG-SR202, short of no rating, but check 'cut "
                        "length' failed"));
}

TEST_F(SizeCommand, BrakeResistors) {
  // So small a capacitor that braking lifts the bus.
  options.set = {"plants.knife.servo.supply.capacitance=100 uF", "plants.knife.drum_inertia=1 kg m2"};
  options.resistors = "20 W, 200 W, none, 6.5 ohm 1 kW";
  run();
  ASSERT_EQ(rows().size(), 4U);
  std::map<std::string, SizeRow> by;
  for (auto& one : rows()) by[one["brake resistor"]] = one;
  ASSERT_THAT(by, testing::SizeIs(4));
  EXPECT_THAT(by.at("none").at("set"), HasSubstr("servo.supply.resistor=0 ohm"));
  EXPECT_THAT(by.at("20 W").at("set"), AllOf(HasSubstr("resistor_power=20 W"), Not(HasSubstr(" ohm"))));
  EXPECT_THAT(by.at("6.5 ohm 1 kW").at("set"),
              AllOf(HasSubstr("resistor=6.5 ohm"), HasSubstr("resistor_power=1000 W")));
  EXPECT_EQ(by.at("20 W").at("verdict"), "does not fit");
  EXPECT_THAT(by.at("20 W").at("reason"), HasSubstr("brake resistor "));
  EXPECT_EQ(by.at("none").at("verdict"), "does not fit");
  EXPECT_THAT(by.at("none").at("reason"), AllOf(HasSubstr("the drive tripped"), HasSubstr("DC link")));
  // The braking power is the machine's, not the resistor's.
  const auto watts = [&](const char* name, double bears) {
    return number(by.at(name), "brake resistor [% of its rating]") / 100 * bears;
  };
  EXPECT_NEAR(watts("200 W", 200), watts("20 W", 20), 1e-6);
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

// An induction motor behind an inverter is sized as well.
TEST_F(SizeCommand, TheMotorOfAnInverter) {
  options.scenario = shipped("onoff_backlash.yaml");
  options.motors = "generic-4P-1*";
  options.set = {"drives.cycle=2 s", "plants.axis.inverter.torque_limit=7 N m"};
  options.resistors = "100,200 W";
  EXPECT_EQ(run(), all_passed) << err;
  EXPECT_EQ(rows().size(), 4U);
  EXPECT_EQ(rows().front().at("motor"), "generic-4P-1.1kW");
  EXPECT_EQ(rows().front().at("brake resistor"), "100 W");
  EXPECT_THAT(rows().front().at("set"), HasSubstr("plants.axis.inverter.supply.resistor_power=100 W"));
}

// What stands still has no load that goes on for ever.
TEST_F(SizeCommand, WithoutASteadyCycleNothingFits) {
  folder.file(
      "axis.yaml",
      "scene: {duration: 1 s}\nplants:\n  a: {type: linear_axis, drive: inverter}\ndrives: {cycle: 0.2 s}\n");
  options.scenario = folder / "axis.yaml";
  options.motors = "generic-4P-1.1kW";
  options.set = {"plants.a.inverter.torque_limit=5 N m"};
  EXPECT_EQ(run(), check_failed) << err;
  EXPECT_EQ(rows().front().at("verdict"), "does not fit");
  EXPECT_EQ(rows().front().at("reason"), "no machine cycle ended, so its continuous load is unknown");
  EXPECT_EQ(rows().front().at("short by [%]"), "");
  EXPECT_THAT(out, HasSubstr("nearest: generic-4P-1.1kW, of which nobody can say how much it is short"));
}

}  // namespace
}  // namespace drycut::sim::cli
