// make bench: how long a physics step of a rotary knife line takes, everything included, beside other engines
// that step only its bare mechanism. All in one run, one after the other in rounds, so that the ratios mean
// something on a busy machine; the smallest time of the rounds counts.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"
#include "tests/bench/mechanism.hpp"
#include "tests/bench/recording.hpp"

namespace {

using namespace drycut;

constexpr int rounds = 7;
constexpr double simulated = 20;  // [s] a round

struct Row {
  std::string name;
  std::function<void()> run;
  std::int64_t steps = 0;
  double best = 1e9;  // [s]
};

double seconds_of(const std::function<void()>& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// `use` of the frozen line, its closed loop with devices, program, checks and recording, without pictures.
void with_line(const std::function<void(sim::loop::Simulation&)>& use) {
  Problems problems;
  const std::vector<sim::scenario::Override> overrides = {{"scene.duration", fmt::format("{} s", simulated)},
                                                          {"pictures", "{}"}};
  const auto scenario =
      sim::scenario::read_scenario(DRYCUT_SOURCE_DIR "/tests/bench/line.yaml", overrides, problems);
  sim::loop::Simulation simulation(scenario, problems);
  for (const auto& problem : problems) fmt::print(stderr, "{}\n", to_string(problem));
  if (!problems.empty()) std::exit(2);
  use(simulation);
}

void run_line() {
  with_line([](auto& simulation) { simulation.run(); });
}

void run_line_with_states() {
  with_line([](auto& simulation) {
    StateArchive::Bytes state;
    simulation.keep_states(sim::second, true, [&] { state = simulation.save(); });
    simulation.run();
  });
}

/// To keep its state and to come back to it [s].
double state_there_and_back() {
  double best = 1e9;
  with_line([&](auto& simulation) {
    simulation.run();
    for (int round = 0; round < 1000; ++round)
      best = std::min(best, seconds_of([&] { simulation.restore(simulation.save()); }));
  });
  return best;
}

}  // namespace

int main() {
  const bench::Mechanism mechanism;
  const auto steps = static_cast<std::int64_t>(simulated / mechanism.step);
  double bullet_speed = 0;
  std::vector<Row> rows = {{"drycut, the whole closed loop with recording and checks", run_line, steps},
                           {"the same, a state of it kept every second", run_line_with_states, steps},
                           {"stock Bullet, bare mechanism, hinges and slider",
                            [&] { bullet_speed = bench::run_bullet(mechanism, steps); }, steps}};
#ifdef DRYCUT_WITH_MUJOCO
  double mujoco_speed = 0;
  rows.push_back({"MuJoCo, bare mechanism, contacts and constraints off",
                  [&] { mujoco_speed = bench::run_mujoco(mechanism, steps); }, steps});
#endif
  for (int round = 0; round < rounds; ++round) {
    for (auto& row : rows) row.best = std::min(row.best, seconds_of(row.run));
  }
  fmt::print("Rotary knife line, step 100 us, {} s simulated, best of {} rounds\n\n", simulated, rounds);
  fmt::print("{:<56} {:>9} {:>12} {:>10}\n", "", "us/step", "x real time", "ratio");
  for (const auto& row : rows) {
    fmt::print("{:<56} {:>9.3f} {:>12.0f} {:>10.2f}\n", row.name,
               row.best / static_cast<double>(row.steps) * 1e6, simulated / row.best,
               row.best / rows.front().best);
  }
  fmt::print("\nratio: time of the row over the time of drycut; the bar is 4 for Bullet, 1.67 for MuJoCo.\n");
  fmt::print("drum speed at the end: Bullet {:.6f} rad/s", bullet_speed);
#ifdef DRYCUT_WITH_MUJOCO
  fmt::print(", MuJoCo {:.6f} rad/s", mujoco_speed);
#endif
  fmt::print("\n");
  fmt::print("a state of the line in memory, kept and come back to: {:.0f} us, the bar is 50 us\n",
             state_there_and_back() * 1e6);
  double recorded = 1e9;
  for (int round = 0; round < rounds; ++round) recorded = std::min(recorded, bench::write_hdf5());
  fmt::print("trace.h5, 10^6 rows of 30 channels: {:.2f} s of the processor, the bar is 1 s\n", recorded);
}
