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

Parameters wheel_parameters(MeasuringWheelData& data, const std::string& prefix) {
  return {
      {.name = prefix + "circumference",
       .unit = "mm",
       .meaning = "nominal circumference of the measuring wheel",
       .value = &data.circumference,
       .min = 10,
       .max = 10000,
       .source = "usual wheel of 500 mm"},
      {.name = prefix + "circumference_error",
       .unit = "%",
       .meaning = "true circumference over nominal, minus 1: wear, dirt",
       .value = &data.circumference_error,
       .min = -20,
       .max = 20,
       .source = "ideal: none"},
      {.name = prefix + "slip",
       .unit = "%",
       .meaning = "share of the travel that the wheel does not follow",
       .value = &data.slip,
       .min = 0,
       .max = 100,
       .source = "ideal: none"},
      {.name = prefix + "lines",
       .unit = "",
       .meaning = "lines of its encoder per turn; counted four times",
       .value = &data.lines,
       .min = 1,
       .max = 1000000,
       .source = "0.05 mm a count with 500 mm"},
  };
}

}  // namespace drycut::plants
