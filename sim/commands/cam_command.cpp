#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/plots.hpp"
#include "sim/cam/plot.hpp"
#include "sim/cam/report.hpp"
#include "sim/commands/commands.hpp"
#include "sim/file.hpp"

namespace drycut::sim {

namespace {

void check_number(const char* option, const std::optional<double>& value, devices::Problems& problems) {
  constexpr double most = 1e9;
  if (!value || (*value > 0 && *value <= most)) return;  // not NaN either
  problems.push_back(
      {option, 1, 1, fmt::format("{} is out of range", *value), "give a number above 0, at most 1000000000"});
}

void check_output(const char* option, const std::string& file, const CamOptions& options,
                  devices::Problems& problems) {
  std::error_code ignored;
  if (std::filesystem::equivalent(file, options.table, ignored))
    problems.push_back({option, 1, 1, fmt::format("{} is the table itself", file), "name another file"});
  if (std::filesystem::is_directory(file, ignored))
    problems.push_back({option, 1, 1, fmt::format("{} is a directory", file), "name a file"});
  const auto folder = std::filesystem::path(file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
    problems.push_back({option, 1, 1, fmt::format("there is no directory {}", folder.string()),
                        "make it first or name another"});
}

void check_options(const CamOptions& options, devices::Problems& problems) {
  check_number("--master-speed", options.duty.master_speed, problems);
  check_number("--max-velocity", options.duty.max_velocity, problems);
  check_number("--max-acceleration", options.duty.max_acceleration, problems);
  if (!options.duty.master_speed) {
    for (const auto& [option, value] : {std::pair{"--max-velocity", options.duty.max_velocity},
                                        std::pair{"--max-acceleration", options.duty.max_acceleration}})
      if (value)
        problems.push_back({option, 1, 1, "a limit in time means nothing without the master's speed",
                            "give --master-speed too"});
  }
  if (!options.csv.empty() && options.csv != "-") check_output("--csv", options.csv, options, problems);
  if (options.png.empty()) return;
  check_output("--png", options.png, options, problems);
  const std::filesystem::path png = options.png;
  if (png.extension() != ".png" || png.stem().empty())
    problems.push_back({"--png", 1, 1, fmt::format("{} does not end in .png", options.png), "name it x.png"});
  if (options.png == options.csv)
    problems.push_back({"--png", 1, 1, "it is the file of --csv", "name another file"});
}

void check_positions(const CamOptions& options, const CamRun& run, devices::Problems& problems) {
  for (const double at : options.at) {
    if (at >= 0 && at <= run.master_total) continue;
    problems.push_back({"--at", 1, 1, fmt::format("the cam has no master position {}", at),
                        fmt::format("give positions from 0 to {} Um", run.master_total)});
  }
}

void write(const CamOptions& options, const CamTable& table, const CamRun& run,
           const std::vector<CamPoint>& points) {
  if (!options.csv.empty()) {
    std::optional<double> master;
    if (options.duty.master_speed) master = *options.duty.master_speed * um_per_second(table);
    const auto text = cam_csv(points, master);
    if (options.csv == "-") {
      fmt::print("{}", text);
    } else {
      OutputFile file(options.csv);
      file.write(text);
      file.finish();
    }
  }
  if (!options.png.empty()) {
    const std::filesystem::path png = options.png;
    const auto folder = png.has_parent_path() ? png.parent_path() : std::filesystem::path(".");
    renders::draw_plots({cam_plot(table, options.duty, run, png.stem().string())}, folder);
  }
}

}  // namespace

int validate_cam(const CamOptions& options) {
  devices::Problems problems;
  CamTable table;
  if (const auto text = read_file(options.table, problems))
    table = read_cam_table(*text, options.table.string(), problems);
  check_options(options, problems);
  CamRun run;
  if (problems.empty()) {
    run = run_cam(table, options.duty, options.loops);
    check_positions(options, run, problems);
  }
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  const auto findings = judge(table, options.duty, run);
  const auto points = options.at.empty() ? sample_cam(run) : sample_cam_at(run, options.at);
  auto text = cam_report(table, options.duty, run, findings);
  if (!options.at.empty() && options.csv.empty()) text += '\n' + cam_samples_text(points);
  // Samples on standard output are for a program: it must find nothing else there.
  fmt::print(options.csv == "-" ? stderr : stdout, "{}", text);
  write(options, table, run, points);
  return is_unsound(findings, options.strict) ? check_failed : all_passed;
}

}  // namespace drycut::sim
