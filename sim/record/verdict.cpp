#include "sim/record/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/json.hpp"
#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/record/json.hpp"

namespace drycut::sim::record {

namespace {

constexpr std::size_t most_named = 3;  ///< checks that failed

/// A file of results as JSON; null if it cannot be read.
Json json_in(const std::filesystem::path& file) {
  Problems ignored;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};
  const auto text = read_file(file, ignored);
  auto json = text ? json_or_null(*text) : Json();
  return json.is_object() ? std::move(json) : Json();
}

std::string checks_text(const Outcome& outcome, std::vector<std::string> failed) {
  const auto count = failed.size();
  if (count == 0)
    return outcome.checks.empty() ? "the scenario states no checks"
                                  : counted(outcome.checks.size(), "check") + " passed";
  const auto more = count > most_named ? fmt::format(" and {} more", count - most_named) : "";
  failed.resize(std::min(count, most_named));
  return fmt::format("{} of {} checks failed: {}{}{}{}", count, outcome.checks.size(), listed(failed), more,
                     outcome.cause().empty() ? "" : "; ", outcome.cause());
}

}  // namespace

void Verdict::judge(bool passed) {
  verdict = passed ? Came::passed : Came::failed;
  exit = passed ? all_passed : check_failed;
}

void Verdict::stopped(int status) {
  verdict = Came::failed;
  exit = status;
  if (exit == simulation_failed) found({{"run.failed"_code, ""}});
}

void Verdict::found(const std::vector<Finding>& findings) {
  for (const auto& finding : findings)
    if (std::ranges::find(codes, finding.code) == codes.end()) codes.push_back(finding.code);
}

std::string Verdict::headword() const {
  return !word.empty() ? word : verdict == Came::failed ? "FAIL" : "PASS";
}

Verdict verdict_of(const Outcome& outcome) {
  Verdict verdict;
  std::vector<std::string> failed;
  for (const auto& check : outcome.checks)
    if (!check.passed) failed.push_back(check.name);
  if (!outcome.checks.empty()) verdict.judge(outcome.passed());
  if (!outcome.failure.empty()) verdict.stopped();
  if (verdict.verdict == Verdict::Came::none) verdict.word = "RAN";
  const auto count = [&](const char* of, const auto& list) { verdict.counts[of] = std::ssize(list); };
  count("checks", outcome.checks);
  count("failed", failed);
  count("warnings", outcome.warnings());
  count("alarms", outcome.alarms);
  verdict.sentence = outcome.failure.empty() ? checks_text(outcome, std::move(failed)) : outcome.failure;
  verdict.simulated = seconds(outcome.end);
  verdict.found(outcome.findings);
  return verdict;
}

void write_verdict(Verdict verdict, OutputFolder& folder) {
  const auto file = folder.add(verdict_file);
  verdict.kind = folder.kind();
  verdict.files = folder.files();
  verdict.drycut = DRYCUT_VERSION;
  write_file(file, json_text(json_of(verdict), 2) + "\n");
}

std::optional<Verdict> read_verdict(const std::filesystem::path& folder) {
  try {
    if (const auto json = json_in(folder / verdict_file); !json.is_null()) {
      Verdict verdict;
      take_json(json, verdict);
      return verdict;
    }
    const auto json = json_in(folder / checks_file);
    if (json.is_null()) return {};
    Outcome outcome;
    json.at("passed").get<bool>();
    take_json(json, outcome);
    auto verdict = verdict_of(outcome);
    verdict.drycut = json.at("drycut").get<std::string>();
    return verdict;
  } catch (const Json::exception&) {
    return {};
  }
}

}  // namespace drycut::sim::record
