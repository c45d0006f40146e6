#include "sim/cli/tune_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/file.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/tune/patch.hpp"
#include "sim/studies/tune/report.hpp"
#include "sim/studies/tune/search.hpp"
#include "sim/studies/tune/study.hpp"
#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::cli {

namespace {

constexpr auto* evaluations_file = "evaluations.csv";  // it and the next one go on where they ended
constexpr auto* spread_file = "spread.csv";
constexpr auto* patch_file = "patch.txt";

/// The command line, read and found sound.
struct Plan {
  studies::Study study;
  studies::TunedParameters vary;
  studies::TunedParameters spread;
  std::vector<std::optional<double>> present;
};

void read_cases(const TuneOptions& options, studies::Study& study, Problems& problems) {
  for (const auto& file : options.scenarios)
    if (auto text = read_file(file, problems)) study.cases.push_back({file, std::move(*text), {}});
}

void read_settings(const TuneOptions& options, studies::Study& study, Problems& problems) {
  study.set = overrides_of(options.set, problems);
  const auto from = scenario::parse_quantity(options.from);
  if (!from || !(from->number >= 0) || !scenario::is_unit(from->unit) ||
      !scenario::same_dimension(from->unit, "s") || scenario::to_si(from->number, from->unit) > 1e9) {
    problems.push_back({"--from", 1, 1, fmt::format("'{}' is no time", options.from), "such as 3 s"});
  } else {
    study.from = static_cast<Time>(scenario::to_si(from->number, from->unit) * 1e9 + 0.5);
  }
}

void read_parameters(const std::vector<std::string>& texts, const std::string& option, bool relative,
                     studies::TunedParameters& parameters, Problems& problems) {
  for (const auto& text : texts) {
    auto parameter = studies::parse_parameter(text, option, relative, problems);
    if (!parameter) continue;
    const bool twice =
        std::any_of(parameters.begin(), parameters.end(),
                    [&](const studies::TunedParameter& p) { return p.path == parameter->path; });
    if (twice) {
      problems.push_back({option, 1, 1, parameter->path + " is given twice", "keep one"});
    } else {
      parameters.push_back(std::move(*parameter));
    }
  }
}

/// --spread PATH=±30% around what the scenario says.
bool place_relative(studies::TunedParameter& parameter, std::optional<double> present, Problems& problems) {
  if (!parameter.relative) return true;
  if (!present || *present == 0) {
    problems.push_back({parameter.option, 1, parameter.low_column,
                        fmt::format("{} has no value to spread around", parameter.path),
                        "give a range LO..HI, or a quantity that is not 0"});
    return false;
  }
  const double size = std::abs(*present) * *parameter.relative;
  parameter.low = *present - size;
  parameter.high = *present + size;
  if (parameter.integer) {
    parameter.low = std::rint(parameter.low);
    parameter.high = std::rint(parameter.high);
  }
  return true;
}

/// Both ends of the range must be values that the scenario takes.
void try_bounds(const studies::TunedParameter& parameter, const studies::Study& study,
                const studies::Study::Case& entry, Problems& problems) {
  for (const bool upper : {false, true}) {
    auto overrides = study.set;
    overrides.push_back(
        {parameter.path, studies::value_text(parameter, upper ? parameter.high : parameter.low)});
    Problems own;
    const auto scenario = scenario::read_scenario_text(entry.text, entry.file, overrides, own);
    if (own.empty()) const loop::Simulation probe(scenario, own);
    for (auto& problem : own) {
      problem.file = parameter.option;
      problem.line = 1;
      problem.column = upper ? parameter.high_column : parameter.low_column;
      problem.what = parameter.path + ": " + problem.what;
      const bool told = std::any_of(problems.begin(), problems.end(), [&](const Problem& other) {
        return other.what == problem.what && other.file == problem.file;
      });
      if (!told) problems.push_back(std::move(problem));
    }
  }
}

void check_parameter(studies::TunedParameter& parameter, const studies::Study& study,
                     std::optional<double>& present, Problems& problems) {
  const auto told = problems.size();
  for (const auto& entry : study.cases) {
    const auto before = problems.size();
    Problems ignored;
    const auto scenario = scenario::read_scenario_text(entry.text, entry.file, study.set, ignored);
    if (!ignored.empty()) return;
    const auto value = studies::present_value(parameter, scenario);
    if (&entry == &study.cases.front()) present = value;
    if (!place_relative(parameter, value, problems)) return;
    try_bounds(parameter, study, entry, problems);
    if (problems.size() == before) studies::check_against_controller(parameter, scenario, problems);
  }
  if (problems.size() == told && parameter.integer &&
      (parameter.low != std::rint(parameter.low) || parameter.high != std::rint(parameter.high)))
    problems.push_back({parameter.option, 1, parameter.low_column, parameter.path + " is a whole number",
                        "end the range at whole numbers"});
}

Plan make_plan(const TuneOptions& options, Problems& problems) {
  Plan plan;
  read_cases(options, plan.study, problems);
  read_settings(options, plan.study, problems);
  plan.study.minimise = options.minimise;
  plan.study.constraints = options.constraints;
  plan.study.ignore_checks = options.ignore_checks;
  plan.study.loop = options.loop;
  studies::check_request(plan.study.loop, problems);
  studies::prepare(plan.study, problems);
  if (problems.empty() && !plan.study.needs_loop && !options.loop.wire.empty())
    problems.push_back({"--wire", 1, 1, "no constraint is on the loop",
                        "add --constraint \"phase_margin >= 45\", or leave it out"});
  read_parameters(options.vary, "--vary", false, plan.vary, problems);
  read_parameters(options.spread, "--spread", true, plan.spread, problems);
  for (const auto& parameter : plan.spread)
    for (const auto& varied : plan.vary)
      if (varied.path == parameter.path)
        problems.push_back(
            {"--spread", 1, 1, parameter.path + " is what --vary tunes", "spread something else"});
  for (auto& parameter : plan.vary)
    check_parameter(parameter, plan.study, plan.present.emplace_back(), problems);
  for (auto& parameter : plan.spread) {
    std::optional<double> ignored;
    check_parameter(parameter, plan.study, ignored, problems);
  }
  return plan;
}

/// The scenario's own values as a place to start, where it says them all and they lie in the ranges.
std::optional<studies::Point> start_of(const Plan& plan) {
  studies::Point point;
  for (std::size_t i = 0; i < plan.vary.size(); ++i) {
    const auto& value = plan.present[i];
    const auto& p = plan.vary[i];
    if (!value || *value < p.low || *value > p.high || (p.integer && *value != std::rint(*value))) return {};
    point.push_back(*value);
  }
  return point;
}

int tune(const TuneOptions& options, const Plan& plan, OutputFolder& folder) {
  folder.begin({evaluations_file, spread_file});
  const auto& study = plan.study;
  Progress bar;
  studies::Trials trials(study, plan.vary, {}, folder.add(evaluations_file), options.jobs, [&](int runs) {
    bar.show("tuning", std::min(1.0, static_cast<double>(runs) / options.budget));
  });
  studies::Tuning tuning{study, trials, plan.present, studies::measure(study, {}), 0, {}, nullptr, {}, {}};
  tuning.best = studies::search(trials, start_of(plan), options.budget, options.seed);
  const int searched = trials.runs();
  tuning.slices = studies::look_around(trials, tuning.best);

  const auto tuned = studies::overrides_of(plan.vary, trials.at(tuning.best).point);
  std::optional<studies::Trials> spread;
  if (!plan.spread.empty()) {
    const double all = options.spread_runs * study.runs_of_a_trial();
    spread.emplace(study, plan.spread, tuned, folder.add(spread_file), options.jobs,
                   [&](int runs) { bar.show("spreading", std::min(1.0, runs / all)); });
    spread->run("spread", studies::latin_hypercube(plan.spread, options.spread_runs,
                                                   plants::Random(options.seed, "drycut tune spread")));
    tuning.spread = &*spread;
  }
  bar.clear();
  write_file(folder.add(patch_file), patch_text(tuning));
  fmt::print("{}", studies::summary_text(tuning));
  const auto now = trials.simulated() + (spread ? spread->simulated() : 0);
  fmt::print("\n{} sets of values tried, {} simulated now; {}\n", trials.trials().size(), now,
             (options.out / evaluations_file).string());
  fmt::print("simulated runs: search {}, surroundings {}{}\n", searched, trials.runs() - searched,
             spread ? fmt::format(", spread {}", spread->runs()) : "");
  if (options.pictures && !trials.at(tuning.best).verdict.stopped) {
    for (const auto& entry : study.cases) {
      tuning.runs_before.push_back(studies::keep_run(study, entry, {}));
      tuning.runs_after.push_back(studies::keep_run(study, entry, tuned));
    }
    studies::write_tuning_report(tuning, folder);
    fmt::print("report: {}\n", (options.out / "report.html").string());
  }
  const auto& best = trials.at(tuning.best).verdict;
  if (best.stopped) return simulation_failed;
  return best.feasible() ? all_passed : check_failed;
}

}  // namespace

