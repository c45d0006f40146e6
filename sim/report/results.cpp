#include "sim/report/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/json.hpp"
#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/loop/signs.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::report {

namespace {

/// XML has no way to say a control character.
std::string escaped(const std::string& text) { return xml_text(printable(text)); }

/// As GitLab and Jenkins read it from a case's output: from the repository on, or with its whole path, as
/// --out was given.
std::string attachment_of(const RunResult& result) {
  if (!result.has_report) return "";
  return fmt::format("[[ATTACHMENT|{}]]",
                     escaped((result.directory / "report.html").lexically_normal().string()));
}

std::string properties_of(const RunResult& result) {
  std::string text = "    <properties>\n";
  const auto add = [&](const char* name, const std::string& value) {
    text += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", name, escaped(value));
  };
  add("drycut", DRYCUT_VERSION);
  if (!result.title.empty()) add("scene", result.title);
  add("scenario", result.scenario.string());
  if (result.seed) add("seed", std::to_string(*result.seed));
  add("duration", fmt::format("{} s", record::seconds_text(result.outcome.end)));
  for (const auto& warning : result.outcome.warnings()) add("warning", to_string(warning));
  return text + "    </properties>\n";
}

/// Of a check, or of the run's end behind the last one; `inside`: what went wrong, "" = nothing did.
std::string case_of(const RunResult& result, std::size_t number, const std::string& name, double time,
                    const std::string& inside) {
  const auto place = result.place_of(number);
  auto text =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.6f}\" file=\"{}\" line=\"{}\"",
                  escaped(result.name), escaped(name), time, escaped(path_from_here(place.file)), place.line);
  if (inside.empty()) return text + "/>\n";
  text += ">\n      " + inside + "\n";
  if (const auto attached = attachment_of(result); !attached.empty())
    text += "      <system-out>" + attached + "</system-out>\n";
  return text + "    </testcase>\n";
}

std::string suite_of(const RunResult& result) {
  const auto& outcome = result.outcome;
  const auto failed =
      std::count_if(outcome.checks.begin(), outcome.checks.end(), [](const auto& c) { return !c.passed; });
  const bool stopped = !outcome.failure.empty();
  const auto cases = outcome.checks.size() + (stopped ? 1 : 0);
  const double each = seconds(outcome.end) / static_cast<double>(std::max<std::size_t>(cases, 1));
  const auto skipped = std::ranges::count_if(
      outcome.checks, [](const auto& check) { return check.so_far || check.judged_nothing(); });
  auto text = fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.6f}\" skipped=\"{}\" "
      "file=\"{}\">\n",
      escaped(result.name), cases, failed, stopped ? 1 : 0, seconds(outcome.end), skipped,
      escaped(path_from_here(result.scenario)));
  text += properties_of(result);
  const auto sign = loop::sign_told(outcome);
  for (std::size_t i = 0; i < outcome.checks.size(); ++i) {
    const auto& check = outcome.checks[i];
    text += case_of(result, i, check.name, i < result.took.size() ? seconds(result.took[i]) : each,
                    check.so_far             ? "<skipped message=\"it held until the run stopped\"/>"
                    : check.judged_nothing() ? fmt::format("<skipped message=\"{}\"/>", escaped(check.doubt))
                    : check.passed
                        ? ""
                        : fmt::format("<failure message=\"{}{}{}\">{}; {}{}{}</failure>",
                                      escaped(check.expectation), outcome.cause().empty() ? "" : ": failed ",
                                      escaped(outcome.cause()), escaped(check.detail),
                                      escaped(margin_text(check)), sign.empty() ? "" : "; ", escaped(sign)));
  }
  if (stopped)
    text += case_of(result, outcome.checks.size(), "runs to its end", each,
                    fmt::format("<error message=\"{}\"/>", escaped(outcome.failure)));
  auto output = attachment_of(result);
  for (const auto& warning : outcome.warnings())
    output += fmt::format("{}warning: {}", output.empty() ? "" : "\n", escaped(to_string(warning)));
  if (!output.empty()) text += "    <system-out>" + output + "</system-out>\n";
  std::string alarms;
  for (const auto& alarm : outcome.alarms)
    alarms += (alarms.empty() ? "" : "\n") + escaped(record::text_of(alarm));
  if (!alarms.empty()) text += "    <system-err>" + alarms + "</system-err>\n";
  return text + "  </testsuite>\n";
}

}  // namespace

