// The cam of LX3VP as what a run is compared with: ECAMTBX's exact laws, or the lines between given rows.
#include "sim/cam/lx3vp/report.hpp"
#include "sim/cam/lx3vp/study.hpp"
#include "sim/cam/lx3vp/table.hpp"

namespace drycut::sim {

IdealCam ideal_lx3vp(std::string_view text, MasterRange range) {
  Problems problems;
  const auto table = read_ecam_table(text, "", problems);
  if (!problems.empty()) return {};
  const auto run = run_ecam(table, {}, 1);
  if (!run.runs()) return {};
  IdealCam ideal;
  ideal.master_unit = table.time_axis > 0 ? "counts" : "pulses";
  ideal.slave_unit = ideal.error_unit = "pulses";
  repeat(ideal, run, range, zones_of(table, run));
  return ideal;
}

}  // namespace drycut::sim
