// pictures: frames, what stands over them, the user's own meshes. Plots are in plot_requests.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numbers>

#include "base/picture_size.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr std::size_t most_cameras = 4;
constexpr std::size_t most_live = 2;
constexpr double degree = std::numbers::pi / 180;

// "960x540"
Form size_form(PicturesSection& pictures) {
  return single(
      [&pictures](const Text& text, const std::string& name, Findings& findings) {
        int width = 0;
        int height = 0;
        const char* const end = text.text.data() + text.text.size();
        const auto first = std::from_chars(text.text.data(), end, width);
        const bool crossed = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
        const auto second = crossed ? std::from_chars(first.ptr + 1, end, height) : first;
        if (!crossed || second.ec != std::errc() || second.ptr != end) {
          findings.add("scenario.out-of-range"_code, text.place,
                       fmt::format("{}: '{}' is no picture size", name, text.text),
                       "write width x height in pixels without blanks: 960x540");
        } else if (std::min(width, height) < smallest_picture || std::max(width, height) > largest_picture) {
          findings.add("scenario.out-of-range"_code, text.place,
                       fmt::format("{} is {}, out of range", name, text.text),
                       fmt::format("{} to {} pixels each way", smallest_picture, largest_picture));
        } else {
          pictures.width = width;
          pictures.height = height;
        }
      },
      [&pictures] { return fmt::format("{}x{}", pictures.width, pictures.height); },
      R"({"type": "string", "pattern": "^[0-9]+x[0-9]+$"})");
}

// around: "cut[3]", or cut for the first
Form around_form(std::optional<PicturesSection::Around>& around) {
  return single(
      [&around](const Text& text, const std::string& name, Findings& findings) {
        around = PicturesSection::Around{};
        auto& [event, number, before, after] = *around;
        event = text;
        const auto open = text.text.find('[');
        if (open == std::string::npos) return;
        event.text.resize(open);
        const char* const end = text.text.data() + text.text.size();
        const auto read = std::from_chars(text.text.data() + open + 1, end, number);
        const bool closed = read.ec == std::errc() && end - read.ptr == 1 && *read.ptr == ']';
        if (closed && number >= 1 && open > 0) return;
        findings.add("scenario.unknown-event"_code, text.place,
                     fmt::format("{}: '{}' is no event", name, text.text),
                     "write its name and its number from 1: \"cut[3]\"");
      },
      [&around] {
        return around ? yaml_quoted(fmt::format("{}[{}]", around->event.text, around->number)) : "";
      },
      std::string(any_text_schema));
}

void visit_frames(Archive& archive, PicturesSection& pictures) {
  pictures.frames = true;
  archive.value({"every", "a frame this often"}, form(pictures.every, Sign::positive));
  visit_window(archive, pictures.from, pictures.until, &pictures.around);
  archive.value({"slow", "so many times slower than the machine"}, form(pictures.slow, 1, 10000));
  archive.section(
      {"camera", "operator, a plant, a part (knife.blade), or a place of your own", pictures.cameras.empty()},
      [&](Archive& inner) { visit(inner, pictures.camera); });
  archive.list({"cameras", "two to four in its place, which share the picture", !pictures.cameras.empty()},
               pictures.cameras, true);
  archive.value(
      {"follow", "a part that the camera, of several the first, goes with", !pictures.follow.text.empty()},
      form(pictures.follow));
  archive.value({"size", "of a frame in pixels"}, size_form(pictures));
  archive.judge([&pictures](MapReader& reader) {
    pictures.slow_place = reader.has("slow") ? reader.value_place("slow") : reader.place("every");
    const auto cameras = pictures.cameras.size();
    if (cameras == 1 || cameras > most_cameras)
      reader.refuse("scenario.out-of-range"_code, "cameras",
                    fmt::format("{} has {}", reader.full("cameras"), cameras),
                    "two to four share the picture; one stands under camera");
    for (const auto* key : {"from", "until"}) {
      if (!reader.has("around") || !reader.has(key)) continue;
      reader.refuse("scenario.does-not-go-together"_code, key,
                    fmt::format("{} does not go with around", reader.full(key)), "write before and after");
    }
  });
}

