#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "base/output_file.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/verb.hpp"
#include "sim/studies/fit/move_files.hpp"
#include "sim/studies/fit/report.hpp"

namespace drycut::sim::cli {

namespace {

struct FitOptions {
  studies::FitRequest request;
  std::vector<std::string> set;
  std::filesystem::path out;  ///< "": out/fit, of a plan out/fit_plan
  bool plan = false;
  bool pictures = true;
};

/// Proposes the move to record.
int plan(const FitOptions& options, Problems& problems) {
  studies::FitPlan plan;
  plan.request = options.request;
  for (const auto& [option, files] :
       {std::pair{"--recording", &options.request.recordings}, std::pair{"--test", &options.request.tests}})
    if (!files->empty())
      problems.push_back({"option.together"_code, option, 1, 1,
                          "a plan is made without recordings, for there are none yet",
                          "--plan, or recordings"});
  if (options.request.closed)
    problems.push_back({"option.together"_code, "--closed", 1, 1, "a plan is a move, and closes no loop",
                        "--plan, or --closed"});
  const auto move = studies::plan_move(plan, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "fit plan", studies::move_files, problems);
  if (!problems.empty() || !move) {
    print_problems(problems);
    return bad_input;
  }
  folder->begin();
  studies::write_move(plan, *move, *folder);
  fmt::print("{}", studies::move_summary(*move));
  fmt::print("the move: {}\n", (options.out / "move.txt").string());
  return all_passed;
}

int fit(FitOptions options) {
  Problems problems;
  options.request.set = overrides_of(options.set, problems);
  if (options.out.empty()) options.out = options.plan ? "out/fit_plan" : "out/fit";
  if (options.plan) return plan(options, problems);
  const auto plan = studies::plan_fit(options.request, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "fit", studies::fit_files, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  folder->begin();
  ProgressBar bar;
  double share = 0;
  auto found = studies::fit(plan.question, plan.recordings, options.request.jobs, [&](const char* doing) {
    bar.show(doing, share);
    share += 1.0 / 4;
  });
  if (!plan.tests.empty()) {
    bar.show("cross test", share);
    studies::cross_test(plan.question, plan.tests, options.request.limit, options.request.jobs, found);
  }
  bar.clear();
  for (const auto& finding : plan.findings) found.tell(finding);
  const int status = studies::write_fit(plan, found, *folder, options.pictures);
  fmt::print("{}", studies::fit_text(found));
  fmt::print("scenario with these values: {}\n", (options.out / studies::fitted_file).string());
  if (options.pictures) fmt::print("report: {}\n", (options.out / "report.html").string());
  return status;
}

int fit_machine(const FitOptions& options) {
  try {
    return fit(options);
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
}

void fit_options(CLI::App& fit, int& status) {
  const auto chosen = std::make_shared<FitOptions>();
  auto& options = *chosen;
  fit.add_option("scenario", options.request.scenario, "Scenario file (.yaml) of the machine")->required();

  fit.add_option("--recording", options.request.recordings,
                 "Recording (.yaml, see drycut import) of its motor's torque and its motion; may be repeated")
      ->allow_extra_args(false);
  fit.add_option("--vary", options.request.vary,
                 "Value that is looked for, such as plants.axis.mass; may be repeated")
      ->allow_extra_args(false);
  fit.add_option("--test", options.request.tests,
                 "Recording that the values found must explain, too; may be repeated")
      ->allow_extra_args(false);
  fit.add_flag("--closed", options.request.closed,
               "The whole scenario runs, with drive's loops, controller and inputs; else the recorded torque "
               "drives the machine alone");
  fit.add_flag(
      "--plan", options.plan,
      "Without recordings: the move to record, as programs of the controllers, scenarios that run them, "
      "and text for the drive's own generator");
  fit.add_option("--limit", options.request.limit,
                 "Of the torque that --test may leave unexplained [%], rms over rms; else it fails nothing")
      ->check(CLI::Range(0.0, 1000.0));
  fit.add_option("--jobs", options.request.jobs, "Replays at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_set(fit, options.set, "scenario");
  add_out(fit, options.out, "Directory for the results; out/fit, of a plan out/fit_plan");
  add_no_pictures(fit, options.pictures, "No plots and no report");
  fit.callback([chosen, &status] { status = fit_machine(*chosen); });
}

}  // namespace

Verb fit_verb() {
  return {"fit",
          "Learn values of a machine from recordings of the real one: inertia or\n"
          "mass, friction, stiffness, play. Replays the recorded torque in the\n"
          "simulated machine and compares the motion, or with --closed runs the\n"
          "scenario and compares torque and motion.\n"
          "Exit status: 0 all values are known, 1 one is not, more than a third of the\n"
          "torque is left unexplained, or the cross test is above --limit,\n"
          "2 bad input, 3 the machine cannot follow the recording, or a result could not\n"
          "be written",
          {"drycut fit line.yaml --plan --vary plants.axis.mass",
           "drycut fit line.yaml --recording move.yaml --vary plants.axis.mass",
           "  --vary plants.axis.carriage_friction.coulomb"},
          {"scenario", {FileKind::scenario}},
          fit_options};
}

}  // namespace drycut::sim::cli
