// The cam of MC_CamIn as what a run is compared with: the polynomials between its points.
#include "sim/cam/mc_camin/report.hpp"
#include "sim/cam/mc_camin/run.hpp"
#include "sim/cam/mc_camin/study.hpp"

namespace drycut::sim {

IdealCam ideal_mc_camin(std::string_view text, MasterRange range) {
  Problems problems;
  const auto cam = devices::plcopen::read_cam(text, "", problems);
  if (!cam) return {};
  const auto run = run_cam_in(*cam, {}, 1);
  if (!run.runs()) return {};
  IdealCam ideal;
  ideal.master_unit = cam->master_unit;
  ideal.slave_unit = cam->slave_unit;
  ideal.shown = 1 / increments_per_unit;
  ideal.error_unit = increments_of(cam->slave_unit);
  ideal.speed_scale = 1 / increments_per_unit;
  repeat(ideal, run, range, zones_of(run));
  return ideal;
}

}  // namespace drycut::sim
