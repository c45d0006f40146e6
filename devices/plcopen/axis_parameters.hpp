#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace drycut {
class StateArchive;
}

namespace drycut::devices::plcopen {

/// Increments (0.1 um or 0.0001 deg) in the kernel's other units: speeds are given in um/s or 0.001 deg/s,
/// accelerations and jerks in mm/s2, mm/s3 or deg/s2, deg/s3.
inline constexpr double increments_per_speed = 10;
inline constexpr double increments_per_acceleration = 10'000;

/// What an axis is made of.
enum class AxisKind : int {
  drive = 0,         ///< a servo with +-10 V reference and an encoder
  virtual_axis = 1,  ///< setpoints only
  encoder = 2,       ///< an encoder only: a master that follows the machine
};

/// The axis machine data as far as a cam application needs them, in the units of axis_parameter_table.
struct AxisParameters {
  AxisKind kind = AxisKind::drive;
  double modulo = 3'600'000;
  double vb_max = 1'000'000;
  double a_max = 10'000;
  double tr_min = 50'000;
  double tr_max = 1'000'000;
  double a_grenz_stufe_1 = 20'000;
  double swe_neg = 0;
  double swe_pos = 0;
  double window = 1'000;
  double path_increments = 3'600'000;
  double path_counts = 10'000;
  bool homed_at_start = false;
  double v_at_10v = 1'000'000;
  double kv = 2'000;
  double feed_forward = 1'000;
  double following_error_max = 0;

  bool is_master = false;
  double v_diff_percent = 100;
  double time_in_window = 8'000;
  double time_out_in_window = 1'000'000;
  bool timeout_from_execute = false;
  bool average_filter = false;
  double filter_cycles = 10;
  double delay_time = 0;
  double v_max_slave = 0;
  double a_max_slave = 0;
  double v_phasing = 1;
  double a_phasing = 1;
  double d_phasing = 1;
  double j_phasing = 10;
  double j_vel_sync = 1'000;
  bool keep_coupling_on_lr_error = false;
  bool keep_coupling_on_fe_drop = false;

  /// They can be written while it runs.
  void visit(StateArchive& archive);
};

/// One parameter of an axis: its face to programs, scenarios and `drycut devices`.
struct AxisParameter {
  std::string_view name;
  std::string_view number;  ///< "P-AXIS-00289"; "" for a parameter of ours
  std::string_view unit;
  double min = 0;
  double max = 0;
  bool whole = false;
  std::variant<double AxisParameters::*, bool AxisParameters::*, AxisKind AxisParameters::*> member;
  std::string_view meaning;

  /// A switch as 0 or 1, the kind by its number.
  [[nodiscard]] double value(const AxisParameters& of) const {
    return std::visit([&](auto place) { return static_cast<double>(of.*place); }, member);
  }
  [[nodiscard]] bool is_switch() const { return std::holds_alternative<bool AxisParameters::*>(member); }
  template <typename Value>
  [[nodiscard]] bool is(Value AxisParameters::*other) const {
    const auto* own = std::get_if<Value AxisParameters::*>(&member);
    return own != nullptr && *own == other;
  }
};

/// What an axis measures: its units for people are mm or deg.
enum class Measure : std::uint8_t { length, angle };
/// Of "um/s, 0.001 deg/s" the unit that goes with `measure`.
std::string_view unit_of(const AxisParameter& parameter, Measure measure);

/// An axis as the machine data describe it.
struct AxisConfiguration {
  std::string name;
  AxisParameters parameters;
  Measure measure = Measure::angle;
};

/// All parameters; the default is what AxisParameters{} holds.
std::span<const AxisParameter> axis_parameter_table();
/// By name, nullptr if there is none.
const AxisParameter* find_axis_parameter(std::string_view name);
/// Sets it; false, and nothing changes, if the value is outside the range or must be whole and is not.
bool set_parameter(AxisParameters& parameters, const AxisParameter& parameter, double value);

}  // namespace drycut::devices::plcopen
