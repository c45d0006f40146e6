// The sections of a scenario: scene, wiring, filters, timeline, record and checks. Plants, disturbances and
// pictures have files of their own, controllers a folder (sim/controllers).
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_set>

#include "base/text.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/sections.hpp"

namespace drycut::sim::scenario {

namespace {

void visit_scene(Archive& archive, SceneSection& scene) {
  archive.value({"title", "what reports and films call the scenario"}, form(scene.title));
  archive.value({"step", "of the physics; every period is a whole multiple of it"},
                form(scene.step, Sign::positive));
  archive.value({"duration", "of the run"}, form(scene.duration, Sign::positive));
  archive.value({"seed", "of all that is drawn at random"}, form(scene.seed));
  archive.judge([&scene](MapReader& reader) {
    if (reader.has("step")) scene.step_place = reader.value_place("step");
  });
}

// A value that the timeline writes: a quantity, or a switch position as 1 or 0.
std::optional<Quantity> read_action(const YamlNode::Entry& entry, const std::string& name,
                                    Findings& findings) {
  if (entry.value.kind == YamlNode::Kind::null) {
    findings.add("scenario.needs-another"_code, entry.key.place, fmt::format("{} has no value", name),
                 "write the value to set");
    return {};
  }
  if (entry.value.kind != YamlNode::Kind::scalar) {
    refuse_kind(entry.value, name, YamlNode::Kind::scalar, findings);
    return {};
  }
  const auto& text = entry.value.text;
  if (text.text == "on" || text.text == "true") return Quantity{1, "", text.place};
  if (text.text == "off" || text.text == "false") return Quantity{0, "", text.place};
  return read_quantity(text, name, findings);
}

std::string action_text(const Text& target, const Quantity& value) {
  auto written = value;
  return fmt::format("{}: {}", yaml_text(target.text), form(written).write());
}

constexpr std::string_view action_schema = R"({"type": ["number", "string", "boolean"]})";

/// What acts on nothing would be no line of a session.
void refuse_empty(const YamlNode& map, const Form::Name& name, std::string_view example, Findings& findings) {
  if (!map.entries.empty()) return;
  findings.add("scenario.needs-another"_code, name.key, fmt::format("{} is empty", name.full),
               fmt::format("name what it acts on, {}, or leave it out", example));
}

// set: {panel.start: 1, web.speed: 60 m/min}
Form actions_form(std::vector<std::pair<Text, Quantity>>& actions) {
  return whole(
      YamlNode::Kind::map,
      [&actions](const YamlNode& map, const Form::Name& name, Findings& findings) {
        refuse_duplicates(map, name.full, findings);
        refuse_empty(map, name, "{web.speed: 30 m/min}", findings);
        for (const auto& entry : map.entries) {
          const auto quantity = read_action(entry, name.full + "." + entry.key.text, findings);
          if (quantity) actions.emplace_back(entry.key, *quantity);
        }
      },
      [&actions] {
        std::vector<std::string> items;
        for (const auto& [target, value] : actions) items.push_back(action_text(target, value));
        return yaml_map(items);
      },
      fmt::format(R"({{"type": "object", "minProperties": 1, "additionalProperties": {}}})", action_schema));
}

void read_faults(const YamlNode& map, const std::string& name, std::vector<Stimulus::FaultAction>& faults,
                 Findings& findings) {
  refuse_duplicates(map, name, findings);
  for (const auto& component : map.entries) {
    const auto full = name + "." + component.key.text;
    if (component.value.kind != YamlNode::Kind::map || component.value.entries.empty()) {
      findings.add(
          "scenario.needs-another"_code, component.key.place, fmt::format("{} names no fault", full),
          fmt::format("write {}: {{fault: value}}; 'drycut plants' lists the faults", component.key.text));
      continue;
    }
    refuse_duplicates(component.value, full, findings);
    for (const auto& fault : component.value.entries) {
      const auto value = read_action(fault, full + "." + fault.key.text, findings);
      if (value) faults.push_back({component.key, fault.key, *value});
    }
  }
}

// Each component once, with its faults.
std::string faults_text(const std::vector<Stimulus::FaultAction>& faults) {
  std::vector<std::pair<std::string, std::vector<std::string>>> components;
  for (const auto& fault : faults) {
    auto same = std::find_if(components.begin(), components.end(),
                             [&](const auto& other) { return other.first == fault.component.text; });
    if (same == components.end()) same = components.insert(same, {fault.component.text, {}});
    same->second.push_back(action_text(fault.fault, fault.value));
  }
  std::vector<std::string> items;
  for (const auto& [component, own] : components)
    items.push_back(fmt::format("{}: {}", yaml_text(component), yaml_map(own)));
  return yaml_map(items);
}

// fault: {knife.encoder: {lose_counts: 200}}
Form faults_form(std::vector<Stimulus::FaultAction>& faults) {
  return whole(
      YamlNode::Kind::map,
      [&faults](const YamlNode& map, const Form::Name& name, Findings& findings) {
        refuse_empty(map, name, "{knife.encoder: {lose_counts: 200}}", findings);
        read_faults(map, name.full, faults, findings);
      },
      [&faults] { return faults_text(faults); },
      fmt::format(
          R"({{"type": "object", "minProperties": 1, "additionalProperties": {{"type": "object", "minProperties": 1,)"
          R"( "additionalProperties": {}}}}})",
          action_schema));
}

void judge_stimulus(MapReader& reader, Stimulus& stimulus) {
  stimulus.place = reader.place();
  const auto& name = reader.name();
  if (reader.has("ramp") && !reader.has("over"))
    reader.refuse("scenario.needs-another"_code, "ramp", fmt::format("{}.ramp has no duration", name),
                  "add over: 1 s");
  if (reader.has("over") && !reader.has("ramp")) {
    reader.refuse("scenario.needs-another"_code, "over", fmt::format("{}.over stands without ramp", name),
                  "write ramp instead of set, or leave over out");
  }
  if (reader.has("at") && reader.has("when"))
    reader.refuse("scenario.does-not-go-together"_code, "at", fmt::format("{} has both at and when", name),
                  "keep one; from: is the time before which `when` is not looked at");
  if (reader.has("from") && !reader.has("when"))
    reader.refuse("scenario.needs-another"_code, "from", fmt::format("{}.from stands without when", name),
                  "write at for a time");
}

struct KindName {
  std::string_view key;
  CheckRequest::Kind kind;
  std::string_view meaning;
};
constexpr KindName kinds[] = {
    {"each", CheckRequest::Kind::each,
     "every event of this name satisfies expect; statistics look from one event to the next"},
    {"all", CheckRequest::Kind::all,
     "expect holds over statistics of all events of this name: mean_x, max_x, ..., p99(x), rms(x), ..."},
    {"always", CheckRequest::Kind::always,
     "the expression holds at every record instant; statistics look at every step of the whole window, or of "
     "every period"},
    {"eventually", CheckRequest::Kind::eventually,
     "the expression holds at one record instant at least, or over one period"},
    {"never", CheckRequest::Kind::never, "no event of this name happens"}};

bool is_of_events(const CheckRequest& check) {
  return check.kind == CheckRequest::Kind::each || check.kind == CheckRequest::Kind::all;
}

// The value of a kind's key: an expression, or an event. `said` once one of the keys has been read.
Form kind_form(CheckRequest& check, const KindName& of, bool& said) {
  auto expression = expression_form(check.expression);
  auto event = form(check.event);
  const bool of_time = of.kind == CheckRequest::Kind::always || of.kind == CheckRequest::Kind::eventually;
  auto made = of_time ? expression : event;
  made.read = [&check, &said, &of, read = made.read](const YamlNode& node, const Form::Name& name,
                                                     Findings& findings) {
    if (said) return;
    said = true;
    check.kind = of.kind;
    read(node, name, findings);
  };
  return made;
}

// Statistics look at the whole window, or at one period of it after the other.
void judge_period(MapReader& reader, const CheckRequest& check) {
  const bool eventually = check.kind == CheckRequest::Kind::eventually;
  if (reader.has("every") && check.kind != CheckRequest::Kind::always && !eventually)
    return reader.refuse("scenario.needs-another"_code, "every",
                         fmt::format("{} does not go with this kind of check", reader.full("every")),
                         "every belongs to always and eventually");
  if (check.expression.text.empty() || reader.has("every") == has_statistics(check.expression)) return;
  if (reader.has("every"))
    reader.refuse("scenario.needs-another"_code, "every",
                  fmt::format("{} stands without a statistic", reader.full("every")),
                  "write a statistic, such as rms(knife.motor.torque), or leave every out");
  else if (eventually)
    reader.refuse("scenario.needs-another"_code, "eventually",
                  fmt::format("{} has statistics and no period", reader.name()),
                  "add every: 0.8 s, or write always");
}

void judge_check(MapReader& reader, const CheckRequest& check) {
  // A key that belongs to other kinds of check only.
  const auto refuse_misplaced = [&](std::string_view key, std::string_view belongs_to) {
    if (!reader.has(key)) return;
    reader.refuse("scenario.needs-another"_code, key,
                  fmt::format("{} does not go with this kind of check", reader.full(key)),
                  fmt::format("{} belongs to {}", key, belongs_to));
  };
  std::vector<std::string_view> given;
  for (const auto& kind : kinds)
    if (reader.find(kind.key) != nullptr) given.push_back(kind.key);
  const bool of_events = !given.empty() && is_of_events(check);
  if (of_events && !reader.has("expect"))
    reader.missing("expect", "add expect: \"abs(length - 500) <= 0.2\" or the like");
  if (!of_events && !given.empty()) refuse_misplaced("expect", "each and all");
  if (given.size() > 1) {
    reader.refuse("scenario.does-not-go-together"_code, given[1],
                  fmt::format("{} is both {} and {}", reader.name(), given[0], given[1]),
                  "make two checks of it");
  }
  const bool eventually = check.kind == CheckRequest::Kind::eventually;
  if (!eventually) refuse_misplaced("within", "eventually");
  if (eventually) refuse_misplaced("until", "each, all, always and never");
  if (!is_of_events(check)) refuse_misplaced("at_least", "each and all");
  judge_period(reader, check);
  if (check.until && *check.until <= check.from && reader.has("from")) {
    reader.refuse("scenario.order"_code, "until", fmt::format("{} is not after from", reader.full("until")),
                  "let until be later than from");
  }
}

void visit_record(Archive& archive, RecordSection& record) {
  archive.value({"format", "csv: trace.csv, events.csv; hdf5: both in trace.h5"},
                choice_form({"csv", "hdf5"}, record.format));
  archive.value({"every", "a row of the trace"}, form(record.every, Sign::positive));
  archive.value({"channels", "columns: AxisX.posit, knife.angle, web.speed"}, form(record.channels));
  archive.judge([&record](MapReader& reader) {
    record.place = reader.place();
    std::unordered_set<std::string> known;
    for (const auto& channel : record.channels)
      if (!known.insert(channel.text).second)
        reader.findings().add("scenario.twice"_code, channel.place,
                              fmt::format("channel {} is recorded twice", channel.text), "keep one");
  });
}

void visit_panel(Archive& archive, PanelSection& panel) {
  archive.value({"push_buttons", "switches that are on while they are pressed: [acknowledge]"},
                form(panel.push_buttons));
}

void visit_drives(Archive& archive, DrivesSection& drives) {
  archive.value({"cycle", "of the machine, for the ratings of its drives; 0 = from cut to cut"},
                form(drives.cycle, Sign::not_negative));
  archive.value({"judge", "the check \"drive within its ratings\" is among the checks"}, form(drives.judge));
}

void visit_faults(Archive& archive, FaultsSection& faults) {
  archive.value({"told",
                 "an expression that becomes true when somebody is told of a fault; absent: an error of the "
                 "controller, or a drive that it switches off",
                 faults.told.has_value()},
                expression_form(faults.told));
  archive.value({"within", "so long after the fault"}, form(faults.within, Sign::positive));
  archive.value({"product", "checks that say what good product is; none: all that look at each cut",
                 !faults.product.empty()},
                form(faults.product));
}

/// Checks of which a moment says that they failed then.
void judge_product(MapReader& reader, const Scenario& scenario) {
  std::vector<std::string> known;
  for (const auto& check : scenario.checks)
    if (check.kind != CheckRequest::Kind::all && check.kind != CheckRequest::Kind::eventually)
      known.push_back(check.name.text);
  for (const auto& name : scenario.faults.product)
    if (std::ranges::find(known, name.text) == known.end())
      reader.findings().add("scenario.unknown-name"_code, name.place,
                            fmt::format("there is no check '{}' of each, always or never", name.text),
                            did_you_mean(name.text, known, "name one of checks"));
}

}  // namespace

void visit(Archive& archive, Wire& wire) {
  auto plug = form(wire.plug);
  plug.read = [read = plug.read](const YamlNode& node, const Form::Name& name, Findings& findings) {
    if (node.kind != YamlNode::Kind::null) return read(node, name, findings);
    findings.add("scenario.needs-another"_code, name.key, fmt::format("{} leads to nothing", name.full),
                 "write terminal: plant.plug, or terminal: panel.switch");
  };
  archive.alone(plug);
}

void visit(Archive& archive, InputFilter& filter) {
  archive.in_line();
  archive.value({"frequency", "counter: highest of one phase; counts beyond are lost", filter.frequency > 0},
                form(filter.frequency, "Hz", 1e-3, 1e9, "0.001 Hz to 1e9 Hz"));
  archive.value({"pulse", "interrupt line: shorter zero pulses are not seen", filter.pulse > 0},
                form(filter.pulse, Sign::positive));
  archive.value({"delay", "input: a level is taken when it has lasted so long", filter.delay > 0},
                form(filter.delay, Sign::positive));
  archive.require_one({"frequency", "pulse", "delay"}, "filters nothing",
                      "add frequency: 100 kHz, pulse: 20 us or delay: 3 ms");
}

void visit(Archive& archive, Stimulus& stimulus) {
  archive.in_line();
  archive.value({"at", "time from the start", !stimulus.when}, form(stimulus.at, Sign::not_negative));
  archive.value({"when", "an expression; the entry acts once, the first time it is true"},
                expression_form(stimulus.when));
  archive.value({"from", "`when` is not looked at before this time", stimulus.when.has_value()},
                form(stimulus.at, Sign::not_negative));
  archive.value({"after", "delay behind at or when", stimulus.after != 0},
                form(stimulus.after, Sign::not_negative));
  archive.value({"every", "acts again with this period"}, form(stimulus.every, Sign::positive));
  archive.value({"set", "panel switches, settings of plants and controller values", !stimulus.set.empty()},
                actions_form(stimulus.set));
  archive.value({"ramp", "the same, reached linearly over `over`", !stimulus.ramp.empty()},
                actions_form(stimulus.ramp));
  archive.value({"over", "duration of the ramp", !stimulus.ramp.empty()},
                form(stimulus.over, Sign::positive));
  archive.value(
      {"fault", "faults by component: {knife.encoder: {lose_counts: 200}}", !stimulus.faults.empty()},
      faults_form(stimulus.faults));
  archive.value({"power", "of the controller"}, form(stimulus.power));
  archive.require_one({"at", "when"}, "does not say when", "add at: 0.5 s, or when: \"...\"");
  archive.require_one({"set", "ramp", "fault", "power"}, "does nothing", "add set, ramp, fault or power");
  archive.judge([&stimulus](MapReader& reader) { judge_stimulus(reader, stimulus); });
}

void visit(Archive& archive, CheckRequest& check) {
  archive.in_line();
  archive.value({"name", "what reports call it, once a scenario"}, form(check.name));
  archive.require("name", "a check needs a name of its own");
  bool said = false;
  for (const auto& kind : kinds)
    archive.value({kind.key, kind.meaning, kind.kind == check.kind}, kind_form(check, kind, said));
  auto expect = expression_form(check.expression);
  if (archive.reads() && !(said && is_of_events(check))) expect.read = [](auto&&...) {};
  archive.value({"expect", "of each and all: over the event's values", is_of_events(check)}, expect);
  archive.value({"from", "what is earlier does not count"}, form(check.from, Sign::not_negative));
  archive.value({"until", "what is later does not count"}, form(check.until, Sign::positive));
  archive.value({"within", "of eventually: not later than so long after from"},
                form(check.within, Sign::positive));
  archive.value({"every", "of always and eventually: statistics look at periods of this length"},
                form(check.every, Sign::positive));
  archive.value({"at_least", "of each and all: fewer events than this fail the check", is_of_events(check)},
                form(check.at_least, 0, std::numeric_limits<int>::max()));
  archive.require_one({"each", "all", "always", "eventually", "never"}, "does not say what it checks",
                      "add one of each, all, always, eventually, never");
  archive.judge([&check](MapReader& reader) { judge_check(reader, check); });
}

void visit(Archive& archive, VariableEntry& variable) { archive.alone(form(variable.value)); }

void visit(Archive& archive, Scenario& scenario) {
  archive.value({"extends",
                 "another scenario that this one changes: maps are merged, `key: ~` leaves out, "
                 "lists are replaced, or changed by the names of their entries",
                 false},
                form(scenario.extends));
  archive.names({"variables",
                 "by names of your own; ${name} stands for its value anywhere below, and in cam "
                 "tables and registers, also in arithmetic: ${length} / 2 + 3 mm",
                 !scenario.variables.empty()},
                scenario.variables, &VariableEntry::name);
  archive.section({"scene", "title, time and chance"},
                  [&](Archive& inner) { visit_scene(inner, scenario.scene); });
  archive.plants({"plants", "the machine's parts, by names of your own; 'drycut plants' lists the types",
                  !scenario.plants.empty()},
                 scenario.plants);
  archive.names({"fitted", "values of plants that were learnt from recordings: 'drycut fit' writes it",
                 !scenario.fitted.empty()},
                scenario.fitted, &FittedEntry::path);
  archive.controller({"controller", "one of them", scenario.controller != nullptr}, scenario.controller);
  archive.names(
      {"wiring", "terminal of the controller: plant.plug, or panel.switch", !scenario.wiring.empty()},
      scenario.wiring, &Wire::terminal);
  archive.names(
      {"filters", "what the cards make of what comes to their terminals", !scenario.filters.empty()},
      scenario.filters, &InputFilter::terminal);
  archive.section({"panel", "how an operator works the switches of the panel: `drycut live`",
                   !scenario.panel.push_buttons.empty()},
                  [&](Archive& inner) { visit_panel(inner, scenario.panel); });
  archive.list(
      {"timeline", "what the operator and the line around do, and faults", !scenario.timeline.empty()},
      scenario.timeline);
  archive.list({"disturbances", "what is added to settings, live parameters and faults of plants",
                !scenario.disturbances.empty()},
               scenario.disturbances);
  archive.names({"inputs",
                 "what a recording of the real machine drives: what the timeline can set, or a plug without "
                 "a wire",
                 !scenario.inputs.empty()},
                scenario.inputs, &RecordedInput::name);
  archive.section({"record", "what trace.csv or trace.h5 holds"},
                  [&](Archive& inner) { visit_record(inner, scenario.record); });
  archive.section({"drives", "how the drives are judged by their ratings"},
                  [&](Archive& inner) { visit_drives(inner, scenario.drives); });
  archive.list({"checks", "what must hold for the run to pass", !scenario.checks.empty()}, scenario.checks);
  archive.section({"faults", "what `drycut faults` holds a fault to",
                   scenario.faults.told || !scenario.faults.product.empty() ||
                       scenario.faults.within != FaultsSection().within},
                  [&](Archive& inner) { visit_faults(inner, scenario.faults); });
  archive.section({"pictures", "frames, film and plots of the run"},
                  [&](Archive& inner) { visit(inner, scenario.pictures); });
  archive.section({"opcua", "what OPC UA clients of the live line are told of the machine as a whole",
                   scenario.opcua.given()},
                  [&](Archive& inner) { visit(inner, scenario.opcua); });
  archive.judge([&scenario](MapReader& reader) {
    if (!scenario.filters.empty() && !reader.has("controller"))
      reader.refuse("scenario.needs-another"_code, "filters",
                    "filters are of a controller's cards, and there is no controller",
                    "add one, or leave the filters out");
    judge_product(reader, scenario);
    take_fitted(scenario, reader.is_sound(), reader.findings());
    refuse_same_name(scenario.checks, "checks", "rename one; the first is at line {}", reader.findings());
    for (const auto& check : scenario.checks)
      if (check.every && *check.every < scenario.record.every)
        reader.findings().add(
            "scenario.order"_code, check.expression.place,
            fmt::format("the period of the check '{}' is shorter than record.every", check.name.text),
            fmt::format("every: {} at least", format_time(scenario.record.every)));
  });
}

const std::vector<std::string>& section_names() {
  static const std::vector<std::string> names = {
      "extends",  "variables",    "scene",  "plants", "fitted", "controller", "wiring", "filters",  "panel",
      "timeline", "disturbances", "inputs", "record", "drives", "checks",     "faults", "pictures", "opcua"};
  return names;
}

}  // namespace drycut::sim::scenario
