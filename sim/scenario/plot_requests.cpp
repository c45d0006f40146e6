// pictures.plots: panels of channels, lanes, events, a path, a motor.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::scenario {

namespace {

using PanelKind = PlotRequest::Panel::Kind;

// points: {A: [0, 0], B: [15, -33]}
Form points_form(std::vector<PlotRequest::Panel::Point>& points) {
  return whole(
      YamlNode::Kind::map,
      [&points](const YamlNode& map, const Form::Name& name, Findings& findings) {
        refuse_duplicates(map, name.full, findings);
        for (const auto& [key, value, first_line] : map.entries) {
          if (first_line > 0) continue;
          const auto full = name.full + "." + key.text;
          const auto numbers = read_numbers(value, full, findings);
          if (!numbers) continue;
          if (numbers->size() == 2)
            points.push_back({key, numbers->front(), numbers->back()});
          else
            findings.add("scenario.wrong-kind"_code, key.place,
                         fmt::format("{} must be a place in the plane", full), "for example [15, -33]");
        }
      },
      [&points] {
        std::vector<std::string> items;
        for (const auto& [label, x, y] : points)
          items.push_back(fmt::format("{}: [{}, {}]", yaml_text(label.text), x, y));
        return yaml_map(items);
      },
      map_schema(pair_schema));
}

/// What a panel may show. A path, lanes and a motor go with none of it but themselves.
constexpr auto panel_keys = {"channels", "lanes",  "motor",     "event",
                             "values",   "limits", "histogram", "spectrum"};

void judge_path(MapReader& reader, const PlotRequest::Panel& panel) {
  const auto& name = reader.name();
  if (reader.has("x") != reader.has("y")) {
    reader.refuse("scenario.needs-another"_code, reader.has("x") ? "x" : "y",
                  fmt::format("{}: x and y go together", name), "write x: AxisX.posit, y: AxisY.posit");
  }
  for (const auto* key : panel_keys) {
    if (!reader.has(key)) continue;
    reader.refuse("scenario.does-not-go-together"_code, key,
                  fmt::format("{} has both a path and {}", name, key), "make two plots of it");
  }
  if (!panel.labels.empty() && panel.split.text.empty()) {
    reader.refuse("scenario.does-not-go-together"_code, "labels",
                  fmt::format("{}: labels are for the parts of a split path", name),
                  "add split: with the channel that numbers them, or leave labels out");
  }
}

/// A panel of lanes, or of a motor, shows nothing else.
void judge_alone(MapReader& reader, std::string_view what) {
  for (const auto* key : panel_keys) {
    if (key == what || !reader.has(key)) continue;
    reader.refuse("scenario.does-not-go-together"_code, key,
                  fmt::format("{} has both {} and {}", reader.name(), what, key), "make two panels of it");
  }
}

void judge_panel(MapReader& reader, const PlotRequest::Panel& panel) {
  const auto& name = reader.name();
  if (reader.has("x") || reader.has("y")) return judge_path(reader, panel);
  for (const auto* key : {"split", "labels", "points"}) {
    if (!reader.has(key)) continue;
    reader.refuse("scenario.needs-another"_code, key,
                  fmt::format("{}: {} goes with a path in a plane", name, key),
                  "write x: AxisX.posit, y: AxisY.posit, or leave it out");
  }
  const bool event = reader.has("event");
  if (panel.histogram && (!event || panel.values.size() != 1)) {
    reader.refuse("scenario.does-not-go-together"_code, "histogram",
                  fmt::format("{}: a histogram shows one value of an event", name),
                  "write event: cut, values: [length]");
  }
  if (panel.spectrum && (!event || panel.values.size() != 1)) {
    reader.refuse("scenario.does-not-go-together"_code, "spectrum",
                  fmt::format("{}: a spectrum is of one value of an event", name),
                  "write event: cut, values: [length]");
  }
  for (const auto* key : {"histogram", "limits"}) {
    if (!panel.spectrum || !reader.has(key)) continue;
    reader.refuse("scenario.does-not-go-together"_code, key,
                  fmt::format("{} has both a spectrum and {}", name, key), "make two plots of it");
  }
  if (reader.has("lanes") || reader.has("motor")) {
    judge_alone(reader, reader.has("lanes") ? "lanes" : "motor");
  } else if (reader.has("channels") && event) {
    reader.refuse("scenario.does-not-go-together"_code, "event",
                  fmt::format("{} has both channels and an event", name), "make two panels of it");
  } else if (!reader.has("channels") && !event) {
    reader.missing("channels",
                   "add channels: [knife.speed], lanes: [2.OUT01], or event: cut and values: [length]");
  } else if (event != reader.has("values")) {
    reader.refuse("scenario.needs-another"_code, event ? "event" : "values",
                  fmt::format("{}: event and values go together", name),
                  "write event: cut, values: [length]");
  }
}

void judge_against(MapReader& reader, const PlotRequest& plot) {
  if (!plot.against_number) return;
  for (const auto& panel : plot.panels) {
    if (panel.channels.empty() && panel.lanes.empty()) continue;
    reader.findings().add("scenario.does-not-go-together"_code, reader.value_place("against"),
                          fmt::format("{}: {} have no number", reader.full("against"),
                                      panel.lanes.empty() ? "channels" : "lanes"),
                          "against: number is for plots whose panels all show events");
    return;
  }
}

void judge_plot(MapReader& reader, const PlotRequest& plot) {
  const auto& name = reader.name();
  const auto& file = plot.name.text;
  constexpr std::size_t longest = 100;  // [bytes]; a file system takes 255
  if (file.find_first_of("/\\\n\r\t\f") != std::string::npos || file.starts_with('.') ||
      file.size() > longest) {
    reader.findings().add("scenario.bad-name"_code, plot.name.place,
                          fmt::format("{}.name '{}' is no file name", name, file),
                          "leave / and \\ out and begin with a letter, not too long; it becomes name.png");
  }
  judge_against(reader, plot);
  const auto refuse_marks = [&] {
    if (plot.marks)
      reader.refuse("scenario.does-not-go-together"_code, "marks",
                    fmt::format("{}: marks stand at times, this plot is not over time", name),
                    "leave marks out");
  };
  // What has an x of its own.
  const auto loner = std::find_if(plot.panels.begin(), plot.panels.end(),
                                  [](const auto& panel) { return panel.has_own_x(); });
  if (loner == plot.panels.end()) {
    if (plot.against_number) refuse_marks();
    return;
  }
  static constexpr std::array names = {"curves", "lanes",       "points",    "a motor",
                                       "a path", "a histogram", "a spectrum"};
  const auto* const kind = names.at(static_cast<std::size_t>(loner->kind()));
  if (plot.panels.size() > 1) {
    reader.refuse("scenario.does-not-go-together"_code, "panels",
                  fmt::format("{}: {} stands alone in its plot", name, kind), "make a plot of each");
  }
  if (plot.against_number)
    reader.refuse("scenario.does-not-go-together"_code, "against",
                  fmt::format("{}: {} has its own x", name, kind), "leave against out");
  refuse_marks();
}

void visit_plot(Archive& archive, PlotRequest& plot, std::optional<PicturesSection::Around>* around) {
  archive.value({"name", "of the file: name.png"}, form(plot.name));
  archive.require("name", "it names the file: name.png");
  if (archive.reads()) plot.title = plot.name.text;
  archive.value({"title", "the name unless given"}, form(plot.title));
  visit_window(archive, plot.from, plot.until, around);
  archive.value(
      {"against", "what stands along x; number is that of the events", around == nullptr || !*around},
      choice_form({"time", "number"}, plot.against_number));
  archive.value({"marks", "events drawn as vertical lines; faults and power changes unless given"},
                form(plot.marks));
  archive.list({"panels", "one above the other"}, plot.panels);
  archive.require("panels", "add panels: [{title: ..., channels: [...]}]");
  archive.judge([&plot](MapReader& reader) { judge_plot(reader, plot); });
}

}  // namespace

