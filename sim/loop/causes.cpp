#include "sim/loop/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::size_t most_causes = 200;  ///< of each kind
constexpr double soon = 1;  ///< [s] what lies so little before a failure is held to be its cause

/// Machines tell numbers and no text.
std::string text_of(const record::RecordedEvent& event) {
  const auto number = [&](const char* value) {
    const auto* found = event.find(value);
    return found != nullptr ? found->number : 0;
  };
  if (event.event == "held_back")
    return fmt::format(
        "its line drive stood at its largest force, {:.4g} N, and it ran at {:.3g} of {:.3g} m/min",
        number("force"), number("speed"), number("set_speed"));
  if (event.event == "clamped_moving")
    return fmt::format("{} took hold of material that ran {:.4g} mm/s {} than the carriage",
                       number("blade") != 0 ? "the blade" : "the clamps", std::abs(number("difference")),
                       number("difference") < 0 ? "faster" : "slower");
  if (event.event == "unclamped") return "the blade came into the material, and nothing clamped it";
  if (event.event == "against_brake")
    return fmt::format("its drive has moved the motor with {:.3g} N m against a brake that is told to hold",
                       number("torque"));
  if (event.event == "opened_early") return "the clamps let go with the blade in the material";
  return event.text.empty() ? fmt::format("{}: {}", event.event, values_text(event, 4)) : event.text;
}
/// What a machine suffers from what went wrong before.
std::string blow_of(const record::RecordedEvent& event) {
  if (event.event == "tear") return "it tore the web";
  const auto* speed = event.find("speed");
  if (speed == nullptr) return "";
  const auto at = std::abs(speed->number);
  if (event.event == "crash" || event.event == "end_stop")
    return fmt::format("it ran into its end stop at {:.4g} {}", at, speed->unit);
  return event.event == "sag" ? fmt::format("it sank at {:.4g} {} when it should stand", at, speed->unit)
                              : "";
}

// When the first check failed that can say so; those that found nothing to judge cannot.
std::optional<double> first_failure(const std::vector<record::CheckResult>& checks) {
  std::optional<double> first;
  for (const auto& check : checks)
    if (!check.passed && check.failed_at && (!first || *check.failed_at < *first)) first = check.failed_at;
  return first;
}

// What the timeline did to the machine just before a check failed, or while it counted too few events.
std::string last_set(const std::vector<record::Alarm>& sets, const std::vector<record::CheckResult>& checks) {
  for (const auto& set : sets)
    for (const auto& check : checks) {
      const bool behind = check.failed_at && set.at <= *check.failed_at && *check.failed_at - set.at <= soon;
      const bool within = check.too_few && set.at >= *check.too_few;
      if (!check.passed && (behind || within))
        return fmt::format("the timeline had at {:.6g} s: {}", set.at, set.text);
    }
  return "";
}

// A check whose expression never fits.
std::string of_check(const std::vector<record::CheckResult>& checks) {
  for (const auto& check : checks)
    if (!check.passed && !check.throughout.empty())
      return fmt::format("check '{}' held at no instant: {}", check.name, check.throughout);
  return "";
}

bool found_nothing(const std::vector<record::CheckResult>& checks) {
  return std::any_of(checks.begin(), checks.end(),
                     [](const record::CheckResult& check) { return !check.passed && check.idle; });
}

std::string text_of_fault(const record::Alarm& fault) {
  return fmt::format("the timeline had at {:.6g} s: {} {}", fault.at, fault.source, fault.text);
}

std::string joined(const std::string& text) { return text.empty() ? "" : "; " + text; }

}  // namespace

