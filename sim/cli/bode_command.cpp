#include "sim/cli/bode_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/report/report.hpp"
#include "sim/studies/bode/advice_report.hpp"
#include "sim/studies/bode/fmi_step.hpp"
#include "sim/studies/bode/report.hpp"

namespace drycut::sim::cli {

namespace {

void check_limit(const char* option, const std::optional<double>& value, double most, const char* unit,
                 Problems& problems) {
  if (!value || (*value >= 0 && *value <= most)) return;  // not NaN either
  problems.push_back({"option.out-of-range"_code, option, 1, 1, fmt::format("{} is out of range", *value),
                      fmt::format("give 0 to {} {}", most, unit)});
}

void check_options(const BodeOptions& options, Problems& problems) {
  studies::check_request(options.loop, problems);
  if (!options.fmi_step.empty() && !studies::fmi_step_of(options.fmi_step))
    problems.push_back({"option.out-of-range"_code, "--fmi-step", 1, 1,
                        fmt::format("'{}' is no time above 0 and up to 1 s", options.fmi_step),
                        "such as 1 ms"});
  check_limit("--min-phase-margin", options.min_phase_margin, 180, "deg", problems);
  check_limit("--min-gain-margin", options.min_gain_margin, 200, "dB", problems);
  check_outputs(options.csv, options.png, {options.scenario, "scenario"},
                {options.force, studies::bode_csv_header}, problems);
}

/// What a limit is held against.
struct KnownMargin {
  std::optional<studies::AtFrequency> margin;
  std::string why_not;  ///< it is not known
};

KnownMargin known_phase(const studies::LoopResult& result) {
  if (const auto phase = result.known_phase()) return {phase, ""};
  return {{},
          studies::loop_doubts(result).empty() ? "it lies outside these frequencies"
                                               : "what was measured is not to be trusted"};
}

/// With play the least of all amplitudes counts.
KnownMargin known_gain(const studies::LoopResult& result, const studies::LimitCycle* cycle) {
  if (cycle != nullptr && cycle->from()) {
    const auto& sines = cycle->least;
    const bool pushed = cycle->hunting && cycle->hunting->from;
    const double frequency = pushed ? cycle->hunting->frequency : cycle->margins[*sines].gain->frequency;
    return {studies::AtFrequency{frequency, 20 * std::log10(*cycle->from())}, ""};
  }
  if (!studies::loop_doubts(result).empty()) return {{}, "what was measured is not to be trusted"};
  if (result.play.empty()) return {result.margins.gain, "it lies outside these frequencies"};
  return {result.least_gain(), "with " + result.play + " it is the least over all amplitudes"};
}

/// A limit of the options, and what there is.
struct Judged {
  record::CheckResult check;
  double limit = 0;             ///< in the check's unit
  std::optional<double> value;  ///< nothing: it is not known
};
std::vector<record::CheckResult> checks_of(const std::vector<Judged>& judged) {
  std::vector<record::CheckResult> checks;
  checks.reserve(judged.size());
  for (const auto& one : judged) checks.push_back(one.check);
  return checks;
}

std::vector<Judged> judged(const BodeOptions& options, const studies::LoopResult& result,
                           const studies::LimitCycle* cycle) {
  std::vector<Judged> all;
  const auto judge = [&](const char* name, const std::optional<double>& limit, const KnownMargin& known,
                         const char* unit) {
    if (!limit) return;
    record::CheckResult check{name, fmt::format("{} >= {:g} {}", name, *limit, unit), false, {}, unit, {},
                              ""};
    if (const auto& margin = known.margin) {
      check.passed = margin->value >= *limit;
      check.margin = margin->value - *limit;
      check.detail = fmt::format("{:.2f} {} at {:.4g} Hz", margin->value, unit, margin->frequency);
    } else {
      check.detail = "not known: " + known.why_not;
    }
    all.push_back(
        {std::move(check), *limit, known.margin ? std::optional(known.margin->value) : std::nullopt});
  };
  judge("phase margin", options.min_phase_margin, known_phase(result), "deg");
  judge("gain margin", options.min_gain_margin, known_gain(result, cycle), "dB");
  return all;
}

/// "the gain margin of 7.10 dB is below 12 dB".
std::string judged_text(const Judged& judged) {
  const auto& [check, limit, value] = judged;
  if (!value) return fmt::format("the {} is {}", check.name, check.detail);
  return fmt::format("the {} of {:.2f} {} is {} {:g} {}", check.name, *value, check.unit,
                     check.passed ? "not below" : "below", limit, check.unit);
}

/// All that was asked for; `folder` may be null.
void write(const BodeOptions& options, const scenario::Scenario& scenario, const studies::LoopResult& result,
           const studies::LimitCycle* cycle, const record::Verdict& verdict,
           const std::vector<record::CheckResult>& checks, const std::string& fmi_step,
           OutputFolder* folder) {
  if (folder != nullptr)
    studies::write_bode_report(result, cycle, verdict, checks, fmi_step, scenario, *folder);
  if (folder != nullptr && !result.sweep.points.empty())
    write_file(folder->add("bode.csv"), bode_csv(result));
  if (folder != nullptr) record::write_verdict(verdict, *folder);
  if (result.sweep.points.empty()) return;
  if (options.csv == "-") {
    fmt::print("{}", studies::bode_csv(result));
  } else if (!options.csv.empty()) {
    write_file(options.csv, bode_csv(result));
  }
  if (!options.png.empty()) report::draw_png(studies::bode_plot(result, "bode"), options.png);
}

int advise_filters(const BodeOptions& options, const scenario::Scenario& scenario, Problems problems) {
  for (const auto& [given, option] : {std::pair(!options.loop.speed.empty(), "--speed"),
                                      {options.loop.amplitude.has_value(), "--amplitude"},
                                      {options.loop.settle.has_value(), "--settle"},
                                      {options.limit_cycle, "--limit-cycle"},
                                      {!options.fmi_step.empty(), "--fmi-step"},
                                      {options.min_gain_margin.has_value(), "--min-gain-margin"},
                                      {options.min_phase_margin.has_value(), "--min-phase-margin"},
                                      {!options.csv.empty(), "--csv"},
                                      {!options.png.empty(), "--png"}})
    if (given)
      problems.push_back({"option.together"_code, option, 1, 1,
                          "it is of the position loop, --advise of the speed loop", "one of them"});
  if (scenario.buildable) studies::check_speed_range(scenario, options.loop, problems);
  std::optional<studies::SpeedLoop> loop;
  std::optional<OutputFolder> folder;
  if (problems.empty() && !options.out.empty())
    folder.emplace(options.out, "bode", studies::bode_files, problems);
  if (problems.empty() && folder) folder->begin();
  if (problems.empty()) {
    ProgressBar bar;
    loop = studies::measure_speed_loop(scenario, options.loop, problems, [&](double done) {
      bar.show("measuring " + options.scenario.stem().string(), done);
    });
  }
  if (!loop) {
    print_problems(problems);
    return bad_input;
  }
  const auto advice = studies::advise(std::move(*loop));
  fmt::print("{}", studies::advice_text(advice));
  auto verdict = studies::verdict_of(advice);
  verdict.scenarios = {options.scenario.generic_string()};
  if (folder) {
    studies::write_advice_report(advice, scenario, *folder);
    record::write_verdict(verdict, *folder);
    fmt::print("report: {}\n", (options.out / "report.html").string());
  }
  return verdict.exit;
}

void bode_options(CLI::App& bode, int& status) {
  const auto chosen = std::make_shared<BodeOptions>();
  auto& options = *chosen;
  bode.add_option("scenario", options.scenario, "Scenario (.yaml)")->required();
  bode.add_option("--wire", options.loop.wire, "Analogue reference, as knife.servo.reference");
  bode.add_option("--speed", options.loop.speed, "Channel of the motor's speed, for the speed loop");
  bode.add_option("--at", options.loop.at, "The scenario runs undisturbed until then [s]; else to its end");
  bode.add_option("--from", options.loop.from,
                  "Lowest frequency [Hz]; else 1, and lower to the crossover; with --advise 2");
  bode.add_option("--to", options.loop.to,
                  "Highest frequency [Hz]; else half the sampling frequency; with --advise a quarter of that "
                  "of the steps");
  bode.add_option("--points", options.loop.points,
                  "Frequencies between them, evenly in decades; with --advise 360 or more, 360 if not given")
      ->check(CLI::Range(2, 1000))
      ->default_str(std::to_string(studies::LoopRequest::usual_points));
  bode.add_option("--amplitude", options.loop.amplitude, "Of the sine [V]")
      ->default_str(fmt::to_string(studies::LoopRequest::usual_amplitude));
  bode.add_option("--settle", options.loop.settle, "Before each measurement [s]")
      ->default_str(fmt::to_string(studies::LoopRequest::usual_settle));
  bode.add_flag(
      "--limit-cycle", options.limit_cycle,
      "Sweep the amplitude too: from which gain on play, stiction or limits keep an oscillation up");
  bode.add_flag("--advise", options.advise,
                "Measure the speed loop: which notch or low-pass of the servo's torque gains most.\nBy a "
                "sine of 5 % of rated torque at every step; takes --wire, --at, --from, --to and --points");
  bode.add_option("--min-phase-margin", options.min_phase_margin, "Fails if the margin is less [deg]");
  bode.add_option("--min-gain-margin", options.min_gain_margin, "Fails if the margin is less [dB]");
  bode.add_option(
      "--fmi-step", options.fmi_step,
      "Tell too what is left of the margins where the machine is an FMU under a master that exchanges\n"
      "values after each communication step of this length, such as \"1 ms\"");
  bode.add_option("--csv", options.csv, "Write the response; - prints it, the report to standard error");
  bode.add_option("--png", options.png, "Draw gain and phase");
  add_force(bode, options.force);
  add_out(bode, options.out, "Directory for report.html, plot and table");
  add_set(bode, options.set, "scenario");
  bode.callback([chosen, &status] { status = measure_bode(*chosen); });
}

}  // namespace

int measure_bode(const BodeOptions& options) {
  Problems problems;
  check_options(options, problems);
  const auto overrides = overrides_of(options.set, problems);
  auto scenario = scenario::read_scenario(options.scenario, overrides, problems);
  scenario.pictures.frames = false;  // nothing draws them
  if (options.advise) return advise_filters(options, scenario, std::move(problems));
  if (scenario.buildable) studies::check_loop(scenario, options.loop, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty() && !options.out.empty())
    folder.emplace(options.out, "bode", studies::bode_files, problems);
  if (problems.empty() && folder) folder->begin();
  std::optional<studies::LoopResult> result;
  std::optional<studies::LimitCycle> cycle;
  if (problems.empty() && options.limit_cycle) {
    ProgressBar bar;
    cycle = studies::find_limit_cycle(scenario, options.loop, problems, [&](double done) {
      bar.show("measuring " + options.scenario.stem().string(), done);
    });
    if (cycle) result = cycle->margins[cycle->least.value_or(cycle->margins.size() / 2)].loop;
  } else if (problems.empty()) {
    ProgressBar bar;
    result = studies::measure_both(scenario, options.loop, problems, [&](double done) {
      bar.show("measuring " + options.scenario.stem().string(), done);
    });
  }
  if (!result) {
    print_problems(problems);
    return bad_input;
  }
  const auto limits = judged(options, *result, cycle ? &*cycle : nullptr);
  std::vector<std::string> faults;
  auto text = studies::bode_report(*result);
  if (cycle) text += '\n' + studies::limit_cycle_text(*cycle);
  const auto fmi_step = options.fmi_step.empty()
                            ? std::string()
                            : studies::fmi_step_text(*result, *studies::fmi_step_of(options.fmi_step));
  text += fmi_step;
  for (const auto& limit : limits) {
    text += fmt::format("{}: {}\n", limit.check.passed ? "PASS" : "FAIL", judged_text(limit));
    if (!limit.check.passed) faults.push_back(judged_text(limit));
  }
  // A response on standard output is for a program: it must find nothing else there.
  fmt::print(options.csv == "-" ? stderr : stdout, "{}", text);
  // Where play makes a limit cycle, small motions do not answer: that is what was looked for.
  std::vector<Finding> found;
  if (!cycle || !cycle->from()) found = studies::loop_doubts(*result);
  if (cycle && !cycle->from())
    found.emplace_back("bode.no-margin"_code, "no gain margin was found at any amplitude");
  for (const auto& finding : found) faults.push_back(finding.text);
  const auto checks = checks_of(limits);
  auto verdict = studies::verdict_of(*result, faults, checks);
  verdict.found(found);
  verdict.scenarios = {options.scenario.generic_string()};
  write(options, scenario, *result, cycle ? &*cycle : nullptr, verdict, checks, fmi_step,
        folder ? &*folder : nullptr);
  if (!options.out.empty())
    fmt::print(options.csv == "-" ? stderr : stdout, "report: {}\n", (options.out / "report.html").string());
  else if (options.png.empty() && options.csv.empty())
    fmt::print("no plots; --out DIR writes them as a report\n");
  return verdict.exit;
}

Verb bode_verb() {
  return {
      "bode",
      "Frequency response of a closed position loop: a sine is added to the analogue reference.\n"
      "Exit status: 0 measured, 1 not stable, open, not to be trusted or below a limit, 2 bad input, 3 the\n"
      "simulation failed",
      {"drycut bode scenes/rotary_knife.yaml"},
      {"scenario", {FileKind::scenario}},
      bode_options};
}

}  // namespace drycut::sim::cli
