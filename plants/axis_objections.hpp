#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plants/end_stop.hpp"
#include "plants/friction.hpp"
#include "plants/plant.hpp"
#include "plants/transmission.hpp"

namespace drycut::plants {

// What every axis on a gear objects to when its data are taken together: motions that are too fast for the
// usual step, and places that contradict each other.

/// The step for which data are judged [s].
inline constexpr double usual_step = 100e-6;

/// Parameters of an axis with complaints about them.
class AxisObjections {
 public:
  /// `what_moves`: "carriage", "ram".
  explicit AxisObjections(std::string_view what_moves) : what_moves_(what_moves) {}

  void object(std::string_view parameter, std::string what, std::string remedy);
  /// Motor and load on the gear oscillate too fast; inertias on the motor's shaft [kg m2].
  void gear(const TransmissionData& gear, double motor_inertia, double load_inertia);
  /// Friction that stops `inertia` [kg m2 or kg] within a step; `unit` of the friction.
  void viscous(std::string_view parameter, const Friction& friction, double inertia, std::string_view unit);
  /// A spring with a damper that throws `mass` [kg] back within a few steps.
  void contact(std::string_view parameter, const EndStopData& stop, double mass, std::string_view what);
  /// End stops and start [m].
  void travel(double travel_min, double travel_max, double start);
  /// Limit switches [m].
  void limit_switches(double limit_min, double limit_max);

  void add(std::vector<PlantDefinition::Objection> more);
  [[nodiscard]] std::vector<PlantDefinition::Objection> take() { return std::move(found_); }

 private:
  std::string_view what_moves_;
  std::vector<PlantDefinition::Objection> found_;
};

}  // namespace drycut::plants
