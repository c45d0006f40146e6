#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.hpp"

namespace drycut::sim::scenario {
struct Scenario;
struct Text;
}  // namespace drycut::sim::scenario

namespace drycut::sim::loop {

/// An event that something in the scenario can report, with its values and their units.
struct KnownEvent {
  std::string source;
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;
  Severity severity = Severity::note;
};

/// What the timeline, any controller and its cards report besides the plants' own events; these have no
/// values.
std::vector<KnownEvent> events_of_every_run();

/// How bad one of those is. Throws std::logic_error if it is none of them.
Severity severity_of_every_run(std::string_view event);
/// One of those tells what a program may wait for in vain, or lose.
bool is_of_program(std::string_view event);

/// How bad an event is, from a file that does not say it: as the plants and controllers of this program have
/// it. A note if they know no such event.
Severity severity_of(const std::string& event);

/// "cut" names the event of any source, "knife.cut" that of one.
bool names_event(const std::string& wanted, const std::string& source, const std::string& event);

/// The first of `events` that `wanted` names; nullptr after a problem that tells the nearest one.
const KnownEvent* find_event(const std::vector<KnownEvent>& events, const scenario::Text& wanted,
                             const scenario::Scenario& scenario, Problems& problems);

}  // namespace drycut::sim::loop
