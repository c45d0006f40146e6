#include "sim/cam/cycles.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim {

double cycle_at(const EvenCycles& cycles, double master) {
  return std::floor((master - cycles.first) / cycles.length);
}

void add_cycles(IdealCam& ideal, const EvenCycles& cycles, MasterRange range,
                const std::vector<CamZone>& zones) {
  constexpr double most = 1e6;
  const double begin = cycle_at(cycles, range.first);
  const double end = std::clamp(cycle_at(cycles, range.last) + 1, begin + 1, begin + most);
  for (double cycle = begin; cycle <= end; ++cycle) {
    const double from = cycle * cycles.length;
    ideal.cycles.push_back(cycles.first + from);
    ideal.origins.push_back(cycle * cycles.way);
    if (cycle == end) break;
    for (const CamZone& zone : zones)
      ideal.zones.push_back({from + zone.from, from + zone.to, zone.name, zone.synchronous});
  }
}

}  // namespace drycut::sim
