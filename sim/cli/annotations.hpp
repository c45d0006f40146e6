#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/report/results.hpp"

namespace drycut::sim::cli {

/// What failed or may be a slip, as services of repositories show it beside the lines of a file.
struct Annotation {
  enum class Kind { problem, check, run, warning };
  Kind kind = Kind::problem;
  report::FilePlace place;
  std::string title;    ///< one line: "rotary_knife: cut length"
  std::string message;  ///< what is wrong
  std::string lasting;  ///< what of it is the same in the next run: no figures
};

std::vector<Annotation> annotations_of(const Problems& problems);
/// Failed checks, runs that did not come to their end, warnings, and of those that failed the alarms.
std::vector<Annotation> annotations_of(const std::vector<report::RunResult>& results);

/// Workflow commands of GitHub, a line each: "::error file=...,line=...,col=...,title=...::...", "::warning
/// ...".
std::string github_text(const std::vector<Annotation>& annotations);

/// GitLab's report of code quality. A finding's fingerprint stays the same while its place and figures
/// change; no two have the same.
std::string gitlab_text(const std::vector<Annotation>& annotations);
inline constexpr auto* gitlab_file = "gl-code-quality-report.json";

/// It is a problem of `--annotate` if what annotate() writes cannot be written.
void check_annotate(const std::string& whom, Problems& problems);
/// Prints them for "github" on standard output, writes them for "gitlab" into `gitlab_file` in the current
/// folder, unless check_annotate() has told that it cannot; nothing for "". Throws std::runtime_error if that
/// cannot be done.
void annotate(const std::string& whom, const std::vector<Annotation>& annotations);

}  // namespace drycut::sim::cli
