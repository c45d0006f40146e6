#include "sim/cli/cam_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/cams/study.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/table_values.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/record/own_file.hpp"
#include "sim/report/report.hpp"

namespace drycut::sim::cli {

namespace {

void check_number(const char* option, const std::optional<double>& value, Problems& problems) {
  constexpr double most = 1e9;
  if (!value || (*value > 0 && *value <= most)) return;  // not NaN either
  problems.push_back({"option.out-of-range"_code, option, 1, 1, fmt::format("{} is out of range", *value),
                      "give a number above 0, at most 1000000000"});
}

void check_options(const CamOptions& options, bool speed_known, Problems& problems) {
  check_number("--master-speed", options.duty.master_speed, problems);
  check_number("--max-velocity", options.duty.max_velocity, problems);
  check_number("--max-acceleration", options.duty.max_acceleration, problems);
  if (!options.duty.master_speed && !speed_known) {
    for (const auto& [option, value] : {std::pair{"--max-velocity", options.duty.max_velocity},
                                        std::pair{"--max-acceleration", options.duty.max_acceleration}})
      if (value)
        problems.push_back({"option.does-not-apply"_code, option, 1, 1,
                            "a limit in time means nothing without the master's speed",
                            "give --master-speed too"});
  }
  const InputFile input{options.table, "table"};
  check_outputs(options.csv, options.png, input, {options.force, cams::cam_csv_header}, problems);
  if (options.rows.empty()) return;
  check_output("--table", options.rows, input, {options.force}, problems);
  if (options.rows == options.csv || options.rows == options.png)
    problems.push_back(
        {"option.file-name"_code, "--table", 1, 1, "it is the file of another option", "name another file"});
}

void write(const CamOptions& options, const cams::CamStudy& study) {
  if (!options.csv.empty()) {
    const auto text = cams::cam_csv(study.points, study.course.master_speed);
    if (options.csv == "-")
      fmt::print("{}", text);
    else
      write_file(options.csv, text);
  }
  if (!options.rows.empty() && !study.table.empty())
    write_file(options.rows, fmt::format("## {} cam.\n{}", record::own_mark, study.table));
  if (!options.png.empty() && !study.plot.panels.empty()) report::draw_png(study.plot, options.png);
}

}  // namespace

int validate_cam(const CamOptions& options) {
  Problems problems;
  const auto file = read_file(options.table, problems);
  const auto values = file ? with_values(*file, options.table, options.scene, problems) : TableText();
  const auto table = problems.empty()
                         ? cams::read_cam(options.device, values.text, options.table.string(), problems)
                         : devices::CamTable();
  check_options(options, cams::gives_master_speed(table), problems);
  cams::CamStudy study;
  if (problems.empty()) {
    const cams::CamRequest request{options.duty, options.at, options.loops,
                                   std::filesystem::path(options.png).stem().string()};
    study = cams::study_cam(table, request, problems);
  }
  if (problems.empty() && !options.rows.empty() && study.rows_are_given)
    problems.push_back({"option.does-not-apply"_code, "--table", 1, 1,
                        "the table's rows were given, not made", "leave it out"});
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  auto report = cams::cam_report(study.text, study.findings);
  if (!values.scenario.empty())
    report = fmt::format("with the values of {}\n{}", values.scenario.string(), report);
  if (!options.at.empty() && options.csv.empty()) report += '\n' + cams::cam_samples_text(study.points);
  // Samples on standard output are for a program: it must find nothing else there.
  fmt::print(options.csv == "-" ? stderr : stdout, "{}", report);
  write(options, study);
  return cams::is_unsound(study.findings, options.strict) ? check_failed : all_passed;
}

namespace {

void cam_options(CLI::App& cam, int& status) {
  const auto chosen = std::make_shared<CamOptions>();
  auto& options = *chosen;
  std::string headers;
  std::vector<std::string> devices;
  for (const auto& kind : cams::cam_kinds()) {
    headers += (headers.empty() ? "" : "; ") + std::string(kind.header);
    devices.emplace_back(kind.name);
  }
  cam.add_option("table", options.table, "Cam table (.csv, .tab): " + headers)->required();
  cam.add_option("--device", options.device, "Device that runs the cam; else by the table's header")
      ->check(CLI::IsMember(devices));
  cam.add_option(
      "--scene", options.scene,
      "Scenario whose values the table takes for its ${name}; else that beside it, or above, which names it");
  cam.add_option("--master-speed", options.duty.master_speed,
                 "Speed of the master: results in time too, and what depends on it is judged");
  cam.add_option("--max-velocity", options.duty.max_velocity, "Limit of the slave's velocity");
  cam.add_option("--max-acceleration", options.duty.max_acceleration,
                 "Limit of the slave's acceleration [Um/s2, pulses/s2, mm/s2 or deg/s2]");
  cam.add_option("--at", options.at, "Sample at these master positions, in the table's unit, M1,M2,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  cam.add_option("--csv", options.csv, "Write the samples; - prints them, the report to standard error");
  cam.add_option("--png", options.png, "Draw position, velocity, acceleration and jerk");
  cam.add_option("--table", options.rows, "Write the rows that the device makes (# ecamtbx)");
  cam.add_option("--loops", options.loops, "Times round, for a cam that comes back to its beginning")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  add_force(cam, options.force);
  cam.add_flag("--strict", options.strict, "Warnings and cautions fail as well");
  cam.callback([chosen, &status] { status = validate_cam(*chosen); });
}

}  // namespace

Verb cam_verb() {
  return {
      "cam",
      "Validate a cam table without a machine: its sectors or rows, errors, warnings and violated limits.\n"
      "CAMMING4: positions in Um, speeds in 10^decpt Um per minute or second (unitvel), as maxvel.\n"
      "LX3VP: positions in pulses, speeds in pulses per second.\n"
      "MC_CamIn: positions in 0.1 um or 0.0001 deg, speeds in mm/s or deg/s.\n"
      "Exit status: 0 sound (warnings are printed), 1 an error or a violated limit, 2 bad input",
      {"drycut cam scenes/cams/rotary_knife.csv"},
      {"table", {FileKind::cam_table}},
      cam_options};
}

}  // namespace drycut::sim::cli
