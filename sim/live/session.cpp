#include "sim/live/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "sim/file.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/record/own_file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::live {

namespace {

using scenario::Findings;
using scenario::YamlNode;

/// The first line of a session.
struct Head {
  scenario::Text scenario;
  std::vector<scenario::Text> set;
  scenario::Text fingerprint;
};

void visit_head(scenario::Archive& archive, Head& head) {
  archive.in_line();
  archive.value({"scenario", ""}, form(head.scenario));
  archive.require("scenario", "name the file of the scenario");
  archive.value({"set", ""}, form(head.set));
  archive.value({"fingerprint", ""}, form(head.fingerprint));
}

/// "{at: 1 s, set: {panel.start: 1}}"
template <typename Visit>
std::string in_one_line(const Visit& visit) {
  const std::string key = "line";
  auto text = scenario::yaml_of([&](scenario::Archive& archive) { archive.section({key, ""}, visit); });
  text.erase(0, key.size() + 2);
  return text;
}

std::string act_text(const scenario::Stimulus& act) {
  auto written = act;
  return in_one_line([&](scenario::Archive& archive) { visit(archive, written); });
}

/// Every place of an act, to be put where it belongs.
template <typename Move>
void move_places(scenario::Stimulus& act, const Move& move) {
  move(act.place);
  for (auto* const actions : {&act.set, &act.ramp}) {
    for (auto& [name, quantity] : *actions) {
      move(name.place);
      move(quantity.place);
    }
  }
  for (auto& fault : act.faults) {
    move(fault.component.place);
    move(fault.fault.place);
    move(fault.value.place);
  }
}

/// Reads the lines of a session, each on its own: a session of a day has a hundred thousand of them.
class SessionReader {
 public:
  SessionReader(std::string file, Problems& problems) : file_(std::move(file)), problems_(problems) {}

  std::optional<Session> read(std::string_view text) {
    const auto before = problems_.size();
    for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
      ++number_;
      line(text.substr(0, end));
      text.remove_prefix(end + 1);
    }
    if (number_ == 0)
      problems_.push_back({"live.session-form"_code, file_, 1, 1, "the session is empty",
                           "a file that drycut live --record wrote"});
    if (problems_.size() > before) return {};
    return std::move(session_);
  }

 private:
  static constexpr std::string_view item = "- ";

  void line(std::string_view text) {
    if (!text.starts_with(item))
      return problem("live.session-form"_code, "this is no line of a session", "each begins with '- {'");
    text.remove_prefix(item.size());
    Findings findings({file_});
    const auto node = scenario::parse_yaml(text, 0, findings);
    if (findings.empty() && node.kind != YamlNode::Kind::map)
      scenario::refuse_kind(node, "the line", YamlNode::Kind::map, findings);
    if (findings.empty()) take(node, findings);
    for (auto& found : findings.sorted()) {
      found.line += number_ - 1;
      found.column += static_cast<int>(item.size());
      problems_.push_back(std::move(found));
    }
  }

  void take(const YamlNode& node, Findings& findings) {
    if (number_ == 1) return head(node, findings);
    if (const auto* reached = child(node, "reached"); reached != nullptr && node.entries.size() == 1) {
      const auto time = scenario::read_time(reached->text, "reached", scenario::Sign::not_negative, findings);
      if (time) session_.reached = std::max(session_.reached, *time);
      return;
    }
    // An earlier version recorded acts that did nothing.
    if (child(node, "at") != nullptr && node.entries.size() == 1) return;
    scenario::Stimulus act;
    scenario::MapReader reader(node, "the act", findings);
    visit(reader, act);
    reader.finish();
    if (!act.at || act.when || act.every || act.after != 0) {
      if (findings.empty())
        findings.add("live.session-form"_code, node.text.place,
                     "an act has the time at which it acted and nothing else", "{at: 1.2 s, set: {...}}");
      return;
    }
    session_.reached = std::max(session_.reached, *act.at);
    move_places(act, [this](scenario::ScenePlace& place) {
      place.line += number_ - 1;
      place.column += static_cast<int>(item.size());
    });
    session_.acts.push_back(std::move(act));
  }

