#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "python/shared.hpp"
#include "sim/cams/study.hpp"
#include "sim/file.hpp"

namespace drycut::python {

namespace {

py::dict cam(const std::filesystem::path& file, const std::string& device, const sim::cams::CamDuty& duty,
             const std::vector<double>& at, int loops) {
  Problems problems;
  const auto text = sim::read_file(file, problems);
  refuse(problems);
  const auto table = sim::cams::read_cam(device, *text, file.string(), problems);
  refuse(problems);
  const auto study = sim::cams::study_cam(table, {duty, at, loops, "cam"}, problems);
  refuse(problems);
  constexpr const char* grades[] = {"error", "limit", "warning", "caution", "remark"};
  py::list findings;
  for (const auto& finding : study.findings)
    findings.append(py::make_tuple(grades[static_cast<int>(finding.grade)], finding.number, finding.where,
                                   finding.text, finding.remedy.text, std::string(finding.kind.text())));
  const auto& points = study.points;
  using Point = sim::cams::CamPoint;
  return py::dict(
      "device"_a = std::string(table.kind()), "findings"_a = findings,
      "sound"_a = !sim::cams::is_unsound(study.findings, false),
      "report"_a = sim::cams::cam_report(study.text, study.findings), "unit"_a = study.master_unit,
      "columns"_a =
          py::dict("master"_a = numbers(column(points, [](const Point& p) { return p.master; })),
                   "slave"_a = numbers(column(points, [](const Point& p) { return p.position; })),
                   "velocity"_a = numbers(column(points, [](const Point& p) { return p.velocity; })),
                   "acceleration"_a = numbers(column(points, [](const Point& p) { return p.acceleration; })),
                   "jerk"_a = numbers(column(points, [](const Point& p) { return p.jerk; })),
                   "row"_a = numbers(column(points, [](const Point& p) { return p.row; }))));
}

}  // namespace

void add_cams(py::module_& module) {
  module.def(
      "cam",
      [](const std::filesystem::path& file, const std::string& device, std::optional<double> master_speed,
         std::optional<double> max_velocity, std::optional<double> max_acceleration,
         const std::vector<double>& at, int loops) {
        return cam(file, device, {master_speed, max_velocity, max_acceleration}, at, loops);
      },
      "file"_a, "device"_a, "master_speed"_a, "max_velocity"_a, "max_acceleration"_a, "at"_a, "loops"_a);
}

}  // namespace drycut::python
