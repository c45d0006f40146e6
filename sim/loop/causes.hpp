#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/loop/checks.hpp"
#include "sim/loop/observer.hpp"

namespace drycut::sim::loop {

/// Keeps what may be the cause of a failure: the first errors and warnings of each source, faults, drives at
/// their limits.
class Causes : public Observer {
 public:
  void happened(const RecordedEvent& event) override;

  /// What a run knows besides, a phrase each, the most telling one first.
  struct Known {
    std::vector<std::string> contradictions;  ///< of controller and machine
    std::vector<std::string>
        hindrances;  ///< why nothing began: a switch that was never on, a program that waits
  };
  /// Why the checks failed, as the end of a sentence: "because Knife at 2.282 s: the cam asks for ...", or
  /// where it only came before, "after ..."; "" if nothing tells or all passed.
  [[nodiscard]] std::string of(const std::vector<CheckResult>& checks, const Known& known) const;

 private:
  struct Told {
    double at = 0;  ///< [s]
    std::string source;
    std::string text;
  };
  struct Limit {
    std::string drive;
    double begin = 0;  ///< [s]
    double end = 0;
  };
  [[nodiscard]] const Told* first_error(double until) const;
  [[nodiscard]] const Told* last_warning(double until, const std::string& source) const;
  [[nodiscard]] std::string by_time(double failed_at) const;

  std::vector<Told> errors_;    ///< the first of each source
  std::vector<Told> warnings_;  ///< the first of each source and text
  std::vector<Told> faults_;
  std::vector<Limit> limits_;
};

}  // namespace drycut::sim::loop
