#include "plants/screw_drive.hpp"

#include <cmath>
#include <utility>

#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

double screw_per_metre(const ScrewDriveData& data) { return units::turn / data.lead; }

SlideDefinition started(SlideDefinition part, double position, double with_part) {
  part.position = position;
  part.mass += with_part;
  return part;
}

/// The screw's inertia, where it moves with the part [kg].
double moved_with_part(const ScrewDriveData& data) {
  return data.nut_rigid ? data.screw_inertia * screw_per_metre(data) * screw_per_metre(data) : 0;
}

bool is_own_body(const ScrewDriveData& data) { return data.nut_stiffness > 0; }

}  // namespace

double motor_inertia(const ScrewDriveData& data, double rotor_inertia) {
  if (data.nut_rigid || is_own_body(data)) return rotor_inertia;
  return rotor_inertia + data.screw_inertia / (data.gear.ratio * data.gear.ratio);
}

double reflected_inertia(const ScrewDriveData& data) {
  const double metre_per_radian = data.lead / units::turn;
  return data.mass * metre_per_radian * metre_per_radian;
}

double behind_gear(const ScrewDriveData& data) {
  return reflected_inertia(data) + (is_own_body(data) || data.nut_rigid ? data.screw_inertia : 0);
}

double on_gear(const ScrewDriveData& data) {
  return is_own_body(data) ? data.screw_inertia : behind_gear(data);
}

double load_inertia(const ScrewDriveData& data) {
  return (data.screw_inertia + reflected_inertia(data)) / (data.gear.ratio * data.gear.ratio);
}

Efficiency efficiency(const ScrewDriveData& data) { return in_series(data.gear.efficiency, data.efficiency); }

Parameters screw_parameters(ScrewDriveData& data, std::string_view moved_by_from) {
  return joined(
      Parameters{
          row("nut.rigid",
              "the screw (pulley, pinion) turns with the part, for gear.stiffness is that of coupling and "
              "gear alone",
              data.nut_rigid, "the screw turns with the motor, for gear.stiffness is that of the nut"),
          row("nut.stiffness", "N/m",
              "of nut and bearings along the screw, beside gear.stiffness of the coupling: the screw is a "
              "body of its own; 0 = it turns with the motor, or with the part (nut.rigid)",
              data.nut_stiffness, 0, 1e10, "in gear.stiffness"),
          row("nut.damping", "N s/m", "of the same", data.nut_damping, 0, 1e8, "none"),
          preset_row("moved_by",
                     "what turns the motor's turns into travel, whose efficiency and back_efficiency are "
                     "the defaults",
                     data.moved_by, slide_types(), moved_by_from)},
      efficiency_parameters(data.efficiency, "moved_by"));
}

Parameters guide_coefficient_parameters(ScrewDriveData& data) {
  return {row("coefficient", "",
              "of friction, for dry friction besides that grows with the weight on the guides",
              data.guide_coefficient, 0, 2, "none: usual are 0.003 of rolling, 0.05 to 0.2 of plain guides")};
}

ScrewDrive::ScrewDrive(const ScrewDriveData& data, const std::string& name, double rotor_inertia,
                       SlideDefinition part, World& world, double held)
    : rotor(world.add_shaft({.name = name + " motor",
                             .inertia = motor_inertia(data, rotor_inertia),
                             .revolutions = data.start / data.lead * data.gear.ratio})),
      slide(world.add_slide(started(part, data.start, moved_with_part(data)))),
      stops{EndStop(data.stop, data.travel_min, -1), EndStop(data.stop, data.travel_max, 1)},
      sensors(data.sensors, data.start, rotor.revolutions(), world.random(name + " encoder"),
              world.random(name + " scale")),
      rotor_inertia_(rotor_inertia),
      screw_per_metre_(screw_per_metre(data)),
      with_part_(moved_with_part(data)),
      lift_(part.gravity ? with_part_ * units::gravity * part.axis[1] : 0) {
  if (is_own_body(data))
    screw_ = &world.add_shaft(
        {.name = name + " screw", .inertia = data.screw_inertia, .revolutions = data.start / data.lead});
  take_data(data, part.mass);
  twist_ = held * data.lead / units::turn / data_.gear.stiffness;
  if (held != 0) twist_ += std::copysign(data_.gear.backlash / 2, twist_);
  if (screw_ != nullptr) stretch_ = held / data_.nut_stiffness;
}

