#include "plants/holding_brake.hpp"

#include <algorithm>

namespace drycut::plants {

void HoldingBrake::offer_faults(std::vector<Fault>& faults) {
  faults.push_back(fault_state("brake", "stuck_open", stuck_open_, "1: it does not hold any more"));
  faults.push_back(fault_state("brake", "stuck_closed", stuck_closed_, "1: it does not release any more"));
  faults.push_back(
      fault_value("brake", "worn", "", worn_, "this share of its torque is lost", {0, 1, false}));
}

Parameters holding_brake_parameters(HoldingBrakeData& data, std::string_view torque_from) {
  return {
      row("torque", "N m", "what the brake holds on the motor's shaft, 0 = no brake", data.torque, 0, 1e5,
          torque_from),
      row("release_delay", "ms", "from command to released", data.release_delay, 0, 5000,
          "usual: spring-applied brake of 20 N m"),
      row("engage_delay", "ms", "from command to full torque, switched on the DC side", data.engage_delay, 0,
          5000, "usual: spring-applied brake of 20 N m"),
      row("control",
          "released while the drive moves the motor and brake.release is on, or by brake.release alone",
          data.control, {"drive", "output"}, "coil on the motor's terminals or the inverter's relay"),
  };
}

}  // namespace drycut::plants