FilePlace RunResult::place_of(std::size_t check) const {
  return check < places.size() ? places[check] : FilePlace{scenario.string()};
}

std::string path_from_here(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto normal = file.lexically_normal();
  if (!normal.is_absolute()) return normal.string();
  const auto inside = normal.lexically_relative(std::filesystem::current_path(ignored));
  return inside.empty() || *inside.begin() == ".." ? normal.string() : inside.string();
}

std::string margin_text(const record::CheckResult& check) {
  std::vector<std::string> parts;
  if (check.margin) {
    const auto unit = check.unit.empty() ? "" : " " + check.unit;
    const double room = record::without_noise(std::abs(*check.margin));
    const auto at = check.at ? fmt::format(", at {:.4f} s", *check.at) : "";
    parts.push_back(fmt::format("{:.4g}{} {}{}", room, unit, *check.margin >= 0 ? "left" : "too far", at));
  }
  auto more = told_of(record::json_of(check), record::CheckResult::told());
  if (!more.empty()) parts.push_back(std::move(more));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string told_of(const Json& visited, const std::vector<std::string_view>& keys) {
  std::vector<std::string> parts;
  for (const auto key : keys) {
    const auto& value = visited.at(std::string(key));
    if (value.is_null() || value == false || value == "") continue;
    std::string name(key);
    std::ranges::replace(name, '_', ' ');
    const auto text = value.is_string()         ? value.get<std::string>()
                      : value.is_number_float() ? fmt::format("{:.6g}", value.get<double>())
                                                : json_text(value);
    parts.push_back(value == true ? name : name + " " + text);
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

record::CheckResult no_warnings(const record::Outcome& outcome) {
  record::CheckResult check;
  check.name = "no warning";
  check.expectation = "no warning, with --strict";
  check.detail = fmt::format("{}", fmt::join(record::texts_of(outcome.warnings()), "; "));
  return check;
}

std::string verdict_text(const record::Outcome& outcome) {
  const auto warned = outcome.warnings().empty()
                          ? ""
                          : ", " + counted(static_cast<std::int64_t>(outcome.warnings().size()), "warning");
  if (!outcome.failure.empty()) return "the simulation stopped: " + outcome.failure;
  const auto failed =
      std::count_if(outcome.checks.begin(), outcome.checks.end(), [](const auto& c) { return !c.passed; });
  if (outcome.checks.empty()) return "the scenario states no checks" + warned;
  if (failed > 0)
    return fmt::format("{} of {} checks failed{}{}{}", failed, outcome.checks.size(),
                       outcome.cause().empty() ? "" : ", ", outcome.cause(), warned);
  const auto idle = std::ranges::count_if(outcome.checks, &record::CheckResult::judged_nothing);
  if (idle > 0)
    return fmt::format("{} of {} checks passed, {} judged nothing{}", outcome.checks.size() - idle,
                       outcome.checks.size(), idle, warned);
  return (outcome.checks.size() == 1 ? "the one check passed"
                                     : fmt::format("all {} checks passed", outcome.checks.size())) +
         warned;
}

record::Outcome outcome_to_come() {
  return {0, "the run has not come to its end; it goes on, or it was ended from outside", {}};
}

void write_checks(const record::Outcome& outcome, const std::filesystem::path& file) {
  Json json = {{"drycut", DRYCUT_VERSION}};
  json.update(record::json_of(outcome));
  if (const auto& half = outcome.half_step)
    for (std::size_t i = 0; i < std::min(outcome.checks.size(), half->checks.size()); ++i) {
      const auto& other = half->checks[i];
      json["checks"][i]["half_step"] = {{"passed", other.passed},
                                        {"margin", record::json_of(other.margin)},
                                        {"moved", record::json_of(studies::moved(outcome.checks[i], other))}};
    }
  write_file(file, json_text(json, 2) + "\n");
}

std::string scenario_text(const scenario::Scenario& scenario) {
  return "# The scenario of this run with every default in force. Paths are relative to the original "
         "file.\n" +
         expand(scenario);
}

void write_scenario(const scenario::Scenario& scenario, const std::filesystem::path& file) {
  write_file(file, scenario_text(scenario));
}

void write_junit(const std::vector<RunResult>& results, const std::filesystem::path& file) {
  OutputFile out(file);
  out.write("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"drycut\">\n");
  for (const auto& result : results) out.write(suite_of(result));
  out.write("</testsuites>\n");
  out.finish();
}

}  // namespace drycut::sim::report
