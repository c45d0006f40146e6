#pragma once
#include <cstdint>

namespace drycut {
class StateArchive;
}

namespace drycut::devices {

/// What happens at each whole multiple of a period: a device's sample, a task's cycle, a scan.
struct Due {
  std::int64_t period_ns = 0;  ///< 0: it happens whenever it is asked
  std::int64_t next_ns = 0;

  /// Whether it happens at `time_ns`; if so, it is next due at the first multiple behind that.
  bool take(std::int64_t time_ns) {
    if (time_ns < next_ns) return false;
    if (period_ns <= 0) return true;
    next_ns += period_ns;
    if (next_ns <= time_ns) next_ns = (time_ns / period_ns + 1) * period_ns;
    return true;
  }
  /// The period is none.
  void visit(StateArchive& archive);
};

}  // namespace drycut::devices
