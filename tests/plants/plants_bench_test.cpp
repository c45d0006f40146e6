#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "plants/bench.hpp"
#include "plants/ideal_axis.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

TEST(ExactSum, KeepsWhatRoundingTakesAway) {
  ExactSum sum;
  double plain = 0;
  for (int i = 0; i < 10000000; ++i) {
    sum.add(0.1);
    plain += 0.1;
  }
  EXPECT_NEAR(sum.value(), 1e6, 1e-9);
  EXPECT_GT(std::abs(plain - 1e6), 1e-5);
}

TEST(Bench, CountersTurnAtTheirRate) {
  Bench bench;
  set(bench, "counter1.rate", 12345);
  set(bench, "counter2.rate", -777);
  for (int i = 0; i < 1000000; ++i) bench.sense(h);
  EXPECT_EQ(plug<EncoderPort>(bench, "counter1").count, 1234500);
  EXPECT_EQ(plug<EncoderPort>(bench, "counter2").count, -77700);
  EXPECT_EQ(plug<EncoderPort>(bench, "counter3").count, 0);
  EXPECT_EQ(channel(bench, "counter1.count"), 1234500);
  EXPECT_EQ(channel(bench, "counter2.rate"), -777);
}

TEST(Bench, CountStepsAtOnceAndGoesOnFromThere) {
  Bench bench;
  set(bench, "counter1.rate", 10000);
  bench.sense(h);
  set(bench, "counter1.count", -5000);
  auto& port = plug<EncoderPort>(bench, "counter1");
  EXPECT_EQ(port.count, -5000);
  bench.sense(h);
  EXPECT_EQ(port.count, -4999);
}

TEST(Bench, IndexPulseLatchesTheCountOfItsMoment) {
  Bench bench;
  set(bench, "counter1.rate", 50000);
  for (int i = 0; i < 20; ++i) bench.sense(h);
  auto& index = plug<SignalPort>(bench, "counter1.index");
  EXPECT_EQ(index.edges.size(), 0U);
  set(bench, "counter1.index", 1);
  bench.sense(h);
  ASSERT_EQ(index.edges.size(), 2U);
  EXPECT_TRUE(index.edges[0].rising);
  EXPECT_EQ(plug<EncoderPort>(bench, "counter1").count_at(index.edges[0].fraction), 100);
  EXPECT_EQ(channel(bench, "counter1.index"), 1);
  bench.sense(h);
  EXPECT_EQ(index.edges.size(), 0U);
}

TEST(Bench, EveryIndexPulseOfAStepIsGiven) {
  Bench bench;
  for (int i = 0; i < 20; ++i) set(bench, "counter1.index", 1);
  bench.sense(h);
  EXPECT_EQ(plug<SignalPort>(bench, "counter1.index").edges.size(), 40U);
  EXPECT_EQ(channel(bench, "counter1.index"), 20);
}

TEST(Bench, InputsShowAtOnceAndGiveOneEdge) {
  Bench bench;
  auto& input = plug<SignalPort>(bench, "input16");
  set(bench, "input16", 1);
  EXPECT_TRUE(input.level);
  bench.sense(h);
  ASSERT_EQ(input.edges.size(), 1U);
  EXPECT_TRUE(input.edges[0].rising);
  EXPECT_EQ(input.edges[0].fraction, 0);
  bench.sense(h);
  EXPECT_EQ(input.edges.size(), 0U);
  set(bench, "input16", 0);
  bench.sense(h);
  EXPECT_FALSE(input.edges[0].rising);
  EXPECT_EQ(channel(bench, "input16"), 0);
}

TEST(Bench, RecordsWhatTheControllerPutsOut) {
  Bench bench;
  plug<CommandPort>(bench, "output7").level = true;
  plug<ReferencePort>(bench, "analogue2").volts = -3.5;
  EXPECT_EQ(channel(bench, "output7"), 1);
  EXPECT_EQ(channel(bench, "output8"), 0);
  EXPECT_EQ(channel(bench, "analogue2"), -3.5);
  EXPECT_EQ(bench.ports().size(), 4U * 2 + 16 + 16 + 4);
}

