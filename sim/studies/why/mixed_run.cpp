#include "sim/studies/why/mixed_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/interrupt.hpp"
#include "sim/loop/names.hpp"
#include "sim/parallel.hpp"

namespace drycut::sim::studies {

TrialCame FailedCheck::of(const record::Outcome& outcome) const {
  if (name.empty() && !outcome.failure.empty()) return TrialCame::failed;
  if (outcome.passed()) return TrialCame::passed;
  const auto* check = find_check(outcome, name);
  const bool fails = outcome.failure.empty() && check != nullptr && !check->passed;
  return fails ? TrialCame::failed : TrialCame::unresolved;
}

std::optional<FailedCheck> first_failed(const record::Outcome& outcome) {
  if (!outcome.failure.empty()) return FailedCheck{""};
  const record::CheckResult* first = nullptr;
  const auto when = [](const record::CheckResult& check) {
    return check.failed_at.value_or(std::numeric_limits<double>::infinity());
  };
  for (const auto& check : outcome.checks)
    if (!check.passed && (first == nullptr || when(check) < when(*first))) first = &check;
  if (first == nullptr) return {};
  return FailedCheck{first->name};
}

const record::CheckResult* find_check(const record::Outcome& outcome, const std::string& name) {
  const auto found = std::ranges::find(outcome.checks, name, &record::CheckResult::name);
  return found == outcome.checks.end() ? nullptr : &*found;
}

MixedRun::MixedRun(const Mixture::Made& made, const std::vector<std::string>* channels) : use_(files_) {
  for (const auto& [name, text] : made.files) files_.files[name] = {FileSet::State::present, text};
  scenario_ = scenario::read_scenario_text(made.text, made.file, {}, problems_);
  scenario_.pictures = {};
  if (!problems_.empty()) return;
  simulation_ = std::make_unique<loop::Simulation>(scenario_, problems_);
  if (channels == nullptr) {
    simulation_->keep_nothing();
    return;
  }
  std::vector<scenario::Text> more;
  for (const auto& name : *channels) {
    const auto is_it = [&](const auto& channel) { return channel.text == name; };
    const bool known =
        std::ranges::any_of(scenario_.record.channels, is_it) || std::ranges::any_of(more, is_it);
    if (!known && simulation_->names().reading(name)) more.push_back({name, {1, 1, 0}, {}});
  }
  if (more.empty()) return;
  auto& recorded = scenario_.record.channels;
  recorded.insert(recorded.end(), more.begin(), more.end());
  simulation_ = std::make_unique<loop::Simulation>(scenario_, problems_);
}

record::Outcome MixedRun::run() {
  return simulation_->run([](Time) { InterruptWatch::check_progress(); });
}

MixedTrials::MixedTrials(const Mixture& mixture, FailedCheck check, int budget, int jobs, Progress progress)
    : mixture_(mixture),
      check_(std::move(check)),
      budget_(budget),
      jobs_(jobs),
      progress_(std::move(progress)) {}

MixedTrials::Trial MixedTrials::one(const Subset& set) const {
  MixedRun mixed(mixture_.with(set));
  if (!mixed.problems().empty()) return {TrialCame::unresolved, to_string(mixed.problems().front())};
  const auto outcome = mixed.run();
  Trial trial{check_.of(outcome), ""};
  if (trial.came != TrialCame::unresolved) return trial;
  if (const auto other = first_failed(outcome))
    trial.note = outcome.failure.empty() ? fmt::format("check '{}' fails", other->name) : outcome.failure;
  return trial;
}

std::vector<TrialCame> MixedTrials::run(const std::vector<Subset>& sets) {
  std::vector<Subset> open;
  for (const auto& set : sets)
    if (find(set) == nullptr && std::ranges::find(open, set) == open.end()) open.push_back(set);
  if (std::ssize(open) > left()) open.resize(static_cast<std::size_t>(left()));
  std::vector<Trial> came(open.size());
  for_each_index(open.size(), jobs_, [&](std::size_t i) { came[i] = one(open[i]); });
  for (std::size_t i = 0; i < open.size(); ++i) trials_.emplace(open[i], std::move(came[i]));
  runs_ += static_cast<int>(open.size());
  progress_(runs_);
  std::vector<TrialCame> answers;
  for (const auto& set : sets) {
    const auto* trial = find(set);
    if (trial == nullptr) break;
    answers.push_back(trial->came);
  }
  return answers;
}

const MixedTrials::Trial* MixedTrials::find(const Subset& set) const {
  const auto found = trials_.find(set);
  return found == trials_.end() ? nullptr : &found->second;
}

bool MixedTrials::take() {
  if (left() <= 0) return false;
  ++runs_;
  progress_(runs_);
  return true;
}

}  // namespace drycut::sim::studies
