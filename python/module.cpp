// The extension under the Python package `drycut`: what the program does, with numbers for numpy. The package
// (python/drycut) gives it its classes and its documentation.
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <drycut/simulation.hpp>

#include <complex>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/cams/study.hpp"
#include "sim/file.hpp"
#include "sim/library.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/studies/bode/loop.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace {

using namespace drycut;

using Settings = std::map<std::string, std::string>;

/// Throws what was found.
void refuse(const Problems& problems) {
  if (!problems.empty()) throw BadInput(problems);
}

/// Numbers for Python, which owns them from now on.
template <class Number>
py::array numbers(std::vector<Number> values) {
  auto* kept = new std::vector<Number>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Number>*>(p); });
  return py::array_t<Number>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

template <class Items, class Of>
auto column(const Items& items, Of of) {
  std::vector<std::decay_t<decltype(of(*items.begin()))>> values;
  values.reserve(items.size());
  for (const auto& item : items) values.push_back(of(item));
  return values;
}

/// Lets Python handle its signals in a long run: Ctrl-C ends it.
void listen() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

py::dict run(const std::filesystem::path& file, const Settings& set) {
  std::optional<sim::scenario::Scenario> scenario;
  std::optional<sim::loop::Simulation> simulation;
  sim::loop::Outcome outcome;
  {
    const py::gil_scoped_release unlocked;
    scenario.emplace(sim::read_for_program(file, set));
    Problems problems;
    simulation.emplace(*scenario, problems);
    refuse(problems);
    outcome = simulation->run([](sim::Time) { listen(); });
  }
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
  py::list checks;
  for (const auto& check : outcome.checks)
    checks.append(py::make_tuple(check.name, check.expectation, check.passed, check.margin, check.unit,
                                 check.at, check.detail));
  return py::dict("passed"_a = outcome.passed(), "failure"_a = outcome.failure, "checks"_a = checks,
                  "events"_a = events, "columns"_a = columns, "units"_a = units,
                  "notes"_a = simulation->notes());
}

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
                                   finding.text, finding.remedy.text));
  const auto& points = study.points;
  using Point = sim::cams::CamPoint;
  return py::dict(
      "device"_a = std::string(sim::cams::kind_name(table)), "findings"_a = findings,
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

py::object at_frequency(const std::optional<sim::studies::AtFrequency>& margin) {
  if (!margin) return py::none();
  return py::make_tuple(margin->value, margin->frequency);
}

py::dict bode(const std::filesystem::path& file, const Settings& set,
              const sim::studies::LoopRequest& request) {
  std::optional<sim::studies::LoopResult> result;
  {
    const py::gil_scoped_release unlocked;
    auto scenario = sim::read_for_program(file, set);
    Problems problems;
    sim::studies::check_request(request, problems);
    if (scenario.buildable) sim::studies::check_loop(scenario, request, problems);
    refuse(problems);
    result = sim::studies::measure_both(scenario, request, problems, [](double) { listen(); });
    refuse(problems);
  }
  if (!result->sweep.failure.empty()) throw Diverged(result->sweep.failure);
  const auto& points = result->sweep.points;
  using Point = sim::studies::BodePoint;
  constexpr const char* loops[] = {"closed", "open", "restless", "runaway", "unstable"};
  const auto& margins = result->margins;
  return py::dict("wire"_a = result->wire, "loop"_a = loops[static_cast<int>(result->sweep.loop)],
                  "frequency"_a = numbers(column(points, [](const Point& p) { return p.frequency; })),
                  "open_loop"_a = numbers(column(points, [](const Point& p) { return p.open_loop; })),
                  "error"_a = numbers(column(points, [](const Point& p) { return p.error; })),
                  "phase_margin"_a = at_frequency(margins.phase),
                  "gain_margin"_a = at_frequency(margins.gain),
                  "gain_margin_down"_a = at_frequency(margins.gain_down),
                  "peak_sensitivity"_a = at_frequency(margins.sensitivity),
                  "bandwidth"_a = margins.closed_bandwidth, "doubts"_a = sim::studies::loop_doubts(*result));
}

PyObject* bad_input = nullptr;
PyObject* diverged = nullptr;

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const BadInput& fault) {
    py::list problems;
    for (const auto& p : fault.problems)
      problems.append(py::make_tuple(p.file, p.line, p.column, p.what, p.remedy));
    const auto error = py::reinterpret_borrow<py::object>(bad_input)(fault.what(), problems);
    PyErr_SetObject(bad_input, error.ptr());
  } catch (const Diverged& fault) {
    PyErr_SetString(diverged, fault.what());
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.attr("version") = DRYCUT_VERSION;
  py::register_exception_translator(translate);
  module.def("set_exceptions", [](const py::object& bad, const py::object& failed) {
    bad_input = py::object(bad).release().ptr();
    diverged = py::object(failed).release().ptr();
  });

  module.def("run", run, "file"_a, "set"_a);
  module.def(
      "cam",
      [](const std::filesystem::path& file, const std::string& device, std::optional<double> master_speed,
         std::optional<double> max_velocity, std::optional<double> max_acceleration,
         const std::vector<double>& at, int loops) {
        return cam(file, device, {master_speed, max_velocity, max_acceleration}, at, loops);
      },
      "file"_a, "device"_a, "master_speed"_a, "max_velocity"_a, "max_acceleration"_a, "at"_a, "loops"_a);
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

  using Unlocked = py::call_guard<py::gil_scoped_release>;
  py::class_<Simulation>(module, "Simulation")
      .def(py::init<const std::filesystem::path&, const Settings&>(), "file"_a, "set"_a, Unlocked())
      .def("step", &Simulation::step, Unlocked())
      .def("advance", &Simulation::advance, "seconds"_a, Unlocked())
      .def_property_readonly("time", &Simulation::time)
      .def_property_readonly("step_length", &Simulation::step_length)
      .def_property_readonly("duration", &Simulation::duration)
      .def("names", &Simulation::names)
      .def("read", &Simulation::read, "name"_a)
      .def("unit", &Simulation::unit, "name"_a)
      .def("write", &Simulation::write, "name"_a, "value"_a)
      .def("take_events",
           [](Simulation& simulation) {
             py::list events;
             for (const auto& e : simulation.take_events())
               events.append(py::make_tuple(e.time, e.source, e.name, e.values, e.text));
             return events;
           })
      .def("checks", [](Simulation& simulation) {
        py::list checks;
        for (const auto& c : simulation.checks())
          checks.append(py::make_tuple(c.name, "", c.passed, c.margin, c.unit, py::none(), c.detail));
        return checks;
      });
}