  void head(const YamlNode& node, Findings& findings) {
    Head head;
    scenario::MapReader reader(node, "the session", findings);
    visit_head(reader, head);
    reader.finish();
    session_.scenario = head.scenario.text;
    for (const auto& text : head.set) {
      const auto equals = text.text.find('=');
      if (equals == std::string::npos)
        findings.add("option.set-path"_code, text.place, fmt::format("'{}' is no override", text.text),
                     "write path=value");
      else
        session_.set.push_back({text.text.substr(0, equals), text.text.substr(equals + 1)});
    }
    const auto& digits = head.fingerprint.text;
    std::from_chars(digits.data(), digits.data() + digits.size(), session_.fingerprint, 16);
  }

  void problem(Code code, std::string what, std::string remedy) {
    problems_.push_back({code, file_, number_, 1, std::move(what), std::move(remedy)});
  }

  std::string file_;
  Problems& problems_;
  Session session_;
  int number_ = 0;
};

std::optional<Session> read_lines(const std::filesystem::path& file, Problems& problems) {
  constexpr std::uintmax_t largest_session = std::uintmax_t{1} << 30U;
  const auto text = read_file(file, problems, largest_session);
  if (!text) return {};
  auto session = SessionReader(file.string(), problems).read(*text);
  if (session && session->scenario.is_relative())
    session->scenario = (file.parent_path() / session->scenario).lexically_normal();
  return session;
}

}  // namespace

std::optional<scenario::Stimulus> read_act(std::string_view text, const std::string& name, Time at,
                                           Problems& problems) {
  Findings findings({name});
  auto node = scenario::parse_yaml(text, 0, findings);
  if (findings.empty() && node.kind != YamlNode::Kind::map)
    scenario::refuse_kind(node, name, YamlNode::Kind::map, findings);
  scenario::Stimulus act;
  if (findings.empty()) {
    for (const auto* when : {"at", "when", "after", "every"}) {
      if (const auto* given = child(node, when))
        findings.add("live.session-form"_code, given->text.place, fmt::format("{} acts now, and once", name),
                     fmt::format("leave {} out", when));
    }
    scenario::Text key{"at", node.text.place, {}};
    scenario::Text time{scenario::format_time(at), node.text.place, {}};
    node.entries.push_back({std::move(key), YamlNode(YamlNode::Kind::scalar, std::move(time)), 0});
  }
  if (findings.empty()) {
    scenario::MapReader reader(node, name, findings);
    visit(reader, act);
    reader.finish();
  }
  if (findings.empty()) return act;
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return {};
}

bool is_session(const std::filesystem::path& file) {
  constexpr std::string_view first = "- {scenario: ";
  std::string beginning(first.size(), ' ');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(beginning.data(), static_cast<std::streamsize>(first.size())) && beginning == first;
}

std::uint64_t fingerprint_of(scenario::Scenario& scenario) {
  loop::Fingerprint hash;
  Problems ignored;
  if (const auto kept = loop::retentive_file(scenario)) {
    hash.add(read_file(*kept, ignored).value_or(""));
    const auto named = std::exchange(scenario.controller->retentive, {});
    hash.add(scenario);
    scenario.controller->retentive = named;
  } else {
    hash.add(scenario);
  }
  return hash.value();
}

SessionFile::SessionFile(const std::filesystem::path& file, const scenario::Scenario& scenario,
                         std::uint64_t fingerprint)
    : lines_(file) {
  Head head;
  head.scenario.text = std::filesystem::absolute(scenario.file).lexically_normal().string();
  if (const auto kept = loop::retentive_file(scenario); kept && file_exists(*kept)) {
    Problems unreadable;
    const auto values = read_file(*kept, unreadable);
    if (!values) throw std::runtime_error(to_string(unreadable.front()));
    write_file(file.parent_path() / retentive_copy, *values);
  }
  for (const auto& [path, value] : scenario.overrides)
    head.set.push_back({fmt::format("{}={}", path, value), {}, {}});
  head.fingerprint.text = fmt::format("{:016x}", fingerprint);
  lines_.write(
      fmt::format("- {}", in_one_line([&](scenario::Archive& archive) { visit_head(archive, head); })));
  reached(0);
}