void Causes::happened(const record::RecordedEvent& event) {
  const double at = event.at_seconds();
  const auto keep = [&](std::vector<record::Alarm>& list, bool each_text) {
    auto text = text_of(event);
    const bool known = std::any_of(list.begin(), list.end(), [&](const record::Alarm& told) {
      return told.source == event.source && (!each_text || told.text == text);
    });
    if (!known && list.size() < most_causes) list.push_back({at, event.source, std::move(text)});
  };
  if (event.source == "timeline") {
    if ((event.event == "fault" || event.text == "off") && faults_.size() < most_causes)
      faults_.push_back({at, event.event, event.text});
    const bool operates = event.text.starts_with("panel.");
    if ((event.event == "set" || event.event == "ramp") && !operates && at > 1 && sets_.size() < most_causes)
      sets_.push_back({at, event.event, event.text});
  } else if (const auto blow = blow_of(event); !blow.empty()) {
    const bool known = std::any_of(blows_.begin(), blows_.end(),
                                   [&](const record::Alarm& one) { return one.source == event.source; });
    if (!known) blows_.push_back({at, event.source, blow});
    if (!stop_ && event.event != "sag") stop_ = record::Alarm{at, event.source, blow};
  } else if (event.severity >= Severity::error) {
    keep(errors_, false);
  } else if (event.severity == Severity::warning && !event.text.empty()) {
    keep(warnings_, true);
    if (!value_cut_ && event.event == "value_cut") value_cut_ = record::Alarm{at, event.source, event.text};
  } else if (event.event == "saturated" && limits_.size() < most_causes) {
    const auto* begin = event.find("begin");
    const auto* end = event.find("end");
    if (begin != nullptr && end != nullptr) limits_.push_back({event.source, begin->number, end->number});
  }
}

void Causes::follow(std::string name, const double* number) {
  states_.push_back({std::move(name), number, *number});
}

void Causes::sample(Time now) {
  for (auto& state : states_) {
    if (*state.number == state.last) continue;
    state.last = *state.number;
    if (state.changed > 0) state.longest = std::max(state.longest, seconds(now) - state.changed);
    state.changed = seconds(now);
  }
}

std::string Causes::state_that_stands(double now) const {
  constexpr double long_enough = 1;  // [s]
  constexpr double at_work = 1.5;    // times what it has stood before: it may be about to go on
  const State* latest = nullptr;
  for (const auto& state : states_)
    if (state.changed > 0 && (latest == nullptr || state.changed > latest->changed)) latest = &state;
  if (latest == nullptr || now - latest->changed < std::max(long_enough, at_work * latest->longest))
    return "";
  return fmt::format("{} stands at {:g} since {:.6g} s", latest->name, latest->last, latest->changed);
}

