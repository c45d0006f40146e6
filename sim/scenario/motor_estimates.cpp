#include "sim/scenario/motor_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include "sim/scenario/motor_catalogue.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr double rpm_in_si = std::numbers::pi / 30;

// The field of a motor on the mains.
struct EstimatedField {
  double frequency;  // [Hz]
  double speed;      // [rad/s]
};

// With 2 to 8 poles at 50 or 60 Hz, or at the frequency that is given: the field that turns the least faster
// than the rotor at rated load.
EstimatedField field_above(double rated_speed, double frequency) {
  constexpr int most_pole_pairs = 4;
  EstimatedField nearest{0, std::numeric_limits<double>::infinity()};
  for (const double mains : {50.0, 60.0}) {
    const double each = frequency > 0 ? frequency : mains;
    for (int pairs = 1; pairs <= most_pole_pairs; ++pairs) {
      const double speed = 2 * std::numbers::pi * each / pairs;
      if (speed > rated_speed && speed < nearest.speed) nearest = {each, speed};
    }
  }
  return nearest.frequency > 0 ? nearest : EstimatedField{frequency > 0 ? frequency : 60, 1.05 * rated_speed};
}

}  // namespace

std::vector<std::vector<std::string_view>> needed_values(std::string_view kind) {
  if (kind == motor_kinds[0])
    return {{"rated_torque"},
            {"peak_torque"},
            {"rated_speed"},
            {"rotor_inertia"},
            {"rated_current", "torque_constant"}};
  return {{"rated_torque"}, {"pullout_torque"}, {"rated_speed"}, {"rotor_inertia"}, {"rated_current"}};
}

MotorTable::MotorTable(std::string_view kind) : is_servo_(kind == motor_kinds[0]) {
  rows = is_servo_ ? servo_parameters(servo_) : induction_motor_parameters(induction_motor_);
  rows.push_back(plants::row("rated_power", "kW", "power of the name plate", rated_power_, 1e-3, 1e4, ""));
  if (!is_servo_) return;
  rows.push_back(plants::row("largest_inertia_ratio", "",
                             "load over rotor inertia that its maker recommends or allows at most",
                             largest_inertia_ratio_, 1e-3, 1e4, ""));
}

const plants::Parameter* MotorTable::find(std::string_view name) const {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<std::string> MotorTable::names() const {
  std::vector<std::string> names;
  names.reserve(rows.size());
  for (const auto& row : rows) names.push_back(row.name);
  return names;
}

void MotorTable::set(const std::string& name, double value) {
  const auto* const row = find(name);
  if (row == nullptr || !std::holds_alternative<double*>(row->value)) return;
  *std::get<double*>(row->value) = value;
  given_.insert(name);
}

void MotorTable::estimate(std::string_view name, double value, std::string why) {
  if (given_.contains(name)) return;
  const auto& row = *find(name);
  *std::get<double*>(row.value) = value;
  made_.push_back({row.name, std::move(why)});
}

double MotorTable::rounded(std::string_view name, double value, int digits, bool up) const {
  if (value == 0) return 0;
  const auto unit = find(name)->unit;
  const double number = from_si(value, unit);
  const double scale = std::pow(10, digits - 1 - std::floor(std::log10(std::abs(number))));
  return to_si((up ? std::ceil(number * scale - 1e-9) : std::round(number * scale)) / scale, unit);
}

std::vector<MotorTable::Estimate> MotorTable::estimates() {
  made_.clear();
  if (is_servo_)
    estimate_servo();
  else
    estimate_induction_motor();
  return std::exchange(made_, {});
}

void MotorTable::estimate_servo() {
  auto& motor = servo_;
  if (motor.rated_current > 0)
    estimate("torque_constant", rounded("torque_constant", motor.rated_torque / motor.rated_current),
             "rated torque over rated current");
  estimate("max_speed", motor.rated_speed, "the rated speed: no higher one is known");
  const bool is_flat = motor.max_speed <= motor.rated_speed;
  estimate("torque_at_max_speed", is_flat ? motor.peak_torque : motor.rated_torque,
           is_flat ? "the peak torque, for the highest speed is the rated speed"
                   : "the rated torque: motors of the catalogue have more");
  if (!given_.contains("stall_torque")) motor.stall_torque = 0;
  const auto rest = plants::electrical(motor);
  estimate("stall_torque", rest.stall_torque, "the rated torque: at standstill most motors have more");
  if (plants::has_currents(motor)) {
    if (rest.stall_torque > motor.rated_torque)
      estimate("stall_current", rounded("stall_current", rest.stall_current),
               "in proportion to the rated current");
    estimate("peak_current", rounded("peak_current", rest.peak_current, 3, true),
             "a quarter more than in proportion to the rated current: iron saturates");
  }
  estimate("winding_resistance", rounded("winding_resistance", rest.winding_resistance),
           "6 % of the rated power is lost in it");
  // A rounded torque constant would ask for a little more than the plate's.
  const bool plate = motor.rated_current > 0 && rest.stall_torque <= motor.rated_torque;
  estimate("amplifier_current",
           plate ? motor.rated_current : rounded("amplifier_current", rest.amplifier.current, 3, true),
           "the motor's continuous current: the amplifier is chosen to give it");
  motor.amplifier.peak_current = given_.contains("amplifier_peak_current") ? motor.amplifier.peak_current : 0;
  estimate("amplifier_peak_current",
           rounded("amplifier_peak_current", plants::electrical(motor).amplifier.peak_current, 3, true),
           "the current of the peak torque: the amplifier is chosen to give it");
  estimate("overload_time", 1, "thermal relays of amplifiers stand their peak current longer");
  estimate_heat(20);
}

void MotorTable::estimate_induction_motor() {
  auto& motor = induction_motor_;
  auto& winding = motor.winding;
  if (given_.contains("synchronous_speed")) {
    const double turns = winding.synchronous_speed / rpm_in_si;
    const bool at_50 = std::abs(std::remainder(3000, turns)) < 1e-6 * turns;
    estimate("rated_frequency", at_50 ? 50 : 60, "the mains of that field's speed");
  } else {
    const auto field =
        field_above(winding.rated_speed, given_.contains("rated_frequency") ? motor.rated_frequency : 0);
    estimate("rated_frequency", field.frequency, "the mains with the least slip at rated speed");
    estimate("synchronous_speed", rounded("synchronous_speed", field.speed, 6),
             "the next speed of a field above rated speed, of 2 to 8 poles");
  }
  estimate("max_speed", rounded("max_speed", 1.2 * winding.synchronous_speed, 6),
           "1.2 times the field's speed, which every motor is tested at (IEC 60034-1)");
  const auto rest = plants::electrical(motor);
  estimate("no_load_current", rounded("no_load_current", rest.no_load_current), "half the rated current");
  estimate("stator_resistance", rounded("stator_resistance", rest.stator_resistance),
           "7 % of the rated power is lost in it");
  estimate_heat(30);
}

void MotorTable::estimate_heat(double winding_time_constant) {
  const auto* const sooner = "shorter than of any motor of the catalogue: it warms sooner";
  estimate("winding_time_constant", winding_time_constant, sooner);
  estimate("housing_time_constant", 600, sooner);
  estimate("temperature_rise", 105, "thermal class F, used up at an ambient of 40 degC");
  estimate("temperature_limit", 428.15, "thermal class F");
}

}  // namespace drycut::sim::scenario
