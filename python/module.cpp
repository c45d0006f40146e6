#include "python/shared.hpp"

#include <algorithm>

namespace drycut::python {

namespace {

PyObject* bad_input = nullptr;
PyObject* diverged = nullptr;

}  // namespace

std::vector<sim::scenario::Override> overrides_of(const Settings& set) {
  std::vector<sim::scenario::Override> overrides;
  overrides.reserve(set.size());
  for (const auto& [path, value] : set) overrides.push_back({path, value});
  return overrides;
}

void refuse(const Problems& problems, const ArgumentNames& names) {
  if (problems.empty()) return;
  auto told = problems;
  for (auto& problem : told) {
    const auto known = names.find(problem.file);
    if (known != names.end()) {
      problem.file = known->second;
    } else if (problem.file.starts_with("--")) {
      problem.file.erase(0, 2);
      std::replace(problem.file.begin(), problem.file.end(), '-', '_');
    }
  }
  throw BadInput(told);
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const BadInput& fault) {
    py::list problems;
    for (const auto& p : fault.problems)
      problems.append(py::make_tuple(p.file, p.line, p.column, p.what, p.remedy, std::string(p.code.text())));
    const auto error = py::reinterpret_borrow<py::object>(bad_input)(fault.what(), problems);
    PyErr_SetObject(bad_input, error.ptr());
  } catch (const Diverged& fault) {
    PyErr_SetString(diverged, fault.what());
  }
}

void listen() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace drycut::python

PYBIND11_MODULE(_core, module) {
  using namespace drycut::python;
  module.attr("version") = DRYCUT_VERSION;
  py::register_exception_translator(translate);
  module.def("set_exceptions", [](const py::object& bad, const py::object& failed) {
    bad_input = py::object(bad).release().ptr();
    diverged = py::object(failed).release().ptr();
  });
  add_runs(module);
  add_line(module);
  add_cams(module);
  add_studies(module);
  add_fits(module);
  add_verbs(module);
}
