#include "sim/live/protocol.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/json.hpp"
#include "sim/record/json.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::live {

namespace {

/// As many digits as a picture needs.
double rounded(double number, double unit) {
  return std::isfinite(number) ? std::round(number / unit) * unit : 0;
}

Json list_of(const Problems& problems) {
  auto list = Json::array();
  for (const auto& problem : problems)
    list.push_back({{"code", problem.code.text()}, {"what", problem.what}, {"remedy", problem.remedy}});
  return list;
}

Json range_json(const devices::ValueRange& range) {
  return {{"low", range.low}, {"high", range.high}, {"whole", range.whole}};
}

/// Reads one request.
class RequestParser {
 public:
  explicit RequestParser(Problems& problems) : problems_(problems) {}

  std::optional<decltype(Request::what)> read(const Json& message) {
    if (message.contains("act")) return read_act(message["act"]);
    if (message.contains("run")) return read_switch(message["run"]);
    if (message.contains("advance")) return read_advance(message["advance"]);
    if (message.contains("until")) return read_until(message["until"]);
    if (message.contains("pace")) return read_pace(message["pace"]);
    if (message.contains("restart")) return Restart{};
    if (message.contains("look")) return read_look(message);
    if (message.contains("sample") || message.contains("watch") || message.contains("programs"))
      return read_sample(message);
    if (message.contains("go_on")) return read_go_on(message["go_on"]);
    if (message.contains("read")) return read_values(message);
    refuse("live.message"_code, "the message asks for nothing",
           "one of act, run, advance, until, pace, restart, sample, watch, programs, look, go_on, read");
    return {};
  }

  void refuse(Code code, std::string what, std::string remedy) {
    problems_.push_back({code, "message", 1, 1, std::move(what), std::move(remedy)});
  }