int tune_scenarios(const TuneOptions& options) {
  Problems problems;
  const auto plan = make_plan(options, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty())
    folder.emplace(
        options.out, "tune",
        std::vector<std::string>{evaluations_file, spread_file, patch_file, "report.html", "plots/"},
        problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  try {
    return tune(options, plan, *folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return simulation_failed;
  }
}

void add_tune(CLI::App& app, int& status) {
  const auto chosen = std::make_shared<TuneOptions>();
  auto& options = *chosen;
  auto* tune = app.add_subcommand(
      "tune",
      "Find the values of device or drive parameters with the least metric, on one or several scenarios.\n"
      "Terms of a metric: max, min, mean, rms, sd, count, p99 (CH or EVENT.VALUE), settling(CH, band).\n"
      "Exit status: 0 the tuned values keep all limits, 1 none were found that do, 2 bad input");
  tune->add_option("scenarios", options.scenarios, "Scenario files (.yaml); the worst one counts")
      ->required();
  tune->add_option("--vary", options.vary,
                   "PATH=LO..HI[:integer], such as controller.qmove.set.AxisX.pgain=1..100 or "
                   "\"plants.knife.servo.speed_gain=100..400 rad/s\"; may be repeated")
      ->required()
      ->allow_extra_args(false);
  tune->add_option("--minimise", options.minimise, "Metric, such as rms(AxisX.follerr) or sd(cut.length)")
      ->required();
  tune->add_option("--constraint", options.constraints,
                   "Limit, such as \"max(abs(knife.motor.torque)) <= 20\", \"phase_margin >= 45\" [deg], "
                   "\"gain_margin >= 6\" [dB] or \"max_sensitivity <= 2\"; may be repeated")
      ->allow_extra_args(false);
  tune->add_option("--wire", options.loop.wire,
                   "Analogue reference where margins are measured, as with bode");
  tune->add_option("--at", options.loop.at, "Margins are measured from then on [s]; else from the end on");
  tune->add_option("--amplitude", options.loop.amplitude, "Of the sine that measures margins [V]")
      ->capture_default_str();
  tune->add_option("--from", options.from, "Metric and constraints look from this time on")
      ->capture_default_str();
  tune->add_flag("--ignore-checks", options.ignore_checks, "The scenarios' failed checks do not count");
  tune->add_option("--budget", options.budget,
                   "Simulated runs of the search; the surroundings of the optimum come on top.\n"
                   "A margin takes two more, of the values that keep all other limits")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  tune->add_option("--jobs", options.jobs, "Runs at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  tune->add_option("--seed", options.seed, "Seed of the search and the spread")->capture_default_str();
  tune->add_option("--spread", options.spread,
                   "PATH=±30% or PATH=LO..HI: try the tuned values on machines that differ; may be repeated")
      ->allow_extra_args(false);
  tune->add_option("--spread-runs", options.spread_runs, "How many such machines")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_set(*tune, options.set, "scenarios");
  add_out(*tune, options.out, "Directory for the results; evaluations in it are used again");
  add_no_pictures(*tune, options.pictures, "No plots and no report");
  tune->callback([chosen, &status] { status = tune_scenarios(*chosen); });
}

}  // namespace drycut::sim::cli
