#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/loop/names.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Compares where axes believe to be with where their machine is: another scale, another place at the first
/// command, where no program homes them; another zero, where one does. Only of axes that count a machine with
/// a position.
class Whereabouts : public record::Observer {
 public:
  Whereabouts(const scenario::Scenario& scenario, devices::Controller& controller, Names& names);

  void sample(Time now) override;
  void visit(StateArchive& archive) override;

  /// What differs, a phrase each: "Axis counted 50 where press.position went 200 mm".
  [[nodiscard]] std::vector<Finding> texts() const;
  /// Of axes that a program homes, a phrase each: "AxisX is at 50 where saw.position is 5 mm: another zero".
  [[nodiscard]] std::vector<Finding> zeros() const;

 private:
  struct Axis {
    std::string name;
    std::function<double()> drive;
    std::function<double()> posit;  ///< in the axis' unit
    std::function<double()> decpt;
    std::string plant;                 ///< "press.position"
    std::function<double()> position;  ///< [mm]
    bool homed = false;                ///< by a program
    double last_posit = 0;
    double last_position = 0;
    double went = 0;   ///< by the axis' count, in its unit, without what a program set
    double moved = 0;  ///< by the machine [mm], in the same time
    bool driven = false;
    double began_posit = 0;  ///< when it was driven first ...
    double began = 0;        ///< ... and the machine then [mm]
    double rests_posit = 0;  ///< where it believed to be when the machine rested last ...
    double rests = 0;        ///< ... and the machine [mm]
  };
  [[nodiscard]] static double unit_position(const Axis& axis);

  std::vector<Axis> axes_;
};

}  // namespace drycut::sim::loop
