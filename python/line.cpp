// Simulation, step by step. Programs call its read, write, step and advance every millisecond of the machine:
// those four are methods of plain C, at a third of what pybind11's cost.
#include <array>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "devices/controller.hpp"
#include "python/shared.hpp"
#include "sim/loop/names.hpp"

namespace drycut::python {

namespace {

/// A simulation that one thread at a time works on. Whoever asks holds the interpreter's lock.
class PythonLine {
 public:
  PythonLine(const std::filesystem::path& file, const Settings& set) : simulation_(file, set) {}

  Simulation& own() {
    if (busy_) throw std::runtime_error("another thread steps this simulation now");
    return simulation_;
  }
  /// `work` on the simulation, while other threads run.
  template <typename Work>
  void unlocked(const Work& work) {
    auto& simulation = own();
    const Busy busy(busy_);
    const Unlocked others;
    work(simulation);
  }

 private:
  struct Busy {
    explicit Busy(bool& flag) : flag(flag) { flag = true; }
    ~Busy() { flag = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    bool& flag;
  };
  struct Unlocked {
    Unlocked() = default;
    ~Unlocked() { PyEval_RestoreThread(state); }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;
    PyThreadState* state = PyEval_SaveThread();
  };

  Simulation simulation_;
  bool busy_ = false;
};

PythonLine& line_of(PyObject* self) {
  auto* const instance = reinterpret_cast<py::detail::instance*>(self);
  auto* const line = static_cast<PythonLine*>(instance->get_value_and_holder().value_ptr());
  if (line == nullptr) throw std::runtime_error("Simulation.__init__ was not called");
  return *line;
}

/// Arguments of a call, in their order.
template <std::size_t count>
using Taken = std::array<PyObject*, count>;
template <std::size_t count>
using ArgumentList = std::array<const char*, count>;

[[noreturn]] void no_such_call(const std::string& what) {
  PyErr_SetString(PyExc_TypeError, what.c_str());
  throw py::error_already_set();
}

/// By place or by name.
template <std::size_t count>
Taken<count> taken(const ArgumentList<count>& names, PyObject* const* given, Py_ssize_t places,
                   PyObject* keywords) {
  Taken<count> taken = {};
  const auto placed = static_cast<std::size_t>(places);
  const auto named =
      keywords == nullptr ? std::size_t{0} : static_cast<std::size_t>(PyTuple_GET_SIZE(keywords));
  if (placed + named != count)
    no_such_call(std::to_string(placed + named) + " arguments are given, it takes " + std::to_string(count));
  std::copy(given, given + places, taken.begin());
  for (std::size_t i = 0; i < named; ++i) {
    auto* const key = PyTuple_GET_ITEM(keywords, static_cast<Py_ssize_t>(i));
    std::size_t place = placed;
    while (place < count && PyUnicode_CompareWithASCIIString(key, names[place]) != 0) ++place;
    if (place == count || taken[place] != nullptr)
      no_such_call("there is no argument " + std::string(py::str(py::repr(key))) + " left");
    taken[place] = given[placed + i];
  }
  return taken;
}

std::string text_of(PyObject* object) {
  if (!PyUnicode_Check(object)) no_such_call("a name is a str");
  Py_ssize_t size = 0;
  const char* const text = PyUnicode_AsUTF8AndSize(object, &size);
  if (text == nullptr) throw py::error_already_set();
  return {text, static_cast<std::size_t>(size)};
}

double number_of(PyObject* object) {
  const double number = PyFloat_AsDouble(object);
  if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  return number;
}

/// What `work` gives; nullptr with Python's error set where it throws.
template <typename Work>
PyObject* answered(const Work& work) noexcept {
  try {
    return work();
  } catch (py::error_already_set& error) {
    error.restore();
  } catch (...) {
    try {
      translate(std::current_exception());
    } catch (const std::exception& error) {
      PyErr_SetString(PyExc_RuntimeError, error.what());
    }
  }
  return nullptr;
}

PyObject* nothing() {
  Py_INCREF(Py_None);
  return Py_None;
}

PyObject* read(PyObject* self, PyObject* const* given, Py_ssize_t places, PyObject* keywords) {
  return answered([&] {
    const auto [name] = taken<1>({"name"}, given, places, keywords);
    return PyFloat_FromDouble(line_of(self).own().read(text_of(name)));
  });
}

PyObject* write(PyObject* self, PyObject* const* given, Py_ssize_t places, PyObject* keywords) {
  return answered([&] {
    const auto [name, value] = taken<2>({"name", "value"}, given, places, keywords);
    line_of(self).own().write(text_of(name), number_of(value));
    return nothing();
  });
}

PyObject* advance(PyObject* self, PyObject* const* given, Py_ssize_t places, PyObject* keywords) {
  return answered([&] {
    const auto [seconds] = taken<1>({"seconds"}, given, places, keywords);
    line_of(self).unlocked(
        [number = number_of(seconds)](Simulation& simulation) { simulation.advance(number, listen); });
    return nothing();
  });
}

PyObject* step(PyObject* self, PyObject* /*nothing*/) {
  return answered([&] {
    line_of(self).unlocked([](Simulation& simulation) { simulation.step(); });
    return nothing();
  });
}

using Method = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);
PyMethodDef method(const char* name, Method call, const char* help) {
  // Python keeps functions of every kind in one type.
  return {name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call)),
          METH_FASTCALL | METH_KEYWORDS, help};
}

