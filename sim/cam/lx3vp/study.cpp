#include "sim/cam/lx3vp/study.hpp"

#include "sim/cam/lx3vp/judge.hpp"
#include "sim/cam/lx3vp/report.hpp"
#include "sim/cam/lx3vp/table.hpp"

namespace drycut::sim {

bool owns_lx3vp(std::string_view text) {
  const auto header = header_line(text);
  return header.starts_with("master") || header.starts_with("parameter");
}

bool check_lx3vp(std::string_view text, const std::string& file, Problems& problems) {
  return read_ecam_table(text, file, problems).time_axis > 0;
}

CamStudy study_lx3vp(std::string_view text, const std::string& file, const CamRequest& request,
                     Problems& problems) {
  const auto table = read_ecam_table(text, file, problems);
  if (!problems.empty()) return {};
  if (table.time_axis > 0 && request.duty.master_speed)
    problems.push_back({"--master-speed", 1, 1, "the master is time and has its own speed",
                        "leave it out, or give another # time_axis"});
  const auto run = run_ecam(table, request.duty, request.loops);
  if (run.runs())
    check_positions(request.at, {run.first_master, run.first_master + run.master_total()}, "pulses",
                    problems);
  if (!problems.empty()) return {};
  CamStudy study;
  study.text = ecam_text(table, run);
  study.findings = judge_ecam(table, request.duty, run);
  if (run.runs()) study.points = request.at.empty() ? sample_cam(run) : sample_cam_at(run, request.at);
  study.master_per_s = run.master_speed;
  take(study, ecam_plot(table, request.duty, run, request.plot_name));
  study.rows_are_given = !table.is_made();
  if (table.is_made() && table.made.ok()) study.table = ecam_rows_csv(table);
  return study;
}

}  // namespace drycut::sim
