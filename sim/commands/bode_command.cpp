#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/plots.hpp"
#include "sim/bode/report.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/progress.hpp"
#include "sim/file.hpp"

namespace drycut::sim {

namespace {

void check_number(const char* option, const std::optional<double>& value, double least, double most,
                  const char* unit, devices::Problems& problems) {
  if (!value || (*value >= least && *value <= most)) return;  // not NaN either
  problems.push_back({option, 1, 1, fmt::format("{} is out of range", *value),
                      fmt::format("give {} to {} {}", least, most, unit)});
}

void check_output(const char* option, const std::string& file, const BodeOptions& options,
                  devices::Problems& problems) {
  std::error_code ignored;
  if (std::filesystem::equivalent(file, options.scenario, ignored))
    problems.push_back({option, 1, 1, fmt::format("{} is the scenario itself", file), "name another file"});
  if (std::filesystem::is_directory(file, ignored))
    problems.push_back({option, 1, 1, fmt::format("{} is a directory", file), "name a file"});
  const auto folder = std::filesystem::path(file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
    problems.push_back({option, 1, 1, fmt::format("there is no directory {}", folder.string()),
                        "make it first or name another"});
}

void check_options(const BodeOptions& options, devices::Problems& problems) {
  check_number("--at", options.at, 0, 1e6, "s", problems);
  check_number("--settle", options.settle, 0, 1000, "s", problems);
  check_number("--amplitude", options.amplitude, 0.001, 10, "V", problems);
  check_number("--from", options.from, 0.001, 1e6, "Hz", problems);
  check_number("--to", options.to, 0.001, 1e6, "Hz", problems);
  check_number("--min-phase-margin", options.min_phase_margin, 0, 180, "deg", problems);
  check_number("--min-gain-margin", options.min_gain_margin, 0, 200, "dB", problems);
  if (options.points < 2 || options.points > 1000)
    problems.push_back(
        {"--points", 1, 1, fmt::format("{} is out of range", options.points), "give 2 to 1000"});
  if (!options.csv.empty() && options.csv != "-") check_output("--csv", options.csv, options, problems);
  if (options.png.empty()) return;
  check_output("--png", options.png, options, problems);
  const std::filesystem::path png = options.png;
  if (png.extension() != ".png" || png.stem().empty())
    problems.push_back({"--png", 1, 1, fmt::format("{} does not end in .png", options.png), "name it x.png"});
  if (options.png == options.csv)
    problems.push_back({"--png", 1, 1, "it is the file of --csv", "name another file"});
}

std::vector<Override> overrides_of(const BodeOptions& options, devices::Problems& problems) {
  std::vector<Override> overrides;
  for (const auto& text : options.set) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      problems.push_back({"--set", 1, 1, fmt::format("'{}' is not an assignment", text),
                          "write path=value, such as controller.qmove.set.AxisX.pgain=50"});
      continue;
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

/// The wire to measure at; nullopt and a problem if it is not clear which.
std::optional<std::size_t> choose_wire(const BodeOptions& options, Simulation& simulation,
                                       devices::Problems& problems) {
  const auto& wires = simulation.bus().analogue_wires();
  std::vector<std::string> plugs;
  std::string all;
  for (const auto& wire : wires) {
    plugs.push_back(wire.plug);
    all += (all.empty() ? "" : ", ") + wire.plug;
  }
  if (wires.empty()) {
    problems.push_back({options.scenario.string(), 1, 1, "no analogue output is wired",
                        "a position loop needs one, such as 2.AN01: knife.servo.reference"});
    return {};
  }
  if (options.wire.empty()) {
    if (wires.size() == 1) return 0;
    problems.push_back(
        {"--wire", 1, 1, "the scenario has more than one analogue reference", "give one of: " + all});
    return {};
  }
  const auto found = std::find(plugs.begin(), plugs.end(), options.wire);
  if (found != plugs.end()) return static_cast<std::size_t>(found - plugs.begin());
  problems.push_back({"--wire", 1, 1, fmt::format("there is no analogue reference '{}'", options.wire),
                      "give one of: " + all});
  return {};
}

/// The channel of the motor's speed: the one asked for, or what the plant at the wire calls so.
std::string choose_speed(const BodeOptions& options, const std::string& plug, Simulation& simulation,
                         devices::Problems& problems) {
  auto& names = simulation.names();
  if (!options.speed.empty()) {
    if (names.reading(options.speed)) return options.speed;
    problems.push_back({"--speed", 1, 1, fmt::format("there is no channel '{}'", options.speed),
                        names.suggest_reading(options.speed)});
    return "";
  }
  const auto plant = plug.substr(0, plug.find('.'));
  for (const auto* channel : {".motor.speed", ".speed"})
    if (names.reading(plant + channel)) return plant + channel;
  return "";
}

/// Where and how to measure; nullopt and problems if the options do not fit the scenario.
std::optional<SweepPlan> plan_of(const BodeOptions& options, const Scenario& scenario, Simulation& simulation,
                                 devices::Problems& problems) {
  const auto wire = choose_wire(options, simulation, problems);
  if (!wire) return {};
  const auto& at_wire = simulation.bus().analogue_wires()[*wire];
  SweepPlan plan;
  plan.wire = *wire;
  plan.speed = choose_speed(options, at_wire.plug, simulation, problems);
  plan.at = options.at ? std::llround(*options.at * 1e9) : scenario.scene.duration;
  plan.step = scenario.scene.step;
  plan.sampling = std::max(simulation.output_period(at_wire.terminal), plan.step);
  plan.amplitude = options.amplitude;
  plan.settle = options.settle;
  const double highest = 0.5 / seconds(plan.sampling);
  const double to = options.to.value_or(highest);
  const double from = options.from.value_or(std::min(1.0, to / 100));
  if (to > highest)
    problems.push_back({"--to", 1, 1,
                        fmt::format("{} Hz is above half the sampling frequency of {} ms", to,
                                    seconds(plan.sampling) * 1000),
                        fmt::format("give at most {} Hz", highest)});
  if (from >= to)
    problems.push_back(
        {"--from", 1, 1, fmt::format("{} Hz is not below --to, {} Hz", from, to), "give a lower frequency"});
  constexpr double window = 2;  // long enough for tens of periods where a loop crosses over [s]
  if (problems.empty()) plan.tones = plan_tones(from, to, options.points, plan.sampling, window);
  return plan;
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

void write(const BodeOptions& options, const BodeResult& result) {
  if (result.sweep.points.empty()) return;
  if (options.csv == "-") {
    fmt::print("{}", bode_csv(result));
  } else if (!options.csv.empty()) {
    OutputFile file(options.csv);
    file.write(bode_csv(result));
    file.finish();
  }
  if (options.png.empty()) return;
  const std::filesystem::path png = options.png;
  const auto folder = png.has_parent_path() ? png.parent_path() : std::filesystem::path(".");
  renders::draw_plots({bode_plot(result, png.stem().string())}, folder);
}

}  // namespace

int measure_bode(const BodeOptions& options) {
  devices::Problems problems;
  check_options(options, problems);
  const auto overrides = overrides_of(options, problems);
  auto scenario = read_scenario(options.scenario, overrides, problems);
  scenario.pictures.frames = false;  // nothing draws them
  std::optional<SweepPlan> plan;
  std::unique_ptr<Simulation> excited;
  std::unique_ptr<Simulation> still;
  if (scenario.buildable) {
    excited = std::make_unique<Simulation>(scenario, problems);
    if (problems.empty()) plan = plan_of(options, scenario, *excited, problems);
    if (problems.empty()) still = std::make_unique<Simulation>(scenario, problems);
  }
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }

  BodeResult result;
  result.scenario = options.scenario.stem().string();
  const auto& wire = excited->bus().analogue_wires()[plan->wire];
  result.wire = wire.plug;
  result.terminal = devices::to_string(wire.terminal);
  result.speed = plan->speed;
  if (!plan->speed.empty()) result.speed_unit = excited->names().reading(plan->speed)->unit;
  result.plan = *plan;
  {
    Progress bar;
    result.sweep = measure(*excited, *still, *plan,
                           [&](double done) { bar.show("measuring " + result.scenario, done); });
  }
  result.margins = margins_of(result.sweep.points);
  const auto lines = shortfalls(options, result.margins);
  auto text = bode_report(result);
  for (const auto& line : lines) text += line + '\n';
  // A response on standard output is for a program: it must find nothing else there.
  fmt::print(options.csv == "-" ? stderr : stdout, "{}", text);
  write(options, result);
  if (!result.sweep.failure.empty()) return simulation_failed;
  return lines.empty() && bode_doubts(result).empty() ? all_passed : check_failed;
}

}  // namespace drycut::sim
