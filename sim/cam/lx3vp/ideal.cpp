// The cam of LX3VP as what a run is compared with: ECAMTBX's exact laws, or the lines between given rows.
#include <memory>

#include "sim/cam/cycles.hpp"
#include "sim/cam/lx3vp/report.hpp"
#include "sim/cam/lx3vp/run.hpp"
#include "sim/cam/lx3vp/study.hpp"
#include "sim/cam/lx3vp/table.hpp"

namespace drycut::sim {

IdealCam ideal_lx3vp(std::string_view text, MasterRange range) {
  Problems problems;
  const auto table = read_ecam_table(text, "", problems);
  if (!problems.empty()) return {};
  const auto run = std::make_shared<const EcamRun>(run_ecam(table, {}, 1));
  if (run->law.pieces.empty()) return {};
  const EvenCycles cycles{run->first_master, run->cycle(), run->law.slave_length};
  IdealCam ideal;
  ideal.master_unit = table.time_axis > 0 ? "counts" : "pulses";
  ideal.slave_unit = ideal.error_unit = "pulses";
  add_cycles(ideal, cycles, range, zones_of(table, *run));
  ideal.slave = [run, cycles](double master) {
    const double cycle = cycle_at(cycles, master);
    const double inside = master - cycles.first - cycle * cycles.length;
    return run->first_slave + cycle * cycles.way + at(run->law, inside).position;
  };
  return ideal;
}

}  // namespace drycut::sim
