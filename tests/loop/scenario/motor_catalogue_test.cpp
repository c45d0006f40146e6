// Motors of the catalogue: those that come with the program, and what a scenario makes of them.
#include "sim/scenario/motor_catalogue.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "plants/servo_drive.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/motor_estimates.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "sim/scenario/units.hpp"
#include "tests/findings.hpp"
#include "tests/loop/scenario/folder.hpp"

namespace drycut::sim::scenario {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

double si(const MotorModel& motor, std::string_view parameter) {
  const auto* const value = motor.find(parameter);
  EXPECT_NE(value, nullptr) << motor.name.text << ": " << parameter;
  if (value == nullptr) return 0;
  const auto quantity = parse_quantity(value->text.text);
  return to_si(quantity->number, quantity->unit);
}

// A value of a plant as `drycut check --expand` writes it.
std::string value_of(const Scenario& scenario, std::string_view plant, std::string_view parameter) {
  for (const auto& entry : scenario.plants) {
    if (entry.name.text != plant) continue;
    const auto parameters = entry.definition->parameters();
    for (const auto& row : parameters)
      if (row.name == parameter) return value_text(row);
  }
  return "";
}

std::string knife_with(const std::string& servo) {
  return "plants:\n  web: {type: web}\n  knife: {type: rotary_knife, web: web, " + servo + "}\n";
}

TEST(ShippedMotors, AreEnough) {
  Findings findings({"nothing"});
  const auto motors = read_motors("/nowhere", findings);
  EXPECT_THAT(lines_of(findings.sorted()), IsEmpty());
  std::map<std::string, std::set<std::string>> vendors;
  std::map<std::string, std::size_t> count;
  for (const auto& motor : motors) {
    vendors[motor.kind].insert(motor.vendor);
    ++count[motor.kind];
  }
  EXPECT_GE(count["servo"], 12U);
  EXPECT_GE(vendors["servo"].size(), 3U);
  EXPECT_GE(count["induction_motor"], 4U);
}

TEST(ShippedMotors, SayWhereEachValueIsFrom) {
  for (const auto& motor : shipped_motors()) {
    for (const auto& value : motor.values) {
      SCOPED_TRACE(motor.name.text + "." + value.parameter);
      EXPECT_THAT(value.from, ContainsRegex("^(checked 20[0-9-]{8}|unchecked|estimate): ........"));
      // Who was checked names the page.
      if (value.is_checked()) {
        EXPECT_THAT(value.from, ContainsRegex(", (p\\. |[0-9]+\\.1 \\(technical data\\))"));
      }
    }
  }
}

TEST(ShippedMotors, SayHowFarTheyWereChecked) {
  for (const auto& motor : shipped_motors()) {
    SCOPED_TRACE(motor.name.text);
    // Of these nobody has compared the values with the maker's page.
    const bool unchecked = motor.name.text.starts_with("HG-SR") || motor.name.text == "Sg180L-4" ||
                           motor.name.text == "WAT-80M-0.75" || motor.name.text.starts_with("generic-4P-");
    if (unchecked) {
      EXPECT_EQ(motor.standing(), "unchecked");
      for (const auto& value : motor.values) EXPECT_FALSE(value.is_checked()) << value.parameter;
    } else if (motor.name.text.starts_with("HC")) {
      EXPECT_EQ(motor.standing(), "checked");
    } else if (motor.name.text.starts_with("SGM7J")) {
      EXPECT_EQ(motor.standing(), "checked, 8 estimated");
    }
  }
}

TEST(ShippedMotors, ReachDownToFiftyWatts) {
  const auto motors = shipped_motors();
  for (const auto& [name, power] :
       {std::pair("SGM7J-A5A", 50.0), std::pair("SGM7J-01A", 100.0), std::pair("SGM7J-02A", 200.0)}) {
    const auto found = std::find_if(motors.begin(), motors.end(), [wanted = name](const auto& motor) {
      return motor.name.text == wanted && motor.kind == "servo";
    });
    ASSERT_NE(found, motors.end()) << name;
    EXPECT_EQ(si(*found, "rated_power"), power);
  }
}

TEST(ShippedMotors, AreConsistentInThemselves) {
  for (const auto& motor : shipped_motors()) {
    SCOPED_TRACE(motor.name.text);
    const double rated = si(motor, "rated_torque");
    if (motor.kind == "servo") {
      EXPECT_GE(si(motor, "peak_torque"), rated);
      EXPECT_LE(si(motor, "torque_at_max_speed"), si(motor, "peak_torque"));
      EXPECT_GE(si(motor, "max_speed"), si(motor, "rated_speed"));
    } else {
      EXPECT_GE(si(motor, "pullout_torque"), 1.6 * rated);
      EXPECT_LT(si(motor, "rated_speed"), si(motor, "synchronous_speed"));
    }
    if (motor.find("rated_power") != nullptr) {
      const double power = si(motor, "rated_power");
      EXPECT_NEAR(rated * si(motor, "rated_speed"), power, 0.03 * power);
    }
    // 1 rad/s of the bare rotor in a millisecond at least.
    EXPECT_GT(rated / si(motor, "rotor_inertia"), 900);
  }
}

// With the rotor's own inertia, at the default step: what the motor is made of is no problem, though a gear
// may be too stiff for so small a rotor.
TEST(ShippedMotors, FitTheirPlants) {
  for (const auto& motor : shipped_motors()) {
    SCOPED_TRACE(motor.name.text);
    const bool is_servo = motor.kind == "servo";
    const auto model = fmt::format("{}: {{model: \"{}\"}}", motor.kind, motor.name.text);
    Problems problems;
    const auto scenario = read_scenario_text(
        is_servo
            ? knife_with(model)
            : "plants:\n  press: {type: vertical_press, drive: inverter, inverter.torque_limit: 5 N m, " +
                  model + "}\n",
        "/nowhere/line.yaml", {}, problems);
    for (const auto& problem : problems) EXPECT_THAT(to_string(problem), Not(HasSubstr(motor.kind + ".")));
    for (const auto& value : motor.values) {
      // What the sheet alone has.
      if (value.parameter == "rated_power" || (is_servo && value.parameter == "rated_current") ||
          value.parameter == "largest_inertia_ratio")
        continue;
      EXPECT_EQ(value_of(scenario, is_servo ? "knife" : "press", motor.kind + "." + value.parameter),
                value.shown)
          << value.parameter;
    }
  }
}

// The default motor of every plant is in the catalogue with the values of the default.
TEST(ShippedMotors, HaveTheDefaultOne) {
  Problems problems;
  const auto by_default = read_scenario_text(knife_with(""), "/nowhere/line.yaml", {}, problems);
  const auto by_model =
      read_scenario_text(knife_with("servo: {model: HG-SR202}"), "/nowhere/line.yaml", {}, problems);
  EXPECT_THAT(lines_of(problems), IsEmpty());
  for (const auto* name : {"rotor_inertia", "rated_torque", "peak_torque", "torque_at_max_speed",
                           "rated_speed", "max_speed", "torque_constant"}) {
    const auto parameter = std::string("servo.") + name;
    EXPECT_EQ(value_of(by_model, "knife", parameter), value_of(by_default, "knife", parameter));
  }
}

struct MotorModels : ScenarioFolder {
  // A file of catalogue/ beside the scenario.
  void own(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(folder / "catalogue");
    write("catalogue/" + name, text);
  }
};

// A servo motor with all that one needs, and `more`.
std::string servo_motor(const std::string& name, const std::string& more = "") {
  std::string text = "  " + name + ":\n";
  const std::pair<const char*, const char*> values[] = {{"rotor_inertia", "2e-4 kg m^2"},
                                                        {"rated_torque", "3 N m"},
                                                        {"peak_torque", "9 N m"},
                                                        {"torque_at_max_speed", "6 N m"},
                                                        {"rated_speed", "3000 rpm"},
                                                        {"max_speed", "5000 rpm"},
                                                        {"stall_torque", "3.2 N m"},
                                                        {"torque_constant", "0.6 N m/A"},
                                                        {"winding_resistance", "1 ohm"},
                                                        {"winding_time_constant", "40 s"},
                                                        {"housing_time_constant", "20 min"},
                                                        {"temperature_rise", "100 K"},
                                                        {"temperature_limit", "155 degC"},
                                                        {"amplifier_current", "6 A"},
                                                        {"amplifier_peak_current", "18 A"},
                                                        {"overload_time", "3 s"}};
  plants::ServoData scratch;
  const auto rows = servo_parameters(scratch);
  const auto known = [&](const std::string& name) {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
  };
  for (const auto& [key, value] : values)
    if (known(key) && more.find(std::string(key) + ":") == std::string::npos)
      text += std::string("    ") + key + ": {value: " + value + ", from: sheet}\n";
  return text + more;
}

const std::string head =
    "vendor: Ours\nseries: S1\nkind: servo\nsources: {sheet: \"sheet: our own\"}\nmotors:\n";

TEST_F(MotorModels, GiveWayToWhatIsWrittenBesideThem) {
  for (const auto* servo : {"servo: {rated_torque: 5 N m, model: HG-SR352}",
                            "servo.model: HG-SR352, servo: {rated_torque: 5 N m}",
                            "servo.rated_torque: 5 N m, servo: {model: HG-SR352}"}) {
    SCOPED_TRACE(servo);
    problems.clear();
    const auto scenario = read(knife_with(servo));
    EXPECT_THAT(told(), IsEmpty());
    EXPECT_EQ(value_of(scenario, "knife", "servo.rated_torque"), "5 N m");
    EXPECT_EQ(value_of(scenario, "knife", "servo.peak_torque"), "50.1 N m");
    EXPECT_EQ(value_of(scenario, "knife", "servo.rotor_inertia"), "0.00786 kg m2");
  }
  const auto scenario = read(knife_with("drive: servo"), {{"plants.knife.servo.model", "HG-SR52"}});
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(value_of(scenario, "knife", "servo.peak_torque"), "7.2 N m");
}

TEST_F(MotorModels, AreWrittenOutAsTheirValues) {
  const auto scenario = read(knife_with("servo: {model: HG-SR52, max_speed: 2500 rpm}"));
  ASSERT_THAT(told(), IsEmpty());
  const auto text = expand(scenario);
  EXPECT_THAT(text, AllOf(HasSubstr("      model: none  # HG-SR52: its values are written out\n"),
                          HasSubstr("      rotor_inertia: 0.000726 kg m2\n"),
                          HasSubstr("      max_speed: 2500 rpm\n")));
  const auto again = read(text);
  EXPECT_THAT(told(), IsEmpty());
  for (const auto* parameter : {"servo.rotor_inertia", "servo.peak_torque", "servo.max_speed"})
    EXPECT_EQ(value_of(again, "knife", parameter), value_of(scenario, "knife", parameter));
  // Where each value is from, for the report.
  const auto& knife = scenario.plants.back();
  ASSERT_FALSE(knife.modelled.empty());
  EXPECT_THAT(sentences(notes_of_models(knife)),
              ElementsAre(AllOf(StartsWith("knife.servo.model: "), HasSubstr("unchecked"))));
  EXPECT_THAT(knife.modelled.front().from, StartsWith("HG-SR52, "));
}

TEST_F(MotorModels, ThatAreUnknownAreToldWithTheNearest) {
  const struct {
    const char* servo;
    std::string told;
  } cases[] = {
      {"servo: {model: HG-SR203}",
       "line.yaml:3:56: plants.knife.servo.model: there is no motor 'HG-SR203'; did you mean HG-SR202? "
       "[plant.unknown-motor]"},
      {"servo: {model: nonsense from nowhere}",
       "line.yaml:3:56: plants.knife.servo.model: there is no motor 'nonsense from nowhere'; 'drycut plants "
       "--motors' "
       "lists them; your own are in catalogue/ beside the scenario [plant.unknown-motor]"},
      {"servo: {model: {a: b}}",
       "line.yaml:3:56: plants.knife.servo.model must be a single value, not a map; write one value "
       "[scenario.wrong-kind]"},
      {"servo: {modle: HG-SR202}",
       "line.yaml:3:49: unknown key 'modle' in plants.knife.servo; did you mean model? "
       "[scenario.unknown-key]"},
  };
  for (const auto& [servo, expected] : cases) {
    SCOPED_TRACE(servo);
    problems.clear();
    read(knife_with(servo));
    EXPECT_THAT(told(), ElementsAre(expected));
  }
  problems.clear();
  read(knife_with("drive: servo"), {{"plants.knife.servo.model", "HG-SR205"}});
  EXPECT_THAT(told(), ElementsAre(StartsWith("--set plants.knife.servo.model:1:1: ")));
}

// What the motor's own values make impossible is told where the scenario names the motor.
TEST_F(MotorModels, AreObjectedToWhereTheyAreNamed) {
  own("ours.yaml", head + servo_motor("S1-3", "    peak_torque: {value: 2 N m, from: sheet}\n"));
  read(knife_with("servo: {model: S1-3}"));
  ASSERT_FALSE(told().empty());
  EXPECT_THAT(told().front(),
              StartsWith("line.yaml:3:56: knife.servo.peak_torque: it is below servo.rated_torque"));
}

TEST_F(MotorModels, OfOnesOwnComeFirst) {
  own("a.yaml", head + servo_motor("HG-SR202") + servo_motor("S1-3"));
  const auto scenario = read(knife_with("servo: {model: HG-SR202}"));
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(value_of(scenario, "knife", "servo.rated_torque"), "3 N m");
  EXPECT_EQ(value_of(read(knife_with("servo: {model: S1-3}")), "knife", "servo.max_speed"), "5000 rpm");
  EXPECT_EQ(value_of(read(knife_with("servo: {model: HG-SR52}")), "knife", "servo.max_speed"), "3000 rpm");
  EXPECT_THAT(told(), IsEmpty());

  own("b.yaml", head + servo_motor("S1-3"));
  read(knife_with("servo: {model: HG-SR52}"));
  ASSERT_EQ(told().size(), 1U);
  EXPECT_THAT(told().front(),
              AllOf(StartsWith("b.yaml:6:3: there are two motors named 'S1-3'; rename one; the first is in "),
                    HasSubstr("a.yaml:")));
}

TEST_F(MotorModels, OfABrokenFileAreToldInIt) {
  const auto with = [](const std::string& line) { return head + servo_motor("S1-3", "    " + line + "\n"); };
  const struct {
    std::string text;
    std::vector<std::string> told;
  } cases[] = {
      {head + "  S1-3:\n    rated_torque: {value: 3 N, from: sheet}\n",
       {"own.yaml:7:29: motors.S1-3.rated_torque is a torque, not a force (N); for example 1 N m "
        "[scenario.wrong-unit]"}},
      {head + "  S1-3:\n    rated_torque: {value: 3e9 N m, from: sheet}\n",
       {"own.yaml:7:27: motors.S1-3.rated_torque is 3000000000 N m, out of range; 0.001 N m to 10000 N m "
        "[scenario.out-of-range]"}},
      {head + "  S1-3:\n    rated_torgue: {value: 3 N m, from: sheet}\n",
       {"own.yaml:7:5: unknown key 'rated_torgue' in motors.S1-3; did you mean rated_torque? "
        "[scenario.unknown-key]"}},
      {head + "  S1-3:\n    rated_torque: 3 N m\n",
       {"own.yaml:7:19: motors.S1-3.rated_torque must be a map, not a single value; write key: value, or "
        "{key: "
        "value} [scenario.wrong-kind]"}},
      {head + "  S1-3:\n    rated_torque: {value: 3 N m}\n",
       {"own.yaml:7:19: motors.S1-3.rated_torque.from is missing; write from: \"sheet: ...\" or from: "
        "\"estimate: "
        "...\" [scenario.missing-key]"}},
      {head + "  S1-3:\n    rated_torque: {value: 3 N m, from: sheat}\n",
       {"own.yaml:7:40: motors.S1-3.rated_torque.from says neither which sheet nor why an estimate; did you "
        "mean "
        "sheet? [plant.motor-sheet]"}},
      {head + "  S1-3:\n    rated_torque: {value: 3 N m, from: \"checked today: p. 3\"}\n",
       {"own.yaml:7:41: motors.S1-3.rated_torque.from says neither which sheet nor why an estimate; write "
        "\"sheet: ...\", \"checked 2026-11-24: ...\" or \"estimate: ...\", or a word of sources "
        "[plant.motor-sheet]"}},
      {with("rated_power: {value: 2 kW, from: sheet}"),
       {"own.yaml:23:26: motors.S1-3.rated_power is 2 kW, but rated torque at rated speed gives 0.942 kW; "
        "within 3 % "
        "of each other [plant.motor-sheet]"}},
      {"vendor: Ours\nseries: S1\nkind: stepper\nmotors: {}\n",
       {"own.yaml:3:7: kind: unknown choice 'stepper'; known: servo, induction_motor "
        "[scenario.unknown-choice]"}},
      {"vendor: Ours\nseries: S1\nkind: servo\n",
       {"own.yaml:1:1: motors is missing; write motors: {HG-SR202: "
        "{rated_torque: {value: 9.55 N m, from: sheet}, ...}} [scenario.missing-key]"}},
      {"",
       {"own.yaml:1:1: a series of motors must be a map, not nothing; write key: value, or {key: value} "
        "[scenario.wrong-kind]"}},
  };
  for (const auto& [text, expected] : cases) {
    SCOPED_TRACE(text);
    problems.clear();
    own("own.yaml", text);
    read(knife_with("servo: {model: HG-SR202}"));
    EXPECT_EQ(told(), expected);
  }
  // A scenario without a model does not read them.
  problems.clear();
  read(knife_with("drive: servo"));
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MotorModels, SayWhichValuesOfTheSheetAreMissing) {
  own("own.yaml", head + "  S1-3:\n    rated_torque: {value: 3 N m, from: sheet}\n");
  read(knife_with("servo: {model: S1-3}"));
  const std::string remedy =
      "; write it from the motor's sheet; drycut plants --motor-template shows which values a motor needs "
      "and which are estimated without [plant.motor-incomplete]";
  EXPECT_THAT(told(),
              ElementsAre("own.yaml:6:3: motors.S1-3.peak_torque is missing" + remedy,
                          "own.yaml:6:3: motors.S1-3.rated_speed is missing" + remedy,
                          "own.yaml:6:3: motors.S1-3.rotor_inertia is missing" + remedy,
                          "own.yaml:6:3: motors.S1-3.rated_current or torque_constant is missing" + remedy));
  EXPECT_THAT(told(), Not(testing::Contains(HasSubstr("there is no motor"))));
}

// Five values of a sheet, in the units of an American one; the rest by closed forms on the safe side.
TEST_F(MotorModels, OfFiveValuesAreCompleted) {
  own("own.yaml", head + R"(  M1:
    rated_torque: {value: 21 lb in, from: sheet}
    peak_torque: {value: 63 lbf in, from: sheet}
    rated_speed: {value: 3005 rpm, from: sheet}
    rotor_inertia: {value: 0.018 oz in s2, from: sheet}
    rated_current: {value: 4 A, from: sheet}
)");
  const auto scenario = read(knife_with("servo: {model: M1}"));
  Findings findings({"line.yaml"});
  const auto motors = read_motors(folder / ".", findings);
  ASSERT_THAT(lines_of(findings.sorted()), IsEmpty());
  const auto& motor = motors.front();
  ASSERT_EQ(motor.name.text, "M1");
  constexpr double pound_inch = 0.45359237 * 9.80665 * 0.0254;
  const double rated = 21 * pound_inch;
  const double speed = 3005 * std::numbers::pi / 30;
  EXPECT_NEAR(si(motor, "rated_torque"), rated, 1e-12);
  // Copies are exact: no more than the sheet has, and no less than its neighbours need.
  EXPECT_EQ(si(motor, "max_speed"), si(motor, "rated_speed"));
  EXPECT_EQ(si(motor, "torque_at_max_speed"), si(motor, "peak_torque"));
  EXPECT_EQ(si(motor, "stall_torque"), si(motor, "rated_torque"));
  EXPECT_NEAR(si(motor, "rotor_inertia"), 0.018 * pound_inch / 16, 1e-15);
  const auto is_estimate = [&](const char* name, double value) {
    SCOPED_TRACE(name);
    EXPECT_NEAR(si(motor, name), value, 0.01 * value);  // rounded to three digits, currents up
    ASSERT_NE(motor.find(name), nullptr);
    EXPECT_TRUE(motor.find(name)->is_estimate());
  };
  is_estimate("torque_constant", rated / 4);
  is_estimate("max_speed", speed);
  is_estimate("torque_at_max_speed", 3 * rated);
  is_estimate("stall_torque", rated);
  is_estimate("winding_resistance", 0.06 * rated * speed / (1.5 * 4 * 4));
  is_estimate("amplifier_current", 4);
  is_estimate("peak_current", 15);
  is_estimate("amplifier_peak_current", 15);
  // Never less torque than the sheet has.
  EXPECT_GE(si(motor, "amplifier_peak_current") * si(motor, "torque_constant"), 3 * rated * (1 - 0.005));
  EXPECT_EQ(std::count_if(motor.values.begin(), motor.values.end(),
                          [](const auto& value) { return value.is_completed(); }),
            13);
  EXPECT_EQ(motor.standing(), "unchecked, 13 estimated");
  // The scenario has it, the sheet's and the estimates; and says so.
  EXPECT_EQ(value_of(scenario, "knife", "servo.stall_torque"), motor.find("stall_torque")->shown);
  ASSERT_FALSE(scenario.plants.empty());
  EXPECT_THAT(sentences(notes_of_models(scenario.plants.back())),
              ElementsAre(HasSubstr("unchecked, 13 estimated")));
}

TEST_F(MotorModels, EstimatesAreOnTheSafeSideOfKnownOnes) {
  for (const auto& motor : shipped_motors()) {
    if (motor.kind != "servo" || motor.standing().find("estimated") != std::string::npos) continue;
    SCOPED_TRACE(motor.name.text);
    auto text = head + "  M1:\n";
    for (const auto* name :
         {"rated_torque", "peak_torque", "rated_speed", "rotor_inertia", "torque_constant"})
      text += fmt::format("    {}: {{value: {}, from: sheet}}\n", name, motor.find(name)->shown);
    own("own.yaml", text);
    Findings findings({"line.yaml"});
    const auto motors = read_motors(folder / ".", findings);
    ASSERT_THAT(lines_of(findings.sorted()), IsEmpty());
    const auto& made = motors.front();
    for (const auto* least : {"max_speed", "stall_torque", "winding_time_constant", "housing_time_constant"})
      EXPECT_LE(si(made, least), 1.0001 * si(motor, least)) << least;
    EXPECT_GE(si(made, "temperature_rise"), si(motor, "temperature_rise"));
  }
}

TEST_F(MotorModels, OfInductionNeedFiveValuesToo) {
  const struct {
    const char* speed;
    double frequency;
    double field;
  } cases[] = {{"1440 rpm", 50, 1500}, {"1750 rpm", 60, 1800}, {"2850 rpm", 50, 3000},
               {"1170 rpm", 60, 1200}, {"960 rpm", 50, 1000},  {"870 rpm", 60, 900}};
  for (const auto& [speed, frequency, field] : cases) {
    SCOPED_TRACE(speed);
    own("own.yaml", fmt::format("vendor: Ours\nseries: S1\nkind: induction_motor\nmotors:\n  M1:\n"
                                "    rated_torque: {{value: 10 N m, from: \"sheet: ours\"}}\n"
                                "    pullout_torque: {{value: 25 N m, from: \"sheet: ours\"}}\n"
                                "    rated_speed: {{value: {}, from: \"sheet: ours\"}}\n"
                                "    rotor_inertia: {{value: 40 kg cm2, from: \"sheet: ours\"}}\n"
                                "    rated_current: {{value: 3.5 A, from: \"sheet: ours\"}}\n",
                                speed));
    Findings findings({"line.yaml"});
    const auto motors = read_motors(folder / ".", findings);
    ASSERT_THAT(lines_of(findings.sorted()), IsEmpty());
    EXPECT_NEAR(si(motors.front(), "rated_frequency"), frequency, 1e-9);
    EXPECT_NEAR(si(motors.front(), "synchronous_speed"), field * std::numbers::pi / 30, 1e-9);
    EXPECT_NEAR(si(motors.front(), "max_speed"), 1.2 * field * std::numbers::pi / 30, 1e-9);
  }
}

// What the template asks for is enough, and what it offers is known.
TEST_F(MotorModels, AreMadeFromTheTemplate) {
  for (const auto kind : motor_kinds) {
    SCOPED_TRACE(kind);
    std::string filled;
    std::istringstream lines(motor_template(kind));
    for (std::string line; std::getline(lines, line);) {
      const auto gap = line.find("___");
      const auto unit = [&](std::string_view name) { return line.find(name) != std::string::npos; };
      if (gap != std::string::npos && !line.starts_with("    #"))
        line.replace(gap, 3,
                     unit("speed")                  ? "1400"
                     : unit("inertia")              ? "0.001"
                     : unit("peak") || unit("pull") ? "20"
                                                    : "7");
      if (line.starts_with("    # ") && gap != std::string::npos) {
        auto key = line.substr(6, line.find(':') - 6);
        EXPECT_NE(MotorTable(kind).find(key), nullptr) << key;
      }
      filled += line + "\n";
    }
    own("own.yaml", filled);
    Findings findings({"line.yaml"});
    const auto motors = read_motors(folder / ".", findings);
    EXPECT_THAT(lines_of(findings.sorted()), IsEmpty());
    EXPECT_EQ(motors.front().name.text, "NAME");
    EXPECT_EQ(motors.front().kind, kind);
    // Not filled in it is told, gap by gap.
    own("own.yaml", motor_template(kind));
    Findings gaps({"line.yaml"});
    read_motors(folder / ".", gaps);
    EXPECT_EQ(gaps.count(), 5U);
  }
}

TEST_F(MotorModels, AnswerToTheirFormerNameWithANote) {
  const auto press = [](const std::string& model) {
    return "plants:\n  press: {type: vertical_press, drive: inverter, inverter.torque_limit: 5 N m, "
           "induction_motor: {model: " +
           model + "}}\n";
  };
  const auto scenario = read(press("IEC-4P-2.2kW"));
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(value_of(scenario, "press", "induction_motor.rated_torque"), "14.7 N m");
  ASSERT_EQ(scenario.plants.size(), 1U);
  EXPECT_THAT(sentences(notes_of_models(scenario.plants.front())),
              testing::Contains(AllOf(HasSubstr("IEC-4P-2.2kW"), HasSubstr("generic-4P-2.2kW"))));
  const auto today = read(press("generic-4P-2.2kW"));
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(sentences(notes_of_models(today.plants.front())), Not(testing::Contains(HasSubstr("IEC-4P"))));
}

// Common values hold for each motor of the file; its own go before them.
TEST_F(MotorModels, ShareWhatIsCommon) {
  auto text = head;
  text.insert(text.find("motors:"), "common: {max_speed: {value: 4000 rpm, from: \"estimate: a guess\"}}\n");
  own("own.yaml", text + servo_motor("A", "    max_speed: {value: 4500 rpm, from: sheet}\n") +
                      "  B:\n    rated_torque: {value: 3 N m, from: sheet}\n");
  read(knife_with("servo: {model: A}"));
  // B lacks much, but not what is common.
  EXPECT_THAT(told(), Not(IsEmpty()));
  EXPECT_THAT(told(), Not(testing::Contains(HasSubstr("motors.B.max_speed"))));
}

}  // namespace
}  // namespace drycut::sim::scenario
