#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/studies/why/mixture.hpp"

namespace drycut::sim::studies {

/// What is asked about: a check, or "" = that the simulation itself stops.
struct FailedCheck {
  std::string name;
  /// Whether it fails in a run that came to this.
  [[nodiscard]] TrialCame of(const record::Outcome& outcome) const;
};
/// Of a run that failed the check that did so first; nothing = all passed.
std::optional<FailedCheck> first_failed(const record::Outcome& outcome);
const record::CheckResult* find_check(const record::Outcome& outcome, const std::string& name);

/// A mixture put together on this thread, where its files are read in place of those on the disk.
class MixedRun {
 public:
  /// What it records is kept with `channels`, which are recorded besides those that the scenario names; those
  /// that it has not are left out.
  explicit MixedRun(const Mixture::Made& made, const std::vector<std::string>* channels = nullptr);
  /// Why there is no simulation; none = there is one.
  [[nodiscard]] const Problems& problems() const { return problems_; }
  [[nodiscard]] loop::Simulation& simulation() { return *simulation_; }
  [[nodiscard]] const scenario::Scenario& scenario() const { return scenario_; }
  /// To its end. Throws Interrupted.
  record::Outcome run();

 private:
  FileSet files_;
  UseFiles use_;
  Problems problems_;
  scenario::Scenario scenario_;
  std::unique_ptr<loop::Simulation> simulation_;
};

/// Tries sets of differences, several at the same time, each once, as long as there is budget.
class MixedTrials {
 public:
  using Progress = std::function<void(int runs)>;
  MixedTrials(const Mixture& mixture, FailedCheck check, int budget, int jobs, Progress progress);

  struct Trial {
    TrialCame came = TrialCame::unresolved;
    std::string note;  ///< why it could not be run, or what else failed
  };
  /// In the order asked; fewer where the budget ends.
  std::vector<TrialCame> run(const std::vector<Subset>& sets);
  /// One that was tried; nullptr = it was not.
  [[nodiscard]] const Trial* find(const Subset& set) const;
  [[nodiscard]] int runs() const { return runs_; }
  [[nodiscard]] int left() const { return budget_ - runs_; }
  /// Takes a run of another kind from the budget; false = there is none left.
  bool take();

 private:
  [[nodiscard]] Trial one(const Subset& set) const;

  const Mixture& mixture_;
  FailedCheck check_;
  int budget_;
  int jobs_;
  Progress progress_;
  int runs_ = 0;
  std::map<Subset, Trial> trials_;
};

}  // namespace drycut::sim::studies