void ScrewDrive::take_data(const ScrewDriveData& data, double mass) {
  data_ = data;
  // One that is not known is by all that it moves.
  data_.gear =
      with_stiffness(data.gear, plants::motor_inertia(data, rotor_inertia_), plants::behind_gear(data));
  before_screw_ = screw_ != nullptr ? data.gear.efficiency : efficiency(data);
  guide_friction_ = data.guide_friction;
  guide_friction_.coulomb += data.guide_coefficient * data.guide_weight * mass * units::gravity;
}

// Of the gear's twist, seen at the screw.
double ScrewDrive::rate() const {
  return rotor.speed / data_.gear.ratio -
         (screw_ != nullptr ? screw_->speed : slide.speed * screw_per_metre_);
}
double ScrewDrive::nut_rate() const { return screw_->speed / screw_per_metre_ - slide.speed; }

void ScrewDrive::transmit() {
  torque_ = transmission_torque(data_.gear, twist_, rate());
  rotor.add_torque(-torque_ / data_.gear.ratio);
  if (screw_ == nullptr) {
    force_ = torque_ * screw_per_metre_;
  } else {
    force_ = data_.nut_stiffness * stretch_ + data_.nut_damping * nut_rate();
    screw_->add_torque(torque_ - force_ / screw_per_metre_);
  }
  slide.add_force(force_);
}

void ScrewDrive::push_back(double h) {
  for (EndStop& stop : stops) stop.drive(slide, h);
}

void ScrewDrive::rub(double h, const DryResistance& on_rotor, double weight) {
  DryResistance dry = losses(before_screw_, torque_ / data_.gear.ratio);
  dry.forward += on_rotor.forward;
  dry.backward += on_rotor.backward;
  rotor.add_torque(friction_effort(data_.motor_friction, rotor.speed, rotor.torque, rotor.inertia, h, dry));
  if (screw_ != nullptr)
    screw_->add_torque(friction_effort({}, screw_->speed, screw_->torque, screw_->inertia, h,
                                       losses(data_.efficiency, force_ / screw_per_metre_)));
  rubbing_ = friction_effort(guide_friction_, slide.speed, slide.force + weight, slide.mass, h);
  slide.add_force(rubbing_ + lift_);
}

void ScrewDrive::sense(double h) {
  // Summed up from the speeds, as Transmission does: a difference of two long ways would lose its digits.
  twist_ += rate() * h;
  if (screw_ != nullptr) stretch_ += nut_rate() * h;
  sensors.sense(rotor, slide, h);
}

MotorLoad ScrewDrive::motor_load(double torque, double weight, double h) const {
  const double arm = 1 / (screw_per_metre_ * data_.gear.ratio);  // of the part at the motor [m]
  double turning = rotor.inertia * (rotor.speed - rotor.speed_before) / h;
  if (screw_ != nullptr)
    turning += screw_->inertia * (screw_->speed - screw_->speed_before) / h / data_.gear.ratio;
  const double moving = slide.mass * (slide.speed - slide.speed_before) / h;
  const double resisting = force_ + weight - moving;
  return {.torque = torque,
          .acceleration = turning + moving * arm,
          .friction = torque - force_ * arm - turning - rubbing_ * arm,
          .load = (resisting + rubbing_) * arm,
          .gravity = -weight * arm,
          .speed = rotor.speed};
}

void ScrewDrive::take(const ScrewDriveData& data, double mass, World& world) {
  take_data(data, mass);
  if (slide.mass != mass + with_part_) world.set_mass(slide, mass + with_part_);
}

double ScrewDrive::screw_turn() const {
  return units::turn * std::fmod(rotor.revolutions() / data_.gear.ratio, 1.0);
}

void ScrewDrive::visit(StateArchive& archive) {
  STATE(archive, stops, sensors, twist_, stretch_, torque_, force_);
}

}  // namespace drycut::plants
