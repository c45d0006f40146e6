#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sim/file.hpp"
#include "sim/recordings/recording_file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/extends.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/json_schema.hpp"
#include "sim/scenario/variables.hpp"
#include "sim/studies/compare/scene.hpp"

namespace drycut::sim::studies {

namespace {

/// A name that an expression can hold: letters, digits and underscores.
void require_name(const scenario::Text& name, const std::string& what, scenario::Findings& findings) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const bool begins = !name.text.empty() && std::isdigit(static_cast<unsigned char>(name.text[0])) == 0;
  if (begins && std::all_of(name.text.begin(), name.text.end(), fits)) return;
  findings.add("scenario.bad-name"_code, name.place,
               fmt::format("{} '{}' is no name for an expression", what, name.text),
               "letters, digits and underscores, a letter first: MC_CamIn");
}

constexpr std::string_view same_name_remedy = "give it a name of its own; the first is at line {}";

void judge_members(scenario::MapReader& reader, std::vector<ComparisonScene::Member>& members) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    auto& [name, scenario, set, channels] = members[i];
    const auto full = fmt::format("{}.{}", reader.full("scenarios"), i);
    if (name.text.empty()) name = {std::filesystem::path(scenario.text).stem().string(), scenario.place};
    if (!scenario.text.empty()) require_name(name, full + ":", reader.findings());
    if (name.text == "plots")
      reader.findings().add("scenario.bad-name"_code, name.place,
                            fmt::format("{}: 'plots' is the folder of the comparison's own plots", full),
                            "give the run another name");
  }
  if (members.size() < 2)
    reader.refuse("compare.runs"_code, "scenarios", "compare.scenarios needs two scenarios at least",
                  "write scenarios: [rotary_knife.yaml, rotary_knife_lx3vp.yaml]");
  scenario::refuse_same_name(members, "runs", same_name_remedy, reader.findings());
}

void visit_compare(scenario::Archive& archive, ComparisonScene& scene) {
  archive.list({"scenarios", "paths, or maps with what is particular to a run"}, scene.members);
  archive.value({"from", "figures look from here on"},
                scenario::form(scene.from, scenario::Sign::not_negative));
  archive.list({"figures", "numbers of each run, side by side"}, scene.figures);
  archive.list({"plots", "as pictures.plots, the runs over each other"}, scene.plots);
  archive.judge([&scene](scenario::MapReader& reader) {
    judge_members(reader, scene.members);
    scenario::refuse_same_name(scene.figures, "figures", same_name_remedy, reader.findings());
  });
}

}  // namespace

// set: {scene.duration: 2 s}
void visit(scenario::Archive& archive, std::pair<scenario::Override, scenario::ScenePlace>& setting) {
  auto value = scenario::form(setting.first.value);
  value.read = [&setting, read = value.read](const scenario::YamlNode& node, const auto& name,
                                             auto& findings) {
    setting.second = node.text.place;
    read(node, name, findings);
  };
  archive.alone(value);
}

// channels: {following_error: {of: AxisX.follerr * 0.1, unit: mm}}
void visit(scenario::Archive& archive, ComparisonScene::Channel& channel) {
  archive.in_line();
  archive.value({"of", "an expression over what this run records"}, scenario::quoted_form(channel.of));
  archive.require("of", "add of: AxisX.follerr * 0.1 or the like");
  archive.value({"unit", ""}, scenario::form(channel.unit));
}

// A path, or a map with the path and what is particular to this run.
void visit(scenario::Archive& archive, ComparisonScene::Member& member) {
  if (archive.instead(false, scenario::path_form(member.scenario))) return;
  archive.value({"name", "its folder, its label, its name in checks"}, scenario::form(member.name));
  archive.value({"scenario", "path, relative to the scene"}, scenario::path_form(member.scenario));
  archive.require("scenario", "add scenario: rotary_knife.yaml");
  auto& set = member.set;
  archive.names(
      {"set", "as --set of the command line", !set.empty()},
      {set.size(), [&](std::size_t i) { return set[i].first.path; },
       [&](const scenario::Text& path) {
         set.push_back({{path.text, ""}, {}});
       },
       [&] { set.pop_back(); }, [&](scenario::Archive& inner, std::size_t i) { visit(inner, set[i]); }});
  archive.names({"channels", "names that all runs share", !member.channels.empty()}, member.channels,
                &ComparisonScene::Channel::name);
  archive.judge([&member](scenario::MapReader& reader) {
    for (const auto& channel : member.channels)
      require_name(channel.name, reader.full("channels") + ":", reader.findings());
  });
}

void visit(scenario::Archive& archive, ComparisonScene::FigureRequest& figure) {
  archive.in_line();
  archive.value({"name", "in checks: RUN.name"}, scenario::form(figure.name));
  archive.require("name", "checks name it: mean_length");
  if (archive.reads()) figure.title = figure.name.text;
  archive.value({"title", "the name unless given"}, scenario::form(figure.title));
  archive.value({"of", "terms as of drycut tune: mean(cut.length)"}, scenario::quoted_form(figure.of));
  archive.require("of", "add of: mean(cut.length) or the like");
  archive.value({"unit", ""}, scenario::form(figure.unit));
  archive.judge([&figure](scenario::MapReader& reader) {
    if (reader.has("name")) require_name(figure.name, reader.name() + ":", reader.findings());
  });
}

