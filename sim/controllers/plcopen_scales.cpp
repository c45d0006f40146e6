// Whether the axes of a PLCopen controller fit the machine: encoders, references, the circumference of a
// drum.
#include "sim/controllers/plcopen_scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/text.hpp"
#include "sim/scenario/axis_units.hpp"

namespace drycut::sim::controllers {

namespace plcopen = devices::plcopen;

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double increments_a_metre = 1e7;
constexpr double increments_a_turn = 3.6e6;

bool differ(double a, double b, double tolerance) { return std::abs(a - b) > tolerance * std::abs(b); }

/// The plug that a terminal is wired to; "" without.
std::string plug_at(const scenario::Scenario& scenario, const std::string& terminal) {
  for (const auto& wire : scenario.wiring)
    if (same_word(wire.terminal.text, terminal)) return wire.plug.text;
  return "";
}

class AxisJudge {
 public:
  AxisJudge(const PlcopenSection::Axis& axis, const scenario::Scenario& scenario,
            const scenario::ControllerSection::ScaleOf& scale_of)
      : axis_(axis), of_(axis.configuration.parameters), scenario_(scenario), scale_of_(scale_of) {}

  std::vector<Finding> run() {
    judge_path();
    judge_speed();
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool turns() const { return axis_.configuration.measure == plcopen::Measure::angle; }
  /// Of the plug at this terminal of the axis, where the machine's part moves as the axis is measured.
  [[nodiscard]] std::optional<plants::PlugScale> scale_at(const std::string& terminal,
                                                          std::string& plug) const {
    plug = plug_at(scenario_, fmt::format("{}.{}", axis_.name.text, terminal));
    const auto scale = plug.empty() ? std::nullopt : scale_of_(plug);
    return scale && scale->turns == turns() ? scale : std::nullopt;
  }

  void judge_path() {
    std::string plug;
    const auto scale = scale_at("encoder", plug);
    if (!scale) return;
    const double way =
        turns() ? of_.path_increments / increments_a_turn * turn : of_.path_increments / increments_a_metre;
    const double given = scale->value * way;
    constexpr double tolerance = 1e-3;
    if (!differ(of_.path_counts, given, tolerance)) return;
    const auto shown = turns() ? fmt::format("{:.6g} deg", of_.path_increments / increments_a_turn * 360)
                               : fmt::format("{:.6g} mm", of_.path_increments / increments_a_metre * 1000);
    found_.emplace_back("wiring.counts-contradict"_code,
                        fmt::format("{}.path says {:.10g} counts for {}, and {} gives {:.10g}",
                                    axis_.name.text, of_.path_counts, shown, plug, given));
  }

  void judge_speed() {
    std::string plug;
    const auto scale = scale_at("reference", plug);
    if (!scale) return;
    const double in_unit = turns() ? scale->value / turn * 360 : scale->value * 1000;
    const double says = of_.v_at_10v / 1000;
    constexpr double tolerance = 1e-2;
    if (!differ(says, in_unit, tolerance)) return;
    const std::string_view unit = turns() ? "deg/s" : "mm/s";
    found_.emplace_back("wiring.speed-contradicts"_code,
                        fmt::format("{}.antr.v_at_10v is {:.6g} {}, and 10 V at {} are {:.6g} {}",
                                    axis_.name.text, says, unit, plug, in_unit, unit));
  }

  const PlcopenSection::Axis& axis_;
  const plcopen::AxisParameters& of_;
  const scenario::Scenario& scenario_;
  const scenario::ControllerSection::ScaleOf& scale_of_;
  std::vector<Finding> found_;
};

/// The way of the web in a turn of a straight-bladed knife's drum [m].
std::optional<double> circumference_of(const scenario::PlantEntry& plant) {
  if (plant.type.text != "rotary_knife") return {};
  std::optional<double> found;
  for (const auto& row : plant.definition->parameters()) {
    const auto* const* value = std::get_if<double*>(&row.value);
    if (value == nullptr) continue;
    if (row.name == "circumference") found = **value;
    if (row.name == "helix" && **value != 0) return {};
  }
  return found;
}

/// The slope that is nearest to `wanted` among the straight lines of a cam; nothing if it has none.
std::optional<double> nearest_slope(const plcopen::McCamTable& cam, double wanted) {
  const auto interpolation =
      plcopen::interpolation_of(cam, static_cast<std::uint32_t>(plcopen::Interpolation::table_defined));
  const bool lines = interpolation && (*interpolation == plcopen::Interpolation::linear ||
                                       *interpolation == plcopen::Interpolation::line_poly5 ||
                                       *interpolation == plcopen::Interpolation::poly5_line);
  if (!lines || cam.columns() != 2) return {};
  // Every second piece is a line, the first or the second; with `linear` all are.
  const std::size_t every = *interpolation == plcopen::Interpolation::linear ? 1 : 2;
  std::optional<double> best;
  for (std::size_t i = 0; i + 1 < cam.lines(); i += every) {
    const double slope = (cam.value(i + 1, 1) - cam.value(i, 1)) / (cam.value(i + 1, 0) - cam.value(i, 0));
    if (!best || std::abs(slope - wanted) < std::abs(*best - wanted)) best = slope;
  }
  return best;
}

}  // namespace

std::vector<Finding> contradicting_scales(const PlcopenSection& section, const scenario::Scenario& scenario,
                                          const scenario::ControllerSection::ScaleOf& scale_of) {
  std::vector<Finding> found;
  for (const auto& axis : section.axes)
    for (auto& note : AxisJudge(axis, scenario, scale_of).run()) found.push_back(std::move(note));
  return found;
}

std::vector<Finding> contradicting_cams(const PlcopenSection& section,
                                        const std::vector<plcopen::McCamTable>& cams,
                                        const scenario::Scenario& scenario) {
  std::vector<Finding> found;
  for (const auto& axis : section.axes) {
    if (axis.configuration.measure != plcopen::Measure::angle) continue;
    const auto plug = plug_at(scenario, axis.name.text + ".encoder");
    for (const auto& plant : scenario.plants) {
      const auto circumference = circumference_of(plant);
      if (!circumference || plug != plant.name.text + ".encoder") continue;
      const double wanted = increments_a_turn / (*circumference * increments_a_metre);
      for (const auto& cam : cams) {
        const auto slope = nearest_slope(cam, wanted);
        constexpr double tolerance = 0.02;
        if (!slope || *slope <= 0 || !differ(*slope, wanted, tolerance)) continue;
        found.emplace_back(
            "wiring.cam-contradicts"_code,
            fmt::format("{} runs {:.4g} deg a mm of web, as a drum of {:.6g} mm does, and {} has {:.6g} mm",
                        cam.file, *slope * increments_a_metre / increments_a_turn * 360 / 1000,
                        increments_a_turn / (*slope * increments_a_metre) * 1000, plant.name.text,
                        *circumference * 1000));
      }
    }
  }
  return found;
}

}  // namespace drycut::sim::controllers