 private:
  std::optional<decltype(Request::what)> read_act(const Json& act) {
    auto text = json_text(act);
    if (text.size() <= most_of_act) return Act{std::move(text)};
    refuse("live.message"_code, fmt::format("an act of {} bytes", text.size()),
           fmt::format("{} at most; make several of it", most_of_act));
    return {};
  }
  std::optional<decltype(Request::what)> read_switch(const Json& on) {
    if (on.is_boolean()) return Go{on.get<bool>()};
    refuse("live.message"_code, "run is true or false", "{\"run\": true}");
    return {};
  }
  std::optional<decltype(Request::what)> read_advance(const Json& by) {
    scenario::Findings findings({"message"});
    if (by.is_string()) {
      const auto time = scenario::read_time({by.get<std::string>(), {1, 1, 0}, {}}, "advance",
                                            scenario::Sign::positive, findings);
      if (time && *time <= most_advance) return Advance{*time};
    }
    refuse("live.message"_code, "advance is a time of an hour at most", R"({"advance": "1 ms"})");
    return {};
  }
  std::optional<decltype(Request::what)> read_until(const Json& event) {
    if (event.is_string()) return UntilEvent{event.get<std::string>()};
    refuse("live.message"_code, "until is an event's name", R"({"until": "cut"}, "" for any)");
    return {};
  }
  std::optional<decltype(Request::what)> read_pace(const Json& pace) {
    if (pace == "max") return Pace{0};
    if (pace.is_number() && pace.get<double>() >= least_pace && pace.get<double>() <= most_pace)
      return Pace{pace.get<double>()};
    refuse("live.message"_code,
           fmt::format("pace is a number from {} to {}, or \"max\"", least_pace, most_pace), "{\"pace\": 1}");
    return {};
  }
  std::optional<decltype(Request::what)> read_sample(const Json& message) {
    Sample sample;
    if (!read_names(message, "sample", sample.names)) return {};
    const auto sampled = sample.names.size();
    if (!read_names(message, "watch", sample.names)) return {};
    sample.watched = sample.names.size() - sampled;
    if (!read_programs(message, sample.programs)) return {};
    return sample;
  }
  bool read_programs(const Json& message, bool& programs) {
    if (!message.contains("programs")) return true;
    if (message["programs"].is_boolean()) {
      programs = message["programs"].get<bool>();
      return true;
    }
    refuse("live.message"_code, "programs is true or false", R"({"watch": [], "programs": true})");
    return false;
  }
  std::optional<decltype(Request::what)> read_look(const Json& message) {
    Look look;
    if (!read_past(message["look"], "look", look.time) || !read_names(message, "read", look.names) ||
        !read_programs(message, look.programs))
      return {};
    if (look.names.size() <= most_looked_at) return look;
    refuse("live.message"_code, fmt::format("{} channels", look.names.size()),
           fmt::format("{} at most", most_looked_at));
    return {};
  }
  std::optional<decltype(Request::what)> read_go_on(const Json& from) {
    GoOn on;
    if (!read_past(from, "go_on", on.from)) return {};
    return on;
  }
  /// A time that the run has behind it.
  bool read_past(const Json& text, const char* key, Time& time) {
    scenario::Findings findings({"message"});
    if (text.is_string()) {
      const auto read = scenario::read_time({text.get<std::string>(), {1, 1, 0}, {}}, key,
                                            scenario::Sign::not_negative, findings);
      if (read) {
        time = *read;
        return true;
      }
    }
    refuse("live.message"_code, fmt::format("{} is a time of the run", key),
           fmt::format(R"({{"{}": "12.5 s"}})", key));
    return false;
  }
  std::optional<decltype(Request::what)> read_values(const Json& message) {
    Read read;
    if (!read_names(message, "read", read.names)) return {};
    return read;
  }
  /// Adds the names under `key`, if there are any.
  bool read_names(const Json& message, const char* key, std::vector<std::string>& names) {
    if (!message.contains(key)) return true;
    const auto& list = message[key];
    const auto is_name = [](const Json& item) { return item.is_string(); };
    if (!list.is_array() || !std::all_of(list.begin(), list.end(), is_name)) {
      refuse("live.message"_code, fmt::format("{} is a list of channels", key),
             fmt::format(R"({{"{}": ["web.speed"]}})", key));
      return false;
    }
    for (const auto& item : list) names.push_back(item.get<std::string>());
    return true;
  }

  static constexpr std::size_t most_looked_at = 1024;
  static constexpr Time most_advance = 3600 * second;
  static constexpr std::size_t most_of_act = 16U << 10U;  ///< [bytes]: it is read between two cycles
  Problems& problems_;
};

/// [["length", 800.1, "mm"], ["number", 3, ""]]
Json numbers_json(const record::RecordedEvent& event) {
  auto list = Json::array();
  for (const auto& [name, number, unit] : event.values) list.push_back({name, record::json_of(number), unit});
  return list;
}

Json events_json(const std::vector<record::RecordedEvent>& events) {
  auto list = Json::array();
  for (const auto& event : events)
    list.push_back({{"time", event.at_seconds()},
                    {"source", event.source},
                    {"event", event.event},
                    {"severity", name_of(event.severity)},
                    {"values", record::values_text(event, 6)},
                    {"numbers", numbers_json(event)}});
  return list;
}

Json poses_json(const std::vector<plants::PartPose>& poses) {
  constexpr double length = 1e-5;
  constexpr double turn = 1e-5;
  auto numbers = Json::array();
  for (const auto& [pose, visible, scale] : poses) {
    for (const double x : pose.position) numbers.push_back(rounded(x, length));
    for (const double x : pose.rotation) numbers.push_back(rounded(x, turn));
    for (const double x : scale) numbers.push_back(visible ? rounded(x, turn) : 0);
  }
  return numbers;
}

Json program_json(const devices::ProgramText& program) {
  auto values = Json::object();
  for (const auto& [line, names] : program.values) values[std::to_string(line)] = names;
  return {{"name", program.name},
          {"file", program.file},
          {"language", program.language},
          {"text", program.text},
          {"values", std::move(values)}};
}

Json positions_json(const devices::ProgramPositions& positions) {
  auto tasks = Json::array();
  for (const auto& task : positions.tasks)
    tasks.push_back({{"name", task.name},
                     {"program", task.program},
                     {"line", task.line},
                     {"doing", task.doing},
                     {"calls", task.calls}});
  return {{"tasks", tasks}, {"scanned", positions.scanned}};
}

Json channel_json(const LineDescription::Channel& channel) {
  Json one = {{"name", channel.name}, {"unit", channel.unit}, {"writable", channel.writable}};
  if (channel.range) one["range"] = range_json(*channel.range);
  return one;
}

Json opcua_json(const scenario::OpcuaSection& opcua) {
  const auto& [machine, packml, machinery, cutters] = opcua;
  auto lengths = Json::object();
  for (const auto& cutter : cutters) lengths[cutter.plant.text] = cutter.length.text;
  return {{"manufacturer", machine.manufacturer},
          {"model", machine.model},
          {"serial_number", machine.serial_number},
          {"packml", {{"state", packml.state.text}, {"mode", packml.mode.text}}},
          {"machinery",
           {{"executing", machinery.executing.text},
            {"out_of_service", machinery.out_of_service.text},
            {"mode", machinery.mode.text}}},
          {"lengths", lengths}};
}

}  // namespace

