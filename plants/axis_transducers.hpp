#pragma once
#include <vector>

#include "plants/encoder.hpp"
#include "plants/position_switch.hpp"

namespace drycut::plants {

/// What an axis' position is measured with; positions along the axis [m].
struct AxisTransducersData {
  EncoderData encoder = {.lines = 2500};                ///< on the motor
  double scale_resolution = 1e-6;                       ///< of the linear scale, a count x4
  double scale_pitch = 0.02;                            ///< between two index pulses of the scale
  PositionSwitchData home = {0, 0.02, 0.5e-3, 0.5e-3};  ///< [m]
  double limit_min = -0.03;                             ///< the limit switches are on beyond these
  double limit_max = 1.03;
  double limit_delay = 0.5e-3;  ///< of the limit switches' filter [s]
};

/// Where a machine's defaults are from.
struct AxisTransducersSources {
  std::string_view scale_resolution = "a usual scale";
  std::string_view home = "position 0";
  std::string_view limits = "20 mm before the stop";
};
/// Rows for a parameter table: `encoder.`, `scale.`, `home.`, `limit_`.
Parameters axis_transducer_parameters(AxisTransducersData& data, const AxisTransducersSources& from = {});

/// Encoder on the motor, linear scale and switches on the moving part. Both count 0 at the start.
class AxisTransducers {
 public:
  /// `start` [m] and `revolutions` of the motor at the start.
  AxisTransducers(const AxisTransducersData& data, double start, double revolutions, Random encoder_noise,
                  Random scale_noise);

  /// Follows the bodies over the last step of `h` seconds.
  void sense(const Shaft& rotor, const Slide& part, double h);

  // What they add to a plant's lists.
  void offer_ports(std::vector<Port>& ports);
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_faults(std::vector<Fault>& faults);

 private:
  AxisTransducersData data_;
  double start_;
  Encoder encoder_;
  PulseLine scale_;
  SignalPort scale_index_;
  PositionSwitch home_;
  PositionSwitch limit_min_;
  PositionSwitch limit_max_;
};

}  // namespace drycut::plants
