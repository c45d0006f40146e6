#include "sim/cli/tune_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "base/output_file.hpp"
#include "base/plain_text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/verb.hpp"

namespace drycut::sim::cli {

namespace {

int tune(const TuneOptions& options, const studies::TunePlan& plan, OutputFolder& folder) {
  Problems problems;
  const auto workers = workers_of(options.cluster, options.jobs, options.out, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  ProgressBar bar;
  const auto tuned = studies::tune(plan, options, workers, folder,
                                   [&](const char* doing, double share) { bar.show(doing, share); });
  bar.clear();
  fmt::print("{}", studies::summary_text(tuned.found));
  const auto& trials = tuned.trials;
  const auto& spread = tuned.spread;
  const auto now = trials->simulated() + (spread ? spread->simulated() : 0);
  fmt::print("\n{} sets of values tried, {} simulated now; {}\n", trials->trials().size(), now,
             (options.out / studies::evaluations_file).string());
  fmt::print("simulated runs: {}\n", studies::runs_text(tuned.found));
  if (tuned.has_report) fmt::print("report: {}\n", (options.out / "report.html").string());
  print_left_out(tuned.lost());
  return tuned.exit;
}

}  // namespace

int tune_scenarios(const TuneOptions& options) {
  Problems problems;
  auto set = overrides_of(options.set, problems);
  const auto plan = studies::plan_tuning(options, std::move(set), problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "tune", studies::tuning_files, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  try {
    return tune(options, plan, *folder);
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
}

namespace {

void tune_options(CLI::App& tune, int& status) {
  const auto chosen = std::make_shared<TuneOptions>();
  auto& options = *chosen;
  tune.add_option("scenarios", options.scenarios, "Scenario files (.yaml); the worst one counts")->required();
  tune.add_option("--vary", options.vary,
                  "PATH=LO..HI[:integer], such as controller.qmove.set.AxisX.pgain=1..100 or "
                  "\"plants.knife.servo.speed_gain=100..400 rad/s\"; may be repeated")
      ->required()
      ->allow_extra_args(false);
  tune.add_option("--minimise", options.minimise, "Metric, such as rms(AxisX.follerr) or sd(cut.length)")
      ->required();
  tune.add_option("--constraint", options.constraints,
                  "Limit, such as \"max(abs(knife.motor.torque)) <= 20\", \"phase_margin >= 45\" [deg], "
                  "\"gain_margin >= 6\" [dB] or \"max_sensitivity <= 2\"; may be repeated")
      ->allow_extra_args(false);
  tune.add_option("--wire", options.loop.wire, "Analogue reference where margins are measured, as with bode");
  tune.add_option("--at", options.loop.at, "Margins are measured from then on [s]; else from the end on");
  tune.add_option("--amplitude", options.loop.amplitude, "Of the sine that measures margins [V]")
      ->default_str(fmt::to_string(studies::LoopRequest::usual_amplitude));
  tune.add_option("--from", options.from, "Metric and constraints look from this time on")
      ->capture_default_str();
  tune.add_flag("--ignore-checks", options.ignore_checks, "The scenarios' failed checks do not count");
  tune.add_option(
          "--budget", options.budget,
          "Simulated runs of all parts together: present values, search, surroundings of the optimum, "
          "spread, pictures.\nMargins take two more, pushes where there is play another two, of the values "
          "that keep all other limits")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  tune.add_option("--jobs", options.jobs, "Runs at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  tune.add_option("--seed", options.seed, "Seed of the search and the spread")->capture_default_str();
  tune.add_option(
          "--spread", options.spread,
          "PATH=±30%, PATH=LO..HI, or the fit.json of drycut fit, whose limits are the ranges: try the tuned "
          "values on machines that differ; may be repeated")
      ->allow_extra_args(false);
  tune.add_option("--spread-runs", options.spread_runs,
                  "How many such machines; fewer where the budget has no room")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_on(tune, options.cluster);
  add_set(tune, options.set, "scenarios");
  add_out(tune, options.out, "Directory for the results; evaluations in it are used again");
  add_no_pictures(tune, options.pictures, "No plots and no report");
  tune.callback([chosen, &status] { status = tune_scenarios(*chosen); });
}

}  // namespace

Verb tune_verb() {
  return {
      "tune",
      "Find the values of device or drive parameters with the least metric, on one or several scenarios.\n"
      "Terms of a metric: max, min, mean, rms, sd, count, p99 (CH or EVENT.VALUE), settling(CH, band).\n"
      "Exit status: 0 the tuned values keep all limits, 1 none were found that do, 2 bad input",
      {"drycut tune scenes/rotary_knife.yaml --minimise \"rms(AxisX.follerr)\"",
       "  --vary controller.qmove.set.AxisX.pgain=1..400 --jobs 2"},
      {"scenarios", {FileKind::scenario}},
      tune_options};
}

}  // namespace drycut::sim::cli
