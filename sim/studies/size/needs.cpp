#include "sim/studies/size/needs.hpp"

#include <fmt/format.h>

#include <limits>
#include <string>

#include "base/units.hpp"

namespace drycut::sim::studies {

std::vector<scenario::Override> without_limits(const SizedDrive& drive) {
  if (!drive.is_servo()) return {};
  std::vector<scenario::Override> overrides;
  const auto set = [&](const std::string& parameter, const char* value) {
    overrides.push_back({drive.path(parameter), value});
  };
  set("servo.peak_torque", "100000 N m");
  set("servo.torque_at_max_speed", "100000 N m");
  set("servo.max_speed", "100000 rpm");
  set("servo.rated_torque", "10000 N m");
  set("servo.stall_torque", "10000 N m");
  // So little current that neither winding, amplifier nor DC link notices.
  set("servo.torque_constant", "1000 N m/A");
  set("servo.amplifier_current", "0 A");
  set("servo.amplifier_peak_current", "0 A");
  for (const auto* current : {"rated", "stall", "peak"}) set(fmt::format("servo.{}_current", current), "0 A");
  set("servo.supply.capacitance", "1000000 uF");
  set("servo.supply.overvoltage", "400 %");
  set("servo.supply.undervoltage", "1 %");
  return overrides;
}

std::array<RatedDrive::Figure, ratings.size()> needs_of(const RatedDrive& unlimited,
                                                        const plants::DriveRatings& rated, bool peaks) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::array<RatedDrive::Figure, ratings.size()> needs;
  needs.fill({none, none});
  const auto need = [&](std::string_view rating, double most) {
    const auto i = rating_index(rating);
    const double value = unlimited.figures.at(i).value;
    needs.at(i) = {value, value / most};
  };
  need("rms torque", rated.continuous(unlimited.rms.first));
  if (!peaks) return needs;
  need("peak torque", rated.peak_torque);
  need("largest speed", rated.max_speed * units::rpm);
  return needs;
}

}  // namespace drycut::sim::studies
