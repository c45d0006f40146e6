// The shipped lines stand on no counting grid: where the measuring wheel gives whole counts a sampling, every
// sampling is like the one before, and no counting noise reaches the loop.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"
#include "sim/loop/statistics.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;

/// Scenes that want their counts exact, and why.
const std::map<std::string, std::string> exact_counts = {
    {"mc_camin_eject", "the pusher waits and settles to 5 um, and set values are compared with ="},
    {"mc_camin_engage", "the jerk of the synchronisation is held to 0.01 mm/s3 beside the law's"},
    {"mc_camin_table_switch", "strokes are held to 0.1 um, and no leap of the torque may hide in noise"},
};

/// A scenario of the folder scenes, its machine built.
struct Shipped {
  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<loop::Simulation> simulation;

  explicit Shipped(const fs::path& file) : scenario(scenario::read_scenario(file, {}, problems)) {
    scenario.pictures.frames = false;
    if (problems.empty()) simulation = std::make_unique<loop::Simulation>(scenario, problems);
  }

  double parameter(const std::string& plant, const std::string& name) const {
    for (const auto& entry : scenario.plants) {
      if (entry.name.text != plant) continue;
      for (const auto& row : entry.definition->parameters()) {
        if (row.name != name) continue;
        const auto* whole = std::get_if<int*>(&row.value);
        return whole != nullptr ? **whole : **std::get_if<double*>(&row.value);
      }
    }
    ADD_FAILURE() << plant << "." << name;
    return NAN;
  }
  /// What the controller samples its counters with [s].
  double sampling() const {
    if (scenario.controller->kind() == "lx3vp") return 100e-6;
    Time longest = 0;
    for (const auto& wire : simulation->bus().analogue_wires())
      longest = std::max(longest, simulation->output_period(wire.terminal));
    return static_cast<double>(longest) * 1e-9;
  }
  /// Counts that the web's wheel gives in a sampling at a speed [m/s]. An LX3VP counts pulses, the others all
  /// four edges of each.
  double counts(const std::string& web, double speed) const {
    const double edges = scenario.controller->kind() == "lx3vp" ? 1 : 4;
    return speed * sampling() * (1 - parameter(web, "wheel.slip")) * edges * parameter(web, "wheel.lines") /
           (parameter(web, "wheel.circumference") * (1 + parameter(web, "wheel.circumference_error")));
  }
  /// Speeds that the scene gives a web, at its start or by the timeline [m/s].
  std::set<double> speeds(const std::string& web) const {
    std::set<double> all = {parameter(web, "speed")};
    for (const auto& entry : scenario.timeline)
      for (const auto* targets : {&entry.set, &entry.ramp})
        for (const auto& [target, value] : *targets) {
          if (target.text != web + ".speed") continue;
          EXPECT_EQ(value.unit, "m/min") << target.text;
          all.insert(value.number / 60);
        }
    all.erase(0);
    return all;
  }
};

/// Samplings after which the pattern of whole counts comes back, 0 if not within four.
int grid(double counts) {
  for (int n = 1; n <= 4; ++n)
    if (std::abs(n * counts - std::round(n * counts)) < 1e-6) return n;
  return 0;
}

TEST(CountingGrid, NoShippedLineStandsOnItButThoseThatWantExactCounts) {
  std::set<std::string> exact;
  int lines = 0;
  for (const auto* folder : {"scenes", "scenes/envelope", "scenes/new"})
    for (const auto& file : fs::directory_iterator(source_root / folder)) {
      if (file.path().extension() != ".yaml" || file.path().stem() == "three_way") continue;
      SCOPED_TRACE(file.path().string());
      const Shipped line(file.path());
      ASSERT_EQ(lines_of(line.problems), "");
      for (const auto& plant : line.scenario.plants) {
        if (plant.type.text != "web" || !line.scenario.controller) continue;
        ++lines;
        ASSERT_GT(line.sampling(), 0);
        for (const double speed : line.speeds(plant.name.text)) {
          const int repeats = grid(line.counts(plant.name.text, speed));
          if (exact_counts.contains(file.path().stem()))
            exact.insert(repeats == 0 ? "" : file.path().stem());
          else
            EXPECT_EQ(repeats, 0) << speed * 60 << " m/min: " << line.counts(plant.name.text, speed)
                                  << " counts a sampling";
        }
      }
    }
  EXPECT_GT(lines, 45);
  for (const auto& [name, why] : exact_counts) EXPECT_TRUE(exact.contains(name)) << name << ": " << why;
}

