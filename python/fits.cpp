// A machine learnt from recordings, and the recordings themselves.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/shared.hpp"
#include "sim/output_folder.hpp"
#include "sim/recordings/recording.hpp"
#include "sim/studies/fit/report.hpp"

namespace drycut::python {

namespace {

namespace studies = sim::studies;

constexpr int most_jobs = 256;
const ArgumentNames argument_names = {{"--recording", "recordings"}};

std::vector<std::string> texts_of(const std::vector<Finding>& findings) {
  return column(findings, [](const Finding& finding) { return to_string(finding); });
}

py::dict replay_of(const std::string& name, const studies::Replayed& one) {
  return py::dict("name"_a = name, "times"_a = numbers(one.times), "torque"_a = numbers(one.torque),
                  "torque_left"_a = numbers(one.torque_left), "speed"_a = numbers(one.speed),
                  "position"_a = numbers(one.position), "position_unit"_a = one.position_unit);
}

py::list replays_of(const std::vector<studies::ReplaySeries>& series,
                    const std::vector<studies::Replayed>& replays) {
  py::list list;
  for (std::size_t i = 0; i < replays.size(); ++i) list.append(replay_of(series[i].name(), replays[i]));
  return list;
}

py::dict fit(const studies::FitRequest& request, const std::optional<std::filesystem::path>& out) {
  std::optional<studies::FitPlan> plan;
  studies::FitFound found;
  {
    const py::gil_scoped_release unlocked;
    Problems problems;
    plan = studies::plan_fit(request, problems);
    if (request.jobs < 1 || request.jobs > most_jobs)
      problems.push_back({"study.out-of-range"_code, "jobs", 1, 1,
                          std::to_string(request.jobs) + " runs at the same time",
                          "1 to " + std::to_string(most_jobs)});
    refuse(problems, argument_names);
    std::optional<sim::OutputFolder> folder;
    if (out) folder.emplace(*out, "fit", studies::fit_files, problems);
    refuse(problems, argument_names);
    if (folder) folder->begin();
    found = studies::fit(plan->question, plan->recordings, request.jobs, [](const char*) { listen(); });
    if (!plan->tests.empty()) cross_test(plan->question, plan->tests, request.limit, request.jobs, found);
    for (const auto& finding : plan->findings) found.tell(finding);
    if (folder) write_fit(*plan, found, *folder, true);
  }
  py::dict answer = python_of(found);
  answer["passed"] = found.passed;
  answer["notes"] = texts_of(found.findings);
  answer["replays"] = replays_of(plan->recordings, found.replayed);
  answer["tests"] = replays_of(plan->tests, found.tested);
  return answer;
}

py::dict read_recording(const std::filesystem::path& file) {
  sim::recordings::Recording recording;
  std::vector<Finding> findings;
  {
    const py::gil_scoped_release unlocked;
    Problems problems;
    const auto yaml = sim::recordings::read_recording_file(file, problems);
    refuse(problems);
    recording = load(yaml, problems, findings);
    refuse(problems);
  }
  py::dict channels;
  for (auto& series : recording.series)
    channels[py::str(series.channel)] =
        py::make_tuple(numbers(std::move(series.time_s)), numbers(std::move(series.value)), series.unit,
                       numbers(std::vector<std::int64_t>(series.clipped.begin(), series.clipped.end())));
  return py::dict("file"_a = recording.file, "checksum"_a = recording.checksum, "rows"_a = recording.rows,
                  "channels"_a = channels, "notes"_a = texts_of(findings));
}

}  // namespace

void add_fits(py::module_& module) {
  module.def(
      "fit",
      [](const std::filesystem::path& scenario, const Settings& set,
         const std::vector<std::filesystem::path>& recordings, const std::vector<std::string>& vary,
         const std::vector<std::filesystem::path>& tests, std::optional<double> limit, bool closed, int jobs,
         const std::optional<std::filesystem::path>& out) {
        return fit({scenario, recordings, tests, vary, limit, overrides_of(set), closed, jobs}, out);
      },
      "scenario"_a, "set"_a, "recordings"_a, "vary"_a, "tests"_a, "limit"_a, "closed"_a, "jobs"_a, "out"_a);
  module.def("read_recording", read_recording, "file"_a);
}

}  // namespace drycut::python
