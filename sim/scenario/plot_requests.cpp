// pictures.plots: panels of channels, lanes, events, a path, a motor.
#include <fmt/format.h>

#include <algorithm>

#include "sim/scenario/sections.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

// limits: [499.8, 500.2], in the unit of the curves
void read_limits(const YamlNode& list, const std::string& name, PlotRequest::Panel& panel,
                 Findings& findings) {
  const auto texts = read_texts(list, name, findings);
  std::vector<double> numbers;
  for (const auto& text : texts) {
    if (const auto number = read_si(text, name, "", findings)) numbers.push_back(*number);
  }
  if (numbers.size() != list.items.size()) return;
  if (numbers.size() != 2 || numbers[0] > numbers[1]) {
    findings.add(list.text.place, fmt::format("{} must be a lower and an upper limit", name),
                 "for example [499.8, 500.2]");
    return;
  }
  panel.limits = {numbers[0], numbers[1]};
}

// points: {A: [0, 0], B: [15, -33]}
void read_points(const YamlNode& map, const std::string& name, PlotRequest::Panel& panel,
                 Findings& findings) {
  refuse_duplicates(map, name, findings);
  for (const auto& [key, value, first_line] : map.entries) {
    if (first_line > 0) continue;
    const auto full = name + "." + key.text;
    std::vector<double> numbers;
    if (value.kind == YamlNode::Kind::sequence) {
      for (const auto& text : read_texts(value, full, findings)) {
        if (const auto number = read_si(text, full, "", findings)) numbers.push_back(*number);
      }
      if (numbers.size() != value.items.size()) continue;
    }
    if (numbers.size() != 2) {
      findings.add(key.place, fmt::format("{} must be a place in the plane", full), "for example [15, -33]");
      continue;
    }
    panel.points.push_back({key, numbers[0], numbers[1]});
  }
}

void check_path(MapReader& reader, const std::string& name, const PlotRequest::Panel& panel,
                Findings& findings) {
  if (reader.has("x") != reader.has("y")) {
    findings.add(reader.place(reader.has("x") ? "x" : "y"), fmt::format("{}: x and y go together", name),
                 "write x: AxisX.posit, y: AxisY.posit");
  }
  for (const auto* key : {"channels", "lanes", "motor", "event", "values", "limits", "histogram"}) {
    if (!reader.has(key)) continue;
    findings.add(reader.place(key), fmt::format("{} has both a path and {}", name, key),
                 "make two plots of it");
  }
  if (!panel.labels.empty() && panel.split.text.empty()) {
    findings.add(reader.place("labels"), fmt::format("{}: labels are for the parts of a split path", name),
                 "add split: with the channel that numbers them, or leave labels out");
  }
}

/// A panel of lanes, or of a motor, shows nothing else.
void check_alone(MapReader& reader, const std::string& name, std::string_view what, Findings& findings) {
  for (const auto* key : {"lanes", "motor", "channels", "event", "values", "limits", "histogram"}) {
    if (key == what || !reader.has(key)) continue;
    findings.add(reader.place(key), fmt::format("{} has both {} and {}", name, what, key),
                 "make two panels of it");
  }
}

void check_histogram(MapReader& reader, const std::string& name, const PlotRequest::Panel& panel,
                     Findings& findings) {
  if (!panel.histogram) return;
  if (!reader.has("event") || panel.values.size() != 1) {
    findings.add(reader.place("histogram"), fmt::format("{}: a histogram shows one value of an event", name),
                 "write event: cut, values: [length]");
  }
}

