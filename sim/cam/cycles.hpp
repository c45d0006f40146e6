#pragma once
#include "sim/cam/ideal.hpp"

namespace drycut::sim {

/// A cam whose cycles are all alike.
struct EvenCycles {
  double first = 0;   ///< master where cycle 0 begins
  double length = 0;  ///< of the master, above 0
  double way = 0;     ///< of the slave in a cycle
};

/// The cycle that holds `master`: ..., -1, 0, 1, ...
double cycle_at(const EvenCycles& cycles, double master);

/// Fills in the cycles over `range` and in each of them `zones`, which are those of cycle 0. After a million
/// cycles the rest is left out.
void add_cycles(IdealCam& ideal, const EvenCycles& cycles, MasterRange range,
                const std::vector<CamZone>& zones);

}  // namespace drycut::sim
