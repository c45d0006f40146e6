#include "sim/loop/bindings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/scenario/units.hpp"

namespace drycut::sim::loop {

namespace {

class RecordingBinder {
 public:
  RecordingBinder(const Lookup& lookup, record::Recording& recording, Problems& problems)
      : lookup_(lookup),
        scenario_(lookup.scenario),
        pictures_(lookup.scenario.pictures),
        recording_(recording),
        problems_(problems) {}

  Captions bind() {
    for (const auto& name : scenario_.record.channels) add_channel(name);
    check_camera();
    check_frames();
    for (const auto& plot : pictures_.plots) add_plot(plot);
    for (const auto& name : pictures_.live) add_channel(name);
    Captions captions;
    for (const auto* names : {&pictures_.caption, &pictures_.lamps}) add_captions(*names, captions);
    check_units();
    if (pictures_.quota) captions.quota = quota(*pictures_.quota);
    return captions;
  }

 private:
  void fault(Code code, const scenario::ScenePlace& place, std::string what, std::string remedy) {
    problems_.push_back(scenario::problem_at(code, scenario_, place, std::move(what), std::move(remedy)));
  }
  void no_channel(const scenario::Text& name) {
    fault("scenario.unknown-name"_code, name.place, fmt::format("there is no channel '{}'", name.text),
          lookup_.names.suggest_reading(name.text));
  }

  void add_channel(const scenario::Text& name) {
    if (!lookup_.watch.record(name.text, recording_)) no_channel(name);
  }

  /// A lane shows a state: a quantity with a unit is none.
  void add_lane(const scenario::Text& name) {
    add_channel(name);
    const auto* column = recording_.column(name.text);
    if (column != nullptr && !column->unit.empty())
      fault("scenario.wrong-kind"_code, name.place,
            fmt::format("{} is a quantity in {}, not a state", name.text, column->unit),
            "show it in a panel of channels");
  }

  void add_motor(const scenario::Text& plant) {
    const auto found = std::find_if(lookup_.plants.begin(), lookup_.plants.end(),
                                    [&](const auto& one) { return one.name == plant.text; });
    bool known = found != lookup_.plants.end() && !found->plant->drives().empty();
    for (const auto& name : motor_channels(plant.text))
      known = known && lookup_.watch.record(name, recording_);
    if (!known)
      fault("scenario.unknown-name"_code, plant.place,
            fmt::format("'{}' is no plant with a drive that has ratings", plant.text),
            "name a plant with parameters servo.rated_torque, servo.peak_torque, ...");
  }

  void add_captions(const std::vector<scenario::Text>& names, Captions& captions) {
    for (const auto& name : names) {
      const auto* slot = lookup_.watch.slot(name.text);
      if (slot == nullptr) {
        no_channel(name);
        continue;
      }
      captions.slots.push_back(slot);
      captions.units.push_back(lookup_.watch.unit(name.text));
    }
  }

  void check_units() {
    const auto is_axis = [&](const std::string& name) {
      const auto names = lookup_.names.reading_names();
      return std::any_of(names.begin(), names.end(),
                         [&](const auto& reading) { return reading.starts_with(name + "."); });
    };
    for (const auto& [of, is] : pictures_.units) {
      if (lookup_.watch.slot(of.text) == nullptr && !is_axis(of.text))
        fault("scenario.unknown-name"_code, of.place,
              fmt::format("pictures.units: there is no axis and no channel '{}'", of.text),
              lookup_.names.suggest_reading(of.text));
      if (!scenario::is_unit(is.unit) || is.unit.empty() || !(is.number > 0))
        fault("scenario.wrong-unit"_code, is.place,
              fmt::format("pictures.units: {} is no unit's size", of.text),
              "write what 1 is of a known unit: 0.01 mm");
    }
  }

