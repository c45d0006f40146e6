// Motors of the catalogue: those that come with the program, and what a scenario makes of them.
#include "sim/scenario/motor_catalogue.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "plants/servo_drive.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "sim/scenario/units.hpp"
#include "tests/sim/scenario/folder.hpp"

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
      EXPECT_THAT(value.from, ContainsRegex("^(sheet|estimate): ........"));
      EXPECT_EQ(value.is_estimate(), value.from.starts_with("estimate: "));
    }
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
      if (value.parameter == "rated_power") continue;
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
  for (const auto* name :
       {"rotor_inertia", "rated_torque", "peak_torque", "torque_at_max_speed", "rated_speed", "max_speed"}) {
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
  EXPECT_THAT(knife.modelled.front().from, StartsWith("HG-SR52, "));
}

TEST_F(MotorModels, ThatAreUnknownAreToldWithTheNearest) {
  const struct {
    const char* servo;
    std::string told;
  } cases[] = {
      {"servo: {model: HG-SR203}",
       "line.yaml:3:56: plants.knife.servo.model: there is no motor 'HG-SR203'; did you mean HG-SR202?"},
      {"servo: {model: nonsense from nowhere}",
       "line.yaml:3:56: plants.knife.servo.model: there is no motor 'nonsense from nowhere'; 'drycut plants "
       "--motors' "
       "lists them; your own are in catalogue/ beside the scenario"},
      {"servo: {model: {a: b}}",
       "line.yaml:3:56: plants.knife.servo.model must be a single value, not a map; write one value"},
      {"servo: {modle: HG-SR202}",
       "line.yaml:3:49: unknown key 'modle' in plants.knife.servo; did you mean model?"},
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
       {"own.yaml:7:29: motors.S1-3.rated_torque is a torque, not a force (N); for example 1 N m"}},
      {head + "  S1-3:\n    rated_torque: {value: 3e9 N m, from: sheet}\n",
       {"own.yaml:7:27: motors.S1-3.rated_torque is 3000000000 N m, out of range; 0.001 N m to 10000 N m"}},
      {head + "  S1-3:\n    rated_torgue: {value: 3 N m, from: sheet}\n",
       {"own.yaml:7:5: unknown key 'rated_torgue' in motors.S1-3; did you mean rated_torque?"}},
      {head + "  S1-3:\n    rated_torque: 3 N m\n",
       {"own.yaml:7:19: motors.S1-3.rated_torque must be a map, not a single value; write key: value, or "
        "{key: "
        "value}"}},
      {head + "  S1-3:\n    rated_torque: {value: 3 N m}\n",
       {"own.yaml:7:19: motors.S1-3.rated_torque.from is missing; write from: \"sheet: ...\" or from: "
        "\"estimate: "
        "...\""}},
      {head + "  S1-3:\n    rated_torque: {value: 3 N m, from: sheat}\n",
       {"own.yaml:7:40: motors.S1-3.rated_torque.from says neither which sheet nor why an estimate; did you "
        "mean "
        "sheet?"}},
      {with("rated_power: {value: 2 kW, from: sheet}"),
       {"own.yaml:23:26: motors.S1-3.rated_power is 2 kW, but rated torque at rated speed gives 0.942 kW; "
        "within 3 % "
        "of each other"}},
      {"vendor: Ours\nseries: S1\nkind: stepper\nmotors: {}\n",
       {"own.yaml:3:7: kind: unknown choice 'stepper'; known: servo, induction_motor"}},
      {"vendor: Ours\nseries: S1\nkind: servo\n",
       {"own.yaml:1:1: motors is missing; write motors: {HG-SR202: "
        "{rated_torque: {value: 9.55 N m, from: sheet}, ...}}"}},
      {"",
       {"own.yaml:1:1: a series of motors must be a map, not nothing; write key: value, or {key: value}"}},
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

TEST_F(MotorModels, SayAllThatTheDefaultWouldSayOfAnother) {
  own("own.yaml", head + "  S1-3:\n    rated_torque: {value: 3 N m, from: sheet}\n");
  read(knife_with("servo: {model: S1-3}"));
  EXPECT_THAT(told(), testing::Contains(
                          "own.yaml:6:3: motors.S1-3.rotor_inertia is missing; left out it would be that "
                          "of the motor that is the default"));
  EXPECT_THAT(told(), Not(testing::Contains(HasSubstr("there is no motor"))));
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
