// controller: plcopen: program, axes with their parameters, cam tables.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/text.hpp"

#include "sim/scenario/axis_units.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/sections.hpp"
#include "sim/scenario/units.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

namespace plcopen = devices::plcopen;
using plcopen::AxisParameter;
using plcopen::AxisParameters;
using plcopen::Measure;

const std::string axes_name = "controller.plcopen.axes";

// Reads the parameters of one axis.
class AxisReader {
 public:
  AxisReader(PlcopenSection::Axis& axis, Findings& findings)
      : axis_(axis), full_(axes_name + "." + axis.name.text), findings_(findings) {}

  void read(const YamlNode& node) {
    const auto before = findings_.count();
    read_level(node, "");
    if (findings_.count() == before) check_software_limits();
    AxisParameters& parameters = axis_.configuration.parameters;
    // A virtual axis has no zero to look for, unless the scenario wants it to be homed by the program.
    const bool given = std::any_of(axis_.places.begin(), axis_.places.end(),
                                   [](const auto& place) { return place.first == "homed_at_start"; });
    if (!given && parameters.kind == static_cast<double>(plcopen::AxisKind::virtual_axis))
      parameters.homed_at_start = 1;
    if (measured_by_)
      axis_.configuration.measure = measure_;
    else if (parameters.modulo == 0)
      axis_.configuration.measure = Measure::length;  // no unit says it: a linear axis
  }

 private:
  // A key is a parameter, or the first part of some: then its value is a map of the rest.
  void read_level(const YamlNode& node, const std::string& prefix) {
    const auto where = prefix.empty() ? full_ : full_ + "." + prefix;
    refuse_duplicates(node, where, findings_);
    for (const auto& entry : node.entries) {
      if (entry.is_repeated()) continue;
      const auto name = prefix.empty() ? entry.key.text : prefix + "." + entry.key.text;
      if (name == "path") {
        read_path(entry);
      } else if (const auto* parameter = plcopen::find_axis_parameter(name)) {
        if (remember(std::string(parameter->name), entry.key)) read_value(*parameter, entry);
      } else if (!is_group(name)) {
        findings_.add(entry.key.place, fmt::format("unknown key '{}' in {}", entry.key.text, where),
                      suggestion(name));
      } else if (entry.value.kind != YamlNode::Kind::map) {
        refuse_kind(entry.value, full_ + "." + name, YamlNode::Kind::map, findings_);
      } else {
        read_level(entry.value, name);
      }
    }
  }

  static bool is_group(const std::string& name) {
    const auto table = plcopen::axis_parameter_table();
    return std::any_of(table.begin(), table.end(), [&](const AxisParameter& parameter) {
      return parameter.name.starts_with(name + ".");
    });
  }

  static std::string suggestion(const std::string& name) {
    std::vector<std::string> names = {"path"};
    for (const auto& parameter : plcopen::axis_parameter_table()) {
      names.emplace_back(parameter.name);
      const auto dot = parameter.name.rfind('.');
      // People write v_phasing for cam_gear.v_phasing.
      if (dot != std::string_view::npos && parameter.name.substr(dot + 1) == name)
        return fmt::format("did you mean {}?", parameter.name);
    }
    const auto near = nearest(name, names);
    return near.empty() ? "'drycut devices AXIS' lists the parameters"
                        : fmt::format("did you mean {}?", near);
  }

  // Equal limits are none.
  void check_software_limits() {
    const auto& [name, parameters, measure] = axis_.configuration;
    if (parameters.swe_neg <= parameters.swe_pos) return;
    const auto& low = *plcopen::find_axis_parameter("kenngr.swe_neg");
    const auto& high = *plcopen::find_axis_parameter("kenngr.swe_pos");
    // One of them has been given: the defaults are equal.
    const auto place = std::find_if(axis_.places.begin(), axis_.places.end(), [&](const auto& given) {
      return given.first == low.name || given.first == high.name;
    });
    findings_.add(place->second,
                  fmt::format("{}: {} {} is above {} {}", full_, low.name,
                              axis_value_text(low, parameters.swe_neg, Measure::length), high.name,
                              axis_value_text(high, parameters.swe_pos, Measure::length)),
                  "give the lower limit as kenngr.swe_neg; equal limits are none");
  }

