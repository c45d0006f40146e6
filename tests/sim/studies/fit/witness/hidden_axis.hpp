#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "plants/linear_axis.hpp"
#include "plants/random.hpp"
#include "sim/recordings/recording.hpp"
#include "tests/plants/witness/screw_law.hpp"

namespace drycut::sim::studies {

/// How an axis was recorded.
struct Recorder {
  double every = 1e-3;         ///< [s]
  int late = 1;                ///< samples by which the torque lags
  double noise = 0.03;         ///< of the torque, standard deviation [N m]
  double torque_lsb = 9.5e-3;  ///< [N m]
  double offset = 0.15;        ///< of the torque [N m]
  bool scale = false;          ///< a linear scale on the carriage, of 1 um
};

/// An axis whose values a fit does not know, integrated by CVODE from the equations of its parts: none of the
/// plants' code runs.
class HiddenAxis {
 public:
  HiddenAxis(const plants::LinearAxisData& data, std::vector<plants::witness::Leg> legs)
      : per_turn_(4.0 * data.sensors.encoder.lines), until_(legs.back().until) {
    plants::witness::ScrewLaw law(data, data.drive.servo, {std::move(legs)});
    plants::witness::Cvode cvode(law, 1e-9);
    for (int i = 0; i * step < until_; ++i) {
      if (i > 0) cvode.run_to(i * step);
      if (law.motion.follow(i * step)) cvode.restart();
      const auto y = cvode.state();
      torque_.push_back(y[law.servo_states + plants::witness::Servo::torque]);
      angle_.push_back(y[law.angle]);
      place_.push_back(y[law.place]);
    }
  }

  [[nodiscard]] recordings::Recording recorded(const Recorder& by, std::uint64_t seed) const {
    recordings::Series torque{"axis.motor.torque", "N m"};
    recordings::Series counts{"axis.encoder.count", ""};
    recordings::Series place{"axis.position", "m"};
    plants::Random random(seed, "recorder");
    const auto apart = static_cast<std::size_t>(std::lround(by.every / step));
    for (std::size_t i = 0; i < torque_.size(); i += apart) {
      const double at = static_cast<double>(i) * step;
      const auto lag = static_cast<std::size_t>(by.late) * apart;
      const double true_torque = torque_[i < lag ? 0 : i - lag];
      const double told = true_torque + by.offset + by.noise * random.gaussian();
      torque.time_s.push_back(at);
      torque.value.push_back(by.torque_lsb * std::round(told / by.torque_lsb));
      counts.time_s.push_back(at);
      counts.value.push_back(std::floor(angle_[i] / (2 * std::numbers::pi) * per_turn_));
      place.time_s.push_back(at);
      constexpr double resolution = 1e-6;
      place.value.push_back(resolution * std::floor(place_[i] / resolution));
    }
    recordings::Recording recording;
    recording.file = "hidden.csv";
    recording.series = {torque, counts};
    if (by.scale) recording.series.push_back(place);
    return recording;
  }

 private:
  static constexpr double step = 5e-4;  // [s]
  double per_turn_;
  double until_;
  std::vector<double> torque_;
  std::vector<double> angle_;
  std::vector<double> place_;
};

}  // namespace drycut::sim::studies
