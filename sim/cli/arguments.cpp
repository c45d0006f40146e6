#include "sim/cli/arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "sim/file.hpp"
#include "sim/record/own_file.hpp"
#include "sim/studies/cluster/engine.hpp"

namespace drycut::sim::cli {

namespace fs = std::filesystem;

void add_set(CLI::App& command, std::vector<std::string>& set, const std::string& whose) {
  command
      .add_option("--set", set, fmt::format("Override a value of the {}: path=value, may be repeated", whose))
      ->allow_extra_args(false);
}

void add_out(CLI::App& command, fs::path& out, const std::string& help) {
  // An empty path names no folder.
  const CLI::Validator named(
      [](std::string& text) { return text.empty() ? "it is empty; name a folder" : ""; }, "");
  auto* option = command.add_option("--out", out, help)->check(named);
  if (!out.empty()) option->capture_default_str();
}

void add_on(CLI::App& command, ClusterOptions& cluster) {
  const CLI::Validator known(
      [](std::string& text) {
        const auto fault = cluster::engine_fault(text);
        return fault ? fault->what + "; " + fault->remedy : "";
      },
      "");
  command
      .add_option(
          "--on", cluster.on,
          "Where the runs are run, if not here: dask://HOST:PORT, slurm or slurm:PARTITION; the result "
          "is the same (docs/clusters.md)")
      ->check(known);
  command.add_option("--stage", cluster.stage,
                     "A folder that all machines of Slurm see, if they do not see that of --out");
}

cluster::Workers workers_of(const ClusterOptions& options, int jobs, const fs::path& out,
                            Problems& problems) {
  if (options.on.empty()) {
    if (!options.stage.empty())
      problems.push_back({"option.does-not-apply"_code, "--stage", 1, 1, "nothing is staged for runs here",
                          "add --on slurm, or leave it out"});
    return jobs;
  }
  return {jobs, cluster::open_engine(options.on, out, options.stage, problems)};
}

void add_annotate(CLI::App& command, std::string& whom) {
  command
      .add_option("--annotate", whom,
                  "Tell what is wrong at its line: github prints workflow commands, gitlab writes "
                  "gl-code-quality-report.json here")
      ->check(CLI::IsMember({"github", "gitlab"}));
}

void add_no_pictures(CLI::App& command, bool& pictures, const std::string& help) {
  command.add_flag_callback(
      "--no-pictures", [&pictures] { pictures = false; }, help);
}

std::vector<scenario::Override> overrides_of(const std::vector<std::string>& set, Problems& problems) {
  std::vector<scenario::Override> overrides;
  for (const auto& text : set) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      problems.push_back({"option.set-path"_code, "--set", 1, 1,
                          fmt::format("'{}' is not an assignment", text),
                          "write path=value, such as \"plants.web.speed=80 m/min\""});
      continue;
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "Replace files, too, that drycut did not write");
}

void check_output(const char* option, const std::string& file, const InputFile& input,
                  const Replacing& replacing, Problems& problems) {
  std::error_code ignored;
  const auto refuse = [&](Code code, std::string what, const char* remedy) {
    problems.push_back({code, option, 1, 1, std::move(what), remedy});
  };
  const bool is_input = fs::equivalent(file, input.file, ignored);
  if (is_input)
    refuse("option.file-name"_code, fmt::format("{} is the {} itself", file, input.kind),
           "name another file");
  if (fs::is_directory(file, ignored))
    refuse("file.not-writable"_code, fmt::format("{} is a directory", file), "name a file");
  else if (const auto why = hindrance(file); !why.empty())
    refuse("file.not-writable"_code, fmt::format("{} cannot be written: {}", file, why), "name another file");
  else if (!is_input && !replacing.force && fs::is_regular_file(file, ignored) &&
           !record::is_own_file(file, replacing.header))
    refuse("file.not-ours"_code, fmt::format("{} is there already, and drycut did not write it", file),
           "name another file, or replace it with --force");
  const auto folder = fs::path(file).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    refuse("file.not-writable"_code, fmt::format("there is no directory {}", folder.string()),
           "make it first or name another");
}

void check_outputs(const std::string& csv, const std::string& png, const InputFile& input,
                   const Replacing& replacing, Problems& problems) {
  if (!csv.empty() && csv != "-") check_output("--csv", csv, input, replacing, problems);
  if (png.empty()) return;
  check_output("--png", png, input, {replacing.force}, problems);
  const fs::path picture = png;
  if (picture.extension() != ".png" || picture.stem().empty())
    problems.push_back({"option.file-name"_code, "--png", 1, 1, fmt::format("{} does not end in .png", png),
                        "name it x.png"});
  if (png == csv)
    problems.push_back(
        {"option.file-name"_code, "--png", 1, 1, "it is the file of --csv", "name another file"});
}

}  // namespace drycut::sim::cli
