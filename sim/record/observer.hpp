#pragma once
#include "sim/record/event_log.hpp"
#include "sim/time.hpp"

namespace drycut::sim::record {

/// Looks at a run while it goes on and changes nothing of it. The watch has been updated before each call.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A record instant.
  virtual void sample(Time) {}
  /// Time zero and every physics step, before the rest, of who asked for it; nothing has been updated.
  virtual void stepped(Time) {}
  virtual void happened(const RecordedEvent&) {}
  /// The run has come to its end. May throw std::runtime_error when something cannot be written.
  virtual void finish() {}

 protected:
  Observer() = default;
  Observer(const Observer&) = default;
  Observer& operator=(const Observer&) = default;
};

}  // namespace drycut::sim::record
