// A command line, read and done: of the program `drycut` and of Python.
#include "sim/cli/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/help.hpp"
#include "sim/cli/usage.hpp"

namespace drycut::sim::cli {

namespace {

thread_local Problems* kept_problems = nullptr;

}  // namespace

void print_problems(const Problems& problems) {
  for (const auto& problem : problems) fmt::print(stderr, "{}\n", printable(to_string(problem)));
  if (kept_problems != nullptr) kept_problems->insert(kept_problems->end(), problems.begin(), problems.end());
}

int print_failure(const std::string& why) {
  fmt::print(stderr, "{} [run.failed]\n", printable(why));
  return simulation_failed;
}

void print_left_out(const std::vector<std::string>& lost) {
  for (const auto& what : lost) fmt::print(stderr, "{} [run.left-out]\n", printable(what));
}

ProblemKeeper::ProblemKeeper(Problems& problems) { kept_problems = &problems; }
ProblemKeeper::~ProblemKeeper() { kept_problems = nullptr; }

int run_program(std::vector<std::string> words) {
  CLI::App app{"drycut: virtual commissioning for cut-to-length lines", "drycut"};
  app.set_version_flag("--version", version_text);
  int status = all_passed;

  add_commands(app, status);

  const auto commands = app.get_subcommands({});
  const auto is_named = [&](const CLI::App* command) { return command->get_name() == words[0]; };
  if (!words.empty() && !words[0].starts_with('-') && std::ranges::none_of(commands, is_named)) {
    std::vector<std::string> names;
    for (const auto* command : commands)
      if (!command->get_group().empty()) names.push_back(command->get_name());
    fmt::print(stderr, "drycut: there is no command '{}'; {} [option.unknown-choice]\n", words[0],
               did_you_mean(words[0], names));
    return bad_input;
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto fault = text_fault(words[i]);
    if (!fault) continue;
    fmt::print(stderr, "drycut: in argument {} {}: {} [option.value]\n", i + 1, fault->what,
               printable(words[i]));
    return bad_input;
  }
  try {
    std::ranges::reverse(words);  // as it is taken
    app.parse(std::move(words));
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

}  // namespace drycut::sim::cli
