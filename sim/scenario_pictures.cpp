// pictures: frames, caption and plots.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/scenario_sections.hpp"
#include "sim/yaml_reader.hpp"

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

PlotRequest::Panel read_panel(const YamlNode& node, const std::string& name, Findings& findings) {
  PlotRequest::Panel panel;
  MapReader reader(node, name, findings);
  reader.text("title", panel.title);
  reader.texts("channels", panel.channels);
  reader.text("event", panel.event);
  reader.texts("values", panel.values);
  if (const auto* limits = reader.list("limits")) read_limits(*limits, name + ".limits", panel, findings);
  reader.finish();
  if (node.kind != YamlNode::Kind::map) return panel;
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
