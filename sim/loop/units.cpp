#include "sim/loop/units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "sim/loop/wires.hpp"

namespace drycut::sim::loop {

namespace {

std::optional<plants::PlugScale> scale_of(const std::vector<NamedPlant>& plants, const std::string& plug) {
  for (const auto& [name, plant] : plants)
    if (plug.starts_with(name + ".")) return plant->scale_of(std::string_view(plug).substr(name.size() + 1));
  return {};
}

/// How far a length is from a power of ten of `base`: 0.1 mm, 1 mm, 10 mm ... are 0.
bool is_round(double value, double base) {
  constexpr double tolerance = 0.001;  // 0.23 %
  const double decades = std::log10(value / base);
  return std::abs(decades - std::round(decades)) < tolerance;
}

/// A unit of an axis as the machine has it.
struct MachineUnit {
  devices::Controller::CountedUnit counted;
  std::string plug;
  double length = 0;  ///< [m], 0 = it turns and touches no material
  double angle = 0;   ///< [rad], 0 = it does not turn

  [[nodiscard]] std::string text() const {
    return fmt::format("{}: a unit is {} by {}", counted.name,
                       length > 0 ? fmt::format("{:.4g} mm", length * 1000)
                                  : fmt::format("{:.4g} deg", angle * 180 / std::numbers::pi),
                       plug);
  }
};

std::vector<MachineUnit> machine_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                       const std::vector<NamedPlant>& plants) {
  std::vector<MachineUnit> units;
  for (auto& unit : controller.counted_units()) {
    const auto* wire = wire_at(scenario, controller, unit.counter);
    const auto scale = wire != nullptr ? scale_of(plants, wire->plug.text) : std::nullopt;
    if (!scale || unit.counts <= 0) continue;
    const double way = unit.counts / scale->value;
    units.push_back(
        {std::move(unit), wire->plug.text, scale->turns ? way * scale->radius : way, scale->turns ? way : 0});
  }
  return units;
}

}  // namespace

std::vector<Finding> contradictions(const scenario::Scenario& scenario,
                                    const std::vector<NamedPlant>& plants) {
  if (!scenario.controller) return {};
  return scenario.controller->contradictions(scenario,
                                             [&](const std::string& plug) { return scale_of(plants, plug); });
}

std::vector<Finding> contradicting_speeds(const scenario::Scenario& scenario, devices::Controller& controller,
                                          const std::vector<NamedPlant>& plants) {
  constexpr double tolerance = 0.02;
  std::vector<Finding> found;
  for (const auto& loop : controller.position_loops()) {
    const double told = loop.counts_at_10v ? loop.counts_at_10v() : 0;
    if (told <= 0 || !loop.counter || !loop.reference) continue;
    const auto* counted = wire_at(scenario, controller, *loop.counter);
    const auto* driven = wire_at(scenario, controller, *loop.reference);
    if (counted == nullptr || driven == nullptr) continue;
    const auto counts = scale_of(plants, counted->plug.text);
    const auto speed = scale_of(plants, driven->plug.text);
    if (!counts || !speed || counts->turns != speed->turns) continue;
    const double given = std::abs(counts->value * speed->value);
    if (std::abs(told - given) <= tolerance * given) continue;
    found.emplace_back(
        "wiring.speed-contradicts"_code,
        fmt::format("{}: by its parameters 10 V are {:.0f} counts/s (maxvel, unitvel, decpt, counts a "
                    "unit), by {} and {} {:.0f}",
                    loop.name, told, driven->plug.text, counted->plug.text, given));
  }
  return found;
}

std::vector<Finding> strange_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                   const std::vector<NamedPlant>& plants) {
  constexpr double millimetre = 1e-3;
  constexpr double inch = 25.4e-3;
  constexpr double degree = std::numbers::pi / 180;
  std::vector<Finding> found;
  for (const auto& unit : machine_units(scenario, controller, plants)) {
    const bool of_length =
        unit.length > 0 && (is_round(unit.length, millimetre) || is_round(unit.length, inch));
    const bool of_angle =
        unit.angle > 0 && (is_round(unit.angle, degree) || is_round(unit.angle, 360 * degree));
    if (!of_length && !of_angle) found.emplace_back("wiring.strange-unit"_code, unit.text());
  }
  return found;
}

std::vector<Finding> different_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                     const std::vector<NamedPlant>& plants) {
  constexpr double tolerance = 0.01;
  const auto units = machine_units(scenario, controller, plants);
  std::vector<Finding> found;
  for (std::size_t i = 1; i < units.size(); ++i) {
    const auto& own = units[i - 1];
    const auto& master = units[i];
    if (own.counted.axis != master.counted.axis || own.length == 0 || master.length == 0) continue;
    if (std::abs(own.length - master.length) > tolerance * own.length)
      found.emplace_back("wiring.units-differ"_code, fmt::format("{}, {}", own.text(), master.text()));
  }
  return found;
}

std::vector<Finding> strange_cycles(const std::vector<CamCycle>& cycles,
                                    const std::vector<std::pair<std::string, record::Tolerance>>& limits) {
  constexpr double tolerance = 0.02;
  const auto is_whole = [&](double ratio) {
    return std::round(ratio) >= 1 && std::abs(ratio - std::round(ratio)) <= tolerance * ratio;
  };
  std::vector<Finding> found;
  for (const auto& cycle : cycles)
    for (const auto& [check, limit] : limits) {
      const double wanted = (limit.low + limit.high) / 2;
      if (cycle.unit != "mm" || cycle.length <= 0 || limit.value != "length" || !std::isfinite(wanted) ||
          wanted <= 0 || is_whole(cycle.length / wanted) || is_whole(wanted / cycle.length))
        continue;
      found.emplace_back(
          "loop.cycle-no-piece"_code,
          fmt::format("a cycle of the cam of {} is {:.4g} mm of material, and check '{}' wants "
                      "{:.4g} mm",
                      cycle.axis, cycle.length, check, wanted));
    }
  return found;
}

std::vector<Finding> backward_masters(const scenario::Scenario& scenario, devices::Controller& controller,
                                      const std::vector<NamedPlant>& plants) {
  std::vector<Finding> found;
  const auto units = controller.counted_units();
  // A device's first counter is its own, the second one its master's.
  for (std::size_t i = 1; i < units.size(); ++i) {
    const auto reversed = controller.find(units[i].axis + ".st_cntrevm");
    const auto* wire = wire_at(scenario, controller, units[i].counter);
    if (units[i - 1].axis != units[i].axis || !reversed || wire == nullptr) continue;
    const auto scale = scale_of(plants, wire->plug.text);
    if (scale && (reversed->read() != 0) == (scale->value > 0))
      found.emplace_back("wiring.master-backwards"_code,
                         fmt::format("{} counts its master backwards (st_cntrevm {:g}, {})", units[i].axis,
                                     reversed->read(), wire->plug.text));
  }
  return found;
}

}  // namespace drycut::sim::loop
