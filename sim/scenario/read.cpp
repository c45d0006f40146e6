// The scenario as a whole: text, overrides, sections, and what must fit together.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/extends.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/sections.hpp"
#include "sim/scenario/variable_slips.hpp"
#include "sim/scenario/variables.hpp"

namespace drycut::sim::scenario {

namespace {

// Reads the whole: plants need the step and the known types, a controller one of its kinds.
class ScenarioReader final : public MapReader {
 public:
  ScenarioReader(const YamlNode& root, std::span<const plants::PlantType> types, const Scenario& scenario,
                 Findings& findings)
      : MapReader(root, "", findings), types_(types), scenario_(scenario) {}

  void plants(const Key& key, std::vector<PlantEntry>& plants) override {
    const auto before = findings().count();
    if (const auto* node = of_kind(key.name, YamlNode::Kind::map))
      plants = read_plants(*node, types_, scenario_.scene.step, scenario_.file.parent_path(), findings());
    machine_sound_ = findings().count() == before;
  }

  void controller(const Key& key, std::unique_ptr<ControllerSection>& controller) override {
    const auto before = findings().count();
    if (const auto* node = of_kind(key.name, YamlNode::Kind::map)) read_controller(*node, controller);
    machine_sound_ = machine_sound_ && findings().count() == before;
  }

  [[nodiscard]] bool machine_is_sound() const { return machine_sound_; }

 private:
  void read_controller(const YamlNode& node, std::unique_ptr<ControllerSection>& controller) {
    refuse_duplicates(node, "controller", findings());
    std::vector<std::string> known;
    std::vector<std::string> examples;
    for (const auto& kind : controller_kinds()) {
      known.emplace_back(kind.name);
      examples.push_back(fmt::format("{{{}: {}}}", kind.name, kind.example));
    }
    for (const auto& entry : node.entries) {
      const auto* const kind = controller_kind(entry.key.text);
      if (kind == nullptr) {
        findings().add("controller.unknown-kind"_code, entry.key.place,
                       fmt::format("unknown controller '{}'", entry.key.text),
                       fmt::format("known: {}", fmt::join(known, ", ")));
      } else if (!entry.is_repeated() && &entry != &node.entries.front()) {
        findings().add("scenario.twice"_code, entry.key.place,
                       fmt::format("a second controller, after {}", node.entries.front().key.text),
                       "keep one");
      } else if (!entry.is_repeated()) {
        controller = kind->make();
        controller->place = entry.key.place;
        MapReader reader(entry.value, "controller." + entry.key.text, findings());
        controller->visit(reader);
        reader.finish();
      }
    }
    if (!node.entries.empty()) return;
    const auto last = examples.back();
    examples.pop_back();
    findings().add("scenario.needs-another"_code, node.text.place, "controller names none",
                   fmt::format("write controller: {} or {}", fmt::join(examples, ", "), last));
  }

