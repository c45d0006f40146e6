#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/loop/signs.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

/// Keeps the first of what the controller remarks during a run, for a reader who does not open events.csv.
class Remarks : public record::Observer {
 public:
  void happened(const record::RecordedEvent& event) override;
  void visit(StateArchive& archive) override;
  /// The remarks, and how many more there were.
  [[nodiscard]] std::vector<Finding> notes() const;
  /// What of all events may announce a failure.
  [[nodiscard]] const Signs& signs() const { return signs_; }

 private:
  std::vector<Finding> remarks_;
  std::size_t urgent_ = 0;  ///< that stand at their beginning
  std::size_t count_ = 0;
  Signs signs_;
};

}  // namespace drycut::sim::loop
