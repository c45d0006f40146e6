// What a scene says of the machine that a table is for: its pulses, its drum, and where its program has the
// cut.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/cams/study.hpp"
#include "sim/studies/design/scene_reading.hpp"

namespace drycut::sim::studies {

namespace {

using plants::PlantDefinition;

/// A number of a plant, 0 if it has none of that name.
double parameter(const scenario::PlantEntry& plant, std::string_view name) {
  for (const auto& row : plant.definition->parameters()) {
    if (row.name != name) continue;
    if (const auto* const number = std::get_if<double*>(&row.value)) return **number;
    if (const auto* const number = std::get_if<int*>(&row.value)) return **number;
    if (const auto* const on = std::get_if<bool*>(&row.value)) return **on ? 1 : 0;
  }
  return 0;
}

/// So many of them on a way; nothing where one of both is not known.
std::optional<PulseWay> way_of(double metres, double pulses) {
  if (!(metres > 0 && pulses > 0)) return {};
  const double whole = std::round(pulses);
  return PulseWay{metres * 1000, std::abs(pulses - whole) <= 1e-9 * pulses ? whole : pulses};
}

/// What a pulse of a plug is; counters of CAMMING4 count four edges of it.
std::optional<PulseWay> pulse_of(const scenario::PlantEntry& plant, std::string_view port, int edges) {
  const double turn =
      plant.type.text == "rotary_knife" ? parameter(plant, "circumference") : parameter(plant, "lead");
  const double gear = parameter(plant, "gear.ratio");
  if (port == "wheel")
    return way_of(parameter(plant, "wheel.circumference"), edges * parameter(plant, "wheel.lines"));
  if (port == "scale") return way_of(parameter(plant, "scale.resolution"), edges / 4.0);
  if (port == "encoder")
    return way_of(turn, edges * parameter(plant, "encoder.lines") *
                            (parameter(plant, "encoder.on_drum") > 0 ? 1 : gear));
  if (port == "servo.pulses")
    return way_of(turn, parameter(plant, "servo.pulses.resolution") *
                            parameter(plant, "servo.pulses.gear_denominator") /
                            parameter(plant, "servo.pulses.gear_numerator") * gear);
  return {};
}

/// The same of the terminal that it is wired to.
std::optional<PulseWay> pulse_at(const scenario::Scenario& scene, const std::string& terminal, int edges) {
  for (const auto& wire : scene.wiring) {
    if (wire.terminal.text != terminal) continue;
    const auto dot = wire.plug.text.find('.');
    if (dot == std::string::npos) return {};
    for (const auto& plant : scene.plants)
      if (plant.name.text == wire.plug.text.substr(0, dot))
        return pulse_of(plant, wire.plug.text.substr(dot + 1), edges);
  }
  return {};
}

/// Terminals of a cam's master and slave; nothing where there is not exactly one.
struct CamTerminals {
  std::string master;
  std::string slave;
};
std::optional<CamTerminals> terminals_of(const std::string& text, const char* pattern, bool slave_first) {
  const auto first = found_in(text, pattern, 1);
  const auto second = found_in(text, pattern, 2);
  if (first.size() != 1) return {};
  if (slave_first) return CamTerminals{second.front(), first.front()};
  return CamTerminals{first.front(), second.front()};
}

/// Where the scene's table is synchronous with a drum: the middle of the longest stretch at the web's speed.
std::optional<DesignAxes::Cut> cut_of(const devices::plcopen::CamFile& table, double circumference) {
  constexpr double increment = 1e-7;    // of the master [m]
  constexpr double a_turn = 3'600'000;  // of the slave
  const double slave_unit = circumference / a_turn;
  Problems none;
  const auto study = cams::study_cam(table, {}, none);
  double longest = 0;
  std::optional<DesignAxes::Cut> cut;
  double begin = 0;
  double end = -1;
  for (const auto& piece : study.course.law.pieces) {
    const auto speed = piece.extremes(devices::CamOrder::velocity);
    const auto is_web_speed = [&](double ratio) {
      return std::abs(ratio * slave_unit / increment - 1) < 1e-6;
    };
    if (!is_web_speed(speed.low) || !is_web_speed(speed.high)) continue;
    if (std::abs(piece.master - end) > 1) begin = piece.master;
    end = piece.master + piece.length;
    if (end - begin <= longest) continue;
    longest = end - begin;
    const double slave = piece.end().position - longest / 2 * increment / slave_unit;
    cut = {(begin + end) / 2 * increment, slave * slave_unit};
  }
  return cut;
}

class AxesReader {
 public:
  AxesReader(const scenario::Scenario& scene, const std::string& device, const DesignJob& job,
             Problems& problems)
      : scene_(scene), device_(device), job_(job), problems_(problems) {}

  DesignAxes read(const GivenPulses& given) {
    DesignAxes axes;
    check_machine();
    check_material();
    if (!plays_the_device()) return axes;
    if (device_ == "mc_camin") {
      const auto table =
          job_.kind == DesignKind::rotary_knife ? present_table(scene_, problems_) : std::nullopt;
      if (table) axes.cut = cut_of(*table, job_.slave * job_.blades);
    }
    const auto terminals = terminals_of_device();
    take(axes.master, given.master, terminals ? terminals->master : "", "--master-pulse");
    take(axes.slave, given.slave, terminals ? terminals->slave : "", "--slave-pulse");
    return axes;
  }

 private:
  void refuse(Code code, const char* option, std::string what, std::string remedy) {
    problems_.push_back({code, option, 1, 1, std::move(what), std::move(remedy)});
  }

