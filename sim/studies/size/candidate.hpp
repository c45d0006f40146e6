#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "plants/power_stage.hpp"
#include "sim/studies/size/choices.hpp"

namespace drycut::sim::studies {

/// A motor with its drive, a gear and a brake resistor, and how they are set up in the scenario.
struct Candidate {
  std::string motor;
  std::string values;         ///< how far its values can be trusted: MotorModel::standing()
  double rated_power = 0;     ///< [W]
  std::string gear;           ///< as given; "" = as it is
  std::string gear_kind;      ///< as given; "" = as it is
  double ratio = 0;           ///< of the gear; 0: the plant has none
  BrakeResistor resistor;     ///< text "" = as it is
  double resistor_power = 0;  ///< [W], 0 = none
  /// Share of the bus voltage's way to its limit up to which the brake resistor holds it; 0 without one.
  double braked_share = 0;
  plants::DriveRatings ratings;
  double inertia_ratio = 0;                                             ///< load over rotor
  double most_inertia_ratio = std::numeric_limits<double>::infinity();  ///< that is taken
  enum class LimitFrom { nobody, option, maker, usage } limit_from = LimitFrom::nobody;
  [[nodiscard]] bool is_too_heavy() const { return inertia_ratio > most_inertia_ratio; }
  std::vector<scenario::Override> overrides;
  std::string unfit;  ///< why it cannot be set up at all; "" = it can be run
};

/// "HG-SR202, gear 7, 13 ohm 100 W": without what stays as it is.
std::string name_of(const Candidate& candidate);

/// All of them: motors, of each its gears, of each its resistors. So that it is the same machine for the
/// controller: a gear takes along the speed at 10 V or the electronic gear and, if the controller counts an
/// encoder on the motor, its lines (a gear to which no whole number of lines belongs cannot be set up). A
/// gear of a kind takes along its efficiency. A gear that the scenario ties takes along what the scenario
/// says; what to do about gears that cannot be set up goes to the notes of the choices. The inertia ratio set
/// in a servo amplifier follows the machine's, so that the speed loop stays as quick as the scenario has it.
/// Choices that no scenario takes are told in `problems`.
std::vector<Candidate> candidates_of(SizeChoices& choices, const PointQuestion& question,
                                     const scenario::Scenario& scenario, Problems& problems);

}  // namespace drycut::sim::studies
