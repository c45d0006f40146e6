#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/verb.hpp"
#include "sim/studies/why/report.hpp"

namespace drycut::sim::cli {

namespace {

struct WhyOptions {
  studies::WhyRequest request;
  std::filesystem::path out = "out/why";
  bool pictures = true;
};

int why(const WhyOptions& options) {
  const auto& [request, out, pictures] = options;
  Problems problems;
  for (const auto& run : {request.run, request.good}) {
    std::error_code ignored;
    if (!run.empty() && std::filesystem::equivalent(out, run, ignored))
      problems.push_back({"compare.runs"_code, "--out", 1, 1,
                          fmt::format("{} is one of the runs", out.string()), "name another folder"});
  }
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(out, "why", studies::why_files, problems);
  std::optional<studies::WhyFound> found;
  ProgressBar bar;
  if (problems.empty())
    found = studies::find_why(request, problems,
                              [&](const char* doing, double share) { bar.show(doing, share); });
  bar.clear();
  if (!found || !problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  folder->begin();
  const int status = studies::write_why(*found, *folder, pictures);
  for (const auto& sentence : studies::why_sentences(*found)) fmt::print("{}\n", printable(sentence));
  if (found->runs > 0) fmt::print("{} simulated\n", counted(found->runs, "run"));
  fmt::print("{}\n", pictures ? "report: " + (out / "report.html").string()
                              : "results: " + (out / studies::why_file).string());
  return status;
}

int why_run(const WhyOptions& options) {
  try {
    return why(options);
  } catch (const std::exception& error) {
    return print_failure(fmt::format("{}: {}", options.out.string(), drycut::words_of(error)));
  }
}

void why_options(CLI::App& why, int& status) {
  const auto chosen = std::make_shared<WhyOptions>();
  auto& options = *chosen;
  why.add_option("run", options.request.run, "Folder of a run that failed, or a scenario that fails")
      ->required();
  why.add_option(
      "--good", options.request.good,
      "Folder of a run, or a scenario, that passes: the least difference that makes it fail is looked for");
  why.add_option("--check", options.request.check,
                 "The check that is asked about; else the one that failed first");
  why.add_option("--budget", options.request.budget, "Simulated runs, all together")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  why.add_option("--jobs", options.request.jobs, "Runs at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_out(why, options.out, "Directory for the results");
  add_no_pictures(why, options.pictures, "No plots and no report");
  why.callback([chosen, &status] { status = why_run(*chosen); });
}

}  // namespace

Verb why_verb() {
  return {"why",
          "Say why a run failed: the first sign of it and the chain before it; with --good the least "
          "difference that\n"
          "turns good into failed, the channel that parts first, and until when taking it away still saves "
          "the run.\n"
          "Exit status: 0 a cause was found, 1 none within the budget, 2 bad input, 3 a result could not be "
          "written",
          {"drycut why out/rotary_knife", "drycut why out/b/rotary_knife --good out/a/rotary_knife"},
          {"run", {FileKind::run_folder, FileKind::scenario, FileKind::folder}},
          why_options};
}

}  // namespace drycut::sim::cli
