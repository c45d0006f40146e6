#include "plants/holding_brake.hpp"

#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double standstill = 1 / units::rpm;  // up to here it engages at rest [rad/s]

}  // namespace

void HoldingBrake::account(const Shaft& rotor, double h) {
  const bool holds = applied_ > 0;
  if (holds && !held_) {
    last_energy_ = 0;
    if (std::abs(rotor.speed_before) > standstill) ++engagements_;
  }
  held_ = holds;
  // A torque that does not change over the step takes just this out of the rotor.
  const double slipped = applied_ * std::abs(rotor.speed_before + rotor.speed) / 2 * h;
  energy_ += slipped;
  last_energy_ += slipped;
}

void HoldingBrake::offer_channels(std::vector<Channel>& channels) const {
  channels.insert(
      channels.end(),
      {{"brake.engaged", "", [this] { return released() ? 0.0 : 1.0; }, "1 while the brake holds"},
       {"brake.energy", "J", [this] { return energy_; },
        "slip work of the brake since the start: its torque over the angle by which it slipped, heat and "
        "wear "
        "of its linings"},
       {"brake.last_energy", "J", [this] { return last_energy_; },
        "slip work of the last engagement, so far while it lasts"},
       {"brake.engagements", "", [this] { return static_cast<double>(engagements_); },
        "how often the brake engaged at speed, a motor faster than 1 rpm"}});
}

void HoldingBrake::offer_faults(std::vector<Fault>& faults) {
  faults.push_back(fault_state("brake", "stuck_open", stuck_open_, "1: it does not hold any more"));
  faults.push_back(fault_state("brake", "stuck_closed", stuck_closed_, "1: it does not release any more"));
  faults.push_back(
      fault_value("brake", "worn", "", worn_, "this share of its torque is lost", {0, 1, false}));
}

void HoldingBrake::visit(StateArchive& archive) {
  STATE(archive, release, contact_, random_, holds_, stuck_open_, stuck_closed_, worn_, applied_, held_,
        energy_, last_energy_, engagements_);
}

Parameters holding_brake_parameters(HoldingBrakeData& data, std::string_view torque_from) {
  return {
      row("torque", "N m", "what the brake holds on the motor's shaft, 0 = no brake", data.torque, 0, 1e5,
          torque_from),
      row("release_delay", "ms", "from command to released", data.release_delay, 0, 5000,
          "usual: spring-applied brake of 20 N m"),
      row("engage_delay", "ms", "from command to full torque, switched on the DC side", data.engage_delay, 0,
          5000, "usual: spring-applied brake of 20 N m"),
      row("scatter", "ms", "standard deviation of both delays, from time to time", data.scatter, 0, 500,
          "none: set it to see what a placement's tolerance is made of"),
      row("control",
          "released while the drive moves the motor and brake.release is on, or by brake.release alone",
          data.control, {"drive", "output"}, "coil on the motor's terminals or the inverter's relay"),
  };
}

}  // namespace drycut::plants
