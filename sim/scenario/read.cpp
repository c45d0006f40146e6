// The scenario as a whole: text, overrides, sections, and what must fit together.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <unordered_set>

#include "base/plain_text.hpp"
#include "sim/file.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/sections.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

constexpr std::size_t largest_text = std::size_t{1} << 20U;  // [bytes]; yaml-cpp takes half a second for it

void read_seed(const Text& text, std::uint64_t& seed, Findings& findings) {
  const char* const end = text.text.data() + text.text.size();
  const auto read = std::from_chars(text.text.data(), end, seed);
  if (read.ec == std::errc() && read.ptr == end) return;
  findings.add(text.place, fmt::format("scene.seed: '{}' is not a whole number", text.text),
               "0 to 18446744073709551615");
}

SceneSection read_scene(const YamlNode& node, Findings& findings) {
  SceneSection scene;
  MapReader reader(node, "scene", findings);
  reader.text("title", scene.title);
  reader.time("step", scene.step, Sign::positive);
  if (const auto* step = reader.scalar("step")) scene.step_place = step->place;
  reader.time("duration", scene.duration, Sign::positive);
  if (const auto* seed = reader.scalar("seed")) read_seed(*seed, scene.seed, findings);
  reader.finish();
  return scene;
}

QmoveSection read_qmove(const YamlNode& node, const Place& place, Findings& findings) {
  QmoveSection qmove;
  qmove.place = place;
  MapReader reader(node, "controller.qmove", findings);
  reader.text("configuration", qmove.configuration);
  reader.texts("tasks", qmove.tasks);
  reader.time("cycle", qmove.cycle, Sign::positive);
  reader.text("retentive", qmove.retentive);
  read_preset(reader, "controller.qmove", qmove.set, findings);
  reader.finish();
  if (!reader.has("configuration")) {
    reader.missing("configuration", "add configuration: programs/line.cnf");
  }
  return qmove;
}

Lx3vpSection read_lx3vp(const YamlNode& node, const Place& place, Findings& findings) {
  Lx3vpSection lx3vp;
  lx3vp.place = place;
  MapReader reader(node, "controller.lx3vp", findings);
  reader.text("program", lx3vp.program);
  reader.text("registers", lx3vp.registers);
  reader.time("scan", lx3vp.scan, Sign::positive);
  reader.text("retentive", lx3vp.retentive);
  read_preset(reader, "controller.lx3vp", lx3vp.set, findings);
  reader.finish();
  if (!reader.has("program")) reader.missing("program", "add program: programs/saw.il");
  return lx3vp;
}

ControllerSection read_controller(const YamlNode& node, Findings& findings) {
  refuse_duplicates(node, "controller", findings);
  ControllerSection section;
  for (const auto& entry : node.entries) {
    const auto& kind = entry.key.text;
    if (kind != "qmove" && kind != "lx3vp" && kind != "plcopen") {
      findings.add(entry.key.place, fmt::format("unknown controller '{}'", kind),
                   "known: qmove, lx3vp, plcopen");
    } else if (!entry.is_repeated()) {
      if (&entry != &node.entries.front()) {
        findings.add(entry.key.place,
                     fmt::format("a second controller, after {}", node.entries.front().key.text), "keep one");
      } else if (kind == "qmove") {
        section = read_qmove(entry.value, entry.key.place, findings);
      } else if (kind == "lx3vp") {
        section = read_lx3vp(entry.value, entry.key.place, findings);
      } else {
        section = read_plcopen(entry.value, entry.key.place, findings);
      }
    }
  }
  if (node.entries.empty()) {
    findings.add(node.text.place, "controller names none",
                 "write controller: {qmove: {configuration: ...}}, {lx3vp: {program: ...}} or {plcopen: "
                 "{program: ...}}");
  }
  return section;
}

std::vector<Wire> read_wiring(const YamlNode& node, Findings& findings) {
  std::vector<Wire> wiring;
  refuse_duplicates(node, "wiring", findings);
  for (const auto& entry : node.entries) {
    const auto name = "wiring." + entry.key.text;
    if (entry.is_repeated()) continue;
    if (entry.value.kind == YamlNode::Kind::scalar) {
      wiring.push_back({entry.key, entry.value.text});
    } else if (entry.value.kind == YamlNode::Kind::null) {
      findings.add(entry.key.place, fmt::format("{} leads to nothing", name),
                   "write terminal: plant.plug, or terminal: panel.switch");
    } else {
      refuse_kind(entry.value, name, YamlNode::Kind::scalar, findings);
    }
  }
  return wiring;
}

