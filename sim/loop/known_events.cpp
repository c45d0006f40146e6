#include "sim/loop/known_events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "base/text.hpp"
#include "plants/plant.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/specimens.hpp"

namespace drycut::sim::loop {

namespace {

struct RunEventRow {
  const char* source;
  const char* name;
  Severity severity;
  bool of_program = false;  ///< what a program may wait for in vain, or lose
};
using enum Severity;
constexpr RunEventRow event_rows[] = {
    {"timeline", "set", note},
    {"timeline", "ramp", note},
    {"timeline", "fault", warning},
    {"timeline", "power", note},
    {"controller", "refused", warning},
    {"controller", "out_of_range", warning},
    {"controller", "error", error},
    {"controller", "warning", warning},
    {"controller", "note", note},
    {"controller", "contradiction", warning, true},
    {"controller", "value_cut", warning, true},
    {"controller", "held_up", warning, true},
    {"controller", "overrun", warning, true},
    {"controller", "stopped", error},
    {"controller", "errorstop", error},
    {"controller", "block_error", error},
    {"card", "counts_lost", warning},
    {"card", "pulse_lost", warning},
};

const RunEventRow* row_of(std::string_view event) {
  const auto* found = std::ranges::find(event_rows, event, &RunEventRow::name);
  return found == std::end(event_rows) ? nullptr : found;
}

}  // namespace

std::vector<KnownEvent> events_of_every_run() {
  std::vector<KnownEvent> events;
  for (const auto& row : event_rows) events.push_back({row.source, row.name, {}, row.severity});
  return events;
}

Severity severity_of_every_run(std::string_view event) {
  const auto* row = row_of(event);
  if (row == nullptr) throw std::logic_error(fmt::format("{} is no event of a controller", event));
  return row->severity;
}

bool is_of_program(std::string_view event) {
  const auto* row = row_of(event);
  return row != nullptr && row->of_program;
}

Severity severity_of(const std::string& event) {
  static const auto severities = [] {
    std::map<std::string, Severity, std::less<>> found;
    for (const auto& row : event_rows) found.emplace(row.name, row.severity);
    for (const auto& type : plants::plant_types())
      for (const auto& specimen : scenario::specimens_of(type))
        for (const auto& kind : specimen->plant().event_types()) found.emplace(kind.name, kind.severity);
    return found;
  }();
  const auto found = severities.find(event);
  return found == severities.end() ? note : found->second;
}

bool names_event(const std::string& wanted, const std::string& source, const std::string& event) {
  if (wanted == event) return true;
  return wanted.size() == source.size() + 1 + event.size() && wanted.starts_with(source) &&
         wanted[source.size()] == '.' && wanted.ends_with(event);
}

const KnownEvent* find_event(const std::vector<KnownEvent>& events, const scenario::Text& wanted,
                             const scenario::Scenario& scenario, Problems& problems) {
  for (const auto& event : events)
    if (names_event(wanted.text, event.source, event.name)) return &event;
  std::vector<std::string> known;
  for (const auto& event : events) {
    if (problems.size() > most_suggestions) break;
    known.push_back(event.name);
    known.push_back(event.source + "." + event.name);
  }
  problems.push_back(
      scenario::problem_at("scenario.unknown-event"_code, scenario, wanted.place,
                           fmt::format("nothing here reports an event '{}'", wanted.text),
                           did_you_mean(wanted.text, known, "events of plants are listed by drycut plants")));
  return nullptr;
}

}  // namespace drycut::sim::loop
