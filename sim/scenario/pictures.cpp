// pictures: frames and caption; the plots are read in plot_requests.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numbers>

#include "sim/scenario/sections.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

constexpr int smallest = 64;
constexpr int largest = 4096;
constexpr std::size_t most_live = 2;
constexpr double narrowest = 1 * std::numbers::pi / 180;  // field of view [rad]
constexpr double widest = 150 * std::numbers::pi / 180;

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

// around: "cut[3]", or cut for the first
void read_around(const Text& text, const std::string& name, PicturesSection::Around& around,
                 Findings& findings) {
  around.event = text;
  const auto open = text.text.find('[');
  if (open == std::string::npos) return;
  around.event.text.resize(open);
  const char* const end = text.text.data() + text.text.size();
  const auto number = std::from_chars(text.text.data() + open + 1, end, around.number);
  const bool closed = number.ec == std::errc() && end - number.ptr == 1 && *number.ptr == ']';
  if (closed && around.number >= 1 && open > 0) return;
  findings.add(text.place, fmt::format("{}: '{}' is no event", name, text.text),
               "write its name and its number from 1: \"cut[3]\"");
}

void read_window(MapReader& reader, PicturesSection& pictures, Findings& findings) {
  reader.time("from", pictures.from, Sign::not_negative);
  reader.time("until", pictures.until, Sign::positive);
  pictures.around = read_around_window(reader, findings);
  refuse_empty_window(reader, pictures.from, pictures.until, findings);
  for (const auto* key : {"from", "until"}) {
    if (!reader.has("around") || !reader.has(key)) continue;
    findings.add(reader.place(key), fmt::format("{} does not go with around", reader.full(key)),
                 "write before and after");
  }
}

// camera: operator, or {eye: [0 m, 1 m, 2 m], target: [0 m, 0 m, 0 m]}
void read_camera(MapReader& frames, PicturesSection& pictures, Findings& findings) {
  const auto* entry = frames.find("camera");
  if (entry == nullptr) return;
  pictures.camera_place = entry->value.text.place;
  if (entry->value.kind != YamlNode::Kind::map) {
    if (const auto* name = frames.scalar("camera")) pictures.camera = name->text;
    return;
  }
  MapReader reader(entry->value, "pictures.frames.camera", findings);
  PicturesSection::Eye own;
  for (const auto* key : {"eye", "target"})
    if (!reader.has(key))
      reader.missing(key, fmt::format("write {}: [0 m, 1 m, 2 m], along x, y and z", key));
  const auto before = findings.count();
  read_triple(reader, "eye", "m", own.eye, findings);
  read_triple(reader, "target", "m", own.target, findings);
  if (const auto* angle = reader.scalar("field_of_view")) {
    own.field_of_view =
        read_si(*angle, reader.full("field_of_view"), "deg", findings).value_or(own.field_of_view);
    if (own.field_of_view < narrowest || own.field_of_view > widest)
      findings.add(angle->place,
                   fmt::format("{} is {}, out of range", reader.full("field_of_view"), angle->text),
                   "1 deg to 150 deg; 35 deg is the default");
  }
  if (findings.count() == before && reader.has("eye") && reader.has("target") && own.eye == own.target)
    findings.add(reader.place("target"), "pictures.frames.camera looks at the place where it stands",
                 "let target be another point than eye");
  reader.finish();
  pictures.own_camera = own;
}

// overlays: [trail, lengths, forces]
void read_overlays(MapReader& reader, PicturesSection& pictures, Findings& findings) {
  std::vector<Text> names;
  const bool given = reader.has("overlays");
  reader.texts("overlays", names);
  if (!given) return;
  auto& overlays = pictures.overlays;
  overlays = {false, false, false};
  for (const auto& name : names) {
    bool* chosen = name.text == "trail"     ? &overlays.trail
                   : name.text == "lengths" ? &overlays.lengths
                   : name.text == "forces"  ? &overlays.forces
                                            : nullptr;
    if (chosen != nullptr)
      *chosen = true;
    else
      findings.add(name.place, fmt::format("pictures.overlays: there is no overlay '{}'", name.text),
                   "overlays: trail, lengths, forces");
  }
}

// live: [knife.motor.torque, AxisX.follerr]
void read_live(MapReader& reader, PicturesSection& pictures, Findings& findings) {
  reader.texts("live", pictures.live);
  if (pictures.live.size() > most_live)
    findings.add(pictures.live[most_live].place,
                 fmt::format("pictures.live has {} channels", pictures.live.size()),
                 "one or two have room in the corner; show more in plots");
}

void read_frames(const YamlNode& node, PicturesSection& pictures, Findings& findings) {
  MapReader reader(node, "pictures.frames", findings);
  pictures.frames = true;
  reader.time("every", pictures.every, Sign::positive);
  read_window(reader, pictures, findings);
  reader.integer("slow", pictures.slow, 1, 10000);
  const auto* slow = reader.scalar("slow");
  pictures.slow_place = slow == nullptr ? reader.place("every") : slow->place;
  read_camera(reader, pictures, findings);
  reader.text("follow", pictures.follow);
  if (const auto* size = reader.scalar("size")) read_size(*size, pictures, findings);
  reader.finish();
}

}  // namespace

std::optional<PicturesSection::Around> read_around_window(MapReader& reader, Findings& findings) {
  PicturesSection::Around around;
  const auto* event = reader.scalar("around");
  reader.time("before", around.before, Sign::not_negative);
  reader.time("after", around.after, Sign::not_negative);
  if (event != nullptr) read_around(*event, reader.full("around"), around, findings);
  for (const auto* key : {"before", "after"}) {
    if (reader.has("around") || !reader.has(key)) continue;
    findings.add(reader.place(key), fmt::format("{} stands without around", reader.full(key)),
                 "add around: \"cut[3]\", or write from and until");
  }
  if (event == nullptr) return {};
  return around;
}

void refuse_empty_window(MapReader& reader, Time from, const std::optional<Time>& until, Findings& findings) {
  if (!until || *until > from || *until == 0) return;
  findings.add(reader.place("until"), fmt::format("{} is not after from", reader.full("until")),
               "let until be later than from");
}

PicturesSection read_pictures(const YamlNode& node, Findings& findings) {
  PicturesSection pictures;
  MapReader reader(node, "pictures", findings);
  if (const auto* frames = reader.map("frames")) read_frames(*frames, pictures, findings);
  if (const auto* video = reader.scalar("video")) {
    pictures.video = read_switch(*video, "pictures.video", findings).value_or(false);
    if (pictures.video && !reader.has("frames")) {
      findings.add(reader.place("video"), "pictures.video is a film of the frames, and there are none",
                   "add frames: {every: 40 ms}");
    }
  }
  reader.texts("caption", pictures.caption);
  reader.texts("lamps", pictures.lamps);
  read_overlays(reader, pictures, findings);
  read_live(reader, pictures, findings);
  if (const auto* meshes = reader.map("meshes")) pictures.meshes = read_meshes(*meshes, findings);
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