  std::span<const plants::PlantType> types_;
  const Scenario& scenario_;
  bool machine_sound_ = true;
};

// Where the value at `path` stands: the place of what makes two numbers not fit.
ScenePlace place_at(const YamlNode& root, std::initializer_list<std::string_view> path) {
  const YamlNode* node = &root;
  for (const auto& key : path) {
    const auto* const next = child(*node, key);
    if (next == nullptr) break;
    node = next;
  }
  return node->text.place;
}

// Every period is a whole multiple of the physics step.
void require_multiple(const YamlNode& root, std::initializer_list<std::string_view> path, Time period,
                      Time step, Findings& findings) {
  if (period % step == 0) return;
  const Time below = period / step * step;
  const auto name = fmt::format("{}", fmt::join(path, "."));
  findings.add("scenario.time-grid"_code, place_at(root, path),
               fmt::format("{} {} is not a whole multiple of scene.step {}", name, format_time(period),
                           format_time(step)),
               below == 0
                   ? fmt::format("for example {}", format_time(step))
                   : fmt::format("for example {} or {}", format_time(below), format_time(below + step)));
}

// Who shortens a run from the command line knows that it does not get so far.
void refuse_late_checks(const Scenario& scenario, const YamlNode& root, Findings& findings) {
  const auto shortened = place_at(root, {"scene", "duration"}).source;
  if (shortened > 0 && shortened <= static_cast<int>(scenario.overrides.size())) return;
  for (const auto& check : scenario.checks)
    if (check.from >= scenario.scene.duration)
      findings.add("scenario.order"_code, check.name.place,
                   fmt::format("the check '{}' begins at {}, and the run ends at {}", check.name.text,
                               format_time(check.from), format_time(scenario.scene.duration)),
                   "an earlier from, or a longer scene.duration");
}

void check_together(const Scenario& scenario, const YamlNode& root, Findings& findings) {
  const Time step = scenario.scene.step;
  require_multiple(root, {"record", "every"}, scenario.record.every, step, findings);
  if (scenario.pictures.frames) {
    require_multiple(root, {"pictures", "frames", "every"}, scenario.pictures.every, step, findings);
  }
  if (const auto& controller = scenario.controller) {
    const auto [key, time] = controller->period();
    require_multiple(root, {"controller", controller->kind(), key}, time, step, findings);
    require_multiple(root, {"controller", controller->kind(), "compute_time"}, controller->compute_time, step,
                     findings);
  }
  if (scenario.scene.duration < step) {
    findings.add("scenario.time-grid"_code, place_at(root, {"scene", "duration"}),
                 fmt::format("scene.duration {} is shorter than scene.step {}",
                             format_time(scenario.scene.duration), format_time(step)),
                 "let it last at least one step");
  }
  refuse_late_checks(scenario, root, findings);
  constexpr Time most_steps = Time{1} << 53U;  // a recorder's row has a number that a double holds
  if (scenario.scene.duration / step > most_steps) {
    findings.add("scenario.time-grid"_code, place_at(root, {"scene", "step"}),
                 fmt::format("scene.duration {} takes {} steps of {}", format_time(scenario.scene.duration),
                             scenario.scene.duration / step, format_time(step)),
                 fmt::format("at most {} steps: a longer step or a shorter duration", most_steps));
  }
}

void read_sections(const YamlNode& root, std::span<const plants::PlantType> types, Scenario& scenario,
                   Findings& findings) {
  ScenarioReader reader(root, types, scenario, findings);
  visit(reader, scenario);
  reader.finish();
  const auto singly = findings.count();
  check_together(scenario, root, findings);
  scenario.buildable = reader.machine_is_sound() && findings.count() == singly;
}

/// What the file and what it extends say of a variable.
void take_origin(const YamlNode& root, VariableEntry& variable) {
  const auto* section = child(root, "variables");
  const auto* value = section == nullptr ? nullptr : child(*section, variable.name.text);
  if (value == nullptr) return;
  variable.beside = value->beside;
  variable.given_anew = !value->first.empty();
}

// An axis drives something, so it has wires.
void refuse_axes_without_wires(const YamlNode& root, Findings& findings) {
  const auto* node = &root;
  for (const auto* key : {"controller", "plcopen", "axes"})
    if (node != nullptr) node = child(*node, key);
  if (node == nullptr) return;
  const auto* wiring = child(root, "wiring");
  for (const auto& axis : node->entries) {
    const auto meant = did_you_mean(axis.key.text, axis.value.beside, "");
    if (axis.value.beside.empty() || meant.empty() || child(axis.value, "kind") != nullptr) continue;
    const auto is_of_axis = [&](const YamlNode::Entry& wire) {
      return wire.key.text.starts_with(axis.key.text + ".");
    };
    if (wiring != nullptr && std::any_of(wiring->entries.begin(), wiring->entries.end(), is_of_axis))
      continue;
    findings.add(
        "scenario.unknown-name"_code, axis.key.place,
        fmt::format("the axis '{}' has no wire, and what is extended has none of this name", axis.key.text),
        meant);
  }
}

// A section whose name is nearly that of one which is not there is told and then read as that one, so that
// the rest is judged by what was meant.
void take_misspelt_sections(YamlNode& root, Findings& findings) {
  for (auto& [key, value, first_line] : root.entries) {
    const auto meant = nearest(key.text, section_names());
    if (meant.empty() || child(root, meant) != nullptr) continue;
    findings.add("scenario.unknown-key"_code, key.place, fmt::format("unknown key '{}'", key.text),
                 did_you_mean(key.text, section_names()));
    key.text = meant;
  }
}

// {gap: 0,4 mm} is a gap of 0 and a key '4 mm': told as what it is, and read as what was meant.
void take_decimal_commas(YamlNode& node, Findings& findings) {
  for (auto& item : node.items) take_decimal_commas(item, findings);
  for (auto& entry : node.entries) take_decimal_commas(entry.value, findings);
  for (std::size_t i = 1; i < node.entries.size(); ++i) {
    auto& [key, value, repeated] = node.entries[i - 1];
    const auto& torn = node.entries[i];
    if (torn.value.kind != YamlNode::Kind::null || value.kind != YamlNode::Kind::scalar) continue;
    const auto written = fmt::format("{},{}", value.text.text, torn.key.text);
    const auto pointed = with_decimal_point(written);
    if (pointed.empty()) continue;
    findings.add("scenario.not-a-number"_code, value.text.place,
                 fmt::format("{}: '{}' has a decimal comma", key.text, written),
                 fmt::format("write {}", pointed));
    value.text = {pointed, value.text.place};
    node.entries.erase(node.entries.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

// A scene that compares scenarios (sim/studies/compare/scene.hpp) is none itself.
bool refuse_comparison(const YamlNode& root, Findings& findings) {
  const auto found = std::find_if(root.entries.begin(), root.entries.end(),
                                  [](const YamlNode::Entry& entry) { return entry.key.text == "compare"; });
  if (found == root.entries.end()) return false;
  findings.add("scenario.not-a-scenario"_code, found->key.place,
               "this scene compares scenarios and is none itself",
               "drycut run and drycut check take it; name one of its scenarios here");
  return true;
}

}  // namespace

ScenePlace Text::at(std::size_t offset) const {
  ScenePlace base = place;
  std::size_t from = 0;
  for (const auto& next : breaks) {
    if (next.offset > offset) break;
    base = next.place;
    from = next.offset;
  }
  base.column += static_cast<int>(offset - from);
  return base;
}

bool sets(const Scenario& scenario, std::string_view value) {
  const auto names_it = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const auto& entry) {
      const std::string_view name = entry.first.text;
      return same_word(name, value) || same_word(name.substr(name.rfind('.') + 1), value);
    });
  };
  return (scenario.controller && names_it(scenario.controller->set)) ||
         std::any_of(scenario.timeline.begin(), scenario.timeline.end(), [&](const Stimulus& stimulus) {
           return names_it(stimulus.set) || names_it(stimulus.ramp);
         });
}

NamedAt named_at(const Scenario& scenario, const ScenePlace& place) {
  const auto source = static_cast<std::size_t>(place.source);
  const auto name = source < scenario.sources.size() ? scenario.sources[source] : scenario.file.string();
  return {name, place.line, place.column};
}

Problem problem_at(Code code, const Scenario& scenario, const ScenePlace& place, std::string what,
                   std::string remedy) {
  auto at = named_at(scenario, place);
  return {code, std::move(at.file), at.line, at.column, std::move(what), std::move(remedy)};
}

namespace {

Scenario read_once(std::string_view text, const std::filesystem::path& file,
                   const std::vector<Override>& overrides, Problems& problems,
                   std::span<const plants::PlantType> types, const Trial* trial) {
  Scenario scenario;
  scenario.on_trial = trial != nullptr;
  scenario.file = file;
  scenario.sources = {file.string()};
  scenario.overrides = overrides;
  for (const auto& override : overrides) scenario.sources.push_back("--set " + override.path);
  Findings findings(scenario.sources);
  auto root = read_tree(text, file, findings);
  if (findings.empty() && root.kind == YamlNode::Kind::null) {
    findings.add("scenario.needs-another"_code, {1, 1}, "the scenario is empty",
                 fmt::format("its sections are: {}", fmt::join(section_names(), ", ")));
  } else if (root.kind != YamlNode::Kind::null) {
    take_misspelt_sections(root, findings);
    take_decimal_commas(root, findings);
    for (std::size_t i = 0; i < overrides.size(); ++i) {
      apply_override(root, overrides[i], static_cast<int>(i) + 1, findings);
    }
    if (root.kind == YamlNode::Kind::map) {
      if (!refuse_comparison(root, findings)) {
        const auto before = findings.count();
        if (trial != nullptr) put_on_trial(root, *trial);
        auto used = resolve_variables(root, findings);
        const bool resolved = findings.count() == before;
        read_sections(root, types, scenario, findings);
        scenario.buildable = scenario.buildable && resolved;
        for (auto& variable : scenario.variables) {
          variable.uses = std::move(used[variable.name.text]);
          take_origin(root, variable);
        }
        refuse_slips(scenario, findings);
        refuse_axes_without_wires(root, findings);
      }
    } else {
      refuse_kind(root, "a scenario", YamlNode::Kind::map, findings);
    }
  }
  scenario.sources = findings.sources();
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return scenario;
}

}  // namespace

Scenario read_scenario_text(std::string_view text, const std::filesystem::path& file,
                            const std::vector<Override>& overrides, Problems& problems,
                            std::span<const plants::PlantType> types, const Trial* trial) {
  const auto before = problems.size();
  auto scenario = read_once(text, file, overrides, problems, types, trial);
  blame_variables(scenario, problems, before, [&](const Trial& other) {
    Problems left;
    read_once(text, file, overrides, left, types, &other);
    return left;
  });
  return scenario;
}

Scenario read_scenario(const std::filesystem::path& file, const std::vector<Override>& overrides,
                       Problems& problems, std::span<const plants::PlantType> types, const Trial* trial) {
  const auto text = read_file(file, problems);
  if (!text) {
    Scenario scenario;
    scenario.file = file;
    return scenario;
  }
  return read_scenario_text(*text, file, overrides, problems, types, trial);
}

}  // namespace drycut::sim::scenario
