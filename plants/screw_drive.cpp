#include "plants/screw_drive.hpp"

#include <cmath>
#include <utility>

#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

SlideDefinition started(SlideDefinition part, double position) {
  part.position = position;
  return part;
}

}  // namespace

double motor_inertia(const ScrewDriveData& data, double rotor_inertia) {
  return rotor_inertia + data.screw_inertia / (data.gear.ratio * data.gear.ratio);
}

double reflected_inertia(const ScrewDriveData& data) {
  const double metre_per_radian = data.lead / units::turn;
  return data.mass * metre_per_radian * metre_per_radian;
}

double load_inertia(const ScrewDriveData& data) {
  return (data.screw_inertia + reflected_inertia(data)) / (data.gear.ratio * data.gear.ratio);
}

ScrewDrive::ScrewDrive(const ScrewDriveData& data, const std::string& name, double rotor_inertia,
                       SlideDefinition part, World& world, double twist)
    : rotor(world.add_shaft({.name = name + " motor",
                             .inertia = motor_inertia(data, rotor_inertia),
                             .revolutions = data.start / data.lead * data.gear.ratio})),
      slide(world.add_slide(started(std::move(part), data.start))),
      stops{EndStop(data.stop, data.travel_min, -1), EndStop(data.stop, data.travel_max, 1)},
      sensors(data.sensors, data.start, rotor.revolutions(), world.random(name + " encoder"),
              world.random(name + " scale")),
      data_(data),
      screw_per_metre_(units::turn / data.lead),
      twist_(twist) {}

double ScrewDrive::rate() const { return rotor.speed / data_.gear.ratio - slide.speed * screw_per_metre_; }

void ScrewDrive::transmit() {
  torque_ = transmission_torque(data_.gear, twist_, rate());
  force_ = torque_ * screw_per_metre_;
  rotor.add_torque(-torque_ / data_.gear.ratio);
  slide.add_force(force_);
}

void ScrewDrive::push_back(double h) {
  for (EndStop& stop : stops) stop.drive(slide, h);
}

void ScrewDrive::rub(double h, const DryResistance& on_rotor, double weight) {
  rotor.add_torque(
      friction_effort(data_.motor_friction, rotor.speed, rotor.torque, rotor.inertia, h, on_rotor));
  rubbing_ = friction_effort(data_.guide_friction, slide.speed, slide.force + weight, slide.mass, h);
  slide.add_force(rubbing_);
}

void ScrewDrive::sense(double h) {
  // Summed up from the speeds, as Transmission does: a difference of two long ways would lose its digits.
  twist_ += rate() * h;
  sensors.sense(rotor, slide, h);
}

MotorLoad ScrewDrive::motor_load(double torque, double weight, double h) const {
  const double arm = 1 / (screw_per_metre_ * data_.gear.ratio);  // of the part at the motor [m]
  const double turning = rotor.inertia * (rotor.speed - rotor.speed_before) / h;
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
  data_ = data;
  if (slide.mass != mass) world.set_mass(slide, mass);
}

double ScrewDrive::screw_turn() const {
  return units::turn * std::fmod(rotor.revolutions() / data_.gear.ratio, 1.0);
}

void ScrewDrive::visit(StateArchive& archive) { STATE(archive, stops, sensors, twist_, torque_, force_); }

}  // namespace drycut::plants
