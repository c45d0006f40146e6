#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sim/live/line.hpp"

namespace drycut::sim::live {

// What goes over the wire, as JSON. A client says one thing a message:
//   {"act": {"set": {"panel.start": 1}}}   also ramp with over, fault, power; as an entry of a timeline
//   {"run": true}  {"advance": "1 ms"}  {"until": "cut"}  {"pace": 0.1}  {"pace": "max"}  {"restart": true}
//   {"sample": ["knife.speed", "web.speed"], "watch": ["slLength"]}   every cycle; the latest value
//   with "programs": true the news tell where the programs stand, too
//   {"look": "12.5 s", "read": ["slLength"], "programs": true}   as it was then, told at once, while the line
//   goes on: {"done": id, "problems": [], "past": {...}} with "run", "time", "poses", "values", "lamps",
//   "programs", "outcome" as the news have them, and in "read" the values of the channels that were named.
//   Who asks again before that is told of the later one; the earlier one is "live.busy"
//   {"go_on": "12.5 s"}   the run as it was then is the next one, and goes on
//   {"read": ["slLength", "knife.angle"]}   as they are now, told at once: {"done": id, "problems": [],
//   "values": [800, 1.5]}
// each with "id", a number, if it wants to know what became of it: {"done": id, "problems": [...]}. With
// "busy": true it was not taken, for too much waits already, see Inbox.

/// nullopt if the message is none, with what is wrong in `problems`. `id`: what the client calls it, 0 =
/// nothing.
std::optional<Request> parse_request(std::string_view message, Asker asker, double& id, Problems& problems);

/// {"line": {...}}: what there is to see and to set. "programs": texts with their "file" as messages name it,
/// their "language" and for each line the values that it names, {"12": ["slLength"]}.
std::string description_json(const LineDescription& line);
/// {"news": {...}}, the same for everybody. "left_out": so many more events happened; "record_lost": why the
/// record has ended before the run. "programs", if anybody wants it: "tasks", each in a line of a
/// program (0: nowhere), and what each program's last scan did, see devices::ProgramPositions.
std::string news_json(const News& news);
/// Whether the line samples all that is wanted.
bool knows(const News::Samples& samples, const Sample& wanted);
/// {"samples": {"names": [...], "times": [...], "rows": [...], "watched": {"slLength": 800}}} of the channels
/// that one client wants; "" = none.
std::string samples_json(const News::Samples& samples, const Sample& wanted);
/// {"done": id, "problems": [...]}
std::string answer_json(double id, const Problems& problems);
/// The same of what was not taken.
std::string busy_json(double id);
/// The same with the values that were read.
std::string values_json(double id, const Problems& problems, const std::vector<double>& values);
/// The same with what was to be seen at a time that was looked at.
std::string seen_json(double id, const Problems& problems, const Seen& seen);

}  // namespace drycut::sim::live
