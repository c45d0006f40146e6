// The program `drycut`: reads the command line and calls what does the work (sim/cli/commands.hpp).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/help.hpp"
#include "sim/cli/usage.hpp"
#include "sim/interrupt.hpp"

namespace {

using namespace drycut;
using namespace drycut::sim::cli;

int run(int argc, char** argv) {
  CLI::App app{"drycut: virtual commissioning for cut-to-length lines"};
  app.set_version_flag("--version", version_text());
  int status = all_passed;

  add_commands(app, status);

  const auto commands = app.get_subcommands({});
  const auto is_named = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && std::none_of(commands.begin(), commands.end(), is_named)) {
    std::vector<std::string> names;
    for (const auto* command : commands)
      if (!command->get_group().empty()) names.push_back(command->get_name());
    fmt::print(stderr, "drycut: there is no command '{}'; {} [option.unknown-choice]\n", argv[1],
               did_you_mean(argv[1], names));
    return bad_input;
  }
  for (int i = 1; i < argc; ++i) {
    const auto fault = text_fault(argv[i]);
    if (!fault) continue;
    fmt::print(stderr, "drycut: in argument {} {}: {} [option.value]\n", i, fault->what, printable(argv[i]));
    return bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    app.exit(asked);
  } catch (const CLI::RuntimeError& told) {
    return told.get_exit_code();
  } catch (const CLI::ParseError& error) {
    tell_usage(app, error);
    return bad_input;
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  // What cannot be told, because standard error takes nothing either, is still told by the status.
  const auto failed = [](const std::string& what) {
    std::fputs(("drycut: " + what + " [run.failed]\n").c_str(), stderr);
    return simulation_failed;
  };
  try {
    const int status = run(argc, argv);
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
