#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/fmi/fmu.hpp"
#include "sim/loop/guests.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::cli {

namespace {

struct FmuOptions {
  std::filesystem::path scenario;
  std::string part = "machine";
  int standard = 2;
  std::filesystem::path out;
  std::vector<std::string> set;
  bool force = false;
};

int write_fmu_of(const FmuOptions& options) {
  Problems problems;
  const bool line = options.part == "line";
  if (!line && options.part != "machine")
    problems.push_back({"option.unknown-choice"_code, "--part", 1, 1,
                        fmt::format("there is no part {}", in_quotes(options.part)), "machine or line"});
  const auto overrides = overrides_of(options.set, problems);
  const auto out =
      options.out.empty() ? std::filesystem::path(options.scenario.stem().string() + ".fmu") : options.out;
  check_output("--out", out.string(), {options.scenario, "scenario"}, {options.force}, problems);
  FileSet files;
  const UseFiles use(files);  // which a line takes with it
  const auto scenario = scenario::read_scenario(options.scenario, overrides, problems);
  if (problems.empty() && scenario.plants.empty())
    problems.push_back({"scenario.missing-key"_code, options.scenario.string(), 1, 1,
                        "the scenario has no plants: there is no machine", "give it some under plants"});
  for (const auto& plant : scenario.plants)
    if (problems.empty() && !line && loop::guest_of(plant) != nullptr)
      problems.push_back(loop::problem_of_guest("scenario.does-not-go-together"_code, scenario, plant,
                                                "a machine with a foreign FMU cannot be written as one",
                                                "write the line, --part line, or leave the plant out"));
  // All that its controller reads is read, and told if it does not fit.
  if (problems.empty() && line) const loop::Simulation tried(scenario, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  try {
    const auto standard = options.standard == 2 ? fmi::Standard::fmi2 : fmi::Standard::fmi3;
    const auto written =
        line ? fmi::write_line(scenario, files, standard, out) : fmi::write_machine(scenario, standard, out);
    fmt::print("{}: FMI {}.0, {} inputs, {} outputs, {} parameters\n", out.string(), options.standard,
               written.inputs, written.outputs, written.parameters);
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
  return all_passed;
}

void fmu_options(CLI::App& fmu, int& status) {
  const auto chosen = std::make_shared<FmuOptions>();
  auto& options = *chosen;
  fmu.add_option("scenario", options.scenario, "Scenario file")->required();
  fmu.add_option("--part", options.part, "machine: all plants, without the controller; line: with it")
      ->capture_default_str();
  fmu.add_option("--fmi", options.standard, "Version of the standard: 2 or 3")
      ->check(CLI::Range(2, 3))
      ->capture_default_str();
  fmu.add_option("--out", options.out,
                 "The file, which is replaced if drycut wrote it; else the scenario's name with .fmu, here");
  add_force(fmu, options.force);
  add_set(fmu, options.set, "scenario");
  fmu.callback([chosen, &status] { status = write_fmu_of(*chosen); });
}

}  // namespace

Verb fmu_verb() {
  return {
      "fmu",
      "Write the machine as an FMU, for a controller in another tool, or the line with its controller:\n"
      "co-simulation by FMI 2.0 or 3.0 for 64-bit Linux. Inputs are what the controller, or the operator,\n"
      "drives, settings such as the web's speed, and faults; outputs encoders, switches, channels and "
      "events;\n"
      "every value of the plants is a parameter.\n"
      "Exit status: 0 written, 2 bad input, 3 the file could not be written",
      {"drycut fmu scenes/rotary_knife.yaml --fmi 3 --out knife.fmu",
       "drycut fmu scenes/rotary_knife.yaml --part line --out line.fmu"},
      {"scenario", {FileKind::scenario}},
      fmu_options};
}

}  // namespace drycut::sim::cli
