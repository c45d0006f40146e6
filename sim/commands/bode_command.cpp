#include <fmt/format.h>

#include "sim/bode/report.hpp"
#include "sim/commands/arguments.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/progress.hpp"
#include "sim/file.hpp"
#include "sim/report.hpp"

namespace drycut::sim {

namespace {

void check_limit(const char* option, const std::optional<double>& value, double most, const char* unit,
                 Problems& problems) {
  if (!value || (*value >= 0 && *value <= most)) return;  // not NaN either
  problems.push_back(
      {option, 1, 1, fmt::format("{} is out of range", *value), fmt::format("give 0 to {} {}", most, unit)});
}

void check_options(const BodeOptions& options, Problems& problems) {
  check_request(options.loop, problems);
  check_limit("--min-phase-margin", options.min_phase_margin, 180, "deg", problems);
  check_limit("--min-gain-margin", options.min_gain_margin, 200, "dB", problems);
  check_outputs(options.csv, options.png, {options.scenario, "scenario"}, problems);
}

/// What falls below the limits of the options, a line each.
std::vector<std::string> shortfalls(const BodeOptions& options, const Margins& margins) {
  std::vector<std::string> lines;
  const auto judge = [&](const char* name, const std::optional<double>& limit,
                         const std::optional<AtFrequency>& margin, const char* unit) {
    if (!limit) return;
    if (!margin) {
      lines.push_back(fmt::format("FAIL: the {} is not known: it lies outside these frequencies", name));
    } else if (margin->value < *limit) {
      lines.push_back(
          fmt::format("FAIL: the {} of {:.2f} {} is below {} {}", name, margin->value, unit, *limit, unit));
    }
  };
  judge("phase margin", options.min_phase_margin, margins.phase, "deg");
  judge("gain margin", options.min_gain_margin, margins.gain, "dB");
  return lines;
}

/// All that was asked for; `folder` may be null; `faults` are the lines that fail the measurement.
void write(const BodeOptions& options, const Scenario& scenario, const LoopResult& result,
           const LimitCycle* cycle, const std::vector<std::string>& faults, OutputFolder* folder) {
  if (folder != nullptr) write_bode_report(result, cycle, faults, expand(scenario), *folder);
  if (result.sweep.points.empty()) return;
  if (folder != nullptr) write_file(folder->add("bode.csv"), bode_csv(result));
  if (options.csv == "-") {
    fmt::print("{}", bode_csv(result));
  } else if (!options.csv.empty()) {
    write_file(options.csv, bode_csv(result));
  }
  if (!options.png.empty()) draw_png(bode_plot(result, "bode"), options.png);
}

}  // namespace

int measure_bode(const BodeOptions& options) {
  Problems problems;
  check_options(options, problems);
  const auto overrides = overrides_of(options.set, problems);
  auto scenario = read_scenario(options.scenario, overrides, problems);
  scenario.pictures.frames = false;  // nothing draws them
  if (scenario.buildable) check_loop(scenario, options.loop, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty() && !options.out.empty()) folder.emplace(options.out, "bode", bode_files, problems);
  if (problems.empty() && folder) folder->begin();
  std::optional<LoopResult> result;
  std::optional<LimitCycle> cycle;
  if (problems.empty() && options.limit_cycle) {
    Progress bar;
    cycle = find_limit_cycle(scenario, options.loop, problems, [&](double done) {
      bar.show("measuring " + options.scenario.stem().string(), done);
    });
    if (cycle) result = cycle->margins[cycle->least.value_or(cycle->margins.size() / 2)].loop;
  } else if (problems.empty()) {
    Progress bar;
    result = measure_loop(scenario, options.loop, problems, [&](double done) {
      bar.show("measuring " + options.scenario.stem().string(), done);
    });
  }
  if (!result) {
    print_problems(problems);
    return bad_input;
  }
  const auto doubts = loop_doubts(*result);
  auto faults = shortfalls(options, result->margins);
  auto text = bode_report(*result);
  if (cycle) text += '\n' + limit_cycle_text(*cycle);
  for (const auto& line : faults) text += line + '\n';
  // A response on standard output is for a program: it must find nothing else there.
  fmt::print(options.csv == "-" ? stderr : stdout, "{}", text);
  // Where play makes a limit cycle, small motions do not answer: that is what was looked for.
  if (!cycle || !cycle->least) faults.insert(faults.begin(), doubts.begin(), doubts.end());
  if (cycle && !cycle->least) faults.emplace_back("no gain margin was found at any amplitude");
  write(options, scenario, *result, cycle ? &*cycle : nullptr, faults, folder ? &*folder : nullptr);
  if (!options.out.empty())
    fmt::print(options.csv == "-" ? stderr : stdout, "report: {}\n", (options.out / "report.html").string());
  if (!result->sweep.failure.empty()) return simulation_failed;
  return faults.empty() ? all_passed : check_failed;
}

}  // namespace drycut::sim
