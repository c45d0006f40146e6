#include "sim/loop/signs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/state_archive.hpp"
#include "sim/record/outcome.hpp"
#include "sim/time.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::size_t most_signs = 50;
constexpr double just_before = 1;  // [s]

bool is_sign(const record::RecordedEvent& event) {
  if (event.source == "timeline") return event.event == "fault" || event.event == "power";
  return event.severity >= Severity::warning || event.event == "saturated" || event.event == "note";
}

/// The check that failed first, those behind that cannot say when.
const record::CheckResult* failed_first(const record::Outcome& outcome) {
  const record::CheckResult* first = nullptr;
  for (const auto& check : outcome.checks) {
    if (check.passed) continue;
    const bool sooner =
        first != nullptr && check.failed_at && (!first->failed_at || *check.failed_at < *first->failed_at);
    if (first == nullptr || sooner) first = &check;
  }
  return first;
}

}  // namespace

void Sign::visit(StateArchive& archive) { STATE(archive, at, source, event, text, severity, times); }

std::string text_of(const Sign& sign) {
  return fmt::format("{}: {}{}{}", sign.source, sign.event, sign.text.empty() ? "" : ": ", sign.text);
}

void Signs::take(const record::RecordedEvent& event) {
  if (!is_sign(event)) return;
  const auto known = std::ranges::find_if(all_, [&](const Sign& sign) {
    return sign.source == event.source && sign.event == event.event &&
           (event.text.empty() || sign.text == event.text);
  });
  if (known != all_.end()) {
    ++known->times;
    return;
  }
  if (all_.size() >= most_signs) return;
  // A drive tells of its limit when that is over.
  const auto* begin = event.find("begin");
  all_.push_back({begin != nullptr ? begin->number : event.at_seconds(), event.source, event.event,
                  record::values_text(event, 6), event.severity, 1});
}

const Sign* Signs::first(double failed_at) const {
  const Sign* first = nullptr;
  for (const auto& sign : all_) {
    if (sign.at > failed_at || (first != nullptr && first->at <= sign.at)) continue;
    const bool alone = sign.severity >= Severity::warning || sign.source == "timeline";
    const bool limit = sign.event == "saturated" && failed_at - sign.at <= just_before;
    if (alone || limit) first = &sign;
  }
  return first;
}

std::optional<Finding> Signs::sentence(const record::Outcome& outcome) const {
  const auto* check = failed_first(outcome);
  if (check == nullptr) return {};
  const auto failed_at = check->failed_at.value_or(seconds(outcome.end));
  const auto failed = check->failed_at ? fmt::format("check '{}' failed at {:.6g} s", check->name, failed_at)
                                       : fmt::format("check '{}' failed", check->name);
  const auto* sign = first(failed_at);
  if (sign == nullptr) return Finding{"why.sign"_code, fmt::format("nothing announced that {}", failed)};
  const auto before = check->failed_at ? fmt::format(", {:.4g} s before", failed_at - sign->at) : ", before";
  return Finding{"why.sign"_code, fmt::format("the first sign came at {:.6g} s{} {}: {}", sign->at, before,
                                              failed, text_of(*sign))};
}

void Signs::visit(StateArchive& archive) { STATE(archive, all_); }

std::string sign_told(const record::Outcome& outcome) {
  const auto found = std::ranges::find_if(
      outcome.findings, [](const Finding& finding) { return finding.code == "why.sign"_code.text(); });
  return found == outcome.findings.end() ? "" : std::string(found->text);
}

}  // namespace drycut::sim::loop