struct Ideal {
  World world;
  IdealAxis axis;
  ReferencePort& reference;
  EncoderPort& encoder;
  explicit Ideal(const IdealAxisData& data = {})
      : axis(data, world),
        reference(plug<ReferencePort>(axis, "reference")),
        encoder(plug<EncoderPort>(axis, "encoder")) {}
  void run(int steps) {
    for (int i = 0; i < steps; ++i) axis.sense(h);
  }
};

TEST(IdealAxis, VoltageIsSpeedExactlyAndDoesNotDrift) {
  Ideal ideal;
  ideal.reference.volts = 3.3;
  ideal.run(3000000);  // 330 mm/s, 300 s
  EXPECT_EQ(channel(ideal.axis, "speed"), 330);
  EXPECT_NEAR(channel(ideal.axis, "position"), 99000, 1e-7);
  EXPECT_EQ(ideal.encoder.count, 9900000);
  ideal.reference.volts = -3.3;
  ideal.run(3000000);
  EXPECT_NEAR(ideal.encoder.now, 0, 1e-6);
  ideal.reference.volts = 20;  // the input ends at 10 V
  ideal.run(1);
  EXPECT_EQ(channel(ideal.axis, "speed"), 1000);
}

TEST(IdealAxis, IndexComesOnceAPitch) {
  for (const bool reverse : {false, true}) {
    IdealAxisData data;
    data.reverse = reverse;
    Ideal ideal(data);
    auto& index = plug<SignalPort>(ideal.axis, "encoder.index");
    ideal.reference.volts = 7.7;
    int pulses = 0;
    for (int i = 0; i < 10000; ++i) {
      ideal.run(1);
      if (index.edges.empty()) continue;
      ++pulses;
      EXPECT_EQ(ideal.encoder.count_at(index.edges[0].fraction), (reverse ? -1 : 1) * 4000 * pulses);
    }
    EXPECT_EQ(pulses, 19);  // 770 mm
  }
}

TEST(IdealAxis, SwitchesStandAtTheirPositions) {
  IdealAxisData data;
  data.start = 0.5;
  Ideal ideal(data);
  EXPECT_EQ(channel(ideal.axis, "switch2"), 0);
  ideal.reference.volts = 10;
  ideal.run(4960);
  EXPECT_NEAR(channel(ideal.axis, "position"), 996, 1e-6);
  EXPECT_EQ(channel(ideal.axis, "switch2"), 1);
  EXPECT_EQ(channel(ideal.axis, "switch1"), 0);
  EXPECT_EQ(ideal.encoder.count, 49600);  // 0 at the start
  ideal.run(100);
  EXPECT_EQ(channel(ideal.axis, "switch2"), 0);
  fault(ideal.axis.faults(), "switch1", "dead", 1);
  fault(ideal.axis.faults(), "encoder", "lose_counts", 100);
  ideal.run(1);
  EXPECT_EQ(ideal.encoder.count, 50610 - 100);
}

/// SI value of one display unit.
double si(std::string_view unit) {
  static const std::map<std::string_view, double> units = {{"", 1},
                                                           {"mm", 1e-3},
                                                           {"m/min", 1.0 / 60},
                                                           {"kg/m3", 1},
                                                           {"MPa", 1e6},
                                                           {"kg", 1},
                                                           {"m/s2", 1},
                                                           {"N/m", 1},
                                                           {"N s/m", 1},
                                                           {"N", 1},
                                                           {"%", 0.01},
                                                           {"kg m2", 1},
                                                           {"deg", std::acos(-1) / 180},
                                                           {"mm/s", 1e-3},
                                                           {"ms", 1e-3},
                                                           {"us", 1e-6},
                                                           {"N m", 1},
                                                           {"N m s/rad", 1},
                                                           {"rpm", std::acos(-1) / 30},
                                                           {"Hz", 1},
                                                           {"s", 1},
                                                           {"N s/m2", 1},
                                                           {"V", 1},
                                                           {"rad/s", 1},
                                                           {"N m/rad", 1},
                                                           {"N m/A", 1},
                                                           {"s2/m", 1},
                                                           {"A", 1},
                                                           {"ohm", 1},
                                                           {"W", 1},
                                                           {"K", 1},
                                                           {"degC", 1},
                                                           {"uF", 1e-6}};
  const auto found = units.find(unit);
  EXPECT_NE(found, units.end()) << "unit " << unit;
  return found == units.end() ? 1 : found->second;
}

