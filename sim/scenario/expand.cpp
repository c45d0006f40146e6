// The scenario written back, every default in force.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

#include "sim/scenario/axis_units.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim {

namespace {

std::string texts(const std::vector<Text>& list) {
  std::vector<std::string> items;
  for (const auto& item : list) items.push_back(yaml_text(item.text));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string map(const std::vector<std::string>& items) {
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}

std::string number(double value) { return fmt::format("{}", value); }

std::string quantity(const Quantity& value) {
  return value.unit.empty() ? number(value.number)
                            : yaml_text(fmt::format("{} {}", value.number, value.unit));
}

class Writer {
 public:
  std::string write(const Scenario& scenario) {
    scene(scenario.scene);
    if (!scenario.plants.empty()) line(0, "plants:");
    for (const auto& entry : scenario.plants) plant(entry);
    if (const auto* section = std::get_if<QmoveSection>(&scenario.controller)) qmove(*section);
    if (const auto* section = std::get_if<Lx3vpSection>(&scenario.controller)) lx3vp(*section);
    if (const auto* section = std::get_if<PlcopenSection>(&scenario.controller)) plcopen(*section);
    wiring(scenario.wiring);
    if (!scenario.timeline.empty()) line(0, "timeline:");
    for (const auto& stimulus : scenario.timeline) timeline(stimulus);
    line(0, "record:");
    line(1, fmt::format("every: {}", format_time(scenario.record.every)));
    line(1, fmt::format("channels: {}", texts(scenario.record.channels)));
    if (!scenario.checks.empty()) line(0, "checks:");
    for (const auto& one : scenario.checks) check(one);
    pictures(scenario.pictures);
    return std::move(out_);
  }

 private:
  void line(int level, std::string_view text) {
    fmt::format_to(std::back_inserter(out_), "{:{}}{}\n", "", 2 * level, text);
  }

  void scene(const SceneSection& section) {
    line(0, "scene:");
    line(1, fmt::format("title: {}", yaml_text(section.title)));
    line(1, fmt::format("step: {}", format_time(section.step)));
    line(1, fmt::format("duration: {}", format_time(section.duration)));
    line(1, fmt::format("seed: {}", section.seed));
  }

  static std::string value(const plants::Parameter& parameter, double& bound) {
    return yaml_text(format_quantity(bound, parameter.unit));
  }
  static std::string value(const plants::Parameter& parameter, int& bound) {
    return parameter.unit.empty() ? fmt::format("{}", bound)
                                  : yaml_text(fmt::format("{} {}", bound, parameter.unit));
  }
  static std::string value(const plants::Parameter&, bool& bound) { return bound ? "true" : "false"; }
  static std::string value(const plants::Parameter&, std::string& bound) { return yaml_text(bound); }

  // Dotted names become nested maps again; parameters of a group stand together in the table, and a group
  // that is taken up again later is written with its full name.
  void plant(const PlantEntry& entry) {
    line(1, fmt::format("{}:", yaml_text(entry.name.text)));
    line(2, fmt::format("type: {}", yaml_text(entry.type.text)));
    std::string group;
    std::vector<std::string> seen;
    for (const auto& parameter : entry.definition->parameters()) {
      const auto text = std::visit([&](auto* bound) { return value(parameter, *bound); }, parameter.value);
      const auto dot = parameter.name.find('.');
      const auto first = dot == std::string::npos ? std::string() : parameter.name.substr(0, dot);
      if (!first.empty() && first != group && std::find(seen.begin(), seen.end(), first) == seen.end()) {
        line(2, fmt::format("{}:", first));
        seen.push_back(first);
        group = first;
      }
      if (first.empty() || first != group) {
        group.clear();
        line(2, fmt::format("{}: {}", parameter.name, text));
      } else {
        line(3, fmt::format("{}: {}", parameter.name.substr(dot + 1), text));
      }
    }
  }

  void qmove(const QmoveSection& section) {
    line(0, "controller:");
    line(1, "qmove:");
    line(2, fmt::format("configuration: {}", yaml_text(section.configuration.text)));
    line(2, fmt::format("tasks: {}", texts(section.tasks)));
    line(2, fmt::format("cycle: {}", format_time(section.cycle)));
    line(2, fmt::format("retentive: {}", yaml_text(section.retentive.text)));
    preset(section.set);
  }

  void lx3vp(const Lx3vpSection& section) {
    line(0, "controller:");
    line(1, "lx3vp:");
    line(2, fmt::format("program: {}", yaml_text(section.program.text)));
    line(2, fmt::format("registers: {}", yaml_text(section.registers.text)));
    line(2, fmt::format("scan: {}", format_time(section.scan)));
    line(2, fmt::format("retentive: {}", yaml_text(section.retentive.text)));
    preset(section.set);
  }

  void plcopen(const PlcopenSection& section) {
    line(0, "controller:");
    line(1, "plcopen:");
    line(2, fmt::format("program: {}", yaml_text(section.program.text)));
    line(2, fmt::format("cycle: {}", format_time(section.cycle)));
    line(2, fmt::format("task_cycle: {}", format_time(section.task_cycle)));
    line(2, section.tasks.empty() ? "tasks: {}" : "tasks:");
    for (const auto& task : section.tasks) {
      std::vector<std::string> programs;
      for (const auto& program : task.programs) programs.push_back(yaml_text(program.text));
      line(3, fmt::format("{}: {{cycle: {}, priority: {}, programs: [{}]}}", yaml_text(task.name.text),
                          format_time(task.cycle), task.priority, fmt::join(programs, ", ")));
    }
    line(2, section.axes.empty() ? "axes: {}" : "axes:");
    for (const auto& axis : section.axes) {
      line(3, fmt::format("{}:", axis.name.text));
      const auto& [name, parameters, measure] = axis.configuration;
      for (const auto& row : devices::plcopen::axis_parameter_table())
        line(4, fmt::format("{}: {}", yaml_text(row.name),
                            axis_value_text(row, parameters.*row.member, measure)));
    }
    std::vector<std::string> tables;
    for (const auto& table : section.tables)
      tables.push_back(table.id == 0
                           ? yaml_text(table.file.text)
                           : fmt::format("{{file: {}, id: {}}}", yaml_text(table.file.text), table.id));
    line(2, fmt::format("tables: [{}]", fmt::join(tables, ", ")));
    line(2, fmt::format("retentive: {}", yaml_text(section.retentive.text)));
    preset(section.set);
  }

  void preset(const std::vector<std::pair<Text, double>>& values) {
    std::vector<std::string> items;
    for (const auto& [name, value] : values) {
      items.push_back(fmt::format("{}: {}", yaml_text(name.text), number(value)));
    }
    line(2, fmt::format("set: {}", map(items)));
  }

  void wiring(const std::vector<Wire>& wires) {
    if (!wires.empty()) line(0, "wiring:");
    for (const auto& wire : wires) {
      line(1, fmt::format("{}: {}", yaml_text(wire.terminal.text), yaml_text(wire.plug.text)));
    }
  }

  static std::string actions(const std::vector<std::pair<Text, Quantity>>& list) {
    std::vector<std::string> items;
    for (const auto& [target, value] : list) {
      items.push_back(fmt::format("{}: {}", yaml_text(target.text), quantity(value)));
    }
    return map(items);
  }

  static std::string faults(const std::vector<Stimulus::FaultAction>& list) {
    std::vector<std::string> components;
    for (const auto& fault : list) {
      if (std::find(components.begin(), components.end(), fault.component.text) == components.end()) {
        components.push_back(fault.component.text);
      }
    }
    std::vector<std::string> items;
    for (const auto& component : components) {
      std::vector<std::string> own;
      for (const auto& fault : list) {
        if (fault.component.text != component) continue;
        own.push_back(fmt::format("{}: {}", yaml_text(fault.fault.text), quantity(fault.value)));
      }
      items.push_back(fmt::format("{}: {}", yaml_text(component), map(own)));
    }
    return map(items);
  }

  void timeline(const Stimulus& stimulus) {
    std::vector<std::string> items;
    if (stimulus.at) items.push_back(fmt::format("at: {}", format_time(*stimulus.at)));
    if (stimulus.when) items.push_back(fmt::format("when: {}", yaml_quoted(stimulus.when->text)));
    if (stimulus.after != 0) items.push_back(fmt::format("after: {}", format_time(stimulus.after)));
    if (stimulus.every) items.push_back(fmt::format("every: {}", format_time(*stimulus.every)));
    if (!stimulus.set.empty()) items.push_back("set: " + actions(stimulus.set));
    if (!stimulus.ramp.empty()) {
      items.push_back("ramp: " + actions(stimulus.ramp));
      items.push_back(fmt::format("over: {}", format_time(stimulus.over)));
    }
    if (!stimulus.faults.empty()) items.push_back("fault: " + faults(stimulus.faults));
    if (stimulus.power) items.push_back(fmt::format("power: {}", *stimulus.power ? "on" : "off"));
    line(1, "- " + map(items));
  }

  void check(const Check& one) {
    static constexpr std::array<std::string_view, 5> kinds = {"each", "all", "always", "eventually", "never"};
    const bool of_events = one.kind == Check::Kind::each || one.kind == Check::Kind::all;
    std::vector<std::string> items = {"name: " + yaml_text(one.name.text)};
    const auto kind = kinds.at(static_cast<std::size_t>(one.kind));
    items.push_back(
        fmt::format("{}: {}", kind,
                    one.event.text.empty() ? yaml_quoted(one.expression.text) : yaml_text(one.event.text)));
    if (of_events) items.push_back("expect: " + yaml_quoted(one.expression.text));
    items.push_back("from: " + format_time(one.from));
    if (one.until) items.push_back("until: " + format_time(*one.until));
    if (one.within) items.push_back("within: " + format_time(*one.within));
    if (of_events) items.push_back(fmt::format("at_least: {}", one.at_least));
    line(1, "- " + map(items));
  }

  void pictures(const PicturesSection& section) {
    line(0, "pictures:");
    if (section.frames) {
      line(1, "frames:");
      line(2, fmt::format("every: {}", format_time(section.every)));
      frame_window(section);
      line(2, fmt::format("slow: {}", section.slow));
      camera(section);
      line(2, fmt::format("size: {}x{}", section.width, section.height));
      line(1, fmt::format("video: {}", section.video ? "on" : "off"));
    }
    line(1, fmt::format("caption: {}", texts(section.caption)));
    if (section.frames) overlays(section);
    if (!section.meshes.empty()) line(1, "meshes:");
    for (const auto& one : section.meshes) mesh(one);
    if (section.plots.empty()) line(1, "plots: []");
    if (!section.plots.empty()) line(1, "plots:");
    for (const auto& one : section.plots) plot(one);
  }

  static std::string triple(const std::array<double, 3>& values, std::string_view unit) {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + yaml_text(format_quantity(value, unit));
    return "[" + text + "]";
  }

  void camera(const PicturesSection& section) {
    if (const auto& own = section.own_camera) {
      line(2, "camera:");
      line(3, "eye: " + triple(own->eye, "m"));
      line(3, "target: " + triple(own->target, "m"));
      line(3, "field_of_view: " + yaml_text(format_quantity(own->field_of_view, "deg")));
    } else {
      line(2, fmt::format("camera: {}", section.camera));
    }
    if (!section.follow.text.empty()) line(2, "follow: " + yaml_text(section.follow.text));
  }

  void overlays(const PicturesSection& section) {
    std::vector<std::string> names;
    if (section.overlays.trail) names.emplace_back("trail");
    if (section.overlays.lengths) names.emplace_back("lengths");
    if (section.overlays.forces) names.emplace_back("forces");
    line(1, fmt::format("lamps: {}", texts(section.lamps)));
    line(1, fmt::format("overlays: [{}]", fmt::join(names, ", ")));
    line(1, fmt::format("live: {}", texts(section.live)));
  }

  void mesh(const PicturesSection::MeshRequest& one) {
    line(2, fmt::format("{}:", yaml_text(one.part.text)));
    line(3, "file: " + yaml_text(one.file.text));
    line(3, fmt::format("scale: {}", one.scale));
    line(3, "at: " + triple(one.at, "mm"));
    line(3, "rotate: " + triple(one.rotate, "deg"));
  }

  void frame_window(const PicturesSection& section) {
    if (section.around) {
      const auto& around = *section.around;
      line(2, "around: " + yaml_quoted(fmt::format("{}[{}]", around.event.text, around.number)));
      line(2, fmt::format("before: {}", format_time(around.before)));
      line(2, fmt::format("after: {}", format_time(around.after)));
      return;
    }
    line(2, fmt::format("from: {}", format_time(section.from)));
    if (section.until) line(2, fmt::format("until: {}", format_time(*section.until)));
  }

  static std::string panel(const PlotRequest::Panel& one) {
    std::vector<std::string> items = {"title: " + yaml_text(one.title)};
    if (one.is_path()) {
      items.push_back("x: " + yaml_text(one.x.text));
      items.push_back("y: " + yaml_text(one.y.text));
      if (!one.split.text.empty()) items.push_back("split: " + yaml_text(one.split.text));
      if (!one.labels.empty()) items.push_back("labels: " + texts(one.labels));
      std::vector<std::string> points;
      for (const auto& p : one.points)
        points.push_back(fmt::format("{}: [{}, {}]", yaml_text(p.label.text), p.x, p.y));
      if (!points.empty()) items.push_back("points: " + map(points));
    } else if (!one.motor.text.empty()) {
      items.push_back("motor: " + yaml_text(one.motor.text));
    } else if (!one.lanes.empty()) {
      items.push_back("lanes: " + texts(one.lanes));
    } else if (one.event.text.empty()) {
      items.push_back("channels: " + texts(one.channels));
    } else {
      items.push_back("event: " + yaml_text(one.event.text));
      items.push_back("values: " + texts(one.values));
    }
    if (one.histogram) items.push_back("histogram: on");
    if (one.limits) items.push_back(fmt::format("limits: [{}, {}]", one.limits->first, one.limits->second));
    return map(items);
  }

  void plot(const PlotRequest& one) {
    line(2, fmt::format("- name: {}", yaml_text(one.name.text)));
    line(3, fmt::format("title: {}", yaml_text(one.title)));
    line(3, fmt::format("from: {}", format_time(one.from)));
    if (one.until) line(3, fmt::format("until: {}", format_time(*one.until)));
    line(3, fmt::format("against: {}", one.against_number ? "number" : "time"));
    if (one.marks) line(3, "marks: " + texts(*one.marks));
    line(3, one.panels.empty() ? "panels: []" : "panels:");
    for (const auto& request : one.panels) {
      line(4, "- " + panel(request));
    }
  }

  std::string out_;
};

}  // namespace

std::string expand(const Scenario& scenario) { return Writer().write(scenario); }

std::string format_time(Time time) {
  // The largest unit in which three decimals hold it.
  struct Unit {
    Time size;
    std::string_view name;
  };
  static constexpr std::array<Unit, 4> units = {
      {{second, "s"}, {millisecond, "ms"}, {microsecond, "us"}, {1, "ns"}}};
  for (const auto& unit : units) {
    const bool fits = unit.size == 1 || (time >= unit.size && time % (unit.size / 1000) == 0);
    if (time != 0 && !fits) continue;
    auto text = fmt::format("{}", time / unit.size);
    if (const Time rest = time % unit.size; rest != 0) {
      text += fmt::format(".{:03}", rest / (unit.size / 1000));
      text.resize(text.find_last_not_of('0') + 1);
    }
    return fmt::format("{} {}", text, unit.name);
  }
  return "";
}

std::string yaml_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\r':
        out += "\\r";
        break;
      default:
        out += c;
    }
  }
  return out + "\"";
}

std::string yaml_text(std::string_view text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view(" _./-+^%").find(c) != std::string_view::npos;
  };
  const bool null_word = text == "null" || text == "Null" || text == "NULL";
  const bool bare = !text.empty() && !null_word && text.front() != ' ' && text.back() != ' ' &&
                    text.find("  ") == std::string_view::npos &&
                    std::string_view("-.%").find(text.front()) == std::string_view::npos &&
                    std::all_of(text.begin(), text.end(), plain);
  const bool negative_number = text.size() > 1 && text.front() == '-' &&
                               std::isdigit(static_cast<unsigned char>(text[1])) != 0 &&
                               std::all_of(text.begin(), text.end(), plain) && text.back() != ' ';
  return bare || negative_number ? std::string(text) : yaml_quoted(text);
}

}  // namespace drycut::sim
