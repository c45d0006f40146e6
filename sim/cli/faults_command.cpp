#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/plain_text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/output_folder.hpp"
#include "sim/studies/faults/report.hpp"
#include "sim/studies/faults/study.hpp"

namespace drycut::sim::cli {

namespace {

constexpr auto* faults_file = "faults.csv";
constexpr auto* cells_cache = "cells.cache";  // goes on where it ended

struct FaultsOptions {
  std::filesystem::path scenario;
  int moments = 100;
  bool at_events = false;
  std::vector<std::string> only;
  std::filesystem::path accept;
  std::vector<std::string> set;
  int jobs = 1;
  ClusterOptions cluster;
  std::filesystem::path out = "out/faults";
};

void print_faults(const FaultsOptions& options, const studies::FaultQuestion& question,
                  const studies::FaultMatrix& matrix, const std::vector<Finding>& findings,
                  const record::Verdict& verdict) {
  for (const auto* list : {&question.notes, &findings})
    for (const auto& note : *list) fmt::print("  note {}\n", printable(to_string(note)));
  const auto red = studies::failing_lines(question, matrix);
  for (const auto& line : red) fmt::print("  RED {}\n", printable(line));
  fmt::print("{}: {}\nreport: {}\n{} cells simulated now\n", printable(question.file.stem().string()),
             printable(verdict.sentence), (options.out / "report.html").string(), matrix.simulated);
  print_left_out(matrix.lost);
}

int try_all(const FaultsOptions& options, const studies::FaultQuestion& question,
            const std::vector<studies::AcceptedCells>& accepted, OutputFolder& folder) {
  Problems problems;
  const auto workers = workers_of(options.cluster, options.jobs, options.out, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  folder.begin_aside({cells_cache});
  ProgressBar bar;
  auto matrix =
      studies::try_faults(question, folder.add(cells_cache), workers, [&](std::size_t done, std::size_t of) {
        bar.show("trying faults", static_cast<double>(done) / static_cast<double>(of));
      });
  bar.clear();
  const auto findings = studies::accept_cells(question, accepted, matrix);
  write_file(folder.add(faults_file), studies::faults_table(question, accepted, matrix).csv());
  const auto verdict = studies::write_faults_report(question, accepted, matrix, findings, folder);
  record::write_verdict(verdict, folder);
  folder.finish();
  print_faults(options, question, matrix, findings, verdict);
  return verdict.exit;
}

int faults_of_scenario(const FaultsOptions& options) {
  Problems problems;
  studies::FaultQuestion question;
  question.file = options.scenario;
  question.moments = options.moments;
  question.at_events = options.at_events;
  question.only = options.only;
  question.set = overrides_of(options.set, problems);
  std::vector<studies::AcceptedCells> accepted;
  if (!options.accept.empty()) accepted = studies::read_accepted(options.accept, problems);
  if (auto text = read_file(options.scenario, problems); text && problems.empty()) {
    question.text = std::move(*text);
    studies::prepare(question, problems);
  }
  std::optional<OutputFolder> folder;
  if (problems.empty()) {
    std::vector<std::string> files = {faults_file, cells_cache};
    files.insert(files.end(), studies::fault_pages.begin(), studies::fault_pages.end());
    folder.emplace(options.out, "faults", files, problems);
  }
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  try {
    return try_all(options, question, accepted, *folder);
  } catch (const std::exception& error) {
    return print_failure(fmt::format("{}: {}", options.out.string(), drycut::words_of(error)));
  }
}

void faults_options(CLI::App& faults, int& status) {
  const auto chosen = std::make_shared<FaultsOptions>();
  auto& options = *chosen;
  faults.add_option("scenario", options.scenario, "Scenario file (.yaml)")->required();
  faults.add_option("--moments", options.moments, "Moments, spread evenly over a machine cycle")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  faults.add_flag("--at-events", options.at_events, "Also when each kind of event happens first");
  faults
      .add_option("--only", options.only,
                  "Faults by a pattern of their full names, such as \"knife.encoder.*\" or \"wire.*\"; may "
                  "be repeated")
      ->allow_extra_args(false);
  faults.add_option(
      "--accept", options.accept,
      "File of cells that are accepted: a list of {fault: ..., when: ..., cell: wrong, why: ...}");
  faults.add_option("--jobs", options.jobs, "Branches at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_on(faults, options.cluster);
  add_set(faults, options.set, "scenario");
  add_out(faults, options.out, "Directory for the results; cells in it are not tried again");
  faults.callback([chosen, &status] { status = faults_of_scenario(*chosen); });
}

}  // namespace

Verb faults_verb() {
  return {
      "faults",
      "Try every fault of plants, wires and mains at every moment of a machine cycle: faults.csv, a row a "
      "fault and moment, and a matrix that says where the line makes wrong product or breaks and nobody is "
      "told.\nEach is a branch from a kept state of one run.",
      {"drycut faults scenes/rotary_knife.yaml --moments 100 --jobs 2",
       "drycut faults scenes/flying_saw.yaml --only \"wire.*\" --at-events"},
      {"scenario", {FileKind::scenario}},
      faults_options};
}

}  // namespace drycut::sim::cli
