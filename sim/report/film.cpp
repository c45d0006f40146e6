#include "sim/report/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "renders/decimate.hpp"
#include "renders/mesh.hpp"
#include "renders/part_models.hpp"
#include "renders/pictures.hpp"
#include "sim/loop/shutter.hpp"
#include "sim/loop/strobe.hpp"
#include "sim/report/gallery_plots.hpp"

namespace drycut::sim::report {

namespace {

/// Models that are used more than once are read once, those of one size stretched once.
class Models {
 public:
  std::shared_ptr<const renders::Mesh> stretched(const plants::Part& part) {
    if (part.model.empty()) return nullptr;
    auto& mesh = stretched_[{part.model, part.size, part.ends_kept}];
    if (mesh) return mesh;
    auto found = read_.find(part.model);
    if (found == read_.end()) found = read_.emplace(part.model, renders::part_model(part.model)).first;
    mesh = std::make_shared<const renders::Mesh>(
        renders::stretched(found->second, renders::vec(part.size), part.ends_kept));
    return mesh;
  }

 private:
  std::map<std::string, renders::Mesh> read_;
  std::map<std::tuple<std::string, std::array<double, 3>, bool>, std::shared_ptr<const renders::Mesh>>
      stretched_;
};

renders::SolidPart solid(const std::string& plant, const plants::Part& part) {
  const auto shape = part.shape == plants::Part::Shape::box        ? renders::SolidPart::Shape::box
                     : part.shape == plants::Part::Shape::cylinder ? renders::SolidPart::Shape::cylinder
                                                                   : renders::SolidPart::Shape::wedge;
  renders::SolidPart drawn{plant + "." + part.name, shape, renders::vec(part.size), part.colour,
                           part.material};
  if (part.tip) drawn.tip = renders::vec(*part.tip);
  return drawn;
}

renders::Placement placement(const plants::PartPose& pose) {
  const auto& turn = pose.pose.rotation;
  return {renders::vec(pose.pose.position),
          {turn[0], turn[1], turn[2], turn[3]},
          renders::vec(pose.scale),
          pose.visible};
}

/// A caption's number with as many digits as an operator's panel would show.
std::string caption_number(double number, const std::string& unit) {
  const double size = std::abs(number);
  const int digits = size >= 1000 ? 0 : size >= 10 ? 1 : 2;
  const bool whole = unit.empty() || unit == "counts" || unit == "bits x4";
  auto text = fmt::format("{:.{}f}", number, whole && number == std::round(number) ? 0 : digits);
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-')
    text.erase(0, 1);  // no "-0.00"
  return unit.empty() ? text : text + " " + unit;
}

/// A number of which 1 is that much, with the digits that 1 has: 30000 of 0.01 mm is 300.00 mm.
std::string caption_number(double number, const scenario::Quantity& one) {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(one.number) - 1e-9)), 0, 6);
  return fmt::format("{:.{}f} {}", number * one.number + 0.0, digits, one.unit);
}

/// The film as the camera sees it: of one plant only its own parts, or one part, unless it shows the whole
/// line. A camera that goes along needs no room for what the machine does later.
renders::Film shown(const renders::Film& film, const std::string& camera, bool goes_along) {
  auto view = film;
  if (goes_along && !film.frames.empty()) view.frames.resize(1);
  if (camera == "operator") return view;
  for (std::size_t i = 0; i < view.parts.size(); ++i) {
    if (view.parts[i].name == camera || view.parts[i].name.starts_with(camera + ".")) continue;
    for (auto& frame : view.frames) frame.placements[i].visible = false;
  }
  return view;
}

std::vector<renders::DrawnCallout> chosen_callouts(const scenario::PicturesSection::Overlays& overlays,
                                                   const std::vector<plants::Callout>& callouts) {
  std::vector<renders::DrawnCallout> chosen;
  for (const auto& [kind, text, at, to] : callouts) {
    const bool length = kind == plants::Callout::Kind::length;
    const bool force = kind == plants::Callout::Kind::force;
    if (length ? !overlays.lengths : force ? !overlays.forces : !overlays.speeds) continue;
    using Kind = renders::DrawnCallout::Kind;
    chosen.push_back({length  ? Kind::length
                      : force ? Kind::force
                              : Kind::speed,
                      text, renders::vec(at), renders::vec(to)});
  }
  return chosen;
}

/// Of a long run only what a short film of it shows.
std::vector<renders::LiveCurve> live_curves(const scenario::PicturesSection& pictures,
                                            const record::Recording& recording, const renders::Film& film) {
  Rows rows{0, recording.times().size()};
  if (rows.count() > renders::kMostSamples && !film.frames.empty()) {
    const auto ns = [](double time) { return static_cast<Time>(std::max(0.0, time) * second); };
    rows = rows_between(recording, ns(film.frames.front().time_s - film.live_window_s),
                        ns(film.frames.back().time_s));
  }
  std::vector<renders::LiveCurve> curves;
  for (const auto& name : pictures.live) {
    const auto* column = recording.column(name.text);
    auto& curve = curves.emplace_back(renders::LiveCurve{name.text, column->unit, {}, {}});
    for (auto row = rows.first; row < rows.end; ++row) {
      curve.times_s.push_back(seconds(recording.times()[row]));
      curve.values.push_back(column->values[row]);
    }
  }
  return curves;
}

