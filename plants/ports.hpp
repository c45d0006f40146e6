#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

namespace drycut::plants {

// The plugs of a plant, named from the plant's side. The bus (sim) copies between these and the controller's
// terminals once a step; a plant never knows what is plugged in.

/// A quadrature transducer, after its faults: what a counter input sees.
struct EncoderPort {
  std::int64_t count = 0;  ///< bits x4 since the start
  double before = 0;       ///< exact position at the start of the last step [bits x4]
  double now = 0;          ///< exact position at its end [bits x4]
  /// The count at a fraction 0..1 of the last step. Edges lie half-way between whole positions, so that a
  /// machine that stands on a whole position, an index pulse for one, counts the same whatever the last digit
  /// says.
  [[nodiscard]] std::int64_t count_at(double fraction) const {
    return static_cast<std::int64_t>(std::floor(before + (now - before) * fraction + 0.5));
  }
};

/// A signal that the plant gives: sensor, index pulse, in-position.
struct SignalPort {
  struct Edge {
    bool rising = false;
    double fraction = 0;  ///< when in the last step, 0..1
    double width = 0;     ///< of the zero pulse that begins here, in steps; 0 = as its falling edge says
  };
  bool level = false;       ///< at the end of the last step
  std::vector<Edge> edges;  ///< of the last step, in order of time
  void add_edge(bool rising, double fraction, double width = 0) {
    edges.push_back({rising, fraction, width});
  }
  /// Takes the level, with an edge at `fraction` of the step where it changes; true then.
  bool show(bool now, double fraction = 1) {
    if (now == level) return false;
    level = now;
    add_edge(now, fraction);
    return true;
  }
};

/// A signal that the plant takes: enable, forward, brake release.
struct CommandPort {
  bool level = false;
};

/// An analogue reference that the plant takes [V].
struct ReferencePort {
  double volts = 0;
};

/// A pulse train that the plant takes: pulses since the start, each one counted whatever its direction, which
/// is a signal of its own as on the cable. Never decreases; the pulses of a step come evenly within it.
struct PulsePort {
  std::int64_t pulses = 0;
};

}  // namespace drycut::plants