TEST(PlantTypes, TablesAreCompleteAndTheirDefaultsLegal) {
  std::vector<std::string_view> names;
  for (const PlantType& type : plant_types()) {
    names.push_back(type.name);
    EXPECT_FALSE(type.summary.empty());
    const std::unique_ptr<PlantDefinition> definition = type.define();
    EXPECT_TRUE(definition->objections(1e-4).empty()) << type.name;
    std::set<std::string> seen;
    for (const Parameter& p : definition->parameters()) {
      SCOPED_TRACE(std::string(type.name) + " " + p.name);
      EXPECT_TRUE(seen.insert(p.name).second);
      EXPECT_FALSE(p.meaning.empty());
      if (const auto* number = std::get_if<double*>(&p.value)) {
        EXPECT_LT(p.min, p.max);
        const double zero = p.unit == "degC" ? 273.15 : 0;
        EXPECT_GE(**number, zero + p.min * si(p.unit) - 1e-12 * std::abs(p.min * si(p.unit)) - 1e-15);
        EXPECT_LE(**number, zero + p.max * si(p.unit) * (1 + 1e-12));
        EXPECT_FALSE(p.source.empty() && p.name != "gear.ratio");
      } else if (const auto* whole = std::get_if<int*>(&p.value)) {
        EXPECT_GE(**whole, p.min);
        EXPECT_LE(**whole, p.max);
      }
    }
  }
  EXPECT_THAT(names,
              testing::ElementsAre("backlash_axis", "bench", "flying_saw", "fmu", "ideal_axis", "linear_axis",
                                   "rotary_axis", "rotary_knife", "vertical_press", "web"));
}

TEST(PlantTypes, EveryPlantOffersNamesOnceWithMeanings) {
  World world;
  std::vector<std::unique_ptr<Plant>> plants;
  std::map<std::string, Plant*> by_name;
  for (const char* name : {"backlash_axis", "bench", "ideal_axis", "linear_axis", "rotary_axis", "web",
                           "rotary_knife", "flying_saw", "vertical_press", "fmu"})
    for (const PlantType& type : plant_types())
      if (type.name == name) {
        plants.push_back(type.define()->build(
            world, [&](std::string_view wanted) { return by_name.at(std::string(wanted)); }));
        by_name[name] = plants.back().get();
      }
  ASSERT_EQ(plants.size(), plant_types().size());
  for (const auto& plant : plants) {
    std::set<std::string> names;
    for (const Channel& c : plant->channels()) {
      EXPECT_TRUE(names.insert(c.name).second) << c.name;
      EXPECT_FALSE(c.meaning.empty());
      EXPECT_TRUE(std::isfinite(c.read())) << c.name;
    }
    names.clear();
    for (const Port& p : plant->ports()) EXPECT_TRUE(names.insert(p.name).second) << p.name;
    names.clear();
    for (const Setting& s : plant->settings()) {
      EXPECT_TRUE(names.insert(s.name).second) << s.name;
      s.write(1);
      EXPECT_EQ(s.read(), 1) << s.name;
    }
    names.clear();
    for (const Fault& f : plant->faults())
      EXPECT_TRUE(names.insert(f.component + "." + f.name).second) << f.name;
    names.clear();
    for (const Part& p : plant->parts()) EXPECT_TRUE(names.insert(p.name).second) << p.name;
  }
}

}  // namespace
}  // namespace drycut::plants
