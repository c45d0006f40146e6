#include "plants/measuring_wheel.hpp"

#include <algorithm>

namespace drycut::plants {

MeasuringWheel::MeasuringWheel(const MeasuringWheelData& data, Random noise) : pulses(noise), data_(data) {
  set_slip(data.slip);
}

void MeasuringWheel::set_slip(double share) {
  base_ += turns_per_metre_ * (travel_ - anchor_);
  anchor_ = travel_;
  turns_per_metre_ = (1 - share) / (data_.circumference * (1 + data_.circumference_error));
}

void MeasuringWheel::sense(double before, double now) {
  const double turns_before = base_ + turns_per_metre_ * (before - anchor_);
  revolutions_ = base_ + turns_per_metre_ * (now - anchor_);
  travel_ = now;
  const double bits_per_turn = 4.0 * data_.lines;
  pulses.carry(turns_before * bits_per_turn, revolutions_ * bits_per_turn);
  index.edges.clear();
  if (!pulses.stuck())
    put_index(index, turns_before, revolutions_, turns_before * bits_per_turn, revolutions_ * bits_per_turn,
              bits_per_turn);
}

void MeasuringWheel::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  faults.push_back({component, "slip", "%", [this](double v) { set_slip(v); },
                    "share of the travel that the wheel does not follow, instead of the parameter's",
                    in_percent});
  pulses.offer_faults(faults, component);
}

Parameters wheel_parameters(MeasuringWheelData& data) {
  return {
      row("circumference", "mm", "nominal circumference of the measuring wheel", data.circumference, 10,
          10000, "usual wheel of 500 mm"),
      row("circumference_error", "%", "true circumference over nominal, minus 1: wear, dirt",
          data.circumference_error, -20, 20, "ideal: none"),
      row("slip", "%", "share of the travel that the wheel does not follow", data.slip, 0, 100,
          "ideal: none"),
      row("lines", "lines of its encoder per turn; counted four times", data.lines, 1, 1000000,
          "0.05 mm a count with 500 mm"),
  };
}

}  // namespace drycut::plants
