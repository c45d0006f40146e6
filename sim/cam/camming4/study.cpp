#include "sim/cam/camming4/study.hpp"

#include "sim/cam/camming4/judge.hpp"
#include "sim/cam/camming4/plot.hpp"
#include "sim/cam/camming4/report.hpp"

namespace drycut::sim {

bool owns_camming4(std::string_view text) { return header_line(text).starts_with("sector"); }

bool check_camming4(std::string_view text, const std::string& file, Problems& problems) {
  read_cam_table(text, file, problems);
  return false;
}

CamStudy study_camming4(std::string_view text, const std::string& file, const CamRequest& request,
                        Problems& problems) {
  const auto table = read_cam_table(text, file, problems);
  if (!problems.empty()) return {};
  const auto run = run_cam(table, request.duty, request.loops);
  check_positions(request.at, {0, run.master_total()}, "Um", problems);
  if (!problems.empty()) return {};
  CamStudy study;
  study.text = cam_text(table, request.duty, run);
  study.findings = judge(table, request.duty, run);
  study.points = request.at.empty() ? sample_cam(run) : sample_cam_at(run, request.at);
  if (request.duty.master_speed) study.master_per_s = *request.duty.master_speed * um_per_second(table);
  take(study, cam_plot(table, request.duty, run, request.plot_name));
  return study;
}

}  // namespace drycut::sim
