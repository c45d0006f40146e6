#pragma once
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/outcome.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

/// Keeps what may be the cause of a failure: the first errors and warnings of each source, faults, drives at
/// their limits, since when the program's states have stood as they are.
class Causes : public record::Observer {
 public:
  void happened(const record::RecordedEvent& event) override;
  void sample(Time now) override;
  void visit(StateArchive& archive) override;
  /// A number of the program that tells how far it is; it outlives this.
  void follow(std::string name, const double* number);

  /// What a run knows besides, a phrase each, the most telling one first.
  struct Known {
    std::vector<Finding> contradictions;  ///< of controller and machine
    /// Why nothing began: a switch that was never on, a program that waits.
    std::vector<Finding> hindrances = {};
    /// An axis that goes the wrong way: from when on [s].
    std::vector<std::pair<double, Finding>> astray = {};
    /// An axis that hunts: from when on [s].
    std::optional<std::pair<double, Finding>> hunting = {};
    /// Where the whole program stands, and since when [s].
    std::optional<std::pair<double, Finding>> standing = {};
    /// What may be a slip, where nothing tells more: positions that differ, doubtful wires.
    std::vector<Finding> doubts = {};
  };
  /// Why the checks failed, as the end of a sentence: "because Knife at 2.282 s: the cam asks for ...", or
  /// where it only came before, "after ..."; nothing if nothing tells or all passed.
  [[nodiscard]] std::optional<Finding> of(const std::vector<record::CheckResult>& checks,
                                          const Known& known) const;
  /// "gbPhase stands at 1 since 0.31 s": the state that changed last, if it has not for a long time;
  /// nothing = there is none, or it has stood since after `until` only.
  [[nodiscard]] std::optional<Finding> state_that_stands(
      double now, double until = std::numeric_limits<double>::infinity()) const;
  /// The first time that a plant ran into its end stop; nullptr = none did.
  [[nodiscard]] const record::Alarm* first_stop() const { return stop_ ? &*stop_ : nullptr; }
  /// The machine whose clamps or blade first took hold of what ran at another speed, and its plug; "" = none.
  [[nodiscard]] const std::string& grip() const { return grip_; }
  /// The first errors and warnings in the order of their times, twenty at most.
  [[nodiscard]] std::vector<record::Alarm> alarms() const;

 private:
  struct State {
    std::string name;
    const double* number;
    double last = 0;
    double changed = 0;  ///< [s]; 0: it has not yet
    double longest = 0;  ///< that it has stood between two changes [s]
  };
  struct Limit {
    std::string drive;
    double begin = 0;  ///< [s]
    double end = 0;
  };
  /// How sure a cause is: the word before it.
  enum class Link { because, after, shortly_before, meanwhile };
  struct Cause {
    Link link;
    Finding what;
    bool of_controller = false;  ///< an error that it told itself
    /// The same, and behind it a phrase that tells more; "" = none.
    [[nodiscard]] Cause with(const std::string& more) const;
  };
  [[nodiscard]] const record::Alarm* first_error(double until) const;
  [[nodiscard]] const record::Alarm* last_warning(double until, const std::string& source) const;
  [[nodiscard]] std::string with_warning(const record::Alarm& error) const;
  [[nodiscard]] std::optional<Cause> by_time(double failed_at, const Known& known) const;
  [[nodiscard]] std::optional<Cause> cause_of(const std::vector<record::CheckResult>& checks,
                                              const Known& known) const;
  [[nodiscard]] static std::optional<Cause> only_late(const std::vector<record::CheckResult>& checks);
  [[nodiscard]] std::optional<Cause> last_resort(const std::vector<record::CheckResult>& checks,
                                                 const Known& known, std::optional<Cause> before) const;

  std::vector<record::Alarm> errors_;    ///< the first of each source
  std::vector<record::Alarm> warnings_;  ///< the first of each source and text
  std::vector<record::Alarm> faults_;
  std::vector<record::Alarm> sets_;         ///< what the timeline did to the machine
  std::vector<record::Alarm> blows_;        ///< the first of each source: it ran into a stop, it sank
  std::optional<record::Alarm> stop_;       ///< the first at an end stop
  std::optional<record::Alarm> odd_value_;  ///< the first that was cut, or is outside of the manual's range
  bool is_cut_ = false;                     ///< that one
  std::set<std::string> machines_;          ///< sources that tell numbers and no text
  std::string grip_;
  std::vector<Limit> limits_;
  std::vector<State> states_;
};

}  // namespace drycut::sim::loop
