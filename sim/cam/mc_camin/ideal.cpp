// The cam of MC_CamIn as what a run is compared with: the polynomials between its points.
#include <algorithm>
#include <memory>

#include "sim/cam/cycles.hpp"
#include "sim/cam/mc_camin/report.hpp"
#include "sim/cam/mc_camin/run.hpp"
#include "sim/cam/mc_camin/study.hpp"

namespace drycut::sim {

IdealCam ideal_mc_camin(std::string_view text, MasterRange range) {
  Problems problems;
  const auto cam = devices::plcopen::read_cam(text, "", problems);
  if (!cam) return {};
  const auto run = std::make_shared<const CamInRun>(run_cam_in(*cam, {}, 1));
  if (!run->runs()) return {};
  const EvenCycles cycles{0, run->curve.modulo, run->advance()};
  IdealCam ideal;
  ideal.master_unit = cam->master_unit;
  ideal.slave_unit = cam->slave_unit;
  ideal.shown = 1 / increments_per_unit;
  ideal.error_unit = increments_of(cam->slave_unit);
  ideal.speed_scale = 1 / increments_per_unit;
  add_cycles(ideal, cycles, range, zones_of(*run));
  ideal.slave = [run, cycles](double master) {
    double cycle = cycle_at(cycles, master);
    double inside = std::max(0.0, master - cycle * cycles.length);
    // A place just below the end may round to it.
    if (inside >= cycles.length) {
      ++cycle;
      inside = 0;
    }
    return cycle * cycles.way + at(run->curve, inside).position;
  };
  return ideal;
}

}  // namespace drycut::sim
