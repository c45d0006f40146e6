#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plants/plant.hpp"
#include "plants/screw_drive.hpp"
#include "plants/stiff_pair.hpp"

namespace drycut::plants {

// What a plant objects to when its data are taken together: motions that are too fast for the step, and
// places that contradict each other.

/// Parameters of a plant with complaints about them.
class AxisObjections {
 public:
  /// `what_moves`: "carriage", "ram". `h`: the step for which the data are judged [s].
  AxisObjections(std::string_view what_moves, double h) : what_moves_(what_moves), h_(h) {}

  void object(Code code, std::string_view parameter, std::string what, std::string remedy);
  /// A pair, "motor and drum", whose spring or damper (parameters `stiffness`, `damping`) is faster than the
  /// step.
  void pair(std::string_view stiffness, std::string_view damping, const StiffPair& pair,
            std::string_view pair_name);
  /// A damper alone.
  void damper(std::string_view parameter, double damping, double inertia, std::string_view pair_name) {
    pair(parameter, parameter, {0, damping, inertia}, pair_name);
  }
  /// Motor and load on the gear; inertias of the motor on its own shaft and of the load [kg m2].
  void gear(const TransmissionData& gear, double motor_inertia, double load_inertia);
  /// Friction that stops `inertia` [kg m2 or kg].
  void viscous(std::string_view parameter, const Friction& friction, double inertia, std::string_view part);
  /// A spring with a damper, of parameters `group`.stiffness and .damping, that throws `mass` [kg] back.
  void contact(const std::string& group, const EndStopData& stop, double mass, std::string_view what);
  /// Of a part on a screw drive: gear and end stops; `motor_inertia` turns with the motor [kg m2].
  void screw(const ScrewDriveData& data, double motor_inertia);
  /// Of the same: friction (`guides`: the parameter of the part's), travel and limit switches.
  void guided(std::string_view guides, const ScrewDriveData& data, double motor_inertia);

  void add(std::vector<PlantDefinition::Objection> more);
  [[nodiscard]] std::vector<PlantDefinition::Objection> take() { return std::move(found_); }

 private:
  std::string_view what_moves_;
  double h_;
  std::vector<PlantDefinition::Objection> found_;
};

/// "scene.step of at most 50 us": the largest round step up to `longest` [s].
[[nodiscard]] std::string step_remedy(double longest);

}  // namespace drycut::plants
