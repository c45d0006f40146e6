#include "sim/cams/course.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim::cams {

void repeat(IdealCam& ideal, const CamCourse& course, MasterRange range, const std::vector<CamZone>& zones) {
  constexpr double most = 1e6;
  if (!course.runs()) return;
  const double length = course.law.master_length;
  const double way = course.law.slave_length;
  const auto cycle_at = [first = course.first_master, length](double master) {
    return std::floor((master - first) / length);
  };
  const double begin = cycle_at(range.first);
  const double end = std::clamp(cycle_at(range.last) + 1, begin + 1, begin + most);
  for (double cycle = begin; cycle <= end; ++cycle) {
    const double from = cycle * length;
    ideal.cycles.push_back(course.first_master + from);
    ideal.origins.push_back(cycle * way);
    if (cycle == end) break;
    for (const CamZone& zone : zones)
      ideal.zones.push_back({from + zone.from, from + zone.to, zone.name, zone.synchronous});
  }
  ideal.slave = [course, cycle_at, length, way](double master) {
    double cycle = cycle_at(master);
    double inside = std::max(0.0, master - course.first_master - cycle * length);
    // A place just below the end may round to it.
    if (inside >= length) {
      ++cycle;
      inside = 0;
    }
    return course.first_slave + cycle * way + at(course.law, inside).position;
  };
}

}  // namespace drycut::sim::cams