// Where the loop was silent, and where it is not.
TEST(CountingGrid, IsThatOfTheRoundSpeeds) {
  const Shipped knife(source_root / "scenes/rotary_knife_mc_camin.yaml");
  EXPECT_DOUBLE_EQ(knife.counts("web", 1), 80);
  EXPECT_EQ(grid(knife.counts("web", 1)), 1);
  EXPECT_EQ(grid(knife.counts("web", 60.4 / 60)), 0);
  const Shipped saw(source_root / "scenes/flying_saw.yaml");
  EXPECT_EQ(grid(saw.counts("tube", 40.0 / 60)), 3) << "106, 107, 107 counts";
}

// docs/maximum_speed.md tells it: 3.90 N m and 5.28 N m.
TEST(CountingGrid, CostsAThirdOfThePeakTorqueBesideIt) {
  std::map<double, double> peaks;  // [N m] by speed [m/min]
  for (const double speed : {60.0, 60.4}) {
    Problems problems;
    auto scenario = scenario::read_scenario(source_root / "scenes/rotary_knife.yaml",
                                            {{"plants.web.speed", std::to_string(speed) + " m/min"},
                                             {"plants.web.wheel.eccentricity", "0 mm"},
                                             {"plants.web.wheel.slip", "0 %"},
                                             {"plants.web.wheel.circumference_error", "0 %"},
                                             {"plants.knife.encoder.eccentricity", "0 deg"}},
                                            problems);
    ASSERT_EQ(lines_of(problems), "");
    scenario.pictures.frames = false;
    loop::Simulation simulation(scenario, problems);
    simulation.run();
    const auto& torque = simulation.recording().column("knife.motor.torque")->values;
    for (std::size_t i = 2000; i < torque.size(); ++i)  // from 4 s on
      peaks[speed] = std::max(peaks[speed], std::abs(static_cast<double>(torque[i])));
  }
  EXPECT_NEAR(peaks[60.0], 3.90, 0.01);
  EXPECT_NEAR(peaks[60.4], 5.28, 0.01);
}

// What the report of `make demo` says of the pieces, as a customer reads it.
TEST(DemoLine, ItsPiecesHaveTheSpreadOfARealLine) {
  Shipped line(source_root / "scenes/rotary_knife.yaml");
  ASSERT_EQ(lines_of(line.problems), "");
  const auto outcome = line.simulation->run();
  EXPECT_TRUE(outcome.passed());
  const auto lengths = loop::event_numbers(line.simulation->recording().events(), "cut", "length", 4).numbers;
  ASSERT_GE(lengths.size(), 10U);  // fewer have no Cpk
  const auto found = loop::statistics(lengths);
  // The wheel's axis lies 0.02 mm beside its middle: a sine of 2 e sin(800 mm / 2r), and its counts add
  // theirs.
  const double eccentric = 2 * 0.02 * std::abs(std::sin(3.14159265 * 800 / 500)) / std::sqrt(2);
  EXPECT_NEAR(found[0] - 800, 800 * (1 - 0.00027 - (1 - 0.0003)), 0.02);  // the mean: slip and circumference
  EXPECT_GT(found[3], 0.7 * eccentric);
  EXPECT_LT(found[3], 2 * eccentric);
  const auto capability = loop::capability(found, 799.8, 800.2);
  ASSERT_TRUE(capability);
  EXPECT_GT(capability->cpk, 1.33);
  EXPECT_LT(capability->cpk, 5) << "nobody believes that";
  // No drive at its limit, the search of home included.
  for (const auto& event : line.simulation->recording().events()) EXPECT_NE(event.event, "saturated");
}

}  // namespace
}  // namespace drycut::sim