  // False if the parameter was given before: nested in one place and dotted in another.
  bool remember(const std::string& name, const Text& key) {
    for (const auto& [known, place] : axis_.places) {
      if (known != name) continue;
      findings_.add(key.place, fmt::format("{}.{} is given twice", full_, name),
                    fmt::format("keep one; the first is at line {}", place.line));
      return false;
    }
    axis_.places.emplace_back(name, key.place);
    return true;
  }

  void read_value(const AxisParameter& parameter, const YamlNode::Entry& entry) {
    const auto full = fmt::format("{}.{}", full_, parameter.name);
    if (entry.value.kind == YamlNode::Kind::null) {
      findings_.add(entry.key.place, fmt::format("{} has no value", full),
                    "give it one, or leave the key out");
    } else if (entry.value.kind != YamlNode::Kind::scalar) {
      refuse_kind(entry.value, full, YamlNode::Kind::scalar, findings_);
    } else if (parameter.member == &AxisParameters::kind) {
      read_kind(entry.value.text, full);
    } else {
      assign(parameter, entry.value.text, full);
    }
  }

  void read_kind(const Text& text, const std::string& full) {
    std::vector<std::string> kinds;
    for (int kind = 0; kind <= static_cast<int>(plcopen::AxisKind::encoder); ++kind)
      kinds.emplace_back(axis_kind_text(kind));
    if (!read_choice(text, full, kinds, findings_)) return;
    axis_.configuration.parameters.kind =
        static_cast<double>(std::find(kinds.begin(), kinds.end(), text.text) - kinds.begin());
  }

  // path: [500 mm, 10000], the way of so many counts.
  void read_path(const YamlNode::Entry& entry) {
    const auto full = full_ + ".path";
    const auto& items = entry.value.items;
    const bool pair = entry.value.kind == YamlNode::Kind::sequence && items.size() == 2 &&
                      items[0].kind == YamlNode::Kind::scalar && items[1].kind == YamlNode::Kind::scalar;
    if (!pair) {
      findings_.add(entry.value.kind == YamlNode::Kind::null ? entry.key.place : entry.value.text.place,
                    fmt::format("{} is not a way and its counts", full),
                    "write [500 mm, 10000]: the way of so many counts (x4) of the encoder");
      return;
    }
    const auto& way = *plcopen::find_axis_parameter("path_increments");
    const auto& counts = *plcopen::find_axis_parameter("path_counts");
    if (remember(std::string(way.name), entry.key)) assign(way, items[0].text, full);
    if (remember(std::string(counts.name), entry.key)) assign(counts, items[1].text, full);
  }

  // A bare number is in the kernel's own unit.
  void assign(const AxisParameter& parameter, const Text& text, const std::string& full) {
    if (parameter.whole && parameter.max == 1 && !parse_quantity(text.text)) {
      if (const auto on = read_switch(text, full, findings_))
        axis_.configuration.parameters.*parameter.member = *on ? 1 : 0;
      return;
    }
    const auto quantity = read_quantity(text, full, findings_);
    if (!quantity) return;
    AxisUnit people;
    double value = quantity->number;
    if (!quantity->unit.empty()) {
      const auto unit = unit_for(parameter, *quantity, text, full);
      if (!unit) return;
      people = *unit;
      value = to_kernel(quantity->number, quantity->unit, people);
    }
    if (plcopen::set_parameter(axis_.configuration.parameters, parameter, value)) return;
    const bool in_range = value >= parameter.min && value <= parameter.max;
    const auto limit = [&](double number) {
      return fmt::format("{:.12g}{}{}", number / people.factor, people.unit.empty() ? "" : " ", people.unit);
    };
    findings_.add(text.place,
                  in_range ? fmt::format("{} is {}, not a whole number of {}", full, text.text,
                                         parameter.unit.empty() ? "ones" : parameter.unit)
                           : fmt::format("{} is {}, out of range", full, text.text),
                  fmt::format("{} to {}", limit(parameter.min), limit(parameter.max)));
  }

