#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/plants/plants_lookup.hpp"
#include "tests/plants/witness/cvode.hpp"
#include "tests/plants/witness/laws.hpp"

namespace drycut::plants::witness {

inline constexpr double sample = 1e-3;  // [s]
inline constexpr int samples = 2000;

/// Largest difference of both, in travels.
inline double difference(const Track& one, const Track& other) {
  double most = 0;
  for (std::size_t i = 0; i < one.load.size(); ++i)
    most = std::max({most, std::abs(one.load[i] - other.load[i]), std::abs(one.motor[i] - other.motor[i])});
  return most / one.travel();
}

/// What CVODE makes of a law.
template <class Law>
Track track_of(Law& law, double tolerance = 1e-10) {
  Track track;
  Cvode solver(law, tolerance);
  for (int i = 1; i <= samples; ++i) {
    solver.run_to(i * sample);
    law.record(solver.state(), track);
    if (law.motion.follow(i * sample)) solver.restart();
  }
  return track;
}

/// What a plant does in steps of `dt` seconds. A voltage that is held for a step stands for its middle.
template <class Unit>
Track track_of(Unit&& unit, Motion motion, double dt) {
  Track track;
  double& volts = unit.template plug<ReferencePort>("servo.reference").volts;
  const auto steps = std::lround(sample / dt);
  for (int i = 0; i < samples; ++i) {
    if (motion.follow(i * sample) || i == 0) unit.process(motion.force());
    for (long step = 0; step < steps; ++step) {
      volts = motion.volts(i * sample + (static_cast<double>(step) + 0.5) * dt);
      unit.step(dt);
    }
    unit.record(track);
  }
  EXPECT_EQ(unit.world.failure(), "");
  return track;
}

/// The same for ever shorter steps, from a track and that of steps half as long: what is wrong in proportion
/// to the step is gone.
inline Track extrapolated(const Track& coarse, const Track& fine) {
  Track limit = fine;
  for (std::size_t i = 0; i < fine.load.size(); ++i) {
    limit.motor[i] += fine.motor[i] - coarse.motor[i];
    limit.load[i] += fine.load[i] - coarse.load[i];
  }
  return limit;
}

/// A term that a law has wrong: the comparison must see it.
template <class Law>
struct Mistake {
  const char* name;
  void (*make)(Law& law);
};

inline constexpr double agreed = 1e-5;  // of the travel

/// The plant that `unit` builds and the law that `law` builds agree over the motion to 1e-5 of the travel in
/// steps of `dt` seconds, and differ by the step alone: twice as much in steps twice as long, `in_limit` of
/// the travel extrapolated. With one of the mistakes they do not agree.
template <class Law, class MakeUnit, class MakeLaw>
void expect_witness(MakeUnit unit, MakeLaw law, double dt, double in_limit,
                    const std::vector<Mistake<Law>>& mistakes) {
  const auto witness = [&law](double tolerance, void (*change)(Law&)) {
    const auto own = law();
    if (change != nullptr) change(*own);
    return track_of(*own, tolerance);
  };
  const auto told = [](const std::string& name, double found) {
    testing::Test::RecordProperty(name, fmt::format("{:.3g}", found));
    return found;
  };
  const Track truth = witness(1e-10, nullptr);
  EXPECT_LT(told("looser witness", difference(truth, witness(1e-9, nullptr))), agreed / 1000);

  std::vector<Track> plant;
  std::vector<double> found;
  for (const double times : {4, 2, 1}) {
    plant.push_back(track_of(*unit(), law()->motion, dt * times));
    found.push_back(told(fmt::format("steps of {:g} us", dt * times * 1e6), difference(truth, plant.back())));
  }
  EXPECT_NEAR(found[0] / found[1], 2, 0.3);
  EXPECT_NEAR(found[1] / found[2], 2, 0.3);
  EXPECT_LT(found[2], agreed);
  const Track limit = extrapolated(plant[1], plant[2]);
  EXPECT_LT(told("extrapolated", difference(truth, limit)), in_limit);

  for (const Mistake<Law>& mistake : mistakes)
    EXPECT_GT(told(mistake.name, difference(limit, witness(1e-9, mistake.make))), 2 * in_limit)
        << mistake.name;
}

}  // namespace drycut::plants::witness
