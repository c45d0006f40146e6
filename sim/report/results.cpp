#include "sim/report/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::report {

namespace {

/// XML has no way to say a control character.
std::string escaped(const std::string& text) { return xml_text(printable(text)); }

nlohmann::ordered_json number_or_null(const std::optional<double>& number) {
  if (!number || !std::isfinite(*number)) return nullptr;
  return *number;
}

}  // namespace

std::string margin_text(const loop::CheckResult& check) {
  if (!check.margin) return "";
  const auto unit = check.unit.empty() ? "" : " " + check.unit;
  const double room = loop::without_noise(std::abs(*check.margin));
  auto text = fmt::format("{:.4g}{} {}", room, unit, *check.margin >= 0 ? "left" : "too far");
  if (check.at) text += fmt::format(", at {:.4f} s", *check.at);
  return text;
}

std::string verdict_text(const loop::Outcome& outcome) {
  if (!outcome.failure.empty()) return "the simulation stopped: " + outcome.failure;
  const auto failed =
      std::count_if(outcome.checks.begin(), outcome.checks.end(), [](const auto& c) { return !c.passed; });
  if (outcome.checks.empty()) return "the scenario states no checks";
  if (failed > 0) return fmt::format("{} of {} checks failed", failed, outcome.checks.size());
  return outcome.checks.size() == 1 ? "the one check passed"
                                    : fmt::format("all {} checks passed", outcome.checks.size());
}

loop::Outcome outcome_to_come() {
  return {0, "the run has not come to its end; it goes on, or it was ended from outside", {}};
}

void write_checks(const loop::Outcome& outcome, const std::filesystem::path& file) {
  nlohmann::ordered_json json;
  json["drycut"] = DRYCUT_VERSION;
  json["passed"] = outcome.passed();
  json["end"] = seconds(outcome.end);
  json["failure"] = outcome.failure;
  const auto& half = outcome.half_step;
  if (half) json["half_step"] = {{"step", seconds(half->step)}, {"failure", half->failure}};
  json["checks"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < outcome.checks.size(); ++i) {
    const auto& check = outcome.checks[i];
    json["checks"].push_back({{"name", check.name},
                              {"expectation", check.expectation},
                              {"passed", check.passed},
                              {"margin", number_or_null(check.margin)},
                              {"unit", check.unit},
                              {"at", number_or_null(check.at)},
                              {"detail", check.detail}});
    if (!half || i >= half->checks.size()) continue;
    const auto& other = half->checks[i];
    json["checks"].back()["half_step"] = {{"passed", other.passed},
                                          {"margin", number_or_null(other.margin)},
                                          {"moved", number_or_null(studies::moved(check, other))}};
  }
  write_file(file, json.dump(2) + "\n");
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
  for (const auto& result : results) {
    const auto& outcome = result.outcome;
    const auto failed =
        std::count_if(outcome.checks.begin(), outcome.checks.end(), [](const auto& c) { return !c.passed; });
    const bool stopped = !outcome.failure.empty();
    out.write(fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
                          escaped(result.name), outcome.checks.size() + (stopped ? 1 : 0), failed,
                          stopped ? 1 : 0));
    for (const auto& check : outcome.checks) {
      out.write(fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escaped(result.name),
                            escaped(check.name)));
      if (check.passed) {
        out.write("/>\n");
        continue;
      }
      out.write(fmt::format(">\n      <failure message=\"{}\">{}; {}</failure>\n    </testcase>\n",
                            escaped(check.expectation), escaped(check.detail), escaped(margin_text(check))));
    }
    if (stopped) {
      out.write(
          fmt::format("    <testcase classname=\"{}\" name=\"runs to its end\">\n      <error "
                      "message=\"{}\"/>\n    </testcase>\n",
                      escaped(result.name), escaped(outcome.failure)));
    }
    out.write("  </testsuite>\n");
  }
  out.write("</testsuites>\n");
  out.finish();
}

}  // namespace drycut::sim::report
