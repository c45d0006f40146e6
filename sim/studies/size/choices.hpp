#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/motor_catalogue.hpp"
#include "sim/studies/sweep/axis.hpp"
#include "sim/studies/sweep/point.hpp"

namespace drycut::sim::studies {

/// The drive of a scenario whose motor is sought.
struct SizedDrive {
  std::string plant;  ///< "knife"
  std::string name;   ///< "servo"; "drive" behind an inverter or contactors
  std::string kind;   ///< of its motor: "servo", "induction_motor"

  [[nodiscard]] std::string full_name() const { return plant + "." + name; }
  /// As an override names a parameter of its plant: "plants.knife.gear.ratio".
  [[nodiscard]] std::string path(const std::string& parameter) const {
    return "plants." + plant + "." + parameter;
  }
  [[nodiscard]] bool is_servo() const { return kind == scenario::motor_kinds[0]; }
  /// The group of its mains and brake resistor: "servo.supply.".
  [[nodiscard]] std::string supply() const { return is_servo() ? "servo.supply." : "inverter.supply."; }
};

/// The plant that it belongs to.
const scenario::PlantEntry& plant_of(const SizedDrive& drive, const scenario::Scenario& scenario);
/// A number of a plant's table in SI; nothing if there is none of that name.
std::optional<double> number_in(const scenario::PlantEntry& plant, std::string_view parameter);
/// A word of it; "" if there is none.
std::string word_in(const scenario::PlantEntry& plant, std::string_view parameter);

struct BrakeResistor {
  std::string text;             ///< as given, with its unit: "13 ohm 100 W", "none"
  std::optional<double> ohm;    ///< absent: as the scenario has it; 0 = none
  std::optional<double> power;  ///< that it bears for ever [W]
};

/// Load over rotor inertia up to which a motor is taken whose sheet says nothing of it.
inline constexpr double usual_inertia_ratio = 10;

/// What is tried in place of what the scenario has.
struct SizeChoices {
  SizedDrive drive;
  std::vector<scenario::MotorModel> motors;
  bool all_motors = false;  ///< of the catalogue
  SweepAxes gears;          ///< none: the gear stays; else one axis
  /// Of gear_types(), whose efficiency goes with it: of each value, or one for all; "" = as the scenario has
  /// it.
  std::vector<std::string> gear_kinds = {};
  [[nodiscard]] bool has_gear_kinds() const {
    return std::ranges::any_of(gear_kinds, [](const auto& kind) { return !kind.empty(); });
  }
  /// The kind of value `i` of the gears.
  [[nodiscard]] std::string gear_kind(std::size_t i) const {
    if (gear_kinds.empty()) return "";
    return gear_kinds.size() == 1 ? gear_kinds.front() : gear_kinds.at(i);
  }
  bool gear_is_tied =
      false;  ///< the axis is another value of the scenario, which ties to it what goes with it
  std::vector<BrakeResistor> resistors;  ///< none: it stays
  /// Load over rotor inertia; a candidate with more is ruled out. Infinity: any. None: what its maker says,
  /// else the usual one.
  std::optional<double> most_inertia_ratio;
  std::vector<Finding> notes = {};  ///< on gears that cannot be tried as the machine is: candidates_of()
};

struct SizeTexts {
  std::string drive;          ///< "knife.servo"; "" = the only one
  std::string motors;         ///< "all", "HG-SR202,HG-SR3*"
  std::string gears;          ///< "5..20:16", "5 planetary, 20 worm", "variables.gear=5,7,10"; "" = as it is
  std::string resistors;      ///< "100,200 W", "13 ohm 100 W, none"; "" = as it is
  std::string inertia_ratio;  ///< "15", "off"; "" = the maker's, else the usual one
};

/// Reads what is to be tried on `scenario`, which is that of the question. Gears are read and not tried yet.
/// What is wrong goes to `problems`, by the option's name.
SizeChoices read_choices(const SizeTexts& texts, const PointQuestion& question,
                         const scenario::Scenario& scenario, Problems& problems);

}  // namespace drycut::sim::studies