RecordSection read_record(const YamlNode& node, Findings& findings) {
  RecordSection record;
  record.place = node.text.place;
  MapReader reader(node, "record", findings);
  reader.time("every", record.every, Sign::positive);
  reader.texts("channels", record.channels);
  reader.finish();
  std::unordered_set<std::string> known;
  for (const auto& channel : record.channels)
    if (!known.insert(channel.text).second)
      findings.add(channel.place, fmt::format("channel {} is recorded twice", channel.text), "keep one");
  return record;
}

// Where the value at `path` stands: the place of what makes two numbers not fit.
Place place_at(const YamlNode& root, std::initializer_list<std::string_view> path) {
  const YamlNode* node = &root;
  for (const auto& key : path) {
    const auto found = std::find_if(node->entries.begin(), node->entries.end(),
                                    [&](const YamlNode::Entry& entry) { return entry.key.text == key; });
    if (found == node->entries.end()) return node->text.place;
    node = &found->value;
  }
  return node->text.place;
}

// Every period is a whole multiple of the physics step.
void require_multiple(const YamlNode& root, std::initializer_list<std::string_view> path, Time period,
                      Time step, Findings& findings) {
  if (period % step == 0) return;
  const Time below = period / step * step;
  const auto name = fmt::format("{}", fmt::join(path, "."));
  findings.add(place_at(root, path),
               fmt::format("{} {} is not a whole multiple of scene.step {}", name, format_time(period),
                           format_time(step)),
               below == 0
                   ? fmt::format("for example {}", format_time(step))
                   : fmt::format("for example {} or {}", format_time(below), format_time(below + step)));
}

void check_together(const Scenario& scenario, const YamlNode& root, Findings& findings) {
  const Time step = scenario.scene.step;
  require_multiple(root, {"record", "every"}, scenario.record.every, step, findings);
  if (scenario.pictures.frames) {
    require_multiple(root, {"pictures", "frames", "every"}, scenario.pictures.every, step, findings);
  }
  if (const auto* qmove = std::get_if<QmoveSection>(&scenario.controller)) {
    require_multiple(root, {"controller", "qmove", "cycle"}, qmove->cycle, step, findings);
  }
  if (const auto* lx3vp = std::get_if<Lx3vpSection>(&scenario.controller)) {
    require_multiple(root, {"controller", "lx3vp", "scan"}, lx3vp->scan, step, findings);
  }
  if (const auto* plcopen = std::get_if<PlcopenSection>(&scenario.controller)) {
    require_multiple(root, {"controller", "plcopen", "cycle"}, plcopen->cycle, step, findings);
  }
  if (scenario.scene.duration < step) {
    findings.add(place_at(root, {"scene", "duration"}),
                 fmt::format("scene.duration {} is shorter than scene.step {}",
                             format_time(scenario.scene.duration), format_time(step)),
                 "let it last at least one step");
  }
  constexpr Time most_steps = Time{1} << 53U;  // a recorder's row has a number that a double holds
  if (scenario.scene.duration / step > most_steps) {
    findings.add(place_at(root, {"scene", "step"}),
                 fmt::format("scene.duration {} takes {} steps of {}", format_time(scenario.scene.duration),
                             scenario.scene.duration / step, format_time(step)),
                 fmt::format("at most {} steps: a longer step or a shorter duration", most_steps));
  }
}

void read_sections(const YamlNode& root, std::span<const plants::PlantType> types, Scenario& scenario,
                   Findings& findings) {
  MapReader reader(root, "", findings);
  if (const auto* node = reader.map("scene")) scenario.scene = read_scene(*node, findings);
  const auto before = findings.count();
  if (const auto* node = reader.map("plants"))
    scenario.plants = read_plants(*node, types, scenario.scene.step, findings);
  if (const auto* node = reader.map("controller")) {
    scenario.controller = read_controller(*node, findings);
  }
  const bool machine_sound = findings.count() == before;
  if (const auto* node = reader.map("wiring")) scenario.wiring = read_wiring(*node, findings);
  if (const auto* node = reader.list("timeline")) scenario.timeline = read_timeline(*node, findings);
  if (const auto* node = reader.map("record")) scenario.record = read_record(*node, findings);
  if (const auto* node = reader.list("checks")) scenario.checks = read_checks(*node, findings);
  if (const auto* node = reader.map("pictures")) scenario.pictures = read_pictures(*node, findings);
  reader.finish();
  const auto singly = findings.count();
  check_together(scenario, root, findings);
  scenario.buildable = machine_sound && findings.count() == singly;
}