std::vector<record::Alarm> Causes::alarms() const {
  constexpr std::size_t most_told = 20;
  auto all = errors_;
  all.insert(all.end(), warnings_.begin(), warnings_.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  if (all.size() > most_told) all.resize(most_told);
  return all;
}

const record::Alarm* Causes::first_error(double until) const {
  return errors_.empty() || errors_.front().at > until ? nullptr : &errors_.front();
}

const record::Alarm* Causes::last_warning(double until, const std::string& source) const {
  const record::Alarm* last = nullptr;
  for (const auto& warning : warnings_)
    if (warning.at <= until && (source.empty() || warning.source == source)) last = &warning;
  // What the same source warned of just before it explains more.
  for (const auto& warning : warnings_)
    if (last != nullptr && warning.source == last->source && warning.at <= last->at &&
        last->at - warning.at <= soon)
      return &warning;
  return last;
}

// An error behind what its source warned of before, or another just before.
std::string Causes::with_warning(const record::Alarm& error) const {
  if (const auto* warning = last_warning(error.at, error.source); warning != nullptr)
    return fmt::format("{}; then at {:.6g} s: {}", text_of(*warning), error.at, error.text);
  const auto* warning = last_warning(error.at, "");
  if (warning == nullptr || error.at - warning->at > soon) return text_of(error);
  return fmt::format("{}; then {}", text_of(*warning), text_of(error));
}

// What came before a failure: a fault that was put in, an error and the warning behind it, a drive at its
// limit.
std::string Causes::by_time(double failed_at, const Known& known) const {
  constexpr double told_late = 0.1;  // [s] an error is told once it has lasted
  const record::Alarm* fault = nullptr;
  for (const auto& one : faults_)
    if (one.at <= failed_at) fault = &one;
  const auto* error = first_error(failed_at + told_late);
  const auto* warning =
      last_warning(error != nullptr ? error->at : failed_at, error != nullptr ? error->source : "");
  if (fault != nullptr) {
    const bool shown = failed_at - fault->at <= soon || (error != nullptr && error->at >= fault->at) ||
                       (warning != nullptr && warning->at >= fault->at);
    return (shown ? "because " : "after ") + text_of_fault(*fault);
  }
  if (error != nullptr) return "because " + with_warning(*error);
  if (known.hunting && known.hunting->first <= failed_at &&
      (warning == nullptr || known.hunting->first <= warning->at))
    return "because " + known.hunting->second;
  for (const auto& limit : limits_)
    if (limit.begin <= failed_at && failed_at - limit.end <= soon && warning == nullptr)
      return fmt::format("after the drive of {} was at its torque limit from {:.6g} s on", limit.drive,
                         limit.begin);
  if (warning == nullptr) return "";
  // An error of the same source that follows confirms it.
  const bool confirmed = std::any_of(errors_.begin(), errors_.end(), [&](const record::Alarm& later) {
    return later.source == warning->source && later.at - warning->at <= soon;
  });
  return fmt::format("{} {}", confirmed || failed_at - warning->at <= soon ? "because" : "after",
                     text_of(*warning));
}

std::string Causes::of(const std::vector<record::CheckResult>& checks, const Known& known) const {
  if (std::all_of(checks.begin(), checks.end(),
                  [](const record::CheckResult& check) { return check.passed; }))
    return "";
  constexpr auto ever = std::numeric_limits<double>::infinity();
  const auto failed_at = first_failure(checks);
  if (value_cut_ && value_cut_->at <= failed_at.value_or(ever)) {
    const auto* error = first_error(ever);
    return "because " + text_of(*value_cut_) + joined(error != nullptr ? text_of(*error) : "");
  }
  if (!known.contradictions.empty()) {
    const auto* error = first_error(ever);
    return "because " + known.contradictions.front() + (error != nullptr ? "; " + text_of(*error) : "");
  }
  for (const auto& [at, text] : known.astray)
    if (at <= failed_at.value_or(ever) && first_error(at) == nullptr) return "because " + text;
  if (const auto* error = first_error(ever); !failed_at && error == nullptr && !known.hindrances.empty())
    return faults_.empty() ? "because " + known.hindrances.front() + joined(last_set(sets_, checks))
                           : "after " + text_of_fault(faults_.front()) + joined(known.hindrances.front());
  auto cause = by_time(failed_at.value_or(ever), known);
  const auto misfit = of_check(checks);
  if (errors_.empty() && !misfit.empty() && (cause.empty() || cause.starts_with("after ")))
    return "because " + misfit;
  if (cause.empty() && known.standing && known.standing->first <= failed_at.value_or(ever))
    cause = "while " + known.standing->second;
  if (cause.empty() || cause.starts_with("after ")) return last_resort(checks, known, cause);
  if (!faults_.empty()) return cause;
  if (found_nothing(checks) && !known.hindrances.empty()) {
    const auto both =
        first_error(failed_at.value_or(ever)) != nullptr
            ? cause + joined(known.hindrances.front())
            : fmt::format("because {}; {}", known.hindrances.front(), cause.substr(cause.find(' ') + 1));
    return both + (known.doubts.empty() ? "" : joined(known.doubts.front()));
  }
  return errors_.empty() || known.doubts.empty() ? cause : cause + joined(known.doubts.front());
}

// Where nothing to judge was found, the machine stands: where. Else what looks odd, and what was done to it.
std::string Causes::last_resort(const std::vector<record::CheckResult>& checks, const Known& known,
                                const std::string& before) const {
  if (found_nothing(checks) && !known.hindrances.empty()) {
    const auto* error = first_error(std::numeric_limits<double>::infinity());
    const bool announced = error != nullptr && last_warning(error->at, error->source) != nullptr;
    if (announced && !before.empty())
      return "because " + with_warning(*error) + joined(known.hindrances.front());
    return "while " + known.hindrances.front() + joined(error != nullptr ? text_of(*error) : "");
  }
  if (!before.empty()) return before + joined(known.doubts.empty() ? "" : known.doubts.front());
  if (!known.doubts.empty()) return "while " + known.doubts.front();
  const auto failed_at = first_failure(checks);
  for (const auto& blow : blows_)
    if (failed_at && std::abs(blow.at - *failed_at) <= soon)
      return fmt::format("{} {}", blow.at <= *failed_at ? "after" : "shortly before", text_of(blow));
  if (const auto set = last_set(sets_, checks); !set.empty()) return "after " + set;
  return "";
}

}  // namespace drycut::sim::loop