  Captions::Quota quota(const scenario::PicturesSection::Quota& wanted) {
    Captions::Quota quota;
    for (const auto& [name, plant] : lookup_.plants)
      if (name == wanted.plant.text && plant->quota_line(0)) quota.plant = plant;
    if (quota.plant == nullptr)
      fault("scenario.unknown-name"_code, wanted.plant.place,
            fmt::format("'{}' is no plant that shows a quota", wanted.plant.text),
            "name one of type vertical_press");
    quota.slot = lookup_.watch.slot(wanted.at.text);
    if (quota.slot == nullptr) {
      no_channel(wanted.at);
      return {};
    }
    std::string unit = lookup_.watch.unit(wanted.at.text);
    double number = 1;
    if (const auto own = pictures_.own_unit(wanted.at.text, unit)) number = own->number, unit = own->unit;
    if (scenario::is_unit(unit) && scenario::same_dimension(unit, "mm"))
      quota.metres = scenario::to_si(number, unit);
    else
      fault("scenario.wrong-unit"_code, wanted.at.place,
            fmt::format("pictures.quota.at: {} is no length", wanted.at.text),
            fmt::format("name a position, or say what 1 is: units: {{{}: 0.01 mm}}", wanted.at.text));
    return quota;
  }

  void add_plot(const scenario::PlotRequest& plot) {
    for (const auto& panel : plot.panels) {
      check_event(panel);
      for (const auto& name : panel.lanes) add_lane(name);
      for (const auto& name : panel.recorded()) add_channel(name);
      if (!panel.motor.text.empty()) add_motor(panel.motor);
    }
    if (!plot.marks) return;
    for (const auto& mark : *plot.marks) find_event(lookup_.all_events, mark, scenario_, problems_);
  }

  void check_event(const scenario::PlotRequest::Panel& panel) {
    if (panel.event.text.empty()) return;
    const auto* known = find_event(lookup_.plant_events, panel.event, scenario_, problems_);
    if (known == nullptr) return;
    std::vector<std::string> names;
    for (const auto& [name, unit] : known->values) names.push_back(name);
    for (const auto& value : panel.values) {
      if (std::find(names.begin(), names.end(), value.text) == names.end())
        fault("scenario.unknown-event"_code, value.place,
              fmt::format("event '{}' has no value '{}'", panel.event.text, value.text),
              fmt::format("it has: {}", fmt::join(names, ", ")));
    }
  }

  void check_frames() {
    if (!pictures_.frames) return;
    if (pictures_.around) find_event(lookup_.all_events, pictures_.around->event, scenario_, problems_);
    const auto step = scenario_.scene.step;
    if (pictures_.every % pictures_.slow == 0 && pictures_.every / pictures_.slow % step == 0) return;
    fault(
        "scenario.time-grid"_code, pictures_.slow_place,
        fmt::format("pictures.frames: a frame every {} ns / {} is not a whole multiple of the step of {} ns",
                    pictures_.every, pictures_.slow, step),
        "choose every = slow x a multiple of the step");
  }

  /// A part's name is looked up where parts are: load_part_meshes.
  void check_camera() {
    std::vector<std::string> cameras = {"operator"};
    for (const auto& plant : lookup_.plants) cameras.push_back(plant.name);
    for (const auto& camera : pictures_.views())
      if (!camera.own && !camera.looks_at_part() &&
          std::find(cameras.begin(), cameras.end(), camera.shows.text) == cameras.end())
        fault("scenario.unknown-name"_code, camera.shows.place,
              fmt::format("there is no camera '{}'", camera.shows.text),
              fmt::format("cameras: {}", fmt::join(cameras, ", ")));
  }

  const Lookup& lookup_;
  const scenario::Scenario& scenario_;
  const scenario::PicturesSection& pictures_;
  record::Recording& recording_;
  Problems& problems_;
};

}  // namespace

std::vector<std::string> motor_channels(const std::string& plant) {
  return {plant + ".motor.speed", plant + ".motor.torque"};
}

Captions bind_recording(const Lookup& lookup, record::Recording& recording, Problems& problems) {
  return RecordingBinder(lookup, recording, problems).bind();
}

}  // namespace drycut::sim::loop
