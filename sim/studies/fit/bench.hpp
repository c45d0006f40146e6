#pragma once
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "sim/studies/fit/machine.hpp"
#include "sim/studies/fit/replay.hpp"
#include "sim/studies/fit/solve.hpp"

namespace drycut::sim::studies {

/// Replays sets of values in machines of its own, on several threads. A set has the question's values [SI],
/// then the offset of the torque, then delays and shares of each recording.
class FitBench {
 public:
  /// Both outlive it. `standstill`: see ReplaySetup; it is so where what is looked for shows there. Throws
  /// std::runtime_error if the machine does not move.
  FitBench(const FitQuestion& question, const std::vector<ReplaySeries>& recordings, int jobs,
           bool standstill = false);
  [[nodiscard]] bool standstill() const { return standstill_; }

  [[nodiscard]] const std::vector<FitUnknown>& unknowns() const { return unknowns_; }
  /// Holds a number of the sets at a value; returns what it was.
  FitUnknown fix(std::size_t number, double value);
  void release(std::size_t number, const FitUnknown& unknown) { unknowns_[number] = unknown; }
  /// The scenario's values, and no error of the recordings.
  [[nodiscard]] std::vector<double> start() const;
  /// How many numbers of a set are the question's.
  [[nodiscard]] std::size_t values() const { return question_.vary.size(); }
  [[nodiscard]] const std::string& unit(std::size_t value) const { return units_[value]; }
  [[nodiscard]] std::size_t torque_offset() const { return values(); }
  [[nodiscard]] std::size_t torque_delay(std::size_t recording) const { return torque_delays_[recording]; }
  [[nodiscard]] std::optional<std::size_t> load_delay(std::size_t recording) const {
    return load_delays_[recording];
  }
  /// The share of an input of a recording that acts, where that is looked for: of a force or torque.
  [[nodiscard]] std::optional<std::size_t> share(std::size_t recording, std::size_t input) const {
    return shares_[recording][input];
  }
  [[nodiscard]] const FitQuestion& question() const { return question_; }
  [[nodiscard]] const std::vector<ReplaySeries>& recordings() const { return recordings_; }
  [[nodiscard]] std::size_t runs() const { return runs_; }
  [[nodiscard]] int jobs() const { return jobs_; }

  /// How the machine answers to the torque of its motor, with the values of the scenario and with others.
  [[nodiscard]] const Plausible& answer(std::size_t recording) const { return about_[recording]; }
  [[nodiscard]] Plausible answer_with(const std::vector<double>& set);
  /// Up to where the noise of a recorded motion is worth little of its torque [Hz]; see resolved_up_to(). A
  /// closed loop takes no torque from it.
  [[nodiscard]] double resolved(std::size_t recording) const;
  /// How much of the torque that may be: springs and play show high up, where there is little else.
  [[nodiscard]] double noise_share() const { return springs_ ? 0.1 : 0.02; }

  using OfRecordings = std::vector<std::optional<Replayed>>;
  /// Of each set each recording; none where the machine cannot be built or diverges.
  std::vector<OfRecordings> replay(const std::vector<std::vector<double>>& sets, double cutoff);

 private:
  std::unique_ptr<scenario::Scenario> take_machine();
  /// With the values of a set, where a recording begins.
  std::unique_ptr<scenario::Scenario> take_machine(const std::vector<double>& set, std::size_t recording);
  void give_back(std::unique_ptr<scenario::Scenario> machine);
  void collect_unknowns();
  [[nodiscard]] ReplayErrors errors_of(const std::vector<double>& set, std::size_t recording) const;
  [[nodiscard]] std::optional<Replayed> replay_one(const std::vector<double>& set, std::size_t recording,
                                                   double cutoff);

  const FitQuestion& question_;
  const std::vector<ReplaySeries>& recordings_;
  int jobs_;
  bool standstill_ = false;
  bool springs_ = false;  ///< of gear or nut something is looked for
  std::size_t runs_ = 0;
  std::vector<FitUnknown> unknowns_;
  std::vector<std::string> units_;
  std::vector<std::size_t> torque_delays_;
  std::vector<std::optional<std::size_t>> load_delays_;
  std::vector<std::vector<std::optional<std::size_t>>> shares_;
  std::vector<Plausible> about_;  ///< of each recording
  std::mutex mutex_;
  std::vector<std::unique_ptr<scenario::Scenario>> free_;
};

}  // namespace drycut::sim::studies