PlotRequest::Panel::Kind PlotRequest::Panel::kind() const {
  if (!x.text.empty()) return Kind::path;
  if (histogram) return Kind::histogram;
  if (spectrum) return Kind::spectrum;
  if (!motor.text.empty()) return Kind::motor;
  if (!lanes.empty()) return Kind::lanes;
  return event.text.empty() ? Kind::curves : Kind::points;
}

std::vector<Text> PlotRequest::Panel::recorded() const {
  auto names = channels;
  for (const auto* name : {&x, &y, &split})
    if (!name->text.empty()) names.push_back(*name);
  return names;
}

void visit(Archive& archive, PlotRequest::Panel& panel) {
  archive.in_line();
  const auto kind = panel.kind();
  const bool path = kind == PanelKind::path;
  const bool motor = kind == PanelKind::motor;
  const bool lanes = kind == PanelKind::lanes;
  const bool event = !path && !motor && !lanes && !panel.event.text.empty();
  archive.value({"title", ""}, form(panel.title));
  archive.value({"channels", "curves over time", !path && !motor && !lanes && !event}, form(panel.channels));
  archive.value({"lanes", "states over time, one lane each", lanes}, form(panel.lanes));
  archive.value({"event", "points, one an event of this name", event}, form(panel.event));
  archive.value({"values", "of the event", event}, form(panel.values));
  archive.value({"motor", "torque over speed of the servo motor of this plant", motor}, form(panel.motor));
  archive.value({"x", "of a path in a plane", path}, form(panel.x));
  archive.value({"y", "of a path in a plane", path}, form(panel.y));
  archive.value(
      {"split", "a curve for each whole value of this channel from 1", path && !panel.split.text.empty()},
      form(panel.split));
  archive.value({"labels", "of these curves", path && !panel.labels.empty()}, form(panel.labels));
  archive.value({"points", "named places in the plane", path && !panel.points.empty()},
                points_form(panel.points));
  archive.value({"histogram", "the event's value by how often it comes", panel.histogram},
                form(panel.histogram));
  archive.value(
      {"spectrum", "how much of the event's value comes back how often over the web", panel.spectrum},
      form(panel.spectrum));
  archive.value({"limits", "a band behind the curves, in their unit"}, form(panel.limits));
  archive.judge([&panel](MapReader& reader) { judge_panel(reader, panel); });
}

void visit(Archive& archive, PlotRequest& plot) { visit_plot(archive, plot, nullptr); }

void visit(Archive& archive, PlotRequest& plot, std::optional<PicturesSection::Around>& around) {
  visit_plot(archive, plot, &around);
}

}  // namespace drycut::sim::scenario
