#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sim/compare/scene.hpp"
#include "sim/file.hpp"
#include "sim/scenario/sections.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

/// A name that an expression can hold: letters, digits and underscores.
void require_name(const Text& name, const std::string& what, Findings& findings) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const bool begins = !name.text.empty() && std::isdigit(static_cast<unsigned char>(name.text[0])) == 0;
  if (begins && std::all_of(name.text.begin(), name.text.end(), fits)) return;
  findings.add(name.place, fmt::format("{} '{}' is no name for an expression", what, name.text),
               "letters, digits and underscores, a letter first: MC_CamIn");
}

/// Says that two entries of a list have one name.
template <typename Item>
void refuse_same_name(const std::vector<Item>& items, const std::string& what, Findings& findings) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto same = std::find_if(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const Item& other) { return other.name.text == items[i].name.text; });
    if (same == items.begin() + static_cast<std::ptrdiff_t>(i) || items[i].name.text.empty()) continue;
    findings.add(items[i].name.place, fmt::format("there are two {} named '{}'", what, items[i].name.text),
                 fmt::format("give it a name of its own; the first is at line {}", same->name.place.line));
  }
}

// channels: {following_error: {of: AxisX.follerr * 0.1, unit: mm}}
std::vector<ComparisonScene::Channel> read_channels(const YamlNode& map, const std::string& name,
                                                    Findings& findings) {
  refuse_duplicates(map, name, findings);
  std::vector<ComparisonScene::Channel> channels;
  for (const auto& entry : map.entries) {
    ComparisonScene::Channel channel;
    channel.name = entry.key;
    require_name(channel.name, name + ":", findings);
    MapReader reader(entry.value, name + "." + entry.key.text, findings);
    reader.text("of", channel.of);
    reader.text("unit", channel.unit);
    reader.finish();
    if (!reader.has("of")) reader.missing("of", "add of: AxisX.follerr * 0.1 or the like");
    channels.push_back(std::move(channel));
  }
  return channels;
}

std::vector<std::pair<Override, Place>> read_set(const YamlNode& map, const std::string& name,
                                                 Findings& findings) {
  refuse_duplicates(map, name, findings);
  std::vector<std::pair<Override, Place>> set;
  for (const auto& entry : map.entries) {
    if (entry.value.kind == YamlNode::Kind::scalar) {
      set.push_back({{entry.key.text, entry.value.text.text}, entry.value.text.place});
    } else {
      refuse_kind(entry.value, name + "." + entry.key.text, YamlNode::Kind::scalar, findings);
    }
  }
  return set;
}

/// A path, or a map with the path and what is particular to this run.
ComparisonScene::Member read_one(const YamlNode& node, const std::string& name, Findings& findings) {
  ComparisonScene::Member member;
  if (node.kind == YamlNode::Kind::scalar) {
    member.scenario = node.text;
  } else {
    MapReader reader(node, name, findings);
    reader.text("name", member.name);
    reader.text("scenario", member.scenario);
    if (const auto* set = reader.map("set")) member.set = read_set(*set, name + ".set", findings);
    if (const auto* map = reader.map("channels"))
      member.channels = read_channels(*map, name + ".channels", findings);
    reader.finish();
    if (node.kind != YamlNode::Kind::map) return member;
    if (!reader.has("scenario")) reader.missing("scenario", "add scenario: rotary_knife.yaml");
  }
  if (member.name.text.empty())
    member.name = {std::filesystem::path(member.scenario.text).stem().string(), member.scenario.place};
  if (!member.scenario.text.empty()) require_name(member.name, name + ":", findings);
  if (member.name.text == "plots")
    findings.add(member.name.place,
                 fmt::format("{}: 'plots' is the folder of the comparison's own plots", name),
                 "give the run another name");
  return member;
}

ComparisonScene::FigureRequest read_figure(const YamlNode& node, const std::string& name,
                                           Findings& findings) {
  ComparisonScene::FigureRequest figure;
  MapReader reader(node, name, findings);
  reader.text("name", figure.name);
  figure.title = figure.name.text;
  reader.text("title", figure.title);
  reader.text("of", figure.of);
  reader.text("unit", figure.unit);
  reader.finish();
  if (node.kind != YamlNode::Kind::map) return figure;
  if (!reader.has("name")) reader.missing("name", "checks name it: mean_length");
  if (!reader.has("of")) reader.missing("of", "add of: mean(cut.length) or the like");
  if (reader.has("name")) require_name(figure.name, name + ":", findings);
  return figure;
}

