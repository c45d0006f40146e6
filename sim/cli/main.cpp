// The program `drycut`: reads the command line and calls what does the work (sim/cli/program.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>

#include "base/output_file.hpp"
#include "sim/cli/program.hpp"
#include "sim/interrupt.hpp"
#include "sim/record/verdict.hpp"

using namespace drycut::sim::cli;
using drycut::sim::record::interrupted_status;
using drycut::sim::record::simulation_failed;

int main(int argc, char** argv) {
  // What cannot be told, because standard error takes nothing either, is still told by the status.
  const auto failed = [](const std::string& what) {
    std::fputs(("drycut: " + what + " [run.failed]\n").c_str(), stderr);
    return simulation_failed;
  };
  try {
    const int status = run_program({argv + std::min(argc, 1), argv + argc});
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return status;
    return failed(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
  } catch (const drycut::sim::Interrupted& interrupted) {
    // All is cleared up: it ends as the signal would have ended it.
    std::signal(interrupted.signal, SIG_DFL);
    std::raise(interrupted.signal);
    return interrupted_status;
  } catch (const std::exception& error) {
    return failed(drycut::words_of(error));
  }
}