  // The unit in which people give the parameter; nullopt if `quantity` is of another dimension. An axis
  // measures lengths or angles, not both.
  std::optional<AxisUnit> unit_for(const AxisParameter& parameter, const Quantity& quantity, const Text& text,
                                   const std::string& full) {
    const AxisUnit length = axis_unit(parameter, Measure::length);
    const AxisUnit angle = axis_unit(parameter, Measure::angle);
    const auto place = text.at(parse_quantity(text.text)->unit_offset);
    const bool is_length = !length.unit.empty() && same_dimension(quantity.unit, length.unit);
    const bool is_angle = !angle.unit.empty() && same_dimension(quantity.unit, angle.unit);
    if (!is_length && !is_angle) {
      const auto wanted = length.unit.empty()         ? std::string("a pure number")
                          : length.unit == angle.unit ? dimension_name(length.unit)
                                                      : fmt::format("{} or {}", dimension_name(length.unit),
                                                                    dimension_name(angle.unit));
      findings_.add(
          place,
          fmt::format("{} is {}, not {} ({})", full, wanted, dimension_name(quantity.unit), quantity.unit),
          length.unit.empty()         ? std::string("write a number without unit")
          : length.unit == angle.unit ? fmt::format("for example 1 {}", length.unit)
                                      : fmt::format("for example 1 {} or 1 {}", length.unit, angle.unit));
      return {};
    }
    if (length.unit == angle.unit) return length;
    const Measure measure = is_length ? Measure::length : Measure::angle;
    if (measured_by_ && measure != measure_) {
      findings_.add(place,
                    fmt::format("{} is {}, but {} is {}", full, dimension_name(quantity.unit), *measured_by_,
                                measured_unit_),
                    "an axis measures lengths or angles: give all its quantities in one of them");
      return {};
    }
    if (!measured_by_) {
      measured_by_ = parameter.name;
      measured_unit_ = dimension_name(quantity.unit);
    }
    measure_ = measure;
    return is_length ? length : angle;
  }

  PlcopenSection::Axis& axis_;
  std::string full_;
  Findings& findings_;
  Measure measure_ = Measure::angle;
  std::optional<std::string> measured_by_;  ///< the parameter whose unit tells it
  std::string measured_unit_;
};

void read_axes(const YamlNode& node, std::vector<PlcopenSection::Axis>& axes, Findings& findings) {
  refuse_duplicates(node, axes_name, findings);
  for (const auto& entry : node.entries) {
    if (entry.is_repeated()) continue;
    const auto& name = entry.key;
    if (!is_identifier(name.text) || name.text == "panel") {
      findings.add(name.place, fmt::format("'{}' is no name of an axis", name.text),
                   "letters, digits and underscores, as the program's VAR_EXTERNAL spells it");
      continue;
    }
    const auto same = std::find_if(axes.begin(), axes.end(), [&](const PlcopenSection::Axis& other) {
      return same_word(other.name.text, name.text);
    });
    if (same != axes.end()) {
      findings.add(
          name.place,
          fmt::format("axis {} is {} already: names are the same in any case", name.text, same->name.text),
          "keep one");
      continue;
    }
    axes.push_back({name, {}, {}});
    axes.back().configuration.name = name.text;
    if (entry.value.kind == YamlNode::Kind::map)
      AxisReader(axes.back(), findings).read(entry.value);
    else if (entry.value.kind != YamlNode::Kind::null)
      refuse_kind(entry.value, axes_name + "." + name.text, YamlNode::Kind::map, findings);
  }
}