void SessionFile::add(const scenario::Stimulus& act) { lines_.write(fmt::format("- {}", act_text(act))); }

void SessionFile::reached(Time now) {
  lines_.write(fmt::format("- {{reached: {}}}\n", scenario::format_time(now)));
  lines_.flush();
}

std::optional<Replay> read_session(const std::filesystem::path& file, std::optional<Time> until,
                                   std::vector<Finding>& notes, Problems& problems) {
  auto session = read_lines(file, problems);
  if (!session) return {};
  if (until && *until > session->reached) {
    problems.push_back({"study.out-of-range"_code, file.string(), 1, 1,
                        fmt::format("the session ends at {}, before {}",
                                    scenario::format_time(session->reached), scenario::format_time(*until)),
                        "name a time in it"});
    return {};
  }
  const auto before = problems.size();
  Replay replay;
  auto& scenario = replay.scenario;
  scenario = scenario::read_scenario(session->scenario, session->set, problems);
  if (problems.size() > before) return {};
  if (scenario.controller && !scenario.controller->retentive.text.empty()) {
    scenario.controller->retentive.text =
        (std::filesystem::absolute(file).parent_path() / retentive_copy).string();
    scenario.controller->retains = false;
  }
  replay.fingerprint = fingerprint_of(scenario);
  if (replay.fingerprint != session->fingerprint)
    notes.emplace_back(
        "live.other-files"_code,
        fmt::format("{} or one of its files is not what it was in the session: this run may differ",
                    session->scenario.string()));
  const auto source = static_cast<int>(scenario.sources.size());
  scenario.sources.push_back(file.string());
  for (auto& act : session->acts) {
    if (until && *act.at >= *until) continue;
    move_places(act, [source](scenario::ScenePlace& place) { place.source = source; });
    scenario.timeline.push_back(std::move(act));
    ++replay.acts;
  }
  replay.reached = until.value_or(session->reached);
  return replay;
}

std::string scenario_of_session(const std::filesystem::path& file, const std::filesystem::path& to,
                                std::vector<Finding>& notes, Problems& problems) {
  auto replay = read_session(file, {}, notes, problems);
  if (!replay) return "";
  auto& scenario = replay->scenario;
  std::error_code unknown;
  const auto place = std::filesystem::weakly_canonical(to, unknown);
  if (std::ranges::any_of(scenario.sources, [&](const auto& source) {
        return std::filesystem::weakly_canonical(source, unknown) == place;
      }))
    problems.push_back({"live.cannot-extend"_code, to.string(), 1, 1,
                        "the session's scenario stands there, and what is made extends it",
                        "name another file"});
  for (const auto& [path, value] : scenario.overrides) {
    problems.push_back({"live.cannot-extend"_code, file.string(), 1, 1,
                        fmt::format("the session ran with --set \"{}={}\"", path, value),
                        "put the value into a scenario and run the session of that one"});
  }
  if (loop::retentive_file(scenario))
    problems.push_back({"live.cannot-extend"_code, file.string(), 1, 1,
                        fmt::format("{} keeps retentive values: a scenario that extends it would begin with "
                                    "today's and change them",
                                    scenario.file.string()),
                        "drycut replay runs the session with those that it began with"});
  const auto base =
      std::filesystem::proximate(scenario.file, std::filesystem::absolute(to).parent_path(), unknown);
  return fmt::format("# {} replay: the session {} as a scenario\nextends: {}\nscene: {{duration: {}}}\n",
                     record::own_mark, file.string(),
                     scenario::yaml_text((unknown ? scenario.file : base).string()),
                     scenario::format_time(std::max(replay->reached, scenario.scene.step))) +
         scenario::yaml_of([&](scenario::Archive& archive) {
           archive.list({"timeline", ""}, scenario.timeline);
         });
}

}  // namespace drycut::sim::live
