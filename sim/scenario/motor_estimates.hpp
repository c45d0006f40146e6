#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "plants/induction_motor.hpp"
#include "plants/plant.hpp"
#include "plants/servo_drive.hpp"

namespace drycut::sim::scenario {

/// The values that a motor of a kind ("servo", "induction_motor") must have from its sheet, each with those
/// that do in its place. They are five.
std::vector<std::vector<std::string_view>> needed_values(std::string_view kind);

/// The values of one motor: the rows of its group, and what only its sheet has (rated_power, a servo's
/// largest_inertia_ratio).
class MotorTable {
 public:
  explicit MotorTable(std::string_view kind);
  MotorTable(const MotorTable&) = delete;
  MotorTable& operator=(const MotorTable&) = delete;

  plants::Parameters rows;  ///< bound to this table

  [[nodiscard]] const plants::Parameter* find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  /// A value from the sheet [SI].
  void set(const std::string& name, double value);

  struct Estimate {
    std::string parameter;
    std::string why;
  };
  /// Fills in what was not set, on the safe side: no more speed, torque or current than the sheet's values
  /// vouch for, and windings that warm sooner than those of known motors. What was set must have all that
  /// needed_values() names.
  std::vector<Estimate> estimates();

 private:
  void estimate_servo();
  void estimate_induction_motor();
  /// What all motors have: heat.
  void estimate_heat(double winding_time_constant);
  /// Sets a value that was not given.
  void estimate(std::string_view name, double value, std::string why);
  /// A value [SI] to some digits in its parameter's unit; `up`: no smaller.
  [[nodiscard]] double rounded(std::string_view name, double value, int digits = 3, bool up = false) const;

  bool is_servo_;
  plants::ServoData servo_;
  plants::InductionMotorData induction_motor_;
  double rated_power_ = 0;            // [W]
  double largest_inertia_ratio_ = 0;  // of a servo
  std::set<std::string, std::less<>> given_;
  std::vector<Estimate> made_;
};

}  // namespace drycut::sim::scenario
