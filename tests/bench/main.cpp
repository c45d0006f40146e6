// make bench: how long a physics step of a rotary knife line takes, everything included, beside other engines
// that step only its bare mechanism, and beside a floor, the same knife as one straight loop. All in one
// program, one after the other in rounds, so that the ratios mean something on a busy machine; of a run the
// smallest time of its rounds counts, of three runs the median, and the spread is told.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"
#include "tests/bench/fmi.hpp"
#include "tests/bench/mechanism.hpp"
#include "tests/bench/recording.hpp"

namespace {

using namespace drycut;

constexpr std::size_t runs = 3;
constexpr int rounds = 7;         // of a run
constexpr double simulated = 20;  // [s] a round

using Figures = std::array<double, runs>;

struct Row {
  std::string name;
  std::function<void()> run;
  Figures best;  // of each run [s]
};

Figures sorted(Figures figures) {
  std::ranges::sort(figures);
  return figures;
}
double median(const Figures& figures) { return sorted(figures)[runs / 2]; }

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
  bench::Followed floor;
  std::vector<Row> rows = {{"drycut, the whole closed loop with recording and checks", run_line, {}},
                           {"the same, a state of it kept every second", run_line_with_states, {}},
                           {"floor: the same knife as one straight loop of C++",
                            [&] { floor = bench::run_floor(mechanism, steps); },
                            {}},
                           {"stock Bullet, bare mechanism, hinges and slider",
                            [&] { bullet_speed = bench::run_bullet(mechanism, steps); },
                            {}}};
#ifdef DRYCUT_WITH_MUJOCO
  double mujoco_speed = 0;
  rows.push_back({"MuJoCo, bare mechanism, contacts and constraints off",
                  [&] { mujoco_speed = bench::run_mujoco(mechanism, steps); },
                  {}});
#endif
  for (std::size_t run = 0; run < runs; ++run) {
    for (auto& row : rows) row.best[run] = 1e9;
    for (int round = 0; round < rounds; ++round)
      for (auto& row : rows) row.best[run] = std::min(row.best[run], seconds_of(row.run));
  }
  fmt::print("Rotary knife line, step 100 us, {} s simulated, best of {} rounds, median of {} runs\n\n",
             simulated, rounds, runs);
  fmt::print("{:<56} {:>9} {:>12} {:>10} {:>16}\n", "", "us/step", "x real time", "ratio", "least to most");
  for (const auto& row : rows) {
    Figures ratios{};
    for (std::size_t run = 0; run < runs; ++run) ratios[run] = row.best[run] / rows.front().best[run];
    const auto spread = sorted(ratios);
    const double best = median(row.best);
    fmt::print("{:<56} {:>9.3f} {:>12.0f} {:>10.2f} {:>7.2f} to {:>5.2f}\n", row.name,
               best / static_cast<double>(steps) * 1e6, simulated / best, median(ratios), spread.front(),
               spread.back());
  }
  fmt::print(
      "\nratio: time of the row over the time of drycut; the bar is 15 for Bullet, 4.6 for MuJoCo.\n"
      "The floor has motor, drum, gear, servo, friction, encoder, cam, position loop and DAC, and a web "
      "that runs by itself.\nIt leaves out: what the blade does in the web, the web's drive, switches "
      "and zero pulses, currents, heat and DC link,\nfaults, Bullet's bodies, devices and program, "
      "wires, events, checks, recording.\n");
  fmt::print("drum speed at the end: Bullet {:.6f} rad/s", bullet_speed);
#ifdef DRYCUT_WITH_MUJOCO
  fmt::print(", MuJoCo {:.6f} rad/s", mujoco_speed);
#endif
  fmt::print("; the floor's motor: {:.3f} turns, at most {:.3f} mm from its cam\n", floor.turns,
             floor.error * 1e3);
  fmt::print("a state of the line in memory, kept and come back to: {:.0f} us, the bar is 50 us\n",
             state_there_and_back() * 1e6);
  double recorded = 1e9;
  for (int round = 0; round < rounds; ++round) recorded = std::min(recorded, bench::write_hdf5());
  fmt::print("trace.h5, 10^6 rows of 30 channels: {:.2f} s of the processor, the bar is 1 s\n", recorded);
  bench::print_fmi_cost(rounds);
}