  /// The device whose cams the scene plays, "" = it plays none.
  std::string device_of_scene() {
    if (const auto* qmove = controllers::controller_of<controllers::QmoveSection>(scene_))
      return found_in(content_of(qmove->configuration, scene_, problems_), R"(^\s*\w+\s+(CAMMING4)\b)")
                     .empty()
                 ? ""
                 : "camming4";
    if (const auto* lx3vp = controllers::controller_of<controllers::Lx3vpSection>(scene_))
      return found_in(content_of(lx3vp->program, scene_, problems_), R"(^\s*(DECAM)\b)").empty() ? ""
                                                                                                 : "lx3vp";
    const auto* plcopen = controllers::controller_of<controllers::PlcopenSection>(scene_);
    return plcopen == nullptr || plcopen->tables.empty() ? "" : "mc_camin";
  }
  bool plays_the_device() {
    const auto plays = device_of_scene();
    if (plays.empty())
      refuse("design.scene"_code, "--scene",
             fmt::format("{} plays no cam: it has no axis of CAMMING4, no DECAM and no table of MC_CamIn",
                         scene_.file.string()),
             "name a scene that has one; drycut new --list tells which lines play a cam");
    else if (plays != device_)
      refuse("design.scene"_code, "--scene", fmt::format("{} does not run {}", scene_.file.string(), device_),
             fmt::format("give --device {}, or another scene", plays));
    return plays == device_;
  }

  [[nodiscard]] int edges() const { return device_ == "camming4" ? 4 : 1; }

  std::optional<CamTerminals> terminals_of_device() {
    if (const auto* qmove = controllers::controller_of<controllers::QmoveSection>(scene_))
      return terminals_of(content_of(qmove->configuration, scene_, problems_),
                          R"(^\s*\w+\s+CAMMING4\s+\S+\s+(\S+)\s+(\S+))", true);
    if (const auto* lx3vp = controllers::controller_of<controllers::Lx3vpSection>(scene_))
      return terminals_of(content_of(lx3vp->program, scene_, problems_),
                          R"(^\s*DECAM\s+(\S+)\s+\S+\s+\S+\s+(\S+))", false);
    return {};
  }

  /// A pulse's way: the scene's, and what is given must be that.
  void take(PulseWay& way, const std::optional<PulseWay>& given, const std::string& terminal,
            const char* option) {
    const auto known = pulse_at(scene_, terminal, edges());
    if (given) way = *given;
    if (!known) {
      // The program counts pulses of the scene's machine.
      if (!given && device_ == "lx3vp")
        refuse("option.missing"_code, option, "it is not given, and the scene does not say what a pulse is",
               fmt::format("such as {}", option == std::string_view("--master-pulse")
                                             ? R"(--master-pulse "0.05 mm")"
                                             : R"(--slave-pulse "600 mm/20000")"));
      return;
    }
    if (!given) way = *known;
    if (given && std::abs(given->metres() / known->metres() - 1) > 1e-9)
      refuse("option.does-not-apply"_code, option,
             fmt::format("{} a pulse; {} has {} at {}", length_text(given->metres()), scene_.file.string(),
                         length_text(known->metres()), terminal),
             "leave it out");
  }

  /// The scene's machine must be the job's.
  void check_machine() {
    if (job_.kind == DesignKind::feed) return;
    const bool knife = job_.kind == DesignKind::rotary_knife;
    const auto has = [&](std::string_view type) {
      return std::any_of(scene_.plants.begin(), scene_.plants.end(),
                         [&](const auto& plant) { return plant.type.text == type; });
    };
    const auto* own = knife ? "rotary_knife" : "flying_saw";
    const auto* other = knife ? "flying_saw" : "rotary_knife";
    if (!has(own) && has(other))
      refuse("design.scene"_code, "--scene",
             fmt::format("{} has a {}, the job is one of a {}", scene_.file.string(), other, own),
             fmt::format("drycut design {}, or another scene", other));
    if (!knife) return;
    const double wanted = job_.slave * job_.blades;
    for (const auto& plant : scene_.plants) {
      const double drum = parameter(plant, "circumference");
      if (drum == 0 || std::abs(drum - wanted) <= 1e-9) continue;
      refuse("design.scene"_code, "--scene",
             fmt::format("{} has a drum of {}, the job one of {}", scene_.file.string(), length_text(drum),
                         length_text(wanted)),
             fmt::format("--circumference \"{}\", or another scene", length_text(drum)));
    }
  }

  void check_material() {
    if (job_.thickness == 0) return;
    for (const auto& plant : scene_.plants) {
      const double thickness = plant.type.text == "web" ? parameter(plant, "thickness") : 0;
      if (thickness == 0 || std::abs(thickness - job_.thickness) <= 1e-9) continue;
      refuse("design.scene"_code, "--thickness",
             fmt::format("{} are not those of {}: {}", length_text(job_.thickness), scene_.file.string(),
                         length_text(thickness)),
             fmt::format("--thickness \"{}\", or another scene", length_text(thickness)));
    }
  }

  const scenario::Scenario& scene_;
  const std::string& device_;
  const DesignJob& job_;
  Problems& problems_;
};

}  // namespace

DesignAxes scene_axes(const scenario::Scenario& scene, const std::string& device, const DesignJob& job,
                      const GivenPulses& given, Problems& problems) {
  return AxesReader(scene, device, job, problems).read(given);
}

}  // namespace drycut::sim::studies
