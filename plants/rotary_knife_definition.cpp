#include <fmt/format.h>

#include <stdexcept>

#include "base/problem.hpp"
#include "base/units.hpp"
#include "plants/axis_objections.hpp"
#include "plants/friction_rows.hpp"
#include "plants/rotary_knife.hpp"

namespace drycut::plants {

namespace {

constexpr TurningTransducersWords drum_words = {
    .on_load = "encoder.on_drum",
    .on_load_meaning = "the encoder is on the drum, not on the motor",
    .reverse_meaning = "it counts down when the blade moves with the web",
    .home_meaning = "drum angle of the middle of the home target",
    .lines_from = "8192 counts a turn",
    .home_from = "opposite to the cut",
    .hysteresis_from = "estimate: proximity switch on 95 mm radius"};

}  // namespace

Parameters rotary_knife_parameters(RotaryKnifeData& data) {
  return joined(
      Parameters{
          row("web", "the web that it cuts", data.web, "web", "", true),
      },
      station_parameters(data.station),
      Parameters{
          row("circumference", "mm", "circumference of the circle of the blade tips", data.circumference, 50,
              10000, "a usual size: drum of 191 mm"),
          row("blade_count", "blades, evenly on the drum", data.blade_count, 1, 24, "one cut a turn"),
          row("blade_width", "mm", "width of drum and blades across the line", data.blade_width, 1, 10000,
              "a narrow line"),
          row("helix", "deg",
              "angle of the blades to the drum's axis, 0 = straight; the drum stands at that angle to the "
              "web, so "
              "that a blade at web speed cuts square",
              data.helix, 0, 45, "straight blades; usual are 0.5 to 3 deg"),
          live(row("drum_inertia", "kg m2", "inertia of the drum with its blades", data.drum_inertia, 1e-5,
                   1e4, "estimate: solid steel drum, diameter 191 mm, 400 mm wide")),
          row("drum_eccentricity", "mm",
              "the blades' circle lies so far beside the axis, square to blade 1: blades cut off their place",
              data.drum_eccentricity, 0, 100, "ideal: none"),
          row("initial_angle", "deg", "angle of blade 1 at the start, 0 = at the cut", data.initial_angle,
              -360, 360, "blade up, away from the web"),
          row("coupling", "N s/m", "horizontal force between blade and web for their speed mismatch",
              data.coupling, 0, 1e6, "estimate"),
          row("grip", "N", "largest horizontal force between blade and web", data.grip, 0, 1e6,
              "estimate: then the web gives way"),
          row("mismatch_limit", "mm/s", "speed mismatch at which the web tears or buckles",
              data.mismatch_limit, 0.1, 1e5, "estimate: 10 % of 60 m/min"),
      },
      turning_transducer_parameters(data.sensors, drum_words),
      group("motor_friction.", shaft_friction_parameters(data.motor_friction,
                                                         {.dry = "dry friction of the motor",
                                                          .viscous = "viscous friction of the motor",
                                                          .coulomb_from = "estimate: 1 % of rated torque"})),
      group("drum_friction.", shaft_friction_parameters(
                                  data.drum_friction, {.dry = "dry friction of the drum's bearings and seals",
                                                       .viscous = "viscous friction of the drum"})),
      group("counter.", counter_drum_parameters(data.counter)),
      Parameters{
          row("motors",
              "motors of this kind, each with its gear, one on each drum, that share the torque; channels "
              "and verdict are those of one",
              data.motors, 1, 2, "one motor")},
      servo_axis_parameters(data.drive), group("gear.", transmission_parameters(data.gear)));
}

std::vector<PlantDefinition::Objection> RotaryKnifeDefinition::objections(double h) {
  const double motor_inertia = data.drive.servo.rotor_inertia;
  AxisObjections found("drum", h);
  found.gear(data.gear, motor_inertia, data.geared() / data.motors);
  found.viscous("motor_friction.viscous", data.motor_friction, motor_inertia, "motor");
  const Friction friction = geared_friction(data.drum_friction, data.counter);
  const bool more_below = friction.viscous > 2 * data.drum_friction.viscous;
  found.viscous(more_below ? "counter.friction.viscous" : "drum_friction.viscous", friction, data.geared(),
                "drum");
  if (data.counter.cuts() && data.counter.ratio != 1)
    found.object(
        "plant.parameters-contradict"_code, "counter.ratio",
        fmt::format("blades on both drums meet only where both turn alike, not at {:g}", data.counter.ratio),
        "1, or counter.drum: smooth");
  if (data.motors > 1 && data.counter.turns() && data.counter.ratio != 1)
    found.object("plant.parameters-contradict"_code, "motors",
                 fmt::format("the one on the counter drum would have to run {:g} times as fast as the other",
                             data.counter.ratio),
                 "motors: 1, or counter.ratio: 1");
  found.add(servo_axis_objections(data.drive, motor_inertia, h));
  found.add(turning_transducer_objections(data.sensors));
  const double most = data.circumference / units::turn / 20;
  if (data.drum_eccentricity > most)
    found.object("plant.parameters-contradict"_code, "drum_eccentricity",
                 fmt::format("{:g} mm is more than a twentieth of the radius: such a drum cuts nothing",
                             data.drum_eccentricity * units::millimetres),
                 fmt::format("at most {:.3g} mm", most * units::millimetres));
  return found.take();
}

namespace {

// What keeps the knife from cutting this web.
std::vector<PlantDefinition::Objection> objections_to(const WebData& web, const RotaryKnifeData& knife) {
  if (web.cross_section().tube)
    return {{"plant.parameters-contradict"_code, "web",
             fmt::format("a rotary knife cuts no tube, and {} is one", knife.web),
             "a web of 'section: strip', or a flying_saw"}};
  std::vector<PlantDefinition::Objection> found;
  const double radius = knife.circumference / (2 * std::numbers::pi);
  const double pitch = 2 * std::numbers::pi / knife.blade_count;
  const double closing = knife.counter.cuts() ? 2 * radius : radius;
  const double most_lag = web.thickness < radius ? pitch - 2 * engagement_angle(closing, web.thickness) : 0;
  const double lag = helix_lag(radius, knife.helix, web.width);
  if (web.thickness >= radius)
    found.push_back({"plant.parameters-contradict"_code, "circumference",
                     fmt::format("the web of {:g} mm is thicker than the radius of {:g} mm",
                                 web.thickness * 1000, radius * 1000),
                     "a larger circumference or a thinner web"});
  else if (most_lag <= 0)
    found.push_back({"plant.parameters-contradict"_code, "blade_count",
                     fmt::format("with {} blades two are in the web of {:g} mm at once", knife.blade_count,
                                 web.thickness * 1000),
                     "fewer blades, a larger circumference or a thinner web"});
  else if (lag >= most_lag)
    found.push_back(
        {"plant.parameters-contradict"_code, "helix",
         fmt::format(
             "a blade of {:g} deg takes {:.4g} deg of the drum from edge to edge of the web of {:g} mm: {}",
             knife.helix * units::degrees, lag * units::degrees, web.width * 1000,
             knife.blade_count > 1 ? "two are in it at once" : "it never leaves it"),
         fmt::format("less than {:.3g} deg, {}a larger circumference or a narrower web",
                     helix_of_lag(radius, most_lag, web.width) * units::degrees,
                     knife.blade_count > 1 ? "fewer blades, " : "")});
  return found;
}

}  // namespace

std::vector<PlantDefinition::Objection> RotaryKnifeDefinition::objections_with(const FindDefinition& find,
                                                                               double h) {
  const auto* web = dynamic_cast<WebDefinition*>(find(data.web));
  if (web == nullptr) return {};
  AxisObjections found("drum", h);
  found.add(objections_to(web->data, data));
  const double radius = data.circumference / (2 * std::numbers::pi);
  found.add(station_objections(data.station, web->data));
  if (!web->data.strip.on)
    found.damper("coupling", data.coupling, reduced(data.geared() / (radius * radius), web->data.mass),
                 "blade and web");
  return found.take();
}

std::optional<PlantDefinition::Stretch> RotaryKnifeDefinition::stretch() const {
  const double radius = data.circumference / (2 * std::numbers::pi);
  return Stretch{data.station.place - radius, data.station.place + radius};
}

std::unique_ptr<Plant> RotaryKnifeDefinition::build(World& world,
                                                    const std::function<Plant*(std::string_view)>& find) {
  auto& web = referred<Web>(find, "web", data.web, "web");
  for (const Objection& o : objections_to(web.data(), data))
    throw std::invalid_argument(fmt::format("{}: {}; {}", o.parameter, o.what, o.remedy));
  return std::make_unique<RotaryKnife>(data, world, web);
}

}  // namespace drycut::plants