std::optional<Request> parse_request(std::string_view message, Asker asker, double& id, Problems& problems) {
  RequestParser parser(problems);
  const auto json = json_or_null(message);
  id = 0;
  if (!json.is_object()) {
    parser.refuse("live.message"_code, "the message is no JSON object", "{\"run\": true}");
    return {};
  }
  if (json.contains("id") && json["id"].is_number()) id = json["id"].get<double>();
  auto what = parser.read(json);
  if (!what) return {};
  return Request{asker, std::move(*what)};
}

std::string description_json(const LineDescription& line) {
  auto targets = Json::array();
  for (const auto& target : line.targets) {
    Json one = {
        {"name", target.name}, {"unit", target.unit}, {"panel", target.of_panel}, {"used", target.used}};
    if (target.push) one["push"] = *target.push;
    if (target.range) one["range"] = range_json(*target.range);
    targets.push_back(std::move(one));
  }
  auto faults = Json::array();
  for (const auto& fault : line.faults)
    faults.push_back({{"component", fault.component},
                      {"name", fault.name},
                      {"unit", fault.unit},
                      {"meaning", fault.meaning},
                      {"range", range_json(fault.range)}});
  auto channels = Json::array();
  for (const auto& channel : line.channels) channels.push_back(channel_json(channel));
  auto plants = Json::array();
  for (const auto& plant : line.plants)
    plants.push_back({{"name", plant.name}, {"type", plant.type}, {"web", plant.web}, {"cuts", plant.cuts}});
  auto programs = Json::array();
  for (const auto& program : line.programs) programs.push_back(program_json(program));
  return json_text({{"line",
                     {{"process", line.process},
                      {"run", line.run},
                      {"title", line.title},
                      {"scenario", line.scenario},
                      {"step", seconds(line.step)},
                      {"duration", seconds(line.duration)},
                      {"targets", targets},
                      {"lamps", line.lamps},
                      {"faults", faults},
                      {"channels", channels},
                      {"plants", plants},
                      {"controller", line.controller},
                      {"opcua", opcua_json(line.opcua)},
                      {"parts", line.parts},
                      {"checks", line.checks},
                      {"programs", programs},
                      {"notes", line.notes}}}});
}

