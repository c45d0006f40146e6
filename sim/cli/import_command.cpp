#include "sim/cli/import_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "base/output_file.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/recordings/guess.hpp"
#include "sim/recordings/recording.hpp"

namespace drycut::sim::cli {

namespace {

/// Whether a file may be written over by `text`: it is not there, or says the same, or is to be replaced.
void check_unchanged(const ImportOptions& options, const std::string& text, Problems& problems) {
  std::error_code ignored;
  if (options.out.empty() || options.force || !std::filesystem::is_regular_file(options.out, ignored)) return;
  Problems unread;
  const auto there = read_file(options.out, unread);
  if (there == text || (there && there->empty())) return;
  problems.push_back({"file.not-ours"_code, options.out.string(), 1, 1,
                      "it is there already and is not what import would write: it may have been corrected",
                      "name another file, or replace it with --force"});
}

/// What the whole file has to say, where the guess is enough to read it.
void tell_doubts(const std::string& yaml, const std::filesystem::path& beside, Problems& problems) {
  Problems incomplete;
  const auto recording = recordings::read_recording_text(yaml, beside, incomplete);
  if (!incomplete.empty()) {
    fmt::print(stderr, "note: it is not whole yet: add what the comments ask for, then drycut check\n");
    return;
  }
  std::vector<Finding> findings;
  recordings::load(recording, problems, findings);
  for (const auto& finding : findings)
    fmt::print(stderr, "{} {}\n", words_of(finding.role).at(static_cast<std::size_t>(finding.role)),
               to_string(finding));
}

}  // namespace

int import_file(const ImportOptions& options) {
  Problems problems;
  const auto yaml = options.out.empty() ? options.file.parent_path() / "recording.yaml" : options.out;
  if (!options.out.empty())
    check_output("--out", options.out.string(), {options.file, "export"}, {options.force}, problems);
  const auto guess = recordings::guess(options.file, yaml, problems);
  if (problems.empty()) {
    const auto text = recordings::write(guess);
    fmt::print("{}", text);
    std::fflush(stdout);  // before what is told of it
    check_unchanged(options, text, problems);
    tell_doubts(text, yaml, problems);
    try {
      if (problems.empty() && !options.out.empty()) write_file(options.out, text);
    } catch (const std::exception& error) {
      return print_failure(drycut::words_of(error));
    }
  }
  if (problems.empty()) return all_passed;
  print_problems(problems);
  return bad_input;
}

namespace {

void import_options(CLI::App& import, int& status) {
  const auto chosen = std::make_shared<ImportOptions>();
  auto& options = *chosen;
  import.add_option("file", options.file, "Export of a scope or drive tool, as text")->required();
  import.add_option("--out", options.out,
                    "Write the guess to this file, too; one that says anything else stays");
  add_force(import, options.force);
  import.callback([chosen, &status] { status = import_file(*chosen);
});
}  // namespace

}  // namespace drycut::sim::cli

Verb import_verb() {
  return {
      "import",
      "Read a recording of a real machine, guess its format, columns and units, and show the guess as YAML.\n"
      "Comments say what it rests on and what the file leaves open; --out writes it.\n"
      "Exit status: 0 guessed, 2 bad input, 3 it could not be written",
      {"drycut import scope.csv --out scope.yaml"},
      {},
      import_options};
}

}  // namespace drycut::sim::cli
