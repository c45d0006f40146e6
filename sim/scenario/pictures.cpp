// pictures: frames, caption and plots.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/scenario/sections.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

constexpr int smallest = 64;
constexpr int largest = 4096;

// "960x540"
void read_size(const Text& text, PicturesSection& pictures, Findings& findings) {
  int width = 0;
  int height = 0;
  const char* const end = text.text.data() + text.text.size();
  const auto first = std::from_chars(text.text.data(), end, width);
  const bool crossed = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
  const auto second = crossed ? std::from_chars(first.ptr + 1, end, height) : first;
  if (!crossed || second.ec != std::errc() || second.ptr != end) {
    findings.add(text.place, fmt::format("pictures.frames.size: '{}' is no picture size", text.text),
                 "write width x height in pixels without blanks: 960x540");
  } else if (std::min(width, height) < smallest || std::max(width, height) > largest) {
    findings.add(text.place, fmt::format("pictures.frames.size is {}, out of range", text.text),
                 fmt::format("{} to {} pixels each way", smallest, largest));
  } else {
    pictures.width = width;
    pictures.height = height;
  }
}

void refuse_empty_window(MapReader& reader, Time from, const std::optional<Time>& until, Findings& findings) {
  if (!until || *until > from || *until == 0) return;
  findings.add(reader.place("until"), fmt::format("{} is not after from", reader.full("until")),
               "let until be later than from");
}

void read_frames(const YamlNode& node, PicturesSection& pictures, Findings& findings) {
  MapReader reader(node, "pictures.frames", findings);
  pictures.frames = true;
  reader.time("every", pictures.every, Sign::positive);
  reader.time("from", pictures.from, Sign::not_negative);
  reader.time("until", pictures.until, Sign::positive);
  refuse_empty_window(reader, pictures.from, pictures.until, findings);
  if (const auto* camera = reader.scalar("camera")) {
    pictures.camera_place = camera->place;
    pictures.camera = camera->text;
  }
  if (const auto* size = reader.scalar("size")) read_size(*size, pictures, findings);
  reader.finish();
}

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
  for (const auto& [key, value] : map.entries) {
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
  for (const auto* key : {"channels", "event", "values", "limits"}) {
    if (!reader.has(key)) continue;
    findings.add(reader.place(key), fmt::format("{} has both a path and {}", name, key),
                 "make two plots of it");
  }
  if (!panel.labels.empty() && panel.split.text.empty()) {
    findings.add(reader.place("labels"), fmt::format("{}: labels are for the parts of a split path", name),
                 "add split: with the channel that numbers them, or leave labels out");
  }
}

PlotRequest::Panel read_panel(const YamlNode& node, const std::string& name, Findings& findings) {
  PlotRequest::Panel panel;
  MapReader reader(node, name, findings);
  reader.text("title", panel.title);
  reader.texts("channels", panel.channels);
  reader.text("event", panel.event);
  reader.texts("values", panel.values);
  if (const auto* limits = reader.list("limits")) read_limits(*limits, name + ".limits", panel, findings);
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
  if (reader.has("channels") && reader.has("event")) {
    findings.add(reader.place("event"), fmt::format("{} has both channels and an event", name),
                 "make two panels of it");
  } else if (!reader.has("channels") && !reader.has("event")) {
    reader.missing("channels", "add channels: [knife.speed], or event: cut and values: [length]");
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
    if (panel.channels.empty()) continue;
    findings.add(text.place, fmt::format("{}: channels have no number", name),
                 "against: number is for plots whose panels all show events");
    return;
  }
}

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
  reader.finish();
  if (node.kind != YamlNode::Kind::map) return plot;
  if (!reader.has("name")) reader.missing("name", "it names the file: name.png");
  if (plot.name.text.find_first_of("/\\") != std::string::npos) {
    findings.add(plot.name.place, fmt::format("{}.name '{}' is no file name", name, plot.name.text),
                 "leave / and \\ out; it becomes name.png");
  }
  if (!reader.has("panels")) reader.missing("panels", "add panels: [{title: ..., channels: [...]}]");
  const auto paths = std::count_if(plot.panels.begin(), plot.panels.end(),
                                   [](const PlotRequest::Panel& panel) { return panel.is_path(); });
  if (paths > 0 && plot.panels.size() > 1) {
    findings.add(reader.place("panels"), fmt::format("{}: a path stands alone in its plot", name),
                 "make a plot of each");
  }
  if (paths > 0 && plot.against_number) {
    findings.add(reader.place("against"), fmt::format("{}: a path has its own x", name), "leave against out");
  }
  return plot;
}

}  // namespace

PicturesSection read_pictures(const YamlNode& node, Findings& findings) {
  PicturesSection pictures;
  MapReader reader(node, "pictures", findings);
  if (const auto* frames = reader.map("frames")) read_frames(*frames, pictures, findings);
  reader.texts("caption", pictures.caption);
  if (const auto* list = reader.list("plots")) {
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      auto plot = read_plot(list->items[i], fmt::format("pictures.plots.{}", i), findings);
      const bool twice =
          std::any_of(pictures.plots.begin(), pictures.plots.end(), [&](const PlotRequest& other) {
            return !plot.name.text.empty() && other.name.text == plot.name.text;
          });
      if (twice) {
        findings.add(plot.name.place, fmt::format("there are two plots named '{}'", plot.name.text),
                     "rename one: each is a file");
      }
      pictures.plots.push_back(std::move(plot));
    }
  }
  reader.finish();
  return pictures;
}

}  // namespace drycut::sim