// As one of pictures.plots, and with a window about an event of each run.
void visit(scenario::Archive& archive, OverlayRequest& request) {
  scenario::visit(archive, request.plot, request.around);
  archive.judge([&request](scenario::MapReader& reader) {
    const auto& panels = request.plot.panels;
    if (std::any_of(panels.begin(), panels.end(), [](const auto& panel) { return panel.has_own_x(); }))
      reader.findings().add("scenario.does-not-go-together"_code, reader.place(),
                            fmt::format("{}: a path, a histogram or a motor is not overlaid", reader.name()),
                            "write panels of channels, of lanes or of an event");
    for (const auto* key : {"from", "until", "against"}) {
      if (!request.around || !reader.has(key)) continue;
      reader.findings().add("scenario.does-not-go-together"_code, reader.value_place(key),
                            fmt::format("{} does not go with around", reader.full(key)),
                            "write before and after");
    }
  });
}

void visit(scenario::Archive& archive, ComparisonScene::Check& check) {
  archive.in_line();
  archive.value({"name", "what reports call it"}, scenario::form(check.name));
  archive.require("name", "a check needs a name of its own");
  archive.value({"expect", "over RUN.figure and RUN.passed"}, scenario::expression_form(check.expect));
  archive.require("expect", "add expect: \"abs(A.mean_length - B.mean_length) <= 0.1\" or the like");
}

void visit(scenario::Archive& archive, ComparisonScene& scene) {
  archive.value({"extends", "another such scene that this one changes", false},
                scenario::form(scene.extends));
  archive.names({"variables", "used as ${name} in this scene", !scene.variables.empty()}, scene.variables,
                &scenario::VariableEntry::name);
  archive.section({"scene", ""}, [&](scenario::Archive& inner) {
    inner.value({"title", "what reports call it"}, scenario::form(scene.title));
  });
  archive.section({"compare", "scenarios that are run and laid over each other"},
                  [&](scenario::Archive& inner) { visit_compare(inner, scene); });
  archive.list({"checks", "what must hold between the runs"}, scene.checks);
  archive.judge([&scene](scenario::MapReader& reader) {
    scenario::refuse_same_name(scene.checks, "checks", same_name_remedy, reader.findings());
  });
}

std::string json_schema() {
  return scenario::json_schema(
      [](scenario::Archive& archive) {
        ComparisonScene scratch;
        visit(archive, scratch);
      },
      [](scenario::Archive& archive) {
        recordings::RecordingFile scratch;
        recordings::visit(archive, scratch);
      });
}

std::string expand(const ComparisonScene& scene) {
  // visit() takes a scene that may change, because other archives fill it; this archive only reads.
  return scenario::yaml_of(
      [&](scenario::Archive& archive) { visit(archive, const_cast<ComparisonScene&>(scene)); });
}

std::optional<ComparisonScene> read_comparison(const std::filesystem::path& file, Problems& problems) {
  // What cannot be read or parsed is told by whoever reads it as a scenario.
  Problems ignored;
  const auto text = read_file(file, ignored);
  if (!text) return {};
  scenario::Findings findings({file.string()});
  auto root = scenario::read_tree(*text, file, findings);
  if (!findings.empty() || scenario::child(root, "compare") == nullptr) return {};
  scenario::resolve_variables(root, findings);
  ComparisonScene scene;
  scene.file = file;
  scenario::MapReader reader(root, "", findings);
  visit(reader, scene);
  reader.finish();
  scene.sources = findings.sources();
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return scene;
}

scenario::Scenario read_member(const ComparisonScene& scene, const ComparisonScene::Member& member,
                               const std::vector<scenario::Override>& overrides, Problems& problems) {
  std::vector<scenario::Override> all;
  for (const auto& [override, place] : member.set) all.push_back(override);
  all.insert(all.end(), overrides.begin(), overrides.end());
  const auto path = scene.file.parent_path() / member.scenario.text;
  if (!std::filesystem::exists(path)) {
    problems.push_back(scene.problem("file.missing"_code, member.scenario.place,
                                     fmt::format("there is no file {}", path.string()),
                                     "check the path; it is relative to the file that names it"));
    return {};
  }
  return scenario::read_scenario(path, all, problems);
}

void place_in_scene(const ComparisonScene& scene, const ComparisonScene::Member& member, Problems& problems) {
  for (auto& problem : problems) {
    for (const auto& [override, place] : member.set) {
      if (problem.file != "--set " + override.path) continue;
      problem = scene.problem(problem.code, {place.line, place.column + problem.column - 1, place.source},
                              problem.what, problem.remedy);
      break;
    }
  }
}

}  // namespace drycut::sim::studies
