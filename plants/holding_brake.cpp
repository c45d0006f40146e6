#include "plants/holding_brake.hpp"

#include <algorithm>

namespace drycut::plants {

void HoldingBrake::offer_faults(std::vector<Fault>& faults) {
  faults.push_back({"brake", "stuck_open", "", [this](double v) { stuck_open_ = v != 0; },
                    "1: it does not hold any more"});
  faults.push_back({"brake", "stuck_closed", "", [this](double v) { stuck_closed_ = v != 0; },
                    "1: it does not release any more"});
  faults.push_back({"brake",
                    "worn",
                    "",
                    [this](double v) { worn_ = v; },
                    "this share of its torque is lost",
                    {0, 1, false}});
}

Parameters holding_brake_parameters(HoldingBrakeData& data, const std::string& prefix) {
  const auto row = [&](const char* name, std::string_view unit, std::string_view meaning, double& value,
                       double min, double max, std::string_view source) {
    return Parameter{prefix + name, unit, meaning, &value, min, max, {}, {}, source};
  };
  return {
      row("torque", "N m", "what the brake holds on the motor's shaft, 0 = no brake", data.torque, 0, 1e5,
          "none"),
      row("release_delay", "ms", "from command to released", data.release_delay, 0, 5000,
          "usual: spring-applied brake of 20 N m"),
      row("engage_delay", "ms", "from command to full torque, switched on the DC side", data.engage_delay, 0,
          5000, "usual: spring-applied brake of 20 N m"),
      {.name = prefix + "control",
       .unit = "",
       .meaning =
           "released while the drive moves the motor and brake.release is on, or by brake.release alone",
       .value = &data.control,
       .choices = {"drive", "output"},
       .source = "coil on the motor's terminals or the inverter's relay"},
  };
}

}  // namespace drycut::plants