std::optional<std::size_t> part_number(const renders::Film& film, const std::string& part) {
  for (std::size_t i = 0; i < film.parts.size(); ++i)
    if (film.parts[i].name == part) return i;
  return std::nullopt;
}

/// A camera that looks at one part stands back, to show what the part works on.
renders::Camera named_camera(const renders::Film& film, const std::string& name, std::size_t view) {
  constexpr double room = 1.8;
  auto camera = renders::operator_camera(shown(film, name, film.follow && view == 0), view);
  if (!part_number(film, name)) return camera;
  camera.eye = camera.target + room * (camera.eye - camera.target);
  return camera;
}

renders::Camera own_camera(const scenario::PicturesSection::Eye& eye) {
  return {renders::vec(eye.eye), renders::vec(eye.target), eye.field_of_view * 180 / std::numbers::pi};
}

/// What a film in slow motion about an event tells beside the channels.
std::vector<renders::CaptionItem> film_caption(const scenario::PicturesSection& pictures,
                                               std::optional<double> event_at, double at) {
  std::vector<renders::CaptionItem> items;
  if (event_at) {
    items.push_back({fmt::format("from {}[{}]", pictures.around->event.text, pictures.around->number),
                     fmt::format("{:+.1f} ms", (at - *event_at) * 1e3)});
  }
  if (pictures.slow > 1) items.push_back({"slowed down", fmt::format("{} x", pictures.slow)});
  return items;
}

/// That the frame does not show how something turns.
renders::CaptionItem strobe_caption(const std::optional<loop::Strobe>& strobe) {
  return {"strobe effect",
          strobe ? fmt::format("{} by {:.1f} pitches a frame", strobe->part, strobe->pitches) : "none"};
}

}  // namespace

renders::Film film_of(const scenario::Scenario& scenario, const loop::Simulation& simulation,
                      const PartMeshes& meshes) {
  renders::Film film;
  film.title = scenario.scene.title;
  film.width = scenario.pictures.width;
  film.height = scenario.pictures.height;
  Models models;
  for (const auto& [name, plant] : simulation.plants()) {
    for (const auto& part : plant->parts()) {
      auto& drawn = film.parts.emplace_back(solid(name, part));
      const auto own = meshes.find(drawn.name);
      drawn.mesh = own == meshes.end() ? models.stretched(part) : own->second;
    }
  }
  const auto strobes = simulation.strobes();
  const bool flickers = loop::worst_strobe(strobes).has_value();
  for (const auto& shot : simulation.snapshots()) {
    renders::Frame frame;
    frame.time_s = seconds(shot.time);
    for (const auto& pose : shot.poses) frame.placements.push_back(placement(pose));
    for (const auto& key : shot.between)
      if (!film.frames.empty()) frame.before.push_back({key.part, seconds(key.time), placement(key.pose)});
    frame.caption = film_caption(scenario.pictures, simulation.frames_event(), frame.time_s);
    const auto& numbers = scenario.pictures.caption;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto& unit = simulation.caption_units()[i];
      const auto own = scenario.pictures.own_unit(numbers[i].text, unit);
      frame.caption.push_back({numbers[i].text, own ? caption_number(shot.caption[i], *own)
                                                    : caption_number(shot.caption[i], unit)});
    }
    for (std::size_t i = numbers.size(); i < shot.caption.size(); ++i)
      frame.caption.push_back({scenario.pictures.lamps[i - numbers.size()].text, "", shot.caption[i] != 0});
    if (flickers) frame.caption.push_back(strobe_caption(strobes[film.frames.size()]));
    frame.callouts = chosen_callouts(scenario.pictures.overlays, shot.callouts);
    if (const auto& quota = shot.quota)
      frame.quota = {renders::vec(quota->line.left), renders::vec(quota->line.right), quota->place,
                     quota->line.miss, scenario.pictures.quota->tolerance};
    film.frames.push_back(std::move(frame));
  }
  film.follow = part_number(film, scenario.pictures.follow.text);
  film.trails = scenario.pictures.overlays.trail;
  film.live_window_s /= scenario.pictures.slow;
  film.live = live_curves(scenario.pictures, simulation.recording(), film);
  const auto views = scenario.pictures.views();
  film.beside.resize(views.size() - 1);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto& [shows, own] = views[i];
    const auto camera = own ? own_camera(*own) : named_camera(film, shows.text, i);
    (i == 0 ? film.camera : film.beside[i - 1].camera) = camera;
    (i == 0 ? film.camera_name : film.beside[i - 1].name) = own ? "" : shows.text;
  }
  return film;
}

}  // namespace drycut::sim::report