PlotRequest::Panel read_panel(const YamlNode& node, const std::string& name, Findings& findings) {
  PlotRequest::Panel panel;
  MapReader reader(node, name, findings);
  reader.text("title", panel.title);
  reader.texts("channels", panel.channels);
  reader.texts("lanes", panel.lanes);
  reader.text("event", panel.event);
  reader.texts("values", panel.values);
  if (const auto* limits = reader.list("limits")) read_limits(*limits, name + ".limits", panel, findings);
  if (const auto* on = reader.scalar("histogram"))
    panel.histogram = read_switch(*on, name + ".histogram", findings).value_or(false);
  reader.text("motor", panel.motor);
  reader.text("x", panel.x);
  reader.text("y", panel.y);
  reader.text("split", panel.split);
  reader.texts("labels", panel.labels);
  if (const auto* points = reader.map("points")) read_points(*points, name + ".points", panel, findings);
  reader.finish();
  if (node.kind != YamlNode::Kind::map) return panel;
  if (reader.has("x") || reader.has("y")) {
    check_path(reader, name, panel, findings);
    return panel;
  }
  for (const auto* key : {"split", "labels", "points"}) {
    if (!reader.has(key)) continue;
    findings.add(reader.place(key), fmt::format("{}: {} goes with a path in a plane", name, key),
                 "write x: AxisX.posit, y: AxisY.posit, or leave it out");
  }
  check_histogram(reader, name, panel, findings);
  if (reader.has("lanes") || reader.has("motor")) {
    check_alone(reader, name, reader.has("lanes") ? "lanes" : "motor", findings);
  } else if (reader.has("channels") && reader.has("event")) {
    findings.add(reader.place("event"), fmt::format("{} has both channels and an event", name),
                 "make two panels of it");
  } else if (!reader.has("channels") && !reader.has("event")) {
    reader.missing("channels",
                   "add channels: [knife.speed], lanes: [2.OUT01], or event: cut and values: [length]");
  } else if (reader.has("event") != reader.has("values")) {
    findings.add(reader.place(reader.has("event") ? "event" : "values"),
                 fmt::format("{}: event and values go together", name), "write event: cut, values: [length]");
  }
  return panel;
}

std::vector<PlotRequest::Panel> read_panels(const YamlNode& list, const std::string& name,
                                            Findings& findings) {
  std::vector<PlotRequest::Panel> panels;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    panels.push_back(read_panel(list.items[i], fmt::format("{}.{}", name, i), findings));
  }
  return panels;
}

// against: number
void read_against(const Text& text, const std::string& name, PlotRequest& plot, Findings& findings) {
  if (!read_choice(text, name, {"time", "number"}, findings)) return;
  plot.against_number = text.text == "number";
  if (!plot.against_number) return;
  for (const auto& panel : plot.panels) {
    if (panel.channels.empty() && panel.lanes.empty()) continue;
    findings.add(text.place,
                 fmt::format("{}: {} have no number", name, panel.lanes.empty() ? "channels" : "lanes"),
                 "against: number is for plots whose panels all show events");
    return;
  }
}

void refuse_marks(MapReader& reader, const std::string& name, Findings& findings) {
  findings.add(reader.place("marks"),
               fmt::format("{}: marks stand at times, this plot is not over time", name), "leave marks out");
}

}  // namespace

PlotRequest read_plot(const YamlNode& node, const std::string& name, Findings& findings) {
  PlotRequest plot;
  MapReader reader(node, name, findings);
  reader.text("name", plot.name);
  plot.title = plot.name.text;
  reader.text("title", plot.title);
  if (const auto* list = reader.list("panels")) {
    plot.panels = read_panels(*list, name + ".panels", findings);
  }
  if (const auto* text = reader.scalar("against")) read_against(*text, name + ".against", plot, findings);
  reader.time("from", plot.from, Sign::not_negative);
  reader.time("until", plot.until, Sign::positive);
  refuse_empty_window(reader, plot.from, plot.until, findings);
  if (const auto* marks = reader.list("marks")) {
    plot.marks = read_texts(*marks, name + ".marks", findings);
  }
  reader.finish();
  if (node.kind != YamlNode::Kind::map) return plot;
  if (!reader.has("name")) reader.missing("name", "it names the file: name.png");
  const auto& file = plot.name.text;
  constexpr std::size_t longest = 100;  // [bytes]; a file system takes 255
  if (file.find_first_of("/\\\n\r\t\f") != std::string::npos || file.starts_with('.') ||
      file.size() > longest) {
    findings.add(plot.name.place, fmt::format("{}.name '{}' is no file name", name, file),
                 "leave / and \\ out and begin with a letter, not too long; it becomes name.png");
  }
  if (!reader.has("panels")) reader.missing("panels", "add panels: [{title: ..., channels: [...]}]");
  // What has an x of its own.
  const auto loner = std::find_if(plot.panels.begin(), plot.panels.end(),
                                  [](const auto& panel) { return panel.has_own_x(); });
  if (loner == plot.panels.end()) {
    if (plot.marks && plot.against_number) refuse_marks(reader, name, findings);
    return plot;
  }
  const auto* const kind = loner->is_path() ? "a path" : loner->histogram ? "a histogram" : "a motor";
  if (plot.panels.size() > 1) {
    findings.add(reader.place("panels"), fmt::format("{}: {} stands alone in its plot", name, kind),
                 "make a plot of each");
  }
  if (plot.against_number) {
    findings.add(reader.place("against"), fmt::format("{}: {} has its own x", name, kind),
                 "leave against out");
  }
  if (plot.marks) refuse_marks(reader, name, findings);
  return plot;
}

}  // namespace drycut::sim