// overlays: [trail, lengths, forces, speeds]
Form overlays_form(PicturesSection::Overlays& overlays) {
  const auto flag = [&overlays](std::string_view name) -> bool* {
    if (name == "trail") return &overlays.trail;
    if (name == "lengths") return &overlays.lengths;
    if (name == "forces") return &overlays.forces;
    return name == "speeds" ? &overlays.speeds : nullptr;
  };
  return whole(
      YamlNode::Kind::sequence,
      [&overlays, flag](const YamlNode& list, const Form::Name& name, Findings& findings) {
        std::vector<Text> given;
        form(given).read(list, name, findings);
        overlays = {false, false, false, false};
        for (const auto& one : given) {
          if (bool* const chosen = flag(one.text))
            *chosen = true;
          else
            findings.add("scenario.unknown-choice"_code, one.place,
                         fmt::format("{}: there is no overlay '{}'", name.full, one.text),
                         "overlays: trail, lengths, forces, speeds");
        }
      },
      [flag] {
        std::vector<std::string> names;
        for (const auto* name : {"trail", "lengths", "forces", "speeds"})
          if (*flag(name)) names.emplace_back(name);
        return yaml_list(names);
      },
      R"({"type": "array", "items": {"enum": ["trail", "lengths", "forces", "speeds"]}})");
}

}  // namespace

// camera: operator, or {eye: [0 m, 1 m, 2 m], target: [0 m, 0 m, 0 m]}
void visit(Archive& archive, PicturesSection::Camera& camera) {
  auto& own = camera.own;
  if (archive.instead(!own, form(camera.shows))) return;
  if (!own) own = PicturesSection::Eye{};
  archive.in_line();
  archive.value({"eye", "where it stands, along x, y and z"}, form(own->eye, "m"));
  archive.value({"target", "what it looks at"}, form(own->target, "m"));
  archive.value({"field_of_view", "vertical"}, form(own->field_of_view, "deg", 1 * degree, 150 * degree,
                                                    "1 deg to 150 deg; 35 deg is the default"));
  archive.require("eye", "write eye: [0 m, 1 m, 2 m], along x, y and z");
  archive.require("target", "write target: [0 m, 1 m, 2 m], along x, y and z");
  archive.judge([&own](MapReader& reader) {
    if (reader.is_sound() && own->eye == own->target)
      reader.refuse("scenario.does-not-go-together"_code, "target",
                    fmt::format("{} looks at the place where it stands", reader.name()),
                    "let target be another point than eye");
  });
}

void visit_window(Archive& archive, Time& from, std::optional<Time>& until,
                  std::optional<PicturesSection::Around>* around) {
  const bool about = around != nullptr && *around;
  archive.value({"from", "what is earlier is not shown", !about}, form(from, Sign::not_negative));
  archive.value({"until", "what is later is not shown", !about}, form(until, Sign::positive));
  archive.judge([&from, &until](MapReader& reader) {
    if (!until || *until > from || *until == 0) return;
    reader.refuse("scenario.order"_code, "until", fmt::format("{} is not after from", reader.full("until")),
                  "let until be later than from");
  });
  if (around == nullptr) return;
  archive.value({"around", "in place of from and until: about an event, cut[3] the third cut"},
                around_form(*around));
  PicturesSection::Around none;
  auto& window = *around ? **around : none;
  archive.value({"before", "so long before the event", about}, form(window.before, Sign::not_negative));
  archive.value({"after", "so long after it", about}, form(window.after, Sign::not_negative));
  archive.judge([](MapReader& reader) {
    for (const auto* key : {"before", "after"}) {
      if (reader.has("around") || !reader.has(key)) continue;
      reader.refuse("scenario.needs-another"_code, key,
                    fmt::format("{} stands without around", reader.full(key)),
                    "add around: \"cut[3]\", or write from and until");
    }
  });
}

