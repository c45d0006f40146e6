#pragma once
#include <array>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace drycut::sim::fakes {

// Plants with every kind of parameter and no machine behind them: the reader under test sees only tables.

struct FakeWeb : plants::PlantDefinition {
  double speed = 1;       // [m/s]
  double slip = 0.02;     // pure number
  double friction = 0.3;  // pure number
  double mass = 5.5;      // [kg]
  int lines = 2500;
  bool brake = false;
  plants::Parameters parameters() override {
    return {
        {"speed", "m/min", "line speed", &speed, 0, 300}, {"slip", "%", "slip of the wheel", &slip, 0, 50},
        {"friction", "", "coefficient", &friction, 0, 1}, {"mass", "kg", "moving mass", &mass, 0.1, 1000},
        {"lines", "", "lines a turn", &lines, 1, 100000}, {"brake", "", "has a brake", &brake}};
  }
  std::vector<Objection> objections(double) override {
    if (brake && mass > 500)
      return {{"plant.parameters-contradict"_code, "mass", "too heavy for the brake",
               "at most 500 kg with a brake"}};
    return {};
  }
  std::unique_ptr<plants::Plant> build(plants::World&,
                                       const std::function<plants::Plant*(std::string_view)>&) override {
    return nullptr;
  }
};

struct FakeKnife : plants::PlantDefinition {
  std::string web = "web";
  std::string mounting = "motor";
  double circumference = 0.6;               // [m]
  double angle = 0;                         // [rad]
  double rated_torque = 9.5;                // [N m]
  double rated_speed = 209.43951023931953;  // [rad/s]
  double stiffness = 4000;                  // [N m/rad]
  double gain = 1;
  plants::Parameters parameters() override {
    return {{"web", "", "the web that it cuts", &web, 0, 0, {}, "web"},
            {"circumference", "mm", "cutting circle", &circumference, 100, 5000},
            {"angle", "deg", "initial angle", &angle, -180, 180},
            {"servo.rated_torque", "N m", "rated torque", &rated_torque, 0.1, 1000},
            {"servo.rated_speed", "rpm", "rated speed", &rated_speed, 1, 10000},
            {"encoder.mounting", "", "where the encoder sits", &mounting, 0, 0, {"motor", "load"}},
            {"gear.stiffness", "N m/rad", "torsional stiffness", &stiffness, 1, 1e6},
            {"servo.loop.gain", "", "speed loop gain", &gain, 0, 100}};
  }
  std::unique_ptr<plants::Plant> build(plants::World&,
                                       const std::function<plants::Plant*(std::string_view)>&) override {
    return nullptr;
  }
};

// Refers to a plant of its own type.
struct FakeAxis : plants::PlantDefinition {
  std::string master;
  plants::Parameters parameters() override {
    return {{"master", "", "the axis that it follows", &master, 0, 0, {}, "axis"}};
  }
  std::unique_ptr<plants::Plant> build(plants::World&,
                                       const std::function<plants::Plant*(std::string_view)>&) override {
    return nullptr;
  }
};

template <typename Definition>
std::unique_ptr<plants::PlantDefinition> define() {
  return std::make_unique<Definition>();
}

inline const std::array<plants::PlantType, 3> fake_types = {
    {{"axis", "", define<FakeAxis>}, {"rotary_knife", "", define<FakeKnife>}, {"web", "", define<FakeWeb>}}};

/// Reads a scenario from memory; the problems as "line:column: what; remedy", with "--set ...:" in front of
/// those of an override.
inline scenario::Scenario read(std::string_view text, std::vector<std::string>& problems,
                               const std::vector<scenario::Override>& overrides = {}) {
  Problems found;
  auto scenario = scenario::read_scenario_text(text, "line.yaml", overrides, found, fake_types);
  const std::string file = "line.yaml:";
  for (const auto& problem : found) {
    const auto message = to_string(problem);
    problems.push_back(message.starts_with(file) ? message.substr(file.size()) : message);
  }
  return scenario;
}

inline std::vector<std::string> problems_of(std::string_view text,
                                            const std::vector<scenario::Override>& overrides = {}) {
  std::vector<std::string> problems;
  read(text, problems, overrides);
  return problems;
}

}  // namespace drycut::sim::fakes
