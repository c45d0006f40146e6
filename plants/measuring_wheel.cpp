#include "plants/measuring_wheel.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

double MeasuringWheelData::radius() const { return circumference * (1 + circumference_error) / units::turn; }

MeasuringWheel::MeasuringWheel(const MeasuringWheelData& data, Random noise, double speed)
    : pulses(noise),
      data_(data),
      start_speed_(speed),
      uneven_(data.eccentricity != 0 || data.tooth_error != 0),
      bits_per_turn_(4.0 * data.lines) {
  set_slip(data.slip);
}

void MeasuringWheel::set_slip(double share) {
  base_ += turns_per_metre_ * (travel_ - anchor_);
  anchor_ = travel_;
  slip_ = share;
  turns_per_metre_ = (1 - slip_) / (data_.circumference * (1 + data_.circumference_error));
}

// The axis turns at w, the web runs at w times its distance from the axis, r + e cos(angle): r angle + e
// sin(angle) has rolled off. Solved by Newton's method within a turn, so that nothing is lost far away.
double MeasuringWheel::turned(double rolled) const {
  if (data_.eccentricity == 0) return rolled;
  const double ratio = data_.eccentricity / data_.radius();
  const double whole = std::floor(rolled);
  const double way = (rolled - whole) * units::turn;
  double angle = way - ratio * std::sin(way);
  for (int i = 0; i < 20; ++i) {
    const double change = (way - angle - ratio * std::sin(angle)) / (1 + ratio * std::cos(angle));
    angle += change;
    if (std::abs(change) < 1e-14) break;
  }
  return whole + angle / units::turn;
}

double MeasuringWheel::shown(double turns) const {
  if (data_.tooth_error == 0) return turns;
  const double angle = (turns - std::floor(turns)) * units::turn;
  return turns + data_.tooth_error / data_.radius() * std::sin(angle * data_.teeth) / units::turn;
}

void MeasuringWheel::sense(double before, double now, double h) {
  double from = rolled(before);
  double to = revolutions_ = rolled(now);
  travel_ = now;
  if (uneven_) {
    from = shown_.at(from, [this](double turns) { return shown(turned(turns)); });
    revolutions_ = turned(to);
    to = shown_.at(to, [this](double) { return shown(revolutions_); });
  }
  const double count_before = from * bits_per_turn_;
  const double count = to * bits_per_turn_;
  pulses.carry(count_before, count, h);
  index.edges.clear();
  // The errors are 0 at whole turns: the index stays where it is.
  if (!pulses.stuck()) put_index(index, from, to, count_before, count, bits_per_turn_);
}

void MeasuringWheel::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  faults.push_back(
      {component,
       "slip",
       "%",
       [this](double v) { set_slip(v); },
       "share of the travel that the wheel does not follow, instead of the parameter's; below 0 it runs "
       "ahead",
       {-100, 100, false},
       [this] { return data_.slip; },
       0.05});
  pulses.offer_faults(faults, component);
}

void MeasuringWheel::visit(StateArchive& archive) {
  STATE(archive, pulses, index, slip_, anchor_, base_, travel_, revolutions_);
  if (archive.restores())
    turns_per_metre_ = (1 - slip_) / (data_.circumference * (1 + data_.circumference_error));
}

Parameters wheel_parameters(MeasuringWheelData& data) {
  return {
      row("circumference", "mm", "nominal circumference of the measuring wheel", data.circumference, 10,
          10000, "usual wheel of 500 mm"),
      row("circumference_error", "%", "true circumference over nominal, minus 1: wear, dirt",
          data.circumference_error, -20, 20, "ideal: none"),
      row("slip", "%", "share of the travel that the wheel does not follow", data.slip, 0, 100,
          "ideal: none"),
      row("acceleration_slip", "s2/m",
          "the same for each m/s2 of the web's acceleration; braking gives back what was lost",
          data.acceleration_slip, 0, 0.1, "ideal: none"),
      row("eccentricity", "mm", "its axis lies so far from the middle of its rim", data.eccentricity, 0, 100,
          "ideal: none"),
      row("tooth_error", "mm", "peak of its error once a tooth of its encoder's gear, on the web",
          data.tooth_error, 0, 100, "ideal: none"),
      row("teeth", "teeth, for tooth_error", data.teeth, 1, 100000, "a round number"),
      row("lines", "lines of its encoder per turn; counted four times", data.lines, 1, 1000000,
          "0.05 mm a count with 500 mm"),
  };
}

std::vector<PlantDefinition::Objection> wheel_objections(const MeasuringWheelData& data) {
  const double radius = data.radius();
  if (data.eccentricity >= radius / 2)
    return {{"plant.parameters-contradict"_code, "wheel.eccentricity",
             fmt::format("{:g} mm on a radius of {:.4g} mm is no measuring wheel", data.eccentricity * 1000,
                         radius * 1000),
             fmt::format("less than {:.4g} mm", radius * 500)}};
  if (data.tooth_error * data.teeth >= radius)
    return {{"plant.parameters-contradict"_code, "wheel.tooth_error",
             fmt::format("with {} teeth the count would go back within each", data.teeth),
             fmt::format("less than {:.3g} mm, or fewer teeth", radius * 1000 / data.teeth)}};
  return {};
}

}  // namespace drycut::plants
