#include "plants/power_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/state_archive.hpp"

namespace drycut::plants {

namespace {

double squared(double x) { return x * x; }

}  // namespace

DcLink::DcLink(const SupplyData& data)
    : data_(data),
      nominal_(data.capacitance * squared(data.voltage)),  // half the capacitance times the peak squared
      brake_on_(nominal_ * squared(data.brake_voltage)),
      brake_off_(nominal_ * squared(data.brake_voltage - data.brake_hysteresis)),
      over_(nominal_ * squared(data.overvoltage)),
      under_(nominal_ * squared(data.undervoltage)),
      energy_(nominal_) {}

double DcLink::rectified(double time) const {
  if (outage_) return 0;
  const double peak = nominal_ * squared(1 - dip_);
  return phase_lost_ ? peak * squared(std::sin(2 * std::numbers::pi * data_.frequency * time)) : peak;
}

void DcLink::carry(double energy, double seconds) {
  time_ += seconds;
  if (energy_ > brake_on_)
    braking_ = data_.resistor > 0 && load_ < 1;
  else if (energy_ < brake_off_ || load_ >= 1)
    braking_ = false;
  const double burnt =
      braking_ ? -energy_ * std::expm1(-2 * seconds / (data_.resistor * data_.capacitance)) : 0;
  energy_ = std::max(0.0, energy_ - energy - burnt);
  const double fed = std::max(0.0, rectified(time_) - energy_);
  energy_ += fed;
  mains_ += fed;
  burnt_ += burnt;
  mains_power_ = fed / seconds;
  resistor_power_ = burnt / seconds;
  load_ += (resistor_power_ / data_.resistor_power - load_) * seconds / data_.resistor_time_constant;
}

double DcLink::voltage() const { return std::sqrt(2 * energy_ / data_.capacitance); }

double DcLink::speed_share() const { return energy_ < nominal_ ? std::sqrt(energy_ / nominal_) : 1; }

double DcLink::resistor_temperature() const { return MotorHeat::ambient + load_ * data_.resistor_rise; }

bool DcLink::mains_well() const { return !outage_ && !phase_lost_ && dip_ <= 0.15; }

void DcLink::offer_faults(std::vector<Fault>& faults) {
  faults.push_back(
      fault_value("mains", "dip", "%", dip_, "so much of the mains' voltage is missing", in_percent, 0.6));
  faults.push_back(fault_state("mains", "phase_lost", phase_lost_, "1: two phases of the mains are left"));
  faults.push_back(fault_state("mains", "outage", outage_, "1: the mains are gone"));
}

void DcLink::visit(StateArchive& archive) {
  STATE(archive, energy_, mains_, burnt_, mains_power_, resistor_power_, load_, time_, braking_, dip_,
        phase_lost_, outage_);
}

Parameters supply_parameters(SupplyData& data) {
  return {
      row("voltage", "V", "of the mains between two phases, rms", data.voltage, 50, 1000,
          "class of the drive"),
      row("frequency", "Hz", "of the mains", data.frequency, 10, 400, "Europe"),
      row("capacitance", "uF", "of the DC link", data.capacitance, 10, 1e6, "estimate: usual in the class"),
      row("brake_voltage", "%", "of the rectified mains: the brake resistor is switched on",
          data.brake_voltage, 105, 300, "estimate: 370 V of 283 V, 735 V of 566 V"),
      row("brake_hysteresis", "%", "the brake resistor is switched off so far below", data.brake_hysteresis,
          0.1, 50, "estimate"),
      row("overvoltage", "%", "of the rectified mains: the drive trips", data.overvoltage, 106, 400,
          "estimate: 410 V of 283 V, 820 V of 566 V"),
      row("undervoltage", "%", "of the rectified mains: the drive trips", data.undervoltage, 1, 99,
          "estimate: 200 V of 283 V, 400 V of 566 V"),
      row("resistor", "ohm", "brake resistor, 0 = none", data.resistor, 0, 1e4,
          "estimate: built-in resistor of the 2 kW class"),
      row("resistor_power", "W", "continuous power of the brake resistor", data.resistor_power, 0.1, 1e6,
          "estimate: built-in resistor of the 2 kW class"),
      row("resistor_time_constant", "s", "thermal time constant of the brake resistor",
          data.resistor_time_constant, 0.1, 1e5, "estimate"),
      row("resistor_rise", "K", "of the brake resistor over ambient at resistor_power", data.resistor_rise, 1,
          1000, "estimate: wire-wound in aluminium"),
  };
}

}  // namespace drycut::plants
