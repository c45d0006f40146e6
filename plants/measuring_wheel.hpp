#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/transducers.hpp"

namespace drycut::plants {

/// A wheel with an incremental encoder that runs on the web. It has no inertia of its own.
struct MeasuringWheelData {
  double circumference = 0.5;      ///< nominal [m]
  double circumference_error = 0;  ///< true circumference = nominal * (1 + error)
  double slip = 0;                 ///< share of the travel that the wheel does not follow, 0..1
  double acceleration_slip = 0;    ///< the same for each m/s2 at which the web gets faster [s2/m]
  double eccentricity = 0;         ///< of its axis from the middle of its rim [m]
  double tooth_error = 0;          ///< peak of the error that comes `teeth` times a turn, on the web [m]
  int teeth = 64;                  ///< of the gear or coupling of its encoder
  int lines = 2500;                ///< of its encoder, per turn

  [[nodiscard]] double radius() const;  ///< the true one [m]
};

/// Rows of the group `wheel.`.
Parameters wheel_parameters(MeasuringWheelData& data);
/// What is wrong with them, for parameters of the group `wheel.`.
std::vector<PlantDefinition::Objection> wheel_objections(const MeasuringWheelData& data);

class MeasuringWheel {
 public:
  /// `speed` of the web at the start [m/s].
  MeasuringWheel(const MeasuringWheelData& data, Random noise, double speed = 0);

  PulseLine pulses;
  SignalPort index;  ///< once a turn of the wheel, as Encoder::index

  /// Follows the web over the last step of `h` seconds: travel since the start [m].
  void sense(double before, double now, double h);
  /// The same for a wheel that creeps while the web gets faster: what the rim takes along is proportional to
  /// the force, and so to the acceleration. It gets back what it lost when the web gets slower again.
  void sense(const Slide& web, double h) {
    if (data_.acceleration_slip == 0) return sense(web.position_before, web.position, h);
    sense(web.position_before - creep(web.speed_before), web.position - creep(web.speed), h);
  }
  [[nodiscard]] double revolutions() const { return revolutions_; }

  /// slip, and what PulseLine offers, under the component name `component`.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

  void visit(StateArchive& archive);

 private:
  void set_slip(double share);
  // The integral of acceleration_slip * acceleration * speed since the start [m].
  [[nodiscard]] double creep(double speed) const {
    return data_.acceleration_slip / 2 * (speed * std::abs(speed) - start_speed_ * std::abs(start_speed_));
  }
  // Turns of the wheel when that much of its rim has rolled off [turns], and what its encoder shows of them.
  [[nodiscard]] double rolled(double travel) const { return base_ + turns_per_metre_ * (travel - anchor_); }
  [[nodiscard]] double turned(double rolled) const;
  [[nodiscard]] double shown(double turns) const;

  const MeasuringWheelData data_;
  const double start_speed_;    // [m/s]
  const bool uneven_;           // in a turn
  const double bits_per_turn_;  // counts x4
  double slip_ = 0;             // of now
  double turns_per_metre_ = 0;  // with it
  double anchor_ = 0;           // travel where the slip changed last [m]
  double base_ = 0;             // turns there
  double travel_ = 0;
  double revolutions_ = 0;
  LastValue shown_;
};

}  // namespace drycut::plants
