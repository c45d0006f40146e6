#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sim/file.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/forms.hpp"
#include "sim/studies/compare/scene.hpp"

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

constexpr std::string_view same_name_remedy = "give it a name of its own; the first is at line {}";

void judge_members(MapReader& reader, std::vector<ComparisonScene::Member>& members) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    auto& [name, scenario, set, channels] = members[i];
    const auto full = fmt::format("{}.{}", reader.full("scenarios"), i);
    if (name.text.empty()) name = {std::filesystem::path(scenario.text).stem().string(), scenario.place};
    if (!scenario.text.empty()) require_name(name, full + ":", reader.findings());
    if (name.text == "plots")
      reader.findings().add(name.place,
                            fmt::format("{}: 'plots' is the folder of the comparison's own plots", full),
                            "give the run another name");
  }
  if (members.size() < 2)
    reader.refuse("scenarios", "compare.scenarios needs two scenarios at least",
                  "write scenarios: [rotary_knife.yaml, rotary_knife_lx3vp.yaml]");
  refuse_same_name(members, "runs", same_name_remedy, reader.findings());
}

void visit_compare(Archive& archive, ComparisonScene& scene) {
  archive.list({"scenarios", "paths, or maps with what is particular to a run"}, scene.members);
  archive.value({"from", "figures look from here on"}, form(scene.from, Sign::not_negative));
  archive.list({"figures", "numbers of each run, side by side"}, scene.figures);
  archive.list({"plots", "as pictures.plots, the runs over each other"}, scene.plots);
  archive.judge([&scene](MapReader& reader) {
    judge_members(reader, scene.members);
    refuse_same_name(scene.figures, "figures", same_name_remedy, reader.findings());
  });
}

}  // namespace

// set: {scene.duration: 2 s}
void visit(Archive& archive, std::pair<Override, Place>& setting) {
  auto value = form(setting.first.value);
  value.read = [&setting, read = value.read](const YamlNode& node, const auto& name, auto& findings) {
    setting.second = node.text.place;
    read(node, name, findings);
  };
  archive.alone(value);
}

// channels: {following_error: {of: AxisX.follerr * 0.1, unit: mm}}
void visit(Archive& archive, ComparisonScene::Channel& channel) {
  archive.in_line();
  archive.value({"of", "an expression over what this run records"}, quoted_form(channel.of));
  archive.require("of", "add of: AxisX.follerr * 0.1 or the like");
  archive.value({"unit", ""}, form(channel.unit));
}

// A path, or a map with the path and what is particular to this run.
void visit(Archive& archive, ComparisonScene::Member& member) {
  if (archive.instead(false, form(member.scenario))) return;
  archive.value({"name", "its folder, its label, its name in checks"}, form(member.name));
  archive.value({"scenario", "path, relative to the scene"}, form(member.scenario));
  archive.require("scenario", "add scenario: rotary_knife.yaml");
  auto& set = member.set;
  archive.names({"set", "as --set of the command line", !set.empty()},
                {set.size(), [&](std::size_t i) { return set[i].first.path; },
                 [&](const Text& path) {
                   set.push_back({{path.text, ""}, {}});
                 },
                 [&] { set.pop_back(); }, [&](Archive& inner, std::size_t i) { visit(inner, set[i]); }});
  archive.names({"channels", "names that all runs share", !member.channels.empty()}, member.channels,
                &ComparisonScene::Channel::name);
  archive.judge([&member](MapReader& reader) {
    for (const auto& channel : member.channels)
      require_name(channel.name, reader.full("channels") + ":", reader.findings());
  });
}

void visit(Archive& archive, ComparisonScene::FigureRequest& figure) {
  archive.in_line();
  archive.value({"name", "in checks: RUN.name"}, form(figure.name));
  archive.require("name", "checks name it: mean_length");
  if (archive.reads()) figure.title = figure.name.text;
  archive.value({"title", "the name unless given"}, form(figure.title));
  archive.value({"of", "terms as of drycut tune: mean(cut.length)"}, quoted_form(figure.of));
  archive.require("of", "add of: mean(cut.length) or the like");
  archive.value({"unit", ""}, form(figure.unit));
  archive.judge([&figure](MapReader& reader) {
    if (reader.has("name")) require_name(figure.name, reader.name() + ":", reader.findings());
  });
}

// As one of pictures.plots, and with a window about an event of each run.
void visit(Archive& archive, OverlayRequest& request) {
  visit(archive, request.plot, request.around);
  archive.judge([&request](MapReader& reader) {
    const auto& panels = request.plot.panels;
    if (std::any_of(panels.begin(), panels.end(), [](const auto& panel) { return panel.has_own_x(); }))
      reader.findings().add(reader.place(),
                            fmt::format("{}: a path, a histogram or a motor is not overlaid", reader.name()),
                            "write panels of channels, of lanes or of an event");
    for (const auto* key : {"from", "until", "against"}) {
      if (!request.around || !reader.has(key)) continue;
      reader.findings().add(reader.value_place(key),
                            fmt::format("{} does not go with around", reader.full(key)),
                            "write before and after");
    }
  });
}

void visit(Archive& archive, ComparisonScene::Check& check) {
  archive.in_line();
  archive.value({"name", "what reports call it"}, form(check.name));
  archive.require("name", "a check needs a name of its own");
  archive.value({"expect", "over RUN.figure and RUN.passed"}, expression_form(check.expect));
  archive.require("expect", "add expect: \"abs(A.mean_length - B.mean_length) <= 0.1\" or the like");
}

void visit(Archive& archive, ComparisonScene& scene) {
  archive.section({"scene", ""}, [&](Archive& inner) {
    inner.value({"title", "what reports call it"}, form(scene.title));
  });
  archive.section({"compare", "scenarios that are run and laid over each other"},
                  [&](Archive& inner) { visit_compare(inner, scene); });
  archive.list({"checks", "what must hold between the runs"}, scene.checks);
  archive.judge([&scene](MapReader& reader) {
    refuse_same_name(scene.checks, "checks", same_name_remedy, reader.findings());
  });
}

std::string expand(const ComparisonScene& scene) {
  // A visit takes what an archive may fill; this one fills nothing.
  return yaml_of([&](Archive& archive) { visit(archive, const_cast<ComparisonScene&>(scene)); });
}

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
  visit(reader, scene);
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
