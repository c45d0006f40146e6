#include "sim/cam/mc_camin/study.hpp"

#include "sim/cam/mc_camin/judge.hpp"
#include "sim/cam/mc_camin/report.hpp"
#include "sim/cam/mc_camin/run.hpp"

namespace drycut::sim {

bool owns_mc_camin(std::string_view text) {
  const auto header = header_line(text).substr(0, header_line(text).find_first_of("\r\n"));
  if (header.starts_with("slave") || header.starts_with("a0")) return true;
  if (header.find('=') != std::string_view::npos) return true;  // of a .tab file
  const auto above = text.substr(0, static_cast<std::size_t>(header.data() - text.data()));
  return header.starts_with("master") && above.find("# interpolation") != std::string_view::npos;
}

bool check_mc_camin(std::string_view text, const std::string& file, Problems& problems) {
  devices::plcopen::read_cam(text, file, problems);
  return false;
}

CamStudy study_mc_camin(std::string_view text, const std::string& file, const CamRequest& request,
                        Problems& problems) {
  const auto cam = devices::plcopen::read_cam(text, file, problems);
  if (!cam) return {};
  const CamInRun run = run_cam_in(*cam, request.duty, request.loops);
  if (run.runs())
    check_positions(request.at, {0, run.master_total()}, increments_of(cam->master_unit), problems);
  if (!problems.empty()) return {};
  CamStudy study;
  study.text = cam_in_text(run);
  study.findings = judge_cam_in(run, request.duty);
  study.master_per_s = run.master_speed;
  if (!run.runs()) return study;
  study.points = request.at.empty() ? sample_cam(run) : sample_cam_at(run, request.at);
  take(study, cam_in_plot(run, request.duty, request.plot_name));
  return study;
}

}  // namespace drycut::sim
