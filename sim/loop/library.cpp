// The library's front, include/drycut/simulation.hpp, before the simulation that the program runs.
#include "sim/loop/library.hpp"

#include <fmt/format.h>

#include <drycut/simulation.hpp>

#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/text.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/loop/live_parameters.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/units.hpp"

namespace drycut {

namespace {

std::string lines_of(const Problems& problems) {
  std::string lines;
  for (const auto& problem : problems) lines += (lines.empty() ? "" : "\n") + to_string(problem);
  return lines;
}

sim::scenario::Scenario without_records(sim::scenario::Scenario scenario) {
  scenario.record.channels.clear();
  return scenario;
}

}  // namespace

BadInput::BadInput(Problems found) : std::invalid_argument(lines_of(found)), problems(std::move(found)) {}

sim::scenario::Scenario sim::read_for_program(const std::filesystem::path& file,
                                              const std::map<std::string, std::string>& set) {
  std::vector<scenario::Override> overrides;
  overrides.reserve(set.size());
  for (const auto& [path, value] : set) overrides.push_back({path, value});
  Problems problems;
  auto scenario = scenario::read_scenario(file, overrides, problems);
  if (!problems.empty()) throw BadInput(problems);
  scenario.pictures = {};
  return scenario;
}

/// Events are kept here until they are taken, and nothing else of what is recorded.
struct Simulation::Run : sim::record::Observer {
  Run(const std::filesystem::path& file, const std::map<std::string, std::string>& set)
      : scenario(without_records(sim::read_for_program(file, set))), simulation(scenario, problems) {
    if (!problems.empty()) throw BadInput(problems);
    simulation.keep_nothing();
    simulation.add(*this);
  }

  void happened(const sim::record::RecordedEvent& recorded) override {
    Event event{recorded.at_seconds(), recorded.source, recorded.event, {}, recorded.text};
    for (const auto& value : recorded.values) event.values.emplace(value.name, value.number);
    events.push_back(std::move(event));
  }

  /// nullptr if there is none of that name.
  const sim::loop::Reading* find_reading(const std::string& name) {
    const auto known = readings.find(name);
    if (known != readings.end()) return &known->second;
    auto found = simulation.names().reading(name);
    return found ? &readings.emplace(name, std::move(*found)).first->second : nullptr;
  }

  const sim::loop::Reading& reading(const std::string& name) {
    if (const auto* found = find_reading(name)) return *found;
    throw BadInput(
        fmt::format("there is no channel {}; {}", in_quotes(name), simulation.names().suggest_reading(name)));
  }

  const sim::loop::Target& target(const std::string& name) {
    const auto known = targets.find(name);
    if (known != targets.end()) return known->second;
    auto found = simulation.names().target(name);
    if (!found)
      throw BadInput(fmt::format("nothing called {} can be set; {}", in_quotes(name),
                                 simulation.names().suggest_target(name)));
    if (simulation.names().is_driven(name))
      throw BadInput(fmt::format("{} is driven by {}; leave that out", in_quotes(name),
                                 simulation.names().driven_by(name)));
    return targets.emplace(name, std::move(*found)).first->second;
  }

  void step() {
    if (!simulation.advance()) throw Diverged(simulation.failure());
  }

  Problems problems;
  sim::scenario::Scenario scenario;
  sim::loop::Simulation simulation;
  std::unordered_map<std::string, sim::loop::Reading> readings;
  std::unordered_map<std::string, sim::loop::Target> targets;
  std::vector<Event> events;  ///< since they were taken last
};

Simulation::Simulation(const std::filesystem::path& scenario, const std::map<std::string, std::string>& set)
    : run_(std::make_unique<Run>(scenario, set)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::step() { run_->step(); }

void Simulation::advance(double seconds, const std::function<void()>& meanwhile) {
  constexpr long long often = 4096;
  constexpr double longest = 1e9;
  if (!(seconds >= 0 && seconds <= longest))
    throw BadInput(fmt::format("{} s cannot be simulated; give 0 to {} s", seconds, longest));
  const auto steps = std::llround(seconds / step_length());
  for (long long i = 1; i <= steps; ++i) {
    run_->step();
    if (i % often == 0 && meanwhile) meanwhile();
  }
}

double Simulation::time() const { return sim::seconds(run_->simulation.time()); }
double Simulation::step_length() const { return sim::seconds(run_->scenario.scene.step); }
double Simulation::duration() const { return sim::seconds(run_->scenario.scene.duration); }

std::vector<std::string> Simulation::names() const { return run_->simulation.names().reading_names(); }

double Simulation::read(const std::string& name) { return run_->reading(name).read(); }

std::string Simulation::unit(const std::string& name) {
  if (const auto* reading = run_->find_reading(name)) return reading->unit;
  return run_->target(name).unit;
}

void Simulation::write(const std::string& name, double value) {
  const auto& target = run_->target(name);
  const double si = target.unit.empty() ? value : sim::scenario::to_si(value, target.unit);
  auto fault = target.misfit(value);
  if (!fault) fault = sim::loop::objection_to(run_->scenario, name, si);
  if (fault) throw BadInput(fault->what + "; " + fault->remedy);
  target.write(si);
}

std::vector<std::byte> Simulation::save() { return run_->simulation.save(); }

void Simulation::restore(const std::vector<std::byte>& moment) {
  try {
    run_->simulation.restore(moment);
  } catch (const BadState& bad) {
    throw BadInput(std::string("this moment cannot be restored: ") + bad.what());
  }
  run_->events.clear();
}

std::vector<Event> Simulation::take_events() { return std::exchange(run_->events, {}); }

std::vector<Check> Simulation::checks() { return run_->simulation.outcome().checks; }

}  // namespace drycut