std::string news_json(const News& news) {
  const auto& kept = news.punctuality;
  Json json = {
      {"run", news.run},
      {"time", seconds(news.time)},
      {"running", news.running},
      {"pace", news.pace},
      {"late",
       {{"cycles", kept.cycles}, {"late", kept.late}, {"worst", kept.worst}, {"dropped", kept.dropped}}},
      {"poses", poses_json(news.poses)},
      {"values", news.values},
      {"lamps", news.lamps}};
  if (!news.failure.empty()) json["failure"] = news.failure;
  if (!news.record_lost.empty()) json["record_lost"] = news.record_lost;
  if (news.events_left_out > 0) json["left_out"] = news.events_left_out;
  if (!news.events.empty()) json["events"] = events_json(news.events);
  if (news.programs) json["programs"] = positions_json(*news.programs);
  if (news.outcome) json["outcome"] = record::json_of(*news.outcome);
  return json_text({{"news", std::move(json)}});
}

bool knows(const News::Samples& samples, const Sample& wanted) {
  return samples.names && std::ranges::all_of(wanted.names, [&](const auto& name) {
           return std::ranges::binary_search(*samples.names, name);
         });
}

// By hand: of all that is told these are by far the most numbers.
std::string samples_json(const News::Samples& samples, const Sample& wanted) {
  if (samples.times.empty() || wanted.names.empty() || !knows(samples, wanted)) return "";
  const auto& known = *samples.names;
  std::vector<std::size_t> columns;
  columns.reserve(wanted.names.size());
  for (const auto& name : wanted.names)
    columns.push_back(static_cast<std::size_t>(std::ranges::lower_bound(known, name) - known.begin()));
  std::string text;
  const auto put = [&](double number) {
    if (text.back() != '[' && text.back() != ':') text += ',';
    if (std::isfinite(number))
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), number);
    else
      text += "null";
  };
  const auto value = [&](std::size_t row, std::size_t item) {
    return samples.rows[row * known.size() + columns[item]];
  };
  const auto sampled = columns.size() - wanted.watched;
  const auto last = samples.times.size() - 1;
  auto names = Json::array();
  for (std::size_t item = 0; item < sampled; ++item) names.push_back(wanted.names[item]);
  text = R"({"samples":{"names":)" + json_text(names) + R"(,"times":[)";
  if (sampled > 0)
    for (const auto time : samples.times) put(seconds(time));
  text += R"(],"rows":[)";
  for (std::size_t row = 0; sampled > 0 && row <= last; ++row)
    for (std::size_t item = 0; item < sampled; ++item) put(value(row, item));
  text += R"(],"watched":{)";
  for (std::size_t item = sampled; item < columns.size(); ++item) {
    text += (item == sampled ? "" : ",") + json_text(wanted.names[item]) + ":";
    put(value(last, item));
  }
  return text + "}}}";
}

std::string busy_json(double id) {
  return json_text(
      {{"done", id},
       {"busy", true},
       {"problems",
        list_of({{"live.busy"_code, "", 1, 1, "busy: too much of what was asked waits for the line already",
                  fmt::format("wait for answers; {} requests and {} kB a client, {} of all",
                              Inbox::most_of_one, Inbox::most_bytes_of_one >> 10U, Inbox::most_of_all)}})}});
}

std::string answer_json(double id, const Problems& problems) {
  return json_text({{"done", id}, {"problems", list_of(problems)}});
}

std::string values_json(double id, const Problems& problems, const std::vector<double>& values) {
  return json_text({{"done", id}, {"problems", list_of(problems)}, {"values", record::json_of(values)}});
}

std::string seen_json(double id, const Problems& problems, const Seen& seen) {
  if (!problems.empty()) return answer_json(id, problems);
  Json past = {{"run", seen.run},
               {"time", seconds(seen.time)},
               {"poses", poses_json(seen.poses)},
               {"values", record::json_of(seen.values)},
               {"lamps", record::json_of(seen.lamps)},
               {"read", record::json_of(seen.read)}};
  if (seen.programs) past["programs"] = positions_json(*seen.programs);
  past["outcome"] = record::json_of(seen.outcome);
  return json_text({{"done", id}, {"problems", Json::array()}, {"past", std::move(past)}});
}

}  // namespace drycut::sim::live
