#pragma once
#include <string>
#include <vector>

#include "sim/loop/checks.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Fails a run in which a machine did what it must not, though no check asks about it: events that their
/// plant declares failures. Where a check names the event, that check alone decides.
class Unasked : public record::Observer {
 public:
  Unasked(const scenario::Scenario& scenario, const std::vector<KnownEvent>& events);

  void happened(const record::RecordedEvent& event) override;
  void visit(StateArchive& archive) override;
  /// A failed check for each kind that happened; none where none did.
  [[nodiscard]] std::vector<record::CheckResult> results() const;

 private:
  struct Watched {
    std::string source;
    std::string name;
    int times = 0;
    double first = 0;    ///< [s]
    std::string values;  ///< of the first
  };
  std::vector<Watched> watched_;
};

}  // namespace drycut::sim::loop
