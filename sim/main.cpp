// The program `drycut`: reads the command line and calls what does the work (sim/commands/commands.hpp).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "base/plain_text.hpp"
#include "sim/cam/study.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/reference.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace {

using namespace drycut;
using namespace drycut::sim;

/// An empty path names no folder.
CLI::Validator named() {
  return {[](std::string& text) { return text.empty() ? "it is empty; name a folder" : ""; }, ""};
}

void add_cam(CLI::App& app, CamOptions& options, int& status) {
  auto* cam = app.add_subcommand(
      "cam",
      "Validate a cam table without a machine: its sectors or rows, errors, warnings and violated limits.\n"
      "CAMMING4: positions in Um, speeds in 10^decpt Um per minute or second (unitvel), as maxvel.\n"
      "LX3VP: positions in pulses, speeds in pulses per second.\n"
      "MC_CamIn: positions in 0.1 um or 0.0001 deg, speeds in mm/s or deg/s.\n"
      "Exit status: 0 sound (warnings are printed), 1 an error or a violated limit, 2 bad input");
  std::string headers;
  std::vector<std::string> devices;
  for (const auto& kind : cam_kinds()) {
    headers += (headers.empty() ? "" : "; ") + std::string(kind.header);
    devices.emplace_back(kind.name);
  }
  cam->add_option("table", options.table, "Cam table (.csv, .tab): " + headers)->required();
  cam->add_option("--device", options.device, "Device that runs the cam; else by the table's header")
      ->check(CLI::IsMember(devices));
  cam->add_option("--master-speed", options.duty.master_speed,
                  "Speed of the master: results in time too, and what depends on it is judged");
  cam->add_option("--max-velocity", options.duty.max_velocity, "Limit of the slave's velocity");
  cam->add_option("--max-acceleration", options.duty.max_acceleration,
                  "Limit of the slave's acceleration [Um/s2, pulses/s2, mm/s2 or deg/s2]");
  cam->add_option("--at", options.at, "Sample at these master positions, in the table's unit, M1,M2,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  cam->add_option("--csv", options.csv, "Write the samples; - prints them, the report to standard error");
  cam->add_option("--png", options.png, "Draw position, velocity, acceleration and jerk");
  cam->add_option("--table", options.rows, "Write the rows that the device makes (# ecamtbx)");
  cam->add_option("--loops", options.loops, "Times round, for a cam that comes back to its beginning")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  cam->add_flag("--strict", options.strict, "Warnings and cautions fail as well");
  cam->callback([&] { status = validate_cam(options); });
}

void add_bode(CLI::App& app, BodeOptions& options, int& status) {
  auto* bode = app.add_subcommand(
      "bode",
      "Frequency response of a closed position loop: a sine is added to the analogue reference.\n"
      "Exit status: 0 measured, 1 not stable, open, not to be trusted or below a limit, 2 bad input, 3 the\n"
      "simulation failed");
  bode->add_option("scenario", options.scenario, "Scenario (.yaml)")->required();
  bode->add_option("--wire", options.loop.wire, "Analogue reference, as knife.servo.reference");
  bode->add_option("--speed", options.loop.speed, "Channel of the motor's speed, for the speed loop");
  bode->add_option("--at", options.loop.at, "The scenario runs undisturbed until then [s]; else to its end");
  bode->add_option("--from", options.loop.from, "Lowest frequency [Hz]; else 1, and lower to the crossover");
  bode->add_option("--to", options.loop.to, "Highest frequency [Hz]; else half the sampling frequency");
  bode->add_option("--points", options.loop.points, "Frequencies between them, evenly in decades")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  bode->add_option("--amplitude", options.loop.amplitude, "Of the sine [V]")->capture_default_str();
  bode->add_option("--settle", options.loop.settle, "Before each measurement [s]")->capture_default_str();
  bode->add_flag(
      "--limit-cycle", options.limit_cycle,
      "Sweep the amplitude too: from which gain on play, stiction or limits keep an oscillation up");
  bode->add_option("--min-phase-margin", options.min_phase_margin, "Fails if the margin is less [deg]");
  bode->add_option("--min-gain-margin", options.min_gain_margin, "Fails if the margin is less [dB]");
  bode->add_option("--csv", options.csv, "Write the response; - prints it, the report to standard error");
  bode->add_option("--png", options.png, "Draw gain and phase");
  bode->add_option("--out", options.out, "Directory for report.html, plot and table")->check(named());
  bode->add_option("--set", options.set, "Override a value of the scenario: path=value, may be repeated")
      ->allow_extra_args(false);
  bode->callback([&] { status = measure_bode(options); });
}

void add_tune(CLI::App& app, TuneOptions& options, int& status) {
  auto* tune = app.add_subcommand(
      "tune",
      "Find the values of device or drive parameters with the least metric, on one or several scenarios.\n"
      "Terms of a metric: max, min, mean, rms, sd, count (CH or EVENT.VALUE), settling(CH, band).\n"
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
  tune->add_option("--set", options.set, "Override a value of the scenarios: path=value, may be repeated")
      ->allow_extra_args(false);
  tune->add_option("--out", options.out, "Directory for the results; evaluations in it are used again")
      ->check(named())
      ->capture_default_str();
  tune->add_flag("!--no-pictures", options.pictures, "No plots and no report");
  tune->callback([&] { status = tune_scenarios(options); });
}

void add_compare(CLI::App& app, CompareOptions& options, int& status) {
  auto* compare = app.add_subcommand(
      "compare",
      "Compare runs: checks, cuts and other events, channels, parameters in force; report.html, plots and\n"
      "comparison.csv.\n"
      "Exit status: 0 compared, 1 different and --fail-on-difference, 2 bad input, 3 a result could not be\n"
      "written");
  compare->add_option("runs", options.runs, "Folders that drycut run made, such as out/rotary_knife")
      ->required();
  compare->add_option("--out", options.out, "Directory for the results")
      ->check(named())
      ->capture_default_str();
  compare->add_option(
      "--from", options.from,
      "Figures look from this time on, as \"4 s\"; else where the plot with the limits begins");
  compare->add_flag("--fail-on-difference", options.fail_on_difference,
                    "Exit status 1 where the runs are not the same");
  compare->add_flag("!--no-pictures", options.pictures, "No plots and no report");
  compare->callback([&] { status = compare_runs(options); });
}

int run(int argc, char** argv) {
  CLI::App app{"drycut: virtual commissioning for cut-to-length lines"};
  app.require_subcommand(1);
  app.set_version_flag("--version", DRYCUT_VERSION);
  int status = all_passed;

  RunOptions run_options;
  std::uint64_t seed = 0;
  bool no_pictures = false;
  auto* run =
      app.add_subcommand("run", "Run scenarios: traces, events, checks, pictures and a report for each");
  run->add_option("scenarios", run_options.scenarios, "Scenario files (.yaml)")->required();
  run->add_option("--out", run_options.out, "Directory for the results")
      ->check(named())
      ->capture_default_str();
  run->add_option("--jobs", run_options.jobs, "Scenarios run at the same time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  auto* seed_option =
      run->add_option("--seed", seed, "Seed of every random source, in place of the scenarios'");
  run->add_flag("--no-pictures", no_pictures, "No frames, plots or report");
  run->add_flag("--gltf", run_options.gltf, "The run as an animated glTF file (.glb) for any 3D viewer");
  run->add_flag("--verify-step", run_options.verify_step,
                "Run again at half scene.step and tell how far every check's margin moved");
  run->add_option("--set", run_options.set, "Override a value of the scenarios: path=value, may be repeated")
      ->allow_extra_args(false);
  run->callback([&] {
    if (seed_option->count() > 0) run_options.seed = seed;
    run_options.pictures = !no_pictures;
    status = run_scenarios(run_options);
  });

  CheckOptions check_options;
  auto* check = app.add_subcommand("check", "Parse and type-check files without running anything");
  check
      ->add_option(
          "files", check_options.files,
          "Scenarios (.yaml), configurations (.cnf), QCL modules (.mod) after their .cnf, instruction "
          "lists (.il), Structured Text (.st), cam tables (.csv, .tab) and registers (.csv)")
      ->required();
  check->add_flag("--expand", check_options.expand, "Print scenarios with every default in force");
  check
      ->add_option("--set", check_options.set,
                   "Override a value of the scenarios: path=value, may be repeated")
      ->allow_extra_args(false);
  check->callback([&] { status = check_files(check_options); });

  CamOptions cam_options;
  add_cam(app, cam_options, status);

  TuneOptions tune_options;
  add_tune(app, tune_options, status);

  BodeOptions bode_options;
  add_bode(app, bode_options, status);

  CompareOptions compare_options;
  add_compare(app, compare_options, status);

  std::string name;
  bool json = false;
  auto* devices = app.add_subcommand("devices", "List device types, or the table of one");
  devices->add_option("name", name, "Device type, such as CAMMING4");
  devices->add_flag("--json", json, "As JSON");
  devices->callback([&] { status = list_devices(name, json); });

  auto* plants = app.add_subcommand("plants", "List plant types, or the table of one");
  plants->add_option("name", name, "Plant type, such as rotary_knife");
  plants->add_flag("--json", json, "As JSON");
  plants->callback([&] { status = list_plants(name, json); });

  std::filesystem::path folder;
  auto* reference = app.add_subcommand("reference", "Write the reference: manual page, completion, pages");
  reference->add_option("folder", folder, "Directory for the files")->required()->check(named());
  reference->group("")->callback([&] { status = write_reference(app, folder); });

  std::vector<std::string> commands;
  for (const auto* command : app.get_subcommands({})) commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    fmt::print(stderr, "drycut: there is no command '{}'; {}\n", argv[1], did_you_mean(argv[1], commands));
    return bad_input;
  }
  for (int i = 1; i < argc; ++i) {
    const auto fault = text_fault(argv[i]);
    if (!fault) continue;
    fmt::print(stderr, "drycut: in argument {} {}: {}\n", i, fault->what, printable(argv[i]));
    return bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? all_passed : bad_input;
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  // What cannot be told, because standard error takes nothing either, is still told by the status.
  const auto failed = [](const std::string& what) {
    std::fputs(("drycut: " + what + "\n").c_str(), stderr);
    return simulation_failed;
  };
  try {
    const int status = run(argc, argv);
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return status;
    return failed(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
  } catch (const std::exception& error) {
    return failed(error.what());
  }
}
