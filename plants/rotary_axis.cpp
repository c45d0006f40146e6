#include "plants/rotary_axis.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/assembly.hpp"
#include "plants/axis_objections.hpp"
#include "plants/friction_rows.hpp"

namespace drycut::plants {

namespace {

constexpr TurningTransducersWords table_words = {
    .on_load = "encoder.on_table",
    .on_load_meaning = "the encoder is on the table, not on the motor",
    .reverse_meaning = "it counts down when the table turns forwards",
    .home_meaning = "angle of the middle of the home target",
    .lines_from = "10000 counts a turn",
    .home_from = "at 0",
    .hysteresis_from = "estimate: proximity switch on 250 mm radius"};

TransmissionData sprung(const RotaryAxisData& data) {
  return with_stiffness(data.gear, data.drive.rotor_inertia(), data.inertia);
}

}  // namespace

RotaryAxis::RotaryAxis(const RotaryAxisData& data, World& world)
    : data_(data),
      world_(world),
      rotor_(world.add_shaft({.name = "rotary axis motor",
                              .inertia = data.drive.rotor_inertia(),
                              .revolutions = data.start / units::turn * data.gear.ratio})),
      table_(world.add_shaft(
          {.name = "rotary axis table", .inertia = data.inertia, .revolutions = data.start / units::turn})),
      drive_(data.drive, world, "rotary axis"),
      gear_(sprung(data)),
      sensors_(data.sensors, rotor_, table_, world.random("rotary axis encoder")) {}

// A pendulum's: none where it hangs down.
double RotaryAxis::weight() const {
  return -data_.unbalance * std::sin(units::turn * table_.part - data_.unbalance_angle);
}

void RotaryAxis::drive(double h) {
  drive_.drive(rotor_, h);
  gear_.drive(rotor_, table_);
  weight_ = data_.unbalance > 0 ? weight() : 0;
  table_.add_torque(weight_ + outer_torque_);
  // Dry friction last: it answers to all other torques.
  DryResistance dry = losses(data_.gear.efficiency, gear_.torque() / data_.gear.ratio);
  dry.forward += drive_.brake_torque();
  dry.backward += drive_.brake_torque();
  rotor_.add_torque(
      friction_effort(data_.motor_friction, rotor_.speed, rotor_.torque, rotor_.inertia, h, dry));
  rubbing_ = friction_effort(data_.friction, table_.speed, table_.torque, table_.inertia, h);
  table_.add_torque(rubbing_);
}

void RotaryAxis::sense(double h) {
  tell_motor_load(h);
  gear_.sense(rotor_, table_, h);
  sensors_.sense(rotor_, table_, h);
  happened_to(drive_, rotor_);
}

void RotaryAxis::visit(StateArchive& archive) { STATE(archive, drive_, gear_, sensors_, outer_torque_); }

Parameters RotaryAxis::live_parameters() { return live_rows(rotary_axis_parameters(data_)); }

void RotaryAxis::parameters_changed() {
  gear_.take(sprung(data_));
  if (table_.inertia != data_.inertia) world_.set_inertia(table_, data_.inertia);
}

std::vector<Port> RotaryAxis::ports() {
  std::vector<Port> ports;
  sensors_.offer_ports(ports, "incremental encoder of the motor, or of the table",
                       "home switch at the table");
  drive_.offer_ports(ports);
  return ports;
}

std::optional<PlugScale> RotaryAxis::scale_of(std::string_view port) const {
  if (port == "encoder") return PlugScale{data_.sensors.counts_per_radian(data_.gear.ratio), true};
  if (port == "servo.reference") return PlugScale{data_.drive.servo.speed_at_10v / data_.gear.ratio, true};
  return {};
}

std::vector<Channel> RotaryAxis::channels() {
  std::vector<Channel> channels = {
      {"angle", "deg", [this] { return table_.part * 360; }, "angle of the table within a turn"},
      {"angle.total", "deg", [this] { return table_.revolutions() * 360; }, "over all turns"},
      {"speed", "rpm", [this] { return table_.speed * units::rpm; }, "speed of the table"},
      {"motor.speed", "rpm", [this] { return rotor_.speed * units::rpm; }, "speed of the motor"},
      {"gear.torque", "N m", [this] { return gear_.torque(); }, "torque of the gear on the table"},
      {"gear.twist", "deg", [this] { return gear_.twist() * units::degrees; },
       "twist between motor and table, at the table"},
  };
  sensors_.offer_channels(channels);
  drive_.offer_channels(channels);
  return channels;
}

std::vector<Setting> RotaryAxis::settings() {
  std::vector<Setting> settings = {{"torque",
                                    "N m",
                                    [this](double v) { outer_torque_ = v; },
                                    [this] { return outer_torque_; },
                                    "torque of the process on the table, positive forwards",
                                    {-1e6, 1e6, false}}};
  drive_.offer_settings(settings);
  return settings;
}

std::vector<Fault> RotaryAxis::faults() {
  std::vector<Fault> faults;
  drive_.offer_faults(faults);
  sensors_.offer_faults(faults);
  return faults;
}

std::vector<EventType> RotaryAxis::event_types() {
  std::vector<EventType> types;
  AxisDrive::offer_events(types);
  return types;
}

std::vector<DriveOfPlant> RotaryAxis::drives() {
  return drive_.drives(data_.inertia / (data_.gear.ratio * data_.gear.ratio), data_.gear.efficiency);
}

MotorLoad RotaryAxis::motor_load(double h) const {
  const double arm = 1 / data_.gear.ratio;
  const double torque = drive_.torque();
  const double turning = rotor_.inertia * (rotor_.speed - rotor_.speed_before) / h;
  const double table = table_.inertia * (table_.speed - table_.speed_before) / h;
  return {.torque = torque,
          .acceleration = turning + table * arm,
          .friction = torque - gear_.torque() * arm - turning - rubbing_ * arm,
          .load = (gear_.torque() + weight_ + rubbing_ - table) * arm,
          .gravity = -weight_ * arm,
          .speed = rotor_.speed};
}

std::vector<Part> RotaryAxis::parts() {
  const bool upright_axis = data_.looks == "table";
  const Pose place = at(data_.place_x, data_.place_y, data_.place_z) * (upright_axis ? upright : Pose{});
  const auto turning = [&](const Shaft& shaft, const Pose& about) -> Frame {
    return [&shaft, about] { return PartPose(about * about_z(units::turn * shaft.part)); };
  };
  // Plate or roller; gear, motor and encoder behind it, under a table.
  Assembly picture;
  picture.on(turning(table_, place));
  picture.rod("table", data_.diameter, data_.width, looks::moving, {});
  picture.box("table mark", {0.04 * data_.diameter, 0.3 * data_.diameter, 0.004}, looks::white,
              at(0, 0.3 * data_.diameter, data_.width / 2 + 0.002));
  const auto behind = [&](double distance) { return place * at(0, 0, -data_.width / 2 - distance); };
  picture.on_floor();
  picture.rod("gearbox", 0.13, 0.12, looks::steel, behind(0.06), "gearbox");
  picture.box("motor", {0.14, 0.14, 0.20}, looks::dark, behind(0.22), "servo_motor");
  picture.on(turning(rotor_, behind(0.33)));
  picture.rod("encoder disc", 0.11, 0.008, looks::brass, {}, "encoder_disc");
  picture.box("encoder mark", {0.008, 0.05, 0.002}, looks::red, at(0, 0.025, -0.005));
  // What carries it, down to the floor, and the home switch beside its edge.
  picture.on_floor();
  const double top = data_.place_y - (upright_axis ? data_.width / 2 + 0.03 : 0);
  for (const double side : {-1.0, 1.0}) {
    const double height = std::max(top - floor_y, 0.05);
    const auto stand = [&](double x, double z) {
      return at(data_.place_x + x, top - height / 2, data_.place_z + z);
    };
    if (upright_axis)
      picture.box(numbered("stand", side), {0.05, height, 0.5 * data_.diameter}, looks::bed,
                  stand(side * 0.3 * data_.diameter, 0));
    else
      picture.box(numbered("stand", side), {0.1, height, 0.05}, looks::bed,
                  stand(0, side * (data_.width / 2 + 0.03)));
  }
  if (upright_axis)
    picture.box("bed", {0.65 * data_.diameter, 0.03, 0.5 * data_.diameter}, looks::bed,
                at(data_.place_x, top + 0.015, data_.place_z));
  const Pose switch_at = place * about_z(data_.sensors.home.centre) * at(0, data_.diameter / 2 + 0.03, 0);
  picture.box("home switch", {0.025, 0.05, 0.025}, looks::dark, switch_at);
  picture.on(turning(table_, place));
  picture.box("home flag", {0.02, 0.02, 0.006}, looks::red,
              at(0, data_.diameter / 2 - 0.01, data_.width / 2 + 0.003));
  return picture.take();
}

Parameters rotary_axis_parameters(RotaryAxisData& data) {
  return joined(
      Parameters{
          live(row("inertia", "kg m2", "of all that turns behind the gear, with what it carries",
                   data.inertia, 1e-6, 1e5, "aluminium plate of 600 mm by 25 mm, and its parts")),
          row("unbalance", "N m", "torque of its weight where that is largest, 0 = balanced, or upright",
              data.unbalance, 0, 1e5, "balanced"),
          row("unbalance_angle", "deg", "angle at which its weight hangs down", data.unbalance_angle, -360,
              360, "at 0"),
          row("start", "deg", "angle at the start; the encoder counts 0 there", data.start, -360, 360,
              "at 0"),
      },
      turning_transducer_parameters(data.sensors, table_words),
      group("motor_friction.", shaft_friction_parameters(data.motor_friction,
                                                         {.dry = "dry friction of the motor",
                                                          .viscous = "viscous friction of the motor",
                                                          .coulomb_from = "estimate: 1 % of rated torque"})),
      group("friction.",
            shaft_friction_parameters(data.friction, {.dry = "dry friction of the table's bearing and seals",
                                                      .viscous = "viscous friction of the table"})),
      axis_drive_parameters(
          data.drive, {.servo = {.inertia_ratio = "the default table behind gear 10: 0.9 / 100 / 0.00468"}}),
      group("gear.", transmission_parameters(data.gear)),
      Parameters{
          row("looks", "picture: table = about an upright axis, roller = about one across the line",
              data.looks, {"table", "roller"}, "an indexing table"),
          row("diameter", "mm", "picture: of table or roller", data.diameter, 10, 1e4, "600 mm"),
          row("width", "mm", "picture: of the table's plate, or of the roller across the line", data.width, 1,
              1e4, "a plate with its parts"),
          row("place.x", "mm", "picture: its middle along the line", data.place_x, -1e5, 1e5, "at the cut"),
          row("place.y", "mm", "picture: height over the web", data.place_y, -900, 1e5, "height of the web"),
          row("place.z", "mm", "picture: across the line, towards the operator", data.place_z, -1e5, 1e5,
              "middle of the line"),
      });
}

std::vector<PlantDefinition::Objection> RotaryAxisDefinition::objections(double h) {
  AxisObjections found("table", h);
  const double inertia = data.drive.rotor_inertia();
  found.gear(data.gear, inertia, data.inertia);
  found.viscous("motor_friction.viscous", data.motor_friction, inertia, "motor");
  found.viscous("friction.viscous", data.friction, data.inertia, "table");
  found.add(turning_transducer_objections(data.sensors));
  found.add(axis_drive_objections(data.drive, inertia, h));
  return found.take();
}

std::unique_ptr<Plant> RotaryAxisDefinition::build(World& world,
                                                   const std::function<Plant*(std::string_view)>&) {
  return std::make_unique<RotaryAxis>(data, world);
}

}  // namespace drycut::plants
