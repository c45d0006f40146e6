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
#include "sim/cli/pages.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/fmi/fmu.hpp"
#include "sim/loop/guests.hpp"
#include "sim/loop/links.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/guests.hpp"

namespace drycut::sim::cli {

namespace {

struct FmuOptions {
  std::filesystem::path scenario;
  std::string part = "machine";
  std::string standard = "2";
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
  const bool two = options.standard == "2" || options.standard == "2.0";
  if (!two && options.standard != "3" && options.standard != "3.0")
    problems.push_back({"option.unknown-choice"_code, "--fmi", 1, 1,
                        fmt::format("there is no version {}", in_quotes(options.standard)), "2 or 3"});
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
  for (const auto& wire : scenario.wiring)
    if (problems.empty() && !line && loop::joins_plants(wire, scenario))
      problems.push_back(
          scenario::problem_at("scenario.does-not-go-together"_code, scenario, wire.terminal.place,
                               "a wire from plant to plant would be lacking in the machine alone",
                               "write the line, --part line, or leave the wire out"));
  // All that its controller reads is read, and told if it does not fit.
  if (problems.empty() && line) const loop::Simulation tried(scenario, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  try {
    const auto standard = two ? fmi::Standard::fmi2 : fmi::Standard::fmi3;
    const auto written =
        line ? fmi::write_line(scenario, files, standard, out) : fmi::write_machine(scenario, standard, out);
    fmt::print("{}: FMI {}.0, {} inputs, {} outputs, {} parameters\n", out.string(), two ? 2 : 3,
               written.inputs, written.outputs, written.parameters);
    if (!written.files.empty()) fmt::print("It carries these files whole, and whoever has it has them:\n");
    for (const auto& file : written.files) fmt::print("  {}\n", printable(file));
    fmt::print("{}\n", written.own_licence);
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
  fmu.add_option("--fmi", options.standard, "Version of the standard: 2 or 3")->capture_default_str();
  fmu.add_option("--out", options.out,
                 "The file, which is replaced if drycut wrote it; else the scenario's name with .fmu, here");
  add_force(fmu, options.force);
  add_set(fmu, options.set, "scenario");
  fmu.callback([chosen, &status] { status = write_fmu_of(*chosen); });
}

std::string_view causality_of(plants::GuestVariable::Role role) {
  using Role = plants::GuestVariable::Role;
  return role == Role::input ? "input" : role == Role::output ? "output" : "parameter";
}

std::string_view type_of(plants::GuestVariable::Type type) {
  constexpr std::string_view names[] = {"real", "whole", "Boolean", "text"};
  return names[static_cast<std::size_t>(type)];
}

/// An output has none.
Sheet::Cell start_cell(const plants::GuestVariable& variable) {
  using Type = plants::GuestVariable::Type;
  if (variable.role == plants::GuestVariable::Role::output) return nullptr;
  if (variable.type == Type::word) return variable.start_word;
  if (variable.type == Type::flag) return {variable.start != 0, variable.start != 0 ? "true" : "false"};
  const double start = variable.in_unit(variable.start);
  return {start, fmt::format("{:.12g}", start)};
}

std::string guest_range(const plants::GuestVariable& variable) {
  using Type = plants::GuestVariable::Type;
  constexpr double none = 1e300;
  if (variable.type == Type::flag || variable.type == Type::word) return "";
  const bool low = variable.min > -none;
  const bool high = variable.max < none;
  if (!low && !high) return "";
  return fmt::format("{}..{}", low ? fmt::format("{:.12g}", variable.min) : "",
                     high ? fmt::format("{:.12g}", variable.max) : "");
}

Page page_of(const std::string& file, const plants::GuestType& type) {
  Sheet itself("fmu", "The FMU", {"name=property", "value"});
  itself.add({"is", type.origin()});
  itself.add({"state", type.keeps_state() ? "can be kept" : "cannot be kept"});
  itself.add({"step", type.fixed_step() > 0 ? fmt::format("{:g} s and its multiples", type.fixed_step())
                                            : "of any length"});
  Sheet variables("variables", "Variables, for wiring, settings, channels and parameters",
                  {"name=variable", "causality=is", "type", "unit", "start", "range", "meaning"});
  for (const auto& variable : type.variables())
    variables.add({variable.name, causality_of(variable.role), type_of(variable.type), variable.unit,
                   start_cell(variable), guest_range(variable), variable.meaning});
  return {file, "a foreign FMU", "", {itself, variables}};
}

}  // namespace

int list_fmu(const std::string& file, bool json) {
  Problems problems;
  const auto bytes = read_bytes(file, problems, {file, 1, 1}, scenario::largest_guest);
  if (bytes) {
    try {
      return show({"drycut plants", "FMU"}, {page_of(file, *scenario::open_guest(*bytes, file))}, file, json);
    } catch (const scenario::GuestRefused& refused) {
      problems.push_back({refused.code(), file, 1, 1, refused.what(), refused.remedy()});
    }
  }
  print_problems(problems);
  return bad_input;
}

Verb fmu_verb() {
  return {"fmu",
          "Write the machine as an FMU, for a controller in another tool, or the line with its controller.\n"
          "It is for co-simulation by FMI 2.0 or 3.0 on 64-bit Linux. Inputs are what the controller, or the "
          "operator,\n"
          "drives, settings such as the web's speed, and faults; outputs encoders, switches, channels and "
          "events;\n"
          "every value of the plants is a parameter. What it carries of your files is listed.\n"
          "Exit status: 0 written, 2 bad input, 3 the file could not be written",
          {"drycut fmu scenes/rotary_knife.yaml --fmi 3 --out knife.fmu",
           "drycut fmu scenes/rotary_knife.yaml --part line --out line.fmu"},
          {"scenario", {FileKind::scenario}},
          fmu_options};
}

}  // namespace drycut::sim::cli
