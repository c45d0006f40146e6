#include "sim/cams/judged.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace drycut::sim::cams {

namespace {

/// Its four first digits, as a person would give it.
double rounded(double speed) { return std::strtod(fmt::format("{:.4g}", speed).c_str(), nullptr); }

MasterRange range_of(const loop::PlayedCam& played) {
  MasterRange range;
  for (std::size_t i = 0; i < played.samples.size(); ++i) {
    const double master = played.samples[i].master;
    range.first = i == 0 ? master : std::min(range.first, master);
    range.last = i == 0 ? master : std::max(range.last, master);
  }
  return range;
}

}  // namespace

JudgedCam judged(const loop::PlayedCam& played, const std::string& name, Lines lines) {
  JudgedCam cam{played.text, {}, {}};
  const auto file = name + ".csv";
  if (played.table) {
    auto written = cam.table = *played.table;
    cam.text = cam_file(written, file);
    if (lines == Lines::written) cam.table = std::move(written);
  }
  // Also of a table that was written just now: will drycut cam take the file?
  auto read = read_cam(played.table ? played.table->kind() : "mc_camin", cam.text, file, cam.problems);
  if (!played.table) cam.table = std::move(read);
  if (!cam.problems.empty()) return cam;
  cam.ideal = ideal_cam(cam.table, range_of(played));
  CamRequest request;
  request.plot_name = "cam_" + name;
  if (!gives_master_speed(cam.table)) cam.master_speed = rounded(played.fastest * cam.ideal.speed_scale);
  if (cam.master_speed > 0) request.duty.master_speed = cam.master_speed;
  cam.study = study_cam(cam.table, request, cam.problems);
  return cam;
}

loop::CamJudgement cam_judgement(const std::vector<loop::PlayedCam>& played) {
  constexpr std::size_t most = 3;  // of a cam
  loop::CamJudgement judgement;
  for (const auto& one : played) {
    const auto cam = judged(one, "cam", Lines::own);
    if (!cam.problems.empty()) continue;
    const auto& course = cam.study.course;
    // A law with passes in itself begins with what is not repeated.
    if (course.runs() && !course.lets_go && course.passes == 0)
      judgement.cycles.push_back(
          {one.axis, course.law.master_length * cam.ideal.shown, cam.ideal.master_unit});
    // What is wrong at any speed is wrong with the table; else its master may have been too fast.
    constexpr double slow = 1e-3;
    CamRequest slowly;
    if (cam.master_speed > 0) slowly.duty.master_speed = slow * cam.master_speed;
    Problems none;
    const auto at_slow_speed = study_cam(cam.table, slowly, none);
    const auto is_of_table = [&](const CamFinding& finding) {
      return is_unsound({finding}, false) &&
             std::any_of(at_slow_speed.findings.begin(), at_slow_speed.findings.end(),
                         [&](const CamFinding& other) {
                           return other.kind == finding.kind && other.grade == finding.grade &&
                                  other.number == finding.number && other.where == finding.where;
                         });
    };
    const auto file = cam.study.file.empty() ? "" : fmt::format(" ({})", cam.study.file);
    std::size_t told = 0;
    for (const auto& finding : cam.study.findings)
      if (finding.grade < CamFinding::Grade::caution && ++told <= most)
        judgement.doubts.push_back(
            {{finding.kind, fmt::format("cam of {}{}, {}", one.axis, file, sentence(finding))},
             is_of_table(finding)});
  }
  return judgement;
}

}  // namespace drycut::sim::cams
