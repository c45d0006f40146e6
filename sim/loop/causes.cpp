#include "sim/loop/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"
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
  if (!event.text.empty()) return event.text;
  return event.values.empty() ? event.event : fmt::format("{}: {}", event.event, values_text(event, 4));
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
std::optional<Finding> of_check(const std::vector<record::CheckResult>& checks) {
  for (const auto& check : checks)
    if (!check.passed && !check.throughout.empty())
      return Finding{"check.never-held"_code,
                     fmt::format("check '{}' held at no instant: {}", check.name, check.throughout)};
  return {};
}

/// Nothing went wrong by itself: something has not come.
bool only_missing(const std::vector<record::CheckResult>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const record::CheckResult& check) {
    return check.passed || check.deadline || !check.failed_at;
  });
}

bool found_nothing(const std::vector<record::CheckResult>& checks) {
  return std::any_of(checks.begin(), checks.end(),
                     [](const record::CheckResult& check) { return !check.passed && check.idle; });
}

std::string text_of_fault(const record::Alarm& fault) {
  return fmt::format("the timeline had at {:.6g} s: {} {}", fault.at, fault.source, fault.text);
}

}  // namespace

void Causes::happened(const record::RecordedEvent& event) {
  const double at = event.at_seconds();
  if (event.text.empty()) machines_.insert(event.source);
  if (const bool cut = event.event == "value_cut"; !odd_value_ && (cut || event.event == "out_of_range")) {
    odd_value_ = record::Alarm{at, event.source, event.text};
    is_cut_ = cut;
  }
  const auto keep = [&](std::vector<record::Alarm>& list, bool each_text) {
    auto text = text_of(event);
    const bool known = std::any_of(list.begin(), list.end(), [&](const record::Alarm& told) {
      return told.source == event.source && (!each_text || told.text == text);
    });
    if (!known && list.size() < most_causes) list.push_back({at, event.source, std::move(text)});
  };
  if (const auto* blade = event.find("blade"); grip_.empty() && event.event == "clamped_moving")
    grip_ = event.source + (blade != nullptr && blade->number != 0 ? ".head.plunge" : ".clamp");
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

std::optional<Finding> Causes::state_that_stands(double now, double until) const {
  constexpr double long_enough = 1;  // [s]
  constexpr double at_work = 1.5;    // times what it has stood before: it may be about to go on
  const State* latest = nullptr;
  for (const auto& state : states_)
    if (state.changed > 0 && (latest == nullptr || state.changed > latest->changed)) latest = &state;
  if (latest == nullptr || latest->changed > until ||
      now - latest->changed < std::max(long_enough, at_work * latest->longest))
    return {};
  return Finding{"loop.state-stands"_code, fmt::format("{} stands at {:g} since {:.6g} s", latest->name,
                                                       latest->last, latest->changed)};
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
std::optional<Causes::Cause> Causes::by_time(double failed_at, const Known& known) const {
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
    return Cause{shown ? Link::because : Link::after, {"loop.fault-put-in"_code, text_of_fault(*fault)}};
  }
  if (error != nullptr)
    return Cause{
        Link::because, {"loop.error"_code, with_warning(*error)}, !machines_.contains(error->source)};
  if (known.hunting && known.hunting->first <= failed_at &&
      (warning == nullptr || known.hunting->first <= warning->at))
    return Cause{Link::because, known.hunting->second};
  for (const auto& limit : limits_)
    if (limit.begin <= failed_at && failed_at - limit.end <= soon && warning == nullptr)
      return Cause{
          Link::after,
          {"loop.torque-limit"_code, fmt::format("the drive of {} was at its torque limit from {:.6g} s on",
                                                 limit.drive, limit.begin)}};
  if (warning == nullptr) return {};
  // An error of the same source that follows confirms it.
  const bool confirmed = std::any_of(errors_.begin(), errors_.end(), [&](const record::Alarm& later) {
    return later.source == warning->source && later.at - warning->at <= soon;
  });
  return Cause{confirmed || failed_at - warning->at <= soon ? Link::because : Link::after,
               {"loop.warning"_code, text_of(*warning)}};
}

std::optional<Finding> Causes::of(const std::vector<record::CheckResult>& checks, const Known& known) const {
  if (std::all_of(checks.begin(), checks.end(),
                  [](const record::CheckResult& check) { return check.passed; }))
    return {};
  const auto cause = cause_of(checks, known);
  if (!cause) return {};
  constexpr const char* words[] = {"because", "after", "shortly before", "while"};
  auto found = cause->what;
  found.role = Finding::Role::cause;
  found.text = fmt::format("{} {}", words[static_cast<std::size_t>(cause->link)], found.text);
  return found;
}

// All is as it should be, but later than a check wants.
std::optional<Causes::Cause> Causes::only_late(const std::vector<record::CheckResult>& checks) {
  const record::CheckResult* failed = nullptr;
  for (const auto& check : checks) {
    if (check.passed) continue;
    if (failed != nullptr || !check.deadline || !check.margin) return {};
    failed = &check;
  }
  if (failed == nullptr) return {};
  return Cause{
      Link::meanwhile,
      {"check.alone-fails"_code, fmt::format("nothing but check '{}' is amiss: it came true {:.4g} s "
                                             "too late",
                                             failed->name, -*failed->margin)}};
}

std::optional<Causes::Cause> Causes::cause_of(const std::vector<record::CheckResult>& checks,
                                              const Known& known) const {
  constexpr auto ever = std::numeric_limits<double>::infinity();
  const auto failed_at = first_failure(checks);
  const auto then_error = [&] {
    const auto* error = first_error(ever);
    return error != nullptr ? text_of(*error) : "";
  };
  if (auto late = only_late(checks)) return late;
  if (odd_value_ && odd_value_->at <= failed_at.value_or(ever))
    return Cause{Link::because,
                 {is_cut_ ? "loop.value-cut"_code : "loop.value-out-of-range"_code, text_of(*odd_value_)}}
        .with(then_error());
  if (!known.contradictions.empty())
    return Cause{Link::because, known.contradictions.front()}.with(then_error());
  for (const auto& [at, found] : known.astray)
    if (at <= failed_at.value_or(ever) && first_error(at) == nullptr) return Cause{Link::because, found};
  if (only_missing(checks) && first_error(failed_at.value_or(ever)) == nullptr && !known.hindrances.empty()) {
    const auto& first = known.hindrances.front();
    return faults_.empty()
               ? Cause{Link::because, first}.with(last_set(sets_, checks))
               : Cause{Link::after, {"loop.fault-put-in"_code, text_of_fault(faults_.front())}}.with(
                     first.text);
  }
  auto cause = by_time(failed_at.value_or(ever), known);
  if (auto misfit = of_check(checks); errors_.empty() && misfit && (!cause || cause->link == Link::after))
    return Cause{Link::because, known.astray.empty() ? std::move(*misfit) : known.astray.front().second};
  if (!cause && known.standing && known.standing->first <= failed_at.value_or(ever))
    cause = Cause{Link::meanwhile, known.standing->second};
  if (!cause || cause->link == Link::after) return last_resort(checks, known, std::move(cause));
  if (!faults_.empty()) return cause;
  if (found_nothing(checks) && !known.hindrances.empty()) {
    const auto& first = known.hindrances.front();
    const auto both = first_error(failed_at.value_or(ever)) != nullptr || cause->of_controller
                          ? cause->with(first.text)
                          : Cause{Link::because, first}.with(cause->what.text);
    return both.with(known.doubts.empty() ? "" : known.doubts.front().text);
  }
  return errors_.empty() || known.doubts.empty() ? cause : cause->with(known.doubts.front().text);
}

// Where nothing to judge was found, the machine stands: where. Else what looks odd, and what was done to it.
std::optional<Causes::Cause> Causes::last_resort(const std::vector<record::CheckResult>& checks,
                                                 const Known& known, std::optional<Cause> before) const {
  if (found_nothing(checks) && !known.hindrances.empty()) {
    const auto* error = first_error(std::numeric_limits<double>::infinity());
    const bool announced = error != nullptr && last_warning(error->at, error->source) != nullptr;
    if (announced && before)
      return Cause{Link::because, {"loop.error"_code, with_warning(*error)}}.with(
          known.hindrances.front().text);
    return Cause{Link::meanwhile, known.hindrances.front()}
        .with(error != nullptr ? text_of(*error) : "")
        .with(known.doubts.empty() ? "" : known.doubts.front().text);
  }
  if (before) return known.doubts.empty() ? before : before->with(known.doubts.front().text);
  if (errors_.empty() && !known.astray.empty()) return Cause{Link::because, known.astray.front().second};
  if (!known.doubts.empty()) return Cause{Link::meanwhile, known.doubts.front()};
  const auto failed_at = first_failure(checks);
  for (const auto& blow : blows_)
    if (failed_at && std::abs(blow.at - *failed_at) <= soon)
      return Cause{blow.at <= *failed_at ? Link::after : Link::shortly_before,
                   {"loop.blow"_code, text_of(blow)}};
  const auto set = last_set(sets_, checks);
  if (set.empty()) return {};
  return Cause{Link::after, {"loop.timeline-set"_code, set}};
}

Causes::Cause Causes::Cause::with(const std::string& more) const {
  auto cause = *this;
  if (!more.empty()) cause.what.text += "; " + more;
  return cause;
}

void Causes::visit(StateArchive& archive) {
  STATE(archive, errors_, warnings_, faults_, sets_, blows_, stop_, odd_value_, is_cut_, machines_, grip_);
  archive.list("limits_", limits_,
               [&](Limit& limit) { STATE(archive, limit.drive, limit.begin, limit.end); });
  archive.each("states_", states_,
               [&](State& state) { STATE(archive, state.last, state.changed, state.longest); });
}

}  // namespace drycut::sim::loop
