// Classes of gears, motors and encoders: values that a scenario has by a word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/scenario/format.hpp"
#include "sim/scenario/motor_catalogue.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "tests/findings.hpp"
#include "tests/loop/scenario/folder.hpp"

namespace drycut::sim::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

struct Classes : ScenarioFolder {
  PlantEntry knife(const std::string& with) {
    problems.clear();
    auto scenario =
        read("plants:\n  web: {type: web}\n  knife: {type: rotary_knife, web: web, " + with + "}\n");
    EXPECT_THAT(told(), IsEmpty()) << with;
    const auto found = std::ranges::find(scenario.plants, "knife", [](const auto& p) { return p.name.text; });
    return std::move(*found);
  }
  static std::string value(const PlantEntry& plant, std::string_view parameter) {
    for (const auto& row : plant.definition->parameters())
      if (row.name == parameter) return value_text(row);
    return "";
  }
  static std::string from(const PlantEntry& plant, std::string_view parameter) {
    const auto found = std::ranges::find(plant.modelled, parameter, &PlantEntry::Modelled::parameter);
    return found == plant.modelled.end() ? "" : found->from;
  }
};

TEST_F(Classes, GiveNothingUntilOneIsNamed) {
  const auto plain = knife("drive: servo");
  for (const auto* parameter :
       {"servo.cogging", "servo.torque_ripple", "encoder.eccentricity", "encoder.interpolation_error"}) {
    EXPECT_THAT(value(plain, parameter), StartsWith("0")) << parameter;
    EXPECT_EQ(from(plain, parameter), "");
  }
}

// Whichever stands first, and whether the torque is the scenario's, a model's or the default.
TEST_F(Classes, OfMotorsGiveAShareOfTheRatedTorque) {
  for (const auto* servo :
       {"servo: {class: iron_core, rated_torque: 4 N m}", "servo: {rated_torque: 4 N m, class: iron_core}",
        "servo.rated_torque: 4 N m, servo: {class: iron_core, model: HG-SR202}"}) {
    const auto plant = knife(servo);
    EXPECT_EQ(value(plant, "servo.cogging"), "0.04 N m") << servo;
    EXPECT_EQ(value(plant, "servo.torque_ripple"), "2 %") << servo;
    EXPECT_THAT(from(plant, "servo.cogging"), StartsWith("iron_core, estimate: "));
  }
  EXPECT_EQ(value(knife("servo: {class: skewed, model: HG-SR52}"), "servo.cogging"), "0.012 N m");
  EXPECT_EQ(value(knife("servo: {class: skewed}"), "servo.cogging"), "0.0475 N m");
}

TEST_F(Classes, GiveWayToWhatIsWrittenBesideThem) {
  const auto plant =
      knife("servo: {cogging: 0.2 N m, class: iron_core}, encoder: {class: ttl, eccentricity: 0 deg}");
  EXPECT_EQ(value(plant, "servo.cogging"), "0.2 N m");
  EXPECT_EQ(value(plant, "servo.torque_ripple"), "2 %");
  EXPECT_EQ(value(plant, "encoder.eccentricity"), "0 deg");
  EXPECT_EQ(value(plant, "encoder.interpolation_error"), "3 %");
  EXPECT_EQ(from(plant, "servo.cogging"), "");
}

TEST_F(Classes, OfEncodersGiveTheirSheetsErrors) {
  EXPECT_EQ(value(knife("encoder: {class: sin_cos}"), "encoder.interpolation_error"), "1 %");
  EXPECT_THAT(value(knife("encoder: {class: resolver}"), "encoder.eccentricity"), StartsWith("0.23333"));
  EXPECT_THAT(from(knife("encoder: {class: sin_cos}"), "encoder.interpolation_error"),
              HasSubstr("Heidenhain"));
}

// A sheet that tells the cogging is better than the motor's class; a class that the scenario names is better
// still.
TEST_F(Classes, MayBeAModels) {
  std::filesystem::create_directories(folder / "catalogue");
  write("catalogue/own.yaml", R"(
vendor: Ours
series: S1
kind: servo
sources: {sheet: "sheet: our own"}
common:
  class: {value: iron_core, from: sheet}
  rotor_inertia: {value: 2e-4 kg m^2, from: sheet}
  rated_torque: {value: 3 N m, from: sheet}
  peak_torque: {value: 9 N m, from: sheet}
  rated_speed: {value: 3000 rpm, from: sheet}
  rated_current: {value: 5 A, from: sheet}
motors:
  Plain: {}
  Told: {cogging: {value: 0.012 N m, from: sheet}}
)");
  EXPECT_EQ(value(knife("servo: {model: Plain}"), "servo.cogging"), "0.03 N m");
  const auto told_by_sheet = knife("servo: {model: Told}");
  EXPECT_EQ(value(told_by_sheet, "servo.class"), "iron_core");
  EXPECT_EQ(value(told_by_sheet, "servo.cogging"), "0.012 N m");
  EXPECT_EQ(value(told_by_sheet, "servo.torque_ripple"), "2 %");
  EXPECT_EQ(value(knife("servo: {model: Told, class: skewed}"), "servo.cogging"), "0.015 N m");
}

// The notes on a model are on the model's values alone.
TEST_F(Classes, AreNoMotors) {
  EXPECT_THAT(codes(notes_of_models(knife("servo: {class: iron_core}"))), IsEmpty());
  EXPECT_THAT(codes(notes_of_models(knife("servo: {class: iron_core, model: HC203R}"))), IsEmpty());
  EXPECT_THAT(codes(notes_of_models(knife("servo: {class: iron_core, model: HG-SR202}"))),
              ElementsAre("plant.motor-unchecked"));
}

TEST_F(Classes, AreRefusedWhereThereIsNone) {
  read("plants:\n  web: {type: web}\n  knife: {type: rotary_knife, web: web, servo: {class: iron_cor}}\n");
  EXPECT_THAT(told(), ElementsAre(HasSubstr("iron_core")));
}

// What `drycut check --expand` writes is the same machine.
TEST_F(Classes, SurviveBeingWrittenOut) {
  const std::string text =
      "plants:\n  web: {type: web}\n"
      "  knife: {type: rotary_knife, web: web, servo: {class: skewed}, encoder: {class: resolver}, "
      "gear: {type: worm}}\n";
  const auto once = expand(read(text));
  EXPECT_THAT(once, HasSubstr("class: skewed"));
  EXPECT_EQ(expand(read(once)), once);
  EXPECT_THAT(told(), IsEmpty());
}

// A motor of the 400 V class brings its mains; others are refused.
TEST_F(Classes, OfMainsComeWithTheMotor) {
  const auto plant = knife("servo: {model: SGMSH-20D}");
  EXPECT_EQ(value(plant, "servo.supply.voltage"), "400 V");
  EXPECT_EQ(value(plant, "servo.rated_torque"), "6.36 N m");
  EXPECT_EQ(value(knife("servo: {model: SGMSH-20D, supply: {voltage: 480 V}}"), "servo.supply.voltage"),
            "480 V");
  problems.clear();
  read(
      "plants:\n  web: {type: web}\n"
      "  knife: {type: rotary_knife, web: web, servo: {model: SGMSH-20D, supply: {voltage: 200 V}}}\n");
  EXPECT_THAT(
      told(),
      ElementsAre(HasSubstr(
          "line.yaml:3:85: knife.servo.supply.voltage: SGMSH-20D is for mains of 400 V, not of 200 V")));
}

}  // namespace
}  // namespace drycut::sim::scenario
