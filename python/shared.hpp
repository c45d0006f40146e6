#pragma once
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <drycut/simulation.hpp>

#include <exception>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/visit.hpp"
#include "sim/scenario/scenario.hpp"

// The extension under the Python package `drycut`: what the program does, with numbers for numpy. The package
// (python/drycut) gives it its classes and its documentation.
namespace drycut::python {

namespace py = pybind11;
using namespace py::literals;

using Settings = std::map<std::string, std::string>;
std::vector<sim::scenario::Override> overrides_of(const Settings& set);

/// Options of the command line that Python calls otherwise: {"--from", "lowest"}.
using ArgumentNames = std::map<std::string, std::string>;
/// Throws what was found, with the names of arguments for those of options: "--max-travel" is "max_travel".
void refuse(const Problems& problems, const ArgumentNames& names = {});

/// What is thrown by the rooms as Python's exceptions; what is neither BadInput nor Diverged is thrown on.
void translate(std::exception_ptr thrown);

/// Lets Python handle its signals in a long run: Ctrl-C ends it. The lock may be held or not.
void listen();

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

template <typename T>
py::object python_of(const T& value);

struct DictWriter {
  py::dict dict;
  template <typename T>
  void operator()(const char* key, const T& member) {
    dict[key] = python_of(member);
  }
};

/// What came of a run as Python has it: a dict a visited value, None for what is not there, times in seconds,
/// points as an array of two columns.
template <typename T>
py::object python_of(const T& value) {
  if constexpr (sim::record::Visited<T>) {
    DictWriter writer;
    T::visit(writer, value);
    return std::move(writer.dict);
  } else if constexpr (sim::record::is_optional<T>) {
    return value ? python_of(*value) : py::none();
  } else if constexpr (sim::record::is_cloud<T>) {
    py::array_t<double> points({static_cast<py::ssize_t>(value.size()), py::ssize_t{2}});
    auto* next = points.mutable_data();
    for (const auto& [x, y] : value) {
      *next++ = x;
      *next++ = y;
    }
    return points;
  } else if constexpr (sim::record::is_list<T>) {
    py::list list;
    for (const auto& item : value) list.append(python_of(item));
    return list;
  } else if constexpr (sim::record::is_map<T>) {
    py::dict dict;
    for (const auto& [key, item] : value) dict[py::str(key)] = python_of(item);
    return dict;
  } else if constexpr (sim::record::is_time<T>) {
    return py::float_(sim::seconds(value));
  } else if constexpr (std::is_enum_v<T>) {
    return py::str(sim::record::word_of(value));
  } else {
    return py::cast(value);
  }
}

// Each adds its part to the module.
void add_line(py::module_& module);
void add_cams(py::module_& module);
void add_runs(py::module_& module);
void add_studies(py::module_& module);
void add_fits(py::module_& module);
void add_verbs(py::module_& module);

}  // namespace drycut::python
