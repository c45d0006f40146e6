// The cam of CAMMING4 as what a run is compared with: the laws of its sectors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/cam/camming4/plot.hpp"
#include "sim/cam/camming4/run.hpp"
#include "sim/cam/camming4/study.hpp"

namespace drycut::sim {

namespace {

/// So many passes that the cam reaches `master`.
CamRun run_to(const CamTable& table, double master) {
  auto run = run_cam(table, {}, 1);
  if (run.end != CamRun::End::came_round || run.master_total() >= master) return run;
  // The pass after the first one is judged only, but it is there: all others are as long.
  double again = 0;
  for (std::size_t i = run.shown; i < run.visits.size(); ++i) again += run.visits[i].master_length;
  if (again <= 0) return run;
  const auto visits = static_cast<double>(run.visits.size() - run.shown);
  const double most = CamRun::most_visits / std::max(visits, 1.0) - 2;
  const double wanted = std::ceil((master - run.master_total()) / again) + 1;
  return run_cam(table, {}, static_cast<int>(std::clamp(wanted, 1.0, std::max(most, 1.0))));
}

/// How much of the run the table alone says.
struct Known {
  std::size_t visits = 0;
  std::string silence;
};
Known known_of(const CamRun& run) {
  for (std::size_t i = 0; i < run.shown; ++i) {
    const CamVisit& visit = run.visits[i];
    if (visit.waiting)
      return {i, fmt::format("sector {} waits for a count of the master that the program sets", visit.row)};
    const bool released = visit.sector.kind == devices::camming4::Sector::Kind::gearing;
    if (released) return {i + 1, fmt::format("sector {} is a gearing, which the program ends", visit.row)};
  }
  return {run.shown, ""};
}

}  // namespace

IdealCam ideal_camming4(std::string_view text, MasterRange range) {
  Problems problems;
  const auto table = read_cam_table(text, "", problems);
  if (!problems.empty()) return {};
  const auto run = run_to(table, range.last);
  const auto known = known_of(run);
  const auto& slave = table.settings.slave;
  IdealCam ideal;
  ideal.master_unit = ideal.slave_unit = "Um";
  ideal.error_unit = "bits x4";
  ideal.error_scale = static_cast<double>(slave.pulse) / static_cast<double>(slave.measure);
  ideal.speed_scale = 1 / um_per_second(table);
  ideal.silence = known.silence;
  if (known.visits == 0) return ideal;
  for (std::size_t i = 0; i < known.visits; ++i) {
    const CamVisit& visit = run.visits[i];
    if (i > 0 && visit.pass == run.visits[i - 1].pass) continue;
    ideal.cycles.push_back(visit.master_start);
    ideal.origins.push_back(visit.slave_start);
  }
  const CamVisit& last = run.visits[known.visits - 1];
  ideal.cycles.push_back(last.master_end());
  ideal.origins.push_back(last.slave_start + last.slave_length);
  for (auto& zone : zones_of(table, run))
    if (zone.from < last.master_end()) ideal.zones.push_back(std::move(zone));
  const double first = run.visits[0].master_start;
  ideal.slave = [law = law_of(run.visits, known.visits), first](double master) {
    const bool inside = master >= first && master <= law.master_length;
    return inside ? at(law, master).position : std::numeric_limits<double>::quiet_NaN();
  };
  return ideal;
}

}  // namespace drycut::sim
