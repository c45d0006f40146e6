#include "sim/cli/compare_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "base/output_file.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/verb.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/studies/compare/alignment.hpp"
#include "sim/studies/compare/explained.hpp"
#include "sim/studies/compare/measured_report.hpp"
#include "sim/studies/compare/report.hpp"

namespace drycut::sim::cli {

namespace {

namespace fs = std::filesystem;

std::optional<double> from_of(const CompareOptions& options, Problems& problems) {
  if (options.from.empty()) return {};
  scenario::Findings findings({"--from"});
  const auto time =
      scenario::read_time({options.from, {1, 1}}, "--from", scenario::Sign::not_negative, findings);
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  if (!time) return {};
  return seconds(*time);
}

void refuse_own_run(const CompareOptions& options, std::size_t run, Problems& problems) {
  std::error_code ignored;
  if (fs::equivalent(options.out, options.runs[run], ignored))
    problems.push_back({"compare.runs"_code, "--out", 1, 1,
                        fmt::format("{} is one of the runs", options.out.string()),
                        "the comparison would replace its report; name another folder"});
}

std::vector<studies::ComparedRun> read_runs(const CompareOptions& options, Problems& problems) {
  if (options.runs.size() < 2) {
    problems.push_back({"compare.runs"_code, options.runs.empty() ? "compare" : options.runs[0].string(), 1,
                        1, "one run alone is nothing to compare", "name two folders of runs or more"});
  }
  const auto labels = studies::labels_of(options.runs, problems);
  std::vector<studies::ComparedRun> runs;
  for (std::size_t i = 0; i < options.runs.size(); ++i) {
    refuse_own_run(options, i, problems);
    runs.push_back(studies::read_run(options.runs[i], problems));
    runs.back().label = labels[i];
  }
  return runs;
}

/// Its names are known when the runs have been read.
studies::Allowances allowances_of(const CompareOptions& options,
                                  const std::vector<studies::ComparedRun>& runs, std::optional<double> from,
                                  Problems& problems) {
  auto allowances = studies::read_allowances(options.tolerances, problems);
  if (!problems.empty() || allowances.named.empty()) return allowances;
  std::vector<std::pair<std::string, std::string>> figures;
  for (const auto& figure : studies::compare_events(runs, from))
    figures.emplace_back(figure.name, figure.unit);
  studies::check_allowances(allowances, runs, figures, problems);
  return allowances;
}

/// What the page is headed with where the exit status says it, too.
void judge(const CompareOptions& options, const studies::Comparison& comparison,
           studies::ComparisonPage& page) {
  page.verdict = studies::difference_text(comparison);
  if (options.tolerances.empty() && !options.fail_on_difference) return;
  page.tolerances = options.tolerances;
  page.checks = studies::judgement(comparison, options.fail_on_difference);
  page.passed = options.fail_on_difference ? studies::same(comparison) : studies::kept(comparison);
  if (*page.passed && !options.tolerances.empty())
    page.verdict = comparison.parameters.empty()
                       ? "no difference beyond the tolerance"
                       : "no difference beyond the tolerance but parameters in force";
}

bool is_measured(const fs::path& run) { return kind_of(run) == FileKind::recording; }

/// What goes with runs only.
void refuse_options_of_runs(const CompareOptions& options, Problems& problems) {
  const auto refuse = [&](const char* option, const char* what, const char* remedy) {
    problems.push_back({"scenario.does-not-go-together"_code, option, 1, 1, what, remedy});
  };
  if (options.runs.size() != 2 || std::ranges::count_if(options.runs, is_measured) != 1)
    problems.push_back({"compare.runs"_code, options.runs[0].string(), 1, 1,
                        "a recording is compared with one run",
                        "name one recording and one folder of a run"});
  if (options.fail_on_difference)
    refuse("--fail-on-difference", "what was measured is never quite what is simulated",
           "say how far apart they may be: --tolerance NAME=1mm");
  if (!options.align.empty())
    refuse("--align", "a recording is laid over the run by the clock", "leave --align out");
}

int compare_with_recording(const CompareOptions& options) {
  Problems problems;
  refuse_options_of_runs(options, problems);
  for (std::size_t i = 0; i < options.runs.size(); ++i) refuse_own_run(options, i, problems);
  const auto from = from_of(options, problems);
  studies::MeasuredRun measured;
  if (problems.empty()) {
    const bool first = is_measured(options.runs[0]);
    measured = studies::measure_run(options.runs[first ? 0 : 1], options.runs[first ? 1 : 0],
                                    from.value_or(0), options.without, options.tolerances, problems);
  }
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "compare", studies::comparison_files, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  int status = all_passed;
  const auto hints = studies::explained_table(measured);
  try {
    folder->begin();
    status = studies::write_measured(measured, hints, options.tolerances, *folder, options.pictures);
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
  fmt::print("{}", studies::residual_table(measured).text(0));
  if (!hints.rows().empty()) fmt::print("\n{}\n", hints.text(0));
  fmt::print("{}\n", studies::residual_sentence(measured));
  for (const auto& channel : measured.only_measured)
    fmt::print("  note {} was not recorded in the run\n", channel);
  fmt::print("  {}\n", options.pictures ? "report: " + (options.out / "report.html").string()
                                        : "results: " + options.out.string());
  return status;
}

}  // namespace

int compare_runs(const CompareOptions& options) {
  if (std::ranges::any_of(options.runs, is_measured)) return compare_with_recording(options);
  Problems problems;
  auto runs = read_runs(options, problems);
  const auto from = from_of(options, problems);
  studies::leave_out(runs, options.without, problems);
  studies::align(runs, options.align, problems);
  const auto allowances = allowances_of(options, runs, from, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "compare", studies::comparison_files, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  const auto comparison = studies::compare(std::move(runs), from, allowances);
  studies::ComparisonPage page;
  for (const auto& run : comparison.runs) {
    page.title += (page.title.empty() ? "" : " against ") + run.label;
    page.source += (page.source.empty() ? "" : ", ") + run.folder.string();
  }
  judge(options, comparison, page);
  int status = all_passed;
  try {
    folder->begin();
    status = studies::write_comparison(comparison, page, *folder, options.pictures);
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
  fmt::print("{}: {}", page.title, studies::comparison_text(comparison, page.passed.has_value()));
  if (page.passed)
    fmt::print("  {}: {}\n", *page.passed ? "PASS" : "FAIL",
               *page.passed                 ? "kept"
               : options.fail_on_difference ? "not the same"
                                            : "beyond the tolerance");
  fmt::print("  {}\n", options.pictures ? "report: " + (options.out / "report.html").string()
                                        : "results: " + options.out.string());
  return status;
}

namespace {

void compare_options(CLI::App& compare, int& status) {
  const auto chosen = std::make_shared<CompareOptions>();
  auto& options = *chosen;
  compare
      .add_option("runs", options.runs,
                  "Folders that drycut run made, such as out/rotary_knife; or a recording of the real "
                  "machine and one folder")
      ->required();
  add_out(compare, options.out, "Directory for the results");
  compare.add_option(
      "--from", options.from,
      "Figures look from this time on, as \"4 s\"; else where the plot with the limits begins");
  compare.add_flag("--fail-on-difference", options.fail_on_difference,
                   "Exit status 1 where the runs are not the same");
  compare
      .add_option("--tolerance", options.tolerances,
                  "NAME=0.01mm, or a part of the largest value: NAME=0.1%, NAME=1e-6; without NAME for all "
                  "else, 1e-7 unless given. NAME: a channel, a value of events (length, knife.cut.length), a "
                  "figure, a check's margin, time. Exit status 1 beyond it; parameters do not count; may be "
                  "repeated")
      ->allow_extra_args(false);
  compare.add_option("--without", options.without, "Channels to leave out, as gbTour,Axis.*")
      ->delimiter(',')
      ->allow_extra_args(false);
  compare.add_option(
      "--align", options.align,
      "Event or recorded channel, as cut or gbPlace: each time it happens, or changes, the runs "
      "are laid over each other anew; else by the clock");
  add_no_pictures(compare, options.pictures, "No plots and no report");
  compare.callback([chosen, &status] { status = compare_runs(*chosen); });
}

}  // namespace

Verb compare_verb() {
  return {
      "compare",
      "Compare runs: checks, cuts and other events, channels, parameters in force; report.html, plots and\n"
      "comparison.csv. With a recording of the real machine: what the run leaves of each measured channel.\n"
      "Exit status: 0 compared, 1 different and --fail-on-difference or --tolerance, 2 bad input, 3 a "
      "result\n"
      "could not be written",
      {"drycut compare out/before out/after",
       "drycut compare goldens/rotary_knife out/rotary_knife --tolerance length=0.01mm",
       "drycut compare scope.yaml out/line --tolerance axis.position=0.5mm"},
      {"runs", {FileKind::run_folder, FileKind::folder, FileKind::recording}},
      compare_options};
}

}  // namespace drycut::sim::cli
