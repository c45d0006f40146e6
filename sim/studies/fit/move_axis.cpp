#include "sim/studies/fit/move_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.hpp"
#include "sim/studies/fit/machine.hpp"

namespace drycut::sim::studies {

namespace {

/// The rows of one plant, by name.
class PlantRows {
 public:
  PlantRows(scenario::Scenario& scenario, const std::string& plant) {
    const auto entry =
        std::ranges::find(scenario.plants, plant, [](const auto& one) { return one.name.text; });
    rows_ = entry->definition->parameters();
  }

  [[nodiscard]] const plants::Parameter* find(const std::string& name) const {
    const auto row = std::ranges::find(rows_, name, &plants::Parameter::name);
    return row == rows_.end() ? nullptr : &*row;
  }

  /// A quantity or number [SI].
  [[nodiscard]] std::optional<double> number(const std::string& name) const {
    const auto* row = find(name);
    if (row == nullptr) return {};
    if (const auto* const* quantity = std::get_if<double*>(&row->value)) return **quantity;
    if (const auto* const* whole = std::get_if<int*>(&row->value)) return **whole;
    return {};
  }
  [[nodiscard]] double number(const std::string& name, double otherwise) const {
    return number(name).value_or(otherwise);
  }
  [[nodiscard]] bool is_on(const std::string& name) const {
    const auto* row = find(name);
    return row != nullptr && *std::get<bool*>(row->value);
  }
  [[nodiscard]] std::string word(const std::string& name, const std::string& otherwise) const {
    const auto* row = find(name);
    return row == nullptr ? otherwise : *std::get<std::string*>(row->value);
  }