// tables: [cams/knife.tab, {file: cams/eject.csv, id: 2}]
void read_tables(const YamlNode& node, std::vector<PlcopenSection::Table>& tables, Findings& findings) {
  constexpr int last_id = 65535;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const auto& item = node.items[i];
    const auto name = fmt::format("controller.plcopen.tables.{}", i);
    PlcopenSection::Table table;
    if (item.kind == YamlNode::Kind::scalar) {
      table.file = item.text;
    } else {
      MapReader reader(item, name, findings);
      if (item.kind != YamlNode::Kind::map) continue;
      reader.text("file", table.file);
      reader.integer("id", table.id, 1, last_id);
      reader.finish();
      if (!reader.has("file")) reader.missing("file", "add file: cams/knife.tab");
    }
    if (!table.file.text.empty()) tables.push_back(std::move(table));
  }
}

const std::string tasks_name = "controller.plcopen.tasks";

void check_multiple(Time time, Time cycle, const std::string& name, Place place, Findings& findings) {
  if (time % cycle == 0) return;
  findings.add(place,
               fmt::format("{} {} is not a whole multiple of the cycle {}", name, format_time(time),
                           format_time(cycle)),
               fmt::format("for example {}", format_time(std::max<Time>(1, time / cycle) * cycle)));
}

// tasks: {fast: {cycle: 2 ms, priority: 1, programs: [Main]}}
void read_tasks(const YamlNode& node, PlcopenSection& plcopen, Findings& findings) {
  constexpr int last_priority = 65535;
  refuse_duplicates(node, tasks_name, findings);
  for (const auto& entry : node.entries) {
    if (entry.is_repeated()) continue;
    const auto name = fmt::format("{}.{}", tasks_name, entry.key.text);
    if (entry.value.kind != YamlNode::Kind::map) {
      refuse_kind(entry.value, name, YamlNode::Kind::map, findings);
      continue;
    }
    PlcopenSection::Task task;
    task.name = entry.key;
    task.cycle = plcopen.task_cycle;
    MapReader reader(entry.value, name, findings);
    reader.time("cycle", task.cycle, Sign::positive);
    reader.integer("priority", task.priority, 0, last_priority);
    reader.texts("programs", task.programs);
    reader.finish();
    if (task.programs.empty()) reader.missing("programs", "name its PROGRAMs: programs: [Main]");
    check_multiple(task.cycle, plcopen.cycle, name + ".cycle", reader.place("cycle"), findings);
    for (const auto& other : plcopen.tasks)
      for (const auto& program : other.programs)
        for (const auto& again : task.programs)
          if (same_word(program.text, again.text))
            findings.add(again.place, fmt::format("{} runs in {} already", again.text, other.name.text),
                         "a program has one task");
    plcopen.tasks.push_back(std::move(task));
  }
}

}  // namespace

PlcopenSection read_plcopen(const YamlNode& node, const Place& place, Findings& findings) {
  PlcopenSection plcopen;
  plcopen.place = place;
  MapReader reader(node, "controller.plcopen", findings);
  reader.text("program", plcopen.program);
  reader.time("cycle", plcopen.cycle, Sign::positive);
  plcopen.task_cycle = plcopen.cycle;
  reader.time("task_cycle", plcopen.task_cycle, Sign::positive);
  if (const auto* axes = reader.map("axes")) read_axes(*axes, plcopen.axes, findings);
  if (const auto* tables = reader.list("tables")) read_tables(*tables, plcopen.tables, findings);
  if (const auto* tasks = reader.map("tasks")) read_tasks(*tasks, plcopen, findings);
  reader.text("retentive", plcopen.retentive);
  read_preset(reader, "controller.plcopen", plcopen.set, findings);
  reader.finish();
  if (!reader.has("program")) reader.missing("program", "add program: programs/knife.st");
  check_multiple(plcopen.task_cycle, plcopen.cycle, "controller.plcopen.task_cycle",
                 reader.place("task_cycle"), findings);
  return plcopen;
}

}  // namespace drycut::sim