// A scene that compares scenarios (sim/compare/scene.hpp) is none itself.
bool refuse_comparison(const YamlNode& root, Findings& findings) {
  const auto found = std::find_if(root.entries.begin(), root.entries.end(),
                                  [](const YamlNode::Entry& entry) { return entry.key.text == "compare"; });
  if (found == root.entries.end()) return false;
  findings.add(found->key.place, "this scene compares scenarios and is none itself",
               "drycut run and drycut check take it; name one of its scenarios here");
  return true;
}

// The tree of the file, or a map without entries where nothing can be read.
YamlNode parse(std::string_view text, Findings& findings) {
  if (text.size() > largest_text) {
    findings.add({1, 1}, fmt::format("the text has {} bytes", text.size()),
                 fmt::format("a scenario has at most {}", largest_text));
    return {};
  }
  if (const auto fault = text_fault(text)) {
    findings.add({fault->line, fault->column}, fault->what, "a scenario is a YAML text in UTF-8");
    return {};
  }
  return parse_yaml(text, 0, findings);
}

}  // namespace

Place Text::at(std::size_t offset) const {
  Place base = place;
  std::size_t from = 0;
  for (const auto& next : breaks) {
    if (next.offset > offset) break;
    base = next.place;
    from = next.offset;
  }
  base.column += static_cast<int>(offset - from);
  return base;
}

Problem problem_at(const Scenario& scenario, const Place& place, std::string what, std::string remedy) {
  const auto source = static_cast<std::size_t>(place.source);
  const auto name = source < scenario.sources.size() ? scenario.sources[source] : scenario.file.string();
  return {name, place.line, place.column, std::move(what), std::move(remedy)};
}

void read_preset(MapReader& reader, const std::string& of, std::vector<std::pair<Text, double>>& values,
                 Findings& findings) {
  const auto* set = reader.map("set");
  if (set == nullptr) return;
  refuse_duplicates(*set, of + ".set", findings);
  for (const auto& entry : set->entries) {
    const auto name = fmt::format("{}.set.{}", of, entry.key.text);
    if (entry.value.kind != YamlNode::Kind::scalar) {
      refuse_kind(entry.value, name, YamlNode::Kind::scalar, findings);
    } else if (const auto number = read_si(entry.value.text, name, "", findings)) {
      values.emplace_back(entry.key, *number);
    }
  }
}

const std::vector<std::string>& section_names() {
  static const std::vector<std::string> names = {"scene",    "plants", "controller", "wiring",
                                                 "timeline", "record", "checks",     "pictures"};
  return names;
}

Scenario read_scenario_text(std::string_view text, const std::filesystem::path& file,
                            const std::vector<Override>& overrides, Problems& problems,
                            std::span<const plants::PlantType> types) {
  Scenario scenario;
  scenario.file = file;
  scenario.sources = {file.string()};
  scenario.overrides = overrides;
  for (const auto& override : overrides) scenario.sources.push_back("--set " + override.path);
  Findings findings(scenario.sources);
  auto root = parse(text, findings);
  if (findings.empty() && root.kind == YamlNode::Kind::null) {
    findings.add({1, 1}, "the scenario is empty",
                 fmt::format("its sections are: {}", fmt::join(section_names(), ", ")));
  } else if (root.kind != YamlNode::Kind::null) {
    for (std::size_t i = 0; i < overrides.size(); ++i) {
      apply_override(root, overrides[i], static_cast<int>(i) + 1, findings);
    }
    if (root.kind == YamlNode::Kind::map) {
      if (!refuse_comparison(root, findings)) read_sections(root, types, scenario, findings);
    } else {
      refuse_kind(root, "a scenario", YamlNode::Kind::map, findings);
    }
  }
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return scenario;
}

Scenario read_scenario(const std::filesystem::path& file, const std::vector<Override>& overrides,
                       Problems& problems, std::span<const plants::PlantType> types) {
  const auto text = read_file(file, problems);
  if (!text) {
    Scenario scenario;
    scenario.file = file;
    return scenario;
  }
  return read_scenario_text(*text, file, overrides, problems, types);
}

}  // namespace drycut::sim
