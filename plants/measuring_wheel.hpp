#pragma once
#include <string>
#include <vector>

#include "plants/encoder.hpp"
#include "plants/plant.hpp"

namespace drycut::plants {

/// A wheel with an incremental encoder that runs on the web. It has no inertia of its own.
struct MeasuringWheelData {
  double circumference = 0.5;      ///< nominal [m]
  double circumference_error = 0;  ///< true circumference = nominal * (1 + error)
  double slip = 0;                 ///< share of the travel that the wheel does not follow, 0..1
  int lines = 2500;                ///< of its encoder, per turn
};

/// Rows of the group `wheel.`.
Parameters wheel_parameters(MeasuringWheelData& data);

class MeasuringWheel {
 public:
  MeasuringWheel(const MeasuringWheelData& data, Random noise);

  PulseLine pulses;
  SignalPort index;  ///< once a turn of the wheel, as Encoder::index

  /// Follows the web over the last step: travel since the start [m].
  void sense(double before, double now);
  [[nodiscard]] double revolutions() const { return revolutions_; }

  /// slip, and what PulseLine offers, under the component name `component`.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

 private:
  void set_slip(double share);

  MeasuringWheelData data_;
  double turns_per_metre_ = 0;  // with the slip of now
  double anchor_ = 0;           // travel where the slip changed last [m]
  double base_ = 0;             // turns there
  double travel_ = 0;
  double revolutions_ = 0;
};

}  // namespace drycut::plants
