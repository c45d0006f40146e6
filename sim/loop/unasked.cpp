#include "sim/loop/unasked.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

Unasked::Unasked(const scenario::Scenario& scenario, const std::vector<KnownEvent>& events) {
  for (const auto& event : events) {
    const bool asked =
        std::any_of(scenario.checks.begin(), scenario.checks.end(), [&](const scenario::CheckRequest& check) {
          return names_event(check.event.text, event.source, event.name);
        });
    if (event.severity >= Severity::error && !asked) watched_.push_back({event.source, event.name, 0, 0, {}});
  }
}

void Unasked::happened(const record::RecordedEvent& event) {
  for (auto& watched : watched_) {
    if (watched.name != event.event || watched.source != event.source) continue;
    constexpr int shown_digits = 4;
    if (watched.times++ > 0) continue;
    watched.first = event.at_seconds();
    watched.values = values_text(event, shown_digits);
  }
}

std::vector<record::CheckResult> Unasked::results() const {
  std::vector<record::CheckResult> results;
  for (const auto& watched : watched_) {
    if (watched.times == 0) continue;
    const auto name = watched.source + "." + watched.name;
    record::CheckResult result;
    result.name = "no " + name;
    result.expectation = fmt::format("never {}, which no check asks about", name);
    result.detail = fmt::format("{}, first at {:.6g} s{}{}", counted(watched.times, "time"), watched.first,
                                watched.values.empty() ? "" : ": ", watched.values);
    result.failed_at = watched.first;
    results.push_back(std::move(result));
  }
  return results;
}

void Unasked::visit(StateArchive& archive) {
  archive.each("watched_", watched_,
               [&](Watched& event) { STATE(archive, event.times, event.first, event.values); });
}

}  // namespace drycut::sim::loop
