// The verbs of the command line: Python's faces are made of the same rows (sim/cli/verb.hpp), and a call is a
// command line, so that it prints and writes the same bytes.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <stdexcept>

#include "base/output_file.hpp"
#include "python/shared.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/help.hpp"
#include "sim/cli/program.hpp"
#include "sim/cli/verb.hpp"
#include "sim/interrupt.hpp"

namespace drycut::python {

namespace {

namespace cli = sim::cli;

/// While it lives, what the process writes to a descriptor is kept.
class Catcher {
 public:
  explicit Catcher(int descriptor)
      : descriptor_(descriptor), before_(dup(descriptor)), kept_(memfd_create("drycut", MFD_CLOEXEC)) {
    if (before_ < 0 || kept_ < 0 || dup2(kept_, descriptor_) < 0)
      throw std::runtime_error("what a verb prints cannot be kept");
  }
  ~Catcher() {
    dup2(before_, descriptor_);
    close(before_);
    close(kept_);
  }
  Catcher(const Catcher&) = delete;
  Catcher& operator=(const Catcher&) = delete;
  [[nodiscard]] std::string text() const {
    std::string text(static_cast<std::size_t>(lseek(kept_, 0, SEEK_END)), '\0');
    const auto read = pread(kept_, text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read)));
    return text;
  }

 private:
  int descriptor_;
  int before_;
  int kept_;
};

void flush() {
  std::cout.flush();
  std::fflush(stdout);
  std::fflush(stderr);
}

struct Ran {
  int status = 0;
  std::string out;
  std::string err;
};

/// One at a time: the descriptors are the process' own.
Ran run_line(std::vector<std::string> words) {
  static std::mutex one;
  const std::lock_guard lock(one);
  Ran ran;
  const sim::InterruptWatch watch(sim::InterruptWatch::Ends::at_progress);
  flush();
  const Catcher out(STDOUT_FILENO);
  const Catcher err(STDERR_FILENO);
  try {
    ran.status = cli::run_program(std::move(words));
  } catch (const sim::Interrupted&) {
    ran.status = cli::interrupted_status;
  } catch (const std::exception& error) {
    fmt::print(stderr, "drycut: {}\n", words_of(error));
    ran.status = cli::simulation_failed;
  }
  flush();
  ran.out = out.text();
  ran.err = err.text();
  return ran;
}

py::tuple command(const std::vector<std::string>& words) {
  Ran ran;
  Problems problems;
  {
    const py::gil_scoped_release unlocked;
    const cli::ProblemKeeper keeper(problems);
    ran = run_line(words);
  }
  if (ran.status == cli::bad_input && !problems.empty()) refuse(problems);
  // Texts that are no UTF-8 are none of ours: the name of a file.
  const auto text = [](const std::string& bytes) {
    return py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
  };
  return py::make_tuple(ran.status, text(ran.out), text(ran.err));
}

/// Each verb: name, what it does, and its options as (name, positional, flag, several,
/// required, default, meaning).
py::list verbs() {
  CLI::App app{"drycut", "drycut"};
  int status = 0;
  cli::add_commands(app, status);
  py::list all;
  for (const auto& verb : cli::verbs()) {
    if (verb.shown == cli::Verb::Shown::no) continue;
    const auto* command = app.get_subcommand(std::string(verb.name));
    py::list options;
    for (const auto* option : command->get_options()) {
      if (option == command->get_help_ptr()) continue;
      const bool positional = option->get_positional();
      options.append(py::make_tuple(positional ? option->get_name(true) : "--" + option->get_lnames().front(),
                                    positional, option->get_expected_max() == 0,
                                    option->get_expected_max() > 1 || option->get_items_expected_max() > 1,
                                    option->get_required(), option->get_default_str(),
                                    option->get_description()));
    }
    all.append(py::make_tuple(verb.name, verb.help, options));
  }
  return all;
}

}  // namespace

void add_verbs(py::module_& module) {
  module.def("verbs", verbs);
  module.def("command", command, "words"_a);
}

}  // namespace drycut::python
