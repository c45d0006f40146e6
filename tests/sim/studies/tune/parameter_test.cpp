// What --vary names and what stands there before the tuning.
#include <gtest/gtest.h>

#include "sim/studies/tune/parameter.hpp"

namespace drycut::sim::studies {
namespace {

scenario::Scenario scene(const std::string& name) {
  Problems problems;
  auto scenario = scenario::read_scenario(
      std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes" / (name + ".yaml"), {}, problems);
  EXPECT_TRUE(problems.empty());
  return scenario;
}

TunedParameter parameter(const std::string& text) {
  Problems problems;
  const auto made = parse_parameter(text, "--vary", false, problems);
  EXPECT_TRUE(made.has_value());
  return made.value_or(TunedParameter{});
}

TEST(TuneParameter, NamesAValueOfEveryController) {
  for (const std::string section : {"qmove", "lx3vp", "plcopen"}) {
    const auto preset = preset_name("controller." + section + ".set.Axis.gain");
    ASSERT_TRUE(preset.has_value()) << section;
    EXPECT_EQ(preset->section, section);
    EXPECT_EQ(preset->value, "Axis.gain");
  }
  EXPECT_FALSE(preset_name("controller.plc.set.D100").has_value());
  EXPECT_FALSE(preset_name("plants.knife.servo.speed_gain").has_value());
}

TEST(TuneParameter, WhatTheSceneSetsIsThePresentValue) {
  auto set = parameter("controller.plcopen.set.Knife.kv=1000..9000");
  EXPECT_EQ(present_value(set, scene("mc_camin_first")), 6000);
}

TEST(TuneParameter, AnAxisParameterHasAValueWithoutBeingSet) {
  auto started = parameter("controller.plcopen.set.Knife.dynamik.a_max=1000..9000");
  EXPECT_EQ(present_value(started, scene("mc_camin_first")), 8000);
  auto none = parameter("controller.plcopen.set.Knife.no_such=1000..9000");
  EXPECT_FALSE(present_value(none, scene("mc_camin_first")).has_value());
}

TEST(TuneParameter, BoundsOfAnAxisParameterAreChecked) {
  Problems problems;
  auto negative = parameter("controller.plcopen.set.Knife.kv=-5..9000");
  check_against_controller(negative, scene("mc_camin_first"), problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].column, 33);
}

}  // namespace
}  // namespace drycut::sim::studies
