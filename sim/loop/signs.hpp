#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/outcome.hpp"
#include "sim/record/recording.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::sim::loop {

/// Something that may announce a failure: a fault, an alarm, a command that was refused, counts that were
/// lost, a drive at its limit.
struct Sign {
  double at = 0;  ///< [s] the first time
  std::string source;
  std::string event;
  Prose text;  ///< "begin=2.1 s; end=2.2 s", "warning 12"
  Severity severity = Severity::note;
  int times = 1;

  void visit(StateArchive& archive);
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("at", self.at);
    archive("source", self.source);
    archive("event", self.event);
    archive("text", self.text);
    archive("times", self.times);
  }
};
/// "knife: saturated: begin=2.1 s; end=2.2 s"
std::string text_of(const Sign& sign);

/// The first of each kind, in the order in which they came.
class Signs {
 public:
  void take(const record::RecordedEvent& event);
  void visit(StateArchive& archive);
  [[nodiscard]] const std::vector<Sign>& all() const { return all_; }
  /// The first of them that stands for itself before a check failed: no notes, and a drive's limit only just
  /// before.
  [[nodiscard]] const Sign* first(double failed_at) const;
  /// The sentence of a run that failed: the first sign, and how long before; nothing if no check failed.
  [[nodiscard]] std::optional<Finding> sentence(const record::Outcome& outcome) const;

 private:
  std::vector<Sign> all_;
};

/// The sentence in an outcome; "" = it has none.
std::string sign_told(const record::Outcome& outcome);

}  // namespace drycut::sim::loop
