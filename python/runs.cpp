// Whole runs of a scenario: from beginning to end, and those that measure a loop.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "python/shared.hpp"
#include "sim/loop/library.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/report/coverage.hpp"
#include "sim/report/part_meshes.hpp"
#include "sim/report/run_folder.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/bode/loop.hpp"
#include "sim/time.hpp"

namespace drycut::python {

namespace {

namespace report = sim::report;
using Simulation = sim::loop::Simulation;

sim::scenario::Scenario read_with_pictures(const std::filesystem::path& file, const Settings& set) {
  Problems problems;
  auto scenario = sim::scenario::read_scenario(file, overrides_of(set), problems);
  refuse(problems);
  return scenario;
}

/// By file: counts by line, of each decision's ways by line, of functions by name; the lines that never ran.
py::dict coverage_dict(const devices::Coverage& coverage) {
  py::dict files;
  for (const auto& [name, file] : coverage.files) {
    py::dict functions;
    for (const auto& [function, count] : file.functions) functions[py::str(function.second)] = count;
    files[py::str(name)] = py::dict("lines"_a = file.lines, "branches"_a = file.decisions,
                                    "functions"_a = functions, "never"_a = devices::figures_of(file).never);
  }
  return files;
}

py::dict run(const std::filesystem::path& file, const Settings& set,
             const std::optional<std::filesystem::path>& out, bool pictures, bool coverage) {
  std::optional<sim::scenario::Scenario> scenario;
  std::optional<Simulation> simulation;
  report::RunResult result;
  report::RunLeft left;
  {
    const py::gil_scoped_release unlocked;
    scenario.emplace(out ? read_with_pictures(file, set) : sim::read_for_program(file, set));
    Problems problems;
    simulation.emplace(*scenario, problems);
    refuse(problems);
    if (out) {
      const auto meshes = report::load_part_meshes(*scenario, simulation->plants(), problems);
      report::RunFolder folder(*out, problems);
      refuse(problems);
      folder.begin();
      report::RunRequest request;
      request.pictures = pictures;
      request.in_memory = true;
      request.coverage = coverage;
      request.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
      request.progress = [](const char*, double) { listen(); };
      left = folder.run(*scenario, *simulation, meshes, request, result);
    } else {
      if (coverage && simulation->controller() != nullptr) simulation->controller()->count_programs();
      result.outcome = simulation->run([](sim::Time) { listen(); });
      left.coverage = report::coverage_of(*scenario, *simulation);
    }
  }
  auto notes = sim::record::texts_of(simulation->notes());
  if (!left.left_out.empty()) notes.push_back("left out: " + left.left_out);
  py::dict columns;
  py::dict units;
  const auto& recording = simulation->recording();
  columns["time"] = numbers(column(recording.times(), sim::seconds));
  units["time"] = "s";
  for (const auto& recorded : recording.columns()) {
    columns[py::str(recorded.name)] = numbers(column(recorded.values, [](double value) { return value; }));
    units[py::str(recorded.name)] = recorded.unit;
  }
  py::list events;
  for (const auto& event : recording.events()) {
    py::dict values;
    for (const auto& value : event.values) values[py::str(value.name)] = value.number;
    events.append(py::make_tuple(event.at_seconds(), event.source, event.event, values, event.text));
  }
  return py::dict("outcome"_a = python_of(result.outcome), "events"_a = events, "columns"_a = columns,
                  "units"_a = units, "notes"_a = notes, "coverage"_a = coverage_dict(left.coverage));
}

py::object at_frequency(const std::optional<sim::studies::AtFrequency>& margin) {
  if (!margin) return py::none();
  return py::make_tuple(margin->value, margin->frequency);
}

py::dict bode(const std::filesystem::path& file, const Settings& set,
              const sim::studies::LoopRequest& request) {
  const ArgumentNames names = {{"--from", "lowest"}, {"--to", "highest"}};
  std::optional<sim::studies::LoopResult> result;
  {
    const py::gil_scoped_release unlocked;
    auto scenario = sim::read_for_program(file, set);
    Problems problems;
    sim::studies::check_request(request, problems);
    if (scenario.buildable) sim::studies::check_loop(scenario, request, problems);
    refuse(problems, names);
    result = sim::studies::measure_both(scenario, request, problems, [](double) { listen(); });
    refuse(problems, names);
  }
  if (!result->sweep.failure.empty()) throw Diverged(result->sweep.failure);
  const auto& points = result->sweep.points;
  using Point = sim::studies::BodePoint;
  constexpr const char* loops[] = {"closed", "open", "restless", "runaway", "unstable"};
  const auto& margins = result->margins;
  return py::dict(
      "wire"_a = result->wire, "loop"_a = loops[static_cast<int>(result->sweep.loop)],
      "frequency"_a = numbers(column(points, [](const Point& p) { return p.frequency; })),
      "open_loop"_a = numbers(column(points, [](const Point& p) { return p.open_loop; })),
      "error"_a = numbers(column(points, [](const Point& p) { return p.error; })),
      "phase_margin"_a = at_frequency(margins.phase), "gain_margin"_a = at_frequency(margins.gain),
      "gain_margin_down"_a = at_frequency(margins.gain_down),
      "peak_sensitivity"_a = at_frequency(margins.sensitivity), "bandwidth"_a = margins.closed_bandwidth,
      "doubts"_a = sim::record::texts_of(sim::studies::loop_doubts(*result)));
}

}  // namespace

void add_runs(py::module_& module) {
  module.def("run", run, "file"_a, "set"_a, "out"_a, "pictures"_a, "coverage"_a);
  module.def(
      "bode",
      [](const std::filesystem::path& file, const Settings& set, const std::string& wire,
         const std::optional<std::string>& at, std::optional<double> from, std::optional<double> to,
         int points, double amplitude, double settle) {
        sim::studies::LoopRequest request;
        request.wire = wire;
        request.at = at;
        request.from = from;
        request.to = to;
        request.points = points;
        request.amplitude = amplitude;
        request.settle = settle;
        return bode(file, set, request);
      },
      "file"_a, "set"_a, "wire"_a, "at"_a, "lowest"_a, "highest"_a, "points"_a, "amplitude"_a, "settle"_a);
}

}  // namespace drycut::python