 private:
  plants::Parameters rows_;
};

constexpr double mm = 1000;
constexpr double turn = 2 * std::numbers::pi;
constexpr double degrees = 360;

/// Where a carriage may go, with margins; false if it has no room.
bool find_travel(const PlantRows& rows, MoveAxis& axis) {
  const auto low = std::max(rows.number("travel_min", -1e6), rows.number("limit_min", -1e6)) * mm;
  const auto high = std::min(rows.number("travel_max", 1e6), rows.number("limit_max", 1e6)) * mm;
  constexpr double margin = 0.05;
  axis.low = low + margin * (high - low);
  axis.high = high - margin * (high - low);
  axis.start = (low + high) / 2;
  return high > low;
}

/// Antiresonance and resonance of two masses, as the scenario has their spring.
void find_resonance(const PlantRows& rows, MoveAxis& axis) {
  const double ratio = rows.number("gear.ratio", 1);
  double compliance = 0;  // at the motor
  if (const double gear = rows.number("gear.stiffness", 0); gear > 0) compliance += ratio * ratio / gear;
  const double per_radian = axis.per_turn / mm / turn;
  if (const double nut = rows.number("nut.stiffness", 0); nut > 0)
    compliance += 1 / (nut * per_radian * per_radian);
  const double rotor = rows.number("servo.rotor_inertia", 0);
  const double load = axis.inertia - rotor;
  if (compliance <= 0 || rotor <= 0 || load <= 0) return;
  axis.antiresonance = std::sqrt(1 / compliance / load) / turn;
  axis.resonance = std::sqrt((1 / rotor + 1 / load) / compliance) / turn;
}

void find_stribeck_speed(const PlantRows& rows, const std::vector<FitPath>& vary, MoveAxis& axis) {
  double lowest = 0;
  for (const auto& path : vary) {
    const auto group = path.row.substr(0, path.row.rfind('.') + 1);
    const auto* row = rows.find(group + "stribeck_speed");
    if (row == nullptr) continue;
    const double speed = **std::get_if<double*>(&row->value);
    double at_motor = speed;
    if (row->unit == "mm/s")
      at_motor = speed * mm / axis.per_turn * turn;
    else if (!group.starts_with("motor"))
      at_motor = speed * degrees / axis.per_turn;
    at_motor *= units::rpm;
    lowest = lowest > 0 ? std::min(lowest, at_motor) : at_motor;
  }
  axis.stribeck_speed = lowest;
}

/// How the machine answers to torque, whatever its spring.
void find_answer(scenario::Scenario& machine, MoveAxis& axis) {
  plants::Parameters rows;
  if (quantity_at(machine, {axis.plant, "gear.stiffness"}, rows) != nullptr) {
    set_quantity(machine, {axis.plant, "gear.stiffness"}, 0);
    set_quantity(machine, {axis.plant, "gear.backlash"}, 0);
    make_rigid(machine, axis.plant);
  }
  set_quantity(machine, {axis.plant, "brake.torque"}, 0);
  ReplaySeries series;
  series.plant = axis.plant;
  series.channel = axis.plant + ".motor.speed";
  series.kind = ReplaySeries::Kind::speed;
  constexpr double third = 1.0 / 3;  // it is pushed with three times and six times as much
  series.torque.value = {third * axis.rated_torque};
  const auto answer = measure_answer(machine, series);
  axis.inertia = answer.inertia;
  axis.drag = answer.drag;
}

}  // namespace

std::optional<MoveAxis> move_axis(scenario::Scenario& machine, const FitQuestion& question,
                                  Problems& problems) {
  // Torque and speed limits are gone from a source of torque: they are read from the scenario itself.
  Problems none;
  auto original = scenario::read_scenario_text(question.text, question.file, question.set, none);
  const PlantRows rows(original, question.plant);
  MoveAxis axis;
  axis.plant = question.plant;
  if (rows.find("place") != nullptr) axis.web = rows.word("web", "");
  const auto lead = rows.number("lead");
  const double ratio = rows.number("gear.ratio", 1);
  axis.linear = lead.has_value();
  axis.unit = axis.linear ? "mm" : "deg";
  axis.per_turn = axis.linear ? *lead * mm / ratio : degrees / ratio;
  if (axis.linear && !find_travel(rows, axis)) {
    problems.push_back({"plant.parameters-contradict"_code, question.file.string(), 1, 1,
                        fmt::format("{} has no travel between its limits", axis.plant),
                        "a travel_max above travel_min, and limit switches between them"});
    return {};
  }
  constexpr double counted = 4;
  axis.counts = counted * rows.number("encoder.lines", 0);
  for (const auto* where : {"encoder.on_table", "encoder.on_drum"})
    if (rows.is_on(where)) axis.counts /= ratio;
  axis.reversed = rows.is_on("encoder.reverse");
  axis.drive = rows.word("drive", "servo");
  if (const auto resolution = rows.number("servo.pulses.resolution")) {
    axis.pulse_resolution = *resolution;
    axis.pulses_per_turn = *resolution * rows.number("servo.pulses.gear_denominator", 1) /
                           rows.number("servo.pulses.gear_numerator", 1);
  }
  axis.rated_torque = rows.number("servo.rated_torque", 0);
  axis.peak_torque = rows.number("servo.peak_torque", 0);
  axis.speed_at_10v = rows.number("servo.speed_at_10v", 0) * units::rpm;
  constexpr double of_10v = 0.9;  // the position loop needs the rest
  axis.top_speed = std::min(of_10v * axis.speed_at_10v, rows.number("servo.rated_speed", 1e9) * units::rpm);
  if (axis.linear) set_quantity(machine, {axis.plant, "start"}, axis.start / mm);
  find_answer(machine, axis);
  constexpr double most = 0.6;  // of the peak; the rest is to move it
  if (!std::isfinite(axis.inertia) || axis.inertia <= 0 || std::abs(axis.drag) > most * axis.peak_torque) {
    problems.push_back(
        {"fit.no-torque-left"_code, question.file.string(), 1, 1,
         fmt::format("friction and weight leave the motor of {} no torque to move it with", axis.plant),
         "mass, friction and gear of the machine, or another motor"});
    return {};
  }
  find_resonance(rows, axis);
  find_stribeck_speed(rows, question.vary, axis);
  return axis;
}

}  // namespace drycut::sim::studies