/// As one of pictures.plots, and with a window about an event of each run.
OverlayRequest read_overlay(const YamlNode& node, const std::string& name, Findings& findings) {
  static const std::vector<std::string> own = {"around", "before", "after"};
  const auto is_own = [&](const YamlNode::Entry& entry) {
    return std::find(own.begin(), own.end(), entry.key.text) != own.end();
  };
  OverlayRequest request;
  YamlNode window(YamlNode::Kind::map, node.text);
  auto plot = node;
  for (const auto& entry : node.entries)
    if (is_own(entry)) window.entries.push_back(entry);
  std::erase_if(plot.entries, is_own);
  request.plot = read_plot(plot, name, findings);
  for (const auto& panel : request.plot.panels) {
    if (!panel.has_own_x()) continue;
    findings.add(node.text.place, fmt::format("{}: a path, a histogram or a motor is not overlaid", name),
                 "write panels of channels, of lanes or of an event");
    break;
  }
  if (window.entries.empty()) return request;
  MapReader reader(window, name, findings);
  request.around = read_around_window(reader, findings);
  for (const auto* key : {"from", "until", "against"}) {
    if (child(node, key) == nullptr) continue;
    findings.add(child(node, key)->text.place, fmt::format("{}.{} does not go with around", name, key),
                 "write before and after");
  }
  return request;
}

void read_compare(const YamlNode& node, ComparisonScene& scene, Findings& findings) {
  MapReader reader(node, "compare", findings);
  const auto each = [&](const char* key, const auto& read) {
    const auto* list = reader.list(key);
    if (list == nullptr) return;
    for (std::size_t i = 0; i < list->items.size(); ++i)
      read(list->items[i], fmt::format("compare.{}.{}", key, i));
  };
  each("scenarios", [&](const YamlNode& item, const std::string& name) {
    scene.members.push_back(read_one(item, name, findings));
  });
  reader.time("from", scene.from, Sign::not_negative);
  each("figures", [&](const YamlNode& item, const std::string& name) {
    scene.figures.push_back(read_figure(item, name, findings));
  });
  each("plots", [&](const YamlNode& item, const std::string& name) {
    scene.plots.push_back(read_overlay(item, name, findings));
  });
  reader.finish();
  if (scene.members.size() < 2 && node.kind == YamlNode::Kind::map) {
    findings.add(reader.place("scenarios"), "compare.scenarios needs two scenarios at least",
                 "write scenarios: [rotary_knife.yaml, rotary_knife_lx3vp.yaml]");
  }
  refuse_same_name(scene.members, "runs", findings);
  refuse_same_name(scene.figures, "figures", findings);
}

std::vector<ComparisonScene::Check> read_own_checks(const YamlNode& list, Findings& findings) {
  std::vector<ComparisonScene::Check> checks;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    ComparisonScene::Check check;
    MapReader reader(list.items[i], fmt::format("checks.{}", i), findings);
    reader.text("name", check.name);
    reader.expression("expect", check.expect);
    reader.finish();
    if (list.items[i].kind == YamlNode::Kind::map) {
      if (!reader.has("name")) reader.missing("name", "a check needs a name of its own");
      if (!reader.has("expect"))
        reader.missing("expect", "add expect: \"abs(A.mean_length - B.mean_length) <= 0.1\" or the like");
    }
    checks.push_back(std::move(check));
  }
  refuse_same_name(checks, "checks", findings);
  return checks;
}

}  // namespace

std::optional<ComparisonScene> read_comparison(const std::filesystem::path& file, Problems& problems) {
  // What cannot be read or parsed is told by whoever reads it as a scenario.
  Problems ignored;
  const auto text = read_file(file, ignored);
  if (!text) return {};
  Findings findings({file.string()});
  const auto root = parse_yaml(*text, 0, findings);
  if (!findings.empty() || child(root, "compare") == nullptr) return {};
  ComparisonScene scene;
  scene.file = file;
  MapReader reader(root, "", findings);
  if (const auto* node = reader.map("scene")) {
    MapReader own(*node, "scene", findings);
    own.text("title", scene.title);
    own.finish();
  }
  if (const auto* node = reader.map("compare")) read_compare(*node, scene, findings);
  if (const auto* node = reader.list("checks")) scene.checks = read_own_checks(*node, findings);
  reader.finish();
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return scene;
}

Scenario read_member(const ComparisonScene& scene, const ComparisonScene::Member& member,
                     const std::vector<Override>& overrides, Problems& problems) {
  std::vector<Override> all;
  for (const auto& [override, place] : member.set) all.push_back(override);
  all.insert(all.end(), overrides.begin(), overrides.end());
  const auto path = scene.file.parent_path() / member.scenario.text;
  if (!std::filesystem::exists(path)) {
    problems.push_back(scene.problem(member.scenario.place, fmt::format("there is no file {}", path.string()),
                                     "check the path; it is relative to the file that names it"));
    return {};
  }
  return read_scenario(path, all, problems);
}

void place_in_scene(const ComparisonScene& scene, const ComparisonScene::Member& member, Problems& problems) {
  for (auto& problem : problems) {
    for (const auto& [override, place] : member.set) {
      if (problem.file != "--set " + override.path) continue;
      problem = scene.problem({place.line, place.column + problem.column - 1}, problem.what, problem.remedy);
      break;
    }
  }
}

}  // namespace drycut::sim
