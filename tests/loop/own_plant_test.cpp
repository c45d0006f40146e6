// What CONTRIBUTING.md promises: a plant is a definition in a file of its own and a line in a registry, and
// all the rest follows.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <span>

#include "base/state_archive.hpp"
#include "plants/plant.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// The file of its own: a wheel that friction slows down, and a brake that helps.

class Flywheel : public plants::Plant {
 public:
  Flywheel(double speed, double decay) : speed_(speed), decay_(decay) {}
  void drive(double h) override { speed_ -= speed_ * h / decay_ * (brake_ ? 10 : 1); }
  void sense(double) override {}
  void visit(StateArchive& archive) override { STATE(archive, speed_, brake_); }
  std::vector<plants::Channel> channels() override {
    return {{"speed", "rad/s", [this] { return speed_; }, "how fast it turns"}};
  }
  std::vector<plants::Setting> settings() override {
    return {{"brake", "", [this](double on) { brake_ = on != 0; }, [this] { return brake_ ? 1.0 : 0.0; },
             "ten times the friction"}};
  }

 private:
  double speed_;
  double decay_;
  bool brake_ = false;
};

class FlywheelDefinition : public plants::PlantDefinition {
 public:
  plants::Parameters parameters() override {
    return {{"speed", "rad/s", "how fast it turns at the start", &speed_, 0, 1000},
            {"decay", "s", "time constant of its friction", &decay_, 0.01, 1000}};
  }
  std::unique_ptr<plants::Plant> build(plants::World&,
                                       const std::function<plants::Plant*(std::string_view)>&) override {
    return std::make_unique<Flywheel>(speed_, decay_);
  }

 private:
  double speed_ = 100;
  double decay_ = 2;
};

/// A wheel of a knife, which cuts once and then bursts.
class Cutter : public Flywheel {
 public:
  using Flywheel::Flywheel;
  std::vector<plants::EventType> event_types() override {
    return {{plants::cut_event, {{"length", "mm"}}, "a piece"},
            {"burst", {{"speed", "rad/s"}}, "it flies apart", Severity::damage}};
  }
  void sense(double) override {
    if (++steps_ == 1) happened({"cut", 1, {{"length", 800, "mm"}}});
    if (steps_ == 2) happened({"burst", 1, {{"speed", 100, "rad/s"}}});
  }

 private:
  int steps_ = 0;
};

class CutterDefinition : public FlywheelDefinition {
 public:
  std::unique_ptr<plants::Plant> build(plants::World&,
                                       const std::function<plants::Plant*(std::string_view)>&) override {
    return std::make_unique<Cutter>(1, 1);
  }
};

// The line in the registry.
const plants::PlantType types[] = {
    {"flywheel", "a wheel that slows down",
     [] { return std::unique_ptr<plants::PlantDefinition>(std::make_unique<FlywheelDefinition>()); }},
    {"cutter", "a wheel that cuts",
     [] { return std::unique_ptr<plants::PlantDefinition>(std::make_unique<CutterDefinition>()); }}};

constexpr auto* wheel_scenario = R"(scene: {title: A wheel, duration: 2 s, step: 1 ms}
plants: {wheel: {type: flywheel, speed: 600 deg/s}}
timeline: [{at: 1 s, set: {wheel.brake: 1}}]
record: {every: 100 ms, channels: [wheel.speed]}
checks: [{name: it slows down, eventually: wheel.speed < 1}]
)";

TEST(APlantOfOnesOwn, IsReadRunRecordedSetAndChecked) {
  Problems problems;
  const auto scenario = scenario::read_scenario_text(wheel_scenario, "wheel.yaml", {}, problems, types);
  EXPECT_EQ(lines_of(problems), "");
  loop::Simulation simulation(scenario, problems);
  ASSERT_EQ(lines_of(problems), "");
  EXPECT_TRUE(simulation.run().passed());
  const auto& speed = simulation.recording().column("wheel.speed")->values;
  const double start = 600 * std::acos(-1.0) / 180;
  EXPECT_NEAR(speed[10], start * std::pow(1 - 1e-3 / 2, 1000), 1e-9);
  EXPECT_NEAR(speed[20], speed[10] * std::pow(1 - 1e-2 / 2, 1000), 1e-9);
}

// What it declares of its events is all that anybody needs to know of them.
TEST(APlantOfOnesOwn, CutsAndBreaksBySayingSo) {
  Problems problems;
  auto scenario = scenario::read_scenario_text(
      "scene: {title: A cutter, duration: 10 ms, step: 1 ms}\n"
      "plants: {blade: {type: cutter}, wheel: {type: flywheel}}\n"
      "opcua: {cutters: {blade: {length: blade.speed}, wheel: {length: blade.speed}}}\n",
      "cutter.yaml", {}, problems, types);
  loop::Simulation refused(scenario, problems);
  ASSERT_EQ(problems.size(), 1U) << lines_of(problems);
  EXPECT_THAT(to_string(problems[0]), HasSubstr("cutter.yaml:3:49: no plant 'wheel' cuts"));
  problems.clear();
  scenario.opcua.cutters.pop_back();
  loop::Simulation simulation(scenario, problems);
  ASSERT_EQ(lines_of(problems), "");
  const auto outcome = simulation.run();
  const auto& events = simulation.recording().events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].severity, Severity::note);
  EXPECT_EQ(events[1].severity, Severity::damage);
  ASSERT_EQ(outcome.checks.size(), 1U);
  EXPECT_EQ(outcome.checks[0].name, "no blade.burst");
  EXPECT_FALSE(outcome.passed());
}

TEST(APlantOfOnesOwn, IsWrittenOutWithItsDefaults) {
  Problems problems;
  const auto scenario = scenario::read_scenario_text(wheel_scenario, "wheel.yaml", {}, problems, types);
  EXPECT_THAT(scenario::expand(scenario), HasSubstr("decay: 2 s"));
}

TEST(APlantOfOnesOwn, IsCheckedLikeAnyOther) {
  Problems problems;
  scenario::read_scenario_text(
      "scene: {title: A wheel}\nplants: {wheel: {type: flywheel, decy: 1 s, speed: 2 m}}\n", "wheel.yaml", {},
      problems, types);
  EXPECT_THAT(lines_of(problems), HasSubstr("wheel.yaml:2:34: "));
  EXPECT_THAT(lines_of(problems), HasSubstr("did you mean decay?"));
  EXPECT_THAT(lines_of(problems), HasSubstr("speed"));
}

}  // namespace
}  // namespace drycut::sim