void visit(Archive& archive, PicturesSection::MeshRequest& mesh) {
  archive.value({"file", "a mesh, relative to the scenario"}, path_form(mesh.file));
  archive.require("file", "name a mesh file: file: meshes/my_drum.stl");
  archive.value({"scale", "on the file's unit"},
                form(mesh.scale, "", 1e-6, 1e6, "1e-6 to 1e6; 1 takes the file as it is"));
  archive.value({"at", "its origin from the part's middle, along x, y and z"}, form(mesh.at, "mm"));
  archive.value({"rotate", "about x, then y, then z"}, form(mesh.rotate, "deg"));
}

void visit(Archive& archive, PicturesSection::OwnUnit& own) { archive.alone(form(own.is)); }

std::optional<Quantity> PicturesSection::own_unit(std::string_view channel, std::string_view unit) const {
  constexpr std::string_view users = "Um";
  for (const auto& own : units)
    if (own.of.text == channel) return own.is;
  if (!unit.starts_with(users)) return {};
  for (const auto& own : units)
    if (own.of.text == channel.substr(0, channel.find('.')))
      return Quantity{own.is.number, own.is.unit + std::string(unit.substr(users.size())), own.is.place};
  return {};
}

namespace {

void visit_quota(Archive& archive, PicturesSection::Quota& quota) {
  archive.in_line();
  archive.value({"plant", "a vertical_press"}, form(quota.plant));
  archive.value({"at", "the channel that says where it is to go"}, form(quota.at));
  archive.value({"tolerance", "on either side"},
                form(quota.tolerance, "mm", 1e-6, 1, "0.001 mm to 1 m; 0.1 mm is the default"));
  archive.require("plant", "name the plant: plant: press");
  archive.require("at", "name a channel: at: Axis.setpos");
}

}  // namespace

void visit(Archive& archive, PicturesSection& pictures) {
  archive.section({"frames", "pictures of the machine", pictures.frames},
                  [&](Archive& inner) { visit_frames(inner, pictures); });
  archive.value({"video", "the frames as a film too", pictures.frames}, form(pictures.video));
  archive.value({"view", "the machine in 3-D in the report, moving as in the frames; on unless switched off",
                 pictures.frames},
                form(pictures.view));
  archive.value({"caption", "channels under the frames"}, form(pictures.caption));
  archive.value({"lamps", "channels there as lamps, lit unless 0", pictures.frames}, form(pictures.lamps));
  archive.names(
      {"units", "in captions and quota: what 1 of a channel is, or 1 Um of an axis: {Axis: 0.01 mm}",
       !pictures.units.empty()},
      pictures.units, &PicturesSection::OwnUnit::of);
  archive.section({"quota", "a line where a plant is to go, and a gauge of how far off it is",
                   pictures.quota.has_value()},
                  [&](Archive& inner) {
                    if (!pictures.quota) pictures.quota = PicturesSection::Quota{};
                    visit_quota(inner, *pictures.quota);
                  });
  archive.value({"overlays", "what is drawn over the frames", pictures.frames},
                overlays_form(pictures.overlays));
  archive.value({"live", "one or two channels that run along in the corner", pictures.frames},
                form(pictures.live));
  archive.names({"meshes", "meshes of your own in place of parts: knife.drum", !pictures.meshes.empty()},
                pictures.meshes, &PicturesSection::MeshRequest::part);
  archive.list({"plots", "curves of the run"}, pictures.plots);
  archive.judge([&pictures](MapReader& reader) {
    if (pictures.video && !reader.has("frames")) {
      reader.refuse("scenario.needs-another"_code, "video",
                    "pictures.video is a film of the frames, and there are none",
                    "add frames: {every: 40 ms}");
    }
    if (pictures.view && reader.has("view") && !reader.has("frames")) {
      reader.refuse("scenario.needs-another"_code, "view",
                    "pictures.view moves the machine as in the frames, and there are none",
                    "add frames: {every: 40 ms}");
    }
    if (pictures.live.size() > most_live)
      reader.findings().add("scenario.out-of-range"_code, pictures.live[most_live].place,
                            fmt::format("pictures.live has {} channels", pictures.live.size()),
                            "one or two have room in the corner; show more in plots");
    refuse_same_name(pictures.plots, "plots", "rename one: each is a file", reader.findings());
  });
}

}  // namespace drycut::sim::scenario