std::array methods = {
    method("read", read,
           "read($self, name)\n--\n\nThe number under a name as it is now, in unit(name). Raises BadInput if "
           "nothing has this name."),
    method(
        "write", write,
        "write($self, name, value)\n--\n\nSets what a timeline may set: a plant's setting, a panel switch "
        "(0, 1), a value of the\ncontroller, which takes it as from an HMI. In unit(name). Raises BadInput "
        "if nothing has this\nname, it can only be read, or the number is beyond its range."),
    method("advance", advance,
           "advance($self, seconds)\n--\n\nSo many seconds, 0 or more, rounded to whole steps. Other threads "
           "run meanwhile, Ctrl-C ends it.\nRaises Diverged; BadInput for other numbers."),
    PyMethodDef{"step", step, METH_NOARGS,
                "step($self)\n--\n\nOne step of the machine, `step_length` [s] long. Raises Diverged."},
};

py::list events_of(PythonLine& line) {
  py::list events;
  for (const auto& e : line.own().take_events())
    events.append(py::make_tuple(e.time, e.source, e.name, e.values, e.text));
  return events;
}

}  // namespace

void add_line(py::module_& module) {
  const auto type =
      py::class_<PythonLine>(module, "Simulation")
          .def(py::init<const std::filesystem::path&, const Settings&>(), "file"_a, "set"_a,
               py::call_guard<py::gil_scoped_release>())
          .def_property_readonly("time", [](PythonLine& line) { return line.own().time(); })
          .def_property_readonly("step_length", [](PythonLine& line) { return line.own().step_length(); })
          .def_property_readonly("duration", [](PythonLine& line) { return line.own().duration(); })
          .def("names", [](PythonLine& line) { return line.own().names(); })
          .def(
              "unit", [](PythonLine& line, const std::string& name) { return line.own().unit(name); },
              "name"_a)
          .def("save",
               [](PythonLine& line) {
                 const auto moment = line.own().save();
                 return py::bytes(reinterpret_cast<const char*>(moment.data()), moment.size());
               })
          .def(
              "restore",
              [](PythonLine& line, const py::bytes& moment) {
                const auto text = static_cast<std::string_view>(moment);
                const auto* const begin = reinterpret_cast<const std::byte*>(text.data());
                line.own().restore({begin, begin + text.size()});
              },
              "moment"_a)
          .def("take_events", events_of)
          .def("checks", [](PythonLine& line) { return python_of(line.own().checks()); });
  for (auto& each : methods) {
    const auto made = py::reinterpret_steal<py::object>(
        PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(type.ptr()), &each));
    if (!made) throw py::error_already_set();
    type.attr(each.ml_name) = made;
  }
}

}  // namespace drycut::python
