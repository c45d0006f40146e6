#include "sim/loop/known_events.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "sim/loop/names.hpp"

namespace drycut::sim::loop {

std::vector<KnownEvent> events_of_every_run() {
  std::vector<KnownEvent> events;
  for (const auto* name : {"set", "ramp", "fault", "power"}) events.push_back({"timeline", name, {}});
  for (const auto* name : {"refused", "out_of_range", "error", "warning", "note", "contradiction", "held_up",
                           "overrun", "stopped", "errorstop", "block_error"})
    events.push_back({"controller", name, {}});
  for (const auto* name : {"counts_lost", "pulse_lost"}) events.push_back({"card", name, {}});
  return events;
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
  problems.push_back(scenario::problem_at(
      scenario, wanted.place, fmt::format("nothing here reports an event '{}'", wanted.text),
      did_you_mean(wanted.text, known, "events of plants are listed by drycut plants")));
  return nullptr;
}

}  // namespace drycut::sim::loop
