#include "sim/studies/fit/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/parallel.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/fit/noise.hpp"
#include "sim/studies/fit/words.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::string_view torque_constant = "servo.torque_constant";

bool is_of_spring(const FitPath& path) { return shows(path) == Shows::in_bending; }

/// Values that show only where the motion begins, turns or stands.
bool shows_at_standstill(const FitPath& path) {
  return is_of_spring(path) || shows(path) == Shows::at_low_speed;
}

void begin(scenario::Scenario& machine, const ReplaySeries& series, bool closed) {
  if (series.start) set_quantity(machine, {series.plant, "start"}, *series.start);
  if (closed) {
    for (auto& input : machine.inputs) input.recording.text = std::filesystem::absolute(series.file).string();
    return;
  }
  // No end stop is in the way of what moved.
  constexpr double far = 1e3;
  set_quantity(machine, {series.plant, "travel_min"}, -far);
  set_quantity(machine, {series.plant, "travel_max"}, far);
}

}  // namespace

FitBench::FitBench(const FitQuestion& question, const std::vector<ReplaySeries>& recordings, int jobs,
                   bool standstill)
    : question_(question),
      recordings_(recordings),
      jobs_(jobs),
      standstill_(standstill || std::ranges::any_of(question.vary, shows_at_standstill)),
      springs_(std::ranges::any_of(question.vary, is_of_spring)) {
  collect_unknowns();
  auto machine = take_machine();
  for (const auto& series : recordings) {
    begin(*machine, series, question.closed);
    about_.push_back(question.closed ? Plausible{} : measure_answer(*machine, series));
  }
  give_back(std::move(machine));
}

void FitBench::collect_unknowns() {
  auto machine = take_machine();
  for (const auto& path : question_.vary) {
    plants::Parameters rows;
    const auto* row = quantity_at(*machine, path, rows);
    if (row == nullptr) throw std::runtime_error(path.text() + " is no quantity of the machine");
    auto& one = unknowns_.emplace_back(FitUnknown{*std::get<double*>(row->value),
                                                  scenario::to_si(row->min, row->unit),
                                                  scenario::to_si(row->max, row->unit)});
    // A stiffness of 0 is none that is known.
    constexpr double far = 100;
    const bool is_scale = path.row.ends_with("stiffness") || path.row == torque_constant;
    one.never_zero = is_scale || shows(path) == Shows::in_acceleration;
    if (is_scale) {
      one.low = one.start / far;
      one.high = one.start * far;
    }
    units_.emplace_back(row->unit);
  }
  give_back(std::move(machine));
  double most = 0;
  for (const auto& one : recordings_)
    for (const double torque : one.torque.value) most = std::max(most, std::abs(torque));
  unknowns_.push_back({0, -most, most});
  constexpr double samples = 20;
  for (const auto& one : recordings_) {
    const double longest = samples * one.sampling;
    torque_delays_.push_back(unknowns_.size());
    unknowns_.push_back({0, -longest, longest});
    load_delays_.push_back(one.load ? std::optional(unknowns_.size()) : std::nullopt);
    if (one.load) unknowns_.push_back({0, -longest, longest});
    auto& shares = shares_.emplace_back();
    for (std::size_t i = 0; i < one.inputs.size(); ++i) {
      constexpr double most_share = 3;
      shares.push_back(one.is_effort(i) ? std::optional(unknowns_.size()) : std::nullopt);
      if (shares.back()) unknowns_.push_back({1, -most_share, most_share});
    }
  }
}

std::unique_ptr<scenario::Scenario> FitBench::take_machine(const std::vector<double>& set,
                                                           std::size_t recording) {
  auto machine = take_machine();
  for (std::size_t i = 0; i < values(); ++i) set_quantity(*machine, question_.vary[i], set[i]);
  begin(*machine, recordings_[recording], question_.closed);
  return machine;
}

Plausible FitBench::answer_with(const std::vector<double>& set) {
  auto machine = take_machine(set, 0);
  const auto answer = measure_answer(*machine, recordings_.front());
  give_back(std::move(machine));
  return answer;
}

double FitBench::resolved(std::size_t recording) const {
  return resolved_up_to(recordings_[recording], about_[recording], noise_share());
}

FitUnknown FitBench::fix(std::size_t number, double value) {
  return std::exchange(unknowns_[number], {value, value, value});
}

std::vector<double> FitBench::start() const {
  std::vector<double> start;
  for (const auto& one : unknowns_) start.push_back(one.start);
  return start;
}

ReplayErrors FitBench::errors_of(const std::vector<double>& set, std::size_t recording) const {
  ReplayErrors errors;
  errors.torque_offset = set[torque_offset()];
  errors.torque_delay = set[torque_delays_[recording]];
  if (const auto load = load_delays_[recording]) errors.load_delay = set[*load];
  for (const auto& share : shares_[recording]) errors.shares.push_back(share ? set[*share] : 1);
  for (std::size_t i = 0; i < values(); ++i)
    if (question_.vary[i].row == torque_constant) errors.torque_scale = set[i] / unknowns_[i].start;
  return errors;
}

std::unique_ptr<scenario::Scenario> FitBench::take_machine() {
  {
    const std::scoped_lock lock(mutex_);
    if (!free_.empty()) {
      auto machine = std::move(free_.back());
      free_.pop_back();
      return machine;
    }
  }
  Problems problems;
  auto machine = std::make_unique<scenario::Scenario>(
      scenario::read_scenario_text(question_.text, question_.file, question_.set, problems));
  if (!problems.empty()) throw std::runtime_error(problems.front().what);
  if (question_.closed) {
    strip_onlookers(*machine);
    return machine;
  }
  strip(*machine);
  if (!make_source_of_torque(*machine, question_.plant))
    throw std::runtime_error(fmt::format("{} has no servo", question_.plant));
  make_rigid(*machine, question_.plant);
  return machine;
}

void FitBench::give_back(std::unique_ptr<scenario::Scenario> machine) {
  const std::scoped_lock lock(mutex_);
  free_.push_back(std::move(machine));
}

std::optional<Replayed> FitBench::replay_one(const std::vector<double>& set, std::size_t recording,
                                             double cutoff) {
  auto machine = take_machine(set, recording);
  std::optional<Replayed> found;
  if (is_sound(*machine))
    found = studies::replay(*machine, recordings_[recording],
                            {cutoff, about_[recording], standstill_, question_.closed},
                            errors_of(set, recording));
  give_back(std::move(machine));
  return found;
}

std::vector<FitBench::OfRecordings> FitBench::replay(const std::vector<std::vector<double>>& sets,
                                                     double cutoff) {
  const auto count = recordings_.size();
  std::vector<OfRecordings> all(sets.size(), OfRecordings(count));
  runs_ += sets.size() * count;
  for_each_index(sets.size() * count, jobs_, [&](std::size_t job) {
    all[job / count][job % count] = replay_one(sets[job / count], job % count, cutoff);
  });
  return all;
}

}  // namespace drycut::sim::studies
